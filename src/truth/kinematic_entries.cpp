#include <algorithm>
#include <cmath>
#include <string_view>

#include "truth/entries.hpp"
#include "truth/family_truth.hpp"

namespace probewright::truth {

namespace {

using machine::ChainElement;
using machine::MachineDescription;

/// The element that turns with the axis.
const ChainElement* elementOf(const MachineDescription& machine, std::size_t axis) {
  for (const auto* chain : {&machine.tableChain, &machine.spindleChain})
    for (const ChainElement& element : *chain)
      if (element.axis == axis) return &element;
  return nullptr;
}

std::optional<std::size_t> lastWriter(const control::Journal& journal, const FamilyTruth& family) {
  std::optional<std::size_t> last;
  for (std::size_t i = 0; i < journal.cycles.size(); ++i) {
    const auto& writes = journal.cycles[i].writes;
    if (std::ranges::any_of(writes,
                            [&](const control::WriteRecord& write) { return family.isOfKinematics(write.table); }))
      last = i;
  }
  return last;
}

}  // namespace

std::vector<records::EntryTruth> kinematicEntries(const session::RunOutcome& outcome, const simulation::Truth& truth) {
  std::vector<records::EntryTruth> entries;
  const FamilyTruth* family = familyTruth(outcome.control);
  if (family == nullptr) return entries;
  const auto cycle = lastWriter(outcome.journal, *family);
  if (!cycle || !outcome.believedMachine) return entries;
  const MachineDescription real = simulation::trueDescription(truth.machine, truth.errors);
  for (std::size_t axis = 0; axis < real.axes.size(); ++axis) {
    if (real.axes[axis].kind != machine::AxisKind::Rotary) continue;
    const ChainElement* believed = elementOf(*outcome.believedMachine, axis);
    const ChainElement* planted = elementOf(real, axis);
    if (believed == nullptr || planted == nullptr) continue;
    // The point of the true axis that is level with the believed one.
    const Vector3 direction = planted->direction;
    const Vector3 point = planted->point + direction * direction.dot(believed->point - planted->point);
    records::EntryTruth entry;
    entry.kind = records::EntryKind::Kinematics;
    entry.name = "axis " + real.axes[axis].name;
    entry.cycle = cycle;
    for (int i = 0; i < 3; ++i) {
      if (std::abs(direction[i]) > 0.9) continue;
      entry.values.push_back({std::string(1, "XYZ"[i]), "mm", believed->point[i], point[i]});
    }
    entry.distance = (believed->point - point).norm();
    const double across = believed->direction.cross(direction).norm();
    entry.angle = degreesFromRadians(std::atan2(across, std::abs(believed->direction.dot(direction))));
    entries.push_back(std::move(entry));
  }
  return entries;
}

}  // namespace probewright::truth
