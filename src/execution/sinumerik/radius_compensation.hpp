#pragma once

#include <functional>
#include <optional>

#include "execution/sinumerik/path_element.hpp"

namespace probewright::execution::sinumerik {

/// Tool radius compensation in the working plane (G41, G42, G40 with NORM; corners G450 and G451). Elements go in as
/// they are programmed; what the tool centre travels comes out, one element later, because a corner needs both sides.
/// Inner corners are cut at the intersection of the offset paths, outer corners are rounded (G450) or cut (G451).
class RadiusCompensator {
public:
  using Output = std::function<void(const PathElement&)>;

  explicit RadiusCompensator(Output output) : output_(std::move(output)) {}

  bool active() const { return side_ != 0; }
  /// Begins: the next line leads from where the tool stands to the offset contour. `side`: 1 left, -1 right.
  void begin(int side, double radius, const control::WorkingPlane& plane, bool cornerArc);
  /// The next line leads from the offset contour to its programmed end, then compensation is over.
  void end();
  void add(const PathElement& element);
  /// Puts out what is held back, square to the contour's end.
  void flush();

private:
  Vector3 normal(const Vector3& direction) const;
  PathElement offset(const PathElement& element) const;
  void putOut(PathElement element, const Vector3& end);
  std::optional<Vector3> intersection(const PathElement& first, const PathElement& second, const Vector3& corner) const;

  Output output_;
  int side_ = 0;
  double radius_ = 0;
  control::WorkingPlane plane_;
  Vector3 axis_ = Vector3::UnitZ();
  bool cornerArc_ = true;
  bool approaching_ = false;
  bool leaving_ = false;
  std::optional<PathElement> held_;     ///< as programmed
  Vector3 position_ = Vector3::Zero();  ///< where the tool centre stands
  bool positionKnown_ = false;
};

}  // namespace probewright::execution::sinumerik
