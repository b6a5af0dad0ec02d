#pragma once

#include <fmt/format.h>

#include "cycles/catalogue.hpp"
#include "cycles_heidenhain/worlds.hpp"
#include "session/convert.hpp"
#include "session/source.hpp"
#include "setup/simulated_run.hpp"

/// Programs and their conversions in the same worlds.
namespace probewright::testing_support {

using session::ProgramLanguage;

inline constexpr double exactly = 1e-6;  ///< mm, degrees

inline ProgramLanguage otherLanguage(ProgramLanguage language) {
  return language == ProgramLanguage::Klartext ? ProgramLanguage::Sinumerik : ProgramLanguage::Klartext;
}

/// `control`: to write for, if it is to be a HEIDENHAIN control.
inline conversion::Conversion converted(const std::string& text, ProgramLanguage from,
                                        ControlKind control = ControlKind::TNC640,
                                        const conversion::TouchProbe& probe = {}) {
  const auto program = session::programOf(from == ProgramLanguage::Sinumerik ? "BENCH.MPF" : "BENCH.H", text, from);
  return conversion::convert(*program, from, otherLanguage(from),
                             {.globalData = {}, .control = control, .probe = probe});
}
inline conversion::Conversion toSinumerik(const std::string& text) {
  return converted(text, ProgramLanguage::Klartext);
}
inline conversion::Conversion toKlartext(const std::string& text) {
  return converted(text, ProgramLanguage::Sinumerik);
}

/// A program with its run: what was measured on the way, what the control believes at the end, where the probe stands.
struct Twin {
  std::string text;
  ProgramLanguage language = ProgramLanguage::Klartext;
  Diagnostics lost;   ///< by the conversion that gave the text
  Diagnostics notes;  ///< of the same
  bool finished = false;
  std::string why;
  Pose machineFromWorkpiece = Pose::Identity();
  control::Journal journal;
  std::map<std::string, std::string> files;
  machine::AxisPositions axes;  ///< at the end
  double seconds = 0;           ///< that the run takes on the machine

  /// A result of the last cycle that has it, by its name on the control.
  double result(std::string_view name) const {
    for (auto cycle = journal.cycles.rbegin(); cycle != journal.cycles.rend(); ++cycle) {
      for (const control::ResultRecord& each : cycle->results)
        if (each.name == name) return each.value;
    }
    return std::nan("");
  }
};

/// The positions of X, Y and Z that were latched, in their order.
inline std::vector<Vector3> touchesOf(const Twin& twin) {
  std::vector<Vector3> found;
  for (const control::CycleRecord& cycle : twin.journal.cycles)
    for (const control::TouchRecord& touch : cycle.touches)
      if (touch.outcome == "touched") found.emplace_back(touch.latched[0], touch.latched[1], touch.latched[2]);
  return found;
}

/// The setup with the zero offsets that are the twins of its presets.
inline setup::Setup twinSetup(const setup::Setup& setup) {
  setup::Setup twin = setup;
  twin.beliefs.zeroOffsets = setup.beliefs.presets;
  for (control::BelievedFrame& frame : twin.beliefs.zeroOffsets)
    if (frame.index == 0) frame.index = 99;
  return twin;
}

/// What a run has left.
inline Twin twinOf(setup::SimulatedRun run) {
  session::RunOutcome& outcome = run.outcome;
  Twin twin;
  twin.finished = !hasErrors(outcome.diagnostics) && outcome.result.end == execution::RunEnd::Finished;
  if (hasErrors(outcome.diagnostics)) {
    twin.why = format(outcome.diagnostics.front());
  } else if (!outcome.result.diagnostics.empty()) {
    twin.why = format(outcome.result.diagnostics.front());
  }
  twin.machineFromWorkpiece = outcome.machineFromWorkpiece.value_or(Pose::Identity());
  if (run.machine) twin.axes = run.machine->position();
  if (run.machine) twin.seconds = run.machine->seconds();
  twin.journal = std::move(outcome.journal);
  twin.files = std::move(outcome.files);
  return twin;
}

inline Twin run(const std::string& text, ProgramLanguage language, const PlantedPart& part) {
  const bool heidenhain = language == ProgramLanguage::Klartext;
  session::RunOptions options;
  options.control = heidenhain ? part.bench.control : ControlKind::Sinumerik840Dsl;
  Twin twin = twinOf(setup::runText(heidenhain ? "BENCH.H" : "BENCH.MPF", text, twinSetup(part.bench.setup), options,
                                    {.recordPath = false}));
  twin.text = text;
  twin.language = language;
  return twin;
}
inline Twin runKlartext(const std::string& text, const PlantedPart& part) {
  return run(text, ProgramLanguage::Klartext, part);
}
inline Twin runSinumerik(const std::string& text, const PlantedPart& part) {
  return run(text, ProgramLanguage::Sinumerik, part);
}

/// Counts for the exit code. How far the surfaces of these worlds are off is known: both probes look far enough for
/// them. So is that either posture of the rotary axes reaches what is measured.
inline bool isLoss(const Diagnostic& listed) {
  return listed.severity != Severity::Note && listed.message.find("looks for the surface") == std::string::npos &&
         listed.message.find("SEQ") == std::string::npos;
}

/// A message of what is listed contains the text.
inline bool lists(const conversion::Conversion& conversion, std::string_view text) {
  return std::ranges::any_of(conversion.notCarriedOver, [&](const Diagnostic& each) {
    return each.severity != Severity::Note && each.message.find(text) != std::string::npos;
  });
}

/// What counts for the exit code.
inline Diagnostics warningsOf(const conversion::Conversion& conversion) {
  Diagnostics warnings = conversion.notCarriedOver;
  std::erase_if(warnings, [](const Diagnostic& each) { return each.severity == Severity::Note; });
  return warnings;
}

/// The program in the other language, run in the same world.
inline Twin runConverted(const Twin& twin, const PlantedPart& part, const conversion::TouchProbe& probe = {}) {
  conversion::Conversion conversion = converted(twin.text, twin.language, part.bench.control, probe);
  Twin other = run(conversion.text, otherLanguage(twin.language), part);
  other.lost = std::move(conversion.mistakes);
  for (Diagnostic& each : conversion.notCarriedOver)
    if (isLoss(each)) {
      other.lost.push_back(std::move(each));
    } else if (each.severity == Severity::Note) {
      other.notes.push_back(std::move(each));
    }
  return other;
}

/// Leaves out of what is listed that verdicts are told by a message only.
inline Twin withoutVerdict(Twin twin) {
  std::erase_if(twin.lost, [](const Diagnostic& each) {
    return each.message.find("verdict") != std::string::npos || each.message.find("judges") != std::string::npos ||
           each.message.find("SETAL(67000)") != std::string::npos;
  });
  return twin;
}

/// The program ran to its end, and its conversion has lost nothing.
inline ::testing::AssertionResult ranWhole(const Twin& twin) {
  if (!twin.lost.empty()) return ::testing::AssertionFailure() << format(twin.lost.front()) << "\n" << twin.text;
  if (!twin.finished) return ::testing::AssertionFailure() << twin.why << "\n" << twin.text;
  return ::testing::AssertionSuccess();
}

/// A result by its names on both controls.
struct Counterpart {
  std::string heidenhain, sinumerik;
  const std::string& on(ProgramLanguage language) const {
    return language == ProgramLanguage::Klartext ? heidenhain : sinumerik;
  }
};

/// Both controls have the same results.
inline ::testing::AssertionResult sameResults(const Twin& one, const Twin& other,
                                              const std::vector<Counterpart>& results) {
  for (const Counterpart& each : results) {
    const double first = one.result(each.on(one.language)), second = other.result(each.on(other.language));
    if (!(std::abs(first - second) < exactly)) {
      return ::testing::AssertionFailure() << each.on(one.language) << " = " << fmt::format("{:.9f}", first) << ", "
                                           << each.on(other.language) << " = " << fmt::format("{:.9f}", second) << "\n"
                                           << one.text << "\n"
                                           << other.text;
    }
  }
  return ::testing::AssertionSuccess();
}

/// Both programs touch at the same places, in any order, or a note of the conversion that gave `other` tells that they
/// do not.
inline ::testing::AssertionResult touchesAgreeOrToldOf(const Twin& one, const Twin& other) {
  const bool told = std::ranges::any_of(other.notes, [](const Diagnostic& each) {
    return each.message.find("touches lie at other places") != std::string::npos ||
           each.message.find("is touched twice") != std::string::npos;
  });
  if (told) return ::testing::AssertionSuccess();
  std::vector<Vector3> left = touchesOf(other);
  for (const Vector3& touch : touchesOf(one)) {
    const auto same = std::ranges::find_if(left, [&](const Vector3& each) { return (each - touch).norm() < 1e-5; });
    if (same == left.end()) {
      return ::testing::AssertionFailure()
             << fmt::format("only one touches at {:.6f} {:.6f} {:.6f}\n", touch.x(), touch.y(), touch.z()) << one.text
             << "\n"
             << other.text;
    }
    left.erase(same);
  }
  if (left.empty()) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << left.size() << " touches more\n" << one.text << "\n" << other.text;
}

/// What the tools' corrections are at the end, by length and radius: of tool 5, "MILL".
inline std::array<double, 2> correctionsOfTool(const Twin& twin) {
  if (twin.language == ProgramLanguage::Klartext) {
    Diagnostics diagnostics;
    const auto table = control::heidenhain::TypedTable::parse(twin.files.at("TOOL.T"), "TOOL.T",
                                                              control::heidenhain::toolColumns(), diagnostics);
    return {table->numberOr("5", "DL", 0), table->numberOr("5", "DR", 0)};
  }
  const auto wear = [&](const char* name) {
    const std::string& text = twin.files.at("TOOLS.TOA");
    const std::size_t at = text.find(fmt::format("{}[5,1]=", name));
    return at == std::string::npos ? 0 : std::stod(text.substr(text.find('=', at) + 1));
  };
  return {wear("$TC_DP12"), wear("$TC_DP15")};
}

/// Both controls have corrected the tool alike, as far as TOOL.T tells it: four decimals at each of the `corrections`.
inline ::testing::AssertionResult sameTool(const Twin& one, const Twin& other, int corrections = 1) {
  const auto first = correctionsOfTool(one), second = correctionsOfTool(other);
  for (std::size_t i = 0; i < 2; ++i) {
    if (std::abs(first[i] - second[i]) < corrections * 0.5001e-4) continue;
    return ::testing::AssertionFailure() << fmt::format("{} of the tool: {:.6f} and {:.6f}\n",
                                                        i == 0 ? "length" : "radius", first[i], second[i])
                                         << one.text << "\n"
                                         << other.text;
  }
  return ::testing::AssertionSuccess();
}

/// Both controls have their origin at the same place, turned alike.
inline ::testing::AssertionResult sameOrigin(const Twin& one, const Twin& other) {
  const Pose difference = one.machineFromWorkpiece.inverse() * other.machineFromWorkpiece;
  const double turned = (difference.linear() - Eigen::Matrix3d::Identity()).norm();
  if (difference.translation().norm() < exactly && turned < 1e-8) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << fmt::format("shifted by {:.9f} {:.9f} {:.9f}, turned by {:.3g}\n",
                                                      difference.translation().x(), difference.translation().y(),
                                                      difference.translation().z(), turned)
                                       << one.text << "\n"
                                       << other.text;
}

/// Both machines stand at the same place, linear and rotary axes; whole turns do not count.
inline ::testing::AssertionResult sameEnd(const Twin& one, const Twin& other) {
  for (std::size_t i = 0; i < one.axes.values.size(); ++i) {
    double apart = one.axes[i] - other.axes[i];
    if (i >= 3) apart = std::remainder(apart, 360);  // rotary axes stand behind X, Y and Z
    if (std::abs(apart) < exactly) continue;
    return ::testing::AssertionFailure() << fmt::format("axis {}: {:.9f} and {:.9f}\n", i, one.axes[i], other.axes[i])
                                         << one.text << "\n"
                                         << other.text;
  }
  return ::testing::AssertionSuccess();
}

/// Blocks with the frame of a Klartext program.
inline std::string klartextProgram(const std::string& blocks) {
  return "BEGIN PGM BENCH MM\nTOOL CALL 1 Z\nL Z+100 R0 FMAX\n" + blocks + "END PGM BENCH MM\n";
}

using Named = std::vector<std::pair<std::string, double>>;

/// A call of a SINUMERIK cycle with its arguments by name. S_TNAME is the number of a tool, 0: "MILL".
inline std::string sinumerikCall(const std::string& cycle, const Named& arguments) {
  const cycles::CycleDefinition* definition = cycles::sinumerikCycle(cycle);
  std::vector<std::string> places(definition->parameters.size());
  for (const auto& [name, value] : arguments) {
    const auto parameter = std::find_if(definition->parameters.begin(), definition->parameters.end(),
                                        [&](const cycles::Parameter& each) { return each.name == name; });
    EXPECT_NE(parameter, definition->parameters.end()) << cycle << " has no " << name;
    if (name == "S_TNAME") {
      places[parameter->address] = value == 0 ? "\"MILL\"" : fmt::format("\"{:.0f}\"", value);
      continue;
    }
    places[parameter->address] =
        value == std::round(value) ? fmt::format("{:.0f}", value) : fmt::format("{:.6f}", value);
  }
  while (places.back().empty())
    places.pop_back();
  return fmt::format("{}({})\n", cycle, fmt::join(places, ","));
}

}  // namespace probewright::testing_support
