#pragma once

#include <optional>
#include <string>
#include <vector>

#include "records/truth.hpp"
#include "truth/touched_points.hpp"

/// Shapes through touches, believed and true, in coordinates of the working plane.
namespace probewright::truth {

using Touches = std::vector<const TouchedPoint*>;

/// How a true shape was found.
struct Origin {
  records::TruthBasis basis = records::TruthBasis::Face;
  std::string shape;
};

/// Fitted or exact: a hole, a stud, a sphere.
struct Round {
  Vector3 centre = Vector3::Zero();
  double diameter = 0;
};

struct TrueRound : Round {
  Origin origin;
};

/// What the control may have computed: a circle in the working plane through the ball centres, less or more by the
/// balls, and one through the points of contact; or the same of spheres.
enum class RoundShape { Circle, Sphere };
std::vector<Round> believedRounds(const Touches& touches, RoundShape shape);
std::optional<TrueRound> trueRound(const Touches& touches, RoundShape shape);

/// Touches that lie on one flat face, or are to be taken as points of one.
struct TrueFlat {
  Plane plane;
  Origin origin;
};

/// The flat face that all of them touched. Without one: through three points or more the plane that fits best, through
/// two the one that stands square on the working plane, through one the plane that touches there.
std::optional<TrueFlat> trueFlat(const Touches& touches);
/// The believed one: through the points of contact, or through the ball centres and by the balls beside them. Of one
/// touch the plane square to its direction.
std::vector<Plane> believedFlats(const Touches& touches);

/// How far along `axis` from `from` the surface is that was touched: on its face, or else on the plane that touches it.
std::optional<double> distanceToFace(const TouchedPoint& touched, const Vector3& from, const Vector3& axis);

/// The touches by their directions, opposite ones apart; the first direction first.
std::vector<Touches> byDirection(const Touches& touches);
/// The touches by the round faces that they are on; those on others are left out.
std::vector<Touches> byRoundFace(const Touches& touches);

Vector3 meanOf(const Touches& touches, Vector3 TouchedPoint::*member);

}  // namespace probewright::truth
