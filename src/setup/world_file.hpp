#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/toml_table.hpp"
#include "simulation/world.hpp"

/// The true half of a setup file.
namespace probewright::setup {

/// A machine file that has been read.
struct MachineRead {
  machine::MachineDescription description;
  std::optional<machine::TableBody> table;
};

/// Reads what is true, section by section, into `world`; the machine comes first. Relative paths count from `folder`;
/// the files that the setup names are added to `inputs`.
class WorldReader {
public:
  WorldReader(TomlReader& root, std::filesystem::path folder, simulation::World& world,
              std::vector<std::filesystem::path>& inputs)
      : root_(root), folder_(std::move(folder)), world_(world), inputs_(inputs) {}

  /// `instead`: a machine file that takes the place of the one that [machine] names; empty: none. `known`: what that
  /// file says, if it need not be read again.
  void readMachine(const std::filesystem::path& instead, const MachineRead* known = nullptr);
  void readSeed();
  /// [part], [[fixture]], [ring], [sphere], [gauge_block] and [tool_probe].
  void readSolids();
  void readErrors();

private:
  std::filesystem::path resolve(const std::string& path) const {
    return std::filesystem::path(path).is_absolute() ? std::filesystem::path(path) : folder_ / path;
  }
  const machine::MachineDescription& machine() const { return world_.truth.machine; }
  /// Who says which machine file it is.
  enum class Named : std::uint8_t { ByThisFile, ByCaller };
  void loadMachine(const std::string& name, TomlReader& reader, std::string_view key, Named named);
  void takeMachine(const machine::MachineDescription& description, const std::optional<machine::TableBody>& table);
  void readStart(TomlReader& reader);
  void readHirthGrids(TomlReader& reader);
  void readSolid(TomlReader& reader, simulation::SolidRole role, std::string defaultName, const char* featureTable);
  void placeGauge(simulation::SolidRecipe recipe, TomlReader& reader, std::string name, simulation::SolidRole role);
  void readGauges();
  void readToolProbes();  ///< one table, or several
  void addToolProbe(TomlReader& reader);
  Vector3 travelDirection(std::size_t axis) const;
  void readAxisErrors(TomlReader& reader, std::size_t axis);

  TomlReader& root_;
  std::filesystem::path folder_;
  simulation::World& world_;
  std::vector<std::filesystem::path>& inputs_;
  const MachineRead* known_ = nullptr;
};

}  // namespace probewright::setup
