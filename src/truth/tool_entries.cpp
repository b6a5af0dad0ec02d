#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "control/heidenhain/typed_table.hpp"
#include "session/heidenhain/beliefs.hpp"
#include "session/sinumerik/beliefs.hpp"
#include "simulation/tool_shape.hpp"
#include "truth/entries.hpp"

namespace probewright::truth {

namespace {

using control::BelievedTool;
using records::EntryKind;
using records::EntryTruth;
using records::EntryValue;

/// What the teeth of a mill add to its radius and its length where they cut: those that reach furthest.
struct Reach {
  double radius = 0, length = 0;
};

Reach reachOf(const simulation::TrueTool* tool) {
  if (tool == nullptr || tool->cutter.teeth.empty()) return {};
  Reach reach{-1e9, -1e9};
  for (const simulation::TrueTooth& tooth : tool->cutter.teeth) {
    reach.radius = std::max(reach.radius, tooth.radial - tooth.radialWear);
    reach.length = std::max(reach.length, tooth.axial - tooth.axialWear - tooth.broken);
  }
  return reach;
}

/// The theoretical tip of a turning tool, from where its length begins, in the frame of the tool: along the plane of
/// its insert (X), across (Y), along its axis (Z). The tangents to a worn nose have moved away from where it points.
Vector3 trueTip(const simulation::TrueTool& tool) {
  const simulation::TrueInsert& insert = *tool.cutter.insert;
  const double half = std::remainder(insert.secondNormal - insert.firstNormal, 360) / 2;
  const double middle = radiansFromDegrees(insert.firstNormal + half);
  const auto worn = [&](double pointing) {
    return std::abs(pointing) < 1e-6 ? 0 : std::copysign(insert.wear, pointing);
  };
  return {tool.cutter.eccentricity.x() - worn(std::cos(middle)), tool.cutter.eccentricity.y(),
          -tool.length - worn(std::sin(middle))};
}

const simulation::TrueTool* toolNumbered(const simulation::Truth& truth, int number) {
  const auto found = std::ranges::find(truth.tools, number, &simulation::TrueTool::number);
  return found == truth.tools.end() ? nullptr : &*found;
}

/// Collects numbers by the entry that they belong to.
class Entries {
public:
  void add(EntryKind kind, const std::string& name, std::optional<std::size_t> cycle, EntryValue value) {
    auto entry = std::ranges::find(entries_, name, &EntryTruth::name);
    if (entry == entries_.end()) {
      EntryTruth made;
      made.kind = kind;
      made.name = name;
      entry = entries_.insert(entries_.end(), std::move(made));
    }
    if (cycle) entry->cycle = std::max(entry->cycle.value_or(0), *cycle);
    entry->distance = std::max(entry->distance.value_or(0), std::abs(value.value - value.truth));
    entry->values.push_back(std::move(value));
  }
  std::vector<EntryTruth> take() { return std::move(entries_); }

private:
  std::vector<EntryTruth> entries_;
};

/// A number of a tool: what the control computes with is the sum of its entries.
struct ToolNumber {
  std::string label;
  std::vector<std::string> parts;  ///< columns, or data
};

/// A length of a turning tool: what the control computes with is length and delta.
struct TurningNumber {
  const char* length;
  const char* delta;
  Eigen::Index axis;  ///< of trueTip()
  double sign;
};
constexpr TurningNumber turningNumbers[] = {{"ZL", "DZL", 2, -1}, {"XL", "DXL", 0, 1}, {"YL", "DYL", 1, 1}};

void heidenhainTools(Entries& entries, const session::RunOutcome& outcome, const control::Beliefs& beliefs,
                     const control::Beliefs& calibrated, const simulation::Truth& truth) {
  Diagnostics ignored;
  const auto before = session::heidenhainTables(beliefs, outcome.control, ignored);
  const auto ideal = session::heidenhainTables(calibrated, outcome.control, ignored);
  const WrittenValues written = writtenValues(outcome.journal);
  const auto find = [&](const std::string& table, const std::string& row, const std::string& column) {
    const auto found = written.find({table, fmt::format("row {}, column {}", row, column)});
    return found == written.end() ? nullptr : &found->second;
  };
  static const ToolNumber numbers[] = {{"L", {"L", "DL"}}, {"R", {"R", "DR"}}};
  for (const BelievedTool& tool : calibrated.tools) {
    const std::string row = std::to_string(tool.number);
    const simulation::TrueTool* planted = toolNumbered(truth, tool.number);
    if (tool.kind == "turn") {  // its lengths are those of its tip, in the table of turning tools
      if (planted == nullptr || !planted->cutter.insert || !before.turningTools) continue;
      const Vector3 tip = trueTip(*planted);
      for (const TurningNumber& number : turningNumbers) {
        const Written* length = find("TOOLTURN.TRN", row, number.length);
        const Written* delta = find("TOOLTURN.TRN", row, number.delta);
        if (length == nullptr && delta == nullptr) continue;
        const auto valueOf = [&](const Written* one, const char* column) {
          return one != nullptr
                     ? one->value
                     : before.turningTools->numberOr(row, control::heidenhain::NumberColumn::named(column), 0);
        };
        entries.add(EntryKind::Tool, "tool " + row, (length != nullptr ? length : delta)->cycle,
                    {number.length, "mm", valueOf(length, number.length) + valueOf(delta, number.delta),
                     number.sign * tip[number.axis]});
      }
      continue;
    }
    const Reach reach = reachOf(planted);
    for (const ToolNumber& number : numbers) {
      double believed = 0, real = 0;
      const Written* last = nullptr;
      for (const std::string& column : number.parts) {
        const auto name = control::heidenhain::NumberColumn::named(column);
        const Written* one = find("TOOL.T", row, column);
        if (one != nullptr) last = one;
        believed += one != nullptr ? one->value : before.tools.numberOr(row, name, 0);
        real += ideal.tools.numberOr(row, name, 0);
      }
      if (last == nullptr) continue;
      real += number.label == "L" ? reach.length : reach.radius;
      entries.add(tool.kind == "probe" ? EntryKind::Probe : EntryKind::Tool, "tool " + row, last->cycle,
                  {number.label, "mm", believed, real});
    }
    if (tool.kind != "probe") continue;
    for (const char* column : {"CAL_OF1", "CAL_OF2"}) {
      const std::string probe = std::to_string(tool.probeNumber);
      const Written* one = find("TCHPROBE.TP", probe, column);
      const auto name = control::heidenhain::NumberColumn::named(column);
      if (one != nullptr)
        entries.add(EntryKind::Probe, "tool " + row, one->cycle,
                    {column, "mm", one->value, ideal.probes.numberOr(probe, name, 0)});
    }
  }
}

/// What a HEIDENHAIN control keeps outside its tables: of tool touch probes, on the iTNC 530 also of touch probes.
void calibrationData(Entries& entries, const session::RunOutcome& outcome, const control::Beliefs& calibrated) {
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

/// Turning tools as they are now: their inserts stand beside the axis, and have lost something.
control::Beliefs withInserts(control::Beliefs calibrated, const simulation::Truth& truth) {
  for (BelievedTool& tool : calibrated.tools) {
    const simulation::TrueTool* planted = toolNumbered(truth, tool.number);
    if (tool.kind != "turn" || planted == nullptr || !planted->cutter.insert) continue;
    const Vector3 tip = trueTip(*planted);
    if (calibrated.technology == control::Technology::Turning) {
      const Vector3 aside =
          Eigen::AngleAxisd(radiansFromDegrees(planted->cutter.insert->orientation), Vector3::UnitZ()) *
          Vector3(tip.x(), tip.y(), tip.z() + planted->length);
      tool.mount += simulation::toolFrame(*planted) * aside;
    } else {
      tool.length = -tip.z();
    }
  }
  return calibrated;
}

/// The numbers between brackets: "[12,1]".
std::vector<int> indicesOf(const std::string& entry) {
  std::vector<int> indices;
  std::string digits;
  for (const char c : entry) {
    if (c >= '0' && c <= '9') {
      digits += c;
    } else if (!digits.empty()) {
      indices.push_back(std::stoi(digits.substr(0, 9)));
      digits.clear();
    }
  }
  return indices;
}

void sinumerikTools(Entries& entries, const session::RunOutcome& outcome, const control::Beliefs& beliefs,
                    const control::Beliefs& calibrated, const simulation::Truth& truth) {
  Diagnostics ignored;
  const auto before = session::sinumerikData(beliefs, ignored).store;
  const auto ideal = session::sinumerikData(withInserts(calibrated, truth), ignored).store;
  const WrittenValues written = writtenValues(outcome.journal);
  // Geometry and wear count together.
  static const ToolNumber numbers[] = {{"length 1", {"$TC_DP3", "$TC_DP12"}},
                                       {"length 2", {"$TC_DP4", "$TC_DP13"}},
                                       {"radius", {"$TC_DP6", "$TC_DP15"}}};
  for (const BelievedTool& tool : calibrated.tools) {
    const Reach reach = reachOf(toolNumbered(truth, tool.number));
    const std::string entry = fmt::format("[{},1]", tool.number);
    for (const ToolNumber& number : numbers) {
      double believed = 0, real = 0;
      const Written* last = nullptr;
      for (const std::string& name : number.parts) {
        const auto found = written.find({name, entry});
        if (found != written.end()) last = &found->second;
        believed += found != written.end() ? found->second.value : before.number(name, {tool.number, 1});
        real += ideal.number(name, {tool.number, 1});
      }
      if (last == nullptr || !ideal.isSet({number.parts.front(), {tool.number, 1}})) continue;
      if (number.label == "radius") real += reach.radius;
      // The end of a tool along its own axis: length 1, of tools across the spindle length 2.
      if (number.label == (std::abs(tool.shankDirection.z()) > 0.5 ? "length 1" : "length 2")) real += reach.length;
      entries.add(tool.kind == "probe" ? EntryKind::Probe : EntryKind::Tool, fmt::format("tool {}", tool.number),
                  last->cycle, {number.label, "mm", believed, real});
    }
  }
  for (const auto& [place, value] : written) {
    const bool probe = place.first.starts_with("$SNS_MEA_WP_"), toolProbe = place.first.starts_with("$SNS_MEA_TP_");
    const bool length = place.first.find("TRIG_") != std::string::npos || place.first.ends_with("BALL_DIAM") ||
                        place.first.find("POS_DEV_") != std::string::npos;
    const std::vector<int> indices = indicesOf(place.second);
    if (!(probe || toolProbe) || !length || indices.size() != 1) continue;
    const control::sinumerik::DataKey key(place.first, {indices[0]});
    if (!ideal.isSet(key)) continue;
    entries.add(EntryKind::Probe, fmt::format("{} data {}", probe ? "probe" : "tool probe", indices[0] + 1),
                value.cycle, {place.first.substr(12), "mm", value.value, ideal.number(key)});
  }
}

bool isOfTools(const std::string& table) {
  return table == "TOOL.T" || table == "TOOLTURN.TRN" || table == "TCHPROBE.TP" || table == "calibration data" ||
         table.starts_with("$TC_DP") || table.starts_with("$SNS_MEA_");
}

}  // namespace

std::vector<EntryTruth> toolEntries(const session::RunOutcome& outcome, const control::Beliefs& beliefs,
                                    const control::Beliefs& calibrated, const simulation::Truth& truth) {
  Entries entries;
  // Most runs write nothing of tools; the tables need not be made again for them.
  if (std::ranges::none_of(writtenValues(outcome.journal),
                           [](const auto& written) { return isOfTools(written.first.first); }))
    return {};
  switch (outcome.control) {
    case control::ControlKind::TNC640:
    case control::ControlKind::iTNC530:
      heidenhainTools(entries, outcome, beliefs, calibrated, truth);
      calibrationData(entries, outcome, calibrated);
      break;
    case control::ControlKind::Sinumerik840Dsl:
      sinumerikTools(entries, outcome, beliefs, calibrated, truth);
      break;
  }
  return entries.take();
}

}  // namespace probewright::truth
