#include <fmt/format.h>

#include <algorithm>

#include "control/heidenhain/probe_table.hpp"
#include "control/heidenhain/tool_table.hpp"
#include "control/heidenhain/turning_tool_table.hpp"
#include "control/heidenhain/typed_table.hpp"
#include "session/heidenhain/beliefs.hpp"
#include "truth/entries.hpp"
#include "truth/family_truth.hpp"
#include "truth/tool_numbers.hpp"

namespace probewright::truth {

namespace {

using control::BelievedTool;
using control::heidenhain::NumberColumn;
using records::EntryKind;

/// A length of a turning tool: what the control computes with is length and delta.
struct TurningNumber {
  NumberColumn length, delta;
  Eigen::Index axis;  ///< of trueTip()
  double sign;
};
/// A number of a tool, and the columns whose sum it is.
struct ToolDimension {
  NumberColumn nominal, delta;
};

constexpr TurningNumber turningNumbers[] = {{"ZL", "DZL", 2, -1}, {"XL", "DXL", 0, 1}, {"YL", "DYL", 1, 1}};

/// A table as the run left it, if it wrote one; its numbers are in mm whatever the unit of the file.
std::optional<control::heidenhain::TypedTable> leftBehind(const session::RunOutcome& outcome, const std::string& name,
                                                          std::span<const control::heidenhain::ColumnSpec> columns) {
  const auto file = outcome.files.find(name);
  if (file == outcome.files.end()) return std::nullopt;
  Diagnostics ignored;
  auto table = control::heidenhain::TypedTable::parse(file->second, name, columns, ignored);
  if (!table) return std::nullopt;
  return std::move(*table);
}

void heidenhainTools(CollectedEntries& entries, const session::RunOutcome& outcome, const control::Beliefs& calibrated,
                     const simulation::Truth& truth) {
  Diagnostics ignored;
  const auto ideal = session::heidenhain::heidenhainTables(calibrated, outcome.control, ignored);
  const WrittenValues written = writtenValues(outcome.journal);
  const auto tools = leftBehind(outcome, "TOOL.T", control::heidenhain::toolColumns());
  const auto turningTools = leftBehind(outcome, "TOOLTURN.TRN", control::heidenhain::turningToolColumns());
  const auto probes = leftBehind(outcome, "TCHPROBE.TP", control::heidenhain::probeColumns());
  const auto find = [&](const std::string& table, const std::string& row, const NumberColumn& column) {
    const auto found = written.find({table, fmt::format("row {}, column {}", row, column.name())});
    return found == written.end() ? nullptr : &found->second;
  };
  static constexpr ToolDimension numbers[] = {{"L", "DL"}, {"R", "DR"}};
  for (const BelievedTool& tool : calibrated.tools) {
    const std::string row = std::to_string(tool.number);
    const simulation::TrueTool* planted = toolNumbered(truth, tool.number);
    if (tool.kind == "turn") {  // its lengths are those of its tip, in the table of turning tools
      if (planted == nullptr || !planted->cutter.insert || !turningTools) continue;
      const Vector3 tip = trueTip(*planted);
      for (const TurningNumber& number : turningNumbers) {
        const Written* length = find("TOOLTURN.TRN", row, number.length);
        const Written* delta = find("TOOLTURN.TRN", row, number.delta);
        if (length == nullptr && delta == nullptr) continue;
        const auto valueOf = [&](const NumberColumn& column) { return turningTools->numberOr(row, column, 0); };
        entries.add(EntryKind::Tool, "tool " + row, (length != nullptr ? length : delta)->cycle,
                    {std::string(number.length.name()), "mm", valueOf(number.length) + valueOf(number.delta),
                     number.sign * tip[number.axis]});
      }
      continue;
    }
    const ToolReach reach = reachOf(planted);
    for (const ToolDimension& number : numbers) {
      double believed = 0, real = 0;
      const Written* last = nullptr;
      for (const NumberColumn& column : {number.nominal, number.delta}) {
        const Written* one = find("TOOL.T", row, column);
        if (one != nullptr) last = one;
        if (tools) believed += tools->numberOr(row, column, 0);
        real += ideal.tools.numberOr(row, column, 0);
      }
      if (last == nullptr || !tools) continue;
      real += &number == &numbers[0] ? reach.length : reach.radius;
      entries.add(tool.kind == "probe" ? EntryKind::Probe : EntryKind::Tool, "tool " + row, last->cycle,
                  {std::string(number.nominal.name()), "mm", believed, real});
    }
    if (tool.kind != "probe") continue;
    for (const NumberColumn& column : {NumberColumn("CAL_OF1"), NumberColumn("CAL_OF2")}) {
      const std::string probe = std::to_string(tool.probeNumber);
      const Written* one = find("TCHPROBE.TP", probe, column);
      if (one != nullptr && probes)
        entries.add(EntryKind::Probe, "tool " + row, one->cycle,
                    {std::string(column.name()), "mm", probes->numberOr(probe, column, 0),
                     ideal.probes.numberOr(probe, column, 0)});
    }
  }
}

/// What a HEIDENHAIN control keeps outside its tables: of tool touch probes, on the iTNC 530 also of touch probes.
void calibrationData(CollectedEntries& entries, const session::RunOutcome& outcome,
                     const control::Beliefs& calibrated) {
  const WrittenValues written = writtenValues(outcome.journal);
  const auto compare = [&](const std::string& entry, const std::string& name, double truth) {
    const auto found = written.find({"calibration data", entry});
    if (found != written.end())
      entries.add(EntryKind::Probe, name, found->second.cycle, {entry, "mm", found->second.value, truth});
  };
  const auto probe = std::ranges::find(calibrated.tools, "probe", &BelievedTool::kind);
  if (probe != calibrated.tools.end()) {
    compare("effective radius", "touch probe", probe->radius);
    compare("effective length", "touch probe", probe->length);
    compare("centre offset, main axis", "touch probe", probe->tipOffset.x());
    compare("centre offset, minor axis", "touch probe", probe->tipOffset.y());
  }
  if (calibrated.toolProbes.empty()) return;
  const control::BelievedToolProbe& contact = calibrated.toolProbes.front();
  compare("TT centre, X", "tool touch probe", contact.centre.x());
  compare("TT centre, Y", "tool touch probe", contact.centre.y());
  compare("TT centre, Z", "tool touch probe", contact.centre.z() - contact.pretravel);
  compare("TT radius, main axis", "tool touch probe", contact.width / 2 - contact.pretravel);
  compare("TT radius, minor axis", "tool touch probe", contact.widthY / 2 - contact.pretravel);
}

}  // namespace

std::vector<records::EntryTruth> heidenhainToolEntries(const session::RunOutcome& outcome,
                                                       const control::Beliefs& /*beliefs*/,
                                                       const control::Beliefs& calibrated,
                                                       const simulation::Truth& truth) {
  CollectedEntries entries;
  heidenhainTools(entries, outcome, calibrated, truth);
  calibrationData(entries, outcome, calibrated);
  return entries.take();
}

}  // namespace probewright::truth
