#include "simulation/continuous_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace probewright::simulation {
namespace {

constexpr double cornerTolerance = 0.01;  // mm

/// The time of a move that begins and ends with a speed.
double secondsOf(const MotionProfile& move, double entry, double exit) {
  const double length = move.length(), acceleration = move.acceleration();
  const double reached = (2 * acceleration * length + entry * entry + exit * exit) / 2;
  const double peak = std::min(move.targetSpeed(), std::sqrt(reached));
  const double changing = (2 * peak * peak - entry * entry - exit * exit) / (2 * acceleration);
  return (2 * peak - entry - exit) / acceleration + std::max(0.0, length - changing) / peak;
}

/// The speed of the arc that joins two ways within the tolerance.
double cornerSpeed(const machine::AxisPositions& in, const machine::AxisPositions& out, double acceleration) {
  double product = 0, squareIn = 0, squareOut = 0;
  for (std::size_t i = 0; i < in.values.size(); ++i) {
    product += in[i] * out[i];
    squareIn += in[i] * in[i];
    squareOut += out[i] * out[i];
  }
  // Half the angle between the directions.
  const double cosine = std::clamp(product / std::sqrt(squareIn * squareOut), -1.0, 1.0);
  const double half = std::sqrt((1 + cosine) / 2);
  if (half >= 1) return std::numeric_limits<double>::infinity();
  return std::sqrt(acceleration * cornerTolerance * half / (1 - half));
}

}  // namespace

double ContinuousPath::join(const machine::AxisPositions& way, const MotionProfile& profile) {
  Move move{way, profile, 0, 0};
  double saved = debt_;
  if (last_) {
    const MotionProfile& before = last_->profile;
    move.entry =
        std::min({before.targetSpeed(), profile.targetSpeed(), std::sqrt(2 * profile.acceleration() * profile.length()),
                  std::sqrt(last_->entry * last_->entry + 2 * before.acceleration() * before.length()),
                  cornerSpeed(last_->way, way, std::min(before.acceleration(), profile.acceleration()))});
    saved += last_->seconds - secondsOf(before, last_->entry, move.entry);
  } else {
    saved = 0;
  }
  move.seconds = secondsOf(profile, move.entry, 0);
  const double added = std::max(0.0, move.seconds - saved);
  debt_ = saved - (move.seconds - added);
  last_ = move;
  return added;
}

}  // namespace probewright::simulation
