#include <gmock/gmock.h>

#include "conversion/twins.hpp"

/// Rows that touch probe cycles write: a control that lacks the row adds it as a copy of the preset in effect, while a
/// settable zero offset is always there and keeps what no cycle sets.
namespace probewright::testing_support {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Cycle 412 writes X and Y of the row.
std::string hole(const std::string& row) {
  std::string block = probe(
      412, {{321, 0}, {322, 0}, {262, 40}, {325, 0}, {247, 90}, {261, -8}, {320, 1}, {260, 30}, {301, 0}, {305, 77},
            {331, 0}, {332, 0}, {303, 1},  {381, 0}, {382, 0},  {383, 0},  {384, 0}, {333, 0},  {423, 4}, {365, 1}});
  const std::string rowOfBlock = "Q305=+77.000000";
  return block.replace(block.find(rowOfBlock), rowOfBlock.size(), "Q305=" + row);
}

std::string turned(int row) { return probe(404, {{307, 12}, {305, row}}); }
std::string select(int row) { return fmt::format("CYCL DEF 247 PRESET ~\n    Q339=+{}\n", row); }

/// The messages of a conversion that name a row which may be missing.
std::vector<std::string> doubtsOf(const conversion::Conversion& there) {
  std::vector<std::string> found;
  EXPECT_THAT(there.mistakes, IsEmpty()) << format(there.mistakes.front());
  for (const Diagnostic& each : there.notCarriedOver) {
    if (!isLoss(each)) continue;
    EXPECT_EQ(each.severity, Severity::Warning);
    EXPECT_FALSE(each.advice.empty());
    found.push_back(fmt::format("{}: {}", each.place.line, each.message));
  }
  return found;
}

std::vector<std::string> doubts(const std::string& blocks) { return doubtsOf(toSinumerik(klartextProgram(blocks))); }

/// CYCLE977 corrects X and Y of a zero offset.
std::string correct(int offset, double safe = 8) {
  return sinumerikCall("CYCLE977",
                       {{"S_MVAR", 101}, {"S_KNUM", 10000 + offset}, {"S_SETV", 40}, {"S_FA", 4}, {"S_TSA", safe}}) +
         "G0 X0 Y0 Z100\n";
}

std::vector<std::string> doubtsThere(const std::string& blocks, ControlKind control = ControlKind::TNC640) {
  return doubtsOf(
      converted("G17 G90 G710\nT1 M6 D1\nG0 Z100\n" + blocks + "M30\n", ProgramLanguage::Sinumerik, control));
}

TEST(ConvertLackingRows, AreNamedWhereALaterBlockSelectsThem) {
  const auto namesRow = [](const char* row) {
    return ElementsAre(HasSubstr("PRESET.PR may lack row " + std::string(row)));
  };
  EXPECT_THAT(doubts(hole("+5") + select(5)), namesRow("5"));
  EXPECT_THAT(doubts(hole("+5") + hole("+5") + select(5)), namesRow("5"));  // once
  EXPECT_THAT(doubts(select(1) + hole("+5") + select(5)), namesRow("5"));
  EXPECT_THAT(doubts(turned(5) + select(5)), namesRow("5"));
  EXPECT_THAT(doubts("Q9 = 5\n" + hole("+Q9") + select(5)), namesRow("5"));
  // In a subprogram, and on the second round of a repeated part.
  EXPECT_THAT(doubts("CALL LBL 7\n" + select(5) + "L Z+100 R0 FMAX M2\nLBL 7\n" + hole("+5") + "LBL 0\n"),
              namesRow("5"));
  EXPECT_THAT(doubts("FN 9: IF +Q1 EQU +0 GOTO LBL 1\n" + select(5) + "LBL 1\n" + hole("+5") + select(5)),
              namesRow("5"));
}

TEST(ConvertLackingRows, AreNotNamedWhereNothingCanBeLost) {
  EXPECT_THAT(doubts(hole("+5")), IsEmpty());                          // nobody selects it
  EXPECT_THAT(doubts(hole("+5") + select(6)), IsEmpty());              // another one
  EXPECT_THAT(doubts(select(5) + hole("+5") + select(5)), IsEmpty());  // it has been selected: it is there
  EXPECT_THAT(doubts(select(5) + select(1) + hole("+5") + select(5)), IsEmpty());
  EXPECT_THAT(doubts(hole("-1") + select(5)), IsEmpty());  // the one in effect
  EXPECT_THAT(doubts(select(5) + "Q9 = 5\n" + hole("+Q9") + select(5)), IsEmpty());
  // The cycle stands behind the selection, and no way leads back.
  EXPECT_THAT(doubts("FN 9: IF +Q1 EQU +0 GOTO LBL 1\n" + select(5) + "LBL 1\n" + hole("+5")), IsEmpty());
}

/// The same of zero offsets: those that were selected before have a row, or the converted program has stopped there.
TEST(ConvertLackingRows, OfZeroOffsetsAreNamedWhereALaterBlockSelectsThem) {
  const auto namesRow = [](const char* row) {
    return ElementsAre(HasSubstr("PRESET.PR may lack row " + std::string(row)));
  };
  for (const ControlKind control : {ControlKind::TNC640, ControlKind::iTNC530}) {
    EXPECT_THAT(doubtsThere("G54\n" + correct(2) + "G55\n", control), namesRow("2"));
    EXPECT_THAT(doubtsThere("G54\n" + correct(2) + correct(2) + "G55\n", control), namesRow("2"));  // once
    EXPECT_THAT(doubtsThere(correct(1) + "G54\n", control), namesRow("1"));
    EXPECT_THAT(doubtsThere("G54\nR1=0\nIF R1==1\nG505\nENDIF\n" + correct(5) + "G505\n", control), namesRow("5"));
    EXPECT_THAT(doubtsThere("G54\nLOOPED:\nG55\n" + correct(3) + "G56\nR1=R1+1\nIF R1<2 GOTOB LOOPED\n", control),
                namesRow("3"));
  }
  EXPECT_THAT(doubtsThere("G54\n$P_UIFR[2,Z,RT]=3\nG55\n"), namesRow("2"));
  EXPECT_THAT(doubtsThere("G54\n$P_UIFR[2,Z,RT]=3 G55\n"), namesRow("2"));
  EXPECT_THAT(doubtsThere("G54\n$P_UIFR[2,X,TR]=25\nG55\n"),
              ElementsAre(::testing::AllOf(HasSubstr("PRESET.PR may lack row 2"), HasSubstr("stops here"))));
  EXPECT_THAT(doubtsThere("G54\nR1=2\n$P_UIFR[R1,Z,RT]=3\nG55\n"), namesRow("2"));
}

TEST(ConvertLackingRows, OfZeroOffsetsAreNotNamedWhereNothingCanBeLost) {
  for (const ControlKind control : {ControlKind::TNC640, ControlKind::iTNC530}) {
    EXPECT_THAT(doubtsThere("G54\n" + correct(2), control), IsEmpty());            // nobody selects it
    EXPECT_THAT(doubtsThere("G54\n" + correct(2) + "G56\n", control), IsEmpty());  // another one
    EXPECT_THAT(doubtsThere("G55\nG54\n" + correct(2) + "G55\n", control), IsEmpty());
    EXPECT_THAT(doubtsThere("G54\n" + correct(1) + "G54\n", control), IsEmpty());  // the one in effect
    // The correction comes after the selection, and no way leads back.
    EXPECT_THAT(doubtsThere("R1=0\nIF R1==0 GOTOF LAB\nG54\nLAB:\n" + correct(1), control), IsEmpty());
  }
  EXPECT_THAT(doubtsThere("G54\n$P_UIFR[2,X,TR]=25\n$P_UIFR[2,Z,RT]=3\n"), IsEmpty());
  EXPECT_THAT(doubtsThere("G55\nG54\n$P_UIFR[2,X,TR]=25\nG55\n"), IsEmpty());
}

/// What may have to be put back is read first, and a control stops where it reads a row that it lacks.
TEST(ConvertLackingRows, ThatAreReadForTheSafeAreaAreNamed) {
  const auto isRead = ElementsAre(HasSubstr("PRESET.PR may lack row 2, which is read before this cycle"));
  EXPECT_THAT(doubtsThere("G54\n" + correct(2, 1)), isRead);
  EXPECT_THAT(doubtsThere("G54\n" + correct(2, 1) + correct(2, 1)), isRead);  // once
  EXPECT_THAT(doubtsThere("G55\nG54\n" + correct(2, 1)), IsEmpty());
  EXPECT_THAT(doubtsThere("G54\n" + correct(1, 1)), IsEmpty());
  for (const bool hasRow : {true, false}) {
    PlantedPart part;
    part.bench.preset(1, {0, 0, -300});
    if (hasRow) part.bench.preset(2, {0, 0, -310}, 0, false);
    part.bench.probeOf(100, 2);
    part.bench.part(simulation::Ring(20, 60, -30), part.machineFromPart = pose({0, 0, -300}));
    const Twin original =
        runSinumerik("G17 G90 G710\nT1 M6 D1\nG54\nG0 Z100\nG0 X0 Y0\nG0 Z-10\n" + correct(2, 1) + "M30\n", part);
    EXPECT_TRUE(original.finished) << original.why;
    EXPECT_EQ(runConverted(original, part).finished, hasRow);
  }
}

/// What is named: on the row that the control adds, the height of the preset in effect stands.
TEST(ConvertLackingRows, OfZeroOffsetsTakeWhatNobodySetsFromThePresetInEffect) {
  const auto runsOn = [](bool hasRow) {
    PlantedPart part;
    part.bench.preset(1, {0, 0, -300});
    part.bench.preset(2, {0, 0, -310});
    const Twin original =
        runSinumerik("G17 G90 G710\nT1 M6 D1\nG54\nG0 Z100\n$P_UIFR[2,Z,RT]=3\nG55\nG0 X5 Y6 Z110\nM30\n", part);
    if (!hasRow) std::erase_if(part.bench.setup.beliefs.presets, [](const auto& frame) { return frame.index == 2; });
    const Twin there = runConverted(original, part);
    EXPECT_EQ(original.why, "");
    EXPECT_EQ(there.why, "");
    return bool(sameEnd(original, there));
  };
  EXPECT_TRUE(runsOn(true));
  EXPECT_FALSE(runsOn(false));
}

}  // namespace
}  // namespace probewright::testing_support
