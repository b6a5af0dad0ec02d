#include <gmock/gmock.h>

#include "cycles_heidenhain/table_folder.hpp"
#include "cycles_heidenhain/worlds.hpp"

/// Probing cycles and patterns of points: they act where they are defined, once; a program that cycle 12 calls at each
/// point of a pattern measures there, its coordinates shifted to the point.
namespace probewright::testing_support {
namespace {

using ::testing::HasSubstr;

constexpr double exact = 1e-6;

const Words hole = {{273, 0}, {274, 0}, {262, 14}, {325, 0}, {247, 90}, {261, -6}, {320, 0}, {260, 20},
                    {301, 0}, {275, 0}, {276, 0},  {279, 0}, {280, 0},  {281, 0},  {309, 0}, {330, 0}};

/// A plate with holes; beside the program lies FEEL.H, which measures the hole at the datum.
struct Plate {
  explicit Plate(ControlKind kind) : bench(kind), folder(bench) {
    bench.preset(1, {0, 0, -400});
    bench.program = (bench.setup.beliefs.tables / "BENCH.H").string();
  }
  void holes(const std::vector<Vector2>& places) {
    for (const Vector2& place : places)
      bench.part(simulation::Ring(7, 10, -30), pose({place.x(), place.y(), -400}));
  }
  Bench bench;
  TableFolder folder;
};

std::string called(const std::string& blocks) {
  return "BEGIN PGM FEEL MM\n" + blocks + "Q50 = Q50 + 1\nEND PGM FEEL MM\n";
}
const std::string cycle12 = "CYCL DEF 12.0 PGM CALL\nCYCL DEF 12.1 PGM FEEL.H\n";

/// Where the holes were found, in the coordinates that were active: one touch cycle a hole.
std::vector<Vector2> found(const Ran& ran) {
  std::vector<Vector2> all;
  for (const auto& cycle : ran.outcome.journal.cycles) {
    Vector2 place = Vector2::Constant(std::nan(""));
    for (const auto& result : cycle.results) {
      if (result.name == "Q151") place.x() = result.value;
      if (result.name == "Q152") place.y() = result.value;
    }
    all.push_back(place);
  }
  return all;
}

TEST(Patterns, ShiftTheDatumForTheProgramOfCycle12) {
  const std::vector<Vector2> circle = {{40, 0}, {0, 40}, {-40, 0}, {0, -40}};
  std::vector<Vector2> lying;
  for (std::size_t i = 0; i < circle.size(); ++i)
    lying.emplace_back(circle[i] + Vector2(0.1 * static_cast<double>(i + 1), -0.2));
  Plate plate(ControlKind::iTNC530);
  plate.holes(lying);
  plate.folder.put("FEEL.H", called(probe(421, hole)));
  const Ran ran = plate.bench.run(cycle12 + "PATTERN DEF CIRC1 (X+0 Y+0 D80 START+0 NUM4 Z+0)\nCYCL CALL PAT FMAX\n" +
                                  "Q51 = Q151\nL X+5 Y+6 R0 FMAX\n");
  ASSERT_TRUE(ran.finished()) << ran.why();
  EXPECT_EQ(ran.q(50), 4);
  const auto places = found(ran);
  ASSERT_EQ(places.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_LT((circle[i] + places[i] - lying[i]).norm(), exact) << i;
  // Behind the call the datum is what it was.
  EXPECT_NEAR(ran.machine->position()[0], 5, exact);
  EXPECT_NEAR(ran.machine->position()[1], 6, exact);
}

/// The rotation cycles of the TNC 640 allow a datum shift; cycles 400 to 499 do not, unless the machine permits it.
TEST(Patterns, ObeyWhatTheControlAllows) {
  const std::vector<Vector2> lying = {{0, 0}, {30, 0.1}, {60, 0.2}};
  const Words two = {{1100, 0},  {1101, 0}, {1102, -6}, {1116, 14}, {1103, 30},  {1104, 0}, {1105, -6},
                     {1117, 14}, {1115, 0}, {423, 4},   {325, 0},   {1119, 360}, {320, 0},  {260, 20},
                     {1125, 1},  {309, 0},  {1126, 0},  {1120, 0},  {1121, 0}};
  const std::string row = "PATTERN DEF ROW1 (X+0 Y+0 D+30 NUM2 ROT+0 Z+0)\nCYCL CALL PAT FMAX\n";
  Plate plate(ControlKind::TNC640);
  plate.holes(lying);
  plate.folder.put("FEEL.H", called(probe(1411, two) + "Q60 = Q60 + Q953\n"));
  const Ran ran = plate.bench.run(cycle12 + row);
  ASSERT_TRUE(ran.finished()) << ran.why();
  EXPECT_EQ(ran.outcome.journal.cycles.size(), 2U);
  EXPECT_NEAR(ran.q(60), 30 + 30, exact);
  EXPECT_NEAR(ran.q(954), 0.2, exact);

  plate.folder.put("FEEL.H", called(probe(421, hole)));
  const Ran refused = plate.bench.run(cycle12 + "PATTERN DEF POS1 (X+30 Y+0 Z+0)\nCYCL CALL PAT FMAX\n");
  EXPECT_EQ(refused.alarm(), "Coordinate transformation not permitted") << refused.why();
}

TEST(Patterns, FollowARotationAndEachOther) {
  Plate plate(ControlKind::iTNC530);
  // The pattern lies in coordinates that are shifted and turned by 90 degrees; its program calls a pattern again.
  plate.holes({{100, 20}, {100, 60}, {80, 20}, {80, 60}});
  plate.folder.put("FEEL.H", called("CYCL DEF 12.0 PGM CALL\nCYCL DEF 12.1 PGM TOUCH.H\n"
                                    "PATTERN DEF POS1 (X+0 Y+0 Z+0) POS2 (IX+40 IY+0 Z+0)\nCYCL CALL PAT\n"));
  plate.folder.put("TOUCH.H", called(probe(421, hole)));
  const Ran ran = plate.bench.run(
      "CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+100\nCYCL DEF 7.2 Y+20\nCYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 "
      "ROT+90\n" +
      cycle12 + "PATTERN DEF POS1 (X+0 Y+0 Z+0) POS2 (X+0 Y+20 Z+0)\nCYCL CALL PAT FMAX\nL X+3 Y+0 R0 FMAX\n");
  ASSERT_TRUE(ran.finished()) << ran.why();
  const auto places = found(ran);
  ASSERT_EQ(places.size(), 4U);
  for (const Vector2& place : places)
    EXPECT_LT(place.norm(), exact);
  EXPECT_NEAR(ran.machine->position()[0], 100, exact);
  EXPECT_NEAR(ran.machine->position()[1], 23, exact);
}

TEST(Patterns, ComeFromPointTables) {
  Plate plate(ControlKind::iTNC530);
  plate.holes({{10, 20}, {50, 30}});
  plate.folder.put("HOLES.PNT",
                   "BEGIN HOLES.PNT MM\nNR   X         Y         Z         FADE\n0    +10       +20       +0        N\n"
                   "1    +90       +90       +0        Y\n2    +50       +30       +0        N\n[END]\n");
  plate.folder.put("FEEL.H", called(probe(421, hole)));
  const Ran ran = plate.bench.run(cycle12 + "SEL PATTERN \"HOLES.PNT\"\nCYCL CALL PAT FMAX\n");
  ASSERT_TRUE(ran.finished()) << ran.why();
  EXPECT_EQ(ran.outcome.journal.cycles.size(), 2U);
  const Ran missing = plate.bench.run(cycle12 + "SEL PATTERN \"OTHERS.PNT\"\nCYCL CALL PAT FMAX\n");
  EXPECT_EQ(missing.alarm(), "Table missing") << missing.why();
}

TEST(Patterns, LeaveProbingCyclesAlone) {
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    Plate plate(kind);
    plate.holes({{0, 0}});
    const std::string pattern =
        "GLOBAL DEF 125 POSITIONING ~\n  Q345=+1 ;HEIGHT\nPATTERN DEF POS1 (X+50 Y+0 Z+0) POS2 (X+90 Y+0 Z+0)\n";
    const std::string drill =
        "CYCL DEF 200 DRILLING ~\n  Q200=2 ~\n  Q201=-5 ~\n  Q206=150 ~\n  Q202=5 ~\n  Q210=0 ~\n"
        "  Q203=+0 ~\n  Q204=50 ~\n  Q211=0\n";
    const std::string circle =
        "CYCL DEF 220 POLAR PATTERN ~\n  Q216=+50 ~\n  Q217=+50 ~\n  Q244=80 ~\n  Q245=+0 ~\n"
        "  Q246=+360 ~\n  Q247=+0 ~\n  Q241=8 ~\n  Q200=2 ~\n  Q203=+0 ~\n  Q204=50 ~\n  Q301=1\n";
    const std::string grid =
        "CYCL DEF 221 CARTESIAN PATTERN ~\n  Q225=+15 ~\n  Q226=+15 ~\n  Q237=+10 ~\n  Q238=+8 ~\n"
        "  Q242=6 ~\n  Q243=4 ~\n  Q224=+15 ~\n  Q200=2 ~\n  Q203=+0 ~\n  Q204=50 ~\n  Q301=1\n";
    // A probing cycle between a machining cycle and its pattern changes nothing about either.
    for (const std::string& after : {circle, grid, pattern + "CYCL CALL PAT FMAX\n"}) {
      const Ran ran = plate.bench.run(drill + probe(421, hole) + after);
      ASSERT_TRUE(ran.finished()) << ran.why();
      ASSERT_EQ(ran.outcome.journal.cycles.size(), 1U);
      EXPECT_NEAR(ran.q(151), 0, exact);
      EXPECT_EQ(
          std::ranges::count(ran.outcome.journal.events, control::EventKind::Skipped, &control::EventRecord::kind), 1);
    }
    // Without a machining cycle there is nothing to call, and without a pattern no place for it.
    const Ran nothing = plate.bench.run(pattern + probe(421, hole) + "CYCL CALL PAT FMAX\n");
    EXPECT_EQ(nothing.alarm(), "Cycle not defined") << nothing.why();
    EXPECT_EQ(nothing.outcome.journal.cycles.size(), 1U);
    const Ran nowhere = plate.bench.run(cycle12 + "CYCL CALL PAT FMAX\n");
    EXPECT_EQ(nowhere.alarm(), "Pattern not defined") << nowhere.why();
    const Ran mistake = plate.bench.run("PATTERN DEF BOW1 (X+1)\n");
    EXPECT_EQ(mistake.outcome.info.exit, records::ExitState::InputMistake);
    EXPECT_THAT(mistake.why(), HasSubstr("'BOW' is not an element"));
  }
}

}  // namespace
}  // namespace probewright::testing_support
