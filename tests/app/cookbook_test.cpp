#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <sstream>

#include "app/program.hpp"

/// The recipes of docs/cookbook.md: after each one the control believes what is true.
namespace probewright::app::testing {
namespace {

using ::testing::HasSubstr;

const std::string root = PROBEWRIGHT_SOURCE_DIR;

/// Runs a recipe on its setup; what it leaves is in `out`.
Answer cook(const std::string& program, const std::filesystem::path& out) {
  const std::string path = root + "/examples/cookbook/" + program;
  const std::string setup = path.substr(0, path.rfind('.')) + ".toml";
  return probewright({"run", path, "--setup", setup, "--out", out.string()});
}

/// The text in a column of a row in a table of fixed columns.
std::string cell(const std::filesystem::path& file, const std::string& row, const std::string& column) {
  std::istringstream table(textOf(file));
  std::string line, head;
  std::getline(table, line);  // BEGIN
  std::getline(table, head);
  std::size_t at = head.find(" " + column + " ");
  if (at == std::string::npos) throw std::runtime_error("no column " + column);
  ++at;
  while (std::getline(table, line))
    if (line.starts_with(row + " ")) return line.substr(at, line.find(' ', at) - at);
  throw std::runtime_error("no row " + row);
}

double number(const std::filesystem::path& file, const std::string& row, const std::string& column) {
  return std::stod(cell(file, row, column));
}

TEST(Cookbook, SetsUpOnEdgeAndBore) {
  const Folder folder;
  const Answer answer = cook("set-up.h", folder / "out");
  ASSERT_EQ(answer.exit, 0) << answer.output << answer.errors;
  const auto presets = folder / "out/PRESET.PR";
  EXPECT_NEAR(number(presets, "1", "X"), -48.7, 1e-4);
  EXPECT_NEAR(number(presets, "1", "Y"), -30.8, 1e-4);
  EXPECT_NEAR(number(presets, "1", "Z"), -469.6, 1e-4);
  EXPECT_NEAR(number(presets, "1", "SPC"), 0.8, 1e-4);
}

TEST(Cookbook, InspectsABoreAndCorrectsTheTool) {
  const Folder folder;
  const Answer answer = cook("inspect.h", folder / "out");
  ASSERT_EQ(answer.exit, 1) << answer.output << answer.errors;
  EXPECT_THAT(answer.output, HasSubstr("REWORK"));
  // Half of what the bore of 39.96 lacks of 40.0125.
  EXPECT_NEAR(number(folder / "out/TOOL.T", "5", "DR"), (39.96 - 40.0125) / 2, 1e-4);
}

TEST(Cookbook, PutsADatumOnAFaceThatStandsAskew) {
  const Folder folder;
  const Answer answer = cook("tilted-datum.h", folder / "out");
  ASSERT_EQ(answer.exit, 0) << answer.output << answer.errors;
  const auto presets = folder / "out/PRESET.PR";
  EXPECT_NEAR(number(presets, "1", "X"), 1.2, 1e-4);
  EXPECT_NEAR(number(presets, "1", "Y"), -0.7, 1e-4);
  EXPECT_NEAR(number(presets, "1", "Z"), -479.4, 1e-4);
  EXPECT_NEAR(number(presets, "1", "SPA"), 1.5, 1e-4);
  EXPECT_NEAR(number(presets, "1", "SPB"), -0.9, 1e-4);
}

TEST(Cookbook, CalibratesOnARingAndOnASphere) {
  const Folder folder;
  const Answer answer = cook("calibrate.h", folder / "out");
  ASSERT_EQ(answer.exit, 0) << answer.output << answer.errors;
  EXPECT_NEAR(number(folder / "out/TOOL.T", "1", "L"), 140.25, 1e-4);
  EXPECT_NEAR(number(folder / "out/TOOL.T", "1", "R"), 3 - 0.006, 1e-4);
  EXPECT_EQ(cell(folder / "out/TOOL.T", "1", "DR2TABLE"), "T1.3DTC");
  EXPECT_NEAR(number(folder / "out/TCHPROBE.TP", "1", "CAL_OF1"), 0.03, 1e-4);
  EXPECT_NEAR(number(folder / "out/TCHPROBE.TP", "1", "CAL_OF2"), -0.02, 1e-4);
}

TEST(Cookbook, RunsTheFirstProgramInSinumerik) {
  const Folder folder;
  const Answer answer = cook("first.mpf", folder / "out");
  ASSERT_EQ(answer.exit, 0) << answer.output << answer.errors;
  const std::string frames = textOf(folder / "out/FRAMES.UFR");
  const auto component = [&](const std::string& name) {
    const std::string head = "$P_UIFR[1," + name + "]=";
    const std::size_t at = frames.find(head);
    if (at == std::string::npos) throw std::runtime_error("no " + head);
    return std::stod(frames.substr(at + head.size()));
  };
  EXPECT_NEAR(component("X,TR"), -48.7, 1e-6);
  EXPECT_NEAR(component("Y,TR"), -30.8, 1e-6);
  EXPECT_NEAR(component("Z,TR"), -469.6, 1e-6);
  EXPECT_NEAR(component("Z,RT"), 0.8, 1e-6);
}

/// A row of docs/troubleshooting.md that can be tried.
struct Trial {
  std::string alarm, recipe, before, after;
};

std::vector<Trial> trials() {
  std::vector<Trial> found;
  std::istringstream page(textOf(root + "/docs/troubleshooting.md"));
  const std::regex row(R"(\| ([^|]+) \|.*\| ([a-z-]+): `([^`]+)` -> `([^`]+)`( and a line `([^`]+)`)? \|)");
  for (std::string line; std::getline(page, line);) {
    std::smatch match;
    if (!std::regex_match(line, match, row)) continue;
    found.push_back({match[1], match[2], match[3], match[4]});
    if (match[6].matched) found.back().after += "\n" + match[6].str();
  }
  return found;
}

TEST(Troubleshooting, EachChangeOfThePageEndsAsItSays) {
  const std::vector<Trial> all = trials();
  EXPECT_GE(all.size(), 12U);
  for (const Trial& trial : all) {
    SCOPED_TRACE(trial.alarm + ": " + trial.recipe + " " + trial.before + " -> " + trial.after);
    const Folder folder;
    const std::string name = trial.recipe + (trial.recipe == "first" ? ".mpf" : ".h");
    int changed = 0;
    const auto copy = [&](const std::string& file) {
      std::string text = textOf(root + "/examples/cookbook/" + file);
      if (const std::size_t at = text.find(trial.before); at != std::string::npos) {
        text.replace(at, trial.before.size(), trial.after);
        ++changed;
      }
      return folder.file(file, text);
    };
    const std::string program = copy(name), setup = copy(trial.recipe + ".toml");
    EXPECT_EQ(changed, 1);
    const Answer answer = probewright({"run", program, "--setup", setup, "--out", (folder / "out").string()});
    EXPECT_THAT(answer.output + answer.errors, HasSubstr(trial.alarm));
    EXPECT_EQ(answer.exit, trial.recipe == "inspect" ? 1 : 3);
  }
}

}  // namespace
}  // namespace probewright::app::testing
