#include "cycles_heidenhain/table_folder.hpp"
#include "cycles_heidenhain/tilted_place.hpp"
#include "cycles_heidenhain/worlds.hpp"

/// The basic rotation of cycles 414 and 415 where the corner goes into a datum table, and under a rotation by cycle 10.
namespace probewright::testing_support {
namespace {

constexpr double exact = 1e-6;
const Vector3 origin(10, -20, -400);

/// A corner of a block that lies at `lying`, where the active coordinates lie at `active`: with a basic rotation along
/// its first side, and the wishes 1 and -2.
Words cornerWords(const Pose& active, const Pose& lying) {
  const auto drawn = [&](double x, double y) { return Vector3(active.inverse() * (lying * Vector3(x, y, 0))); };
  const Vector3 first = drawn(15, 0), third = drawn(0, 15);
  return {{263, written(first.x(), 1)},
          {264, written(first.y(), 1)},
          {326, 30},
          {296, written(third.x(), 1)},
          {297, written(third.y(), 1)},
          {327, 30},
          {261, -8},
          {320, 5},
          {260, 20},
          {301, 1},
          {304, 1},
          {331, 1},
          {332, -2}};
}

/// A block whose corner lies at (30, 20) of a preset with a basic rotation of 12 degrees, skewed by 2 degrees more.
struct SkewedCorner {
  explicit SkewedCorner(ControlKind kind) : bench(kind) {
    bench.preset(1, origin, 12);
    bench.part(simulation::Box({0, 0, -40}, {90, 80, 0}), lying);
  }
  /// `turn`: how far the active coordinates are turned from the preset.
  Words words(double turn = 0) const { return cornerWords(pose(origin, {0, 0, 12 + turn}), lying); }
  Pose lying = pose(origin, {0, 0, 12}) * pose({30, 20, 0}, {0, 0, 2});
  Bench bench;
};

TEST(Cycle414, TurnsTheActivePresetWhereADatumTableTakesTheCorner) {
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    SkewedCorner world(kind);
    const TableFolder folder(world.bench);
    folder.put("ZERO.D", control::heidenhain::defaultDatumTable(kind, "ZERO.D"));
    const Ran ran = world.bench.run("SEL TABLE \"ZERO.D\"\n" + probe(414, with(world.words(), {{303, 0}, {305, 4}})) +
                                    "CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 #4\nL X+1 Y-2 R0 FMAX\n");
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_TRUE(ran.preset().isApprox(pose(origin, {0, 0, 14}), 1e-10));
    EXPECT_NEAR(ran.cell("PRESET.PR", "1", kind == ControlKind::TNC640 ? "SPC" : "ROT"), 14, 6e-5);
    // With the shift of the row the corner reads 1, -2: there the probe stands now.
    const auto stands = ran.machine->position();
    EXPECT_NEAR(stands[0], world.lying.translation().x(), 1e-4);
    EXPECT_NEAR(stands[1], world.lying.translation().y(), 1e-4);
  }
}

/// A datum table whose column Y is too narrow for the corner refuses it: the basic rotation, which would go into the
/// preset table, is not set either.
TEST(Cycle414, TurnsNothingWhereTheDatumTableRefusesTheCorner) {
  SkewedCorner world(ControlKind::TNC640);
  const TableFolder folder(world.bench);
  folder.put("ZERO.D", "BEGIN ZERO .D MM\nNR X         Y    Z         \n4  +7        +8   +9        \n[END]\n");
  const Ran ran = world.bench.run("SEL TABLE \"ZERO.D\"\n" + probe(414, with(world.words(), {{303, 0}, {305, 4}})));
  EXPECT_EQ(ran.alarm(), "Table write error");
  EXPECT_TRUE(ran.preset().isApprox(pose(origin, {0, 0, 12}), 1e-12));
  EXPECT_EQ(ran.cell("PRESET.PR", "1", "SPC"), 12);
  EXPECT_EQ(ran.cell("ZERO.D", "4", "X"), 7);
}

TEST(Cycle414, TakesARotationByCycle10IntoThePreset) {
  const std::string turn = "CYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 ROT+5\n";
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    for (const int row : {0, 3}) {
      SkewedCorner world(kind);
      const std::string after = row == 0 ? "" : "CYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 ROT+0\n" + transferInto(3).after;
      const Ran ran = world.bench.run(turn + probe(414, with(world.words(5), {{303, 1}, {305, row}})) + after);
      ASSERT_TRUE(ran.finished()) << ran.why();
      EXPECT_LT((ran.preset().linear() - world.lying.linear()).norm(), 1e-9) << "row " << row;
      EXPECT_LT((ran.seen(world.lying.translation()) - Vector3(1, -2, 0)).norm(), exact);
    }
  }
}

/// The plane of a rotation by cycle 10 and a tilt upon it stays where it is; the new preset turns it within itself, so
/// that without cycle 10 its main axis lies along the side.
TEST(Cycle414, TurnsATiltedPlaneWithinItselfWhereCycle10Ends) {
  Dice dice(41410);
  const std::string turn = "CYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 ROT+25\n";
  for (const int row : {0, 3}) {
    TiltedPlace place(dice, ControlKind::TNC640);
    Pose input = place.preset * pose(Vector3::Zero(), {0, 0, 25});
    input.linear() *= place.tilt;
    const Pose lying = input * pose({-20, -10, 0}, {0, 0, 2});
    place.bench.part(simulation::Box({0, 0, -40}, {90, 80, 0}), lying);
    const std::string after = row == 0 ? "" : "CYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 ROT+0\n" + transferInto(row).after;
    const Ran ran = place.bench.run(turn + place.before +
                                    probe(414, with(cornerWords(input, lying), {{303, 1}, {305, row}})) + after);
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_LT((ran.preset().linear() * place.tilt - lying.linear()).norm(), 1e-6) << "row " << row;
    EXPECT_LT((place.inPlane(ran.preset(), lying.translation()) - Vector3(1, -2, 0)).head<2>().norm(), 1e-5);
  }
}

}  // namespace
}  // namespace probewright::testing_support
