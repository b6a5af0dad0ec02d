#include "probing/sinumerik_rapid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace probewright::probing {

using machine::Feed;

Feed reducedRapid(const control::Channel& channel, const ProgramPlace& target, double percent) {
  if (percent <= 0 || percent >= 100) return Feed::rapidTraverse();
  const machine::AxisPositions from = channel.axes(), to = channel.axesFromProgram(target, from);
  // Each linear axis and its share of the way.
  const auto eachShare = [&](auto&& visit) {
    std::size_t index = 0;
    for (const machine::Axis& axis : channel.description().axes) {
      if (axis.kind == machine::AxisKind::Linear) visit(axis, std::abs(to[index] - from[index]));
      ++index;
    }
  };
  double way = 0;
  eachShare([&](const machine::Axis&, double share) { way += share * share; });
  way = std::sqrt(way);
  double speed = std::numeric_limits<double>::infinity();
  eachShare([&](const machine::Axis& axis, double share) {
    if (share > 0) speed = std::min(speed, axis.rapid * way / share);
  });
  return std::isfinite(speed) ? Feed::at(speed * percent / 100) : Feed::rapidTraverse();
}

}  // namespace probewright::probing
