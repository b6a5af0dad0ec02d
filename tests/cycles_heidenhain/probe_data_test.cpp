#include "control/heidenhain/probe_table.hpp"
#include "cycles_heidenhain/table_folder.hpp"
#include "cycles_heidenhain/worlds.hpp"

/// The columns of TCHPROBE.TP, the machine parameters of the iTNC 530 in their place, and GLOBAL DEF: each is seen at
/// work.
namespace probewright::testing_support {
namespace {

namespace hh = control::heidenhain;

constexpr double exact = 1e-6;
constexpr double diameter = 40;

/// A hole of 40 mm at X0 Y0 of the preset, its top at Z0; the probe's ball stands 0.1 mm beside the spindle axis.
struct Holed {
  explicit Holed(ControlKind kind) : bench(kind) {
    bench.preset(1, {0, 0, -400});
    bench.part(simulation::Ring(diameter / 2, 50, -40), pose({0, 0, -400}));
    bench.believedProbe().maximumTravel = 10;
    bench.trueProbe().tipOffset = {0.1, 0};
    bench.believedProbe().tipOffset = {0.1, 0};
  }
  Words words() const {
    const Words common = {{273, 0}, {274, 0}, {262, diameter}, {325, 0}, {247, 90}, {261, -8}, {320, 0}, {260, 40},
                          {301, 0}, {275, 0}, {276, 0},        {279, 0}, {280, 0},  {281, 0},  {309, 0}, {330, 0}};
    return bench.control == ControlKind::TNC640 ? with(common, {{423, 4}, {365, 1}}) : common;
  }
  Ran run(const Words& changes = {}) const { return bench.run(probe(421, with(words(), changes))); }
  Bench bench;
};

double seconds(const Ran& ran) {
  EXPECT_TRUE(ran.finished()) << ran.why();
  return ran.cycle().endSeconds - ran.cycle().startSeconds;
}

double latched(const Ran& ran, std::size_t touch, int axis) {
  return ran.cycle().touches[touch].latched[static_cast<std::size_t>(axis)];
}

/// Runs with row 1 of the touch probe table changed.
class TableWorld : public Holed {
public:
  TableWorld() : Holed(ControlKind::TNC640), folder_(bench), table_(hh::defaultProbeTable(ControlKind::TNC640)) {
    number("CAL_OF1", 0.1);
  }
  void number(hh::NumberColumn column, double value) {
    EXPECT_TRUE(table_.setNumber("1", column, value));
    folder_.put("TCHPROBE.TP", table_);
  }
  void text(hh::Column column, const char* value) {
    EXPECT_TRUE(table_.setText("1", column, value));
    folder_.put("TCHPROBE.TP", table_);
  }

private:
  TableFolder folder_;
  hh::TypedTable table_;
};

void expectHole(const Ran& ran, double near = exact) {
  ASSERT_TRUE(ran.finished()) << ran.why();
  EXPECT_NEAR(ran.q(151), 0, exact);
  EXPECT_NEAR(ran.q(152), 0, exact);
  EXPECT_NEAR(ran.q(153), diameter, near);
}

TEST(TouchProbeTable, SaysHowFastTheProbeMoves) {
  TableWorld world;
  world.number("F", 60);
  world.number("FMAX", 2000);
  expectHole(world.run());
  const double slow = seconds(world.run());
  world.number("F", 600);
  const double fast = seconds(world.run());
  // Four strokes of 2 mm at a tenth of the time.
  EXPECT_NEAR(slow - fast, 4 * 2 / (60.0 / 60) * 0.9, 0.5);
  world.bench.setup.beliefs.parameters["maxTouchFeed"] = {60.0, {}};
  EXPECT_NEAR(seconds(world.run()), slow, exact);
  world.bench.setup.beliefs.parameters.clear();

  world.number("FMAX", 200);
  const double crawling = seconds(world.run());
  EXPECT_GT(crawling, fast + 20);
  world.text("F_PREPOS", "FMAX_MACHINE");
  EXPECT_LT(seconds(world.run()), fast);
  world.text("F_PREPOS", "FMAX_PROBE");
  EXPECT_NEAR(seconds(world.run()), crawling, exact);
}

TEST(TouchProbeTable, SaysHowFarTheProbeSearches) {
  TableWorld world;
  world.number("DIST", 2.05);
  world.number("SET_UP", 2);
  EXPECT_EQ(world.run({{262, diameter - 1}}).alarm(), "Touch point inaccessible");
  world.number("DIST", 3.05);
  expectHole(world.run({{262, diameter - 1}}));
  world.number("SET_UP", 4);
  EXPECT_EQ(world.run({{262, diameter - 1}}).alarm(), "Touch point inaccessible");
  EXPECT_EQ(world.run({{262, diameter - 1}, {320, 0}}).why().find("DIST") != std::string::npos, true);
  world.number("DIST", 10);
  expectHole(world.run({{262, diameter - 1}}));
}

TEST(TouchProbeTable, SaysHowTheSpindleHoldsTheProbe) {
  TableWorld world;
  // CAL_ANG: the spindle goes there, and the offset belongs to it.
  world.number("CAL_ANG", 90);
  world.number("CAL_OF1", 0);
  world.number("CAL_OF2", 0.1);
  const Ran turned = world.run();
  expectHole(turned);
  EXPECT_NEAR(turned.machine->spindle().angle, 90, exact);
  // A wrong offset shifts the centre by what is missing.
  world.number("CAL_OF2", 0);
  EXPECT_NEAR(world.run().q(152), -0.1, exact);
  // TRACK: the ball leads by its offset at every touch, so only the diameter suffers.
  world.number("CAL_ANG", 0);
  world.text("TRACK", "ON");
  const Ran tracked = world.run();
  ASSERT_TRUE(tracked.finished()) << tracked.why();
  EXPECT_NEAR(tracked.q(151), 0, exact);
  EXPECT_NEAR(tracked.q(152), 0, exact);
  EXPECT_NEAR(tracked.q(153), diameter - 0.2, exact);
  EXPECT_NEAR(latched(tracked, 0, 0) - latched(turned, 0, 0), -0.1, 1e-3);
  world.number("CAL_OF1", 0.1);
  world.number("CAL_OF2", 0);
  expectHole(world.run());
}

TEST(TouchProbeTable, AsksForACalibrationWithTheSameTracking) {
  TableWorld world;
  simulation::TrueProbe& stylus = world.bench.trueProbe();
  stylus.pretravel = 0.02;
  stylus.lobing = 0.008;
  stylus.lobingPhase = 20;
  const std::string calibrate = "L Z+60 R0 FMAX\nL X+0 Y+0 R0 FMAX\nL Z-10 R0 FMAX\n" +
                                probe(462, {{407, diameter / 2}, {320, 0}, {423, 8}, {380, 0}}) + "L Z+60 R0 FMAX\n";
  const auto found = [&](bool calibrated) {
    return world.bench.run((calibrated ? calibrate : std::string()) + probe(421, world.words())).q(153) - diameter;
  };
  EXPECT_GT(std::abs(found(false)), 0.01);
  // Turned to every touch, the probe signals with one side only.
  world.text("TRACK", "ON");
  EXPECT_NEAR(found(true), 0, exact);
  // Calibrated without, it is wrong by what this side differs from the mean.
  world.text("TRACK", "OFF");
  const Ran still = world.bench.run(calibrate);
  ASSERT_TRUE(still.finished()) << still.why();
  TableFolder folder(world.bench);
  folder.put("TOOL.T", still.outcome.files.at("TOOL.T"));
  std::string table = still.outcome.files.at("TCHPROBE.TP");
  table.replace(table.find("OFF", table.find("\n1 ")), 3, "ON ");
  folder.put("TCHPROBE.TP", table);
  EXPECT_GT(std::abs(found(false)), 0.002);
}

TEST(TouchProbeTable, SaysHowTheMachineStopsAtACollision) {
  TableWorld world;
  place(world.bench.setup.world.truth, simulation::Box({-60, 24, 0}, {60, 40, 70}), pose({0, 0, -400}), "clamp",
        simulation::SolidRole::Fixture);
  const Words far = {{273, 0}, {274, 14}};
  const Ran stopped = world.run(far);
  EXPECT_EQ(stopped.alarm(), "Collision");
  EXPECT_NE(stopped.why().find("clamp"), std::string::npos) << stopped.why();
  world.text("REACTION", "EMERGSTOP");
  EXPECT_EQ(world.run(far).alarm(), "Emergency stop");
  world.text("REACTION", "NCSTOP");
  EXPECT_EQ(world.run(far).alarm(), "Collision");
}

TEST(TouchProbeTable, TakesTheSerialNumberOfTheProbe) {
  Holed world(ControlKind::TNC640);
  const auto serial = [&] {
    const Ran ran = world.run();
    expectHole(ran);
    Diagnostics diagnostics;
    return hh::TypedTable::parse(ran.outcome.files.at("TCHPROBE.TP"), "TCHPROBE.TP", hh::probeColumns(), diagnostics)
        ->text("1", "SERIAL");
  };
  EXPECT_EQ(serial(), "");
  world.bench.trueProbe().serial = "4711-08";
  EXPECT_EQ(serial(), "4711-08");
}

TEST(MachineParameters, StandForTheTouchProbeTableOnTheITNC530) {
  Holed world(ControlKind::iTNC530);
  auto& parameters = world.bench.setup.beliefs.parameters;
  expectHole(world.run());
  const double plain = seconds(world.run());
  parameters["MP6120"] = {30.0, {}};
  EXPECT_GT(seconds(world.run()), plain + 10);
  parameters.clear();
  parameters["MP6150"] = {200.0, {}};
  EXPECT_GT(seconds(world.run()), plain + 20);
  parameters["MP6151"] = {1.0, {}};
  EXPECT_LT(seconds(world.run()), plain);
  parameters.clear();
  parameters["MP6130"] = {2.05, {}};
  EXPECT_EQ(world.run({{262, diameter - 1}}).alarm(), "Touch point inaccessible");
  parameters["MP6130"] = {3.05, {}};
  expectHole(world.run({{262, diameter - 1}}));
  parameters["MP6140"] = {4.0, {}};
  EXPECT_EQ(world.run({{262, diameter - 1}}).alarm(), "Touch point inaccessible");
  parameters.clear();
  // MP6165 turns the ball, whose offset the control does not know, to every touch.
  world.bench.believedProbe().tipOffset = {0, 0};
  EXPECT_NEAR(world.run().q(151), -0.1, exact);
  parameters["MP6165"] = {1.0, {}};
  EXPECT_NEAR(world.run().q(151), 0, exact);
  EXPECT_NEAR(world.run().q(153), diameter - 0.2, exact);
}

TEST(MachineParameters, MeasureEveryPointSeveralTimesOnTheITNC530) {
  Holed world(ControlKind::iTNC530);
  auto& parameters = world.bench.setup.beliefs.parameters;
  world.bench.trueProbe().repeatability = 0.004;
  const double once = seconds(world.run());
  // The scatter of the diameter over many seeds, with one and with three measurements of each point.
  const auto scatter = [&] {
    double sum = 0;
    constexpr int seeds = 60;
    for (int seed = 0; seed < seeds; ++seed) {
      world.bench.setup.world.truth.seed = static_cast<std::uint64_t>(seed);
      sum += std::pow(world.run().q(153) - diameter, 2);
    }
    return std::sqrt(sum / seeds);
  };
  const double single = scatter();
  parameters["MP6170"] = {3.0, {}};
  EXPECT_GT(seconds(world.run()), once + 3);
  const double triple = scatter();
  EXPECT_LT(triple, 0.75 * single);
  EXPECT_GT(triple, 0.4 * single);
  parameters["MP6171"] = {0.002, {}};
  const Ran ran = world.run();
  EXPECT_EQ(ran.alarm(), "Value beyond tolerance");
  EXPECT_NE(ran.why().find("0.0020"), std::string::npos) << ran.why();
}

TEST(MachineParameters, CalibrateWithoutTurningTheProbe) {
  Holed world(ControlKind::iTNC530);
  world.bench.believedProbe().tipOffset = {0, 0};
  world.bench.part(simulation::SolidSphere(Vector3::Zero(), 12), pose({120, 0, -390}));
  const std::string calibrate = "L Z+60 R0 FMAX\nL X+120 Y+0 R0 FMAX\nL Z+26 R0 FMAX\n" +
                                probe(460, {{407, 12}, {320, 1}, {301, 1}, {423, 4}, {380, 0}, {433, 0}, {434, 10}});
  const Ran turned = world.bench.run(calibrate);
  ASSERT_TRUE(turned.finished()) << turned.why();
  EXPECT_NEAR(turned.cell("TOOL.T", "1", "CAL-OF1"), 0.1, exact);
  world.bench.setup.beliefs.parameters["MP6160"] = {0.0, {}};
  const Ran fixed = world.bench.run(calibrate);
  ASSERT_TRUE(fixed.finished()) << fixed.why();
  EXPECT_NEAR(fixed.cell("TOOL.T", "1", "CAL-OF1"), 0, exact);
  EXPECT_LT(fixed.touches(), turned.touches());
}

/// Blocks whose values come from GLOBAL DEF move as blocks that have them written.
TEST(GlobalDefinitions, StandForTheValuesOfAllProbingCycles) {
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    Holed world(kind);
    const auto predefined = [&](const Words& words) {
      std::string text = probe(421, words);
      for (const int number : {320, 260, 301}) {
        const std::size_t at = text.find(fmt::format("Q{}=", number));
        const std::size_t begin = at + 5, end = text.find(' ', begin);
        text.replace(begin, end - begin, "PREDEF");
      }
      return text;
    };
    const auto global = [](double clearance, double height, int travel) {
      return fmt::format(
          "GLOBAL DEF 120 PROBING ~\n  Q320={:+.3f} ;SET-UP ~\n  Q260={:+.3f} ;HEIGHT ~\n  Q301={} ;TRAVEL\n",
          clearance, height, travel);
    };
    std::vector<double> lengths;
    for (const auto& [clearance, height, travel] :
         {std::tuple(0.0, 40.0, 0), std::tuple(3.0, 40.0, 0), std::tuple(0.0, 60.0, 0), std::tuple(0.0, 40.0, 1)}) {
      const Words words = with(world.words(), {{320, clearance}, {260, height}, {301, travel}});
      const Ran written = world.bench.run(probe(421, words));
      const Ran global120 = world.bench.run(global(clearance, height, travel) + predefined(world.words()));
      expectHole(global120);
      EXPECT_NEAR(global120.cycle().pathLength, written.cycle().pathLength, exact);
      EXPECT_NEAR(seconds(global120), seconds(written), exact);
      lengths.push_back(global120.cycle().pathLength);
    }
    // Each of the three has an effect.
    for (std::size_t i = 1; i < lengths.size(); ++i)
      EXPECT_GT(std::abs(lengths[i] - lengths[0]), 1);
    // The last definition counts; what is written in the cycle does not change.
    const Ran again = world.bench.run(global(3, 60, 1) + global(0, 40, 0) + predefined(world.words()));
    EXPECT_NEAR(again.cycle().pathLength, lengths[0], exact);
    const Ran fixed = world.bench.run(global(3, 60, 1) + probe(421, world.words()));
    EXPECT_NEAR(fixed.cycle().pathLength, lengths[0], exact);
    // In inches.
    Words inches = world.words();
    for (auto& [number, value] : inches) {
      if (number == 262 || number == 261) value /= 25.4;
    }
    const Ran inch = world.bench.run(global(0, 40 / 25.4, 0) + predefined(inches), "INCH");
    ASSERT_TRUE(inch.finished()) << inch.why();
    EXPECT_NEAR(inch.cycle().pathLength, lengths[0], 0.1);

    const Ran missing = world.bench.run(predefined(world.words()));
    EXPECT_EQ(missing.alarm(), "GLOBAL DEF missing");
    EXPECT_NE(missing.why().find("Q320"), std::string::npos) << missing.why();
    const Ran group = world.bench.run("GLOBAL DEF 119 X ~\n  Q320=+0 ;X\n");
    EXPECT_EQ(group.alarm(), "GLOBAL DEF wrong");
    const Ran parameter = world.bench.run("GLOBAL DEF 120 X ~\n  Q200=+0 ;X\n");
    EXPECT_EQ(parameter.alarm(), "GLOBAL DEF wrong");
    EXPECT_NE(parameter.why().find("Q200"), std::string::npos) << parameter.why();
  }
}

}  // namespace
}  // namespace probewright::testing_support
