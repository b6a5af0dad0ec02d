#include "simulation/body_scene.hpp"

#include <algorithm>
#include <utility>

#include "simulation/link_motion.hpp"

namespace probewright::simulation {

using machine::Link;

namespace {

constexpr double reserve = 1.02;  // of a way: scales of axes, errors of their directions

/// The distance of a point from a box; 0 within.
double distance(const Vector3& point, const Bounds& box) {
  return (box.minimum - point).cwiseMax(point - box.maximum).cwiseMax(0).norm();
}

}  // namespace

double boxDistance(const Bounds& first, const Pose& firstFromSecond, const Bounds& second) {
  const Vector3 centre = firstFromSecond * (0.5 * (second.minimum + second.maximum));
  const Vector3 reach = 0.5 * (firstFromSecond.linear().cwiseAbs() * (second.maximum - second.minimum));
  return (first.minimum - centre - reach).cwiseMax(centre - reach - first.maximum).cwiseMax(0).norm();
}

double apartByBounds(const BodyThing& first, const Pose& firstFromSecond, const BodyThing& second) {
  const Vector3 firstMiddle = 0.5 * (first.bounds.minimum + first.bounds.maximum),
                secondMiddle = 0.5 * (second.bounds.minimum + second.bounds.maximum);
  const Pose back = firstFromSecond.inverse();
  return std::max({(firstFromSecond * secondMiddle - firstMiddle).norm() - first.radius - second.radius,
                   distance(firstFromSecond * secondMiddle, first.bounds) - second.radius,
                   distance(back * firstMiddle, second.bounds) - first.radius,
                   boxDistance(first.bounds, firstFromSecond, second.bounds),
                   boxDistance(second.bounds, back, first.bounds)});
}

BodyScene::BodyScene(const Truth& truth) : machine_(trueDescription(truth.machine, truth.errors)) {
  errors_.axes = truth.errors.axes;
  for (AxisErrors& axis : errors_.axes)
    axis.deviations.clear();
  things_.reserve(truth.bodies.size() + truth.solids.size());  // pairs point to them
  for (const MachineBody& body : truth.bodies)
    addThing(body.solid, body.link, body.linkFromSolid, body.name, Kind::Body);
  const Link table = machine::tableLink(machine_);
  for (const PlacedSolid& solid : truth.solids) {
    // Tool touch probes of a lathe stand on its bed.
    const bool onBed = solid.role == SolidRole::ToolProbe && machine_.mainSpindle;
    addThing(solid.solid, onBed ? Link{} : table, solid.tableFromSolid, solid.name,
             solid.ofMachine ? Kind::OfMachine : Kind::Other);
  }
  addPairs();
  addViews();
}

void BodyScene::addThing(std::shared_ptr<const Solid> solid, const Link& link, const Pose& linkFromSolid,
                         std::string name, Kind kind) {
  BodyThing thing;
  thing.bounds = solid->bounds();
  const Vector3 size = thing.bounds.maximum - thing.bounds.minimum;
  if (!(size.minCoeff() >= 0 && size.maxCoeff() < 1e7)) return;  // nothing, or without an end
  thing.index = things_.size();
  thing.centre = linkFromSolid * (0.5 * (thing.bounds.minimum + thing.bounds.maximum));
  thing.radius = 0.5 * size.norm();
  thing.solid = std::move(solid);
  thing.link = link;
  thing.linkFromSolid = linkFromSolid;
  thing.name = std::move(name);
  thing.ofMachine = kind != Kind::Other;
  thing.isBody = kind == Kind::Body;
  things_.push_back(std::move(thing));
}

std::shared_ptr<const TrueKinematics> BodyScene::kinematicsBetween(const Link& first, const Link& second) const {
  machine::Between chains = machine::between(machine_, first, second);
  machine::MachineDescription seen;
  seen.axes = machine_.axes;
  seen.tableChain = std::move(chains.first);
  seen.spindleChain = std::move(chains.second);
  return std::make_shared<const TrueKinematics>(seen, errors_);
}

void BodyScene::addPairs() {
  for (std::size_t i = 0; i < things_.size(); ++i) {
    for (std::size_t k = i + 1; k < things_.size(); ++k) {
      const BodyThing &first = things_[k], &second = things_[i];  // bodies come before what lies on the table
      if (!second.isBody || first.link == second.link) continue;
      if (first.ofMachine && second.ofMachine && machine::areNeighbours(first.link, second.link)) continue;
      const auto alike = std::ranges::find_if(pairs_, [&](const BodyPair& pair) {
        return pair.first->link == first.link && pair.second->link == second.link;
      });
      if (alike != pairs_.end()) {
        pairs_.push_back({&first, &second, alike->kinematics, alike->between});
      } else {
        pairs_.push_back({&first, &second, kinematicsBetween(first.link, second.link),
                          machine::between(machine_, first.link, second.link)});
      }
    }
  }
}

void BodyScene::addViews() {
  const Link head = machine::headLink(machine_);
  for (const BodyThing& thing : things_) {
    if (!thing.isBody || thing.link == head) continue;
    auto view = std::ranges::find(views_, thing.link, &BodyView::link);
    if (view == views_.end())
      view = views_.insert(views_.end(), BodyView{thing.link, kinematicsBetween(thing.link, head), {}, nullptr});
    view->solids.push_back({.solid = thing.solid,
                            .tableFromSolid = thing.linkFromSolid,
                            .name = thing.name,
                            .role = SolidRole::Fixture,
                            .ofMachine = true});
  }
  for (BodyView& view : views_)
    view.surroundings = std::make_unique<Surroundings>(view.solids);
}

double BodyScene::longestWay(const BodyPair& pair, const Motion& motion, double more) const {
  const auto of = [&](const std::vector<machine::ChainElement>& chain, const BodyThing& thing) {
    return simulation::longestWay(chain, machine_.axes, motion, thing.centre, thing.radius + more);
  };
  return reserve * (of(pair.between.first, *pair.first) + of(pair.between.second, *pair.second));
}

Motion BodyScene::seen(const Motion& motion, const TrueKinematics& kinematics) {
  return {kinematics, motion.from, motion.to, motion.slidesAtStart, motion.startSeconds, motion.profile};
}

}  // namespace probewright::simulation
