#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "control/heidenhain/kinematics.hpp"
#include "cycles/heidenhain/kinematics_log.hpp"
#include "cycles/heidenhain/kinematics_plan.hpp"
#include "cycles/heidenhain/sphere_search.hpp"
#include "kinematics/chain_fit.hpp"

/// What cycles 451 and 452 measure and make of it.
namespace probewright::cycles::heidenhain {

/// The sphere at the reference and at each angle of one axis.
struct MeasuredSeries {
  AxisSeries plan;
  /// The reference first; with the backlash measured those reached in +.
  std::vector<kinematics::SphereSighting> sightings;
  /// Reached in + and in -; empty where the backlash is not measured.
  std::vector<std::pair<kinematics::SphereSighting, kinematics::SphereSighting>> approaches;
};

/// All series, one after the other; the first position is approached with A, then B, then C.
std::vector<MeasuredSeries> measureSeries(Context& context, SphereSearch& search, const MeasuringPlan& plan);

/// What there is to fit with the active kinematics: the places of the measured axes.
kinematics::ChainFitTask fitTaskOf(Context& context, std::span<const MeasuredSeries> series);
std::vector<kinematics::SphereSighting> allSightings(std::span<const MeasuredSeries> series);
/// Throws Alarm where the positions leave an axis open; warns of directions that they leave open.
kinematics::ChainFit fitOrAlarm(Context& context, const kinematics::ChainFitTask& task,
                                std::span<const MeasuredSeries> series);

/// What the measurement says of one axis. Lengths in mm, angles in degrees.
struct AxisFindings {
  double scatter = 0, attainable = 0;  ///< root mean square of the spatial errors, as measured and with the fit
  double maximum = 0, attainableMaximum = 0;
  double radius = 0;                   ///< of the measuring circle, mean
  double valuation = 0;                ///< of the measuring points
  std::optional<double> angularError;  ///< by which its direction was believed wrong
  std::optional<double> backlash, positioning;
  double uncertainty = 0;  ///< degrees for 0.001 mm
};
std::vector<AxisFindings> findingsOf(const kinematics::ChainFitTask& task, const kinematics::ChainFit& fit,
                                     std::span<const MeasuredSeries> series);

/// The kinematics with what was fitted.
control::heidenhain::KinematicData fitted(const control::heidenhain::KinematicData& before,
                                          const kinematics::ChainFit& fit);
/// Stops for NC start where the change goes beyond maxModification.
void confirmChange(Context& context, const control::heidenhain::KinematicData& before,
                   const control::heidenhain::KinematicData& after, const kinematics::ChainFit& fit);

enum class Optimised { Yes, No };
/// Q141 to Q149. `offset`: of the sphere from the active preset as the kinematics then sees it.
void reportResults(Context& context, std::span<const MeasuredSeries> series, std::span<const AxisFindings> findings,
                   Optimised optimised, const Vector3& offset);

/// TCHPR451.html and so on; `mode` empty: the cycle has none.
void logMeasurement(Context& context, const std::string& mode, std::span<const MeasuredSeries> series,
                    std::span<const AxisFindings> findings, const control::heidenhain::KinematicData& before,
                    const control::heidenhain::KinematicData& after, const Vector3& offset,
                    std::span<const std::string> remarks);

/// The TNC 640 ends with the working plane tilted as the rotary axes stand.
void tiltAsTheAxesStand(Context& context, const SphereSearch& search);

namespace results {

constexpr control::ResultKind scatterOf(std::uint8_t axis) {
  return result::actual(control::Characteristic{control::Quantity::Scatter}.number(axis));
}
constexpr control::ResultKind attainedBy(std::uint8_t axis) {
  return result::statistic(control::Characteristic{control::Quantity::Scatter}.number(axis));
}

inline constexpr ResultDefinition kinematics[] = {
    {"Q141", "measured standard deviation of A; -1: not measured", scatterOf(1).main()},
    {"Q142", "measured standard deviation of B; -1: not measured", scatterOf(2).main()},
    {"Q143", "measured standard deviation of C; -1: not measured", scatterOf(3).main()},
    {"Q144", "optimised standard deviation of A; -1: not optimised", attainedBy(1).main()},
    {"Q145", "optimised standard deviation of B; -1: not optimised", attainedBy(2).main()},
    {"Q146", "optimised standard deviation of C; -1: not optimised", attainedBy(3).main()},
    {"Q147", {"offset error, ", "X"}, result::difference(of::positionX)},
    {"Q148", {"offset error, ", "Y"}, result::difference(of::positionY)},
    {"Q149", {"offset error, ", "Z"}, result::difference(of::positionZ)},
};

}  // namespace results

}  // namespace probewright::cycles::heidenhain
