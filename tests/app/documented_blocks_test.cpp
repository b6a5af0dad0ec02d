#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "app/documents.hpp"
#include "app/program.hpp"

/// Each block of code of the documents does what the page says: setups and machines are read, commands run and print
/// what is shown, lines for LinuxCNC are those that it is started with.
namespace probewright::app::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

const fs::path source = PROBEWRIGHT_SOURCE_DIR;

std::vector<CodeBlock> blocksOf(const std::string& kind) {
  std::vector<CodeBlock> blocks = codeBlocks();
  std::erase_if(blocks, [&](const CodeBlock& block) { return block.kind != kind; });
  return blocks;
}

std::string placeOf(const CodeBlock& block) { return block.page + ":" + std::to_string(block.line); }

/// A folder with everything that the setups of the documents name.
void furnish(const Folder& folder) {
  for (const char* part : {"housing.step", "chip-guard.step"})
    fs::copy_file(source / "examples/parts/housing.step", folder / part);
  for (const char* file : {"set-up.h", "set-up.toml", "inspect.h", "inspect.toml"})
    fs::copy_file(source / "examples/cookbook" / file, folder / file);
  fs::create_directory(folder / "measured");
  folder.file("shop.ini", textOf(source / "examples/linuxcnc/mill3/mill3.ini"));
  folder.file("empty.h", "0 BEGIN PGM EMPTY MM\n1 END PGM EMPTY MM\n");
}

TEST(DocumentedBlocks, SetupsMachinesAndProjectsAreTaken) {
  int setups = 0, machines = 0, projects = 0;
  for (const CodeBlock& block : blocksOf("toml")) {
    // Those of own-machine.md are one machine in parts: OwnMachine.* puts it together.
    if (block.page == "own-machine.md") continue;
    SCOPED_TRACE(placeOf(block) + "\n" + block.text);
    const Folder folder;
    furnish(folder);
    Answer answer;
    if (block.text.find("[[run]]") != std::string::npos) {
      // The second program has the setup of its recipe beside it in the example.
      answer = probewright({"project", folder.file("project.toml", block.text), "--out", (folder / "out").string()});
      ++projects;
    } else if (block.text.find("[[axis]]") != std::string::npos) {
      answer = probewright({"machine", folder.file("machine.toml", block.text), "--out", (folder / "m.html").string()});
      EXPECT_THAT(answer.output, HasSubstr("2-axis stand"));
      ++machines;
    } else {
      std::vector<std::string> words = {"run",     (folder / "empty.h").string(),
                                        "--setup", folder.file("setup.toml", block.text),
                                        "--out",   (folder / "out").string()};
      if (block.text.find("[control]") == std::string::npos)
        words.insert(words.end(), {"--control", block.text.find("MP6") == std::string::npos ? "TNC640" : "iTNC530"});
      answer = probewright(words);
      ++setups;
    }
    EXPECT_LE(answer.exit, 1) << answer.output << answer.errors;
    EXPECT_THAT(answer.errors, Not(HasSubstr("error")));
  }
  EXPECT_GE(setups, 5);
  EXPECT_EQ(machines, 1);
  EXPECT_EQ(projects, 1);
}

/// The commands of a block, each with the lines that the page shows of its output.
struct Command {
  std::string words, shown;
};

std::vector<Command> commandsOf(const std::string& block) {
  std::vector<Command> commands;
  std::istringstream stream(std::regex_replace(block, std::regex(R"(\\\n\s*)"), " "));
  const bool prompts = block.starts_with("$ ");
  for (std::string line; std::getline(stream, line);) {
    if (!prompts || line.starts_with("$ "))
      commands.push_back({line.substr(prompts ? 2 : 0), ""});
    else
      commands.back().shown += line + "\n";
  }
  return commands;
}

/// Dates and times of day are those of the run.
std::string withoutDates(std::string text) {
  for (const char* date : {R"(\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d)", R"(\d\d\.\d\d\.\d{4}/\d\d:\d\d:\d\d)",
                           R"(DATE=\d{4}/\d\d/\d\d)", R"(TIME=\d\d:\d\d:\d\d)", R"(\r)"})
    text = std::regex_replace(text, std::regex(date), *date == '\\' && date[1] == 'r' ? "" : "<date>");
  return text;
}

TEST(DocumentedBlocks, CommandsThatReadResultsPrintWhatIsShown) {
  const Folder folder;
  const Answer run = probewright({"run", "examples/first/plate.h", "--setup", "examples/first/plate.toml", "--out",
                                  (folder / "plate").string(), "--export", "csv,xlsx,qif,dfq,dmis,junit"});
  ASSERT_EQ(run.exit, 1) << run.errors;
  fs::create_directory(folder / "out");
  fs::rename(folder / "plate", folder / "out/plate");
  int compared = 0;
  for (const CodeBlock& block : blocksOf("sh")) {
    if (block.page != "exchange.md" && block.page != "results.md") continue;
    for (const Command& command : commandsOf(block.text)) {
      SCOPED_TRACE(placeOf(block) + "\n" + command.words);
      if (command.words.starts_with("probewright run examples/first/plate.h")) continue;  // what has been run above
      folder.file("command.sh", "cd '" + (folder / "").string() + "' && " + command.words + "\n");
      const std::string line =
          "sh '" + (folder / "command.sh").string() + "' > '" + (folder / "printed").string() + "' 2>&1";
      EXPECT_EQ(std::system(line.c_str()), 0);
      EXPECT_EQ(withoutDates(textOf(folder / "printed")), withoutDates(command.shown));
      ++compared;
    }
  }
  EXPECT_GE(compared, 10);
}

/// Commands on files that the pages only name, run on files of the examples; those of a LinuxCNC that moves are run by
/// the suites of LinuxCNC with these words.
TEST(DocumentedBlocks, CommandsOnFilesOfTheReaderRunOnExamples) {
  const std::map<std::string, std::string> standIns = {
      {"bore.h", "examples/linuxcnc/mill3/bore.h"},
      {"housing.h", "examples/first/plate.h"},
      {"housing.toml", "examples/first/plate.toml"},
      {"~/linuxcnc/configs/shop/shop.ini", "examples/linuxcnc/mill3/mill3.ini"}};
  const std::string started = textOf(source / "tests/linuxcnc_simulator/examples_test.cpp");
  const std::string outside =
      textOf(source / "tests/linuxcnc/adapter_test.cpp") + textOf(source / "tests/support/linuxcnc_session.hpp");
  int ran = 0, elsewhere = 0;
  for (const CodeBlock& block : blocksOf("sh")) {
    if (block.page == "exchange.md" || block.page == "results.md") continue;
    for (const Command& command : commandsOf(block.text)) {
      SCOPED_TRACE(placeOf(block) + "\n" + command.words);
      const std::string text = std::regex_replace(command.words, std::regex(R"(\s*(#.*)?$)"), "");
      std::istringstream stream(text);
      std::vector<std::string> words{std::istream_iterator<std::string>(stream), {}};
      ASSERT_FALSE(words.empty());
      if (words[0] == "...") continue;
      if (words[0].starts_with("./") || words[0].starts_with(".ci/") || words[0].starts_with("scripts/")) {
        const auto permissions = fs::status(source / words[0]).permissions();
        EXPECT_NE(permissions & fs::perms::owner_exec, fs::perms::none) << "a script of the sources";
        ++elsewhere;
      } else if (words[0] == "examples/linuxcnc/start") {
        if (words.size() > 2) {
          EXPECT_THAT(started, HasSubstr("start(\"" + words[1] + " " + words[2] + "\")"));
        }
        EXPECT_TRUE(fs::exists(source / "examples/linuxcnc" / words[1]));
        ++elsewhere;
      } else if (text.find("--machine linuxcnc") != std::string::npos || words.back() == "ADAPTER") {
        EXPECT_THAT(outside, HasSubstr("--machine linuxcnc"));
        ++elsewhere;
      } else if (std::ranges::any_of(words, [](const std::string& word) { return word.starts_with("examples/"); })) {
        ++elsewhere;  // Documents.PrintCommandsThatRun
      } else {
        ASSERT_TRUE(words[0].ends_with("probewright")) << "a command that no test runs";
        const Folder folder;
        std::vector<std::string> given(words.begin() + 1, words.end());
        // The plate of the example and what a control believes of it.
        const std::string setup = folder.file(
            "setup.toml",
            std::regex_replace(textOf(source / "examples/linuxcnc/mill3/practice.toml"), std::regex("mill3.ini"),
                               (source / "examples/linuxcnc/mill3/mill3.ini").string()) +
                "[control]\ntype = \"TNC640\"\n[[preset]]\nrow = 1\norigin = [0, 0, -250]\nactive = true\n");
        for (std::string& word : given) {
          if (word == "setup.toml") word = setup;
          if (const auto found = standIns.find(word); found != standIns.end()) word = found->second;
        }
        // Of "M. Weber" in quotes the blank divides the words.
        for (std::size_t i = 0; i + 1 < given.size(); ++i) {
          if (std::ranges::count(given[i], '"') != 1) continue;
          given[i] += " " + given[i + 1];
          std::erase(given[i], '"');
          given.erase(given.begin() + static_cast<std::ptrdiff_t>(i) + 1);
        }
        given.insert(given.end(), {"--out", (folder / "out").string()});
        const Answer answer = probewright(given);
        EXPECT_LE(answer.exit, 1) << answer.errors;
        ++ran;
      }
    }
  }
  EXPECT_GE(ran, 2);
  EXPECT_GE(elsewhere, 10);
}

/// "The same by hand" of projects.md, in a folder with what the project of the cookbook names.
TEST(DocumentedBlocks, AProjectByHandMeasuresTheSame) {
  const std::string page = textOf(source / "docs/projects.md");
  std::smatch found;
  ASSERT_TRUE(std::regex_search(page, found, std::regex("The same by hand[^`]*`probewright ([^`]*)`")));
  const Folder folder;
  for (const auto& entry : fs::directory_iterator(source / "examples/cookbook"))
    fs::copy_file(entry.path(), folder / entry.path().filename().string());
  const auto run = [&](const std::string& words) {
    const std::string line = "cd '" + (folder / "").string() + "' && '" PROBEWRIGHT_PROGRAM "' " + words + " > '" +
                             (folder / "printed").string() + "' 2>&1";
    return WEXITSTATUS(std::system(line.c_str()));
  };
  ASSERT_EQ(run("project plate-project.toml --out out"), 0) << textOf(folder / "printed");
  fs::rename(folder / "out/2-inspect", folder / "by-project");
  ASSERT_EQ(run(found[1].str()), 0) << textOf(folder / "printed");
  const Answer compared =
      probewright({"compare", (folder / "by-project").string(), (folder / "out/2-inspect").string()});
  EXPECT_EQ(compared.exit, 0) << compared.output << compared.errors;
  EXPECT_EQ(textOf(folder / "by-project/TOOL.T"), textOf(folder / "out/2-inspect/TOOL.T"));
}

/// What truth.md shows of the terminal has the form of what is printed; the numbers are those of other runs.
TEST(DocumentedBlocks, TruthIsPrintedInTheFormThatIsShown) {
  const Folder folder;
  const Answer answer = probewright({"run", "examples/cookbook/set-up.h", "--setup", "examples/cookbook/set-up.toml",
                                     "--out", (folder / "out").string()});
  ASSERT_EQ(answer.exit, 0) << answer.errors;
  int lines = 0;
  for (const CodeBlock& block : blocksOf("text")) {
    if (block.page != "truth.md" || block.text.starts_with("  truth ")) continue;
    std::istringstream stream(block.text);
    for (std::string line; std::getline(stream, line); ++lines) {
      line = std::regex_replace(line, std::regex(R"([.()+*\[\]|^$])"), "\\$&");
      line = std::regex_replace(line, std::regex(R"(\\\.\\\.\\\.)"), "[^\n]*");
      line = std::regex_replace(line, std::regex(R"((\\\+|-)?[0-9]+(\\\.[0-9]+)?)"), "[-+]?[0-9]+([.][0-9]+)?");
      line = std::regex_replace(line, std::regex(" +"), " +");
      EXPECT_TRUE(std::regex_search(answer.output, std::regex("(^|\n)" + line + "(\n|$)"))) << line;
    }
  }
  EXPECT_EQ(lines, 2);
}

/// The numbers of a page are those that its command prints. Without optimisation they would take minutes.
TEST(DocumentedBlocks, StudiesPrintWhatIsShown) {
  if (!PROBEWRIGHT_OPTIMIZED) GTEST_SKIP();
  int lines = 0;
  for (const char* page : {"survive.md", "uncertainty.md"}) {
    std::string words, shown;
    for (const CodeBlock& block : codeBlocks()) {
      if (block.page != page) continue;
      if (block.kind == "sh" && words.empty()) words = commandsOf(block.text).front().words;
      if (block.kind == "text" && shown.empty()) shown = block.text;
    }
    SCOPED_TRACE(words);
    const Folder folder;
    std::istringstream stream(words.substr(words.find(' ') + 1));
    std::vector<std::string> all{std::istream_iterator<std::string>(stream), {}};
    all.insert(all.end(), {"--out", (folder / "out").string()});
    const Answer answer = probewright(all);
    EXPECT_LE(answer.exit, 1) << answer.errors;
    std::istringstream each(shown);
    for (std::string line; std::getline(each, line);) {
      if (line == "  ...") continue;
      EXPECT_THAT(answer.output, HasSubstr(line + "\n"));
      ++lines;
    }
  }
  EXPECT_GT(lines, 25);
}

/// Names of sections and keys in lines for LinuxCNC.
std::set<std::string> keysOf(const std::string& ini) {
  std::set<std::string> keys;
  std::istringstream stream(ini);
  std::string section;
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("[")) section = line;
    const std::size_t equals = line.find(" = ");
    if (equals != std::string::npos && !line.starts_with("#")) keys.insert(section + line.substr(0, equals));
  }
  return keys;
}

/// What configurations are started with in the suites of LinuxCNC.
TEST(DocumentedBlocks, LinesForLinuxCncAreThoseThatItIsStartedWith) {
  std::set<std::string> known;
  for (const char* ini : {"examples/linuxcnc/mill3/mill3.ini", "examples/linuxcnc/mill5/mill5.ini"})
    known.merge(keysOf(textOf(source / ini)));
  const std::string engine = textOf(source / "linuxcnc/interpreter/interpreter.cpp") +
                             textOf(source / "linuxcnc/feel/probewright_feel.tcl") +
                             textOf(source / "tests/linuxcnc/axis_test.cpp");
  int keys = 0;
  for (const CodeBlock& block : blocksOf("ini")) {
    SCOPED_TRACE(placeOf(block));
    if (block.text.find("ROTARY_A") != std::string::npos) continue;  // below
    for (const std::string& key : keysOf(block.text)) {
      ++keys;
      const std::string name = key.substr(key.find(']') + 1);
      EXPECT_TRUE(known.contains(key) || engine.find(name) != std::string::npos) << key;
    }
  }
  EXPECT_GE(keys, 9);
  for (const CodeBlock& block : blocksOf("hal")) {
    // Names of pins: where the line leads is what the feeling simulator of the examples drives, too.
    EXPECT_THAT(block.text, HasSubstr("=> motion.probe-input"));
    EXPECT_THAT(engine, HasSubstr("net probewright-probe probewright-feel.probe motion.probe-input"));
  }
}

TEST(DocumentedBlocks, KinematicsInAConfigurationAreThoseOfTheMachine) {
  std::string lines;
  for (const CodeBlock& block : blocksOf("ini"))
    if (block.text.find("ROTARY_A") != std::string::npos) lines = block.text;
  ASSERT_NE(lines, "");
  std::string ini = "[EMC]\nMACHINE = shop mill\n[KINS]\nKINEMATICS = trivkins coordinates=XYZA\nJOINTS = 4\n";
  for (int joint = 0; joint < 4; ++joint)
    ini += "[JOINT_" + std::to_string(joint) + "]\nTYPE = " + (joint == 3 ? "ANGULAR" : "LINEAR") +
           "\nMIN_LIMIT = -300\nMAX_LIMIT = 100\nMAX_VELOCITY = 50\nMAX_ACCELERATION = 500\n";
  const Folder folder;
  const Answer answer =
      probewright({"machine", folder.file("shop.ini", ini + lines), "--out", (folder / "m.html").string()});
  EXPECT_EQ(answer.exit, 0) << answer.errors;
  // TABLE: what carries the workpiece; right-handed about +X.
  EXPECT_THAT(answer.output, ::testing::ContainsRegex("workpiece[^\n]* A"));
  EXPECT_THAT(answer.output, ::testing::ContainsRegex("A +rotary[^\n]*workpiece \\+X"));
}

TEST(DocumentedBlocks, ExcerptsAreOfTheFilesThatTheyAreTakenFrom) {
  const auto takes = [](const CodeBlock& block, const std::string& file) {
    const std::string whole = textOf(source / file);
    std::istringstream stream(block.text);
    std::size_t from = 0;
    for (std::string line; std::getline(stream, line);) {
      if (line == "    ...") continue;
      const std::size_t at = whole.find(line, from);
      EXPECT_NE(at, std::string::npos) << placeOf(block) << " " << line;
      from = at;
    }
  };
  for (const CodeBlock& block : blocksOf("klartext"))
    takes(block, "examples/programs/housing.h");
  for (const CodeBlock& block : blocksOf("sinumerik")) {
    const Folder folder;
    const Answer answer = probewright({"check", folder.file("call.mpf", block.text + "M30\n")});
    EXPECT_EQ(answer.exit, 0) << answer.errors;
  }
  for (const CodeBlock& block : blocksOf("cpp"))
    takes(block, "src/cycles/heidenhain/cycle_412.cpp");
}

}  // namespace
}  // namespace probewright::app::testing
