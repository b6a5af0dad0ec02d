#include "cycles/catalogue.hpp"
#include "cycles_sinumerik/milling_variants.hpp"

/// What every measuring cycle refuses in the same way, in each of its variants: with the same alarm, before anything is
/// corrected.
namespace probewright {
namespace {

using namespace testing_support;

/// What is wrong, and the alarm that it has.
struct Wrong {
  const char* what;
  const char* alarm;
  NamedNumbers call;
  std::string before;
  std::function<void(SinumerikBench&)> data;
  std::vector<std::string_view> except;  ///< cycles that it does not concern
};

std::vector<Wrong> wrongs() {
  const auto probeType = [](double type) {
    return [type](SinumerikBench& bench) { bench.set("$TC_DP1", {1, 1}, type); };
  };
  return {
      {"radius compensation", "61300", {}, "G41\n", {}, {}},
      {"a safe area that is too small", "61303", {{"S_TSA", 1e-5}}, {}, {}, {}},
      {"no measuring path", "61308", {{"S_FA", 0}}, {}, {}, {}},
      {"a cutter in the spindle", "61309", {}, {}, probeType(120), {}},
      {"a tool probe in the spindle", "61309", {}, {}, probeType(725), {}},
      {"a scale factor", "61310", {}, "SCALE Z2\n", {}, {}},
      {"a mirrored axis", "61310", {}, "MIRROR Y0\n", {}, {}},
      {"no offset", "61311", {}, "D0\n", {}, {}},
      {"probe number 13", "61313", {{"S_PRNUM", 13}}, {}, {}, {}},
      {"ten measurements", "61319", {{"S_NMSP", 10}}, {}, {}, {}},
      {"plane 4", "61319", {{"_DMODE", 4}}, {}, {}, {}},
      {"no positioning feed", "61338", {}, {}, [](auto& bench) { bench.set("$SCS_MEA_FEED_FEEDAX_VALUE", {}, 0); }, {}},
      {"an empty data set", "61341", {{"S_PRNUM", 7}}, {}, {}, {"CYCLE976"}},
  };
}

TEST(EveryCycleRefuses, WhatTheOthersRefuse) {
  for (const Variant& variant : everyCall()) {
    for (const Wrong& wrong : wrongs()) {
      if (std::ranges::find(wrong.except, variant.cycle) != wrong.except.end()) continue;
      SCOPED_TRACE(fmt::format("{} with {}", variant.name, wrong.what));
      simulation::Truth truth = perfectWorld();
      variant.part(truth, translation(origin + Vector3(0.2, 0.1, 0.1)) * rotation(Vector3(1, 1, 1).normalized(), 0.5));
      SinumerikBench bench(truth);
      plantFrame(bench, "$P_UIFR", 1, origin);
      if (std::string_view(variant.cycle) == "CYCLE976") bench.set("$SNS_MEA_WP_TRIG_PLUS_DIR_AX1", {0}, 2.1);
      if (wrong.data) wrong.data(bench);
      bench.start(variant.start);
      const execution::RunResult result =
          bench.tryRun(variant.cycle, with(with(variant.call, {{"S_KNUM", variant.corrects() ? 1 : 0}}), wrong.call),
                       {}, wrong.before);
      ASSERT_FALSE(result.diagnostics.empty());
      EXPECT_EQ(result.diagnostics.front().code, wrong.alarm) << format(result.diagnostics.front());
      EXPECT_TRUE(bench.control.journal.cycles.back().writes.empty());
      EXPECT_EQ(bench.ovi(9), std::stoi(wrong.alarm));
    }
  }
}

TEST(EveryCycleRefuses, ToMeasureNothing) {
  for (const Variant& variant : everyCall()) {
    SCOPED_TRACE(variant.name);
    SinumerikBench bench(perfectWorld());
    plantFrame(bench, "$P_UIFR", 1, origin);
    bench.start(variant.start);
    EXPECT_EQ(bench.alarmOf(variant.cycle, variant.call), "61301");
  }
}

TEST(EveryCycleRefuses, DigitsThatNoListHas) {
  // A program that computes its variant gets past the check before the run.
  for (const Variant& variant : everyCall()) {
    const cycles::CycleDefinition& definition = *cycles::sinumerikCycle(variant.cycle);
    const cycles::Parameter& code = definition.parameters.front();
    simulation::Truth truth = perfectWorld();
    variant.part(truth, translation(origin));
    for (int place = 1; place <= 8; ++place) {
      for (int value = 1; value <= 9; ++value) {
        int listed = -1;
        for (const cycles::CodeDigit& digit : code.digits) {
          if (digit.place != place) continue;
          listed = std::ranges::find(digit.choices, value, &cycles::Choice::value) != digit.choices.end();
        }
        // One wrong value a place is enough where all are wrong.
        if (listed == 1 || (listed == -1 && value > 1)) continue;
        const auto scale = static_cast<int>(std::pow(10, place - 1));
        int number = static_cast<int>(valueOf(variant.call, "S_MVAR"));
        number += (value - number / scale % 10) * scale;
        SCOPED_TRACE(fmt::format("{} with S_MVAR = {}", variant.name, number));
        SinumerikBench bench(truth);
        plantFrame(bench, "$P_UIFR", 1, origin);
        bench.start(variant.start);
        EXPECT_EQ(bench.alarmOf(variant.cycle, with(variant.call, {{"S_MVAR", number}})), "61307");
        EXPECT_TRUE(bench.machine.path().touches.empty());
      }
    }
  }
}

TEST(EveryCycleRefuses, WrongTargetsAndLimitsBeforeAnythingMoves) {
  const NamedNumbers tool = {{"S_KNUM1", 1}};
  const struct {
    const char* variant;
    const char* alarm;
    double task;  ///< hundreds of S_MVAR
    NamedNumbers call;
  } cases[] = {
      {"978 1st axis", "61319", 1, {{"S_KNUM", 1}, {"S_EVNUM", 21}}},
      {"978 1st axis", "61319", 2, with(tool, {{"S_EVNUM", 21}})},
      {"978 1st axis", "61319", 2, with(tool, {{"S_EVNUM", 210000}})},
      {"978 1st axis", "61319", 2, with(tool, {{"_AMODE", 1}, {"S_TUL", -0.1}, {"S_TLL", 0.1}})},
      {"978 1st axis", "61321", 1, {{"S_KNUM", 101}}},
      {"978 1st axis", "61325", 0, {{"S_MA", 4}}},
      {"978 1st axis", "61326", 0, {{"S_MD", 3}}},
      {"977 hole", "61319", 2, with(tool, {{"S_EVNUM", 9999}})},
      {"977 hole", "61318", 2, with(tool, {{"S_EVNUM", 10000}})},
      {"977 hole", "61343", 2, with(tool, {{"S_KNUM1", 1000}})},
      {"977 hole", "61314", 2, {{"S_KNUM1", 5000001}}},
      {"977 pocket", "61319", 2, with(tool, {{"S_KNUM1", 1000001}, {"S_DLNUM", 7}})},
      {"977 pocket", "61322", 1, {{"S_KNUM", 4001}}},
      {"979 inside", "61319", 2, with(tool, {{"_AMODE", 1}, {"S_TUL", 0}, {"S_TLL", 0.001}})},
      {"979 inside", "61328", 2, {{"S_KNUM1", 9}}},
      {"979 outside", "61323", 1, {{"S_KNUM", 20001}}},
      {"961 right outside", "61322", 1, {{"S_KNUM", 3001}}},
      {"961 any inside", "61324", 1, {{"S_KNUM", 100001}}},
      {"997 ball", "61319", 1, {{"S_KNUM", 1}, {"S_INCA", 91}}},
      {"997 three balls", "61322", 1, {{"S_KNUM", 3001}}},
      {"997 three balls", "61319", 1, {{"S_KNUM", 1}, {"S_SETV7", 5.0 / 3}, {"S_SETV8", 10.0 / 3}}},
      {"998 edge", "61319", 1, {{"S_KNUM", 1}, {"S_EVNUM", 21}}},
      {"998 edge", "61329", 1, {{"S_KNUM", 1}, {"S_RA", 1}}},
      {"998 edge", "61329", 1, {{"S_KNUM", 1}, {"S_RA", 9}}},
      {"998 edge", "61325", 1, {{"S_MA", 101}}},
      {"998 plane", "61319", 1, {{"S_KNUM", 1}, {"S_EVNUM", 21}}},
      {"998 plane", "61329", 1, {{"S_KNUM", 1}, {"S_RA", 4}}},
  };
  const std::vector<Variant> known = everyCall();
  for (const auto& [name, alarm, task, call] : cases) {
    const Variant& variant = *std::ranges::find(known, std::string_view(name), &Variant::name);
    const int number = static_cast<int>(valueOf(variant.call, "S_MVAR"));
    SCOPED_TRACE(fmt::format("{}: {} {}", name, call.back().first, call.back().second));
    simulation::Truth truth = perfectWorld();
    variant.part(truth, translation(origin));
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, origin);
    bench.control.data.set("$TC_TP2", {7}, std::string("MILL"));
    bench.set("$TC_DP1", {7, 1}, 120);
    bench.start(variant.start);
    const cycles::CycleDefinition& definition = *cycles::sinumerikCycle(variant.cycle);
    const bool named = std::ranges::any_of(definition.parameters, [](const auto& p) { return p.name == "S_TNAME"; });
    EXPECT_EQ(
        bench.alarmOf(
            variant.cycle, with(with(variant.call, {{"S_MVAR", number + (task - number / 100 % 10) * 100}}), call),
            named ? NamedTexts{{"S_TNAME", std::string_view(alarm) == "61343" ? "NONE" : "MILL"}} : NamedTexts{}),
        alarm);
    EXPECT_TRUE(bench.machine.path().touches.empty());
  }
}

TEST(EveryCycleRefuses, AProtectionZoneThatFillsTheOtherLengthBeforeTheFirstTouch) {
  const std::vector<Variant> known = everyCall();
  const Variant& pocket = *std::ranges::find(known, std::string_view("977 pocket"), &Variant::name);
  simulation::Truth truth = perfectWorld();
  pocket.part(truth, translation(origin));
  SinumerikBench bench(truth);
  plantFrame(bench, "$P_UIFR", 1, origin);
  bench.start(pocket.start);
  EXPECT_EQ(bench.alarmOf("CYCLE977", with(pocket.call, {{"S_MVAR", 1105}, {"S_SZA", 10}, {"S_SZO", 27}})), "61334");
  EXPECT_TRUE(bench.machine.path().touches.empty());
}

}  // namespace
}  // namespace probewright
