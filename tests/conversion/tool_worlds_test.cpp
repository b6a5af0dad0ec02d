#include "tool_touch_probe/tool_worlds.hpp"
#include "conversion/twins.hpp"

/// Cycles 481 to 483, 31 to 33 and CYCLE971: a tool is measured to the same belief by a program and its conversion.
namespace probewright::testing_support {
namespace {

constexpr double tolerance = 0.001;  ///< mm, permissible measuring error on both controls

/// A mill that the control knows about right.
struct Milled {
  Milled(Dice& dice, ControlKind kind, bool teeth) : world(kind), folder(world.bench) {
    world.contact = {written(dice.between(80, 160)), written(dice.between(-80, 0)), written(dice.between(-480, -460))};
    dice.coin() ? world.disc(written(dice.between(24, 40))) : world.cuboid(24, 30);
    const double radius = written(dice.between(4, 20));
    mill = plantedMill(dice, radius, teeth ? dice.whole(1, 2) : dice.whole(1, 6), true);
    mill.cutter.helix = 0;
    world.add(mill, 12, written(mill.length + dice.between(-1, 1)), written(radius + dice.between(-0.3, 0.3)));
    const int count = static_cast<int>(mill.cutter.teeth.size());
    world.bench.setup.beliefs.tools.back().teeth = count;
    enter(folder, world, {{"CUT", fmt::format("{}", count)}});
  }
  double length() const { return mill.length + largest(mill, &simulation::TrueTooth::axial); }
  double radius() const { return mill.radius + largest(mill, &simulation::TrueTooth::radial); }
  double believedLength() const { return world.bench.setup.beliefs.tools.back().length; }
  double believedRadius() const { return world.bench.setup.beliefs.tools.back().radius; }

  /// The values of the parameters Q1 to Q4 (R1 to R4) at the end.
  std::array<double, 4> run(const std::string& text, ProgramLanguage language) const {
    const bool heidenhain = language == ProgramLanguage::Klartext;
    setup::Setup setup = twinSetup(world.bench.setup);
    setup.beliefs.toolProbes = setup::believedToolProbes(setup.world);
    if (!heidenhain) setup.beliefs.tables.clear();  // TOOL.T
    const char* name = !heidenhain                                  ? "$SNS_MEA_CM_MEASURING_ACCURACY[0]"
                       : world.bench.control == ControlKind::TNC640 ? "measureTolerance1"
                                                                    : "MP6510";
    setup.beliefs.parameters[name] = {tolerance, {}};
    session::RunOptions options;
    options.control = heidenhain ? world.bench.control : ControlKind::Sinumerik840Dsl;
    const setup::SimulatedRun run =
        setup::runText(heidenhain ? "BENCH.H" : "BENCH.MPF", text, setup, options, {.recordPath = false});
    const auto& outcome = run.outcome;
    EXPECT_FALSE(hasErrors(outcome.diagnostics)) << format(outcome.diagnostics.front()) << text;
    EXPECT_EQ(outcome.result.end, execution::RunEnd::Finished)
        << (outcome.result.diagnostics.empty() ? "" : format(outcome.result.diagnostics.front())) << text;
    std::array<double, 4> values;
    for (std::size_t i = 0; i < 4; ++i)
      values[i] =
          outcome.variable ? outcome.variable(fmt::format("{}{}", heidenhain ? 'Q' : 'R', i + 1)) : std::nan("");
    return values;
  }

  ToolWorld world;
  TableFolder folder;
  simulation::TrueTool mill;
};

const std::string readTable =
    "FN 18: SYSREAD Q1 = ID50 NR1 IDX12\nFN 18: SYSREAD Q2 = ID50 NR2 IDX12\nFN 18: SYSREAD Q3 = ID50 NR4 IDX12\nFN "
    "18: SYSREAD Q4 = ID50 NR5 IDX12\n";

TEST(ToolConversion, ToSinumerikMeasuresTheSameTool) {
  Dice dice(9711);
  for (int at = 0; at < 24; ++at) {
    const bool teeth = at % 4 == 3;
    const int number = 481 + at % 3, mode = at / 3 % 2;
    SCOPED_TRACE(fmt::format("world {}: {} mode {}", at, number, mode));
    const Milled milled(dice, controlOf(at), teeth);
    const std::string text = "0 BEGIN PGM BENCH MM\nTOOL CALL 12 Z\nL Z+150 R0 FMAX\n" +
                             toolCycle(number, mode, teeth, at % 5 == 0) + readTable + "9 END PGM BENCH MM\n";
    const conversion::Conversion conversion = toSinumerik(text);
    EXPECT_FALSE(hasErrors(conversion.mistakes));
    EXPECT_EQ(conversion.notCarriedOver.size(), mode == 1 ? 1U : 0U) << conversion.text;
    EXPECT_EQ(conversion.text.find("NOT CARRIED"), std::string::npos) << conversion.text;
    const auto there = milled.run(conversion.text, ProgramLanguage::Sinumerik);
    const auto here = milled.run(text, ProgramLanguage::Klartext);
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(there[i], here[i], tolerance + 1e-4) << "value " << i << "\n" << conversion.text;
    const bool length = number != 482, radius = number != 481;
    EXPECT_NEAR(there[0] + there[2], length ? milled.length() : milled.believedLength(), tolerance + 1e-4);
    EXPECT_NEAR(there[1] + there[3], radius ? milled.radius() : milled.believedRadius(), tolerance + 1e-4);
    if (mode == 1) {
      EXPECT_EQ(there[0], milled.believedLength());
    }
  }
}

TEST(ToolConversion, ToSinumerikMeasuresSingleEdges) {
  Dice dice(9712);
  for (int at = 0; at < 6; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    const Milled milled(dice, ControlKind::TNC640, true);
    const std::string text = "0 BEGIN PGM BENCH MM\nTOOL CALL 12 Z\nL Z+150 R0 FMAX\n" +
                             toolCycle(482, 0, true, false) + readTable + "9 END PGM BENCH MM\n";
    const auto there = milled.run(toSinumerik(text).text, ProgramLanguage::Sinumerik);
    EXPECT_NEAR(there[1], milled.radius(), tolerance + 1e-4);
  }
}

TEST(ToolConversion, CarriesDeviationsAndNamesWhatSinumerikLacks) {
  Dice dice(9713);
  for (const bool inch : {false, true}) {
    const Milled milled(dice, ControlKind::TNC640, false);
    const double unit = inch ? 25.4 : 1;
    std::string text =
        fmt::format("0 BEGIN PGM BENCH {}\nTOOL CALL 12 Z\nL Z+{} R0 FMAX\n", inch ? "INCH" : "MM", inch ? 5.5 : 150) +
        probe(483, {{340, 1}, {260, inch ? 3 : 60}, {341, 0}}) +
        fmt::format("Q1 = Q115\nQ2 = Q116\n9 END PGM BENCH {}\n", inch ? "INCH" : "MM");
    const conversion::Conversion conversion = toSinumerik(text);
    const auto there = milled.run(conversion.text, ProgramLanguage::Sinumerik),
               here = milled.run(text, ProgramLanguage::Klartext);
    EXPECT_NEAR(there[0] * unit, milled.length() - milled.believedLength(), tolerance + 1e-4) << conversion.text;
    EXPECT_NEAR(there[1] * unit, milled.radius() - milled.believedRadius(), tolerance + 1e-4);
    EXPECT_NEAR(there[0], here[0], tolerance);
    EXPECT_NEAR(there[1], here[1], tolerance);
  }
  const auto lost = [](const std::string& cycle, const std::string& after) {
    return toSinumerik("0 BEGIN PGM A MM\nTOOL CALL 12 Z\n" + cycle + after + "9 END PGM A MM\n");
  };
  EXPECT_NE(lost(toolCycle(481, 2, false, false), "").text.find("NOT CARRIED OVER: TCH PROBE 481"), std::string::npos);
  EXPECT_NE(lost(toolCycle(481, 1, false, false), "Q1 = Q199\n").text.find("Q199: CYCLE971 tells no status"),
            std::string::npos);
  EXPECT_NE(lost(toolCycle(481, 1, false, true), "Q1 = Q5\n").text.find("Q5: CYCLE971 tells no status"),
            std::string::npos);
}

TEST(ToolConversion, ToKlartextMeasuresTheSameTool) {
  Dice dice(9714);
  for (int at = 0; at < 16; ++at) {
    const bool length = at % 2 == 0, wear = at / 2 % 2 == 1;
    SCOPED_TRACE(fmt::format("world {}", at));
    const Milled milled(dice, controlOf(at / 4), false);
    const std::string text = fmt::format(
        "G17 G54 G90 G710\nT12\nM6 D1\nG0 Z150\nCYCLE971(2,{},1,{},{},0,15,15,,0,0,1)\nR1=_OVR[{}] "
        "R2=_OVR[{}]\nR3=$TC_DP{}[12,1] R4=$TC_DP{}[12,1]\nM30\n",
        wear ? 1 : 0, length ? 3 : 1, length ? 0 : 1, length ? 8 : 10, length ? 9 : 11, length ? 3 : 6,
        length ? 12 : 15);
    const conversion::Conversion conversion = converted(text, ProgramLanguage::Sinumerik, milled.world.bench.control);
    EXPECT_TRUE(conversion.notCarriedOver.empty()) << format(conversion.notCarriedOver.front()) << conversion.text;
    const auto here = milled.run(text, ProgramLanguage::Sinumerik);
    const auto there = milled.run(conversion.text, ProgramLanguage::Klartext);
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(there[i], here[i], tolerance + 1e-4) << "value " << i << "\n" << conversion.text;
    EXPECT_NEAR(there[0], length ? milled.length() : milled.radius(), tolerance + 1e-4);
  }
}

/// Single edges: the longest and the largest one count on both controls.
TEST(ToolConversion, ToKlartextMeasuresSingleEdges) {
  Dice dice(9715);
  for (int at = 0; at < 12; ++at) {
    const bool length = at % 2 == 0, wear = at / 2 % 2 == 1;
    SCOPED_TRACE(fmt::format("world {}", at));
    const Milled milled(dice, controlOf(at / 4), true);
    const std::string text = fmt::format(
        "G17 G54 G90 G710\nT12\nM6 D1\nG0 Z150\nCYCLE971(102,{},1,{},{},0,15,15,,0,0,1)\n"
        "R1=$TC_DP3[12,1] R2=$TC_DP6[12,1] R3=$TC_DP12[12,1] R4=$TC_DP15[12,1]\nM30\n",
        wear ? 1 : 0, length ? 3 : 1, length ? 0 : 1);
    const conversion::Conversion conversion = converted(text, ProgramLanguage::Sinumerik, milled.world.bench.control);
    EXPECT_TRUE(conversion.notCarriedOver.empty()) << format(conversion.notCarriedOver.front()) << conversion.text;
    const auto here = milled.run(text, ProgramLanguage::Sinumerik);
    const auto there = milled.run(conversion.text, ProgramLanguage::Klartext);
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(there[i], here[i], tolerance + 1e-4) << "value " << i << "\n" << conversion.text;
    const double found = length ? there[0] + there[2] : there[1] + there[3];
    EXPECT_NEAR(found, length ? milled.length() : milled.radius(), tolerance + 1e-4);
  }
}

/// 30 to 33 and 480 to 483 leave the same table and the same parameters, in Klartext and DIN/ISO.
TEST(ToolConversion, OldAndNewFormsMeasureTheSameTool) {
  Dice dice(9716);
  for (int at = 0; at < 24; ++at) {
    const bool old = at % 2 == 0, teeth = at / 2 % 2 == 1;
    const int number = 481 + at % 3, mode = at / 4 % 2;
    SCOPED_TRACE(fmt::format("world {}: {} mode {} old {}", at, number, mode, old));
    Milled milled(dice, controlOf(at / 12), teeth);
    simulation::TrueTool pin;
    pin.length = 70;
    pin.radius = 6;
    milled.world.add(pin, 9, pin.length, pin.radius);
    // Q5 has the status either way.
    const std::string text =
        "0 BEGIN PGM BENCH MM\nTOOL CALL 9 Z\n" +
        (old ? std::string("TCH PROBE 30.0 TT\nTCH PROBE 30.1 HEIGHT: +90\n") : probe(480, {{260, 90}})) +
        "TOOL CALL 12 Z\n" + toolCycle(number, mode, teeth, old) + (old ? "" : "Q5 = Q199\n") +
        "Q6 = Q115\nQ7 = Q116\n9 END PGM BENCH MM\n";
    const auto run = [&](const std::string& program, const char* file) {
      setup::Setup setup = milled.world.bench.setup;
      setup.beliefs.toolProbes = setup::believedToolProbes(setup.world);
      setup.beliefs.parameters["stopOnCheck"] = {0.0, {}};
      if (milled.world.bench.control == ControlKind::iTNC530) setup.beliefs.parameters.erase("stopOnCheck");
      session::RunOptions options;
      options.control = milled.world.bench.control;
      auto outcome = setup::runText(file, program, setup, options, {.recordPath = false}).outcome;
      EXPECT_EQ(outcome.result.end, execution::RunEnd::Finished)
          << (outcome.result.diagnostics.empty() ? "" : format(outcome.result.diagnostics.front())) << program;
      std::string left = outcome.files.contains("TOOL.T") ? outcome.files.at("TOOL.T") : "";
      for (const char* name : {"Q5", "Q6", "Q7"})
        left += fmt::format("{} {:.9f}\n", name, outcome.variable(name));
      return left;
    };
    const auto into = [&](const std::string& program, ProgramLanguage from, ProgramLanguage to,
                          conversion::ToolCycles form) {
      const auto read = session::programOf(from == ProgramLanguage::DinIso ? "BENCH.I" : "BENCH.H", program, from);
      const auto conversion = conversion::convert(*read, from, to, {.globalData = {}, .toolCycles = form});
      EXPECT_TRUE(conversion.notCarriedOver.empty() && conversion.mistakes.empty()) << conversion.text;
      return conversion.text;
    };
    using enum conversion::ToolCycles;
    constexpr auto klartext = ProgramLanguage::Klartext, iso = ProgramLanguage::DinIso;
    const std::string expected = run(text, "BENCH.H");
    const std::string other = into(text, klartext, klartext, old ? New : Old);
    const std::string there = fmt::format("TCH PROBE {}", old ? number : number - 450);
    EXPECT_NE(other.find(there), std::string::npos) << other;
    EXPECT_EQ(run(other, "BENCH.H"), expected) << other;
    const std::string back = into(other, klartext, klartext, old ? Old : New);
    EXPECT_EQ(run(back, "BENCH.H"), expected) << back;
    const std::string dinIso = into(text, klartext, iso, AsWritten);
    EXPECT_EQ(run(dinIso, "BENCH.I"), expected) << dinIso;
    const std::string oldAgain = into(dinIso, iso, klartext, Old);
    EXPECT_EQ(run(oldAgain, "BENCH.H"), expected) << oldAgain;
  }
}

TEST(ToolConversion, OldFormsComeOfCycle971Too) {
  const auto program =
      session::programOf("A.MPF", "G17 G54 G90 G710\nT12\nM6 D1\nG0 Z150\nCYCLE971(2,0,1,3,0,0,15,15,,0,0,1)\nM30\n",
                         ProgramLanguage::Sinumerik);
  const auto conversion = conversion::convert(*program, ProgramLanguage::Sinumerik, ProgramLanguage::Klartext,
                                              {.globalData = {}, .toolCycles = conversion::ToolCycles::Old});
  EXPECT_TRUE(conversion.notCarriedOver.empty());
  EXPECT_NE(conversion.text.find("TCH PROBE 31.3"), std::string::npos) << conversion.text;
}

TEST(ToolConversion, NewFormsStayWhereTheOldOneCannotSayIt) {
  std::string cycle = toolCycle(481, 1, false, false);
  const std::string written = "Q260=+60.000000";
  cycle.replace(cycle.find(written), written.size(), "Q260=PREDEF");
  const auto program = session::programOf("A.H",
                                          "0 BEGIN PGM A MM\nGLOBAL DEF 120 P ~\n  Q320=+0 ~\n  Q260=+9 ~\n  "
                                          "Q301=+1\nTOOL CALL 12 Z\n" +
                                              cycle + "9 END PGM A MM\n",
                                          ProgramLanguage::Klartext);
  const auto conversion = conversion::convert(*program, ProgramLanguage::Klartext, ProgramLanguage::Klartext,
                                              {.globalData = {}, .toolCycles = conversion::ToolCycles::Old});
  ASSERT_EQ(conversion.notCarriedOver.size(), 1U);
  EXPECT_NE(conversion.notCarriedOver.front().message.find("GLOBAL DEF"), std::string::npos);
  EXPECT_NE(conversion.text.find("TCH PROBE 481"), std::string::npos) << conversion.text;
}

TEST(ToolConversion, ToKlartextNamesWhatTouchProbeCyclesLack) {
  const auto text = [](const std::string& call) { return toKlartext("G17 G90\nT12\nM6 D1\n" + call + "\nM30\n").text; };
  EXPECT_NE(text("CYCLE971(0,0,1,3,0,0,15,15)").find("NOT CARRIED OVER: CYCLE971"), std::string::npos);
  EXPECT_NE(text("CYCLE971(2,0,1,3,0,2,15,15)").find("S_ID has no counterpart"), std::string::npos);
  EXPECT_NE(text("CYCLE971(2,0,1,3,0,0,15,15,,0.01,0.2)").find("S_TDIF has no counterpart"), std::string::npos);
  EXPECT_NE(text("CYCLE971(2,0,1,3,0,0,15,3)").find("S_TSA: a tool is looked for"), std::string::npos);
  EXPECT_NE(text("CYCLE971(2,0,1,3,0,0,15,R1)").find("S_TSA: a tool is looked for"), std::string::npos);
  EXPECT_NE(text("CYCLE971(2,0,1,3,0,0,30,15)").find("S_FA: touch probe cycles look"), std::string::npos);
  EXPECT_NE(text("CYCLE971(2,0,1,3,0,0,R1,15)").find("S_FA: touch probe cycles look"), std::string::npos);
  EXPECT_NE(text("CYCLE971(2,0,1,103,0,0,15,15)").find("S_MA: how far beside"), std::string::npos);
  EXPECT_EQ(text("CYCLE971(2,0,1,3,0,0,15,15)").find("NOT CARRIED OVER"), std::string::npos);
  EXPECT_NE(text("CYCLE971(1,0,1,1,1,0,15,15)").find("a rotating tool"), std::string::npos);
  EXPECT_NE(text("CYCLE971(2,0,1,3,0,0,15,15,,,,3)").find("S_NMSP: one touch"), std::string::npos);
}

/// In workpiece coordinates the contact of the probe lies elsewhere under another zero offset; only the SINUMERIK
/// knows.
TEST(ToolConversion, ToKlartextNamesToolsMeasuredInWorkpieceCoordinates) {
  const auto listed = [](const std::string& variant) {
    std::string all;
    const auto conversion = toKlartext("G17 G90\nT12\nM6 D1\nCYCLE971(" + variant + ",0,1,3,0,0,15,15)\nM30\n");
    for (const Diagnostic& each : conversion.notCarriedOver)
      all += each.message;
    return all;
  };
  for (const char* variant : {"11", "12", "112"})
    EXPECT_NE(listed(variant).find("counts in workpiece coordinates"), std::string::npos) << variant;
  for (const char* variant : {"1", "2", "102"})
    EXPECT_EQ(listed(variant).find("coordinates"), std::string::npos) << variant;
}

TEST(ToolConversion, OldFormsBecomeNewOnesInDinIso) {
  const auto program = session::programOf("A.H",
                                          "0 BEGIN PGM A MM\nTOOL CALL 12 Z\n" + toolCycle(482, 1, true, true) +
                                              "TCH PROBE 30.0 TT\nTCH PROBE 30.1 HEIGHT: +90\n9 END PGM A MM\n",
                                          ProgramLanguage::Klartext);
  const conversion::Conversion there =
      conversion::convert(*program, ProgramLanguage::Klartext, ProgramLanguage::DinIso, {});
  EXPECT_TRUE(there.notCarriedOver.empty()) << there.text;
  for (const char* line : {"G482", "Q340=+1", "Q260=+60", "Q341=+1", "D00 Q5 P01 +Q199", "G480", "Q260=+90"})
    EXPECT_NE(there.text.find(line), std::string::npos) << line << "\n" << there.text;
  const auto iso = session::programOf("A.I", there.text, ProgramLanguage::DinIso);
  const conversion::Conversion back = conversion::convert(*iso, ProgramLanguage::DinIso, ProgramLanguage::Klartext, {});
  EXPECT_TRUE(back.notCarriedOver.empty()) << back.text;
  EXPECT_NE(back.text.find("TCH PROBE 482"), std::string::npos);
}

TEST(ToolConversion, NamesWhatTheOlderControlRefuses) {
  const auto program = session::programOf("A.H",
                                          "0 BEGIN PGM A MM\nTOOL CALL 12 Z\n" + toolCycle(481, 2, false, false) +
                                              probe(484, {{536, 1}}) + "9 END PGM A MM\n",
                                          ProgramLanguage::Klartext);
  const auto listed = [&](ControlKind control) {
    return conversion::convert(*program, ProgramLanguage::Klartext, ProgramLanguage::Klartext,
                               {.globalData = {}, .control = control})
        .notCarriedOver.size();
  };
  EXPECT_EQ(listed(ControlKind::TNC640), 0U);
  EXPECT_EQ(listed(ControlKind::iTNC530), 2U);
}

}  // namespace
}  // namespace probewright::testing_support
