#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/primitives.hpp"

namespace probewright::simulation {

/// The part of a surface's parameter plane that a face covers: the inside of closed polygons, by the even-odd rule; the
/// whole surface where there is no polygon. On a surface that closes, the polygons may lie in any period, each loop in
/// another, and reach across more than one.
/// The polygons follow the face's borders closely, not exactly; near a border its edge decides about contacts.
class TrimmedDomain {
public:
  struct Segment {
    Vector2 from;
    Vector2 to;
  };

  TrimmedDomain() = default;
  /// Periods are zero for directions that do not close.
  TrimmedDomain(std::vector<Segment> border, double periodU, double periodV);

  bool contains(const Vector2& parameters) const;
  /// True if some point of a box, taken modulo the periods, lies within; also if the box only touches a polygon.
  bool reaches(const Vector2& low, const Vector2& high) const;
  bool isEverywhere() const { return border_.empty(); }

  /// The corners of the box about the polygons.
  const Vector2& low() const { return low_; }
  const Vector2& high() const { return high_; }
  /// The area within the polygons where all run in their right sense.
  double area() const;

  /// Appends it as it lies in memory.
  void appendTo(std::string& bytes) const;
  /// Takes what appendTo() gave from the beginning of `bytes`; nothing if they are not that.
  static std::optional<TrimmedDomain> takeFrom(std::string_view& bytes);

private:
  bool containsPlain(const Vector2& p) const;
  bool crosses(const Vector2& low, const Vector2& high) const;

  std::vector<Segment> border_;
  std::vector<std::vector<std::uint32_t>> bands_;  ///< the segments that cross each band of equal height in v
  Vector2 low_ = Vector2::Zero();
  Vector2 high_ = Vector2::Zero();
  double periodU_ = 0;
  double periodV_ = 0;
};

}  // namespace probewright::simulation
