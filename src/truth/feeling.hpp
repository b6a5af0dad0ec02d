#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "control/journal.hpp"
#include "simulation/truth.hpp"

/// Looking for faces in the true world, for those who explain an alarm.
namespace probewright::truth {

/// How far is looked at beyond what is expected, mm.
inline constexpr double room = 60;

/// Where a face is, and how it stands there: its outward normal. Table frame.
struct FeltFace {
  Vector3 point = Vector3::Zero(), normal = Vector3::UnitZ();
};

/// What a small ball on its way first meets; nothing if the way is free or begins in material.
std::optional<FeltFace> felt(const std::vector<simulation::PlacedSolid>& solids, const Vector3& from,
                             const Vector3& to);

/// The number of a parameter of a call; nothing if it has none.
std::optional<double> valueOf(const control::CycleRecord& cycle, std::string_view name);

}  // namespace probewright::truth
