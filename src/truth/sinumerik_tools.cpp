#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "session/sinumerik/beliefs.hpp"
#include "simulation/tool_shape.hpp"
#include "truth/entries.hpp"
#include "truth/family_truth.hpp"
#include "truth/tool_numbers.hpp"

namespace probewright::truth {

namespace {

using control::BelievedTool;
using records::EntryKind;

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

void sinumerikTools(CollectedEntries& entries, const session::RunOutcome& outcome, const control::Beliefs& beliefs,
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
    const ToolReach reach = reachOf(toolNumbered(truth, tool.number));
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

}  // namespace

std::vector<records::EntryTruth> sinumerikToolEntries(const session::RunOutcome& outcome,
                                                      const control::Beliefs& beliefs,
                                                      const control::Beliefs& calibrated,
                                                      const simulation::Truth& truth) {
  CollectedEntries entries;
  sinumerikTools(entries, outcome, beliefs, calibrated, truth);
  return entries.take();
}

}  // namespace probewright::truth
