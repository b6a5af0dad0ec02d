#include "language/klartext/pattern.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

/// The points of PATTERN DEF and of point tables.
namespace probewright::language::klartext {
namespace {

std::vector<Vector3> points(const std::string& text) {
  const auto found = patternPoints(text, [](std::string_view name) {
    return name == "Q5" ? 12.5 : name == "QL3" ? 4 : 7;
  });
  EXPECT_TRUE(found) << (found ? "" : found.error().message);
  return found ? *found : std::vector<Vector3>{};
}

void expectPoints(const std::string& text, const std::vector<Vector3>& expected) {
  SCOPED_TRACE(text);
  const auto found = points(text);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_LT((found[i] - expected[i]).norm(), 1e-12) << "point " << i << ": " << found[i].transpose();
}

TEST(Pattern, PlacesPointsOneByOne) {
  expectPoints("POS1 (X+25 Y+33.5 Z+0)", {{25, 33.5, 0}});
  expectPoints("POS1( X+25 Y+33,5 Z-2 ) ~\n  POS2( IX+10 Y+6.5 ) ~\n  POS3 (X-1 IY-2 IZ+1)",
               {{25, 33.5, -2}, {35, 6.5, -2}, {-1, 4.5, -1}});
  expectPoints("pos1 (X+Q5 Y-Q5 Z+QL3)", {{12.5, -12.5, 4}});
}

TEST(Pattern, PlacesRowsGridsAndFrames) {
  expectPoints("ROW1 (X+25 Y+33 D+8 NUM3 ROT+90 Z+1)", {{25, 33, 1}, {25, 41, 1}, {25, 49, 1}});
  expectPoints("PAT1 (X+1 Y+2 DX+10 DY+20 NUMX3 NUMY2 ROT+0 ROTX+0 ROTY+0 Z+0)",
               {{1, 2, 0}, {11, 2, 0}, {21, 2, 0}, {21, 22, 0}, {11, 22, 0}, {1, 22, 0}});
  expectPoints("FRAME1 (X+0 Y+0 DX+10 DY+10 NUMX3 NUMY3 ROT+0 ROTX+0 ROTY+0 Z+0)",
               {{0, 0, 0}, {10, 0, 0}, {20, 0, 0}, {20, 10, 0}, {20, 20, 0}, {10, 20, 0}, {0, 20, 0}, {0, 10, 0}});
  expectPoints("FRAME1 (X+0 Y+0 DX+10 DY+10 NUMX1 NUMY2)", {{0, 0, 0}, {0, 10, 0}});
  // The whole grid turned, then one of its axes alone.
  expectPoints("PAT1 (X+0 Y+0 DX+10 DY+20 NUMX2 NUMY2 ROT+90)", {{0, 0, 0}, {0, 10, 0}, {-20, 10, 0}, {-20, 0, 0}});
  const double c = 10 * std::sqrt(0.5);
  expectPoints("PAT1 (X+0 Y+0 DX+10 DY+20 NUMX2 NUMY2 ROTX+45)", {{0, 0, 0}, {c, c, 0}, {c, c + 20, 0}, {0, 20, 0}});
  expectPoints("PAT1 (X+0 Y+0 DX+5 DY+10 NUMX2 NUMY2 ROTY-45)", {{0, 0, 0}, {5, 0, 0}, {5 + c, c, 0}, {c, c, 0}});
}

TEST(Pattern, PlacesCircles) {
  expectPoints("CIRC1 (X+10 Y+20 D80 START+90 NUM4 Z-1)", {{10, 60, -1}, {-30, 20, -1}, {10, -20, -1}, {50, 20, -1}});
  expectPoints("PITCHCIRC1 (X+0 Y+0 D80 START+0 STEP-90 NUM3 Z+0)", {{40, 0, 0}, {0, -40, 0}, {-40, 0, 0}});
  expectPoints("PITCHCIRC1 (X+0 Y+0 D80 START+0 END+180 NUM3)", {{40, 0, 0}, {0, 40, 0}, {-40, 0, 0}});
  expectPoints("POS1 (X+1 Y+1 Z+0) CIRC2 (X+0 Y+0 D2 NUM1)", {{1, 1, 0}, {1, 0, 0}});
}

TEST(Pattern, NamesWhatIsWrong) {
  const auto reason = [](const std::string& text) {
    const auto found = patternPoints(text, [](std::string_view) { return 1.0; });
    return found ? std::string() : found.error().message;
  };
  EXPECT_EQ(reason(""), "PATTERN DEF names no points");
  EXPECT_EQ(reason("BOW1 (X+1)"), "'BOW' is not an element of PATTERN DEF");
  EXPECT_EQ(reason("POS1 X+1"), "( is expected after POS");
  EXPECT_EQ(reason("POS1 (X+1 W+2)"), "POS does not take 'W'");
  EXPECT_EQ(reason("POS1 (X+ Y+2)"), "a number is expected after X of POS");
  EXPECT_EQ(reason("POS1 (X+1 Y+2"), "POS does not take ''");
  EXPECT_EQ(reason("ROW1 (X+1 Y+2 NUM3)"), "ROW lacks D");
  EXPECT_EQ(reason("ROW1 (X+1 Y+2 D5 NUM0)"), "NUM of ROW must be from 1 to 10000");
  EXPECT_EQ(reason("CIRC1 (X+1 Y+2 D5 NUM1000000)"), "NUM of CIRC must be from 1 to 10000");
  EXPECT_EQ(reason("PAT1 (X+1 Y+2 DX5 DY5 NUMX200 NUMY200)"),
            "NUMX and NUMY of PAT must be at least 1, with at most 10000 points");
  EXPECT_EQ(reason("PITCHCIRC1 (X+1 Y+2 D5 NUM3)"), "PITCHCIRC takes either STEP or END");
}

TEST(Pattern, ReadsPointTables) {
  const std::string table =
      "BEGIN HOLES.PNT MM\nNR   X         Y         Z         FADE\n0    +10       +20,5     +0        N\n"
      "1    +30       -20       -1.5      Y\n2    -5        +0        -         \n[END]\n";
  const auto found = pointTable(table, "HOLES.PNT");
  ASSERT_TRUE(found) << found.error().message;
  ASSERT_EQ(found->size(), 2U);
  EXPECT_EQ((*found)[0], Vector3(10, 20.5, 0));
  EXPECT_EQ((*found)[1], Vector3(-5, 0, 0));
  EXPECT_FALSE(pointTable("nothing", "X.PNT"));
  const auto empty = pointTable("BEGIN X.PNT MM\nNR X Y Z\n[END]\n", "X.PNT");
  ASSERT_FALSE(empty);
  EXPECT_EQ(empty.error().message, "the point table X.PNT has no points");
}

}  // namespace
}  // namespace probewright::language::klartext
