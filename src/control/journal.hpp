#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostic.hpp"
#include "control/event_list.hpp"
#include "control/interrupted_motion.hpp"
#include "control/result_kind.hpp"
#include "control/working_plane.hpp"
#include "geometry/primitives.hpp"
#include "machine/description.hpp"
#include "metrology/verdict.hpp"

/// What happened in a run, as plain data: written by the control and its cycles while they work, read by logs, results
/// and reports afterwards. Positions of programs are in the workpiece coordinate system that was active then.
namespace probewright::control {

/// One touch, or one attempt.
struct TouchRecord {
  Vector3 target = Vector3::Zero();      ///< expected point on the surface, workpiece coordinates
  Vector3 direction = Vector3::Zero();   ///< probing direction, unit, workpiece coordinates
  Vector3 ballCentre = Vector3::Zero();  ///< as the control believes it at the signal, workpiece coordinates
  Vector3 surface = Vector3::Zero();     ///< compensated point on the surface, workpiece coordinates
  Vector3 spindle = Vector3::Zero();     ///< tool reference point at the signal (HEIDENHAIN), workpiece coordinates
  machine::AxisPositions latched;        ///< axis positions at the signal
  double seconds = 0;                    ///< machine clock
  std::string outcome;                   ///< "touched", "no contact", "deflected", "collision"
  /// Workpiece coordinates from those of the table, as the control believes the coordinate system to lie at the touch.
  Eigen::Affine3d programFromTable = Eigen::Affine3d::Identity();
};

/// A line, circle, plane or sphere that a cycle laid through what it touched, by least squares. Coordinates count along
/// main axis, minor axis and tool axis of the working plane, in the program's coordinate system; mm.
struct FitRecord {
  std::string shape;                 ///< "line", "circle", "plane", "sphere"
  std::vector<std::size_t> touches;  ///< of each point the place of its (last) touch in the cycle's record
  std::vector<double> residuals;     ///< of each point its distance from the shape; positive outside, or on the left
  double formDeviation = 0;          ///< greatest less least residual
  int degreesOfFreedom = 0;          ///< points less freedoms of the shape; 0: it passes through every point
  std::vector<std::string_view> members;  ///< what `cofactors` counts: "centre.main", "radius"
  /// The members' covariance, row by row, where a point has the standard deviation 1 mm along the surface normal.
  std::vector<double> cofactors;
};

using metrology::Verdict;

/// A value that a cycle leaves in the control, under the control's own name.
struct ResultRecord {
  std::string name;     ///< "Q151", "_OVR[4]"
  std::string meaning;  ///< "actual value, centre in main axis"
  double value = 0;
  std::string unit;   ///< "mm", "deg", ""
  std::string label;  ///< of the characteristic alone: "centre in main axis"; may be empty
  ResultKind kind;
  std::optional<double> nominal, deviation, lowerLimit, upperLimit;
  std::optional<double> uncertainty;  ///< expanded, k = 2
  Verdict verdict = Verdict::None;
};

/// A change of a table, a parameter memory or a frame.
struct WriteRecord {
  std::string table;  ///< "PRESET.PR", "$P_UIFR"
  std::string entry;  ///< "row 5, column X", "[1,X,TR]"
  std::string before, after;
};

/// A parameter of a cycle call as it was used.
struct ParameterRecord {
  std::string name;   ///< "Q321", "S_MVAR"
  std::string value;  ///< as text, defaults filled in
  std::string meaning;
  bool isDefault = false;
  std::optional<double> number =
      std::nullopt;  ///< mm, mm/min, degrees, whatever unit the program counts in; none for texts
};

struct CycleRecord {
  std::string name;  ///< "411", "CYCLE977"
  std::string title;
  SourcePlace place;
  WorkingPlane plane;  ///< in which the cycle began
  std::vector<ParameterRecord> parameters;
  std::vector<TouchRecord> touches;
  std::vector<FitRecord> fits;
  std::vector<ResultRecord> results;
  std::vector<WriteRecord> writes;
  std::vector<std::string> logFiles;
  std::vector<std::string> screens;  ///< results as the control showed them: text of several lines, UTF-8
  std::string alarm;                 ///< code and text if the cycle ended with one
  Verdict verdict = Verdict::None;
  double startSeconds = 0, endSeconds = 0;
  double pathLength = 0;  ///< mm travelled by the tool within the cycle
};

/// The record of one run. Cycles in the order they ran; writes outside cycles (FN 17, CYCL DEF 247...) in `writes`.
///
/// A program in an endless loop must not fill the memory of the computer: what is entered through the functions below
/// counts against `limit`, and the entry that goes beyond it throws RecordFull, once.
struct Journal {
  std::vector<CycleRecord> cycles;
  EventList events;
  std::deque<WriteRecord> writes;
  std::deque<InterruptedMotion> interrupted;
  bool cycleOpen = false;  ///< the last of `cycles` is running

  std::uint64_t limit = 0;  ///< bytes of memory that a run may leave; 0: any
  std::uint64_t used = 0;   ///< bytes that count against it

  /// Where the program's coordinates lie on the table at the measuring move under way; the channel keeps it up.
  Eigen::Affine3d programFromTable = Eigen::Affine3d::Identity();

  /// The cycle that runs, or null.
  CycleRecord* open() { return cycleOpen ? &cycles.back() : nullptr; }

  /// A cycle begins and is the open one from here on.
  void begin(CycleRecord record);
  /// The touch goes to the open cycle, with the coordinate system of the measuring move; without a cycle it is
  /// forgotten. Returns its place among the cycle's touches.
  std::size_t touch(TouchRecord record);
  /// The same of a fit.
  void fit(FitRecord record);
  /// The change goes to the open cycle, or to `writes`.
  void write(WriteRecord record);
  void event(const EventRecord& record);
  void interrupt(InterruptedMotion motion);

  /// Something else that the run leaves grows by so many bytes, a file for instance.
  void charge(std::uint64_t bytes);

private:
  bool full_ = false;  ///< RecordFull was thrown
};

}  // namespace probewright::control
