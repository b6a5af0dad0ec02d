#include "simulation/setup_tools.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "simulation/setup_solids.hpp"

namespace probewright::simulation {
namespace {

constexpr NumberRange anyNumber = NumberRange::within(1e6);
constexpr NumberRange positive = anyLength;
constexpr NumberRange notNegative = anyLengthOrNone;
constexpr NumberRange anyFeed{0.01, 1e6};
/// What the columns of tool tables hold, mm.
constexpr double longestTool = 9999;
constexpr NumberRange toolLength{0, longestTool, true};
constexpr NumberRange toolRadius{0, longestTool};
constexpr NumberRange believedLength{-longestTool, longestTool};

void readProbe(TomlReader& reader, TrueTool& tool, BelievedTool& believed) {
  TrueProbe& probe = tool.probe;
  const auto get = [&](const char* key, double otherwise, NumberRange range = anyNumber) {
    return reader.number(key, range).value_or(otherwise);
  };
  probe.ballRadius = reader.requiredNumber("ball_radius", positive).value_or(probe.ballRadius);
  probe.stylusRadius = get("stylus_radius", 0.6 * probe.ballRadius, notNegative);
  probe.stylusLength = get("stylus_length", std::min(50.0, 0.5 * tool.length), positive);
  probe.bodyRadius = get("body_radius", 30, notNegative);
  probe.bodyLength = get("body_length", std::max(tool.length - probe.stylusLength, 2 * probe.bodyRadius), positive);
  probe.tipOffset = readVector2(reader, "tip_offset").value_or(Vector2::Zero());
  probe.pretravel = get("pretravel", 0, {-1, 1});
  probe.lobing = get("lobing", 0, {-1, 1});
  probe.lobingPhase = get("lobing_phase", 0);
  probe.axialPretravel = get("axial_pretravel", 0, {-1, 1});
  probe.repeatability = get("repeatability", 0, {0, 1});
  probe.signalDelay = get("signal_delay", 0, {0, 1});
  probe.switchedOn = reader.boolean("switched_on").value_or(true);
  probe.serial = reader.text("serial").value_or("");
  if (probe.stylusRadius >= probe.ballRadius) {
    reader.report("stylus_radius", "the stylus must be thinner than its ball");
  }
  probe.starArm = believed.starArm = get("star_arm", 0, notNegative);
  if (probe.starArm > 0 && probe.starArm < 1.5 * probe.ballRadius) {
    reader.report("star_arm", "the balls of the star overlap",
                  "Make star_arm, from the middle of the star to the centre of each ball, at least 1.5 ball_radius");
  }
  if (tool.length <= 2 * probe.ballRadius) {
    reader.report("length", "the probe is shorter than its ball");
  } else if (probe.stylusLength >= tool.length) {
    reader.report("stylus_length", "the stylus must be shorter than the whole probe",
                  "length is that from the spindle nose to the tip, stylus_length that of the stylus alone");
  }

  believed.probeNumber = static_cast<int>(reader.integer("probe_number", 0, 99).value_or(1));
  believed.feed = get("probing_feed", believed.feed, anyFeed);
  believed.rapid = get("probing_rapid", believed.rapid, anyFeed);
  believed.maximumTravel = get("maximum_travel", believed.maximumTravel, positive);
  believed.setUpClearance = get("set_up_clearance", believed.setUpClearance, notNegative);
  believed.calibrationAngle = get("calibration_angle", 0, {-360, 360});
  believed.orient = reader.boolean("orient").value_or(false);
  const double delayed = probe.signalDelay * believed.feed / 60;
  believed.length = get("believed_length", tool.length - probe.axialPretravel - delayed, believedLength);
  believed.radius = get("believed_radius", probe.starArm + probe.ballRadius - probe.pretravel - delayed, toolRadius);
  believed.axialRadius = believed.radius - probe.starArm + probe.pretravel - probe.axialPretravel;
  const std::optional<Vector2> offset = readVector2(reader, "believed_tip_offset");
  believed.tipOffset = offset.value_or(probe.tipOffset);
  believed.trueTipOffset = !offset;
}

}  // namespace

void readTools(TomlReader& root, Setup& setup) {
  static const std::vector<std::string> kinds = {"probe", "mill", "drill", "turn"};
  for (TomlReader& reader : root.tables("tool")) {
    TrueTool tool;
    BelievedTool believed;
    reader.require("number");
    tool.number = believed.number = static_cast<int>(reader.integer("number", 1, 32767).value_or(1));
    tool.name = believed.name = reader.text("name").value_or("");
    reader.require("kind");
    const std::size_t kind = reader.choice("kind", kinds).value_or(0);
    tool.kind = kind == 0 ? ToolKind::Probe : ToolKind::Cutter;
    believed.kind = kinds[kind];
    tool.length = reader.requiredNumber("length", toolLength).value_or(100);
    if (auto direction = readVector(reader, "shank_direction")) {
      if (direction->norm() < 1e-9) {
        reader.report("shank_direction", "a direction cannot be [0, 0, 0]");
      } else {
        tool.shankDirection = direction->normalized();
      }
    }
    tool.mount = readVector(reader, "mount").value_or(Vector3::Zero());
    believed.mount = tool.mount;
    believed.shankDirection = tool.shankDirection;
    believed.inSpindle = reader.boolean("in_spindle").value_or(false);
    if (tool.kind == ToolKind::Probe) {
      readProbe(reader, tool, believed);
    } else {
      tool.radius = reader.requiredNumber("radius", toolRadius).value_or(5);
      believed.length = reader.number("believed_length", believedLength).value_or(tool.length);
      believed.radius = reader.number("believed_radius", toolRadius).value_or(tool.radius);
    }
    for (const BelievedTool& other : setup.tools) {
      if (other.number == tool.number) {
        reader.report("number", fmt::format("there are two tools with number {}", tool.number));
      } else if (!tool.name.empty() && other.name == tool.name) {
        reader.report("name", fmt::format("there are two tools called \"{}\"", tool.name));
      }
      if (other.inSpindle && believed.inSpindle) reader.report("in_spindle", "two tools are in the spindle");
    }
    reader.finish();
    setup.truth.tools.push_back(std::move(tool));
    setup.tools.push_back(std::move(believed));
  }
}

}  // namespace probewright::simulation
