#include "simulation/body_guard.hpp"

#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <cmath>

#include "simulation/body_mesh.hpp"
#include "simulation/link_motion.hpp"

namespace probewright::simulation {

using machine::AxisKind;
using machine::AxisPositions;
using machine::Link;

namespace {

constexpr double touching = 0.002;      // mm: no gap
constexpr double shortestStep = 0.02;   // mm
constexpr double toolPrecision = 1e-3;  // mm
constexpr double reserve = 1.02;        // of a way: scales of axes, errors of their directions
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

/// The distance of a point from a box; 0 within.
double distance(const Vector3& point, const Bounds& box) {
  return (box.minimum - point).cwiseMax(point - box.maximum).cwiseMax(0).norm();
}

/// How far two boxes are apart at least: the second one within the smallest box about it that is parallel to the first.
double boxDistance(const Bounds& first, const Pose& firstFromSecond, const Bounds& second) {
  const Vector3 centre = firstFromSecond * (0.5 * (second.minimum + second.maximum));
  const Vector3 reach = 0.5 * (firstFromSecond.linear().cwiseAbs() * (second.maximum - second.minimum));
  return (first.minimum - centre - reach).cwiseMax(centre - reach - first.maximum).cwiseMax(0).norm();
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

/// A body, or a solid on the table.
struct BodyGuard::Thing {
  std::shared_ptr<const Solid> solid;
  Link link;
  Pose linkFromSolid;
  std::string name;
  bool ofMachine = false;  ///< the machine's own: it may touch its neighbours
  bool isBody = false;
  Bounds bounds;                     ///< solid's frame
  Vector3 centre = Vector3::Zero();  ///< of a ball about it, link frame
  double radius = 0;
  std::shared_ptr<const BodyMesh> triangles;  ///< solid's frame; made when they are needed

  const BodyMesh& mesh() {
    if (!triangles) triangles = bodyMesh(solid);
    return *triangles;
  }
};

struct BodyGuard::Pair {
  Thing* first = nullptr;
  Thing* second = nullptr;
  std::unique_ptr<TrueKinematics> kinematics;  ///< "table" and "spindle" of it are the two links
  machine::Between between;
  double clear = 0;       ///< mm: they are not closer than that where the axes stand
  bool fromStart = true;  ///< they have never been apart: not tested until they are

  /// On the motion asked for last: where they were, and how far apart at least.
  struct Known {
    double fraction = 0, gap = 0;
  };
  std::vector<Known> known;
  double way = 0;  ///< how far they may travel against each other on it
};

/// The bodies of one link as the tool sees them.
struct BodyGuard::View {
  Link link;
  std::unique_ptr<TrueKinematics> kinematics;
  std::vector<PlacedSolid> solids;
  std::unique_ptr<Surroundings> surroundings;
  bool fromStart = true;  ///< the tool has never been free of them
  Bounds toolBox;         ///< of the tool that was asked for last
  double clear = 0;       ///< mm: the tool is not closer than that where the axes stand
  double way = 0;         ///< how far it may travel on the motion asked for last

  /// How far the tool is from the bodies at least, by boxes about them.
  double gap(const Pose& linkFromSpindle) const {
    double least = 1e300;
    for (const Surroundings::Item& item : surroundings->items())
      least = std::min(least, boxDistance(item.bounds, item.solidFromTable * linkFromSpindle, toolBox));
    return least;
  }
};

BodyGuard::BodyGuard(const Truth& truth) : machine_(trueDescription(truth.machine, truth.errors)) {
  errors_.axes = truth.errors.axes;
  for (AxisErrors& axis : errors_.axes)
    axis.deviations.clear();
  for (const MachineBody& body : truth.bodies)
    addThing(body.solid, body.link, body.linkFromSolid, body.name, true, true);
  const Link table = machine::tableLink(machine_);
  for (const PlacedSolid& solid : truth.solids) {
    // Tool touch probes of a lathe stand on its bed.
    const bool onBed = solid.role == SolidRole::ToolProbe && machine_.mainSpindle;
    addThing(solid.solid, onBed ? Link{} : table, solid.tableFromSolid, solid.name, solid.ofMachine, false);
  }
  addPairs();
  addViews();
}

BodyGuard::~BodyGuard() = default;

void BodyGuard::addThing(std::shared_ptr<const Solid> solid, const Link& link, const Pose& linkFromSolid,
                         std::string name, bool ofMachine, bool isBody) {
  auto thing = std::make_unique<Thing>();
  thing->bounds = solid->bounds();
  const Vector3 size = thing->bounds.maximum - thing->bounds.minimum;
  if (!(size.minCoeff() >= 0 && size.maxCoeff() < 1e7)) return;  // nothing, or without an end
  thing->centre = linkFromSolid * (0.5 * (thing->bounds.minimum + thing->bounds.maximum));
  thing->radius = 0.5 * size.norm();
  thing->solid = std::move(solid);
  thing->link = link;
  thing->linkFromSolid = linkFromSolid;
  thing->name = std::move(name);
  thing->ofMachine = ofMachine;
  thing->isBody = isBody;
  things_.push_back(std::move(thing));
}

std::unique_ptr<TrueKinematics> BodyGuard::kinematicsBetween(const Link& first, const Link& second) const {
  machine::Between chains = machine::between(machine_, first, second);
  machine::MachineDescription seen;
  seen.axes = machine_.axes;
  seen.tableChain = std::move(chains.first);
  seen.spindleChain = std::move(chains.second);
  return std::make_unique<TrueKinematics>(seen, errors_);
}

void BodyGuard::addPairs() {
  for (std::size_t i = 0; i < things_.size(); ++i) {
    for (std::size_t k = i + 1; k < things_.size(); ++k) {
      Thing &first = *things_[k], &second = *things_[i];  // bodies come before what lies on the table
      if (!second.isBody || first.link == second.link) continue;
      if (first.ofMachine && second.ofMachine && machine::areNeighbours(first.link, second.link)) continue;
      auto pair = std::make_unique<Pair>();
      pair->first = &first;
      pair->second = &second;
      pair->between = machine::between(machine_, first.link, second.link);
      pair->kinematics = kinematicsBetween(first.link, second.link);
      pairs_.push_back(std::move(pair));
    }
  }
}

void BodyGuard::addViews() {
  const Link head = machine::headLink(machine_);
  for (const auto& thing : things_) {
    if (!thing->isBody || thing->link == head) continue;
    auto view = std::ranges::find_if(views_, [&](const auto& known) { return known->link == thing->link; });
    if (view == views_.end()) {
      auto added = std::make_unique<View>();
      added->link = thing->link;
      added->kinematics = kinematicsBetween(thing->link, head);
      view = views_.insert(views_.end(), std::move(added));
    }
    (*view)->solids.push_back({thing->solid, thing->linkFromSolid, thing->name, SolidRole::Fixture, true});
  }
  for (const auto& view : views_)
    view->surroundings = std::make_unique<Surroundings>(view->solids);
}

Motion BodyGuard::seen(const Motion& motion, const TrueKinematics& kinematics) const {
  return {kinematics, motion.from, motion.to, motion.slidesAtStart, motion.startSeconds, motion.profile};
}

Pose BodyGuard::tableFromLink(const Link& link, const AxisPositions& slides) const {
  return machine::baseFromTable(machine_, slides).inverse() * machine::baseFromLink(machine_, slides, link);
}

BodyHit BodyGuard::hitOf(const Pair& pair, const Motion& motion, double fraction, const Vector3& point,
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

BodyHit BodyGuard::hitOf(const View& view, const Touch& touch, const Pose& tableFromLink) const {
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
double BodyGuard::gap(Pair& pair, const Pose& firstFromSecond, double enough, Vector3* point, Vector3* normal) {
  Thing &first = *pair.first, &second = *pair.second;
  const Pose between = first.linkFromSolid.inverse() * firstFromSecond * second.linkFromSolid;
  const Vector3 firstMiddle = 0.5 * (first.bounds.minimum + first.bounds.maximum),
                secondMiddle = 0.5 * (second.bounds.minimum + second.bounds.maximum);
  const Pose back = between.inverse();
  const double byBounds =
      std::max({(between * secondMiddle - firstMiddle).norm() - first.radius - second.radius,
                distance(between * secondMiddle, first.bounds) - second.radius,
                distance(back * firstMiddle, second.bounds) - first.radius,
                boxDistance(first.bounds, between, second.bounds), boxDistance(second.bounds, back, first.bounds)});
  if (byBounds > enough || (byBounds > boxesDo && point == nullptr)) return byBounds;
  const BodyMesh &one = first.mesh(), &other = second.mesh();
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
  pair.way =
      reserve * (longestWay(pair.between.first, machine_.axes, motion, pair.first->centre, pair.first->radius) +
                 longestWay(pair.between.second, machine_.axes, motion, pair.second->centre, pair.second->radius));
  pair.known.assign(1, {0, pair.clear});
  if (pair.way == 0 || pair.clear > pair.way * end) return std::nullopt;
  const Motion relative = seen(motion, *pair.kinematics);
  const auto gapAt = [&](double fraction, double enough) {
    return gap(pair, relative.tableFromSpindleAt(fraction), enough, nullptr, nullptr);
  };
  const auto hitAt = [&](double fraction) {
    Vector3 point = Vector3::Zero(), normal = Vector3::UnitZ();
    gap(pair, relative.tableFromSpindleAt(fraction), 1e300, &point, &normal);
    return hitOf(pair, motion, fraction, point, normal);
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
    if (apart > pair.way * (end - fraction) || fraction >= end) return std::nullopt;
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
  const auto shift = longestShift(machine_.axes, motion);
  for (const auto& pair : pairs_) {
    if (shift && pair->clear > *shift * reach) {
      pair->way = *shift;
      pair->known.assign(1, {0, pair->clear});
      continue;
    }
    auto hit = approach(*pair, motion, reach, mode, stop);
    if (!hit || (first && hit->fraction >= first->fraction)) continue;
    reach = hit->fraction;
    first = std::move(hit);
  }
  const SearchOptions options{.precision = toolPrecision, .stop = &stop};
  const Bounds toolBox = boundsOf(tool);
  const bool anyTool = toolBox.minimum.x() <= toolBox.maximum.x();
  for (const auto& view : views_) {
    if (!anyTool) continue;
    if (view->toolBox.minimum != toolBox.minimum || view->toolBox.maximum != toolBox.maximum) view->clear = 0;
    view->toolBox = toolBox;
    view->way = shift.value_or(1e300);
    if (shift && view->clear > *shift * reach + toolPrecision) continue;
    const Motion relative = seen(motion, *view->kinematics);
    if (shift) {
      view->clear = view->gap(relative.tableFromSpindleAt(0));
      if (view->clear > *shift * reach + toolPrecision) {
        view->fromStart = false;
        continue;
      }
    }
    if (mode == Touching::MayBePulledOff || view->fromStart) {
      const Pose start = relative.tableFromSpindleAt(0);
      if (shaftOverlap(start, tool, *view->surroundings) || ballOverlap(start, tool, *view->surroundings)) continue;
      view->fromStart = false;
    }
    const auto touch = firstTouch(relative, 0, reach, tool, *view->surroundings, options);
    if (!touch || (first && touch->fraction >= first->fraction)) continue;
    reach = touch->fraction;
    first = hitOf(*view, *touch, tableFromLink(view->link, motion.slidesAt(touch->fraction)));
  }
  return first;
}

void BodyGuard::arrived(double fraction) {
  for (const auto& pair : pairs_) {
    double clear = 0;
    for (const Pair::Known& known : pair->known)
      clear = std::max(clear, known.gap - pair->way * std::abs(fraction - known.fraction));
    pair->clear = clear;
    pair->known.clear();
  }
  for (const auto& view : views_) {
    view->clear = std::max(0.0, view->clear - view->way * fraction);
    view->way = 1e300;  // until a motion is asked for
  }
}

void BodyGuard::forget() {
  for (const auto& pair : pairs_) {
    pair->clear = 0;
    pair->known.clear();
  }
  for (const auto& view : views_)
    view->clear = 0;
}

std::optional<BodyHit> BodyGuard::standing(const AxisPositions& slides, double seconds) {
  for (const auto& pair : pairs_) {
    Vector3 point = Vector3::Zero(), normal = Vector3::UnitZ();
    const Pose pose = pair->kinematics->tableFromSpindle(slides, seconds);
    if (gap(*pair, pose, touching, nullptr, nullptr) > touching) continue;
    gap(*pair, pose, 1e300, &point, &normal);
    const Motion motion{*pair->kinematics, slides, slides, slides, seconds, MotionProfile(0, 1, 1)};
    return hitOf(*pair, motion, 0, point, normal);
  }
  return std::nullopt;
}

std::optional<BodyHit> BodyGuard::standing(const AxisPositions& slides, double seconds, const ToolShape& tool) {
  for (const auto& view : views_) {
    const Pose pose = view->kinematics->tableFromSpindle(slides, seconds);
    auto touch = shaftOverlap(pose, tool, *view->surroundings);
    if (!touch) touch = ballOverlap(pose, tool, *view->surroundings);
    if (touch) return hitOf(*view, *touch, tableFromLink(view->link, slides));
  }
  return std::nullopt;
}

}  // namespace probewright::simulation
