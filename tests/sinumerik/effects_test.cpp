#include <gtest/gtest.h>

#include "sinumerik/told.hpp"

/// Nothing is ignored without a word: what is not carried out is named, and refused if that is asked for.
namespace probewright::language::sinumerik {
namespace {

/// A word that is written otherwise than its name is looked for at the first word of its block.
TEST(SinumerikEffects, HaveAPlaceHoweverTheyAreWritten) {
  for (const auto& [block, column] : {std::pair("N10 T2=1", 5U), {"N10 G90 T2=1", 9U}, {"N10 G90 T2 =1", 5U}}) {
    const auto program = SinumerikProgram::fromText("test.mpf", std::string(block) + "\nM30\n");
    const Diagnostics found = check(*program);
    ASSERT_FALSE(found.empty()) << block;
    EXPECT_EQ(found.front().message, "T2= is not carried out");
    EXPECT_EQ(found.front().place.column, column) << block;
  }
}

TEST(SinumerikEffects, WhatIsNotCarriedOutIsNamedOnceAndRefusedUnderStrict) {
  const std::pair<const char*, const char*> words[] = {
      {"M25", "M25"},
      {"M1=50", "M50"},
      {"H5", "the auxiliary function H"},
      {"TRANSMIT", "TRANSMIT"},
      {"CUT3DC", "CUT3DC"},
      {"TCARR=1", "TCARR"},
      {"OFFN=0.5", "OFFN"},
      {"FXS[X]=1", "FXS"},
      {"TOFF[Z]=1", "TOFF"},
      {"CUTMOD=1", "CUTMOD"},
      {"ORIMKS", "ORIMKS"},
      {"TRAILON(X,Y,1)", "TRAILON"},
      {"GEOAX(1,X)", "GEOAX"},
      {"SETMS(3)", "SETMS"},
      {"DELDL(1,1)", "DELDL"},
      {"TCA(\"MILL\")", "TCA"},
      {"CALLPATH(\"/_N_WKS_DIR\")", "CALLPATH"},
      {"REDEF CHAN INT AAA APR 7", "REDEF"},
      {"PTP", "PTP"},
      {"TOWMCS", "TOWMCS"},
      {"G7", "G7"},
      {"G74 X1=0 Z1=0", "G74"},
      {"G810", "G810"},
      {"G[25]=2", "G[25]=2"},
      {"G75 FP=2 X1=0", "FP=2"},
      {"ID=1 WHENEVER $AA_IW[X]>5 DO $AC_OVR=50", "the synchronized action ID"},
      {"SETINT(1) PRIO=1 LIFTOUT", "the interrupt SETINT"},
      {"T2=1", "T2="},
      {"OS[X]=1", "OS"},
      {"OSP1[X]=10", "OSP1"},
      {"DELTC(1,2)", "DELTC"},
      {"POSM(1,2)", "POSM"},
      {"G1 X1 F100 TOFFLR=0.1", "TOFFLR"},
      {"G461", "G461"},
      {"DISC=50", "DISC"},
      {"GFRAME3", "GFRAME3"},
      {"WALCS2", "WALCS2"},
      {"MEAC[X]=(1,2,-1)", "MEAC"},
      {"CPDEF=(X)", "CPDEF"},
      {"CPLON[X]=Y", "CPLON"},
      {"CPLPOS[X,Y]=5", "CPLPOS"},
      {"FOCON[X]", "FOCON"},
      {"TOFFON(Z,1)", "TOFFON"},
      {"G1 X1 F100 MOVT=IC(5)", "MOVT"},
      {"G1 X1 F100 STAT='B010'", "STAT"},
      {"G1 X1 F100 A7=1", "A7"},
      {"G1 X1 F100 THETA=5", "THETA"},
      {"PSI=4", "PSI"},
      {"G1 X1 F100 PSI=4", "PSI"},
      {"TRAORI(2)", "TRAORI with another transformation"},
      {"TRAORI(1,1,0,0)", "TRAORI with another direction"},
      {"$P_EXTFRAME=CTRANS(X,3)", "$P_EXTFRAME"},
      {"$P_CYCFRAME[X,TR]=3", "$P_CYCFRAME"},
      {"$P_TRAFR=CTRANS(X,3)", "$P_TRAFR"},
      {"$P_CHBFRMASK=0", "$P_CHBFRMASK"},
      {"$P_NCBFRMASK=1", "$P_NCBFRMASK"},
      {"$P_GFR[1]=CTRANS(X,3)", "$P_GFR"},
  };
  for (const auto& [block, name] : words) {
    World world;
    world.run(std::string(block) + "\n" + block + "\n");
    const auto named = texts(world, control::EventKind::Skipped);
    ASSERT_EQ(named.size(), 1u) << block;
    EXPECT_TRUE(named[0].starts_with(name)) << block << ": " << named[0];
    const auto checked = SinumerikProgram::fromText("test.mpf", block);
    const Diagnostics told = check(*checked);
    ASSERT_EQ(told.size(), 1u) << block;
    EXPECT_EQ(told[0].severity, Severity::Warning) << block;
    EXPECT_TRUE(told[0].message.starts_with(name)) << block << ": " << told[0].message;
    NotingMachine machine("mill3");
    control::sinumerik::Control control(machine, World::data());
    SinumerikHost strict(control, {.strict = true});
    Texts none;
    const auto result = execution::Interpreter(none, strict).run(SinumerikProgram::fromText("MAIN.MPF", block));
    EXPECT_EQ(result.end, execution::RunEnd::Alarm) << block;
  }
}

TEST(SinumerikEffects, WhatSaysNothingAboutTheToolPassesInSilence) {
  for (const char* block : {"M8",
                            "M9",
                            "M7",
                            "M41",
                            "SOFT",
                            "FFWON",
                            "COMPCAD",
                            "CTOL=0.01",
                            "SETMS",
                            "SETMS(1)",
                            "DELAYFSTON",
                            "DELAYFSTOF",
                            "CLGON",
                            "CTOLG0=0.01",
                            "G1 X1 F100 F7=200 F6=50 ST=1 SR=0.5",
                            "FMA[2,X]=100",
                            "WAITC(X,1)",
                            "GEOAX()",
                            "OFFN=0",
                            "TCARR=0",
                            "CUTMOD=0",
                            "FINEA[X]",
                            "COARSEA=X",
                            "IPOBRKA[X]=50",
                            "SCPARA[X]=1",
                            "POLF[Z]=100",
                            "TOWSTD",
                            "CP",
                            "G64",
                            "G60",
                            "G641 ADIS=0.1",
                            "G601",
                            "DYNFINISH",
                            "FGROUP(X,Y)",
                            "WAITM(1,1,2)",
                            "CDOF",
                            "NORM",
                            "G[10]=2",
                            "RTLION",
                            "UPATH",
                            "ORIAXES",
                            "STOLF=0.1",
                            "G75 FP=1 X1=0",
                            "ENDPROC",
                            "TRAORI(1)",
                            "DISC=0",
                            "SCC[X]",
                            "BNAT EAUTO",
                            "FENDNORM",
                            "LFOF",
                            "WALCS0",
                            "CPLNUM[X,Y]=2",
                            "G460",
                            "ADISPOSA=(X,50)"}) {
    World world;
    world.run(std::string(block) + "\n");
    EXPECT_TRUE(texts(world, control::EventKind::Skipped).empty()) << block;
    EXPECT_EQ(mistake(std::string(block) + "\n"), "") << block;
  }
}

TEST(SinumerikEffects, EveryWordOfTheTableDoesWhatItsRowSays) {
  int rows = 0;
  for (const KeywordEntry& row : keywords()) {
    std::string block(row.name);
    switch (row.keyword) {
      case Keyword::Modal:
        break;
      case Keyword::Statement:
        block += "(2,1)";
        break;
      case Keyword::Setting:
        block += "=1";
        break;
      case Keyword::Axial:
        block += "[X]";
        break;
      case Keyword::MoveWord:
        block = "G1 X1 F100 " + block + "=1";
        break;
      case Keyword::Motion:
        block += " X1 F100";
        break;
      default:
        continue;
    }
    if (row.effect == Effect::CarriedOut) continue;
    ++rows;
    World world;
    world.run(block + "\n");
    const auto named = texts(world, control::EventKind::Skipped);
    ASSERT_EQ(named.size(), row.effect == Effect::Harmless ? 0u : 1u) << block;
    if (!named.empty()) {
      EXPECT_EQ(named[0], std::string(row.name) + " " + std::string(skippedFunction(row.name)));
    }
  }
  EXPECT_GT(rows, 200);
}

TEST(SinumerikEffects, CheckNamesThemToo) {
  EXPECT_EQ(mistake("M25\nM25\n"), "M25 is carried out only by a machine that has it");
  EXPECT_EQ(mistake("OFFN=0.5\n"), "OFFN is not carried out");
  EXPECT_EQ(mistake("TRAORI\nG1 X1 LEAD=3 F5\n"), "LEAD is not carried out");
  EXPECT_EQ(mistake("DEF BOOL OK_1\nOK_1=CHKDNO(1)\n"), "the function CHKDNO is not available here");
  EXPECT_EQ(mistake("R1=SETDNO(1,1,3)\n"), "the function SETDNO is not available here");
  EXPECT_EQ(mistake("POS[C]=CAC(5)\n"), "the function CAC is not available here");
  EXPECT_EQ(mistake("G291\n"), "G291: programs of the ISO dialect are not available");
  EXPECT_EQ(World().alarm("G291\nG28 U0\n"), "14011");
}

TEST(SinumerikEffects, BlocksOfAContourTableDoNotMoveTheAxes) {
  World world;
  world.run(
      "DEF REAL TAB[30,11]\nDEF INT NUM, ERR\nG0 X1 Y1 Z1\nCONTPRON(TAB,\"N\",NUM)\nG1 X50 Y50 F100\nG2 X60 Y60 CR=50\n"
      "EXECUTE(ERR)\n");
  EXPECT_EQ(tip(world), Vector3(1, 1, 1));
  world.run("G0 X2\n");
  EXPECT_EQ(tip(world), Vector3(2, 1, 1));
}

TEST(SinumerikEffects, ToolsAndCirclesThatProgramsAskForAreTold) {
  World world;
  world.run("DEF INT TNO\nT1 M6\nT2\nGETSELT(TNO)\nR1=TNO\nM6\nGETEXET(TNO)\nR2=TNO\nR3=GETDNO(2,1)\n");
  EXPECT_EQ(world.r(1), 2);
  EXPECT_EQ(world.r(2), 2);
  EXPECT_EQ(world.r(3), 1);
  EXPECT_NEAR(world.value("MODAXVAL(X,-30)"), 330, 1e-12);
  // Three points of the circle about (10, 20) with radius 5.
  world.run(
      "DEF REAL PT[4,2]=SET(15,20,10,25,5,20)\nDEF REAL RES[3]\nDEF BOOL FOUND\nFOUND=CALCDAT(PT,3,RES)\n"
      "R1=FOUND R2=RES[0] R3=RES[1] R4=RES[2]\n");
  EXPECT_EQ(world.r(1), 1);
  EXPECT_NEAR(world.r(2), 10, 1e-9);
  EXPECT_NEAR(world.r(3), 20, 1e-9);
  EXPECT_NEAR(world.r(4), 5, 1e-9);
  EXPECT_EQ(world.alarm("DEF REAL PT[3,2]=SET(0,0,1,0,2,0)\nDEF REAL RES[3]\nCALCDAT(PT,3,RES)\n"), "14051");
  EXPECT_EQ(world.alarm("CALCDAT(1,3,2)\n"), "14020");
  const std::string arrays =
      "DEF REAL PT[4,2]=SET(15,20,10,25,5,20,10,15)\nDEF REAL RES[3]\nDEF REAL OFT[2,2]\n"
      "DEF REAL ONE[4,1]\nDEF REAL TWO[2]\nDEF INT INTS[4,2]\n";
  for (const char* wrong : {"CALCDAT(PT,2,RES)", "CALCDAT(PT,5,RES)", "CALCDAT(OFT,3,RES)", "CALCDAT(ONE,3,RES)",
                            "CALCDAT(PT,3,TWO)", "CALCDAT(PT,3)", "CALCDAT(INTS,3,RES)"})
    EXPECT_EQ(World().alarm(arrays + wrong + "\n"), "14020") << wrong;
  World four;
  four.run(arrays + "CALCDAT(PT,4,RES)\nR1=RES[0] R2=RES[1] R3=RES[2]\n");
  EXPECT_NEAR(four.r(1), 10, 1e-9);
  EXPECT_NEAR(four.r(2), 20, 1e-9);
  EXPECT_NEAR(four.r(3), 5, 1e-9);
}

}  // namespace
}  // namespace probewright::language::sinumerik
