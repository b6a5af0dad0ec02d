#include "simulation/cutting_edges.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulation/edge_distance.hpp"
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
  // A stump ends in the face of the break, from the axis on.
  if (shifted.broken > 0 && !left.empty()) {
    const Vector2 rim = left.front().meridian(0);
    if (rim.x() > 0) left.insert(left.begin(), line({0, rim.y()}, rim));
  }
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

/// At all angles, `out` farther from the axis, where a piece does not begin on it.
void turnAbout(EdgePiece& piece, double out) {
  piece.turned = true;
  piece.centre.x() += out;
  if (piece.from.x() != 0) piece.from.x() += out;
  piece.to.x() += out;
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
  const double flank = flankDepth(*insert_);
  const std::vector<EdgePiece>& front = edges_.front();
  if (flank <= 0) return nearestOf(front, solidFromCutter, solid);
  const std::vector<EdgePiece> behind = insertOf(*insert_, 1);
  EdgeDistance nearest;
  for (std::size_t i = 0; i < front.size(); ++i) {
    const EdgeDistance here = nearestOfFlank(front[i], behind[i], flank, solidFromCutter, solid);
    if (here.gap < nearest.gap) nearest = here;
  }
  return nearest;
}

EdgeDistance CuttingEdges::nearest(std::size_t edge, const Pose& solidFromCutter, const DistanceSolid& solid) const {
  return insert_ ? nearestOfInsert(solidFromCutter, solid) : nearestOf(edges_[edge], solidFromCutter, solid);
}

double CuttingEdges::leastGap(const Pose& solidFromSpindle, const DistanceSolid& solid) const {
  return leastGapOf(envelope_, solidFromSpindle * spindleFromTool_, solid);
}

double CuttingEdges::leastGap(std::size_t edge, const Pose& solidFromSpindle, const DistanceSolid& solid) const {
  return leastGapOf(envelopes_[edge], solidFromSpindle * spindleFromTool_, solid);
}

}  // namespace probewright::simulation
