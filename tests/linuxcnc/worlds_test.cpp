#include <cstdlib>
#include <random>

#include "linuxcnc/interpreter_bench.hpp"

/// Random places of the part, measured by programs that LinuxCNC runs itself: 50 worlds in five sessions with
/// PROBEWRIGHT_LONG_TESTS (11 minutes), else a few in one.
namespace probewright::testing {
namespace {

class RandomWorlds : public AsInterpreter, public ::testing::WithParamInterface<int> {};

TEST_P(RandomWorlds, PresetsAreFoundWhereTheyArePlanted) {
  constexpr double feed = 600;
  constexpr double bound = feed / 60 * period + 1e-4;
  const bool all = std::getenv("PROBEWRIGHT_LONG_TESTS") != nullptr;
  if (!all && GetParam() > 0) GTEST_SKIP() << "set PROBEWRIGHT_LONG_TESTS to run it";
  const int count = all ? 10 : 5;
  std::mt19937 random(static_cast<unsigned>(20264 + GetParam()));
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
  double worst = 0;
  for (int i = 0; i < count; ++i) {
    const World& planted = worlds[static_cast<std::size_t>(i)];
    const std::vector<double> found = preset("w" + std::to_string(i));
    ASSERT_EQ(found.size(), 3U) << i << "\n" << output;
    const std::vector<double> truth = {planted.x, planted.y, planted.top};
    const std::vector<double> g54 = session_.told(output, "g" + std::to_string(i));
    ASSERT_EQ(g54.size(), 3U) << i;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(found[axis], truth[axis], bound) << "world " << i << ", axis " << axis;
      EXPECT_NEAR(g54[axis], found[axis], 1e-4) << "the table and G54, world " << i;
      worst = std::max(worst, std::abs(found[axis] - truth[axis]));
    }
  }
  std::printf("%d worlds: presets are off by %.4f mm at most; a servo period is %.4f\n", count, worst,
              feed / 60 * period);
}

INSTANTIATE_TEST_SUITE_P(Session, RandomWorlds, ::testing::Range(0, 5));

}  // namespace
}  // namespace probewright::testing
