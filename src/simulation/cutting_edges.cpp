#include "simulation/cutting_edges.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulation/tool_shape.hpp"

namespace probewright::simulation {

namespace {

constexpr double pi = std::numbers::pi;

/// A meridian as drawn: the end, the corner and the circumference of a mill or drill.
struct Drawn {
  double radius = 0;
  double corner = 0;
  double pointAngle = 180;  ///< degrees
  double length = 0;        ///< of the edges along the axis
};

/// How an edge differs from the drawing.
struct Shifted {
  double radial = 0, axial = 0;  ///< outwards, longer
  double broken = 0;
};

EdgePiece line(const Vector2& from, const Vector2& to) {
  EdgePiece piece;
  piece.from = from;
  piece.to = to;
  return piece;
}

EdgePiece arc(const Vector2& centre, double radius, double fromAngle, double toAngle) {
  EdgePiece piece;
  piece.kind = EdgePiece::Kind::Arc;
  piece.centre = centre;
  piece.radius = radius;
  piece.fromAngle = fromAngle;
  piece.toAngle = toAngle;
  return piece;
}

/// What remains above `height` of a piece whose heights increase along it; nothing if all of it is below.
bool cutBelow(EdgePiece& piece, double height) {
  if (piece.kind == EdgePiece::Kind::Line) {
    if (piece.to.y() < height) return false;
    if (piece.from.y() < height)
      piece.from += (piece.to - piece.from) * ((height - piece.from.y()) / (piece.to.y() - piece.from.y()));
    return true;
  }
  if (piece.centre.y() < height) return false;  // corners end at the height of their centre
  const double sine = (height - piece.centre.y()) / piece.radius;
  if (sine > -1) piece.fromAngle = std::max(piece.fromAngle, std::asin(sine));
  return true;
}

std::vector<EdgePiece> meridianOf(const Drawn& drawn, const Shifted& shifted) {
  const double radius = drawn.radius, corner = std::min(drawn.corner, radius);
  // With the cone of a drill: up to the circumference.
  const double slope = drawn.pointAngle < 180 ? 1 / std::tan(radiansFromDegrees(drawn.pointAngle / 2)) : 0;
  const double shoulder = slope > 0 ? slope * radius : corner;
  std::vector<EdgePiece> pieces;
  if (slope > 0) {
    pieces.push_back(line({0, 0}, {radius, shoulder}));
  } else {
    if (corner < radius) pieces.push_back(line({0, 0}, {radius - corner, 0}));
    if (corner > 0) pieces.push_back(arc({radius - corner, corner}, corner, -pi / 2, 0));
  }
  if (drawn.length > shoulder) pieces.push_back(line({radius, shoulder}, {radius, drawn.length}));
  std::vector<EdgePiece> left;
  for (EdgePiece piece : pieces)
    if (shifted.broken <= 0 || cutBelow(piece, shifted.broken)) left.push_back(piece);
  pieces = std::move(left);
  const Vector2 shift(shifted.radial, -shifted.axial);
  for (EdgePiece& piece : pieces) {
    // What begins on the axis goes on beginning there.
    if (piece.from.x() > 0 || piece.kind == EdgePiece::Kind::Arc) {
      piece.from += shift;
    } else {
      piece.from.y() += shift.y();
    }
    piece.to += shift;
    piece.centre += shift;
    piece.datum = shift.y();
  }
  return pieces;
}

/// How far the flank of an insert recedes for a mm across its plane.
double recession(const TrueInsert& insert) { return std::tan(radiansFromDegrees(insert.clearance)); }

/// The edges of an insert, nose and both straights, or the lines of its flank `depth` across its plane. Its theoretical
/// tip, where the tangents of the nose along the axes of its plane meet, is the origin.
std::vector<EdgePiece> insertOf(const TrueInsert& insert, double depth = 0) {
  const double first = radiansFromDegrees(insert.firstNormal);
  const double second = first + std::remainder(radiansFromDegrees(insert.secondNormal) - first, 2 * pi);
  // The quadrant in which the nose points, seen from its centre.
  const double middle = 0.5 * (first + second);
  const auto sign = [](double value) { return std::abs(value) < 1e-9 ? 0.0 : value < 0 ? -1.0 : 1.0; };
  const Vector2 centre = -insert.noseRadius * Vector2(sign(std::cos(middle)), sign(std::sin(middle)));
  const double radius = insert.noseRadius - insert.wear - recession(insert) * depth;
  const auto normal = [](double angle) { return Vector2(std::cos(angle), std::sin(angle)); };
  const double turn = second > first ? 1 : -1;
  const auto straight = [&](double angle, double towards) {
    const Vector2 start = centre + radius * normal(angle);
    return line(start, start + towards * insert.edgeLength * Vector2(-std::sin(angle), std::cos(angle)));
  };
  std::vector<EdgePiece> pieces = {arc(centre, radius, first, second), straight(first, -turn), straight(second, turn)};
  for (EdgePiece& piece : pieces) {
    piece.angle = radiansFromDegrees(insert.orientation);
    piece.across = insert.thickness < 0 ? -depth : depth;
  }
  return pieces;
}

/// The least of `value` between 0 and 1: from `samples` + 1 places, refined between the neighbours of each that may be
/// the least. `slack`: how much less it may be half a step beside a sample.
template <class Value>
double leastShare(const Value& value, int samples, double slack) {
  std::vector<double> found(static_cast<std::size_t>(samples) + 1);
  for (int i = 0; i <= samples; ++i)
    found[static_cast<std::size_t>(i)] = value(static_cast<double>(i) / samples);
  double share = 0, least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= samples; ++i) {
    const double here = found[static_cast<std::size_t>(i)];
    if (here < least) {
      least = here;
      share = static_cast<double>(i) / samples;
    }
  }
  const double lowest = least;
  for (int i = 0; i <= samples; ++i) {
    const double here = found[static_cast<std::size_t>(i)];
    if (here - slack > lowest || (i > 0 && found[static_cast<std::size_t>(i) - 1] <= here) ||
        (i < samples && found[static_cast<std::size_t>(i) + 1] < here))
      continue;
    constexpr double golden = 0.6180339887498949;
    double low = static_cast<double>(std::max(i - 1, 0)) / samples;
    double high = static_cast<double>(std::min(i + 1, samples)) / samples;
    double a = high - golden * (high - low), b = low + golden * (high - low);
    double atA = value(a), atB = value(b);
    int settled = 0;
    for (int step = 0; step < 50 && settled < 3; ++step) {
      settled = std::abs(atA - atB) < 1e-12 ? settled + 1 : 0;
      if (atA < atB) {
        high = b;
        b = a;
        atB = atA;
        a = high - golden * (high - low);
        atA = value(a);
      } else {
        low = a;
        a = b;
        atA = atB;
        b = low + golden * (high - low);
        atB = value(b);
      }
    }
    if (const double refined = std::min(atA, atB); refined < least) {
      least = refined;
      share = atA < atB ? a : b;
    }
  }
  return share;
}

/// At most as far as a turned piece is from the solid: by the distance of its axis.
double leastGapOf(const EdgePiece& piece, const Pose& solidFromCutter, const DistanceSolid& solid) {
  constexpr int samples = 4;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= samples; ++i) {
    const Vector2 place = piece.meridian(static_cast<double>(i) / samples);
    const double axis = solid.closest(solidFromCutter * Vector3(0, 0, place.y())).distance;
    least = std::min(least, axis - std::abs(place.x()));
  }
  return least - std::numbers::sqrt2 * 0.5 * piece.length() / samples;
}

/// The point of a piece that comes nearest; far away, a gap that is not wider than the true one.
EdgeDistance nearestOf(const EdgePiece& piece, const Pose& solidFromCutter, const DistanceSolid& solid) {
  constexpr double far = 0.2;  // mm
  if (piece.turned) {
    if (const double gap = leastGapOf(piece, solidFromCutter, solid); gap > far) return {.gap = gap};
  }
  const auto gapAt = [&](double share, double about) {
    return solid.closest(solidFromCutter * piece.at(share, about)).distance;
  };
  constexpr double fullTurn = 2 * pi;
  const auto aboutOf = [&](double share) {
    const double radius = piece.meridian(share).x();
    if (!piece.turned || radius == 0) return 0.0;
    constexpr int places = 16;
    return fullTurn *
           leastShare([&](double s) { return gapAt(share, fullTurn * s); }, places, pi * std::abs(radius) / places);
  };
  const double turns = std::abs(piece.winding * (piece.meridian(1).y() - piece.meridian(0).y()));
  const int samples = 4 + static_cast<int>(std::ceil(turns / radiansFromDegrees(15)));
  const double share =
      leastShare([&](double s) { return gapAt(s, aboutOf(s)); }, samples, 0.5 * piece.length() / samples);
  EdgeDistance distance;
  distance.place = solidFromCutter * piece.at(share, aboutOf(share));
  const ClosestPoint near = solid.closest(distance.place);
  distance.gap = near.distance;
  distance.normal = near.normal;
  return distance;
}

/// At all angles, `out` farther from the axis, where a piece does not begin on it.
void turnAbout(EdgePiece& piece, double out) {
  piece.turned = true;
  piece.centre.x() += out;
  if (piece.from.x() != 0) piece.from.x() += out;
  piece.to.x() += out;
}

EdgeDistance nearestOf(const std::vector<EdgePiece>& pieces, const Pose& solidFromCutter, const DistanceSolid& solid) {
  EdgeDistance nearest;
  for (const EdgePiece& piece : pieces) {
    const EdgeDistance here = nearestOf(piece, solidFromCutter, solid);
    if (here.gap < nearest.gap) nearest = here;
  }
  return nearest;
}

}  // namespace

double flankDepth(const TrueInsert& insert) {
  const double round = insert.noseRadius - insert.wear, slope = recession(insert);
  const double depth = std::abs(insert.thickness);
  return slope > 0 && slope * depth > round ? round / slope : depth;
}

Vector2 EdgePiece::meridian(double share) const {
  if (kind == Kind::Line) return from + (to - from) * share;
  const double at = fromAngle + (toAngle - fromAngle) * share;
  return centre + radius * Vector2(std::cos(at), std::sin(at));
}

Vector3 EdgePiece::at(double share, double about) const {
  const Vector2 place = meridian(share);
  const double at = angle + winding * (place.y() - datum) + about;
  return {place.x() * std::cos(at) - across * std::sin(at), place.x() * std::sin(at) + across * std::cos(at),
          place.y()};
}

double EdgePiece::length() const {
  const double along = kind == Kind::Line ? (to - from).norm() : radius * std::abs(toAngle - fromAngle);
  const Vector2 first = meridian(0), last = meridian(1);
  return along + std::abs(winding * (last.y() - first.y())) * std::max(std::abs(first.x()), std::abs(last.x()));
}

CuttingEdges::CuttingEdges(const TrueTool& tool) : eccentricity_(offsetOf(tool.cutter)) {
  const TrueCutter& cutter = tool.cutter;
  const double whole = tool.length - cutter.holderLength;
  const Drawn drawn{tool.radius, cutter.cornerRadius, cutter.pointAngle,
                    cutter.cutLength > 0 ? std::min(cutter.cutLength, whole) : whole};
  spindleFromTool_ = translation(tool.mount - tool.length * tool.shankDirection);
  spindleFromTool_.linear() = toolFrame(tool);
  Shifted most;
  if (cutter.insert) {
    insert_ = cutter.insert;
    edges_.push_back(insertOf(*cutter.insert));
    envelope_ = edges_.front();
  } else if (cutter.teeth.empty()) {
    round_ = true;
    edges_.push_back(meridianOf(drawn, {}));
    for (EdgePiece& piece : edges_.front())
      piece.turned = true;
  } else {
    most = {-1e300, -1e300, 1e300};
    for (const TrueTooth& tooth : cutter.teeth) {
      const Shifted shifted{tooth.radial - tooth.radialWear, tooth.axial - tooth.axialWear, tooth.broken};
      most.radial = std::max(most.radial, shifted.radial);
      most.axial = std::max(most.axial, shifted.axial);
      most.broken = std::min(most.broken, shifted.broken);
      std::vector<EdgePiece> edge = meridianOf(drawn, shifted);
      for (EdgePiece& piece : edge) {
        piece.angle = radiansFromDegrees(tooth.angle);
        piece.winding = tool.radius > 0 ? std::tan(radiansFromDegrees(cutter.helix)) / tool.radius : 0;
      }
      edges_.push_back(std::move(edge));
    }
  }
  if (!cutter.insert) envelope_ = meridianOf(drawn, most);
  const double aside = eccentricity_.norm() + (insert_ ? flankDepth(*insert_) : 0);
  envelopes_ = edges_;
  for (std::vector<EdgePiece>& envelope : envelopes_)
    for (EdgePiece& piece : envelope)
      turnAbout(piece, cutter.insert && piece.meridian(1).x() < 0 ? -aside : aside);
  for (EdgePiece& piece : envelope_) {
    turnAbout(piece, cutter.insert && piece.meridian(1).x() < 0 ? -aside : aside);
    reach_ =
        std::max({reach_, std::abs(piece.from.x()), std::abs(piece.to.x()), std::abs(piece.centre.x()) + piece.radius});
  }
}

Pose CuttingEdges::spindleFromCutter(double degrees) const {
  return spindleFromTool_ * rotation(Vector3::UnitZ(), degrees) *
         translation({eccentricity_.x(), eccentricity_.y(), 0});
}

EdgeDistance CuttingEdges::nearestOfInsert(const Pose& solidFromCutter, const DistanceSolid& solid) const {
  const EdgeDistance edge = nearestOf(edges_.front(), solidFromCutter, solid);
  const double flank = flankDepth(*insert_);
  // No point of the flank is farther than this from its edge.
  const double away = flank * std::hypot(1, recession(*insert_));
  constexpr double far = 1;  // mm
  if (flank <= 0) return edge;
  if (edge.gap - away > far) return {.gap = edge.gap - away, .place = edge.place, .normal = edge.normal};
  const auto at = [&](double share) { return nearestOf(insertOf(*insert_, share * flank), solidFromCutter, solid); };
  constexpr int samples = 4;
  const double share = leastShare([&](double s) { return at(s).gap; }, samples, 0.5 * away / samples);
  return at(share);
}

EdgeDistance CuttingEdges::nearest(std::size_t edge, const Pose& solidFromCutter, const DistanceSolid& solid) const {
  return insert_ ? nearestOfInsert(solidFromCutter, solid) : nearestOf(edges_[edge], solidFromCutter, solid);
}

double CuttingEdges::leastGap(const Pose& solidFromSpindle, const DistanceSolid& solid) const {
  return nearestOf(envelope_, solidFromSpindle * spindleFromTool_, solid).gap;
}

double CuttingEdges::leastGap(std::size_t edge, const Pose& solidFromSpindle, const DistanceSolid& solid) const {
  return nearestOf(envelopes_[edge], solidFromSpindle * spindleFromTool_, solid).gap;
}

}  // namespace probewright::simulation
