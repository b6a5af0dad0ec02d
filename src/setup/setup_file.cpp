#include <algorithm>

#include "base/file.hpp"
#include "base/toml_table.hpp"
#include "setup/belief_file.hpp"
#include "setup/calibrated_beliefs.hpp"
#include "setup/camera_keys.hpp"
#include "setup/setup_document.hpp"
#include "setup/setup_on_machine.hpp"
#include "setup/tool_keys.hpp"
#include "setup/world_file.hpp"

namespace probewright::setup {

namespace {

/// [job]: texts for the head of the report.
records::Job readJob(TomlReader& root) {
  records::Job job;
  if (auto reader = root.table("job")) {
    for (const records::JobField& field : records::jobFields)
      job.*field.value = reader->text(field.name).value_or("");
    reader->finish();
  }
  return job;
}

std::optional<Setup> setupOf(const toml::table& table, const std::string& file, const std::filesystem::path& machine,
                             const MachineRead* known, Diagnostics& diagnostics,
                             const session::ControlFamilies& families, const MayBeMissing& mayBeMissing = {}) {
  const auto errors = [&] { return std::ranges::count(diagnostics, Severity::Error, &Diagnostic::severity); };
  const auto before = errors();
  TomlReader root(table, "", file, diagnostics);
  Setup setup;
  setup.world.file = setup.beliefs.file = file;
  setup.inputs.emplace_back(file);
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  WorldReader world(root, folder, setup.world, setup.inputs);
  BeliefReader beliefs(root, folder, setup.world.truth.machine, setup.beliefs, families);
  world.readMachine(machine, known);
  beliefs.readControl(mayBeMissing);
  world.readSeed();
  world.readSolids();
  readTools(root, setup.world, setup.beliefs);
  setup.camera = readCamera(root, setup.world);
  beliefs.readFrames();
  world.readErrors();
  beliefs.readParameters();
  beliefs.readAnswers();
  setup.job = readJob(root);
  root.finish();
  if (errors() > before) return std::nullopt;
  believeHirthCouplings(setup.beliefs, setup.world.truth);
  setup.beliefs.technology = believedTechnology(setup.world.truth.machine);
  setup.beliefs.toolProbes = believedToolProbes(setup.world);
  return setup;
}

std::optional<Setup> parse(std::string_view text, const std::string& file, const std::filesystem::path& machine,
                           Diagnostics& diagnostics, const session::ControlFamilies& families,
                           const MayBeMissing& mayBeMissing = {}) {
  const auto table = parseToml(text, file, diagnostics);
  return table ? setupOf(*table, file, machine, nullptr, diagnostics, families, mayBeMissing) : std::nullopt;
}

}  // namespace

std::optional<Setup> parseSetup(std::string_view text, const std::string& file, Diagnostics& diagnostics,
                                const session::ControlFamilies& families) {
  return parse(text, file, {}, diagnostics, families);
}

std::optional<Setup> readSetup(const std::filesystem::path& path, Diagnostics& diagnostics,
                               const session::ControlFamilies& families) {
  return readSetupOn({}, path, diagnostics, {}, families);
}

std::optional<Setup> readSetupOn(const std::filesystem::path& machine, const std::filesystem::path& path,
                                 Diagnostics& diagnostics, const MayBeMissing& mayBeMissing,
                                 const session::ControlFamilies& families) {
  auto text = readFile(path, largestText);
  if (!text) {
    diagnostics.push_back(std::move(text.error()));
    return std::nullopt;
  }
  return parse(*text, path.string(), machine, diagnostics, families, mayBeMissing);
}

std::optional<SetupDocument> SetupDocument::read(const std::filesystem::path& path, Diagnostics& diagnostics,
                                                 const session::ControlFamilies& families) {
  auto text = readFile(path, largestText);
  if (!text) {
    diagnostics.push_back(std::move(text.error()));
    return std::nullopt;
  }
  return parse(*text, path.string(), diagnostics, families);
}

std::optional<SetupDocument> SetupDocument::parse(std::string_view text, const std::string& file,
                                                  Diagnostics& diagnostics, const session::ControlFamilies& families) {
  auto table = parseToml(text, file, diagnostics);
  if (!table) return std::nullopt;
  auto setup = setupOf(*table, file, {}, nullptr, diagnostics, families);
  if (!setup) return std::nullopt;
  return SetupDocument(std::move(*table), std::move(*setup), families);
}

SetupDocument::SetupDocument(toml::table table, Setup asWritten, const session::ControlFamilies& families)
    : table_(std::move(table)), asWritten_(std::move(asWritten)), families_(&families) {}

std::optional<Setup> SetupDocument::with(const toml::table& table, Diagnostics& diagnostics) const {
  const MachineRead machine{asWritten_.world.truth.machine, asWritten_.world.table};
  return setupOf(table, asWritten_.world.file, {}, &machine, diagnostics, *families_);
}

}  // namespace probewright::setup
