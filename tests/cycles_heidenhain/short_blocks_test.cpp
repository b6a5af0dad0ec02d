#include <map>

#include "cycles/heidenhain/registry.hpp"
#include "cycles_heidenhain/travel_cases.hpp"

/// Blocks of older controls, which end before the parameters that came later: these count as the manuals say.
namespace probewright::testing_support {
namespace {

/// What parameters that are left out stand for.
double standardOf(int cycle, int parameter) {
  static const std::map<int, double> values = {{305, 0}, {402, 0}, {337, 0}, {380, 0}, {381, 0}, {382, 0},
                                               {383, 0}, {384, 0}, {333, 0}, {320, 0}, {423, 4}, {365, 1},
                                               {331, 0}, {332, 0}, {405, 0}, {301, 0}};
  if (parameter == 303) return cycle == 403 ? 1 : -1;
  return values.at(parameter);
}

TEST(ShortBlocks, MeanWhatTheManualsSay) {
  for (const travel::Case& one : travel::cases()) {
    if (one.cycle == 405) continue;  // it has no such parameters
    for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
      if (one.newerOnly && kind != ControlKind::TNC640) continue;
      SCOPED_TRACE(fmt::format("cycle {} on the {}", one.cycle, control::name(kind)));
      const cycles::CycleDefinition& cycle = cycles::heidenhain::findEntry(one.cycle)->definition;
      // Without Q303 only row 0 can be meant.
      Words words = one.words;
      if (one.cycle >= 408) words = with(words, {{305, 0}});
      Words required, full;
      for (const cycles::Parameter& parameter : cycle.parameters) {
        if (!parameter.controls.contains(kind)) continue;
        const int number = static_cast<int>(parameter.address);
        const auto given = std::ranges::find(words, number, &std::pair<int, double>::first);
        if (parameter.required()) {
          required.emplace_back(number, given == words.end() ? 0 : given->second);
          full.push_back(required.back());
        } else if (number != 303 || one.cycle > 409) {  // 408 and 409 do not print -1
          full.emplace_back(number, standardOf(one.cycle, number));
        }
      }
      ASSERT_LT(required.size(), full.size());
      Bench bench(kind, one.cycle == 403 ? "mill5-table-table" : "mill3");
      bench.preset(1, {0.5, -0.25, -400});
      one.lay(bench);
      const Ran little = bench.run(probe(one.cycle, required)), all = bench.run(probe(one.cycle, full));
      ASSERT_TRUE(little.finished()) << little.why();
      ASSERT_TRUE(all.finished()) << all.why();
      EXPECT_EQ(little.touches(), all.touches());
      EXPECT_TRUE(little.preset().isApprox(all.preset(), 1e-12));
      EXPECT_EQ(little.table("PRESET.PR").table().bytes(), all.table("PRESET.PR").table().bytes());
    }
  }
}

TEST(ShortBlocks, OfCycle404SetTheActivePreset) {
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    Bench bench(kind);
    bench.preset(1, {1, 2, -400}, 9, false);
    bench.preset(3, {10, 20, -400}, 5);
    const Ran ran = bench.run(probe(404, {{307, -4}}));
    ASSERT_TRUE(ran.finished()) << ran.why();
    const char* column = kind == ControlKind::TNC640 ? "SPC" : "ROT";
    EXPECT_EQ(ran.cell("PRESET.PR", "3", column), -4);
    EXPECT_EQ(ran.cell("PRESET.PR", "1", column), 9);
  }
}

}  // namespace
}  // namespace probewright::testing_support
