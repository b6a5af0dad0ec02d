#include <gtest/gtest.h>

#include "sinumerik/world.hpp"

/// RET with arguments: where the calling program goes on.
namespace probewright::language::sinumerik {
namespace {

/// R1 after a subprogram that ends with `ret`: each block of the main program adds another power of ten.
double afterReturn(const std::string& ret) {
  World world;
  world.texts.add("SUBR", ret + "\n");
  world.run(
      "R1=0\nN10 SUBR\nR1=R1+1\nN90 TGT1: R1=R1+10\nR1=R1+100\nN95 IF R1<1000 GOTOF ENDE\nM30\nENDE: "
      "R1=R1+1000\nM30\n");
  return world.r(1);
}

TEST(SinumerikReturn, GoesOnWhereItsArgumentsSay) {
  EXPECT_EQ(afterReturn("RET"), 1111);
  EXPECT_EQ(afterReturn("RET(\"TGT1\")"), 1110);
  EXPECT_EQ(afterReturn("RET(\"tgt1\")"), 1110);
  EXPECT_EQ(afterReturn("RET(\"N90\")"), 1110);
  EXPECT_EQ(afterReturn("RET(\"TGT1\",0)"), 1110);
  EXPECT_EQ(afterReturn("RET(\"TGT1\",1)"), 1100);
  EXPECT_EQ(afterReturn("DEF STRING[20] GOAL=\"ENDE\"\nRET(GOAL)"), 1000);
  EXPECT_EQ(afterReturn("RET(\"TGT1\",,1)"), 1110);
}

TEST(SinumerikReturn, FindsTheBlockWithATextInIt) {
  for (const auto& [ret, value] : std::vector<std::pair<std::string, double>>{
           {"RET(\"PART_NO\")", 1101}, {"RET(\"write_log\")", 1001}, {"RET(\"WRITE_LOG\",1)", 1}}) {
    World world;
    world.texts.add("SUBR", ret + "\n");
    world.texts.add("WRITE_LOG", "R1=R1+1000\n");
    world.run(
        "DEF REAL PART_NO, WRITE_LOG_2\nR1=1 ; WRITE_LOG\nSUBR\nR1=R1+10 WRITE_LOG_2=3\nR1=R1+100 PART_NO=5\n"
        "WRITE_LOG\nM30\n");
    EXPECT_EQ(world.r(1), value) << ret;
  }
}

TEST(SinumerikReturn, LeavesSeveralLevels) {
  World world;
  world.texts.add("INNER", "R1=R1+1\nRET(,,2)\n");
  world.texts.add("OUTER", "INNER\nR1=R1+10\nM17\n");
  world.run("R1=0\nOUTER\nR1=R1+100\n");
  EXPECT_EQ(world.r(1), 101);
  world.texts.add("INNER2", "RET(\"LAST\",,2)\n");
  world.texts.add("OUTER2", "INNER2\nR1=R1+10\nM17\n");
  world.run("R1=0\nOUTER2\nR1=R1+100\nLAST: R1=R1+1000\n");
  EXPECT_EQ(world.r(1), 1000);
}

TEST(SinumerikReturn, DropsThePassesOfTheCallThatAreStillToCome) {
  World world;
  world.texts.add("SUBR", "R1=R1+1\nIF R1==2 GOTOF OUT\nRET\nOUT: RET(\"DONE\")\n");
  world.run("R1=0\nSUBR P5\nR1=R1+10\nDONE: R1=R1+100\n");
  EXPECT_EQ(world.r(1), 102);
}

TEST(SinumerikReturn, BringsBackWhatSaveKept) {
  World world;
  world.texts.add("INNER", "PROC INNER SAVE\nG91\nRET(,,2)\n");
  world.texts.add("OUTER", "PROC OUTER SAVE\nG18 G91\nINNER\nM17\n");
  world.run("G17 G90\nOUTER\nR1=$P_GG[6] R2=$P_GG[14]\n");
  EXPECT_EQ(world.r(1), 1);
  EXPECT_EQ(world.r(2), 1);
}

TEST(SinumerikReturn, RefusesAMissingTargetAndTooManyLevels) {
  World world;
  world.texts.add("SUBR", "RET(\"NOWHERE\")\n");
  EXPECT_EQ(world.alarm("SUBR\n"), "14080");
  world.texts.add("SUBR2", "RET(,,2)\n");
  EXPECT_EQ(world.alarm("SUBR2\n"), "14000");
  EXPECT_EQ(world.alarm("TGT1: RET(\"TGT1\")\n"), "14000") << "the main program returns to nobody";
}

}  // namespace
}  // namespace probewright::language::sinumerik
