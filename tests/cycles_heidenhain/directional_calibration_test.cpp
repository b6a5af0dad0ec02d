#include "control/heidenhain/deflection_table.hpp"
#include "cycles_heidenhain/table_folder.hpp"
#include "cycles_heidenhain/worlds.hpp"
#include "geometry/decompositions.hpp"
#include "probing/directional_radius.hpp"

/// Cycle 460 with Q455: a probe that signals sooner or later by direction, and what it measures afterwards.
namespace probewright::testing_support {
namespace {

/// Between two rings of 3.6 degrees the response bends by 4e-5; the length in the table has four decimals.
constexpr double interpolated = 1e-4;

/// A sphere, a wall somewhere beside it, and a probe with pretravel that depends on the direction.
struct Lobed {
  Bench bench{ControlKind::TNC640};
  Pose machineFromPreset = Pose::Identity();
  double radius = 0, height = 0;  ///< of the sphere
  Vector3 normal = Vector3::UnitZ();
  double deviation = 0;
  std::string calibrate;  ///< with {} for Q455
  std::string measure;    ///< cycle 444 at the wall

  Ran run(int points) const { return bench.run(fmt::format(fmt::runtime(calibrate), points) + measure); }
};

Lobed lobed(Dice& dice, double clearance = 1) {
  Lobed world;
  Bench& bench = world.bench;
  const double length = written(dice.between(80, 140), 4), ball = written(dice.between(1, 3), 4);
  bench.probeOf(length, ball);
  simulation::TrueProbe& stylus = bench.trueProbe();
  stylus.tipOffset = {dice.between(-0.4, 0.4), dice.between(-0.4, 0.4)};
  stylus.pretravel = dice.between(0.01, 0.02);
  stylus.lobing = dice.between(0.006, 0.01);
  stylus.lobingPhase = dice.between(0, 120);
  stylus.axialPretravel = dice.between(0.002, 0.006);
  auto& believed = bench.believedProbe();
  believed.length += written(dice.between(-0.3, 0.3), 4);
  believed.radius += written(dice.between(-0.1, 0.1), 4);
  believed.maximumTravel = 40;
  believed.calibrationAngle = dice.coin() ? 0 : written(dice.between(-180, 180));
  const Vector3 origin(written(dice.between(-60, 60), 4), written(dice.between(-60, 60), 4), -400);
  const double rotation = dice.coin() ? 0 : written(dice.between(-170, 170));
  bench.preset(1, origin, rotation);
  world.machineFromPreset = pose(origin, {0, 0, rotation});
  world.radius = written(dice.between(10, 15), 4);
  world.height = written(dice.between(-5, 5), 4);
  bench.part(simulation::SolidSphere(Vector3::Zero(), world.radius),
             pose(world.machineFromPreset * Vector3(dice.between(-0.3, 0.3), dice.between(-0.3, 0.3), world.height)));

  const Vector3 anyNormal(dice.between(-1, 1), dice.between(-1, 1), dice.between(0, 1));
  world.normal = anyNormal.normalized().unaryExpr([](double v) { return written(v, 6); });
  const Vector3 point(90, 0, 0);
  Pose presetFromBlock = Pose::Identity();
  presetFromBlock.translation() = point;
  presetFromBlock.linear() = shortestTurn(Vector3::UnitZ(), world.normal).toRotationMatrix();
  bench.part(simulation::Box({-25, -25, -20}, {25, 25, 0}), world.machineFromPreset * presetFromBlock);
  world.deviation = dice.between(-0.2, 0.2);
  const Vector3 nominal = point - world.normal * world.deviation;

  const Words words = {{407, world.radius},
                       {320, clearance},
                       {301, dice.whole(0, 1)},
                       {423, dice.whole(7, 8)},
                       {380, written(dice.between(0, 360))},
                       {433, 1},
                       {434, world.height}};
  world.calibrate = fmt::format("L Z+60 R0 FMAX\nL X+0 Y+0 R0 FMAX\nL Z{:+.4f} R0 FMAX\n",
                                world.height + world.radius + 3 + clearance) +
                    probe(460, words, " ~\n  Q455={} ;POINTS") + "L Z+80 R0 FMAX\n";
  world.measure = probe(444,
                        {{263, nominal.x()},
                         {264, nominal.y()},
                         {294, nominal.z()},
                         {581, world.normal.x()},
                         {582, world.normal.y()},
                         {583, world.normal.z()},
                         {320, 1},
                         {260, 60},
                         {309, 0}},
                        " ~\n  QS400=\" \" ;TOLERANCE");
  return world;
}

TEST(Cycle460, RemovesWhatDependsOnTheDirection) {
  Dice dice(4604);
  double plain = 0;
  for (int at = 0; at < 40; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    const Lobed world = lobed(dice);
    const Ran without = world.run(0);
    ASSERT_TRUE(without.finished()) << without.why();
    EXPECT_EQ(without.outcome.files.count("T1.3DTC"), 0U);
    plain = std::max(plain, std::abs(without.q(164) - world.deviation));
    const Ran ran = world.run(25);
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_EQ(ran.table("TOOL.T").text("1", "DR2TABLE"), "T1.3DTC");
    EXPECT_NEAR(ran.q(164), world.deviation, interpolated);
    // What the record says of the touch lies on the wall, too, which passes 90 mm beside the preset.
    const control::TouchRecord& touch = ran.outcome.journal.cycles.back().touches.back();
    EXPECT_NEAR((touch.surface - Vector3(90, 0, 0)).dot(world.normal), 0, interpolated);
  }
  EXPECT_GT(plain, 0.008);
}

/// The sphere is searched over the set-up clearance of the table and that of the cycle together.
TEST(Cycle460, FindsTheSphereFromAnyClearance) {
  Dice dice(4606);
  for (const double clearance : {0.0, 5.0, 18.0}) {
    const Lobed world = lobed(dice, clearance);
    const Ran ran = world.run(9);
    ASSERT_TRUE(ran.finished()) << clearance << ": " << ran.why();
    EXPECT_EQ(ran.table("TOOL.T").text("1", "DR2TABLE"), "T1.3DTC") << clearance;
  }
}

TEST(Cycle460, LeavesATableThatLaterRunsBelieve) {
  Dice dice(4605);
  Lobed world = lobed(dice);
  const Ran calibrated = world.run(25);
  ASSERT_TRUE(calibrated.finished()) << calibrated.why();
  // The tables of a run as the control of the next one finds them.
  const TableFolder folder(world.bench);
  for (const char* name : {"TOOL.T", "TCHPROBE.TP", "T1.3DTC"})
    folder.put(name, calibrated.outcome.files.at(name));
  const Ran later = world.bench.run(world.measure);
  ASSERT_TRUE(later.finished()) << later.why();
  EXPECT_NEAR(later.q(164), world.deviation, interpolated);

  // A wrong table yields wrong results: 0.05 more ball radius in all directions puts the surface 0.05 deeper.
  Diagnostics diagnostics;
  auto table = control::heidenhain::TypedTable::parse(calibrated.outcome.files.at("T1.3DTC"), "T1.3DTC",
                                                      control::heidenhain::deflectionColumns(), diagnostics);
  ASSERT_TRUE(table);
  auto rows = control::heidenhain::deflectionsOf(*table);
  EXPECT_GE(rows.size(), 1U + 25 * 7);
  for (auto& row : rows)
    row.deviation += 0.05;
  folder.put("T1.3DTC", *control::heidenhain::deflectionTable("T1.3DTC", rows));
  const Ran wrong = world.bench.run(world.measure);
  ASSERT_TRUE(wrong.finished()) << wrong.why();
  EXPECT_NEAR(wrong.q(164), later.q(164) - 0.05, 2e-6);

  // Calibrating again overwrites the table that DR2TABLE names.
  const Ran again = world.run(20);
  ASSERT_TRUE(again.finished()) << again.why();
  EXPECT_NEAR(again.q(164), world.deviation, 2 * interpolated);

  world.bench.setup.beliefs.parameters["option92"] = {0.0, {}};
  EXPECT_EQ(world.run(5).alarm(), "Option 92 not enabled");
  // Without the option the data have no effect.
  EXPECT_GT(std::abs(world.bench.run(world.measure).q(164) - later.q(164)), 1e-4);
  world.bench.setup.beliefs.parameters.clear();

  rows[3].azimuth += 1;
  folder.put("T1.3DTC", *control::heidenhain::deflectionTable("T1.3DTC", rows));
  EXPECT_EQ(world.bench.run(world.measure).alarm(), "Calibration data wrong");
  folder.remove("T1.3DTC");
  EXPECT_EQ(world.bench.run(world.measure).alarm(), "Calibration data missing");
}

TEST(DirectionalRadius, FollowsLobesAndStaysOnItsRings) {
  const auto truth = [](double polar, double azimuth) {
    return 0.01 * std::pow(std::sin(radians(polar)), 2) * (1 + 0.5 * std::cos(3 * radians(azimuth - 20)));
  };
  std::vector<probing::DirectionalRadius::Ring> rings = {{0, 0, {0}}};
  for (int polar = 10; polar <= 90; polar += 10) {
    probing::DirectionalRadius::Ring ring{static_cast<double>(polar), 15, {}};
    for (int i = 0; i < 7; ++i)
      ring.deviations.push_back(truth(polar, 15 + 360.0 * i / 7));
    rings.push_back(ring);
  }
  const probing::DirectionalRadius radius(rings);
  const auto direction = [](double polar, double azimuth) {
    return Vector3(std::sin(radians(polar)) * std::cos(radians(azimuth)),
                   std::sin(radians(polar)) * std::sin(radians(azimuth)), -std::cos(radians(polar)));
  };
  Dice dice(92);
  for (int at = 0; at < 100; ++at) {
    const double azimuth = dice.between(-400, 400);
    const int ring = dice.whole(1, 9);
    EXPECT_NEAR(radius.at(3 * direction(10 * ring, azimuth)), truth(10 * ring, azimuth), 1e-12);
    const double between = dice.between(0, 90);
    EXPECT_NEAR(radius.at(direction(between, azimuth)), truth(between, azimuth), 1.5e-4);
    EXPECT_NEAR(radius.at(direction(dice.between(90, 180), azimuth)), truth(90, azimuth), 1e-12);
  }
  EXPECT_EQ(radius.at(Vector3::Zero()), 0);
  EXPECT_EQ(probing::DirectionalRadius().at(Vector3::UnitX()), 0);
}

}  // namespace
}  // namespace probewright::testing_support
