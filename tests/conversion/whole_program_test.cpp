#include "conversion/twins.hpp"

/// Whole programs as they stand on machines: subprograms, loops, decisions by what was measured, shifted origins,
/// tilted planes, corrected tools. There and back they measure, correct and drive the same.
namespace probewright::testing_support {
namespace {

constexpr int worlds = 200;

/// Three holes in a row and a block with a skewed edge, on a five-axis machine.
struct Plate {
  PlantedPart part;
  double pitch = 34, diameter, edge;

  explicit Plate(Dice& dice)
      : part(plant(dice, ControlKind::TNC640, 0.6, 1, "mill5-table-table")), diameter(written(dice.between(16, 22))) {
    for (int i = 0; i < 3; ++i) {
      const double actual = diameter + dice.between(-0.4, 0.4);
      part.bench.part(simulation::Ring(actual / 2, 16.5, -40), part.machineFromPart * pose({i * pitch, 0, 0}));
    }
    part.bench.part(simulation::Box({-60, -50, -40}, {-30, 50, 0}), part.machineFromPart);
    edge = part.nominal.x() - 60;
    part.bench.knows(5, "MILL", 80, 5);
  }
};

std::string wholeProgram(const Plate& plate, Dice& dice) {
  const Vector3& n = plate.part.nominal;
  const double height = n.z() - 8, clear = n.z() + 20;
  const auto number = [](double value) { return fmt::format("{:+.6f}", value); };
  std::string text = "BLK FORM 0.1 Z X-100 Y-60 Z-40\nBLK FORM 0.2 X+100 Y+60 Z+0\n; THE PLATE\n";
  text += "CYCL DEF 247 PRESETTING ~\n  Q339=+1 ;NUMBER\n";
  text += fmt::format("Q1 = {}\nQ2 = {}\nQ3 = 0 ; OUT OF TOLERANCE\nQ10 = 0\nQ20 = 0\nQ21 = 0\nQL5 = {}\n", plate.pitch,
                      plate.diameter, 0.15);
  // The origin by the first hole, then the edge.
  text += probe(412, {{321, n.x()}, {322, n.y()}, {262, plate.diameter},
                      {325, 0},     {247, 90},    {261, height},
                      {320, 1},     {260, clear}, {301, dice.whole(0, 1)},
                      {305, 1},     {331, n.x()}, {332, n.y()},
                      {303, 1},     {381, 0},     {382, 0},
                      {383, 0},     {384, 0},     {333, 0},
                      {423, 4},     {365, 1}});
  text += "CALL LBL \"EDGE\"\n";
  text += "LBL 1\nQ10 = Q10 + 1\nQ11 = " + number(n.x()) + " + (Q10 - 1) * Q1\nCALL LBL 20\n";
  text += "FN 12: IF +Q10 LT +3 GOTO LBL 1\n";
  // Along a tilted plane, and back; then the edge once more, from a shifted origin.
  text += "L Z-5 R0 FMAX M91\nPLANE SPATIAL SPA+0 SPB+15 SPC+30 TURN FMAX\nL Z+150 R0 FMAX\nPLANE RESET TURN FMAX\n";
  text += "L Z+100 R0 FMAX\nCYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+5\nCYCL DEF 7.2 IY-3\nL X+0 Y+0 R0 FMAX\n";
  text += "CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+0\nCYCL DEF 7.2 Y+0\nCALL LBL \"EDGE\"\n";
  text += "Q30 = 0\nLBL 3\nQ30 = Q30 + 1\nCALL LBL 3 REP 2\n";
  text += "FN 11: IF +Q3 GT +1 GOTO LBL \"SCRAP\"\nL Z+100 R0 FMAX\nL X+Q21 Y+Q22 FMAX\n";
  text += "FN 9: IF +0 EQU +0 GOTO LBL \"END\"\nLBL \"SCRAP\"\nL Z+110 R0 FMAX\nL X+Q22 Y+Q21 FMAX\n";
  text += "LBL \"END\"\nL IZ+Q30 FMAX\nL IZ+Q3 FMAX M30\n";
  // Measures a hole: Q11 is its place.
  text += "LBL 20\nTCH PROBE 421 MEASURE HOLE";
  text += fmt::format(" ~\n  Q273=+Q11 ~\n  Q274={} ~\n  Q262=+Q2 ~\n  Q325=+0 ~\n  Q247=+90 ~\n  Q261={} ~\n  Q320=+1",
                      number(n.y()), number(height));
  text += fmt::format(" ~\n  Q260={} ~\n  Q301=+0 ~\n  Q275={} ~\n  Q276={} ~\n  Q279=+0 ~\n  Q280=+0 ~\n  Q281=+0",
                      number(clear), number(plate.diameter + 0.2), number(plate.diameter - 0.2));
  text += " ~\n  Q309=+0 ~\n  Q330=+5 ~\n  Q423=+4 ~\n  Q365=+1\n";
  text += "FN 9: IF +Q180 EQU +1 GOTO LBL 21\nQ3 = Q3 + 1\nLBL 21\nQ20 = Q20 + Q151\nQ21 = Q21 + Q153 - QL5\nLBL 0\n";
  text += "LBL \"EDGE\"\n";
  text += probe(427, {{263, plate.edge},
                      {264, n.y()},
                      {261, height},
                      {320, 2},
                      {272, 1},
                      {267, 1},
                      {260, clear},
                      {281, 0},
                      {288, 0},
                      {289, 0},
                      {309, 0},
                      {330, 0}});
  text += "Q22 = Q160 / 2\nLBL 0\n";
  return text;
}

TEST(ConvertWholeProgram, MeasuresTheSameThereAndBack) {
  Dice dice(20260);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    const Plate plate(dice);
    const Twin original = runKlartext(klartextProgram(wholeProgram(plate, dice)), plate.part);
    ASSERT_TRUE(ranWhole(original));
    const Twin there = withoutVerdict(runConverted(original, plate.part));
    ASSERT_TRUE(ranWhole(there));
    const Twin back = withoutVerdict(runConverted(there, plate.part));
    ASSERT_TRUE(ranWhole(back));
    for (const Twin* twin : {&there, &back}) {
      EXPECT_TRUE(sameOrigin(original, *twin));
      EXPECT_TRUE(sameTool(original, *twin, 3));
      EXPECT_TRUE(sameEnd(original, *twin));
    }
    EXPECT_TRUE(sameResults(original, there, {{"Q160", "_OVR[4]"}}));
    if (::testing::Test::HasFailure()) return;
  }
}

/// What a HEIDENHAIN control alone has stays as a comment at its place and is named with its line.
TEST(ConvertWithoutTwin, KeepsHeidenhainCyclesAsComments) {
  for (const int cycle : {1, 2, 405, 440, 441, 444, 450, 452, 463, 480, 485, 1411}) {
    std::string call = fmt::format("TCH PROBE {} CYCLE", cycle);
    if (const cycles::CycleDefinition* definition = cycles::heidenhainCycle(cycle)) {
      for (const cycles::Parameter& parameter : definition->parameters) {
        if (parameter.name.front() != 'Q') continue;
        call +=
            fmt::format(" ~\n  {}={:+}", parameter.name, parameter.standard.value_or(std::max(0.0, parameter.minimum)));
      }
    } else {
      call += " ~\n  Q410=+0";
    }
    if (cycle == 1) call = "TCH PROBE 1.0 POLAR PRESET\nTCH PROBE 1.1 X ANGLE:+30\nTCH PROBE 1.2 X+5 Y+0 Z-5";
    if (cycle == 2) call = "TCH PROBE 2.0 CALIBRATE TS\nTCH PROBE 2.1 HEIGHT:+50 R+25.003 MEASUREMENT LOG:0";
    const conversion::Conversion there = toSinumerik(klartextProgram(call + "\nL X+7 R0 FMAX\n"));
    ASSERT_TRUE(there.mistakes.empty()) << cycle << ": " << format(there.mistakes.front());
    ASSERT_EQ(there.notCarriedOver.size(), 1U) << cycle << "\n" << there.text;
    EXPECT_EQ(there.notCarriedOver[0].place.line, 4U) << cycle;
    EXPECT_NE(there.text.find(fmt::format("; NOT CARRIED OVER: TCH PROBE {}", cycle)), std::string::npos) << there.text;
    EXPECT_NE(there.text.find("G0 X7\n"), std::string::npos) << there.text;
  }
}

TEST(ConvertWithoutTwin, KeepsSinumerikCyclesAsComments) {
  for (const char* call :
       {"CYCLE995(0,,1)", "CYCLE997(9,,1,20,8,5)", "CYCLE973(1)", "CYCLE974(1)", "CYCLE994(1)", "CYCLE971(1)",
        "CYCLE982(1)", "CYCLE996(10)", "CYCLE961(105,10001,1,20,5,5,10,20,30,0,0,0,90)", "CYCLE976(4,,1,20,5,5,1,1)"}) {
    const conversion::Conversion there = toKlartext(fmt::format("G17 G90 G710\nT1 M6 D1\n{}\nG0 X7\nM30\n", call));
    ASSERT_TRUE(there.mistakes.empty()) << call << ": " << format(there.mistakes.front());
    ASSERT_EQ(there.notCarriedOver.size(), 1U) << call << "\n" << there.text;
    EXPECT_EQ(there.notCarriedOver[0].place.line, 3U) << call;
    EXPECT_NE(there.text.find(fmt::format("; NOT CARRIED OVER: {}", call)), std::string::npos) << there.text;
    EXPECT_NE(there.text.find("L X+7 R0 FMAX\n"), std::string::npos) << there.text;
  }
}

/// Beyond a tolerance both programs stop, if they are asked to.
TEST(ConvertTolerances, StopTheProgram) {
  Dice dice(309);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    PlantedPart part = plant(dice, dice.coin() ? ControlKind::TNC640 : ControlKind::iTNC530, 0.5, 0);
    const double diameter = dice.between(20, 60), limit = written(dice.between(0.1, 0.4));
    const bool hole = dice.coin();
    if (hole) {
      part.bench.part(simulation::Ring(diameter / 2, diameter / 2 + 40, -40), part.machineFromPart);
    } else {
      part.bench.part(simulation::RoundBar(diameter / 2, -40, 0), part.machineFromPart);
    }
    const double nominal = written(diameter + dice.between(-0.5, 0.5)), centre = dice.coin() ? 0 : 0.3;
    const Twin original = runKlartext(klartextProgram(probe(hole ? 421 : 422, {{273, part.nominal.x()},
                                                                               {274, part.nominal.y()},
                                                                               {262, nominal},
                                                                               {325, 0},
                                                                               {247, 90},
                                                                               {261, part.nominal.z() - 8},
                                                                               {320, 2},
                                                                               {260, part.nominal.z() + 20},
                                                                               {301, 1},
                                                                               {hole ? 275 : 277, nominal + limit},
                                                                               {hole ? 276 : 278, nominal - limit},
                                                                               {279, centre},
                                                                               {280, centre},
                                                                               {281, 0},
                                                                               {309, 1},
                                                                               {330, 0}})),
                                      part);
    const Twin there = runConverted(original, part);
    EXPECT_TRUE(there.lost.empty()) << format(there.lost.front());
    EXPECT_EQ(original.finished, there.finished) << original.why << there.why << original.text << there.text;
    if (!original.finished) {
      EXPECT_NE(original.why.find("Tolerance exceeded"), std::string::npos) << original.why;
      EXPECT_NE(there.why.find("65000"), std::string::npos) << there.why;
    }
    const Twin back = runConverted(there, part);
    EXPECT_EQ(original.finished, back.finished) << back.why << back.text;
    if (::testing::Test::HasFailure()) return;
  }
}

TEST(ConvertLogs, WritesThem) {
  Dice dice(281);
  PlantedPart part = plant(dice, ControlKind::TNC640, 0.5, 0);
  part.bench.part(simulation::Box({-50, -50, -40}, {50, 50, 0}), part.machineFromPart);
  const auto program = [&](int log) {
    return klartextProgram(probe(427, {{263, part.nominal.x()},
                                       {264, part.nominal.y()},
                                       {261, part.nominal.z()},
                                       {320, 2},
                                       {272, 3},
                                       {267, -1},
                                       {260, part.nominal.z() + 20},
                                       {281, log},
                                       {288, 0},
                                       {289, 0},
                                       {309, 0},
                                       {330, 0}}));
  };
  const Twin original = runKlartext(program(1), part);
  const Twin there = runConverted(original, part);
  const Twin back = runConverted(there, part);
  for (const Twin* twin : {&original, &there, &back}) {
    ASSERT_TRUE(ranWhole(*twin));
    EXPECT_TRUE(twin->files.contains("TCHPR427.TXT")) << twin->text;
  }
  EXPECT_FALSE(runConverted(runKlartext(program(0), part), part).files.contains("TCHPR427.TXT"));
  const std::string screen = toSinumerik(program(2)).text;
  EXPECT_NE(screen.find("CYCLE150(31,0)\n"), std::string::npos) << screen;
  EXPECT_NE(toKlartext(screen).text.find("Q281=+2 "), std::string::npos) << toKlartext(screen).text;
}

/// Two ways on which the same log was asked for meet before the cycle.
TEST(ConvertLogs, KnowThemWhereWaysMeet) {
  const auto there = [](const std::string& one, const std::string& other) {
    return toKlartext(
        fmt::format("G17 G90 G710\nT1 M6 D1\nG54\nG0 Z100\nIF R1==1\n{}\nG0 X3\nELSE\n{}\nENDIF\nG0 X0 Y0\n"
                    "CYCLE978(0,,,1,0,8,8,1,1,1)\nM30\n",
                    one, other));
  };
  const std::string file = "CYCLE150(0,1,\"TCHPR427\")", screen = "CYCLE150(31,0)", none = "CYCLE150(0,0)";
  for (const auto& [asked, q281] : {std::pair(file, "Q281=+1 "), {screen, "Q281=+2 "}, {none, "Q281=+0 "}}) {
    const conversion::Conversion same = there(asked, asked);
    EXPECT_FALSE(lists(same, "CYCLE150")) << same.text;
    EXPECT_NE(same.text.find(q281), std::string::npos) << same.text;
  }
  EXPECT_TRUE(lists(there(file, none), "CYCLE150"));
}

}  // namespace
}  // namespace probewright::testing_support
