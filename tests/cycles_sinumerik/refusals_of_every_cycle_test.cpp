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
      const language::RunResult result =
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

}  // namespace
}  // namespace probewright
