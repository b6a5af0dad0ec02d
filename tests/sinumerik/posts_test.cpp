#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "language/sinumerik/check.hpp"
#include "sinumerik/world.hpp"

/// Whole programs as CAM posts and setters write them: they are read without a mistake, run to their end, name what
/// they skip, and leave the tool where they say.
namespace probewright::language::sinumerik {
namespace {

struct Post {
  const char* name;
  const char* machine;
  std::string text;
  std::vector<std::string> skipped;
  Vector3 end;  ///< of the tool tip, program coordinates
};

std::vector<Post> posts() {
  return {
      {"three axes, cutter compensation",
       "mill3",
       "%_N_POCKET_01_MPF\n;$PATH=/_N_WKS_DIR/_N_PART1_WPD\n; (POCKET ROUGH)\nN10 G17 G40 G71 G90 G94 G64 SOFT FFWON\n"
       "N20 CYCLE832(0.05,_ROUGH,1)\nN30 WORKPIECE(,\"\",,\"BOX\",112,0,-20,-80,-20,-20,20,20)\nN40 T=\"MILL\" D1\nN50 "
       "M6\n"
       "N60 S4500 M3 M8\nN70 G54 D1\nN90 G0 X-40 Y-40\nN100 G0 Z50\nN110 G1 Z5 F800\nN120 G641 ADIS=0.02\n"
       "N130 G1 G41 X-30 Y-30\nN135 X-5 Y-30\nN140 G3 X5 Y-20 CR=10\nN145 G1 Y20\nN148 G40 X30\nN160 G0 Z50 M9\nN170 "
       "M5\n"
       "N180 SUPA G0 Z0 D0\nN185 G0 X3 Y4 Z5 D1\nN190 M30\n",
       {},
       {3, 4, 5}},
      {"home variables, feeds by name",
       "mill3",
       "DEF REAL _camtolerance\nDEF REAL _X_HOME, _Y_HOME, _Z_HOME\nDEF REAL _F_CUTTING, _F_ENGAGE\nG40 G17 G94 G90 "
       "G71\n"
       "_camtolerance=0.0254\n_F_CUTTING=1500. _F_ENGAGE=800.\nT=\"MILL\"\nM6\nG54 D1\nCYCLE832(_camtolerance,0,1)\n"
       "G0 G90 X0. Y0. S2000 D1 M3\nZ50. M8\nG1 Z10. F=_F_ENGAGE\nX20. F=_F_CUTTING\nG0 Z50.\nM9\nCYCLE832()\nM5\nM2\n",
       {},
       {20, 0, 50}},
      {"five axes with vectors",
       "mill5-table-table",
       "DEF REAL _Z_HOME=-10\nG40 G17 G710 G94 G90 G60 G601 FNORM\nTRAFOOF\nT1 M6\nG54 D1\nTRAORI\nORIWKS ORIAXES\n"
       "CYCLE832(0.01,_ORI_FINISH,1,0.5)\nUPATH SOFT COMPCAD\nS8000 M3\nG0 X10 Y10 Z100 A3=0 B3=0 C3=1\n"
       "G1 X10 Y10 Z80 A3=0.1 B3=0.0 C3=.995 F1500 M8\nX12 Y10 Z80 A3=.12 B3=.01 C3=.99\nX14 A3=.14 B3=.02 C3=.98\n"
       "G0 Z90\nM9 M5\nM30\n",
       {},
       {14, 10, 90}},
      {"five axes with rotary axes",
       "mill5-head-head",
       "G54 G17 G90 T1 D1 M6\nTRAORI(1)\nORIWKS\nG0 X0 Y0 Z60\nG1 X5 Y5 Z60 A=DC(10) C=DC(30) F2000\nG1 X6 A12 "
       "C35\nM30\n",
       {},
       {6, 5, 60}},
      {"drilling patterns",
       "mill3",
       "T1 M6\nG54 G90 S2000 M3 F200\nG0 X0 Y0 Z10\nMCALL CYCLE82(10,0,2,-20,,0)\nX10 "
       "Y10\nX20\nHOLES2(0,0,20,0,60,6)\nMCALL\n"
       "CYCLE83(10,0,2,-20,,-5,,2,0,0,1,0)\nM30\n",
       {"CYCLE82 is not carried out", "HOLES2 is not carried out", "CYCLE83 is not carried out"},
       {20, 10, 10}},
      {"rigid tapping",
       "mill3",
       "T1 D1 M6\nG54 G90\nSPOS=0\nG0 X0 Y0 Z5\nG331 Z-10 K1.5 S500\nG332 Z5 K1.5\nM30\n",
       {"G331 is travelled as straight lines", "G332 is travelled as straight lines"},
       {0, 0, 5}},
      {"two spindles and gears",
       "mill3",
       "S1=3000 M1=3\nG4 F1\nS[1]=4000\nM[1]=4\nSPOS[1]=90\nSETMS(1)\nG97 S500 M3\nLIMS=3000\nM41\nM5\nG26 S5000\nG0 "
       "X1 Y2 Z3\n"
       "M30\n",
       {},
       {1, 2, 3}},
      {"M functions of the machine builder",
       "mill3",
       "M3 S100\nM7\nM8\nM88\nM27\nM10\nG0 X1 Y1 Z1\nM11\nM27\nM5\nM9\nM30\n",
       {"M88 is not carried out", "M27 is not carried out", "M10 is not carried out", "M11 is not carried out"},
       {1, 1, 1}},
      {"dynamics, feeds and path words",
       "mill3",
       "T1 M6\nG0 G90 G54 X0 Y0 Z0 D1 M3 S1000\nSTOPRE\nIF NOT $P_SIM GOTOF NOSIM\nM0\nNOSIM: G1 X10 F=R1+500\nX=IC(5) "
       "Y=AC(3)\nG91 Z5\n"
       "G90\nPOS[X]=5 FA[X]=1000 POS[Y]=3\nWAITP(X)\nFGROUP(X,Y) FGREF[C]=10\nG9 X3\nOVR=50\nACC[X]=80 VELOLIM[X]=80 "
       "JERKLIM[X]=50\nDYNNORM DYNFINISH\nBRISK SOFT\nCTOL=0.01 OTOL=0.1 ATOL=0.1\nG642 ADIS=0.1 ADISPOS=0.2\nG64 G60 "
       "G601\nFFWON FFWOF\nSBLOF SBLON\nDISPLOF DISPLON\nRTLION\nG93 X4 F2\nG94 F100\nG1 X5 "
       "FINEA[X]\nPOSP[Z]=(7,2,0)\nM30\n",
       {},
       {5, 3, 7}},
      {"texts and files",
       "mill3",
       "DEF STRING[32] NAME_1=\"PART_007\", OUT_1\nDEF STRING[255] LINES[3]\nDEF INT NO_1, ERR_1\nDEF CHAR CH_1\n"
       "OUT_1=SUBSTR(NAME_1,INDEX(NAME_1,\"_\")+1)\nNO_1=NUMBER(OUT_1)\nIF NAME_1[0]==\"P\" GOTOF OK_1\n"
       "SETAL(65000,\"wrong\")\nOK_1:\nNAME_1[0]=\"Q\"\nCH_1=NAME_1[1]\nOUT_1=CH_1\nIF "
       "OUT_1<>\"A\"\nSETAL(65001,\"wrong\")\n"
       "ENDIF\nWRITE(ERR_1,\"LOG\",SPRINT(\"%S;%5.2F;%D\",NAME_1,R1,NO_1))\nREAD(ERR_1,\"LOG\",1,1,LINES)\n"
       "IF LINES[0]<>\"QART_007; 0.00;7\"\nSETAL(65002,LINES[0])\nENDIF\nDELETE(ERR_1,\"LOG\")\nG0 X1 Y1 Z1\nM30\n",
       {},
       {1, 1, 1}},
      {"frames of a setter",
       "mill3",
       "DEF AXIS AX_1=(X)\nG54 G90\nTRANS X10 Y10\nAROT Z90\nASCALE X2\nG0 X5 Y0 Z0\nTRANS\nMIRROR AX[AX_1]=0\nAMIRROR "
       "X0\n"
       "TRANS AX[AX_1]=7\nG0 X0 Y1 Z2\nTRANS\nM30\n",
       {},
       {7, 1, 2}},
      {"a probing macro",
       "mill3",
       "DEF REAL _DEV\nDEF INT _ERR\nDEF STRING[80] _LINE\nDEF CHAR _SEP=\";\"\nG54 G17 G90\nT=\"PROBE\" "
       "D1\nM6\nSPOS=0\nG0 X0 Y0\n"
       "G0 Z50\nMEAS=1 G1 Z40 F300\nSTOPRE\nIF $AC_MEA[1]==0\nGOTOF "
       "END_1\nENDIF\n_DEV=$AA_MW[Z]\n_LINE=\"Z\"<<_SEP<<_DEV\n"
       "WRITE(_ERR,\"LOG_1\",_LINE)\nIF (_ERR<>0) OR (_DEV>100)\nSETAL(65001,\"bad\")\nENDIF\nEND_1: G0 Z60\nM30\n",
       {},
       {0, 0, 60}},
      {"steps of a shop floor program",
       "mill3",
       "N10 G54\nN15 G17 G90\nE_HEAD(100,\"BLANK\",0,1,1,50)\nE_LAB_A_FACE: ;#SM Z:2\nE_MI_PL(\"MILL\",0,1,2,0)\n"
       "E_PO_CIR(\"MILL\",1,,20)\nE_LAB_E_FACE:\nCYCLE61(50,0,2,-1,0,0,100,80,1,5,30,0.1,800,31,0,1,10)\n"
       "G0 X7 Y8\nZ9\nE_END(0,1,0)\nM30 ;#SM\n",
       {"E_HEAD is not carried out", "E_MI_PL is not carried out", "E_PO_CIR is not carried out",
        "CYCLE61 is not carried out", "E_END is not carried out"},
       {7, 8, 9}},
      {"without blanks",
       "mill3",
       "N10G0G90G54G17X10Y20Z60\nN20T1D1M6\nN30G1X=R1Y=R2F500\nN40M3S1000\nIF(R1==0)GOTOF "
       "A_1\nM0\nA_1:G4F.2\nX10Y=20Z=R3+60\nM30\n",
       {},
       {10, 20, 60}},
      {"synchronized actions",
       "mill3",
       "ID=1 WHENEVER $AA_IW[Z]<10 DO $AC_OVR=50\nG0 X4 Y5 Z6\nCANCEL(1)\nM30\n",
       {"the synchronized action ID is not carried out"},
       {4, 5, 6}},
      {"a chased thread",
       "lathe2c",
       "G18 G90 G71 DIAMON\nG54\nG96 S200 LIMS=2500 M4\nG0 X80 Z2\nG1 X60 F0.2\nG1 Z-30\nX80\nG97 S500 M3\nG33 Z-50 "
       "K1.5 SF=0\n"
       "G0 X100 Z20\nM30\n",
       {"G33 is travelled as straight lines"},
       {50, 0, 20}},
      {"moves written by a text",
       "mill3",
       "DEF STRING[40] CMD_1\nDEFINE _HOME AS G0 Z9\nCMD_1=\"G0 X\"<<5\nEXECSTRING(CMD_1)\nEXECSTRING(\"R1=R1+1\")\nG0 "
       "Y=R1\n"
       "_HOME\nM30\n",
       {},
       {5, 1, 9}},
  };
}

TEST(Posts, ProgramsRunAndSayWhatTheySkip) {
  for (const Post& post : posts()) {
    SCOPED_TRACE(post.name);
    World world(post.machine);
    world.control.data.load({"$P_UIFR", {1, "Z", "TR"}}, world.machine.description().axisIndex("A") ? -300.0 : 0.0);
    world.texts.add("UNUSED", "M17\n");
    const auto program = SinumerikProgram::fromText("MAIN.MPF", post.text);
    for (const Diagnostic& each : check(*program)) {
      if (each.severity == Severity::Error) ADD_FAILURE() << format(each);
    }
    world.run(post.text);
    std::vector<std::string> skipped;
    for (const auto& event : world.control.journal.events)
      if (event.kind == control::EventKind::Skipped) skipped.push_back(event.text);
    EXPECT_EQ(skipped, post.skipped);
    EXPECT_LT((world.control.channel.position().vector() - post.end).norm(), 1e-6)
        << world.control.channel.position().vector().transpose();
  }
}

/// Machine builders give their axes names of their own.
TEST(Posts, AxesThatAreNotKnownAreNamedAsSuch) {
  for (const std::string dimension : {"AC", "IC", "DC", "ACP", "ACN"}) {
    const auto program = SinumerikProgram::fromText("MAIN.MPF", "G0 X5 XV=" + dimension + "(3)\nM30\n");
    const Diagnostics found = check(*program);
    const auto named = std::ranges::find_if(found, [](const Diagnostic& each) { return each.place.column == 10U; });
    ASSERT_NE(named, found.end());
    EXPECT_NE(named->message.find(dimension + " is written behind the name of an axis only"), std::string::npos)
        << named->message;
    EXPECT_NE(named->advice.find("The axes are X, Y, Z"), std::string::npos) << named->advice;
  }
}

TEST(Posts, WordsOfOtherDialectsAreExplained) {
  const auto advice = [](const std::string& text) {
    const auto program = SinumerikProgram::fromText("MAIN.MPF", text);
    const Diagnostics found = check(*program);
    return found.empty() ? std::string() : found.front().advice;
  };
  for (const char* block : {"G21\n", "G28 U0 W0\n", "G43 H1 Z5\n", "G49 G80\n", "G73 X5 Z-20\n"})
    EXPECT_NE(advice(block).find("ISO dialect"), std::string::npos) << block << advice(block);
  // G functions that Fanuc controls have and SINUMERIK controls do not.
  const std::vector<int> ofDialect = {20, 21, 22, 23, 24, 27, 28, 29, 30, 31, 32, 43, 44, 49, 50, 51, 52, 65, 66, 67,
                                      68, 69, 72, 73, 76, 77, 78, 79, 80, 81, 82, 83, 84, 85, 86, 87, 88, 89, 98, 99};
  for (int number = 0; number < 100; ++number) {
    const bool named = advice(fmt::format("G{}\n", number)).find("ISO dialect") != std::string::npos;
    EXPECT_EQ(named, std::ranges::count(ofDialect, number) == 1) << "G" << number;
  }
}

}  // namespace
}  // namespace probewright::language::sinumerik
