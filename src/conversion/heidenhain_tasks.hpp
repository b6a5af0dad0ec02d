#pragma once

#include <array>

#include "control/control_kind.hpp"
#include "conversion/call.hpp"

/// HEIDENHAIN touch probe cycles as measuring tasks.
namespace probewright::conversion {

/// The cycles of a feature with a centre: one sets the preset to it, one inspects it.
struct CentredCycles {
  Feature feature;
  int preset, inspection;
};
inline constexpr std::array<CentredCycles, 8> centredCycles = {{{Feature::Hole, 412, 421},
                                                                {Feature::Spigot, 413, 422},
                                                                {Feature::HoleSegment, 412, 421},
                                                                {Feature::SpigotSegment, 413, 422},
                                                                {Feature::Groove, 408, 425},
                                                                {Feature::Rib, 409, 426},
                                                                {Feature::Pocket, 410, 423},
                                                                {Feature::RectangularSpigot, 411, 424}}};

/// True for 481 to 483 and 31 to 33, which are not tasks: they measure tools.
bool measuresTools(int heidenhainCycle);

/// The tasks of a call, in the order in which the cycle carries them out. What of the call a task cannot say goes to
/// `losses`. Throws NotCarriedOver for cycles and parameters without a task. `ballRadius`: as the written program
/// names it.
std::vector<MeasuringTask> heidenhainTasks(const Call& call, const Quantity& ballRadius, Losses& losses);

/// A call that carries out the task, with all parameters that the cycle has on that control; throws NotCarriedOver if
/// there is none.
Call heidenhainCall(const MeasuringTask& task, control::ControlKind control, const TouchProbe& probe = {});

/// Where that cycle leaves its results.
Results heidenhainResults(const std::string& cycle, const MeasuringTask& task);

}  // namespace probewright::conversion
