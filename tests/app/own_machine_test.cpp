#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "app/program.hpp"

/// `probewright machine`, and the page of the documents that builds a machine with it.
namespace probewright::app::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string page = textOf(std::string(PROBEWRIGHT_SOURCE_DIR) + "/docs/own-machine.md");

/// The blocks of code of a kind up to a heading, one after the other.
std::string blocks(const std::string& kind, const std::string& upTo) {
  std::string text;
  std::istringstream stream(page.substr(0, page.find(upTo)));
  bool within = false;
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("```")) {
      within = !within && line == "```" + kind;
      continue;
    }
    if (within) text += line + "\n";
  }
  return text;
}

/// The block of code that begins with this line, without it.
std::string shownAfter(const std::string& line) {
  const std::size_t begin = page.find(line + "\n");
  if (begin == std::string::npos) return "no block " + line;
  const std::size_t from = begin + line.size() + 1;
  return page.substr(from, page.find("```", from) - from);
}

class OwnMachine : public ::testing::Test {
protected:
  Answer machine(const std::string& text, std::vector<std::string> more = {}) const {
    std::vector<std::string> words = {"machine", folder.file("workshop.toml", text), "--out",
                                      (folder / "machine.html").string()};
    words.insert(words.end(), more.begin(), more.end());
    Answer answer = probewright(words);
    for (std::string* each : {&answer.output, &answer.errors}) {
      for (std::size_t at; (at = each->find((folder / "").string())) != std::string::npos;)
        each->erase(at, (folder / "").string().size());
    }
    return answer;
  }
  Folder folder;
};

TEST_F(OwnMachine, OfTheDocumentsIsReadAsShown) {
  const Answer answer = machine(blocks("toml", "## 5."));
  EXPECT_EQ(answer.exit, 0) << answer.errors;
  EXPECT_EQ(answer.errors, "");
  EXPECT_EQ(answer.output, shownAfter("$ probewright machine workshop.toml"));
  EXPECT_THAT(textOf(folder / "machine.html"), HasSubstr("Workshop trunnion"));
}

TEST_F(OwnMachine, OfTheDocumentsHasTheBodiesShown) {
  const std::string text = blocks("toml", "## 7.");
  const Answer answer = machine(text);
  EXPECT_EQ(answer.exit, 0) << answer.errors;
  EXPECT_THAT(answer.output, HasSubstr("bodies     table (C), trunnion (A), spindle nose (Z)"));
  // And it runs.
  const Answer run =
      probewright({"run", folder.file("p.h", "0 BEGIN PGM P MM\n1 L A+40 C+30 R0 FMAX M91\n2 END PGM P MM\n"),
                   "--setup", folder.file("s.toml", blocks("toml", "\nin a setup, or").substr(text.size())), "--out",
                   (folder / "out").string(), "--control", "TNC640"});
  EXPECT_EQ(run.exit, 0) << run.errors;
}

TEST_F(OwnMachine, TurningTheWrongWayIsNamedAsShown) {
  std::string text = blocks("toml", "## 5.");
  const std::string right = "axis = \"C\"\ndirection = [0, 0, -1]";
  ASSERT_NE(text.find(right), std::string::npos);
  text.replace(text.find(right), right.size(), "axis = \"C\"\ndirection = [0, 0, 1]");
  const Answer answer = machine(text);
  EXPECT_EQ(answer.exit, 0);
  const std::size_t begin = page.find("workshop.toml: warning: ");
  ASSERT_NE(begin, std::string::npos);
  EXPECT_THAT(answer.errors, HasSubstr(page.substr(begin, page.find('\n', begin) - begin)));
  EXPECT_THAT(answer.output, HasSubstr("tool turns about -Z, workpiece +Z"));
}

TEST_F(OwnMachine, MistakesHaveTheirPlaces) {
  const std::string text = blocks("toml", "## 7.");
  const auto wrong = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    EXPECT_NE(changed.find(from), std::string::npos) << from;
    changed.replace(changed.find(from), from.size(), to);
    const Answer answer = machine(changed);
    EXPECT_EQ(answer.exit, 2);
    EXPECT_EQ(answer.output, "");
    return answer.errors;
  };
  EXPECT_THAT(wrong("axis = \"A\"\ndirection", "axis = \"B\"\ndirection"),
              AllOf(HasSubstr("workshop.toml:"), HasSubstr("error: there is no axis called B"),
                    HasSubstr("axis A moves nothing")));
  EXPECT_THAT(wrong("direction = [-1, 0, 0]", "direction = [0, 0, 0]"), HasSubstr("a direction cannot be [0, 0, 0]"));
  EXPECT_THAT(wrong("link = \"A\"", "link = \"Q\""), HasSubstr("error: there is no axis called Q"));
  EXPECT_THAT(wrong("minimum = -30\n", "minimum = 130\n"), HasSubstr("the travel of axis A ends before it begins"));
  EXPECT_THAT(wrong("shape = \"cylinder\"\n", "shape = \"cylindre\"\n"), HasSubstr("workshop.toml:"));
}

TEST_F(OwnMachine, BodiesThatTouchAreNamed) {
  std::string text = blocks("toml", "## 7.");
  const std::string nose = "diameter = 70\nheight = 120";
  ASSERT_NE(text.find(nose), std::string::npos);
  // It reaches down to the table where tools are changed.
  text.insert(text.find(nose), "centre = [0, 0, -400]\n");
  const Answer answer = machine(text);
  EXPECT_EQ(answer.exit, 0);
  EXPECT_THAT(answer.errors, HasSubstr("warning: where the machine starts the machine's \"spindle nose\" touched"));
}

/// A part that nobody has placed lies at the spindle nose.
TEST_F(OwnMachine, PartUnderTheSpindleStopsNoRun) {
  const std::string setup = "[part]\n[[part.feature]]\nshape = \"box\"\nsize = [50, 50, 30]\n";
  const Answer run = probewright({"run", folder.file("p.h", "0 BEGIN PGM P MM\n1 FN 0: Q1 = +1\n2 END PGM P MM\n"),
                                  "--setup", folder.file("s.toml", setup), "--out", (folder / "out").string()});
  EXPECT_EQ(run.exit, 0) << run.errors;
  EXPECT_THAT(run.errors, HasSubstr("warning: where the machine starts the machine's"));
}

TEST_F(OwnMachine, PageReplacesOnlyPages) {
  const std::string text = blocks("toml", "## 5.");
  folder.file("machine.html", "my own page");
  const Answer refused = machine(text);
  EXPECT_EQ(refused.exit, 2);
  EXPECT_THAT(refused.errors, HasSubstr("not the page of a machine"));
  EXPECT_EQ(textOf(folder / "machine.html"), "my own page");
  EXPECT_EQ(machine(text, {"--force"}).exit, 0);
  EXPECT_EQ(machine(text).exit, 0) << "its own page";
  EXPECT_THAT(textOf(folder / "machine.html"), Not(HasSubstr("my own page")));
}

TEST_F(OwnMachine, MayBeReadyMadeOrOfLinuxCnc) {
  const std::string out = (folder / "m.html").string();
  const Answer ready = probewright({"machine", "mill5-head-table", "--out", out});
  EXPECT_EQ(ready.exit, 0);
  EXPECT_THAT(ready.output, HasSubstr("tool turns about +Y"));
  const std::string ini =
      "[EMC]\nMACHINE = shop mill\n[KINS]\nKINEMATICS = trivkins coordinates=XYZ\n"
      "[JOINT_0]\nMIN_LIMIT = -100\nMAX_LIMIT = 100\nMAX_VELOCITY = 50\nMAX_ACCELERATION = 500\n"
      "[JOINT_1]\nMIN_LIMIT = -100\nMAX_LIMIT = 100\nMAX_VELOCITY = 50\nMAX_ACCELERATION = 500\n"
      "[JOINT_2]\nMIN_LIMIT = -300\nMAX_LIMIT = 0\nMAX_VELOCITY = 50\nMAX_ACCELERATION = 500\n";
  const Answer shop = probewright({"machine", folder.file("shop.ini", ini), "--out", out});
  EXPECT_EQ(shop.exit, 0) << shop.errors;
  EXPECT_THAT(shop.output, AllOf(HasSubstr("-100 to 100 mm"), HasSubstr("bodies     none")));
  const Answer none = probewright({"machine", "mill4", "--out", out});
  EXPECT_EQ(none.exit, 2);
  EXPECT_THAT(none.errors, HasSubstr("there is neither a ready-made machine nor a file called \"mill4\""));
}

TEST_F(OwnMachine, OfASetupIsDrawnWithWhatLiesOnIt) {
  const std::string out = (folder / "m.html").string();
  const std::string setup =
      "[machine]\nname = \"mill5-head-table\"\n[[machine.body]]\nname = \"lamp\"\nlink = \"Z\"\n"
      "[[machine.body.feature]]\nshape = \"sphere\"\ndiameter = 40\ncentre = [0, 400, 700]\n"
      "[part]\nname = \"flange\"\npose = { z = -700 }\n[[part.feature]]\nshape = \"cylinder\"\n"
      "diameter = 90\nheight = 30\n";
  const Answer answer = probewright({"machine", folder.file("s.toml", setup), "--out", out});
  EXPECT_EQ(answer.exit, 0) << answer.errors;
  EXPECT_THAT(answer.output, AllOf(HasSubstr("flange (C), table (C)"), HasSubstr("lamp (Z)")));
  EXPECT_THAT(textOf(out), HasSubstr("\"name\":\"flange\""));
  const Answer wrong = probewright({"machine", folder.file("w.toml", setup + "[fixtur]\n"), "--out", out});
  EXPECT_EQ(wrong.exit, 2);
  EXPECT_THAT(wrong.errors, HasSubstr("unknown key \"fixtur\""));
}

/// The same run on the same machine without its bodies: nothing that is measured may change.
TEST_F(OwnMachine, BodiesChangeNothingWhereNothingIsHit) {
  const std::string source = PROBEWRIGHT_SOURCE_DIR;
  for (const auto& [program, setup, machine] :
       {std::tuple("kinematics.h", "kinematics-tnc640.toml", "mill5-table-table"),
        {"housing.mpf", "housing-840dsl.toml", "mill3"},
        {"shaft.mpf", "shaft-lathe.toml", "lathe2c"}}) {
    std::string bare = textOf(source + "/machines/" + machine + ".toml");
    bare = bare.substr(0, bare.find("[[body]]"));
    const auto run = [&](const std::string& out, std::vector<std::string> more) {
      std::vector<std::string> words = {"run",     source + "/examples/programs/" + program,
                                        "--setup", source + "/examples/setups/" + setup,
                                        "--out",   (folder / out).string()};
      words.insert(words.end(), more.begin(), more.end());
      return probewright(words);
    };
    const Answer with = run("with", {});
    const Answer without = run("without", {"--machine-ini", folder.file("bare.toml", bare)});
    EXPECT_EQ(with.exit, without.exit) << with.errors;
    EXPECT_EQ(with.errors, without.errors);
    int compared = 0;
    for (const std::string& name : namesIn(folder / "with")) {
      if (name.ends_with(".html") || name.ends_with(".json") || name.ends_with(".KD")) continue;  // they hold times
      EXPECT_EQ(textOf(folder / "with" / name), textOf(folder / "without" / name)) << program << " " << name;
      ++compared;
    }
    EXPECT_GE(compared, 2) << program;
  }
}

}  // namespace
}  // namespace probewright::app::testing
