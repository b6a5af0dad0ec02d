#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <ranges>
#include <vector>

#include "base/number_text.hpp"
#include "base/truncated.hpp"
#include "control/sinumerik/length_type.hpp"
#include "control/sinumerik/measuring_data.hpp"
#include "control/sinumerik/tool_data.hpp"
#include "cycles/sinumerik/correction_strategy.hpp"
#include "cycles/sinumerik/corrections.hpp"
#include "cycles/sinumerik/parameters.hpp"
#include "metrology/tolerance.hpp"

namespace probewright::cycles::sinumerik {

using control::sinumerik::DataKey;
using control::sinumerik::ToolEdge;

namespace {

enum class Component { FromAxis, Length1, Length2, Length3, Radius };
enum class Memory { Wear, Additive, SetupWithAdditive, Setup, Geometry };

struct ToolTarget {
  int tool = 0, edge = 0, dl = 0;
  Component component = Component::FromAxis;
  Memory memory = Memory::Wear;
  bool inverted = false;
};

/// The tool that alone has edge `edge`, where D numbers are given once on the whole machine.
std::optional<int> ownerOf(const Control& control, int edge) {
  std::optional<int> owner;
  for (const int tool : toolNumbers(control.data)) {
    if (!toolEdge(control.data, tool, edge)) continue;
    if (owner) return std::nullopt;
    owner = tool;
  }
  return owner;
}

int toolOf(Context& context, int edge) {
  const Control& control = context.control();
  const std::string& name = context.text("S_TNAME");
  // Unique D numbers need no name beside them: where the machine has such, and the fourth and fifth digit of S_KNUM1.
  if (name.empty() && (edge > 999 || control.machineData("$MN_MM_TYPE_CUTTING_EDGE") == 1)) {
    if (const auto owner = ownerOf(control, edge)) return *owner;
    context.alarm(61328, fmt::format("D{} belongs to no tool, or to several", edge));
  }
  if (name.empty()) context.alarm(61343, "S_TNAME names no tool");
  if (const auto tool = toolNamed(control.data, name)) return *tool;
  const auto number = parseInteger(name);
  if (number && *number > 0 && *number < 1000000) {
    const auto all = toolNumbers(control.data);
    if (std::ranges::find(all, static_cast<int>(*number)) != all.end()) return static_cast<int>(*number);
  }
  context.alarm(61343, fmt::format("S_TNAME = \"{}\"", name));
}

/// What S_KNUM1, S_TNAME and S_DLNUM name; nothing for S_KNUM1 = 0.
std::optional<ToolTarget> toolTarget(Context& context) {
  const int code = context.integer("S_KNUM1");
  if (code == 0) return std::nullopt;
  if (code < 0) context.alarm(61328, fmt::format("S_KNUM1 = {}", code));
  ToolTarget target;
  const int component = context.digit("S_KNUM1", 6);
  if (codesTurnedTool(context.arguments().definition())) {
    target.edge = code % 1000;
    target.inverted = context.digit("S_KNUM1", 5) == 1;
    if (component > 3) context.alarm(61314, fmt::format("sixth digit of S_KNUM1 = {}", code));
  } else {
    target.edge = code % 100000;
    target.inverted = context.digit("S_KNUM1", 8) == 1;
    if (component > 4) context.alarm(61314, fmt::format("sixth digit of S_KNUM1 = {}", code));
  }
  target.component = static_cast<Component>(component);
  const int memory = context.digit("S_KNUM1", 7);
  if (memory > 4) context.alarm(61314, fmt::format("seventh digit of S_KNUM1 = {}", code));
  target.memory = static_cast<Memory>(memory);
  if (target.edge == 0) return std::nullopt;
  target.tool = toolOf(context, target.edge);
  if (!toolEdge(context.control().data, target.tool, target.edge)) {
    context.alarm(61328, fmt::format("tool {} has no edge D{}", target.tool, target.edge));
  }
  const bool needsDl = target.memory != Memory::Wear && target.memory != Memory::Geometry;
  if (needsDl) {
    target.dl = context.integer("S_DLNUM");
    const bool setUp = !context.control().data.isSet(DataKey("$MN_MM_TOOL_MANAGEMENT_MASK", {})) ||
                       maskBit(context.control().data, "$MN_MM_TOOL_MANAGEMENT_MASK", 8);
    const int most = setUp ? truncated(context.control().machineData("$MN_MM_NUM_SUMCORR", 6)) : 0;
    if (target.dl < 1 || target.dl > std::min(6, most)) {
      context.alarm(
          61319, fmt::format("S_DLNUM = {}: additive and setup offsets have DL 1 to {}", target.dl, std::min(6, most)));
    }
  }
  return target;
}

/// A datum that a correction changes: 0, 1, 2 are length 1, 2, 3, and 3 is the radius.
struct Corrected {
  int component = 0;
  double share = 1;  ///< how far the length acts in the measuring axis; -1: against it
};

/// True if rotary axes have turned the head that holds the tools.
bool carrierIsTurned(const Context& context) {
  const control::Channel& channel = context.control().channel;
  return !machine::baseFromSpindle(channel.description(), channel.axes()).linear().isIdentity(1e-9);
}

/// The tool as its carrier holds it now, in a head that rotary axes have turned (bit 2 of MD 51740): its lengths act
/// where the head has turned their axes, at an angle several of them. The one that acts most comes first.
std::vector<Corrected> onTurnedCarrier(const Context& context, const ToolTarget& target, const ToolEdge& edge,
                                       const ToolInfluence& influence, const std::array<int, 3>& lengths) {
  const Vector3 seen = probing::directionFromSpindle(context.control().channel, context.control().workingPlane(),
                                                     PlaneWay::unit(influence.measuringAxis));
  const auto shareOf = [&](int component) { return seen[lengths[static_cast<std::size_t>(component)]]; };
  const auto signOf = [&](int component) { return shareOf(component) < -1e-9 ? -1.0 : 1.0; };
  if (target.component != Component::FromAxis) {
    const int component = static_cast<int>(target.component) - 1;
    return {{component, signOf(component)}};
  }
  constexpr double least = 1e-3;  // less is a head that leans a little beside its drawing
  std::vector<Corrected> corrected;
  for (int component = 0; component < 3; ++component)
    if (std::abs(shareOf(component)) > least) corrected.push_back({component, shareOf(component)});
  std::ranges::sort(corrected, std::greater(), [](const Corrected& each) { return std::abs(each.share); });
  if (edge.isTurning()) return corrected;
  const int component = corrected.front().component;
  if (component != 0) return {{3, 1}};
  return {{component, signOf(component)}};
}

std::vector<Corrected> correctedBy(const Context& context, const ToolTarget& target, const ToolEdge& edge,
                                   const ToolInfluence& influence) {
  if (target.component == Component::Radius) return {{3, 1}};
  const int plane = context.control().plane;
  const auto type = lengthType(context.control());
  const auto lengths = lengthAxes(planeOfLengths(context.control().data, plane), edge, type);
  if (maskBit(context.control().data, "$MNS_MEA_FUNCTION_MASK", 2) && influence.surface && carrierIsTurned(context))
    return onTurnedCarrier(context, target, edge, influence, lengths);
  if (target.component != Component::FromAxis) return {{static_cast<int>(target.component) - 1, 1}};
  if (!edge.isTurning() && (influence.radiusFromAxis || type != control::sinumerik::LengthType::AsTurning))
    return {{influence.radiusFromAxis ? 3 : 0, 1}};
  const int axis = control::WorkingPlane::ofG(plane).axis(static_cast<int>(influence.measuringAxis));
  return {{static_cast<int>(std::ranges::find(lengths, axis) - lengths.begin()), 1}};
}

void addTo(Context& context, const ToolTarget& target, const std::string& name, double amount) {
  const DataKey key(name, {target.tool, target.edge});
  context.control().write(key, context.control().data.number(key) + amount);
}

void writeCorrection(Context& context, const ToolTarget& target, const ToolEdge& edge, int component, double amount) {
  const auto index = static_cast<std::size_t>(component);
  if (target.memory == Memory::Wear && component < 3) amount *= edge.wearScale[index];
  if (target.memory == Memory::Geometry && component < 3) amount *= edge.lengthScale[index];
  const auto dp = [component](int firstLength, int radius) {
    return fmt::format("$TC_DP{}", component == 3 ? radius : firstLength + component);
  };
  const int offsetParameter = 3 + component;
  switch (target.memory) {
    case Memory::Wear:
      addTo(context, target, dp(12, 15), amount);
      break;
    case Memory::Geometry:
      addTo(context, target, dp(3, 6), amount);
      break;
    case Memory::Additive:
      addTo(context, target, control::sinumerik::additiveOffsetName(target.dl, offsetParameter), amount);
      break;
    case Memory::Setup:
      addTo(context, target, control::sinumerik::setupOffsetName(target.dl, offsetParameter), amount);
      break;
    case Memory::SetupWithAdditive: {
      const DataKey additive(control::sinumerik::additiveOffsetName(target.dl, offsetParameter),
                             {target.tool, target.edge});
      const double sum = context.control().data.number(additive);
      addTo(context, target, control::sinumerik::setupOffsetName(target.dl, offsetParameter), sum + amount);
      context.control().write(additive, 0);
      break;
    }
  }
  if (context.control().tool.number == target.tool) context.control().refreshTool();
}

bool usesTolerance(const Context& context) { return context.digit("_AMODE", 1) == 1; }

/// How many empirical or mean values the machine keeps.
int memoriesOf(const Context& context, std::string_view count) {
  return std::clamp(truncated(context.control().machineData(count, 20)), 0, 20);
}

/// The memory of the mean that S_EVNUM selects, 1 to 20; 0: none.
int meanMemory(Context& context) {
  const int number = context.integer("S_EVNUM") / 10000;
  if (number < 0 || number > memoriesOf(context, "$SCS_MEA_AVERAGE_VALUE_NUM")) {
    context.alarm(61319, fmt::format("S_EVNUM = {}", context.integer("S_EVNUM")));
  }
  return number;
}

}  // namespace

bool codesTurnedTool(const CycleDefinition& cycle) {
  const auto found = std::ranges::find(cycle.parameters, "S_KNUM1", &Parameter::name);
  return found != cycle.parameters.end() && found->digits.data() == parameters::turnedToolDigits;
}

Task taskOf(Context& context) {
  const int digit = context.digit("S_MVAR", 3);
  if (digit > 2 || (digit == 2 && !context.has("S_KNUM1"))) context.alarm(61307, "hundreds of S_MVAR");
  const auto task = static_cast<Task>(digit);
  if (task == Task::Tool && toolTarget(context)) {
    if (meanMemory(context) != 0 && context.integer("S_K") <= 0) {
      context.alarm(61318, fmt::format("S_K = {}", context.integer("S_K")));
    }
    empiricalValue(context);
    if (usesTolerance(context) && context.real("S_TUL") < context.real("S_TLL")) {
      context.alarm(61319, "S_TUL is smaller than S_TLL");
    }
  }
  return task;
}

ToolInfluence influenceOnSize(Side side, int measuringAxis) {
  const double half = side == Side::Inside ? 0.5 : -0.5;
  return {.radius = half, .length = -0.5, .radiusFromAxis = true, .measuringAxis = measuringAxis};
}

ToolInfluence influenceOnSurface(int measuringAxis, double direction) {
  return {.radius = direction < 0 ? -1.0 : 1.0,
          .length = -1,
          .radiusFromAxis = measuringAxis != 2,
          .measuringAxis = measuringAxis,
          .surface = true};
}

double setValueOf(const Context& context, Task task, double programmed) {
  if (task != Task::Tool || !usesTolerance(context)) return programmed;
  return programmed + (context.real("S_TUL") + context.real("S_TLL")) / 2;
}

Compared comparedSurface(Context& context, Task task, double set, double actual, double direction) {
  // Material in front of the set value, where the probe comes from, can still be taken away: as in a hole too small.
  return comparedSize(context, task, set, actual, direction > 0 ? Side::Inside : Side::Outside);
}

Compared comparedSize(Context& context, Task task, double set, double actual, Side side) {
  Compared compared{.nominal = set};
  if (task != Task::Tool || !usesTolerance(context)) return compared;
  const double half = (context.real("S_TUL") - context.real("S_TLL")) / 2;
  const metrology::Limits limits{set - half, set + half};
  compared.lower = limits.lower;
  compared.upper = limits.upper;
  const double judged = actual - empiricalValue(context);
  compared.verdict = side == Side::Inside ? boreVerdict(judged, limits) : studVerdict(judged, limits);
  context.record().verdict = worst(context.record().verdict, compared.verdict);
  return compared;
}

double empiricalValue(Context& context) {
  const int number = context.integer("S_EVNUM") % 10000;
  if (number < 0 || number > memoriesOf(context, "$SCS_MEA_EMPIRIC_VALUE_NUM")) {
    context.alarm(61319, fmt::format("S_EVNUM = {}", context.integer("S_EVNUM")));
  }
  return number == 0 ? 0 : context.control().data.number("$SCS_MEA_EMPIRIC_VALUE", {number - 1});
}

void correctTool(Context& context, std::span<const Dimension> dimensions, const ToolInfluence& influence) {
  const std::optional<ToolTarget> target = toolTarget(context);
  if (!target) return;
  Control& control = context.control();

  const bool tolerance = usesTolerance(context);
  const double halfTolerance = (context.real("S_TUL") - context.real("S_TLL")) / 2;
  const CorrectionBands bands = {
      .zeroOffsetRange = context.real("S_TZL"),
      .meanRange = context.real("S_TMV"),
      .dimensionalDifference = context.real("S_TDIF"),
      .tolerance = tolerance ? std::optional(halfTolerance) : std::nullopt,
  };
  const double empirical = empiricalValue(context);
  const int memory = meanMemory(context);
  std::optional<WeightedMean> mean;
  if (memory != 0) {
    mean = {.old = control.data.number("$SCS_MEA_AVERAGE_VALUE", {memory - 1}),
            .weight = static_cast<double>(context.integer("S_K"))};
  }

  double sum = 0;
  bool wornOut = false;
  for (const Dimension& dimension : dimensions) {
    const double difference = dimension.actual - dimension.set - empirical;
    sum += difference;
    wornOut = wornOut || decideCorrection(difference, bands, std::nullopt).toolWornOut;
  }
  if (wornOut) context.repeatIfAsked(61306, fmt::format("S_TDIF = {:.4f} mm", bands.dimensionalDifference));
  for (const Dimension& dimension : dimensions) {
    const double difference = dimension.actual - dimension.set - empirical;
    const CorrectionDecision single = decideCorrection(difference, bands, std::nullopt);
    if (tolerance) {
      context.result(dimension.upperResult, halfTolerance);
      context.result(dimension.lowerResult, -halfTolerance);
    }
    if (single.size == CorrectionDecision::Size::Over) {
      context.warn(61304, fmt::format("{:.4f} mm above the middle of the tolerance", difference));
    }
    if (single.size == CorrectionDecision::Size::Under) {
      context.warn(61305, fmt::format("{:.4f} mm below the middle of the tolerance", -difference));
    }
    if (single.size != CorrectionDecision::Size::Within)
      context.stopOutOfTolerance("The workpiece is out of tolerance");
  }
  CorrectionDecision decision = decideCorrection(sum / static_cast<double>(dimensions.size()), bands, mean);
  if (wornOut) {
    context.warn(61306, fmt::format("S_TDIF = {:.4f} mm", bands.dimensionalDifference));
    context.stopOutOfTolerance("The permissible dimensional difference is exceeded");
    decision = {};
    if (mean) decision.mean = mean->old;
  }

  double written = 0;
  if (decision.corrects) {
    const ToolEdge edge = toolEdge(control.data, target->tool, target->edge).value_or(ToolEdge{});
    const std::vector<Corrected> corrected = correctedBy(context, *target, edge, influence);
    for (const auto& [component, share] : std::views::reverse(corrected)) {
      written = decision.correction * (component == 3 ? influence.radius : share * influence.length);
      if (target->inverted) written = -written;
      writeCorrection(context, *target, edge, component, written);
    }
  }
  if (memory != 0 && decision.mean) {
    const DataKey key("$SCS_MEA_AVERAGE_VALUE", {memory - 1});
    if (control.data.number(key) != *decision.mean) control.write(key, *decision.mean);
  }

  context.result(20, written);
  context.result(27, bands.zeroOffsetRange);
  context.result(28, context.real("S_TSA"));
  context.result(29, bands.dimensionalDifference);
  context.result(30, empirical);
  context.result(31, decision.formed.value_or(decision.mean.value_or(0)));
  context.resultInteger(0, target->edge);
  context.resultInteger(4, context.integer("S_K"));
  context.resultInteger(6, memory);
  context.resultInteger(7, context.integer("S_EVNUM") % 10000);
  context.resultInteger(8, target->tool);
  context.resultInteger(13, target->dl);
  context.correctedTool(toolName(control.data, target->tool));
}

}  // namespace probewright::cycles::sinumerik
