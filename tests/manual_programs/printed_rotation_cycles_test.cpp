#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "manual_programs/part.hpp"

/// The examples that the manual prints for semi-automatic probing and for tolerances in cycles 1410, 1411 and 1420,
/// completed to whole blocks and run on parts that lie somewhere else than the drawing's coordinates say.
namespace probewright::testing_support {
namespace {

using ::testing::HasSubstr;

constexpr double exact = 1e-6;

const Words travel = {{320, 0}, {260, 100}, {1125, 0}, {309, 0}, {1126, 0}, {1120, 0}, {1121, 0}};

/// The operator brings the tip of the probe to these places, main, minor and tool axis.
void answers(Part& part, const std::map<std::string, Vector3>& places) {
  part.bench.answer = [places](const std::string& question) -> std::optional<std::string> {
    const auto found = places.find(question);
    if (found == places.end()) return std::nullopt;
    const Vector3& tip = found->second;
    return fmt::format("{0} {1} 90; {0} {1} {2}", tip.x(), tip.y(), tip.z());
  };
}

TEST(PrintedSemiAutomatic, Cycle1411FindsTwoHolesAnywhere) {
  Part part(ControlKind::TNC640);
  // The drawing has the holes at X30 Y50 and X75 Y50; the part lies elsewhere, and askew.
  const Pose lying = pose({52.4, -61.3, 0}, {0, 0, 6});
  const Vector3 first = lying * Vector3(30, 50, 0), second = lying * Vector3(75, 50, 0);
  part.hole(first.head<2>(), 10.2);
  part.hole(second.head<2>(), 9.9);
  answers(part, {{"1411 object 1", Vector3(first.x() + 0.7, first.y() - 0.4, -9)},
                 {"1411 object 2", Vector3(second.x() - 0.5, second.y() + 0.6, -8)}});
  const std::string texts =
      " ~\n QS1100= \"?30\" ;X ~\n QS1101= \"?50\" ;Y ~\n QS1102= \"?\" ;Z ~\n Q1116=+10 ;D ~\n QS1103= \"?75\" ;X ~\n"
      " QS1104= \"?50\" ;Y ~\n QS1105= \"?\" ;Z ~\n Q1117=+10 ;D ~\n Q1115=+0 ;KIND";
  const Words rest = with(Words{{423, 4}, {325, 0}, {1119, 360}}, with(travel, {{1120, 1}, {1121, 1}}));
  const Ran ran = part.bench.run(probe(1411, rest, texts));
  ASSERT_TRUE(ran.finished()) << ran.why();
  EXPECT_NEAR(ran.q(950), first.x(), exact);
  EXPECT_NEAR(ran.q(954), second.y(), exact);
  EXPECT_NEAR(ran.q(966), 10.2, exact);
  EXPECT_NEAR(ran.q(967), 9.9, exact);
  EXPECT_NEAR(ran.q(994), 6, exact);
  EXPECT_NEAR(ran.q(982), 0, exact) << "? takes the measured height for the nominal one";
  const Vector3 origin = pose({0, 0, tableHeight}) * lying * Vector3::Zero();
  EXPECT_LT((ran.preset().translation() - origin).head<2>().norm(), exact) << "the drawing's origin";
}

TEST(PrintedSemiAutomatic, Cycle1410FindsAnEdgeAnywhere) {
  Part part(ControlKind::TNC640);
  const double lies = 3;
  part.wall({20, 37.5}, lies);
  const auto onEdge = [&](double x) { return 37.5 + (x - 20) * std::tan(radians(lies)); };
  answers(part,
          {{"1410 point 1", Vector3(-20, onEdge(-20) - 8, -10)}, {"1410 point 2", Vector3(60, onEdge(60) - 9, -10)}});
  const std::string texts =
      " ~\n QS1100= \"?\" ;X ~\n QS1101= \"?0\" ;Y ~\n QS1102= \"?\" ;Z ~\n QS1103= \"?\" ;X ~\n QS1104= \"?0\" ;Y ~\n"
      " QS1105= \"?\" ;Z ~\n Q372=+2 ;WAY";
  const Ran ran = part.bench.run(probe(1410, with(travel, {{1120, 3}, {1121, 1}}), texts));
  ASSERT_TRUE(ran.finished()) << ran.why();
  // The nominal line runs along the main axis through 0.
  EXPECT_NEAR(ran.q(994), lies, exact);
  EXPECT_NEAR(ran.q(980), 0, exact);
  const double late = 2 / std::cos(radians(lies)) - 2;
  EXPECT_NEAR(ran.q(981), onEdge(-20) - late, exact);
  EXPECT_NEAR(ran.q(984), onEdge(60) - late, exact);
  const Vector3 middle(20, (ran.q(951) + ran.q(954)) / 2, tableHeight);
  EXPECT_NEAR(ran.seen(middle).y(), 0, exact) << "the middle of the edge has become Y 0";
}

TEST(PrintedSemiAutomatic, Cycle1420FindsAPlaneAnywhere) {
  Part part(ControlKind::TNC640);
  const Vector3 normal = pose(Vector3::Zero(), {2, -3, 0}).linear().col(2);
  part.bench.part(simulation::HalfSpace({Vector3(0, 0, tableHeight + 12), normal}));
  const auto height = [&](double x, double y) { return 12 - (normal.x() * x + normal.y() * y) / normal.z(); };
  answers(part, {{"1420 point 1", Vector3(50, 10, height(50, 10) + 6)},
                 {"1420 point 2", Vector3(80, 50, height(80, 50) + 6)},
                 {"1420 point 3", Vector3(20, 80, height(20, 80) + 6)}});
  std::string texts;
  const int nominal[] = {50, 10, 0, 80, 50, 0, 20, 80, 0};
  for (int i = 0; i < 9; ++i)
    texts += fmt::format(" ~\n QS{}= \"?{}\" ;NOMINAL", 1100 + i, nominal[i]);
  const Ran ran = part.bench.run(probe(1420, with(travel, {{1120, 1}, {1121, 1}}), texts + " ~\n Q372=-3 ;WAY"));
  ASSERT_TRUE(ran.finished()) << ran.why();
  EXPECT_LT((ran.preset().linear().col(2) - normal).norm(), 1e-9);
  EXPECT_NEAR(ran.q(961), degrees(std::asin(-normal.y())), exact);
  EXPECT_NEAR(ran.q(962), degrees(std::atan2(normal.x(), normal.z())), exact);
  const double late = 2 / normal.z() - 2;
  EXPECT_NEAR(ran.q(982), height(50, 10) + late, exact);
}

/// Diameters of 10 mm with the limits 9 and 9.5: the first is good, the second scrap; Q309 = 2 asks about scrap alone.
TEST(PrintedTolerances, Cycle1411StopsAtScrap) {
  Part part(ControlKind::TNC640);
  part.hole({30.02, 50}, 9.3);
  part.hole({75, 50}, 9.52);
  const std::string texts =
      " ~\n Q1100=+30 ;X ~\n Q1101= +50 ;Y ~\n Q1102= -5 ;Z ~\n QS1116=\"+10-1-0.5\";D ~\n Q1103= +75 ;X ~\n"
      " Q1104=+50 ;Y ~\n QS1105= -5 ;Z ~\n QS1117=\"+10-1-0,5\";D ~\n Q1115=+0 ;KIND";
  const Words rest = with(Words{{423, 4}, {325, 0}, {1119, 360}}, with(travel, {{309, 2}, {1125, 1}}));
  const Ran ran = part.bench.run(probe(1411, rest, texts));
  ASSERT_TRUE(ran.finished()) << ran.why();
  EXPECT_EQ(ran.q(183), 2);
  EXPECT_NEAR(ran.q(996), 9.3 - 9.25, exact);
  EXPECT_NEAR(ran.q(997), 9.52 - 9.25, exact);
  ASSERT_EQ(ran.screens().size(), 1U);
  EXPECT_THAT(ran.screens().front(), HasSubstr("scrap"));
  EXPECT_THAT(ran.screens().front(), HasSubstr("Diameter 2: nominal 10.0000, actual 9.5200"));
  part.bench.setup.world.truth.solids.pop_back();
  part.hole({75, 50}, 9.4);
  const Ran good = part.bench.run(probe(1411, rest, texts));
  EXPECT_EQ(good.q(183), 0);
  EXPECT_TRUE(good.screens().empty());
}

}  // namespace
}  // namespace probewright::testing_support
