#include <gtest/gtest.h>

#include "sinumerik/world.hpp"

/// Frames of data management and the active ones: which of them a program changes, and when that acts.
namespace probewright::language::sinumerik {
namespace {

TEST(SinumerikActiveFrames, DataActWhenTheyAreActivated) {
  World world;
  world.run(
      "G500\nG0 X10 Y0 Z0\nG54\n$P_UIFR[1]=CTRANS(X,100):CFINE(X,0.25)\n"
      "R1=$P_UIFR[1,X,TR] R2=$P_UIFR[1,X,FI] R3=$P_IFRAME[X,TR]\nG17\nD0\nTRANS Y1\nR4=$AA_IW[X]\n"
      "G54\nR5=$P_IFRAME[X,TR] R6=$AA_IW[X]\n");
  EXPECT_EQ(world.r(1), 100);
  EXPECT_EQ(world.r(2), 0.25);
  EXPECT_EQ(world.r(3), 0) << "not yet activated";
  EXPECT_NEAR(world.r(4), 10, 1e-12) << "plane, tool and programmed frame do not activate it";
  EXPECT_EQ(world.r(5), 100);
  EXPECT_NEAR(world.r(6), 10 - 100.25, 1e-12);
}

/// MD 28080 counts G500, too: with 6 there are G54 to G57 and G505.
TEST(SinumerikActiveFrames, AreAsManyAsTheMachineHas) {
  World world;
  world.run("$MC_MM_NUM_USER_FRAMES=6\n$P_UIFR[5]=CTRANS(X,3)\nG505\nR1=$P_IFRAME[X,TR]\n");
  EXPECT_EQ(world.r(1), 3);
  EXPECT_EQ(World().alarm("$MC_MM_NUM_USER_FRAMES=6\nG506\n"), "18310");
}

TEST(SinumerikActiveFrames, TheActiveSettableFrameIsWrittenWithoutItsData) {
  World world;
  world.run(
      "G54\n$P_IFRAME=CTRANS(X,5,Y,6):CROT(Z,90)\nG0 X10 Y0 Z0\nR1=$AA_IM[X] R2=$AA_IM[Y] R3=$P_UIFR[1,X,TR]\n"
      "$P_IFRAME[X,TR]=7\nR4=$P_IFRAME[X,TR] R5=$P_IFRAME[Z,RT]\nG54\nR6=$P_IFRAME[X,TR]\n");
  EXPECT_NEAR(world.r(1), 5, 1e-9);
  EXPECT_NEAR(world.r(2), 16, 1e-9);
  EXPECT_EQ(world.r(3), 0);
  EXPECT_EQ(world.r(4), 7);
  EXPECT_EQ(world.r(5), 90);
  EXPECT_EQ(world.r(6), 0) << "G54 takes the data again";
}

TEST(SinumerikActiveFrames, BasicFramesByTheirActiveAndTheirStoredNames) {
  World world;
  world.run(
      "G500\n$P_CHBFR[0]=CTRANS(Z,-3)\nR1=$P_ACTBFRAME[Z,TR]\nG500\nR2=$P_ACTBFRAME[Z,TR]\n"
      "$P_CHBFRAME[0]=CTRANS(Z,-4)\nR3=$P_ACTBFRAME[Z,TR] R4=$P_CHBFR[0,Z,TR]\n"
      "$P_BFRAME[Z,TR]=-5\nR5=$P_CHBFRAME[0,Z,TR] R6=$P_UBFR[Z,TR]\n"
      "$P_CHBFRAME[1]=CTRANS(X,2)\n$P_NCBFRAME[0]=CTRANS(Y,8)\nG0 X0 Y0 Z0\n"
      "R7=$AA_IM[X] R8=$AA_IM[Y] R9=$AA_IM[Z]\n$P_UBFR=CTRANS(X,1)\nG500\nR10=$P_ACTBFRAME[X,TR] "
      "R11=$P_ACTBFRAME[Z,TR]\n");
  EXPECT_EQ(world.r(1), 0);
  EXPECT_EQ(world.r(2), -3);
  EXPECT_EQ(world.r(3), -4);
  EXPECT_EQ(world.r(4), -3);
  EXPECT_EQ(world.r(5), -5);
  EXPECT_EQ(world.r(6), -3);
  EXPECT_NEAR(world.r(7), 2, 1e-12);
  EXPECT_NEAR(world.r(8), 8, 1e-12);
  EXPECT_NEAR(world.r(9), -5, 1e-12);
  EXPECT_EQ(world.r(10), 1);
  EXPECT_EQ(world.r(11), 0);
  EXPECT_EQ(world.alarm("$P_CHBFRAME[16]=CTRANS(X,1)\n"), "17020");
  EXPECT_EQ(world.alarm("$P_ACTBFRAME=CTRANS(X,1)\n"), "12130");
}

TEST(SinumerikActiveFrames, WholeFramesTravelThroughVariables) {
  World world;
  world.run(
      "DEF FRAME ONE, MORE[2]\nONE=CTRANS(X,1,Y,2)\nMORE[1]=ONE:CROT(Z,10)\n$P_UIFR[3]=MORE[1]\n"
      "R1=$P_UIFR[3,Y,TR] R2=$P_UIFR[3,Z,RT]\n$P_UIFR[3]=INVFRAME(ONE)\nR3=$P_UIFR[3,Y,TR]\n"
      "$P_UIFR[2]=$P_UIFR[3]:CTRANS(Y,5)\nR4=$P_UIFR[2,Y,TR]\n$P_PFRAME=CTRANS(X,1):CMIRROR(Y)\nR5=$P_PFRAME[Y,MI]\n"
      "$P_UIFR[2]=CTRANS()\nR6=$P_UIFR[2,Y,TR]\n");
  EXPECT_EQ(world.r(1), 2);
  EXPECT_EQ(world.r(2), 10);
  EXPECT_EQ(world.r(3), -2);
  EXPECT_EQ(world.r(4), 3);
  EXPECT_EQ(world.r(5), 1);
  EXPECT_EQ(world.r(6), 0);
}

TEST(SinumerikActiveFrames, SaveBringsBackWhatItShould) {
  World world;
  world.texts.add("SUB",
                  "PROC SUB SAVE DISPLOF\nG18 G91 G55 G70\nTRANS X5\n$P_CHBFRAME[0]=CTRANS(Z,1)\nF700 S80\nRET\n");
  world.texts.add("FIND", "PROC FIND SAVE\n$P_UIFR[1]=CTRANS(X,3)\nG54\nRET\n");
  world.run(
      "G17 G90 G54 F100\nTRANS Y7\nSUB\nR1=$P_GG[6] R2=$P_GG[14] R3=$P_UIFRNUM R4=$P_PFRAME[X,TR] R5=$P_PFRAME[Y,TR]\n"
      "R6=$P_GG[13] R7=$P_F R8=$P_S R9=$P_CHBFRAME[0,Z,TR]\nFIND\nR10=$P_IFRAME[X,TR]\n");
  EXPECT_EQ(world.r(1), 1);
  EXPECT_EQ(world.r(2), 1);
  EXPECT_EQ(world.r(3), 1);
  EXPECT_EQ(world.r(4), 0);
  EXPECT_EQ(world.r(5), 7);
  EXPECT_EQ(world.r(6), 2);
  EXPECT_EQ(world.r(7), 700) << "F is no G function";
  EXPECT_EQ(world.r(8), 80);
  EXPECT_EQ(world.r(9), 0) << "another settable frame was activated, and the basic frames with it";
  EXPECT_EQ(world.r(10), 3) << "what a subprogram found stays";
}

TEST(SinumerikActiveFrames, AChannelBeginsAsMachineDatum20150Says) {
  World turned("lathe2c");
  EXPECT_EQ(turned.control.plane, 18);
  auto store = World::data();
  store.load({"$MC_GCODE_RESET_VALUES", {5}}, 3.0);
  store.load({"$MC_GCODE_RESET_VALUES", {12}}, 3.0);
  store.load({"$MC_GCODE_RESET_VALUES", {28}}, 2.0);
  NotingMachine machine("mill3");
  control::sinumerik::Control control(machine, store);
  EXPECT_EQ(control.plane, 19);
  EXPECT_EQ(control.unit, 25.4);
  EXPECT_TRUE(control.diameter);
  SinumerikHost host(control);
  EXPECT_EQ(host.motionState().gGroup[6], 3);
  EXPECT_EQ(host.motionState().gGroup[13], 3);
  EXPECT_EQ(host.motionState().gGroup[29], 2);
  EXPECT_TRUE(host.motionState().feedInInch);
}

/// A frame that is written whole counts as its components do: in inches with G700, in millimetres with G70.
TEST(SinumerikActiveFrames, FrameFunctionsCountAsTheComponentsOfFramesDo) {
  for (const bool inch : {false, true}) {
    World world;
    world.run(std::string("DEF FRAME FRM\n") + (inch ? "G700" : "G70") +
              "\n$P_UIFR[1]=CTRANS(X,1,C,30):CFINE(Y,0.5):CROT(Z,10)\nR1=$P_UIFR[1,X,TR] "
              "R2=$P_UIFR[1,Y,FI] R3=$P_UIFR[1,C,TR] R4=$P_UIFR[1,Z,RT]\nFRM=CTRANS(Z,2)\nR5=FRM[Z,TR]\nFRM[Z,TR]=3\n"
              "$P_UIFR[2]=FRM\nR6=$P_UIFR[2,Z,TR]\n$P_UIFR[3]=CTRANS(Y,1):CTRANS(Y,2)\n$P_UIFR[4]=$P_UIFR[3]\n"
              "R8=$P_UIFR[4,Y,TR]\n");
    const double millimetres = inch ? 25.4 : 1;
    EXPECT_NEAR(world.r(1), 1, 1e-12);
    EXPECT_NEAR(world.r(2), 0.5, 1e-12);
    EXPECT_NEAR(world.r(3), 30, 1e-12);
    EXPECT_NEAR(world.r(4), 10, 1e-9);
    EXPECT_NEAR(world.r(5), 2, 1e-12);
    EXPECT_NEAR(world.r(6), 3, 1e-12);
    EXPECT_NEAR(world.r(8), 3, 1e-12);
    EXPECT_NEAR(world.control.data.number({"$P_UIFR", {1, "X", "TR"}}), millimetres, 1e-12);
    EXPECT_NEAR(world.control.data.number({"$P_UIFR", {1, "Y", "FI"}}), millimetres / 2, 1e-12);
    EXPECT_NEAR(world.control.data.number({"$P_UIFR", {2, "Z", "TR"}}), 3 * millimetres, 1e-12);
  }
}

TEST(SinumerikActiveFrames, G700ConvertsSystemVariablesAndFeedsG70DoesNot) {
  World world;
  world.run("G70 G500 G90 G0 X1 Y0 Z0\nTRANS X2\nR1=$AA_IW[X] R2=$P_PFRAME[X,TR]\nG1 X0 F100\n");
  EXPECT_NEAR(world.r(1), 25.4 - 50.8, 1e-9);
  EXPECT_NEAR(world.r(2), 50.8, 1e-9);
  EXPECT_EQ(world.machine.moves.back().feed.perMinute, 100);
  world.run("G700\nR1=$AA_IW[X] R2=$P_PFRAME[X,TR]\nG1 X1 F10\n$P_UIFR[1,X,TR]=1\nG71\nR3=$P_UIFR[1,X,TR]\n");
  EXPECT_NEAR(world.r(1), 0, 1e-9);
  EXPECT_NEAR(world.r(2), 2, 1e-9);
  EXPECT_EQ(world.machine.moves.back().feed.perMinute, 254);
  EXPECT_NEAR(world.r(3), 25.4, 1e-9);
}

TEST(SinumerikActiveFrames, DiametersInAbsoluteAndIncrementalPositions) {
  World world("lathe2c");
  world.run("DIAMON G90 G0 X100 Z50\nR1=$AA_IM[X] R2=$AA_IW[X]\nG91 X10\nR3=$AA_IM[X]\n");
  EXPECT_NEAR(world.r(1), 50, 1e-12);
  EXPECT_NEAR(world.r(2), 100, 1e-12);
  EXPECT_NEAR(world.r(3), 55, 1e-12) << "DIAMON: ways too";
  world.run(
      "DIAM90 G90 X100\nG91 X10\nR4=$AA_IM[X] R5=$P_GG[29]\nG90 X=IC(4)\nR6=$AA_IM[X]\nDIAMOF X70\nR7=$AA_IM[X]\n");
  EXPECT_NEAR(world.r(4), 60, 1e-12) << "DIAM90: positions only";
  EXPECT_EQ(world.r(5), 3);
  EXPECT_NEAR(world.r(6), 64, 1e-12);
  EXPECT_NEAR(world.r(7), 70, 1e-12);
}

}  // namespace
}  // namespace probewright::language::sinumerik
