#include "cycles/sinumerik/tool_probe_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace probewright::cycles::sinumerik {

using control::BelievedToolProbe;
using control::sinumerik::DataKey;
using control::sinumerik::DataStore;

namespace {

/// A probe in coordinates whose origin is `origin` in the machine's.
void enter(DataStore& data, ProbeSystem system, int index, const BelievedToolProbe& probe, const Vector3& origin,
           const control::WorkingPlane& plane) {
  const auto put = [&](const std::string& name, double value) { data.load(DataKey(name, {index}), value); };
  int directions = 0, place = 1;
  for (int axis = 0; axis < 3; ++axis, place *= 10) {
    const int xyz = plane.axis(axis);
    const bool plus = probe.gives[static_cast<std::size_t>(2 * xyz)];
    const bool minus = probe.gives[static_cast<std::size_t>(2 * xyz + 1)];
    // Whoever fitted it knows its sides; the 3rd axis has those only where it signals.
    if (axis < 2 || minus) put(toolProbeTrigger(system, axis, -1), probe.most[xyz] - origin[xyz] - probe.pretravel);
    if (axis < 2 || plus) put(toolProbeTrigger(system, axis, 1), probe.least[xyz] - origin[xyz] + probe.pretravel);
    directions += place * ((minus ? 1 : 0) + (plus ? 2 : 0));  // the digit of SD 54632 for an axis
  }
  put(toolProbeDatum(system, "EDGE_DISK_SIZE"), probe.width);
  put(toolProbeDatum(system, "AX_DIR_AUTO_CAL"), directions);
  put(toolProbeDatum(system, "TYPE"), probe.cuboid ? 0 : 101);
  put(toolProbeDatum(system, "FEED"), data.number("$SCS_MEA_TP_FEED_MEASURE", {}, 0));
}

}  // namespace

std::string toolProbeDatum(ProbeSystem system, std::string_view what) {
  return fmt::format("$SNS_MEA_{}_{}", system == ProbeSystem::Machine ? "TP" : "TPW", what);
}

std::string toolProbeTrigger(ProbeSystem system, int axis, double sign) {
  return toolProbeDatum(system, fmt::format("TRIG_{}_DIR_AX{}", sign < 0 ? "MINUS" : "PLUS", axis + 1));
}

double ToolProbeField::trigger(int axis, double sign) const {
  return (sign < 0 ? triggerMinus : triggerPlus)[static_cast<std::size_t>(axis)];
}

double ToolProbeField::centre(int axis) const {
  const double minus = trigger(axis, -1), plus = trigger(axis, 1);
  if (minus == 0 && plus != 0 && !approaches(axis, -1)) return plus + size / 2;
  if (plus == 0 && minus != 0 && !approaches(axis, 1)) return minus - size / 2;
  return (minus + plus) / 2;
}

bool ToolProbeField::isEmpty() const {
  const auto zero = [](double value) { return value == 0; };
  return std::ranges::all_of(triggerMinus, zero) && std::ranges::all_of(triggerPlus, zero);
}

bool ToolProbeField::approaches(int axis, double sign) const {
  int digits = std::abs(directions);
  for (int i = 0; i < axis; ++i)
    digits /= 10;
  return (digits % 10 & (sign < 0 ? 1 : 2)) != 0;
}

ToolProbeField toolProbeField(const DataStore& data, ProbeSystem system, int index) {
  const auto datum = [&](const char* what) { return data.number(toolProbeDatum(system, what), {index}); };
  ToolProbeField field;
  for (int axis = 0; axis < 3; ++axis) {
    const auto place = static_cast<std::size_t>(axis);
    field.triggerMinus[place] = data.number(toolProbeTrigger(system, axis, -1), {index});
    field.triggerPlus[place] = data.number(toolProbeTrigger(system, axis, 1), {index});
  }
  field.size = datum("EDGE_DISK_SIZE");
  field.directions = static_cast<int>(std::lround(datum("AX_DIR_AUTO_CAL")));
  field.type = static_cast<int>(std::lround(datum("TYPE")));
  field.depth = datum("CAL_MEASURE_DEPTH");
  field.feed = datum("FEED");
  return field;
}

void enterToolProbes(DataStore& data, std::span<const BelievedToolProbe> probes,
                     const control::BelievedFrame* activeOffset, control::WorkingPlane plane) {
  const bool turned = activeOffset != nullptr && !activeOffset->rotation.isZero(0);
  const Vector3 origin = activeOffset == nullptr ? Vector3::Zero() : activeOffset->origin;
  int index = 0;
  for (const BelievedToolProbe& probe : probes) {
    if (index == toolProbeFields) return;
    enter(data, ProbeSystem::Machine, index, probe, Vector3::Zero(), plane);
    if (!turned) enter(data, ProbeSystem::Workpiece, index, probe, origin, plane);
    ++index;
  }
}

}  // namespace probewright::cycles::sinumerik
