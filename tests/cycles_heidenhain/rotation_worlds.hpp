#pragma once

#include "cycles_heidenhain/worlds.hpp"

/// Worlds of cycles 1410, 1411 and 1420: a part under any coordinates, with an edge, two circles or a plane to be
/// found.
namespace probewright::testing_support {

inline constexpr int worlds = 100;
inline constexpr double exact = 1e-6;

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

inline Place placeAt(Dice& dice, double misplaced, double skewed, const std::string& machine = "mill3") {
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

inline Words common(Dice& dice, const Place& place) {
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
inline Vector3 touchOnPlane(const Vector3& start, int axis, double sign, const Vector3& point, const Vector3& normal,
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

inline Edge layEdge(Dice& dice, Place& place) {
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
inline void expectTransfer(const Ran& ran, const Place& place, const Matrix3& rotation, const Vector3& actual,
                           const Vector3& wanted) {
  const Pose inputFromPreset = place.machineFromInput.inverse() * place.machineFromPreset;
  const Pose found = ran.preset() * inputFromPreset.inverse();
  EXPECT_TRUE(found.linear().isApprox(place.machineFromInput.linear() * rotation, 1e-9));
  EXPECT_LT((found.inverse() * (place.machineFromInput * actual) - wanted).norm(), exact);
}

/// The position that Q1120 = `position` transfers: the first, the second, or the mean.
inline Vector3 chosen(int position, const std::array<Vector3, 2>& points) {
  return position == 3 ? Vector3((points[0] + points[1]) / 2) : points[static_cast<std::size_t>(position - 1)];
}

inline Matrix3 aboutZ(double degreesTurned) { return pose(Vector3::Zero(), {0, 0, degreesTurned}).linear(); }

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

inline Circles layCircles(Dice& dice, Place& place) {
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

inline double angleBetween(const std::array<Vector3, 2>& points) {
  const Vector3 along = points[1] - points[0];
  return degrees(std::atan2(along.y(), along.x()));
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

inline Tilted layPlane(Dice& dice, Place& place, double tilt) {
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
inline Matrix3 turnTo(const Vector3& normal) {
  return pose(Vector3::Zero(), {degrees(std::asin(-normal.y())), degrees(std::atan2(normal.x(), normal.z())), 0})
      .linear();
}

}  // namespace probewright::testing_support
