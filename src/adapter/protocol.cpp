#include "adapter/protocol.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

namespace probewright::adapter {
namespace {

using machine::FunctionEnd;
using machine::MeasureEnd;
using machine::MoveEnd;
using machine::Rotation;
using machine::Sensor;
using machine::ToolChangeEnd;
using machine::TouchWith;
using machine::WaitEnd;

template <class Value>
using Words = std::pair<Value, std::string_view>;

constexpr std::array<Words<MoveEnd>, 6> moveEnds = {{{MoveEnd::Reached, "reached"},
                                                     {MoveEnd::ProbeSignal, "probeSignal"},
                                                     {MoveEnd::Collision, "collision"},
                                                     {MoveEnd::AxisLimit, "axisLimit"},
                                                     {MoveEnd::Cancelled, "cancelled"},
                                                     {MoveEnd::Refused, "refused"}}};
constexpr std::array<Words<MeasureEnd>, 8> measureEnds = {{{MeasureEnd::Touched, "touched"},
                                                           {MeasureEnd::NoContact, "noContact"},
                                                           {MeasureEnd::DeflectedAtStart, "deflectedAtStart"},
                                                           {MeasureEnd::Collision, "collision"},
                                                           {MeasureEnd::AxisLimit, "axisLimit"},
                                                           {MeasureEnd::Cancelled, "cancelled"},
                                                           {MeasureEnd::NotReady, "notReady"},
                                                           {MeasureEnd::Refused, "refused"}}};
constexpr std::array<Words<FunctionEnd>, 4> functionEnds = {{{FunctionEnd::CarriedOut, "carriedOut"},
                                                             {FunctionEnd::Unknown, "unknown"},
                                                             {FunctionEnd::Refused, "refused"},
                                                             {FunctionEnd::Cancelled, "cancelled"}}};
constexpr std::array<Words<ToolChangeEnd>, 7> toolChangeEnds = {{{ToolChangeEnd::Changed, "changed"},
                                                                 {ToolChangeEnd::ByHand, "byHand"},
                                                                 {ToolChangeEnd::Missing, "missing"},
                                                                 {ToolChangeEnd::Refused, "refused"},
                                                                 {ToolChangeEnd::ProbeSignal, "probeSignal"},
                                                                 {ToolChangeEnd::Collision, "collision"},
                                                                 {ToolChangeEnd::Cancelled, "cancelled"}}};
constexpr std::array<Words<WaitEnd>, 2> waitEnds = {{{WaitEnd::Over, "over"}, {WaitEnd::Cancelled, "cancelled"}}};
constexpr std::array<Words<Sensor>, 2> sensors = {
    {{Sensor::TouchProbe, "touchProbe"}, {Sensor::ToolTouchProbe, "toolTouchProbe"}}};
constexpr std::array<Words<TouchWith>, 2> touchParts = {{{TouchWith::Ball, "ball"}, {TouchWith::Shaft, "shaft"}}};
constexpr std::array<Words<Rotation>, 3> rotations = {
    {{Rotation::None, "none"}, {Rotation::Clockwise, "clockwise"}, {Rotation::CounterClockwise, "counterClockwise"}}};
constexpr std::array<Words<machine::AxisKind>, 2> axisKinds = {
    {{machine::AxisKind::Linear, "linear"}, {machine::AxisKind::Rotary, "rotary"}}};

template <class Value, std::size_t count>
std::string_view wordOf(const std::array<Words<Value>, count>& words, Value value) {
  for (const auto& [each, word] : words) {
    if (each == value) return word;
  }
  return {};
}

template <class Value, std::size_t count>
Value valueOf(const std::array<Words<Value>, count>& words, std::string_view word) {
  for (const auto& [value, each] : words) {
    if (each == word) return value;
  }
  throw Breach(fmt::format("\"{}\" is not a word of the protocol here", word.substr(0, 40)));
}

double finite(const Json& json, const char* name) {
  if (!json.is_number() || !std::isfinite(json.get<double>()))
    throw Breach(fmt::format("\"{}\" is not a number", name));
  return json.get<double>();
}

double numberOr(const Json& object, const char* name, double otherwise) {
  return object.contains(name) ? number(object, name) : otherwise;
}

bool flag(const Json& object, const char* name, bool otherwise) {
  if (!object.contains(name)) return otherwise;
  const Json& value = object.at(name);
  if (!value.is_boolean()) throw Breach(fmt::format("\"{}\" is neither true nor false", name));
  return value.get<bool>();
}

Json vectorJson(const Vector3& vector) { return {vector.x(), vector.y(), vector.z()}; }

Vector3 vectorOf(const Json& object, const char* name, const Vector3& otherwise) {
  if (!object.contains(name)) return otherwise;
  const Json& json = object.at(name);
  if (!json.is_array() || json.size() != 3) throw Breach(fmt::format("\"{}\" has no three numbers", name));
  return {finite(json[0], name), finite(json[1], name), finite(json[2], name)};
}

Json chainJson(const machine::MachineDescription& machine, const std::vector<machine::ChainElement>& chain) {
  Json json = Json::array();
  for (const machine::ChainElement& element : chain) {
    Json one = {{"direction", vectorJson(element.direction)}, {"point", vectorJson(element.point)}};
    if (element.axis) one["axis"] = machine.axes[*element.axis].name;
    json.push_back(std::move(one));
  }
  return json;
}

std::size_t axisNamed(const machine::MachineDescription& machine, const std::string& name) {
  if (const auto index = machine.axisIndex(name)) return *index;
  throw Breach(fmt::format("there is no axis {}", name.substr(0, 40)));
}

std::vector<machine::ChainElement> chainOf(const machine::MachineDescription& machine, const Json& json) {
  if (!json.is_array()) throw Breach("a chain is not a list");
  std::vector<machine::ChainElement> chain;
  for (const Json& one : json) {
    machine::ChainElement element;
    if (one.contains("axis")) element.axis = axisNamed(machine, text(one, "axis"));
    element.direction = vectorOf(one, "direction", Vector3::UnitX());
    element.point = vectorOf(one, "point", Vector3::Zero());
    if (element.axis && std::abs(element.direction.norm() - 1) > 1e-9)
      throw Breach(fmt::format("the direction of axis {} has not the length 1", machine.axes[*element.axis].name));
    chain.push_back(element);
  }
  return chain;
}

std::vector<machine::ChainElement> linearChain(const machine::MachineDescription& machine) {
  std::vector<machine::ChainElement> chain;
  constexpr std::array<const char*, 3> names = {"X", "Y", "Z"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (const auto index = machine.axisIndex(names[i]))
      chain.push_back({*index, Vector3::Unit(static_cast<Eigen::Index>(i)), Vector3::Zero()});
  }
  return chain;
}

}  // namespace

std::string_view word(MoveEnd end) { return wordOf(moveEnds, end); }
std::string_view word(MeasureEnd end) { return wordOf(measureEnds, end); }
std::string_view word(FunctionEnd end) { return wordOf(functionEnds, end); }
std::string_view word(ToolChangeEnd end) { return wordOf(toolChangeEnds, end); }
std::string_view word(WaitEnd end) { return wordOf(waitEnds, end); }
std::string_view word(Sensor value) { return wordOf(sensors, value); }
std::string_view word(TouchWith part) { return wordOf(touchParts, part); }
std::string_view word(Rotation value) { return wordOf(rotations, value); }

MoveEnd moveEnd(std::string_view word) { return valueOf(moveEnds, word); }
MeasureEnd measureEnd(std::string_view word) { return valueOf(measureEnds, word); }
FunctionEnd functionEnd(std::string_view word) { return valueOf(functionEnds, word); }
ToolChangeEnd toolChangeEnd(std::string_view word) { return valueOf(toolChangeEnds, word); }
WaitEnd waitEnd(std::string_view word) { return valueOf(waitEnds, word); }
Sensor sensor(std::string_view word) { return valueOf(sensors, word); }
TouchWith touchWith(std::string_view word) { return valueOf(touchParts, word); }
Rotation rotation(std::string_view word) { return valueOf(rotations, word); }

Json toJson(const machine::AxisPositions& positions, std::size_t axes) {
  return std::vector<double>(positions.values.begin(), positions.values.begin() + static_cast<std::ptrdiff_t>(axes));
}

machine::AxisPositions positions(const Json& json, std::size_t axes) {
  if (!json.is_array() || json.size() != axes)
    throw Breach(fmt::format("a position is not a list of {} numbers, one for each axis", axes));
  machine::AxisPositions positions;
  for (std::size_t i = 0; i < axes; ++i)
    positions[i] = finite(json[i], "position");
  return positions;
}

Json toJson(const machine::OwnTables& tables, std::size_t axes) {
  Json offsets = Json::array(), tools = Json::array();
  for (const machine::OwnOffset& offset : tables.offsets)
    offsets.push_back(
        {{"number", offset.number}, {"origin", toJson(offset.origin, axes)}, {"rotation", offset.rotation}});
  for (const machine::OwnTool& tool : tables.tools)
    tools.push_back({{"number", tool.number}, {"length", tool.length}, {"diameter", tool.diameter}});
  return {{"offsets", std::move(offsets)}, {"tools", std::move(tools)}};
}

machine::OwnTables ownTables(const Json& json, std::size_t axes) {
  const auto listed = [&](const char* name) -> const Json& {
    const Json& list = member(json, name);
    if (!list.is_array()) throw Breach(fmt::format("\"{}\" is not a list", name));
    return list;
  };
  const auto numbered = [](const Json& row) {
    const Json& value = member(row, "number");
    if (!value.is_number_integer() || value.get<long>() < 0 || value.get<long>() > 1'000'000'000)
      throw Breach("\"number\" is not the number of a row");
    return value.get<int>();
  };
  machine::OwnTables tables;
  for (const Json& row : listed("offsets"))
    tables.offsets.push_back({numbered(row), positions(member(row, "origin"), axes), number(row, "rotation")});
  for (const Json& row : listed("tools"))
    tables.tools.push_back({numbered(row), number(row, "length"), number(row, "diameter")});
  return tables;
}

void addFeed(Json& order, machine::Feed feed) {
  if (feed.rapid) {
    order["rapid"] = true;
  } else {
    order["feed"] = feed.perMinute;
  }
}

machine::Feed feed(const Json& order) {
  return flag(order, "rapid", false) ? machine::Feed::rapidTraverse() : machine::Feed::at(number(order, "feed"));
}

Json toJson(const machine::MachineDescription& machine) {
  Json axes = Json::array();
  for (const machine::Axis& axis : machine.axes) {
    axes.push_back({{"name", axis.name},
                    {"kind", wordOf(axisKinds, axis.kind)},
                    {"minimum", axis.minimum},
                    {"maximum", axis.maximum},
                    {"rapid", axis.rapid},
                    {"acceleration", axis.acceleration},
                    {"modulo", axis.modulo}});
  }
  Json json = {{"name", machine.name},
               {"axes", std::move(axes)},
               {"tableChain", chainJson(machine, machine.tableChain)},
               {"spindleChain", chainJson(machine, machine.spindleChain)},
               {"spindleOrients", machine.spindleOrients},
               {"toolChange", toJson(machine.toolChange, machine.axes.size())},
               {"toolChangeSeconds", machine.toolChangeSeconds}};
  if (machine.mainSpindle) json["mainSpindle"] = machine.axes[*machine.mainSpindle].name;
  return json;
}

machine::MachineDescription description(const Json& json) {
  machine::MachineDescription machine;
  machine.name = text(json, "name");
  const Json& axes = member(json, "axes");
  if (!axes.is_array() || axes.empty() || axes.size() > machine::maximumAxes)
    throw Breach(fmt::format("\"axes\" is not a list of 1 to {} axes", machine::maximumAxes));
  for (const Json& one : axes) {
    machine::Axis axis;
    axis.name = text(one, "name");
    if (axis.name.empty() || machine.axisIndex(axis.name)) throw Breach("two axes have the same name, or one has none");
    axis.kind = valueOf(axisKinds, text(one, "kind"));
    axis.modulo = flag(one, "modulo", false);
    axis.minimum = numberOr(one, "minimum", axis.minimum);
    axis.maximum = numberOr(one, "maximum", axis.maximum);
    axis.rapid = numberOr(one, "rapid", axis.rapid);
    axis.acceleration = numberOr(one, "acceleration", axis.acceleration);
    if (axis.minimum > axis.maximum || axis.rapid <= 0 || axis.acceleration <= 0)
      throw Breach(fmt::format("the travel, speed or acceleration of axis {} is not possible", axis.name));
    machine.axes.push_back(std::move(axis));
  }
  const bool chains = json.contains("tableChain") || json.contains("spindleChain");
  if (json.contains("tableChain")) machine.tableChain = chainOf(machine, json.at("tableChain"));
  if (json.contains("spindleChain")) machine.spindleChain = chainOf(machine, json.at("spindleChain"));
  if (!chains) machine.spindleChain = linearChain(machine);
  machine.spindleOrients = flag(json, "spindleOrients", false);
  if (json.contains("mainSpindle")) machine.mainSpindle = axisNamed(machine, text(json, "mainSpindle"));
  if (json.contains("toolChange")) machine.toolChange = positions(json.at("toolChange"), machine.axes.size());
  machine.toolChangeSeconds = numberOr(json, "toolChangeSeconds", machine.toolChangeSeconds);
  return machine;
}

Json parseLine(std::string_view line) {
  Json json = Json::parse(line, nullptr, false);
  if (!json.is_object()) throw Breach(fmt::format("this line is not a JSON object: {}", line.substr(0, 80)));
  return json;
}

const Json& member(const Json& object, const char* name) {
  if (!object.is_object() || !object.contains(name)) throw Breach(fmt::format("\"{}\" is missing", name));
  return object.at(name);
}

double number(const Json& object, const char* name) { return finite(member(object, name), name); }

std::string text(const Json& object, const char* name) {
  const Json& value = member(object, name);
  if (!value.is_string()) throw Breach(fmt::format("\"{}\" is not a text", name));
  return value.get<std::string>();
}

std::string optionalText(const Json& object, const char* name) {
  return object.contains(name) ? text(object, name) : std::string();
}

}  // namespace probewright::adapter
