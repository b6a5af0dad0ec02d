#include <algorithm>
#include <string>

#include "conversion/heidenhain_tasks.hpp"
#include "conversion/meanings.hpp"

/// Where touch probe cycles leave what they have measured.
namespace probewright::conversion {

Results heidenhainResults(const std::string& cycle, const MeasuringTask& task) {
  // The angle of two holes or spigots is computed from their centres on the other side.
  if (task.feature == Feature::HolePair || task.feature == Feature::SpigotPair) return {};
  return resultsOf(*cycles::heidenhainCycle(std::stoi(cycle)));
}

}  // namespace probewright::conversion
