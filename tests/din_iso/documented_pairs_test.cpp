#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <set>
#include <vector>

#include "din_iso/resolved.hpp"

/// The table "What is read" of docs/din-iso.md: each of its rows means the same in both languages.
namespace probewright::language::din_iso::testing {
namespace {

using klartext::testing::irOf;

struct Pair {
  std::string dinIso;
  std::string klartext;
};

/// Examples by what the row's first column says.
std::map<std::string, std::vector<Pair>> examples() {
  return {
      {"G00, G01, G07", {{"G00 X+1 *", "L X+1 FMAX"}, {"G01 Y+2 F9 *", "L Y+2 F9"}, {"G07 Z+5 F9 *", "L Z+5 F9"}}},
      {"G02, G03, G05, G06; R or I, J, K",
       {{"G02 X+4 Y+2 *", "C X+4 Y+2 DR-"},
        {"G03 X+4 Y+2 *", "C X+4 Y+2 DR+"},
        {"G05 X+4 Y+2 *", "C X+4 Y+2"},
        {"G06 X+4 Y+2 *", "CT X+4 Y+2"},
        {"G03 X+4 Y+2 R-20 *", "CR X+4 Y+2 R-20 DR+"},
        {"G02 X+4 Y+2 R+20 *", "CR X+4 Y+2 R+20 DR-"}}},
      {"G10, G11, G12, G13, G15, G16 with R, H",
       {{"G10 R+45 H+0 *", "LP PR+45 PA+0 FMAX"},
        {"G11 R+45 H+180 F300 *", "LP PR+45 PA+180 F300"},
        {"G12 H+90 *", "CP PA+90 DR-"},
        {"G13 H+180 *", "CP PA+180 DR+"},
        {"G15 H+90 *", "CP PA+90"},
        {"G16 R+10 H+30 *", "CTP PR+10 PA+30"}}},
      {"I, J, K; G29", {{"I+25 J+30 *", "CC X+25 Y+30"}, {"J+1 K+2 *", "CC Y+1 Z+2"}, {"G29 *", "CC"}}},
      {"G24, G25", {{"G24 R2 *", "CHF 2"}, {"G25 R5 *", "RND R5"}}},
      {"G26, G27", {{"G26 R5 *", "RND R5"}, {"G27 R5 *", "RND R5"}}},
      {"G40, G41, G42; G43, G44",
       {{"G01 G40 X+1 F9 *", "L X+1 R0 F9"},
        {"G01 G41 X+1 F9 *", "L X+1 RL F9"},
        {"G01 G42 X+1 F9 *", "L X+1 RR F9"},
        {"G07 G43 X+1 F9 *", "L R+ X+1 F9"},
        {"G07 G44 X+1 F9 *", "L R- X+1 F9"}}},
      {"G90, G91", {{"G01 G90 X+1 F9 *", "L X+1 F9"}, {"G01 G91 X+1 F9 *", "L IX+1 F9"}}},
      {"T5 G17 S F DL DR DR2; S500",
       {{"T5 G17 S2500 F350 DL+0.2 DR-1 DR2+0.05 *", "TOOL CALL 5 Z S2500 F350 DL+0.2 DR-1 DR2+0.05"},
        {"T5 G17 S(VC=120) *", "TOOL CALL 5 Z S(VC=120)"},
        {"S500 *", "TOOL CALL S500"}}},
      {"G17, G18, G19", {{"T1 G17 *", "TOOL CALL 1 Z"}, {"T1 G18 *", "TOOL CALL 1 Y"}, {"T1 G19 *", "TOOL CALL 1 X"}}},
      {"G99 T L R; G51 T", {{"G99 T5 L+10 R+3 *", "TOOL DEF 5 L+10 R+3"}, {"G51 T6 *", "TOOL DEF 6"}}},
      {"G98 L1; L1 or L1,0; L1,5; L\"NAME\"",
       {{"G98 L1 *", "LBL 1"},
        {"L1 *", "CALL LBL 1"},
        {"L1,0 *", "CALL LBL 1"},
        {"L1,5 *", "CALL LBL 1 REP5"},
        {"L\"NAME\" *", "CALL LBL \"NAME\""}}},
      {"%NAME; %<>%; %:PGM:, %:TAB:, %:PAT:, %:CNT:",
       {{"%B.I *", "CALL PGM B.I"},
        {"%<>% *", "CALL SELECTED PGM"},
        {"%:PGM: \"X.I\" *", "SEL PGM \"X.I\""},
        {"%:TAB: \"Z.D\" *", "SEL TABLE \"Z.D\""},
        {"%:PAT: \"P.H\" *", "SEL PATTERN \"P.H\""},
        {"%:CNT: \"C.H\" *", "SEL CONTOUR \"C.H\""}}},
      {"D00 to D38 with P01, P02, P03; Dnn: with the words of Klartext",
       {{"D00 Q5 P01 +60 *", "FN 0: Q5 = +60"},
        {"D09 P01 +Q1 P02 +Q3 P03 5 *", "FN 9: IF +Q1 EQU +Q3 GOTO LBL 5"},
        {"D19 P01 +10 P02 +Q3 *", "FN 19: PLC=+10/+Q3"},
        {"D18: SYSREAD Q25 = ID210 NR4 IDX3 *", "FN 18: SYSREAD Q25 = ID210 NR4 IDX3"}}},
      {"Q1 = ...", {{"Q1 = Q2 * SIN Q3 + 4 *", "Q1 = Q2 * SIN Q3 + 4"}}},
      {"G04 F; G36 S; G38; G39 P01; G62 T P01 P02",
       {{"G04 F1.5 *", "CYCL DEF 9.0 DWELL TIME\nCYCL DEF 9.1 DWELL 1.5"},
        {"G36 S90 *", "CYCL DEF 13.0 ORIENTATION\nCYCL DEF 13.1 ANGLE 90"},
        {"G38 *", "STOP"},
        {"G39 P01 \"B.I\" *", "CYCL DEF 12.0 PGM CALL\nCYCL DEF 12.1 PGM B.I"},
        {"G62 T0.05 P01 1 P02 5 *", "CYCL DEF 32.0 TOLERANCE\nCYCL DEF 32.1 T0.05\nCYCL DEF 32.2 HSC-MODE:1 TA5"}}},
      {"G53 P01; G54; G28; G73 H; G72 F; G80",
       {{"G53 P01 12 *", "CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 #12"},
        {"G54 G90 X+25 *", "CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+25"},
        {"G28 X Y *", "CYCL DEF 8.0 MIRROR IMAGE\nCYCL DEF 8.1 X Y"},
        {"G73 G90 H+35 *", "CYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 ROT+35"},
        {"G72 F0.75 *", "CYCL DEF 11.0 SCALING\nCYCL DEF 11.1 SCL 0.75"},
        {"G80 A+0 B+30 C+0 *", "CYCL DEF 19.0 WORKING PLANE\nCYCL DEF 19.1 A+0 B+30 C+0"}}},
      {"G247; G200 ...",
       {{"G247 Q339=+4 *", "CYCL DEF 247 DATUM SETTING ~\n Q339=+4"},
        {"G200 Q200=+2 *", "CYCL DEF 200 DRILLING ~\n Q200=+2"}}},
      {"G400 to G601, G1400 ...",
       {{"G421 Q273=+50 *", "TCH PROBE 421 MEASURE HOLE ~\n Q273=+50"},
        {"G601 Q301=+0 *", "TCH PROBE 601 LOCAL TOLERANCE ~\n Q301=+0"},
        {"G1410 Q1102=+0 *", "TCH PROBE 1410 PROBING ON EDGE ~\n Q1102=+0"}}},
      {"G55 P01 5 P02 X- P03 +5 P04 +0 P05 -5",
       {{"G55 P01 5 P02 X- P03 +5 P04 +0 P05 -5 *", "TCH PROBE 0.0 REF. PLANE Q5 X-\nTCH PROBE 0.1 X+5 Y+0 Z-5"}}},
      {"G79; M99, M89", {{"G79 *", "CYCL CALL"}, {"G00 X+5 M99 *", "L X+5 FMAX M99"}, {"M89 *", "M89"}}},
      {"G30, G31",
       {{"G30 G17 X+0 Y+0 Z-40 *", "BLK FORM 0.1 Z X+0 Y+0 Z-40"},
        {"G31 G90 X+9 Y+8 Z+0 *", "BLK FORM 0.2 X+9 Y+8 Z+0"}}},
      {"PLANE, FUNCTION, TRANS, PRESET, DECLARE, SQL, TABDATA, SEL CYCLE, OPEN FILE",
       {{"PLANE RESET STAY *", "PLANE RESET STAY"},
        {"FUNCTION RESET TCPM *", "FUNCTION RESET TCPM"},
        {"TRANS DATUM AXIS X+10 *", "TRANS DATUM AXIS X+10"},
        {"TABDATA READ Q1 = CORR-TCS COLUMN \"DR\" KEY \"3\" *", "TABDATA READ Q1 = CORR-TCS COLUMN \"DR\" KEY \"3\""},
        {"SEL CYCLE \"C.H\" *", "SEL CYCLE \"C.H\""}}},
  };
}

/// The first column of the table, in its order.
std::vector<std::string> documentedRows() {
  std::ifstream file(std::string(PROBEWRIGHT_SOURCE_DIR) + "/docs/din-iso.md");
  std::vector<std::string> rows;
  bool inTable = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("| DIN/ISO | Klartext")) {
      inTable = true;
    } else if (inTable && !line.starts_with("|")) {
      break;
    } else if (inTable && !line.starts_with("| ---")) {
      rows.push_back(line.substr(2, line.find(" | ") - 2));
    }
  }
  return rows;
}

TEST(DocumentedPairs, MeanTheSameInBothLanguages) {
  const auto all = examples();
  std::set<std::string> documented;
  for (const std::string& row : documentedRows()) {
    documented.insert(row);
    const auto found = all.find(row);
    if (found == all.end()) {
      ADD_FAILURE() << "no example of the row " << row;
      continue;
    }
    for (const Pair& pair : found->second) {
      // A name after % on the first line would be the head of the program.
      const std::string head = "BEGIN PGM 'A MM'\n";
      const std::string meant = resolvedText("%A G71 *\nG90 *\n" + pair.dinIso + "\n");
      ASSERT_TRUE(meant.starts_with(head)) << meant;
      EXPECT_EQ(meant.substr(head.size()), irOf(pair.klartext)) << pair.dinIso << " | " << pair.klartext;
    }
  }
  for (const auto& [row, pairs] : all)
    EXPECT_TRUE(documented.contains(row)) << "docs/din-iso.md has no row " << row;
}

}  // namespace
}  // namespace probewright::language::din_iso::testing
