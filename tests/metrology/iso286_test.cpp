// Limit deviations in micrometres as ISO 286-2 tabulates them, and the formulas that ISO 286-1 derives its tables from.
#include "metrology/iso286.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

namespace probewright::metrology {
namespace {

struct Published {
  double nominal;
  const char* name;
  double upper, lower;  // micrometres
};
void PrintTo(const Published& published, std::ostream* out) { *out << published.nominal << ' ' << published.name; }

class PublishedLimits : public testing::TestWithParam<Published> {};

TEST_P(PublishedLimits, AreMet) {
  const Published& expected = GetParam();
  const auto tolerance = isoTolerance(expected.nominal, expected.name);
  ASSERT_TRUE(tolerance) << tolerance.error().message;
  EXPECT_NEAR(tolerance->upper, expected.upper / 1000, 1e-12);
  EXPECT_NEAR(tolerance->lower, expected.lower / 1000, 1e-12);
}

// clang-format off
INSTANTIATE_TEST_SUITE_P(Iso286Part2, PublishedLimits, testing::Values(
    // holes
    Published{10, "H7", 15, 0}, Published{50, "H7", 25, 0}, Published{3, "H7", 10, 0}, Published{3.001, "H7", 12, 0},
    Published{25, "H6", 13, 0}, Published{25, "H8", 33, 0}, Published{25, "H9", 52, 0}, Published{120, "H11", 220, 0},
    Published{10, "H01", 0.4, 0}, Published{10, "H0", 0.6, 0}, Published{10, "H1", 1, 0}, Published{500, "H7", 63, 0}, Published{1, "H13", 140, 0}, Published{400, "H5", 25, 0},
    Published{25, "G7", 28, 7}, Published{100, "F8", 90, 36}, Published{20, "F7", 41, 20}, Published{25, "E9", 92, 40},
    Published{25, "D10", 149, 65}, Published{60, "D9", 174, 100}, Published{8, "C11", 170, 80}, Published{25, "B11", 290, 160},
    Published{25, "A11", 430, 300}, Published{25, "JS7", 10.5, -10.5}, Published{25, "JS9", 26, -26},
    Published{25, "J6", 8, -5}, Published{25, "J7", 12, -9}, Published{25, "J8", 20, -13}, Published{4, "J7", 6, -6},
    Published{25, "K7", 6, -15}, Published{25, "K6", 2, -11}, Published{25, "K8", 10, -23}, Published{2, "K7", 0, -10},
    Published{100, "K7", 10, -25}, Published{300, "K6", 5, -27}, Published{14, "K3", 0, -3}, Published{14, "M3", -6, -9},
    Published{25, "M7", 0, -21}, Published{25, "M6", -4, -17}, Published{25, "M8", 4, -29}, Published{300, "M6", -9, -41},
    Published{300, "M7", 0, -52}, Published{2, "M7", -2, -12}, Published{25, "M9", -8, -60},
    Published{25, "N7", -7, -28}, Published{25, "N9", 0, -52}, Published{2, "N9", -4, -29}, Published{60, "N7", -9, -39},
    Published{8, "N9", 0, -36}, Published{25, "P7", -14, -35}, Published{8, "P9", -15, -51}, Published{4, "P7", -8, -20},
    Published{60, "P7", -21, -51}, Published{50, "R7", -25, -50}, Published{100, "S7", -58, -93}, Published{130, "R7", -48, -88},
    Published{25, "S7", -27, -48}, Published{50, "T7", -45, -70}, Published{100, "U7", -111, -146}, Published{130, "U7", -155, -195},
    // shafts
    Published{50, "g6", -9, -25}, Published{8, "m7", 21, 6}, Published{100, "f7", -36, -71}, Published{25, "js7", 10.5, -10.5},
    Published{25, "h6", 0, -13}, Published{25, "h7", 0, -21}, Published{25, "h9", 0, -52}, Published{25, "h11", 0, -130},
    Published{25, "g6", -7, -20}, Published{25, "f7", -20, -41}, Published{25, "f6", -20, -33}, Published{25, "e8", -40, -73},
    Published{25, "d9", -65, -117}, Published{35, "c11", -120, -280}, Published{45, "c11", -130, -290},
    Published{130, "b11", -260, -510}, Published{490, "a11", -1650, -2050},
    Published{10, "j6", 7, -2}, Published{25, "j6", 9, -4}, Published{25, "j7", 13, -8}, Published{150, "j6", 14, -11},
    Published{25, "k6", 15, 2}, Published{50, "k6", 18, 2}, Published{100, "k6", 25, 3}, Published{25, "k5", 11, 2},
    Published{25, "k8", 33, 0}, Published{25, "k11", 130, 0}, Published{2, "k6", 6, 0},
    Published{25, "m6", 21, 8}, Published{100, "m6", 35, 13}, Published{25, "n6", 28, 15}, Published{50, "n6", 33, 17},
    Published{25, "p6", 35, 22}, Published{200, "p6", 79, 50}, Published{25, "r6", 41, 28}, Published{60, "r6", 60, 41},
    Published{70, "r6", 62, 43}, Published{25, "s6", 48, 35}, Published{100, "s6", 93, 71}, Published{110, "s6", 101, 79},
    Published{28, "t6", 54, 41}, Published{22, "u6", 54, 41}, Published{28, "u6", 61, 48}, Published{60, "u6", 106, 87},
    Published{16, "x8", 72, 45}, Published{25, "x8", 97, 64}, Published{40, "z8", 151, 112}, Published{25, "zc10", 302, 218},
    Published{5, "ef6", -14, -22}, Published{5, "cd8", -46, -64}, Published{5, "fg6", -6, -14},
    Published{12, "cd8", -70, -97}, Published{18, "EF7", 41, 23}, Published{25, "cd9", -85, -137}, Published{24, "fg6", -12, -25},
    Published{40, "ef8", -35, -74}, Published{50, "FG7", 40, 15}, Published{50, "CD10", 200, 100}));
// clang-format on

// Upper bounds of the intermediate ranges.
constexpr std::array<double, 25> bounds{3,   6,   10,  14,  18,  24,  30,  40,  50,  65,  80,  100, 120,
                                        140, 160, 180, 200, 225, 250, 280, 315, 355, 400, 450, 500};
constexpr std::array<double, 14> mainBounds{0, 3, 6, 10, 18, 30, 50, 80, 120, 180, 250, 315, 400, 500};

double mainMean(double nominal) {
  for (std::size_t i = 1; i < mainBounds.size(); ++i) {
    if (nominal <= mainBounds[i]) return i == 1 ? std::sqrt(3.0) : std::sqrt(mainBounds[i - 1] * mainBounds[i]);
  }
  return 0;
}
double mean(std::size_t i) { return i == 0 ? std::sqrt(3.0) : std::sqrt(bounds[i - 1] * bounds[i]); }

// ISO 286-1:1988 A.3: i = 0.45 D^(1/3) + 0.001 D; IT5 = 7 i, then the multiples 10, 16, 25, 40, 64, 100 ... rounded.
// The range up to 3 mm keeps older values and is pinned by the published limits above.
TEST(Formulas, GradesFollowTheToleranceUnit) {
  const std::array<double, 14> multiples{7, 10, 16, 25, 40, 64, 100, 160, 250, 400, 640, 1000, 1600, 2500};
  for (std::size_t r = 2; r < mainBounds.size(); ++r) {
    const double d = mainMean(mainBounds[r]);
    const double unit = 0.45 * std::cbrt(d) + 0.001 * d;
    for (int grade = 5; grade <= 18; ++grade) {
      const double expected = multiples[static_cast<std::size_t>(grade - 5)] * unit;
      const auto width = standardTolerance(mainBounds[r], grade);
      ASSERT_TRUE(width);
      EXPECT_NEAR(*width * 1000, expected, 0.06 * expected + 0.5) << "IT" << grade << " to " << mainBounds[r];
    }
  }
}

// ISO 286-1:1988 A.4: the formulas of the fundamental deviations, D the geometric mean of the range. The tables keep
// some older rounded values, most of all in the small ranges.
TEST(Formulas, ShaftDeviationsFollowTheirPowersOfTheSize) {
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    const double size = bounds[i];
    const double d = mean(i);
    const double dMain = mainMean(size);
    const auto grade = [&](int n) { return *standardTolerance(size, n) * 1000; };
    const auto es = [&](const char* name) { return -isoTolerance(size, name)->upper * 1000; };
    const auto ei = [&](const char* name) { return isoTolerance(size, name)->lower * 1000; };
    const auto near = [&](const char* name, double value, double expected) {
      const double share = size > 40 ? 0.05 : 0.14;
      EXPECT_NEAR(value, expected, share * expected + 2.2) << name << " to " << size;
    };
    near("a", es("a9"), size <= 120 ? 265 + 1.3 * d : 3.5 * d);
    near("b", es("b9"), size <= 160 ? 140 + 0.85 * d : 1.8 * d);
    near("c", es("c9"), size <= 30 ? 52 * std::pow(d, 0.2) : 95 + 0.8 * d);
    near("d", es("d9"), 16 * std::pow(dMain, 0.44));
    near("e", es("e8"), 11 * std::pow(dMain, 0.41));
    near("f", es("f7"), 5.5 * std::pow(dMain, 0.41));
    near("g", es("g6"), 2.5 * std::pow(dMain, 0.34));
    near("k", ei("k6"), 0.6 * std::cbrt(dMain));
    near("m", ei("m6"), grade(7) - grade(6));
    near("n", ei("n6"), 5 * std::pow(dMain, 0.34));
    if (size > 3) near("p", ei("p6"), grade(7) + 2.5);
    near("s", ei("s6"), size <= 50 ? grade(8) + 2.5 : grade(7) + 0.4 * d);
    near("r", ei("r6"), std::sqrt(ei("p6") * ei("s6")));
    if (size > 18) near("u", ei("u6"), grade(7) + d);
    if (size > 18) near("x", ei("x6"), grade(7) + 1.6 * d);
    if (size > 18) near("z", ei("z6"), grade(7) + 2.5 * d);
    if (size > 18) near("za", ei("za6"), grade(8) + 3.15 * d);
    if (size > 18) near("zb", ei("zb6"), grade(9) + 4 * d);
    if (size > 18) near("zc", ei("zc6"), grade(10) + 5 * d);
    if (size > 24) near("t", ei("t6"), grade(7) + 0.63 * d);
    if (size > 18) near("v", ei("v6"), grade(7) + 1.25 * d);
    if (size > 18) near("y", ei("y6"), grade(7) + 2 * d);
  }
}

TEST(Tables, GrowWithTheSizeAndFromLetterToLetter) {
  const std::array<const char*, 9> roomy{"a9", "b9", "c9", "d9", "e9", "f9", "g9", "h9", "k9"};
  const std::array<const char*, 13> tight{"k6", "m6", "n6", "p6", "r6", "s6", "t6",
                                          "u6", "v6", "x6", "y6", "z6", "za6"};
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    for (std::size_t l = 1; l < roomy.size(); ++l) {
      EXPECT_LT(isoTolerance(bounds[i], roomy[l - 1])->upper, isoTolerance(bounds[i], roomy[l])->upper);
    }
    double last = -1;
    for (const char* name : tight) {
      const auto tolerance = isoTolerance(bounds[i], name);
      if (!tolerance) continue;
      EXPECT_GT(tolerance->lower, last) << name << " to " << bounds[i];
      last = tolerance->lower;
      const auto smaller = i > 0 ? isoTolerance(bounds[i - 1], name) : tolerance;
      if (smaller) {
        EXPECT_GE(tolerance->lower, smaller->lower) << name << " to " << bounds[i];
      }
    }
  }
}

// The point of the delta rule: H7/p6 and P7/h6 have the same least and greatest interference.
TEST(DeltaRule, MakesHoleAndShaftBasisFitsAlike) {
  for (std::size_t i = 1; i < bounds.size(); ++i) {
    const double size = bounds[i];
    for (const auto& [shaft, hole] :
         {std::pair{"k6", "K7"}, {"m6", "M7"}, {"n6", "N7"}, {"p6", "P7"}, {"s6", "S7"}, {"u6", "U7"}}) {
      const auto holeBasis = *isoTolerance(size, "H7");
      const auto tight = *isoTolerance(size, shaft);
      const auto shaftBasis = *isoTolerance(size, "h6");
      const auto wide = *isoTolerance(size, hole);
      EXPECT_NEAR(holeBasis.upper - tight.lower, wide.upper - shaftBasis.lower, 1e-12) << size << shaft;
      EXPECT_NEAR(holeBasis.lower - tight.upper, wide.lower - shaftBasis.upper, 1e-12) << size << shaft;
    }
  }
}

TEST(Grades, FineOnes) {
  EXPECT_NEAR(*standardTolerance(40, 1), 0.0015, 1e-15);
  EXPECT_NEAR(*standardTolerance(40, 4), 0.007, 1e-15);
  EXPECT_NEAR(*standardTolerance(40, 0), 0.001, 1e-15);
  EXPECT_NEAR(*standardTolerance(40, -1), 0.0006, 1e-15);
  EXPECT_NEAR(isoTolerance(40, "h01")->lower, -0.0006, 1e-15);
}

TEST(Refusals, NameWhatIsWrong) {
  EXPECT_EQ(isoTolerance(10, "Hh7").error().message, "'Hh7' is not a tolerance class of ISO 286");
  EXPECT_EQ(isoTolerance(10, "q7").error().message, "'q7' is not a tolerance class of ISO 286");
  EXPECT_EQ(isoTolerance(10, "H").error().message, "'H' is not a tolerance class of ISO 286");
  EXPECT_EQ(isoTolerance(10, "7").error().message, "'7' is not a tolerance class of ISO 286");
  EXPECT_EQ(isoTolerance(10, "H19").error().message, "'H19' is not a tolerance class of ISO 286");
  EXPECT_EQ(isoTolerance(10, "H07").error().message, "'H07' is not a tolerance class of ISO 286");
  EXPECT_EQ(isoTolerance(10, "").error().message, "'' is not a tolerance class of ISO 286");
  EXPECT_EQ(isoTolerance(20, "t6").error().message, "ISO 286 defines no class t6 for 20 mm");
  EXPECT_EQ(isoTolerance(60, "fg6").error().message, "ISO 286 defines no class fg6 for 60 mm");
  EXPECT_EQ(isoTolerance(0.8, "a11").error().message, "ISO 286 defines no class a11 for 0.8 mm");
  EXPECT_EQ(isoTolerance(20, "J9").error().message, "ISO 286 defines no class J9 for 20 mm");
  EXPECT_EQ(isoTolerance(20, "K9").error().message, "ISO 286 defines no class K9 for 20 mm");
  EXPECT_FALSE(isoTolerance(500.1, "H7"));
  EXPECT_EQ(isoTolerance(10, "H+7").error().message, "'H+7' is not a tolerance class of ISO 286");
  EXPECT_EQ(isoTolerance(10, "H-7").error().message, "'H-7' is not a tolerance class of ISO 286");
  EXPECT_FALSE(isoTolerance(0, "H7"));
  EXPECT_FALSE(isoTolerance(-10, "H7"));
  EXPECT_FALSE(isoTolerance(std::nan(""), "H7"));
  EXPECT_FALSE(isoTolerance(0.5, "H14"));
  EXPECT_FALSE(isoTolerance(1, "H14"));
  EXPECT_FALSE(standardTolerance(10, 19));
  EXPECT_FALSE(standardTolerance(10, -2));
}

}  // namespace
}  // namespace probewright::metrology
