#include "support/result_screen.hpp"

#include <functional>

#include "support/lathe_bench.hpp"

/// Screens and logs of every measuring variant of turning, on parts whose errors are planted.
namespace probewright {
namespace {

using namespace testing_support;

constexpr double face = 200;

struct Variant {
  const char* cycle;
  int mvar;
  int position;  ///< of the probe
  std::function<void(simulation::Truth&)> part;
  std::string way, arguments;  ///< those behind S_MVAR
  std::vector<std::pair<std::string, std::vector<std::string>>> rows;
};

std::function<void(simulation::Truth&)> bar(double radius, double length = 0) {
  return [=](simulation::Truth& truth) {
    place(truth, simulation::RoundBar(radius, -100, 0), translation({0, 0, face + length}));
  };
}
std::function<void(simulation::Truth&)> bore(double radius) {
  return [=](simulation::Truth& truth) { place(truth, simulation::Ring(radius, 70, -100), translation({0, 0, face})); };
}

/// The reference groove 1, open to +X, and its entry in the setting data.
void groove(simulation::Truth& truth) {
  place(truth, simulation::Box({90, -20, 270}, {100, 20, 310}));
  place(truth, simulation::Box({100, -20, 270}, {112, 20, 280}));
  place(truth, simulation::Box({100, -20, 300}, {112, 20, 310}));
}
void enterGroove(LatheBench& bench) {
  bench.set("$SNS_MEA_CAL_EDGE_BASE_AX2", {0}, 100);
  bench.set("$SNS_MEA_CAL_EDGE_UPPER_AX2", {0}, 112);
  bench.set("$SNS_MEA_CAL_EDGE_PLUS_DIR_AX1", {0}, 300);
  bench.set("$SNS_MEA_CAL_EDGE_MINUS_DIR_AX1", {0}, 280);
}

std::vector<Variant> variants() {
  const std::string outside = "G0 X110\nG0 Z-10\n", inside = "G0 Z30\nG0 X60\nG0 Z-10\n",
                    front = "G0 Z40\nG0 X40\nG0 Z12\n", overGroove = "G0 X264 Z92\n";
  return {
      {"CYCLE973",
       1100,
       8,
       bar(40),
       outside,
       ",1,,80,2,1,6,4,200",
       {{"trigger point, minus direction, 2nd axis [mm]", {"-2.0000", "0.0000"}}}},
      {"CYCLE973", 1101, 8, bar(40), outside, ",1,,80,2,1,6,4,200", {{"safe area [mm]", {"4.0000"}}}},
      {"CYCLE973", 102, 8, groove, overGroove, ",1,1,,,,3,4", {{"probe number", {"1"}}}},
      {"CYCLE973",
       2103,
       8,
       groove,
       overGroove,
       ",1,1,,1,,3,4",
       {{"trigger point, minus direction, 1st axis [mm]", {"-2.0000", "0.0000"}},
        {"trigger point, plus direction, 1st axis [mm]", {"2.0000", "0.0000"}}}},
      {"CYCLE974",
       100,
       7,
       bar(40, 0.25),
       front,
       ",1,,1,0,1,6,4",
       {{"measuring axis [mm]", {"0.0000", "0.2500", "0.2500"}},
        {"1st axis of the plane [mm]", {"0.0000", "0.2500", "0.2500"}},
        {"corrected", {"$P_UIFR[1,Z,FI]"}}}},
      {"CYCLE974",
       1,
       7,
       bore(40.1),
       inside,
       ",,,1,80,2,6,4",
       {{"2nd axis of the plane [mm]", {"80.0000", "80.2000", "0.2000"}}}},
      {"CYCLE974",
       202,
       8,
       bar(40.05),
       outside,
       ",,1,1,80,2,6,4,,1,\"FINISH\",,0.001,0.5,0.2,-0.2,,1,,,2,1",
       {{"measuring axis [mm]", {"80.0000", "80.1000", "0.1000", "79.8000", "80.2000", "good"}},
        {"correction value of the tool [mm]", {"-0.0500"}},
        {"dimensional difference [mm]", {"0.5000"}},
        {"corrected tool", {"T", "FINISH", "D1"}},
        {"corrected", {"$TC_DP12[2,1]"}}}},
      {"CYCLE974",
       10002,
       8,
       bar(39.9),
       outside,
       ",,,1,80,2,6,4,30",
       {{"measuring axis [mm]", {"80.0000", "79.8000", "-0.2000"}}}},
      {"CYCLE994",
       1,
       7,
       bore(40.1),
       inside,
       ",,,1,80,2,0,30,6,4",
       {{"2nd axis of the plane [mm]", {"80.0000", "80.2000", "0.2000"}}}},
      {"CYCLE994",
       1202,
       7,
       bar(20.1),
       "G0 X80\nG0 Z-10\n",
       ",,1,1,40,2,66,28,4,3,1,\"FINISH\",,0.001,0.5,0.3,-0.3,,1,,,2,1",
       {{"measuring axis [mm]", {"40.0000", "40.2000", "0.2000", "39.7000", "40.3000", "good"}},
        {"corrected tool", {"T", "FINISH", "D1"}}}},
  };
}

TEST(TurningScreens, HaveWhatTheControlShowsInEveryVariant) {
  for (const Variant& variant : variants()) {
    SCOPED_TRACE(fmt::format("{} S_MVAR {}", variant.cycle, variant.mvar));
    LatheProbe probe;
    probe.position = variant.position;
    if (probe.position != 8) probe.mount = {-75, 0, 0};
    setup::Setup setup = latheSetup(probe);
    variant.part(setup.world.truth);
    LatheBench bench(setup);
    enterGroove(bench);
    plantFrame(bench, "$P_UIFR", 1, 0, face);
    showAndLog(bench.control);
    bench.run("DIAMON\nG0 X300\n" + variant.way +
              fmt::format("{}({}{})", variant.cycle, variant.mvar, variant.arguments));
    ASSERT_FALSE(bench.control.journal.cycles.empty());
    expectScreenAndLogs(bench.control, variant.cycle, variant.mvar);
    const std::string text = bench.control.journal.cycles.back().screens.back();
    for (const auto& [label, words] : variant.rows)
      EXPECT_EQ(ResultScreen(text).row(label), words) << label << "\n" << text;
  }
}

}  // namespace
}  // namespace probewright
