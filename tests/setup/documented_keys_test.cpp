#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <sstream>

#include "machine/machine_file.hpp"
#include "setup/setup.hpp"

/// docs/setup-format.md and docs/machine-files.md against the readers of setups and machine files: the keys of every
/// table, their ranges and defaults.
namespace probewright::setup {
namespace {

using namespace simulation;
using control::BelievedTool;

using testing::HasSubstr;

std::string page() {
  std::stringstream text;
  for (const char* name : {"setup-format.md", "machine-files.md"})
    text << std::ifstream(std::string(PROBEWRIGHT_EXAMPLES "/../docs/") + name).rdbuf();
  return text.str();
}

/// A row of a table of the page.
struct Row {
  std::string heading;  ///< "`[machine]`"
  std::string table;    ///< the table of the setup that the row names itself: "[ring]"
  std::vector<std::string> keys;
  std::map<std::string, std::string> cells;  ///< by the head of their column
};

std::vector<std::string> codeWords(const std::string& cell) {
  std::vector<std::string> found;
  static const std::regex code("`([^`]+)`");
  for (std::sregex_iterator each(cell.begin(), cell.end(), code), end; each != end; ++each)
    found.push_back((*each)[1]);
  return found;
}

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(' ');
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(' ') + 1 - begin);
}

std::vector<Row> rows() {
  std::vector<Row> found;
  std::istringstream stream(page());
  std::string heading, table;
  std::vector<std::string> head;
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("#")) heading = trimmed(line.substr(line.find(' ')));
    if (!line.starts_with("|")) {
      head.clear();
      table.clear();
      continue;
    }
    std::vector<std::string> cells;
    std::istringstream row(line.substr(1));
    for (std::string cell; std::getline(row, cell, '|');)
      cells.push_back(trimmed(cell));
    if (head.empty()) {
      head = cells;
      continue;
    }
    if (cells[0].starts_with("---")) continue;
    Row each;
    each.heading = heading;
    for (std::size_t i = 0; i < cells.size() && i < head.size(); ++i)
      each.cells[head[i]] = cells[i];
    const bool named = !head[0].starts_with("key") && !head[0].starts_with("`shape`");
    std::vector<std::string> first = codeWords(cells[0]);
    if (!first.empty() && first[0].starts_with("[")) {
      table = first[0];
      for (std::size_t i = 1; i < first.size() && first[i].starts_with("["); ++i)
        table += " " + first[i];
      std::erase_if(first, [](const std::string& word) { return word.starts_with("["); });
    } else if (!first.empty() && named) {
      table = first[0].starts_with("spindle_tilt") ? "" : table;
    }
    each.table = table;
    each.keys = named && each.cells.contains("key") ? codeWords(each.cells["key"]) : first;
    if (named && each.keys.empty()) each.keys = first;
    if (!each.keys.empty()) found.push_back(each);
  }
  return found;
}

std::set<std::string> documented(const std::string& heading, const std::string& table = "") {
  std::set<std::string> keys;
  for (const Row& row : rows()) {
    const bool lists = row.cells.contains("key") || row.cells.contains("table or key");
    if (lists && row.heading == heading && row.table == table) keys.insert(row.keys.begin(), row.keys.end());
  }
  return keys;
}

/// What the reader of setups, or of machine files, says of a text.
Diagnostics mistakesOf(const std::string& text, bool machine) {
  Diagnostics mistakes;
  if (machine) {
    machine::parseMachine(text, "m.toml", mistakes);
  } else {
    parseSetup(text, "s.toml", mistakes);
  }
  return mistakes;
}

/// The keys that a reader lists where it meets an unknown one.
std::set<std::string> known(const std::string& text, bool machine = false) {
  for (const Diagnostic& mistake : mistakesOf(text, machine)) {
    const std::string head = "Known keys here: ";
    if (mistake.message.find("zzqqxx") == std::string::npos || !mistake.advice.starts_with(head)) continue;
    std::set<std::string> keys;
    std::string list = mistake.advice.substr(head.size());
    static const std::regex comma(", ");
    for (std::sregex_token_iterator each(list.begin(), list.end(), comma, -1), end; each != end; ++each)
      keys.insert(*each);
    return keys;
  }
  ADD_FAILURE() << "no list of keys for\n" << text;
  return {};
}

const std::string probe = "[[tool]]\nnumber = 1\nkind = \"probe\"\nlength = 100\nball_radius = 3\n";
const std::string mill = "[[tool]]\nnumber = 1\nkind = \"mill\"\nlength = 100\nradius = 3\n";
const std::string z = "zzqqxx = 1\n";

TEST(DocumentedKeys, OfEverySection) {
  std::set<std::string> top = {"seed"};
  const std::string text = page();
  static const std::regex name("`\\[+([a-z_]+)\\]+`");
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with("## ")) continue;
    for (std::sregex_iterator each(line.begin(), line.end(), name), end; each != end; ++each)
      top.insert((*each)[1]);
  }
  EXPECT_EQ(known(z), top);
  EXPECT_EQ(known("[machine]\n" + z), documented("`[machine]`"));
  EXPECT_EQ(known("[[machine.body]]\nlink = \"bed\"\nfile = \"a.stl\"\n" + z), documented("Bodies"));
  EXPECT_EQ(known("[control]\n" + z), documented("`[control]`"));
  EXPECT_EQ(known("[machine]\nname = \"mill5-table-table\"\n[control.kinematics.C]\n" + z),
            documented("`[control.kinematics.C]`"));
  EXPECT_EQ(known("[part]\nfile = \"a.stl\"\n" + z), documented("`[part]` and `[[fixture]]`"));
  EXPECT_EQ(known("[[fixture]]\nfile = \"a.stl\"\n" + z), documented("`[part]` and `[[fixture]]`"));
  EXPECT_EQ(known("[part]\nfile = \"a.stl\"\n[part.pose]\n" + z), documented("`pose`"));
  for (const char* gauge : {"ring", "sphere", "gauge_block", "tool_probe"}) {
    EXPECT_EQ(known(fmt::format("[{}]\n", gauge) + z),
              documented("`[ring]`, `[sphere]`, `[gauge_block]`, `[tool_probe]`", fmt::format("[{}]", gauge)))
        << gauge;
  }
  EXPECT_EQ(known("[camera]\n" + z), documented("`[camera]`"));
  const std::string frames = "`[[preset]]` and `[[zero_offset]]`";
  std::set<std::string> preset = documented(frames), offset = preset;
  EXPECT_TRUE(preset.erase("name") == 1 && offset.erase("row") == 1);
  EXPECT_EQ(known("[[preset]]\nrow = 1\n" + z), preset);
  EXPECT_EQ(known("[[zero_offset]]\nname = \"G54\"\n" + z), offset);
}

TEST(DocumentedKeys, OfTools) {
  const std::set<std::string> all = documented("`[[tool]]`");
  const std::set<std::string> ofProbes = known(probe + z), ofMills = known(mill + z);
  std::set<std::string> both = ofProbes;
  both.insert(ofMills.begin(), ofMills.end());
  both.merge(known("[[tool]]\nnumber = 1\nkind = \"turn\"\nlength = 9\nradius = 1\n" + z));
  EXPECT_EQ(both, all);
  EXPECT_TRUE(ofMills.contains("radius") && !ofProbes.contains("radius"));
}

TEST(DocumentedKeys, OfCutters) {
  const auto listed = [](const std::string& head) {
    std::set<std::string> keys;
    for (const Row& row : rows())
      if (row.heading == "`[tool.cutter]`" && row.cells.contains("key of `" + head + "`"))
        keys.insert(row.keys.begin(), row.keys.end());
    return keys;
  };
  const std::string cutter = mill + "[tool.cutter]\nteeth = 2\n";
  EXPECT_EQ(known(cutter + z), listed("[tool.cutter]"));
  EXPECT_EQ(known(cutter + "[[tool.cutter.tooth]]\nnumber = 1\n" + z), listed("[[tool.cutter.tooth]]"));
  EXPECT_EQ(known(mill + "[tool.cutter.insert]\nnose_radius = 1\n" + z), listed("[tool.cutter.insert]"));
}

TEST(DocumentedKeys, OfLampsAndSurfaces) {
  for (const char* table : {"lamp", "surface"}) {
    const std::string head = fmt::format("[[camera.{}]]", table);
    std::set<std::string> keys;
    for (const Row& row : rows())
      if (row.cells.contains("key of `" + head + "`")) keys.insert(row.keys.begin(), row.keys.end());
    EXPECT_EQ(known(head + "\nposition = [0, 0, 1]\n" + z), keys);
  }
}

TEST(DocumentedKeys, OfFeatures) {
  const std::map<std::string, std::string> examples = {{"box", "size = [9, 9, 9]"},
                                                       {"cylinder", "diameter = 9\nheight = 9"},
                                                       {"cone", "diameter = 9\nheight = 9"},
                                                       {"sphere", "diameter = 9"},
                                                       {"torus", "diameter = 9\ntube_diameter = 2"},
                                                       {"hole", "diameter = 9"},
                                                       {"pocket", "size = [9, 9]"},
                                                       {"slot", "size = [9, 5]"},
                                                       {"chamfer", "width = 1\nedges = [[0, 0, 0]]"},
                                                       {"fillet", "radius = 1\nedges = [[0, 0, 0]]"}};
  const std::string heading = "`[[part.feature]]`, `[[fixture.feature]]`";
  int shapes = 0;
  for (const Row& row : rows()) {
    if (row.heading != heading || !row.cells.contains("`shape`")) continue;
    ++shapes;
    const std::string& shape = row.keys.at(0);
    ASSERT_TRUE(examples.contains(shape)) << shape;
    std::set<std::string> keys = {"shape"};
    for (const std::string& key : codeWords(row.cells.at("keys")))
      keys.insert(key);
    const bool placed = shape != "chamfer" && shape != "fillet";
    const bool body = placed && shape != "hole" && shape != "pocket" && shape != "slot";
    if (placed) keys.insert({"centre", "rotation", "pattern"});
    if (body) keys.insert("mode");
    EXPECT_EQ(known(fmt::format("[[part.feature]]\nshape = \"{}\"\n{}\n", shape, examples.at(shape)) + z), keys);
  }
  EXPECT_EQ(shapes, static_cast<int>(examples.size()));
  const std::string feature =
      "[[part.feature]]\nshape = \"box\"\nsize = [9, 9, 9]\n[[part.feature.pattern]]\ncount = 2\n";
  std::set<std::string> pattern = known(feature + "kind = \"linear\"\nspacing = [9, 0, 0]\n" + z);
  pattern.merge(known(feature + "kind = \"circular\"\n" + z));
  std::set<std::string> named;
  for (const Row& row : rows())
    if (row.heading == heading && row.cells.contains("key of a pattern")) named.insert(row.keys.at(0));
  EXPECT_EQ(pattern, named);
}

TEST(DocumentedKeys, OfErrors) {
  const std::string heading = "`[errors]`";
  EXPECT_EQ(known("[errors.axis.X]\n" + z), [&] {
    std::set<std::string> keys = documented(heading, "[errors.axis.X]");
    keys.insert("deviation");
    return keys;
  }());
  EXPECT_EQ(known("[[errors.axis.X.deviation]]\n" + z), documented(heading, "[[errors.axis.X.deviation]]"));
  EXPECT_EQ(known("[[errors.squareness]]\naxis = \"X\"\ntowards = \"Y\"\ndegrees = 1\n" + z),
            documented(heading, "[[errors.squareness]]"));
  EXPECT_EQ(known("[machine]\nname = \"mill5-table-table\"\n[errors.rotary.C]\n" + z),
            documented(heading, "[errors.rotary.C]"));
  EXPECT_EQ(known("[[errors.thermal]]\namount = [0, 0, 1]\n" + z), documented(heading, "[[errors.thermal]]"));
}

TEST(DocumentedKeys, OfMachineFiles) {
  const std::string linear = "name = \"m\"\n[[axis]]\nname = \"X\"\nkind = \"linear\"\nminimum = 0\nmaximum = 9\n";
  const std::string rotary = "name = \"m\"\n[[axis]]\nname = \"C\"\nkind = \"rotary\"\nmodulo = true\n";
  std::set<std::string> all = known(z + linear, true);
  for (const char* table : {"axis", "table_chain", "spindle_chain", "table", "body"})
    EXPECT_EQ(all.erase(table), 1U) << table;
  all.merge(known(linear + z, true));
  all.merge(known(rotary + z, true));
  all.merge(known(linear + "[[table_chain]]\naxis = \"X\"\ndirection = [1, 0, 0]\n" + z, true));
  all.merge(known(rotary + "[[table_chain]]\naxis = \"C\"\ndirection = [0, 0, 1]\n" + z, true));
  std::set<std::string> named;
  for (const Row& row : rows()) {
    if (row.heading == "Machine files" && !row.table.starts_with("[table]"))
      named.insert(row.keys.begin(), row.keys.end());
  }
  EXPECT_EQ(named, all);
}

/// What a range says of a number.
struct Range {
  std::optional<double> minimum, maximum;
  bool openBelow = false, openAbove = false, whole = false;
};

std::optional<Range> rangeOf(const std::string& text) {
  static const std::string number = "(-?[0-9.]+(?:e[0-9]+)?)";
  std::smatch found;
  Range range;
  range.whole = text.find("whole") != std::string::npos;
  if (std::regex_search(text, found, std::regex("^(above )?" + number + " to " + number))) {
    range.openBelow = found[1].matched;
    range.minimum = std::stod(found[2]);
    range.maximum = std::stod(found[3]);
  } else if (std::regex_search(text, found, std::regex("^above " + number))) {
    range.openBelow = true;
    range.minimum = std::stod(found[1]);
  } else if (std::regex_search(text, found, std::regex("^" + number + " or more"))) {
    range.minimum = std::stod(found[1]);
  } else {
    return std::nullopt;
  }
  return range;
}

/// Is the value refused for itself?
bool refused(const std::string& text, const std::string& key, bool machine) {
  for (const Diagnostic& mistake : mistakesOf(text, machine)) {
    if (mistake.message.find("\"" + key + "\"") != std::string::npos &&
        mistake.message.find("must be") != std::string::npos)
      return true;
  }
  return false;
}

TEST(DocumentedKeys, HaveTheRangesOfThePage) {
  // Where a key of a section is written; {} is the key with its value.
  const std::map<std::string, std::string> places = {
      {"Top level", "{}"},
      {"`[[tool]]`", probe + "{}"},
      {"`[[preset]]` and `[[zero_offset]]`", "[[preset]]\n{}"},
      {"`[camera]`", "[camera]\n{}"},
      {"[[camera.lamp]]", "[camera]\n[[camera.lamp]]\nposition = [0, 0, 0]\n{}"},
      {"[[camera.surface]]", "[camera]\n[[camera.surface]]\nsolid = \"part\"\n{}"},
      {"[errors.axis.X]", "[errors.axis.X]\n{}"},
      {"[[errors.axis.X.deviation]]", "[[errors.axis.X.deviation]]\n{}"},
      {"[[errors.squareness]]", "[[errors.squareness]]\naxis = \"X\"\ntowards = \"Y\"\n{}"},
      {"[[errors.thermal]]", "[[errors.thermal]]\namount = [0, 0, 1]\n{}"},
      {"Machine files", "name = \"m\"\n[[axis]]\nname = \"X\"\nkind = \"linear\"\n{}"}};
  const std::map<std::string, std::string> bare = {
      {"number", "[[tool]]\nkind = \"mill\"\nlength = 9\nradius = 1\n{}"},
      {"length", "[[tool]]\nnumber = 1\nkind = \"mill\"\nradius = 1\n{}"},
      {"radius", "[[tool]]\nnumber = 1\nkind = \"mill\"\nlength = 9\n{}"},
      {"ball_radius", "[[tool]]\nnumber = 1\nkind = \"probe\"\nlength = 100\n{}"},
      {"cutting_edge_position", "[[tool]]\nnumber = 1\nkind = \"turn\"\nlength = 9\nradius = 1\n{}"},
      {"tool_change_seconds", "{}"}};
  int checked = 0;
  for (const Row& row : rows()) {
    if (!row.cells.contains("range")) continue;
    const std::optional<Range> range = rangeOf(row.cells.at("range"));
    std::string where = row.table.empty() ? row.heading : row.table;
    for (const std::string table : {"[[camera.lamp]]", "[[camera.surface]]"}) {
      if (row.cells.contains("key of `" + table + "`")) where = table;
    }
    const auto place = places.find(where);
    if (!range || place == places.end()) continue;
    for (const std::string& key : row.keys) {
      if (key == "polynomial" || key == "rotary" || key == "resolution" || key == "distortion")
        continue;  // lists and tables
      const bool machine = row.heading == "Machine files";
      const auto own = bare.find(key);
      const bool tool = row.heading == "`[[tool]]`" || key == "tool_change_seconds";
      const auto takes = [&](double value) {
        const std::string written =
            range->whole || value == std::floor(value) ? fmt::format("{:.0f}", value) : fmt::format("{}", value);
        const std::string& frame = own != bare.end() && tool ? own->second : place->second;
        return !refused(fmt::format(fmt::runtime(frame), key + " = " + written + "\n"), key, machine);
      };
      SCOPED_TRACE(row.heading + " " + row.table + " " + key + ": " + row.cells.at("range"));
      ++checked;
      const double grain = 0.001;
      if (range->minimum) {
        EXPECT_EQ(takes(*range->minimum), !range->openBelow);
        EXPECT_FALSE(takes(*range->minimum - (range->whole ? 1 : grain)));
        if (range->openBelow) {
          EXPECT_TRUE(takes(*range->minimum + grain));
        }
      }
      if (range->maximum) {
        EXPECT_TRUE(takes(*range->maximum));
        EXPECT_FALSE(takes(*range->maximum * (*range->maximum > 0 ? 1.001 : 0.999) + 1));
      }
    }
  }
  EXPECT_GE(checked, 29);
}

TEST(DocumentedKeys, HaveTheDefaultsOfThePage) {
  Diagnostics mistakes;
  const auto setup =
      parseSetup(probe + "[[preset]]\nrow = 1\n[[errors.axis.X.deviation]]\n[[errors.thermal]]\namount = [0, 0, 1]\n",
                 "s.toml", mistakes);
  ASSERT_TRUE(setup);
  const BelievedTool& tool = setup->beliefs.tools.at(0);
  const auto& axis = setup->world.truth.errors.axes.at(0);
  const std::map<std::string, std::string> actual = {
      {"Top level seed", fmt::format("{}", setup->world.truth.seed)},
      {"`[[tool]]` probe_number", fmt::format("{}", tool.probeNumber)},
      {"`[[tool]]` probing_feed", fmt::format("{}", tool.feed)},
      {"`[[tool]]` probing_rapid", fmt::format("{}", tool.rapid)},
      {"`[[tool]]` maximum_travel", fmt::format("{}", tool.maximumTravel)},
      {"`[[tool]]` set_up_clearance", fmt::format("{}", tool.setUpClearance)},
      {"`[[tool]]` calibration_angle", fmt::format("{}", tool.calibrationAngle)},
      {"`[[tool]]` orient", tool.orient ? "true" : "false"},
      {"`[[tool]]` in_spindle", tool.inSpindle ? "true" : "false"},
      {"`[[preset]]` and `[[zero_offset]]` active", setup->beliefs.presets.at(0).active ? "true" : "false"}};
  int compared = 0;
  for (const Row& row : rows()) {
    for (const std::string& key : row.keys) {
      const auto found = actual.find(row.heading + " " + key);
      if (found == actual.end()) continue;
      ++compared;
      EXPECT_EQ(row.cells.at("default"), found->second) << found->first;
    }
  }
  EXPECT_EQ(compared, static_cast<int>(actual.size()));
  // Defaults that the text of a meaning names.
  EXPECT_THAT(page(), HasSubstr(fmt::format("| `wavelength` | mm, degrees | 0.1 to 1000000 | default {} |",
                                            axis.deviations.at(0).wavelength)));
}

}  // namespace
}  // namespace probewright::setup
