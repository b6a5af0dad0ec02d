#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/block_world.hpp"
#include "app/program.hpp"

/// Programs, setups and folders that want too much, or something that is not theirs.
namespace probewright::app::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// Writes `text` into the pipe at `path` as soon as somebody reads.
std::thread intoPipe(const std::string& path, const std::string& text) {
  return std::thread([path, text] {
    const int pipe = open(path.c_str(), O_WRONLY);
    EXPECT_EQ(write(pipe, text.data(), text.size()), static_cast<ssize_t>(text.size()));
    close(pipe);
  });
}

std::string pipeIn(const Folder& folder, const std::string& name) {
  const std::string path = (folder / name).string();
  EXPECT_EQ(mkfifo(path.c_str(), 0600), 0);
  return path;
}

TEST(Hostile, ReadsAProgramFromAPipeOnce) {
  const Folder folder;
  const std::string world = folder.file("s.toml", blockSetup());
  const std::string out = (folder / "out").string();
  const std::string bad = "0 BEGIN PGM P MM\n1 GARBAGE\n2 END PGM P MM\n";
  const auto answerTo = [&](const std::string& text, const std::vector<std::string>& words) {
    const Folder aside;
    const std::string pipe = pipeIn(aside, "p.h");
    std::thread writer = intoPipe(pipe, text);
    std::vector<std::string> all = {words[0], pipe};
    all.insert(all.end(), words.begin() + 1, words.end());
    Answer answer = probewright(all);
    writer.join();
    return answer;
  };
  EXPECT_EQ(answerTo(bad, {"check"}).exit, 2);
  EXPECT_EQ(answerTo(bad, {"run", "--setup", world, "--out", out}).exit, 2);
  EXPECT_EQ(answerTo(bad, {"convert", (folder / "x.mpf").string()}).exit, 2);
  // The side lies at X 20: too long for these limits.
  EXPECT_EQ(answerTo(blockProgram("+19.9", "+19.8"), {"run", "--setup", world, "--out", out}).exit, 1);
  const Answer good = answerTo(blockProgram("+20.1", "+19.9"), {"run", "--setup", world, "--out", out});
  EXPECT_EQ(good.exit, 0) << good.errors;
  EXPECT_THAT(good.output, HasSubstr("OK: the toleranced value is within the limits"));
}

TEST(Hostile, RefusesWhatIsNoFile) {
  const Folder folder;
  const std::string world = folder.file("s.toml", blockSetup()), program = folder.file("p.h", blockProgram());
  const std::string out = (folder / "out").string();
  const auto errors = [&](const std::vector<std::string>& words) {
    const Answer answer = probewright(words);
    EXPECT_EQ(answer.exit, 2) << answer.errors;
    EXPECT_LT(answer.peakMegabytes, 200);
    return answer.errors;
  };
  const auto run = [&](const std::string& name, const std::string& setup, const std::string& answers = {}) {
    std::vector<std::string> words = {"run", name, "--setup", setup, "--out", out};
    if (!answers.empty()) words.insert(words.end(), {"--answers", answers});
    return errors(words);
  };
  const std::string pipe = pipeIn(folder, "pipe.h");
  EXPECT_THAT(errors({"check", "/dev/zero"}), HasSubstr("/dev/zero: error: this is a device"));
  EXPECT_THAT(errors({"check", pipe}), HasSubstr("this is a pipe, and nothing writes into it"));
  EXPECT_THAT(errors({"check", folder.file("big.h", "") + "/.."}), HasSubstr("error:"));
  EXPECT_THAT(run("/dev/zero", world), HasSubstr("this is a device"));
  EXPECT_THAT(run(pipe, world), HasSubstr("this is a pipe"));
  EXPECT_THAT(run((folder / "").string(), world), HasSubstr("this is a folder"));
  EXPECT_THAT(run(program, "/dev/zero"), HasSubstr("this is a device"));
  EXPECT_THAT(run(program, pipe), HasSubstr("this is a pipe"));
  EXPECT_THAT(run(program, world, "/dev/urandom"), HasSubstr("this is a device"));
  EXPECT_THAT(errors({"convert", pipe, (folder / "x.mpf").string()}), HasSubstr("this is a pipe"));
  std::filesystem::create_directory(folder / "part.step");
  const std::string parts = folder.file("part.toml", "[part]\nfile = \"part.step\"\n");
  EXPECT_THAT(run(program, parts), HasSubstr("part.toml:2:8: error: "));
  EXPECT_THAT(run(program, parts), HasSubstr("is a folder or a device"));
  // In the folder of tables, too.
  std::filesystem::create_directories(folder / "T/TOOL.T");
  std::filesystem::create_symlink("nowhere", folder / "T/PRESET.PR");
  const std::string tables = folder.file("t.toml", "[control]\ntype = \"TNC640\"\ntables = \"T\"\n");
  const std::string message = run(folder.file("n.h", "0 BEGIN PGM N MM\n1 END PGM N MM\n"), tables);
  EXPECT_THAT(message, HasSubstr("T/TOOL.T: error: this has the name of a table, but it is a folder"));
  EXPECT_THAT(message, HasSubstr("T/PRESET.PR: error: this has the name of a table, but it is a symbolic link"));
  std::filesystem::remove_all(folder / "T");
  std::filesystem::create_directories(folder / "T");
  folder.file("T/TOOL.T", "");
  folder.file("T/tool.t", "");
  folder.file("T/notes.txt", "");
  folder.file("T/NOTES.TXT", "");
  const std::string twice = run((folder / "n.h").string(), tables);
  EXPECT_THAT(twice, HasSubstr("error: the control knows this table and "));
  EXPECT_THAT(twice, ::testing::Not(HasSubstr("NOTES")));
  // What a program names as a mask.
  folder.file("secret.a", "\"SECRET\";\n");
  for (const std::string& mask :
       std::vector<std::string>{"/dev/zero", "/proc/self/environ", "/etc/passwd", "../secret.a", pipe}) {
    std::filesystem::create_directories(folder / "sub");
    const std::string text = "0 BEGIN PGM P MM\n1 FN 16: F-PRINT " + mask + " / L.TXT\n2 END PGM P MM\n";
    const Answer answer = probewright({"run", folder.file("sub/p.h", text), "--setup", world, "--out", out});
    EXPECT_EQ(answer.exit, 3) << mask << answer.errors;
    EXPECT_LT(answer.peakMegabytes, 200);
    EXPECT_THAT(answer.errors, HasSubstr("p.h:2:"));
    EXPECT_THAT(answer.errors, HasSubstr("in the folder of the program or among the tables")) << mask;
    EXPECT_THAT(answer.errors + textOf(folder / "out/report.html"), Not(HasSubstr("root:x:")));
  }
}

TEST(Hostile, ReadsMasksOfItsOwnFolderAndOfTheTables) {
  const Folder folder;
  std::filesystem::create_directories(folder / "sub/masks");
  std::filesystem::create_directories(folder / "T");
  folder.file("sub/masks/A.A", "\"below\";\n");
  folder.file("T/B.A", "\"tables\";\n");
  const std::string world = folder.file("s.toml", "[control]\ntype = \"TNC640\"\ntables = \"T\"\n");
  const std::string text =
      "0 BEGIN PGM P MM\n1 FN 16: F-PRINT masks/A.A / A.TXT\n2 FN 16: F-PRINT TNC:\\masks\\A.A / B.TXT\n"
      "3 FN 16: F-PRINT B.A / C.TXT\n4 END PGM P MM\n";
  const std::string out = (folder / "out").string();
  const Answer answer = probewright({"run", folder.file("sub/p.h", text), "--setup", world, "--out", out});
  ASSERT_EQ(answer.exit, 0) << answer.errors;
  EXPECT_THAT(textOf(folder / "out/A.TXT"), HasSubstr("below"));
  EXPECT_THAT(textOf(folder / "out/B.TXT"), HasSubstr("below"));
  EXPECT_THAT(textOf(folder / "out/C.TXT"), HasSubstr("tables"));
}

TEST(Hostile, CallsNoProgramOutsideOfItsFolder) {
  const Folder folder;
  std::filesystem::create_directories(folder / "sub");
  folder.file("OUT.H", "0 BEGIN PGM OUT MM\n1 END PGM OUT MM\n");
  const std::string world = folder.file("s.toml", blockSetup());
  const std::string text = "0 BEGIN PGM P MM\n1 CALL PGM ..\\OUT.H\n2 END PGM P MM\n";
  const Answer answer =
      probewright({"run", folder.file("sub/p.h", text), "--setup", world, "--out", (folder / "out").string()});
  EXPECT_NE(answer.exit, 0);
  EXPECT_THAT(answer.errors, HasSubstr("p.h:2:"));
}

struct Loop {
  const char* name;
  const char* program;  ///< without an end
};

/// Loops that leave something behind each time.
const std::vector<Loop> loops = {
    {"fn15.h", "0 BEGIN PGM P MM\n1 LBL 1\n2 FN 15: PRINT 5\n3 FN 9: IF +1 EQU +1 GOTO LBL 1\n4 END PGM P MM\n"},
    {"fn16.h",
     "0 BEGIN PGM P MM\n1 LBL 1\n2 FN 16: F-PRINT M.A / L.TXT\n3 FN 9: IF +1 EQU +1 GOTO LBL 1\n4 END PGM P MM\n"},
    {"screen.h",
     "0 BEGIN PGM P MM\n1 LBL 1\n2 FN 16: F-PRINT M.A / SCREEN:\n3 FN 9: IF +1 EQU +1 GOTO LBL 1\n4 END PGM P MM\n"},
    {"fn17.h",
     "0 BEGIN PGM P MM\n1 LBL 1\n2 FN 1: Q1 = +Q1 + +1\n3 FN 17: SYSWRITE ID990 NR4 IDX1 = +Q1\n"
     "4 FN 9: IF +1 EQU +1 GOTO LBL 1\n5 END PGM P MM\n"},
    {"msg.mpf", "WHILE TRUE\nMSG(\"WAITING\")\nENDWHILE\nM30\n"},
    {"write.mpf", "DEF INT ERR\nWHILE TRUE\nWRITE(ERR,\"LOG\",\"SOMETHING\")\nENDWHILE\nM30\n"},
    {"setal.mpf", "WHILE TRUE\nSETAL(62000)\nENDWHILE\nM30\n"},
    {"tool.mpf", "WHILE TRUE\nR1=R1+1\n$TC_DP3[9,1]=R1\nENDWHILE\nM30\n"},
    {"frame.mpf", "WHILE TRUE\nR1=R1+1\n$P_UIFR[1,X,TR]=R1\nENDWHILE\nM30\n"},
};

TEST(Hostile, StopsALoopThatLeavesMoreAndMore) {
  for (const Loop& loop : loops) {
    const Folder folder;
    folder.file("M.A", "\"A LINE OF A LOG\";\n");
    const bool heidenhain = std::string(loop.name).ends_with(".h");
    const std::string world =
        folder.file("s.toml", heidenhain ? "[control]\ntype = \"TNC640\"\n" : "[control]\ntype = \"840Dsl\"\n");
    const Answer answer = probewright({"run", folder.file(loop.name, loop.program), "--setup", world, "--out",
                                       (folder / "out").string(), "--record-limit", "4", "--quiet"});
    if (std::string(loop.name) == "fn17.h" && answer.exit == 3 &&
        answer.errors.find("--record-limit") == std::string::npos)
      continue;
    EXPECT_EQ(answer.exit, 3) << loop.name << ": " << answer.errors;
    EXPECT_THAT(answer.errors, HasSubstr("--record-limit")) << loop.name;
    EXPECT_THAT(answer.errors, HasSubstr(std::string(loop.name) + ":")) << loop.name;
    EXPECT_THAT(answer.errors, Not(HasSubstr("internal"))) << loop.name;
    EXPECT_LT(answer.peakMegabytes, 150) << loop.name;
  }
}

/// Loops that leave little or nothing behind, but whose blocks take long.
const std::vector<Loop> slowLoops = {
    {"begun_anew.h",
     "0 BEGIN PGM P MM\n1 LBL 1\n2 FN 16: F-PRINT NEW.A / L.TXT\n3 FN 9: IF +1 EQU +1 GOTO LBL 1\n4 END PGM P MM\n"},
    {"table.h", "0 BEGIN PGM P MM\n1 LBL 1\n2 FN 26: TABOPEN T.TAB\n3 FN 9: IF +1 EQU +1 GOTO LBL 1\n4 END PGM P MM\n"},
    {"table.i",
     "%P G71 *\nN10 G98 L1 *\nN20 D26: TABOPEN T.TAB *\nN30 D09 P01 +1 P02 +1 P03 1 *\nN99999999 %P G71 *\n"},
    {"circles.h",
     "0 BEGIN PGM P MM\n1 TOOL CALL 1 Z\n2 L X+10 Y+0 Z-200 R0 FMAX\n3 CC X+0 Y+0\n4 LBL 1\n"
     "5 C X-10 Y+0 DR+ R0 F1000\n6 C X+10 Y+0 DR+\n7 FN 9: IF +1 EQU +1 GOTO LBL 1\n8 END PGM P MM\n"},
    {"isfile.mpf", "WHILE ISFILE(\"DONE.TXT\")==0\nENDWHILE\nM30\n"},
    {"read.mpf",
     "DEF INT ERR\nDEF STRING[200] LINE\nWHILE TRUE\nWRITE(ERR,\"LOG\",\"A LINE THAT IS AS LONG AS LINES OF LOGS "
     "ARE\")\n"
     "READ(ERR,\"LOG\",1,1,LINE)\nENDWHILE\nM30\n"},
    {"delete.mpf", "DEF INT ERR\nWHILE TRUE\nR1=R1+1\nDELETE(ERR,\"F\"<<R1)\nENDWHILE\nM30\n"},
    {"circles.mpf",
     "T1 D1 M6\nG90 G54\nG0 Z-200\nX10 Y0\nWHILE TRUE\nG2 X-10 Y0 I=AC(0) J=AC(0) F1000\nG2 X10 Y0 I=AC(0) J=AC(0)\n"
     "ENDWHILE\nM30\n"},
};

TEST(Hostile, CountsBlocksThatTakeLongAsMany) {
  for (const Loop& loop : slowLoops) {
    const Folder folder;
    folder.file("NEW.A", "M_TRUNCATE\n\"A LINE OF A LOG\";\n");
    folder.file("T.TAB", "BEGIN T.TAB MM\nNR       X         Y\n0        +1        +2\n[END]\n");
    const std::string name = loop.name;
    const std::string control = name.ends_with(".mpf") ? "840Dsl" : "TNC640";
    const std::string world = folder.file("s.toml", "[control]\ntype = \"" + control + "\"\n[[tool]]\nnumber = 1\n" +
                                                        "name = \"P\"\nkind = \"mill\"\nlength = 100\nradius = 3\n");
    const Answer answer = probewright({"run", folder.file(name, loop.program), "--setup", world, "--out",
                                       (folder / "out").string(), "--step-limit", "500000", "--quiet"});
    EXPECT_EQ(answer.exit, 3) << name << ": " << answer.errors;
    EXPECT_THAT(answer.errors, HasSubstr("uses of files included")) << name;
    EXPECT_THAT(answer.errors, HasSubstr("--step-limit")) << name;
    EXPECT_THAT(answer.errors, HasSubstr(name + ":")) << name;
    // The default limit is a hundred times as many: a minute at most.
    if (PROBEWRIGHT_OPTIMIZED) {
      EXPECT_LT(answer.cpuSeconds, 1.0) << name;
    }
  }
}

/// However short a file is, it takes room on the disk and in the folder.
TEST(Hostile, StopsALoopThatWritesMoreAndMoreFiles) {
  const std::vector<Loop> loopsOfFiles = {
      {"names.mpf", "DEF INT ERR\nWHILE TRUE\nR1=R1+1\nWRITE(ERR,\"F\"<<R1,\"A\")\nENDWHILE\nM30\n"},
      {"names.h",
       "0 BEGIN PGM P MM\n1 Q1 = 0\n2 LBL 1\n3 Q1 = Q1 + 1\n4 QS1 = \"F\" || TOCHAR( DAT+Q1 DECIMALS0 )\n"
       "5 FN 16: F-PRINT M.A / :'QS1'\n6 FN 9: IF +1 EQU +1 GOTO LBL 1\n7 END PGM P MM\n"}};
  for (const Loop& loop : loopsOfFiles) {
    const Folder folder;
    folder.file("M.A", "\"A\";\n");
    const bool heidenhain = std::string(loop.name).ends_with(".h");
    const std::string world =
        folder.file("s.toml", heidenhain ? "[control]\ntype = \"TNC640\"\n" : "[control]\ntype = \"840Dsl\"\n");
    const Answer answer = probewright({"run", folder.file(loop.name, loop.program), "--setup", world, "--out",
                                       (folder / "out").string(), "--record-limit", "1", "--quiet"});
    EXPECT_EQ(answer.exit, 3) << loop.name << ": " << answer.errors;
    EXPECT_THAT(answer.errors, HasSubstr("--record-limit")) << loop.name;
    EXPECT_THAT(answer.errors, HasSubstr(std::string(loop.name) + ":")) << loop.name;
    EXPECT_LT(namesIn(folder / "out").size(), 1048576U / 16384U + 10) << loop.name;
  }
}

TEST(Hostile, StopsALoopThatMeasuresForEver) {
  const Folder folder;
  const std::string world = folder.file("s.toml", blockSetup());
  std::string text = blockProgram("+0", "+0", 1);
  text.insert(text.find("3 TCH"), "LBL 1\n");
  text.insert(text.find("4 END"), "FN 9: IF +1 EQU +1 GOTO LBL 1\n");
  const Answer answer = probewright({"run", folder.file("p.h", text), "--setup", world, "--out",
                                     (folder / "out").string(), "--record-limit", "2", "--quiet"});
  EXPECT_EQ(answer.exit, 3) << answer.errors;
  EXPECT_THAT(answer.errors, HasSubstr("--record-limit"));
  EXPECT_THAT(answer.errors, HasSubstr("p.h:"));
  // What was measured until then is there.
  const auto results = nlohmann::json::parse(textOf(folder / "out/results.json"));
  EXPECT_GT(results["cycles"].size(), 10U);
}

TEST(Hostile, LetsATextGrowToTheLengthOfTheControlOnly) {
  const Folder folder;
  const std::string world = folder.file("s.toml", "[control]\ntype = \"TNC640\"\n");
  const std::string text =
      "0 BEGIN PGM P MM\n1 QS1 = \"0123456789\"\n2 LBL 1\n3 QS1 = QS1 || QS1\n4 CALL LBL 1 REP 40\n5 END PGM P MM\n";
  const Answer answer =
      probewright({"run", folder.file("p.h", text), "--setup", world, "--out", (folder / "out").string()});
  EXPECT_EQ(answer.exit, 3);
  EXPECT_THAT(answer.errors, HasSubstr("p.h:4:"));
  EXPECT_THAT(answer.errors, HasSubstr("QS1 takes at most 255 characters"));
}

/// The text of a file that grows is kept, copied and written.
TEST(Hostile, StaysBelowThreeHundredMegabytesAtTheLimit) {
  if (!PROBEWRIGHT_OPTIMIZED) GTEST_SKIP() << "takes too long";
  const Folder folder;
  const std::string world = folder.file("s.toml", "[control]\ntype = \"840Dsl\"\n");
  const std::string text = "DEF INT ERR\nWHILE TRUE\nWRITE(ERR,\"LOG\",\"SOMETHING\")\nENDWHILE\nM30\n";
  const Answer answer =
      probewright({"run", folder.file("p.mpf", text), "--setup", world, "--out", (folder / "out").string(), "--quiet"});
  EXPECT_EQ(answer.exit, 3) << answer.errors;
  EXPECT_THAT(answer.errors, HasSubstr("--record-limit"));
  EXPECT_LT(answer.peakMegabytes, 280);
}

TEST(Hostile, KeepsAMillionMessagesInLittleMemory) {
  if (!PROBEWRIGHT_OPTIMIZED) GTEST_SKIP() << "takes too long";
  const Folder folder;
  const std::string world = folder.file("s.toml", "[control]\ntype = \"840Dsl\"\n");
  const std::string text = "FOR R1=1 TO 1000000\nMSG(\"WAITING FOR THE DOOR\")\nENDFOR\nM30\n";
  const Answer answer =
      probewright({"run", folder.file("p.mpf", text), "--setup", world, "--out", (folder / "out").string(), "--quiet"});
  EXPECT_EQ(answer.exit, 0) << answer.errors;
  EXPECT_LT(answer.peakMegabytes, 300);
  // All of them are there.
  const std::string results = textOf(folder / "out/results.json");
  std::size_t count = 0;
  for (std::size_t at = results.find("WAITING FOR"); at != std::string::npos; at = results.find("WAITING FOR", at + 1))
    ++count;
  EXPECT_EQ(count, 1'000'000U);
}

TEST(Hostile, SurvivesTimesBeyondAllCalendars) {
  const Folder folder;
  const std::string world = folder.file("s.toml", blockSetup());
  std::string text = blockProgram("+0", "+0", 1);
  text.insert(text.find("3 TCH"), "CYCL DEF 9.0 DWELL TIME\nCYCL DEF 9.1 DWELL 1000000000000000000\n");
  const Answer answer =
      probewright({"run", folder.file("p.h", text), "--setup", world, "--out", (folder / "out").string()});
  EXPECT_LE(answer.exit, 3) << answer.errors;
  EXPECT_THAT(answer.errors, Not(HasSubstr("internal error")));
}

/// Seconds until the program ends that gets Ctrl-C after `delay` seconds.
double secondsUntilInterrupted(const std::vector<std::string>& words, double delay) {
  std::vector<std::string> all = {PROBEWRIGHT_PROGRAM};
  all.insert(all.end(), words.begin(), words.end());
  std::vector<char*> arguments;
  for (std::string& word : all)
    arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    dup2(open("/dev/null", O_WRONLY), STDERR_FILENO);
    dup2(open("/dev/null", O_WRONLY), STDOUT_FILENO);
    execv(arguments[0], arguments.data());
    _exit(127);
  }
  std::this_thread::sleep_for(std::chrono::duration<double>(delay));
  const auto begin = std::chrono::steady_clock::now();
  kill(child, SIGINT);
  int status = 0;
  waitpid(child, &status, 0);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

TEST(Hostile, ObeysCtrlCWhileItBuildsThePartAndWhileItRuns) {
  const Folder folder;
  const std::string holes = folder.file("holes.toml", R"(
[[part.feature]]
shape = "box"
size = [900, 900, 20]
[[part.feature]]
shape = "hole"
diameter = 9
centre = [-400, -400, 20]
[[part.feature.pattern]]
kind = "linear"
count = 30
spacing = [27, 0, 0]
[[part.feature.pattern]]
kind = "linear"
count = 30
spacing = [0, 27, 0]
)");
  const std::string out = (folder / "out").string();
  const std::string none = folder.file("n.h", "0 BEGIN PGM N MM\n1 END PGM N MM\n");
  EXPECT_LT(secondsUntilInterrupted({"run", none, "--setup", holes, "--out", out}, 0.7), 2);
  const std::string plain = folder.file("plain.toml", "[control]\ntype = \"TNC640\"\n");
  const std::string endless =
      folder.file("e.h", "0 BEGIN PGM E MM\n1 LBL 1\n2 FN 9: IF +1 EQU +1 GOTO LBL 1\n3 END PGM E MM\n");
  EXPECT_LT(secondsUntilInterrupted({"run", endless, "--setup", plain, "--out", out, "--step-limit", "0"}, 0.7), 2);
  EXPECT_THAT(namesIn(folder / "out"), ::testing::Contains("results.json")) << "what was measured until then";
}

}  // namespace
}  // namespace probewright::app::testing
