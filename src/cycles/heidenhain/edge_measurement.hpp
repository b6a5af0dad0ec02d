#pragma once

#include "cycles/heidenhain/call_rules.hpp"
#include "cycles/heidenhain/context.hpp"

/// What cycles 400, 403 and 420 have in common: two touches of an edge, and the angle that they give.
namespace probewright::cycles::heidenhain {

struct MeasuredEdge {
  EvaluatedTouch first, second;
  /// From the first to the second ball centre; the angle of the edge does not depend on the ball radius.
  PlaneWay along = PlaneWay::unit(0);
};

/// Refuses points that say nothing about the angle of an edge.
void edgeRules(CallRules& call);

/// Touches (Q263, Q264) and (Q265, Q266) along axis Q272 in the direction Q267 at the height Q261. With Q272 = 3 the
/// touches go along the touch probe axis and Q261 is the expected surface. Throws Alarm if the points coincide.
MeasuredEdge measureEdge(Context& context);

/// The same line whatever its direction: an angle in (-90, 90].
double undirected(double degrees);

}  // namespace probewright::cycles::heidenhain
