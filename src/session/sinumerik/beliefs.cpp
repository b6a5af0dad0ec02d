#include "session/sinumerik/beliefs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text.hpp"
#include "control/sinumerik/measuring_data.hpp"
#include "control/sinumerik/text.hpp"
#include "control/sinumerik/tool_data.hpp"
#include "cycles/sinumerik/tool_probe_data.hpp"
#include "execution/sinumerik/global_data.hpp"
#include "session/sinumerik/lathe_beliefs.hpp"
#include "session/table_files.hpp"

namespace probewright::session::sinumerik {

namespace sin = control::sinumerik;
namespace fs = std::filesystem;
using control::Beliefs;
using control::BelievedFrame;
using control::BelievedTool;

namespace {

/// Tools of the setup have lengths; where the control counts a length as a diameter (MD 20360, which parameters and
/// tables may tell), its datum is twice as large. What parameters and tables tell of tools is as the control has it.
void countAsDiameters(sin::DataStore& store, const Beliefs& beliefs, const std::set<sin::DataKey>& told) {
  for (const BelievedTool& tool : beliefs.tools) {
    const auto edge = sin::toolEdge(store, tool.number, 1);
    const sin::DataKey length("$TC_DP3", {tool.number, 1});
    if (edge && edge->lengthScale[0] != 1 && !told.contains(length))
      store.load(length, store.number(length) * edge->lengthScale[0]);
  }
}

}  // namespace

SinumerikData sinumerikData(const Beliefs& beliefs, Diagnostics& diagnostics,
                            const execution::sinumerik::GlobalUserData* globalData) {
  sin::InitText::ArraySizes sizes;
  if (globalData != nullptr) sizes = [globalData](std::string_view name) { return globalData->sizesOf(name); };
  SinumerikData data;
  sin::DataStore& store = data.store;
  sin::setMeasuringDefaults(store);
  const bool lathe = beliefs.technology == control::Technology::Turning;
  if (lathe) {
    store.load(sin::DataKey("$SC_TOOL_LENGTH_TYPE", {}), 2.0);
    // A lathe begins with G18 and DIAMON.
    store.load(sin::DataKey("$MC_GCODE_RESET_VALUES", {5}), 2.0);
    store.load(sin::DataKey("$MC_GCODE_RESET_VALUES", {28}), 2.0);
  }
  for (const BelievedTool& tool : beliefs.tools) {
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
    const bool star = tool.starArm > 0, bent = probe && !star && tool.lShaped;
    dp(1, star ? 714 : bent ? 713 : probe ? 710 : turning ? 500 : tool.kind == "drill" ? 200 : 120);
    // The length of stars and Ls ends at the equator of their balls.
    dp(3, star || bent ? tool.length - tool.axialRadius : tool.length);
    dp(6, bent ? tool.tipOffset.norm() : tool.radius);
    if (tool.teeth > 0) store.load(sin::DataKey("$TC_DPNT", {t, 1}), 1.0 * tool.teeth);
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
  const auto active = std::ranges::find(beliefs.zeroOffsets, true, &BelievedFrame::active);
  cycles::sinumerik::enterToolProbes(store, beliefs.toolProbes,
                                     active == beliefs.zeroOffsets.end() ? nullptr : &*active,
                                     control::WorkingPlane::ofG(lathe ? 18 : 17));
  for (const BelievedFrame& offset : beliefs.zeroOffsets) {
    sin::Frame frame;
    for (std::size_t i = 0; i < 3; ++i) {
      frame.geometry[i].coarse = offset.origin[static_cast<Eigen::Index>(i)];
      frame.geometry[i].rotation = offset.rotation[static_cast<Eigen::Index>(i)];
    }
    for (const auto& [axis, angle] : offset.rotary)
      frame.set(axis, sin::FramePart::Translation, angle);
    store.loadFrame(sin::DataKey("$P_UIFR", {offset.index}), frame);
  }
  std::set<sin::DataKey> told;  // by parameters and tables
  for (const auto& [name, parameter] : beliefs.parameters) {
    if (!name.starts_with('$')) {
      diagnostics.push_back({Severity::Error,
                             parameter.place,
                             fmt::format("{} is not a machine or setting datum of the 840Dsl", name),
                             {},
                             "their names begin with $ (docs/measuring-data.md)",
                             {}});
      continue;
    }
    told.merge(sin::InitText::parse(fmt::format("{}={}\n", name,
                                                std::holds_alternative<double>(parameter.value)
                                                    ? sin::numberText(std::get<double>(parameter.value))
                                                    : "\"" + std::get<std::string>(parameter.value) + "\""),
                                    beliefs.file, store, diagnostics)
                   .keys());
  }
  for (const fs::path& path : tableFiles(beliefs.tables, diagnostics)) {
    const std::string ending = upperCase(path.extension().string());
    static constexpr std::array<std::string_view, 6> endings = {".INI", ".TOA", ".UFR", ".GUD", ".SEA", ".MD"};
    if (std::ranges::find(endings, ending) == endings.end()) continue;
    if (const auto text = contents(path, diagnostics)) {
      data.files.push_back(
          {path.filename().string(), sin::InitText::parse(*text, path.string(), store, diagnostics, 1, sizes)});
      told.merge(data.files.back().text.keys());
    }
  }
  countAsDiameters(store, beliefs, told);
  return data;
}

int activeZeroOffset(const Beliefs& beliefs) {
  const auto active = std::ranges::find(beliefs.zeroOffsets, true, &BelievedFrame::active);
  return active == beliefs.zeroOffsets.end() ? 0 : active->index;
}

std::set<std::string> namesOfData(const Beliefs& beliefs) {
  std::set<std::string> names;
  Diagnostics ignored;  // the run names them
  for (const sin::DataKey& key : sinumerikData(beliefs, ignored).store.keys())
    names.insert(key.name);
  return names;
}

}  // namespace probewright::session::sinumerik
