#include "session/sinumerik/own_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "session/own_control.hpp"

namespace probewright::session::sinumerik {

namespace sin = control::sinumerik;
using machine::OwnOffset;
using machine::OwnTables;
using machine::OwnTool;

namespace {

sin::DataKey frameKey(int number) { return {"$P_UIFR", {number}}; }
sin::DataKey edge(int parameter, int tool) { return {fmt::format("$TC_DP{}", parameter), {tool, 1}}; }

bool isOwn(const sin::Frame& frame) {
  const auto turned = [](const sin::FrameAxis& axis) { return axis.scale != 1 || axis.mirror; };
  return frame.geometry[0].rotation != 0 || frame.geometry[1].rotation != 0 ||
         std::ranges::any_of(frame.geometry, turned) ||
         std::ranges::any_of(frame.others, [&](const auto& axis) { return turned(axis.second); });
}

double translation(const sin::Frame& frame, const std::string& axis) {
  return frame.get(axis, sin::FramePart::Translation) + frame.get(axis, sin::FramePart::Fine);
}

OwnOffset offsetOf(const sin::Frame& frame, OwnOffset offset, const machine::MachineDescription& machine) {
  for (std::size_t i = 0; i < machine.axes.size(); ++i)
    offset.origin[i] = translation(frame, machine.axes[i].name);
  offset.rotation = frame.geometry[2].rotation;
  return offset;
}

bool isSet(const sin::DataStore& store, int number) {
  return std::ranges::any_of(store.keys("$P_UIFR"), [&](const sin::DataKey& key) {
    return !key.indices.empty() && key.indices.front() == std::to_string(number);
  });
}

/// Mills, drills and touch probes: length 1 lies along the spindle.
bool isShared(const sin::DataStore& store, int tool) {
  const double type = store.number(edge(1, tool), 0);
  return (type >= 100 && type < 300) || (type >= 700 && type < 800);
}

/// What is added to the parameters for geometry.
double lengthAside(const sin::DataStore& store, int tool) {
  return store.number(edge(12, tool), 0) + store.number(edge(21, tool), 0);
}

OwnTool toolOf(const sin::DataStore& store, OwnTool tool) {
  tool.length = store.number(edge(3, tool.number), 0) + lengthAside(store, tool.number);
  if (store.number(edge(1, tool.number), 0) < 700)
    tool.diameter = 2 * (store.number(edge(6, tool.number), 0) + store.number(edge(15, tool.number), 0));
  return tool;
}

bool differ(double a, double b) { return !(std::abs(a - b) <= sameNumber); }

}  // namespace

std::vector<std::string> takeOver(sin::DataStore& store, const OwnTables& own,
                                  const machine::MachineDescription& machine) {
  std::vector<std::string> notes;
  for (const OwnOffset& offset : own.offsets) {
    sin::Frame frame = store.frame(frameKey(offset.number));
    if (isUnset(offset) || isOwn(frame) || same(offsetOf(frame, offset, machine), offset, machine.axes.size()))
      continue;
    for (std::size_t i = 0; i < machine.axes.size(); ++i) {
      const std::string& axis = machine.axes[i].name;
      frame.set(axis, sin::FramePart::Translation, offset.origin[i] - frame.get(axis, sin::FramePart::Fine));
    }
    frame.geometry[2].rotation = offset.rotation;
    store.loadFrame(frameKey(offset.number), frame);
    notes.push_back(takenOver(fmt::format("$P_UIFR[{}]", offset.number), offset, machine));
  }
  for (const OwnTool& tool : own.tools) {
    if (!isShared(store, tool.number)) continue;
    const OwnTool known = toolOf(store, tool);
    const auto take = [&](double value, double before, double aside, int parameter, const char* what) {
      if (value == 0 || !differ(value, before)) return;
      store.load(edge(parameter, tool.number), value - aside);
      notes.push_back(
          fmt::format("the {} of tool {} is that of the machine's tool table: {:.4f}", what, tool.number, value));
    };
    take(tool.length, known.length, lengthAside(store, tool.number), 3, "length");
    take(tool.diameter / 2, known.diameter / 2, store.number(edge(15, tool.number), 0), 6, "radius");
  }
  return notes;
}

OwnTables differing(const sin::DataStore& store, const OwnTables& own, const machine::MachineDescription& machine) {
  OwnTables changed;
  for (const OwnOffset& offset : own.offsets) {
    const sin::Frame frame = store.frame(frameKey(offset.number));
    if (!isSet(store, offset.number) || isOwn(frame)) continue;
    const OwnOffset now = offsetOf(frame, offset, machine);
    if (!same(now, offset, machine.axes.size())) changed.offsets.push_back(now);
  }
  for (const OwnTool& tool : own.tools) {
    if (!isShared(store, tool.number)) continue;
    const OwnTool now = toolOf(store, tool);
    if (differ(now.length, tool.length) || differ(now.diameter, tool.diameter)) changed.tools.push_back(now);
  }
  return changed;
}

}  // namespace probewright::session::sinumerik
