#include "control/sinumerik/tool_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/number_text.hpp"
#include "control/sinumerik/text.hpp"

namespace probewright::control::sinumerik {

namespace {

constexpr int firstOffset = 3, lastOffset = 11;  // parameters of an edge that a DL adds to
constexpr std::string_view edgeData = "$TC_DP", additiveOffsets = "$TC_SCP", setupOffsets = "$TC_ECP";

int wholeNumber(double value) { return value >= -1e9 && value <= 1e9 ? static_cast<int>(value) : 0; }

std::optional<int> indexOf(const DataKey& key, std::size_t position) {
  if (position >= key.indices.size()) return std::nullopt;
  const auto number = parseInteger(key.indices[position]);
  if (!number || *number < 0 || *number > 1'000'000'000) return std::nullopt;
  return static_cast<int>(*number);
}

/// $TC_DP1..$TC_DP25.
std::string parameterName(int parameter) { return fmt::format("{}{}", edgeData, parameter); }

constexpr int lastParameter = 25;

}  // namespace

std::array<double, 3> ToolEdge::totalLength() const {
  std::array<double, 3> total = {};
  for (std::size_t i = 0; i < 3; ++i)
    total[i] = length[i] / lengthScale[i] + lengthWear[i] / wearScale[i] + adapter[i] + additive[i] + setup[i];
  return total;
}

std::string additiveOffsetName(int dl, int parameter) {
  return fmt::format("{}{}", additiveOffsets, 10 * dl + parameter);
}
std::string setupOffsetName(int dl, int parameter) { return fmt::format("{}{}", setupOffsets, 10 * dl + parameter); }

std::optional<int> offsetNumber(std::string_view name) {
  if (!name.starts_with(additiveOffsets) && !name.starts_with(setupOffsets)) return std::nullopt;
  const auto parameter = parseInteger(name.substr(additiveOffsets.size()));
  for (int dl = 1; dl <= lastOffsetNumber; ++dl) {
    if (parameter && *parameter >= 10 * dl + firstOffset && *parameter <= 10 * dl + lastOffset) return dl;
  }
  return std::nullopt;
}

bool isToolSize(std::string_view name) {
  if (offsetNumber(name)) return true;
  if (!name.starts_with(edgeData)) return false;
  const auto parameter = parseInteger(name.substr(edgeData.size())).value_or(0);
  return (parameter >= 3 && parameter <= 6) || (parameter >= 12 && parameter <= 15) ||
         (parameter >= 21 && parameter <= 23);
}

std::optional<ToolEdge> toolEdge(const DataStore& store, int tool, int edge, int dl) {
  bool exists = false;
  for (int parameter = 1; parameter <= lastParameter && !exists; ++parameter) {
    exists = store.isSet({parameterName(parameter), {tool, edge}});
  }
  if (!exists) return std::nullopt;
  const auto value = [&](std::string_view name) { return store.number(name, {tool, edge}); };
  const auto dp = [&](int parameter) { return value(parameterName(parameter)); };
  ToolEdge data;
  data.type = wholeNumber(dp(1));
  data.position = wholeNumber(dp(2));
  data.radius = dp(6);
  data.cornerRadius = dp(7);
  data.correctionAngle = dp(10);
  data.radiusWear = dp(15);
  data.identifier = dp(25);
  if (data.isTurning() && data.type != 580) {
    const auto mask = static_cast<unsigned>(std::clamp(store.number("$MC_TOOL_PARAMETER_DEF_MASK", {}), 0.0, 65535.0));
    if ((mask & 1U) != 0) data.wearScale[0] = 2;
    if ((mask & 2U) != 0) data.lengthScale[0] = 2;
  }
  for (int i = 0; i < 3; ++i) {
    const auto component = static_cast<std::size_t>(i);
    data.length[component] = dp(3 + i);
    data.lengthWear[component] = dp(12 + i);
    data.adapter[component] = dp(21 + i);
    if (dl < 1 || dl > 6) continue;
    data.additive[component] = value(additiveOffsetName(dl, 3 + i));
    data.setup[component] = value(setupOffsetName(dl, 3 + i));
  }
  if (dl >= 1 && dl <= 6) {
    data.radiusAdditive = value(additiveOffsetName(dl, 6));
    data.radiusSetup = value(setupOffsetName(dl, 6));
  }
  return data;
}

std::vector<int> toolNumbers(const DataStore& store) {
  std::set<int> tools;
  for (const std::string& name : {parameterName(1), parameterName(3), parameterName(6), std::string("$TC_TP2")}) {
    for (const DataKey& key : store.keys(name)) {
      if (const auto tool = indexOf(key, 0)) tools.insert(*tool);
    }
  }
  return {tools.begin(), tools.end()};
}

std::vector<int> toolEdges(const DataStore& store, int tool) {
  std::set<int> edges;
  for (int parameter = 1; parameter <= lastParameter; ++parameter) {
    for (const DataKey& key : store.keys(parameterName(parameter))) {
      const auto edge = indexOf(key, 1);
      if (edge && indexOf(key, 0) == tool) edges.insert(*edge);
    }
  }
  return {edges.begin(), edges.end()};
}

std::optional<int> toolNamed(const DataStore& store, std::string_view name) {
  const std::string wanted = upperCase(name);
  for (const DataKey& key : store.keys("$TC_TP2")) {
    const auto tool = indexOf(key, 0);
    if (tool && upperCase(toolName(store, *tool)) == wanted) return tool;
  }
  return std::nullopt;
}

std::string toolName(const DataStore& store, int tool) { return store.text("$TC_TP2", {tool}); }

std::array<int, 3> lengthAxes(WorkingPlane plane, const ToolEdge& edge, LengthType type) {
  if (type == LengthType::AsTurning || edge.isTurning()) return {plane.minor, plane.main, plane.tool};
  return {plane.tool, plane.minor, plane.main};
}

WorkingPlane planeOfLengths(const DataStore& store, int activePlane) {
  const auto constant = static_cast<int>(store.number("$SC_TOOL_LENGTH_CONST", {}));
  const int plane = constant >= 17 && constant <= 19 ? constant : activePlane;
  return WorkingPlane::ofG(plane);
}

Vector3 toolVector(WorkingPlane plane, const ToolEdge& edge, LengthType type) {
  const auto axes = lengthAxes(plane, edge, type);
  const auto lengths = edge.totalLength();
  Vector3 vector = Vector3::Zero();
  for (std::size_t i = 0; i < 3; ++i)
    vector[axes[i]] = lengths[i];
  return vector;
}

}  // namespace probewright::control::sinumerik
