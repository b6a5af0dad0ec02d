#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "execution/din_iso/host.hpp"
#include "klartext/expectations.hpp"
#include "klartext/host_world.hpp"
#include "language/din_iso/program.hpp"
#include "language/klartext/check.hpp"

/// Programs as CAM systems and setters write them: they pass the check and run to their end.
namespace probewright::language::klartext::testing {

using namespace execution;
using namespace execution::klartext;
namespace {

using control::ControlKind;
using control::EventKind;

struct Sample {
  const char* name;
  const char* machine;
  ControlKind kind;
  const char* text;
  Vector3 end;  ///< the tip at the end, in machine coordinates of preset 0
};

const std::array samples = {
    Sample{"a contour as a CAM system leaves it",
           "mill3",
           ControlKind::TNC640,
           R"(BEGIN PGM 1001 MM
;--- generated 2024-05-14
BLK FORM 0.1 Z X-50. Y-50. Z-20.
BLK FORM 0.2 X50. Y50. Z0.
* - D10 END MILL
TOOL CALL 5 Z S8000 F2400 DL+0. DR+0.
TOOL DEF 1
M3
CYCL DEF 32.0 TOLERANCE
CYCL DEF 32.1 T0.02
CYCL DEF 32.2 HSC-MODE:1 TA0.5
L X-60. Y-30. R0 FMAX M13
L Z+50. R0 FMAX
L Z+2. R0 FMAX
L Z-5. F600
APPR LCT X-40. Y-30. R5. RL F2400
L X+40.
RND R5. F1200
L Y+30.
CHF 3.
L X-40.
CR X-40. Y-30. R+60. DR+
DEP LCT X-60. Y-30. R5.
L Z+50. R0 FMAX
M140 MB MAX
M9
L X+0. Y+0. R0 FMAX M5
END PGM 1001 MM
)",
           {0, 0, 0}},
    Sample{"five axes with PLANE and a retract",
           "mill5-head-table",
           ControlKind::TNC640,
           R"(0  BEGIN PGM PLANE_JOB MM
1  BLK FORM CYLINDER Z R50 L100
2  TOOL CALL 1 Z S50
3  M129
4  M126
5  CYCL DEF 247 PRESET ~
    Q339=+0    ;PRESET NUMBER
6  L  Z+200 R0 FMAX M91
7  CALL LBL 100
8  CYCL DEF 7.0 DATUM SHIFT
9  CYCL DEF 7.1  X+10
10 CYCL DEF 7.2  IY+5
11 CYCL DEF 7.3  Z-2.5
12 PLANE SPATIAL SPA+0 SPB+30 SPC+45 TURN MB50 FMAX SEQ- TABLE ROT
13 L  X+0  Y+0 R0 FMAX
14 L  Z+10 R0 FMAX
15 PLANE RELATIV SPB-30 TURN F9999
16 CALL LBL 100
17 L  X+5 Y+6 Z+150 R0 FMAX
18 STOP M5
19 M30
20 LBL 100 ; reset
21 PLANE RESET TURN F9999
22 CYCL DEF 7.0 DATUM SHIFT
23 CYCL DEF 7.1  X+0
24 CYCL DEF 7.2  Y+0
25 CYCL DEF 7.3  Z+0
26 LBL 0
27 END PGM PLANE_JOB MM
)",
           {5, 6, 150}},
    Sample{"simultaneous five axes",
           "mill5-table-table",
           ControlKind::TNC640,
           R"(0 BEGIN PGM SWARF MM
1 TOOL CALL "MILL" Z S12000 F3000
2 L M3
3 FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS REFPNT TIP-TIP F5000
4 L X+0 Y+0 Z+100 A+0 C+0 R0 FMAX
5 L X+1.25 Y-0.5 Z+40.1 A-2.5 C+10.125 F3000 M8
6 L X+2.5 Y-1 Z+40.05 A-5 C+20.25
7 LN X+3.75 Y-1.5 Z+40 NX0.0871 NY0 NZ0.9962 TX0.1736 TY0 TZ0.9848
8 L A+0 C+0 Z+100 FMAX
9 FUNCTION RESET TCPM
10 FUNCTION MODE MILL
11 L X+0 Y+0 R0 FMAX M9
12 END PGM SWARF MM
)",
           {0, 0, 100}},
    Sample{"label loops, texts and a log",
           "mill3",
           ControlKind::TNC640,
           R"(0 BEGIN PGM LOG MM
1 TOOL CALL 1 Z
2 DECLARE STRING QS10 = "PART-"
3 QS11 = QS10 || TOCHAR( DAT+17 DECIMALS0 )
4 Q50 = STRLEN( SRC_QS11 )
5 Q51 = INSTR( SRC_QS11 SEA_QS10 BEG0 )
6 FN 0: Q1 = +0 ;COUNTER
7 LBL "LOOP"
8 FN 1: Q1 = +Q1 + +1
9 FN 3: Q2 = +Q1 * +12.5
10 L X+Q2 Y-Q2 R0 FMAX
11 FN 18: SYSREAD Q3 = ID270 NR1 IDX1
12 FN 16: F-PRINT MASK.A / TNC:\LOG\:'QS11':.TXT
13 FN 12: IF +Q1 LT +3 GOTO LBL "LOOP"
14 FN 9: IF +Q50 EQU +7 GOTO LBL 7
15 FN 14: ERROR = 1000
16 LBL 7
17 CALL LBL 2 REP3
18 LBL 2
19 L IX+1 IY+0.5 R0 FMAX
20 CALL LBL 2 REP3/3
21 L Z+25 R0 FMAX
22 END PGM LOG MM
)",
           {41.5, -35.5, 25}},
    Sample{"a pattern with a program at each point",
           "mill3",
           ControlKind::TNC640,
           R"(0 BEGIN PGM PATT MM
1 TOOL CALL 1 Z S100
2 PATTERN DEF ~
  POS1 (X+10 Y+10 Z+0) ~
  ROW1 (X+30 Y+10 D+15 NUM3 ROT+0 Z+0) ~
  CIRC1 (X+0 Y+0 D+40 START+45 NUM4 Z+0)
3 SEL CYCLE "POINT.H"
4 CYCL CALL PAT FMAX
5 CYCL CALL POS X+1 Y+2 Z+3 FMAX
6 CYCL DEF 12.0 PGM CALL
7 CYCL DEF 12.1 PGM POINT.H
8 L X+70 Y+0 R0 FMAX M99
9 L Z+60 R0 FMAX
10 END PGM PATT MM
)",
           {0, 0, 60}},
    Sample{"datum tables and transformations",
           "mill3",
           ControlKind::TNC640,
           R"(0 BEGIN PGM DATUMS MM
1 TOOL CALL 1 Z
2 SEL TABLE "TNC:\PARTS\NULL.D"
3 CYCL DEF 7.0 NULLPUNKT
4 CYCL DEF 7.1 #2
5 L X+0 Y+0 Z+0 R0 FMAX
6 TRANS DATUM TABLE TABLINE 1 "NULL.D"
7 TRANS ROTATION ROT+90
8 L X+10 Y+0 R0 FMAX
9 TRANS ROTATION RESET
10 TRANS MIRROR AXIS Y
11 TRANS SCALE SCL0.5
12 L X+10 Y+10 R0 FMAX
13 TRANS SCALE RESET
14 TRANS MIRROR RESET
15 TRANS DATUM RESET
16 L X+1 Y+1 Z+1 R0 FMAX
17 END PGM DATUMS MM
)",
           {1, 1, 1}},
    Sample{"an older control in inches",
           "mill3",
           ControlKind::iTNC530,
           R"(0 BEGIN PGM 4711 INCH
1 BLK FORM 0.1 Z X-1 Y-1 Z-1
2 BLK FORM 0.2 X+1 Y+1 Z+0
3 TOOL CALL 5 Z S2500
4 L Z+4 R0 F MAX M3
5 L X+1,5 Y-0,25 R0 F MAX
6 CC X+0 Y-0,25
7 CP IPA-360 IZ-0,1 DR- R0 F20 M8
8 FN 15: PRINT Q1/Q2
9 L Z+4 F MAX M9
10 M2
11 END PGM 4711 INCH
)",
           {38.1, -6.35, 101.6}},
    Sample{"polar coordinates, CT and tilted with cycle 19",
           "mill5-head-table",
           ControlKind::iTNC530,
           R"(0 BEGIN PGM OLD5 MM
1 TOOL CALL 5 Z S1000 F500
2 L Z+100 R0 FMAX M3
3 CC X+20 Y+20
4 LP PR+30 PA+0 R0 FMAX
5 CP IPA+90 DR+ F500
6 CTP PR+40 PA+135
7 CT X-20 Y+20
8 CYCL DEF 19.0 WORKING PLANE
9 CYCL DEF 19.1 A+0 B+20 C+0 F2000
10 L B+Q121 C+Q122 R0 FMAX
11 L X+0 Y+0 R0 FMAX
12 CYCL DEF 19.0 WORKING PLANE
13 CYCL DEF 19.1 A+0 B+0 C+0
14 L B+0 C+0 R0 FMAX
15 CYCL DEF 19.0 WORKING PLANE
16 CYCL DEF 19.1
17 L X+3 Y+4 Z+120 R0 FMAX M94
18 END PGM OLD5 MM
)",
           {3, 4, 120}},
};

void supply(World& world) {
  world.files["MASK.A"] = "M_APPEND;\n\"%S X=%+8.3LF %02d.%02d.%4d\", QS11, Q3, DAY, MONTH, YEAR4;\nM_CLOSE;\n";
  world.files["NULL.D"] =
      "BEGIN NULL.D MM\nD   X         Y         Z         A         B         C         \n"
      "1   +100.000  +50.000   +0.000    +0.000    +0.000    +0.000    \n"
      "2   -20.000   +0.000    +5.000    +0.000    +0.000    +0.000    \n[END]\n";
  world.library.texts["POINT.H"] = "0 BEGIN PGM POINT MM\n1 L X+0 Y+0 R0 FMAX\n2 L Z+5 FMAX\n3 END PGM POINT MM\n";
}

TEST(ShopPrograms, PassTheCheckAndRun) {
  for (const Sample& sample : samples) {
    KlartextProgram program("main.h", sample.text);
    for (const Diagnostic& diagnostic : checkProgram(program, sample.kind))
      EXPECT_NE(diagnostic.severity, Severity::Error) << sample.name << "\n" << format(diagnostic);
    World world(sample.machine, sample.kind);
    supply(world);
    const RunResult result = world.run(sample.text);
    EXPECT_EQ(result.end, RunEnd::Finished) << sample.name;
    for (const Diagnostic& diagnostic : result.diagnostics)
      ADD_FAILURE() << sample.name << "\n" << format(diagnostic);
    const Vector3 tip = world.control->channel.machineFromAxes(world.control->channel.axes()).vector();
    EXPECT_NEAR(tip.x(), sample.end.x(), 1e-6) << sample.name;
    EXPECT_NEAR(tip.y(), sample.end.y(), 1e-6) << sample.name;
    // M140 MB MAX of the first one ends at the limit of travel.
    if (sample.end.z() != 0) {
      EXPECT_NEAR(tip.z(), sample.end.z(), 1e-6) << sample.name;
    }
  }
}

TEST(ShopPrograms, ALogHoldsALineForEachRound) {
  World world;
  supply(world);
  expectFinished(world.run(samples[3].text));
  const std::string& log = world.control->panel.files().at("PART-17.TXT");
  EXPECT_THAT(log, ::testing::StartsWith("PART-17 X= +12.500 "));
  EXPECT_EQ(std::ranges::count(log, '\n'), 3);
}

/// The same ways in DIN/ISO, without decimals that end in a point.
TEST(ShopPrograms, DinIsoProgramsRunAsTheyAreWritten) {
  struct Case {
    const char* text;
    Vector3 end;
  };
  for (const Case& each : {Case{R"(%1002 G71 *
N10 G30 G17 X-50 Y-50 Z-20 *
N20 G31 G90 X+50 Y+50 Z+0 *
N30 T5 G17 S5000 F1500 *
N40 G00 G40 G90 Z+100 M3 *
N50 X-60 Y-30 *
N60 G01 Z-5 F600 *
N70 G41 X-40 Y-30 F1500 *
N80 G26 R5 *
N90 X+40 *
N100 G25 R5 *
N110 Y+30 *
N120 G24 R3 *
N130 X-40 *
N140 G03 X-40 Y-30 R+60 *
N150 G27 R5 *
N160 G01 G40 X-60 *
N170 G00 Z+100 M9 *
N180 L1,0 *
N200 G98 L2 *
N210 G91 Y+1 *
N220 L2,2 *
N230 G90 X+0 M2 *
N240 G98 L1 *
N250 G00 G90 Y+10 Z+50 *
N260 G98 L0 *
N99999999 %1002 G71 *
)",
                                {0, 13, 50}},
                           Case{R"(%POLAR G71 *
T1 G17 S100 *
G00 G40 G90 Z+20 *
I+10 J+20 *
G10 R+30 H+0 *
G13 G91 H+90 F500 *
G90 *
D00 Q1 P01 +5 *
D01 Q1 P01 +Q1 P02 +2.5 *
D09 P01 +Q1 P02 +7.5 P03 5 *
D14 P01 1000 *
G98 L5 *
G54 X+Q1 Y+0 *
G00 X+0 Y+0 Z+30 *
G54 X+0 Y+0 *
G73 G90 H+90 *
X+10 Y+0 *
G73 H+0 *
G04 F0.5 *
N99999999 %POLAR G71 *
)",
                                {0, 10, 30}}}) {
    World world;
    const auto program = std::make_shared<din_iso::DinIsoProgram>("main.i", each.text);
    for (const Diagnostic& diagnostic : checkProgram(*program, ControlKind::TNC640))
      EXPECT_NE(diagnostic.severity, Severity::Error) << format(diagnostic);
    KlartextHost klartext(*world.control, world.options);
    execution::din_iso::DinIsoHost host(klartext);
    expectFinished(Interpreter(world.library, host).run(program));
    const Vector3 tip = world.control->channel.machineFromAxes(world.control->channel.axes()).vector();
    EXPECT_TRUE(near(tip, each.end, 1e-6)) << each.text;
  }
}

}  // namespace
}  // namespace probewright::language::klartext::testing
