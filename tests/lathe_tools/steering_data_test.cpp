#include "lathe_tools/tool_bench.hpp"

/// What the setting data steer while a tool is measured: bits 16 to 19 of SD 55740, 16 to 18 of SD 54740. Those of
/// workpieces do nothing then.
namespace probewright {
namespace {

using namespace testing_support;
using simulation::PathKind;

class SteeredTool : public testing::Test {
protected:
  static setup::Setup world() {
    setup::Setup setup = toolSetup();
    add(setup, turningTool(5, 3, {80, 40}, 0.8), "turn");
    return setup;
  }
  SteeredTool() : bench(world()) {}

  void setBit(const char* mask, int bit, bool value) {
    control::sinumerik::setMaskBit(bench.control.data, mask, bit, value);
  }
  /// Measures length 2, which the control has wrong by 0.2; how it ends.
  std::string measure(const char* limits = "1", double path = 5) {
    bench.set("$TC_DP4", {5, 1}, 40.2);
    from_ = bench.machine.path().points.size();
    const auto result = bench.tryRun(measuring(5, startOf(3), fmt::format("CYCLE982(1,0,1,1,,,{},{})", path, limits)));
    return result.diagnostics.empty() ? std::string() : result.diagnostics.front().code;
  }
  /// True if a piece of path of this kind was travelled at this feed, mm/min.
  bool travelled(PathKind kind, double feed, double least = 3) const {
    const auto& points = bench.machine.path().points;
    for (std::size_t i = std::max<std::size_t>(from_, 1); i < points.size(); ++i) {
      const double way = (points[i].tip - points[i - 1].tip).norm();
      if (points[i].kind != kind || way < least) continue;
      const double speed = 60 * way / (points[i].seconds - points[i - 1].seconds);
      if (speed < 1.0001 * feed && speed > 0.95 * feed) return true;
    }
    return false;
  }
  auto countOf(PathKind kind) const {
    const auto& points = bench.machine.path().points;
    return std::count_if(points.begin() + static_cast<std::ptrdiff_t>(from_), points.end(),
                         [kind](const auto& point) { return point.kind == kind; });
  }
  auto stops() const {
    return std::ranges::count(bench.control.journal.events, control::EventKind::Stop, &control::EventRecord::kind);
  }
  double rapidOf(const char* axis) const {
    const auto& machine = bench.control.channel.description();
    return machine.axes[*machine.axisIndex(axis)].rapid;
  }

  LatheBench bench;

private:
  std::size_t from_ = 0;
};

TEST_F(SteeredTool, MovesAndTouchesWithTheUsualFeeds) {
  for (const int bit : {0, 4, 5})
    setBit("$SCS_MEA_FUNCTION_MASK", bit, bit != 0);
  EXPECT_EQ(measure(), "");
  EXPECT_TRUE(travelled(PathKind::Feed, 1000));
  EXPECT_TRUE(travelled(PathKind::Measure, 300));
  EXPECT_TRUE(travelled(PathKind::Retract, 1000));
  EXPECT_EQ(countOf(PathKind::Measure), 1);
}

TEST_F(SteeredTool, Bit16PositionsAtReducedRapid) {
  setBit("$SCS_MEA_FUNCTION_MASK", 16, false);
  bench.set("$SCS_MEA_FEED_RAPID_IN_PERCENT", {}, 5);
  EXPECT_EQ(measure(), "");
  EXPECT_TRUE(travelled(PathKind::Feed, 0.05 * rapidOf("X")));
}

TEST_F(SteeredTool, Bit18ApproachesFast) {
  setBit("$SCS_MEA_FUNCTION_MASK", 18, true);
  bench.set("$SCS_MEA_FEED_FAST_MEASURE", {}, 600);
  EXPECT_EQ(measure(), "");
  EXPECT_EQ(countOf(PathKind::Measure), 2) << "fast, and the one that counts";
  EXPECT_TRUE(travelled(PathKind::Measure, 600));
  EXPECT_TRUE(travelled(PathKind::Measure, 300, 1.5));
  EXPECT_NEAR(bench.data("$TC_DP4", {5, 1}), 40, 1e-6);
}

TEST_F(SteeredTool, Bit18ApproachesNotFastOnTheWayOfAMillimetre) {
  setBit("$SCS_MEA_FUNCTION_MASK", 18, true);
  for (const auto& [path, touches] : {std::pair(1.0, 1), std::pair(1.01, 2)}) {
    EXPECT_EQ(measure("1", path), "");
    EXPECT_EQ(countOf(PathKind::Measure), touches) << path;
    EXPECT_NEAR(bench.data("$TC_DP4", {5, 1}), 40, 1e-6) << path;
  }
}

TEST_F(SteeredTool, Bit19RetractsAtReducedRapid) {
  setBit("$SCS_MEA_FUNCTION_MASK", 19, true);
  bench.set("$SCS_MEA_FEED_RAPID_IN_PERCENT", {}, 2);
  EXPECT_EQ(measure(), "");
  EXPECT_TRUE(travelled(PathKind::Retract, 0.02 * rapidOf("Z")));
}

TEST_F(SteeredTool, Bits16And17RepeatAndAskBefore) {
  for (const int bit : {0, 1, 2})
    setBit("$SNS_MEA_FUNCTION_MASK", bit, true);
  EXPECT_EQ(measure("1,,,,0,0.1"), "");
  EXPECT_EQ(stops(), 0);
  EXPECT_EQ(countOf(PathKind::Measure), 1) << "those are of workpieces";
  setBit("$SNS_MEA_FUNCTION_MASK", 16, true);
  EXPECT_EQ(measure("1,,,,0,0.1"), "");
  EXPECT_EQ(countOf(PathKind::Measure), 5);
  EXPECT_EQ(stops(), 0);
  setBit("$SNS_MEA_FUNCTION_MASK", 17, true);
  EXPECT_EQ(measure("1,,,,0,0.1"), "");
  EXPECT_EQ(countOf(PathKind::Measure), 5);
  EXPECT_EQ(stops(), 4);
  EXPECT_EQ(measure("0.1"), "61303");
  EXPECT_EQ(countOf(PathKind::Measure), 5);
  EXPECT_EQ(stops(), 8);
}

TEST_F(SteeredTool, Bit18StopsBeyondTheDimensionalDifference) {
  setBit("$SNS_MEA_FUNCTION_MASK", 18, true);
  EXPECT_EQ(measure("1,,,,0,0.1"), "");
  EXPECT_EQ(stops(), 1);
  EXPECT_EQ(measure("1,,,,0,0.3"), "");
  EXPECT_EQ(stops(), 1);
}

}  // namespace
}  // namespace probewright
