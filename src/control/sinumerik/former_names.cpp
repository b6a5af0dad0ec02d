#include "control/sinumerik/former_names.hpp"

#include <algorithm>
#include <array>

#include "base/number_text.hpp"
#include "control/sinumerik/measuring_data.hpp"

namespace probewright::control::sinumerik {
namespace {

constexpr std::string_view general = "$MNS_MEA_FUNCTION_MASK", channel = "$MCS_MEA_FUNCTION_MASK",
                           setting = "$SNS_MEA_FUNCTION_MASK", channelSetting = "$SCS_MEA_FUNCTION_MASK";

/// A bit of a mask now, or two: one for workpieces, one for tools.
struct FormerBit {
  std::string_view name, mask;
  int bit = 0;
  int toolBit = -1;
  bool indexed = false;  ///< had the index 0
};
constexpr FormerBit bits[] = {
    {"$MNS_MEA_CAL_MONITORING", general, 0},
    {"$MNS_MEA_PROBE_LENGTH_RELATE", general, 1},
    {"$MNS_MEA_TOOLCARR_ENABLE", general, 2, 16},
    {"$MNS_MEA_MONO_COR_POS_ACTIVE", general, 3},
    {"$MNS_MEA_INPUT_PIECE_PROBE", channel, 0, -1, true},
    {"$MNS_MEA_INPUT_TOOL_PROBE", channel, 16, -1, true},
    {"$MCS_MEA_TURN_CYC_SPECIAL_MODE", channel, 1},
    // The manual has both spellings.
    {"$SNS_MEA_REPEAT_ACTIVE", setting, 0, 16},
    {"$SNS_MEA_REPEATE_ACTIVE", setting, 0, 16},
    {"$SNS_MEA_REPEAT_WITH_M0", setting, 1, 17},
    {"$SNS_MEA_REPEATE_WITH_M0", setting, 1, 17},
    {"$SNS_MEA_TOL_ALARM_SET_M0", setting, 2, 18},
    {"$SNS_MEA_PROBE_BALL_RAD_IN_TOA", setting, 3},
    {"$SCS_MEA_COLLISION_MONITORING", channelSetting, 0, 16},
    {"$SCS_MEA_COUPL_SPIND_COORD", channelSetting, 1},
    {"$SCS_MEA_SPIND_MOVE_DIR", channelSetting, 2},
    {"$SCS_MEA_NUM_OF_MEASURE", channelSetting, 3, 17},
    {"$SCS_MEA_FEED_TYP", channelSetting, 4, 18},
    {"$SCS_MEA_RETRACTION_FEED", channelSetting, 5, 19},
    {"$SCS_J_MEA_SET_COUPL_SP_COORD", channelSetting, 14},
    {"$SCS_J_MEA_SET_CAL_MODE", channelSetting, 15},
};

/// The same datum under another name.
struct Renamed {
  std::string_view name, now;
};
constexpr Renamed renamed[] = {
    {"$MNS_MEA_INPUT_TOOL_PROBE_SUB", "$SNS_MEA_INPUT_TOOL_PROBE_SUB"},
    {"$MNS_J_MEA_MEASURING_FEED", "$SCS_MEA_FEED_MEASURE"},
    {"$MNS_J_MEA_T_PROBE_TYPE", "$SNS_MEA_TP_TYPE"},
    {"$MNS_J_MEA_T_PROBE_ALLOW_AX_DIR", "$SNS_MEA_TP_AX_DIR_AUTO_CAL"},
    {"$MNS_J_MEA_T_PROBE_DIAM_LENGTH", "$SNS_MEA_TP_EDGE_DISK_SIZE"},
    {"$MNS_J_MEA_T_PROBE_T_EDGE_DIST", "$SNS_MEA_TP_CAL_MEASURE_DEPTH"},
    {"$MNS_J_MEA_T_PROBE_MEASURE_FEED", "$SCS_MEA_TP_FEED_MEASURE"},
};

const FormerBit* bitOf(const DataKey& key) {
  const auto* const found = std::ranges::find(bits, key.name, &FormerBit::name);
  if (found == std::end(bits)) return nullptr;
  const bool index0 = key.indices.size() == 1 && parseInteger(key.indices.front()) == 0;
  return found->indexed ? (index0 ? found : nullptr) : (key.indices.empty() ? found : nullptr);
}

std::optional<DataKey> renamedKey(const DataKey& key) {
  const auto* const found = std::ranges::find(renamed, key.name, &Renamed::name);
  if (found == std::end(renamed)) return std::nullopt;
  DataKey now = key;
  now.name = found->now;
  return now;
}

}  // namespace

bool isFormerName(std::string_view name) {
  return std::ranges::find(bits, name, &FormerBit::name) != std::end(bits) ||
         std::ranges::find(renamed, name, &Renamed::name) != std::end(renamed);
}

std::optional<double> readFormer(const DataStore& store, const DataKey& key) {
  if (const FormerBit* former = bitOf(key)) return maskBit(store, former->mask, former->bit) ? 1.0 : 0.0;
  if (const auto now = renamedKey(key)) return store.number(*now);
  return std::nullopt;
}

bool writeFormer(DataStore& store, const DataKey& key, double value) {
  if (const FormerBit* former = bitOf(key)) {
    setMaskBit(store, former->mask, former->bit, value != 0);
    if (former->toolBit >= 0) setMaskBit(store, former->mask, former->toolBit, value != 0);
    return true;
  }
  const auto now = renamedKey(key);
  if (now) store.set(*now, value);
  return now.has_value();
}

}  // namespace probewright::control::sinumerik
