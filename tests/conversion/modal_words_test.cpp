#include <gmock/gmock.h>

#include "conversion/twins.hpp"

/// Modal words, rotary axes, spindle, tools and types of variables: nothing of them is lost without a word.
namespace probewright::testing_support {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

PlantedPart table() {
  PlantedPart part{Bench(ControlKind::TNC640, "mill5-table-table")};
  part.bench.preset(1, {10, 20, -400});
  return part;
}

std::string sinumerikProgram(const std::string& blocks, const std::string& definitions = {}) {
  return definitions + "G17 G90 G710\nT1 M6 D1\nG54\nG0 Z100\n" + blocks + "M30\n";
}

::testing::AssertionResult driveAlike(const std::string& program, ProgramLanguage language, double slack = 0.05) {
  const PlantedPart part = table();
  const Twin original = run(program, language, part);
  const Twin there = runConverted(original, part);
  for (const auto& result : {ranWhole(original), ranWhole(there), sameEnd(original, there)})
    if (!result) return result;
  if (std::abs(original.seconds - there.seconds) < slack) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << original.seconds << " s and " << there.seconds << " s\n" << there.text;
}

TEST(ConvertModalWords, EndFeedsPerRevolution) {
  for (const char* blocks :
       {"S1000 M3\nG95 G1 X50 F0.5\nG94 Y50 F500\nM5\n", "S1000 M3\nG95 G1 X50 F0.5\nG1 Y50 F500 G94\n",
        "S1000 M3\nG95\nG1 X50 F0.5\nG94\nG1 Y50 F500\n"})
    EXPECT_TRUE(driveAlike(sinumerikProgram(blocks), ProgramLanguage::Sinumerik)) << blocks;
  EXPECT_THAT(toKlartext(sinumerikProgram("G94 G1 X5 F500\n")).text, Not(HasSubstr("M137")));
}

/// Words of dynamics and of the display are left out, and a note says so; what stands beside them is kept.
TEST(ConvertModalWords, LeaveOutHowPathsAreTravelled) {
  for (const char* word : {"SOFT", "FFWON", "COMPCAD", "G641 ADIS=0.1", "G642", "G602", "CTOL=0.01", "ACC[X]=50",
                           "FINEA[X]", "DYNFINISH", "SBLOF", "CYCLE832(0.01,1,1)", "GROUP_BEGIN(0,\"A\",0,0)"}) {
    const std::string alone = fmt::format("{}\nG1 X50 F500\n", word);
    EXPECT_TRUE(driveAlike(sinumerikProgram(alone), ProgramLanguage::Sinumerik)) << word;
    const conversion::Conversion there = toKlartext(sinumerikProgram(alone + alone));
    ASSERT_EQ(there.notCarriedOver.size(), std::string(word).starts_with("G641") ? 2U : 1U) << word;
    EXPECT_EQ(there.notCarriedOver[0].severity, Severity::Note) << word;
    EXPECT_THAT(there.notCarriedOver[0].message, HasSubstr("is left out")) << word;
    EXPECT_THAT(there.text, Not(HasSubstr("NOT CARRIED OVER"))) << word;
  }
  EXPECT_TRUE(driveAlike(sinumerikProgram("SOFT G1 X50 F500\n"), ProgramLanguage::Sinumerik));
  // What leads elsewhere, waits for other channels or belongs to the builder of the machine is listed.
  for (const char* word : {"KONT", "G451", "WAITM", "CUST_CLAMP", "CDON"})
    EXPECT_THAT(toKlartext(sinumerikProgram(fmt::format("{}\n", word))).text, HasSubstr("NOT CARRIED OVER")) << word;
}

TEST(ConvertModalWords, LeaveOutHowPathsOfKlartextAreTravelled) {
  for (const char* said : {"CYCL DEF 32.0 TOLERANCE\nCYCL DEF 32.1 T0.05\nCYCL DEF 32.2 HSC-MODE:1 TA5\n",
                           "CYCL DEF 32.0 TOLERANCE\nCYCL DEF 32.1\n", "FUNCTION FEED DWELL D-TIME0.5 F-TIME5\n",
                           "FUNCTION S-PULSE RESET\n", "MONITORING SECTION START AS \"A\"\n"}) {
    const std::string alone = fmt::format("{}L X+50 R0 F500\n", said);
    EXPECT_TRUE(driveAlike(klartextProgram(alone), ProgramLanguage::Klartext)) << said;
    const conversion::Conversion there = toSinumerik(klartextProgram(alone + alone));
    ASSERT_EQ(there.notCarriedOver.size(), 1U) << said;
    EXPECT_EQ(there.notCarriedOver[0].severity, Severity::Note) << said;
    EXPECT_THAT(there.notCarriedOver[0].message, HasSubstr("is left out")) << said;
    EXPECT_THAT(there.text, Not(HasSubstr("NOT CARRIED OVER"))) << said;
  }
  // What prevents collisions, counts parts or makes signals for the machine is listed.
  for (const char* kept :
       {"FUNCTION DCM OFF\n", "FUNCTION COUNT RESET\n", "FUNCTION MODE TURN\n", "FN 19: PLC = +1 / +2\n"})
    EXPECT_THAT(toSinumerik(klartextProgram(kept)).text, HasSubstr("NOT CARRIED OVER")) << kept;
}

/// The way is what differs: -45 degrees and +315.
TEST(ConvertModalWords, TurnRotaryAxesTheShortestWay) {
  EXPECT_TRUE(driveAlike(sinumerikProgram("G1 C35 F3000\nC=DC(350)\nC=DC(20)\nG0 X5 C=DC(300)\nG1 C=IC(30)\n"),
                         ProgramLanguage::Sinumerik));
  for (const char* lost : {"G0 C=ACP(350)\n", "G0 C=ACN(350)\n", "G0 A=10 C=DC(350)\n"})
    EXPECT_THAT(toKlartext(sinumerikProgram(lost)).text, HasSubstr("; NOT CARRIED OVER: ")) << lost;
}

/// A SINUMERIK counts an axis that turns endlessly within one turn.
TEST(ConvertModalWords, NamePositionsBeyondATurn) {
  for (const auto& [angle, named] : {std::pair(350, false), {-350, false}, {400, true}, {-400, true}}) {
    EXPECT_EQ(lists(toSinumerik(klartextProgram(fmt::format("L C{:+} R0 FMAX\n", angle))), "beyond a whole turn"),
              named);
    EXPECT_EQ(lists(toKlartext(sinumerikProgram(fmt::format("G0 C{}\n", angle))), "beyond a whole turn"), named);
  }
}

TEST(ConvertModalWords, OrientTheSpindle) {
  for (const char* lost : {"SPOS=IC(90)\n", "SPOS[2]=90\n", "SPOSA=90\n"})
    EXPECT_THAT(toKlartext(sinumerikProgram(lost)).text, HasSubstr("; NOT CARRIED OVER: ")) << lost;
  for (const char* kept : {"SPOS=90\n", "SPOS=DC(90)\n", "SPOS=ACP(90)\n"}) {
    EXPECT_TRUE(toKlartext(sinumerikProgram(kept)).notCarriedOver.empty()) << kept;
    EXPECT_THAT(toKlartext(sinumerikProgram(kept)).text, HasSubstr("CYCL DEF 13.1 ANGLE +90\n")) << kept;
  }
  EXPECT_THAT(toKlartext(sinumerikProgram("SPOS=-90\n")).text, HasSubstr("CYCL DEF 13.1 ANGLE +270\n"));
  EXPECT_TRUE(driveAlike(sinumerikProgram("R1=-90\nSPOS=R1\nR1=750\nSPOS=R1\n"), ProgramLanguage::Sinumerik, 1));
  EXPECT_TRUE(toKlartext(sinumerikProgram("M19\n")).notCarriedOver.empty());
  EXPECT_TRUE(lists(toKlartext(sinumerikProgram("SPOS=90\nM19\n")), "M19"));
}

/// A probe that leaves the spindle has no cutting edge.
TEST(ConvertModalWords, CallToolZero) {
  for (const char* blocks :
       {"TOOL CALL 0 Z\n", "TOOL CALL 0 Z\nL Z-1 R0 FMAX M91\nL X+5 R0 FMAX\n",
        "Q5 = 0\nTOOL CALL Q5 Z\nL Z-1 R0 FMAX M91\n", "Q5 = 1\nTOOL CALL Q5 Z\nL Z-1 R0 FMAX M91\nL Z+90 R0 FMAX\n",
        "FN 9: IF +Q1 EQU +0 GOTO LBL 5\nTOOL CALL 0 Z\nLBL 5\nL Z-1 R0 FMAX M91\nL Z+90 R0 FMAX\n",
        "L Z-1 R0 FMAX M91\nTOOL CALL 0 Z\nLBL 5\nL Z-2 R0 FMAX M91\nCALL LBL 5 REP 1\n"})
    EXPECT_TRUE(driveAlike(klartextProgram("Q1 = 0\n" + std::string(blocks)), ProgramLanguage::Klartext, 10)) << blocks;
  EXPECT_TRUE(driveAlike("BEGIN PGM BENCH MM\nL Z-1 R0 FMAX M91\nTOOL CALL 1 Z\nEND PGM BENCH MM\n",
                         ProgramLanguage::Klartext, 10));
}

/// Cycles that measure in a plane of their own.
TEST(ConvertModalWords, NameThePlaneOfACycle) {
  for (const int plane : {0, 1, 2, 3}) {
    const Named surface = {{"S_MVAR", 0}, {"S_PRNUM", 1}, {"S_SETV", 8}, {"S_FA", 4},      {"S_TSA", 4},
                           {"S_MA", 1},   {"S_MD", 1},    {"S_NMSP", 1}, {"_DMODE", plane}};
    const conversion::Conversion there =
        toKlartext(sinumerikProgram("G0 X0 Y0\n" + sinumerikCall("CYCLE978", surface)));
    EXPECT_EQ(lists(there, "_DMODE"), plane > 1) << plane;
    EXPECT_EQ(there.text.find("TCH PROBE") == std::string::npos, plane > 1) << there.text;
  }
}

TEST(ConvertVariables, KeepTheirTypes) {
  const std::string definitions =
      "DEF BOOL BB1\nDEF INT II1=7.5, II2=-2.5\nDEF INT AA[2]=SET(1.4,2.7)\nDEF REAL RR=2.6\n";
  for (const char* blocks :
       {"II1=2.6\nG0 X=II1", "II1=7/2\nG0 X=II1", "II1=-2.5\nG0 X=II1", "II1=-2.6\nG0 X=II1",
        "R1=3\nII1=R1*1.5+0.4\nG0 X=II1*10", "BB1=5\nG0 X=BB1", "R1=-0.3\nBB1=R1\nG0 X=BB1", "BB1=FALSE\nG0 X=BB1",
        "AA[0]=RR\nG0 X=AA[0] Y=AA[1]", "G0 X=II1 Y=II2", "FOR II1=0.6 TO 3.5\nR2=R2+II1\nENDFOR\nG0 X=II1 Y=R2",
        "II1=RR+II2\nG0 X=II1", "II1=II1+1\nG0 X=II1"})
    EXPECT_TRUE(
        driveAlike(sinumerikProgram("R2=0\n" + std::string(blocks) + "\n", definitions), ProgramLanguage::Sinumerik, 1))
        << blocks;
  // What is whole by itself needs no rounding.
  EXPECT_THAT(toKlartext("DEF INT II=3\nII=II*2+1\nM30\n").text, HasSubstr("Q1600 = Q1600 * 2 + 1\n"));
}

TEST(ConvertVariables, CompareTexts) {
  for (const char* condition :
       {"TT1==\"A\"", "TT1<>\"A\"", "TT1==\"B\"", "\"A\"==TT1", "TT1==TT2", "TT1<<\"B\"==\"AB\""})
    EXPECT_TRUE(driveAlike(sinumerikProgram(fmt::format("IF {}\nG0 X5\nELSE\nG0 X7\nENDIF\n", condition),
                                            "DEF STRING[10] TT1=\"A\", TT2=\"B\"\n"),
                           ProgramLanguage::Sinumerik, 1))
        << condition;
}

TEST(ConvertVariables, NameWhatAProcHeaderAsksFor) {
  for (const char* lost : {"PROC BENCH(BOOL WITH1)\n", "PROC BENCH(STRING[20] NAME1)\n", "PROC BENCH(VAR REAL WIDTH)\n",
                           "PROC BENCH SAVE\n"})
    EXPECT_FALSE(toKlartext(lost + std::string("G0 X1\nM17\n")).notCarriedOver.empty()) << lost;
  for (const char* kept : {"PROC BENCH\n", "PROC BENCH()\n", "PROC BENCH DISPLOF\n"})
    EXPECT_TRUE(toKlartext(kept + std::string("G0 X1\nM17\n")).notCarriedOver.empty()) << kept;
}

/// In a block of its own the name would mean something else than the call of a program.
TEST(ConvertCalls, NameProgramsWhoseNamesMeanSomethingElse) {
  for (const char* name :
       {"X1", "T1", "M30", "G1", "D1", "S50", "R5", "STOPRE", "REPEAT", "CYCLE977", "CYCLE800", "MSG", "G54"})
    EXPECT_THAT(toSinumerik(klartextProgram(fmt::format("CALL PGM {}.H\n", name))).text,
                HasSubstr("; NOT CARRIED OVER: "))
        << name;
  for (const char* name : {"SUB1", "L5", "HOLE", "_A1", "XX1"})
    EXPECT_THAT(toSinumerik(klartextProgram(fmt::format("CALL PGM {}.H\n", name))).text,
                Not(HasSubstr("; NOT CARRIED OVER: ")))
        << name;
}

/// D without a tool stops a SINUMERIK only.
TEST(ConvertModalWords, TellThatAnEdgeNeedsATool) {
  const auto tells = [](const std::string& blocks) {
    const Twin original = runSinumerik("G17 G90 G710 G54\n" + blocks + "G0 X5\nM30\n", table());
    const Twin there = runConverted(original, table());
    EXPECT_TRUE(ranWhole(there));
    const bool told = std::ranges::any_of(
        there.notes, [](const Diagnostic& each) { return each.message.find("17180") != std::string::npos; });
    EXPECT_EQ(told, !original.finished) << blocks << original.why;
    if (!original.finished) {
      EXPECT_THAT(original.why, HasSubstr("17180"));
    }
    return told;
  };
  for (const char* blocks : {"D1\n", "D1\nT1 M6 D1\n", "T1 M6 D1\nT0\nM6\nD1\n", "SUPA G0 Z0 D0\nD1\nT1 M6\n",
                             "IF R1>0\nT1 M6\nENDIF\nD1\n"})
    EXPECT_TRUE(tells(blocks)) << blocks;
  for (const char* blocks : {"T1 M6 D1\n", "T1\nD1\nM6\n", "SUPA G0 Z0 D0\nT1 M6\nD1\n",
                             "IF R1>0\nT1 M6\nELSE\nT1 M6\nENDIF\nD1\n", "T0\nM6 D0\nT1 M6\nD1\n"})
    EXPECT_FALSE(tells(blocks)) << blocks;
}

/// TOOL DEF prepares a tool; only dimensions that older programs give with it would change something.
TEST(ConvertModalWords, LeaveOutWhichToolComesNext) {
  const std::string blocks = "TOOL DEF 5\nL X+5 R0 FMAX\nTOOL DEF \"PROBE\"\nL Y+5 FMAX\n";
  EXPECT_TRUE(driveAlike(klartextProgram(blocks), ProgramLanguage::Klartext));
  EXPECT_THAT(toSinumerik(klartextProgram(blocks)).text, Not(HasSubstr("NOT CARRIED OVER")));
  EXPECT_THAT(toSinumerik(klartextProgram("TOOL DEF 5 L+10 R+3\n")).text, HasSubstr("NOT CARRIED OVER"));
}

}  // namespace
}  // namespace probewright::testing_support
