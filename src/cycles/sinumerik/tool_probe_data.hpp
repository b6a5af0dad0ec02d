#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "control/beliefs.hpp"
#include "control/sinumerik/data_store.hpp"
#include "control/working_plane.hpp"

/// The data fields of tool touch probes, setting data from SD 54625 (machine coordinates) and SD 54640 (workpiece
/// coordinates) on. CYCLE971 and CYCLE982 calibrate and read them.
namespace probewright::cycles::sinumerik {

/// The tens of S_MVAR.
enum class ProbeSystem { Machine, Workpiece };

/// The largest number of a data field.
inline constexpr int toolProbeFields = 6;

/// The name of a datum of the fields: "TRIG_MINUS_DIR_AX1" is $SNS_MEA_TP_TRIG_MINUS_DIR_AX1 or $SNS_MEA_TPW_...
std::string toolProbeDatum(ProbeSystem system, std::string_view what);
/// The name of a trigger point: of axis 0, 1, 2 of the plane, touched while the tool travels in the direction of
/// `sign`.
std::string toolProbeTrigger(ProbeSystem system, int axis, double sign);

/// One field. Axes: 1st, 2nd, 3rd axis of the plane.
///
/// A trigger point is where a tool without a radius would stand at the signal. Minus and plus are the directions in
/// which the tool travels: that of minus lies on the plus side of the contact.
struct ToolProbeField {
  std::array<double, 3> triggerMinus = {};  ///< mm
  std::array<double, 3> triggerPlus = {};   ///< mm
  double size = 0;                          ///< mm, diameter of the disc, or edge of the cube, at its top
  int directions = 0;                       ///< SD 54632, see approaches()
  int type = 0;                             ///< SD 54633: 0 cube, 101, 201, 301 a disc across Z, Y, X
  double depth = 0;                         ///< mm, of the tool's lower end below the top while its side touches
  double feed = 0;                          ///< mm/min, with which the field was calibrated; 0: never

  double trigger(int axis, double sign) const;
  /// The middle between the trigger points of an axis; with one of them alone half the size away from it.
  double centre(int axis) const;
  /// True if no axis has a trigger point.
  bool isEmpty() const;
  /// Whether a complete calibration may touch there. SD 54632 has a digit for each axis, units for the 1st: 0 not at
  /// all, 1 in minus, 2 in plus, 3 in both directions.
  bool approaches(int axis, double sign) const;
};

ToolProbeField toolProbeField(const control::sinumerik::DataStore& data, ProbeSystem system, int index);

/// Fills the fields from the first on with the probes as they were fitted and calibrated: the machine's ones, and where
/// the active zero offset is not turned, those of the workpiece in its coordinates.
/// `plane`: in which the probes are used, G17 on mills, G18 on lathes.
void enterToolProbes(control::sinumerik::DataStore& data, std::span<const control::BelievedToolProbe> probes,
                     const control::BelievedFrame* activeOffset, control::WorkingPlane plane);

}  // namespace probewright::cycles::sinumerik
