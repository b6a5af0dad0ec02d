#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "control/heidenhain/control.hpp"
#include "execution/evaluation.hpp"
#include "language/klartext/heidenhain_program.hpp"

namespace probewright::execution::klartext {

struct HostOptions {
  /// Cycles that are not simulated are refused instead of skipped.
  bool strict = false;
  /// The bytes of a file that a program names: masks of FN 16, datum tables. Without it no such file is found.
  std::function<Result<std::string>(const std::string& name)> readFile;
  /// True if the run reads a file of this name where it would write it: FN 16 must not write over it.
  std::function<bool(const std::string& name)> isInput;
  /// Mid-program startup: the line of the main program whose block is the first that the machine carries out; 0: all
  /// are. What stands before it is counted only and measures nothing; then `scanEnds` brings the machine to where the
  /// program stands.
  std::uint64_t startLine = 0;
  std::function<void()> scanEnds = {};
};

/// Cycle 12 under way through the points of a pattern.
struct PatternRun {
  std::vector<Vector3> points;  ///< mm
  std::size_t next = 0;
  Vector3 shift = Vector3::Zero();  ///< the datum shift without them
  std::string program;
};

/// A program that is under way: the main program, and each that was called.
struct Level {
  const HeidenhainProgram* program = nullptr;
  std::string file;
  double outerUnit = 1;
  std::vector<std::optional<double>> local;  ///< QL
  std::optional<PatternRun> pattern;
};

/// What all parts of the host share: the control, the programs under way, the files beside them, and what the operator
/// is told.
class RunContext {
public:
  RunContext(control::heidenhain::Control& shared, HostOptions given) : control(shared), options(std::move(given)) {}

  control::heidenhain::Control& control;
  const HostOptions options;
  std::vector<Level> levels;
  std::string selectedProgram;         ///< of SEL PGM
  std::string cycleProgram;            ///< of cycle 12
  std::uint64_t work = 0;              ///< since Host::takeWork was asked
  bool scans = options.startLine > 0;  ///< the first block that is carried out has not been reached

  void message(std::string text);
  void warn(std::string text);
  /// Names what is not carried out, once in a run; refuses it under --strict.
  void leaveOut(const std::string& what);
  /// True the first time in a run that `what` is named.
  bool firstTime(const std::string& what) { return named_.insert(what).second; }

  /// A length in the unit of the program, in mm.
  double length(const Operand& operand, Evaluation& evaluation) const {
    return evaluation.number(operand) * control.unit;
  }
  /// A feed in the unit of the program, in mm/min.
  double feed(const Operand& operand, Evaluation& evaluation) const {
    return evaluation.number(operand) * control.feedUnit();
  }
  /// The index of the machine's axis. Throws Alarm if it has none of that name.
  std::size_t axisOf(char letter) const;
  /// The bytes of a file of the control: at its path, or by its name alone.
  Result<std::string> readHostFile(std::string_view path);
  /// The clock of the control, seconds since 1970.
  double machineSeconds() const {
    return static_cast<double>(control.wallClockStart) + control.channel.seconds() - control.startSeconds;
  }

private:
  std::set<std::string> named_;
};

/// The first word with this address, or null.
const Word* find(WordRange range, std::string_view address, Evaluation& evaluation);

/// The number of that word, or `otherwise` if there is none.
double numberOr(WordRange range, std::string_view address, double otherwise, Evaluation& evaluation);

/// The name of a file without the folders of the control: "TNC:\\LOG\\R.TXT" -> "R.TXT".
std::string fileNameOf(std::string_view path);

}  // namespace probewright::execution::klartext
