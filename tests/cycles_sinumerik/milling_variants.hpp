#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "support/sinumerik_bench.hpp"

/// The measuring variants of the milling cycles, each with a part that it measures.
namespace probewright::testing_support {

inline const Vector3 origin(20, -10, -350);

/// A measuring variant: what stands at the origin of the workpiece system, displaced, and how it is measured.
struct Variant {
  const char* name;
  const char* cycle;
  std::function<void(simulation::Truth&, const Pose&)> part;
  NamedNumbers call;
  Vector3 start;
  std::vector<int> axes;  ///< in which the translation is corrected
  bool turns = false;     ///< the rotation about the 3rd axis is corrected
  bool tilts = false;     ///< those about the 1st and 2nd are

  bool corrects() const { return !axes.empty() || turns || tilts; }
};

inline std::vector<Variant> variants() {
  using simulation::Box;
  using simulation::Ring;
  using simulation::RoundBar;
  const auto block = [](simulation::Truth& truth, const Pose& pose) {
    place(truth, Box({0, 0, -60}, {100, 100, 0}), pose);
  };
  const auto hole = [](simulation::Truth& truth, const Pose& pose) { place(truth, Ring(20, 80, -60), pose); };
  const auto spigot = [](simulation::Truth& truth, const Pose& pose) { place(truth, RoundBar(20, -60, 0), pose); };
  const auto groove = [](simulation::Truth& truth, const Pose& pose) {
    place(truth, Box({15, -60, -60}, {60, 60, 0}), pose);
    place(truth, Box({-60, -60, -60}, {-15, 60, 0}), pose);
  };
  const auto groove2 = [](simulation::Truth& truth, const Pose& pose) {
    place(truth, Box({-60, 15, -60}, {60, 60, 0}), pose);
    place(truth, Box({-60, -60, -60}, {60, -15, 0}), pose);
  };
  const auto pocket = [groove, groove2](simulation::Truth& truth, const Pose& pose) {
    groove(truth, pose);
    groove2(truth, pose);
  };
  const auto rib = [](simulation::Truth& truth, const Pose& pose) {
    place(truth, Box({-15, -60, -60}, {15, 60, 0}), pose);
  };
  const auto rectangle = [](simulation::Truth& truth, const Pose& pose) {
    place(truth, Box({-15, -15, -60}, {15, 15, 0}), pose);
  };
  const auto inside = [](simulation::Truth& truth, const Pose& pose) {
    place(truth, Box({-40, -60, -60}, {150, 0, 0}), pose);
    place(truth, Box({-60, -60, -60}, {0, 150, 0}), pose);
  };
  const auto ball = [](simulation::Truth& truth, const Pose& pose) {
    place(truth, simulation::SolidSphere(Vector3::Zero(), 15), pose);
  };
  const NamedNumbers path = {{"S_FA", 6}, {"S_TSA", 5}};
  const auto call = [&path](const NamedNumbers& more) { return with(path, more); };
  std::vector<Variant> all = {
      {"978 1st axis", "CYCLE978", block, call({{"S_MVAR", 100}, {"S_MA", 1}, {"S_MD", 1}}), {-14, 30, -10}, {0}},
      {"978 2nd axis", "CYCLE978", block, call({{"S_MVAR", 100}, {"S_MA", 2}, {"S_MD", 1}}), {30, -14, -10}, {1}},
      {"978 3rd axis", "CYCLE978", block, call({{"S_MVAR", 100}, {"S_MA", 3}, {"S_MD", 2}}), {30, 30, 12}, {2}},
      {"977 hole", "CYCLE977", hole, call({{"S_MVAR", 101}, {"S_SETV", 40}}), {0, 0, -10}, {0, 1}},
      {"977 spigot", "CYCLE977", spigot, call({{"S_MVAR", 102}, {"S_SETV", 40}, {"S_ID", -20}}), {0, 0, 10}, {0, 1}},
      {"977 groove 1", "CYCLE977", groove, call({{"S_MVAR", 103}, {"S_SETV", 30}, {"S_MA", 1}}), {0, 0, -10}, {0}},
      {"977 groove 2", "CYCLE977", groove2, call({{"S_MVAR", 103}, {"S_SETV", 30}, {"S_MA", 2}}), {0, 0, -10}, {1}},
      {"977 rib",
       "CYCLE977",
       rib,
       call({{"S_MVAR", 104}, {"S_SETV", 30}, {"S_MA", 1}, {"S_ID", -20}}),
       {0, 0, 10},
       {0}},
      {"977 pocket",
       "CYCLE977",
       pocket,
       call({{"S_MVAR", 105}, {"S_SETV0", 30}, {"S_SETV1", 30}}),
       {0, 0, -10},
       {0, 1}},
      {"977 rectangle",
       "CYCLE977",
       rectangle,
       call({{"S_MVAR", 106}, {"S_SETV0", 30}, {"S_SETV1", 30}, {"S_ID", -20}}),
       {0, 0, 10},
       {0, 1}},
      {"979 inside", "CYCLE979", hole, call({{"S_MVAR", 101}, {"S_SETV", 40}, {"S_INCA", 80}}), {8, 0, -10}, {0, 1}},
      {"979 outside",
       "CYCLE979",
       spigot,
       call({{"S_MVAR", 1102}, {"S_SETV", 40}, {"S_INCA", 80}}),
       {32, 0, -10},
       {0, 1}},
      {"997 ball", "CYCLE997", ball, call({{"S_MVAR", 101119}, {"S_SETV", 30}, {"S_INCA", 90}}), {0, 0, 25}, {0, 1, 2}},
  };
  const auto corner = [&](int units, double side) {
    return with({{"S_FA", 20},
                 {"S_TSA", 8},
                 {"S_SETV0", side > 0 ? 10.0 : 30.0},
                 {"S_SETV1", 80},
                 {"S_SETV2", side > 0 ? 10.0 : 30.0}},
                {{"S_MVAR", 100.0 + units}, {"S_SETV3", 80}, {"S_SETV4", side}, {"S_SETV5", side}, {"S_INCA", 90}});
  };
  all.push_back({"961 right inside", "CYCLE961", inside, corner(5, 15), {15, 15, -10}, {0, 1}, true});
  all.push_back({"961 right outside", "CYCLE961", block, corner(6, -15), {-15, -15, -10}, {0, 1}, true});
  all.push_back({"961 any inside", "CYCLE961", inside, corner(7, 15), {15, 15, -10}, {0, 1}, true});
  all.push_back({"961 any outside", "CYCLE961", block, corner(8, -15), {-15, -15, -10}, {0, 1}, true});
  all.push_back({"998 edge",
                 "CYCLE998",
                 block,
                 {{"S_MVAR", 100105}, {"S_FA", 9}, {"S_TSA", 12}, {"S_MA", 201}, {"S_MD", 1}, {"S_ID", 50}},
                 {-14, 20, -10},
                 {},
                 true});
  all.push_back({"998 plane",
                 "CYCLE998",
                 block,
                 {{"S_MVAR", 100106}, {"S_FA", 9}, {"S_TSA", 12}, {"S_SETV0", 50}, {"S_SETV2", 20}, {"S_SETV3", 50}},
                 {20, 20, 12},
                 {},
                 false,
                 true});
  all.push_back({"997 three balls",
                 "CYCLE997",
                 [](simulation::Truth& truth, const Pose& pose) {
                   for (const Vector3& centre : {Vector3(0, 0, 0), Vector3(60, 5, 10), Vector3(20, 50, -5)})
                     place(truth, simulation::SolidSphere(centre, 10), pose);
                 },
                 {{"S_MVAR", 111119},
                  {"S_FA", 7},
                  {"S_TSA", 6},
                  {"S_SETV", 20},
                  {"S_INCA", 90},
                  {"S_SETV3", 60},
                  {"S_SETV4", 5},
                  {"S_SETV5", 10},
                  {"S_SETV6", 20},
                  {"S_SETV7", 50},
                  {"S_SETV8", -5}},
                 {0, 0, 38},
                 {0, 1, 2},
                 true,
                 true});
  return all;
}

/// All variants, and the cycles that correct nothing.
inline std::vector<Variant> everyCall() {
  std::vector<Variant> all = variants();
  const auto ring = [](simulation::Truth& truth, const Pose& pose) {
    place(truth, simulation::Ring(20, 60, -40), pose);
  };
  const auto ball = [](simulation::Truth& truth, const Pose& pose) {
    place(truth, simulation::SolidSphere(Vector3::Zero(), 12), pose);
  };
  const NamedNumbers path = {{"S_FA", 6}, {"S_TSA", 4}};
  all.push_back({"976 ring", "CYCLE976", ring, with(path, {{"S_MVAR", 1}, {"S_SETV", 40}}), {0, 0, -10}, {}});
  all.push_back({"976 ball", "CYCLE976", ball, with(path, {{"S_MVAR", 3}, {"S_SETV", 24}}), {0, 0, 20}, {}});
  all.push_back(
      {"995", "CYCLE995", ball, with(path, {{"S_MVAR", 102015}, {"S_SETV", 24}, {"S_DZ", 20}}), {0, 0, 18}, {}});
  return all;
}

/// An argument of a call; 0 if it is left out.
inline double valueOf(const NamedNumbers& call, std::string_view name) {
  const auto found = std::ranges::find(call, name, [](const auto& each) { return std::string_view(each.first); });
  return found == call.end() ? 0 : found->second;
}

/// The part of `variant` where the control believes it, displaced and turned by as much as the variant is to find.
inline Pose displaced(const Variant& variant, const Pose& believed, Planter& plant, double extent = 0.9,
                      double degrees = 2) {
  Vector3 error = plant.within(extent);
  for (int axis = 0; axis < 3; ++axis)
    if (std::find(variant.axes.begin(), variant.axes.end(), axis) == variant.axes.end()) error[axis] = 0;
  Pose part = believed * translation(error);
  if (variant.turns) part = part * rotation(Vector3::UnitZ(), plant.number(-degrees, degrees));
  if (variant.tilts)
    part = part * rotation(Vector3::UnitY(), plant.number(-degrees, degrees)) *
           rotation(Vector3::UnitX(), plant.number(-degrees, degrees));
  return part;
}

/// What the correction of `variant` promises: the part has its set place, and its set directions if it finds angles.
/// `axes`: the directions of the axes of the plane, as columns.
inline void expectInPlace(SinumerikBench& bench, const Variant& variant, const Pose& part,
                          const Matrix3& axes = Matrix3::Identity()) {
  const Vector3 seen = axes.transpose() * inWorkpiece(bench, part.translation());
  for (const int axis : variant.axes)
    EXPECT_NEAR(seen[axis], 0, 1e-6) << variant.name << " axis " << axis;
  const Matrix3 turned = axes.transpose() * bench.control.machineFromWorkpiece().linear().inverse() * part.linear();
  if (variant.turns || variant.tilts) {
    EXPECT_NEAR((turned.col(2) - Vector3::UnitZ()).norm(), 0, 1e-6) << variant.name;
  }
  if (variant.turns) {
    EXPECT_NEAR((turned - Matrix3::Identity()).norm(), 0, 1e-6) << variant.name;
  }
}

}  // namespace probewright::testing_support
