#include <gmock/gmock.h>

#include "cycles_heidenhain/walls.hpp"
#include "geometry/decompositions.hpp"

/// Cycles 420 and 444 on machines and with probes that are not as the control believes.
namespace probewright::testing_support {
namespace {

using ::testing::HasSubstr;

constexpr double exact = 1e-6;

/// Random scales of the linear axes, and X and Z not square to Y and X.
void plantGeometry(Dice& dice, simulation::Truth& truth) {
  truth.errors.axes.resize(truth.machine.axes.size());
  for (const char* name : {"X", "Y", "Z"})
    truth.errors.axes[*truth.machine.axisIndex(name)].scale = dice.between(-1e-3, 1e-3);
  const auto axis = [&](const char* name) { return *truth.machine.axisIndex(name); };
  truth.errors.squareness = {{axis("X"), axis("Y"), dice.between(-0.05, 0.05)},
                             {axis("Z"), axis("X"), dice.between(-0.05, 0.05)}};
}

/// What a step of the axes truly does: columns for X, Y and Z.
Matrix3 trueFromDisplayed(const simulation::Truth& truth) {
  const auto& errors = truth.errors;
  const char* names[] = {"X", "Y", "Z"};
  Matrix3 result = Matrix3::Identity();
  for (int i = 0; i < 3; ++i) {
    Vector3 direction = Vector3::Unit(i);
    for (const simulation::Squareness& each : errors.squareness) {
      if (each.axis != *truth.machine.axisIndex(names[i])) continue;
      for (int to = 0; to < 3; ++to) {
        if (each.towards == *truth.machine.axisIndex(names[to]))
          direction += Vector3::Unit(to) * std::tan(radians(each.degrees));
      }
    }
    result.col(i) = direction.normalized() * (1 + errors.axes[*truth.machine.axisIndex(names[i])].scale);
  }
  return result;
}

/// Everything about the probe is wrong in the tables.
void plantProbe(Dice& dice, Bench& bench) {
  simulation::TrueProbe& stylus = bench.trueProbe();
  stylus.pretravel = dice.between(0.005, 0.03);
  stylus.lobing = dice.between(0.001, 0.005);
  stylus.lobingPhase = dice.between(0, 120);
  stylus.axialPretravel = dice.between(0.001, 0.01);
  bench.believedProbe().tipOffset = {0, 0};
  bench.believedProbe().radius += written(dice.between(-0.05, 0.05), 4);
  bench.believedProbe().length += written(dice.between(-0.3, 0.3), 4);
}

/// `degrees` in (-90, 90].
double asLine(double degrees) {
  const double angle = std::remainder(degrees, 180);
  return angle <= -90 ? angle + 180 : angle;
}

/// Both touches meet the face in the same direction: whatever is wrong with the probe drops out. Scales and squareness
/// do not: the displayed normal of a face with the normal n is M^T n.
TEST(Cycle420, IsWrongByTheGeometryOfTheMachineOnly) {
  Dice dice(4200);
  for (int at = 0; at < 90; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    const int axis = at % 3;
    const double sense = axis == 2 || dice.coin() ? -1 : 1;
    Vector3 normal = -sense * Vector3::Unit(axis);
    // With the touch probe axis the points lie along the main axis (B) or the minor axis (A).
    const int along = axis == 2 ? dice.whole(0, 1) : 1 - axis;
    normal[along] = dice.between(-0.4, 0.4);
    if (axis == 2) normal[1 - along] = dice.between(-0.2, 0.2);
    Wall world = wall(dice, controlOf(at / 3), normal);
    plantGeometry(dice, world.bench.setup.world.truth);
    plantProbe(dice, world.bench);

    // The scales move the face by up to half a millimetre.
    Vector3 first = world.point;
    first[along] -= 10;
    Vector3 second = first;
    second[along] += 20;
    const Words words = {
        {263, first.x()}, {264, first.y()}, {265, second.x()}, {266, second.y()},       {272, axis + 1}, {267, sense},
        {261, first.z()}, {320, 8},         {260, 60},         {301, dice.whole(0, 1)}, {281, 1}};
    const Ran ran = world.bench.run(probe(420, words));
    ASSERT_TRUE(ran.finished()) << ran.why();
    const Matrix3 preset = world.machineFromPreset.linear();
    const Vector3 n =
        preset.transpose() * trueFromDisplayed(world.bench.setup.world.truth).transpose() * preset * world.normal;
    double expected = degrees(std::atan2(n.x(), -n.y()));
    if (axis == 2) expected = along == 1 ? degrees(std::atan(-n.y() / n.z())) : degrees(std::atan(n.x() / n.z()));
    EXPECT_NEAR(asLine(ran.q(150) - expected), 0, 1e-5);
    EXPECT_THAT(ran.log("TCHPR420.TXT"), HasSubstr(fmt::format("{:.4f}", ran.q(150))));
  }
}

/// Scatter of the signal turns the angle by what two touches 20 mm apart let it.
TEST(Cycle420, ScattersWithTheSignal) {
  Dice dice(42001);
  constexpr double sigma = 0.01;
  double sum = 0;
  constexpr int runs = 150;
  Wall world = wall(dice, ControlKind::TNC640, -Vector3::UnitY());
  world.bench.trueProbe().repeatability = sigma;
  for (int at = 0; at < runs; ++at) {
    world.bench.setup.world.truth.seed = static_cast<std::uint64_t>(at + 1);
    const Ran ran = world.bench.run(probe(420, {{263, world.point.x() - 10},
                                                {264, world.point.y()},
                                                {265, world.point.x() + 10},
                                                {266, world.point.y()},
                                                {272, 2},
                                                {267, 1},
                                                {261, world.point.z()},
                                                {320, 1},
                                                {260, 60},
                                                {301, 0},
                                                {281, 0}}));
    ASSERT_TRUE(ran.finished()) << ran.why();
    sum += ran.q(150) * ran.q(150);
  }
  const double expected = degrees(std::sqrt(2.0) * sigma / 20);
  EXPECT_NEAR(std::sqrt(sum / runs), expected, 0.2 * expected);
}

/// Along the normal: a larger ball and a late signal, the tip beside the axis, a stylus that is shorter than believed.
TEST(Cycle444, IsWrongByWhatTheControlDoesNotKnowOfTheProbe) {
  Dice dice(4440);
  for (int at = 0; at < 100; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    Wall world = wall(dice, ControlKind::TNC640, anyNormal(dice));
    const double deviation = dice.between(-0.3, 0.3);
    const Vector3 nominal = world.point - world.normal * deviation;
    plantProbe(dice, world.bench);
    const auto& truth = world.bench.setup.world.truth.tools.front();
    const auto& believed = world.bench.believedProbe();
    const Ran ran = world.bench.run(probe(444,
                                          {{263, nominal.x()},
                                           {264, nominal.y()},
                                           {294, nominal.z()},
                                           {581, world.normal.x()},
                                           {582, world.normal.y()},
                                           {583, world.normal.z()},
                                           {320, 1},
                                           {260, 60},
                                           {309, 0}},
                                          " ~\n  QS400=\"0.1-0.1\" ;T"));
    ASSERT_TRUE(ran.finished()) << ran.why();
    const Vector3 n = world.machineFromPreset.linear() * world.normal;
    const double e = n.z(), phi = degrees(std::atan2(n.y(), n.x()));
    const double late = (1 - e * e) * (truth.probe.pretravel +
                                       truth.probe.lobing * std::cos(radians(3 * (phi - truth.probe.lobingPhase)))) +
                        e * e * truth.probe.axialPretravel;
    // From the ball where the control believes it to the ball as it is.
    const Vector3 beside =
        world.tip + Vector3(0, 0, believed.length - truth.length + truth.probe.ballRadius - believed.radius);
    const double expected = deviation + truth.probe.ballRadius - believed.radius - late - beside.dot(world.normal);
    EXPECT_NEAR(ran.q(164), expected, 2e-5);
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(ran.q(161 + axis), ran.q(164) * world.normal[axis], 2e-5);
    EXPECT_EQ(ran.q(183), expected > 0.1 ? 1 : expected < -0.1 ? 2 : 0);
  }
}

/// Scales and squareness: the displayed place of the face, along the normal of the program.
TEST(Cycle444, IsWrongByTheGeometryOfTheMachine) {
  Dice dice(4441);
  for (int at = 0; at < 60; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    Wall world = wall(dice, ControlKind::TNC640, anyNormal(dice));
    plantGeometry(dice, world.bench.setup.world.truth);
    const Ran ran = world.bench.run(probe(444,
                                          {{263, world.point.x()},
                                           {264, world.point.y()},
                                           {294, world.point.z()},
                                           {581, world.normal.x()},
                                           {582, world.normal.y()},
                                           {583, world.normal.z()},
                                           {320, 3},
                                           {260, 60},
                                           {309, 0}},
                                          " ~\n  QS400=\" \" ;T"));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_EQ(ran.q(183), -1);
    // The axes display q where the tool reference point truly stands at M q; the stylus hangs below it.
    const Matrix3 m = trueFromDisplayed(world.bench.setup.world.truth), preset = world.machineFromPreset.linear();
    const Vector3 n = preset * world.normal, place = world.machineFromPreset * world.point;
    const auto& tool = world.bench.setup.world.truth.tools.front();
    const Vector3 hanging(0, 0, -(tool.length - tool.probe.ballRadius)), tip = preset * world.tip;
    // Ball centres in touch: n . (M q + hanging + tip - place) = R, along q = q0 + t n.
    const Vector3 start = place + n * tool.probe.ballRadius - hanging - tip;
    const double t = (tool.probe.ballRadius - n.dot(m * start + hanging + tip - place)) / n.dot(m * n);
    EXPECT_NEAR(ran.q(164), t, 2e-5);
  }
}

/// With TCPM the stylus may lean, however the plane is tilted: the ball is where the kinematics say.
TEST(Cycle444, TouchesWithALeaningStylusUnderTcpm) {
  Dice dice(4442);
  for (int at = 0; at < 30; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    const std::pair<const char*, const char*> machines[] = {
        {"mill5-table-table", "A"}, {"mill5-head-table", "B"}, {"mill5-head-head", "A"}};
    const auto& [machine, swivel] = machines[at % 3];
    Bench bench(ControlKind::TNC640, machine);
    const Vector3 origin(written(dice.between(-20, 20)), written(dice.between(-20, 20)), -430);
    bench.preset(1, origin);
    bench.believedProbe().maximumTravel = 40;
    bench.setup.beliefs.parameters["chkTiltingAxes"] = {1.0, {}};
    const Vector3 normal = Vector3(dice.between(-0.5, 0.5), dice.between(-0.5, 0.5), 1).normalized();
    Pose face = pose(origin);
    face.linear() = shortestTurn(Vector3::UnitZ(), normal).toRotationMatrix();
    bench.part(simulation::Box({-25, -25, -20}, {25, 25, 0}), face);
    const double deviation = dice.between(-0.3, 0.3);
    const Vector3 nominal = -normal * deviation;
    const std::string touch = probe(444,
                                    {{263, nominal.x()},
                                     {264, nominal.y()},
                                     {294, nominal.z()},
                                     {581, normal.x()},
                                     {582, normal.y()},
                                     {583, normal.z()},
                                     {320, 1},
                                     {260, 50},
                                     {309, 0}},
                                    " ~\n  QS400=\" \" ;T");
    const std::string axes =
        fmt::format("L {}{:+.3f} C{:+.3f} F2000\n", swivel, dice.between(5, 15), dice.between(-60, 60));
    const Ran ran = bench.run("L Z-1 R0 FMAX M91\nM128\n" + axes + touch);
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.q(164), deviation, 2e-5);
    // Without TCPM the rotary axes must agree with the plane.
    const Ran refused = bench.run("L Z-1 R0 FMAX M91\n" + axes + touch);
    EXPECT_EQ(refused.alarm(), "Rotary axes and tilt do not match");
    EXPECT_THAT(refused.why(), HasSubstr("chkTiltingAxes"));
  }
}

}  // namespace
}  // namespace probewright::testing_support
