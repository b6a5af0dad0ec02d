#include "session/beliefs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "base/file.hpp"
#include "control/heidenhain/axis_shift_table.hpp"
#include "control/heidenhain/datum_table.hpp"
#include "control/heidenhain/deflection_table.hpp"
#include "control/heidenhain/preset_table.hpp"
#include "control/heidenhain/probe_table.hpp"
#include "control/heidenhain/tool_table.hpp"
#include "control/heidenhain/turning_tool_table.hpp"
#include "control/sinumerik/measuring_data.hpp"
#include "execution/sinumerik/global_data.hpp"
#include "session/lathe_beliefs.hpp"

namespace probewright::session {

namespace hh = control::heidenhain;
namespace sin = control::sinumerik;
namespace fs = std::filesystem;
using control::ControlKind;
using simulation::BelievedFrame;
using simulation::BelievedTool;
using simulation::Setup;

namespace {

std::string upper(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

/// The files of the setup's table folder, in alphabetical order. What has the name of a table and is none is a mistake.
std::vector<fs::path> tableFiles(const Setup& setup, Diagnostics& diagnostics) {
  std::vector<fs::path> files;
  if (setup.tables.empty()) return files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(setup.tables, error)) {
    static constexpr std::array<std::string_view, 12> endings = {".T",    ".TP",  ".PR",  ".TRN", ".TAB", ".D",
                                                                 ".3DTC", ".INI", ".TOA", ".UFR", ".GUD", ".DEF"};
    const fs::path& path = entry.path();
    if (entry.is_regular_file(error)) {
      files.push_back(path);
    } else if (std::ranges::find(endings, upper(path.extension().string())) != endings.end()) {
      const char* what = fs::is_directory(path, error) ? "a folder"
                         : fs::exists(path, error)     ? "not a file"
                                                       : "a symbolic link that leads nowhere";
      diagnostics.push_back({Severity::Error,
                             {path.string(), 0, 0},
                             fmt::format("this has the name of a table, but it is {}", what),
                             {},
                             "put the table there, or rename it",
                             {}});
    }
  }
  std::ranges::sort(files);
  return files;
}

std::optional<std::string> contents(const fs::path& path, Diagnostics& diagnostics) {
  Result<std::string> text = readFile(path);
  if (!text) {
    diagnostics.push_back(text.error());
    return std::nullopt;
  }
  return std::move(*text);
}

/// The table from the file called `name`, or `otherwise`.
hh::TypedTable tableNamed(const std::string& name, const std::vector<fs::path>& files,
                          std::span<const hh::ColumnSpec> columns, hh::TypedTable otherwise, Diagnostics& diagnostics) {
  const auto found =
      std::ranges::find_if(files, [&](const fs::path& path) { return upper(path.filename().string()) == name; });
  if (found == files.end()) return otherwise;
  const auto text = contents(*found, diagnostics);
  if (!text) return otherwise;
  Result<hh::TypedTable> table = hh::TypedTable::parse(*text, found->string(), columns, diagnostics);
  if (!table) {
    diagnostics.push_back(table.error());
    return otherwise;
  }
  return std::move(*table);
}

/// Enters values into a table that is being made; what the table refuses becomes a diagnostic.
class Entry {
public:
  Entry(hh::TypedTable& table, std::string row, const Setup& setup, Diagnostics& diagnostics)
      : table_(table), row_(std::move(row)), setup_(setup), diagnostics_(diagnostics) {
    keep(table_.ensureRow(row_));
  }
  void number(hh::NumberColumn column, double value) {
    if (table_.hasColumn(column)) keep(table_.setNumber(row_, column, value));
  }
  void text(hh::Column column, std::string_view value) {
    if (table_.hasColumn(column)) keep(table_.setText(row_, column, value));
  }

private:
  void keep(const Result<void>& done) {
    if (done) return;
    Diagnostic mistake = done.error();
    if (mistake.place.file.empty()) mistake.place.file = setup_.file;
    diagnostics_.push_back(std::move(mistake));
  }
  hh::TypedTable& table_;
  std::string row_;
  const Setup& setup_;
  Diagnostics& diagnostics_;
};

/// CAL_OF1, CAL_OF2: where the ball stands with the spindle at CAL_ANG. A setup that says nothing has it right.
Vector2 centreOffset(const BelievedTool& tool) {
  if (!tool.trueTipOffset) return tool.tipOffset;
  return Eigen::Rotation2Dd(radiansFromDegrees(tool.calibrationAngle)) * tool.tipOffset;
}

/// `probeRow`: the row of the touch probe table is to be made too.
void enterTool(hh::Tables& tables, const BelievedTool& tool, bool probeRow, const Setup& setup,
               Diagnostics& diagnostics) {
  const std::string row = std::to_string(tool.number);
  if (!tables.tools.hasRow(row)) {
    Entry entry(tables.tools, row, setup, diagnostics);
    entry.text("NAME", tool.name);
    entry.number("L", tool.length);
    entry.number("R", tool.radius);
    if (tool.kind == "probe") {
      entry.text("TYP", "TCHP");
      entry.number("TP_NO", tool.probeNumber);
      entry.number("CAL-OF1", centreOffset(tool).x());
      entry.number("CAL-OF2", centreOffset(tool).y());
      entry.number("CAL-ANG", tool.calibrationAngle);
    }
    if (tool.kind == "turn") entry.text("TYP", "TURN");
  }
  if (tool.kind == "turn" && tables.turningTools && !tables.turningTools->hasRow(row)) {
    Entry entry(*tables.turningTools, row, setup, diagnostics);
    entry.text("NAME", tool.name);
    entry.number("ZL", tool.length);
    entry.number("RS", tool.radius);
  }
  const std::string probe = std::to_string(tool.probeNumber);
  if (tool.kind == "probe" && probeRow) {
    Entry entry(tables.probes, probe, setup, diagnostics);
    entry.number("CAL_OF1", centreOffset(tool).x());
    entry.number("CAL_OF2", centreOffset(tool).y());
    entry.number("CAL_ANG", tool.calibrationAngle);
    entry.number("F", tool.feed);
    entry.number("FMAX", tool.rapid);
    entry.number("DIST", tool.maximumTravel);
    entry.number("SET_UP", tool.setUpClearance);
    entry.text("TRACK", tool.orient ? "ON" : "OFF");
  }
}

}  // namespace

hh::Tables heidenhainTables(const Setup& setup, ControlKind kind, Diagnostics& diagnostics) {
  const std::vector<fs::path> files = tableFiles(setup, diagnostics);
  // Row 0 is what the control begins with. A setup that names rows has no others.
  const std::size_t presetRows = setup.presets.empty() ? 2 : 1;
  hh::Tables tables{tableNamed("TOOL.T", files, hh::toolColumns(), hh::defaultToolTable(kind), diagnostics),
                    tableNamed("TCHPROBE.TP", files, hh::probeColumns(), hh::defaultProbeTable(kind), diagnostics),
                    tableNamed("PRESET.PR", files, hh::presetColumns(),
                               hh::defaultPresetTable(kind, hh::TableUnit::Millimetre, presetRows), diagnostics),
                    {},
                    {},
                    {},
                    {}};
  if (kind == ControlKind::TNC640) {
    tables.turningTools =
        tableNamed("TOOLTURN.TRN", files, hh::turningToolColumns(), hh::defaultTurningToolTable(), diagnostics);
  } else {
    tables.axisShifts =
        tableNamed("AXSHIFT.TAB", files, hh::axisShiftColumns(), hh::defaultAxisShiftTable(), diagnostics);
  }
  for (const fs::path& path : files) {
    const bool datums = upper(path.extension().string()) == ".D";
    if (!datums && upper(path.extension().string()) != ".3DTC") continue;
    if (const auto text = contents(path, diagnostics)) {
      Result<hh::TypedTable> table = hh::TypedTable::parse(
          *text, path.string(), datums ? hh::datumColumns() : hh::deflectionColumns(), diagnostics);
      if (table) {
        (datums ? tables.datums : tables.deflections).emplace(upper(path.filename().string()), std::move(*table));
      } else {
        diagnostics.push_back(table.error());
      }
    }
  }
  const auto isThere = [&](const char* name) {
    return std::ranges::any_of(files, [&](const fs::path& path) { return upper(path.filename().string()) == name; });
  };
  const bool hasProbeTable = isThere("TCHPROBE.TP"), hasPresetTable = isThere("PRESET.PR");
  for (const BelievedTool& tool : setup.tools) {
    const bool probeRow = !hasProbeTable || !tables.probes.hasRow(std::to_string(tool.probeNumber));
    enterTool(tables, tool, probeRow, setup, diagnostics);
  }
  for (const BelievedFrame& preset : setup.presets) {
    // What a file says goes before the setup: a run that sets presets hands them to the next one so.
    if (hasPresetTable && tables.presets.hasRow(std::to_string(preset.index))) continue;
    Entry entry(tables.presets, std::to_string(preset.index), setup, diagnostics);
    static constexpr std::array<hh::NumberColumn, 3> names = {"X", "Y", "Z"};
    static constexpr std::array<hh::NumberColumn, 3> angles = {"SPA", "SPB", "SPC"};
    for (std::size_t i = 0; i < 3; ++i) {
      entry.number(names[i], preset.origin[static_cast<Eigen::Index>(i)]);
      entry.number(angles[i], preset.rotation[static_cast<Eigen::Index>(i)]);
    }
    entry.number("ROT", preset.rotation.z());
    if (!tables.presets.hasColumn("SPA") && !preset.rotation.head<2>().isZero(0)) {
      diagnostics.push_back({Severity::Error,
                             {setup.file, 0, 0},
                             fmt::format("preset {}: the {} keeps one angle of a basic rotation (ROT), that about the "
                                         "touch probe axis",
                                         preset.index, control::name(kind)),
                             {},
                             "write rotation = [0, 0, ANGLE], or choose the TNC 640",
                             {}});
    }
    for (const auto& [axis, angle] : preset.rotary) {
      const std::string offset = axis + "_OFFS";
      const bool hasOffset = tables.presets.hasColumn(hh::Column::named(offset));
      entry.number(hh::NumberColumn::named(hasOffset ? offset : axis), angle);
    }
  }
  return tables;
}

int activePresetRow(const Setup& setup) {
  const auto active = std::ranges::find(setup.presets, true, &BelievedFrame::active);
  return active == setup.presets.end() ? 0 : active->index;
}

hh::MachineParameters machineParameters(const Setup& setup, ControlKind kind, Diagnostics& diagnostics) {
  hh::MachineParameters parameters;
  // On the iTNC 530 the probing values are in machine parameters, not in a table: the probe in use sets them.
  for (const BelievedTool& tool : setup.tools) {
    if (tool.kind != "probe") continue;
    parameters.mp6120 = tool.feed;
    parameters.mp6130 = tool.maximumTravel;
    parameters.mp6140 = tool.setUpClearance;
    parameters.mp6150 = tool.rapid;
    parameters.mp6165 = tool.orient;
    parameters.calibratedLength = tool.length;
    parameters.calibratedRadius = tool.radius;
    parameters.calibratedOffset1 = centreOffset(tool).x();
    parameters.calibratedOffset2 = centreOffset(tool).y();
    parameters.calibratedAngle = tool.calibrationAngle;
    break;
  }
  // The control knows its tool touch probe as it was fitted, unless the setup says otherwise.
  for (const simulation::SetupSolid& solid : setup.solids) {
    if (solid.role != simulation::SolidRole::ToolProbe) continue;
    const Vector3 place =
        (machine::baseFromTable(setup.truth.machine, setup.truth.start) * solid.tableFromSolid) * Vector3::Zero();
    parameters.mp6580x = place.x();
    parameters.mp6580y = place.y();
    parameters.mp6580z = place.z();
    if (!solid.source.recipe.features.empty()) {
      const simulation::SolidFeature& plate = solid.source.recipe.features.front();
      parameters.mp6531 = plate.diameter > 0 ? plate.diameter : plate.size.x();
    }
  }
  for (const auto& [name, parameter] : setup.parameters) {
    const double* number = std::get_if<double>(&parameter.value);
    if (number == nullptr) {
      diagnostics.push_back({Severity::Error, parameter.place, fmt::format("{} takes a number", name), {}, {}, {}});
      continue;
    }
    if (const Result<void> set = hh::setMachineParameter(parameters, kind, name, *number); !set) {
      Diagnostic mistake = set.error();
      mistake.place = parameter.place;
      diagnostics.push_back(std::move(mistake));
    }
  }
  return parameters;
}

namespace {

/// True if the ball of a probe is believed at the end of an arm: further off the spindle axis than twice ball and shaft
/// together, as where the true stylus is made.
bool isBent(const Setup& setup, const BelievedTool& tool) {
  const auto truth = std::ranges::find(setup.truth.tools, tool.number, &simulation::TrueTool::number);
  if (tool.kind != "probe" || truth == setup.truth.tools.end()) return false;
  return tool.tipOffset.norm() > 2 * (truth->probe.ballRadius + truth->probe.stylusRadius);
}

}  // namespace

SinumerikData sinumerikData(const Setup& setup, Diagnostics& diagnostics, const sinumerik::GlobalUserData* globalData) {
  sin::InitText::ArraySizes sizes;
  if (globalData != nullptr) sizes = [globalData](std::string_view name) { return globalData->sizesOf(name); };
  SinumerikData data;
  sin::DataStore& store = data.store;
  sin::setMeasuringDefaults(store);
  const bool lathe = isLathe(setup.truth.machine);
  if (lathe) {
    store.load(sin::DataKey("$SC_TOOL_LENGTH_TYPE", {}), 2.0);
    // A lathe begins with G18 and DIAMON.
    store.load(sin::DataKey("$MC_GCODE_RESET_VALUES", {5}), 2.0);
    store.load(sin::DataKey("$MC_GCODE_RESET_VALUES", {28}), 2.0);
  }
  for (const BelievedTool& tool : setup.tools) {
    const int t = tool.number;
    if (lathe) {
      store.load(sin::DataKey("$TC_TP2", {t}), tool.name);
      enterLatheTool(store, tool);
      continue;
    }
    const bool probe = tool.kind == "probe";
    const bool turning = tool.kind == "turn";
    const auto dp = [&](int parameter, double value) {
      store.load(sin::DataKey(fmt::format("$TC_DP{}", parameter), {t, 1}), value);
    };
    store.load(sin::DataKey("$TC_TP2", {t}), tool.name);
    const bool star = tool.starArm > 0, bent = !star && isBent(setup, tool);
    dp(1, star ? 714 : bent ? 713 : probe ? 710 : turning ? 500 : tool.kind == "drill" ? 200 : 120);
    // The length of stars and Ls ends at the equator of their balls.
    dp(3, star || bent ? tool.length - tool.axialRadius : tool.length);
    dp(6, bent ? tool.tipOffset.norm() : tool.radius);
    if (star || bent) dp(7, tool.axialRadius);
    if (!probe) continue;
    const int n = tool.probeNumber - 1;
    const auto calibration = [&](const char* name, double value) { store.load(sin::DataKey(name, {n}), value); };
    calibration("$SNS_MEA_WP_BALL_DIAM", 2 * tool.radius);
    calibration("$SNS_MEA_WP_FEED", tool.feed);
    if (bent) {
      // The cycles turn its arm to +X. It measures there, and up and down.
      const double angle = degreesFromRadians(std::atan2(tool.tipOffset.y(), tool.tipOffset.x()));
      dp(10, angle > 0 ? 360 - angle : -angle);
      calibration("$SNS_MEA_WP_TRIG_PLUS_DIR_AX1", tool.tipOffset.norm() + tool.radius);
      calibration("$SNS_MEA_WP_TRIG_MINUS_DIR_AX3", -tool.axialRadius);
      calibration("$SNS_MEA_WP_TRIG_PLUS_DIR_AX3", tool.axialRadius);
      continue;
    }
    calibration("$SNS_MEA_WP_TRIG_MINUS_DIR_AX1", -tool.radius + tool.tipOffset.x());
    calibration("$SNS_MEA_WP_TRIG_PLUS_DIR_AX1", tool.radius + tool.tipOffset.x());
    calibration("$SNS_MEA_WP_TRIG_MINUS_DIR_AX2", -tool.radius + tool.tipOffset.y());
    calibration("$SNS_MEA_WP_TRIG_PLUS_DIR_AX2", tool.radius + tool.tipOffset.y());
    // The tool length ends at the lowest point of the ball: nothing is left to add in the infeed axis.
    calibration("$SNS_MEA_WP_TRIG_MINUS_DIR_AX3", 0);
    calibration("$SNS_MEA_WP_POS_DEV_AX1", tool.tipOffset.x());
    calibration("$SNS_MEA_WP_POS_DEV_AX2", tool.tipOffset.y());
  }
  for (const BelievedFrame& offset : setup.zeroOffsets) {
    sin::Frame frame;
    for (std::size_t i = 0; i < 3; ++i) {
      frame.geometry[i].coarse = offset.origin[static_cast<Eigen::Index>(i)];
      frame.geometry[i].rotation = offset.rotation[static_cast<Eigen::Index>(i)];
    }
    for (const auto& [axis, angle] : offset.rotary)
      frame.set(axis, sin::FramePart::Translation, angle);
    store.loadFrame(sin::DataKey("$P_UIFR", {offset.index}), frame);
  }
  for (const auto& [name, parameter] : setup.parameters) {
    if (!name.starts_with('$')) {
      diagnostics.push_back({Severity::Error,
                             parameter.place,
                             fmt::format("{} is not a machine or setting datum of the 840Dsl", name),
                             {},
                             "their names begin with $ (docs/measuring-data.md)",
                             {}});
      continue;
    }
    sin::InitText::parse(fmt::format("{}={}\n", name,
                                     std::holds_alternative<double>(parameter.value)
                                         ? fmt::format("{}", std::get<double>(parameter.value))
                                         : "\"" + std::get<std::string>(parameter.value) + "\""),
                         setup.file, store, diagnostics);
  }
  for (const fs::path& path : tableFiles(setup, diagnostics)) {
    const std::string ending = upper(path.extension().string());
    static constexpr std::array<std::string_view, 6> endings = {".INI", ".TOA", ".UFR", ".GUD", ".SEA", ".MD"};
    if (std::ranges::find(endings, ending) == endings.end()) continue;
    if (const auto text = contents(path, diagnostics)) {
      data.files.push_back(
          {path.filename().string(), sin::InitText::parse(*text, path.string(), store, diagnostics, 1, sizes)});
    }
  }
  return data;
}

int activeZeroOffset(const Setup& setup) {
  const auto active = std::ranges::find(setup.zeroOffsets, true, &BelievedFrame::active);
  return active == setup.zeroOffsets.end() ? 0 : active->index;
}

std::set<std::string> namesOfData(const simulation::Setup& setup, ControlKind kind) {
  std::set<std::string> names;
  if (control::isHeidenhain(kind)) return names;
  Diagnostics ignored;  // the run names them
  for (const control::sinumerik::DataKey& key : sinumerikData(setup, ignored).store.keys())
    names.insert(key.name);
  return names;
}

}  // namespace probewright::session
