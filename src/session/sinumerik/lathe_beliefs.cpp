#include "session/sinumerik/lathe_beliefs.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace probewright::session::sinumerik {

using control::sinumerik::DataKey;
using control::sinumerik::DataStore;

namespace {

/// The cutting edge position of a tool whose tip points along `direction`.
int positionOf(const Vector3& direction) {
  if (std::abs(direction.z()) > std::abs(direction.x())) return direction.z() > 0 ? 5 : 7;
  return direction.x() > 0 ? 6 : 8;
}

/// From the middle of the end of a calibrating tool to the corner that its lengths count from: the end of its ball, or
/// of the disc or pin in its place, towards -X and -Z (cutting edge position 3).
Vector3 cornerOf(const control::BelievedTool& tool) {
  Vector3 corner = Vector3::Zero();
  for (const int axis : {0, 2})
    if (std::abs(tool.shankDirection[axis]) < 0.5) corner[axis] = -tool.radius;
  return corner;
}

}  // namespace

void enterLatheTool(DataStore& store, const control::BelievedTool& tool) {
  const bool probe = tool.kind == "probe";
  const auto dp = [&](int parameter, double value) {
    store.load(DataKey(fmt::format("$TC_DP{}", parameter), {tool.number, 1}), value);
  };
  // A turning tool's usual position is behind the centre, cutting towards the chuck.
  const bool calibrates = tool.kind == "calibration", turning = tool.kind == "turn";
  const int usual = calibrates || turning ? 3 : 0;
  const int position = probe                              ? positionOf(-tool.shankDirection)
                       : turning && tool.cuttingEdge != 0 ? tool.cuttingEdge
                                                          : usual;
  const double length = probe ? tool.length - tool.axialRadius : tool.length;
  Vector3 reference = length * tool.shankDirection - tool.mount;
  if (calibrates) reference -= cornerOf(tool);
  dp(1, probe || calibrates ? 580 : turning ? 500 : tool.kind == "drill" ? 200 : 120);
  if (position != 0) dp(2, position);
  dp(3, reference.x());
  dp(4, reference.z());
  dp(6, tool.radius);
  if (!probe) return;
  const auto calibration = [&](std::string_view name, double value) {
    store.load(DataKey(fmt::format("$SNS_MEA_WP_{}", name), {tool.probeNumber - 1}), value);
  };
  calibration("BALL_DIAM", 2 * tool.radius);
  static constexpr std::array<int, 3> axes = {2, 0, 1};
  for (int place = 1; place <= 3; ++place) {
    const int axis = axes[static_cast<std::size_t>(place - 1)];
    const double along = tool.shankDirection[axis] * tool.shankDirection[axis];
    const double radius = tool.radius + along * (tool.axialRadius - tool.radius);
    const double offset = axis == 0 ? tool.tipOffset.x() : 0;
    calibration(fmt::format("TRIG_MINUS_DIR_AX{}", place), offset - radius);
    calibration(fmt::format("TRIG_PLUS_DIR_AX{}", place), offset + radius);
    if (place <= 2) calibration(fmt::format("POS_DEV_AX{}", place), offset);
  }
  calibration("FEED", tool.feed);
}

}  // namespace probewright::session::sinumerik
