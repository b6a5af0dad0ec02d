#pragma once

#include <functional>
#include <optional>

#include "execution/sinumerik/path_element.hpp"

namespace probewright::execution::sinumerik {

/// What is inserted between a path element and the next one: CHF, CHR, RND, RNDM.
struct Corner {
  enum class Kind {
    Rounding,       ///< RND, RNDM: a tangential arc, `size` its radius
    ChamferLength,  ///< CHF: a straight line, `size` its length
    ChamferWidth,   ///< CHR: a straight line, `size` the distance of its ends from the corner
  };
  Kind kind = Kind::Rounding;
  double size = 0;                    ///< mm
  std::optional<control::Feed> feed;  ///< FRC, FRCM; without it that of the next element
};

/// Rounds and chamfers the corners of a path in the working plane. Elements go in as they are programmed; one after
/// which something is to be inserted waits for the next one. A chamfer lies symmetrically to the corner. What is too
/// large for the elements beside it becomes as large as they permit, as on the control. The corner stays as it is if
/// one of the elements does not lie in the plane, or if they go over into each other.
class CornerMaker {
public:
  using Output = std::function<void(const PathElement&)>;

  explicit CornerMaker(Output output) : output_(std::move(output)) {}

  void add(const PathElement& element, const std::optional<Corner>& corner, const control::WorkingPlane& plane);
  /// Puts out what waits, with its sharp corner.
  void flush();
  bool holds() const { return held_.has_value(); }

private:
  Output output_;
  std::optional<PathElement> held_;
  Corner corner_;
};

}  // namespace probewright::execution::sinumerik
