#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "conversion/heidenhain_tasks.hpp"
#include "conversion/sinumerik_formulas.hpp"
#include "conversion/to_klartext.hpp"

/// The safe area (S_TSA) of SINUMERIK measuring cycles, which touch probe cycles do not have: after them the program
/// compares, and takes back what they have written before it stops.
namespace probewright::conversion {

using namespace language;

namespace {

constexpr int safeAreaExceeded = 1303;  ///< number of FN 14, for alarm 61303
constexpr int rotationIndex = 6;        ///< of the preset table, FN 18 ID507

}  // namespace

std::optional<ToKlartext::SafeArea> ToKlartext::safeArea(const Call& call, const MeasuringTask& task) const {
  const Quantity limit = call.number("S_TSA"), path = call.number("S_FA");
  SafeArea safe;
  safe.limit = limit;
  const bool zeroOffset = call.digit("S_MVAR", 3) == 1;
  if (call.cycle == "CYCLE977" && isRound(task.feature)) safe.turn = task.angle;
  // What lies further off than S_FA is not found at all, nor is a wall beyond the opposite one.
  const auto watch = [&](Meaning meaning, double reach) {
    const bool tooFar = limit.isNumber() && path.isNumber() && limit.number() >= reach * path.number();
    const bool beyond = isInside(task.feature) && limit.isNumber() && task.size[0].isNumber() &&
                        limit.number() >= std::max(task.size[0].number(), task.size[1].number());
    if (!tooFar && !beyond) safe.watched.push_back({meaning, {}});
  };
  switch (task.feature) {
    case Feature::Surface:
      watch(Meaning::CoordinateDeviation, 1);
      break;
    case Feature::Edge:
      safe.watched.push_back({Meaning::AngleDeviation, {}});
      break;
    case Feature::Plane:
      safe.watched.push_back({Meaning::Angle, call.number("S_STA1")});
      safe.watched.push_back({Meaning::Angle2, call.number("S_INCA")});
      break;
    case Feature::InsideCorner:
    case Feature::OutsideCorner:
      safe.watched.push_back({Meaning::Angle, {}});
      break;
    case Feature::ProbeLength:
    case Feature::ProbeInRing:
    case Feature::ProbeOnBall:
      watch(Meaning::Size1Deviation, 1);
      break;
    default:
      watch(Meaning::Size1Deviation, 2);
      if (isRectangular(task.feature)) watch(Meaning::Size2Deviation, 2);
      if (zeroOffset && isWidth(task.feature)) watch(Meaning::CoordinateDeviation, 1);
      if (zeroOffset && !isWidth(task.feature)) {
        watch(Meaning::Centre1Deviation, 1);
        watch(Meaning::Centre2Deviation, 1);
      }
      break;
  }
  return safe.watched.empty() ? std::nullopt : std::optional(safe);
}

void ToKlartext::rememberPreset(const Block& block, const MeasuringTask& task) {
  before_ = {};
  const bool changes = task.correction == Correction::Origin || task.correction == Correction::OriginAndRotation ||
                       task.correction == Correction::Rotation;
  if (!changes || task.feature == Feature::Plane || control_ == control::ControlKind::iTNC530) return;
  Quantity present = task.row;
  before_.row = task.row;
  if (task.row == 0 || (task.active && task.correction == Correction::Rotation)) {
    const std::string row = formulas_.define("active preset");
    line(fmt::format("FN 18: SYSREAD {} = ID530 NR1", row));
    present = Quantity::of(row);
    // Row 0 becomes a copy of the active one.
    if (task.active) before_.row = present;
  } else if (const int row = static_cast<int>(task.row.number());
             !task.active && !selectedRows_.contains(row) && lackingRows_.isNew(row)) {
    out_.list(
        block,
        fmt::format("PRESET.PR may lack row {}, which is read before this cycle corrects it, to be put back beyond "
                    "S_TSA: the HEIDENHAIN control then stops",
                    row),
        fmt::format("make sure that PRESET.PR has row {} before the program runs", row));
  }
  for (int index = 1; index <= rotationIndex; ++index) {
    if (index > 3 && index < rotationIndex) continue;
    const std::string own = formulas_.define(fmt::format("preset before {}", index));
    const std::string value = formulas_.presetDatum(present, index);
    line(fmt::format("{} = {}", own, value));
    before_.values[static_cast<std::size_t>(index)] = own;
  }
}

bool ToKlartext::deviatesInActivePresetOnly(const SafeArea& safe, const MeasuringTask& task) const {
  const bool inEffect = task.active || (activeRow_ && task.row == (*activeRow_ == 99 ? 0 : *activeRow_));
  if (task.correction == Correction::None || inEffect) return false;
  const Results results = heidenhainResults(heidenhainCall(task, control_, probe_).cycle, task);
  return std::ranges::any_of(safe.watched,
                             [&](const SafeArea::Watched& each) { return !measured(task, results, each.meaning); });
}

std::optional<Quantity> ToKlartext::deviationOfPreset(const MeasuringTask& task, Meaning meaning) {
  if (!before_.row) return std::nullopt;
  const auto change = [&](int index) {
    return Quantity::of(formulas_.presetDatum(*before_.row, index)) -
           Quantity::of(before_.values[static_cast<std::size_t>(index)]);
  };
  if (meaning == Meaning::AngleDeviation || meaning == Meaning::Angle) return change(rotationIndex);
  if (meaning != Meaning::CoordinateDeviation || toolAxis_ != 'Z') return std::nullopt;
  if (task.axis == 2) return change(3);
  const std::string turn = before_.values[rotationIndex];
  const std::string x = spacedExpressionText(change(1)), y = spacedExpressionText(change(2));
  return Quantity::of(task.axis == 0 ? fmt::format("(({0}) * COS {2} + ({1}) * SIN {2})", x, y, turn)
                                     : fmt::format("(({1}) * COS {2} - ({0}) * SIN {2})", x, y, turn));
}

std::optional<Quantity> ToKlartext::alongTurned(const MeasuringTask& task, const Results& results, Meaning meaning,
                                                const Quantity& angle) const {
  const auto main = measured(task, results, Meaning::Centre1Deviation);
  const auto minor = measured(task, results, Meaning::Centre2Deviation);
  if (!main || !minor || !angle.isNumber()) return std::nullopt;
  const double c = std::cos(angle.number() * std::numbers::pi / 180);
  const double s = std::sin(angle.number() * std::numbers::pi / 180);
  return meaning == Meaning::Centre1Deviation ? *main * c + *minor * s : *minor * c - *main * s;
}

void ToKlartext::monitor(const Block& block, const SafeArea& safe, const MeasuringTask& task, const Results& results) {
  const std::string largest = formulas_.define("largest deviation");
  const std::string each = formulas_.define("deviation");
  bool first = true;
  for (const auto& [meaning, set] : safe.watched) {
    std::optional<Quantity> deviation = measured(task, results, meaning);
    if (!deviation) deviation = deviationOfPreset(task, meaning);
    const bool ofCentre = meaning == Meaning::Centre1Deviation || meaning == Meaning::Centre2Deviation;
    if (deviation && ofCentre && !(safe.turn == 0)) deviation = alongTurned(task, results, meaning, safe.turn);
    if (!deviation) {
      out_.list(block,
                fmt::format("S_TSA: what the touch probe cycle measures here is not compared with the safe area{}",
                            control_ == control::ControlKind::iTNC530 ? " on the iTNC530" : ""),
                "compare it by hand");
      continue;
    }
    line(fmt::format("{} = ABS ({})", first ? largest : each, spacedExpressionText(*deviation - set)));
    // The larger one of both.
    if (!first) line(fmt::format("{0} = ({0} + {1} + ABS ({0} - {1})) / 2", largest, each));
    first = false;
  }
  if (first) return;
  const std::string past = unusedLabel("SAFE");
  const std::string limit = formulas_.value(safe.limit + 1e-9);
  line(fmt::format("FN 12: IF +{} LT {} GOTO LBL \"{}\"", largest, limit, past));
  if (before_.row && task.correction != Correction::None) restorePreset(task);
  line(fmt::format("FN 14: ERROR = {}", safeAreaExceeded));
  line(fmt::format("LBL \"{}\"", past));
}

void ToKlartext::restorePreset(const MeasuringTask& task) {
  const std::string row = formulas_.unsignedValue(*before_.row);
  if (task.correction != Correction::Rotation) {
    line(fmt::format("PRESET SELECT #{} KEEP TRANS", row));
    for (int index = 1; index <= 3; ++index) {
      const std::string& old = before_.values[static_cast<std::size_t>(index)];
      const Quantity back = Quantity::of(old) - Quantity::of(formulas_.presetDatum(*before_.row, index));
      line(fmt::format("PRESET CORR {}{}", "XYZ"[index - 1], formulas_.value(back)));
    }
  }
  if (task.correction != Correction::Origin) {
    writeWhole({"TCH PROBE 404 SET BASIC ROTATION ~",
                fmt::format("    Q307=+{} ;PRESET ROTATION ANG. ~", before_.values[rotationIndex]),
                fmt::format("    Q305={} ;NUMBER IN TABLE", formulas_.value(*before_.row))});
  }
}

}  // namespace probewright::conversion
