#include "probing/directional_radius.hpp"

#include <algorithm>
#include <cmath>

namespace probewright::probing {
namespace {

/// The trigonometric polynomial through the points of a ring.
double onRing(const DirectionalRadius::Ring& ring, double azimuth) {
  const std::size_t count = ring.deviations.size();
  const double step = 2 * std::numbers::pi / static_cast<double>(count);
  const double at = radiansFromDegrees(azimuth - ring.azimuth);
  double value = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double away = at - step * static_cast<double>(i);
    // Dirichlet's kernel; for an even number of points its last term counts half.
    double kernel = 1;
    for (std::size_t k = 1; 2 * k <= count; ++k)
      kernel += (2 * k == count ? 1 : 2) * std::cos(static_cast<double>(k) * away);
    value += ring.deviations[i] * kernel / static_cast<double>(count);
  }
  return value;
}

}  // namespace

DirectionalRadius::DirectionalRadius(std::vector<Ring> rings) : rings_(std::move(rings)) {
  std::erase_if(rings_, [](const Ring& ring) { return ring.deviations.empty(); });
}

double DirectionalRadius::at(const Vector3& direction) const {
  const double length = direction.norm();
  if (rings_.empty() || !(length > 0)) return 0;
  const double polar = degreesFromRadians(std::acos(std::clamp(-direction.z() / length, 0.0, 1.0)));
  const double azimuth = degreesFromRadians(std::atan2(direction.y(), direction.x()));
  const auto outer = std::ranges::find_if(rings_, [&](const Ring& ring) { return ring.polar >= polar; });
  if (outer == rings_.begin()) return onRing(*outer, azimuth);
  if (outer == rings_.end()) return onRing(rings_.back(), azimuth);
  const auto inner = outer - 1;
  const double share = (polar - inner->polar) / (outer->polar - inner->polar);
  return (1 - share) * onRing(*inner, azimuth) + share * onRing(*outer, azimuth);
}

}  // namespace probewright::probing
