#include "cycles/sinumerik/tool_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "control/sinumerik/tool_data.hpp"
#include "cycles/sinumerik/corrections.hpp"

namespace probewright::cycles::sinumerik {

using control::sinumerik::DataKey;
using control::sinumerik::ToolEdge;

namespace {

constexpr int radiusComponent = 3;

std::string geometryName(int component) { return fmt::format("$TC_DP{}", 3 + component); }
std::string wearName(int component) { return fmt::format("$TC_DP{}", 12 + component); }

DataKey ofActiveEdge(const Context& context, const std::string& name) {
  return {name, {context.control().tool.number, context.control().tool.edge}};
}

/// How a component counts in geometry and wear: 2 where it is a diameter.
struct Counts {
  double geometry = 1, wear = 1;
};

Counts countsOf(const Context& context, int component) {
  if (component == radiusComponent) return {};
  const Control& control = context.control();
  const auto edge = toolEdge(control.data, control.tool.number, control.tool.edge).value_or(ToolEdge{});
  const auto place = static_cast<std::size_t>(component);
  return {edge.lengthScale[place], edge.wearScale[place]};
}

}  // namespace

ProbeSystem systemOf(const Context& context) {
  return context.digit("S_MVAR", 2) == 1 ? ProbeSystem::Workpiece : ProbeSystem::Machine;
}

namespace {

/// SD 54652 gives tool probes of a counter spindle a measuring input of their own; here they signal at that of the
/// others. Said once a run.
void nameSkippedInput(Context& context, int index) {
  auto& control = context.control();
  if (control.data.number("$SNS_MEA_INPUT_TOOL_PROBE_SUB", {index}, 0) == 0) return;
  const std::string text = fmt::format("$SNS_MEA_INPUT_TOOL_PROBE_SUB[{}] is skipped", index);
  const auto told = [&](const control::EventRecord& event) { return event.text == text; };
  if (std::ranges::none_of(control.journal.events, told))
    control.panel.message(control::EventKind::Skipped, text, control.channel.seconds());
}

}  // namespace

int toolProbeIndex(Context& context) {
  const int number = context.integer("S_PRNUM") == 0 ? 1 : context.integer("S_PRNUM");
  if (number < 1 || number > toolProbeFields) context.alarm(61313, fmt::format("S_PRNUM = {}", number));
  nameSkippedInput(context, number - 1);
  return number - 1;
}

double touchingFeed(const Context& context, const ToolProbeField& field, Touching what) {
  if (const double asked = context.real("S_VMS"); asked > 0) return asked;
  if (what == Touching::Measures && field.feed > 0) return field.feed;
  const double usual = context.control().machineData("$SCS_MEA_TP_FEED_MEASURE");
  return usual > 0 ? usual : 300;
}

namespace {

constexpr double rounding = 1e-9;

bool isWornOut(const Context& context, double judged) {
  const double most = context.real("S_TDIF");
  return most > 0 && std::abs(judged) > most + rounding;
}

std::string wornText(const Context& context, double judged) {
  return fmt::format("difference {:.4f} mm, S_TDIF = {:.4f} mm", judged, context.real("S_TDIF"));
}

}  // namespace

void repeatIfBeyond(Context& context, std::span<const double> differences) {
  for (const double difference : differences) {
    const double judged = difference - empiricalValue(context);
    const double safe = context.real("S_TSA");
    if (std::abs(judged) > safe + rounding)
      context.repeatIfAsked(61303, fmt::format("difference {:.4f} mm, safe area TSA {:.4f} mm", judged, safe));
    if (isWornOut(context, judged)) context.repeatIfAsked(61306, wornText(context, judged));
  }
}

Judgement judgeTool(Context& context, double difference, const std::string& what) {
  const double judged = difference - empiricalValue(context);
  context.checkSafeArea(judged);
  if (isWornOut(context, judged)) {
    context.warn(61306, fmt::format("{}: {}", what, wornText(context, judged)));
    context.stopOutOfTolerance("The permissible dimensional difference is exceeded");
    return Judgement::WornOut;
  }
  return std::abs(judged) < context.real("S_TZL") - rounding ? Judgement::Random : Judgement::Corrects;
}

void correctEdge(Context& context, int component, double difference) {
  Control& control = context.control();
  const double amount = difference - empiricalValue(context);
  const DataKey geometry = ofActiveEdge(context, geometryName(component));
  const DataKey wear = ofActiveEdge(context, wearName(component));
  const Counts counts = countsOf(context, component);
  const double worn = control.data.number(wear);
  if (context.digit("S_KNUM", 1) == 1) {
    control.write(wear, worn + amount * counts.wear);
  } else {
    const double believed = control.data.number(geometry) + worn / counts.wear * counts.geometry;
    control.write(geometry, believed + amount * counts.geometry);
    if (worn != 0) control.write(wear, 0);
  }
  control.refreshTool();
}

double believedComponent(const Context& context, int component) {
  const auto& data = context.control().data;
  const Counts counts = countsOf(context, component);
  return data.number(ofActiveEdge(context, geometryName(component))) / counts.geometry +
         data.number(ofActiveEdge(context, wearName(component))) / counts.wear;
}

void noteTool(Context& context) {
  const Control& control = context.control();
  context.result(27, context.real("S_TZL"));
  context.result(28, context.real("S_TSA"));
  context.result(29, context.real("S_TDIF"));
  context.result(30, empiricalValue(context));
  context.resultInteger(0, control.tool.edge);
  context.resultInteger(7, context.integer("S_EVNUM"));
  context.resultInteger(8, control.tool.number);
  context.correctedTool(control.tool.name);
}

}  // namespace probewright::cycles::sinumerik
