#pragma once

#include "conversion/call.hpp"

/// SINUMERIK measuring cycles as measuring tasks.
namespace probewright::conversion {

/// The task of a call made with the tip of the probe at `start`. Throws NotCarriedOver for cycles and variants without
/// a task. `ballRadius`: as the written program names it.
MeasuringTask sinumerikTask(const Call& call, const Place& start, const Quantity& ballRadius, Losses& losses);

/// Where the probe stands behind the cycle, in the coordinates of the call; what is not known is empty.
/// `results`: where the written program has what was measured.
std::array<std::optional<Quantity>, 3> sinumerikEnd(const Call& call, const MeasuringTask& task, const Place& start,
                                                    const Results& results);

/// A call that carries out the task, and from where: the tip goes up to task.clearance if it is below, over to `start`,
/// down to its height.
struct SinumerikPassage {
  Place start;
  Call call;
};
SinumerikPassage sinumerikPassage(const MeasuringTask& task, const Quantity& ballRadius, Losses& losses);

/// Where that cycle leaves its results.
Results sinumerikResults(const std::string& cycle, const MeasuringTask& task);

}  // namespace probewright::conversion
