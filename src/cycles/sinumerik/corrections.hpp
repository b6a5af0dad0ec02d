#pragma once

#include <optional>
#include <span>
#include <vector>

#include "cycles/sinumerik/context.hpp"

/// What a SINUMERIK measuring cycle does with its result: nothing, the correction of a zero offset, or that of a tool.
namespace probewright::cycles::sinumerik {

/// The hundreds of S_MVAR.
enum class Task { MeasureOnly, ZeroOffset, Tool };

/// The task of this call. Alarm 61307 for another digit, or for the tool where a cycle has no tool correction. What
/// S_KNUM1, S_TNAME and S_EVNUM name is looked up already here, so that a wrong call is refused before anything moves.
Task taskOf(Context& context);

// ---- zero offset ----

/// A frame of data management.
struct FrameTarget {
  std::string name;           ///< "$P_UIFR", "$P_CHBFR", "$P_NCBFR", "$P_SETFR"
  std::optional<int> number;  ///< its index; none for $P_SETFR
  bool coarse = false;        ///< translations go into the coarse part, not into the fine one
  int shown = 0;              ///< S_KNUM without its fifth digit, as _OVI[0] shows it
};

enum class GlobalBase { Allowed, Refused };

/// The frame that S_KNUM names:
///   units, tens  number of the settable zero offset (1 = G54) or of the base frame (1 = the first)
///   thousands    0 settable, 1 channel base frame, 2 base reference, 3 global base frame, 9 the active settable zero
///                offset, with G500 the last channel base frame
///   10^4         0 fine translation (coarse if the machine has none: $MN_MM_FRAME_FINE_TRANS = 0), 1 coarse
/// Nothing for number 0 of a settable zero offset or base frame. Alarms 61321 (number), 61322 (fourth digit), 61323
/// (fifth digit), 61324 (digits beyond).
std::optional<FrameTarget> frameTarget(Context& context, GlobalBase globalBase);

/// Shifts the frame so that a feature gets its set position.
///
/// `feature` is where the feature is, as the chain of frames yields it; `set` where
/// it is to be in the workpiece coordinate system, and `directions` are the directions (unit, at right angles to each
/// other) in which it was measured: in others nothing changes. If the target is not part of the
/// active chain, it is corrected as if it stood in the place of its kind; rotations in the chain are followed.
void correctTranslation(Context& context, const FrameTarget& target, const PartInMachine& feature, const PartPoint& set,
                        std::span<const PlaneWay> directions);

/// Turns the frame so that the axes of the workpiece coordinate system get the directions of the columns of `turn`,
/// expressed in the present one (plane coordinates, orthonormal). Translations of the frame stay as they are.
/// Alarm 61322 for a frame that has no rotation (global base frame).
void correctRotation(Context& context, const FrameTarget& target, const Matrix3& turn);

/// Corrects the translation of rotary axis `axis` (index) so that moving to the present program angle turns the part by
/// -`angle` degrees about `direction` (unit). Alarm 61325 if the axis does not turn the part about
/// that direction.
void correctRotaryAxis(Context& context, const FrameTarget& target, std::size_t axis, const PlaneWay& direction,
                       double angle);

/// Refuses an axis that correctRotaryAxis() would refuse, before anything is measured.
void requireRotaryAxis(Context& context, std::size_t axis, const PlaneWay& direction);

/// Where a point of the workpiece is on the machine.
PartInMachine machinePoint(Context& context, const PartPoint& point);

// ---- tool ----

/// True if S_KNUM1 of this cycle has its digits as the turning cycles have them: D numbers of three digits.
bool codesTurnedTool(const CycleDefinition& cycle);

/// Which way a too large result points to a wrong tool. In `size` results (diameters, widths) the tool sees half.
struct ToolInfluence {
  double radius = 0;           ///< correction of the radius for a difference of +1
  double length = 0;           ///< correction of a length for a difference of +1
  bool radiusFromAxis = true;  ///< S_KNUM1 leaves the component open: radius (or, false, length 1)
  int measuringAxis = 0;       ///< 0, 1, 2: decides the length of a turning tool that S_KNUM1 leaves open
  bool surface = false;        ///< one surface across measuringAxis: turned tool carriers count (MD 51740 bit 2)
};

/// A hole or pocket too large: the tool is larger than its data say. A spigot too large: smaller.
ToolInfluence influenceOnSize(Side side, int measuringAxis = 0);
/// A surface that was measured in `direction` (+1, -1) along `measuringAxis` (0, 1, 2).
ToolInfluence influenceOnSurface(int measuringAxis, double direction);

/// A compared dimension in cycles with tool correction.
struct Dimension {
  double set = 0;        ///< programmed set value
  double actual = 0;     ///< measured
  int upperResult = 8;   ///< _OVR index of the upper tolerance limit
  int lowerResult = 12;  ///< _OVR index of the lower one
};

/// The set value of a dimension: the middle of its tolerance if tool correction uses one (_AMODE, S_TUL, S_TLL).
double setValueOf(const Context& context, Task task, double programmed);

/// What a size is compared with: its set value, and with a tolerance its limits and the verdict, which also counts for
/// the whole cycle. A hole too small can be reworked, one too large cannot; a spigot the other way round. The empirical
/// value is taken off first.
Compared comparedSize(Context& context, Task task, double set, double actual, Side side);
/// The same of the place of a surface that was touched in `direction` (+1, -1): short of its set value it can be
/// reworked.
Compared comparedSurface(Context& context, Task task, double set, double actual, double direction);

/// The empirical value that S_EVNUM selects; 0 without. Alarm 61319 for a number beyond 20.
double empiricalValue(Context& context);

/// Decides whether the tool is corrected, and corrects it, by S_TZL, S_TDIF, S_TUL, S_TLL, S_TMV, S_K, S_EVNUM: with
/// several dimensions (a rectangle) by the mean of their differences, with limits checked for each. Messages 61304,
/// 61305; alarm 61306. Fills the results of tool correction. S_TSA has been checked before.
void correctTool(Context& context, std::span<const Dimension> dimensions, const ToolInfluence& influence);

}  // namespace probewright::cycles::sinumerik
