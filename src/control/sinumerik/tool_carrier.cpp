#include "control/sinumerik/tool_carrier.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "control/sinumerik/text.hpp"

namespace probewright::control::sinumerik {
namespace {

using machine::AxisKind;
using machine::ChainElement;
using machine::MachineDescription;

Vector3 vectorAt(const DataStore& store, int first, int carrier) {
  Vector3 vector;
  for (int i = 0; i < 3; ++i)
    vector[i] = store.number(carrierDatum(first + i, carrier));
  return vector;
}

Vector3 machineVector(const DataStore& store, const char* name) {
  return {store.number(name, {0}), store.number(name, {1}), store.number(name, {2})};
}

std::optional<ToolCarrier::Kind> kindOf(const std::string& text) {
  const std::string kind = upperCase(text);
  if (kind == "T") return ToolCarrier::Kind::Head;
  if (kind == "P") return ToolCarrier::Kind::Table;
  if (kind == "M") return ToolCarrier::Kind::Mixed;
  return std::nullopt;
}

bool isRotary(const MachineDescription& machine, const ChainElement& element) {
  return element.axis && machine.axes[*element.axis].kind == AxisKind::Rotary;
}

ChainElement fixedOffset(const Vector3& way) {
  ChainElement element;
  element.point = way;
  return element;
}

/// The places of the rotary elements, from the bed on.
std::vector<std::size_t> rotaryElements(const MachineDescription& machine, const std::vector<ChainElement>& chain) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < chain.size(); ++i)
    if (isRotary(machine, chain[i])) found.push_back(i);
  return found;
}

bool carriesLinearAxis(const MachineDescription& machine, const std::vector<ChainElement>& chain) {
  bool turned = false;
  for (const ChainElement& element : chain) {
    if (isRotary(machine, element)) turned = true;
    if (turned && element.axis && !isRotary(machine, element)) return true;
  }
  return false;
}

/// The elements of rotary axes 1 and 2 as they follow in the chains; none where the machine has others.
std::vector<ChainElement*> elementsOf(MachineDescription& machine, const ToolCarrier& carrier) {
  std::vector<ChainElement*> found;
  for (int which = 0; which < carrier.axes(); ++which) {
    std::vector<ChainElement>& chain = carrier.inHead(which) ? machine.spindleChain : machine.tableChain;
    const std::vector<std::size_t> places = rotaryElements(machine, chain);
    const bool mixed = carrier.kind == ToolCarrier::Kind::Mixed;
    const std::size_t order = mixed ? 0 : static_cast<std::size_t>(which);
    const std::size_t expected = mixed ? 1 : static_cast<std::size_t>(carrier.axes());
    if (places.size() != expected) return {};
    found.push_back(&chain[places[order]]);
  }
  return found;
}

}  // namespace

DataKey carrierDatum(int datum, int carrier) { return DataKey(fmt::format("$TC_CARR{}", datum), {carrier}); }

std::optional<ToolCarrier> toolCarrier(const DataStore& store, int number) {
  const auto kind = kindOf(store.text("$TC_CARR23", {number}));
  if (!kind) return std::nullopt;
  ToolCarrier carrier;
  carrier.kind = *kind;
  const bool fine = store.number("$SC_TOCARR_FINE_CORRECTION", {}) != 0;
  constexpr int fineFromCoarse = 40;
  for (int vector = 0; vector < 4; ++vector) {
    Vector3& offset = carrier.offset[static_cast<std::size_t>(vector)];
    offset = vectorAt(store, firstDatumOfOffset(vector), number);
    if (fine) offset += vectorAt(store, firstDatumOfOffset(vector) + fineFromCoarse, number);
  }
  for (int which = 0; which < 2; ++which) {
    const auto place = static_cast<std::size_t>(which);
    carrier.axis[place] = vectorAt(store, firstDatumOfAxis(which), number);
    carrier.basicSetting[place] = store.number(carrierDatum(24 + which, number));
    carrier.axisName[place] = upperCase(store.text(carrierDatum(35 + which, number).name, {number}));
  }
  carrier.name = store.text("$TC_CARR34", {number});
  return carrier;
}

void loadCarrier(DataStore& store, int number, const ToolCarrier& carrier) {
  const auto put = [&](int datum, DataValue value) { store.load(carrierDatum(datum, number), std::move(value)); };
  const auto putVector = [&](int first, const Vector3& vector) {
    for (int i = 0; i < 3; ++i)
      put(first + i, vector[i] == 0 ? 0.0 : vector[i]);
  };
  for (int vector = 0; const Vector3& offset : carrier.offset)
    putVector(firstDatumOfOffset(vector++), offset);
  for (int which = 0; which < 2; ++which) {
    const auto place = static_cast<std::size_t>(which);
    putVector(firstDatumOfAxis(which), carrier.axis[place]);
    put(24 + which, carrier.basicSetting[place]);
    put(35 + which, carrier.axisName[place]);
  }
  put(23, std::string(1, static_cast<char>(carrier.kind)));
  put(34, carrier.name);
}

std::optional<int> carrierNamed(const DataStore& store, const std::string& name) {
  for (const DataKey& key : store.keys("$TC_CARR34")) {
    const auto value = store.get(key);
    const auto* text = value ? std::get_if<std::string>(&*value) : nullptr;
    if (text == nullptr || key.indices.size() != 1 || upperCase(*text) != upperCase(name)) continue;
    try {
      return std::stoi(key.indices.front());
    } catch (const std::exception&) {
      continue;
    }
  }
  return std::nullopt;
}

std::optional<ToolCarrier> transformationCarrier(const DataStore& store) {
  const auto type = static_cast<int>(store.number("$MC_TRAFO_TYPE_1", {}));
  constexpr int ofCarrier = 72;
  if (type == 0 || type == ofCarrier) {
    const auto number = static_cast<int>(store.number("$MC_TRAFO5_TCARR_NO_1", {}));
    return toolCarrier(store, number > 0 ? number : 1);
  }
  ToolCarrier carrier;
  const Vector3 part = machineVector(store, "$MC_TRAFO5_PART_OFFSET_1");
  const Vector3 joint = machineVector(store, "$MC_TRAFO5_JOINT_OFFSET_1");
  const Vector3 jointPart = machineVector(store, "$MC_TRAFO5_JOINT_OFFSET_PART_1");
  const Vector3 base = machineVector(store, "$MC_TRAFO5_BASE_TOOL_1");
  const Vector3 none = Vector3::Zero();
  switch (type) {
    case 24:
      carrier.kind = ToolCarrier::Kind::Head;
      carrier.offset = {part, joint, base, none};
      break;
    case 40:
      carrier.kind = ToolCarrier::Kind::Table;
      carrier.offset = {none, base, jointPart, part};
      break;
    case 56:
      carrier.kind = ToolCarrier::Kind::Mixed;
      carrier.offset = {joint, base, jointPart, part};
      break;
    default:
      return std::nullopt;
  }
  carrier.axis = {machineVector(store, "$MC_TRAFO5_AXIS1_1"), machineVector(store, "$MC_TRAFO5_AXIS2_1")};
  return carrier;
}

std::optional<ToolCarrier> carrierOf(const MachineDescription& machine) {
  if (machine.mainSpindle) return std::nullopt;
  if (carriesLinearAxis(machine, machine.tableChain) || carriesLinearAxis(machine, machine.spindleChain))
    return std::nullopt;
  const auto head = rotaryElements(machine, machine.spindleChain), table = rotaryElements(machine, machine.tableChain);
  const std::size_t count = head.size() + table.size();
  if (count < 1 || count > 2) return std::nullopt;

  ToolCarrier carrier;
  carrier.kind = table.empty()  ? ToolCarrier::Kind::Head
                 : head.empty() ? ToolCarrier::Kind::Table
                                : ToolCarrier::Kind::Mixed;
  std::vector<const ChainElement*> axes;
  axes.reserve(head.size() + table.size());
  for (const std::size_t place : head)
    axes.push_back(&machine.spindleChain[place]);
  for (const std::size_t place : table)
    axes.push_back(&machine.tableChain[place]);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    carrier.axis[i] = axes[i]->direction;
    carrier.axisName[i] = upperCase(machine.axes[*axes[i]->axis].name);
  }
  // As machine builders call them: TABLE_AC, MIXED_BC.
  carrier.name = carrier.kind == ToolCarrier::Kind::Head    ? "HEAD_"
                 : carrier.kind == ToolCarrier::Kind::Table ? "TABLE_"
                                                            : "MIXED_";
  carrier.name += carrier.axisName[0] + carrier.axisName[1];
  auto& [i1, i2, i3, i4] = carrier.offset;
  const Vector3& first = axes[0]->point;
  const Vector3& second = axes.size() > 1 ? axes[1]->point : first;
  switch (carrier.kind) {
    case ToolCarrier::Kind::Head:
      i3 = count == 2 ? second : Vector3::Zero();
      i2 = first - i3;
      i1 = -first;
      break;
    case ToolCarrier::Kind::Table:
      i2 = first;
      i3 = second - first;
      i4 = -second;
      break;
    case ToolCarrier::Kind::Mixed:
      i2 = first;
      i1 = -first;
      i3 = second;
      i4 = -second;
      break;
  }
  return carrier;
}

Result<MachineDescription> withCarrier(MachineDescription machine, const ToolCarrier& carrier) {
  if (carrier.axes() == 0) return fail("its axis vector V1 is 0", "enter $TC_CARR7 to $TC_CARR9, or MD 24570");
  if (carrier.basicSetting[0] != 0 || carrier.basicSetting[1] != 0)
    return fail("its basic setting is not at 0 degrees", "set $TC_CARR24 and $TC_CARR25 to 0 and the axes accordingly");
  const std::vector<ChainElement*> elements = elementsOf(machine, carrier);
  if (elements.empty())
    return fail(fmt::format("it is of kind \"{}\" with {} rotary {}, and the machine is not",
                            static_cast<char>(carrier.kind), carrier.axes(), carrier.axes() == 1 ? "axis" : "axes"),
                "compare $TC_CARR23 and the vectors V1 and V2 with the machine");
  const auto& [i1, i2, i3, i4] = carrier.offset;
  std::array<Vector3, 2> point;
  Vector3 headGap = Vector3::Zero(), tableGap = Vector3::Zero();
  switch (carrier.kind) {
    case ToolCarrier::Kind::Head:
      point = {i2 + i3, i3};
      headGap = i1 + i2 + i3;
      break;
    case ToolCarrier::Kind::Table:
      point = {i2, i2 + i3};
      tableGap = i2 + i3 + i4;
      break;
    case ToolCarrier::Kind::Mixed:
      point = {i2, i3};
      headGap = i1 + i2;
      tableGap = i3 + i4;
      break;
  }
  for (std::size_t i = 0; i < elements.size(); ++i) {
    elements[i]->direction = carrier.axis[i].normalized();
    elements[i]->point = point[i];
  }
  // A chain that does not close shifts the tip, or the workpiece, by a fixed way.
  constexpr double closed = 1e-12;
  if (headGap.norm() > closed) machine.spindleChain.insert(machine.spindleChain.begin(), fixedOffset(-headGap));
  if (tableGap.norm() > closed) machine.tableChain.push_back(fixedOffset(tableGap));
  return machine;
}

}  // namespace probewright::control::sinumerik
