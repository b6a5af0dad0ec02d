#include "cycles/sinumerik/kinematics_log.hpp"
#include "base/number_text.hpp"
#include "base/truncated.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>
#include <utility>

namespace probewright::cycles::sinumerik {
namespace {

using control::sinumerik::carrierDatum;
using control::sinumerik::firstDatumOfAxis;
using control::sinumerik::firstDatumOfOffset;

/// Six decimals, as the control has them; never -0.
std::string sixDecimals(double value) { return formatFixed(value, 6); }

std::string vectorLine(int first, int carrier, const Vector3& vector, std::string_view name) {
  std::string line;
  for (int i = 0; i < 3; ++i)
    line += fmt::format("$TC_CARR{}[{}]={} ", first + i, carrier, sixDecimals(vector[i]));
  return fmt::format("{};{}xyz", line, name);
}

std::vector<std::string> vectorLines(int carrier, const ToolCarrier& vectors) {
  std::vector<std::string> lines;
  const auto offset = [&](int vector) {
    lines.push_back(vectorLine(firstDatumOfOffset(vector), carrier, vectors.offset[static_cast<std::size_t>(vector)],
                               fmt::format("I{}", vector + 1)));
  };
  offset(0);
  offset(1);
  for (int axis = 0; axis < 2; ++axis)
    lines.push_back(vectorLine(firstDatumOfAxis(axis), carrier, vectors.axis[static_cast<std::size_t>(axis)],
                               fmt::format("V{}", axis + 1)));
  offset(2);
  offset(3);
  return lines;
}

/// The machine data of TRAORI that hold I1 to I4, by the kind of transformation; empty where it has none of its own.
struct TransformationData {
  int number = 0;  ///< of the machine datum
  const char* name = nullptr;
};
std::array<TransformationData, 4> transformationData(const DataStore& store, ToolCarrier::Kind kind) {
  constexpr TransformationData part{24500, "$MC_TRAFO5_PART_OFFSET_1"}, joint{24560, "$MC_TRAFO5_JOINT_OFFSET_1"},
      jointPart{24558, "$MC_TRAFO5_JOINT_OFFSET_PART_1"}, base{24550, "$MC_TRAFO5_BASE_TOOL_1"};
  switch (truncated(store.number("$MC_TRAFO_TYPE_1", {}))) {
    case 24:
      if (kind == ToolCarrier::Kind::Head) return {part, joint, base, TransformationData{}};
      break;
    case 40:
      if (kind == ToolCarrier::Kind::Table) return {TransformationData{}, base, jointPart, part};
      break;
    case 56:
      if (kind == ToolCarrier::Kind::Mixed) return {joint, base, jointPart, part};
      break;
    default:
      break;
  }
  return {};
}

}  // namespace

std::vector<DatumValue> offsetData(const DataStore& store, int number, const ToolCarrier& carrier) {
  const bool fine = store.number("$SC_TOCARR_FINE_CORRECTION", {}) != 0;
  std::vector<DatumValue> data;  // adding 0 makes 0 of -0
  for (int vector = 0; vector < 4; ++vector) {
    for (int i = 0; i < 3; ++i) {
      const int datum = firstDatumOfOffset(vector) + i;
      const double extra = fine ? store.number(carrierDatum(datum + 40, number)) : 0;
      data.push_back({carrierDatum(datum, number), carrier.offset[static_cast<std::size_t>(vector)][i] - extra + 0.0});
    }
  }
  const auto machineData = transformationData(store, carrier.kind);
  for (std::size_t vector = 0; vector < 4; ++vector) {
    if (machineData[vector].name == nullptr) continue;
    for (int i = 0; i < 3; ++i)
      data.push_back({DataKey(machineData[vector].name, {i}), carrier.offset[vector][i] + 0.0});
  }
  return data;
}

std::string kinematicsProgram(const DataStore& store, int number, const ToolCarrier& before, const ToolCarrier& now) {
  std::string text = fmt::format(";swivel data set {} {}\n", number, now.name);
  for (const std::string& line : vectorLines(number, now))
    text += line + "\n";
  const auto machineData = transformationData(store, now.kind);
  for (std::size_t vector = 0; vector < 4; ++vector) {
    if (machineData[vector].name == nullptr) continue;
    for (int i = 0; i < 3; ++i)
      text += fmt::format("N{} {}[{}]={}\n", machineData[vector].number, machineData[vector].name, i,
                          sixDecimals(now.offset[vector][i]));
  }
  text += ";before the measurement\n";
  for (const std::string& line : vectorLines(number, before))
    text += ";" + line + "\n";
  return text + "M17\n";
}

std::string kinematicsScreen(int number, const ToolCarrier& before, const ToolCarrier& now) {
  std::string text = fmt::format("Swivel data set {} {}\n{:<4}{:>14}{:>14}{:>14}{:>14}\n", number, now.name, "", "X",
                                 "Y", "Z", "Difference");
  const auto row = [&](const std::string& name, const Vector3& was, const Vector3& is, double difference,
                       const char* unit) {
    if (was.isZero() && is.isZero()) return;
    text += fmt::format("{:<4}{:>14}{:>14}{:>14}{:>14} {}\n", name, sixDecimals(is.x()), sixDecimals(is.y()),
                        sixDecimals(is.z()), sixDecimals(difference), unit);
  };
  for (std::size_t i = 0; i < 4; ++i)
    row(fmt::format("I{}", i + 1), before.offset[i], now.offset[i], (now.offset[i] - before.offset[i]).norm(), "mm");
  for (std::size_t i = 0; i < 2; ++i)
    row(fmt::format("V{}", i + 1), before.axis[i], now.axis[i],
        degreesFromRadians(std::atan2(before.axis[i].cross(now.axis[i]).norm(), before.axis[i].dot(now.axis[i]))),
        "deg");
  return text;
}

}  // namespace probewright::cycles::sinumerik
