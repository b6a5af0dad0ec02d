#include <gmock/gmock.h>

#include "conversion/twins.hpp"

/// Shifts and rotations that are known where ways of a program meet: a later block builds on them.
namespace probewright::testing_support {
namespace {

using ::testing::HasSubstr;

PlantedPart table() {
  PlantedPart part{Bench(ControlKind::TNC640, "mill3")};
  part.bench.preset(1, {10, 20, -300});
  return part;
}

std::string shift(const std::string& words) { return "CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 " + words + "\n"; }
std::string turn(const std::string& word) { return "CYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 " + word + "\n"; }
const std::string meet = "FN 9: IF +Q1 EQU +0 GOTO LBL 1\nL X+3 R0 FMAX\nLBL 1\n";
const std::string go = "L X+20 Y+7 R0 FMAX\n";

TEST(ConvertFramesAtLabels, HoldWhatIncrementsAddUpTo) {
  const PlantedPart part = table();
  for (const std::string& before : {shift("X+10") + shift("IX+5"), shift("X+10") + shift("IX-4") + shift("IY+3"),
                                    turn("ROT+20") + turn("IROT+15"), shift("IZ+2") + turn("IROT-12") + turn("IROT-8")})
    for (const std::string& after : {turn("ROT+30"), shift("Y+4"), turn("IROT+6"), shift("IX+1.5")}) {
      SCOPED_TRACE(before + meet + after);
      const Twin original = runKlartext(klartextProgram("Q1 = 0\n" + before + meet + after + go), part);
      const Twin there = runConverted(original, part);
      EXPECT_TRUE(there.lost.empty()) << there.text;
      EXPECT_TRUE(ranWhole(original));
      EXPECT_TRUE(ranWhole(there));
      EXPECT_TRUE(sameEnd(original, there));
    }
}

TEST(ConvertFramesAtLabels, AreNamedWhereWaysDiffer) {
  for (const std::string& one : {shift("IX+5"), turn("IROT+5")}) {
    const std::string program =
        shift("X+10") + "FN 9: IF +Q1 EQU +0 GOTO LBL 1\n" + one + "LBL 1\n" + turn("IROT+30") + go;
    EXPECT_THAT(toSinumerik(klartextProgram("Q1 = 0\n" + program)).text, HasSubstr("NOT CARRIED OVER")) << program;
  }
}

}  // namespace
}  // namespace probewright::testing_support
