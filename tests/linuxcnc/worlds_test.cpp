#include <cstdlib>
#include <random>

#include "linuxcnc/interpreter_bench.hpp"

/// Random places of the part, measured by programs that LinuxCNC runs itself: 50 worlds with PROBEWRIGHT_LONG_TESTS,
/// else a few.
namespace probewright::testing {
namespace {

TEST_F(AsInterpreter, PresetsOfRandomWorldsAreFoundWhereTheyArePlanted) {
  constexpr double feed = 600;
  constexpr double bound = feed / 60 * period + 1e-4;
  const int count = std::getenv("PROBEWRIGHT_LONG_TESTS") != nullptr ? 50 : 5;
  std::mt19937 random(20264);
  std::uniform_real_distribution<double> aside(-1.2, 1.2);
  std::vector<World> worlds;
  session_.write("setup.toml", setup("TNC640", {}, feed));
  session_.write("bore.h", klartext());
  std::string script = keeps;
  for (int i = 0; i < count; ++i) {
    worlds.push_back({aside(random), aside(random), -250 + aside(random), 30 + aside(random) / 10});
    script += call(worlds.back()) + "fresh()\nrun('bore.h', 'w" + std::to_string(i) + "')\n";
    script += "desk.mdi('(PRINT,desk: g" + std::to_string(i) + " #5221 #5222 #5223)')\n";
  }
  atTheDesk(script, 560);
  for (int i = 0; i < count; ++i) {
    const World& planted = worlds[static_cast<std::size_t>(i)];
    const std::vector<double> found = preset("w" + std::to_string(i));
    ASSERT_EQ(found.size(), 3U) << i << "\n" << output;
    EXPECT_NEAR(found[0], planted.x, bound) << i;
    EXPECT_NEAR(found[1], planted.y, bound) << i;
    EXPECT_NEAR(found[2], planted.top, bound) << i;
    const std::vector<double> g54 = session_.told(output, "g" + std::to_string(i));
    ASSERT_EQ(g54.size(), 3U) << i;
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(g54[axis], found[axis], 1e-4) << "the table and G54, world " << i;
  }
}

}  // namespace
}  // namespace probewright::testing
