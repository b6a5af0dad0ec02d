#include "lathe_tools/tool_bench.hpp"

/// CYCLE982 in inches, with diameters, and in systems that mirror X.
namespace probewright {
namespace {

using namespace testing_support;

setup::Setup world() {
  setup::Setup setup = toolSetup();
  add(setup, turningTool(5, 3, {80, 40}, 0.8), "turn");
  return setup;
}

void believeWrong(LatheBench& bench) {
  bench.set("$TC_DP3", {5, 1}, 80.2);
  bench.set("$TC_DP4", {5, 1}, 39.9);
}

void expectRight(LatheBench& bench, double unit = 1) {
  EXPECT_NEAR(bench.data("$TC_DP3", {5, 1}), 80, 1e-6);
  EXPECT_NEAR(bench.data("$TC_DP4", {5, 1}), 40, 1e-6);
  EXPECT_NEAR(bench.ovr(9) * unit, -0.2, 1e-6);
  EXPECT_NEAR(bench.ovr(11) * unit, 0.1, 1e-6);
}

TEST(LatheToolUnits, LengthsAreTheSameInInches) {
  LatheBench bench(world());
  believeWrong(bench);
  bench.run(fmt::format("G700\nDIAMOF\nT5 D1\nG0 Z{:.9f}\nG0 X{:.9f}\nCYCLE982(2,0,1,,,,{:.9f},{:.9f})", 440 / 25.4,
                        190 / 25.4, 5 / 25.4, 1 / 25.4));
  expectRight(bench, 25.4);
}

TEST(LatheToolUnits, LengthsAreTheSameInDiameters) {
  LatheBench bench(world());
  believeWrong(bench);
  bench.run("DIAMON\nT5 D1\nG0 Z440\nG0 X380\nCYCLE982(2,0,1,,,,5,1)");
  expectRight(bench);
}

/// Seen from a system whose X points the other way, the contact and the tool lie mirrored; the lengths are those of the
/// machine.
TEST(LatheToolFrames, XMayBeMirrored) {
  LatheBench bench(world());
  believeWrong(bench);
  bench.set("$P_UIFR", {1, "X", "MI"}, 1);
  bench.set(triggerName(1, -1, "TPW"), {0}, 410);
  bench.set(triggerName(1, 1, "TPW"), {0}, 390);
  // In minus direction of the mirrored X the tool travels towards plus of the machine.
  bench.set(triggerName(2, -1, "TPW"), {0}, -140);
  bench.set(triggerName(2, 1, "TPW"), {0}, -160);
  bench.run("DIAMOF\nT5 D1\nG0 Z440\nG0 X-190\nCYCLE982(12,0,1,,,,5,1)");
  expectRight(bench);
}

}  // namespace
}  // namespace probewright
