#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "app/program.hpp"

/// The length of the path that results.json tells.
namespace probewright::app::testing {
namespace {

/// The length of the path of a tool of this length from the turning axis of the table to X100, and then by `turn`.
double swungPath(const Folder& folder, double toolLength, const std::string& turn) {
  const std::string setup =
      "[control]\ntype = \"TNC640\"\n[machine]\nname = \"mill5-head-table\"\n[[tool]]\nnumber = 1\nkind = "
      "\"probe\"\nball_radius = 3\nlength = " +
      std::to_string(toolLength) + "\n";
  const std::string program =
      "BEGIN PGM SWING MM\nTOOL CALL 1 Z S500\nL X+100 R0 FMAX\nL " + turn + " FMAX\nEND PGM SWING MM\n";
  const Answer ran = probewright({"run", folder.file("SWING.H", program), "--setup", folder.file("s.toml", setup),
                                  "--out", (folder / "out").string(), "--quiet"});
  EXPECT_EQ(ran.exit, 0) << ran.errors;
  return nlohmann::json::parse(textOf(folder / "out/results.json"))["totals"]["pathLength"];
}

/// The head swings the tip about B, whose axis lies as far from the spindle nose as from a tool without length. The
/// table turns under the tip, which moves over it.
TEST(WayOfTheTip, CountsTheArcsOfRotaryAxes) {
  const Folder folder;
  EXPECT_NEAR(swungPath(folder, 150, "B+0"), 100, 1e-9);
  const double quarter = swungPath(folder, 150, "B+90") - 100, shorter = swungPath(folder, 90, "B+90") - 100;
  EXPECT_NEAR(quarter - shorter, 60 * std::numbers::pi / 2, 1e-3);
  EXPECT_NEAR((swungPath(folder, 150, "B+30") - 100) * 3, quarter, 2e-3);
  EXPECT_NEAR(swungPath(folder, 150, "C+90"), 100 + 100 * std::numbers::pi / 2, 1e-3);
}

}  // namespace
}  // namespace probewright::app::testing
