#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "simulation/feeling_probe.hpp"
#include "support/virtual_world.hpp"

/// What the sensors say while another control moves the axes, one servo cycle after another.
namespace probewright::simulation {
namespace {

using testing_support::perfectWorld;
using testing_support::place;
using testing_support::placeToolProbe;
using testing_support::positions;

constexpr double period = 0.001;

/// Axes that somebody else moves.
class Hand {
public:
  explicit Hand(Truth truth, std::optional<int> inSpindle = 1) : probe_(std::move(truth), inSpindle) {
    probe_.onEvent([this](const std::string& what) { events.push_back(what); });
  }

  /// Straight to `target` at `speed` mm/s until `stop` is felt; where that was, or where the way ends.
  template <class Stop>
  Vector3 moveUntil(const Vector3& target, double speed, Stop stop) {
    const Vector3 from = at;
    const double length = (target - from).norm();
    const int steps = std::max(1, static_cast<int>(std::ceil(length / (speed * period) - 1e-6)));
    for (int i = 1; i <= steps; ++i) {
      look(from + (target - from) * (static_cast<double>(i) / steps));
      if (stop(felt)) break;
    }
    return at;
  }
  void move(const Vector3& target, double speed = 50) {
    moveUntil(target, speed, [](const Felt&) { return false; });
  }
  Felt look(const Vector3& where) {
    at = where;
    felt = probe_.feel({positions({at.x(), at.y(), at.z()}), tool, spindleSpeed, period, spindleAngle});
    return felt;
  }
  void pullOff() { probe_.pullOff(); }

  Vector3 at = Vector3::Zero();
  Felt felt;
  int tool = 0;
  double spindleSpeed = 0, spindleAngle = 0;
  std::vector<std::string> events;

private:
  FeelingProbe probe_;
};

const auto touched = [](const Felt& felt) { return felt.touch; };

TEST(FeelingProbe, SignalsOneCycleAfterTheTouchAtMost) {
  std::mt19937_64 random(20261122);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int i = 0; i < 200; ++i) {
    Truth truth = perfectWorld();
    const double side = between(20, 60), pretravel = between(0, 0.02), delay = between(0, 0.002);
    TrueProbe& probe = truth.tools[0].probe;
    probe.pretravel = pretravel;
    probe.signalDelay = delay;
    place(truth, Box({-side, -side, -40}, {side, side, 0}), translation({0, 0, -400}));
    Hand hand(std::move(truth));
    const double y = between(-15, 15), z = between(-320, -305);
    const double start = side + between(2.5, 4), end = side - 2;
    const double speed = (start - end) / std::ceil(between(0.1, 4) / period) / period;
    hand.look({start, y, z});
    // The ball of radius 2 touches where its centre is 2 mm off the face. The way is a whole number of cycles.
    const double contact = side + 2, signal = contact - pretravel - delay * speed;
    const double found = hand.moveUntil({end, y, z}, speed, touched).x();
    ASSERT_TRUE(hand.felt.touch) << i;
    EXPECT_LE(found, signal + 1e-6) << i;
    EXPECT_GE(found, signal - speed * period - 1e-6) << i;
    // The signal stays while the ball is on, and goes when it leaves.
    hand.move({found - 0.1, y, z}, speed);
    EXPECT_TRUE(hand.felt.touch) << i;
    const double free = hand.moveUntil({side + 5, y, z}, speed, [](const Felt& f) { return !f.touch; }).x();
    EXPECT_GE(free, contact - 1e-6);
    EXPECT_LE(free, contact + speed * period + 1e-6);
    EXPECT_FALSE(hand.felt.collision);
  }
}

TEST(FeelingProbe, TurnsBallAndLobingWithTheSpindle) {
  for (const double angle : {0.0, 90.0, 180.0, -37.0, 301.0}) {
    Truth truth = perfectWorld();
    TrueProbe& probe = truth.tools[0].probe;
    probe.tipOffset = {0.3, -0.11};
    probe.pretravel = 0.02;
    probe.lobing = 0.015;
    probe.lobingPhase = 20;
    place(truth, Box({-20, -20, -40}, {20, 20, 0}), translation({0, 0, -400}));
    Hand hand(std::move(truth));
    hand.look({23, 0, -310});
    hand.spindleAngle = angle;
    hand.look({23, 0, -310});
    // The ball of radius 2 stands aside by its offset turned; the face looks along +X of the machine.
    const double a = radiansFromDegrees(angle);
    const double contact = 20 + 2 - (0.3 * std::cos(a) + 0.11 * std::sin(a));
    const double signal = contact - 0.02 - 0.015 * std::cos(3 * (-a - radiansFromDegrees(20)));
    const double found = hand.moveUntil({20, 0, -310}, 1, touched).x();
    EXPECT_LE(found, signal + 1e-6) << angle;
    EXPECT_GE(found, signal - 1 * period - 1e-6) << angle;
  }
}

TEST(FeelingProbe, MissesNothingInALongCycle) {
  Truth truth = perfectWorld();
  place(truth, Box({-0.05, -20, -40}, {0.05, 20, 0}), translation({0, 0, -400}));
  Hand hand(std::move(truth));
  hand.look({4, 0, -310});
  // Through a sheet of 0.1 mm in steps of 2.5 mm.
  hand.move({-1, 0, -310}, 2500);
  EXPECT_TRUE(hand.felt.touch);
}

TEST(FeelingProbe, TakesANewZeroForNoMotion) {
  Truth truth = perfectWorld();
  place(truth, Box({-5, -20, -40}, {5, 20, 0}), translation({0, 0, -400}));
  Hand hand(std::move(truth));
  hand.look({40, 0, -310});
  EXPECT_EQ(hand.look({-40, 0, -310}), Felt{}) << "the axes have not moved through the sheet";
  EXPECT_TRUE(hand.look({0, 0, -310}).touch) << "the ball is within it";
}

TEST(FeelingProbe, FeelsTheStylusAsTheBall) {
  Truth truth = perfectWorld();
  // An edge above the ball: the stylus of radius 1 meets it.
  place(truth, Box({-20, -20, 20}, {0, 20, 25}), translation({0, 0, -400}));
  Hand hand(std::move(truth));
  hand.look({3, 0, -300 + 5});
  const double found = hand.moveUntil({0, 0, -300 + 5}, 5, touched).x();
  EXPECT_TRUE(hand.felt.byStylus);
  EXPECT_NEAR(found, 1, 5 * period + 1e-3);
  EXPECT_FALSE(hand.felt.collision);
}

TEST(FeelingProbe, CollidesWithTheBodyAndCanBePulledOff) {
  Truth truth = perfectWorld();
  place(truth, Box({-50, -50, -100}, {0, 50, 0}), translation({0, 0, -200}));
  Hand hand(std::move(truth));
  // The body of radius 20 begins 62 mm above the tip: at Z-200 its lower face lies at -238.
  hand.look({25, 0, -200});
  hand.moveUntil({10, 0, -200}, 20, [](const Felt& felt) { return felt.collision; });
  ASSERT_TRUE(hand.felt.collision);
  EXPECT_FALSE(hand.felt.touch) << "only the stylus is deflected";
  EXPECT_NEAR(hand.at.x(), 20, 20 * period + 1e-3);
  EXPECT_TRUE(hand.look(hand.at).collision) << "as long as it touches";
  hand.pullOff();
  EXPECT_EQ(hand.look(hand.at), Felt{});
  hand.move({25, 0, -200});
  EXPECT_EQ(hand.felt, Felt{});
  hand.moveUntil({10, 0, -200}, 20, [](const Felt& felt) { return felt.collision; });
  EXPECT_TRUE(hand.felt.collision) << "a second time it is a collision again";
}

TEST(FeelingProbe, CollidesWhenTheBallIsPushedTooFar) {
  Truth truth = perfectWorld();
  place(truth, Box({-20, -20, -40}, {20, 20, 0}), translation({0, 0, -400}));
  Hand hand(std::move(truth));
  hand.look({0, 0, -299});
  hand.moveUntil({0, 0, -310}, 10, [](const Felt& felt) { return felt.collision; });
  EXPECT_TRUE(hand.felt.touch);
  EXPECT_TRUE(hand.felt.collision);
  // Ball radius 2: touched at Z-300, and 1.6 radii deeper it is too far.
  EXPECT_NEAR(hand.at.z(), -303.2, 10 * period + 1e-6);
}

TEST(FeelingProbe, SignalsTheTouchOfACutterOnTheToolTouchProbe) {
  Truth truth = perfectWorld();
  TrueTool mill;
  mill.number = 7;
  mill.kind = ToolKind::Cutter;
  mill.length = 80;
  mill.radius = 5;
  truth.tools.push_back(mill);
  placeToolProbe(truth, RoundBar(20, -10, 0), translation({0, 0, -400}));
  Hand hand(std::move(truth), std::nullopt);
  hand.tool = 7;
  hand.look({0, 0, -315});
  const auto onTool = [](const Felt& felt) { return felt.toolTouch || felt.collision; };
  EXPECT_NEAR(hand.moveUntil({0, 0, -325}, 5, onTool).z(), -320, 5 * period + 1e-6);
  EXPECT_TRUE(hand.felt.toolTouch);
  EXPECT_FALSE(hand.felt.touch);
  EXPECT_FALSE(hand.felt.collision);
  hand.move({0, 0, -315});
  EXPECT_EQ(hand.felt, Felt{});
  // From the side: disc radius 20 and cutter radius 5.
  hand.move({30, 0, -315});
  hand.move({30, 0, -325});
  EXPECT_NEAR(hand.moveUntil({20, 0, -325}, 5, onTool).x(), 25, 5 * period + 1e-6);
  EXPECT_TRUE(hand.felt.toolTouch);
}

TEST(FeelingProbe, CallsAToolThatTheSetupLacksAnEmptySpindle) {
  Truth truth = perfectWorld();
  place(truth, Box({-20, -20, -40}, {20, 20, 0}), translation({0, 0, -400}));
  Hand hand(std::move(truth));
  hand.tool = 12;
  hand.look({0, 0, -299});
  hand.move({0, 0, -310});
  EXPECT_EQ(hand.felt, Felt{});
  ASSERT_EQ(hand.events.size(), 1U);
  EXPECT_NE(hand.events[0].find("no tool 12"), std::string::npos) << hand.events[0];
}

}  // namespace
}  // namespace probewright::simulation
