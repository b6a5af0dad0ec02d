#include "simulation/body_guard.hpp"

#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <cmath>

#include "simulation/body_mesh.hpp"

namespace probewright::simulation {

using machine::AxisKind;
using machine::AxisPositions;
using machine::Link;

namespace {

constexpr double touching = 0.002;      // mm: no gap
constexpr double shortestStep = 0.02;   // mm
constexpr double toolPrecision = 1e-3;  // mm
constexpr double reserve = 1.02;        // of a way, as in BodyScene
constexpr double boxesDo = 5;           // mm: boxes farther apart than that tell enough, triangles are not asked

/// How far any point of any link may travel against any other; nothing if an axis turns.
std::optional<double> longestShift(const std::vector<machine::Axis>& axes, const Motion& motion) {
  double way = 0;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const double travel = std::abs(motion.to[i] - motion.from[i]);
    if (travel > 0 && axes[i].kind != AxisKind::Linear) return std::nullopt;
    way += travel;
  }
  return reserve * way;
}

/// A box about a tool, spindle frame; empty if there is nothing of it.
Bounds boundsOf(const ToolShape& tool) {
  Bounds box;
  const auto hold = [&](const Vector3& point, double radius) {
    box.minimum = box.minimum.cwiseMin(point - Vector3::Constant(radius));
    box.maximum = box.maximum.cwiseMax(point + Vector3::Constant(radius));
  };
  for (const Ball& ball : tool.balls)
    hold(ball.centre, ball.radius);
  for (const Shaft& shaft : tool.shafts) {
    hold(shaft.start, shaft.radius);
    hold(shaft.start + shaft.axis, shaft.radius);
  }
  return box;
}

}  // namespace

struct BodyGuard::Pair {
  const BodyPair* of = nullptr;
  double clear = 0;       ///< mm: they are not closer than that where the axes stand
  bool fromStart = true;  ///< they have never been apart: not tested until they are

  /// On the motion asked for last: where they were, and how far apart at least.
  struct Known {
    double fraction = 0, gap = 0;
  };
  std::vector<Known> known;
  bool shifts = false;  ///< nothing of it had to be asked: it only takes its way off the distance
  double way = 0;       ///< how far they may travel against each other on it
};

struct BodyGuard::View {
  const BodyView* of = nullptr;
  bool fromStart = true;  ///< the tool has never been free of the bodies
  Bounds toolBox;         ///< of the tool that was asked for last
  double clear = 0;       ///< mm: the tool is not closer than that where the axes stand
  double way = 0;         ///< how far it may travel on the motion asked for last

  /// How far the tool is from the bodies at least, by boxes about them.
  double gap(const Pose& linkFromSpindle) const {
    double least = 1e300;
    for (const Surroundings::Item& item : of->surroundings->items())
      least = std::min(least, boxDistance(item.bounds, item.solidFromTable * linkFromSpindle, toolBox));
    return least;
  }
};

BodyGuard::BodyGuard(const Truth& truth) : scene_(truth), meshes_(scene_.things().size()) {
  for (const BodyPair& pair : scene_.pairs())
    pairs_.push_back({.of = &pair, .known = {}});
  for (const BodyView& view : scene_.views())
    views_.push_back({.of = &view, .toolBox = {}});
}

BodyGuard::~BodyGuard() = default;

const BodyMesh& BodyGuard::meshOf(const BodyThing& thing) {
  auto& mesh = meshes_[thing.index];
  if (!mesh) mesh = bodyMesh(thing.solid);
  return *mesh;
}

Pose BodyGuard::tableFromLink(const Link& link, const AxisPositions& slides) const {
  return machine::baseFromTable(scene_.machine(), slides).inverse() *
         machine::baseFromLink(scene_.machine(), slides, link);
}

BodyHit BodyGuard::hitOf(const BodyPair& pair, const Motion& motion, double fraction, const Vector3& point,
                         const Vector3& normal) const {
  const Pose tableFromFirst = tableFromLink(pair.first->link, motion.slidesAt(fraction));
  BodyHit hit;
  hit.fraction = fraction;
  hit.body = pair.second->name;
  hit.other = pair.first->name;
  hit.point = tableFromFirst * point;
  hit.normal = tableFromFirst.linear() * normal;
  return hit;
}

BodyHit BodyGuard::hitOf(const BodyView& view, const Touch& touch, const Pose& tableFromLink) const {
  BodyHit hit;
  hit.fraction = touch.fraction;
  hit.byTool = true;
  hit.shaft = touch.shaft;
  hit.body = view.solids[touch.solid].name;
  hit.point = tableFromLink * touch.point;
  hit.normal = tableFromLink.linear() * touch.normal;
  return hit;
}

/// The distance, or less than it if that is `enough`, or as long as their boxes are apart and nobody asks for the
/// point. At 0 they touch.
double BodyGuard::gap(const BodyPair& pair, const Pose& firstFromSecond, double enough, Vector3* point,
                      Vector3* normal) {
  const BodyThing &first = *pair.first, &second = *pair.second;
  const Pose between = first.linkFromSolid.inverse() * firstFromSecond * second.linkFromSolid;
  const double byBounds = apartByBounds(first, between, second);
  if (byBounds > enough || (byBounds > boxesDo && point == nullptr)) return byBounds;
  const BodyMesh &one = meshOf(first), &other = meshOf(second);
  if (one.num_tris == 0 || other.num_tris == 0) return 1e300;
  fcl::DistanceRequestd request(point != nullptr);
  fcl::DistanceResultd result;
  fcl::distance(&one, fcl::Transform3d::Identity(), &other, between, request, result);
  if (point != nullptr) {
    *point = first.linkFromSolid * result.nearest_points[0];
    const Vector3 apart = first.linkFromSolid.linear() * (result.nearest_points[1] - result.nearest_points[0]);
    if (apart.norm() > 1e-12) *normal = apart.normalized();
  }
  return std::max(result.min_distance, 0.0);
}

std::optional<BodyHit> BodyGuard::approach(Pair& pair, const Motion& motion, double end, Touching mode,
                                           const std::stop_token& stop) {
  pair.way = scene_.longestWay(*pair.of, motion);
  pair.shifts = false;
  pair.known.assign(1, {0, pair.clear});
  if (pair.way == 0 || pair.clear > pair.way * end) return std::nullopt;
  const Motion relative = BodyScene::seen(motion, *pair.of->kinematics);
  const auto gapAt = [&](double fraction, double enough) {
    return gap(*pair.of, relative.tableFromSpindleAt(fraction), enough, nullptr, nullptr);
  };
  const auto hitAt = [&](double fraction) {
    Vector3 point = Vector3::Zero(), normal = Vector3::UnitZ();
    gap(*pair.of, relative.tableFromSpindleAt(fraction), 1e300, &point, &normal);
    return hitOf(*pair.of, motion, fraction, point, normal);
  };
  const double step = shortestStep / pair.way;
  double fraction = 0, before = 0;
  double apart = gapAt(0, pair.way * end);
  if (apart > touching) pair.fromStart = false;
  if (apart <= touching) {
    if (pair.fromStart) return std::nullopt;
    // Coming apart is fine.
    const double further = gapAt(std::min(step, end), 1e300);
    if (further <= apart) return mode == Touching::MayBePulledOff ? std::nullopt : std::optional(hitAt(0));
    fraction = std::min(step, end);
    apart = std::max(further, 2 * touching);
  }
  for (;;) {
    if (stop.stop_requested()) throw SearchStopped{before};
    pair.known.push_back({fraction, apart});
    if (apart > pair.way * (end - fraction)) return std::nullopt;
    before = fraction;
    fraction = std::min(end, fraction + std::max(apart / pair.way, step));
    apart = gapAt(fraction, pair.way * (end - fraction) + shortestStep);
    if (apart > touching) continue;
    double free = before;
    while (apart <= 0 && (fraction - free) * pair.way > touching) {
      const double middle = 0.5 * (free + fraction), there = gapAt(middle, 1e300);
      if (there > 0) {
        free = middle;
      } else {
        fraction = middle;
      }
    }
    return hitAt(apart <= 0 ? free : fraction);
  }
}

std::optional<BodyHit> BodyGuard::firstHit(const Motion& motion, double end, const ToolShape& tool, Touching mode,
                                           const std::stop_token& stop) {
  std::optional<BodyHit> first;
  double reach = end;
  const auto shift = longestShift(scene_.machine().axes, motion);
  for (Pair& pair : pairs_) {
    if (shift && pair.clear > *shift * reach) {
      pair.way = *shift;
      pair.shifts = true;
      continue;
    }
    auto hit = approach(pair, motion, reach, mode, stop);
    if (!hit || (first && hit->fraction >= first->fraction)) continue;
    reach = hit->fraction;
    first = std::move(hit);
  }
  if (views_.empty()) return first;
  const SearchOptions options{.precision = toolPrecision, .stop = &stop};
  const Bounds toolBox = boundsOf(tool);
  const bool anyTool = toolBox.minimum.x() <= toolBox.maximum.x();
  for (View& view : views_) {
    if (!anyTool) continue;
    if (view.toolBox.minimum != toolBox.minimum || view.toolBox.maximum != toolBox.maximum) view.clear = 0;
    view.toolBox = toolBox;
    view.way = shift.value_or(1e300);
    if (shift && view.clear > *shift * reach + toolPrecision) continue;
    const Motion relative = BodyScene::seen(motion, *view.of->kinematics);
    if (shift) {
      view.clear = view.gap(relative.tableFromSpindleAt(0));
      if (view.clear > *shift * reach + toolPrecision) {
        view.fromStart = false;
        continue;
      }
    }
    if (mode == Touching::MayBePulledOff || view.fromStart) {
      const Pose start = relative.tableFromSpindleAt(0);
      if (shaftOverlap(start, tool, *view.of->surroundings) || ballOverlap(start, tool, *view.of->surroundings))
        continue;
      view.fromStart = false;
    }
    const auto touch = firstTouch(relative, 0, reach, tool, *view.of->surroundings, options);
    if (!touch || (first && touch->fraction >= first->fraction)) continue;
    reach = touch->fraction;
    first = hitOf(*view.of, *touch, tableFromLink(view.of->link, motion.slidesAt(touch->fraction)));
  }
  return first;
}

void BodyGuard::arrived(double fraction) {
  for (Pair& pair : pairs_) {
    if (pair.shifts) {
      pair.clear = std::max(0.0, pair.clear - pair.way * fraction);
      pair.shifts = false;
      pair.known.clear();
      continue;
    }
    double clear = 0;
    for (const Pair::Known& known : pair.known)
      clear = std::max(clear, known.gap - pair.way * std::abs(fraction - known.fraction));
    pair.clear = clear;
    pair.known.clear();
  }
  for (View& view : views_) {
    view.clear = std::max(0.0, view.clear - view.way * fraction);
    view.way = 1e300;  // until a motion is asked for
  }
}

void BodyGuard::forget() {
  for (Pair& pair : pairs_) {
    pair.clear = 0;
    pair.shifts = false;
    pair.known.clear();
  }
  for (View& view : views_)
    view.clear = 0;
}

std::optional<BodyHit> BodyGuard::standing(const AxisPositions& slides, double seconds) {
  for (const BodyPair& pair : scene_.pairs()) {
    Vector3 point = Vector3::Zero(), normal = Vector3::UnitZ();
    const Pose pose = pair.kinematics->tableFromSpindle(slides, seconds);
    if (gap(pair, pose, touching, nullptr, nullptr) > touching) continue;
    gap(pair, pose, 1e300, &point, &normal);
    const Motion motion{*pair.kinematics, slides, slides, slides, seconds, MotionProfile(0, 1, 1)};
    return hitOf(pair, motion, 0, point, normal);
  }
  return std::nullopt;
}

std::optional<BodyHit> BodyGuard::standing(const AxisPositions& slides, double seconds, const ToolShape& tool) {
  for (const BodyView& view : scene_.views()) {
    const Pose pose = view.kinematics->tableFromSpindle(slides, seconds);
    auto touch = shaftOverlap(pose, tool, *view.surroundings);
    if (!touch) touch = ballOverlap(pose, tool, *view.surroundings);
    if (touch) return hitOf(view, *touch, tableFromLink(view.link, slides));
  }
  return std::nullopt;
}

}  // namespace probewright::simulation
