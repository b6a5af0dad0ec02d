#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "records/truth.hpp"
#include "simulation/truth.hpp"

/// What the families have in common where they compare tools with the truth.
namespace probewright::truth {

/// What a mill reaches beyond its radius and its length where it cuts: the tooth that goes furthest from the spindle's
/// axis, as it turns, and the one that goes furthest down. The axis of the tool may stand beside that of the spindle.
struct ToolReach {
  double radius = 0, length = 0;
  double rear = 0;  ///< from the end as drawn to where the edges end at the back, the furthest of them
};

inline ToolReach reachOf(const simulation::TrueTool* tool) {
  if (tool == nullptr || tool->cutter.insert) return {};
  const simulation::TrueCutter& cutter = tool->cutter;
  const Vector2& aside = cutter.eccentricity;
  const double whole = tool->length - cutter.holderLength;
  const double edges = cutter.cutLength > 0 ? std::min(cutter.cutLength, whole) : whole;
  if (cutter.teeth.empty()) return {aside.norm(), 0, edges};
  ToolReach reach{-1e9, -1e9, -1e9};
  for (const simulation::TrueTooth& tooth : cutter.teeth) {
    const double angle = radiansFromDegrees(tooth.angle), radius = tool->radius + tooth.radial - tooth.radialWear;
    const Vector2 edge = aside + radius * Vector2(std::cos(angle), std::sin(angle));
    reach.radius = std::max(reach.radius, edge.norm() - tool->radius);
    reach.length = std::max(reach.length, tooth.axial - tooth.axialWear - tooth.broken);
    reach.rear = std::max(reach.rear, edges - tooth.axial + tooth.axialWear);
  }
  return reach;
}

/// The theoretical tip of a turning tool, from where its length begins, in the frame of the tool: along the plane of
/// its insert (X), across (Y), along its axis (Z). The tangents to a worn nose have moved away from where it points.
inline Vector3 trueTip(const simulation::TrueTool& tool) {
  const simulation::TrueInsert& insert = *tool.cutter.insert;
  const double half = std::remainder(insert.secondNormal - insert.firstNormal, 360) / 2;
  const double middle = radiansFromDegrees(insert.firstNormal + half);
  const auto worn = [&](double pointing) {
    return std::abs(pointing) < 1e-6 ? 0 : std::copysign(insert.wear, pointing);
  };
  return {tool.cutter.eccentricity.x() - worn(std::cos(middle)), tool.cutter.eccentricity.y(),
          -tool.length - worn(std::sin(middle))};
}

inline const simulation::TrueTool* toolNumbered(const simulation::Truth& truth, int number) {
  const auto found = std::ranges::find(truth.tools, number, &simulation::TrueTool::number);
  return found == truth.tools.end() ? nullptr : &*found;
}

/// Collects numbers by the entry that they belong to.
class CollectedEntries {
public:
  void add(records::EntryKind kind, const std::string& name, std::optional<std::size_t> cycle,
           records::EntryValue value) {
    auto entry = std::ranges::find(entries_, name, &records::EntryTruth::name);
    if (entry == entries_.end()) {
      records::EntryTruth made;
      made.kind = kind;
      made.name = name;
      entry = entries_.insert(entries_.end(), std::move(made));
    }
    if (cycle) entry->cycle = std::max(entry->cycle.value_or(0), *cycle);
    entry->distance = std::max(entry->distance.value_or(0), std::abs(value.value - value.truth));
    entry->values.push_back(std::move(value));
  }
  std::vector<records::EntryTruth> take() { return std::move(entries_); }

private:
  std::vector<records::EntryTruth> entries_;
};

}  // namespace probewright::truth
