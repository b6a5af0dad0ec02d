#include <map>

#include "cycles_heidenhain/worlds.hpp"
#include "machine/rotary_solver.hpp"

/// Cycles 1410, 1411 and 1420: misalignment of an edge, of two circles, of a plane; texts, tolerances, transfer.
namespace probewright::testing_support {
namespace {

constexpr int worlds = 100;
constexpr double exact = 1e-6;

/// A part and the coordinates that are active when a cycle begins: the preset, a datum shift and a rotation.
struct Place {
  Bench bench;
  Pose machineFromPreset = Pose::Identity();
  Pose machineFromInput = Pose::Identity();
  Pose machineFromPart = Pose::Identity();
  Vector3 nominal = Vector3::Zero();  ///< of the part's origin, in the input coordinates
  double skew = 0;
  double ball = 0;
  std::string before = {};  ///< blocks that make the input coordinates active

  Pose inputFromPart() const { return machineFromInput.inverse() * machineFromPart; }
};

Place placeAt(Dice& dice, double misplaced, double skewed, const std::string& machine = "mill3") {
  Place place{Bench(ControlKind::TNC640, machine)};
  const double rotation = dice.coin() ? 0 : written(dice.between(-40, 40));
  const Vector3 origin(written(dice.between(-80, 80), 4), written(dice.between(-60, 60), 4),
                       written(dice.between(-420, -380), 4));
  place.machineFromPreset = pose(origin, {0, 0, rotation});
  place.bench.preset(1, origin, rotation);
  place.machineFromInput = place.machineFromPreset;
  if (dice.coin()) {
    const Vector3 shift(written(dice.between(-20, 20)), written(dice.between(-20, 20)), written(dice.between(-5, 5)));
    const double turn = written(dice.between(-60, 60));
    place.before = fmt::format(
        "CYCL DEF 7.0 SHIFT\nCYCL DEF 7.1 X{:+.3f}\nCYCL DEF 7.2 Y{:+.3f}\nCYCL DEF 7.3 Z{:+.3f}\n"
        "CYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 ROT{:+.3f}\n",
        shift.x(), shift.y(), shift.z(), turn);
    place.machineFromInput = place.machineFromPreset * pose(shift, {0, 0, turn});
  }
  place.bench.believedProbe().maximumTravel = 70;
  place.ball = written(dice.between(1, 3), 4);
  place.bench.probeOf(written(dice.between(80, 140)), place.ball);
  place.nominal = {written(dice.between(-40, 40)), written(dice.between(-40, 40)), written(dice.between(-20, 20))};
  place.skew = dice.between(-skewed, skewed);
  place.machineFromPart = place.machineFromInput * pose(place.nominal + dice.within(misplaced), {0, 0, place.skew});
  return place;
}

Words common(Dice& dice, const Place& place) {
  return {{320, dice.coin() ? 0 : written(dice.between(0, 3))},
          {260, place.nominal.z() + 30},
          {1125, dice.whole(-1, 2)},
          {309, 0},
          {1126, 0},
          {1120, 0},
          {1121, 0}};
}

/// Where the ball, moving along `axis`, meets a plane through `point` with the outward normal `normal`, all in one
/// system: the point that a control takes for the touch, a ball radius further along the probing direction.
Vector3 touchOnPlane(const Vector3& start, int axis, double sign, const Vector3& point, const Vector3& normal,
                     double ball) {
  Vector3 centre = start;
  Vector3 rest = start - point;
  rest[axis] = 0;
  centre[axis] = point[axis] + (ball - normal.dot(rest)) / normal[axis];
  centre[axis] += sign * ball;
  return centre;
}

/// An edge of a block, probed along `axis` in the direction `sign`.
struct Edge {
  int axis = 0;
  int sign = 1;
  std::array<Vector3, 2> nominal;   ///< in the input coordinates
  std::array<Vector3, 2> expected;  ///< what touches at the nominal places find
  Words words() const {
    return {{1100, nominal[0].x()}, {1101, nominal[0].y()}, {1102, nominal[0].z()},  {1103, nominal[1].x()},
            {1104, nominal[1].y()}, {1105, nominal[1].z()}, {372, sign * (axis + 1)}};
  }
};

Edge layEdge(Dice& dice, Place& place) {
  Edge edge;
  edge.axis = dice.whole(0, 1);
  edge.sign = dice.coin() ? 1 : -1;
  place.bench.believedProbe().setUpClearance = 8;
  const Vector2 half(dice.between(50, 70), dice.between(50, 70));
  place.bench.part(simulation::Box({-half.x(), -half.y(), -40}, {half.x(), half.y(), 0}), place.machineFromPart);
  Vector3 normal = Vector3::Zero();
  normal[edge.axis] = -edge.sign;
  const Pose inputFromPart = place.inputFromPart();
  const double depth = -written(dice.between(6, 12));
  const double ends[] = {-25, 28};
  const bool swapped = dice.coin();
  for (std::size_t i = 0; i < 2; ++i) {
    Vector3 onFace(0, 0, depth);
    onFace[edge.axis] = -edge.sign * half[edge.axis];
    onFace[1 - edge.axis] = ends[swapped ? 1 - i : i];
    edge.nominal[i] = (place.nominal + onFace).unaryExpr([](double v) { return written(v); });
    edge.expected[i] = touchOnPlane(edge.nominal[i], edge.axis, edge.sign, inputFromPart * onFace,
                                    inputFromPart.linear() * normal, place.ball);
  }
  return edge;
}

/// The preset has turned by `rotation` in the working plane, and the touched place reads what it should.
void expectTransfer(const Ran& ran, const Place& place, const Matrix3& rotation, const Vector3& actual,
                    const Vector3& wanted) {
  const Pose inputFromPreset = place.machineFromInput.inverse() * place.machineFromPreset;
  const Pose found = ran.preset() * inputFromPreset.inverse();
  EXPECT_TRUE(found.linear().isApprox(place.machineFromInput.linear() * rotation, 1e-9));
  EXPECT_LT((found.inverse() * (place.machineFromInput * actual) - wanted).norm(), exact);
}

Matrix3 aboutZ(double degreesTurned) { return pose(Vector3::Zero(), {0, 0, degreesTurned}).linear(); }

TEST(Cycle1410, FindsTheMisalignmentOfAnyEdge) {
  Dice dice(1410);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    Place place = placeAt(dice, 1, 8);
    const Edge edge = layEdge(dice, place);
    const int position = dice.whole(0, 3);
    const int rotation = dice.whole(0, 1);
    const Words words = with(with(edge.words(), common(dice, place)), {{1120, position}, {1121, rotation}});
    const Ran ran = place.bench.run(place.before + probe(1410, words));
    ASSERT_TRUE(ran.finished()) << ran.why();
    for (int i = 0; i < 2; ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        const auto& expected = edge.expected[static_cast<std::size_t>(i)];
        const auto& nominal = edge.nominal[static_cast<std::size_t>(i)];
        EXPECT_NEAR(ran.q(950 + 3 * i + axis), expected[axis], exact);
        EXPECT_NEAR(ran.q(980 + 3 * i + axis), expected[axis] - nominal[axis], exact);
      }
    }
    const Vector3 along = edge.nominal[1] - edge.nominal[0];
    EXPECT_NEAR(ran.q(994), place.skew, exact);
    EXPECT_NEAR(std::remainder(ran.q(964) - degrees(std::atan2(along.y(), along.x())) - place.skew, 360), 0, exact);
    EXPECT_EQ(ran.q(183), -1);
    if (position == 0) {
      const Matrix3 turned =
          place.machineFromInput.linear() * aboutZ(rotation * place.skew) * place.machineFromInput.linear().transpose();
      EXPECT_TRUE(ran.preset().linear().isApprox(turned * place.machineFromPreset.linear(), 1e-9));
      EXPECT_LT((ran.preset().translation() - place.machineFromPreset.translation()).norm(), exact);
      continue;
    }
    const auto chosen = [&](const std::array<Vector3, 2>& points) -> Vector3 {
      return position == 3 ? Vector3((points[0] + points[1]) / 2) : points[static_cast<std::size_t>(position - 1)];
    };
    expectTransfer(ran, place, aboutZ(rotation * place.skew), chosen(edge.expected), chosen(edge.nominal));
    EXPECT_EQ(ran.outcome.files.count("TCHPRAUTO.html"), 1U);
  }
}

TEST(Cycle1410, AsksTheOperatorForPlacesThatAreNotKnown) {
  Dice dice(14101);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    Place place = placeAt(dice, 5, 12);
    const Edge edge = layEdge(dice, place);
    // The operator sees where the part truly lies and stands some mm in front of its edge.
    std::map<std::string, std::string> answers;
    std::array<Vector3, 2> stands;
    std::array<Vector3, 2> found;
    const Vector3 normal = place.inputFromPart().linear() * (-edge.sign * Vector3::Unit(edge.axis));
    for (int i = 0; i < 2; ++i) {
      const Vector3 middle = place.inputFromPart().translation();
      const Vector3 face = edge.expected[static_cast<std::size_t>(i)];
      Vector3 along = place.inputFromPart().linear() * Vector3::Unit(1 - edge.axis);
      stands[static_cast<std::size_t>(i)] = face + normal * (place.ball + 8) + along * dice.between(-3, 3);
      stands[static_cast<std::size_t>(i)].z() = middle.z() - 9;
      const Vector3 tip = stands[static_cast<std::size_t>(i)] - Vector3(0, 0, place.ball);
      const auto text = [](const Vector3& p) { return fmt::format("{:.9f} {:.9f} {:.9f}", p.x(), p.y(), p.z()); };
      const Vector3 high(tip.x(), tip.y(), tip.z() + 40);
      answers[fmt::format("1410 point {}", i + 1)] = text(high) + "; " + text(tip);
      answers[fmt::format("1410 point {} away", i + 1)] = text(high);
      found[static_cast<std::size_t>(i)] = touchOnPlane(
          stands[static_cast<std::size_t>(i)], edge.axis, edge.sign,
          face - edge.sign * place.ball * Vector3::Unit(edge.axis) - normal * place.ball, normal, place.ball);
    }
    place.bench.answer = [&](const std::string& question) -> std::optional<std::string> {
      const auto reply = answers.find(question);
      return reply == answers.end() ? std::nullopt : std::optional(reply->second);
    };
    const int position = dice.whole(1, 3);
    const Words words = with(with({{372, edge.sign * (edge.axis + 1)}}, common(dice, place)),
                             {{1120, position}, {1121, 1}, {1125, dice.whole(1, 2)}});
    std::string texts;
    for (int i = 0; i < 2; ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        const std::string value =
            axis == edge.axis ? fmt::format("?{:.3f}", edge.nominal[static_cast<std::size_t>(i)][axis]) : "?";
        texts += fmt::format(" ~\n  QS{}= \"{}\" ;NOMINAL", 1100 + 3 * i + axis, value);
      }
    }
    const Ran ran = place.bench.run(place.before + probe(1410, words, texts));
    ASSERT_TRUE(ran.finished()) << ran.why();
    std::array<Vector3, 2> wanted = found;
    for (int i = 0; i < 2; ++i) {
      const auto at = static_cast<std::size_t>(i);
      wanted[at][edge.axis] = edge.nominal[at][edge.axis];
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(ran.q(950 + 3 * i + axis), found[at][axis], exact);
        EXPECT_NEAR(ran.q(980 + 3 * i + axis), found[at][axis] - wanted[at][axis], exact);
      }
    }
    EXPECT_NEAR(ran.q(994), place.skew, exact);
    const auto chosen = [&](const std::array<Vector3, 2>& points) -> Vector3 {
      return position == 3 ? Vector3((points[0] + points[1]) / 2) : points[static_cast<std::size_t>(position - 1)];
    };
    expectTransfer(ran, place, aboutZ(place.skew), chosen(found), chosen(wanted));
    const auto stops =
        std::ranges::count(ran.outcome.journal.events, control::EventKind::Stop, &control::EventRecord::kind);
    EXPECT_EQ(stops, 4);
  }
}

/// Two holes or studs about the part's origin.
struct Circles {
  int geometry = 0;
  std::array<Vector3, 2> nominal, centre;  ///< in the input coordinates
  std::array<double, 2> diameter{};
  Words words(Dice& dice) const {
    const double span = dice.coin() ? 360 : written(dice.between(130, 300));
    return {{1100, nominal[0].x()},
            {1101, nominal[0].y()},
            {1102, nominal[0].z()},
            {1116, written(diameter[0] + dice.between(-0.5, 0.5))},
            {1103, nominal[1].x()},
            {1104, nominal[1].y()},
            {1105, nominal[1].z()},
            {1117, written(diameter[1] + dice.between(-0.5, 0.5))},
            {1115, geometry},
            {423, dice.whole(3, 8)},
            {325, written(dice.between(-360, 360))},
            {1119, span == 360 ? 360 : (dice.coin() ? 1 : -1) * span}};
  }
};

Circles layCircles(Dice& dice, Place& place) {
  Circles circles;
  circles.geometry = dice.whole(0, 3);
  const Pose inputFromPart = place.inputFromPart();
  for (std::size_t i = 0; i < 2; ++i) {
    const bool stud = circles.geometry == 1 || (circles.geometry == 2 && i == 1) || (circles.geometry == 3 && i == 0);
    const Vector3 local(i == 0 ? -60 : 60, dice.between(-30, 30), 0);
    circles.diameter[i] = dice.between(2 * place.ball + 6, 40);
    if (stud) {
      place.bench.part(simulation::RoundBar(circles.diameter[i] / 2, -40, 0), place.machineFromPart * pose(local));
    } else {
      place.bench.part(simulation::Ring(circles.diameter[i] / 2, circles.diameter[i] / 2 + 10, -40),
                       place.machineFromPart * pose(local));
    }
    circles.centre[i] = inputFromPart * local;
    circles.nominal[i] = (place.nominal + local + Vector3(0, 0, -8)).unaryExpr([](double v) { return written(v); });
    circles.centre[i].z() = circles.nominal[i].z();
  }
  return circles;
}

double angleBetween(const std::array<Vector3, 2>& points) {
  const Vector3 along = points[1] - points[0];
  return degrees(std::atan2(along.y(), along.x()));
}

TEST(Cycle1411, FindsTheMisalignmentOfAnyTwoCircles) {
  Dice dice(1411);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    Place place = placeAt(dice, 0.8, 0.3);
    const Circles circles = layCircles(dice, place);
    const int position = dice.whole(0, 3);
    const int rotation = dice.whole(0, 1);
    const Words words = with(with(circles.words(dice), common(dice, place)),
                             {{1120, position}, {1121, rotation}, {1125, dice.whole(1, 2)}});
    const Ran ran = place.bench.run(place.before + probe(1411, words));
    ASSERT_TRUE(ran.finished()) << ran.why();
    for (int i = 0; i < 2; ++i) {
      const auto at = static_cast<std::size_t>(i);
      for (int axis = 0; axis < 2; ++axis) {
        EXPECT_NEAR(ran.q(950 + 3 * i + axis), circles.centre[at][axis], exact);
        EXPECT_NEAR(ran.q(980 + 3 * i + axis), circles.centre[at][axis] - circles.nominal[at][axis], exact);
      }
      EXPECT_NEAR(ran.q(966 + i), circles.diameter[at], exact);
    }
    const double turned = std::remainder(angleBetween(circles.centre) - angleBetween(circles.nominal), 360);
    EXPECT_NEAR(ran.q(964), angleBetween(circles.centre), exact);
    EXPECT_NEAR(ran.q(994), turned, exact);
    EXPECT_EQ(ran.q(183), -1);
    if (position == 0) continue;
    const auto chosen = [&](const std::array<Vector3, 2>& points) -> Vector3 {
      return position == 3 ? Vector3((points[0] + points[1]) / 2) : points[static_cast<std::size_t>(position - 1)];
    };
    expectTransfer(ran, place, aboutZ(rotation * turned), chosen(circles.centre), chosen(circles.nominal));
  }
}

TEST(Cycle1411, MonitorsDiametersAndCentres) {
  Dice dice(14111);
  int states[4] = {0, 0, 0, 0};
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    Place place = placeAt(dice, 0.2, 0.1);
    Circles circles = layCircles(dice, place);
    const double nominal = written(circles.diameter[0] + dice.between(-0.3, 0.3), 2);
    const double low = -0.2, high = 0.1;
    Words words = with(circles.words(dice), common(dice, place));
    words = with(words, {{1125, 1}, {309, dice.whole(0, 2)}});
    const double reaction = std::ranges::find(words, 309, &std::pair<int, double>::first)->second;
    std::erase_if(words, [](const auto& word) { return word.first == 1116 || word.first == 1100; });
    const double width = written(dice.between(0.05, 0.4), 3);
    const std::string texts = fmt::format(" ~\n  QS1116=\"{:.2f}-0,2+0.1\" ;D ~\n  QS1100=\"{:.3f}+-{:.3f}\" ;X",
                                          nominal, circles.nominal[0].x(), width);
    const Ran ran = place.bench.run(place.before + probe(1411, words, texts));
    ASSERT_TRUE(ran.finished()) << ran.why();
    const double size = circles.diameter[0] - nominal;
    const bool stud = circles.geometry == 1 || circles.geometry == 3;
    int state = 0;
    if (size > high) state = stud ? 1 : 2;
    if (size < low) state = stud ? 2 : 1;
    if (std::abs(circles.centre[0].x() - circles.nominal[0].x()) > width) state = 2;
    ++states[state];
    EXPECT_EQ(ran.q(183), state);
    EXPECT_NEAR(ran.q(996), size - (low + high) / 2, exact);
    const auto stops =
        std::ranges::count(ran.outcome.journal.events, control::EventKind::Stop, &control::EventRecord::kind);
    const bool asked = (reaction == 1 && state > 0) || (reaction == 2 && state == 2);
    EXPECT_EQ(stops, asked ? 1 : 0);
  }
  EXPECT_GT(states[0], 5);
  EXPECT_GT(states[1], 5);
  EXPECT_GT(states[2], 5);
}

/// A plane tilted by up to `tilt` degrees about X and Y of the input coordinates, probed along the tool axis.
struct Tilted {
  Vector3 normal = Vector3::UnitZ();  ///< in the input coordinates
  std::array<Vector3, 3> nominal, expected;
  Words words() const {
    Words all;
    for (int i = 0; i < 3; ++i) {
      for (int axis = 0; axis < 3; ++axis)
        all.emplace_back(1100 + 3 * i + axis, nominal[static_cast<std::size_t>(i)][axis]);
    }
    all.emplace_back(372, -3);
    return all;
  }
};

Tilted layPlane(Dice& dice, Place& place, double tilt) {
  place.bench.believedProbe().setUpClearance = 10;
  Tilted plane;
  plane.normal = pose(Vector3::Zero(), {dice.between(-tilt, tilt), dice.between(-tilt, tilt), 0}).linear().col(2);
  const Vector3 through = place.inputFromPart().translation();
  place.bench.part(
      simulation::HalfSpace({place.machineFromInput * through, place.machineFromInput.linear() * plane.normal}));
  const Vector2 places[] = {{-30, -25}, {35, -20}, {dice.between(-20, 20), 30}};
  for (std::size_t i = 0; i < 3; ++i) {
    plane.nominal[i] =
        (place.nominal + Vector3(places[i].x(), places[i].y(), 0)).unaryExpr([](double v) { return written(v); });
    plane.expected[i] = touchOnPlane(plane.nominal[i], 2, -1, through, plane.normal, place.ball);
  }
  return plane;
}

/// Space angles about X and Y that turn Z to `normal`.
Matrix3 turnTo(const Vector3& normal) {
  return pose(Vector3::Zero(), {degrees(std::asin(-normal.y())), degrees(std::atan2(normal.x(), normal.z())), 0})
      .linear();
}

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
  }
}

/// Where the tool points in the table as it lies when all rotary axes stand at 0.
Vector3 toolOnTable(const Ran& ran) {
  const auto& machine = ran.outcome.machine->description();
  return machine::toolOrientation(machine, {}, ran.outcome.machine->position()).col(2);
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

TEST(Cycle1411, AlignsTheRotaryTable) {
  Dice dice(14112);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    Place place = placeAt(dice, 0.8, 0.3, dice.coin() ? "mill5-table-table" : "mill5-head-table");
    place.before.clear();
    const Pose inputFromPart = place.inputFromPart();
    place.machineFromInput = place.machineFromPreset;
    place.machineFromPart = place.machineFromPreset * inputFromPart;
    const Circles circles = layCircles(dice, place);
    const int rotation = dice.whole(1, 2);
    const Words words = with(with(circles.words(dice), common(dice, place)),
                             {{1120, dice.whole(1, 3)}, {1121, rotation}, {1126, dice.whole(1, 2)}, {1125, 2}});
    // Measured again, the rotation is gone and what was transferred stands where it should.
    const Ran once = place.bench.run(probe(1411, words));
    ASSERT_TRUE(once.finished()) << once.why();
    const double turned = std::remainder(angleBetween(circles.centre) - angleBetween(circles.nominal), 360);
    EXPECT_NEAR(once.q(994), turned, exact);
    // C turns the workpiece against its own count.
    EXPECT_NEAR(once.q(995), -turned, exact);
    const std::size_t axis = *once.outcome.machine->description().axisIndex("C");
    EXPECT_NEAR(std::remainder(once.outcome.machine->position()[axis] - turned, 360), 0, exact);
    if (rotation == 2) {
      EXPECT_NEAR(once.cell("PRESET.PR", "1", "C_OFFS"), turned, 1e-4);
    }
    const Ran twice = place.bench.run(probe(1411, words) + probe(1411, with(words, {{1126, 0}, {1121, 0}})));
    ASSERT_TRUE(twice.finished()) << twice.why();
    EXPECT_NEAR(twice.q(994), 0, exact);
    const double position = std::ranges::find(words, 1120, &std::pair<int, double>::first)->second;
    for (int i = 0; i < 2; ++i) {
      if (position != i + 1) continue;
      EXPECT_NEAR(twice.q(980 + 3 * i), 0, exact);
      EXPECT_NEAR(twice.q(981 + 3 * i), 0, exact);
    }
  }
}

TEST(Cycle1410, TurnsTheBasicRotationInATiltedPlane) {
  Dice dice(14102);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    Bench bench(ControlKind::TNC640, "mill5-head-table");
    const Vector3 origin(written(dice.between(-60, 60)), written(dice.between(-60, 60)), -500);
    const double rotation = written(dice.between(-20, 20));
    bench.preset(1, origin, rotation);
    const double tilt = written(dice.between(-25, 25)), turn = written(dice.between(-25, 25));
    const Pose preset = pose(origin, {0, 0, rotation});
    // The table stands at 0 when the preset counts; the tilted plane goes with the workpiece.
    const Pose input = preset * pose(Vector3::Zero(), {turn, tilt, 0});
    const double skew = dice.between(-4, 4);
    const Pose part = input * pose(dice.within(1), {0, 0, skew});
    bench.believedProbe().maximumTravel = 40;
    bench.believedProbe().setUpClearance = 8;
    bench.part(simulation::Box({-50, -50, -30}, {50, 50, 0}), part);
    const Words words = with(Words{{1100, -30},
                                   {1101, -50},
                                   {1102, -8},
                                   {1103, 30},
                                   {1104, -50},
                                   {1105, -8},
                                   {372, 2},
                                   {320, 0},
                                   {260, 20},
                                   {1125, 1},
                                   {309, 0},
                                   {1126, 0},
                                   {1120, 0},
                                   {1121, 0}},
                             {{1120, 1}, {1121, 1}, {1125, 1}, {260, 30}});
    const std::string plane =
        fmt::format("L Z+0 R0 FMAX M91\nPLANE SPATIAL SPA{:+.3f} SPB{:+.3f} SPC+0 TURN FMAX\n", turn, tilt);
    const Ran ran = bench.run(plane + probe(1410, words) + probe(1410, with(words, {{1120, 0}, {1121, 0}})));
    ASSERT_TRUE(ran.finished()) << ran.why();
    // The second run finds the edge parallel; the axes of the tilted plane are now those of the part.
    EXPECT_NEAR(ran.q(994), 0, exact);
    const Matrix3 tilted = ran.preset().linear() * pose(Vector3::Zero(), {turn, tilt, 0}).linear();
    EXPECT_TRUE(tilted.isApprox(part.linear(), 1e-9));
    EXPECT_NEAR(ran.outcome.journal.cycles.front().results[14].value, skew, exact);
  }
}

TEST(Cycle1410, ComputesWithActualPositionsWithoutProbing) {
  Bench bench;
  bench.preset(1, {10, 20, -400}, 0);
  const std::string blocks =
      "Q1900 = -10.05\n"
      "TCH PROBE 1410 EDGE ~\n  QS1100= \"10+0.02@10.0123\" ;A ~\n  QS1101=\"50@50.0321\" ;B ~\n"
      "  QS1102= \"-10-0.2+0.02@Q1900\" ;C ~\n  QS1103=\"60@60\" ;D ~\n  QS1104=\"50@50.5321\" ;E ~\n"
      "  QS1105=\"-10@-10\" ;F ~\n  Q372=+2 ;DIR ~\n  Q320=+0 ~\n  Q260=+100 ~\n  Q1125=+2 ~\n  Q309=+1 ~\n"
      "  Q1126=+0 ~\n  Q1120=+1 ~\n  Q1121=+1\n";
  const Ran ran = bench.run(blocks);
  ASSERT_TRUE(ran.finished()) << ran.why();
  EXPECT_EQ(ran.touches(), 0U);
  EXPECT_NEAR(ran.q(950), 10.0123, exact);
  EXPECT_NEAR(ran.q(980), 10.0123 - 10.01, exact);
  EXPECT_NEAR(ran.q(981), 0.0321, exact);
  EXPECT_NEAR(ran.q(982), -10.05 + 10.09, exact);
  EXPECT_EQ(ran.q(183), 0);
  const double angle = degrees(std::atan2(0.5, 60 - 10.0123));
  EXPECT_NEAR(ran.q(964), angle, exact);
  EXPECT_NEAR(ran.cell("PRESET.PR", "1", "SPC"), ran.q(994), 1e-4);
  EXPECT_LT((ran.seen({20.0123, 70.0321, -410.05}) - Vector3(10.01, 50, -10.09)).norm(), exact);
}

TEST(RotationCycles, TakeTheSameValuesInInch) {
  const auto run = [](const std::string& unit, double factor) {
    Bench bench;
    bench.preset(1, {0, 0, -400}, 0);
    bench.part(simulation::Box({-50, -50, -40}, {50, 50, 0}), pose({0.3, -0.2, -400}, {0, 0, 2}));
    const Words words = {{1100, -30 / factor},
                         {1102, -8 / factor},
                         {1103, 30 / factor},
                         {1105, -8 / factor},
                         {372, 2},
                         {320, 0},
                         {260, 30 / factor},
                         {1125, 1},
                         {309, 0},
                         {1126, 0},
                         {1120, 1},
                         {1121, 1}};
    return bench.run(probe(1410, words,
                           fmt::format(" ~\n QS1101=\"{0:.6f}+{1:.6f}\" ~\n QS1104=\"{0:.6f}+{1:.6f}\"", -50 / factor,
                                       5.08 / factor)),
                     unit);
  };
  const Ran metric = run("MM", 1);
  const Ran inch = run("INCH", 25.4);
  ASSERT_TRUE(metric.finished()) << metric.why();
  ASSERT_TRUE(inch.finished()) << inch.why();
  EXPECT_NEAR(metric.q(994), 2, exact);
  EXPECT_NEAR(inch.q(994), 2, 1e-5);
  EXPECT_NEAR(inch.q(981) * 25.4, metric.q(981), 1e-4);
  EXPECT_NEAR(inch.q(951) * 25.4, metric.q(951), 1e-4);
}

/// The ways in which printed programs write the parameters.
TEST(Cycle1411, ReadsBlocksAsTheyArePrinted) {
  Bench bench;
  bench.preset(1, {0, 0, -400}, 0);
  bench.part(simulation::Ring(4.65, 15, -20), pose({30, 50.01, -400}));
  bench.part(simulation::Ring(4.4, 15, -20), pose({75, 50, -400}));
  const Ran ran = bench.run(
      "TCH PROBE 1411 TWO CIRCLES\n  Q1100=+30 ;1ST POINT\n  Q1101= +50 ;1ST POINT\n  Q1102= -5 ;1ST POINT\n"
      "  QS1116=\"+10-1-0.5\";DIAMETER 1\n  Q1103= +75 ;2ND POINT\n  Q1104=+50 ;2ND POINT\n  QS1105= -5 ;2ND POINT\n"
      "  QS1117=\"+10-1-0,5\";DIAMETER 2\n  Q1115=0 ;GEOMETRY\n  Q423=4 ;POINTS\n  Q325=+0 ;ANGLE\n"
      "  Q1119=+360;LENGTH\n  Q320=+0 ;CLEARANCE\n  Q260=+100 ;HEIGHT\n  Q1125=+2 ;MODE\n  Q309=+2 ;REACTION\n"
      "  Q1126=+0 ;ALIGN\n  Q1120=+0 ;TRANSFER\n  Q1121=+0 ;ROTATION\n");
  ASSERT_TRUE(ran.finished()) << ran.why();
  EXPECT_NEAR(ran.q(966), 9.3, exact);
  EXPECT_NEAR(ran.q(996), 0.05, exact);
  EXPECT_NEAR(ran.q(967), 8.8, exact);
  EXPECT_NEAR(ran.q(997), -0.45, exact);
  // Too small a hole can be reworked: Q309 = 2 lets it pass.
  EXPECT_EQ(ran.q(183), 1);
}

TEST(Cycle1411, ReducesTheClearanceInSmallHoles) {
  Bench bench;
  bench.preset(1, {0, 0, -400}, 0);
  bench.part(simulation::Ring(3.5, 20, -40), pose({-40, 0, -400}));
  bench.part(simulation::Ring(3.5, 20, -40), pose({40, 0.5, -400}));
  const Words words = {{1100, -40}, {1101, 0}, {1102, -8}, {1116, 7}, {1103, 40},  {1104, 0}, {1105, -8},
                       {1117, 7},   {1115, 0}, {423, 4},   {325, 0},  {1119, 360}, {320, 2},  {260, 20},
                       {1125, 1},   {309, 0},  {1126, 0},  {1120, 0}, {1121, 0}};
  const Ran ran = bench.run(probe(1411, words));
  ASSERT_TRUE(ran.finished()) << ran.why();
  EXPECT_NEAR(ran.q(954), 0.5, exact);
  const auto stops =
      std::ranges::count(ran.outcome.journal.events, control::EventKind::Stop, &control::EventRecord::kind);
  EXPECT_EQ(stops, 2);
  const Ran tooSmall = bench.run(probe(1411, with(words, {{1117, 3}})));
  EXPECT_EQ(tooSmall.alarm(), "Hole too small");
}

std::string spoken(const Vector3& tip) { return fmt::format("{:.9f} {:.9f} {:.9f}", tip.x(), tip.y(), tip.z()); }

/// An operator who knows the answers, and nothing else.
std::function<std::optional<std::string>(const std::string&)> operatorWith(std::map<std::string, std::string> answers) {
  return [answers = std::move(answers)](const std::string& question) -> std::optional<std::string> {
    const auto reply = answers.find(question);
    return reply == answers.end() ? std::nullopt : std::optional(reply->second);
  };
}

/// The words without `first` to `last`, which stand as texts "?value" instead.
std::string asTexts(Words& words, const std::vector<int>& parameters) {
  std::string texts;
  for (const int parameter : parameters) {
    const auto found = std::ranges::find(words, parameter, &std::pair<int, double>::first);
    texts += fmt::format(" ~\n  QS{}= \"?{:.6f}\" ;NOMINAL", parameter, found->second);
    words.erase(found);
  }
  return texts;
}

TEST(Cycle1411, AsksTheOperatorForTheObjects) {
  Dice dice(14113);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    Place place = placeAt(dice, 5, 15);
    const Circles circles = layCircles(dice, place);
    std::map<std::string, std::string> answers;
    for (std::size_t i = 0; i < 2; ++i) {
      const bool stud = circles.geometry == 1 || (circles.geometry == 2 && i == 1) || (circles.geometry == 3 && i == 0);
      const double top = place.inputFromPart().translation().z();
      Vector3 tip = circles.centre[i] + Vector3(dice.between(-0.3, 0.3), dice.between(-0.3, 0.3), 0);
      const Vector3 high(tip.x(), tip.y(), top + 30);
      tip.z() = stud ? top + 4 : top - 9;
      answers[fmt::format("1411 object {}", i + 1)] = spoken(high) + "; " + spoken(tip);
      answers[fmt::format("1411 object {} away", i + 1)] = spoken(high);
    }
    place.bench.answer = operatorWith(answers);
    Words words = with(with(circles.words(dice), common(dice, place)),
                       {{1120, dice.whole(1, 2)}, {1121, 1}, {1125, dice.whole(1, 2)}, {320, 1}});
    const double position = std::ranges::find(words, 1120, &std::pair<int, double>::first)->second;
    std::erase_if(words, [](const auto& word) { return word.first == 1102 || word.first == 1105; });
    const std::string texts = asTexts(words, {1100, 1101, 1103, 1104}) + " ~\n  QS1102= \"?\" ;Z ~\n  QS1105= \"?\" ;Z";
    const Ran ran = place.bench.run(place.before + probe(1411, words, texts));
    ASSERT_TRUE(ran.finished()) << ran.why();
    const double turned = std::remainder(angleBetween(circles.centre) - angleBetween(circles.nominal), 360);
    EXPECT_NEAR(ran.q(994), turned, exact);
    for (int i = 0; i < 2; ++i) {
      const auto at = static_cast<std::size_t>(i);
      for (int axis = 0; axis < 2; ++axis)
        EXPECT_NEAR(ran.q(950 + 3 * i + axis), circles.centre[at][axis], exact);
      EXPECT_NEAR(ran.q(982 + 3 * i), 0, exact);
      EXPECT_NEAR(ran.q(966 + i), circles.diameter[at], exact);
    }
    // The chosen centre reads its nominal place, the other lies on the line to it.
    const auto chosen = static_cast<std::size_t>(position - 1);
    Vector3 wanted = circles.nominal[chosen];
    Vector3 actual = circles.centre[chosen];
    wanted.z() = actual.z() = ran.q(952 + 3 * static_cast<int>(chosen));
    expectTransfer(ran, place, aboutZ(turned), actual, wanted);
  }
}

TEST(Cycle1420, AsksTheOperatorForTheThreePoints) {
  Dice dice(14202);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    Place place = placeAt(dice, 5, 0);
    const Tilted plane = layPlane(dice, place, 5);
    const Vector3 through = place.inputFromPart().translation();
    std::map<std::string, std::string> answers;
    std::array<Vector3, 3> found;
    for (std::size_t i = 0; i < 3; ++i) {
      Vector3 stands = plane.expected[i] + Vector3(dice.between(-4, 4), dice.between(-4, 4), place.ball + 12);
      answers[fmt::format("1420 point {}", i + 1)] = spoken(stands - Vector3(0, 0, place.ball));
      found[i] = touchOnPlane(stands, 2, -1, through, plane.normal, place.ball);
    }
    place.bench.answer = operatorWith(answers);
    Words words = with(with(plane.words(), common(dice, place)), {{1120, 1}, {1121, 1}, {1125, dice.whole(-1, 0)}});
    const std::string texts = asTexts(words, {1100, 1101, 1102, 1103, 1104, 1105, 1106, 1107, 1108});
    const Ran ran = place.bench.run(place.before + probe(1420, words, texts));
    ASSERT_TRUE(ran.finished()) << ran.why();
    for (int i = 0; i < 3; ++i) {
      const auto at = static_cast<std::size_t>(i);
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(ran.q(950 + 3 * i + axis), found[at][axis], exact);
      EXPECT_NEAR(ran.q(980 + 3 * i), 0, exact);
      EXPECT_NEAR(ran.q(981 + 3 * i), 0, exact);
      EXPECT_NEAR(ran.q(982 + 3 * i), found[at].z() - plane.nominal[at].z(), exact);
    }
    EXPECT_LT((ran.preset().linear().col(2) - place.machineFromInput.linear() * plane.normal).norm(), 1e-9);
    Vector3 wanted = found[0];
    wanted.z() = plane.nominal[0].z();
    expectTransfer(ran, place, turnTo(plane.normal), found[0], wanted);
  }
}

TEST(RotationCycles, AskAgainInLaterCalls) {
  Bench bench;
  bench.preset(1, {0, 0, -400}, 0);
  bench.part(simulation::HalfSpace({Vector3(0, 0, -400), Vector3::UnitZ()}));
  std::vector<std::string> asked;
  bench.answer = [&](const std::string& question) -> std::optional<std::string> {
    asked.push_back(question);
    return std::to_string(10 * asked.size()) + (asked.size() % 3 == 0 ? ",30,8" : ",0,8");
  };
  const std::string block =
      probe(1420, {{372, -3}, {320, 0}, {260, 20}, {1125, 0}, {309, 0}, {1126, 0}, {1120, 0}, {1121, 0}},
            " ~\n QS1100=\"?10\" ~\n QS1101=\"?0\" ~\n QS1102=\"?0\" ~\n QS1103=\"?20\" ~\n QS1104=\"?0\""
            " ~\n QS1105=\"?0\" ~\n QS1106=\"?30\" ~\n QS1107=\"?30\" ~\n QS1108=\"?0\"");
  const Ran ran = bench.run(block + block);
  ASSERT_TRUE(ran.finished()) << ran.why();
  const std::vector<std::string> expected = {"1420 point 1",        "1420 point 2",        "1420 point 3",
                                             "1420 call 2 point 1", "1420 call 2 point 2", "1420 call 2 point 3"};
  EXPECT_EQ(asked, expected);
}

TEST(RotationCycles, RefuseAnswersThatAreNoPositions) {
  Bench bench;
  bench.preset(1, {0, 0, -400}, 0);
  bench.answer = [](const std::string&) -> std::optional<std::string> { return "over there"; };
  const Ran ran = bench.run(probe(1410,
                                  {{1100, 0},
                                   {1102, 0},
                                   {1103, 9},
                                   {1104, 0},
                                   {1105, 0},
                                   {372, 2},
                                   {320, 0},
                                   {260, 20},
                                   {1125, 1},
                                   {309, 0},
                                   {1126, 0},
                                   {1120, 0},
                                   {1121, 0}},
                                  " ~\n QS1101=\"?0\""));
  EXPECT_EQ(ran.alarm(), "Position of the probe wrong");
}

}  // namespace
}  // namespace probewright::testing_support
