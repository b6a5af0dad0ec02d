#include <array>

#include "cycles_heidenhain/across.hpp"

/// Touch probe axis X and Y: a probe in an angle head. Main and minor axis are Y and Z, or Z and X.
namespace probewright::testing_support {
namespace {

constexpr double exact = 1e-6;

TEST(ToolAxis, MeasuresHolesStudsAndHeightsAlongXAndY) {
  Dice dice(181);
  for (int at = 0; at < 40; ++at) {
    const char axis = dice.coin() ? 'X' : 'Y';
    SCOPED_TRACE(fmt::format("world {}, tool axis {}", at, axis));
    Across world(controlOf(at / 2), axis);
    const bool newer = world.bench.control == ControlKind::TNC640;
    const Vector3 centre(dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1));
    const double diameter = dice.between(33, 37);
    const bool hole = dice.coin();
    if (hole) {
      world.part(simulation::Ring(diameter / 2, diameter / 2 + 20, -30), pose(centre));
    } else {
      world.part(simulation::RoundBar(diameter / 2, -30, 0), pose(centre));
    }
    Words words = {{273, 0},  {274, 0}, {262, 35}, {325, 20}, {247, 90}, {261, -9}, {320, 1},
                   {260, 20}, {301, 1}, {279, 0},  {280, 0},  {281, 0},  {309, 0},  {330, 0}};
    words = with(words, hole ? Words{{275, 0}, {276, 0}} : Words{{277, 0}, {278, 0}});
    if (newer) words = with(words, {{423, 4}, {365, 1}});
    const Ran ran = world.run(probe(hole ? 421 : 422, words));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.q(151), centre.x(), exact);
    EXPECT_NEAR(ran.q(152), centre.y(), exact);
    EXPECT_NEAR(ran.q(153), diameter, exact);

    Words preset = {{321, 0}, {322, 0},  {262, 35}, {325, 0}, {247, 90}, {261, -9},
                    {320, 1}, {260, 20}, {301, 1},  {331, 7}, {332, -3}};
    if (newer) preset = with(preset, {{423, 4}, {365, 1}});
    const Ran moved = world.run(probe(hole ? 412 : 413, presetInto1(preset)));
    ASSERT_TRUE(moved.finished()) << moved.why();
    EXPECT_LT((world.seen(moved, centre) - Vector3(7, -3, centre.z())).norm(), exact);

    // The face square to the tool axis, beside the hole or on the stud.
    const double aside = hole ? 27 : 4;
    const Ran height = world.run(probe(427, {{263, aside},
                                             {264, 0},
                                             {261, 0},
                                             {320, 1},
                                             {272, 3},
                                             {267, -1},
                                             {260, 20},
                                             {281, 0},
                                             {288, 0},
                                             {289, 0},
                                             {309, 0},
                                             {330, 0}}));
    ASSERT_TRUE(height.finished()) << height.why();
    EXPECT_NEAR(height.q(160), centre.z(), exact);
    const Ran level =
        world.run(probe(417, {{263, aside}, {264, 0}, {294, 0}, {320, 1}, {260, 20}, {305, 1}, {333, 2.5}, {303, 1}}));
    ASSERT_TRUE(level.finished()) << level.why();
    EXPECT_NEAR(world.seen(level, centre).z(), 2.5, exact);
  }
}

TEST(ToolAxis, MeasuresRectanglesWidthsAndEdgesAlongXAndY) {
  for (const char axis : {'X', 'Y'}) {
    for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
      SCOPED_TRACE(fmt::format("tool axis {}", axis));
      Across world(kind, axis);
      const Vector3 centre(0.4, -0.3, 0.2);
      world.part(simulation::Box({-20, -15, -30}, {20, 15, 0}), pose(centre));
      const Ran stud = world.run(probe(424, {{273, 0},
                                             {274, 0},
                                             {282, 40},
                                             {283, 30},
                                             {261, -9},
                                             {320, 1},
                                             {260, 20},
                                             {301, 1},
                                             {284, 0},
                                             {285, 0},
                                             {286, 0},
                                             {287, 0},
                                             {279, 0},
                                             {280, 0},
                                             {281, 0},
                                             {309, 0},
                                             {330, 0}}));
      ASSERT_TRUE(stud.finished()) << stud.why();
      EXPECT_NEAR(stud.q(151), centre.x(), exact);
      EXPECT_NEAR(stud.q(152), centre.y(), exact);
      EXPECT_NEAR(stud.q(154), 40, exact);
      EXPECT_NEAR(stud.q(155), 30, exact);
      const Ran ridge = world.run(probe(426, {{263, 0},
                                              {264, 15},
                                              {265, 0},
                                              {266, -15},
                                              {272, 2},
                                              {261, -9},
                                              {320, 1},
                                              {260, 20},
                                              {311, 30},
                                              {288, 0},
                                              {289, 0},
                                              {281, 0},
                                              {309, 0},
                                              {330, 0}}));
      ASSERT_TRUE(ridge.finished()) << ridge.why();
      EXPECT_NEAR(ridge.q(156), 30, exact);
      EXPECT_NEAR(ridge.q(157), centre.y(), exact);
      for (int measured = 1; measured <= 2; ++measured) {
        const Ran wall = world.run(probe(419, {{263, measured == 1 ? -20 : 0},
                                               {264, measured == 2 ? -15 : 0},
                                               {261, -9},
                                               {320, 1},
                                               {260, 20},
                                               {272, measured},
                                               {267, 1},
                                               {305, 1},
                                               {333, 1.5},
                                               {303, 1}}));
        ASSERT_TRUE(wall.finished()) << wall.why();
        EXPECT_NEAR(world.seen(wall, centre - Vector3(20, 15, 0))[measured - 1], 1.5, exact);
      }
    }
  }
}

TEST(ToolAxis, FindsTheMisalignmentAboutXAndY) {
  Dice dice(1810);
  for (int at = 0; at < 20; ++at) {
    const char axis = dice.coin() ? 'X' : 'Y';
    SCOPED_TRACE(fmt::format("world {}, tool axis {}", at, axis));
    Across world(ControlKind::TNC640, axis);
    const double skew = dice.between(-2, 2);
    world.part(simulation::Box({-40, -30, -30}, {40, 30, 0}), pose(Vector3::Zero(), {0, 0, skew}));
    const Words edge = {{263, -30}, {264, -30}, {265, 30}, {266, -30}, {272, 2}, {267, 1},
                        {261, -9},  {320, 3},   {260, 20}, {301, 1},   {307, 0}, {305, 0}};
    const Ran ran = world.run(probe(400, edge) + probe(400, edge));
    ASSERT_TRUE(ran.finished()) << ran.why();
    // The second run finds nothing left, and the preset's axes are those of the part.
    EXPECT_NEAR(ran.q(150), 0, exact);
    const Matrix3 part = (world.machineFromPlane() * pose(Vector3::Zero(), {0, 0, skew})).linear();
    EXPECT_LT((ran.preset().linear() * world.machineFromPlane().linear() - part).norm(), 1e-6);

    const Words words = {{1100, -30}, {1101, -30}, {1102, -9}, {1103, 30}, {1104, -30}, {1105, -9}, {372, 2},
                         {320, 3},    {260, 20},   {1125, 1},  {309, 0},   {1126, 0},   {1120, 0},  {1121, 1}};
    const Ran rotated = world.run(probe(1410, words));
    ASSERT_TRUE(rotated.finished()) << rotated.why();
    EXPECT_NEAR(rotated.q(994), skew, exact);
    EXPECT_LT((rotated.preset().linear() * world.machineFromPlane().linear() - part).norm(), 1e-6);
  }
}

TEST(ToolAxis, CalibratesAlongXAndY) {
  for (const char axis : {'X', 'Y'}) {
    SCOPED_TRACE(fmt::format("tool axis {}", axis));
    Across world(ControlKind::TNC640, axis);
    world.part(simulation::Ring(20, 40, -30), pose({0.3, -0.2, 0}));
    auto& believed = world.bench.believedProbe();
    believed.tipOffset = {-0.1, 0.2};
    believed.radius += 0.1;
    believed.length -= 0.2;
    const char* names[] = {"X", "Y", "Z"};
    const std::string go =
        fmt::format("L {}+60 R0 FMAX\nL {}+0 {}+0 R0 FMAX\nL {}-9 R0 FMAX\n", names[world.plane.tool],
                    names[world.plane.main], names[world.plane.minor], names[world.plane.tool]);
    const std::string up = fmt::format("L {}+60 R0 FMAX\n", names[world.plane.tool]);
    const std::string beside = fmt::format("L {}+30 {}+0 R0 FMAX\nL {}+5 R0 FMAX\n", names[world.plane.main],
                                           names[world.plane.minor], names[world.plane.tool]);
    const Ran ran =
        world.run(go + probe(462, {{407, 20}, {320, 0}, {423, 4}, {380, 30}}) + up + beside + probe(461, {{434, 0}}));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.cell("TOOL.T", "1", "R"), 2, exact);
    EXPECT_NEAR(ran.cell("TOOL.T", "1", "L"), 100, exact);
    const std::string& table = ran.outcome.files.at("TCHPROBE.TP");
    EXPECT_NE(table.find("+0.0800"), std::string::npos) << table;
    EXPECT_NE(table.find("-0.0500"), std::string::npos) << table;
  }
}

TEST(ToolAxis, MeasuresPocketsSlotsAndBoltCirclesAlongXAndY) {
  Dice dice(183);
  for (int at = 0; at < 40; ++at) {
    const char axis = dice.coin() ? 'X' : 'Y';
    SCOPED_TRACE(fmt::format("world {}, tool axis {}", at, axis));
    const ControlKind kind = controlOf(at / 2);
    const Vector3 middle(dice.between(-0.5, 0.5), dice.between(-0.5, 0.5), dice.between(-1, 1));
    const Vector2 size(dice.between(39.5, 40.5), dice.between(29.5, 30.5));
    Across pocket(kind, axis);
    const Vector2 half = size / 2;
    pocket.part(simulation::Box({half.x(), -40, -30}, {half.x() + 20, 40, 0}), pose(middle));
    pocket.part(simulation::Box({-half.x() - 20, -40, -30}, {-half.x(), 40, 0}), pose(middle));
    pocket.part(simulation::Box({-half.x(), half.y(), -30}, {half.x(), half.y() + 20, 0}), pose(middle));
    pocket.part(simulation::Box({-half.x(), -half.y() - 20, -30}, {half.x(), -half.y(), 0}), pose(middle));
    const Words common = {{261, -9}, {260, 20}, {281, 0}, {309, 0}, {330, 0}};
    const Ran inside = pocket.run(probe(423, with(common, {{273, 0},
                                                           {274, 0},
                                                           {282, 40},
                                                           {283, 30},
                                                           {320, 1},
                                                           {301, dice.whole(0, 1)},
                                                           {284, 0},
                                                           {285, 0},
                                                           {286, 0},
                                                           {287, 0},
                                                           {279, 0},
                                                           {280, 0}})));
    ASSERT_TRUE(inside.finished()) << inside.why();
    EXPECT_NEAR(inside.q(151), middle.x(), exact);
    EXPECT_NEAR(inside.q(152), middle.y(), exact);
    EXPECT_NEAR(inside.q(154), size.x(), exact);
    EXPECT_NEAR(inside.q(155), size.y(), exact);
    for (const int across : {1, 2}) {
      const double width = size[across - 1];
      const Words slot = {{328, 0}, {329, 0}, {310, written(dice.between(-5, 5))}, {272, across}, {311, written(width)},
                          {288, 0}, {289, 0}};
      const Ran ran = pocket.run(probe(425, with(common, slot)));
      ASSERT_TRUE(ran.finished()) << ran.why();
      EXPECT_NEAR(ran.q(156), width, exact);
      EXPECT_NEAR(ran.q(157), middle[across - 1], exact);
    }

    Across holes(kind, axis);
    const double radius = dice.between(29.5, 30.5);
    const Vector3 angles(10, 130, 250);
    for (const double angle : angles) {
      holes.part(simulation::Ring(6, 12, -30),
                 pose(middle + radius * Vector3(std::cos(radians(angle)), std::sin(radians(angle)), 0)));
    }
    const Ran ran = holes.run(probe(430, with(common, {{273, 0},
                                                       {274, 0},
                                                       {262, 60},
                                                       {291, angles[0]},
                                                       {292, angles[1]},
                                                       {293, angles[2]},
                                                       {288, 0},
                                                       {289, 0},
                                                       {279, 0},
                                                       {280, 0}})));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.q(151), middle.x(), exact);
    EXPECT_NEAR(ran.q(152), middle.y(), exact);
    EXPECT_NEAR(ran.q(153), 2 * radius, exact);
  }
}

/// Projection angles count in the planes of the touch probe axis, space angles about X, Y and Z: turned by them, the
/// axes of the program lie in the plane.
TEST(ToolAxis, MeasuresPlanesAlongXAndY) {
  Dice dice(184);
  for (int at = 0; at < 40; ++at) {
    const char axis = dice.coin() ? 'X' : 'Y';
    SCOPED_TRACE(fmt::format("world {}, tool axis {}", at, axis));
    Across world(controlOf(at / 2), axis);
    const Pose face = pose({0, 0, dice.between(-1, 1)}, {dice.between(-15, 15), dice.between(-15, 15), 0});
    world.part(simulation::Box({-60, -60, -20}, {60, 60, 0}), face);
    const Vector3 n = face.linear().col(2);
    const auto heightAt = [&](const Vector2& place) {
      return face.translation().z() - (n.x() * place.x() + n.y() * place.y()) / n.z();
    };
    const std::array<Vector2, 3> places = {Vector2(-20, -20), Vector2(25, written(dice.between(-25, 0))),
                                           Vector2(0, 20)};
    const Ran ran = world.run(probe(431, {{263, places[0].x()},
                                          {264, places[0].y()},
                                          {294, written(heightAt(places[0]))},
                                          {265, places[1].x()},
                                          {266, places[1].y()},
                                          {295, written(heightAt(places[1]))},
                                          {296, places[2].x()},
                                          {297, places[2].y()},
                                          {298, written(heightAt(places[2]))},
                                          {320, 1},
                                          {260, 30},
                                          {281, 0}}));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.q(158), degrees(std::atan2(-n.y(), n.z())), exact);
    EXPECT_NEAR(ran.q(159), degrees(std::atan2(n.x(), n.z())), exact);
    const Matrix3 turned = pose(Vector3::Zero(), {ran.q(170), ran.q(171), ran.q(172)}).linear();
    EXPECT_LT((turned.col(world.plane.tool) - world.plane.xyzFromPlane(n)).norm(), 1e-8);
    const Vector3 along(places[1].x() - places[0].x(), places[1].y() - places[0].y(),
                        heightAt(places[1]) - heightAt(places[0]));
    EXPECT_LT((turned.col(world.plane.main) - world.plane.xyzFromPlane(along.normalized())).norm(), 1e-8);
    // The ball meets a slanting plane beside its south pole.
    const double ball = world.bench.believedProbe().radius, tilt = 1 / n.z() - 1;
    for (std::size_t i = 0; i < (world.bench.control == ControlKind::TNC640 ? 3U : 1U); ++i) {
      EXPECT_NEAR(ran.q(173 + static_cast<int>(i)), heightAt(places[i]) + ball * tilt, exact) << i;
    }
  }
}

}  // namespace
}  // namespace probewright::testing_support
