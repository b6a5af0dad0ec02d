#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "cycles_heidenhain/worlds.hpp"

/// Probing programs as CAM systems and setters write them, with all their habits: they run to their end on both
/// controls, find what is planted, and nothing in them is skipped.
namespace probewright::testing_support {
namespace {

constexpr double size = 100, width = 80;  ///< of the block, whose middle of the top is its origin
const Vector3 misplaced(0.31, -0.22, 0.17);
const Vector3 origin(20, -10, -400);

/// A block that lies a little beside the preset, and a ring with a bore of 30.02 mm beside it.
Bench shop(ControlKind control, const std::string& machine = "mill3") {
  Bench bench(control, machine);
  bench.preset(1, origin);
  bench.probeOf(120, 3);
  bench.believedProbe().maximumTravel = 25;
  bench.knows(5, "MILL_D10", 80, 5);
  bench.part(simulation::Box({-size / 2, -width / 2, -25}, {size / 2, width / 2, 0}), pose(origin + misplaced));
  bench.part(simulation::Ring(15.01, 25, -25), pose(origin + misplaced + Vector3(120, 0, 0)));
  return bench;
}

/// Runs a whole program, which brings its frame along; `file` names its language.
Ran runWhole(const Bench& bench, const std::string& file, const std::string& text) {
  session::RunOptions options;
  options.control = bench.control;
  return {setup::runText(file, text, bench.setup, options, {.recordPath = false})};
}

void expectNothingSkipped(const Ran& ran) {
  EXPECT_TRUE(ran.finished()) << ran.why();
  for (const control::EventRecord& event : ran.outcome.journal.events)
    EXPECT_NE(event.kind, control::EventKind::Skipped) << event.text;
}

constexpr std::array controls = {ControlKind::TNC640, ControlKind::iTNC530};

TEST(ShopProbing, ACamSystemSetsThePresetOfACorner) {
  for (const ControlKind control : controls) {
    const Ran ran = runWhole(shop(control), "PROBE.H", R"(0  BEGIN PGM probe_corner MM 
1  BLK FORM 0.1 Z  X-50  Y-40  Z-25
2  BLK FORM 0.2  X+50  Y+40  Z+0
3  ;-------------------------------------
4  ;Tools
5  ;  #1 D=6 CR=3 - ZMIN=-5 - ZMAX=+55 - probe
6  ;-------------------------------------
7  ;
8  TOOL CALL  Z ;AXIS FOR THE RETRACT
9  * - Probe WCS1
10 M5
11 TOOL CALL 1 Z S50
12 ;Probe
13 TOOL DEF 5
14 L M140 MB MAX
15 L  X+0  Y+0 R0 FMAX
16 L  Z+55 R0 FMAX
17 CYCL DEF 32.0 TOLERANCE
18 CYCL DEF 32.1
19 TCH PROBE 417 DATUM IN TS AXIS ~
    Q263=+0    ;1ST POINT 1ST AXIS ~
    Q264=+0    ;1ST POINT 2ND AXIS ~
    Q294=+0    ;1ST POINT 3RD AXIS ~
    Q320=+5    ;SET-UP CLEARANCE ~
    Q260=+15   ;CLEARANCE HEIGHT ~
    Q305=+1    ;NUMBER IN TABLE ~
    Q333=+0    ;DATUM ~
    Q303=+1    ;MEAS. VALUE TRANSFER
20 L  Z+55 FMAX
21 * - Probe WCS1 (2)
22 L  X-65  Y+0 R0 FMAX
23 L  Z+55 R0 FMAX
24 TCH PROBE 419 DATUM IN ONE AXIS ~
    Q263=-50   ;1ST POINT 1ST AXIS ~
    Q264=+0    ;1ST POINT 2ND AXIS ~
    Q261=-5    ;MEASURING HEIGHT ~
    Q320=+5    ;SET-UP CLEARANCE ~
    Q260=+15   ;CLEARANCE HEIGHT ~
    Q272=+1    ;MEASURING AXIS ~
    Q267=+1    ;TRAVERSE DIRECTION ~
    Q305=+1    ;NUMBER IN TABLE ~
    Q333=-50   ;DATUM ~
    Q303=+1    ;MEAS. VALUE TRANSFER
25 L  Z+55 FMAX
26 L  X+0  Y+55 R0 FMAX
27 TCH PROBE 419 DATUM IN ONE AXIS ~
    Q263=+0    ;1ST POINT 1ST AXIS ~
    Q264=+40   ;1ST POINT 2ND AXIS ~
    Q261=-5    ;MEASURING HEIGHT ~
    Q320=+5    ;SET-UP CLEARANCE ~
    Q260=+15   ;CLEARANCE HEIGHT ~
    Q272=+2    ;MEASURING AXIS ~
    Q267=-1    ;TRAVERSE DIRECTION ~
    Q305=+1    ;NUMBER IN TABLE ~
    Q333=+40   ;DATUM ~
    Q303=+1    ;MEAS. VALUE TRANSFER
28 L  Z+55 FMAX
29 M5
30 L M140 MB MAX
31 M30
32 END PGM probe_corner MM 
)");
    expectNothingSkipped(ran);
    EXPECT_NEAR((ran.preset().translation() - origin - misplaced).norm(), 0, 1e-4);
  }
}

TEST(ShopProbing, ACamSystemInspectsWithDecimalsThatEndInAPointAndItsOwnOrder) {
  for (const ControlKind control : controls) {
    const Ran ran =
        runWhole(shop(control), "INSPECT.H",
                 "1 BEGIN PGM W5270 MM\r\n2 ; ---- INSPECTION ----\r\n"
                 "3 BLK FORM 0.1 Z X-50 Y-40 Z-25.6\r\n4 BLK FORM 0.2 X50 Y40 Z0.6\r\n"
                 "5 CALL LBL 1 ; RESET\r\n6 TOOL CALL \"PROBE\" Z S50 DL+0 DR+0\r\n7 M126 ; SHORTER PATH\r\n"
                 "8 L X-70. Y+0. R0 F MAX M9\r\n9 L Z+15. R0 F MAX\r\n"
                 "10 TCH PROBE 427 MEASURE COORDINATE ~\r\n  Q263=-50. ;1ST POINT 1ST AXIS ~\r\n"
                 "  Q264=+0. ;1ST POINT 2ND AXIS ~\r\n  Q261=-5. ;MEASURING HEIGHT ~\r\n"
                 "  Q320=+4. ;SET-UP CLEARANCE ~\r\n  Q272=+1. ;MEASURING AXIS ~\r\n"
                 "  Q267=+1. ;TRAVERSE DIRECTION ~\r\n  Q260=+15. ;CLEARANCE HEIGHT ~\r\n"
                 "  Q281=+0. ;MEASURING LOG ~\r\n  Q288=-49.6 ;MAXIMUM DIMENSION ~\r\n"
                 "  Q289=-50. ;MINIMUM DIMENSION ~\r\n  Q309=+0. ;PGM-STOP IF ERROR ~\r\n"
                 "  Q330=+0. ;TOOL NUMBER\r\n\r\n11 Q50=Q160;FIRST SIDE\r\n"
                 "12 L X+120 FMAX\r\n13 L Y+0 FMAX\r\n"
                 "14 TCH PROBE 421 MESSEN BOHRUNG~\r\n\tQ273=+120\t;MITTE 1. ACHSE~\r\n"
                 "\tQ274=+0\t;MITTE 2. ACHSE~\r\n\tQ262=+30\t;SOLL-DURCHMESSER~\r\n\tQ325=+0\t;STARTWINKEL~\r\n"
                 "\tQ247=+90\t;WINKELSCHRITT~\r\n\tQ261=-5\t;MESSHOEHE~\r\n\tQ320=+0\t;SICHERHEITS-ABST.~\r\n"
                 "\tQ260=+15\t;SICHERE HOEHE~\r\n\tQ301=+0\t;FAHREN AUF S. HOEHE~\r\n"
                 "\tQ275=+30.05\t;GROESSTMASS~\r\n\tQ276=+29.95\t;KLEINSTMASS~\r\n"
                 "\tQ279=+0.5\t;TOLERANZ 1. MITTE~\r\n\tQ280=+0.5\t;TOLERANZ 2. MITTE~\r\n"
                 "\tQ281=+0\t;MESSPROTOKOLL~\r\n\tQ309=+0\t;PGM-STOP BEI FEHLER~\r\n\tQ330=+0\t;WERKZEUG\r\n"
                 "15 FN 9: IF +Q180 EQU +1 GOTO LBL \"OK\"\r\n16 FN 14: ERROR= 1005\r\n17 LBL \"OK\"\r\n"
                 "18 L Z+50. R0 F MAX\r\n/19 M30\r\n20 LBL 1 ; RESET\r\n21 CYCL DEF 7.0 DATUM SHIFT\r\n"
                 "22 CYCL DEF 7.1 X0\r\n23 CYCL DEF 7.2 Y0\r\n24 CYCL DEF 7.3 Z0\r\n25 LBL 0\r\n"
                 "26 END PGM W5270 MM\r\n");
    expectNothingSkipped(ran);
    EXPECT_NEAR(ran.q(50), -50 + misplaced.x(), 1e-6);
    EXPECT_NEAR(ran.q(151), 120 + misplaced.x(), 1e-5);
    EXPECT_NEAR(ran.q(152), misplaced.y(), 1e-5);
    EXPECT_NEAR(ran.q(153), 30.02, 1e-5);
  }
}

/// Old touch probe cycle 0, formulas with bare brackets, labels with names of digits and a table of points in Q
/// parameters.
TEST(ShopProbing, ASetterMeasuresHeightsInALoop) {
  for (const ControlKind control : controls) {
    const Ran ran = runWhole(shop(control), "HEIGHTS.H", R"(BEGIN PGM HEIGHTS MM 
; Program to find the highest of four points
; Written in the shop
;
FN0 : Q1 = +4 ; points
FN 0: Q2 = +0 ; counter
FN0: Q9=-9999
TOOL CALL 1 Z S5
L Z+30 R0 FMAX
LBL "1005"
FN 1: Q2 = +Q2 + +1 ; count
Q3 = (Q2 - 2.5) * (Q2-2.5)*10-Q2 ;distance
Q4 = - 15
L X+Q3 Y+Q4 FMAX
TCH PROBE 0.0 BEZUGSEBENE Q5 Z-
TCH PROBE 0.1 X+Q3 Y+Q4 Z+2
L IZ+20 F2000
FN 12: IF Q5 LT +Q9 GOTO LBL "1010"
Q9 = Q5
LBL "1010"
FN 12: IF +Q2 LT +Q1 GOTO LBL "1005"
FN18: SYSREAD Q20 = ID270 NR1 IDX3
Q21 = SGN Q9
STOP
M30
END PGM HEIGHTS MM)");
    expectNothingSkipped(ran);
    EXPECT_EQ(ran.q(2), 4);
    EXPECT_NEAR(ran.q(9), misplaced.z(), 1e-6);
    EXPECT_NEAR(ran.q(20), 22, 1e-6);
    EXPECT_EQ(ran.q(21), 1);
  }
}

TEST(ShopProbing, APostTurnsTheTableBeforeItMeasures) {
  for (const ControlKind control : controls) {
    const Ran ran = runWhole(shop(control, "mill5-head-table"), "TURNED.H", R"(0 BEGIN PGM TURNED MM
1 * - HEADER
2 FUNCTION RESET TCPM
3 M127 ; SHORTER PATH OFF
4 CALL LBL 99
5 TOOL CALL "PROBE" Z S50
6 L Z-5 R0 FMAX M91
7 L X0 Y0 R0 FMAX M91
8 L B0 C0 R0 FMAX M94
9 CYCL DEF 7.0 NULLPUNKT
10 CYCL DEF 7.1  X+0.000
11 CYCL DEF 7.2  Y+0.000
12 CYCL DEF 7.3  Z+0.000
13 PLANE SPATIAL SPA0 SPB0 SPC90 STAY SEQ- TABLE ROT
14 L B+Q121 C+Q122 R0 FMAX M126
15 L X+0 Y+0 R0 F MAX
16 L Z+20 R0 F MAX
17 TCH PROBE 427 MESSEN KOORDINATE ~
  Q263=+0 ;1. PUNKT 1. ACHSE ~
  Q264=+0 ;1. PUNKT 2. ACHSE ~
  Q261=+0 ;MESSHOEHE ~
  Q320=+2 ;SICHERHEITS-ABST. ~
  Q272=+3 ;MESSACHSE ~
  Q267=-1 ;VERFAHRRICHTUNG ~
  Q260=+20 ;SICHERE HOEHE ~
  Q281=+0 ;MESSPROTOKOLL ~
  Q288=+0.5 ;GROESSTMASS ~
  Q289=-0.5 ;KLEINSTMASS ~
  Q309=+0 ;PGM-STOP BEI FEHLER ~
  Q330=+0 ;WERKZEUG
18 Q70 = Q160
19 L X+0 Y-60 F MAX
20 TCH PROBE 427 MESSEN KOORDINATE ~
  Q263=+0 ~
  Q264=-50 ~
  Q261=-5 ~
  Q320=+2 ~
  Q272=+2 ~
  Q267=+1 ~
  Q260=+20 ~
  Q281=+0 ~
  Q288=-49 ~
  Q289=-51 ~
  Q309=+0 ~
  Q330=+0
21 CALL LBL 99
22 L Z-5 R0 FMAX M91
23 L B+0 C+0 R0 FMAX
24 M30
25 LBL 99 ; RESET
26 PLANE RESET STAY
27 CYCL DEF 7.0
28 CYCL DEF 7.1 X+0
29 CYCL DEF 7.2 Y+0
30 CYCL DEF 7.3 Z+0
31 LBL 0
32 END PGM TURNED MM
)");
    expectNothingSkipped(ran);
    EXPECT_NEAR(ran.q(70), misplaced.z(), 1e-6);
    // Turned by 90 degrees the side at +X of the block is the one at -Y: y' = -x.
    EXPECT_NEAR(ran.q(160), -(size / 2 + misplaced.x()), 1e-6);
  }
}

TEST(ShopProbing, ADinIsoProgramOfTheShopMeasuresABore) {
  for (const ControlKind control : controls) {
    const Ran ran = runWhole(shop(control), "BORE.I", R"(%4100 G71 *
N10 ;BORE OF THE RING
N20 G30 G17 X-50 Y-40 Z-25*
N30 G31 G90 X+50 Y+40 Z+0*
;--- PROBE ---
N40 T1 G17 S50*              ;the tool call is the T word
N50 G00 G40 G90 Z+50 M5*     ;up
N60 X+120 Y+0*
N70 D00 Q30 P01 +30*
N80 L1,0*
N90 D09 P01 +Q180 P02 +1 P03 10*
N100 D14 P01 1000*
N110 G98 L10*
N120 G55 P01 12 P02 Z- P03 +100 P04 +0 P05 +2*
N130 G00 Z+50 M2*
N140 G98 L1*                 ;the bore
N150 G421 Q273=+120 Q274=+0 Q262=+Q30 Q325=+0 Q247=+90 Q261=-5 Q320=+0 Q260=+15 Q301=+0 Q275=+30.05 Q276=+29.95 Q279=+0.5
 Q280=+0.5 Q281=+0 Q309=+0 Q330=+0*
N160 G98 L0*
N99999999 %4100 G71 *
)");
    expectNothingSkipped(ran);
    EXPECT_NEAR(ran.q(151), 120 + misplaced.x(), 1e-5);
    EXPECT_NEAR(ran.q(153), 30.02, 1e-5);
    EXPECT_NEAR(ran.q(12), misplaced.z(), 1e-6);
  }
}

}  // namespace
}  // namespace probewright::testing_support
