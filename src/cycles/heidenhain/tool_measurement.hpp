#pragma once

#include <optional>
#include <vector>

#include "cycles/heidenhain/call_rules.hpp"
#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/tool_measuring_settings.hpp"
#include "probing/tool_prober.hpp"

/// How cycles 480 to 484, and 30 to 33, measure with the tool touch probe TT.
namespace probewright::cycles::heidenhain {

inline constexpr Conditions toolConditions = {
    .uses = Uses::ToolTouchProbe, .under = Transformed::ByShiftOrRotation, .tilted = control::onITNC530};

/// Spindle speed (rpm) and probing feed (mm/min) for a rotating tool of `radius` (mm), from the permissible speed of
/// its circumference and the permissible measuring error.
struct ToolProbingSpeeds {
  double spindle = 0;
  double feed = 0;
  double fineFeed = 0;  ///< of a second touch; 0: there is none
};
ToolProbingSpeeds toolProbingSpeeds(const control::heidenhain::MachineParameters& parameters, double radius);

/// The tool touch probe as parameters and calibration say. Throws Alarm if the parameters do not say where it is.
enum class Contact { AsFitted, Calibrated };
probing::ToolTouchProbe toolTouchProbe(const Control& control, Contact contact);

/// The side of the contact that tools are measured at: the axis, main (0) or minor (1), and the direction along it.
struct ProbingSide {
  int axis = 0;
  int sense = 1;
};
ProbingSide probingSide(const control::heidenhain::MachineParameters& parameters);

/// What is asked of cycles 481 to 483 and 31 to 33.
struct ToolRequest {
  int mode = 0;  ///< 0 measure, 1 check, 2 compare
  double clearanceHeight = 0;
  bool teeth = false;
  std::optional<int> status;  ///< number of the Q parameter that receives the status
};
ToolRequest newRequest(Context& context);
ToolRequest oldRequest(Context& context);

/// What `check` finds in a call, too: what the iTNC 530 cannot do with the measured value.
void toolRules(CallRules& call);

/// Status of a deviation: 0 within the tolerances, 1 worn, 2 broken; a tolerance of 0 is none.
int toolStatus(double deviation, double wear, double breakage);
/// How displays of tool measurement mark a value: * is beyond the wear tolerance, B beyond that of breakage.
const char* statusMark(int status);

/// Refuses what cannot be measured: no tool, a touch probe, a turning tool.
void requireMeasurable(Context& context);

enum class ToolDimensions { Length, Radius, Both };

/// All of cycles 481 to 483.
void measureTool(Context& context, const ToolRequest& request, ToolDimensions dimensions);

/// A length or radius as measured: with a rotating or stationary tool, or tooth by tooth.
struct ToolDimension {
  std::optional<double> whole;
  std::vector<double> teeth;
  /// What counts: the longest, largest.
  double value() const;
};

class ToolMeasurement {
public:
  ToolMeasurement(Context& context, const ToolRequest& request);

  void measureLength();
  void measureRadius();
  /// Back to the clearance height, the spindle stands; tables, Q parameters, status, screen. Throws Alarm where the
  /// control stops the program.
  void finish();

private:
  void turn();
  void stand();
  void orientTo(double tooth);
  probing::ToolTouch side();
  probing::ToolTouch above(double offset);
  /// Touches, and again more slowly where a second touch of the rotating tool is to count.
  template <class Touch>
  probing::ToolTouch touched(const Touch& touch);
  double lengthAt(const probing::ToolTouch& touch) const;
  double radiusAt(const probing::ToolTouch& touch) const;
  double toothLengthOffset() const;
  void findTeeth(const probing::ToolTouch& touch);
  enum class Of { Length, Radius };
  int enter(const ToolDimension& dimension, Of of);
  void stopIfBroken(int status) const;
  void show(const ToolDimension& dimension, Of of);
  double column(control::heidenhain::NumberColumn name) const;

  Context& context_;
  ToolRequest request_;
  control::Channel& channel_;
  ToolMeasuringSettings settings_;
  probing::ToolTouchProbe probe_;
  probing::ToolProber prober_;
  int axis_ = 0, sense_ = 1;  ///< of radial probing
  int teeth_ = 0;
  double radius_ = 0;
  ToolProbingSpeeds speeds_;
  bool turns_ = false;
  std::optional<double> firstTooth_;  ///< spindle angle with which a tooth points to the contact
  std::optional<ToolDimension> length_, measuredRadius_;
  std::string screen_;
};

}  // namespace probewright::cycles::heidenhain
