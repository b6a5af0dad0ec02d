#include "truth/expected_feature.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "control/working_plane.hpp"
#include "truth/feeling.hpp"

namespace probewright::truth {

namespace {

bool isSinumerik(const control::CycleRecord& cycle) { return cycle.name.starts_with("CYCLE"); }

}  // namespace

std::optional<ExpectedRound> expectedRound(const control::CycleRecord& cycle, int tool, const Vector3& start) {
  const control::WorkingPlane plane = control::WorkingPlane::ofToolAxis("XYZ"[tool]);
  if (isSinumerik(cycle)) {
    const auto diameter = valueOf(cycle, "S_SETV");
    const auto variant = valueOf(cycle, "S_MVAR");
    // Units: the feature. 1 hole, 2 spigot.
    const int feature = variant ? static_cast<int>(*variant) % 10 : 0;
    const bool round = (cycle.name == "CYCLE977" || cycle.name == "CYCLE979") && (feature == 1 || feature == 2);
    if (!round || !diameter || !(*diameter > 0)) return std::nullopt;
    return ExpectedRound{start, *diameter, "the start position"};
  }
  static constexpr std::array<std::array<std::string_view, 2>, 2> centres = {{{"Q321", "Q322"}, {"Q273", "Q274"}}};
  const auto diameter = valueOf(cycle, "Q262");
  if (!diameter || !(*diameter > 0)) return std::nullopt;
  // Circles of holes have several of them, by their angles.
  if (valueOf(cycle, "Q291")) return std::nullopt;
  for (const auto& names : centres) {
    const auto main = valueOf(cycle, names[0]), minor = valueOf(cycle, names[1]);
    if (!main || !minor) continue;
    const double height = valueOf(cycle, "Q261").value_or(plane.planeFromXyz(start).z());
    return ExpectedRound{plane.xyzFromPlane(Vector3(*main, *minor, height)), *diameter,
                         std::string(names[0]) + "/" + std::string(names[1])};
  }
  return std::nullopt;
}

Reach reachOf(const control::CycleRecord* cycle, double way, control::ControlKind control) {
  switch (control) {
    case control::ControlKind::TNC640:
      return {"DIST", way};
    case control::ControlKind::iTNC530:
      return {"MP6130", way};
    case control::ControlKind::Sinumerik840Dsl:
      break;
  }
  // From as far before the surface as it goes on beyond.
  const auto path = cycle != nullptr ? valueOf(*cycle, "S_FA") : std::nullopt;
  return {path ? "S_FA" : "DFA", path.value_or(way / 2)};
}

}  // namespace probewright::truth
