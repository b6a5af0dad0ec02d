#include "sinumerik_tools/tool_bench.hpp"
#include "support/computed_call.hpp"

/// What CYCLE971 refuses, calibrating and measuring, each alarm once: nothing is written then.
namespace probewright {
namespace {

using namespace testing_support;

enum class Task { Calibrate, Complete, Standing, Turning, Edges };

struct Wrong {
  const char* what;
  const char* alarm;
  Task task;
  NamedNumbers call;
  std::string before = {};
  std::function<void(ToolBench&)> world = {};
};

/// The arguments of a call that is right.
NamedNumbers rightCall(Task task) {
  const NamedNumbers usual = {{"S_PRNUM", 1}, {"S_FA", 3}, {"S_TSA", 2}};
  switch (task) {
    case Task::Calibrate:
      return with(usual, {{"S_MVAR", 0}, {"S_MA", 1}});
    case Task::Complete:
      return with(usual, {{"S_MVAR", 100000}});
    case Task::Standing:
      return with(usual, {{"S_MVAR", 1}, {"S_MA", 1}});
    case Task::Turning:
      return with(usual, {{"S_MVAR", 2}, {"S_MA", 1}});
    case Task::Edges:
      return with(usual, {{"S_MVAR", 102}, {"S_MA", 1}});
  }
  return usual;
}

TEST(ToolRefusals, EachAlarmOfACallOnce) {
  const auto datum = [](const char* name, double value) { return [=](ToolBench& bench) { bench.datum(name, value); }; };
  const auto noOrientation = [](ToolBench& bench) { bench.setup.world.truth.machine.spindleOrients = false; };
  const auto off = [](ToolBench& bench) { bench.probe().switchedOn = false; };
  // The tool comes down where the control believes that there is room beside the contact.
  const auto inTheWay = [](ToolBench& bench) { bench.misplace({20, 0, 0}); };
  const Wrong wrongs[] = {
      {"calibrating, radius compensation", "61300", Task::Calibrate, {}, "G41\n"},
      {"calibrating, nothing there",
       "61301",
       Task::Calibrate,
       {},
       {},
       [](auto& bench) {
         bench.misplace({-9, 0, 0});
       }},
      {"calibrating, the contact in the way", "61302", Task::Calibrate, {}, {}, inTheWay},
      {"calibrating, beyond the safe area",
       "61303",
       Task::Calibrate,
       {{"S_TSA", 0.5}},
       {},
       [](auto& bench) {
         bench.misplace({1, 0, 0});
       }},
      {"calibrating task 3", "61307", Task::Calibrate, {{"S_MVAR", 3}}},
      {"calibrating single edges", "61307", Task::Calibrate, {{"S_MVAR", 100}}},
      {"calibrating, 4th digit", "61307", Task::Calibrate, {{"S_MVAR", 1000}}},
      {"calibrating, 5th digit", "61307", Task::Calibrate, {{"S_MVAR", 10000}}},
      {"reversal of the 3rd axis", "61307", Task::Calibrate, {{"S_MVAR", 1000000}, {"S_MA", 3}}},
      {"calibrating, no measuring path", "61308", Task::Calibrate, {{"S_FA", 0}}},
      {"calibrating, the probe is off", "61309", Task::Calibrate, {}, {}, off},
      {"calibrating, a scale factor", "61310", Task::Calibrate, {}, "SCALE Z2\n"},
      {"calibrating, no offset", "61311", Task::Calibrate, {}, "D0\n"},
      {"calibrating data field 7", "61313", Task::Calibrate, {{"S_PRNUM", 7}}},
      {"calibrating with a drill", "61314", Task::Calibrate, {}, {}, datum("$TC_DP1[9,1]", 200)},
      {"calibrating, ten measurements", "61319", Task::Calibrate, {{"S_NMSP", 10}}},
      {"calibrating, plane 4", "61319", Task::Calibrate, {{"_DMODE", 4}}},
      {"not from above", "61319", Task::Complete, {}, {}, datum("$SNS_MEA_TP_AX_DIR_AUTO_CAL[0]", 33)},
      {"calibrating without axis", "61325", Task::Calibrate, {{"S_MA", 0}}},
      {"calibrating axis 4", "61325", Task::Calibrate, {{"S_MA", 4}}},
      {"calibrating, offset axis 3", "61325", Task::Calibrate, {{"S_MA", 301}}},
      {"calibrating, its own offset axis", "61325", Task::Calibrate, {{"S_MA", 101}}},
      {"calibrating direction 3", "61326", Task::Calibrate, {{"S_MD", 3}}},
      {"calibrating from below", "61326", Task::Calibrate, {{"S_MA", 3}, {"S_MD", 1}}},
      {"calibrating in a tilted system", "61330", Task::Calibrate, {{"S_MVAR", 10}}, "ROT X10\n"},
      {"calibrating, no positioning feed", "61338", Task::Calibrate, {}, {}, datum("$SCS_MEA_FEED_PLANE_VALUE", 0)},
      {"an empty data field", "61341", Task::Calibrate, {{"S_PRNUM", 4}}},
      {"a pin without radius", "61351", Task::Calibrate, {}, {}, datum("$TC_DP6[9,1]", 0)},
      {"reversal without orientation", "61372", Task::Calibrate, {{"S_MVAR", 1000000}}, {}, noOrientation},

      {"radius compensation", "61300", Task::Standing, {}, "G42\n"},
      {"nothing there",
       "61301",
       Task::Standing,
       {},
       {},
       [](auto& bench) {
         bench.misplace({-9, 0, 0});
       }},
      {"the contact in the way", "61302", Task::Standing, {}, {}, inTheWay},
      {"beyond the safe area", "61303", Task::Standing, {{"S_TSA", 0.1}}, {}, datum("$TC_DP6[2,1]", 6.2)},
      {"single edges, standing", "61307", Task::Edges, {{"S_MVAR", 101}}},
      {"reversal while measuring", "61307", Task::Standing, {{"S_MVAR", 1000001}}},
      {"a complete measurement", "61307", Task::Standing, {{"S_MVAR", 100001}}},
      {"no measuring path", "61308", Task::Turning, {{"S_FA", 0}}},
      {"the probe is off", "61309", Task::Turning, {}, {}, off},
      {"a mirrored system", "61310", Task::Turning, {}, "MIRROR X0\n"},
      {"no offset", "61311", Task::Turning, {}, "D0\n"},
      {"data field 7", "61313", Task::Turning, {{"S_PRNUM", 7}}},
      {"a turning tool", "61314", Task::Turning, {}, {}, datum("$TC_DP1[2,1]", 500)},
      {"ten measurements", "61319", Task::Turning, {{"S_NMSP", 10}}},
      {"plane 4", "61319", Task::Turning, {{"_DMODE", 4}}},
      {"empirical value 21", "61319", Task::Turning, {{"S_EVNUM", 21}}},
      {"no edges", "61319", Task::Edges, {}, {}, datum("$TC_DPNT[2,1]", 0)},
      {"more than 100 edges", "61319", Task::Edges, {}, {}, datum("$TC_DPNT[2,1]", 101)},
      {"without axis", "61325", Task::Turning, {{"S_MA", 0}}},
      {"its own offset axis", "61325", Task::Turning, {{"S_MA", 202}}},
      {"the tens of S_MA", "61325", Task::Turning, {{"S_MA", 11}}},
      {"direction 3", "61326", Task::Turning, {{"S_MD", 3}}},
      {"a length from below", "61326", Task::Turning, {{"S_MA", 3}, {"S_MD", 1}}},
      {"in a tilted system", "61330", Task::Standing, {{"S_MVAR", 11}}, "ROT Y5\n"},
      {"no positioning feed", "61338", Task::Turning, {}, {}, datum("$SCS_MEA_FEED_PLANE_VALUE", 0)},
      {"a side without trigger point",
       "61341",
       Task::Turning,
       {},
       {},
       [](auto& bench) {
         for (const char* name : {"PLUS", "MINUS"})
           bench.datum(fmt::format("$SNS_MEA_TP_TRIG_{}_DIR_AX1[0]", name), 0);
       }},
      {"no speed",
       "61350",
       Task::Turning,
       {},
       {},
       [](auto& bench) {
         for (const char* name : {"MAX_REVOLUTIONS", "MAX_PERI_SPEED"})
           bench.datum(fmt::format("$SNS_MEA_CM_{}[0]", name), 0);
       }},
      {"no radius", "61351", Task::Standing, {}, {}, datum("$TC_DP6[2,1]", 0)},
      {"edges without orientation", "61372", Task::Edges, {}, {}, noOrientation},
  };
  for (const Wrong& wrong : wrongs) {
    SCOPED_TRACE(wrong.what);
    ToolBench bench;
    bench.disc(20);
    bench.add(9, 80, 5);
    bench.add(2, 80, 6, 3);
    const bool calibrates = wrong.task == Task::Calibrate || wrong.task == Task::Complete;
    const int tool = calibrates ? 9 : 2;
    EXPECT_EQ(bench.run(tool, beside, ToolBench::call(rightCall(wrong.task))).code(), "") << "the right call";
    if (wrong.world) wrong.world(bench);
    const ToolRun left =
        bench.run(tool, beside, wrong.before + computedCall(ToolBench::call(with(rightCall(wrong.task), wrong.call))));
    EXPECT_EQ(left.code(), wrong.alarm);
    coverage::note(control::ControlKind::Sinumerik840Dsl, "CYCLE971", "refusals");
    ASSERT_FALSE(left.run.outcome.result.diagnostics.empty());
    EXPECT_FALSE(left.run.outcome.result.diagnostics.front().advice.empty());
    for (const auto& record : left.journal().cycles)
      EXPECT_TRUE(record.writes.empty());
    if (!left.journal().cycles.empty()) {
      EXPECT_EQ(left.ovi(9), std::stoi(wrong.alarm));
    }
  }
}

}  // namespace
}  // namespace probewright
