#pragma once

#include <bitset>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.hpp"
#include "control/beliefs.hpp"
#include "control/control_kind.hpp"
#include "control/dialog_language.hpp"
#include "cycles/catalogue.hpp"
#include "language/program.hpp"
#include "language/program_language.hpp"
#include "machine/machine.hpp"

/// Everything that makes one vendor's controls different from another's, as one entry of a table. Whatever a family is
/// asked for beyond that, it answers like all others; nothing outside of its entry asks which family a control is of.
namespace probewright::conversion {
struct ConvertOptions;
}

namespace probewright::session {

class HostFiles;
struct RunOptions;
struct RunOutcome;

using language::ProgramLanguage;

/// A language that programs are written in.
struct LanguageEntry {
  ProgramLanguage language = ProgramLanguage::Klartext;
  std::string_view name;                  ///< "Klartext"
  std::string_view whose;                 ///< in "give it the extension of its language: .H for Klartext": "Klartext"
  std::vector<std::string_view> endings;  ///< of files, in capitals: ".H"
  std::vector<std::string_view> archiveEndings;  ///< those under which programs come out of archives
  /// True if the beginning of a text is one of this language; asked where the ending of its file tells nothing.
  bool (*looksLike)(const std::string& head) = nullptr;
  bool holdsControlCharacters = false;  ///< programs may have other bytes than those of text
  Result<std::shared_ptr<language::Program>> (*open)(const std::filesystem::path& path) = nullptr;
  std::shared_ptr<language::Program> (*fromText)(std::string name, std::string text) = nullptr;
};

/// A control of a family.
struct ControlModel {
  control::ControlKind kind = control::ControlKind::TNC640;
  std::string_view name;                         ///< "840Dsl": in messages, results and setups
  std::vector<std::string_view> alsoCalled;      ///< "828D": a control that counts as this one, offered like its name
  std::vector<std::string_view> alsoUnderstood;  ///< on the command line, in small letters and digits: "sinumerik"
};

/// A program to be looked through without running it.
struct CheckRequest {
  language::Program& program;
  control::ControlKind control = control::ControlKind::TNC640;
  std::filesystem::path path = {};            ///< of the program, for files beside it; empty: none are looked for
  const control::Beliefs* beliefs = nullptr;  ///< of its control; null if nothing is known
  std::bitset<10> skipLevels = {};            ///< levels of block skip that are on
  bool foresees = true;                       ///< also what a run would refuse when it gets there
  const machine::MachineDescription* machine = nullptr;  ///< null if it is not known
};

/// A tool or a row as the text of a program names it.
struct NamedItem {
  std::string name;  ///< empty: by its number
  double number = 0;
};

/// What a control has that programs name.
struct Inventory {
  std::function<bool(const NamedItem&)> hasTool;
  /// Whether the magazine of the virtual machine holds a tool that the control has. Empty: not known.
  std::function<bool(const NamedItem&)> holdsTool;
  std::function<bool(const NamedItem&)> hasPreset;
  /// A file that the run may read by this name: beside the program or among the tables of the setup. Empty: not known.
  std::function<bool(const std::string&)> hasFile;
  std::string tools, presets;  ///< for the way out: "the setup has 1 PROBE, 2"
  bool toolSteps = false;      ///< tools are called with steps: 5.1
  /// The parameter of measuring cycles that names a tool to be monitored, and the word that such cycles are called by;
  /// 0: there is none.
  std::uint32_t monitoredTool = 0;
  std::string_view cycleWord;
  /// The place of the argument by which a call of `cycle` names a tool that it corrects for certain; `number` gives an
  /// argument by its name as far as it is written as a number. Empty: calls name no tools.
  std::function<std::optional<std::uint32_t>(std::string_view cycle,
                                             const std::function<std::optional<double>(std::uint32_t place)>& number)>
      correctedTool;
  /// The names of the swivel data sets of CYCLE800, and what is told of them; empty: their names are not known.
  std::vector<std::string> swivelData;
};

/// What a control is to run. `beliefs` and `options` outlive the run.
struct RunRequest {
  std::shared_ptr<language::Program> program;
  std::filesystem::path path;
  control::ControlKind control = control::ControlKind::TNC640;
  const control::Beliefs& beliefs;
  const RunOptions& options;
};

/// Lets the control run the program on a machine, once. What goes wrong before the first block is in the outcome's
/// diagnostics, or thrown as control::Alarm.
using RunOn = std::function<void(machine::Machine& machine, HostFiles& files, RunOutcome& outcome)>;

struct ControlFamily {
  std::string_view name;                 ///< "HEIDENHAIN"
  std::vector<ControlModel> controls;    ///< the first is the one that programs are for if nothing says which
  std::vector<LanguageEntry> languages;  ///< the first is the one to read if neither ending nor text tells
  /// Endings of programs that a program calls without one, in the order in which they are looked for.
  std::vector<std::string> calledEndings;
  std::vector<control::DialogLanguage> dialogLanguages;  ///< that its logs and screens are written in
  bool hasPresets = false;                               ///< beliefs may have rows of a preset table
  bool hasZeroOffsets = false;                           ///< beliefs may have settable zero offsets
  bool hasProgramModes = false;                          ///< dry run and program test (RunOptions::mode)
  bool startsAtLines = false;                            ///< block search, mid-program startup (RunOptions::searchLine)

  std::vector<const cycles::CycleDefinition*> (*cycles)(control::ControlKind control) = nullptr;
  /// Every mistake that can be seen without running, in the order of the lines.
  Diagnostics (*check)(const CheckRequest& request) = nullptr;
  /// What a control with these beliefs has; mistakes in its tables go to `diagnostics`. Null: nothing is compared.
  Inventory (*inventory)(const control::Beliefs& beliefs, control::ControlKind control,
                         Diagnostics& diagnostics) = nullptr;
  /// A call of the cycle to paste into a program and to fill in. Texts of the control in `language`.
  std::string (*cycleTemplate)(const cycles::CycleDefinition& cycle, control::ControlKind control,
                               control::DialogLanguage language) = nullptr;
  /// Tells a conversion what else the program in that file knows of its control: of files beside it and of the beliefs
  /// (null: none are known). Null: programs say all by themselves.
  void (*tellConversion)(const std::filesystem::path& path, const control::Beliefs* beliefs,
                         conversion::ConvertOptions& options, Diagnostics& diagnostics) = nullptr;
  /// Reads the whole program for mistakes, which go to `diagnostics`. What comes back makes tables of the beliefs, runs
  /// the program with the family's interpreter host and leaves tables, logs and journal in the outcome.
  RunOn (*prepare)(const RunRequest& request, Diagnostics& diagnostics) = nullptr;
};

/// The families that there are.
class ControlFamilies {
public:
  explicit ControlFamilies(std::vector<ControlFamily> families) : families_(std::move(families)) {}

  std::span<const ControlFamily> all() const { return families_; }
  /// The family of a control or of a language, which must be one of those here.
  const ControlFamily& of(control::ControlKind control) const;
  const ControlFamily& of(ProgramLanguage language) const;
  const LanguageEntry& entry(ProgramLanguage language) const;
  const ControlModel& model(control::ControlKind control) const;
  /// True if the control runs programs of that language.
  bool speaks(control::ControlKind control, ProgramLanguage language) const;

  /// "TNC640", "iTNC530", "840Dsl", "828D".
  std::vector<std::string> controlNames() const;
  /// The control called `text` (case, blanks and hyphens do not matter), or nothing.
  std::optional<control::ControlKind> controlNamed(std::string_view text) const;

private:
  std::vector<ControlFamily> families_;
};

/// HEIDENHAIN and SINUMERIK.
const ControlFamilies& knownFamilies();

}  // namespace probewright::session
