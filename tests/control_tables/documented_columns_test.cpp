#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <span>
#include <sstream>
#include <string>

#include "control/heidenhain/axis_shift_table.hpp"
#include "control/heidenhain/datum_table.hpp"
#include "control/heidenhain/deflection_table.hpp"
#include "control/heidenhain/kinematic_tables.hpp"
#include "control/heidenhain/preset_table.hpp"
#include "control/heidenhain/probe_table.hpp"
#include "control/heidenhain/tool_table.hpp"
#include "control/heidenhain/turning_tool_table.hpp"

/// The columns that docs/tables.md names against those of the tables.
namespace probewright::control::heidenhain {
namespace {

/// The columns of each table, as the page names them: words in capitals, but not the entries in parentheses.
std::map<std::string, std::set<std::string>> documented() {
  std::ifstream file(std::string(PROBEWRIGHT_SOURCE_DIR) + "/docs/tables.md");
  std::map<std::string, std::set<std::string>> tables;
  static const std::regex word("`([A-Z][A-Z0-9_:-]*)`"), parentheses("\\([^)]*\\)");
  bool inside = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("| file | rows | columns used |")) inside = true;
    if (inside && line.empty()) break;
    if (!inside || !line.starts_with("| `")) continue;
    std::istringstream row(line.substr(1));
    std::string name, rows, columns;
    std::getline(row, name, '|');
    std::getline(row, rows, '|');
    std::getline(row, columns, '|');
    columns = std::regex_replace(columns, parentheses, "");
    for (std::sregex_iterator each(columns.begin(), columns.end(), word), end; each != end; ++each)
      tables[name.substr(2, name.rfind('`') - 2)].insert((*each)[1]);
  }
  return tables;
}

TEST(DocumentedColumns, AreThereInTheTables) {
  const std::map<std::string, std::span<const ColumnSpec>> specs = {
      {"TOOL.T", toolColumns()},       {"TCHPROBE.TP", probeColumns()},
      {"PRESET.PR", presetColumns()},  {"TOOLTURN.TRN", turningToolColumns()},
      {"*.3DTC", deflectionColumns()}, {"AXSHIFT.TAB", axisShiftColumns()},
      {"*.D", datumColumns()},         {"KINEMATIC.TAB", kinematicColumns()},
      {"*.KCO", gridColumns()},        {"DATA450.KD", savedKinematicColumns()}};
  const auto tables = documented();
  EXPECT_EQ(tables.size(), specs.size());
  for (const auto& [name, columns] : tables) {
    ASSERT_TRUE(specs.contains(name)) << name;
    std::set<std::string> known;
    for (const ColumnSpec& column : specs.at(name))
      known.insert(std::string(column.name()));
    for (const std::string& column : columns)
      EXPECT_TRUE(known.contains(column)) << name << ": " << column;
    EXPECT_GE(columns.size(), 3U) << name;
  }
}

}  // namespace
}  // namespace probewright::control::heidenhain
