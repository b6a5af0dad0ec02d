#include "cycles_heidenhain/table_folder.hpp"
#include "cycles_heidenhain/worlds.hpp"
#include "machine/description.hpp"

/// Cycles 400 to 405: a basic rotation or a rotary table makes up for how the part lies.
namespace probewright::testing_support {
namespace {

constexpr int worlds = 100;
constexpr double exact = 1e-6;

/// `degrees` brought into (-90, 90]: the same line whatever its direction.
double asLine(double degrees) {
  double angle = std::remainder(degrees, 180);
  return angle <= -90 ? angle + 180 : angle;
}

/// The same preset without its basic rotation: cycles 400 to 402 measure in it.
Pose unrotated(const PlantedPart& part) { return pose(part.machineFromPreset.translation()); }

/// The angle of the part's X axis seen in `frame`.
double angleIn(const Pose& frame, const Pose& part) {
  const Vector3 x = frame.linear().transpose() * part.linear().col(0);
  return degrees(std::atan2(x.y(), x.x()));
}

/// The column of the basic rotation about Z.
std::string rotationColumn(ControlKind control) { return control == ControlKind::TNC640 ? "SPC" : "ROT"; }

/// Two points of an edge of a box of `half` size, as they would be programmed in `frame`.
struct Edge {
  Words words;
  double angle = 0;  ///< of the edge from first to second point, in the frame
};
Edge drawnEdge(Dice& dice, const PlantedPart& part, const Pose& frame, double half, int axis, double sense) {
  const bool swapped = dice.coin();
  const auto onEdge = [&](double along) {
    Vector3 local = Vector3::Zero();
    local[axis] = -sense * half;
    local[1 - axis] = along;
    return Vector3(frame.inverse() * (part.machineFromPart * local));
  };
  const Vector3 a = onEdge(swapped ? 12 : -12), b = onEdge(swapped ? -12 : 12);
  Edge edge;
  edge.words = {{263, written(a.x(), 1)}, {264, written(a.y(), 1)}, {265, written(b.x(), 1)}, {266, written(b.y(), 1)}};
  edge.angle = degrees(std::atan2(b.y() - a.y(), b.x() - a.x()));
  return edge;
}

TEST(Cycle400, TurnsThePresetAlongAnyEdge) {
  Dice dice(400);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    const ControlKind control = controlOf(world);
    PlantedPart part = plant(dice, control, 0.3, 0);
    // The part lies up to 20 degrees off the machine's axes, whatever the old basic rotation was.
    const double lies = dice.between(-20, 20);
    part.machineFromPart.linear() = pose(Vector3::Zero(), {0, 0, lies}).linear();
    part.bench.part(simulation::Box({-30, -30, -40}, {30, 30, 0}), part.machineFromPart);
    const int axis = dice.whole(0, 1);
    const double sense = dice.coin() ? 1 : -1;
    const Edge edge = drawnEdge(dice, part, unrotated(part), 30, axis, sense);
    const double reference = dice.coin() ? (axis == 0 ? 90 : 0) : written(dice.between(-60, 60));
    const int rows[] = {0, 1, 6};
    const int row = rows[dice.whole(0, 2)];
    const double top = (part.machineFromPreset.inverse() * part.machineFromPart.translation()).z();
    const Words words = with(edge.words, {{272, axis + 1},
                                          {267, sense},
                                          {261, written(top) - 8},
                                          {320, 3},
                                          {260, written(top) + 20},
                                          {301, 1},
                                          {307, reference},
                                          {305, row}});
    const std::string after = row == 6 ? transferInto(6).after : "";
    const Ran ran = part.bench.run(probe(400, words) + after);
    ASSERT_TRUE(ran.finished()) << ran.why();
    const double expected = asLine(asLine(edge.angle) - reference);
    const Pose turned = pose(part.machineFromPreset.translation(), {0, 0, expected});
    EXPECT_TRUE(ran.preset().isApprox(turned, 1e-9)) << ran.preset().matrix() << "\n" << turned.matrix();
    EXPECT_NEAR(ran.cell("PRESET.PR", row == 0 ? "1" : std::to_string(row), rotationColumn(control)), expected, 6e-5);
    if (row == 6) {
      EXPECT_NEAR(ran.cell("PRESET.PR", "1", rotationColumn(control)),
                  angleIn(Pose::Identity(), part.machineFromPreset), 6e-5);
    }
  }
}

/// Cycles 401 and 402 with a basic rotation: two holes or studs.
void expectRotationOfTwo(int cycle, bool holes) {
  Dice dice(static_cast<unsigned>(cycle));
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    const ControlKind control = controlOf(world);
    PlantedPart part = plant(dice, control, 0.3, 0);
    const double lies = dice.between(-180, 180);
    part.machineFromPart.linear() = pose(Vector3::Zero(), {0, 0, lies}).linear();
    const double diameter1 = dice.between(10, 25), diameter2 = dice.between(10, 25), reach = dice.between(30, 60);
    const std::array<Vector3, 2> centres = {Vector3(-reach, 0, 0), Vector3(reach, 0, 0)};
    const std::array<double, 2> diameters = {diameter1, diameter2};
    Words words;
    for (std::size_t i = 0; i < 2; ++i) {
      const Pose lying = part.machineFromPart * pose(centres[i]);
      if (holes) {
        part.bench.part(simulation::Ring(diameters[i] / 2, diameters[i] / 2 + 10, -40), lying);
      } else {
        part.bench.part(simulation::RoundBar(diameters[i] / 2, -40, 0), lying);
      }
      const Vector3 drawn = unrotated(part).inverse() * lying.translation() + dice.within(0.5);
      words.emplace_back(i == 0 ? 268 : 270, written(drawn.x()));
      words.emplace_back(i == 0 ? 269 : 271, written(drawn.y()));
    }
    const double top = written((part.machineFromPreset.inverse() * part.machineFromPart.translation()).z());
    const double reference = written(dice.between(-180, 180));
    const int rows[] = {0, 1, 6};
    const int row = rows[dice.whole(0, 2)];
    words = with(words, {{261, top - 8}, {260, top + 20}, {307, reference}, {305, row}, {402, 0}, {337, 0}});
    if (!holes) {
      words = with(
          words,
          {{313, written(diameter1)}, {314, written(diameter2)}, {315, top - 12}, {320, 1}, {301, dice.whole(0, 1)}});
    }
    const Ran ran = part.bench.run(probe(cycle, words) + (row == 6 ? transferInto(6).after : ""));
    ASSERT_TRUE(ran.finished()) << ran.why();
    const Pose turned = pose(part.machineFromPreset.translation(), {0, 0, lies - reference});
    EXPECT_TRUE(ran.preset().isApprox(turned, 1e-9)) << ran.preset().matrix() << "\n" << turned.matrix();
    // The TNC 640 keeps a rotation for row 0 there, the iTNC 530 in the active preset.
    const std::string kept = row == 6 ? "6" : row == 0 && control == ControlKind::TNC640 ? "0" : "1";
    EXPECT_NEAR(std::remainder(ran.cell("PRESET.PR", kept, rotationColumn(control)) - (lies - reference), 360), 0,
                6e-5);
  }
}

TEST(Cycle401, TurnsThePresetAlongTwoHoles) { expectRotationOfTwo(401, true); }
TEST(Cycle402, TurnsThePresetAlongTwoStuds) { expectRotationOfTwo(402, false); }

TEST(Cycle404, SetsABasicRotationWithoutMeasuring) {
  for (const ControlKind control : {ControlKind::TNC640, ControlKind::iTNC530}) {
    Bench bench(control);
    bench.preset(1, {10, 20, -400}, 5);
    const Ran ran = bench.run(probe(404, {{307, -12.5}}));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_TRUE(ran.preset().isApprox(pose({10, 20, -400}, {0, 0, -12.5}), 1e-12));
    EXPECT_EQ(ran.cell("PRESET.PR", "1", rotationColumn(control)), -12.5);
    EXPECT_EQ(ran.touches(), 0U);
  }
  Bench older(ControlKind::iTNC530);
  older.preset(1, {10, 20, -400}, 5);
  const Ran row = older.run(probe(404, {{307, 3}, {305, 4}}));
  EXPECT_EQ(row.outcome.info.exit, records::ExitState::InputMistake);
  EXPECT_NE(row.why().find("Q305"), std::string::npos) << row.why();
  Bench bench;
  bench.preset(1, {10, 20, -400}, 5);
  const Ran other = bench.run(probe(404, {{307, 3}, {305, 4}}) + transferInto(4).after);
  EXPECT_EQ(other.cell("PRESET.PR", "4", "SPC"), 3);
  EXPECT_EQ(other.cell("PRESET.PR", "1", "SPC"), 5);
  const Ran row0 = bench.run(probe(404, {{307, 3}, {305, 0}}));
  EXPECT_EQ(row0.cell("PRESET.PR", "0", "SPC"), 3);
  EXPECT_EQ(row0.cell("PRESET.PR", "0", "X"), 10);
  EXPECT_TRUE(row0.preset().isApprox(pose({10, 20, -400}, {0, 0, 3}), 1e-12));
}

/// A part on the table of the five-axis machine, seen with the table at C = 0; the control's preset lies in the table's
/// centre line or anywhere else.
PlantedPart onTable(Dice& dice, ControlKind control, double lies, const Vector3& preset, double startC) {
  PlantedPart part{Bench(control, "mill5-table-table")};
  part.bench.believedProbe().maximumTravel = 70;
  part.bench.preset(1, preset);
  part.machineFromPreset = pose(preset);
  // Only the truth knows the table; the part's pose is wanted in the base frame with C at its start.
  auto& truth = part.bench.setup.world.truth;
  truth.start[4] = startC;
  const Pose machineFromPart = pose(Vector3(dice.between(-60, 60), dice.between(-60, 60), -400), {0, 0, lies});
  part.machineFromPart = machineFromPart;
  return part;
}

/// The pose on the table that looks like `machineFromPart` with the table as it starts.
Pose onTableOf(const PlantedPart& part) {
  const auto& truth = part.bench.setup.world.truth;
  return machine::baseFromTable(truth.machine, truth.start).inverse() * part.machineFromPart;
}

/// The direction of the part's X axis in machine coordinates with the table as it stands at the end of the run.
double finalAngle(const PlantedPart& part, const Pose& tableFromPart, const Ran& ran) {
  const auto& truth = part.bench.setup.world.truth;
  const Vector3 x = (machine::baseFromTable(truth.machine, ran.machine->position()) * tableFromPart).linear().col(0);
  return degrees(std::atan2(x.y(), x.x()));
}

TEST(Cycle403, TurnsTheTableUntilTheEdgeIsAligned) {
  Dice dice(403);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    const ControlKind control = controlOf(world);
    PlantedPart part = onTable(dice, control, dice.between(-20, 20), {written(dice.between(-20, 20)), 10, -400},
                               written(dice.between(-90, 90)));
    const Pose tableFromPart = onTableOf(part);
    part.bench.part(simulation::Box({-30, -30, -40}, {30, 30, 0}), tableFromPart);
    const int axis = dice.whole(0, 1);
    const double sense = dice.coin() ? 1 : -1;
    const Edge edge = drawnEdge(dice, part, part.machineFromPreset, 30, axis, sense);
    // Aligned to an axis of the machine, or to any angle; found by the cycle only on the newer control.
    const double target = dice.coin() ? (axis == 0 ? 90 : 0) : written(dice.between(0, 180));
    const bool automatic = control == ControlKind::TNC640 && dice.coin();
    const bool zero = dice.coin();
    const int row = dice.coin() ? 0 : 5;
    const Words words = with(edge.words, {{272, axis + 1},
                                          {267, sense},
                                          {261, -8},
                                          {320, 3},
                                          {260, 20},
                                          {301, 1},
                                          {312, automatic ? 0 : 6},
                                          {337, zero ? 1 : 0},
                                          {305, row},
                                          {303, 1},
                                          {380, target}});
    const Ran ran = part.bench.run(probe(403, words));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.q(150), automatic ? edge.angle : asLine(edge.angle), exact);
    // The edge runs along the part's X (Q272 = 2) or Y axis, forwards or back.
    const double lies = finalAngle(part, tableFromPart, ran) + (axis == 0 ? 90 : 0);
    EXPECT_NEAR(std::remainder(lies - target, 180), 0, exact);
    if (automatic) {
      // The edge points from the first to the second touch.
      const double turned = finalAngle(part, tableFromPart, ran) - angleIn(Pose::Identity(), part.machineFromPart);
      EXPECT_NEAR(std::remainder(edge.angle + turned - target, 360), 0, exact);
    }
    const double c = ran.machine->position()[4];
    const std::string column = control == ControlKind::TNC640 ? "C_OFFS" : "C";
    // Q305 counts for the axis that the cycle finds, on the iTNC 530 for any.
    const std::string entered = !automatic && control == ControlKind::TNC640 ? "1" : row == 0 ? "0" : "5";
    if (zero) {
      EXPECT_NEAR(ran.cell("PRESET.PR", entered, column), c, 6e-5);
    } else {
      EXPECT_EQ(ran.cell("PRESET.PR", "1", column), 0);
      EXPECT_FALSE(ran.table("PRESET.PR").hasRow("5"));
    }
  }
}

TEST(Cycles401And402, TurnTheTableUntilTwoFeaturesAreAligned) {
  Dice dice(4010);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    const ControlKind control = controlOf(world);
    const bool holes = dice.coin();
    const double lies = dice.between(-180, 180);
    PlantedPart part =
        onTable(dice, control, lies, {written(dice.between(-20, 20)), 10, -400}, written(dice.between(-90, 90)));
    const Pose tableFromPart = onTableOf(part);
    Words words;
    for (const double side : {-1.0, 1.0}) {
      const Pose centre = pose({side * 40, 0, 0});
      if (holes) {
        part.bench.part(simulation::Ring(8, 20, -40), tableFromPart * centre);
      } else {
        part.bench.part(simulation::RoundBar(8, -40, 0), tableFromPart * centre);
      }
      const Vector3 drawn = part.machineFromPreset.inverse() * (part.machineFromPart * centre.translation());
      words.emplace_back(side < 0 ? 268 : 270, written(drawn.x(), 1));
      words.emplace_back(side < 0 ? 269 : 271, written(drawn.y(), 1));
    }
    const double reference = written(dice.between(-90, 90));
    const bool zero = dice.coin();
    const int row = dice.coin() ? 0 : 5;
    words = with(words, {{261, -8}, {260, 20}, {307, reference}, {305, row}, {402, 1}, {337, zero ? 1 : 0}});
    if (!holes) words = with(words, {{313, 16}, {314, 16}, {315, -10}, {320, 1}, {301, 1}});
    const Ran ran = part.bench.run(probe(holes ? 401 : 402, words));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(std::remainder(finalAngle(part, tableFromPart, ran) - reference, 360), 0, exact);
    const double c = ran.machine->position()[4];
    const std::string column = control == ControlKind::TNC640 ? "C_OFFS" : "C";
    if (control == ControlKind::TNC640) {
      // Zero where the axis stands, or the offset with which it shows what it showed before.
      const std::string entered = !zero ? "1" : row == 0 ? "0" : "5";
      const double before = part.bench.setup.world.truth.start[4];
      EXPECT_NEAR(std::remainder(ran.cell("PRESET.PR", entered, column) - (zero ? c : c - before), 360), 0, 6e-5);
    } else {
      EXPECT_NEAR(ran.cell("PRESET.PR", "1", column), zero ? c : 0, 6e-5);
      EXPECT_FALSE(ran.table("PRESET.PR").hasRow("5"));
    }
  }
}

TEST(Cycle405, TurnsTheTableUntilTheHoleLiesWhereItShould) {
  Dice dice(405);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    const ControlKind control = controlOf(world);
    // The preset lies on the axis of the table.
    const double start = written(dice.between(-90, 90));
    PlantedPart part = onTable(dice, control, 0, {0, 0, -400}, start);
    // Q322 = 0 places the hole on the X axis, and asks for the positive Y axis.
    const bool toY = dice.coin();
    const double drawn = toY ? (dice.coin() ? 0 : 180) : dice.between(30, 150);
    const double direction = drawn + dice.between(-0.5, 0.5);
    const double reach = dice.between(50, 100), diameter = dice.between(15, 30);
    const auto at = [&](double angle) {
      return Vector3(reach * std::cos(radians(angle)), reach * std::sin(radians(angle)), 0);
    };
    part.machineFromPart = pose(at(direction) + Vector3(0, 0, -400));
    const Pose tableFromPart = onTableOf(part);
    part.bench.part(simulation::Ring(diameter / 2, diameter / 2 + 10, -40), tableFromPart);
    const Vector2 nominal(written(at(drawn).x()), toY ? 0 : written(at(drawn).y()));
    const int row = dice.coin() ? 0 : 3;
    const TableFolder folder(part.bench);
    control::heidenhain::TypedTable datums = control::heidenhain::defaultDatumTable(control, "ZERO.D");
    ASSERT_TRUE(datums.ensureRow("3"));
    ASSERT_TRUE(datums.setNumber("3", "C", 1.5));
    folder.put("ZERO.D", datums);
    const Ran ran = part.bench.run("SEL TABLE \"ZERO.D\"\n" + probe(405, {{321, nominal.x()},
                                                                          {322, nominal.y()},
                                                                          {262, written(diameter) - 0.5},
                                                                          {325, 0},
                                                                          {247, 90},
                                                                          {261, -8},
                                                                          {320, 0},
                                                                          {260, 20},
                                                                          {301, dice.whole(0, 1)},
                                                                          {337, row}}));
    ASSERT_TRUE(ran.finished()) << ran.why();
    const double target = toY ? 90 : degrees(std::atan2(nominal.y(), nominal.x()));
    const double offset = std::remainder(direction - target, 360);
    EXPECT_NEAR(ran.q(150), offset, exact);
    const auto& truth = part.bench.setup.world.truth;
    const Vector3 now = (machine::baseFromTable(truth.machine, ran.machine->position()) * tableFromPart).translation();
    EXPECT_NEAR(degrees(std::atan2(now.y(), now.x())), target, exact);
    // The probe has left the hole above its centre, not above the last touch.
    const auto stands = ran.machine->position();
    EXPECT_NEAR(std::hypot(stands[0] - at(direction).x(), stands[1] - at(direction).y()), 0, exact);
    const std::string column = control == ControlKind::TNC640 ? "C_OFFS" : "C";
    if (row == 0) {
      EXPECT_NEAR(ran.cell("PRESET.PR", "1", column), ran.machine->position()[4], 6e-5);
      EXPECT_EQ(ran.cell("ZERO.D", "3", "C"), 1.5);
    } else {
      EXPECT_NEAR(ran.cell("ZERO.D", "3", "C"), 1.5 + offset, 6e-5);
      EXPECT_EQ(ran.cell("PRESET.PR", "1", column), 0);
    }
  }
}

}  // namespace
}  // namespace probewright::testing_support
