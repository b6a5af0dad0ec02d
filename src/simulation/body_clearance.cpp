#include "simulation/body_clearance.hpp"

#include <fcl/narrowphase/distance.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "machine/links.hpp"
#include "simulation/body_mesh.hpp"
#include "simulation/link_motion.hpp"

namespace probewright::simulation {

using machine::Link;

namespace {

constexpr double ofTriangles = 0.045;  // mm: how far two drawings may leave the surfaces they stand for, together
constexpr double shortestStep = 0.05;  // mm
constexpr double reserve = 1.02;       // of a way: scales of axes, errors of their directions

}  // namespace

struct BodyClearance::Thing {
  std::shared_ptr<const Solid> solid;
  Link link;
  Pose linkFromSolid;
  std::string name;
  bool ofMachine = false;
  bool isBody = false;
  Vector3 centre = Vector3::Zero();  ///< of a ball about it, link frame
  double radius = 0;
  std::shared_ptr<const BodyMesh> triangles;
};

struct BodyClearance::Pair {
  const Thing* first = nullptr;
  const Thing* second = nullptr;
  std::unique_ptr<TrueKinematics> kinematics;
  machine::Between between;

  /// The distance, or less than it if that is more than `enough`.
  double gap(const Pose& firstFromSecond, double enough) const {
    const double byBounds = (firstFromSecond * second->centre - first->centre).norm() - first->radius - second->radius;
    if (byBounds > enough) return byBounds;
    if (first->triangles->num_tris == 0 || second->triangles->num_tris == 0) return 1e300;
    const fcl::DistanceRequestd request;
    fcl::DistanceResultd result;
    fcl::distance(first->triangles.get(), first->linkFromSolid, second->triangles.get(),
                  fcl::Transform3d(firstFromSecond * second->linkFromSolid), request, result);
    return std::max(result.min_distance, 0.0) - ofTriangles;
  }
};

struct BodyClearance::View {
  Link link;
  std::unique_ptr<TrueKinematics> kinematics;
  std::vector<PlacedSolid> solids;
  std::unique_ptr<Surroundings> surroundings;
};

std::string BodyClearance::Near::text() const {
  if (other.empty()) return fmt::format("the tool may touch the machine's \"{}\"", body);
  return fmt::format("the machine's \"{}\" may touch \"{}\"", body, other);
}

/// `second` is a body.
bool BodyClearance::counts(const Thing& first, const Thing& second) const {
  if (!second.isBody || first.link == second.link) return false;
  if (first.ofMachine && second.ofMachine && machine::areNeighbours(first.link, second.link)) return false;
  if (which_ == Pairs::All) return true;
  const auto carries = [](const Thing& thing, Link::Chain chain) {
    return !thing.link.isBed() && thing.link.chain == chain;
  };
  if (!first.isBody && !first.ofMachine) return !carries(second, Link::Chain::Table);
  return (carries(first, Link::Chain::Spindle) && carries(second, Link::Chain::Table)) ||
         (carries(first, Link::Chain::Table) && carries(second, Link::Chain::Spindle));
}

BodyClearance::BodyClearance(const Truth& truth, Pairs pairs)
    : machine_(trueDescription(truth.machine, truth.errors)), which_(pairs) {
  errors_.axes = truth.errors.axes;
  for (AxisErrors& axis : errors_.axes)
    axis.deviations.clear();
  const auto add = [&](const std::shared_ptr<const Solid>& solid, const Link& link, const Pose& linkFromSolid,
                       const std::string& name, bool ofMachine, bool isBody) {
    const Bounds bounds = solid->bounds();
    const Vector3 size = bounds.maximum - bounds.minimum;
    if (!(size.minCoeff() >= 0 && size.maxCoeff() < 1e7)) return;  // nothing, or without an end
    auto thing = std::make_unique<Thing>();
    thing->solid = solid;
    thing->link = link;
    thing->linkFromSolid = linkFromSolid;
    thing->name = name;
    thing->ofMachine = ofMachine;
    thing->isBody = isBody;
    thing->centre = linkFromSolid * (0.5 * (bounds.minimum + bounds.maximum));
    thing->radius = 0.5 * size.norm() + 0.1;
    thing->triangles = bodyMesh(solid);
    things_.push_back(std::move(thing));
  };
  for (const MachineBody& body : truth.bodies)
    add(body.solid, body.link, body.linkFromSolid, body.name, true, true);
  const Link table = machine::tableLink(machine_);
  for (const PlacedSolid& solid : truth.solids) {
    const bool onBed = solid.role == SolidRole::ToolProbe && machine_.mainSpindle;
    add(solid.solid, onBed ? Link{} : table, solid.tableFromSolid, solid.name, solid.ofMachine, false);
  }
  const auto kinematicsBetween = [&](const Link& first, const Link& second) {
    machine::Between chains = machine::between(machine_, first, second);
    machine::MachineDescription seen;
    seen.axes = machine_.axes;
    seen.tableChain = std::move(chains.first);
    seen.spindleChain = std::move(chains.second);
    return std::make_unique<TrueKinematics>(seen, errors_);
  };
  for (std::size_t i = 0; i < things_.size(); ++i) {
    for (std::size_t k = i + 1; k < things_.size(); ++k) {
      const Thing &first = *things_[k], &second = *things_[i];
      if (!counts(first, second)) continue;
      auto pair = std::make_unique<Pair>();
      pair->first = &first;
      pair->second = &second;
      pair->between = machine::between(machine_, first.link, second.link);
      pair->kinematics = kinematicsBetween(first.link, second.link);
      pairs_.push_back(std::move(pair));
    }
  }
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

BodyClearance::~BodyClearance() = default;

std::optional<BodyClearance::Near> BodyClearance::nearer(const Motion& motion, const Margins& margins,
                                                         const ToolShape& tool) const {
  const auto seen = [&](const TrueKinematics& kinematics) {
    return Motion{kinematics, motion.from, motion.to, motion.slidesAtStart, motion.startSeconds, motion.profile};
  };
  for (const auto& pair : pairs_) {
    const double margin = pair->first->isBody ? margins.bodies : margins.solids;
    const double way =
        reserve * (longestWay(pair->between.first, machine_.axes, motion, pair->first->centre, pair->first->radius) +
                   longestWay(pair->between.second, machine_.axes, motion, pair->second->centre, pair->second->radius));
    if (way == 0 && which_ == Pairs::SpindleAgainstTable) continue;
    const Motion relative = seen(*pair->kinematics);
    for (double fraction = 0;;) {
      const double left = way * (1 - fraction);
      const double free = pair->gap(relative.tableFromSpindleAt(fraction), margin + left) - margin;
      if (free <= 0) return Near{pair->second->name, pair->first->name};
      if (free > left || way == 0) break;
      // A gap that small would take steps without end.
      if (free < shortestStep) return Near{pair->second->name, pair->first->name};
      fraction = std::min(1.0, fraction + free / way);
    }
  }
  for (const auto& view : views_) {
    const Motion relative = seen(*view->kinematics);
    const Pose start = relative.tableFromSpindleAt(0);
    std::optional<std::size_t> touched;
    if (const auto touch = firstTouch(relative, 0, 1, tool, *view->surroundings, {.precision = 1e-3}))
      touched = touch->solid;
    else if (const auto shaft = shaftOverlap(start, tool, *view->surroundings))
      touched = shaft->solid;
    else if (const auto ball = ballOverlap(start, tool, *view->surroundings))
      touched = ball->solid;
    if (touched) return Near{view->solids[*touched].name, {}};
  }
  return std::nullopt;
}

}  // namespace probewright::simulation
