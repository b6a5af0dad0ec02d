#include "support/lathe_bench.hpp"

/// Every variant of measuring turned parts into every target of correction.
namespace probewright {
namespace {

using namespace testing_support;

constexpr double face = 200;

/// A feature that a tool has made 0.04 too far out (on the radius, or in Z), and the call that finds it.
struct Variant {
  const char* name;
  int position;  ///< of the probe's cutting edge
  std::string way;
  /// Everything in front of S_KNUM, and everything from S_PRNUM to S_NMSP; {} takes S_MVAR's hundreds.
  const char* cycle;
  int units;
  std::string middle;
  int length;  ///< that acts in the measuring axis: 1 or 2
};

const std::vector<Variant>& variants() {
  static const std::vector<Variant> all = {
      {"face", 7, "G0 X40\nG0 Z20\n", "CYCLE974", 0, "1,0,1,6,2,,1", 2},
      {"inside, one point", 7, "G0 X40\nG0 Z20\nG0 Z-10\n", "CYCLE974", 1, "1,60,2,6,2,,1", 1},
      {"outside, one point", 8, "G0 X120\nG0 Z-10\n", "CYCLE974", 2, "1,40,2,6,2,,1", 1},
      {"inside, two points", 7, "G0 X40\nG0 Z20\nG0 Z-10\n", "CYCLE994", 1, "1,60,2,0,30,6,2,1", 1},
      {"outside, two points", 7, "G0 X90\nG0 Z-10\n", "CYCLE994", 2, "1,40,2,0,30,6,2,1", 1},
  };
  return all;
}

setup::Setup setupOf(const Variant& variant) {
  LatheProbe probe;
  probe.position = variant.position;
  if (variant.position == 7) probe.mount = {-80, 0, 0};
  setup::Setup setup = latheSetup(probe);
  const bool inside = variant.units == 1;
  const double out = variant.units == 0 ? 0.04 : 0;
  if (inside) {
    place(setup.world.truth, simulation::Ring(30.04, 50, -100), translation({0, 0, face}));
  } else {
    place(setup.world.truth, simulation::RoundBar(variant.units == 0 ? 30 : 20.04, -100, 0),
          translation({0, 0, face + out}));
  }
  return setup;
}

std::string callOf(const Variant& variant, int task, int knum, int knum1, const std::string& tool, int dl) {
  return fmt::format("DIAMON\nG0 X300\n{}{}({},{},{},{},\"{}\",{},0,0,0,0,0,1,0,,2,0)\n", variant.way, variant.cycle,
                     variant.units + 100 * task, knum, knum1, variant.middle, tool, dl);
}

TEST(TurningTargets, EachVariantIntoEachToolDatum) {
  for (const Variant& variant : variants()) {
    for (int component = 0; component <= 3; ++component) {
      for (int memory = 0; memory <= 4; ++memory) {
        for (const bool inverted : {false, true}) {
          const int edge = 1 + (component + memory) % 2, dl = 1 + (component + 2 * memory) % 6;
          SCOPED_TRACE(fmt::format("{} component {} memory {} {} D{} DL{}", variant.name, component, memory,
                                   inverted ? "inverted" : "", edge, dl));
          LatheBench bench(setupOf(variant));
          plantFrame(bench, "$P_UIFR", 1, 0, face);
          for (int parameter = 1; parameter <= 6; ++parameter)
            bench.set(fmt::format("$TC_DP{}", parameter), {2, 2},
                      bench.data(fmt::format("$TC_DP{}", parameter), {2, 1}));
          const int length = component == 0 ? variant.length : component;
          const std::string additive = fmt::format("$TC_SCP{}", 10 * dl + 2 + length),
                            setup = fmt::format("$TC_ECP{}", 10 * dl + 2 + length),
                            geometry = fmt::format("$TC_DP{}", 2 + length), wear = fmt::format("$TC_DP{}", 11 + length);
          bench.set(additive, {2, edge}, 0.5);
          bench.set(setup, {2, edge}, 0.25);
          const double before = bench.data(geometry, {2, edge});
          const int code = 1000000 * memory + 100000 * component + (inverted ? 10000 : 0) + edge;
          bench.run(callOf(variant, 2, 0, code, component % 2 == 0 ? "finish" : "2", dl));
          // The tool reaches 0.04 further than its data say.
          const double change = inverted ? 0.04 : -0.04;
          const double expected[] = {change, 0.5 + change, 0.25 + 0.5 + change, 0.25 + change, before + change};
          const std::string* data[] = {&wear, &additive, &setup, &setup, &geometry};
          EXPECT_NEAR(bench.data(*data[memory], {2, edge}), expected[memory], 1e-7) << *data[memory];
          if (memory == 2) {
            EXPECT_EQ(bench.data(additive, {2, edge}), 0);
          }
          EXPECT_NEAR(bench.ovr(20), change, 1e-7);
          EXPECT_EQ(bench.control.journal.cycles.back().writes.size(), memory == 2 ? 2U : 1U) << "nothing else";
          EXPECT_EQ(bench.ovi(0), edge);
          EXPECT_EQ(bench.ovi(8), 2);
          EXPECT_EQ(bench.ovi(13), memory >= 1 && memory <= 3 ? dl : 0);
          EXPECT_EQ(bench.control.data.text("_OVS_TNAME", {}), "FINISH");
        }
      }
    }
  }
}

TEST(TurningTargets, EachVariantIntoEachZeroOffset) {
  const struct {
    int knum;
    const char* frame;
    int number;
    const char* part;
  } targets[] = {{1, "$P_UIFR", 1, "FI"},     {10001, "$P_UIFR", 1, "TR"},  {9000, "$P_UIFR", 1, "FI"},
                 {19000, "$P_UIFR", 1, "TR"}, {1001, "$P_CHBFR", 0, "FI"},  {11002, "$P_CHBFR", 1, "TR"},
                 {3001, "$P_NCBFR", 0, "FI"}, {13002, "$P_NCBFR", 1, "TR"}, {3, "$P_UIFR", 3, "FI"},
                 {10006, "$P_UIFR", 6, "TR"}};
  for (const Variant& variant : variants()) {
    for (const auto& target : targets) {
      SCOPED_TRACE(fmt::format("{} into {}", variant.name, target.knum));
      LatheBench bench(setupOf(variant));
      // Those that are not active stand where the active one does.
      for (const int number : {1, 3, 6})
        plantFrame(bench, "$P_UIFR", number, 0, face);
      const char* axis = variant.length == 2 ? "Z" : "X";
      const double before = bench.data(target.frame, {target.number, axis, target.part});
      const std::string program = callOf(variant, 1, target.knum, 0, "", 0);
      if (std::string_view(variant.cycle) == "CYCLE994") {
        EXPECT_EQ(bench.alarmOf(program), "61307") << "two points correct no zero offset";
        continue;
      }
      bench.run(program);
      EXPECT_NEAR(bench.data(target.frame, {target.number, axis, target.part}) - before, 0.04, 1e-7);
      const auto& writes = bench.control.journal.cycles.back().writes;
      ASSERT_EQ(writes.size(), 1U);
      EXPECT_EQ(writes[0].table, target.frame);
      EXPECT_EQ(bench.ovi(11), 1);
    }
  }
}

TEST(TurningTargets, TheBaseReferenceFineAndCoarse) {
  for (const Variant& variant : variants()) {
    if (std::string_view(variant.cycle) == "CYCLE994") continue;
    for (const auto& [knum, part] : {std::pair(2000, "FI"), std::pair(12000, "TR")}) {
      SCOPED_TRACE(fmt::format("{} into {}", variant.name, knum));
      LatheBench bench(setupOf(variant));
      plantFrame(bench, "$P_UIFR", 1, 0, face);
      bench.run(callOf(variant, 1, knum, 0, "", 0));
      EXPECT_NEAR(bench.data("$P_SETFR", {variant.length == 2 ? "Z" : "X", part}), 0.04, 1e-7);
      EXPECT_EQ(bench.control.journal.cycles.back().writes.size(), 1U);
      EXPECT_EQ(bench.ovi(0), 2000);
    }
  }
}

}  // namespace
}  // namespace probewright
