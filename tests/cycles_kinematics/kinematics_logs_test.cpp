#include <gmock/gmock.h>

#include "cycles_kinematics/sphere_worlds.hpp"

/// The logs of cycles 450 to 453: what the manuals list of them, in that order, on both controls.
namespace probewright::testing_support {
namespace {

/// Each text after the one before it.
void expectInOrder(const std::string& log, const std::vector<std::string>& texts) {
  std::size_t at = 0;
  for (const std::string& text : texts) {
    const std::size_t found = log.find(text, at);
    ASSERT_NE(found, log.npos) << "\"" << text << "\" is missing, or comes too early in\n" << log;
    at = found + text.size();
  }
}

std::string withoutMode(std::string cycle) {
  for (const std::string word : {" ~\n  Q406=", " ~\n  Q431="}) {
    const std::size_t begin = cycle.find(word), end = cycle.find(" ~", begin + 4);
    cycle.erase(begin, end - begin);
  }
  return cycle;
}

struct Logged {
  explicit Logged(ControlKind kind, Dice& dice) : world(builds()[1], kind) {
    world.plant(dice, 0.1, 0.01);
    world.bench.program = "LOGGED.H";
  }
  std::string log(const std::string& blocks, const std::string& file) {
    const Ran ran = world.bench.run(blocks);
    EXPECT_TRUE(ended(ran)) << ran.why();
    return ran.log(file);
  }
  SphereWorld world;
};

const std::vector<std::string> ofEachAxis = {"Start angle",
                                             "End angle",
                                             "Angle of incidence",
                                             "Number of measuring points",
                                             "Scatter (standard deviation)",
                                             "Maximum error",
                                             "Angular error",
                                             "Averaged backlash",
                                             "Averaged positioning error",
                                             "Measuring circle radius"};

std::vector<std::string> joined(std::initializer_list<std::vector<std::string>> parts) {
  std::vector<std::string> all;
  for (const auto& part : parts)
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

TEST(KinematicsLogs, Of451And452OnTheNewerControl) {
  Dice dice(4590);
  Logged logged(ControlKind::TNC640, dice);
  const std::vector<std::string> head = {"1970", "LOGGED.H", "tool 1"},
                                 common = {"<td>Kinematics</td><td>BC</td>", "Sphere radius</td><td>12.5000"},
                                 shift = {"Preset shift"},
                                 places = {"<td>B</td><td>Before", "<td>B</td><td>After", "<td>C</td><td>Before",
                                           "<td>C</td><td>After"};
  for (int mode = 0; mode <= 2; ++mode) {
    expectInOrder(
        logged.log(probe(451, words451(logged.world.build, mode)), "TCHPR451.html"),
        joined({head, {fmt::format("<td>Mode</td><td>{}:", mode)}, common, ofEachAxis, ofEachAxis, shift, places}));
  }
  const std::string compensated = logged.log(withoutMode(probe(452, words451(logged.world.build, 1))), "TCHPR452.html");
  const std::vector<std::string> uncertain = {"Measurement uncertainty"};
  expectInOrder(compensated, joined({head, common, ofEachAxis, uncertain, ofEachAxis, uncertain, shift, places}));
  EXPECT_EQ(compensated.find("<td>Mode"), compensated.npos) << "452 has no modes";
}

TEST(KinematicsLogs, Of451And452OnTheOlderControl) {
  Dice dice(4591);
  Logged logged(ControlKind::iTNC530, dice);
  const std::vector<std::string> quality = {"Valuation of the measuring points", "Measurement uncertainty"};
  for (int mode = 0; mode <= 2; ++mode) {
    const std::string log = logged.log(probe(451, words451(logged.world.build, mode)), "TCHPR451.TXT");
    expectInOrder(
        log, joined({{"1970", "LOGGED.H", "Mode", fmt::format("{}:", mode), "Kinematics", "Sphere radius", "12.5000"},
                     ofEachAxis,
                     quality,
                     ofEachAxis,
                     quality,
                     {"Preset shift"}}));
    EXPECT_EQ(log.find("Before"), log.npos) << "positions are in the log of the newer control";
  }
  const std::string log = logged.log(withoutMode(probe(452, words451(logged.world.build, 1))), "TCHPR452.TXT");
  expectInOrder(
      log,
      joined(
          {{"LOGGED.H", "Kinematics", "Sphere radius"}, ofEachAxis, quality, ofEachAxis, quality, {"Preset shift"}}));
}

/// The angular error is told where the directions were found.
TEST(KinematicsLogs, TellAnAngularErrorOfModes2And3Only) {
  Dice dice(4592);
  Logged logged(ControlKind::TNC640, dice);
  const auto told = [&](int mode) {
    const std::string log = logged.log(probe(451, words451(logged.world.build, mode)), "TCHPR451.html");
    return log.find("<td>Angular error</td><td>-</td>") == log.npos;
  };
  EXPECT_FALSE(told(1));
  EXPECT_TRUE(told(2));
}

std::string cycle450(int mode, const std::string& record) {
  return fmt::format("TCH PROBE 450 SAVE ~\n  Q410={} ;MODE ~\n  {} ;RECORD\n", mode, record);
}

TEST(KinematicsLogs, Of450) {
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    Dice dice(4593);
    Logged logged(kind, dice);
    const bool newer = kind == ControlKind::TNC640;
    const std::string file = newer ? "TCHPRAUTO.html" : "TCHPR450.TXT";
    if (!newer) logged.world.bench.setup.beliefs.parameters["codeNumber"] = {4711.0, {}};
    const std::vector<std::string> when = {"1970", "LOGGED.H"};
    std::vector<std::string> tool, code;
    if (newer) {
      tool.emplace_back("tool 1");
    } else {
      code = {"Code number", "4711"};
    }
    const std::string save = cycle450(0, "Q409=7");
    expectInOrder(logged.log(save, file),
                  joined({when, tool, {"Mode", "0:", "Record", "7", "Kinematics", "BC"}, code, {"TRANS", "TRANS"}}));
    expectInOrder(logged.log(save + cycle450(1, "Q409=7"), file),
                  {"0:", "1:", "Record", "7", "Kinematics", "Before", "After", "TRANS"});
    const auto listed = newer ? std::vector<std::string>{"2:", "Record", "7", "BC", "1970"}
                              : std::vector<std::string>{"2:", "7", "4711", "BC", "1970"};
    expectInOrder(logged.log(save + cycle450(2, "Q409=0"), file), listed);
    if (newer) {
      expectInOrder(logged.log(save + cycle450(3, "Q409=7"), file), {"3:", "Saved on", "7", "BC", "1970"});
    }
  }
}

TEST(KinematicsLogs, Of453) {
  Dice dice(4594);
  Logged logged(ControlKind::TNC640, dice);
  const TableFolder folder(logged.world.bench);
  folder.put("GRID.KCO",
             "BEGIN GRID.KCO MM\n"
             "NR    B         DX           DY           DZ\n"
             "0     -45       0            0            0\n"
             "1     45        0            0            0\n"
             "[END]\n");
  const auto blocks = [](int mode) {
    return probe(453, {{406, mode}, {407, 12.5}, {320, 0}, {408, 0}, {253, 5000}, {380, 45}, {423, 4}, {431, 0}});
  };
  for (const int mode : {0, 1}) {
    expectInOrder(
        logged.log(blocks(mode), "TCHPR453.html"),
        {"1970", "LOGGED.H", "tool 1", fmt::format("<td>{}:", mode), "Standard deviation", "Maximum deviation",
         "Position of the maximum deviation", "B ", "45.0000", "Number of measuring positions</td><td>2"});
  }
  const std::string cleared = logged.log(blocks(-1), "TCHPR453.html");
  expectInOrder(cleared, {"1970", "LOGGED.H", "tool 1", "<td>-1:"});
  EXPECT_EQ(cleared.find("deviation</td>"), cleared.npos) << "there are no results";
}

}  // namespace
}  // namespace probewright::testing_support
