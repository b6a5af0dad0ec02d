#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/number_text.hpp"
#include "control/heidenhain/text_table.hpp"
#include "probing/touch_plan.hpp"
#include "truth/family_truth.hpp"
#include "truth/feeling.hpp"

/// What calls and tables of HEIDENHAIN controls say of the true world.
namespace probewright::truth {

namespace {

using control::CycleRecord;
using records::EntryKind;

std::optional<ExpectedRound> round(const CycleRecord& cycle, const control::WorkingPlane& plane, const Vector3& start) {
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

/// A cycle that looks for walls.
struct WallCycle {
  std::string_view name;
  probing::Side side;
  std::array<std::string_view, 2> centre, lengths;  ///< one length: across the axis in Q272
};
constexpr std::array wallCycles = {
    WallCycle{"408", probing::Side::Inside, {"Q321", "Q322"}, {"Q311", ""}},
    WallCycle{"409", probing::Side::Outside, {"Q321", "Q322"}, {"Q311", ""}},
    WallCycle{"410", probing::Side::Inside, {"Q321", "Q322"}, {"Q323", "Q324"}},
    WallCycle{"411", probing::Side::Outside, {"Q321", "Q322"}, {"Q323", "Q324"}},
    WallCycle{"423", probing::Side::Inside, {"Q273", "Q274"}, {"Q282", "Q283"}},
    WallCycle{"424", probing::Side::Outside, {"Q273", "Q274"}, {"Q282", "Q283"}},
};

std::optional<ExpectedWalls> walls(const CycleRecord& cycle, const control::WorkingPlane& plane, const Vector3& start) {
  const auto kind = std::ranges::find(wallCycles, cycle.name, &WallCycle::name);
  if (kind == wallCycles.end()) return std::nullopt;
  const auto main = valueOf(cycle, kind->centre[0]), minor = valueOf(cycle, kind->centre[1]);
  if (!main || !minor) return std::nullopt;
  ExpectedWalls expected;
  expected.inside = kind->side == probing::Side::Inside;
  expected.pairs = kind->lengths[1].empty()
                       ? wallPair(plane, valueOf(cycle, "Q272"), valueOf(cycle, kind->lengths[0]))
                       : wallPairs(plane, valueOf(cycle, kind->lengths[0]), valueOf(cycle, kind->lengths[1]));
  if (expected.pairs.empty()) return std::nullopt;
  const double height = valueOf(cycle, "Q261").value_or(plane.planeFromXyz(start).z());
  expected.centre = plane.xyzFromPlane(Vector3(*main, *minor, height));
  expected.from = std::string(kind->centre[0]) + "/" + std::string(kind->centre[1]);
  return expected;
}

std::optional<PlaneCorner> corner(const CycleRecord& cycle, double height) {
  const auto value = [&](const char* name) { return valueOf(cycle, name).value_or(0); };
  PlaneCorner known;
  known.height = valueOf(cycle, "Q261").value_or(height);
  const Vector2 first(value("Q263"), value("Q264"));
  if (cycle.name == "414") {
    const Vector2 third(value("Q296"), value("Q297"));
    if (first.x() == third.x() || first.y() == third.y()) return std::nullopt;
    known.corner = {third.x(), first.y()};
    const auto further = [&](const Vector2& a, const Vector2& b) {
      return (a - known.corner).norm() > (b - known.corner).norm() ? a : b;
    };
    known.point = {further(first, first + Vector2(value("Q326"), 0)),
                   further(third, third + Vector2(0, value("Q327")))};
    known.into = {Vector2(0, third.y() > first.y() ? 1 : -1), Vector2(third.x() < first.x() ? 1 : -1, 0)};
    known.from = "Q296/Q264";
    return known;
  }
  if (cycle.name != "415") return std::nullopt;
  const int number = static_cast<int>(value("Q308"));
  const Vector2 inwards(number == 1 || number == 4 ? 1 : -1, number == 1 || number == 2 ? 1 : -1);
  known.corner = first;
  known.point = {first + Vector2(inwards.x() * value("Q326"), 0), first + Vector2(0, inwards.y() * value("Q327"))};
  known.into = {Vector2(0, -inwards.y()), Vector2(-inwards.x(), 0)};
  known.from = "Q263/Q264";
  return known;
}

std::optional<FrameNumber> frameNumber(const std::string& table, const std::string& entry) {
  const bool presets = table == "PRESET.PR";
  if (!presets && !table.ends_with(".D")) return std::nullopt;
  const std::size_t comma = entry.find(", column ");
  if (!entry.starts_with("row ") || comma == std::string::npos) return std::nullopt;
  const std::string row = entry.substr(4, comma - 4), column = entry.substr(comma + 9);
  FrameNumber number{presets ? EntryKind::Preset : EntryKind::ZeroOffset,
                     presets ? "preset " + row : fmt::format("datum {} of {}", row, table), column};
  if (column == "X" || column == "Y" || column == "Z") {
    number.axis = column[0] - 'X';
    return number;
  }
  number.angle = true;
  if (column == "SPA" || column == "SPB" || column == "SPC") {
    number.axis = column[2] - 'A';
  } else if (column == "ROT" || column == "C_OFFS" || column == "C") {
    number.axis = 2;
  } else {
    return std::nullopt;
  }
  return number;
}

Reach reach(const CycleRecord*, double way, control::ControlKind control) {
  return {control == control::ControlKind::iTNC530 ? "MP6130" : "DIST", way};
}

double unitOf(const session::RunOutcome& outcome, const std::string& table) {
  const auto file = outcome.files.find(table);
  if (file == outcome.files.end()) return 1;
  Diagnostics ignored;
  const auto read = control::heidenhain::TextTable::parse(file->second, table, ignored);
  return read && read->unit() == control::heidenhain::TableUnit::Inch ? 25.4 : 1;
}

bool isOfTools(std::string_view table) {
  return table == "TOOL.T" || table == "TOOLTURN.TRN" || table == "TCHPROBE.TP" || table == "calibration data";
}

bool isOfKinematics(std::string_view table) { return table == "KINEMATIC.TAB"; }

}  // namespace

const FamilyTruth heidenhainTruth = {.family = "HEIDENHAIN",
                                     .round = round,
                                     .walls = walls,
                                     .corner = corner,
                                     .reach = reach,
                                     .frameNumber = frameNumber,
                                     .unitOf = unitOf,
                                     .isOfTools = isOfTools,
                                     .tools = heidenhainToolEntries,
                                     .isOfKinematics = isOfKinematics,
                                     .tables = heidenhainTableEntries};

}  // namespace probewright::truth
