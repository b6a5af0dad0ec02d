#include "cycles_heidenhain/rotation_worlds.hpp"
#include "machine/rotary_solver.hpp"

/// Cycle 1420: the angles of a plane.
namespace probewright::testing_support {
namespace {

TEST(Cycle1420, FindsTheAnglesOfAnyPlane) {
  Dice dice(1420);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    Place place = placeAt(dice, 1, 0);
    const Tilted plane = layPlane(dice, place, 5);
    const int position = dice.whole(0, 4);
    const int rotation = dice.whole(0, 1);
    Words words = with(with(plane.words(), common(dice, place)), {{1120, position}, {1121, rotation}});
    const Ran ran = place.bench.run(place.before + probe(1420, words));
    ASSERT_TRUE(ran.finished()) << ran.why();
    for (int i = 0; i < 3; ++i) {
      const auto at = static_cast<std::size_t>(i);
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(ran.q(950 + 3 * i + axis), plane.expected[at][axis], exact);
        EXPECT_NEAR(ran.q(980 + 3 * i + axis), plane.expected[at][axis] - plane.nominal[at][axis], exact);
      }
    }
    const Vector3 inWorkpiece =
        place.machineFromPreset.linear().transpose() * place.machineFromInput.linear() * plane.normal;
    EXPECT_NEAR(ran.q(961), degrees(std::asin(-inWorkpiece.y())), exact);
    EXPECT_NEAR(ran.q(962), degrees(std::atan2(inWorkpiece.x(), inWorkpiece.z())), exact);
    EXPECT_NEAR(ran.q(963), 0, exact);
    if (rotation == 1) {
      const Vector3 square = ran.preset().linear().col(2);
      EXPECT_LT((square - place.machineFromInput.linear() * plane.normal).norm(), 1e-9);
    }
    if (position == 0) continue;
    const auto chosen = [&](const std::array<Vector3, 3>& points) -> Vector3 {
      return position == 4 ? Vector3((points[0] + points[1] + points[2]) / 3)
                           : points[static_cast<std::size_t>(position - 1)];
    };
    expectTransfer(ran, place, rotation == 1 ? turnTo(plane.normal) : Matrix3(Matrix3::Identity()),
                   chosen(plane.expected), chosen(plane.nominal));
    EXPECT_NE(ran.log("TCHPRAUTO.html").find("<h2>1420 "), std::string::npos);
  }
}

/// Walls, probed along the main or minor axis: upright and turned, leaning a little away from the probe.
TEST(Cycle1420, FindsTheAnglesOfAnyWall) {
  Dice dice(14203);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    Place place = placeAt(dice, 1, 0);
    place.bench.believedProbe().setUpClearance = 10;
    const int axis = dice.whole(0, 1), sign = dice.coin() ? 1 : -1;
    // A block whose face towards the probe is the wall; it leans back from its foot.
    const double turn = dice.between(-6, 6), lean = dice.between(0, 4);
    const Vector3 leans = axis == 0 ? Vector3(0, sign * lean, 0) : Vector3(-sign * lean, 0, 0);
    const Matrix3 lies = pose(Vector3::Zero(), {0, 0, turn}).linear() * pose(Vector3::Zero(), leans).linear();
    const Vector3 through = place.inputFromPart().translation();
    const Vector3 normal = lies * (-sign * Vector3::Unit(axis));
    Vector3 low(-90, -90, -60), high(90, 90, 4);
    (sign > 0 ? low : high)[axis] = 0;
    Pose inputFromBlock = Pose::Identity();
    inputFromBlock.linear() = lies;
    inputFromBlock.translation() = through;
    place.bench.part(simulation::Box(low, high), place.machineFromInput * inputFromBlock);
    std::array<Vector3, 3> nominal, expected;
    const Vector2 places[] = {{-30, -25}, {35, -20}, {dice.between(-20, 20), -5}};
    for (std::size_t i = 0; i < 3; ++i) {
      Vector3 onWall(0, 0, places[i].y());
      onWall[1 - axis] = places[i].x();
      nominal[i] = (place.nominal + onWall).unaryExpr([](double v) { return written(v); });
      expected[i] = touchOnPlane(nominal[i], axis, sign, through, normal, place.ball);
    }
    const int position = dice.whole(0, 4);
    Words words = with(common(dice, place), {{372, sign * (axis + 1)}, {1120, position}, {1121, 1}, {1125, 2}});
    for (int i = 0; i < 9; ++i)
      words.emplace_back(1100 + i, nominal[static_cast<std::size_t>(i / 3)][i % 3]);
    const Ran ran = place.bench.run(place.before + probe(1420, words));
    ASSERT_TRUE(ran.finished()) << ran.why();
    for (int i = 0; i < 9; ++i) {
      const auto at = static_cast<std::size_t>(i / 3);
      EXPECT_NEAR(ran.q(950 + i), expected[at][i % 3], exact);
      EXPECT_NEAR(ran.q(980 + i), expected[at][i % 3] - nominal[at][i % 3], exact);
    }
    // The space angles turn the tool axis to the normal in the workpiece system.
    const Matrix3 workpieceFromInput = place.machineFromPreset.linear().transpose() * place.machineFromInput.linear();
    const Matrix3 measured = pose(Vector3::Zero(), {ran.q(961), ran.q(962), ran.q(963)}).linear();
    EXPECT_LT((measured.col(2) - workpieceFromInput * normal).norm(), 1e-7);
    // The basic rotation turns the nominal wall, which is upright, to the measured one and not about its own normal.
    const Matrix3 rotation = place.machineFromInput.linear().transpose() * ran.preset().linear() *
                             place.machineFromPreset.linear().transpose() * place.machineFromInput.linear();
    EXPECT_LT((rotation * (-sign * Vector3::Unit(axis)) - normal).norm(), 1e-8);
    EXPECT_NEAR(rotation(2, 1 - axis), 0, 1e-9);
    if (position == 0) continue;
    Vector3 wanted = Vector3::Zero(), actual = Vector3::Zero();
    for (std::size_t i = 0; i < 3; ++i) {
      const double share = position == 4 ? 1.0 / 3 : position == static_cast<int>(i) + 1 ? 1 : 0;
      wanted += share * nominal[i];
      actual += share * expected[i];
    }
    expectTransfer(ran, place, rotation, actual, wanted);
  }
}

/// An upright wall turned about the tool axis is a matter of SPC alone, on whichever side of the part it lies.
TEST(Cycle1420, TurnsTheBasicRotationAlongUprightWalls) {
  for (const int direction : {-2, -1, 1, 2}) {
    for (const double turn : {-1.5, 0.0, 0.5}) {
      SCOPED_TRACE(fmt::format("Q372 {}, turned by {}", direction, turn));
      Bench bench;
      bench.preset(1, {0, 0, -400});
      bench.believedProbe().maximumTravel = 40;
      bench.part(simulation::Box({-50, -50, -40}, {50, 50, 0}), pose({0, 0, -400}, {0, 0, turn}));
      const int axis = std::abs(direction) - 1;
      Words words = {{372, direction}, {320, 4}, {260, 20}, {1125, 1}, {309, 0}, {1126, 0}, {1120, 0}, {1121, 1}};
      const double along[] = {-30, 30, 10}, heights[] = {-6, -6, -20};
      for (int i = 0; i < 3; ++i) {
        words.emplace_back(1100 + 3 * i + axis, direction > 0 ? -50 : 50);
        words.emplace_back(1100 + 3 * i + 1 - axis, along[i]);
        words.emplace_back(1102 + 3 * i, heights[i]);
      }
      const Ran ran = bench.run(probe(1420, words));
      ASSERT_TRUE(ran.finished()) << ran.why();
      EXPECT_NEAR(ran.cell("PRESET.PR", "1", "SPA"), 0, 1e-4);
      EXPECT_NEAR(ran.cell("PRESET.PR", "1", "SPB"), 0, 1e-4);
      EXPECT_NEAR(ran.cell("PRESET.PR", "1", "SPC"), turn, 1e-4);
      const double upright = direction > 0 ? 1 : -1;
      const Vector3 angles = axis == 0 ? Vector3(upright * turn, -upright * 90, 0) : Vector3(upright * 90, 0, turn);
      for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(ran.q(961 + i), angles[i], exact) << "Q" << 961 + i;
    }
  }
}

/// Without a touch Q372 says nothing: known positions may span a wall.
TEST(Cycle1420, ComputesAWallFromActualPositions) {
  Bench bench;
  bench.preset(1, {10, 20, -400});
  const double turn = 1.25;
  const Vector3 nominal[] = {{-30, -50, -6}, {30, -50, -6}, {10, -50, -20}};
  std::string texts;
  for (int i = 0; i < 9; ++i) {
    const Vector3 actual = aboutZ(turn) * nominal[i / 3];
    texts += fmt::format(" ~\n  QS{}=\"{:.1f}@{:.9f}\" ;X", 1100 + i, nominal[i / 3][i % 3], actual[i % 3]);
  }
  const Ran ran = bench.run(
      probe(1420, {{372, -3}, {320, 0}, {260, 20}, {1125, 1}, {309, 0}, {1126, 0}, {1120, 0}, {1121, 1}}, texts));
  ASSERT_TRUE(ran.finished()) << ran.why();
  EXPECT_EQ(ran.touches(), 0U);
  EXPECT_NEAR(std::abs(ran.q(961)), 90, exact);
  EXPECT_NEAR(ran.q(962), 0, exact);
  EXPECT_NEAR(ran.q(963), turn, exact);
  EXPECT_TRUE(ran.preset().linear().isApprox(aboutZ(turn), 1e-9));
}

/// Where the tool points in the table as it lies when all rotary axes stand at 0.
Vector3 toolOnTable(const Ran& ran) {
  const auto& machine = ran.machine->description();
  return machine::toolOrientation(machine, {}, ran.machine->position()).col(2);
}

TEST(Cycle1420, StandsTheToolSquareToThePlane) {
  Dice dice(14201);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    Place place = placeAt(dice, 1, 0, dice.coin() ? "mill5-table-table" : "mill5-head-table");
    place.before.clear();
    place.machineFromInput = place.machineFromPreset;
    place.machineFromPart = place.machineFromInput * pose(place.nominal + dice.within(1));
    const Tilted plane = layPlane(dice, place, 5);
    Words words = with(with(plane.words(), common(dice, place)),
                       {{1120, 1}, {1121, 1}, {1126, dice.whole(1, 2)}, {1125, 2}, {260, place.nominal.z() + 60}});
    // The second run finds the plane as it should be, but for what the ball radius cost on the slanting plane.
    const Ran ran = place.bench.run(probe(1420, words) + probe(1420, with(words, {{1121, 0}, {1126, 0}})) +
                                    probe(1420, with(words, {{1121, 0}, {1126, 0}})));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_LT((toolOnTable(ran) - place.machineFromInput.linear() * plane.normal).norm(), 1e-9);
    EXPECT_NEAR(ran.q(961), 0, exact);
    EXPECT_NEAR(ran.q(962), 0, exact);
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(ran.q(982 + 3 * i), 0, exact);
  }
}

}  // namespace
}  // namespace probewright::testing_support
