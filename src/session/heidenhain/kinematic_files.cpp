#include "session/heidenhain/kinematic_files.hpp"

#include <filesystem>
#include <utility>

#include "base/text.hpp"
#include "control/heidenhain/kinematic_tables.hpp"
#include "control/heidenhain/kinematics.hpp"
#include "session/table_files.hpp"

namespace probewright::session::heidenhain {

namespace fs = std::filesystem;
namespace hh = control::heidenhain;

namespace {

std::optional<hh::TypedTable> tableIn(const fs::path& path, std::span<const hh::ColumnSpec> columns,
                                      Diagnostics& diagnostics) {
  const auto text = contents(path, diagnostics);
  if (!text) return std::nullopt;
  Result<hh::TypedTable> table = hh::TypedTable::parse(*text, path.string(), columns, diagnostics);
  if (table) return std::move(*table);
  diagnostics.push_back(table.error());
  return std::nullopt;
}

void keep(Diagnostics& diagnostics, Diagnostic mistake, const fs::path& path) {
  if (mistake.place.file.empty()) mistake.place.file = path.string();
  diagnostics.push_back(std::move(mistake));
}

}  // namespace

void readKinematics(hh::Control& control, const control::Beliefs& beliefs, Diagnostics& diagnostics) {
  hh::Kinematics& kinematics = *control.kinematics;
  kinematics.set({control::believedCorrections(kinematics.built(), beliefs.kinematics), Vector3::Zero()});
  for (const auto& [name, belief] : beliefs.kinematics) {
    if (const auto axis = kinematics.built().axisIndex(name)) kinematics.hirthGrid[*axis] = belief.hirthGrid;
  }
  Diagnostics known;  // of the folder; whoever reads the other tables has told them
  for (const fs::path& path : tableFiles(beliefs.tables, known)) {
    const std::string name = upperCase(path.filename().string());
    if (name == hh::kinematicTableName) {
      const auto table = tableIn(path, hh::kinematicColumns(), diagnostics);
      if (!table) continue;
      Result<hh::KinematicData> data = kinematics.dataOf(hh::entriesOf(*table));
      if (!data) {
        data.error().advice = "take the table out of the folder, or use that of this machine";
        keep(diagnostics, data.error(), path);
        continue;
      }
      kinematics.set(std::move(*data));
      kinematics.tabled = true;
    } else if (name == hh::savedKinematicsName) {
      kinematics.saved = tableIn(path, hh::savedKinematicColumns(), diagnostics);
    } else if (name.ends_with(".KCO") && control.isTNC640()) {
      auto table = tableIn(path, hh::gridColumns(), diagnostics);
      if (!table) continue;
      Result<hh::CompensationGrid> grid = hh::CompensationGrid::of(*table, kinematics.built());
      if (!grid) {
        keep(diagnostics, grid.error(), path);
      } else if (kinematics.grid) {
        keep(diagnostics, fail("there are two compensation tables *.KCO", "leave one in the folder").value(), path);
      } else {
        kinematics.grid = std::move(*grid);
        kinematics.gridTable = std::move(table);
      }
    }
  }
  control.applyKinematics();
}

void writeKinematics(const hh::Control& control, std::map<std::string, std::string>& files) {
  const hh::Kinematics& kinematics = *control.kinematics;
  if (kinematics.tabled) files[hh::kinematicTableName] = hh::kinematicTable(kinematics, control.kind()).table().bytes();
  if (kinematics.saved) files[hh::savedKinematicsName] = kinematics.saved->table().bytes();
  if (kinematics.gridTable)
    files[upperCase(fs::path(kinematics.gridTable->table().file()).filename().string())] =
        kinematics.gridTable->table().bytes();
}

std::set<std::string> kinematicFileNames() { return {hh::kinematicTableName, hh::savedKinematicsName}; }

}  // namespace probewright::session::heidenhain
