#include "cycles_sinumerik/milling_variants.hpp"

/// Every measuring variant in G18 and G19 with a probe in an angle head: the plane is the program's or the call's
/// (_DMODE).
namespace probewright {
namespace {

using namespace testing_support;

struct Plane {
  const char* name;
  const char* other;
  int dmode;
  int first, second, third;  ///< axes of the machine
  const char* out;           ///< the word of the 3rd axis
  const char* across;        ///< those of the others, for the origin of the plane
};
constexpr Plane planes[] = {{"G18", "G17", 2, 2, 0, 1, "Y", "X0 Z0"}, {"G19", "G18", 3, 1, 2, 0, "X", "Y0 Z0"}};

/// Machine from coordinates of the plane.
Pose poseOf(const Plane& plane) {
  Matrix3 axes = Matrix3::Zero();
  axes(plane.first, 0) = axes(plane.second, 1) = axes(plane.third, 2) = 1;
  Pose pose = Pose::Identity();
  pose.linear() = axes;
  return pose;
}

class HorizontalBench : public SinumerikBench {
public:
  HorizontalBench(simulation::Truth truth, const Plane& working, double turn = 0)
      : SinumerikBench(headed(std::move(truth), working)), plane_(working) {
    Vector3 rotation = Vector3::Zero();
    rotation[working.third] = turn;
    plantFrame(*this, "$P_UIFR", 1, origin, rotation);
    plane = working.name;
    control.data.set("$TC_TP2", {7}, std::string("MILL"));
    set("$TC_DP1", {7, 1}, 120);
  }

  /// From outside along the 3rd axis to a point in coordinates of the plane, then the call.
  void measure(const char* cycle, const NamedNumbers& call, const Vector3& start, bool byCall,
               const NamedTexts& texts = {}) {
    const char names[] = {'X', 'Y', 'Z'};
    const std::string before =
        fmt::format("G0 {}120\nG0 {}\nG0 {}{:.9f} {}{:.9f}\nG0 {}{:.9f}\n{}", plane_.out, plane_.across,
                    names[plane_.first], start.x(), names[plane_.second], start.y(), plane_.out, start.z(),
                    byCall ? std::string(plane_.other) + "\n" : "");
    run(cycle, with(call, {{"_DMODE", byCall ? static_cast<double>(plane_.dmode) : 0.0}}), texts, before);
    EXPECT_EQ(control.plane, std::stoi(std::string(byCall ? plane_.other : plane_.name).substr(1)));
  }

private:
  static simulation::Truth headed(simulation::Truth truth, const Plane& working) {
    truth.tools[0].shankDirection = Vector3::Unit(working.third);
    return truth;
  }
  const Plane& plane_;
};

TEST(OtherPlanes, EachVariantIntoEachZeroOffset) {
  constexpr double targets[] = {1, 10001, 9000, 1001, 11001, 2000, 12000};
  Planter plant(18);
  std::size_t world = 0;
  for (const Plane& plane : planes) {
    for (const bool byCall : {false, true}) {
      for (const Variant& variant : variants()) {
        const double target = targets[world++ % std::size(targets)];
        SCOPED_TRACE(fmt::format("{} into {} in {} by call {}", variant.name, target, plane.name, byCall));
        const double turn = world % 3 == 0 ? 0 : plant.number(-8, 8);
        const Pose believed = translation(origin) * poseOf(plane) * rotation(Vector3::UnitZ(), turn);
        const Pose part = displaced(variant, believed, plant);
        simulation::Truth truth = perfectWorld();
        variant.part(truth, part);
        HorizontalBench bench(truth, plane, turn);
        bench.measure(variant.cycle, with(variant.call, {{"S_KNUM", target}}), variant.start, byCall);
        expectInPlace(bench, variant, part, poseOf(plane).linear());
        EXPECT_EQ(bench.ovi(11), 1);
      }
    }
  }
}

TEST(OtherPlanes, ToolsAreCorrectedAsInG17) {
  const struct {
    const char* variant;
    const char* datum;
    double change;  ///< for a feature 0.04 too large, or 0.04 too far in plus direction
  } cases[] = {{"977 hole", "$TC_DP15", 0.02},      {"977 spigot", "$TC_DP15", -0.02},
               {"977 pocket", "$TC_DP15", 0.02},    {"979 outside", "$TC_DP15", -0.02},
               {"978 1st axis", "$TC_DP15", 0.04},  {"978 2nd axis", "$TC_DP15", 0.04},
               {"978 3rd axis", "$TC_DP12", -0.04}, {"977 groove 2", "$TC_DP15", 0.02}};
  const std::vector<Variant> known = variants();
  for (const Plane& plane : planes) {
    for (const auto& [name, datum, change] : cases) {
      SCOPED_TRACE(fmt::format("{} in {}", name, plane.name));
      const Variant& variant = *std::ranges::find(known, std::string_view(name), &Variant::name);
      NamedNumbers call = variant.call;
      for (auto& [parameter, value] : call) {
        if (parameter == "S_MVAR") value += 100;
        if (parameter.starts_with("S_SETV")) value -= 0.04;
      }
      if (std::string_view(variant.cycle) == "CYCLE978") call.emplace_back("S_SETV", -0.04);
      simulation::Truth truth = perfectWorld();
      variant.part(truth, translation(origin) * poseOf(plane));
      HorizontalBench bench(truth, plane);
      bench.measure(variant.cycle, with(call, {{"S_KNUM1", 1}}), variant.start, false, {{"S_TNAME", "MILL"}});
      EXPECT_NEAR(bench.data(datum, {7, 1}), change, 1e-7);
      EXPECT_EQ(bench.control.journal.cycles.back().writes.size(), 1u);
    }
  }
}

TEST(OtherPlanes, WhatCycle976CalibratesThereMeasuresRightThere) {
  Planter plant(19);
  for (const Plane& plane : planes) {
    for (int units = 0; units <= 4; ++units) {
      SCOPED_TRACE(fmt::format("{} units {}", plane.name, units));
      simulation::Truth truth = perfectWorld();
      simulation::TrueProbe& probe = truth.tools[0].probe;
      probe.tipOffset = {plant.number(-0.1, 0.1), plant.number(-0.1, 0.1)};
      const double radius = plant.number(18, 22), height = plant.number(-1, 1);
      const Pose pose = translation(origin) * poseOf(plane);
      if (units == 3) {
        place(truth, simulation::SolidSphere({0, 0, height - 15}, 15), pose);
      } else {
        place(truth, simulation::Ring(20, 30, -40), pose);
      }
      place(truth, simulation::Ring(radius, 35, -40), pose * translation({72, 0, 0}));
      place(truth, simulation::Box({-110, -20, -40}, {-60, 20, height}), pose);
      HorizontalBench bench(truth, plane);
      bench.set("$TC_DP3", {1, 1}, 100 + plant.number(-0.5, 0.5));
      const NamedNumbers common = {{"S_FA", 5}, {"S_TSA", 4}};
      if (units == 0) {
        bench.measure("CYCLE976", with(common, {{"S_MVAR", 1000000}, {"S_SETV", height}}), {-85, 0, 10}, true);
      } else if (units == 3) {
        bench.measure("CYCLE976", with(common, {{"S_MVAR", 1000003}, {"S_SETV", 30}, {"S_SETV0", height}}), {0, 0, 8},
                      true);
      } else if (units == 4) {
        for (const int axis : {1, 2})
          bench.measure("CYCLE976", with(common, {{"S_MVAR", 2004}, {"S_SETV", 40}, {"S_MA", axis}}), {0, 0, -10},
                        true);
      } else {
        bench.measure("CYCLE976", with(common, {{"S_MVAR", units}, {"S_SETV", 40}}), {0, 0, -10}, true);
      }
      if (units != 0) {
        bench.measure("CYCLE977", with(common, {{"S_MVAR", 1}, {"S_SETV", 2 * radius}}), {72, 0, -10}, false);
        EXPECT_NEAR(bench.ovr(4), 2 * radius, 5e-4);
        EXPECT_NEAR(bench.ovr(5), 72, 5e-4);
        EXPECT_NEAR(bench.ovr(6), 0, 5e-4);
      }
      if (units == 0 || units == 3) {
        bench.measure("CYCLE978", with(common, {{"S_SETV", height}, {"S_MA", 3}, {"S_MD", 2}}), {-85, 0, 8}, false);
        EXPECT_NEAR(bench.ovr(4), height, units == 3 ? 1e-3 : 1e-7) << "the length";
      }
    }
  }
}

}  // namespace
}  // namespace probewright
