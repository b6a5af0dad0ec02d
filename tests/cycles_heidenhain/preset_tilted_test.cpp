#include "cycles_heidenhain/table_folder.hpp"
#include "cycles_heidenhain/tilted_place.hpp"

/// Presetting cycles in a tilted working plane: what is measured there gets the wished coordinates there.
namespace probewright::testing_support {
namespace {

constexpr double exact = 1e-6;

/// A part in the tilted plane, a little beside where the program thinks.
struct PartInPlane : TiltedPlace {
  Pose part;
  PartInPlane(Dice& dice, ControlKind kind) : TiltedPlace(dice, kind), part(input * pose(dice.within(0.5))) {}
  template <class SolidType>
  void lay(SolidType solid, const Vector3& at = Vector3::Zero()) {
    bench.part(std::move(solid), part * pose(at));
  }
};

/// The same in a preset with a 3-D basic rotation, while the tool stands upright.
struct PartInRotation : PartInPlane {
  explicit PartInRotation(Dice& dice) : PartInPlane(dice, ControlKind::TNC640) {
    const Vector3 angles(written(dice.between(-3, 3)), written(dice.between(-3, 3)), written(dice.between(-40, 40)));
    bench.setup.beliefs.presets.front().rotation = angles;
    tilt = Matrix3::Identity();
    preset = input = pose(preset.translation(), angles);
    part = input * pose(dice.within(0.5));
    before.clear();
  }
};

struct Case {
  int cycle;
  Words words;
  std::function<void(PartInPlane&)> lay;
  Vector3 feature;             ///< on the part
  std::array<bool, 3> wishes;  ///< the axes that are set: to 7, -2 and 5
};

const Words heights = {{261, -8}, {260, 30}};
const Words centre = {{331, 7}, {332, -2}};

void holeAt(PartInPlane& place, double x, double y) { place.lay(simulation::Ring(10, 16, -30), {x, y, 0}); }

std::vector<Case> cases() {
  const auto block = [](PartInPlane& place) { place.lay(simulation::Box({-50, -40, -30}, {50, 40, 0})); };
  const Words circle = with(heights, {{321, 0}, {322, 0}, {262, 40}, {325, 0}, {247, 90}, {320, 1}, {301, 1}});
  const Words width = with(heights, {{321, 0}, {322, 0}, {311, 80}, {272, 2}, {320, 1}, {405, -2}});
  const Words toolAxis = {{381, 1}, {382, 30}, {383, 0}, {384, 0}, {333, 5}};
  return {
      {409, width, block, {0, 0, -8}, {false, true, false}},
      {411,
       with(with(heights, {{321, 0}, {322, 0}, {323, 100}, {324, 80}, {320, 1}, {301, 1}}), centre),
       block,
       {0, 0, -8},
       {true, true, false}},
      {412,
       with(with(circle, centre), toolAxis),
       [](PartInPlane& place) { place.lay(simulation::Ring(20, 45, -30)); },
       {0, 0, 0},
       {true, true, true}},
      {413,
       with(with(circle, centre), {{381, 0}}),
       [](PartInPlane& place) { place.lay(simulation::RoundBar(20, -30, 0)); },
       {0, 0, -8},
       {true, true, false}},
      {414,
       with(with(heights,
                 {{263, -30}, {264, -40}, {326, 50}, {296, -50}, {297, -20}, {327, 40}, {320, 1}, {301, 1}, {304, 0}}),
            centre),
       block,
       {-50, -40, -8},
       {true, true, false}},
      {416,
       with(with(heights, {{273, 0}, {274, 0}, {262, 80}, {291, 0}, {292, 90}, {293, 180}}), centre),
       [](PartInPlane& place) {
         for (const Vector2& at : {Vector2(40, 0), Vector2(0, 40), Vector2(-40, 0)})
           holeAt(place, at.x(), at.y());
       },
       {0, 0, -8},
       {true, true, false}},
      {417, {{263, 10}, {264, 5}, {294, 0}, {320, 1}, {260, 30}, {333, 5}}, block, {10, 5, 0}, {false, false, true}},
      {418,
       with(with(heights, {{268, -30}, {269, -30}, {270, 30}, {271, -30}, {316, 30}, {317, 30}, {318, -30}, {319, 30}}),
            centre),
       [](PartInPlane& place) {
         for (const Vector2& at : {Vector2(-30, -30), Vector2(30, -30), Vector2(30, 30), Vector2(-30, 30)})
           holeAt(place, at.x(), at.y());
       },
       {0, 0, -8},
       {true, true, false}},
      {419,
       with(heights, {{263, -50}, {264, 0}, {272, 1}, {267, 1}, {320, 1}, {333, 7}}),
       block,
       {-50, 0, -8},
       {true, false, false}},
  };
}

/// Measures `one` into the given row and expects what was wished; the other axes keep their zero.
void expectWished(PartInPlane& place, const Case& one, int row) {
  const Vector3 wishes(7, -2, 5);
  one.lay(place);
  const Transfer transfer = transferInto(row);
  const Ran ran = place.bench.run(place.before + probe(one.cycle, with(one.words, transfer.words)) + transfer.after);
  ASSERT_TRUE(ran.finished()) << ran.why();
  const Vector3 feature = place.part * one.feature;
  const Vector3 before = place.inPlane(place.preset, feature), after = place.inPlane(ran.preset(), feature);
  for (int axis = 0; axis < 3; ++axis) {
    const bool wished = one.wishes[static_cast<std::size_t>(axis)];
    EXPECT_NEAR(after[axis], wished ? wishes[axis] : before[axis], exact) << "axis " << axis;
  }
  EXPECT_TRUE(ran.preset().linear().isApprox(place.preset.linear(), 1e-12));
}

TEST(TiltedPlane, TakesPresetsWhereTheyWereMeasured) {
  Dice dice(4081);
  constexpr int rows[] = {0, 1, 6};
  for (const Case& one : cases()) {
    for (int world = 0; world < 20; ++world) {
      const ControlKind kind = controlOf(world);
      PartInPlane place(dice, kind);
      const int row = rows[dice.whole(0, 2)];
      SCOPED_TRACE(fmt::format("cycle {} on the {}, world {}, row {}", one.cycle, control::name(kind), world, row));
      expectWished(place, one, row);
    }
  }
}

TEST(BasicRotation3d, TakesPresetsAlongItsAxes) {
  Dice dice(4083);
  constexpr int rows[] = {0, 1, 6};
  for (const Case& one : cases()) {
    for (int world = 0; world < 10; ++world) {
      PartInRotation place(dice);
      const int row = rows[dice.whole(0, 2)];
      SCOPED_TRACE(fmt::format("cycle {}, world {}, row {}", one.cycle, world, row));
      expectWished(place, one, row);
    }
  }
}

TEST(TiltedPlane, ShiftsItsDatumByATable) {
  Dice dice(4082);
  for (const Case& one : cases()) {
    for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
      SCOPED_TRACE(fmt::format("cycle {} on the {}", one.cycle, control::name(kind)));
      PartInPlane place(dice, kind);
      one.lay(place);
      const TableFolder folder(place.bench);
      folder.put("ZERO.D", control::heidenhain::defaultDatumTable(kind, "ZERO.D"));
      const Ran ran = place.bench.run("SEL TABLE \"ZERO.D\"\n" + place.before +
                                      probe(one.cycle, with(one.words, {{303, 0}, {305, 4}})) +
                                      "CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 #4\nL Z+50 R0 FMAX\nL X+7 Y-2 R0 FMAX\n");
      ASSERT_TRUE(ran.finished()) << ran.why();
      // The tip stands where the feature was: along the axes that were set, seen in the plane.
      const Vector3 feature = place.part * one.feature;
      const Vector3 seen = place.inPlane(place.preset, feature);
      const auto& machine = *ran.machine;
      const Vector3 tip =
          place.inPlane(place.preset, machine.tipOnTable() - 2 * machine.tableFromSpindle().linear().col(2));
      if (one.wishes[0]) {
        EXPECT_NEAR(tip.x(), seen.x(), 2e-3);
      }
      if (one.wishes[1]) {
        EXPECT_NEAR(tip.y(), seen.y(), 2e-3);
      }
      if (one.wishes[2]) {
        EXPECT_NEAR(tip.z() - 50, seen.z() - 5, 2e-3);
      }
    }
  }
}

}  // namespace
}  // namespace probewright::testing_support
