#include <gtest/gtest.h>

#include "conversion/flow.hpp"
#include "session/check.hpp"

/// Random programs with flow of every kind: whatever a conversion does not name runs through the same touches.
namespace probewright::testing_support {
namespace {

// ---- HEIDENHAIN ----

TEST(ConvertFlow, RunsHeidenhainProgramsThroughTheSameTouches) {
  const int programs = setting("PROBEWRIGHT_PROGRAMS", 60);
  Dice dice(static_cast<unsigned>(setting("PROBEWRIGHT_SEED", 4001)));
  // A conversion that names something promises nothing: others take its place.
  int compared = 0;
  for (int i = 0; compared < programs && i < 5 * programs; ++i) {
    SCOPED_TRACE(fmt::format("program {}", i));
    const World world(dice);
    const Twin original = runKlartext(KlartextFlow(dice, world).program(), world.part);
    const Twin there = runConverted(original, world.part);
    if (!there.lost.empty()) continue;
    ++compared;
    ASSERT_TRUE(runsTheSame(original, there));
    const Twin back = runConverted(there, world.part);
    if (back.lost.empty()) {
      ASSERT_TRUE(runsTheSame(original, back));
    }
  }
  EXPECT_EQ(compared, programs) << "too many programs are named, too few compared";
}

// ---- SINUMERIK ----

TEST(ConvertFlow, RunsSinumerikProgramsThroughTheSameTouches) {
  const int programs = setting("PROBEWRIGHT_PROGRAMS", 60);
  Dice dice(static_cast<unsigned>(setting("PROBEWRIGHT_SEED", 4002)));
  int compared = 0;
  for (int i = 0; compared < programs && i < 10 * programs; ++i) {
    SCOPED_TRACE(fmt::format("program {}", i));
    const World world(dice);
    const Twin original = runSinumerik(SinumerikFlow(dice, world).program(), world.part);
    const Twin there = runConverted(original, world.part);
    if (!there.lost.empty()) continue;
    ++compared;
    ASSERT_TRUE(runsTheSame(original, there));
  }
  EXPECT_EQ(compared, programs) << "too many programs are named, too few compared";
}

// ---- origins that a cycle moves before it touches once more ----

/// Cycle 412 or 413 with Q381 = 1: the point in the touch probe axis counts from the origin before the cycle.
std::string presetWithToolAxis(const World& world, int cycle, int row, double wish) {
  const Vector3& n = world.nominal();
  const bool hole = cycle == 412;
  return probe(cycle, {{321, n.x() + (hole ? 0.2 : 60)},
                       {322, n.y() + (hole ? 45 : 60.3)},
                       {262, hole ? world.hole : world.pin},
                       {325, 0},
                       {247, 90},
                       {261, n.z() - 6},
                       {320, 3},
                       {260, n.z() + 30},
                       {301, 1},
                       {305, row},
                       {331, wish},
                       {332, wish + 7},
                       {303, 1},
                       {381, 1},
                       {382, n.x() - 20},
                       {383, n.y() - 30},
                       {384, n.z()},
                       {333, n.z()},
                       {423, 4},
                       {365, 1}});
}

TEST(ConvertFlow, TouchesForTheToolAxisWhereTheOriginBeforeTheCycleSays) {
  Dice dice(4010);
  for (const int cycle : {412, 413}) {
    for (const std::string select :
         {"", "CYCL DEF 247 PRESET ~\n    Q339=+1\n", "CYCL DEF 247 PRESET ~\n    Q339=+2\n"}) {
      for (const int row : {0, 1, 2}) {
        SCOPED_TRACE(fmt::format("{} {} {}", cycle, row, select));
        World world(dice);
        control::BelievedFrame copy = world.part.bench.setup.beliefs.presets.front();
        copy.index = 2;
        copy.active = false;
        world.part.bench.setup.beliefs.presets.push_back(copy);
        world.part.bench.believedProbe().maximumTravel = 10;
        const Twin original = runKlartext(
            klartextProgram(select + presetWithToolAxis(world, cycle, row, dice.between(-3, 3)) + "L Z+60 R0 FMAX\n"),
            world.part);
        const Twin there = runConverted(original, world.part);
        ASSERT_TRUE(ranWhole(original));
        ASSERT_TRUE(ranWhole(there));
        ASSERT_EQ(original.journal.cycles.size(), 1U);
        ASSERT_EQ(there.journal.cycles.size(), 2U) << there.text;
        const control::TouchRecord& last = original.journal.cycles[0].touches.back();
        const control::TouchRecord& same = there.journal.cycles[1].touches.back();
        for (std::size_t i = 0; i < 3; ++i)
          EXPECT_NEAR(last.latched[i], same.latched[i], 2e-4) << there.text;  // the hole leans
      }
    }
  }
}

/// Cycles 408 and 409 leave where the middle lies in Q157; the touch for the tool axis leaves nothing.
TEST(ConvertFlow, KeepsTheMiddleOfARibOrGrooveThroughTheTouchForTheToolAxis) {
  for (const int cycle : {408, 409}) {
    SCOPED_TRACE(cycle);
    const bool groove = cycle == 408;
    PlantedPart part{Bench(ControlKind::TNC640, "mill3")};
    part.bench.preset(1, {20, -10, -400}, 0);
    part.bench.probeOf(100, 2);
    part.bench.believedProbe().maximumTravel = 20;
    const auto lay = [&](double from, double to) {
      part.bench.part(simulation::Box({from, -60, -40}, {to, 60, 0}), pose({20.25, -10, -400.5}, {0, 0, 0}));
    };
    if (groove) {
      lay(-60, -15);
      lay(15, 60);
    } else {
      lay(-15, 15);
    }
    Words words = {{321, 0},  {322, 0}, {311, 30}, {272, 1}, {261, -8}, {320, 8},
                   {260, 30}, {305, 1}, {405, 0},  {303, 1}, {381, 1},  {382, groove ? 30 : 0},
                   {383, 20}, {384, 0}, {333, 0}};
    if (groove) words.push_back({301, 1});
    const Twin original = runKlartext(klartextProgram("CYCL DEF 247 PRESET ~\n    Q339=+1\n" + probe(cycle, words) +
                                                      "Q5 = Q157 * 100\nL Z+100 R0 FMAX\nL X+Q5 Y+0 FMAX\n"),
                                      part);
    const Twin there = runConverted(original, part);
    ASSERT_TRUE(ranWhole(original));
    ASSERT_TRUE(ranWhole(there));
    // The part lies 0.25 mm beside the old origin, which is where the new one is.
    EXPECT_NEAR(original.axes[0], 20.25 + 100 * 0.25, 1e-6);
    EXPECT_NEAR(there.axes[0], 20.25 + 100 * 0.25, 1e-6) << there.text;
  }
}

// ---- zero offsets in effect that only the running program knows ----

TEST(ConvertFlow, ActsAtOnceWhateverOffsetIsInEffect) {
  const PlantedPart part = [] {
    PlantedPart plain;
    plain.bench.preset(1, {10, 20, -300});
    plain.bench.preset(6, {30, -20, -300});
    return plain;
  }();
  // Two ways lead to the cycle, with row 1 and with row 6 in effect.
  for (const int way : {0, 1}) {
    const Twin original = runKlartext(
        klartextProgram(fmt::format("Q1 = {}\nCYCL DEF 247 PRESET ~\n    Q339=+1\nFN 9: IF +Q1 EQU +0 GOTO LBL 1\n"
                                    "CYCL DEF 247 PRESET ~\n    Q339=+6\nLBL 1\n"
                                    "TCH PROBE 404 BASIC ROTATION ~\n    Q307=+12 ~\n    Q305=-1\n"
                                    "L X+50 Y+0 R0 FMAX\n",
                                    way)),
        part);
    const Twin there = runConverted(original, part);
    ASSERT_TRUE(ranWhole(original));
    ASSERT_TRUE(ranWhole(there));
    EXPECT_TRUE(sameEnd(original, there));
    const Twin back = runConverted(there, part);
    EXPECT_TRUE(back.lost.empty()) << back.text;
    EXPECT_TRUE(sameEnd(original, back));
  }
}

/// Touch probe cycle 404 permits no shift and no rotation by the program.
TEST(ConvertFlow, TurnsOffsetsUnderAFrameOfTheProgram) {
  PlantedPart part;
  part.bench.preset(1, {10, 20, -300});
  part.bench.preset(2, {30, -20, -300});
  for (const char* frame : {"TRANS X5 Y-2\n", "R1=4\nTRANS X=R1\n", "TRANS X5\nAROT Z20\n"}) {
    for (const char* turn : {"$P_UIFR[1,Z,RT]=3\nG54\n", "$P_UIFR[2,Z,RT]=3\n", "$P_UIFR[2,Z,RT]=3\nG55\n"}) {
      const std::string program =
          fmt::format("G17 G90 G710\nT1 M6 D1\nG55\nG54\nG0 Z100\n{}{}G0 X50 Y0\nM30\n", frame, turn);
      const Twin original = runSinumerik(program, part);
      const Twin there = runConverted(original, part);
      ASSERT_TRUE(ranWhole(original));
      ASSERT_TRUE(ranWhole(there));
      EXPECT_TRUE(sameEnd(original, there));
      EXPECT_TRUE(sameOrigin(original, there));
    }
  }
}

/// What is written to the zero offset in effect acts on a SINUMERIK when it is selected the next time.
TEST(ConvertFlow, NamesOffsetsThatActLater) {
  PlantedPart part;
  part.bench.preset(1, {10, 20, -300});
  part.bench.preset(2, {30, -20, -300});
  const auto twinOf = [&](const std::string& blocks) {
    return runConverted(runSinumerik("G17 G90 G710\nT1 M6 D1\nG54\nG0 Z100\n" + blocks + "M30\n", part), part);
  };
  for (const char* write : {"$P_UIFR[1,X,TR]=25\n", "$P_UIFR[1,Z,RT]=3\n", "$P_UIFR[$P_UIFRNUM,Y,TR]=7\n"}) {
    const std::string assignment = write;
    for (const char* later :
         {"G0 X50 Y0\n", "R1=1\nCYCLE978(0,,,1,0,5,8,3,2,1)\nG54\n", "GOTOF LAB\nG54\nLAB:\nG0 X50\n"}) {
      const Twin there = twinOf(assignment + later);
      ASSERT_FALSE(there.lost.empty()) << there.text;
      EXPECT_NE(there.lost[0].message.find("acts when it is selected"), std::string::npos) << there.lost[0].message;
    }
    for (const char* before : {"G54\n", "STOPRE\nMSG(\"set\")\nG54 G0 X3\n", "G[8]=$P_UIFRNUM+1\n", "G54\nG55\n"}) {
      const std::string program = "G17 G90 G710\nT1 M6 D1\nG54\nG0 Z100\n" + assignment + before + "G0 X50 Y0\nM30\n";
      const Twin original = runSinumerik(program, part);
      const Twin there = runConverted(original, part);
      EXPECT_TRUE(there.lost.empty()) << there.text;
      EXPECT_TRUE(sameEnd(original, there));
    }
  }
  // Another row than the one in effect changes nothing here.
  EXPECT_TRUE(twinOf("$P_UIFR[2,X,TR]=25\nG0 X50 Y0\n").lost.empty());
}

/// A structure may be the last of a program: what comes behind it is its end.
TEST(ConvertFlow, EndsWithAStructure) {
  for (const char* blocks :
       {"IF R1==1\nG0 X5\nENDIF\n", "IF R1==1\nG0 X5\nELSE\nG0 X6\nENDIF\n", "WHILE R1>1\nR1=R1-1\nENDWHILE\n",
        "FOR R1=1 TO 3\nG0 X=R1\nENDFOR\n", "REPEAT\nR1=R1+1\nUNTIL R1>3\n", "LOOP\nGOTOF LA1\nENDLOOP\nLA1:\n"}) {
    const conversion::Conversion there = toKlartext(fmt::format("G17 G90 G71\n{}", blocks));
    EXPECT_TRUE(there.notCarriedOver.empty()) << there.text;
    EXPECT_NE(there.text.find("LBL"), std::string::npos) << there.text;
    EXPECT_NE(there.text.find("END PGM"), std::string::npos) << there.text;
  }
}

/// With Q305 = 0 the rotation goes into row 0, which is in effect then; other rows keep what they have.
TEST(ConvertFlow, SetsTheRotationOfRowZero) {
  PlantedPart part;
  part.bench.preset(1, {10, 20, -300});
  part.bench.preset(2, {30, -20, -300});
  for (const int row : {0, 1, 2})
    for (const char* after : {"", "CYCL DEF 247 PRESET ~\n    Q339=+1\n", "CYCL DEF 247 PRESET ~\n    Q339=+2\n"}) {
      const Twin original =
          runKlartext(klartextProgram(fmt::format("CYCL DEF 247 PRESET ~\n    Q339=+1\nTCH PROBE 404 BASIC ROTATION ~\n"
                                                  "    Q307=+12 ~\n    Q305={}\n{}L X+50 Y+0 R0 FMAX\n",
                                                  row, after)),
                      part);
      const Twin there = runConverted(original, part);
      ASSERT_TRUE(ranWhole(original));
      ASSERT_TRUE(there.finished) << there.why;
      EXPECT_TRUE(sameEnd(original, there)) << row << after << there.text;
    }
}

/// A row that only the running program knows is that row, not the one in effect.
TEST(ConvertFlow, SetsTheRotationOfARowThatAParameterNames) {
  PlantedPart part;
  part.bench.preset(1, {10, 20, -300});
  part.bench.preset(2, {30, -20, -300});
  const Twin original =
      runKlartext(klartextProgram("CYCL DEF 247 PRESET ~\n    Q339=+1\nQ5 = 2\n"
                                  "TCH PROBE 404 BASIC ROTATION ~\n    Q307=+12 ~\n    Q305=+Q5\nL X+50 Y+0 R0 FMAX\n"),
                  part);
  const Twin there = runConverted(original, part);
  ASSERT_TRUE(ranWhole(original));
  ASSERT_TRUE(ranWhole(there));
  EXPECT_TRUE(sameEnd(original, there));
}

TEST(ConvertFlow, NamesFramesThatTheCycleDoesNotRunUnder) {
  const auto named = [](const std::string& frame, int cycle) {
    const std::string call =
        cycle == 417 ? probe(417, {{263, 0}, {264, 0}, {294, 0}, {320, 3}, {260, 30}, {305, 1}, {333, 0}, {303, 1}})
                     : probe(427, {{263, 0},
                                   {264, 0},
                                   {261, 0},
                                   {320, 3},
                                   {272, 3},
                                   {267, -1},
                                   {260, 30},
                                   {281, 0},
                                   {288, 0},
                                   {289, 0},
                                   {309, 0},
                                   {330, 0}});
    return converted(klartextProgram("CYCL DEF 247 PRESET ~\n    Q339=+1\n" + frame + call), ProgramLanguage::Klartext)
        .notCarriedOver;
  };
  const std::string shift = "CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+5\n",
                    turn = "CYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 ROT+5\n";
  for (const int cycle : {417, 427}) {
    EXPECT_TRUE(named("", cycle).empty());
    ASSERT_EQ(named(shift, cycle).size(), 1U);
    EXPECT_NE(named(shift, cycle)[0].message.find("datum shift"), std::string::npos);
    EXPECT_EQ(named(turn, cycle).size(), cycle == 427 ? 1U : 0U);
  }
}

// ---- damaged programs ----

/// The program with a few lines or signs lost, doubled or exchanged.
std::string damaged(std::string text, Dice& dice) {
  const auto place = [&] { return static_cast<std::size_t>(dice.whole(0, static_cast<int>(text.size()) - 1)); };
  for (int i = 0; i < dice.whole(1, 4); ++i) {
    const std::size_t at = place(), begin = text.rfind('\n', at) + 1;
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
    const std::string line = begin < end ? text.substr(begin, end - begin) : "";
    const int kind = dice.whole(0, 4);
    if (kind == 0) text.erase(begin, line.size());
    if (kind == 1) text.insert(text.find('\n', place()) + 1, line);
    if (kind == 2) text.erase(at, 1);
    if (kind == 3) text[at] = "0129+-=,;~/*()[]LQRXN "[dice.whole(0, 21)];
    if (kind == 4) text.insert(at, std::string(1, "0129-Q,"[dice.whole(0, 6)]));
  }
  return text;
}

/// What `check` accepts is converted; what is written that its control would refuse is named.
TEST(ConvertFlow, SurvivesDamagedPrograms) {
  const int programs = 20 * setting("PROBEWRIGHT_PROGRAMS", 20);
  Dice dice(static_cast<unsigned>(setting("PROBEWRIGHT_SEED", 4003)));
  int accepted = 0;
  for (int i = 0; i < programs; ++i) {
    const World world(dice);
    const bool heidenhain = dice.coin();
    const std::string text =
        damaged(heidenhain ? KlartextFlow(dice, world).program() : SinumerikFlow(dice, world).program(), dice);
    const ProgramLanguage from = heidenhain ? ProgramLanguage::Klartext : ProgramLanguage::Sinumerik;
    const auto program = session::programOf(heidenhain ? "BENCH.H" : "BENCH.MPF", text, from);
    const ControlKind control = heidenhain ? ControlKind::TNC640 : ControlKind::Sinumerik840Dsl;
    if (hasErrors(session::checkProgram(*program, control))) continue;
    ++accepted;
    const conversion::Conversion there =
        converted(text, from, dice.coin() ? ControlKind::TNC640 : ControlKind::iTNC530);
    EXPECT_TRUE(there.mistakes.empty() || !hasErrors(there.mistakes)) << text;
    for (const Diagnostic& each : there.notCarriedOver)
      EXPECT_FALSE(each.message.empty()) << text;
    if (::testing::Test::HasFailure()) return;
  }
  EXPECT_GT(accepted, programs / 20);
}

}  // namespace
}  // namespace probewright::testing_support
