#include "cycles/sinumerik/kinematics_evaluation.hpp"

#include <algorithm>
#include <cmath>

namespace probewright::cycles::sinumerik {
namespace {

Vector3 turned(const Vector3& axis, double degrees, const Vector3& vector) {
  return rotation(axis, degrees).linear() * vector;
}

/// The part of `vector` at right angles to the unit vector `axis`.
Vector3 across(const Vector3& axis, const Vector3& vector) { return vector - axis * axis.dot(vector); }

/// `point` shifted along `axis` to where the normalisation wants it; nothing if the axis does not lead there.
std::optional<Vector3> normalised(const Vector3& point, const Vector3& axis, const Normalisation& wanted) {
  if (wanted.along < 0) return point;
  constexpr double leastShare = 1e-3;
  const double share = axis[wanted.along];
  if (std::abs(share) < leastShare) return std::nullopt;
  return Vector3(point + axis * ((wanted.value - point[wanted.along]) / share));
}

double angleAt(const Vector3& corner, const Vector3& a, const Vector3& b) {
  const Vector3 one = a - corner, other = b - corner;
  return degreesFromRadians(std::atan2(one.cross(other).norm(), one.dot(other)));
}

}  // namespace

std::optional<RotaryLine> rotaryLine(const RotaryAxisMeasurement& measured) {
  const auto& [p1, p2, p3] = measured.ball;
  const Vector3 a = p2 - p1, b = p3 - p1, normal = a.cross(b);
  constexpr double leastHeight = 1e-6;  // mm, of the triangle
  const double longest = std::max({a.norm(), b.norm(), (b - a).norm()});
  if (!(normal.norm() > leastHeight * longest)) return std::nullopt;
  RotaryLine line;
  line.centre = p1 + (a.squaredNorm() * b - b.squaredNorm() * a).cross(normal) / (2 * normal.squaredNorm());
  line.leastAngle = std::min({angleAt(p1, p2, p3), angleAt(p2, p3, p1), angleAt(p3, p1, p2)});
  // The angles say which way round the axis turns; the order of the places does not.
  double best = -1;
  for (const double sign : {1.0, -1.0}) {
    const Vector3 direction = sign * normal.normalized();
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3 expected = line.centre + turned(direction, measured.angle[i] - measured.angle[0], p1 - line.centre);
      sum += (expected - measured.ball[i]).squaredNorm();
    }
    if (best >= 0 && sum >= best) continue;
    best = sum;
    line.direction = direction;
  }
  line.residual = std::sqrt(best / 3);
  line.radius = turned(line.direction, -measured.angle[0], p1 - line.centre);
  return line;
}

Vector3 linearVector(const RotaryLine& line, const RotaryAxisMeasurement& measured, bool inHead) {
  return inHead ? Vector3(line.radius - measured.tool) : line.centre;
}

std::optional<KinematicsEvaluation> evaluateKinematics(const ToolCarrier& before,
                                                       const std::array<std::optional<RotaryLine>, 2>& lines,
                                                       const std::array<RotaryAxisMeasurement, 2>& measured,
                                                       const std::array<Normalisation, 2>& normalisation, Chain chain) {
  if (!lines[0]) return std::nullopt;
  KinematicsEvaluation result{.carrier = before};
  const bool two = lines[1].has_value(), closed = chain == Chain::Closed;
  const RotaryLine& first = *lines[0];
  auto& [v1, v2] = result.carrier.axis;
  auto& [i1, i2, i3, i4] = result.carrier.offset;
  const Vector3 none = Vector3::Zero();
  v1 = first.direction;
  v2 = two ? lines[1]->direction : none;
  for (std::size_t i = 0; i < (two ? 2U : 1U); ++i)
    result.linear[i] = linearVector(*lines[i], measured[i], before.inHead(static_cast<int>(i)));
  // Where axis 1 stood while axis 2 was measured, and the other way round.
  const double firstStood = measured[1].otherAngle, secondStood = measured[0].otherAngle;

  switch (before.kind) {
    case ToolCarrier::Kind::Head: {
      i4 = none;
      Vector3 toSecond = none;  // from the tool adapter to axis 2, the tool at right angles to it
      if (two) {
        // With axis 1 turned, the line of axis 2 is turned with it.
        v2 = turned(v1, -firstStood, lines[1]->direction);
        toSecond = turned(v1, -firstStood, lines[1]->radius) - measured[1].tool;
        const auto point = normalised(toSecond, v2, normalisation[1]);
        if (!point) return std::nullopt;
        toSecond = *point;
        result.linear[1] = turned(v1, -firstStood, lines[1]->radius) - measured[1].tool;
      }
      i3 = toSecond;
      const Vector3 arm = two ? turned(v2, secondStood, i3 + measured[0].tool) : measured[0].tool;
      Vector3 toFirst = i3 + first.radius - across(v1, arm);
      toFirst += v1 * v1.dot(result.linear[0] - toFirst);
      const auto point = normalised(toFirst, v1, normalisation[0]);
      if (!point) return std::nullopt;
      i2 = *point - i3;
      if (closed) i1 = -(i3 + i2);
      break;
    }
    case ToolCarrier::Kind::Table: {
      i1 = none;
      const auto point = normalised(first.centre, v1, normalisation[0]);
      if (!point) return std::nullopt;
      i2 = *point;
      i3 = none;
      if (two) {
        v2 = turned(v1, -firstStood, lines[1]->direction);
        result.linear[1] = i2 + turned(v1, -firstStood, lines[1]->centre - i2);
        const auto second = normalised(result.linear[1], v2, normalisation[1]);
        if (!second) return std::nullopt;
        i3 = *second - i2;
      }
      if (closed) i4 = -(i3 + i2);
      break;
    }
    case ToolCarrier::Kind::Mixed: {
      const auto point = normalised(result.linear[0], v1, normalisation[0]);
      if (!point) return std::nullopt;
      i2 = *point;
      if (closed) i1 = -i2;
      if (!two) {
        i3 = i4 = none;
        break;
      }
      // With the head turned, the ball is measured with the tip beside where the control shows it.
      const Vector3 shown = i1 + turned(v1, firstStood, i2 + measured[1].tool) - measured[1].tool;
      result.linear[1] = lines[1]->centre - shown;
      const auto second = normalised(result.linear[1], v2, normalisation[1]);
      if (!second) return std::nullopt;
      i3 = *second;
      if (closed) i4 = -i3;
      break;
    }
  }
  return result;
}

}  // namespace probewright::cycles::sinumerik
