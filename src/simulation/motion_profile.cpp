#include "simulation/motion_profile.hpp"

#include <algorithm>
#include <cmath>

namespace probewright::simulation {

MotionProfile::MotionProfile(double length, double speed, double acceleration)
    : length_(length),
      target_(speed),
      speed_(std::min(speed, std::sqrt(length * acceleration))),
      acceleration_(acceleration) {}

double MotionProfile::duration() const { return length_ > 0 ? length_ / speed_ + speed_ / acceleration_ : 0; }

double MotionProfile::speedAt(double travelled) const {
  const double toNearestEnd = std::clamp(std::min(travelled, length_ - travelled), 0.0, length_);
  return std::min(speed_, std::sqrt(2 * acceleration_ * toNearestEnd));
}

double MotionProfile::secondsAt(double travelled) const {
  if (length_ <= 0) return 0;
  const double rampLength = speed_ * speed_ / (2 * acceleration_);
  const double inside = std::clamp(travelled, 0.0, length_);
  if (inside < rampLength) return std::sqrt(2 * inside / acceleration_);
  if (inside > length_ - rampLength) return duration() - std::sqrt(2 * (length_ - inside) / acceleration_);
  return speed_ / (2 * acceleration_) + inside / speed_;
}

double MotionProfile::travelledAt(double seconds) const {
  if (length_ <= 0 || seconds >= duration()) return length_;
  const double ramp = speed_ / acceleration_, left = duration() - seconds;
  if (seconds < ramp) return 0.5 * acceleration_ * seconds * seconds;
  if (left < ramp) return length_ - 0.5 * acceleration_ * left * left;
  return speed_ * (seconds - 0.5 * ramp);
}

double MotionProfile::brakingDistanceAt(double travelled) const {
  const double speed = speedAt(travelled);
  return speed * speed / (2 * acceleration_);
}

}  // namespace probewright::simulation
