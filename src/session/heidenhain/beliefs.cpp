#include "session/heidenhain/beliefs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/text.hpp"
#include "control/heidenhain/axis_shift_table.hpp"
#include "control/heidenhain/datum_table.hpp"
#include "control/heidenhain/deflection_table.hpp"
#include "control/heidenhain/preset_table.hpp"
#include "control/heidenhain/probe_table.hpp"
#include "control/heidenhain/tool_table.hpp"
#include "control/heidenhain/turning_tool_table.hpp"
#include "session/table_files.hpp"

namespace probewright::session::heidenhain {

namespace hh = control::heidenhain;
namespace fs = std::filesystem;
using control::Beliefs;
using control::BelievedFrame;
using control::BelievedTool;
using control::ControlKind;

namespace {

/// The table from the file called `name`, or `otherwise`.
hh::TypedTable tableNamed(const std::string& name, const std::vector<fs::path>& files,
                          std::span<const hh::ColumnSpec> columns, hh::TypedTable otherwise, Diagnostics& diagnostics) {
  const auto found =
      std::ranges::find_if(files, [&](const fs::path& path) { return upperCase(path.filename().string()) == name; });
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
  Entry(hh::TypedTable& table, std::string row, const Beliefs& beliefs, Diagnostics& diagnostics)
      : table_(table), row_(std::move(row)), beliefs_(beliefs), diagnostics_(diagnostics) {
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
    if (mistake.place.file.empty()) mistake.place.file = beliefs_.file;
    diagnostics_.push_back(std::move(mistake));
  }
  hh::TypedTable& table_;
  std::string row_;
  const Beliefs& beliefs_;
  Diagnostics& diagnostics_;
};

/// CAL_OF1, CAL_OF2: where the ball stands with the spindle at CAL_ANG.
Vector2 centreOffset(const BelievedTool& tool) {
  if (!tool.tipOffsetAngle) return tool.tipOffset;
  return Eigen::Rotation2Dd(radiansFromDegrees(tool.calibrationAngle - *tool.tipOffsetAngle)) * tool.tipOffset;
}

/// TO of the cutting edge position of a SINUMERIK. TO 1 points to -X and -Z, 8 to -Z, and the numbers go round.
int tipOrientationOf(int cuttingEdge) {
  static constexpr std::array<int, 10> orientations = {9, 5, 7, 1, 3, 4, 6, 8, 2, 9};
  return orientations[static_cast<std::size_t>(std::clamp(cuttingEdge, 0, 9))];
}

/// `probeRow`: the row of the touch probe table is to be made too.
void enterTool(hh::Tables& tables, const BelievedTool& tool, bool probeRow, const Beliefs& beliefs,
               Diagnostics& diagnostics) {
  const std::string row = std::to_string(tool.number);
  if (!tables.tools.hasRow(row)) {
    Entry entry(tables.tools, row, beliefs, diagnostics);
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
    // 0 would stand for a tool that is measured with a standing spindle.
    if (tool.teeth > 0) entry.number("CUT", tool.teeth);
  }
  if (tool.kind == "turn" && tables.turningTools && !tables.turningTools->hasRow(row)) {
    Entry entry(*tables.turningTools, row, beliefs, diagnostics);
    entry.text("NAME", tool.name);
    entry.number("ZL", tool.length);
    entry.number("XL", tool.tipOffset.x());
    entry.number("YL", tool.tipOffset.y());
    entry.number("RS", tool.radius);
    if (tool.cuttingEdge != 0) entry.number("TO", tipOrientationOf(tool.cuttingEdge));
  }
  const std::string probe = std::to_string(tool.probeNumber);
  if (tool.kind == "probe" && probeRow) {
    Entry entry(tables.probes, probe, beliefs, diagnostics);
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

hh::Tables heidenhainTables(const Beliefs& beliefs, ControlKind kind, Diagnostics& diagnostics) {
  const std::vector<fs::path> files = tableFiles(beliefs.tables, diagnostics);
  // Row 0 is what the control begins with. A setup that names rows has no others.
  const std::size_t presetRows = beliefs.presets.empty() ? 2 : 1;
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
    const bool datums = upperCase(path.extension().string()) == ".D";
    if (!datums && upperCase(path.extension().string()) != ".3DTC") continue;
    if (const auto text = contents(path, diagnostics)) {
      Result<hh::TypedTable> table = hh::TypedTable::parse(
          *text, path.string(), datums ? hh::datumColumns() : hh::deflectionColumns(), diagnostics);
      if (table) {
        (datums ? tables.datums : tables.deflections).emplace(upperCase(path.filename().string()), std::move(*table));
      } else {
        diagnostics.push_back(table.error());
      }
    }
  }
  const auto isThere = [&](const char* name) {
    return std::ranges::any_of(files,
                               [&](const fs::path& path) { return upperCase(path.filename().string()) == name; });
  };
  const bool hasProbeTable = isThere("TCHPROBE.TP"), hasPresetTable = isThere("PRESET.PR");
  for (const BelievedTool& tool : beliefs.tools) {
    const bool probeRow = !hasProbeTable || !tables.probes.hasRow(std::to_string(tool.probeNumber));
    enterTool(tables, tool, probeRow, beliefs, diagnostics);
  }
  for (const BelievedFrame& preset : beliefs.presets) {
    // What a file says goes before the setup: a run that sets presets hands them to the next one so.
    if (hasPresetTable && tables.presets.hasRow(std::to_string(preset.index))) continue;
    Entry entry(tables.presets, std::to_string(preset.index), beliefs, diagnostics);
    static constexpr std::array<hh::NumberColumn, 3> names = {"X", "Y", "Z"};
    static constexpr std::array<hh::NumberColumn, 3> angles = {"SPA", "SPB", "SPC"};
    for (std::size_t i = 0; i < 3; ++i) {
      entry.number(names[i], preset.origin[static_cast<Eigen::Index>(i)]);
      entry.number(angles[i], preset.rotation[static_cast<Eigen::Index>(i)]);
    }
    entry.number("ROT", preset.rotation.z());
    if (!tables.presets.hasColumn("SPA") && !preset.rotation.head<2>().isZero(0)) {
      diagnostics.push_back({Severity::Error,
                             {beliefs.file, 0, 0},
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

int activePresetRow(const Beliefs& beliefs) {
  const auto active = std::ranges::find(beliefs.presets, true, &BelievedFrame::active);
  return active == beliefs.presets.end() ? 0 : active->index;
}

hh::MachineParameters machineParameters(const Beliefs& beliefs, ControlKind kind, Diagnostics& diagnostics) {
  hh::MachineParameters parameters;
  // On the iTNC 530 the probing values are in machine parameters, not in a table: the probe in use sets them.
  for (const BelievedTool& tool : beliefs.tools) {
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
  if (!beliefs.toolProbes.empty()) {
    const control::BelievedToolProbe& probe = beliefs.toolProbes.front();
    parameters.mp6580x = parameters.contactX = probe.centre.x();
    parameters.mp6580y = parameters.contactY = probe.centre.y();
    parameters.mp6580z = probe.centre.z();
    parameters.contactZ = probe.centre.z() - probe.pretravel;
    if (probe.width > 0) {
      parameters.mp6531 = std::max(probe.width, probe.widthY);  // no side may be nearer than it is believed
      parameters.contactRadius1 = probe.width / 2 - probe.pretravel;
      parameters.contactRadius2 = probe.widthY / 2 - probe.pretravel;
    }
    parameters.rectangularContact = probe.cuboid;
  }
  for (const auto& [name, parameter] : beliefs.parameters) {
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

}  // namespace probewright::session::heidenhain
