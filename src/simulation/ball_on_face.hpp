#pragma once

#include "simulation/cad_face.hpp"
#include "simulation/sweep.hpp"

namespace probewright::simulation {

/// A ball on its way to a free-form face, and the best meeting so far: what both searches for their contact ask.
class BallOnFace {
public:
  BallOnFace(const CadFace& face, const Way& way, double radius, Meeting& best);

  /// mm: how far the ball is from a place of the surface after a distance along the way; less than zero where it
  /// overlaps.
  double gapAt(double when, const Vector2& at) const;

  /// Puts the place where the ball stands in the face from the start into the best meeting, if it does; looked for from
  /// `nearest` on, in steps no longer than `extent`.
  bool meetsAtStart(Vector2 nearest, const Vector2& extent);

  /// Puts a touch of the whole surface into the best meeting if the face is there and the ball goes on into it. False
  /// if it is no touch.
  bool accept(double when, const Vector2& at);

  /// Puts a place of the face into the best meeting.
  void meet(double when, const Vector2& at);

private:
  const CadFace& face_;
  const FreeformSurface& surface_;
  const Way& way_;
  double radius_;
  Meeting& best_;
};

}  // namespace probewright::simulation
