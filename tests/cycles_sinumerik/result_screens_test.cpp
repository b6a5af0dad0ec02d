#include "support/result_screen.hpp"

#include <functional>

#include "support/sinumerik_bench.hpp"

/// Screens and logs of every measuring variant of milling, on parts whose errors are planted.
namespace probewright::testing_support {
namespace {

using simulation::Box;
using ::testing::ElementsAre;

constexpr double table = -350;

struct Variant {
  const char* cycle;
  int mvar;
  std::function<void(simulation::Truth&)> part;
  Vector3 start;
  NamedNumbers call;
  NamedTexts texts = {};
  /// "label": the words behind it on the screen.
  std::vector<std::pair<std::string, std::vector<std::string>>> rows = {};
};

Pose at(double x, double y, double z = 0) { return translation({x, y, table + z}); }

std::function<void(simulation::Truth&)> hole(double x, double y) {
  return [=](simulation::Truth& truth) { place(truth, simulation::Ring(20.006, 60, -40), at(x, y)); };
}
std::function<void(simulation::Truth&)> bar(double x, double y) {
  return [=](simulation::Truth& truth) { place(truth, simulation::RoundBar(20.006, -60, 0), at(x, y)); };
}
std::function<void(simulation::Truth&)> pocket(double x, double y) {
  return [=](simulation::Truth& truth) {
    place(truth, Box({20.01, -150, -60}, {120, 150, 0}), at(x, y));
    place(truth, Box({-120, -150, -60}, {-20.01, 150, 0}), at(x, y));
    place(truth, Box({-20.01, 15.02, -60}, {20.01, 150, 0}), at(x, y));
    place(truth, Box({-20.01, -150, -60}, {20.01, -15.02, 0}), at(x, y));
  };
}
std::function<void(simulation::Truth&)> block(double x, double y) {
  return [=](simulation::Truth& truth) { place(truth, Box({-20.01, -15.02, -60}, {20.01, 15.02, 0}), at(x, y)); };
}
/// A corner at `x`, `y` with edges along plus of both axes.
std::function<void(simulation::Truth&)> corner(double x, double y, bool inside) {
  return [=](simulation::Truth& truth) {
    if (!inside) return place(truth, Box({0, 0, -60}, {200, 200, 0}), at(x, y));
    place(truth, Box({-150, -60, -60}, {200, 0, 0}), at(x, y), "first edge");
    place(truth, Box({-60, 0, -60}, {0, 200, 0}), at(x, y), "second edge");
  };
}
std::function<void(simulation::Truth&)> balls(const Vector3& error) {
  return [=](simulation::Truth& truth) {
    for (const Vector3& centre : {Vector3(0, 0, 0), Vector3(90, 5, 10), Vector3(20, 70, -5)})
      place(truth, simulation::SolidSphere(Vector3::Zero(), 10), translation(Vector3(0, 0, table) + centre + error));
  };
}

std::vector<Variant> variants() {
  const auto surface = [](simulation::Truth& truth) { place(truth, Box({-50, -50, -40}, {50, 50, 0}), at(0, 0)); };
  const auto wall = [](simulation::Truth& truth) { place(truth, Box({20, -50, -40}, {60, 50, 0}), at(0, 0)); };
  const auto tilted = [](simulation::Truth& truth) {
    const Pose part = at(0, 0) * rotation(Vector3::UnitY(), 1.5) * rotation(Vector3::UnitX(), -2);
    place(truth, simulation::HalfSpace({part * Vector3::Zero(), part.linear() * Vector3::UnitZ()}));
  };
  const auto turnedEdge = [](simulation::Truth& truth) {
    place(truth, Box({-100, 0, -80}, {200, 200, 0}), at(0, 0) * rotation(Vector3::UnitZ(), 1.25));
  };
  const NamedNumbers path = {{"S_FA", 8}, {"S_TSA", 3}};
  const NamedNumbers tool = {{"S_KNUM1", 1}, {"S_TZL", 0.001}, {"S_TDIF", 0.5},
                             {"S_TUL", 0.2}, {"S_TLL", -0.1},  {"_AMODE", 1}};
  return {
      {"CYCLE976",
       0,
       surface,
       {0, 0, 12},
       with(path, {{"S_MA", 3}, {"S_MD", 1}}),
       {},
       {{"safe area [mm]", {"3.0000"}}}},
      {"CYCLE976",
       1,
       [](simulation::Truth& truth) { place(truth, simulation::Ring(20, 60, -40), at(0, 0)); },
       {0, 0, -10},
       with(path, {{"S_SETV", 40}}),
       {},
       {{"effective diameter of the ball [mm]", {"4.0000", "0.0000"}},
        {"trigger point, minus direction, 1st axis [mm]", {"-2.0000", "0.0000"}},
        {"trigger point, plus direction, 2nd axis [mm]", {"2.0000", "0.0000"}},
        {"position deviation of the ball, 1st axis [mm]", {"0.0000"}}}},
      {"CYCLE976",
       2,
       [](simulation::Truth& truth) { place(truth, simulation::Ring(20, 60, -40), at(0.25, -0.5)); },
       {0, 0, -10},
       with(path, {{"S_SETV", 40}}),
       {},
       {{"centre of ring or ball, 1st axis [mm]", {"0.2500"}}, {"centre of ring or ball, 2nd axis [mm]", {"-0.5000"}}}},
      {"CYCLE976",
       3,
       [](simulation::Truth& truth) { place(truth, simulation::SolidSphere(Vector3::Zero(), 12), at(0, 0)); },
       {0, 0, 20},
       with(path, {{"S_SETV", 24}})},
      {"CYCLE976", 1004, wall, {8, 0, -10}, with(path, {{"S_SETV", 20}, {"S_MA", 1}, {"S_MD", 0}})},
      {"CYCLE977",
       1,
       hole(0.05, -0.02),
       {0, 0, -10},
       with(path, {{"S_SETV", 40}}),
       {},
       {{"diameter of the hole [mm]", {"40.0000", "40.0120", "0.0120"}},
        {"centre, 1st axis [mm]", {"0.0000", "0.0500", "0.0500"}},
        {"centre, 2nd axis [mm]", {"0.0000", "-0.0200", "-0.0200"}}}},
      {"CYCLE977",
       101,
       hole(0.05, -0.02),
       {0, 0, -10},
       with(path, {{"S_SETV", 40}, {"S_KNUM", 10001}}),
       {},
       {{"centre, 1st axis [mm]", {"0.0000", "0.0500", "0.0500"}}, {"corrected", {"$P_UIFR[1,X,TR]"}}}},
      {"CYCLE977",
       201,
       hole(0, 0),
       {0, 0, -10},
       with(with(path, tool), {{"S_SETV", 40}}),
       {{"S_TNAME", "MILL"}},
       {{"diameter of the hole [mm]", {"40.0500", "40.0120", "-0.0380", "39.9000", "40.2000", "good"}},
        {"zero offset range [mm]", {"0.0010"}},
        {"dimensional difference [mm]", {"0.5000"}},
        {"corrected tool", {"T", "MILL", "D1"}},
        {"corrected", {"$TC_DP15[2,1]"}}}},
      {"CYCLE977",
       2,
       bar(-0.3, 0.4),
       {0, 0, 15},
       with(path, {{"S_SETV", 40}, {"S_ID", -25}}),
       {},
       {{"diameter of the spigot [mm]", {"40.0000", "40.0120", "0.0120"}}}},
      {"CYCLE977",
       3,
       pocket(0.1, 0),
       {0, 0, -10},
       with(path, {{"S_SETV", 40}, {"S_MA", 1}}),
       {},
       {{"width of the groove [mm]", {"40.0000", "40.0200", "0.0200"}},
        {"centre, 1st axis [mm]", {"0.0000", "0.1000", "0.1000"}}}},
      {"CYCLE977",
       4,
       block(0, 0.1),
       {0, 0, 15},
       with(path, {{"S_SETV", 30}, {"S_MA", 2}, {"S_ID", -25}}),
       {},
       {{"width of the rib [mm]", {"30.0000", "30.0400", "0.0400"}}}},
      {"CYCLE977",
       5,
       pocket(0.1, -0.2),
       {0, 0, -10},
       with(path, {{"S_SETV0", 40}, {"S_SETV1", 30}}),
       {},
       {{"length of the rectangle in the 1st axis [mm]", {"40.0000", "40.0200", "0.0200"}},
        {"length of the rectangle in the 2nd axis [mm]", {"30.0000", "30.0400", "0.0400"}},
        {"centre of the rectangle, 2nd axis [mm]", {"0.0000", "-0.2000", "-0.2000"}}}},
      {"CYCLE977",
       206,
       block(0, 0),
       {0, 0, 15},
       with(with(path, tool), {{"S_SETV0", 40}, {"S_SETV1", 30}, {"S_ID", -25}}),
       {{"S_TNAME", "MILL"}},
       {{"length of the rectangle in the 2nd axis [mm]",
         {"30.0500", "30.0400", "-0.0100", "29.9000", "30.2000", "good"}},
        {"corrected tool", {"T", "MILL", "D1"}}}},
      {"CYCLE978",
       0,
       wall,
       {8, 0, -10},
       with(path, {{"S_SETV", 20.5}, {"S_MA", 1}, {"S_MD", 1}}),
       {},
       {{"measuring axis [mm]", {"20.5000", "20.0000", "-0.5000"}}}},
      {"CYCLE978",
       100,
       surface,
       {0, 0, 12},
       with(path, {{"S_SETV", 0.5}, {"S_MA", 3}, {"S_MD", 2}, {"S_KNUM", 1}}),
       {},
       {{"measuring axis [mm]", {"0.5000", "0.0000", "-0.5000"}}, {"corrected", {"$P_UIFR[1,Z,FI]"}}}},
      {"CYCLE978",
       200,
       wall,
       {8, 0, -10},
       with(with(path, tool), {{"S_SETV", 20}, {"S_MA", 1}, {"S_MD", 1}, {"S_KNUM1", 1100001}, {"S_DLNUM", 1}}),
       {{"S_TNAME", "MILL"}},
       {{"corrected tool", {"T", "MILL", "D1", "DL1"}}}},
      {"CYCLE979",
       1,
       hole(0.05, -0.02),
       {10, 0, -10},
       with(path, {{"S_SETV", 40}, {"S_INCA", 120}, {"S_FA", 6}}),
       {},
       {{"diameter [mm]", {"40.0000", "40.0120", "0.0120"}},
        {"centre, 1st axis [mm]", {"0.0000", "0.0500", "0.0500"}}}},
      {"CYCLE979",
       102,
       bar(0.05, -0.02),
       {30, 0, -10},
       with(path, {{"S_SETV", 40}, {"S_INCA", 60}, {"S_FA", 6}, {"S_KNUM", 1}}),
       {},
       {{"diameter [mm]", {"40.0000", "40.0120", "0.0120"}}}},
      {"CYCLE961",
       105,
       corner(0.3, -0.4, true),
       {15, 15, -10},
       with(path, {{"S_KNUM", 1},
                   {"S_SETV0", 10},
                   {"S_SETV1", 80},
                   {"S_SETV2", 60},
                   {"S_SETV4", 15},
                   {"S_SETV5", 15},
                   {"S_FA", 20}}),
       {},
       {{"corner in the 1st axis, workpiece coordinates [mm]", {"0.3000"}},
        {"corner in the 2nd axis, workpiece coordinates [mm]", {"-0.4000"}},
        {"angle of the 1st edge to the 1st axis, workpiece coordinates [deg]", {"0.0000"}}}},
      {"CYCLE961",
       6,
       corner(0.3, -0.4, false),
       {-15, -15, -10},
       with(path,
            {{"S_SETV0", 30}, {"S_SETV1", 80}, {"S_SETV2", 60}, {"S_SETV4", -15}, {"S_SETV5", -15}, {"S_FA", 20}}),
       {},
       {{"corner in the 2nd axis, machine coordinates [mm]", {"-0.4000"}}}},
      {"CYCLE961",
       7,
       corner(0.3, -0.4, true),
       {15, 15, -10},
       with(path, {{"S_SETV0", 10},
                   {"S_SETV1", 80},
                   {"S_SETV2", 10},
                   {"S_SETV3", 70},
                   {"S_SETV4", 15},
                   {"S_SETV5", 15},
                   {"S_INCA", 90},
                   {"S_FA", 20}}),
       {},
       {{"corner in the 1st axis, workpiece coordinates [mm]", {"0.3000"}}}},
      {"CYCLE961",
       8,
       corner(0.3, -0.4, false),
       {-15, -15, -10},
       with(path, {{"S_SETV0", 30},
                   {"S_SETV1", 80},
                   {"S_SETV2", 30},
                   {"S_SETV3", 70},
                   {"S_SETV4", -15},
                   {"S_SETV5", -15},
                   {"S_INCA", 90},
                   {"S_FA", 20}}),
       {},
       {{"corner in the 1st axis, machine coordinates [mm]", {"0.3000"}}}},
      {"CYCLE997", 109, balls({0.3, -0.2, 0.1}), {0, 0, 25}, with(path, {{"S_KNUM", 1}, {"S_SETV", 20}, {"S_FA", 5}})},
      {"CYCLE997",
       1110119,
       balls({0.1, -0.2, 0.1}),
       {0, 0, 30},
       with(path, {{"S_KNUM", 1},
                   {"S_SETV", 20},
                   {"S_FA", 5},
                   {"S_SETV3", 90},
                   {"S_SETV4", 5},
                   {"S_SETV5", 10},
                   {"S_SETV6", 20},
                   {"S_SETV7", 70},
                   {"S_SETV8", -5},
                   {"S_TNVL", 1}})},
      {"CYCLE998",
       100105,
       turnedEdge,
       {10, -12, -10},
       with(path, {{"S_KNUM", 1}, {"S_MA", 102}, {"S_MD", 1}, {"S_ID", 100}, {"S_TSA", 5}, {"S_FA", 10}}),
       {},
       {{"angle of the edge [deg]", {"0.0000", "1.2500", "1.2500"}}, {"corrected", {"$P_UIFR[1,Z,RT]"}}}},
      {"CYCLE998",
       100106,
       tilted,
       {0, 0, 10},
       with(path, {{"S_KNUM", 1},
                   {"S_TSA", 6},
                   {"S_FA", 10},
                   {"S_MA", 103},
                   {"S_SETV0", 40},
                   {"S_SETV2", 15},
                   {"S_SETV3", 35}})},
      {"CYCLE995",
       1102015,
       [](simulation::Truth& truth) {
         place(truth, simulation::SolidSphere({0, 0, table}, 10), Pose::Identity(), "ball",
               simulation::SolidRole::Sphere);
         truth.tools[0].length = 160;
         truth.tools[0].probe.stylusLength = 100;
         truth.errors.spindleTilt = {0.02, -0.03, 0};
       },
       {0, 0, 15},
       {{"S_SETV", 20}, {"S_FA", 5}, {"S_TSA", 3}, {"S_DZ", 50}}},
  };
}

TEST(ResultScreens, HaveWhatTheControlShowsInEveryVariant) {
  for (const Variant& variant : variants()) {
    SCOPED_TRACE(fmt::format("{} S_MVAR {}", variant.cycle, variant.mvar));
    simulation::Truth truth = perfectWorld();
    variant.part(truth);
    SinumerikBench bench(truth);
    bench.set("$TC_DP3", {1, 1}, truth.tools[0].length);
    bench.control.data.set("$TC_TP2", {2}, std::string("MILL"));
    bench.set("$TC_DP1", {2, 1}, 120);
    bench.set("$TC_DP3", {2, 1}, 90);
    bench.set("$TC_DP6", {2, 1}, 8);
    plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
    showAndLog(bench.control);
    bench.start(variant.start);
    bench.run(variant.cycle, with(variant.call, {{"S_MVAR", variant.mvar}}), variant.texts);
    expectScreenAndLogs(bench.control, variant.cycle, variant.mvar);
    const std::string text = bench.screen();
    for (const auto& [label, words] : variant.rows)
      EXPECT_EQ(ResultScreen(text).row(label), words) << label << "\n" << text;
  }
}

}  // namespace
}  // namespace probewright::testing_support
