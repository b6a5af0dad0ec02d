#include <map>

#include "cycles_heidenhain/rotation_worlds.hpp"

/// Rotation cycles that ask the operator for what their program does not know.
namespace probewright::testing_support {
namespace {

TEST(Cycle1410, AsksTheOperatorForPlacesThatAreNotKnown) {
  Dice dice(14101);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    Place place = placeAt(dice, 5, 12);
    const Edge edge = layEdge(dice, place);
    // The operator sees where the part truly lies and stands some mm in front of its edge.
    std::map<std::string, std::string> answers;
    std::array<Vector3, 2> stands;
    std::array<Vector3, 2> found;
    const Vector3 normal = place.inputFromPart().linear() * (-edge.sign * Vector3::Unit(edge.axis));
    for (int i = 0; i < 2; ++i) {
      const Vector3 middle = place.inputFromPart().translation();
      const Vector3 face = edge.expected[static_cast<std::size_t>(i)];
      Vector3 along = place.inputFromPart().linear() * Vector3::Unit(1 - edge.axis);
      stands[static_cast<std::size_t>(i)] = face + normal * (place.ball + 8) + along * dice.between(-3, 3);
      stands[static_cast<std::size_t>(i)].z() = middle.z() - 9;
      const Vector3 tip = stands[static_cast<std::size_t>(i)] - Vector3(0, 0, place.ball);
      const auto text = [](const Vector3& p) { return fmt::format("{:.9f} {:.9f} {:.9f}", p.x(), p.y(), p.z()); };
      const Vector3 high(tip.x(), tip.y(), tip.z() + 40);
      answers[fmt::format("1410 point {}", i + 1)] = text(high) + "; " + text(tip);
      answers[fmt::format("1410 point {} away", i + 1)] = text(high);
      found[static_cast<std::size_t>(i)] = touchOnPlane(
          stands[static_cast<std::size_t>(i)], edge.axis, edge.sign,
          face - edge.sign * place.ball * Vector3::Unit(edge.axis) - normal * place.ball, normal, place.ball);
    }
    place.bench.answer = [&](const std::string& question) -> std::optional<std::string> {
      const auto reply = answers.find(question);
      return reply == answers.end() ? std::nullopt : std::optional(reply->second);
    };
    const int position = dice.whole(1, 3);
    const Words words = with(with({{372, edge.sign * (edge.axis + 1)}}, common(dice, place)),
                             {{1120, position}, {1121, 1}, {1125, dice.whole(1, 2)}});
    std::string texts;
    for (int i = 0; i < 2; ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        const std::string value =
            axis == edge.axis ? fmt::format("?{:.3f}", edge.nominal[static_cast<std::size_t>(i)][axis]) : "?";
        texts += fmt::format(" ~\n  QS{}= \"{}\" ;NOMINAL", 1100 + 3 * i + axis, value);
      }
    }
    const Ran ran = place.bench.run(place.before + probe(1410, words, texts));
    ASSERT_TRUE(ran.finished()) << ran.why();
    std::array<Vector3, 2> wanted = found;
    for (int i = 0; i < 2; ++i) {
      const auto at = static_cast<std::size_t>(i);
      wanted[at][edge.axis] = edge.nominal[at][edge.axis];
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(ran.q(950 + 3 * i + axis), found[at][axis], exact);
        EXPECT_NEAR(ran.q(980 + 3 * i + axis), found[at][axis] - wanted[at][axis], exact);
      }
    }
    EXPECT_NEAR(ran.q(994), place.skew, exact);
    expectTransfer(ran, place, aboutZ(place.skew), chosen(position, found), chosen(position, wanted));
    const auto stops =
        std::ranges::count(ran.outcome.journal.events, control::EventKind::Stop, &control::EventRecord::kind);
    EXPECT_EQ(stops, 4);
  }
}

std::string spoken(const Vector3& tip) { return fmt::format("{:.9f} {:.9f} {:.9f}", tip.x(), tip.y(), tip.z()); }

/// An operator who knows the answers, and nothing else.
std::function<std::optional<std::string>(const std::string&)> operatorWith(std::map<std::string, std::string> answers) {
  return [answers = std::move(answers)](const std::string& question) -> std::optional<std::string> {
    const auto reply = answers.find(question);
    return reply == answers.end() ? std::nullopt : std::optional(reply->second);
  };
}

/// The words without `first` to `last`, which stand as texts "?value" instead.
std::string asTexts(Words& words, const std::vector<int>& parameters) {
  std::string texts;
  for (const int parameter : parameters) {
    const auto found = std::ranges::find(words, parameter, &std::pair<int, double>::first);
    texts += fmt::format(" ~\n  QS{}= \"?{:.6f}\" ;NOMINAL", parameter, found->second);
    words.erase(found);
  }
  return texts;
}

TEST(Cycle1411, AsksTheOperatorForTheObjects) {
  Dice dice(14113);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    Place place = placeAt(dice, 5, 15);
    const Circles circles = layCircles(dice, place);
    std::map<std::string, std::string> answers;
    for (std::size_t i = 0; i < 2; ++i) {
      const bool stud = circles.geometry == 1 || (circles.geometry == 2 && i == 1) || (circles.geometry == 3 && i == 0);
      const double top = place.inputFromPart().translation().z();
      Vector3 tip = circles.centre[i] + Vector3(dice.between(-0.3, 0.3), dice.between(-0.3, 0.3), 0);
      const Vector3 high(tip.x(), tip.y(), top + 30);
      tip.z() = stud ? top + 4 : top - 9;
      answers[fmt::format("1411 object {}", i + 1)] = spoken(high) + "; " + spoken(tip);
      answers[fmt::format("1411 object {} away", i + 1)] = spoken(high);
    }
    place.bench.answer = operatorWith(answers);
    Words words = with(with(circles.words(dice), common(dice, place)),
                       {{1120, dice.whole(1, 2)}, {1121, 1}, {1125, dice.whole(1, 2)}, {320, 1}});
    const double position = std::ranges::find(words, 1120, &std::pair<int, double>::first)->second;
    std::erase_if(words, [](const auto& word) { return word.first == 1102 || word.first == 1105; });
    const std::string texts = asTexts(words, {1100, 1101, 1103, 1104}) + " ~\n  QS1102= \"?\" ;Z ~\n  QS1105= \"?\" ;Z";
    const Ran ran = place.bench.run(place.before + probe(1411, words, texts));
    ASSERT_TRUE(ran.finished()) << ran.why();
    const double turned = std::remainder(angleBetween(circles.centre) - angleBetween(circles.nominal), 360);
    EXPECT_NEAR(ran.q(994), turned, exact);
    for (int i = 0; i < 2; ++i) {
      const auto at = static_cast<std::size_t>(i);
      for (int axis = 0; axis < 2; ++axis)
        EXPECT_NEAR(ran.q(950 + 3 * i + axis), circles.centre[at][axis], exact);
      EXPECT_NEAR(ran.q(982 + 3 * i), 0, exact);
      EXPECT_NEAR(ran.q(966 + i), circles.diameter[at], exact);
    }
    // The chosen centre reads its nominal place, the other lies on the line to it.
    const auto which = static_cast<std::size_t>(position - 1);
    Vector3 wanted = circles.nominal[which];
    Vector3 actual = circles.centre[which];
    wanted.z() = actual.z() = ran.q(952 + 3 * static_cast<int>(which));
    expectTransfer(ran, place, aboutZ(turned), actual, wanted);
  }
}

TEST(Cycle1420, AsksTheOperatorForTheThreePoints) {
  Dice dice(14202);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    Place place = placeAt(dice, 5, 0);
    const Tilted plane = layPlane(dice, place, 5);
    const Vector3 through = place.inputFromPart().translation();
    std::map<std::string, std::string> answers;
    std::array<Vector3, 3> found;
    for (std::size_t i = 0; i < 3; ++i) {
      Vector3 stands = plane.expected[i] + Vector3(dice.between(-4, 4), dice.between(-4, 4), place.ball + 12);
      answers[fmt::format("1420 point {}", i + 1)] = spoken(stands - Vector3(0, 0, place.ball));
      found[i] = touchOnPlane(stands, 2, -1, through, plane.normal, place.ball);
    }
    place.bench.answer = operatorWith(answers);
    Words words = with(with(plane.words(), common(dice, place)), {{1120, 1}, {1121, 1}, {1125, dice.whole(-1, 0)}});
    const std::string texts = asTexts(words, {1100, 1101, 1102, 1103, 1104, 1105, 1106, 1107, 1108});
    const Ran ran = place.bench.run(place.before + probe(1420, words, texts));
    ASSERT_TRUE(ran.finished()) << ran.why();
    for (int i = 0; i < 3; ++i) {
      const auto at = static_cast<std::size_t>(i);
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(ran.q(950 + 3 * i + axis), found[at][axis], exact);
      EXPECT_NEAR(ran.q(980 + 3 * i), 0, exact);
      EXPECT_NEAR(ran.q(981 + 3 * i), 0, exact);
      EXPECT_NEAR(ran.q(982 + 3 * i), found[at].z() - plane.nominal[at].z(), exact);
    }
    EXPECT_LT((ran.preset().linear().col(2) - place.machineFromInput.linear() * plane.normal).norm(), 1e-9);
    Vector3 wanted = found[0];
    wanted.z() = plane.nominal[0].z();
    expectTransfer(ran, place, turnTo(plane.normal), found[0], wanted);
  }
}

/// Q372 asks for Y+, but the edge that the operator finds runs along Y: he probes along X, from either side.
TEST(Cycle1410, ProbesWhereTheOperatorPointsTo) {
  for (const bool fromRight : {false, true}) {
    SCOPED_TRACE(fromRight);
    const double turn = 1.5, sense = fromRight ? 1 : -1;
    Bench bench;
    bench.preset(1, {0, 0, -400});
    bench.part(simulation::Box({-50, -50, -40}, {50, 50, 0}), pose({0, 0, -400}, {0, 0, turn}));
    bench.answer = [&](const std::string& question) -> std::optional<std::string> {
      const double y = question == "1410 point 1" ? -20 : 25;
      return fmt::format("{0} {1} 50; {0} {1} -10 {2}", sense * 58, y, fromRight ? "X-" : "X+");
    };
    std::string texts;
    for (const int number : {1100, 1103})
      texts += fmt::format(" ~\n  QS{}=\"?{}+-0.4\" ;X ~\n  QS{}=\"?\" ;Y ~\n  QS{}=\"?\" ;Z", number, sense * 50,
                           number + 1, number + 2);
    texts.replace(texts.find("QS1101=\"?\""), 11, "QS1101=\"?-20\"");
    texts.replace(texts.find("QS1104=\"?\""), 11, "QS1104=\"?25\"");
    const Words words = {{372, 2}, {320, 0}, {260, 40}, {1125, 0}, {309, 0}, {1126, 0}, {1120, 1}, {1121, 1}};
    const Ran ran = bench.run(probe(1410, words, texts));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NE(ran.screens().front().find("probing direction Y+"), std::string::npos) << ran.screens().front();
    std::array<Vector3, 2> met;
    const Vector3 normal = aboutZ(turn) * Vector3(sense, 0, 0);
    for (int i = 0; i < 2; ++i) {
      const auto at = static_cast<std::size_t>(i);
      met[at] = touchOnPlane({sense * 58, i == 0 ? -20.0 : 25.0, -8}, 0, -sense, normal * 50, normal, 2);
      EXPECT_NEAR(ran.q(950 + 3 * i), met[at].x(), exact);
      EXPECT_NEAR(ran.q(951 + 3 * i), met[at].y(), exact);
      // The deviation counts along X now.
      EXPECT_NEAR(ran.q(980 + 3 * i), met[at].x() - sense * 50, exact);
      EXPECT_NEAR(ran.q(981 + 3 * i), 0, exact);
    }
    EXPECT_NEAR(ran.q(964), angleBetween(met), exact);
    EXPECT_NEAR(ran.q(994), turn, exact);
    // Material stands out at one point, which is rework, and lacks at the other.
    EXPECT_EQ(ran.q(183), 2);
  }
}

/// NC start without a move: the program has brought the probe to the place.
TEST(RotationCycles, TouchFromWhereTheProbeStands) {
  Bench bench;
  bench.preset(1, {0, 0, -400});
  bench.part(simulation::Ring(10, 18, -40), pose({0.3, -0.2, -400}));
  bench.part(simulation::Ring(10, 18, -40), pose({60.1, 0.4, -400}));
  bench.answer = [](const std::string& question) -> std::optional<std::string> {
    return question == "1411 object 1" ? "" : "0 0 30; 60 0 30; 60 0 -10";
  };
  const Ran ran = bench.run("L X+0 Y+0 R0 FMAX\nL Z-10 R0 FMAX\n" +
                            probe(1411,
                                  {{1116, 20},
                                   {1117, 20},
                                   {1115, 0},
                                   {423, 4},
                                   {325, 0},
                                   {1119, 360},
                                   {320, 0},
                                   {260, 20},
                                   {1125, 0},
                                   {309, 0},
                                   {1126, 0},
                                   {1120, 0},
                                   {1121, 0}},
                                  " ~\n QS1100=\"?0\" ~\n QS1101=\"?0\" ~\n QS1102=\"?\" ~\n QS1103=\"?60\""
                                  " ~\n QS1104=\"?0\" ~\n QS1105=\"?\""));
  ASSERT_TRUE(ran.finished()) << ran.why();
  EXPECT_NEAR(ran.q(950), 0.3, exact);
  EXPECT_NEAR(ran.q(951), -0.2, exact);
  EXPECT_NEAR(ran.q(952), -8, exact);
  EXPECT_NEAR(ran.q(953), 60.1, exact);
}

TEST(RotationCycles, AskAgainInLaterCalls) {
  Bench bench;
  bench.preset(1, {0, 0, -400}, 0);
  bench.part(simulation::HalfSpace({Vector3(0, 0, -400), Vector3::UnitZ()}));
  std::vector<std::string> asked;
  bench.answer = [&](const std::string& question) -> std::optional<std::string> {
    asked.push_back(question);
    return std::to_string(10 * asked.size()) + (asked.size() % 3 == 0 ? ",30,8" : ",0,8");
  };
  const std::string block =
      probe(1420, {{372, -3}, {320, 0}, {260, 20}, {1125, 0}, {309, 0}, {1126, 0}, {1120, 0}, {1121, 0}},
            " ~\n QS1100=\"?10\" ~\n QS1101=\"?0\" ~\n QS1102=\"?0\" ~\n QS1103=\"?20\" ~\n QS1104=\"?0\""
            " ~\n QS1105=\"?0\" ~\n QS1106=\"?30\" ~\n QS1107=\"?30\" ~\n QS1108=\"?0\"");
  const Ran ran = bench.run(block + block);
  ASSERT_TRUE(ran.finished()) << ran.why();
  const std::vector<std::string> expected = {"1420 point 1",        "1420 point 2",        "1420 point 3",
                                             "1420 call 2 point 1", "1420 call 2 point 2", "1420 call 2 point 3"};
  EXPECT_EQ(asked, expected);
}

}  // namespace
}  // namespace probewright::testing_support
