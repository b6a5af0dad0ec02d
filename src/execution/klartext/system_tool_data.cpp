#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/number_text.hpp"
#include "base/truncated.hpp"
#include "control/alarm.hpp"
#include "control/heidenhain/tool_table.hpp"
#include "execution/klartext/system_data.hpp"

/// FN 17 and FN 18, in mm and degrees whatever the unit of the program: tools and touch probes, and what programs may
/// write.
namespace probewright::execution::klartext {

using control::Alarm;
using control::heidenhain::Column;
using control::heidenhain::NumberColumn;

namespace {

constexpr std::string_view axisNames = "XYZABCUVW";

/// Columns of TOOL.T by the number of FN 18 ID 50 and ID 950.
struct ToolColumn {
  int number;
  NumberColumn column;
};
constexpr std::array<ToolColumn, 25> toolColumns = {
    {{1, "L"},        {2, "R"},       {3, "R2"},       {4, "DL"},        {5, "DR"},
     {6, "DR2"},      {9, "TIME1"},   {10, "TIME2"},   {11, "CUR.TIME"}, {13, "LCUTS"},
     {14, "ANGLE"},   {15, "CUT"},    {16, "LTOL"},    {17, "RTOL"},     {19, "R-OFFS"},
     {20, "L-OFFS"},  {21, "LBREAK"}, {22, "RBREAK"},  {24, "CAL-OF1"},  {25, "CAL-OF2"},
     {26, "CAL-ANG"}, {28, "NMAX"},   {32, "T-ANGLE"}, {37, "TP_NO"},    {40, "PITCH"}}};

/// The number of a model of touch probe, as FN 18 ID 350 gives it; 0 for all that have none of their own.
double probeType(std::string_view name) {
  constexpr std::array<std::string_view, 8> models = {"TS120", "TS220", "TS440", "TS630",
                                                      "TS632", "TS640", "TS444", "TS740"};
  const auto found = std::ranges::find(models, name);
  return found == models.end() ? 0 : static_cast<double>(found - models.begin());
}

/// The type of a tool by its number, as far as measuring programs know them. Throws Alarm for any other.
std::string_view toolTypeOf(double number) {
  if (number == 0) return "MILL";
  if (number == 21) return "TCHP";
  throw Alarm(
      "System datum not available",
      fmt::format("FN 17 writes the type of a tool (ID50 NR36) as 0, a mill, or 21, a touch probe, not as {}", number),
      "enter other types in the column TYP of TOOL.T");
}

std::optional<NumberColumn> columnOf(int number) {
  const auto column = std::ranges::find(toolColumns, number, &ToolColumn::number);
  return column == toolColumns.end() ? std::nullopt : std::optional(column->column);
}

/// The column of the touch probe table that holds NR 24, 25 or 26 on the newer control; nothing for any other.
std::optional<NumberColumn> calibrationColumnOf(int number) {
  constexpr std::array<NumberColumn, 3> columns = {"CAL_OF1", "CAL_OF2", "CAL_ANG"};
  return number >= 24 && number <= 26 ? std::optional(columns[static_cast<std::size_t>(number - 24)]) : std::nullopt;
}

}  // namespace

/// The row of TOOL.T that an index names: 5 or, with its step, 5.1.
std::string SystemData::toolRowOf(double index) const {
  return control::heidenhain::toolKey(truncated(std::floor(index)),
                                      static_cast<int>(std::lround((index - std::floor(index)) * 10)));
}

std::string SystemData::missingTool(int id, int number, double index) const {
  if ((id != 50 && id != 950) || !columnOf(number)) return {};
  const std::string row = id == 950 || index <= 0 ? control_.tool.row : toolRowOf(index);
  if (row.empty()) return ": no tool is called";
  return control_.tables.tools.hasRow(row) ? std::string() : fmt::format(": TOOL.T has no row {}", row);
}

std::optional<double> SystemData::toolData(int number, const std::string& row) const {
  const auto& tools = control_.tables.tools;
  if (!tools.hasRow(row)) return row == "0" && columnOf(number) ? std::optional<double>(0) : std::nullopt;
  const auto text = [&](Column column) { return tools.hasColumn(column) ? tools.text(row, column) : ""; };
  switch (number) {
    case 7:
      return text("TL") == "L" ? 1 : 0;
    case 8:
      return parseDecimal(text("RT")).value_or(0);
    case 18:
      return text("DIRECT") == "-" ? -1 : 0;
    case 24:
    case 25:
    case 26: {
      if (!control_.isTNC640()) break;
      const auto& probes = control_.tables.probes;
      const std::string probe = text("TP_NO");
      return probes.hasRow(probe) ? probes.numberOr(probe, *calibrationColumnOf(number), 0) : 0;
    }
    case 34:
      return text("LIFTOFF") == "Y" ? 1 : 0;
    case 36: {
      const std::string probe = text("TP_NO");
      const bool isProbe = !probe.empty() && probe != "0" && probe != "-";
      return isProbe || text("TYP") == "TCHP" ? 21 : 0;
    }
    case 19:
      // An empty cell is the radius, which the control shows as this number.
      if (text("R-OFFS").empty()) return 99999.9999;
      break;
    default:
      break;
  }
  const auto column = columnOf(number);
  if (!column) return std::nullopt;
  return tools.hasColumn(*column) ? tools.numberOr(row, *column, 0) : 0;
}

/// ID 60: what the last TOOL CALL said.
std::optional<double> SystemData::toolCallData(int number) const {
  const control::heidenhain::ActiveTool& tool = control_.tool;
  switch (number) {
    case 1:
      return tool.number;
    case 2:
      return control_.q.q(109);
    case 3:
      return tool.spindleSpeed;
    case 4:
      return tool.deltaLength;
    case 5:
      return tool.deltaRadius;
    case 6:
      return 0;
    case 7:
      return tool.deltaRadius2;
    case 8:
      return tool.index;
    case 9:
      return tool.feed;
    default:
      return std::nullopt;
  }
}

/// ID 200: index 1 without oversizes, 2 with those of the table, 3 also with those of TOOL CALL. NR 6: length of a
/// tool.
std::optional<double> SystemData::toolCompensation(int number, double index) const {
  const control::heidenhain::ActiveTool& tool = control_.tool;
  const auto& tools = control_.tables.tools;
  if (number == 6) return toolData(1, index <= 0 ? tool.row : toolRowOf(index));
  const auto sized = [&](double withTable, NumberColumn delta, double ofCall) {
    if (index < 2) return withTable - (tools.hasRow(tool.row) ? tools.numberOr(tool.row, delta, 0) : 0);
    return index < 3 ? withTable : withTable + ofCall;
  };
  switch (number) {
    case 1:
      return sized(tool.radius, "DR", tool.deltaRadius);
    case 2:
      return sized(tool.length, "DL", tool.deltaLength);
    case 3:
      return sized(tool.radius2, "DR2", tool.deltaRadius2);
    default:
      return std::nullopt;
  }
}

std::optional<double> SystemData::probeData(int number, int index) const {
  const auto& probes = control_.tables.probes;
  const std::string& row = control_.tool.probeRow;
  const bool known = !row.empty() && probes.hasRow(row);
  const auto cell = [&](NumberColumn column) { return known ? probes.numberOr(row, column, 0) : 0; };
  const auto& parameters = control_.parameters;
  const bool inTable = control_.keepsCalibrationInTable();
  const double length = inTable ? control_.tool.length + control_.tool.deltaLength : parameters.calibratedLength;
  const double radius = inTable ? control_.tool.radius : parameters.calibratedRadius;
  // The iTNC 530 keeps its calibration in the tool table, or beside all tables.
  const auto calibrated = [&](std::string name) {
    if (control_.isTNC640()) return cell(NumberColumn::named(name));
    if (!inTable) {
      return name == "CAL_OF1"   ? parameters.calibratedOffset1
             : name == "CAL_OF2" ? parameters.calibratedOffset2
                                 : parameters.calibratedAngle;
    }
    std::ranges::replace(name, '_', '-');
    return control_.tables.tools.numberOr(control_.tool.row, NumberColumn::named(name), 0);
  };
  switch (number) {
    case 10:
      return control_.q.q(109);
    case 11:
      return radius;
    case 12:
      return length;
    case 13:
      return control_.isTNC640() ? std::nullopt : std::optional<double>(control_.calibrationRingRadius);
    case 14:
      return calibrated(index == 2 ? "CAL_OF2" : "CAL_OF1");
    case 15:
      return normalizedDegrees(degreesFromRadians(std::atan2(calibrated("CAL_OF2"), calibrated("CAL_OF1"))) -
                               calibrated("CAL_ANG"));
    case 20:
      if (control_.isTNC640() || index < 1 || index > 3) return std::nullopt;
      return (parameters.contactRadius1 > 0 ? std::array{parameters.contactX, parameters.contactY, parameters.contactZ}
                                            : std::array{parameters.mp6580x, parameters.mp6580y,
                                                         parameters.mp6580z})[static_cast<std::size_t>(index - 1)];
    case 21:
      if (control_.isTNC640()) return std::nullopt;
      return parameters.contactRadius1 > 0 ? parameters.contactRadius1 : parameters.mp6531 / 2;
    case 50:
      if (index == 2) return row.empty() ? -1 : std::stod(row);
      return probeType(known ? probes.text(row, "TYPE") : "");
    case 51:
      return length;
    case 52:
      return index == 2 ? control_.tool.radius2 : radius;
    case 53:
      return calibrated(index == 2 ? "CAL_OF2" : "CAL_OF1");
    case 54:
      return calibrated("CAL_ANG");
    case 55:
      if (index == 3) return known && probes.text(row, "F_PREPOS") == "FMAX_MACHINE" ? 1 : 0;
      return cell(index == 2 ? NumberColumn("F") : NumberColumn("FMAX"));
    case 56:
      return cell(index == 2 ? NumberColumn("SET_UP") : NumberColumn("DIST"));
    case 57:
      return index == 2 ? control_.channel.spindleAngle() : (control_.channel.description().spindleOrients ? 1 : 0);
    default:
      return std::nullopt;
  }
}

void SystemData::write(const Command& command, Evaluation& evaluation) {
  const auto wordOr = [&](std::string_view address, double otherwise) {
    return numberOr(command.words, address, otherwise, evaluation);
  };
  const int id = static_cast<int>(std::lround(wordOr("ID", 0)));
  const int number = static_cast<int>(std::lround(wordOr("NR", 0)));
  const double index = wordOr("IDX", 0);
  const int whole = static_cast<int>(std::lround(index));
  const double value = wordOr("VAL", 0);
  const auto refuse = [&]() {
    throw Alarm("System datum not available",
                fmt::format("FN 17 cannot write ID{} NR{} IDX{} on this control{}", id, number, index,
                            missingTool(id, number, index)),
                "leave the block out for the run");
  };
  switch (id) {
    case 50:
    case 950: {
      const bool rowZero = index == 0 && !control_.isTNC640() && find(command.words, "IDX", evaluation) != nullptr;
      const std::string row = id == 950 || (index <= 0 && !rowZero) ? control_.tool.row : toolRowOf(index);
      const auto column = columnOf(number);
      const bool isType = number == 36;
      if ((!column && !isType) || !control_.tables.tools.hasRow(row)) refuse();
      if (const auto calibration = calibrationColumnOf(number); calibration && control_.isTNC640()) {
        const std::string probe = control_.tables.tools.text(row, "TP_NO");
        if (!control_.tables.probes.hasRow(probe)) refuse();
        control_.writeNumber(control_.tables.probes, probe, *calibration, value);
      } else if (!isType) {
        control_.writeNumber(control_.tables.tools, row, *column, value);
      } else if (control_.tables.tools.hasColumn("TYP")) {
        control_.writeText(control_.tables.tools, row, "TYP", std::string(toolTypeOf(value)));
      } else {
        run_.leaveOut("The type of a tool, for which TOOL.T has no column TYP,");
      }
      if (row == control_.tool.row) {
        tools_.refresh();
      }
      tools_.publishTool();
      break;
    }
    case 500: {
      const auto table = control_.tables.datums.find(control_.activeDatumTable);
      if (table == control_.tables.datums.end() || number < 0 || whole < 1 || whole > 9) refuse();
      control_.writeNumber(table->second, std::to_string(number),
                           NumberColumn::named(axisNames.substr(static_cast<std::size_t>(whole - 1), 1)), value);
      break;
    }
    case 503: {  // as the table shows them: machine coordinates
      if (control_.isTNC640() || number < 0 || whole < 1 || whole > 6) refuse();
      const auto axis =
          control_.channel.description().axisIndex(axisNames.substr(static_cast<std::size_t>(whole - 1), 1));
      control::heidenhain::Control::PresetChange change;
      if (whole <= 3) {
        change.origin[static_cast<std::size_t>(whole - 1)] = value;
      } else if (axis) {
        change.rotaryOffset[*axis] = value;
      } else {
        refuse();
      }
      control_.writePreset(number, change);
      break;
    }
    case 507: {
      if (number < 0) refuse();
      control::heidenhain::Control::PresetChange change;
      if (whole >= 1 && whole <= 3) {
        change.origin[static_cast<std::size_t>(whole - 1)] = value;
      } else if (whole >= 4 && whole <= 6) {
        change.spaceAngles[static_cast<std::size_t>(whole - 4)] = value;
      } else {
        refuse();
      }
      control_.writePreset(number, change);
      break;
    }
    case 508: {
      const auto axis =
          whole >= 4 && whole <= 6
              ? control_.channel.description().axisIndex(axisNames.substr(static_cast<std::size_t>(whole - 1), 1))
              : std::optional<std::size_t>();
      if (!axis || number < 0) refuse();
      control::heidenhain::Control::PresetChange change;
      change.rotaryOffset[*axis] = value;
      control_.writePreset(number, change);
      break;
    }
    case 990:
      // NR 6 chooses the input of the probe, of which there is one here; 0 of NR 1 is the approach that it has anyway.
      if (number != 6 && !(number == 1 && value == 0)) run_.leaveOut(fmt::format("FN 17: SYSWRITE ID990 NR{}", number));
      break;
    default:
      refuse();
  }
}

}  // namespace probewright::execution::klartext
