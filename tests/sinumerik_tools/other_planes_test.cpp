#include "sinumerik_tools/tool_bench.hpp"

/// CYCLE971 in G18 and G19: the head lies, and so does the probe whose upper face looks towards the tool.
namespace probewright {
namespace {

using namespace testing_support;

struct Lying {
  const char* machine;
  const char* turn;       ///< brings the tool along the 3rd axis of the plane
  int plane;              ///< 18 or 19
  Matrix3 upright;        ///< how the probe lies
  Vector3 displaced;      ///< the nose by the turn of the head, from where the control shows it
  std::array<int, 3> of;  ///< X, Y, Z (0 to 2) of the axes of the plane
};

TEST(ToolsInOtherPlanes, AreMeasuredByAProbeThatLies) {
  // B turns about a line 150 over the nose, A about one 200 over it.
  const Lying cases[] = {
      {"mill5-head-table", "B90", 19, rotation(Vector3::UnitY(), 90).linear(), {-150, 0, 150}, {1, 2, 0}},
      {"mill5-head-head", "A-90", 18, rotation(Vector3::UnitX(), -90).linear(), {0, -200, 200}, {2, 0, 1}}};
  Planter plant(97105);
  for (const Lying& lying : cases) {
    for (const bool byCall : {false, true}) {
      SCOPED_TRACE(fmt::format("G{}, {}", lying.plane, byCall ? "of the call" : "of the program"));
      ToolBench bench(lying.machine);
      for (machine::Axis& axis : bench.setup.world.truth.machine.axes) {
        axis.minimum = -2000;
        axis.maximum = 2000;
      }
      const Vector3 contact(100, 40, -450);
      const double width = 20;
      Pose pose = translation(contact);
      pose.linear() = lying.upright;
      placeToolProbe(bench.setup.world.truth, simulation::RoundBar(width / 2, -12, 0), pose);
      bench.add(9, 80, 4);
      bench.add(2, 95.3, 7.1);
      bench.believed(2).length = 95;
      bench.believed(2).radius = 7;
      // As the control shows it: along the axes of the plane.
      const Vector3 shown = contact - lying.displaced;
      const auto truth = [&](int axis, double sign) {
        return shown[lying.of[static_cast<std::size_t>(axis)]] - (axis < 2 ? sign * width / 2 : 0);
      };
      const auto name = [](int axis, double sign) {
        return fmt::format("$SNS_MEA_TP_TRIG_{}_DIR_AX{}[0]", sign < 0 ? "MINUS" : "PLUS", axis + 1);
      };
      for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {-1.0, 1.0})
          if (axis < 2 || sign < 0) bench.datum(name(axis, sign), truth(axis, sign) + plant.number(-0.4, 0.4));
      bench.datum("$SNS_MEA_TP_EDGE_DISK_SIZE[0]", width);
      bench.datum("$SNS_MEA_TP_AX_DIR_AUTO_CAL[0]", 133);
      // The nose, a tool's length and more before the contact, beside it along the 1st axis of the plane.
      const auto place = [&](double beside, double before) {
        Vector3 at = shown;
        at[lying.of[0]] += beside;
        at[lying.of[2]] += before;
        return fmt::format("SUPA G0 X{:.9f} Y{:.9f} Z{:.9f} D0\nD1\n", at.x(), at.y(), at.z());
      };
      const auto call = [&](const NamedNumbers& numbers) {
        NamedNumbers all = with({{"S_PRNUM", 1}, {"S_FA", 3}, {"S_TSA", 2}}, numbers);
        if (byCall) all = with(all, {{"_DMODE", lying.plane - 16}});
        return ToolBench::call(all);
      };
      // The call's plane is the cycle's own.
      const ToolRun left = bench.program(
          fmt::format("G{} G90 G71 G500\nT9 D1 M6\nSUPA G0 Z400 D0\nG0 {}\n", byCall ? 17 : lying.plane, lying.turn) +
          place(0, 200) + call({{"S_MVAR", 100000}}) + place(0, 200) + "SUPA G0 Z400 D0\nT2 D1 M6\n" + place(-40, 200) +
          place(-40, 130) + call({{"S_MVAR", 1}, {"S_MA", 1}}) + place(-40, 130) + call({{"S_MVAR", 1}, {"S_MA", 3}}) +
          "M30\n");
      ASSERT_EQ(left.code(), "");
      for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {-1.0, 1.0})
          if (axis < 2 || sign < 0) {
            EXPECT_NEAR(left.written(name(axis, sign)), truth(axis, sign), 1e-5) << name(axis, sign);
          }
      EXPECT_NEAR(left.written("$TC_DP6[2,1]"), 7.1, 1e-5);
      EXPECT_NEAR(left.written("$TC_DP3[2,1]"), 95.3, 1e-5);
    }
  }
}

}  // namespace
}  // namespace probewright
