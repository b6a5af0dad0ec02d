#include "metrology/iso286.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "base/number_text.hpp"
#include "base/text.hpp"

namespace probewright::metrology {

namespace {

constexpr double micrometre = 1e-3;
constexpr int gradeIt01 = -1;

/// ISO 286-1:2010, table 1: standard tolerance grades in micrometres; a column a main range.
constexpr std::array<double, 13> mainRanges{3, 6, 10, 18, 30, 50, 80, 120, 180, 250, 315, 400, 500};
constexpr std::array<std::array<double, 13>, 20> grades{{
    {0.3, 0.4, 0.4, 0.5, 0.6, 0.6, 0.8, 1, 1.2, 2, 2.5, 3, 4},                       // IT01
    {0.5, 0.6, 0.6, 0.8, 1, 1, 1.2, 1.5, 2, 3, 4, 5, 6},                             // IT0
    {0.8, 1, 1, 1.2, 1.5, 1.5, 2, 2.5, 3.5, 4.5, 6, 7, 8},                           // IT1
    {1.2, 1.5, 1.5, 2, 2.5, 2.5, 3, 4, 5, 7, 8, 9, 10},                              // IT2
    {2, 2.5, 2.5, 3, 4, 4, 5, 6, 8, 10, 12, 13, 15},                                 // IT3
    {3, 4, 4, 5, 6, 7, 8, 10, 12, 14, 16, 18, 20},                                   // IT4
    {4, 5, 6, 8, 9, 11, 13, 15, 18, 20, 23, 25, 27},                                 // IT5
    {6, 8, 9, 11, 13, 16, 19, 22, 25, 29, 32, 36, 40},                               // IT6
    {10, 12, 15, 18, 21, 25, 30, 35, 40, 46, 52, 57, 63},                            // IT7
    {14, 18, 22, 27, 33, 39, 46, 54, 63, 72, 81, 89, 97},                            // IT8
    {25, 30, 36, 43, 52, 62, 74, 87, 100, 115, 130, 140, 155},                       // IT9
    {40, 48, 58, 70, 84, 100, 120, 140, 160, 185, 210, 230, 250},                    // IT10
    {60, 75, 90, 110, 130, 160, 190, 220, 250, 290, 320, 360, 400},                  // IT11
    {100, 120, 150, 180, 210, 250, 300, 350, 400, 460, 520, 570, 630},               // IT12
    {140, 180, 220, 270, 330, 390, 460, 540, 630, 720, 810, 890, 970},               // IT13
    {250, 300, 360, 430, 520, 620, 740, 870, 1000, 1150, 1300, 1400, 1550},          // IT14
    {400, 480, 580, 700, 840, 1000, 1200, 1400, 1600, 1850, 2100, 2300, 2500},       // IT15
    {600, 750, 900, 1100, 1300, 1600, 1900, 2200, 2500, 2900, 3200, 3600, 4000},     // IT16
    {1000, 1200, 1500, 1800, 2100, 2500, 3000, 3500, 4000, 4600, 5200, 5700, 6300},  // IT17
    {1400, 1800, 2200, 2700, 3300, 3900, 4600, 5400, 6300, 7200, 8100, 8900, 9700},  // IT18
}};

/// ISO 286-1:2010, tables 2 to 5: distance of a shaft's tolerance interval from the nominal size, in micrometres, a
/// column an intermediate range. For a to h it is -es, for k to zc it is ei. `none` where the standard has no value.
constexpr double none = -1;
constexpr std::size_t columns = 25;
constexpr std::array<double, columns> ranges{3,   6,   10,  14,  18,  24,  30,  40,  50,  65,  80,  100, 120,
                                             140, 160, 180, 200, 225, 250, 280, 315, 355, 400, 450, 500};
struct Letter {
  std::string_view name;
  std::array<double, columns> distance;
};
// clang-format off
constexpr std::array<Letter, 26> letters{{
    {"a",  {270, 270, 280, 290, 290, 300, 300, 310, 320, 340, 360, 380, 410, 460, 520, 580, 660, 740, 820, 920, 1050, 1200, 1350, 1500, 1650}},
    {"b",  {140, 140, 150, 150, 150, 160, 160, 170, 180, 190, 200, 220, 240, 260, 280, 310, 340, 380, 420, 480, 540, 600, 680, 760, 840}},
    {"c",  {60, 70, 80, 95, 95, 110, 110, 120, 130, 140, 150, 170, 180, 200, 210, 230, 240, 260, 280, 300, 330, 360, 400, 440, 480}},
    {"cd", {34, 46, 56, 70, 70, 85, 85, 100, 100, none, none, none, none, none, none, none, none, none, none, none, none, none, none, none, none}},
    {"d",  {20, 30, 40, 50, 50, 65, 65, 80, 80, 100, 100, 120, 120, 145, 145, 145, 170, 170, 170, 190, 190, 210, 210, 230, 230}},
    {"e",  {14, 20, 25, 32, 32, 40, 40, 50, 50, 60, 60, 72, 72, 85, 85, 85, 100, 100, 100, 110, 110, 125, 125, 135, 135}},
    {"ef", {10, 14, 18, 23, 23, 28, 28, 35, 35, none, none, none, none, none, none, none, none, none, none, none, none, none, none, none, none}},
    {"f",  {6, 10, 13, 16, 16, 20, 20, 25, 25, 30, 30, 36, 36, 43, 43, 43, 50, 50, 50, 56, 56, 62, 62, 68, 68}},
    {"fg", {4, 6, 8, 10, 10, 12, 12, 15, 15, none, none, none, none, none, none, none, none, none, none, none, none, none, none, none, none}},
    {"g",  {2, 4, 5, 6, 6, 7, 7, 9, 9, 10, 10, 12, 12, 14, 14, 14, 15, 15, 15, 17, 17, 18, 18, 20, 20}},
    {"h",  {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}},
    {"k",  {0, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 3, 3, 3, 3, 3, 4, 4, 4, 4, 4, 4, 4, 5, 5}},
    {"m",  {2, 4, 6, 7, 7, 8, 8, 9, 9, 11, 11, 13, 13, 15, 15, 15, 17, 17, 17, 20, 20, 21, 21, 23, 23}},
    {"n",  {4, 8, 10, 12, 12, 15, 15, 17, 17, 20, 20, 23, 23, 27, 27, 27, 31, 31, 31, 34, 34, 37, 37, 40, 40}},
    {"p",  {6, 12, 15, 18, 18, 22, 22, 26, 26, 32, 32, 37, 37, 43, 43, 43, 50, 50, 50, 56, 56, 62, 62, 68, 68}},
    {"r",  {10, 15, 19, 23, 23, 28, 28, 34, 34, 41, 43, 51, 54, 63, 65, 68, 77, 80, 84, 94, 98, 108, 114, 126, 132}},
    {"s",  {14, 19, 23, 28, 28, 35, 35, 43, 43, 53, 59, 71, 79, 92, 100, 108, 122, 130, 140, 158, 170, 190, 208, 232, 252}},
    {"t",  {none, none, none, none, none, none, 41, 48, 54, 66, 75, 91, 104, 122, 134, 146, 166, 180, 196, 218, 240, 268, 294, 330, 360}},
    {"u",  {18, 23, 28, 33, 33, 41, 48, 60, 70, 87, 102, 124, 144, 170, 190, 210, 236, 258, 284, 315, 350, 390, 435, 490, 540}},
    {"v",  {none, none, none, none, 39, 47, 55, 68, 81, 102, 120, 146, 172, 202, 228, 252, 284, 310, 340, 385, 425, 475, 530, 595, 660}},
    {"x",  {20, 28, 34, 40, 45, 54, 64, 80, 97, 122, 146, 178, 210, 248, 280, 310, 350, 385, 425, 475, 525, 590, 660, 740, 820}},
    {"y",  {none, none, none, none, none, 63, 75, 94, 114, 144, 174, 214, 254, 300, 340, 380, 425, 470, 520, 580, 650, 730, 820, 920, 1000}},
    {"z",  {26, 35, 42, 50, 60, 73, 88, 112, 136, 172, 210, 258, 310, 365, 415, 465, 520, 575, 640, 710, 790, 900, 1000, 1100, 1250}},
    {"za", {32, 42, 52, 64, 77, 98, 118, 148, 180, 226, 274, 335, 400, 470, 535, 600, 670, 740, 820, 920, 1000, 1150, 1300, 1450, 1600}},
    {"zb", {40, 50, 67, 90, 108, 136, 160, 200, 242, 300, 360, 445, 525, 620, 700, 780, 880, 960, 1050, 1200, 1300, 1500, 1650, 1850, 2100}},
    {"zc", {60, 80, 97, 130, 150, 188, 218, 274, 325, 405, 480, 585, 690, 800, 900, 1000, 1150, 1250, 1350, 1550, 1700, 1900, 2100, 2400, 2600}},
}};
/// j: -ei of j5 and j6, of j7; ES of J6, J7, J8. By main range.
constexpr std::array<double, 13> shaftJ56{2, 2, 2, 3, 4, 5, 7, 9, 11, 13, 16, 18, 20};
constexpr std::array<double, 13> shaftJ7{4, 4, 5, 6, 8, 10, 12, 15, 18, 21, 26, 28, 32};
constexpr std::array<double, 13> holeJ6{2, 5, 5, 6, 8, 10, 13, 16, 18, 22, 25, 29, 33};
constexpr std::array<double, 13> holeJ7{4, 6, 8, 10, 12, 14, 18, 22, 26, 30, 36, 39, 43};
constexpr std::array<double, 13> holeJ8{6, 10, 12, 15, 20, 24, 28, 34, 41, 47, 55, 60, 66};
// clang-format on

/// A tolerance class taken apart.
struct Class {
  bool hole = false;
  std::string letter;  // small
  int grade = 0;
};

tl::unexpected<Diagnostic> unknown(std::string_view toleranceClass) {
  return fail(fmt::format("'{}' is not a tolerance class of ISO 286", toleranceClass),
              "write a letter and a grade, such as H7 for a hole or g6 for a shaft");
}

tl::unexpected<Diagnostic> undefined(double nominal, std::string_view toleranceClass) {
  return fail(fmt::format("ISO 286 defines no class {} for {} mm", toleranceClass, formatShortest(nominal)),
              "give the deviations as numbers");
}

std::optional<Class> parseClass(std::string_view text) {
  const auto length = static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), isLetter) - text.begin());
  const std::string_view name = text.substr(0, length);
  const std::string_view grade = text.substr(length);
  if (name.empty() || name.size() > 2) return std::nullopt;
  const auto capitals = std::count_if(name.begin(), name.end(), isCapital);
  if (capitals != 0 && static_cast<std::size_t>(capitals) != name.size()) return std::nullopt;

  Class result;
  result.hole = capitals > 0;
  for (const char c : name)
    result.letter += lower(c);
  if (grade == "01") {
    result.grade = gradeIt01;
    return result;
  }
  const auto number = parseInteger(grade);
  if (!number || grade[0] == '+' || grade[0] == '-' || (grade.size() > 1 && grade[0] == '0') || *number > 18) {
    return std::nullopt;
  }
  result.grade = static_cast<int>(*number);
  return result;
}

template <std::size_t N>
std::size_t rangeOf(const std::array<double, N>& upperBounds, double nominal) {
  return static_cast<std::size_t>(std::lower_bound(upperBounds.begin(), upperBounds.end(), nominal) -
                                  upperBounds.begin());
}

double gradeWidth(std::size_t range, int grade) { return grades[static_cast<std::size_t>(grade + 1)][range]; }

/// What the standard adds to the mirrored shaft deviation of a hole so that hole and shaft one grade finer fit alike.
double delta(std::size_t range, int grade) {
  return range == 0 ? 0 : gradeWidth(range, grade) - gradeWidth(range, grade - 1);
}

/// ES of a hole from K to ZC, in micrometres.
std::optional<double> upperDeviationOfTightHole(const Class& wanted, double distance, std::size_t range,
                                                double nominal) {
  if (wanted.grade < 3) return std::nullopt;
  const bool transition = wanted.letter == "k" || wanted.letter == "m" || wanted.letter == "n";
  const bool fine = wanted.grade <= (transition ? 8 : 7);
  if (fine && wanted.letter == "m" && wanted.grade == 6 && nominal > 250 && nominal <= 315) return -9;
  if (fine) return -distance + delta(range, wanted.grade);
  if (wanted.letter == "k") return range == 0 ? std::optional<double>(0) : std::nullopt;
  if (wanted.letter == "n" && nominal <= 1) return std::nullopt;
  if (wanted.letter == "n" && range > 0) return 0;
  return -distance;
}

/// Lower deviation of a shaft j or upper deviation of a hole J, in micrometres.
std::optional<double> deviationOfJ(const Class& wanted, std::size_t range) {
  switch (wanted.grade) {
    case 5:
      return wanted.hole ? std::nullopt : std::optional<double>(-shaftJ56[range]);
    case 6:
      return wanted.hole ? holeJ6[range] : -shaftJ56[range];
    case 7:
      return wanted.hole ? holeJ7[range] : -shaftJ7[range];
    case 8:
      if (wanted.hole) return holeJ8[range];
      return range == 0 ? std::optional<double>(-6) : std::nullopt;
    default:
      return std::nullopt;
  }
}

Tolerance fromLower(double lower, double width) { return {lower * micrometre, (lower + width) * micrometre}; }
Tolerance fromUpper(double upper, double width) { return {(upper - width) * micrometre, upper * micrometre}; }

}  // namespace

Result<double> standardTolerance(double nominal, int grade) {
  if (grade < gradeIt01 || grade > 18) {
    return fail(fmt::format("there is no standard tolerance grade IT{}", grade), "use IT01, IT0 or IT1 to IT18");
  }
  if (!(nominal > 0) || nominal > mainRanges.back()) {
    return fail(fmt::format("ISO 286 tolerances are tabulated for sizes above 0 and up to 500 mm, not for {} mm",
                            formatShortest(nominal)),
                "give the deviations as numbers");
  }
  if (grade >= 14 && nominal <= 1) {
    return fail("grades IT14 to IT18 are not used for sizes up to 1 mm", "give the deviations as numbers");
  }
  return gradeWidth(rangeOf(mainRanges, nominal), grade) * micrometre;
}

Result<Tolerance> isoTolerance(double nominal, std::string_view toleranceClass) {
  const auto wanted = parseClass(toleranceClass);
  if (!wanted) return unknown(toleranceClass);
  const auto checked = standardTolerance(nominal, wanted->grade);
  if (!checked) return tl::unexpected(checked.error());
  const std::size_t range = rangeOf(mainRanges, nominal);
  const double width = gradeWidth(range, wanted->grade);

  if (wanted->letter == "js") return Tolerance{-width / 2 * micrometre, width / 2 * micrometre};
  if (wanted->letter == "j") {
    const auto deviation = deviationOfJ(*wanted, range);
    if (!deviation) return undefined(nominal, toleranceClass);
    return wanted->hole ? fromUpper(*deviation, width) : fromLower(*deviation, width);
  }

  const auto letter =
      std::find_if(letters.begin(), letters.end(), [&](const Letter& l) { return l.name == wanted->letter; });
  if (letter == letters.end()) return unknown(toleranceClass);
  const double distance = letter->distance[rangeOf(ranges, nominal)];
  const bool roomy = letter->name <= "h";
  if (distance == none || (nominal <= 1 && (letter->name == "a" || letter->name == "b"))) {
    return undefined(nominal, toleranceClass);
  }
  if (roomy) return wanted->hole ? fromLower(distance, width) : fromUpper(-distance, width);
  if (wanted->hole) {
    const auto upper = upperDeviationOfTightHole(*wanted, distance, range, nominal);
    if (!upper) return undefined(nominal, toleranceClass);
    return fromUpper(*upper, width);
  }
  if (letter->name == "k" && (wanted->grade < 4 || wanted->grade > 7)) return fromLower(0, width);
  return fromLower(distance, width);
}

}  // namespace probewright::metrology
