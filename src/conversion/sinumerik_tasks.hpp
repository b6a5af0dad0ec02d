#pragma once

#include <array>

#include "conversion/call.hpp"

/// SINUMERIK measuring cycles as measuring tasks.
namespace probewright::conversion {

/// What CYCLE977 measures, by the units of S_MVAR from 1 on.
inline constexpr std::array<Feature, 6> features977 = {Feature::Hole, Feature::Spigot, Feature::Groove,
                                                       Feature::Rib,  Feature::Pocket, Feature::RectangularSpigot};

/// The task of a call made with the tip of the probe at `start`. Throws NotCarriedOver for cycles and variants without
/// a task. `ballRadius`: as the written program names it.
MeasuringTask sinumerikTask(const Call& call, const Place& start, const Quantity& ballRadius, Losses& losses);

/// Where the probe stands after the cycle, in the coordinates of the call; what is not known is empty.
/// `results`: where the written program has what was measured.
std::array<std::optional<Quantity>, 3> sinumerikEnd(const Call& call, const MeasuringTask& task, const Place& start,
                                                    const Quantity& ballRadius, const Results& results);

/// A call that carries out the task, and from where: the tip goes up to the clearance height if it is below, over to
/// `start`, down to its height.
struct SinumerikPassage {
  /// What the call corrects; where it differs from the task, the program has to do the rest.
  enum class Rest {
    Nothing,
    ShiftFromPlace,     ///< the feature has the coordinates of its place: shift the origin to the wish
    ShiftFromMeasured,  ///< nothing is corrected: shift the origin from what was measured to the wish
  };
  std::optional<Place> start;  ///< empty: from where the probe is
  Call call;
  Rest rest = Rest::Nothing;
  bool correctsTool = false;   ///< the cycle itself corrects the tool of the task
  bool looksFarEnough = true;  ///< for the surface: as far as the task asks
  bool judges = false;         ///< the cycle compares with the limits of the task
  Quantity middle;             ///< of these limits: the cycle's set value lies that far from the nominal one
};
SinumerikPassage sinumerikPassage(const MeasuringTask& task, const Quantity& ballRadius, Losses& losses);

/// Where that cycle leaves its results.
Results sinumerikResults(const MeasuringTask& task);

/// S_STA1 of CYCLE998 for an edge at an angle to the main axis, both in degrees: it counts from the offset axis.
Quantity sinumerikEdgeAngle(const MeasuringTask& task, const Quantity& angle);

}  // namespace probewright::conversion
