#include <gmock/gmock.h>

#include "cycles_kinematics/sphere_worlds.hpp"

/// What is left after cycle 451, and what it finds of the backlash, against theory; and how it travels.
namespace probewright::testing_support {
namespace {

using testing::HasSubstr;
using testing::Not;

/// The values of a label in an HTML log, in their order.
std::vector<std::string> logged(const std::string& log, const std::string& label) {
  std::vector<std::string> values;
  const std::string cell = "<td>" + label + "</td><td>";
  for (std::size_t at = log.find(cell); at != log.npos; at = log.find(cell, at + 1)) {
    const std::size_t begin = at + cell.size();
    values.push_back(log.substr(begin, log.find('<', begin) - begin));
  }
  return values;
}

/// The spindle drifts in X while B turns the sphere, at 0, 90, 180 and 270 degrees. With the spots turned back, the
/// least squares of four even positions put the axis off by the mean of the drifts, and the sphere on the table by the
/// mean of the drifts turned back; the rest remains.
TEST(RemainingError, OfADriftIsWhatLeastSquaresLeave) {
  constexpr double amount = 5, timeConstant = 1e5;  // slow: nearly linear while the cycle runs
  SphereWorld world(builds()[3]);
  world.bench.setup.world.truth.errors.thermal.push_back({{amount, 0, 0}, timeConstant});
  world.bench.setup.beliefs.parameters["maxModification"] = {1.0, {}};
  const Ran ran = world.bench.run(probe(451, words451(world.build, 1)));
  ASSERT_TRUE(ended(ran)) << ran.why();
  const std::size_t b = *world.built().axisIndex("B");
  // In X a sphere is seen by its four touches around, each with half of them along X: the mean of their times.
  std::vector<Vector2> drift;  // X and Z of the spindle's motion at each position
  std::vector<double> angles;
  const auto& touches = ran.cycle().touches;
  for (std::size_t first = 0; first + 5 <= touches.size(); first += 5) {
    double mean = 0;
    for (std::size_t i = 1; i < 5; ++i)
      mean += amount * (1 - std::exp(-touches[first + i].seconds / timeConstant)) / 4;
    drift.emplace_back(mean, 0);
    angles.push_back(radians(touches[first].latched[b]));
  }
  ASSERT_EQ(drift.size(), 4U);
  // The tool is further in X than the axis reads, so the sphere is read that much too small.
  Vector2 axis = Vector2::Zero(), sphere = Vector2::Zero();
  const auto turned = [](double angle) { return Eigen::Rotation2Dd(angle).toRotationMatrix(); };
  for (const double sense : {-1.0, 1.0}) {
    axis = sphere = Vector2::Zero();
    for (std::size_t i = 0; i < 4; ++i) {
      axis -= drift[i] / 4;
      sphere -= turned(sense * angles[i]).transpose() * drift[i] / 4;
    }
    std::vector<Vector2> left;
    for (std::size_t i = 0; i < 4; ++i)
      left.emplace_back(-drift[i] - axis - turned(sense * angles[i]) * sphere);
    // Seen as errors against the reference at 0, as the log says.
    double measured = 0, remains = 0;
    for (std::size_t i = 1; i < 4; ++i) {
      measured += (turned(-sense * angles[i]) * drift[i] - drift[0]).squaredNorm() / 3;
      remains += (turned(-sense * angles[i]) * left[i] - left[0]).squaredNorm() / 3;
    }
    EXPECT_GT(std::sqrt(measured), 0.002) << "the drift matters";
    // Along a line the sense of turning makes no difference.
    EXPECT_NEAR(ran.q(142), std::sqrt(measured), 0.02 * std::sqrt(measured));
    EXPECT_NEAR(ran.q(145), std::sqrt(remains), 0.02 * std::sqrt(remains));
  }
  const machine::MachineDescription found = machine::corrected(world.built(), kinematicsOf(ran, world.built()).axes);
  EXPECT_NEAR(apart(found, world.built()).place, axis.norm(), 0.02 * axis.norm());
}

/// On every build of machine, whichever side is reached first.
TEST(BacklashOfAxes, IsFoundOnEveryBuild) {
  for (std::size_t at = 0; at < 4; ++at) {
    for (const double overrun : {0.4, -0.8}) {
      SCOPED_TRACE(fmt::format("{} {}", builds()[at].machine, overrun));
      SphereWorld world(builds()[at]);
      auto& errors = world.bench.setup.world.truth.errors;
      errors.axes.resize(world.built().axes.size());
      std::vector<double> planted;
      for (const auto& [name, measured] : world.build.axes) {
        planted.push_back(0.005 + 0.004 * static_cast<double>(planted.size()));
        errors.axes[*world.built().axisIndex(std::string(1, name))].backlash = planted.back();
      }
      const Ran ran = world.bench.run(probe(451, words451(world.build, 0, {{432, overrun}})));
      ASSERT_TRUE(ended(ran)) << ran.why();
      const auto found = logged(ran.log("TCHPR451.html"), "Averaged backlash");
      ASSERT_EQ(found.size(), planted.size());
      // Head axes that carry each other see a little of the other's.
      for (std::size_t i = 0; i < planted.size(); ++i)
        EXPECT_NEAR(std::stod(found[i]), planted[i], 0.02 * planted[i]);
    }
  }
}

/// Not with a coupling, nor with an M function of the builder, nor where the sphere hardly moves.
TEST(BacklashOfAxes, IsNotMeasuredWhereTheManualsSaySo) {
  const auto backlash = [](const SphereWorld& world, const Words& changes) {
    const Ran ran = world.bench.run(probe(451, words451(world.build, 0, with({{432, 0.5}}, changes))));
    EXPECT_TRUE(ended(ran)) << ran.why();
    return logged(ran.log("TCHPR451.html"), "Averaged backlash");
  };
  SphereWorld hirth(builds()[3]);
  hirth.bench.setup.beliefs.kinematics["B"].hirthGrid = 5;
  EXPECT_EQ(backlash(hirth, {{408, 400}}), std::vector<std::string>{"-"});
  SphereWorld builder(builds()[3]);
  builder.bench.setup.beliefs.parameters["mStrobeRotAxPos"] = {8.0, {}};
  EXPECT_EQ(backlash(builder, {}), std::vector<std::string>{"-"});
  // 0.5 mm beside the axis of the table C.
  Build middle = builds()[1];
  const machine::MachineDescription machine = *machine::readMachine(middle.machine);
  for (const machine::ChainElement& element : machine.tableChain) {
    if (!element.axis || machine.axes[*element.axis].name != "C") continue;
    middle.sphere.x() = element.point.x() + 0.5;
    middle.sphere.y() = element.point.y();
  }
  middle.axes.erase('B');
  EXPECT_EQ(backlash(SphereWorld(middle), {}), std::vector<std::string>{"-"});
}

/// The TNC 640 ends with 3D-ROT active as the rotary axes stand: the top of the sphere is where it was, along the tool.
TEST(EndOfCycle451, LeavesThePlaneTiltedAsTheAxesStand) {
  SphereWorld world(builds()[2]);
  const Ran ran = world.bench.run(probe(451, words451(world.build, 1)) + touchTop());
  ASSERT_TRUE(ended(ran)) << ran.why();
  const std::size_t a = *world.built().axisIndex("A");
  EXPECT_NEAR(ran.cycle().touches.back().latched[a], 45, 1e-9) << "the head leans";
  EXPECT_NEAR(ran.q(160), sphereRadius, 1e-6);
}

/// The probe goes down to a sphere with the smaller one of Q253 and FMAX of its table.
TEST(FeedsOfCycle451, AreThoseOfQ253AndTheProbeTable) {
  const auto seconds = [](double q253, double fmax) {
    SphereWorld world(builds()[3]);
    world.bench.believedProbe().rapid = fmax;
    const Ran ran = world.bench.run(probe(451, words451(world.build, 0, {{253, q253}})));
    EXPECT_TRUE(ended(ran)) << ran.why();
    return ran.cycle().endSeconds - ran.cycle().startSeconds;
  };
  EXPECT_NEAR(seconds(1000, 3000), seconds(1000, 1000), 1e-6) << "Q253 limits FMAX";
  EXPECT_GT(seconds(3000, 1000), 1.05 * seconds(3000, 3000)) << "FMAX limits Q253";
}

/// FMAX, FAUTO and PREDEF in place of numbers.
TEST(FeedsOfCycle451, MayBeWords) {
  SphereWorld world(builds()[3]);
  const auto touches = [&](const std::string& q253, const std::string& before) {
    std::string cycle = probe(451, words451(world.build, 0));
    const std::string written = "Q253=+5000.000000", clearance = "Q320=+0.000000";
    cycle.replace(cycle.find(written), written.size(), "Q253=" + q253);
    if (q253 == "PREDEF") cycle.replace(cycle.find(clearance), clearance.size(), "Q320=PREDEF");
    const Ran ran = world.bench.runBare("TOOL CALL 1 Z F900\n" + before + cycle);
    EXPECT_TRUE(ended(ran)) << ran.why();
    return ran.touches();
  };
  const std::string global =
      "GLOBAL DEF 100 GENERAL ~\n  Q200=+2 ;A ~\n  Q204=+50 ;B ~\n  Q253=+3000 ;C ~\n  Q208=+1000 ;D\n"
      "GLOBAL DEF 120 PROBING ~\n  Q320=+1 ;S ~\n  Q260=+75 ;H ~\n  Q301=+1 ;T\n";
  for (const auto& [word, before] :
       {std::pair<std::string, std::string>("FMAX", ""), {"FAUTO", ""}, {"PREDEF", global}})
    EXPECT_EQ(touches(word, before), 20U) << word;
}

}  // namespace
}  // namespace probewright::testing_support
