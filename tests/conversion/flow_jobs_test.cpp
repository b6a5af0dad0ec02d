#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "base/file.hpp"
#include "conversion/flow.hpp"
#include "session/job.hpp"

/// Jobs of several programs that call each other and share parameters: the programs that are written run through the
/// same touches.
namespace probewright::testing_support {
namespace {

namespace fs = std::filesystem;

/// A folder of this process alone that is gone at the end of the test.
class JobFolder {
public:
  explicit JobFolder(const std::string& name)
      : path_(fs::path(::testing::TempDir()) / fmt::format("{}-{}", name, ::getpid())) {
    fs::remove_all(path_);
    fs::create_directories(path_);
  }
  ~JobFolder() {
    std::error_code none;
    fs::remove_all(path_, none);
  }
  JobFolder(const JobFolder&) = delete;
  JobFolder& operator=(const JobFolder&) = delete;

  fs::path operator/(const std::string& name) const { return path_ / name; }
  const fs::path& path() const { return path_; }

private:
  fs::path path_;
};

using Files = std::map<std::string, std::string>;  ///< texts by name, with ending

void put(const JobFolder& folder, const Files& files) {
  for (const auto& [name, text] : files)
    EXPECT_TRUE(writeFileAtomically(folder / name, text));
}

Twin runFile(const fs::path& path, const Files& files, ProgramLanguage language, const PlantedPart& part) {
  session::RunOptions options;
  options.control = language == ProgramLanguage::Sinumerik ? ControlKind::Sinumerik840Dsl : part.bench.control;
  Twin twin = twinOf(setup::runProgram(path, twinSetup(part.bench.setup), options, {.recordPath = false}));
  for (const auto& [name, text] : files)
    twin.text += text;
  twin.language = language;
  return twin;
}

/// All files of the folder in the other language; `ending`: of theirs. Empty if something is listed.
std::optional<Files> converted(const JobFolder& folder, const Files& files, ProgramLanguage to,
                               const std::string& ending) {
  Files there;
  for (const auto& [name, text] : files) {
    if (name.ends_with(".DEF")) continue;
    const fs::path path = folder / name;
    const ProgramLanguage from = *session::languageOf(path, text);
    const auto program = session::openProgram(path, text, from);
    EXPECT_TRUE(program);
    Diagnostics diagnostics;
    conversion::ConvertOptions options = session::convertOptions(path, from, nullptr, diagnostics);
    const Diagnostics mistakes = session::mistakesOf(**program, path, from);
    EXPECT_FALSE(hasErrors(mistakes)) << format(mistakes.front()) << text;
    const conversion::Job job = session::jobOf(path, from);
    options.job = &job;
    const conversion::Conversion conversion = conversion::convert(**program, from, to, options);
    EXPECT_FALSE(hasErrors(conversion.mistakes)) << text;
    for (const Diagnostic& each : conversion.notCarriedOver)
      if (isLoss(each)) return std::nullopt;
    there[name.substr(0, name.find('.')) + ending] = conversion.text;
  }
  return there;
}

TEST(ConvertJobs, RunHeidenhainProgramsThroughTheSameTouches) {
  const int programs = setting("PROBEWRIGHT_PROGRAMS", 8);
  Dice dice(static_cast<unsigned>(setting("PROBEWRIGHT_SEED", 5001)));
  int compared = 0, inDinIso = 0;
  for (int i = 0; compared < programs && i < 12 * programs; ++i) {
    SCOPED_TRACE(fmt::format("job {}", i));
    const World world(dice);
    Files files = {{"BENCH.H", KlartextFlow(dice, world, {"BENCH", false, {"SECOND", "THIRD"}}).program()},
                   {"SECOND.H", KlartextFlow(dice, world, {"SECOND", true, {"THIRD"}}).program()},
                   {"THIRD.H", KlartextFlow(dice, world, {"THIRD", true, {}}).program()}};
    const JobFolder folder("probewright-job-h"), other("probewright-job-m");
    put(folder, files);
    if (dice.whole(0, 2) == 0) {
      const JobFolder iso("probewright-job-i");
      const auto dinIso = converted(folder, files, ProgramLanguage::DinIso, ".I");
      if (dinIso) {
        for (const auto& [name, text] : files)
          fs::remove(folder / name);
        files = *dinIso;
        put(folder, files);
        ++inDinIso;
      }
    }
    const auto there = converted(folder, files, ProgramLanguage::Sinumerik, ".SPF");
    if (!there) continue;
    ++compared;
    put(other, *there);
    const std::string main = files.begin()->first;
    const Twin original = runFile(folder / main, files, ProgramLanguage::Klartext, world.part);
    const Twin twin = runFile(other / "BENCH.SPF", *there, ProgramLanguage::Sinumerik, world.part);
    ASSERT_TRUE(runsTheSame(original, twin));
  }
  EXPECT_EQ(compared, programs) << "too many jobs are named, too few compared";
  EXPECT_GT(inDinIso, 0);
}

TEST(ConvertJobs, RunSinumerikProgramsThroughTheSameTouches) {
  const int programs = setting("PROBEWRIGHT_PROGRAMS", 8);
  Dice dice(static_cast<unsigned>(setting("PROBEWRIGHT_SEED", 5002)));
  int compared = 0;
  for (int i = 0; compared < programs && i < 60 * programs; ++i) {
    SCOPED_TRACE(fmt::format("job {}", i));
    const World world(dice);
    const Files files = {{"BENCH.MPF", SinumerikFlow(dice, world, {"BENCH", false, {"SECOND", "THIRD"}}).program()},
                         {"SECOND.SPF", SinumerikFlow(dice, world, {"SECOND", true, {"THIRD"}}).program()},
                         {"THIRD.SPF", SinumerikFlow(dice, world, {"THIRD", true, {}}).program()},
                         {"UGUD.DEF", "DEF CHAN REAL PLACES[3]=(5,3,1)\nM17\n"}};
    const JobFolder folder("probewright-job-s"), other("probewright-job-k");
    put(folder, files);
    const auto there = converted(folder, files, ProgramLanguage::Klartext, ".H");
    if (!there) continue;
    ++compared;
    put(other, *there);
    const Twin original = runFile(folder / "BENCH.MPF", files, ProgramLanguage::Sinumerik, world.part);
    const Twin twin = runFile(other / "BENCH.H", *there, ProgramLanguage::Klartext, world.part);
    ASSERT_TRUE(runsTheSame(original, twin));
  }
  EXPECT_EQ(compared, programs) << "too many jobs are named, too few compared";
}

/// Converts the job and runs both: the touches, each in the unit of its own program, are the same.
void expectTheSame(const Files& files, const std::string& main, ProgramLanguage to) {
  Dice dice(11);
  const World world(dice);
  const bool fromKlartext = to == ProgramLanguage::Sinumerik;
  const JobFolder folder("probewright-job-unit"), other("probewright-job-unit-there");
  put(folder, files);
  const auto there = converted(folder, files, to, fromKlartext ? ".SPF" : ".H");
  ASSERT_TRUE(there) << "something is listed";
  put(other, *there);
  const Twin original =
      runFile(folder / main, files, fromKlartext ? ProgramLanguage::Klartext : ProgramLanguage::Sinumerik, world.part);
  const Twin twin = runFile(other / (fromKlartext ? "MAIN.SPF" : "MAIN.H"), *there, to, world.part);
  EXPECT_TRUE(original.finished) << original.why;
  EXPECT_GE(original.journal.cycles.size(), 3u);
  EXPECT_TRUE(runsTheSame(original, twin));
}

/// 427 down to the top of the part at 3 mm, or as many inches; `x`, `y`: from the part's origin in mm.
std::string downwards(const Vector3& nominal, double x, double y, double unit) {
  return fmt::format(
      "TCH PROBE 427 MEASURE ~\n  Q263={:+.6f} ~\n  Q264={:+.6f} ~\n  Q261={:+.6f} ~\n  Q320={:+.6f} ~\n  Q272=+3 ~\n  "
      "Q267=-1 ~\n  Q260={:+.6f} ~\n  Q281=+0 ~\n  Q288=+0 ~\n  Q289=+0 ~\n  Q309=+0 ~\n  Q330=+0\n",
      (nominal.x() + x) / unit, (nominal.y() + y) / unit, nominal.z() / unit, 3 / unit, (nominal.z() + 20) / unit);
}

/// G700 of a called program stays in effect after it, INCH of a called program does not.
TEST(ConvertJobs, CountEachProgramInItsOwnUnit) {
  Dice dice(11);
  const Vector3 n = World(dice).nominal();
  for (const bool mainInInches : {true, false}) {
    SCOPED_TRACE(mainInInches);
    const double own = mainInInches ? 25.4 : 1, called = mainInInches ? 1 : 25.4;
    const std::string one = mainInInches ? "INCH" : "MM", other = mainInInches ? "MM" : "INCH";
    const std::string up = fmt::format("L Z{:+.6f} R0 FMAX\n", (n.z() + 60) / own);
    expectTheSame(
        {{"MAIN.H", fmt::format("BEGIN PGM MAIN {}\nTOOL CALL 1 Z\n{}{}CALL PGM SUB\n{}{}M30\nEND PGM MAIN {}\n", one,
                                up, downwards(n, -40, -30, own), downwards(n, 30, -20, own), up, one)},
         {"SUB.H", fmt::format("BEGIN PGM SUB {}\n{}END PGM SUB {}\n", other, downwards(n, 10, -40, called), other)}},
        "MAIN.H", ProgramLanguage::Sinumerik);
  }
}

/// Several programs, of which only some count in another unit.
TEST(ConvertJobs, GoBackToTheOwnUnitAfterThoseCallsThatLeaveAnother) {
  Dice dice(11);
  const Vector3 n = World(dice).nominal();
  for (const bool mainInInches : {true, false}) {
    SCOPED_TRACE(mainInInches);
    const double own = mainInInches ? 25.4 : 1, other = mainInInches ? 1 : 25.4;
    const std::string one = mainInInches ? "INCH" : "MM", two = mainInInches ? "MM" : "INCH";
    const std::string up = fmt::format("L Z{:+.6f} R0 FMAX\n", (n.z() + 60) / own);
    const auto part = [&](const std::string& name, const std::string& unit, double size, double x) {
      return std::pair<const std::string, std::string>(
          name + ".H",
          fmt::format("BEGIN PGM {} {}\n{}END PGM {} {}\n", name, unit, downwards(n, x, -40, size), name, unit));
    };
    expectTheSame(
        {{"MAIN.H",
          fmt::format("BEGIN PGM MAIN {0}\nTOOL CALL 1 Z\n{1}CALL PGM AB\n{2}CALL PGM BC\n{3}CALL PGM CD\n{2}{1}"
                      "M30\nEND PGM MAIN {0}\n",
                      one, up, downwards(n, -40, -30, own), downwards(n, 30, -20, own))},
         part("AB", one, own, 10),
         part("BC", two, other, 12),
         part("CD", one, own, 14)},
        "MAIN.H", ProgramLanguage::Sinumerik);
  }
}

std::string downwards978(const Vector3& n, double x, double y, double unit) {
  return fmt::format("G0 X{:.6f} Y{:.6f}\nG0 Z{:.6f}\nCYCLE978(0,,,1,{:.6f},{:.6f},{:.6f},3,2,1)\nG0 Z{:.6f}\n",
                     (n.x() + x) / unit, (n.y() + y) / unit, (n.z() + 6) / unit, n.z() / unit, 5 / unit, 4 / unit,
                     (n.z() + 60) / unit);
}

/// A subprogram that selects no unit counts in that of its caller.
TEST(ConvertJobs, GiveSubprogramsTheUnitOfTheirCaller) {
  Dice dice(11);
  const Vector3 n = World(dice).nominal();
  expectTheSame(
      {{"MAIN.MPF", fmt::format("G17 G90 G700 G54\nT1\nM6 D1\nG0 Z{:.6f}\n{}SUB\n{}M30\n", (n.z() + 60) / 25.4,
                                downwards978(n, -40, -30, 25.4), downwards978(n, 30, -20, 25.4))},
       {"SUB.SPF", downwards978(n, 10, -40, 25.4) + "M17\n"}},
      "MAIN.MPF", ProgramLanguage::Klartext);
}

/// What a called program leaves to its caller and a HEIDENHAIN program does not have is named.
TEST(ConvertJobs, NameAUnitThatACalledProgramLeaves) {
  Dice dice(11);
  const Vector3 n = World(dice).nominal();
  const std::string head = fmt::format("G17 G90 G71 G54\nT1\nM6 D1\nG0 Z{:.6f}\nSUB\n", n.z() + 60);
  for (const char* after : {"", "G71\n"}) {
    const Files files = {{"MAIN.MPF", head + after + downwards978(n, 30, -20, 1) + "M30\n"},
                         {"SUB.SPF", "G700\nG0 X0.5 Y1\nM17\n"}};
    const JobFolder folder("probewright-job-unit");
    put(folder, files);
    EXPECT_EQ(converted(folder, files, ProgramLanguage::Klartext, ".H").has_value(), *after != 0);
  }
}

/// A HEIDENHAIN control gives results of cycles in the unit of the main program, a SINUMERIK in that of the program.
TEST(ConvertJobs, NameResultsThatCountInTheUnitOfTheMainProgram) {
  Dice dice(11);
  const Vector3 n = World(dice).nominal();
  for (const bool mixed : {true, false}) {
    // Cycle 0 puts its result into a parameter that it names.
    const std::string touch = fmt::format("TCH PROBE 0.0 REF. PLANE Q5 Z-\nTCH PROBE 0.1 X{:+.3f} Y{:+.3f} Z{:+.3f}\n",
                                          n.x() + 10, n.y() - 40, n.z());
    for (const std::string& more : {std::string("Q2 = Q160\n"), std::string(), touch}) {
      const bool reads = !more.empty();
      SCOPED_TRACE(fmt::format("mixed {} {}", mixed, more));
      const double unit = mixed ? 25.4 : 1;
      const std::string main = mixed ? "INCH" : "MM";
      const Files klartext = {
          {"MAIN.H", fmt::format("BEGIN PGM MAIN {}\nTOOL CALL 1 Z\nL Z{:+.6f} R0 FMAX\nCALL PGM SUB\nM30\nEND PGM "
                                 "MAIN {}\n",
                                 main, (n.z() + 60) / unit, main)},
          {"SUB.H", fmt::format("BEGIN PGM SUB MM\n{}{}L Z{:+.6f} R0 FMAX\nEND PGM SUB MM\n", downwards(n, 10, -40, 1),
                                more, n.z() + 60)}};
      const JobFolder folder("probewright-job-results");
      put(folder, klartext);
      EXPECT_EQ(converted(folder, klartext, ProgramLanguage::Sinumerik, ".SPF").has_value(), !mixed || !reads);
    }
    const Files sinumerik = {
        {"MAIN.MPF", fmt::format("G17 G90 {} G54\nT1\nM6 D1\nG0 Z{:.6f}\nSUB\n{}\nM30\n", mixed ? "G700" : "G710",
                                 (n.z() + 60) / (mixed ? 25.4 : 1), mixed ? "G700" : "G710")},
        {"SUB.SPF", "G710\n" + downwards978(n, 10, -40, 1) + "M17\n"}};
    const JobFolder folder("probewright-job-answers");
    put(folder, sinumerik);
    EXPECT_EQ(converted(folder, sinumerik, ProgramLanguage::Klartext, ".H").has_value(), !mixed);
  }
}

/// Parameters of several programs keep their values while cycles run that fill Q150 and on, in all programs alike.
TEST(ConvertJobs, KeepSharedParametersThatCyclesWouldOverwrite) {
  Dice dice(11);
  const Vector3 n = World(dice).nominal();
  const std::string remark = "; R500 AND ON: Q100 AND ON, R2400 AND ON: QR0 AND ON\n";
  std::string main = fmt::format("{}G17 G90 G71 G54\nT1\nM6 D1\nG0 Z{:.6f}\n", remark, n.z() + 60);
  std::string places;
  double x = -40;
  // Q100, Q150 and on, those of 427, _OVR[4] and a helper of the converter; Q1199, Q1600 and QR0 belong to nobody.
  for (const int parameter : {500, 550, 560, 580, 599, 660, 661, 667, 2104, 2300, 1599, 2000, 2400}) {
    main += fmt::format("R{}={:.6f}\n", parameter, n.x() + x);
    places += fmt::format("G0 X=R{} Y{:.6f}\nG0 Z{:.6f}\nCYCLE978(0,,,1,{:.6f},5,4,3,2,1)\nR3=_OVR[4]\nG0 Z{:.6f}\n",
                          parameter, n.y() - 30, n.z() + 6, n.z(), n.z() + 60);
    x += 4;
  }
  const std::string sub = remark + downwards978(n, 30, -20, 1) + "R1=R560+_OVR[4]\n" + places + "M17\n";
  expectTheSame({{"MAIN.MPF", main + "SUB\n" + places + "M30\n"}, {"SUB.SPF", sub}}, "MAIN.MPF",
                ProgramLanguage::Klartext);
  // What would share a parameter with another one is listed.
  for (const int parameter : {100, 499, 1600, 1999, 2900}) {
    const Files files = {{"MAIN.MPF", fmt::format("{}G17 G90 G71\nR{}=1\nSUB\nM30\n", remark, parameter)},
                         {"SUB.SPF", "M17\n"}};
    const JobFolder folder("probewright-job-taken");
    put(folder, files);
    EXPECT_FALSE(converted(folder, files, ProgramLanguage::Klartext, ".H").has_value()) << parameter;
  }
  const conversion::Conversion refused = toKlartext(remark + "G17 G90 G71\nR100=1\nM30\n");
  ASSERT_EQ(refused.notCarriedOver.size(), 1U) << refused.text;
  EXPECT_EQ(refused.notCarriedOver[0].advice, "take another one: R0 to R99, R500 to R1599 or R2000 to R2899");
}

/// The circle centre and the direction of arcs that a called program has set stay in effect in its caller.
TEST(ConvertJobs, NameArcsAfterAProgramThatSetsTheirCentre) {
  const std::string head = "0 BEGIN PGM MAIN MM\nTOOL CALL 1 Z\nL X+0 Y+0 Z+100 R0 FMAX\nCC X+5 Y+5\n";
  const std::string arc = "CC X+5 Y+0\nC X+0 Y+0 DR- F500\n";
  const auto isNamed = [&](const std::string& after, const std::string& sub) {
    const Files files = {{"MAIN.H", head + "C X+10 Y+0 DR+ F500\nCALL PGM SUB\n" + after + "9 END PGM MAIN MM\n"},
                         {"SUB.H", "0 BEGIN PGM SUB MM\n" + sub + "9 END PGM SUB MM\n"}};
    const JobFolder folder("probewright-job-centre");
    put(folder, files);
    return !converted(folder, files, ProgramLanguage::Sinumerik, ".SPF").has_value();
  };
  EXPECT_TRUE(isNamed("C X+10 Y+0 DR+ F500\n", arc));
  EXPECT_TRUE(isNamed("LP PR+10 PA+30 F500\n", arc));
  EXPECT_FALSE(isNamed("CC X+5 Y+5\nC X+10 Y+0 DR+ F500\n", arc));
  EXPECT_FALSE(isNamed("C X+10 Y+0 DR+ F500\n", "L X+20 R0 F500\nL X+10\n"));
  EXPECT_TRUE(isNamed("CC X+5 Y+5\nC X+10 Y+0 F500\n", arc));
}

/// Arguments: numbers and expressions, left out ones, types that round, and those by reference, nested and returned
/// early.
TEST(ConvertJobs, HandArgumentsOver) {
  Dice dice(11);
  const Vector3 n = World(dice).nominal();
  const std::string touch =
      fmt::format("G0 X=XX+{:.6f} Y=YY+{:.6f}\nG0 Z{:.6f}\nCYCLE978(0,,,1,{:.6f},5,4,3,2,1)\nG0 Z{:.6f}\n", n.x(),
                  n.y(), n.z() + 6, n.z(), n.z() + 60);
  const std::string main = "DEF INT COUNT=2\nDEF REAL LAST\nDEF BOOL FOUND=1\nDEF STRING[20] SAID=\"NO\"\n" +
                           fmt::format("G17 G90 G710 G54\nT1\nM6 D1\nG0 Z{:.6f}\nR1=10\n", n.z() + 60) +
                           "TOUCH(-40,-30,COUNT,LAST,,\"YES\")\nG0 X=COUNT*3 Y=LAST\n"
                           "TOUCH(R1+COUNT,SIN(30)*-40,R1,R2)\nG0 X=R1 Y=R2\n"
                           "TOUCH(,-25.5,R1,R2,1)\n"
                           "IF FOUND\nTOUCH(-R1,-20,COUNT,R1,FOUND,SAID)\nENDIF\nG0 X=COUNT*3 Y=R1\n"
                           "IF SAID==\"YES\"\nTOUCH(1,1,COUNT,R3,0)\nENDIF\nG0 X=R3\nM30\n";
  const std::string sub =
      "PROC TOUCH(REAL XX=30,REAL YY,VAR INT NN,VAR REAL LEFT,BOOL DEEP=0,STRING[20] TEXT=\"\")\n" + touch +
      "NN=NN+1.6\nLEFT=XX*2\nIF DEEP\nRET\nENDIF\nIF TEXT==\"YES\"\nINNER(YY,NN,2.5)\nENDIF\nLEFT=LEFT+NN\nM17\n";
  const std::string inner =
      "PROC INNER(REAL YY,VAR INT NN,INT WHOLE)\nDEF REAL XX\nXX=WHOLE*5\n" + touch + "NN=NN+WHOLE\nRET\n";
  expectTheSame({{"MAIN.MPF", main}, {"TOUCH.SPF", sub}, {"INNER.SPF", inner}}, "MAIN.MPF", ProgramLanguage::Klartext);
  for (const char* lost : {"PROC SUB(REAL PLACES[3])\n", "PROC SUB(AXIS WAY)\n", "PROC SUB(VAR REAL PLACE,FRAME FF)\n",
                           "PROC SUB(CHAR LETTER)\n"}) {
    const JobFolder folder("probewright-job-arguments");
    put(folder, {{"MAIN.MPF", "G17 G90 G710 G54\nSUB\nM30\n"}, {"SUB.SPF", std::string(lost) + "G0 X1\nM17\n"}});
    EXPECT_FALSE(converted(folder, {{"SUB.SPF", std::string(lost) + "G0 X1\nM17\n"}}, ProgramLanguage::Klartext, ".H"))
        << lost;
  }
}

/// RET in the middle of a subprogram.
TEST(ConvertJobs, ReturnEarly) {
  Dice dice(11);
  const Vector3 n = World(dice).nominal();
  const std::string sub =
      "IF R1>1\n" + downwards978(n, 30, -20, 1) + "RET\nENDIF\nR1=R1+1\n" + downwards978(n, -40, -30, 1) + "M17\n";
  expectTheSame({{"MAIN.MPF", fmt::format("G17 G90 G71 G54\nT1\nM6 D1\nG0 Z{:.6f}\nR1=0\nSUB\nSUB\nSUB\nSUB\n{}M30\n",
                                          n.z() + 60, downwards978(n, 10, -40, 1))},
                 {"SUB.SPF", sub}},
                "MAIN.MPF", ProgramLanguage::Klartext);
}

}  // namespace
}  // namespace probewright::testing_support
