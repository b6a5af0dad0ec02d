#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "survival/survival_bench.hpp"

/// Worlds that try to deceive a proof: what fails is thin, is met at a tangent, or lies in a tiny corner of the box.
/// Wherever it fails by a closed form, nothing may be proven; and what is proven is run, half of it on the borders.
namespace probewright::survival::testing {
namespace {

const Options few = {.samples = 60, .boxes = 60, .checks = 200};

std::string fixture(const std::string& name, const Vector3& at, const Vector3& size) {
  const auto list = [](const Vector3& v) {
    return std::to_string(v.x()) + ", " + std::to_string(v.y()) + ", " + std::to_string(v.z());
  };
  return "[[fixture]]\nname = \"" + name + "\"\npose = { x = " + std::to_string(at.x()) +
         ", y = " + std::to_string(at.y()) + ", z = " + std::to_string(at.z()) +
         " }\n[[fixture.feature]]\nshape = \"box\"\nsize = [" + list(size) + "]\n";
}

std::string top(double x, double y) {
  return "TCH PROBE 417 REF. POINT TS.-AXIS ~\nQ263=+" + std::to_string(x) + " ~\nQ264=+" + std::to_string(y) +
         " ~\nQ294=+0 ~\nQ320=+2 ~\nQ260=+20 ~\nQ305=+1 ~\nQ333=+0 ~\nQ303=+1\n";
}

/// True if a point of the box is in a part that is proven.
bool isProven(const Survival& survival, const std::vector<double>& values) {
  for (const Part& part : survival.parts)
    if (part.verdict == Verdict::Proven && part.box.holds(values)) return true;
  return false;
}

/// 0.05 mm thick, in the bore: the ball of 3 mm meets it wherever its way comes nearer than that.
TEST(Attack, ANeedleThatNoTouchIsToMeet) {
  const std::string setup = plateSetup("TNC640", "", fixture("needle", {2, 2, -490}, {0.05, 0.05, 30}));
  const Survival survival =
      survivalOf(setup, klartext(inspectBore), {"fixture[needle].pose.x=6", "fixture[needle].pose.y=7"}, few);
  EXPECT_EQ(survival.end, SurvivalEnd::Finished);
  EXPECT_GT(survival.proven, 0.1);
  // Each touch ends with the ball's middle 12 mm from that of the bore; the needle stands within the ball.
  for (const double x : {7.0, 7.9})
    EXPECT_FALSE(isProven(survival, {x, 0.5})) << x;
}

/// The ball passes a post by 0.001 mm.
TEST(Attack, APostThatIsNearlyTouched) {
  const std::string post = fixture("post", {-10, 13.001, -480}, {20, 20, 20});
  const std::string by = "L X-40 Y+0 R0 FMAX\nL Z+10 R0 FMAX\nL X+40 R0 FMAX\nL Z+50 R0 FMAX\n";
  for (const double half : {0.002, 2.0}) {
    const Survival survival = survivalOf(plateSetup("TNC640", "", post), klartext(by),
                                         {"fixture[post].pose.y=13.001.." + std::to_string(13.001 + half)}, few);
    EXPECT_EQ(survival.end, SurvivalEnd::Finished);
    EXPECT_EQ(survival.failed, 0U);
    const Survival nearer =
        survivalOf(plateSetup("TNC640", "", post), klartext(by), {"fixture[post].pose.y=" + std::to_string(half)}, few);
    EXPECT_EQ(nearer.end, SurvivalEnd::Finished);
    EXPECT_GT(nearer.failed, 0U);
    EXPECT_LE(nearer.symmetric * half, 0.001 + 1e-6);
  }
}

/// A bar lies over the border of the bore, higher than the ball: the stylus of 2 mm meets it while the ball is on its
/// way from 7 mm to where it touches, 12 mm from the middle, wherever the bar reaches nearer than 13 mm.
TEST(Attack, ABarThatTheStylusMeetsOnItsWayToATouch) {
  std::string program = klartext(inspectBore);
  program.replace(program.find("Q320=+2"), 7, "Q320=+5");
  const std::string bar = fixture("bar", {28, 0, -478}, {20, 60, 8});  // from 18 mm on
  const Survival survival = survivalOf(plateSetup("TNC640", "stylus_radius = 1\nbody_radius = 20\n", bar), program,
                                       {"fixture[bar].pose.x=7.4"}, few);
  EXPECT_EQ(survival.end, SurvivalEnd::Finished);
  EXPECT_GT(survival.failed, 0U);
  EXPECT_GT(survival.proven, 0.5);
  for (const double x : {20.7, 21.5, 22.9})
    EXPECT_FALSE(isProven(survival, {x})) << x;
  EXPECT_TRUE(isProven(survival, {24}));
}

/// The last touch orients the spindle to its direction, which follows the measured angle of the part. Then the ball of
/// an arm, 40 mm from the axis of the spindle, stands 0.2 mm beside a post.
TEST(Attack, AStarThatTurnsWithWhatIsMeasured) {
  const std::string program = klartext(
      "TCH PROBE 400 BASIC ROTATION ~\nQ263=-25 ~\nQ264=-30 ~\nQ265=+25 ~\nQ266=-30 ~\nQ272=+2 ~\nQ267=+1 ~\n"
      "Q261=+15 ~\nQ320=+3 ~\nQ260=+20 ~\nQ301=+1 ~\nQ307=+0 ~\nQ305=+1\n"
      "TCH PROBE 427 MEASURE COORDINATE ~\nQ263=+0 ~\nQ264=-30 ~\nQ261=+15 ~\nQ320=+3 ~\nQ272=+2 ~\nQ267=+1 ~\n"
      "Q260=+20 ~\nQ281=+0 ~\nQ288=+0 ~\nQ289=+0 ~\nQ309=+0 ~\nQ330=+0\n"
      "L Z+50 R0 FMAX\nL X+0 Y+0 R0 FMAX M91\nL X+100 R0 FMAX M91\n");
  const std::string setup = plateSetup("TNC640", "orient = true\nstar_arm = 20\ntip_offset = [0, -20]\n",
                                       fixture("post", {140, 7.2, -500}, {10, 8, 80}));
  const auto clampings = clamped(setup, program, {"part.pose.c=3"});
  const double limit = std::asin(0.2 / 40) * 180 / std::numbers::pi;
  EXPECT_FALSE(clampings->run(std::vector<double>{0.99 * limit}, 1).failure);
  EXPECT_TRUE(clampings->run(std::vector<double>{1.01 * limit}, 1).failure);
  const auto verdict = [&](double half) { return proveBox(*clampings, {{-half}, {half}}).verdict; };
  EXPECT_EQ(verdict(0.1 * limit), Verdict::Proven);
  EXPECT_EQ(verdict(1.05 * limit), Verdict::Undecided);
}

/// The touch on a disc of 80 mm leaves its face in one corner of the box only: where x and y both shift by more
/// than 2.28 mm or so, 0.01 % of the box.
TEST(Attack, ATinyCornerThatFails) {
  std::string setup = plateSetup();
  const std::string box =
      "shape = \"box\"\nsize = [80, 60, 20]\n[[part.feature]]\nshape = \"hole\"\ncentre = [0, 0, 20]\ndiameter = 30\n";
  setup.replace(setup.find(box), box.size(), "shape = \"cylinder\"\ndiameter = 80\nheight = 20\n");
  const Survival survival = survivalOf(setup, klartext(top(26, 26)), {"part.pose.x=2.3", "part.pose.y=2.3"}, few);
  EXPECT_EQ(survival.end, SurvivalEnd::Finished);
  EXPECT_GT(survival.proven, 0.5);
  EXPECT_LT(survival.proven, 1);
  EXPECT_FALSE(isProven(survival, {-2.29, -2.29})) << "26 + 2.29 in both: 40.01 mm from the middle of the disc";
  EXPECT_TRUE(isProven(survival, {2.2, 2.2}));
}

/// A part that lies turned by nearly half a turn: angles go through 180 degrees.
TEST(Attack, APartThatIsTurnedRound) {
  std::string setup = plateSetup();
  setup.replace(setup.find("c = 0"), 5, "c = 179.9");
  const Survival survival = survivalOf(setup, klartext(inspectBore), {"part.pose.c=3", "part.pose.y=1"}, few);
  EXPECT_EQ(survival.end, SurvivalEnd::Finished);
  EXPECT_EQ(survival.failed, 0U);
  EXPECT_GT(survival.proven, 0.05);
}

/// A wall of 0.05 mm that the probe is to find: it shifts away before it, or below the ball.
TEST(Attack, AThinWall) {
  std::string setup = plateSetup();
  const std::string hole = "shape = \"hole\"\ncentre = [0, 0, 20]\ndiameter = 30\n";
  setup.replace(setup.find(hole), hole.size(),
                "shape = \"pocket\"\ncentre = [0, 0, 20]\nsize = [79.9, 50]\ndepth = 15\n");
  const std::string wall =
      "TCH PROBE 427 SIDE ~\nQ263=+40 ~\nQ264=+0 ~\nQ261=-5 ~\nQ320=+2 ~\nQ272=+1 ~\nQ267=-1 ~\nQ260=+30 ~\nQ281=+0 "
      "~\nQ288=+0 ~\nQ289=+0 ~\nQ309=+0 ~\nQ330=+0\n";
  const Survival survival = survivalOf(setup, klartext(wall), {"part.pose.x=6", "part.pose.z=7"}, few);
  EXPECT_EQ(survival.end, SurvivalEnd::Finished);
  EXPECT_GT(survival.failed, 0U);
  // 5 mm below the face with a ball of 3 mm: nothing is there where the part lies 8 mm deeper, and the ball meets the
  // edge where it lies more than 5 mm deeper.
  EXPECT_FALSE(isProven(survival, {0, -506}));
}

}  // namespace
}  // namespace probewright::survival::testing
