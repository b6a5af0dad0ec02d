#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>

#include "control/alarm.hpp"
#include "control/heidenhain/datum_table.hpp"
#include "control/heidenhain/tool_table.hpp"
#include "language/klartext/host.hpp"
#include "machine/rotary_solver.hpp"

/// FN 17, FN 18 and SYSSTR: data of the control by group (ID), number (NR) and index (IDX). Lengths are in the unit of
/// the program. docs/klartext.md lists the groups.
namespace probewright::language::klartext {

using control::Alarm;

namespace {

constexpr std::string_view axisNames = "XYZABCUVW";

/// Columns of TOOL.T by the number of FN 18 ID 50.
struct ToolColumn {
  int number;
  std::string_view column;
  bool length;
};
constexpr std::array<ToolColumn, 20> toolColumns = {
    {{1, "L", true},        {2, "R", true},       {3, "R2", true},      {4, "DL", true},      {5, "DR", true},
     {6, "DR2", true},      {8, "RT", false},     {9, "TIME1", false},  {10, "TIME2", false}, {11, "CUR_TIME", false},
     {13, "LCUTS", true},   {14, "ANGLE", false}, {15, "CUT", false},   {16, "LTOL", true},   {17, "RTOL", true},
     {18, "DIRECT", false}, {19, "R-OFFS", true}, {20, "L-OFFS", true}, {21, "LBREAK", true}, {22, "RBREAK", true}}};

}  // namespace

double KlartextHost::machineSeconds() const {
  return static_cast<double>(control_.wallClockStart) + control_.channel.seconds() - control_.startSeconds;
}

void KlartextHost::systemRead(const Command& command, Evaluation& evaluation) {
  const auto wordOr = [&](std::string_view address, double otherwise) {
    const Word* word = find(command.words, address, evaluation);
    return word == nullptr ? otherwise : evaluation.number(word->value);
  };
  const int id = static_cast<int>(std::lround(wordOr("ID", 0)));
  const int number = static_cast<int>(std::lround(wordOr("NR", 0)));
  const double index = wordOr("IDX", 0);
  std::optional<double> value;
  if (id == 990 && number == 10) {
    const int text = static_cast<int>(std::lround(index));
    const std::string name = control::heidenhain::QParameters::exists(text) ? control_.q.qs(text) : std::string();
    const auto row = control::heidenhain::findToolNamed(control_.tables.tools, name);
    value = row ? std::stod(*row) : -1;
  } else {
    value = systemData(id, number, index);
  }
  if (!value) {
    throw Alarm("System datum not available",
                fmt::format("FN 18 cannot read ID{} NR{} IDX{} on this control", id, number, index),
                "read another datum, or set the parameter to a fixed value");
  }
  const VariableRef& target = evaluation.block().variables[static_cast<std::size_t>(command.variable)];
  write(target, *value, evaluation);
}

std::optional<double> KlartextHost::toolData(int number, const std::string& row) const {
  const auto& tools = control_.tables.tools;
  if (!tools.hasRow(row)) return std::nullopt;
  if (number == 7) return tools.text(row, "TL") == "L" ? 1 : 0;
  for (const ToolColumn& column : toolColumns) {
    if (column.number == number) return tools.numberOr(row, column.column, 0) / (column.length ? control_.unit : 1);
  }
  return std::nullopt;
}

std::optional<double> KlartextHost::probeData(int number, int index) const {
  const auto& probes = control_.tables.probes;
  const std::string& row = control_.tool.probeRow;
  const auto cell = [&](std::string_view column) { return probes.numberOr(row, column, 0); };
  const double unit = control_.unit;
  switch (number) {
    case 10:
      return control_.q.q(109);
    case 11:
      return control_.tool.radius / unit;
    case 12:
      return (control_.tool.length + control_.tool.deltaLength) / unit;
    case 14:
      return cell(index == 2 ? "CAL_OF2" : "CAL_OF1") / unit;
    case 50:
      if (index == 2) return row.empty() ? -1 : std::stod(row);
      return 1;
    case 51:
      return (control_.tool.length + control_.tool.deltaLength) / unit;
    case 52:
      return index == 2 ? control_.tool.radius2 / unit : control_.tool.radius / unit;
    case 53:
      return cell(index == 2 ? "CAL_OF2" : "CAL_OF1") / unit;
    case 54:
      return cell("CAL_ANG");
    case 55:
      return cell(index == 2 ? "F" : "FMAX") / unit;
    case 56:
      return cell(index == 2 ? "SET_UP" : "DIST") / unit;
    case 57:
      return index == 2 ? control_.channel.machine().spindleAngle()
                        : (control_.channel.description().spindleOrients ? 1 : 0);
    default:
      return std::nullopt;
  }
}

std::optional<double> KlartextHost::systemData(int id, int number, double index) const {
  const control::heidenhain::ActiveTool& tool = control_.tool;
  const control::heidenhain::Coordinates& coordinates = control_.coordinates;
  const machine::MachineDescription& description = control_.channel.description();
  const double unit = control_.unit;
  const int whole = static_cast<int>(std::lround(index));
  // Axes are numbered X Y Z A B C U V W from 1.
  const bool isAxis = whole >= 1 && whole <= 9;
  const auto axis = isAxis ? description.axisIndex(axisNames.substr(static_cast<std::size_t>(whole - 1), 1))
                           : std::optional<std::size_t>();
  const auto rotary = [&]() { return axis && description.axes[*axis].kind == machine::AxisKind::Rotary; };
  const auto scaled = [&](double value) { return rotary() ? value : value / unit; };
  const std::string row =
      index > 0 ? control::heidenhain::toolKey(static_cast<int>(std::floor(index)),
                                               static_cast<int>(std::lround((index - std::floor(index)) * 10)))
                : tool.row;
  switch (id) {
    case 20:
      switch (number) {
        case 1:
          return tool.number;
        case 2:
          return tool.number;
        case 3:
          return control_.q.q(109);
        case 4:
          return tool.spindleSpeed;
        case 5:
          return !spindleRuns_ ? -1 : clockwise_ ? 0 : 1;
        case 8:
          return 0;
        case 9:
          return feed_ / unit;
        case 10:
        case 11:
          return tool.index;
        default:
          return std::nullopt;
      }
    case 25:
      return 1;
    case 35:
      return number == 1 ? std::optional<double>(0) : std::nullopt;
    case 50:
      return toolData(number, row);
    case 60:
      switch (number) {
        case 1:
          return tool.number;
        case 2:
          return control_.q.q(109);
        case 3:
          return tool.spindleSpeed;
        case 4:
          return tool.deltaLength / unit;
        case 5:
          return tool.deltaRadius / unit;
        case 7:
          return tool.deltaRadius2 / unit;
        case 8:
          return tool.index;
        case 9:
          return tool.feed / unit;
        default:
          return std::nullopt;
      }
    case 200: {
      const bool oversize = whole >= 2;
      if (number == 1) return (tool.radius + (oversize ? tool.deltaRadius : 0)) / unit;
      if (number == 2) return (tool.length + (oversize ? tool.deltaLength : 0)) / unit;
      if (number == 3) return (tool.radius2 + (oversize ? tool.deltaRadius2 : 0)) / unit;
      return std::nullopt;
    }
    case 210:
      switch (number) {
        case 1:
          return coordinates.preset.spaceAngles.z();
        case 2:
          return coordinates.current().rotation;
        case 3: {
          double bits = 0;
          for (std::size_t i = 0; i < 3; ++i)
            bits += coordinates.current().mirror[i] ? static_cast<double>(1U << i) : 0;
          return bits;
        }
        case 4:
          return whole >= 1 && whole <= 3 ? coordinates.current().scale[whole - 1] : 1;
        case 5: {
          if (whole < 1 || whole > 3) return std::nullopt;
          if (!coordinates.tilt) return 0;
          return control::heidenhain::spaceAnglesFromRotation(*coordinates.tilt)[whole - 1];
        }
        case 6:
        case 7:
          return coordinates.tilt ? 1 : 0;
        default:
          return std::nullopt;
      }
    case 220:
      if (number != 2 || !isAxis) return std::nullopt;
      return whole <= 3 ? coordinates.current().shift[whole - 1] / unit : 0;
    case 230:
      if (!axis) return std::nullopt;
      if (number == 2) return scaled(description.axes[*axis].minimum);
      if (number == 3) return scaled(description.axes[*axis].maximum);
      return std::nullopt;
    case 240:
      return axis ? std::optional<double>(scaled(control_.channel.axes()[*axis])) : std::nullopt;
    case 270: {
      if (!isAxis) return std::nullopt;
      if (whole <= 3) return control_.channel.position()[whole - 1] / unit;
      if (!axis) return std::nullopt;
      return scaled(control_.channel.axes()[*axis] - control_.channel.rotaryOffset[*axis]);
    }
    case 280:
      return control_.channel.holdTip ? 1 : 0;
    case 310:
      if (number == 126) return shortestPath_ ? 1 : 0;
      if (number == 128) return control_.channel.holdTip ? 1 : 0;
      return 0;
    case 320: {
      if (number != 1) return std::nullopt;
      const double now = std::floor(machineSeconds());
      return whole == 0 ? now : std::fmod(now, 86400);
    }
    case 350:
      return probeData(number, whole);
    case 500: {
      const auto table = control_.tables.datums.find(control_.activeDatumTable);
      if (table == control_.tables.datums.end() || !isAxis) return std::nullopt;
      const auto datum = control::heidenhain::findDatum(table->second, number);
      if (!datum) return std::nullopt;
      const auto place = static_cast<std::size_t>(whole - 1);
      if (whole <= 3) return datum->shift[whole - 1] / unit;
      return whole <= 6 ? datum->rotary[place - 3] : datum->parallel[place - 6] / unit;
    }
    case 505:
      return control_.activeDatumTable.empty() ? 0 : 1;
    case 507: {
      const auto preset = control_.presetRow(number);
      if (!preset) return std::nullopt;
      if (whole >= 1 && whole <= 3) return preset->origin[whole - 1] / unit;
      if (whole >= 4 && whole <= 6) return preset->spaceAngles[whole - 4];
      return std::nullopt;
    }
    case 508: {
      const auto preset = control_.presetRow(number);
      if (!preset || !axis) return std::nullopt;
      return scaled(preset->rotaryOffset[*axis]);
    }
    case 530:
      return number == 1 || number == 2 ? std::optional<double>(coordinates.preset.row) : std::nullopt;
    case 990:
      if (number == 4) return control_.channel.machine().probeDeflected() ? 1 : 0;
      if (number == 8) return tool.probeRow.empty() ? -1 : std::stod(tool.probeRow);
      return 0;
    default:
      return std::nullopt;
  }
}

void KlartextHost::systemWrite(const Command& command, Evaluation& evaluation) {
  const auto wordOr = [&](std::string_view address, double otherwise) {
    const Word* word = find(command.words, address, evaluation);
    return word == nullptr ? otherwise : evaluation.number(word->value);
  };
  const int id = static_cast<int>(std::lround(wordOr("ID", 0)));
  const int number = static_cast<int>(std::lround(wordOr("NR", 0)));
  const double index = wordOr("IDX", 0);
  const int whole = static_cast<int>(std::lround(index));
  const double value = wordOr("VAL", 0);
  const auto refuse = [&]() {
    throw Alarm("System datum not available",
                fmt::format("FN 17 cannot write ID{} NR{} IDX{} on this control", id, number, index),
                "leave the block out for the run");
  };
  switch (id) {
    case 50: {
      const std::string row =
          index > 0 ? control::heidenhain::toolKey(static_cast<int>(std::floor(index)),
                                                   static_cast<int>(std::lround((index - std::floor(index)) * 10)))
                    : control_.tool.row;
      const auto column = std::ranges::find(toolColumns, number, &ToolColumn::number);
      if (column == toolColumns.end() || !control_.tables.tools.hasRow(row)) refuse();
      control_.writeNumber(control_.tables.tools, row, std::string(column->column),
                           value * (column->length ? control_.unit : 1));
      if (row == control_.tool.row) control_.refreshTool();
      publishTool();
      break;
    }
    case 500: {
      const auto table = control_.tables.datums.find(control_.activeDatumTable);
      if (table == control_.tables.datums.end() || whole < 1 || whole > 9) refuse();
      const bool rotary = whole >= 4 && whole <= 6;
      control_.writeNumber(table->second, std::to_string(number),
                           std::string(axisNames.substr(static_cast<std::size_t>(whole - 1), 1)),
                           value * (rotary ? 1 : control_.unit));
      break;
    }
    case 507: {
      control::heidenhain::Control::PresetChange change;
      if (whole >= 1 && whole <= 3) {
        change.origin[static_cast<std::size_t>(whole - 1)] = value * control_.unit;
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
      if (!axis) refuse();
      control::heidenhain::Control::PresetChange change;
      change.rotaryOffset[*axis] = value;
      control_.writePreset(number, change);
      break;
    }
    case 990:
      break;  // switches of the probe's input and monitoring have no counterpart here
    default:
      refuse();
  }
}

/// SYSSTR: ID10010 NR1 main program, NR2 the running one; ID10060 and ID10950 NR1 name of a tool; ID10321 date and
/// time; ID10630 NR10 software.
Value KlartextHost::systemText(int id, int number, int index) const {
  switch (id) {
    case 10010:
      if (number == 1) return control_.programPath;
      if (number == 2 && !levels_.empty()) return levels_.back().file;
      break;
    case 10060:
      return control_.tool.name;
    case 10950:
      if (number == 1) {
        return control_.tables.tools.text(index > 0 ? std::to_string(index) : control_.tool.row, "NAME");
      }
      break;
    case 10321: {
      const auto now = static_cast<std::time_t>(machineSeconds());
      std::tm parts{};
      gmtime_r(&now, &parts);
      const int year = parts.tm_year + 1900;
      const int month = parts.tm_mon + 1;
      switch (number) {
        case 0:
          return fmt::format("{:02}.{:02}.{:04} {:2}:{:02}:{:02}", parts.tm_mday, month, year, parts.tm_hour,
                             parts.tm_min, parts.tm_sec);
        case 3:
          return fmt::format("{}.{}.{:02} {:2}:{:02}", parts.tm_mday, month, year % 100, parts.tm_hour, parts.tm_min);
        case 4:
          return fmt::format("{:04}-{:02}-{:02} {:02}:{:02}:{:02}", year, month, parts.tm_mday, parts.tm_hour,
                             parts.tm_min, parts.tm_sec);
        case 8:
          return fmt::format("{:02}.{:02}.{:04}", parts.tm_mday, month, year);
        case 11:
          return fmt::format("{:04}-{:02}-{:02}", year, month, parts.tm_mday);
        case 13:
          return fmt::format("{:02}:{:02}:{:02}", parts.tm_hour, parts.tm_min, parts.tm_sec);
        case 15:
          return fmt::format("{:02}:{:02}", parts.tm_hour, parts.tm_min);
        default:
          break;
      }
      break;
    }
    case 10630:
      return std::string(control::name(control_.kind()));
    default:
      break;
  }
  throw Alarm("System datum not available", fmt::format("SYSSTR cannot read ID{} NR{} on this control", id, number),
              "assign a fixed text to the parameter");
}

}  // namespace probewright::language::klartext
