#include "study/program_model.hpp"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <numeric>
#include <optional>
#include <utility>

#include "base/file.hpp"
#include "base/unfinished.hpp"
#include "camera/virtual_camera.hpp"
#include "session/run.hpp"
#include "simulation/virtual_machine.hpp"
#include "study/first_order.hpp"
#include "study/observations.hpp"
#include "truth/true_values.hpp"

namespace probewright::study {

namespace fs = std::filesystem;

namespace {

/// True if the number says what the control believes, not what is true.
bool isBelief(const NumberPath& path) {
  static constexpr std::array<std::string_view, 5> tables = {"preset", "zero_offset", "control", "parameters",
                                                             "answers"};
  static constexpr std::array<std::string_view, 10> ofTools = {
      "believed_length", "believed_radius",  "believed_tip_offset", "probing_feed",          "probing_rapid",
      "maximum_travel",  "set_up_clearance", "calibration_angle",   "cutting_edge_position", "probe_number"};
  const std::vector<std::string> keys = path.keys();
  if (std::ranges::find(tables, keys.front()) != tables.end()) return true;
  return keys.front() == "tool" && keys.size() > 1 && std::ranges::find(ofTools, keys[1]) != ofTools.end();
}

bool samePattern(const simulation::FeaturePattern& a, const simulation::FeaturePattern& b) {
  return a.kind == b.kind && a.count == b.count && a.spacing == b.spacing && a.centre == b.centre && a.angle == b.angle;
}

bool sameShape(const simulation::SolidFeature& a, const simulation::SolidFeature& b) {
  return a.shape == b.shape && a.mode == b.mode && a.centre == b.centre && a.rotation == b.rotation &&
         a.size == b.size && a.diameter == b.diameter && a.topDiameter == b.topDiameter &&
         a.tubeDiameter == b.tubeDiameter && a.height == b.height && a.depth == b.depth &&
         a.cornerRadius == b.cornerRadius && a.edgeSize == b.edgeSize && a.edges == b.edges &&
         std::ranges::equal(a.patterns, b.patterns, samePattern);
}

/// A folder for the tables that a calibration hands over, which goes with the thread's data.
class HandOver {
public:
  HandOver() = default;
  HandOver(const HandOver&) : HandOver() {}
  HandOver& operator=(const HandOver&) = delete;
  ~HandOver() = default;
  /// Empties the folder and writes the files; false if that fails.
  bool take(const std::map<std::string, std::string>& files) {
    if (!scratch_) scratch_.emplace();
    if (scratch_->path().empty()) return false;
    // Not the scratch folder itself: that one is held locked, and a run that begins from tables waits for their folder.
    folder_ = scratch_->path() / "tables";
    std::error_code error;
    fs::remove_all(folder_, error);
    if (!fs::create_directory(folder_, error)) return false;
    for (const auto& [name, text] : files) {
      std::ofstream file(folder_ / fs::path(name).filename(), std::ios::binary);
      file << text;
      if (!file.flush()) return false;
    }
    return true;
  }
  /// Of what has been taken.
  const fs::path& folder() const { return folder_; }

private:
  std::optional<ScratchFolder> scratch_;
  fs::path folder_;
};

struct Script {
  std::string name, text;
};

/// A program as a thread has read it: for as long as beliefs stay as they are, the control is not asked to check it
/// again, and its tables are made once.
struct ReadProgram {
  session::RunOptions options;
  std::optional<session::PreparedProgram> prepared;
};

/// What a thread has of its own.
struct Desk {
  toml::table world, beliefs;
  HandOver handOver;
  std::unique_ptr<ReadProgram> program;  ///< where no trial changes what the control believes
};

class Trials final : public ProgramModel {
public:
  Trials(Script program, std::optional<Script> calibration, setup::SetupDocument document, const Study& study,
         const Options& options, const simulation::Truth& built)
      : program_(std::move(program)),
        calibration_(std::move(calibration)),
        document_(std::move(document)),
        sources_(study.sources),
        control_(options.control),
        stop_(options.import.stop),
        trueValues_(study.trueValues),
        scatter_(scatterOf(document_.asWritten().world.truth)),
        solids_(built.solids),
        bodies_(built.bodies),
        desks_([this] {
          return Desk{document_.table(), document_.table(), {}, nullptr};
        }) {
    for (const Source& source : sources_)
      changesBeliefs_.push_back(source.known || isBelief(source.quantity));
    anyBelief_ = std::ranges::find(changesBeliefs_, true) != changesBeliefs_.end();
  }

  Outcome run(const Draw& draw) const override;
  std::vector<std::string> rebuilt() const override;

private:
  std::optional<setup::Setup> setupOf(Desk& desk, const Draw& draw, Outcome& outcome) const;
  std::unique_ptr<simulation::VirtualMachine> machineOf(const setup::Setup& setup, Outcome& outcome) const;
  /// Runs a program; what it leaves goes to `outcome`. Nothing if it did not come to its end.
  std::optional<session::RunOutcome> carryOut(const Script& script, const setup::Setup& setup,
                                              session::PreparedProgram prepared, std::string_view prefix,
                                              Outcome& outcome) const;
  /// Nobody asks for the files of a trial; those of a calibration hand its tables over.
  enum class Leaves { Results, Files };
  session::RunOptions runOptions(Leaves leaves) const;
  /// The program with the beliefs of the setup as it is written.
  const session::PreparedProgram& preparedFor(Desk& desk) const;

  Script program_;
  std::optional<Script> calibration_;
  setup::SetupDocument document_;
  std::vector<Source> sources_;
  std::optional<control::ControlKind> control_;
  std::stop_token stop_;
  bool trueValues_;
  double scatter_;
  std::vector<simulation::PlacedSolid> solids_;  ///< as built: those of the world, then the table
  std::vector<simulation::MachineBody> bodies_;
  std::vector<bool> changesBeliefs_;
  bool anyBelief_ = false;
  mutable tbb::enumerable_thread_specific<Desk> desks_;
};

void refuse(Outcome& outcome, std::string why) {
  outcome.end = TrialEnd::Refused;
  outcome.why = "could not begin: " + withoutNumbers(why);
}

std::optional<setup::Setup> Trials::setupOf(Desk& desk, const Draw& draw, Outcome& outcome) const {
  enum class Half { World, Beliefs };
  const auto read = [&](toml::table& table, Half half) -> std::optional<setup::Setup> {
    for (std::size_t i = 0; i < sources_.size(); ++i) {
      if (half == Half::Beliefs && !changesBeliefs_[i]) continue;
      if (const auto set = sources_[i].quantity.set(table, draw.inputs[i]); !set) {
        refuse(outcome, set.error().message);
        return std::nullopt;
      }
    }
    Diagnostics mistakes;
    auto setup = document_.with(table, mistakes);
    if (!setup) {
      const auto mistake = std::ranges::find(mistakes, Severity::Error, &Diagnostic::severity);
      refuse(outcome, mistake == mistakes.end() ? "the setup has mistakes" : mistake->message);
    }
    return setup;
  };
  auto setup = read(desk.world, Half::World);
  if (!setup) return std::nullopt;
  if (anyBelief_) {
    auto believed = read(desk.beliefs, Half::Beliefs);
    if (!believed) return std::nullopt;
    setup->beliefs = std::move(believed->beliefs);
  } else {
    setup->beliefs = document_.asWritten().beliefs;
  }
  simulation::Truth& truth = setup->world.truth;
  if (draw.noise) {
    truth.seed = *draw.noise;
  } else {
    for (simulation::TrueTool& tool : truth.tools)
      tool.probe.repeatability = 0;
    for (simulation::TrueToolProbe& probe : truth.toolProbes)
      probe.repeatability = 0;
  }
  return setup;
}

std::unique_ptr<simulation::VirtualMachine> Trials::machineOf(const setup::Setup& setup, Outcome& outcome) const {
  const auto& asWritten = document_.asWritten().world.solids;
  simulation::Truth truth = setup.world.truth;
  truth.solids.clear();
  for (std::size_t i = 0; i < setup.world.solids.size(); ++i) {
    const simulation::WorldSolid& solid = setup.world.solids[i];
    std::shared_ptr<const simulation::Solid> shape = solids_[i].solid;
    if (!std::ranges::equal(solid.source.recipe.features, asWritten[i].source.recipe.features, sameShape)) {
      auto built = simulation::buildSolid(solid.source.recipe, {}, stop_);
      if (!built) {
        refuse(outcome, built.error().message);
        return nullptr;
      }
      shape = std::move(*built);
    }
    truth.solids.push_back({std::move(shape), solid.tableFromSolid, solid.name, solid.role});
  }
  // The table of the machine lies where it lies.
  truth.solids.insert(truth.solids.end(), solids_.begin() + static_cast<std::ptrdiff_t>(asWritten.size()),
                      solids_.end());
  truth.bodies = bodies_;
  auto machine = std::make_unique<simulation::VirtualMachine>(std::move(truth));
  machine->record(trueValues_ ? simulation::Recording::Touches : simulation::Recording::Nothing);
  if (setup.world.toolInSpindle) {
    const auto inserted = machine->insertTool({*setup.world.toolInSpindle, {}});
    if (inserted.end != machine::ToolChangeEnd::Changed) {
      refuse(outcome, "the machine cannot start like this: " + inserted.detail);
      return nullptr;
    }
  }
  if (setup.camera) machine->fit(std::make_unique<camera::VirtualCamera>(*machine, *setup.camera));
  return machine;
}

std::optional<session::RunOutcome> Trials::carryOut(const Script& script, const setup::Setup& setup,
                                                    session::PreparedProgram prepared, std::string_view prefix,
                                                    Outcome& outcome) const {
  const auto machine = machineOf(setup, outcome);
  if (!machine) return std::nullopt;
  session::RunOutcome ran = session::run(std::move(prepared), *machine);
  if (hasErrors(ran.diagnostics)) {
    const auto mistake = std::ranges::find(ran.diagnostics, Severity::Error, &Diagnostic::severity);
    refuse(outcome, mistake->message);
    return std::nullopt;
  }
  Observed observed{script.name, std::string(prefix), scatter_, {}};
  if (trueValues_) {
    const auto touched = truth::touchedCycles(ran.journal, machine->truth(), machine->path());
    observed.truths = truth::trueValues(ran.journal, touched, machine->truth());
  }
  for (Observation& observation : observationsOf(ran.journal, observed))
    outcome.observations.push_back(std::move(observation));
  if (ran.result.end == execution::RunEnd::Finished) return ran;
  if (ran.result.end == execution::RunEnd::Cancelled) {
    outcome.end = TrialEnd::Cancelled;
    return std::nullopt;
  }
  outcome.end = TrialEnd::Alarm;
  outcome.why = std::string(prefix) + "stopped";
  if (!ran.result.diagnostics.empty()) {
    const Diagnostic& why = ran.result.diagnostics.front();
    outcome.why = fmt::format("{}line {}: {}{}{}", prefix, why.place.line, why.code, why.code.empty() ? "" : ": ",
                              withoutNumbers(why.message));
  }
  return std::nullopt;
}

session::RunOptions Trials::runOptions(Leaves leaves) const {
  session::RunOptions options;
  options.files = leaves == Leaves::Files;
  options.control = control_;
  options.stop = stop_;
  return options;
}

const session::PreparedProgram& Trials::preparedFor(Desk& desk) const {
  if (!desk.program) {
    desk.program = std::make_unique<ReadProgram>(ReadProgram{runOptions(Leaves::Results), {}});
    desk.program->prepared =
        session::prepareText(program_.name, program_.text, document_.asWritten().beliefs, desk.program->options);
  }
  return *desk.program->prepared;
}

Outcome Trials::run(const Draw& draw) const {
  Outcome outcome;
  Desk& desk = desks_.local();
  auto setup = setupOf(desk, draw, outcome);
  if (!setup) return outcome;
  if (!calibration_ && !anyBelief_) {
    carryOut(program_, *setup, preparedFor(desk), "", outcome);
    return outcome;
  }
  const session::RunOptions options = runOptions(Leaves::Results), withFiles = runOptions(Leaves::Files);
  control::Beliefs beliefs = setup->beliefs;
  if (calibration_) {
    const auto calibrated = carryOut(*calibration_, *setup,
                                     session::prepareText(calibration_->name, calibration_->text, beliefs, withFiles),
                                     "calibration ", outcome);
    if (!calibrated) return outcome;
    if (!desk.handOver.take(calibrated->files)) {
      refuse(outcome, "the tables of the calibration cannot be written to the folder for temporary files (TMPDIR)");
      return outcome;
    }
    beliefs.tables = desk.handOver.folder();
    // The measuring noise goes on; it does not begin again.
    ++setup->world.truth.seed;
  }
  carryOut(program_, *setup, session::prepareText(program_.name, program_.text, beliefs, options), "", outcome);
  return outcome;
}

std::vector<std::string> Trials::rebuilt() const {
  std::vector<std::string> names;
  toml::table changed = document_.table();
  for (const Source& source : sources_)
    static_cast<void>(source.quantity.set(changed, source.distribution.value({0.3, 0.3})));
  Diagnostics ignored;
  const auto setup = document_.with(changed, ignored);
  if (!setup) return names;
  const auto& asWritten = document_.asWritten().world.solids;
  for (std::size_t i = 0; i < asWritten.size(); ++i) {
    const simulation::WorldSolid& solid = setup->world.solids[i];
    if (!std::ranges::equal(solid.source.recipe.features, asWritten[i].source.recipe.features, sameShape))
      names.push_back(solid.name);
  }
  return names;
}

/// Whether there is a setup with these values of these sources; `mistakes` say why not.
bool hasSetup(const setup::SetupDocument& document, const Sampler& sampler, const std::vector<double>& values,
              const std::vector<std::size_t>& which, Diagnostics& mistakes) {
  toml::table table = document.table();
  for (const std::size_t i : which)
    if (const auto set = sampler.sources()[i].quantity.set(table, values[i]); !set) mistakes.push_back(set.error());
  return !hasErrors(mistakes) && document.with(table, mistakes).has_value();
}

/// Sources that no setup can have: keys that it does not know, values of which none is possible. What is possible in
/// some trials only is no mistake.
void checkSources(const setup::SetupDocument& document, const Study& study, Diagnostics& diagnostics) {
  const Sampler sampler(study);
  const std::vector<double> estimates = sampler.estimate().inputs;
  std::vector<std::size_t> all(sampler.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  Diagnostics ofAll;
  if (hasSetup(document, sampler, estimates, all, ofAll) &&
      hasSetup(document, sampler, sampler.draw(0).inputs, all, ofAll))
    return;
  constexpr std::uint64_t drawn = 40;
  for (const std::size_t i : all) {
    Diagnostics mistakes;
    bool possible = false;
    for (std::uint64_t trial = 0; trial < drawn && !possible; ++trial)
      possible = hasSetup(document, sampler, sampler.draw(trial).inputs, {i}, mistakes = {});
    if (possible) continue;
    const auto mistake = std::ranges::find(mistakes, Severity::Error, &Diagnostic::severity);
    if (mistake == mistakes.end()) continue;
    const Source& source = study.sources[i];
    diagnostics.push_back({Severity::Error,
                           source.place,
                           fmt::format("quantity \"{}\": {}", source.quantity.text(), mistake->message),
                           {},
                           mistake->advice.empty() ? "name a number that docs/setup-format.md has" : mistake->advice,
                           {}});
  }
}

}  // namespace

std::unique_ptr<ProgramModel> ProgramModel::make(const fs::path& program, setup::SetupDocument setup,
                                                 const Study& study, const Options& options, Diagnostics& diagnostics) {
  const auto script = [&](const fs::path& path) -> std::optional<Script> {
    auto text = readFile(path);
    if (text) return Script{path.string(), std::move(*text)};
    diagnostics.push_back(std::move(text.error()));
    return std::nullopt;
  };
  auto main = script(program);
  std::optional<Script> calibration;
  if (!study.calibrate.empty()) calibration = script(study.calibrate);
  if (!main || (!study.calibrate.empty() && !calibration)) return nullptr;
  session::RunOptions checked;
  checked.control = options.control;
  for (const Script* each : {&*main, calibration ? &*calibration : nullptr}) {
    if (each == nullptr) continue;
    const auto prepared = session::prepareText(each->name, each->text, setup.asWritten().beliefs, checked);
    diagnostics.insert(diagnostics.end(), prepared.diagnostics.begin(), prepared.diagnostics.end());
    if (hasErrors(prepared.diagnostics)) return nullptr;
  }
  Diagnostics wrong;
  checkSources(setup, study, wrong);
  diagnostics.insert(diagnostics.end(), wrong.begin(), wrong.end());
  if (!wrong.empty()) return nullptr;
  auto machine = simulation::buildMachine(setup.asWritten().world, options.import);
  if (!machine) {
    diagnostics.push_back(std::move(machine.error()));
    return nullptr;
  }
  return std::make_unique<Trials>(std::move(*main), std::move(calibration), std::move(setup), study, options,
                                  (*machine)->truth());
}

}  // namespace probewright::study
