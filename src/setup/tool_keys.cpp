#include "setup/tool_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "setup/calibrated_beliefs.hpp"
#include "setup/shape_keys.hpp"

namespace probewright::setup {

using control::BelievedTool;
using simulation::ToolKind;
using simulation::TrueCutter;
using simulation::TrueInsert;
using simulation::TrueProbe;
using simulation::TrueTool;
using simulation::TrueTooth;

namespace {

constexpr NumberRange anyNumber = NumberRange::within(1e6);
constexpr NumberRange positive = anyLength;
constexpr NumberRange notNegative = anyLengthOrNone;
constexpr NumberRange anyFeed{0.01, 1e6};
/// What the columns of tool tables hold, mm.
constexpr double longestTool = 9999;
constexpr NumberRange toolLength{.minimum = 0, .maximum = longestTool, .exclusiveMinimum = true};
constexpr NumberRange toolRadius{0, longestTool};
constexpr NumberRange believedLength{-longestTool, longestTool};

void readTrueProbe(TomlReader& reader, TrueTool& tool) {
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
  probe.starArm = get("star_arm", 0, notNegative);
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
}

/// The keys of a probe's belief; `believed` has what the setup does not say.
void readBelievedProbe(TomlReader& reader, const TrueTool& tool, BelievedTool& believed) {
  const auto get = [&](const char* key, double otherwise, NumberRange range) {
    return reader.number(key, range).value_or(otherwise);
  };
  believed.probeNumber = static_cast<int>(reader.integer("probe_number", 0, 99).value_or(1));
  believed.feed = get("probing_feed", believed.feed, anyFeed);
  believed.rapid = get("probing_rapid", believed.rapid, anyFeed);
  believed.maximumTravel = get("maximum_travel", believed.maximumTravel, positive);
  believed.setUpClearance = get("set_up_clearance", believed.setUpClearance, notNegative);
  believed.calibrationAngle = get("calibration_angle", 0, {-360, 360});
  believed.orient = reader.boolean("orient").value_or(false);
  believeAsCalibrated(believed, tool);
  believed.length = get("believed_length", believed.length, believedLength);
  believed.radius = get("believed_radius", believed.radius, toolRadius);
  if (const std::optional<Vector2> offset = readVector2(reader, "believed_tip_offset")) {
    believed.tipOffset = *offset;
    believed.tipOffsetAngle.reset();
  }
  believeShape(believed, tool.probe);
}

/// [[tool.cutter.tooth]]: the teeth that differ from the drawing.
void readTeeth(TomlReader& reader, TrueTool& tool) {
  TrueCutter& cutter = tool.cutter;
  constexpr int mostTeeth = 99;
  const int count = static_cast<int>(reader.integer("teeth", 0, mostTeeth).value_or(0));
  const double first = reader.number("first_tooth", {-360, 360}).value_or(0);
  cutter.teeth.resize(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
    cutter.teeth[static_cast<std::size_t>(i)].angle = first + 360.0 * i / count;
  std::vector<bool> seen(cutter.teeth.size());
  for (TomlReader& entry : reader.tables("tooth")) {
    entry.require("number");
    const int number = static_cast<int>(entry.integer("number", 1, mostTeeth).value_or(1));
    TrueTooth other;
    const bool known = number <= count;
    if (!known) {
      entry.report("number", fmt::format("there is no tooth {}; \"teeth\" says {}", number, count),
                   "Write how many teeth the tool has under [tool.cutter]");
    } else if (seen[static_cast<std::size_t>(number) - 1]) {
      entry.report("number", fmt::format("tooth {} appears here twice", number));
    }
    if (known) seen[static_cast<std::size_t>(number) - 1] = true;
    TrueTooth& tooth = known ? cutter.teeth[static_cast<std::size_t>(number) - 1] : other;
    tooth.angle = entry.number("angle", {-360, 360}).value_or(tooth.angle);
    tooth.radial = entry.number("radial", {-10, 10}).value_or(0);
    tooth.axial = entry.number("axial", {-10, 10}).value_or(0);
    tooth.radialWear = entry.number("radial_wear", {0, 10}).value_or(0);
    tooth.axialWear = entry.number("axial_wear", {0, 10}).value_or(0);
    tooth.broken = entry.number("broken", anyLengthOrNone).value_or(0);
    if (tool.radius + tooth.radial - tooth.radialWear < cutter.cornerRadius)
      entry.report("radial", "the run-out and the wear of this tooth leave less than the corner radius of the tool");
    entry.finish();
  }
}

/// [tool.cutter.insert] of a turning tool.
void readInsert(TomlReader& reader, TrueCutter& cutter) {
  TrueInsert insert;
  insert.noseRadius = reader.requiredNumber("nose_radius", anyLengthOrNone).value_or(insert.noseRadius);
  insert.wear = reader.number("wear", {0, 10}).value_or(0);
  insert.edgeLength = reader.number("edge_length", anyLength).value_or(insert.edgeLength);
  insert.orientation = reader.number("orientation", anyAngle).value_or(0);
  insert.thickness = reader.number("thickness", {-100, 100}).value_or(0);
  insert.clearance = reader.number("clearance", {0, 45}).value_or(insert.clearance);
  if (reader.has("clearance") && insert.thickness == 0)
    reader.report("clearance", "only an insert that has a thickness has a flank with a clearance",
                  "Write the thickness of the insert, too");
  const auto normals = reader.numbers("edge_normals", 2, anyAngle);
  if (normals) {
    insert.firstNormal = (*normals)[0];
    insert.secondNormal = (*normals)[1];
    const double between = std::abs(std::remainder(insert.secondNormal - insert.firstNormal, 360));
    if (between < 1 || between > 180 - 1e-6)
      reader.report("edge_normals", "the normals of the two edges are at least 1 and less than 180 degrees apart");
  }
  if (insert.wear > 0 && insert.wear >= insert.noseRadius)
    reader.report("wear", "the wear leaves nothing of the nose radius");
  reader.finish();
  cutter.insert = insert;
}

/// [tool.cutter]: what of the tool cuts.
void readCutter(TomlReader& reader, TrueTool& tool, bool turning) {
  TrueCutter& cutter = tool.cutter;
  const auto get = [&](const char* key, NumberRange range) { return reader.number(key, range).value_or(0); };
  cutter.cornerRadius = get("corner_radius", notNegative);
  if (cutter.cornerRadius > tool.radius)
    reader.report("corner_radius", "the corner radius is larger than the radius of the tool",
                  "The radius of the tool makes a ball");
  cutter.pointAngle = reader.number("point_angle", {1, 180}).value_or(180);
  if (cutter.pointAngle < 180 && cutter.cornerRadius > 0)
    reader.report("point_angle", "a tool has either a point angle or a corner radius");
  cutter.helix = get("helix", {-85, 85});
  cutter.cutLength = get("cutting_length", notNegative);
  cutter.shankRadius = get("shank_radius", notNegative);
  cutter.holderRadius = get("holder_radius", notNegative);
  cutter.holderLength = get("holder_length", notNegative);
  if (cutter.holderLength >= tool.length) reader.report("holder_length", "the holder is longer than the whole tool");
  if ((cutter.holderLength > 0) != (cutter.holderRadius > 0))
    reader.report("holder_radius", "a holder needs both holder_radius and holder_length");
  cutter.eccentricity = readVector2(reader, "eccentricity", NumberRange::within(1000)).value_or(Vector2::Zero());
  static const std::vector<std::string> directions = {"M3", "M4", "none"};
  const std::size_t direction = reader.choice("cutting_direction", directions).value_or(0);
  cutter.cutting = direction == 0   ? machine::Rotation::Clockwise
                   : direction == 1 ? machine::Rotation::CounterClockwise
                                    : machine::Rotation::None;
  readTeeth(reader, tool);
  if (auto insert = reader.table("insert")) {
    if (!turning) reader.report("insert", "only tools of kind \"turn\" have an insert");
    if (!cutter.teeth.empty()) reader.report("teeth", "a tool with an insert has no teeth");
    readInsert(*insert, cutter);
  }
  reader.finish();
}

}  // namespace

void readTools(TomlReader& root, simulation::World& world, control::Beliefs& beliefs) {
  static const std::vector<std::string> kinds = {"probe", "mill", "drill", "turn", "calibration"};
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
    believed.inSpindle = reader.boolean("in_spindle").value_or(false);
    if (tool.kind == ToolKind::Probe) {
      readTrueProbe(reader, tool);
      readBelievedProbe(reader, tool, believed);
    } else {
      tool.radius = reader.requiredNumber("radius", toolRadius).value_or(5);
      if (auto cutter = reader.table("cutter")) readCutter(*cutter, tool, believed.kind == "turn");
      believeAsCalibrated(believed, tool);
      believed.length = reader.number("believed_length", believedLength).value_or(believed.length);
      believed.radius = reader.number("believed_radius", toolRadius).value_or(believed.radius);
      if (believed.kind == "turn")
        believed.cuttingEdge =
            static_cast<int>(reader.integer("cutting_edge_position", 1, 9).value_or(believed.cuttingEdge));
    }
    for (const BelievedTool& other : beliefs.tools) {
      if (other.number == tool.number) {
        reader.report("number", fmt::format("there are two tools with number {}", tool.number));
      } else if (!tool.name.empty() && other.name == tool.name) {
        reader.report("name", fmt::format("there are two tools called \"{}\"", tool.name));
      }
      if (other.inSpindle && believed.inSpindle) reader.report("in_spindle", "two tools are in the spindle");
    }
    reader.finish();
    if (believed.inSpindle) world.toolInSpindle = tool.number;
    world.truth.tools.push_back(std::move(tool));
    beliefs.tools.push_back(std::move(believed));
  }
}

}  // namespace probewright::setup
