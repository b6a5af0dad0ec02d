#include "control/sinumerik/control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/number_text.hpp"
#include "control/alarm.hpp"
#include "control/sinumerik/length_type.hpp"
#include "control/sinumerik/text.hpp"
#include "control/sinumerik/tool_carrier.hpp"
#include "control/sinumerik/tool_data.hpp"

namespace probewright::control::sinumerik {
namespace {

constexpr double millimetresPerInch = 25.4;

Frame chained(const Frame& outer, const Frame& inner) {
  const Result<Frame> frame = chain(outer, inner);
  if (!frame) throw Alarm("18314", "Frames cannot be chained: " + frame.error().message, frame.error().advice);
  return *frame;
}

/// A value for people: six decimals are a nanometre.
std::string shown(const DataValue& value) {
  const double* number = std::get_if<double>(&value);
  return number == nullptr ? valueText(value) : formatShortest(std::round(*number * 1e6) / 1e6);
}

}  // namespace

Control::Control(machine::Machine& machine, DataStore store, std::optional<machine::MachineDescription> told)
    : panel(journal),
      channel(machine, journal),
      data(std::move(store)),
      told_(std::move(told).value_or(machine.description())) {
  channel.programUnit = &unit;
  channel.alarms = {"10720", "61302", "61302", "22066", "22050", "700000"};
  channel.onToolByHand = [this](const machine::ToolOrder& order, const std::string& detail) {
    panel.stop(askForTool(order, detail), channel.seconds());
  };
  const int planes = initialFunction(6);
  plane = planes >= 1 && planes <= 3 ? 16 + planes : channel.description().axisIndex("Y") ? 17 : 18;
  const int units = initialFunction(13);
  unit = units == 1 || units == 3 ? millimetresPerInch : 1;
  diameter = initialFunction(29) == 2 || initialFunction(29) == 3;
  data.setDefault("$MC_TOOL_CHANGE_MODE", channel.description().axisIndex("Y") ? 1.0 : 0.0);
  channel.setDescription(told_);
  if (!data.isSet(carrierDatum(23, 1))) {
    if (const auto commissioned = carrierOf(told_)) loadCarrier(data, 1, *commissioned);
  }
  applyFrames();
}

void Control::useKinematics() {
  const auto record = transformation ? transformationCarrier(data)
                      : swivelled    ? toolCarrier(data, carrier)
                                     : std::nullopt;
  if (!record) return channel.setDescription(told_);
  const auto described = withCarrier(told_, *record);
  if (!described)
    throw Alarm(
        transformation ? "4342" : "62181",
        fmt::format("{}: {}", transformation ? "The data of TRAORI" : fmt::format("Swivel data set {}", carrier),
                    described.error().message),
        described.error().advice);
  channel.setDescription(*described);
}

int Control::initialFunction(int group) const {
  return static_cast<int>(std::lround(data.number("$MC_GCODE_RESET_VALUES", {group - 1})));
}

int Control::toolNumbered(const std::string& name) const {
  const std::optional<int> number = toolNamed(data, name);
  if (!number) {
    throw Alarm("17190", fmt::format("There is no tool named {}", name),
                "create the tool ($TC_TP2) or correct the name");
  }
  return *number;
}

void Control::loadTool(int number) {
  if (number != 0 && !toolEdge(data, number, 1)) {
    throw Alarm("17190", fmt::format("Illegal T number {}: the tool has no data", number),
                "create the tool ($TC_DP1...) or correct the T number");
  }
  const std::string name = toolName(data, number);
  if (number != tool.number) {
    channel.changeTool({number, name});
    panel.message(EventKind::Tool, fmt::format("Tool T{}{}{}", number, name.empty() ? "" : " ", name),
                  channel.seconds());
  }
  tool = {};
  tool.number = number;
  tool.name = name;
  selectEdge(number == 0 ? 0 : 1);
}

void Control::selectEdge(int edge) {
  if (edge != 0 && !toolEdge(data, tool.number, edge)) {
    throw Alarm("17180", fmt::format("Illegal D number {}: tool {} has no such cutting edge", edge, tool.number),
                "correct the D number");
  }
  tool.edge = edge;
  refreshTool();
}

void Control::selectAdditiveOffset(double number) {
  if (!(number >= 0 && number <= lastOffsetNumber) || number != std::floor(number)) {
    throw Alarm("17182",
                fmt::format("Illegal DL number {}: an edge has the additive offsets 1 to {}", number, lastOffsetNumber),
                "correct the number; DL=0 takes none");
  }
  tool.dl = static_cast<int>(number);
  refreshTool();
  handOverFrames();
}

void Control::refreshTool() {
  edge_ = toolEdge(data, tool.number, tool.edge, tool.dl).value_or(ToolEdge{});
  applyTool();
}

void Control::applyTool() {
  ToolEdge edge = edge_;
  edge.length[0] += tool.programmedLength;
  edge.radius += tool.programmedRadius;
  tool.type = edge.type;
  tool.position = edge.position;
  tool.radius = edge.totalRadius();
  tool.correctionAngle = edge.correctionAngle;
  channel.toolVector = toolVector(planeOfLengths(data, plane), edge, lengthType(*this));
  channel.toolRadius = tool.radius;
}

void Control::activateSettable(int number) {
  const int count = static_cast<int>(machineData("$MC_MM_NUM_USER_FRAMES", 100));
  if (number < 0 || number >= count) {
    throw Alarm("18310", fmt::format("There is no settable zero offset {}", number), "use G54 to G57 or G505 to G599");
  }
  frames.settable = number;
  applyFrames();
}

Eigen::Affine3d Control::machineFromBase() const { return transform(frames.base); }

Eigen::Affine3d Control::machineFromWorkpiece() const {
  if (frames.suppressed) return Eigen::Affine3d::Identity();
  return transform(frames.base) * transform(frames.settableFrame) * transform(frames.toolOriented) *
         transform(frames.programmed);
}

std::vector<DataKey> Control::baseFrameKeys() const {
  std::vector<DataKey> frameKeys;
  for (const char* name : {"$P_NCBFR", "$P_CHBFR"}) {
    for (const DataKey& key : data.keys(name)) {
      if (key.indices.empty()) continue;
      const DataKey frame(name, {key.indices.front()});
      if (frameKeys.empty() || !(frameKeys.back() == frame)) frameKeys.push_back(frame);
    }
  }
  return frameKeys;
}

void Control::applyFrames() {
  frames.basic.assign(1, {DataKey("$P_SETFR", {}), data.frame("$P_SETFR", {})});
  for (const DataKey& key : baseFrameKeys())
    frames.basic.emplace_back(key, data.frame(key));
  frames.settableFrame = data.frame("$P_UIFR", {frames.settable});
  handOverFrames();
}

Frame Control::activeBasicFrame(const DataKey& key) const {
  const auto found = std::ranges::find(frames.basic, key, &std::pair<DataKey, Frame>::first);
  return found == frames.basic.end() ? Frame{} : found->second;
}

void Control::setActiveBasicFrame(const DataKey& key, const Frame& frame) {
  // Outside in: $P_SETFR, $P_NCBFR[0..], $P_CHBFR[0..].
  const auto rank = [](const DataKey& each) { return each.name == "$P_SETFR" ? 0 : each.name == "$P_NCBFR" ? 1 : 2; };
  const auto before = [&](const std::pair<DataKey, Frame>& a, const std::pair<DataKey, Frame>& b) {
    return rank(a.first) != rank(b.first) ? rank(a.first) < rank(b.first) : a.first < b.first;
  };
  std::pair<DataKey, Frame> entry{key, frame};
  const auto place = std::ranges::lower_bound(frames.basic, entry, before);
  if (place != frames.basic.end() && place->first == key) {
    place->second = frame;
  } else {
    frames.basic.insert(place, std::move(entry));
  }
  handOverFrames();
}

void Control::handOverFrames() {
  frames.base = {};
  for (const auto& [key, frame] : frames.basic)
    frames.base = chained(frames.base, frame);
  applyTool();
  const machine::MachineDescription& description = channel.description();
  for (std::size_t i = 0; i < description.axes.size(); ++i) {
    if (description.axes[i].kind != machine::AxisKind::Rotary) continue;
    const std::string axis = upperCase(description.axes[i].name);
    const auto offset = [&axis](const Frame& frame) {
      return frame.get(axis, FramePart::Translation) + frame.get(axis, FramePart::Fine);
    };
    channel.rotaryOffset[i] = frames.suppressed ? 0
                                                : offset(frames.base) + offset(frames.settableFrame) +
                                                      offset(frames.toolOriented) + offset(frames.programmed);
  }
  channel.holdTip = transformation;
  channel.setFollowing(swivelled || transformation ? Following::Kinematics : Following::LinearAxes,
                       channel.rotaryOffset);
  channel.setFrame(machineFromWorkpiece());
}

void Control::write(const DataKey& key, double value) {
  const std::optional<DataValue> before = data.get(key);
  data.set(key, value);
  // What has not changed is not a correction.
  if (before && shown(*before) == shown(value)) return;
  const std::string text = key.text();
  const std::size_t bracket = text.find('[');
  journal.write({text.substr(0, bracket), bracket == std::string::npos ? "" : text.substr(bracket),
                 before ? shown(*before) : "", shown(value)});
}

}  // namespace probewright::control::sinumerik
