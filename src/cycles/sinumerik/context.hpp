#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "control/sinumerik/control.hpp"
#include "cycles/catalogue.hpp"
#include "cycles/sinumerik/registry.hpp"
#include "probing/sinumerik_prober.hpp"
#include "probing/touch_plan.hpp"

/// What SINUMERIK measuring cycles are written with.
///
/// Coordinates are (1st, 2nd, 3rd axis of the plane) of the active workpiece coordinate system, mm and degrees: values
/// of arguments and results are converted at this border in inch programs.
namespace probewright::cycles::sinumerik {

using control::Verdict;
using control::sinumerik::Control;
using probing::MeasuredPoint;
using probing::Side;

/// Workpiece and tool measurement have bits of their own in SD 54740 and SD 55740: from bit 0, from bit 16 on.
enum class Measures { Workpieces, Tools };

class Context {
public:
  /// Opens the cycle's record, clears _OVR and _OVI, and selects the plane that _DMODE asks for. `spindlePositioned`
  /// is called after each positioning of the spindle, where bit 6 of SD 55740 asks for it.
  Context(Control& control, const Entry& entry, const Arguments& arguments, SourcePlace place,
          const std::function<void()>& spindlePositioned = {});
  /// Closes the record and restores the plane (PROC ... SAVE).
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  Control& control() { return control_; }
  const Control& control() const { return control_; }
  control::Channel& channel() { return control_.channel; }
  const Arguments& arguments() const { return arguments_; }
  control::CycleRecord& record() { return control_.journal.cycles[record_]; }

  /// Call parameters by name: "S_FA". Lengths and feeds in mm, mm/min.
  double real(std::string_view name) const;
  int integer(std::string_view name) const;
  const std::string& text(std::string_view name) const;
  bool given(std::string_view name) const;
  bool has(std::string_view name) const;
  /// Decimal digit of a coded integer, counted from the right from 1: digit("S_MVAR", 1) is the units.
  int digit(std::string_view name, int place) const;

  /// The probe number as an index, S_PRNUM - 1; 0 or left out counts as 1. Alarm 61313 outside 1 to 12.
  int dataSet() const;

  /// Refuses to run without a probe of one of `types` (61309), and what requireReady() refuses.
  void requireProbe(std::initializer_list<int> types) const;
  /// Refuses to run without a tool offset (61311), with radius compensation on (61300), with a scale factor (61310), or
  /// called too deep (61300). Mirrored systems belong to counter-spindles.
  enum class Mirrored { Refused, Allowed };
  void requireReady(Mirrored mirrored) const;

  /// Refuses to measure with a data set that was never calibrated (61341), unless the machine data say not to watch it.
  void requireCalibration() const;
  /// S_MA as an index 0, 1, 2; alarm 61325 for an axis beyond the first `count`.
  int measuringAxis(int count);

  /// The prober with the calibration of data set S_PRNUM. Made on first use.
  probing::SinumerikProber& prober();
  /// Positions the spindle, as SPOS does: the tool spindle, on lathes the main spindle.
  void positionSpindle(double degrees);
  /// Measurements at one place, S_NMSP; 0 counts as 1.
  int repetitions() const;

  /// Sets _OVR[index] (mm or degrees, converted to the program's unit) and records it.
  void result(int index, double value, const Compared& compared = {});
  /// Records which variant ran with which probe: _OVI[3], _OVI[5].
  void noteCall();
  /// Sets _OVI[index] and records it.
  void resultInteger(int index, int value);

  /// What _OVI[12] tells if an alarm comes from here on: the part of the task that failed. 0: nothing.
  void markFailing(int part) { failing_ = part; }
  int failingPart() const { return failing_; }

  /// Sets _OVS_TNAME, the name of the tool that was corrected.
  void correctedTool(const std::string& name);

  /// Alarm 61303 if `difference` exceeds the safe area, `factor` times S_TSA.
  void checkSafeArea(double difference, double factor = 1);

  /// Where the machine repeats measurements (bit 0 of SD 54740, for tools 16), drops what was measured and begins the
  /// cycle again, at most four times; with bit 1, for tools 17, only after a message with the alarm's number and NC
  /// start. Nothing may have been corrected yet.
  void repeatIfAsked(int number, const std::string& detail);
  /// How the probe gets clear of the workpiece before a repetition; then it goes straight to where the cycle started.
  /// Called by repeatIfAsked, if the measurement is repeated.
  void setWayBack(std::function<void()> way) { wayBack_ = std::move(way); }
  /// Ready for the repetition.
  void beginAgain();

  /// The alarm with its number and the control's text. Every alarm that ends a cycle sets _OVI[9].
  [[noreturn]] void alarm(int number, const std::string& detail = {});
  /// A message that lets the program go on: oversize, undersize. Sets _OVI[9].
  void warn(int number, const std::string& detail = {});
  /// Waits for NC start where the machine stops for exceeded tolerances (bit 2 of SD 54740, for tools 18).
  void stopOutOfTolerance(const std::string& text);

  /// Tools where the cycle is of that family.
  Measures measures() const;

private:
  void clearResults();
  /// A bit of SD 54740 that workpiece and tool measurement both have.
  bool habit(int bit) const;

  Control& control_;
  const Arguments& arguments_;
  std::size_t record_ = 0;
  int planeBefore_ = 17;
  ProgramPlace start_;
  int repetitionsLeft_ = 0;
  int failing_ = 0;
  std::function<void()> wayBack_;
  std::function<void()> spindlePositioned_;
  std::optional<probing::SinumerikProber> prober_;
};

/// Runs cycle `entry` with `arguments` at `place`: skipped in dry run, program test and block search; otherwise checks
/// the arguments, opens the record, runs, closes. An alarm is noted in the record and thrown on. `spindlePositioned`:
/// see Context.
void runCycle(Control& control, const Entry& entry, const Arguments& arguments, const SourcePlace& place,
              const std::function<void()>& spindlePositioned = {});

/// Calibration data set `index` (from 0) with what the active tool says.
probing::SinumerikProbe probeOfDataSet(const Control& control, int index);
probing::SinumerikHabits habitsOf(const Control& control, Measures what = Measures::Workpieces);

/// The control's text for an alarm of the measuring cycles: "Safe area exceeded". Empty for an unknown number.
std::string_view alarmText(int number);
std::string_view alarmAdvice(int number);

}  // namespace probewright::cycles::sinumerik
