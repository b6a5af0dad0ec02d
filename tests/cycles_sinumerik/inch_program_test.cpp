#include <gtest/gtest.h>

#include <map>

#include "cycles/catalogue.hpp"
#include "support/sinumerik_bench.hpp"

/// The same measurement ordered in millimetres and in inches, for every milling cycle that takes lengths.
namespace probewright {
namespace {

using namespace testing_support;

constexpr double table = -350;

struct Task {
  const char* name;
  const char* cycle;
  simulation::Truth truth;
  NamedNumbers call;  ///< lengths in mm
  Vector3 start;
};

template <class SolidType>
simulation::Truth worldWith(SolidType solid, const Pose& pose) {
  simulation::Truth truth = perfectWorld();
  place(truth, std::move(solid), translation({0, 0, table}) * pose);
  return truth;
}

std::vector<Task> tasks() {
  const Pose off = translation({0.4, -0.3, 0.2});
  const Pose turned = translation({0.4, -0.3, 0}) * rotation(Vector3::UnitZ(), 1.5);
  const simulation::Ring hole(20, 80, -60);
  const simulation::Box block({0, 0, -60}, {120, 120, 0});
  const NamedNumbers common = {{"S_KNUM", 1}, {"S_FA", 8}, {"S_TSA", 8}};
  const auto call = [&](const NamedNumbers& own) { return testing_support::with(common, own); };
  return {
      {"976 ring",
       "CYCLE976",
       worldWith(hole, Pose::Identity()),
       {{"S_MVAR", 1}, {"S_SETV", 40}, {"S_FA", 8}, {"S_TSA", 3}},
       {0, 0, -10}},
      {"977 hole", "CYCLE977", worldWith(hole, off), call({{"S_MVAR", 101}, {"S_SETV", 40}}), {0, 0, -10}},
      {"977 spigot",
       "CYCLE977",
       worldWith(simulation::RoundBar(20, -60, 0), off),
       call({{"S_MVAR", 102}, {"S_SETV", 40}, {"S_ID", -20}}),
       {0, 0, 10}},
      {"977 rectangle",
       "CYCLE977",
       worldWith(simulation::Box({-15, -15, -60}, {15, 15, 0}), off),
       call({{"S_MVAR", 106}, {"S_SETV0", 30}, {"S_SETV1", 30}, {"S_ID", -20}}),
       {0, 0, 10}},
      {"978 edge",
       "CYCLE978",
       worldWith(block, off),
       call({{"S_MVAR", 100}, {"S_SETV", 0.1}, {"S_MA", 1}, {"S_MD", 1}}),
       {-12, 20, -10}},
      {"978 top", "CYCLE978", worldWith(block, off), call({{"S_MVAR", 100}, {"S_MA", 3}, {"S_MD", 2}}), {30, 30, 8}},
      {"979 hole",
       "CYCLE979",
       worldWith(hole, off),
       call({{"S_MVAR", 101}, {"S_SETV", 40}, {"S_CPA", 0.1}, {"S_INCA", 80}}),
       {8, 0, -10}},
      {"961 corner",
       "CYCLE961",
       worldWith(block, turned),
       {{"S_MVAR", 106},
        {"S_KNUM", 1},
        {"S_FA", 20},
        {"S_TSA", 8},
        {"S_SETV0", 30},
        {"S_SETV1", 80},
        {"S_SETV2", 30},
        {"S_SETV3", 80},
        {"S_SETV4", -15},
        {"S_SETV5", -15},
        {"S_INCA", 90}},
       {-15, -15, -10}},
      {"998 edge",
       "CYCLE998",
       worldWith(block, turned),
       {{"S_MVAR", 100105}, {"S_KNUM", 1}, {"S_FA", 9}, {"S_TSA", 12}, {"S_MA", 201}, {"S_MD", 1}, {"S_ID", 50}},
       {-14, 20, -10}},
      {"997 ball",
       "CYCLE997",
       worldWith(simulation::SolidSphere(Vector3::Zero(), 15), off),
       call({{"S_MVAR", 101119}, {"S_SETV", 30}, {"S_INCA", 90}, {"S_SETV0", 0.1}}),
       {0, 0, 25}},
  };
}

/// Frames, calibration data, and results in mm, by name.
std::map<std::string, double> outcome(const Task& task, const char* units, double scale) {
  const cycles::CycleDefinition& definition = *cycles::sinumerikCycle(task.cycle);
  NamedNumbers call = task.call;
  for (auto& [name, value] : call) {
    for (const cycles::Parameter& parameter : definition.parameters)
      if (parameter.name == name && parameter.kind == cycles::ValueKind::Length) value /= scale;
  }
  SinumerikBench bench(task.truth);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
  bench.start(task.start);
  bench.run(task.cycle, call, {}, std::string(units) + "\n");
  std::map<std::string, double> found;
  for (const char* name : {"$P_UIFR", "$SNS_MEA_WP_BALL_DIAM", "$SNS_MEA_WP_TRIG_PLUS_DIR_AX1"}) {
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
