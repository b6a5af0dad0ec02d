#include "cycles/heidenhain/registry.hpp"
#include "cycles_heidenhain/table_folder.hpp"
#include "cycles_heidenhain/worlds.hpp"

/// What holds for every misalignment and presetting cycle: inch programs set the same presets, a datum table takes the
/// shift that a preset takes, and a transfer to nowhere is refused.
namespace probewright::testing_support {
namespace {

using cycles::ValueKind;

constexpr double exact = 1e-6, inch = 25.4;
const Vector3 origin(5, -8, -400);

/// Places on the part, mm, multiples of 2.54: inch programs write them without rounding.
struct Case {
  int cycle;
  Words words;
  std::function<void(Bench&)> lay;
};

void box(Bench& bench, const Vector3& low, const Vector3& high) {
  bench.part(simulation::Box(low, high), pose(origin, {0, 0, 0.7}));
}
void ring(Bench& bench, double x, double y, double radius) {
  bench.part(simulation::Ring(radius, radius + 8, -40), pose(origin + Vector3(x, y, 0)));
}
void bar(Bench& bench, double x, double y, double radius) {
  bench.part(simulation::RoundBar(radius, -40, 0), pose(origin + Vector3(x, y, 0)));
}

const Words height = {{261, -7.62}, {260, 25.4}};
const Words edge =
    with(height, {{263, 10.16}, {264, 0}, {265, 60.96}, {266, 0}, {272, 2}, {267, 1}, {320, 2.54}, {301, 1}});
const Words target = {{305, 1}, {303, 1}, {331, 12.7}, {332, -2.54}, {381, 1},
                      {382, 0}, {383, 0}, {384, 0},    {333, 7.62}};
const Words circle =
    with(height, {{321, 50.8}, {322, 25.4}, {262, 30.48}, {325, 10}, {247, 90}, {320, 2.54}, {301, 1}});
const Words rectangle = with(height, {{321, 50.8}, {322, 25.4}, {323, 76.2}, {324, 50.8}, {320, 2.54}, {301, 1}});
const Words slot = with(height, {{321, 50.8},
                                 {322, 25.4},
                                 {311, 50.8},
                                 {272, 2},
                                 {320, 2.54},
                                 {301, 1},
                                 {305, 1},
                                 {405, 5.08},
                                 {303, 1},
                                 {381, 0}});

std::vector<Case> cases() {
  const auto block = [](Bench& bench) { box(bench, {0.3, -0.2, -40}, {76.4, 50.7, 0}); };
  const auto pocket = [](Bench& bench) {
    box(bench, {-30, -30, -40}, {13, 90, 0});
    box(bench, {89, -30, -40}, {130, 90, 0});
    box(bench, {13, -30, -40}, {89, 0.1, 0});
    box(bench, {13, 51, -40}, {89, 90, 0});
  };
  const auto two = [](const auto& lay) {
    return [lay](Bench& bench) {
      lay(bench, 0, 0.4, 10);
      lay(bench, 76.2, 1.4, 10);
    };
  };
  const Words pair = with(height, {{268, 0}, {269, 0}, {270, 76.2}, {271, 0}, {307, 0}, {305, 1}, {402, 0}, {337, 0}});
  const auto onTop = [](double x, double y) { return with(target, {{382, x}, {383, y}}); };
  return {
      {400, with(edge, {{307, 0}, {305, 1}}), block},
      {401, pair, two(ring)},
      {402, with(pair, {{313, 20.32}, {314, 20.32}, {315, -10.16}, {320, 2.54}, {301, 1}}), two(bar)},
      {408, slot, pocket},
      {409, slot,
       [](Bench& bench) {
         box(bench, {0, 0.3, -40}, {100, 50.8, 0});
       }},
      {410, with(rectangle, onTop(50.8, 76.2)), pocket},
      {411, with(rectangle, onTop(50.8, 25.4)),
       [](Bench& bench) {
         box(bench, {13, 0.2, -40}, {89, 50.5, 0});
       }},
      {412, with(circle, onTop(50.8, 43.18)), [](Bench& bench) { ring(bench, 50.9, 25.1, 15.4); }},
      {413, with(circle, onTop(50.8, 25.4)), [](Bench& bench) { bar(bench, 50.9, 25.1, 15); }},
      {414,
       with(height, with(onTop(25.4, 25.4), {{263, 12.7},
                                             {264, 0},
                                             {326, 25.4},
                                             {296, 0},
                                             {297, 12.7},
                                             {327, 25.4},
                                             {320, 5.08},
                                             {301, 1},
                                             {304, 1}})),
       block},
      {415,
       with(height,
            with(target,
                 {{263, 0}, {264, 0}, {326, 25.4}, {327, 25.4}, {308, 1}, {320, 2.54}, {301, 1}, {304, 1}, {381, 0}})),
       [](Bench& bench) {
         box(bench, {-40, -40, -40}, {0.3, 80, 0});
         box(bench, {0, -40, -40}, {80, -0.2, 0});
       }},
      {416, with(height, with(target, {{273, 0}, {274, 0}, {262, 76.2}, {291, 0}, {292, 90}, {293, 180}, {381, 0}})),
       [](Bench& bench) {
         ring(bench, 38.3, 0, 8);
         ring(bench, 0.2, 38.1, 8);
         ring(bench, -37.9, 0, 8);
       }},
      {417, {{263, 12.7}, {264, 12.7}, {294, 0}, {320, 2.54}, {260, 25.4}, {305, 1}, {333, 7.62}, {303, 1}}, block},
      {418,
       with(
           height,
           with(
               target,
               {{268, 0}, {269, 0}, {270, 76.2}, {271, 0}, {316, 76.2}, {317, 50.8}, {318, 0}, {319, 50.8}, {381, 0}})),
       [](Bench& bench) {
         for (const double x : {0.0, 76.2}) {
           for (const double y : {0.0, 50.8})
             ring(bench, x + 0.3, y - 0.1, 8);
         }
       }},
      {419, with(height, {{263, 0}, {264, 25.4}, {320, 2.54}, {272, 1}, {267, 1}, {305, 1}, {333, 5.08}, {303, 1}}),
       block},
  };
}

/// The words as an inch program writes them.
Words inInches(const cycles::CycleDefinition& cycle, Words words) {
  for (auto& [number, value] : words) {
    if (cycle.parameter(static_cast<std::uint32_t>(number))->kind == ValueKind::Length) value /= inch;
  }
  return words;
}

/// The words that the cycle knows on this control.
Words known(const Case& one, ControlKind kind) {
  const auto& definition = cycles::heidenhain::findEntry(one.cycle)->definition;
  Words words = one.words;
  std::erase_if(words, [&](const auto& word) {
    const auto* parameter = definition.parameter(static_cast<std::uint32_t>(word.first));
    return parameter == nullptr || !parameter->controls.contains(kind);
  });
  return words;
}

TEST(InchPrograms, SetTheSamePresets) {
  for (const Case& one : cases()) {
    for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
      SCOPED_TRACE(fmt::format("cycle {}, {}", one.cycle, control::name(kind)));
      const auto& definition = cycles::heidenhain::findEntry(one.cycle)->definition;
      const Words words = known(one, kind);
      Bench bench(kind);
      bench.preset(1, origin);
      one.lay(bench);
      const Ran metric = bench.run(probe(one.cycle, words));
      const Ran imperial = bench.run(probe(one.cycle, inInches(definition, words)), "INCH");
      ASSERT_TRUE(metric.finished()) << metric.why();
      ASSERT_TRUE(imperial.finished()) << imperial.why();
      EXPECT_LT((metric.preset().matrix() - imperial.preset().matrix()).norm(), exact);
      EXPECT_GT((metric.preset().matrix() - pose(origin).matrix()).norm(), 1e-3) << "something was found";
      for (const auto& result : definition.results) {
        const int number = std::stoi(std::string(result.name.substr(1)));
        const double unit = result.valueKind() == ValueKind::Length ? inch : 1;
        EXPECT_NEAR(imperial.q(number) * unit, metric.q(number), exact) << result.name;
      }
    }
  }
}

/// Parameters count in the unit of the program that they stand in, results and logs in that of the main program.
TEST(InchPrograms, LeaveResultsInTheUnitOfTheMainProgram) {
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    for (const bool mainInInch : {false, true}) {
      SCOPED_TRACE(fmt::format("{}, main program {}", control::name(kind), mainInInch ? "INCH" : "MM"));
      Bench bench(kind);
      bench.preset(1, origin);
      ring(bench, 50.9, 25.1, 15.4);
      const TableFolder folder(bench);
      bench.program = (bench.setup.beliefs.tables / "BENCH.H").string();
      const auto& definition = cycles::heidenhain::findEntry(421)->definition;
      const Words inspect = with(height, {{273, 50.8},
                                          {274, 25.4},
                                          {262, 30.48},
                                          {325, 0},
                                          {247, 90},
                                          {320, 2.54},
                                          {301, 0},
                                          {275, 0},
                                          {276, 0},
                                          {279, 0},
                                          {280, 0},
                                          {281, 1},
                                          {309, 0},
                                          {330, 0}});
      const Words written = mainInInch ? inspect : inInches(definition, inspect);
      const std::string sub = mainInInch ? "MM" : "INCH", outer = mainInInch ? "INCH" : "MM";
      folder.put("FEEL.H",
                 "BEGIN PGM FEEL " + sub + "\n" + probe(421, written) + "Q50 = Q113\nEND PGM FEEL " + sub + "\n");
      const Ran ran = bench.run("CALL PGM FEEL.H\n", outer);
      ASSERT_TRUE(ran.finished()) << ran.why();
      const double unit = mainInInch ? inch : 1;
      EXPECT_NEAR(ran.q(151) * unit, 50.9, exact);
      EXPECT_NEAR(ran.q(152) * unit, 25.1, exact);
      EXPECT_NEAR(ran.q(153) * unit, 30.8, exact);
      EXPECT_EQ(ran.q(50), mainInInch ? 1 : 0);
      EXPECT_NE(ran.log("TCHPR421.TXT").find(mainInInch ? "1.21260" : "30.8000"), std::string::npos)
          << ran.log("TCHPR421.TXT");
    }
  }
}

TEST(PresetCycles, ShiftTheDatumAsTheyShiftThePreset) {
  for (const Case& one : cases()) {
    if (one.cycle < 408) continue;
    for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
      SCOPED_TRACE(fmt::format("cycle {}, {}", one.cycle, control::name(kind)));
      Words words = known(one, kind);
      if (one.cycle == 414 || one.cycle == 415) words = with(words, {{304, 0}});
      Bench bench(kind);
      bench.preset(1, origin);
      one.lay(bench);
      const TableFolder folder(bench);
      folder.put("ZERO.D", control::heidenhain::defaultDatumTable(kind, "ZERO.D"));
      const Ran preset = bench.run(probe(one.cycle, words));
      const Ran datum = bench.run("SEL TABLE \"ZERO.D\"\n" + probe(one.cycle, with(words, {{303, 0}, {305, 4}})));
      ASSERT_TRUE(preset.finished()) << preset.why();
      ASSERT_TRUE(datum.finished()) << datum.why();
      const Vector3 shift = preset.preset().translation() - origin;
      const char* columns[] = {"X", "Y", "Z"};
      for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(shift[axis]) > exact) {
          EXPECT_NEAR(datum.cell("ZERO.D", "4", columns[axis]), shift[axis], 6e-5);
        }
      }
      EXPECT_TRUE(datum.preset().isApprox(pose(origin), 1e-12)) << "nothing is activated";
    }
  }
}

TEST(PresetCycles, RefuseTransfersToNowhere) {
  for (const Case& one : cases()) {
    if (one.cycle < 408) continue;
    for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
      SCOPED_TRACE(fmt::format("cycle {}, {}", one.cycle, control::name(kind)));
      Bench bench(kind);
      bench.preset(1, origin);
      one.lay(bench);
      const auto refusal = [&](double transfer) {
        const Ran ran = bench.run(probe(one.cycle, with(known(one, kind), {{303, transfer}, {305, 5}})));
        for (const auto& cycle : ran.outcome.journal.cycles)
          EXPECT_TRUE(cycle.writes.empty());
        return ran.why();
      };
      if (one.cycle == 408 || one.cycle == 409) {
        EXPECT_NE(refusal(-1).find("cannot be -1"), std::string::npos) << refusal(-1);
      } else {
        EXPECT_NE(refusal(-1).find("Measured value transfer not defined"), std::string::npos) << refusal(-1);
        EXPECT_NE(refusal(-1).find("set Q303 to 0 (datum table) or 1 (preset table)"), std::string::npos);
      }
      EXPECT_NE(refusal(0).find("Datum table not selected"), std::string::npos) << refusal(0);
      const Ran row = bench.run(probe(one.cycle, with(known(one, kind), {{305, 10000}})));
      EXPECT_EQ(row.outcome.info.exit, records::ExitState::InputMistake);
      EXPECT_NE(row.why().find("Q305"), std::string::npos) << row.why();
    }
  }
}

}  // namespace
}  // namespace probewright::testing_support
