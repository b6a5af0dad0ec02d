#include "session/convert.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "din_iso/resolved.hpp"
#include "klartext/ir_text.hpp"
#include "klartext/samples.hpp"

namespace probewright::language::din_iso::testing {
namespace {

using conversion::Conversion;
using klartext::testing::irOf;
using session::ProgramLanguage;
using ::testing::HasSubstr;

Conversion converted(const std::string& text, ProgramLanguage from, ProgramLanguage to) {
  const auto program = session::programOf("part", text, from);
  return conversion::convert(*program, from, to);
}
Conversion toDinIso(const std::string& text) {
  return converted(text, ProgramLanguage::Klartext, ProgramLanguage::DinIso);
}
Conversion toKlartext(const std::string& text) {
  return converted(text, ProgramLanguage::DinIso, ProgramLanguage::Klartext);
}

constexpr const char* klartextProgram =
    "0 BEGIN PGM PLATE MM\n"
    "1 ; front side\n"
    "2 * - presetting\n"
    "3 BLK FORM 0.1 Z X+0 Y+0 Z-40\n"
    "4 TOOL CALL \"PROBE\" Z S50 DL+0.1\n"
    "5 CYCL DEF 247 PRESETTING ~\n"
    "    Q339=+1 ;PRESET NUMBER\n"
    "6 L X+10 Y-5.5 R0 FMAX M3 ;above the hole\n"
    "7 L IX+5 Z+2 F500\n"
    "8 CC X+0 Y+0\n"
    "9 CP IPA+90 DR+\n"
    "10 CR X+20 Y+70 R-20 DR-\n"
    "11 Q1 = (Q2 + 3) * SIN (Q4)\n"
    "12 FN 9: IF +Q1 EQU +2 GOTO LBL \"END\"\n"
    "13 LBL 5\n"
    "14 TCH PROBE 421 MEASURE HOLE ~\n"
    "    Q273=+50 ;CENTER ~\n"
    "    Q274=-Q3\n"
    "15 CALL LBL 5 REP3\n"
    "16 CYCL DEF 7.0 DATUM SHIFT\n"
    "17 CYCL DEF 7.1 X+10\n"
    "18 CYCL DEF 7.2 IY+5\n"
    "19 TCH PROBE 0.0 REF. PLANE Q5 X-\n"
    "20 TCH PROBE 0.1 X+5 Y+0 Z-5\n"
    "21 LBL \"END\"\n"
    "22 END PGM PLATE MM\n";

constexpr const char* dinIsoProgram =
    "%PLATE G71 *\n"
    "N10 ; front side *\n"
    "N20 * - presetting *\n"
    "N30 G30 G17 G90 X+0 Y+0 Z-40 *\n"
    "N40 T\"PROBE\" G17 S50 DL+0.1 *\n"
    "N50 G247 PRESETTING ~\n"
    "    Q339=+1 ;PRESET NUMBER *\n"
    "N60 G00 G40 G90 X+10 Y-5.5 M3 ;above the hole *\n"
    "N70 G01 G91 X+5 G90 Z+2 F500 *\n"
    "N80 G90 I+0 J+0 *\n"
    "N90 G13 G91 H+90 *\n"
    "N100 G02 G90 X+20 Y+70 R-20 *\n"
    "N110 Q1 = (Q2 + 3) * SIN (Q4) *\n"
    "N120 D09 P01 +Q1 P02 +2 P03 \"END\" *\n"
    "N130 G98 L5 *\n"
    "N140 G421 MEASURE HOLE ~\n"
    "    Q273=+50 ;CENTER ~\n"
    "    Q274=-Q3 *\n"
    "N150 L5,3 *\n"
    "N160 G54 G90 X+10 G91 Y+5 *\n"
    "N170 G55 P01 5 P02 X- X+5 Y+0 Z-5 *\n"
    "N180 G98 L\"END\" *\n"
    "N99999999 %PLATE G71 *\n";

TEST(Convert, WritesRowsOfTablesWithoutASign) {
  const std::string inDinIso = toDinIso("0 BEGIN PGM P MM\n1 PRESET SELECT #3\n2 END PGM P MM\n").text;
  EXPECT_THAT(inDinIso, HasSubstr("N10 PRESET SELECT #3 *\n"));
  EXPECT_THAT(toKlartext(inDinIso).text, HasSubstr("1 PRESET SELECT #3\n"));
}

TEST(Convert, NamesBlocksOfFilesWithCarriageReturns) {
  const Conversion conversion =
      toDinIso("0 BEGIN PGM P MM\r\n1 CYCL DEF 1.0 PECKING\r\n2 CYCL DEF 1.1 SET UP 2\r\n3 END PGM P MM\r\n");
  ASSERT_EQ(conversion.notCarriedOver.size(), 1U);
  EXPECT_EQ(conversion.notCarriedOver[0].excerpt, "1 CYCL DEF 1.0 PECKING");
  EXPECT_THAT(conversion.text, HasSubstr("; NOT CARRIED OVER: 2 CYCL DEF 1.1 SET UP 2 *\n"));
  EXPECT_EQ(toDinIso("0 BEGIN PGM P MM\r\n1 ; one ~\r\ntwo ~\r\nthree\r\n2 END PGM P MM\r\n").text,
            "%P G71 *\nN10 ; one *\nN20 ; two *\nN30 ; three *\nN99999999 %P G71 *\n");
}

TEST(Convert, WritesKlartextInDinIso) {
  const Conversion conversion = toDinIso(klartextProgram);
  EXPECT_TRUE(conversion.mistakes.empty());
  EXPECT_TRUE(conversion.notCarriedOver.empty());
  EXPECT_EQ(conversion.text, dinIsoProgram);
}

TEST(Convert, WritesDinIsoInKlartext) {
  const Conversion conversion = toKlartext(dinIsoProgram);
  EXPECT_TRUE(conversion.mistakes.empty());
  EXPECT_TRUE(conversion.notCarriedOver.empty());
  EXPECT_EQ(irOf(conversion.text), irOf(klartextProgram));
  for (const char* comment :
       {"; front side\n", "* - presetting\n", ";above the hole\n", ";PRESET NUMBER\n", ";CENTER ~\n"})
    EXPECT_THAT(conversion.text, HasSubstr(comment));
  EXPECT_THAT(conversion.text, HasSubstr("TCH PROBE 421 MEASURE HOLE ~\n"));
}

TEST(Convert, SeparatesWhatKlartextWritesInSeveralBlocks) {
  const Conversion conversion = toKlartext("%A G71 *\nN10 G03 G90 X+45 Y+25 I+5 J+6 F200 M8 ;arc *\nN20 G91 *\n");
  EXPECT_EQ(conversion.text, "0 BEGIN PGM A MM\n1 CC X+5 Y+6\n2 C X+45 Y+25 DR+ F200 M8 ;arc\n");
}

TEST(Convert, NamesAndKeepsWhatHasNoTwin) {
  const Conversion conversion = toDinIso(
      "0 BEGIN PGM A MM\n1 APPR LT X+1 Y+2 LEN5 RL F100\n2 L X+1 FMAX\n3 TCH PROBE 3.0 MEASURE\n"
      "4 TCH PROBE 3.1 Q1\n5 TCH PROBE 3.2 X ANGLE: +0\n6 TCH PROBE 3.3 DIST +10 F100 MB1\n7 END PGM A MM\n");
  EXPECT_TRUE(conversion.mistakes.empty());
  ASSERT_EQ(conversion.notCarriedOver.size(), 2U);
  EXPECT_EQ(conversion.notCarriedOver[0].place.line, 2U);
  EXPECT_EQ(conversion.notCarriedOver[0].message, "APPR has no twin in DIN/ISO");
  EXPECT_EQ(conversion.notCarriedOver[1].place.line, 4U);
  EXPECT_EQ(conversion.text,
            "%A G71 *\nN10 ; NOT CARRIED OVER: 1 APPR LT X+1 Y+2 LEN5 RL F100 *\nN20 G00 G90 X+1 *\n"
            "N30 ; NOT CARRIED OVER: 3 TCH PROBE 3.0 MEASURE *\nN40 ; NOT CARRIED OVER: 4 TCH PROBE 3.1 Q1 *\n"
            "N50 ; NOT CARRIED OVER: 5 TCH PROBE 3.2 X ANGLE: +0 *\n"
            "N60 ; NOT CARRIED OVER: 6 TCH PROBE 3.3 DIST +10 F100 MB1 *\nN99999999 %A G71 *\n");
}

/// Statements that DIN/ISO programs write as Klartext does.
TEST(Convert, KeepsWhatIsTheSameInBoth) {
  for (const std::string block :
       {"PRESET CORR X+1", "DECLARE POSITION P1", "SQL BIND Q5 \"T.N\"", "SEL CYCLE \"C.H\"",
        "TABDATA READ Q1 = CORR-TCS COLUMN \"DR\" KEY \"3\"", "ERROR = \"E\"", "FUNCTION RESET TCPM"}) {
    const Conversion conversion = toDinIso("0 BEGIN PGM A MM\n1 " + block + "\n2 END PGM A MM\n");
    EXPECT_TRUE(conversion.notCarriedOver.empty()) << conversion.text;
    EXPECT_THAT(conversion.text, HasSubstr("N10 " + block + " *\n"));
  }
}

/// Values for the PLC and for the printer stand behind P01, P02... in DIN/ISO, between slashes in Klartext.
TEST(Convert, GivesListsOfValuesTheFormOfTheLanguage) {
  const std::pair<const char*, const char*> twins[] = {
      {"D19 P01 +1", "FN 19: PLC=+1"},
      {"D19 P01 +10 P02 +Q3", "FN 19: PLC=+10/+Q3"},
      {"D29 P01 +1 P02 -Q2 P03 +4 P04 +5 P05 +6 P06 +7 P07 +8 P08 -9.5", "FN 29: PLC=+1/-Q2/+4/+5/+6/+7/+8/-9.5"}};
  for (const auto& [dinIso, klartext] : twins) {
    const Conversion there = toKlartext("%A G71 *\nN10 " + std::string(dinIso) + " *\nN99 %A G71 *\n");
    EXPECT_EQ(there.text, "0 BEGIN PGM A MM\n1 " + std::string(klartext) + "\n2 END PGM A MM\n");
    EXPECT_TRUE(there.notCarriedOver.empty());
    const Conversion back = toDinIso("0 BEGIN PGM A MM\n1 " + std::string(klartext) + "\n2 END PGM A MM\n");
    EXPECT_EQ(back.text, "%A G71 *\nN10 " + std::string(dinIso) + " *\nN99999999 %A G71 *\n");
    EXPECT_TRUE(back.notCarriedOver.empty());
  }
  EXPECT_THAT(toKlartext("%A G71 *\nN10 D15 P01 1 P02 +Q1 *\nN99 %A G71 *\n").text, HasSubstr("FN 15: PRINT +1/+Q1\n"));
  EXPECT_THAT(toKlartext("%A G71 *\nN10 D15 P01 20 *\nN99 %A G71 *\n").text, HasSubstr("FN 15: PRINT 20\n"));
  // P02 is an address only where it stands by itself: names, paths and texts may hold these letters.
  const std::pair<const char*, const char*> printed[] = {
      {"1P02+Q1", "+1/+Q1"},  {"Q1P02-2.5P03+3", "+Q1/-2.5/+3"}, {"Q5/GRP02", "Q5/GRP02"},
      {"LOG/P02", "LOG/P02"}, {"\"A P02 +1\"", "\"A P02 +1\""},  {"Q5 ; P02", "Q5"}};
  for (const auto& [dinIso, klartext] : printed) {
    const Conversion there = toKlartext("%A G71 *\nN10 D15 P01 " + std::string(dinIso) + " *\nN99 %A G71 *\n");
    EXPECT_THAT(there.mistakes, ::testing::IsEmpty()) << dinIso;
    EXPECT_THAT(there.text, HasSubstr("FN 15: PRINT " + std::string(klartext))) << dinIso;
  }
  // The older form of the same, and what neither language has.
  EXPECT_THAT(toKlartext("%A G71 *\nN10 D19: PLC = +10 / +Q3 *\nN99 %A G71 *\n").text,
              HasSubstr("FN 19: PLC=+10/+Q3\n"));
  for (const char* wrong : {"D19 +1", "D19 P01 +1 P02", "D19 P01 +1 P03 +2", "D19 P01 +1 P02 +2 P03 +3", "D29 P01 X"})
    EXPECT_EQ(toKlartext("%A G71 *\nN10 " + std::string(wrong) + " *\nN99 %A G71 *\n").mistakes.size(), 1U) << wrong;
  for (const char* wrong : {"FN 19: PLC", "FN 19: PLC=", "FN 19: PLC=+1/", "FN 19: PLC=+1/+2/+3", "FN 29: PLC +1"})
    EXPECT_EQ(toDinIso("0 BEGIN PGM A MM\n1 " + std::string(wrong) + "\n2 END PGM A MM\n").mistakes.size(), 1U)
        << wrong;
}

TEST(Convert, WarnsWhereTheOrderOfTheRunDecides) {
  const Conversion conversion = toKlartext(
      "%A G71 *\nN10 G00 G90 X+0 *\nN20 G91 *\nN30 L1 *\nN40 G00 G90 X+1 *\nN50 M30 *\nN60 G98 L1 *\nN70 X+5 *\n"
      "N80 X+6 *\nN90 G98 L0 *\nN99 %A G71 *\n");
  ASSERT_EQ(conversion.notCarriedOver.size(), 1U);
  EXPECT_EQ(conversion.notCarriedOver[0].place.line, 8U);
  EXPECT_EQ(conversion.notCarriedOver[0].message,
            "this block takes the path function and G90 or G91 from the block that runs before it");
}

TEST(Convert, MistakesAreNamed) {
  EXPECT_EQ(toKlartext("%A G71 *\nN10 G01 X+ *\n").mistakes.size(), 1U);
  EXPECT_EQ(toDinIso("0 BEGIN PGM A MM\n1 L X+\n").mistakes.size(), 1U);
}

/// The lines of a program's instructions without those that the messages name, in order.
std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> found;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    // A path without axes does nothing and may be left out.
    found.push_back(std::regex_replace(text.substr(at, end - at), std::regex("\\| Linear$"), "|"));
    if (found.back().ends_with(" |")) found.back().resize(found.back().size() - 2);
    at = end + 1;
  }
  return found;
}

/// There and back again: every block that was carried over does what it did.
TEST(Convert, ThereAndBackKeepsWhatTheBlocksDo) {
  std::size_t carried = 0;
  for (const std::string_view each : klartext::testing::samples) {
    // Tool cycles of the old form come back as 480 to 483.
    const std::string sample =
        std::regex_replace(std::string(each), std::regex("\\d+ TCH PROBE 3[0-3]\\.\\d[^\n]*\n"), "");
    const Conversion there = toDinIso(sample);
    if (hasErrors(there.mistakes)) continue;
    const Conversion back = toKlartext(there.text);
    for (const Diagnostic& mistake : back.mistakes)
      ADD_FAILURE() << format(mistake) << "\n" << there.text;
    // Blocks without a twin are missing, and nothing else is.
    std::vector<std::string> before = lines(irOf(sample));
    const std::vector<std::string> after = lines(irOf(back.text));
    std::size_t at = 0;
    std::size_t missing = 0;
    for (const std::string& line : before) {
      if (at < after.size() && after[at] == line) {
        ++at;
        ++carried;
      } else {
        ++missing;
      }
    }
    EXPECT_EQ(at, after.size()) << "changed: " << (at < after.size() ? after[at] : "") << "\n" << there.text;
    EXPECT_LE(missing, there.notCarriedOver.size()) << there.text << back.text;
  }
  EXPECT_GT(carried, 60U);
}

}  // namespace
}  // namespace probewright::language::din_iso::testing
