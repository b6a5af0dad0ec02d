#include <gtest/gtest.h>

#include <cctype>

#include "base/text.hpp"
#include "klartext/ir_text.hpp"
#include "klartext/samples.hpp"
#include "language/klartext/program.hpp"

namespace probewright::language::klartext::testing {
namespace {

/// The text with each character that is neither in quotation marks nor in a comment passed through `change`.
template <class Change>
std::string changed(std::string_view text, const Change& change) {
  std::string out;
  bool inText = false, inComment = false;
  for (const char c : text) {
    if (c == '"' && !inComment) inText = !inText;
    inComment = c != '\n' && (inComment || (c == ';' && !inText));
    if (inText || inComment)
      out += c;
    else
      change(c, out);
  }
  return out;
}

/// Texts that blocks keep as they are written: capitals, one blank for several.
std::string alike(const std::string& text) {
  std::string out;
  for (const char c : upperCase(text)) {
    if (!isBlank(c))
      out += c;
    else if (out.empty() || out.back() != ' ')
      out += ' ';
  }
  return out;
}

TEST(Blocks, WordsAreMetInEitherCaseAndWithAnyBlanks) {
  for (const std::string_view sample : samples) {
    const std::string asWritten = alike(irOf(std::string(sample)));
    const std::string lower = changed(sample, [](char c, std::string& out) {
      out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    });
    EXPECT_EQ(alike(irOf(lower)), asWritten);
    const std::string wide =
        changed(sample, [](char c, std::string& out) { out += c == ' ' ? " \t " : std::string(1, c); });
    EXPECT_EQ(alike(irOf(wide)), asWritten);
  }
}

TEST(Blocks, FrameCommentsAndStructure) {
  EXPECT_EQ(irOf("0 BEGIN PGM RING MM\n1 ; comment\n2 * - structure\n\n3\n4 END PGM RING MM\n"),
            "BEGIN PGM 'RING MM'\nEndProgram");
  EXPECT_EQ(irOf("BLK FORM 0.1 Z X+0 Y+0 Z-20"), "BLK FORM '0.1 Z X+0 Y+0 Z-20'");
  EXPECT_EQ(irOf("5 ; a remark ~\nthat goes on ~\nand on\n6 L X+1"), "Linear X=1");
}

TEST(Blocks, UnitOfTheProgram) {
  EXPECT_EQ(KlartextProgram("a.h", "0 BEGIN PGM A INCH\n").unit(), Unit::Inch);
  EXPECT_EQ(KlartextProgram("a.h", "; hello\n0  BEGIN PGM A MM\n").unit(), Unit::Millimetre);
  EXPECT_EQ(KlartextProgram("a.h",
                            "\xEF\xBB\xBF"
                            "0 BEGIN PGM A INCH\n")
                .unit(),
            Unit::Inch);
}

TEST(Blocks, ErrorBlocksAreKept) { EXPECT_EQ(irOf("4 ERROR = L X+Y"), "ERROR 'L X+Y'"); }

TEST(Blocks, ToolCalls) {
  EXPECT_EQ(irOf("1 TOOL CALL 5 Z S2500 F350 DL+0.2 DR-1 DR2+0.05"),
            "Tool number=5 axis=Z S=2500 F=350 DL=0.2 DR=-1 DR2=0.05");
  EXPECT_EQ(irOf("TOOL CALL 5.2 Z"), "Tool number=5 index=2 axis=Z");
  EXPECT_EQ(irOf("TOOL CALL \"TASTER 1\" Z"), "Tool name='TASTER 1' axis=Z");
  EXPECT_EQ(irOf("TOOL CALL QS3 Z SQ1"), "Tool name=QS3 axis=Z S=Q1");
  EXPECT_EQ(irOf("TOOL CALL Q3 Z"), "Tool number=Q3 axis=Z");
  EXPECT_EQ(irOf("TOOL CALL S500"), "Tool S=500");
  EXPECT_EQ(irOf("TOOL CALL DL-0.1"), "Tool DL=-0.1");
  EXPECT_EQ(irOf("TOOL DEF 4 L+10 R+3"), "TOOL DEF T=4 L=10 R=3");
}

TEST(Blocks, LabelsAndCalls) {
  EXPECT_EQ(irOf("LBL 12"), "Label '12'");
  EXPECT_EQ(irOf("LBL \"Probe\""), "Label 'Probe'");
  EXPECT_EQ(irOf("LBL 0"), "Label '0' end");
  EXPECT_EQ(irOf("CALL LBL 03 REP5"), "CallLabel '3' rep 5");
  EXPECT_EQ(irOf("CALL LBL \"Probe\""), "CallLabel 'Probe'");
  EXPECT_EQ(irOf("CALL LBL 1 REP 2/2"), "CallLabel '1' rep 2");
  EXPECT_EQ(irOf("CALL LBL QS4 REPQ2"), "CallLabel QS4 rep Q2");
  EXPECT_EQ(irOf("CALL PGM TNC:\\sub\\35K47.H ; next"), "CallProgram 'TNC:\\sub\\35K47.H'");
  EXPECT_EQ(irOf("CALL PGM \"A B.H\""), "CallProgram 'A B.H'");
  EXPECT_EQ(irOf("SEL PGM \"X.H\""), "SEL PGM 'X.H'");
  EXPECT_EQ(irOf("CALL SELECTED PGM"), "CallProgram SELECTED PGM()");
  EXPECT_EQ(irOf("SEL TABLE \"TNC:\\zero.d\""), "SEL TABLE 'TNC:\\zero.d'");
}

TEST(Blocks, LabelsAreFound) {
  KlartextProgram program("a.h", "0 BEGIN PGM A MM\n1 LBL 5\n2 L X+1\n3 LBL \"End\"\n4 CALL LBL 05\n");
  const auto five = program.findLabel("05", {}, JumpDirection::Any);
  ASSERT_TRUE(five);
  EXPECT_EQ(five->line, 2U);
  EXPECT_EQ(program.findLabel("End", {}, JumpDirection::Any)->line, 4U);
  EXPECT_FALSE(program.findLabel("6", {}, JumpDirection::Any));
}

/// A name of digits is another label than the number, and keeps its leading zeros.
TEST(Blocks, NamesOfDigitsAreNoNumbers) {
  KlartextProgram program("a.h", "0 BEGIN PGM A MM\n1 LBL 5\n2 LBL \"5\"\n3 LBL \"007\"\n4 LBL \"0\"\n");
  EXPECT_EQ(program.findLabel("5", {}, JumpDirection::Any)->line, 2U);
  EXPECT_EQ(program.findLabel("\"5\"", {}, JumpDirection::Any)->line, 3U);
  EXPECT_EQ(program.findLabel("\"007\"", {}, JumpDirection::Any)->line, 4U);
  EXPECT_EQ(program.findLabel("007", {}, JumpDirection::Any)->line, 4U);  // of a QS parameter
  EXPECT_EQ(irOf("LBL \"5\""), "Label '\"5\"'");
  EXPECT_EQ(irOf("CALL LBL \"0\""), "CallLabel '\"0\"'");
}

TEST(Blocks, Functions) {
  EXPECT_EQ(irOf("FN 0: Q5 = +60"), "Q5 := 60");
  EXPECT_EQ(irOf("FN1 :Q1 = -Q2 + -5"), "Q1 := (-Q2+-5)");
  EXPECT_EQ(irOf("FN 2  Q1 = +10 - +5"), "Q1 := (10-5)");
  EXPECT_EQ(irOf("FN 4: Q4 = +8 DIV +Q2"), "Q4 := (8/Q2)");
  EXPECT_EQ(irOf("FN 13: Q20 = +25 ANG-Q1"), "Q20 := ANG(25,-Q1)");
  EXPECT_EQ(irOf("FN 9: IF +Q1 EQU +Q3 GOTO LBL \"SPCAN25\""), "Jump 'SPCAN25' if (Q1==Q3)");
  EXPECT_EQ(irOf("FN 9: IF +Q5 IS UNDEFINED GOTO LBL 3"), "Jump '3' if undefined(Q5)");
  EXPECT_EQ(irOf("FN 11: IF +Q1 GT +10 GOTO LBL QS5"), "Jump QS5 if (Q1>10)");
  EXPECT_EQ(irOf("FN 12: IF +Q1 LT -2 GOTO LBL 5"), "Jump '5' if (Q1<-2)");
  EXPECT_EQ(irOf("FN 14: ERROR = 254"), "FN14 0=254");
  EXPECT_EQ(irOf("FN 16: F-PRINT TNC:\\MASK.A / TNC:\\PROT.TXT"), "FN16 'TNC:\\MASK.A / TNC:\\PROT.TXT'");
  EXPECT_EQ(irOf("FN 17: SYSWRITE ID 990 NR 6 IDX 1 = +5"), "FN17 ID=990 NR=6 IDX=1 VAL=5");
  EXPECT_EQ(irOf("FN18 : SYSREAD Q25 = ID210 NR4 IDX3"), "FN18 -> Q25 ID=210 NR=4 IDX=3");
  EXPECT_EQ(irOf("FN 23: Q20 = CDATA Q30"), "FN23 -> Q20 0=30");
  EXPECT_EQ(irOf("FN 25: PRESET = X/+Q1/+0"), "FN25 X=Q1 VAL=0");
  EXPECT_EQ(irOf("FN 26: TABOPEN TNC:\\T.TAB"), "FN26 'TNC:\\T.TAB'");
  EXPECT_EQ(irOf("FN 27: TABWRITE 5/\"R,D\" = Q5"), "FN27 'R,D' -> Q5 0=5");
  EXPECT_EQ(irOf("FN 28: TABREAD Q10 = 6/\"X,Y\""), "FN28 'X,Y' -> Q10 0=6");
}

TEST(Blocks, Formulas) {
  EXPECT_EQ(irOf("Q1 = 5 * 3 + 2 * 10"), "Q1 := ((5*3)+(2*10))");
  EXPECT_EQ(irOf("Q1 = 10 - 3 - 2"), "Q1 := ((10-3)-2)");
  EXPECT_EQ(irOf("Q1 = -3 ^ 2 + 400 % 360"), "Q1 := ((-3^2)+(400%360))");
  EXPECT_EQ(irOf("Q1 = -Q2 ^ 2 ^ -SIN Q3"), "Q1 := (-Q2^(2^-f0(Q3)))");
  EXPECT_EQ(irOf("QL1=(Q2+Q3)/-2"), "QL1 := ((Q2+Q3)/-2)");
  EXPECT_EQ(irOf("QS3 = QS1 || \"mm\" || TOCHAR( DAT+Q5 DECIMALS3 )"), "QS3 := ((QS1||'mm')||TOCHAR(Q5,3))");
  EXPECT_EQ(irOf("QS3 = SUBSTR( SRC_QS10 BEG2 LEN4 )"), "QS3 := SUBSTR(QS10,2,4)");
  EXPECT_EQ(irOf("Q3 = INSTR( SRC_QS10 SEA_QS13 )"), "Q3 := INSTR(QS10,QS13,0)");
  EXPECT_EQ(irOf("DECLARE STRING QS1 = \"A;B\""), "QS1 := 'A;B'");
  EXPECT_EQ(irOf("Q1 = (2 + 3"), "1:12: ')' is expected after the expression in parentheses");
  EXPECT_EQ(irOf("Q1 = "), "1:6: a number, a parameter, a function or a parenthesis is expected in this formula");
}

TEST(Blocks, Planes) {
  EXPECT_EQ(irOf("PLANE SPATIAL SPA+27 SPB+0 SPC+45 MOVE DIST50 F1000 SEQ- COORD ROT"),
            "Transform PLANE SPATIAL SPA=27 SPB=0 SPC=45 MOVE DIST=50 F=1000 SEQ=-1 COOR");
  EXPECT_EQ(irOf("PLANE PROJECTED PROPR+24 PROMIN+24 ROT+30 TURN MB MAX FMAX"),
            "Transform PLANE PROJECTED PROP=24 PROM=24 ROT=30 TURN MB FMAX");
  EXPECT_EQ(irOf("PLANE EULER EULPR45 EULNU20 EULROT22 STAY"), "Transform PLANE EULER EULP=45 EULN=20 EULR=22 STAY");
  EXPECT_EQ(irOf("PLANE VECTOR BX0.8 BY-0.4 BZ-0.4 NX0.2 NY0.2 NZ0.92 STAY"),
            "Transform PLANE VECTOR BX=0.8 BY=-0.4 BZ=-0.4 NX=0.2 NY=0.2 NZ=0.92 STAY");
  EXPECT_EQ(irOf("PLANE RELATIV SPB-45 STAY"), "Transform PLANE RELATIVE SPB=-45 STAY");
  EXPECT_EQ(irOf("PLANE AXIAL B-45 C+Q2 TURN F500"), "Transform PLANE AXIAL B=-45 C=Q2 TURN F=500");
  EXPECT_EQ(irOf("PLANE RESET TURN FMAX"), "Transform PLANE RESET TURN FMAX");
  EXPECT_EQ(irOf("TRANS DATUM AXIS X+10 IY+25"), "Transform TRANS DATUM AXIS X=10 IY=25");
  EXPECT_EQ(irOf("TRANS DATUM TABLE TABLINE25"), "Transform TRANS DATUM TABLE #=25");
  EXPECT_EQ(irOf("TRANS DATUM RESET"), "Transform TRANS DATUM RESET");
  EXPECT_EQ(irOf("FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS"), "Modal FUNCTION TCPM F=1 AXIS=1 PATH=1");
  EXPECT_EQ(irOf("FUNCTION RESET TCPM"), "Modal FUNCTION RESET TCPM");
  EXPECT_EQ(irOf("FUNCTION MODE MILL"), "FUNCTION 'MODE MILL'");
}

}  // namespace
}  // namespace probewright::language::klartext::testing
