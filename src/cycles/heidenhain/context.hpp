#pragma once

#include <optional>
#include <string>
#include <vector>

#include "control/heidenhain/control.hpp"
#include "cycles/catalogue.hpp"
#include "cycles/heidenhain/registry.hpp"
#include "probing/heidenhain_prober.hpp"
#include "probing/heidenhain_strategies.hpp"

/// What HEIDENHAIN cycles are written with.
///
/// Coordinates are (main axis, minor axis, touch probe axis) of the active program coordinate system, mm and degrees:
/// values of arguments are converted at this border in inch programs, results in inch main programs.
namespace probewright::cycles::heidenhain {

using control::Verdict;
using control::heidenhain::Control;
using probing::EvaluatedTouch;
using probing::PlannedTouch;
using probing::Side;

class Context {
public:
  /// Opens the cycle's record in the journal.
  Context(Control& control, const Entry& entry, const Arguments& arguments, SourcePlace place);
  /// Closes it.
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  Control& control() { return control_; }
  control::Channel& channel() { return control_.channel; }
  const Entry& entry() const { return entry_; }
  const Arguments& arguments() const { return arguments_; }
  control::CycleRecord& record() { return control_.journal.cycles[record_]; }

  /// The argument Qn: lengths and feeds in mm, mm/min, whatever the program's unit.
  double q(int number) const;
  bool given(int number) const { return arguments_.given(static_cast<std::uint32_t>(number)); }
  int option(int number) const { return arguments_.integer(static_cast<std::uint32_t>(number)); }

  /// Refuses to run where the entry's conditions are not met. If all is well and the cycle probes, the data of the
  /// touch probe come into effect. runCycle() calls it before the cycle.
  void requireConditions();

  /// The prober with the active probe's data. Made on first use.
  probing::HeidenhainProber& prober();

  /// Machine coordinates (REF) from program coordinates, with the rotary axes of the table where they stand now. Linear
  /// axes count alike whether they move the table or the tool.
  Eigen::Affine3d machineFromProgram();

  /// Sets Qn (mm or degrees; converted to the main program's unit) and records it as a result.
  void result(int number, double value, const Compared& compared = {});
  /// Sets Qn without recording: states and counters.
  void set(int number, double value) { control_.q.setQ(number, value); }

  /// A remark on the run that stops nothing.
  void warn(std::string text) {
    control_.panel.message(control::EventKind::Warning, std::move(text), channel().seconds());
  }

  /// The operator sees the text on the screen and the program waits for NC start.
  void stop(const std::string& text);

  /// "TCHPR421.TXT": writes it as the cycle's log.
  void log(const std::string& name, const std::string& text);

private:
  Control& control_;
  const Entry& entry_;
  const Arguments& arguments_;
  std::size_t record_ = 0;
  std::optional<probing::HeidenhainProber> prober_;
};

/// Runs cycle `entry` with `arguments` at `place`: checks the arguments and conditions, opens the record, runs, closes.
/// An alarm is noted in the record and thrown on.
void runCycle(Control& control, const Entry& entry, const Arguments& arguments, const SourcePlace& place);

/// The probe stands square to the working plane: the rotary axes as the tilt (or its absence) asks.
bool rotaryAxesMatchTilt(const Control& control);

enum class Calibrated { Required, NotYet };

/// The probe as tables, machine parameters and cycle 441 describe it. Throws Alarm if the active tool is none, or is
/// not calibrated although it must be.
probing::HeidenhainProbe activeProbe(const Control& control, Calibrated calibrated = Calibrated::Required);

/// How the probe travels between points, as Q301 says.
probing::Between betweenOf(const Context& context);

/// Turns the spindle to CAL_ANG where it can be oriented, unless the probe is turned to every touch anyway.
void orientToCalibration(control::Channel& channel, const probing::HeidenhainProbe& probe);

}  // namespace probewright::cycles::heidenhain
