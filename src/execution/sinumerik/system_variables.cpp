#include "execution/sinumerik/system_variables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <numbers>

#include "base/number_text.hpp"
#include "base/utc.hpp"
#include "control/alarm.hpp"
#include "control/sinumerik/former_names.hpp"
#include "control/sinumerik/master_spindle.hpp"
#include "control/sinumerik/text.hpp"
#include "control/sinumerik/tool_data.hpp"
#include "execution/sinumerik/datum_check.hpp"
#include "execution/sinumerik/functions.hpp"
#include "execution/sinumerik/measuring_inputs.hpp"

namespace probewright::execution::sinumerik {

using control::Alarm;
using control::sinumerik::DataIndex;
using control::sinumerik::DataKey;
using control::sinumerik::DataValue;
using control::sinumerik::Frame;
using control::sinumerik::FramePart;

namespace {

int integerAt(std::span<const Value> indices, std::size_t place, int otherwise = 0) {
  if (place >= indices.size()) return otherwise;
  const auto* number = std::get_if<double>(&indices[place]);
  return number != nullptr ? static_cast<int>(std::lround(*number)) : otherwise;
}

std::string axisAt(std::span<const Value> indices, std::size_t place, std::string_view name) {
  if (place < indices.size()) {
    if (const auto* text = std::get_if<std::string>(&indices[place])) return upperCase(*text);
  }
  throw Alarm("17020", fmt::format("{} needs the name of an axis as index", name), "write for instance [X]");
}

Value fromDatum(const DataValue& value) {
  if (const auto* number = std::get_if<double>(&value)) return *number;
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? 1.0 : 0.0;
  return std::get<std::string>(value);
}

/// The data behind an active basic frame: $P_BFRAME and $P_CHBFRAME[0] are $P_CHBFR[0].
std::optional<DataKey> basicFrameData(std::string_view name, std::span<const Value> indices) {
  const int number = integerAt(indices, 0);
  if (name == "$P_BFRAME" || name == "$P_CHBFRAME") return DataKey("$P_CHBFR", {number});
  if (name == "$P_NCBFRAME") return DataKey("$P_NCBFR", {number});
  if (name == "$P_SETFRAME") return DataKey("$P_SETFR", {});
  return std::nullopt;
}

/// Frames of data management, whose components the store keeps.
bool isStoredFrame(std::string_view name) {
  return name == "$P_UIFR" || name == "$P_UBFR" || name == "$P_CHBFR" || name == "$P_NCBFR" || name == "$P_SETFR" ||
         name == "$P_EXTFR" || name == "$P_PARTFR" || name == "$P_TOOLFR" || name == "$P_WPFR" || name == "$P_CYCFR" ||
         name == "$P_TRAFR";
}

}  // namespace

DataKey dataKey(std::string_view name, std::span<const Value> indices) {
  std::vector<DataIndex> places;
  for (const Value& index : indices) {
    if (const auto* number = std::get_if<double>(&index)) {
      places.emplace_back(std::lround(*number));
    } else {
      places.emplace_back(std::get<std::string>(index));
    }
  }
  return DataKey(name, places);
}

Value SystemVariables::read(std::string_view name, std::span<const Value> indices) {
  requireDatum(name, indices, nullptr, control_.data);
  if (name == "$PI") return std::numbers::pi;
  if (name.starts_with("$TC_")) return datum(name, indices);
  if (name.starts_with("$AA_") || name.starts_with("$P_EP") || name.starts_with("$VA_"))
    if (auto value = readPosition(name, indices)) return *value;
  if (name.starts_with("$P_")) {
    if (auto value = readTool(name, indices)) return *value;
    if (auto value = readFrame(name, indices)) return *value;
  }
  if (auto value = readState(name, indices)) return *value;
  return datum(name, indices);
}

/// The axis that the first index names; AX2 is the second one of the machine.
std::string SystemVariables::machineAxisAt(std::span<const Value> indices, std::string_view name) const {
  std::string axis = axisAt(indices, 0, name);
  if (!axis.starts_with("AX")) return axis;
  const auto& axes = control_.channel.description().axes;
  const auto number = parseInteger(std::string_view(axis).substr(2));
  return number && *number >= 1 && static_cast<std::size_t>(*number) <= axes.size()
             ? upperCase(axes[static_cast<std::size_t>(*number) - 1].name)
             : axis;
}

std::optional<Value> SystemVariables::readPosition(std::string_view name, std::span<const Value> indices) {
  enum class System { Workpiece, Machine };
  System system = System::Workpiece;
  bool measured = false;
  if (name == "$AA_IW" || name == "$P_EP" || name == "$AA_IEN" || name == "$AA_IBN") {
    system = System::Workpiece;
  } else if (name == "$AA_IM" || name == "$AA_IB" || name == "$VA_IM" || name == "$P_EPM") {
    system = System::Machine;
  } else if (name.starts_with("$AA_MW")) {
    measured = true;
  } else if (name.starts_with("$AA_MM")) {
    measured = true;
    system = System::Machine;
  } else {
    return std::nullopt;
  }
  motion_.flush();
  const std::string axis = machineAxisAt(indices, name);
  const std::uint32_t address = language::addressOf(axis);
  const auto linear = PathMotion::linearAxis(address);
  const auto machineAxis = motion_.machineAxis(address);
  if (!linear && !machineAxis) throw Alarm("17020", fmt::format("{}: there is no axis {}", name, axis));
  const Measurement& found = motion_.measurement();
  const AxisPositions axes = measured ? found.latched : control_.channel.axes();
  const std::vector<machine::Axis>& ofMachine = control_.channel.description().axes;
  double value = 0;
  if (system == System::Machine) {
    if (!machineAxis) throw Alarm("17020", fmt::format("{}: the machine has no axis {}", name, axis));
    value = machine::shownPosition(ofMachine[*machineAxis], axes[*machineAxis]);
  } else if (linear) {
    const ProgramPlace tip = measured ? found.tip : control_.channel.position();
    value = tip[static_cast<Eigen::Index>(*linear)];
    if (*linear == 0 && control_.diameter) value *= 2;
  } else {
    return machine::shownPosition(ofMachine[*machineAxis],
                                  axes[*machineAxis] - control_.channel.rotaryOffset[*machineAxis]);
  }
  const bool length = ofMachine[machineAxis.value_or(0)].kind == machine::AxisKind::Linear;
  return length ? value / unit() : value;
}

std::optional<Value> SystemVariables::readTool(std::string_view name, std::span<const Value> indices) {
  const auto& tool = control_.tool;
  const auto edgeDatum = [&](int parameter) -> Value {
    if (tool.edge == 0) return 0.0;
    return control_.data.number(fmt::format("$TC_DP{}", parameter), {tool.number, tool.edge});
  };
  if (name == "$P_TOOLNO") return static_cast<double>(tool.number);
  if (name == "$P_TOOL") return static_cast<double>(tool.edge);
  if (name == "$P_TOOLR") return tool.radius;
  if (name == "$P_TOOLL") {
    const int length = integerAt(indices, 0, 1);
    if (length < 1 || length > 3) throw Alarm("17020", "$P_TOOLL has the lengths 1 to 3");
    const auto edge = control::sinumerik::toolEdge(control_.data, tool.number, tool.edge, tool.dl);
    return edge ? edge->totalLength()[static_cast<std::size_t>(length - 1)] : 0.0;
  }
  if (name == "$P_TOOLND") {
    const int number = integerAt(indices, 0, tool.number);
    return static_cast<double>(control::sinumerik::toolEdges(control_.data, number).size());
  }
  if (name == "$P_TOOLEXIST")
    return control::sinumerik::toolEdges(control_.data, integerAt(indices, 0)).empty() ? 0.0 : 1.0;
  if (name == "$P_AD" || name == "$P_ADT") return edgeDatum(integerAt(indices, 0, 1));
  return std::nullopt;
}

Frame* SystemVariables::activeFrame(std::string_view name) {
  if (name == "$P_PFRAME") return &control_.frames.programmed;
  if (name == "$P_WPFRAME" || name == "$P_TOOLFRAME" || name == "$P_PARTFRAME") return &control_.frames.toolOriented;
  if (name == "$P_IFRAME") return &control_.frames.settableFrame;
  return nullptr;
}

std::optional<Value> SystemVariables::readFrame(std::string_view name, std::span<const Value> indices) {
  if (name == "$P_UIFRNUM") return static_cast<double>(control_.frames.settable);
  Frame frame;
  std::size_t own = 0;  // indices that name the frame itself
  if (name == "$P_ACTFRAME") {
    const auto whole = control::sinumerik::frameFromTransform(control_.machineFromWorkpiece());
    if (!whole) throw Alarm("18314", whole.error().message, whole.error().advice);
    frame = *whole;
  } else if (name == "$P_ACTBFRAME") {
    frame = control_.frames.base;
  } else if (const auto basic = basicFrameData(name, indices)) {
    own = !indices.empty() && !language::isText(indices[0]) ? 1 : 0;
    frame = control_.activeBasicFrame(*basic);
  } else if (const Frame* active = activeFrame(name)) {
    frame = *active;
  } else if (isStoredFrame(name)) {
    own = !indices.empty() && !language::isText(indices[0]) ? 1 : 0;
    frame = control_.data.frame(name == "$P_UBFR" ? DataKey("$P_CHBFR", {0}) : dataKey(name, indices.first(own)));
  } else {
    return std::nullopt;
  }
  if (indices.size() == own) return frameValue(frame);
  const std::string axis = axisAt(indices, own, name);
  const auto part = indices.size() > own + 1 ? control::sinumerik::framePartOf(axisAt(indices, own + 1, name))
                                             : std::optional(FramePart::Translation);
  if (!part) throw Alarm("17030", fmt::format("{} has the components TR, FI, RT, SC and MI", name));
  const double value = frame.get(axis, *part);
  const bool length = *part == FramePart::Translation || *part == FramePart::Fine;
  return length && control::sinumerik::geometryAxisOf(axis) ? value / unit() : value;
}

std::optional<Value> SystemVariables::readState(std::string_view name, std::span<const Value> indices) {
  const auto number = [](double value) { return Value(value); };
  if (name == "$AC_MEA") return number(motion_.measurement().triggered ? 1 : 0);
  if (name == "$A_PROBE") {
    const int input = integerAt(indices, 0, 1);
    const auto sensor = sensorAt(input, control_);
    return number(sensor && control_.channel.deflected(*sensor) ? 1 : 0);
  }
  if (name == "$P_GG") {
    const int group = integerAt(indices, 0);
    if (group < 1 || group >= static_cast<int>(state_.gGroup.size())) throw Alarm("17020", "there is no such G group");
    if (group == 7) return number(static_cast<int>(state_.compensation));
    if (group == 1) {
      switch (state_.group1) {
        case language::MoveKind::Rapid:
          return number(1);
        case language::MoveKind::ArcClockwise:
          return number(3);
        case language::MoveKind::ArcCounterclockwise:
          return number(4);
        case language::MoveKind::ArcThroughPoint:
          return number(5);
        default:
          return number(2);
      }
    }
    return number(state_.gGroup[static_cast<std::size_t>(group)]);
  }
  if (name == "$P_F") return number(state_.feed);
  if (name == "$P_S") return number(state_.spindleSpeed);
  if (name == "$P_SDIR") return number(state_.spindleDirection);
  if (name == "$P_MSNUM") return number(masterSpindle(control_));
  if (name == "$P_CHANNO" || name == "$AC_PROG") return number(1);
  if (name == "$AC_STAT") return number(2);  // a program is running
  if (name == "$P_D") return number(control_.tool.edge);
  if (name == "$MC_MM_NUM_USER_FRAMES") return number(control_.machineData(name, 100));
  if (name == "$MA_POS_LIMIT_PLUS" || name == "$MA_POS_LIMIT_MINUS") {
    const auto axis = motion_.machineAxis(language::addressOf(machineAxisAt(indices, name)));
    if (!axis) throw Alarm("17020", fmt::format("{}: there is no such axis", name));
    const machine::Axis& travel = control_.channel.description().axes[*axis];
    return number(name == "$MA_POS_LIMIT_PLUS" ? travel.maximum : travel.minimum);
  }
  if (name == "$P_ISTEST") return number(control_.programTest ? 1 : 0);
  if (name == "$P_DRYRUN") return number(control_.dryRun ? 1 : 0);
  if (name == "$P_SEARCH" || name == "$P_SEARCHL") return number(control_.blockSearch ? 1 : 0);
  if (name == "$P_SIM") return number(0);
  if (name == "$P_STACK") return number(control_.level);
  if (name == "$P_MC") return number(control_.modalCall ? 1 : 0);
  if (name == "$P_TRAFO" || name == "$AC_TRAFO") return number(control_.transformation ? 1 : 0);
  if (name == "$P_AXN1") return Value(std::string("X"));
  if (name == "$P_AXN2") return Value(std::string("Y"));
  if (name == "$P_AXN3") return Value(std::string("Z"));
  if (name == "$P_PROG" || name == "$P_PROGPATH") return Value(control_.programPath);
  if (name == "$P_PATH") return Value(control_.programPath.substr(0, control_.programPath.find_last_of("/\\") + 1));
  if (name == "$AC_TIME" || name == "$AC_TIMER" || name == "$AN_SETUP_TIME" || name == "$AC_OPERATING_TIME")
    return number(control_.channel.seconds());
  if (name == "$MN_SCALING_SYSTEM_IS_METRIC") return number(1);
  if (name == "$A_YEAR" || name == "$A_MONTH" || name == "$A_DAY" || name == "$A_HOUR" || name == "$A_MINUTE" ||
      name == "$A_SECOND" || name == "$A_MSECOND") {
    const double seconds = std::floor(control_.channel.seconds() + 1e-9);
    if (name == "$A_MSECOND")
      return number(std::floor(1000 * std::max(0.0, control_.channel.seconds() - seconds) + 1e-6));
    const std::tm parts = utcTime(control_.wallClockStart, seconds);
    if (name == "$A_YEAR") return number(parts.tm_year + 1900);
    if (name == "$A_MONTH") return number(parts.tm_mon + 1);
    if (name == "$A_DAY") return number(parts.tm_mday);
    if (name == "$A_HOUR") return number(parts.tm_hour);
    return number(name == "$A_MINUTE" ? parts.tm_min : parts.tm_sec);
  }
  return std::nullopt;
}

Value SystemVariables::datum(std::string_view name, std::span<const Value> indices) {
  const DataKey key = dataKey(name, indices);
  if (const auto value = control_.data.get(key)) return fromDatum(*value);
  if (name == "$TC_TP2" || name == "$TC_CARR34") return std::string();
  // What a channel begins with where no file of the control says it: the plane, G71, DIAMOF.
  if (name == "$MC_GCODE_RESET_VALUES" && indices.size() == 1) {
    const int group = integerAt(indices, 0) + 1;
    if (group == 6) return control_.channel.description().axisIndex("Y") ? 1.0 : 2.0;
    if (group == 13) return 2.0;
    if (group == 29) return 1.0;
  }
  if (const auto former = control::sinumerik::readFormer(control_.data, key)) return *former;
  // Tool data of an existing edge have the neutral value 0; everything else is worth a word.
  const bool ofEdge = name.starts_with("$TC_DP") && indices.size() == 2;
  const bool exists =
      name.starts_with("$TC_") &&
      !(ofEdge && !control::sinumerik::toolEdge(control_.data, integerAt(indices, 0), integerAt(indices, 1)));
  if (!exists && !warned_.contains(name)) {
    warned_.insert(std::string(name));
    control_.panel.message(control::EventKind::Warning, fmt::format("{} has no value here and reads as 0", key.text()),
                           control_.channel.seconds());
  }
  return 0.0;
}

bool SystemVariables::exists(std::string_view name, std::span<const Value> indices) const {
  static constexpr std::string_view computed[] = {"$P_", "$AA_", "$AC_", "$A_", "$PI"};
  for (const std::string_view family : computed)
    if (name.starts_with(family)) return true;
  return control_.data.get(dataKey(name, indices)).has_value();
}

bool SystemVariables::writeFrame(std::string_view name, std::span<const Value> indices, const Value& value) {
  Frame* active = activeFrame(name);
  const bool stored = isStoredFrame(name);
  const auto basic = basicFrameData(name, indices);
  if (active == nullptr && !stored && !basic) return false;
  const std::size_t own = (stored || basic) && !indices.empty() && !language::isText(indices[0]) ? 1 : 0;
  if (basic && own == 1 && (integerAt(indices, 0) < 0 || integerAt(indices, 0) > 15))
    throw Alarm("17020", fmt::format("{}: there is no basic frame {}", name, integerAt(indices, 0)),
                "basic frames have the numbers 0 to 15");
  const DataKey key = basic ? *basic : name == "$P_UBFR" ? DataKey("$P_CHBFR", {0}) : dataKey(name, indices.first(own));
  const Frame before = basic ? control_.activeBasicFrame(key) : stored ? control_.data.frame(key) : *active;
  Frame after = before;
  if (indices.size() == own) {
    after = frameOf(value);
  } else {
    const auto* number = std::get_if<double>(&value);
    if (number == nullptr) throw Alarm("12150", fmt::format("a component of {} is a number", name));
    const std::string axis = axisAt(indices, own, name);
    const auto part = indices.size() > own + 1 ? control::sinumerik::framePartOf(axisAt(indices, own + 1, name))
                                               : std::optional(FramePart::Translation);
    if (!part) throw Alarm("17030", fmt::format("{} has the components TR, FI, RT, SC and MI", name));
    if (!control::sinumerik::geometryAxisOf(axis) && !motion_.machineAxis(language::addressOf(axis)))
      throw Alarm(own == 0 ? "17020" : "17030", fmt::format("{}: there is no axis {}", name, axis));
    const bool length = *part == FramePart::Translation || *part == FramePart::Fine;
    after.set(axis, *part, *number * (length && control::sinumerik::geometryAxisOf(axis) ? unit() : 1));
  }
  if (basic) {
    control_.setActiveBasicFrame(key, after);
    return true;
  }
  if (!stored) {
    *active = after;
    control_.handOverFrames();
    return true;
  }
  std::vector<std::string> axes = {"X", "Y", "Z"};
  for (const auto& [axis, parts] : before.others)
    axes.push_back(axis);
  for (const auto& [axis, parts] : after.others)
    if (!before.others.contains(axis)) axes.push_back(axis);
  for (const std::string& axis : axes) {
    for (const FramePart part : control::sinumerik::allFrameParts) {
      if (after.get(axis, part) == before.get(axis, part)) continue;
      DataKey component = key;
      component.indices.push_back(axis);
      component.indices.emplace_back(control::sinumerik::name(part));
      control_.write(component, after.get(axis, part));
    }
  }
  return true;
}

void SystemVariables::write(std::string_view name, std::span<const Value> indices, const Value& value) {
  motion_.flush();
  requireDatum(name, indices, &value, control_.data);
  if (writeFrame(name, indices, value)) return;
  const bool computed = name.starts_with("$AA_") || name == "$P_TOOLNO" || name == "$P_TOOL" || name == "$P_UIFRNUM" ||
                        name == "$P_ACTFRAME" || name == "$P_ACTBFRAME" || name == "$P_GG" || name == "$PI" ||
                        name == "$AC_MEA";
  if (computed) throw Alarm("12130", fmt::format("{} can only be read", name));
  const DataKey key = dataKey(name, indices);
  if (const auto* number = std::get_if<double>(&value)) {
    if (control::sinumerik::writeFormer(control_.data, key, *number)) return;
    return control_.write(key, *number);
  }
  const auto before = control_.data.get(key);
  const std::string& text = std::get<std::string>(value);
  control_.data.set(key, text);
  const std::string whole = key.text();
  const std::size_t bracket = whole.find('[');
  control_.journal.write({whole.substr(0, bracket), bracket == std::string::npos ? "" : whole.substr(bracket),
                          before ? control::sinumerik::valueText(*before) : "",
                          control::sinumerik::valueText(DataValue(text))});
}

}  // namespace probewright::execution::sinumerik
