#include <functional>

#include "cycles_heidenhain/worlds.hpp"

/// Cycles 408 to 413: the preset goes to the middle of a slot, ridge, rectangle or circle.
namespace probewright::testing_support {
namespace {

constexpr int worlds = 100;
constexpr double exact = 1e-6;

/// Random values of what all these cycles take.
struct Habits {
  Words words;
  double new1 = 0, new2 = 0, new3 = 0;
  bool toolAxis = false;
  Transfer transfer;
};

/// `onTop`: a place of the part's top face, in the part.
Habits randomHabits(Dice& dice, const PlantedPart& part, const Vector3& onTop) {
  Habits habits;
  habits.new1 = written(dice.between(-50, 50));
  habits.new2 = written(dice.between(-50, 50));
  habits.new3 = written(dice.between(-50, 50));
  habits.toolAxis = dice.coin();
  const int rows[] = {0, 1, 7};
  habits.transfer = transferInto(rows[dice.whole(0, 2)]);
  const Vector3 top = part.machineFromPreset.inverse() * (part.machineFromPart * onTop);
  habits.words = {{261, part.nominal.z() - written(dice.between(5, 12))},
                  {320, dice.coin() ? 0 : written(dice.between(0, 3))},
                  {260, part.nominal.z() + 20},
                  {301, dice.whole(0, 1)},
                  {331, habits.new1},
                  {332, habits.new2},
                  {381, habits.toolAxis ? 1 : 0},
                  {382, written(top.x())},
                  {383, written(top.y())},
                  {384, part.nominal.z()},
                  {333, habits.new3}};
  habits.words = with(habits.words, habits.transfer.words);
  return habits;
}

/// The preset after the cycle: `feature` (machine coordinates) at the wished place, the axes and the height as they
/// were or as asked.
void expectPreset(const Ran& ran, const PlantedPart& part, const Habits& habits, const Vector3& feature) {
  EXPECT_NEAR(ran.seen(feature).x(), habits.new1, exact);
  EXPECT_NEAR(ran.seen(feature).y(), habits.new2, exact);
  const double top = habits.toolAxis ? habits.new3 : part.truth().z();
  EXPECT_NEAR(ran.seen(part.machineFromPart.translation()).z(), top, exact);
  EXPECT_TRUE(ran.preset().linear().isApprox(part.machineFromPreset.linear(), 1e-12));
}

TEST(Cycle412, FindsTheCentreOfAnyHole) {
  Dice dice(412);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    PlantedPart part = plant(dice, controlOf(world), 1, 180);
    const double ball = part.bench.believedProbe().radius;
    const double diameter = dice.between(2 * ball + 6, 90);
    part.bench.part(simulation::Ring(diameter / 2, diameter / 2 + 40, -40), part.machineFromPart);
    const Habits habits = randomHabits(dice, part, {diameter / 2 + 20, 0, 0});
    Words words = with(habits.words, {{321, part.nominal.x()},
                                      {322, part.nominal.y()},
                                      {262, written(diameter + dice.between(-0.5, 0.5))},
                                      {325, written(dice.between(-360, 360))},
                                      {247, (dice.coin() ? 1 : -1) * written(dice.between(20, 120))}});
    if (part.bench.control == ControlKind::TNC640)
      words = with(words, {{423, dice.whole(3, 4)}, {365, dice.whole(0, 1)}});
    const Ran ran = part.bench.run(probe(412, words) + habits.transfer.after);
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.q(151), part.truth().x(), exact);
    EXPECT_NEAR(ran.q(152), part.truth().y(), exact);
    EXPECT_NEAR(ran.q(153), diameter, exact);
    expectPreset(ran, part, habits, part.machineFromPart.translation());
  }
}

TEST(Cycle413, FindsTheCentreOfAnyStud) {
  Dice dice(413);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    PlantedPart part = plant(dice, controlOf(world), 1, 180);
    const double diameter = dice.between(5, 90);
    part.bench.part(simulation::RoundBar(diameter / 2, -40, 0), part.machineFromPart);
    const Habits habits = randomHabits(dice, part, Vector3::Zero());
    Words words = with(habits.words, {{321, part.nominal.x()},
                                      {322, part.nominal.y()},
                                      {262, written(diameter + dice.between(-0.5, 0.5))},
                                      {325, written(dice.between(-360, 360))},
                                      {247, (dice.coin() ? 1 : -1) * written(dice.between(20, 120))}});
    if (part.bench.control == ControlKind::TNC640)
      words = with(words, {{423, dice.whole(3, 4)}, {365, dice.whole(0, 1)}});
    const Ran ran = part.bench.run(probe(413, words) + habits.transfer.after);
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.q(151), part.truth().x(), exact);
    EXPECT_NEAR(ran.q(152), part.truth().y(), exact);
    EXPECT_NEAR(ran.q(153), diameter, exact);
    expectPreset(ran, part, habits, part.machineFromPart.translation());
  }
}

TEST(Cycle411, FindsTheCentreOfAnyRectangularStud) {
  Dice dice(411);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    PlantedPart part = plant(dice, controlOf(world), 1, 2);
    const double ball = part.bench.believedProbe().radius;
    const Vector2 length(dice.between(10, 120), dice.between(10, 120));
    part.bench.part(simulation::Box({-length.x() / 2, -length.y() / 2, -40}, {length.x() / 2, length.y() / 2, 0}),
                    part.machineFromPart);
    const Habits habits = randomHabits(dice, part, Vector3::Zero());
    const Words words = with(
        habits.words,
        {{321, part.nominal.x()}, {322, part.nominal.y()}, {323, written(length.x())}, {324, written(length.y())}});
    const Ran ran = part.bench.run(probe(411, words) + habits.transfer.after);
    ASSERT_TRUE(ran.finished()) << ran.why();
    const FoundRectangle found =
        foundRectangle(part.truth().head<2>(), length, part.skew, ball, part.nominal.head<2>(), 1);
    EXPECT_NEAR(ran.q(151), found.centre.x(), exact);
    EXPECT_NEAR(ran.q(152), found.centre.y(), exact);
    EXPECT_NEAR(ran.q(154), found.length.x(), exact);
    EXPECT_NEAR(ran.q(155), found.length.y(), exact);
    expectPreset(ran, part, habits, part.machineFromPreset * Vector3(found.centre.x(), found.centre.y(), 0));
  }
}

TEST(Cycle410, FindsTheCentreOfAnyRectangularPocket) {
  Dice dice(410);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    PlantedPart part = plant(dice, controlOf(world), 1, 2);
    const double ball = part.bench.believedProbe().radius;
    const Vector2 length(dice.between(2 * ball + 6, 120), dice.between(2 * ball + 6, 120));
    layPocket(part, length);
    const Habits habits = randomHabits(dice, part, {length.x() / 2 + 20, 0, 0});
    const Words words = with(
        habits.words,
        {{321, part.nominal.x()}, {322, part.nominal.y()}, {323, written(length.x())}, {324, written(length.y())}});
    const Ran ran = part.bench.run(probe(410, words) + habits.transfer.after);
    ASSERT_TRUE(ran.finished()) << ran.why();
    const FoundRectangle found =
        foundRectangle(part.truth().head<2>(), length, part.skew, ball, part.nominal.head<2>(), -1);
    EXPECT_NEAR(ran.q(151), found.centre.x(), exact);
    EXPECT_NEAR(ran.q(152), found.centre.y(), exact);
    EXPECT_NEAR(ran.q(154), found.length.x(), exact);
    EXPECT_NEAR(ran.q(155), found.length.y(), exact);
    expectPreset(ran, part, habits, part.machineFromPreset * Vector3(found.centre.x(), found.centre.y(), 0));
  }
}

/// Cycles 408 and 409: `number`, the walls across axis 0 or 1.
void expectMiddle(int number, bool slot) {
  Dice dice(static_cast<unsigned>(number));
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    PlantedPart part = plant(dice, controlOf(world), 1, 2);
    const double ball = part.bench.believedProbe().radius;
    const int axis = dice.whole(0, 1);
    const double width = dice.between(2 * ball + 6, 100);
    Vector2 length(200, 200);
    length[axis] = width;
    if (slot) {
      layPocket(part, length);
    } else {
      part.bench.part(simulation::Box({-length.x() / 2, -length.y() / 2, -40}, {length.x() / 2, length.y() / 2, 0}),
                      part.machineFromPart);
    }
    Vector3 onTop = Vector3::Zero();
    if (slot) onTop[axis] = width / 2 + 20;
    const Habits habits = randomHabits(dice, part, onTop);
    Words words = with(
        habits.words,
        {{321, part.nominal.x()}, {322, part.nominal.y()}, {311, written(width)}, {272, axis + 1}, {405, habits.new1}});
    std::erase_if(words, [&](const auto& word) {
      return word.first == 331 || word.first == 332 || (!slot && word.first == 301);
    });
    const Ran ran = part.bench.run(probe(number, words) + habits.transfer.after);
    ASSERT_TRUE(ran.finished()) << ran.why();
    const FoundRectangle found =
        foundRectangle(part.truth().head<2>(), length, part.skew, ball, part.nominal.head<2>(), slot ? -1 : 1);
    EXPECT_NEAR(ran.q(157), found.centre[axis], exact);
    EXPECT_NEAR(ran.q(166), found.length[axis], exact);
    Vector3 feature = part.truth();
    feature[axis] = found.centre[axis];
    Habits expected = habits;
    // The axis along the walls keeps its zero.
    (axis == 0 ? expected.new2 : expected.new1) = feature[1 - axis];
    (axis == 0 ? expected.new1 : expected.new2) = habits.new1;
    expectPreset(ran, part, expected, part.machineFromPreset * feature);
  }
}

TEST(Cycle408, FindsTheMiddleOfAnySlot) { expectMiddle(408, true); }
TEST(Cycle409, FindsTheMiddleOfAnyRidge) { expectMiddle(409, false); }

}  // namespace
}  // namespace probewright::testing_support
