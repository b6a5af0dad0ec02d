#include <gtest/gtest.h>

#include <map>

#include "cycles/catalogue.hpp"
#include "cycles_sinumerik/milling_variants.hpp"

/// The same measurement ordered in millimetres and in inches, for every milling cycle that takes lengths.
namespace probewright {
namespace {

using namespace testing_support;

struct Task {
  std::string name;
  const char* cycle;
  simulation::Truth truth;
  NamedNumbers call;  ///< lengths in mm
  Vector3 start;
};

std::vector<Task> tasks() {
  std::vector<Task> all;
  Planter plant(254);
  for (const Variant& variant : variants()) {
    Task task{variant.name, variant.cycle, perfectWorld(), with(variant.call, {{"S_KNUM", 1}}), variant.start};
    variant.part(task.truth, displaced(variant, translation(origin), plant));
    all.push_back(task);
    const std::string_view cycle = variant.cycle;
    if (cycle != "CYCLE977" && cycle != "CYCLE978" && cycle != "CYCLE979") continue;
    // The same with the correction of a tool: a tolerance, and a mean that is kept.
    task.name += " corrects a tool";
    for (auto& [name, value] : task.call)
      if (name == "S_MVAR") value += 100;
    task.call = with(task.call, {{"S_KNUM1", 1},
                                 {"S_TUL", 2.1},
                                 {"S_TLL", -1.9},
                                 {"S_TDIF", 4},
                                 {"S_TMV", 1.5},
                                 {"S_TZL", 0.1},
                                 {"S_K", 3},
                                 {"S_EVNUM", 10002},
                                 {"_AMODE", 1}});
    all.push_back(std::move(task));
  }
  const NamedNumbers path = {{"S_FA", 8}, {"S_TSA", 3}, {"S_VMS", 254}};
  const auto calibration = [&](const char* name, auto solid, const NamedNumbers& call, const Vector3& start) {
    Task task{name, "CYCLE976", perfectWorld(), with(path, call), start};
    task.truth.tools[0].probe.tipOffset = {0.03, -0.02};
    place(task.truth, solid, translation(origin));
    all.push_back(std::move(task));
  };
  const simulation::Ring ring(20, 60, -40);
  const simulation::Box block({0, 0, -60}, {80, 80, 0});
  calibration("976 ring", ring, {{"S_MVAR", 1}, {"S_SETV", 40}}, {0, 0, -10});
  calibration("976 two edges", ring, {{"S_MVAR", 2004}, {"S_SETV", 40}, {"S_MA", 1}}, {0, 0, -10});
  calibration("976 edge", block, {{"S_MVAR", 1004}, {"S_SETV", 0.02}, {"S_MA", 1}}, {-12, 30, -10});
  calibration("976 length", block, {{"S_MVAR", 1000000}, {"S_SETV", 0.02}}, {30, 30, 10});
  calibration("976 ball", simulation::SolidSphere({0, 0, -12}, 12),
              {{"S_MVAR", 1000003}, {"S_SETV", 24}, {"S_SETV0", 0.01}}, {0, 0, 8});
  Task spindle{"995",
               "CYCLE995",
               perfectWorld(),
               {{"S_MVAR", 1102015}, {"S_SETV", 24}, {"S_FA", 6}, {"S_TSA", 3}, {"S_DZ", 20}},
               {0, 0, 18}};
  spindle.truth.errors.spindleTilt = {0.02, 0.03, 0};
  place(spindle.truth, simulation::SolidSphere(Vector3::Zero(), 12), translation(origin));
  all.push_back(std::move(spindle));
  return all;
}

/// Frames, calibration data, and results in mm, by name.
std::map<std::string, double> outcome(const Task& task, const char* units, double scale) {
  const cycles::CycleDefinition& definition = *cycles::sinumerikCycle(task.cycle);
  NamedNumbers call = task.call;
  for (auto& [name, value] : call) {
    for (const cycles::Parameter& parameter : definition.parameters)
      if (parameter.name == name &&
          (parameter.kind == cycles::ValueKind::Length || parameter.kind == cycles::ValueKind::Feed))
        value /= scale;
  }
  SinumerikBench bench(task.truth);
  plantFrame(bench, "$P_UIFR", 1, origin);
  bench.control.data.set("$TC_TP2", {7}, std::string("MILL"));
  bench.set("$TC_DP1", {7, 1}, 120);
  bench.set("$SCS_MEA_EMPIRIC_VALUE", {1}, 0.05);
  bench.start(task.start);
  const bool corrects = task.name.ends_with("tool");
  bench.run(task.cycle, call, corrects ? NamedTexts{{"S_TNAME", "MILL"}} : NamedTexts{}, std::string(units) + "\n");
  std::map<std::string, double> found;
  for (const char* name : {"$P_UIFR", "$SNS_MEA_WP_BALL_DIAM", "$SNS_MEA_WP_TRIG_PLUS_DIR_AX1", "$SNS_MEA_WP_FEED",
                           "$TC_DP3", "$TC_DP15", "$SCS_MEA_AVERAGE_VALUE"}) {
    for (const auto& key : bench.control.data.keys(name))
      found[key.text()] = bench.control.data.number(key);
  }
  EXPECT_EQ(bench.control.journal.cycles.size(), 1u);
  for (const control::ResultRecord& result : bench.control.journal.cycles.back().results) {
    // The record counts in mm, what the program reads in its own unit.
    found["record " + result.name] = result.value;
    if (!result.name.starts_with("_OVR[")) continue;
    const auto place = static_cast<std::size_t>(std::stoi(result.name.substr(5)));
    found[result.name] = bench.control.ovr[place] * (result.unit == "mm" ? scale : 1);
  }
  return found;
}

TEST(InchPrograms, MeasureAndCorrectWhatMetricOnesDo) {
  for (const Task& task : tasks()) {
    const auto metric = outcome(task, "G71", 1);
    EXPECT_GT(metric.size(), 6u) << task.name;
    EXPECT_EQ(outcome(task, "G710", 1), metric) << task.name;
    for (const char* units : {"G70", "G700"}) {
      const auto inch = outcome(task, units, 25.4);
      ASSERT_EQ(inch.size(), metric.size()) << task.name;
      for (const auto& [name, value] : metric)
        EXPECT_NEAR(inch.at(name), value, 1e-7) << task.name << " " << units << " " << name;
    }
  }
}

}  // namespace
}  // namespace probewright
