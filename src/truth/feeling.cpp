#include "truth/feeling.hpp"

#include <algorithm>

#include "base/number_text.hpp"

namespace probewright::truth {

std::optional<FeltFace> felt(const std::vector<simulation::PlacedSolid>& solids, const Vector3& from,
                             const Vector3& to) {
  constexpr double feeler = 0.005;  // mm
  std::optional<FeltFace> nearest;
  double first = 2;
  for (const simulation::PlacedSolid& placed : solids) {
    const Pose solidFromTable = placed.tableFromSolid.inverse();
    const auto contact = placed.solid->firstContact(solidFromTable * from, solidFromTable * to, feeler);
    if (!contact || contact->fraction >= first) continue;
    first = contact->fraction;
    nearest = FeltFace{placed.tableFromSolid * contact->touchPoint, placed.tableFromSolid.linear() * contact->normal};
  }
  return first > 0 ? nearest : std::nullopt;
}

std::optional<double> valueOf(const control::CycleRecord& cycle, std::string_view name) {
  const auto found = std::ranges::find(cycle.parameters, name, &control::ParameterRecord::name);
  return found == cycle.parameters.end() ? std::nullopt : found->number;
}

}  // namespace probewright::truth
