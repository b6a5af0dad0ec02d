#include "simulation/body_clearance.hpp"

#include <fcl/narrowphase/distance.h>
#include <fmt/format.h>

#include <algorithm>

#include "simulation/body_mesh.hpp"

namespace probewright::simulation {

namespace {

constexpr double ofTriangles = 0.045;  // mm: how far two drawings may leave the surfaces they stand for, together
constexpr double aboutDrawings = 0.1;  // mm: a ball about a solid with this more holds its drawing as well
constexpr double shortestStep = 0.05;  // mm
constexpr double boxesDo = 5;  // mm beyond the margin: boxes that far apart tell enough, triangles are not asked

/// What carries the tool against what carries the part, or against what lies on the table.
bool isSpindleAgainstTable(const BodyPair& pair) {
  using machine::Link;
  const BodyThing &first = *pair.first, &second = *pair.second;
  const auto carries = [](const BodyThing& thing, Link::Chain chain) {
    return !thing.link.isBed() && thing.link.chain == chain;
  };
  if (!first.isBody && !first.ofMachine) return !carries(second, Link::Chain::Table);
  return (carries(first, Link::Chain::Spindle) && carries(second, Link::Chain::Table)) ||
         (carries(first, Link::Chain::Table) && carries(second, Link::Chain::Spindle));
}

}  // namespace

std::string BodyClearance::Near::text() const {
  if (other.empty()) return fmt::format("the tool may touch the machine's \"{}\"", body);
  return fmt::format("the machine's \"{}\" may touch \"{}\"", body, other);
}

BodyClearance::BodyClearance(const Truth& truth, Pairs pairs) : scene_(truth), which_(pairs) {
  for (const BodyPair& pair : scene_.pairs())
    if (which_ == Pairs::All || isSpindleAgainstTable(pair)) pairs_.push_back(&pair);
  for (const BodyThing& thing : scene_.things())
    meshes_.push_back(bodyMesh(thing.solid));
}

/// The distance, or less than it if that is more than `enough`, or as long as the boxes are well apart.
double BodyClearance::gap(const BodyPair& pair, const Pose& firstFromSecond, double enough, double margin) const {
  const BodyThing &first = *pair.first, &second = *pair.second;
  const double byBalls = (firstFromSecond * second.centre - first.centre).norm() - first.radius - second.radius;
  if (byBalls - 2 * aboutDrawings > enough) return byBalls - 2 * aboutDrawings;
  const double byBounds =
      apartByBounds(first, first.linkFromSolid.inverse() * firstFromSecond * second.linkFromSolid, second) -
      2 * aboutDrawings;
  if (byBounds > std::min(enough, margin + boxesDo)) return byBounds;
  const BodyMesh &one = *meshes_[first.index], &other = *meshes_[second.index];
  if (one.num_tris == 0 || other.num_tris == 0) return 1e300;
  const fcl::DistanceRequestd request;
  fcl::DistanceResultd result;
  fcl::distance(&one, first.linkFromSolid, &other, fcl::Transform3d(firstFromSecond * second.linkFromSolid), request,
                result);
  return std::max(result.min_distance, 0.0) - ofTriangles;
}

std::optional<BodyClearance::Near> BodyClearance::nearer(const Motion& motion, const Margins& margins,
                                                         const ToolShape& tool) const {
  for (const BodyPair* counted : pairs_) {
    const BodyPair& pair = *counted;
    const double margin = pair.first->isBody ? margins.bodies : margins.solids;
    const double way = scene_.longestWay(pair, motion, aboutDrawings);
    if (way == 0 && which_ == Pairs::SpindleAgainstTable) continue;
    const Motion relative = BodyScene::seen(motion, *pair.kinematics);
    for (double fraction = 0;;) {
      const double left = way * (1 - fraction);
      const double free = gap(pair, relative.tableFromSpindleAt(fraction), margin + left, margin) - margin;
      if (free <= 0) return Near{pair.second->name, pair.first->name};
      if (free > left || way == 0) break;
      // A gap that small would take steps without end.
      if (free < shortestStep) return Near{pair.second->name, pair.first->name};
      fraction = std::min(1.0, fraction + free / way);
    }
  }
  for (const BodyView& view : scene_.views()) {
    const Motion relative = BodyScene::seen(motion, *view.kinematics);
    const Pose start = relative.tableFromSpindleAt(0);
    std::optional<std::size_t> touched;
    if (const auto touch = firstTouch(relative, 0, 1, tool, *view.surroundings, {.precision = 1e-3}))
      touched = touch->solid;
    else if (const auto shaft = shaftOverlap(start, tool, *view.surroundings))
      touched = shaft->solid;
    else if (const auto ball = ballOverlap(start, tool, *view.surroundings))
      touched = ball->solid;
    if (touched) return Near{view.solids[*touched].name, {}};
  }
  return std::nullopt;
}

}  // namespace probewright::simulation
