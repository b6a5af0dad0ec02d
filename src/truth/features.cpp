#include "truth/features.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/decompositions.hpp"
#include "truth/shapes.hpp"

namespace probewright::truth {

using control::Along;
using control::Characteristic;
using control::FitRecord;
using control::Quantity;
using records::TruthBasis;

namespace {

using Explanations = std::vector<Explanation>;

/// The worse of two origins.
Origin both(const Origin& a, const Origin& b) {
  return {a.basis == TruthBasis::Face ? b.basis : a.basis, a.shape == b.shape ? a.shape : std::string()};
}

void add(Explanations& to, double believed, double truth, const Origin& origin) {
  if (std::isfinite(believed) && std::isfinite(truth)) to.push_back({believed, truth, origin.basis, origin.shape});
}

/// A feature that has a centre, with what the control may have taken for it.
struct FoundRound {
  std::vector<Round> believed;
  TrueRound truth;
};

}  // namespace

/// Everything that a cycle has touched.
class Features {
public:
  Features(const TouchedCycle& cycle, const std::vector<FitRecord>& fits) : plane_(cycle.plane), fits_(fits) {
    for (const TouchedPoint& point : cycle.points)
      all_.push_back(&point);
  }

  Explanations of(const Characteristic& what) const {
    Explanations found;
    if (all_.empty()) return found;
    switch (what.quantity) {
      case Quantity::Diameter:
        diameters(found, what, 1);
        break;
      case Quantity::Radius:
        diameters(found, what, 0.5);
        break;
      case Quantity::Centre:
        centres(found, what);
        middles(found, what);
        break;
      case Quantity::Width:
      case Quantity::Length:
        widths(found, what);
        break;
      case Quantity::Coordinate:
        coordinates(found, what);
        middles(found, what);
        break;
      case Quantity::Corner:
        corners(found, what);
        break;
      case Quantity::Angle:
      case Quantity::Projection:
        if (const auto axis = turnedAbout(what.along))
          planeAngles(found, *axis);
        else
          lineAngles(found, what.along);
        break;
      case Quantity::Distance:
      case Quantity::Eccentricity:
      case Quantity::Name:
      case Quantity::Scatter:
      case Quantity::None:
        break;
    }
    return found;
  }

private:
  /// The axis of the plane's coordinates, 0 to 2; nothing if the characteristic names none.
  std::optional<int> axisOf(Along along) const {
    switch (along) {
      case Along::First:
        return 0;
      case Along::Second:
        return 1;
      case Along::Third:
        return 2;
      case Along::X:
      case Along::Y:
      case Along::Z: {
        const int xyz = along == Along::X ? 0 : along == Along::Y ? 1 : 2;
        for (int i = 0; i < 3; ++i)
          if (plane_.axis(i) == xyz) return i;
        return std::nullopt;
      }
      default:
        return std::nullopt;
    }
  }

  /// The axis of the working plane that the angle of a plane turns about.
  std::optional<int> turnedAbout(Along along) const {
    const auto axis = axisOf(along == Along::A ? Along::X : along == Along::B ? Along::Y : along);
    return axis && *axis < 2 ? axis : std::nullopt;
  }

  Touches touchesOf(const FitRecord& fit) const {
    Touches touches;
    for (const std::size_t index : fit.touches) {
      const auto found = std::ranges::find(all_, index, [](const TouchedPoint* point) { return point->touch; });
      if (found == all_.end()) return {};
      touches.push_back(*found);
    }
    return touches;
  }

  /// The sets of touches that the control laid a shape through.
  std::vector<Touches> fitted(std::string_view shape) const {
    std::vector<Touches> sets;
    for (const FitRecord& fit : fits_) {
      if (fit.shape != shape) continue;
      if (Touches touches = touchesOf(fit); !touches.empty()) sets.push_back(std::move(touches));
    }
    return sets;
  }

  /// Found once: fits take most of the time.
  const std::vector<FoundRound>& rounds() const {
    if (!rounds_) rounds_ = findRounds();
    return *rounds_;
  }

  std::vector<FoundRound> findRounds() const {
    std::vector<FoundRound> found;
    const auto take = [&](const Touches& touches, RoundShape shape) {
      std::vector<Round> believed = believedRounds(touches, shape);
      const auto truth = trueRound(touches, shape);
      if (truth && !believed.empty()) found.push_back({std::move(believed), *truth});
    };
    for (const Touches& touches : fitted("sphere"))
      take(touches, RoundShape::Sphere);
    for (const Touches& touches : fitted("circle"))
      take(touches, RoundShape::Circle);
    if (!found.empty()) return found;
    for (const Touches& touches : byRoundFace(all_))
      if (touches.size() >= 3) take(touches, RoundShape::Circle);
    // Free forms and triangles do not tell which of them belong together.
    const auto hasFace = [](const TouchedPoint* touch) { return touch->face.has_value(); };
    if (found.empty() && all_.size() >= 3 && std::ranges::none_of(all_, hasFace)) take(all_, RoundShape::Circle);
    return found;
  }

  /// The circle through the centres of several holes.
  static std::optional<FoundRound> circleOf(const std::vector<FoundRound>& holes) {
    if (holes.size() < 3) return std::nullopt;
    std::vector<TouchedPoint> centres(holes.size());
    Touches touches;
    Origin origin = holes.front().truth.origin;
    for (std::size_t i = 0; i < holes.size(); ++i) {
      centres[i].ball = centres[i].surface = holes[i].believed.back().centre;
      centres[i].point = holes[i].truth.centre;
      origin = both(origin, holes[i].truth.origin);
      touches.push_back(&centres[i]);
    }
    std::vector<Round> believed = believedRounds(touches, RoundShape::Circle);
    auto truth = trueRound(touches, RoundShape::Circle);
    if (!truth || believed.empty()) return std::nullopt;
    truth->origin = origin;
    return FoundRound{std::move(believed), *truth};
  }

  /// Those that the characteristic may mean.
  std::vector<FoundRound> roundsFor(const Characteristic& what) const {
    const std::vector<FoundRound>& all = rounds();
    if (what.item > 0) {
      if (what.item > all.size()) return {};
      return {all[what.item - 1U]};
    }
    if (auto circle = circleOf(all)) return {*circle};
    return all;
  }

  void diameters(Explanations& found, const Characteristic& what, double share) const {
    for (const FoundRound& round : roundsFor(what))
      for (const Round& believed : round.believed)
        add(found, share * believed.diameter, share * round.truth.diameter, round.truth.origin);
  }

  void centres(Explanations& found, const Characteristic& what) const {
    const auto axis = axisOf(what.along);
    if (!axis) return;
    for (const FoundRound& round : roundsFor(what)) {
      const bool measured = *axis < 2 || round.truth.origin.shape == "sphere";
      if (!measured) continue;
      for (const Round& believed : round.believed)
        add(found, believed.centre[*axis], round.truth.centre[*axis], round.truth.origin);
    }
  }

  /// Two sets of touches from opposite directions: a slot, a ridge, two sides of a rectangle.
  struct Pair {
    Touches first, second;
    Vector3 direction;
    TrueFlat firstFlat, secondFlat;
    Origin origin;
    /// The plane half way between the two.
    Plane middle() const {
      const Vector3 normal = (firstFlat.plane.normal - secondFlat.plane.normal).normalized();
      return {(firstFlat.plane.point + secondFlat.plane.point) / 2, normal};
    }
  };

  std::vector<Pair> pairs() const {
    std::vector<Pair> found;
    if (!byRoundFace(all_).empty()) return found;
    const std::vector<Touches> groups = byDirection(all_);
    for (std::size_t i = 0; i < groups.size(); ++i) {
      for (std::size_t j = i + 1; j < groups.size(); ++j) {
        if (groups[i].front()->direction.dot(groups[j].front()->direction) > -0.99) continue;
        const auto first = trueFlat({groups[i].back()}), second = trueFlat({groups[j].back()});
        if (!first || !second) continue;
        found.push_back(
            {groups[i], groups[j], groups[i].front()->direction, *first, *second, both(first->origin, second->origin)});
      }
    }
    return found;
  }

  void widths(Explanations& found, const Characteristic& what) const {
    const auto axis = axisOf(what.along);
    for (const Pair& pair : pairs()) {
      if (axis && std::abs(pair.direction[*axis]) < 0.7) continue;
      const double believed = (pair.first.back()->surface - pair.second.back()->surface).dot(pair.direction);
      const Vector3 between = pair.firstFlat.plane.point - pair.secondFlat.plane.point;
      const double truth = std::abs(between.dot(pair.middle().normal));
      add(found, std::abs(believed), truth, pair.origin);
    }
  }

  void middles(Explanations& found, const Characteristic& what) const {
    const auto named = axisOf(what.along);
    const std::vector<Pair> all = pairs();
    for (const Pair& pair : all) {
      Eigen::Index axis = 0;
      pair.direction.cwiseAbs().maxCoeff(&axis);
      if (named) axis = *named;
      if (std::abs(pair.direction[axis]) < 0.2) continue;
      const Vector3 believed = (pair.first.back()->surface + pair.second.back()->surface) / 2;
      const Plane middle = pair.middle();
      const auto other = std::ranges::find_if(
          all, [&](const Pair& second) { return std::abs(second.direction.dot(pair.direction)) < 0.5; });
      if (other != all.end()) {
        // Where the middles of both pairs cross, at the height of the touches.
        const Plane across = other->middle();
        Matrix3 normals;
        normals << middle.normal.transpose(), across.normal.transpose(), Vector3::UnitZ().transpose();
        const Vector3 distances(middle.normal.dot(middle.point), across.normal.dot(across.point), middle.point.z());
        const Vector3 centre = solveLinear(normals, distances);
        add(found, believed[axis], centre[axis], both(pair.origin, other->origin));
        continue;
      }
      const double slope = middle.normal.dot(pair.direction);
      if (std::abs(slope) < 0.05) continue;
      const double along = (middle.point - believed).dot(middle.normal) / slope;
      add(found, believed[axis], believed[axis] + along * pair.direction[axis], pair.origin);
    }
  }

  /// Coordinates of touches from the same side, summed up.
  struct Side {
    Eigen::Index axis = 0;
    bool positive = true;  ///< touched in this direction
    double believed = 0, truth = 0;
    int count = 0;
    Origin origin;
  };

  static Side& sideOf(std::vector<Side>& sides, Eigen::Index axis, bool positive, const Origin& origin) {
    const auto found =
        std::ranges::find_if(sides, [&](const Side& side) { return side.axis == axis && side.positive == positive; });
    if (found != sides.end()) {
      found->origin = both(found->origin, origin);
      return *found;
    }
    return sides.emplace_back(Side{axis, positive, 0, 0, 0, origin});
  }

  void addCoordinate(Explanations& found, Eigen::Index axis, double believed, double truth,
                     const Origin& origin) const {
    add(found, believed, truth, origin);
    // Lathes count diameters.
    if (plane_.axis(static_cast<int>(axis)) == 0) add(found, 2 * believed, 2 * truth, origin);
  }

  void coordinates(Explanations& found, const Characteristic& what) const {
    const auto named = axisOf(what.along);
    if (what.item > all_.size()) return;
    std::vector<Side> sides;
    for (std::size_t i = 0; i < all_.size(); ++i) {
      if (what.item > 0 && i + 1 != what.item) continue;
      const TouchedPoint& touch = *all_[i];
      Eigen::Index axis = 0;
      touch.direction.cwiseAbs().maxCoeff(&axis);
      if (named && *named != axis) continue;
      const auto distance = distanceToFace(touch, touch.surface, Vector3::Unit(axis));
      if (!distance) continue;
      const Origin origin =
          touch.face ? Origin{TruthBasis::Face, nameOf(touch.face->kind)} : Origin{TruthBasis::Points, {}};
      const double believed = touch.surface[axis], truth = believed + *distance;
      addCoordinate(found, axis, believed, truth, origin);
      Side& side = sideOf(sides, axis, touch.direction[axis] > 0, origin);
      side.believed += believed;
      side.truth += truth;
      ++side.count;
    }
    if (what.item > 0) return;
    // Repeated touches count with their mean, so do those of a turned part before and after half a turn. Touches from
    // both sides of it tell its diameter.
    for (Side& side : sides) {
      side.believed /= side.count;
      side.truth /= side.count;
      if (side.count > 1) addCoordinate(found, side.axis, side.believed, side.truth, side.origin);
    }
    for (const Side& plus : sides) {
      for (const Side& minus : sides) {
        if (plus.axis != minus.axis || !plus.positive || minus.positive) continue;
        const double believed = std::abs(plus.believed - minus.believed), truth = std::abs(plus.truth - minus.truth);
        for (const double share : {1.0, 0.5})
          add(found, share * believed, share * truth, both(plus.origin, minus.origin));
      }
    }
  }

  static std::optional<Vector2> crossing(const Plane& a, const Plane& b, double height) {
    Eigen::Matrix2d normals;
    normals << a.normal.head<2>().transpose(), b.normal.head<2>().transpose();
    if (std::abs(normals.determinant()) < 0.1) return std::nullopt;
    const Vector2 distances(a.normal.dot(a.point) - a.normal.z() * height,
                            b.normal.dot(b.point) - b.normal.z() * height);
    return Vector2(normals.inverse() * distances);
  }

  void corners(Explanations& found, const Characteristic& what) const {
    const auto axis = axisOf(what.along);
    if (!axis || *axis > 1) return;
    const std::vector<Touches> sides = byDirection(all_);
    for (std::size_t i = 0; i < sides.size(); ++i) {
      for (std::size_t j = i + 1; j < sides.size(); ++j) {
        const auto first = trueFlat(sides[i]), second = trueFlat(sides[j]);
        if (!first || !second) continue;
        const auto truth = crossing(first->plane, second->plane, meanOf(sides[i], &TouchedPoint::point).z());
        if (!truth) continue;
        for (auto [a, b] : believedSides(sides[i], sides[j])) {
          // A side that was touched once stands square on the other one.
          if (sides[i].size() == 1 && sides[j].size() > 1) a.normal = b.normal.cross(Vector3::UnitZ());
          if (sides[j].size() == 1 && sides[i].size() > 1) b.normal = a.normal.cross(Vector3::UnitZ());
          const auto believed = crossing(a, b, a.point.z());
          if (believed) add(found, (*believed)[*axis], (*truth)[*axis], both(first->origin, second->origin));
        }
      }
    }
    crossings(found, *axis);
  }

  static std::vector<std::pair<Plane, Plane>> believedSides(const Touches& first, const Touches& second) {
    std::vector<std::pair<Plane, Plane>> sides;
    for (const Plane& a : believedFlats(first))
      for (const Plane& b : believedFlats(second))
        sides.emplace_back(a, b);
    return sides;
  }

  /// Where the lines cross that join the centres of four holes.
  void crossings(Explanations& found, int axis) const {
    const std::vector<FoundRound>& holes = rounds();
    if (holes.size() != 4) return;
    const auto joined = [](const Vector3& a, const Vector3& b) {
      return Plane{a, (b - a).cross(Vector3::UnitZ()).normalized()};
    };
    Origin origin = holes[0].truth.origin;
    for (const FoundRound& hole : holes)
      origin = both(origin, hole.truth.origin);
    constexpr int ways[3][4] = {{0, 2, 1, 3}, {0, 1, 2, 3}, {0, 3, 1, 2}};
    for (const auto& way : ways) {
      const auto cross = [&](auto centreOf) {
        const auto at = [&](int place) { return centreOf(holes[static_cast<std::size_t>(way[place])]); };
        return crossing(joined(at(0), at(1)), joined(at(2), at(3)), at(0).z());
      };
      const auto believed = cross([](const FoundRound& hole) { return hole.believed.back().centre; });
      const auto truth = cross([](const FoundRound& hole) { return hole.truth.centre; });
      if (believed && truth) add(found, (*believed)[axis], (*truth)[axis], origin);
    }
  }

  /// Angles of lines, each also as the control may count it: from another axis, or in the other sense.
  static void addAngle(Explanations& found, double believed, double truth, const Origin& origin) {
    for (const double sense : {1.0, -1.0}) {
      for (int quarter = -2; quarter <= 2; ++quarter) {
        const double from = 90.0 * quarter;
        const double counted = normalizedDegrees(sense * believed + from);
        add(found, counted, counted + sense * normalizedDegrees(truth - believed), origin);
      }
    }
  }

  static double directionOf(const Vector3& normal) { return degreesFromRadians(std::atan2(normal.x(), -normal.y())); }

  void lineAngles(Explanations& found, Along about) const {
    if (about != Along::Table && axisOf(about) != 2) return;
    if (!fitted("plane").empty()) return;  // its third angle is none that was measured
    for (const Touches& side : byDirection(all_)) {
      if (side.size() < 2 || std::abs(side.front()->direction.z()) > 0.5) continue;
      const auto truth = trueFlat(side);
      if (!truth) continue;
      for (const Plane& believed : believedFlats(side)) {
        // Nobody touches a wall along itself: such points lie on two features, in line with the touches.
        constexpr double along = 0.05;
        if (std::abs(believed.normal.dot(side.front()->direction)) < along) continue;
        addAngle(found, directionOf(believed.normal), directionOf(truth->plane.normal), truth->origin);
      }
    }
    const std::vector<FoundRound>& holes = rounds();
    if (holes.size() < 2) return;
    const Vector3 believed = holes[1].believed.back().centre - holes[0].believed.back().centre;
    const Vector3 truth = holes[1].truth.centre - holes[0].truth.centre;
    addAngle(found, degreesFromRadians(std::atan2(believed.y(), believed.x())),
             degreesFromRadians(std::atan2(truth.y(), truth.x())), both(holes[0].truth.origin, holes[1].truth.origin));
  }

  /// The angles about the first or the second axis in which controls tell the tilt of a plane.
  static std::array<double, 2> tiltOf(const Vector3& normal, int about) {
    const double leaning = normal[1 - about];
    return {degreesFromRadians(std::atan2(leaning, normal.z())),
            degreesFromRadians(std::asin(std::clamp(leaning, -1.0, 1.0)))};
  }

  void planeAngles(Explanations& found, int about) const {
    std::vector<Touches> sets = fitted("plane");
    if (sets.empty() && all_.size() >= 3) sets.push_back(all_);
    for (const Touches& set : sets) {
      const auto truth = trueFlat(set);
      if (!truth) continue;
      const auto upwards = [](const Vector3& normal) { return normal.z() < 0 ? Vector3(-normal) : normal; };
      const auto trueTilt = tiltOf(upwards(truth->plane.normal), about);
      for (const Plane& plane : believedFlats(set)) {
        const auto tilt = tiltOf(upwards(plane.normal), about);
        for (std::size_t i = 0; i < tilt.size(); ++i) {
          add(found, tilt[i], trueTilt[i], truth->origin);
          add(found, -tilt[i], -trueTilt[i], truth->origin);
        }
      }
    }
  }

  control::WorkingPlane plane_;
  const std::vector<FitRecord>& fits_;
  Touches all_;
  mutable std::optional<std::vector<FoundRound>> rounds_;
};

CycleFeatures::CycleFeatures(const TouchedCycle& cycle, const std::vector<FitRecord>& fits)
    : features_(std::make_unique<const Features>(cycle, fits)) {}
CycleFeatures::~CycleFeatures() = default;

std::vector<Explanation> CycleFeatures::explanations(const Characteristic& of) const { return features_->of(of); }

std::vector<Explanation> explanations(const Characteristic& of, const TouchedCycle& cycle,
                                      const std::vector<FitRecord>& fits) {
  return Features(cycle, fits).of(of);
}

}  // namespace probewright::truth
