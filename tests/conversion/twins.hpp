#pragma once

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
  machine::AxisPositions axes;  ///< at the end

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
  if (outcome.machine) twin.axes = outcome.machine->position();
  twin.journal = std::move(outcome.journal);
  twin.files = std::move(outcome.files);
  return twin;
}

/// Blocks with the frame of a Klartext program.
inline std::string klartextProgram(const std::string& blocks) {
  return "BEGIN PGM BENCH MM\nTOOL CALL 1 Z\nL Z+100 R0 FMAX\n" + blocks + "END PGM BENCH MM\n";
}

/// A result by its names on both controls.
struct Counterpart {
  std::string heidenhain, sinumerik;
};

/// Two ends of the same measurement: what was measured and where the origin lies.
inline void expectSame(const Twin& one, const Twin& other, const std::vector<Counterpart>& results,
                       double exact = 1e-6) {
  for (const Counterpart& each : results) {
    const bool sameVendor = std::isnan(other.result(each.sinumerik));
    EXPECT_NEAR(one.result(each.heidenhain), other.result(sameVendor ? each.heidenhain : each.sinumerik), exact)
        << each.heidenhain;
  }
  const Pose difference = one.machineFromWorkpiece.inverse() * other.machineFromWorkpiece;
  EXPECT_LT(difference.translation().norm(), exact);
  EXPECT_LT((difference.linear() - Eigen::Matrix3d::Identity()).norm(), 1e-8);
}

/// Runs a Klartext program, its twin and the twin's twin in the part's world.
inline void expectTwins(const std::string& klartext, const PlantedPart& part, const std::vector<Counterpart>& results,
                        bool andBack = true) {
  const std::string sinumerik = toSinumerik(klartext);
  const std::string again = andBack ? toKlartext(sinumerik) : std::string();
  SCOPED_TRACE(fmt::format("{}\n{}\n{}", klartext, sinumerik, again));
  const Twin original = runTwin(klartext, part.bench.setup, ControlKind::TNC640);
  const Twin there = runTwin(sinumerik, part.bench.setup, ControlKind::Sinumerik840Dsl);
  ASSERT_TRUE(original.finished) << original.why;
  ASSERT_TRUE(there.finished) << there.why;
  expectSame(original, there, results);
  if (!andBack) return;
  const Twin back = runTwin(again, part.bench.setup, ControlKind::TNC640);
  ASSERT_TRUE(back.finished) << back.why;
  expectSame(original, back, results);
}

/// Runs a SINUMERIK program and its twin in the part's world.
inline void expectTwinOfSinumerik(const std::string& sinumerik, const PlantedPart& part,
                                  const std::vector<Counterpart>& results) {
  const std::string klartext = toKlartext(sinumerik);
  SCOPED_TRACE(fmt::format("{}\n{}", sinumerik, klartext));
  const Twin original = runTwin(sinumerik, part.bench.setup, ControlKind::Sinumerik840Dsl);
  const Twin there = runTwin(klartext, part.bench.setup, ControlKind::TNC640);
  ASSERT_TRUE(original.finished) << original.why;
  ASSERT_TRUE(there.finished) << there.why;
  expectSame(there, original, results);
}

}  // namespace probewright::testing_support
