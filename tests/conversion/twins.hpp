#pragma once

#include <fstream>

#include "control/sinumerik/data_store.hpp"
#include "control/sinumerik/init_text.hpp"
#include "cycles_heidenhain/worlds.hpp"
#include "session/convert.hpp"
#include "session/run.hpp"
#include "session/source.hpp"

/// Programs and their conversions in the same worlds.
namespace probewright::testing_support {

using session::ProgramLanguage;

/// The program in the other language; nothing may be lost.
inline std::string converted(const std::string& text, ProgramLanguage from, ProgramLanguage to) {
  const auto program = session::programOf(from == ProgramLanguage::Sinumerik ? "BENCH.MPF" : "BENCH.H", text, from);
  const session::Conversion conversion = session::convert(*program, from, to);
  for (const Diagnostic& mistake : conversion.mistakes)
    ADD_FAILURE() << format(mistake) << "\n" << text;
  for (const Diagnostic& lost : conversion.notCarriedOver)
    ADD_FAILURE() << format(lost);
  return conversion.text;
}
inline std::string toSinumerik(const std::string& text) {
  return converted(text, ProgramLanguage::Klartext, ProgramLanguage::Sinumerik);
}
inline std::string toKlartext(const std::string& text) {
  return converted(text, ProgramLanguage::Sinumerik, ProgramLanguage::Klartext);
}

/// What both controls believe at the end, and what was measured on the way.
struct Twin {
  bool finished = false;
  std::string why;
  Pose machineFromWorkpiece = Pose::Identity();
  control::Journal journal;
  std::map<std::string, std::string> files;

  /// Where a place of the machine lies in the workpiece system at the end.
  Vector3 seen(const Vector3& machinePoint) const { return machineFromWorkpiece.inverse() * machinePoint; }
  /// A result of the last cycle that has it, by its name on the control.
  double result(std::string_view name) const {
    for (auto cycle = journal.cycles.rbegin(); cycle != journal.cycles.rend(); ++cycle) {
      for (const control::ResultRecord& each : cycle->results)
        if (each.name == name) return each.value;
    }
    return std::nan("");
  }
};

/// The setup with the zero offsets that are the twins of its presets.
inline simulation::Setup twinSetup(const simulation::Setup& setup) {
  simulation::Setup twin = setup;
  twin.zeroOffsets = setup.presets;
  for (simulation::BelievedFrame& frame : twin.zeroOffsets)
    if (frame.index == 0) frame.index = 99;
  return twin;
}

inline Twin runTwin(const std::string& text, const simulation::Setup& setup, ControlKind control) {
  session::RunOptions options;
  options.control = control;
  options.recordPath = false;
  const char* name = control::isHeidenhain(control) ? "BENCH.H" : "BENCH.MPF";
  session::RunOutcome outcome = session::runText(name, text, twinSetup(setup), options);
  Twin twin;
  twin.finished = outcome.diagnostics.empty() && outcome.result.end == language::RunEnd::Finished;
  if (!outcome.diagnostics.empty()) {
    twin.why = format(outcome.diagnostics.front());
  } else if (!outcome.result.diagnostics.empty()) {
    twin.why = format(outcome.result.diagnostics.front());
  }
  twin.machineFromWorkpiece = outcome.machineFromWorkpiece.value_or(Pose::Identity());
  twin.journal = std::move(outcome.journal);
  twin.files = std::move(outcome.files);
  return twin;
}

/// Blocks with the frame of a Klartext program.
inline std::string klartextProgram(const std::string& blocks) {
  return "BEGIN PGM BENCH MM\nTOOL CALL 1 Z\nL Z+100 R0 FMAX\n" + blocks + "END PGM BENCH MM\n";
}

}  // namespace probewright::testing_support
