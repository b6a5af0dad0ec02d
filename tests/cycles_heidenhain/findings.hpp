#pragma once

#include <map>
#include <string>

#include "cycles_heidenhain/worlds.hpp"

/// What an inspection must say about a dimension, and what its log says.
namespace probewright::testing_support {

enum class Finding { Good, Rework, Scrap };

/// What is left of a dimension that a rule of thumb knows: material left can be taken off, material missing cannot.
inline Finding dimension(double actual, double maximum, double minimum, bool inside) {
  if (maximum == 0 && minimum == 0) return Finding::Good;
  if (actual > maximum) return inside ? Finding::Scrap : Finding::Rework;
  if (actual < minimum) return inside ? Finding::Rework : Finding::Scrap;
  return Finding::Good;
}
inline Finding position(double deviation, double tolerance) {
  return tolerance != 0 && std::abs(deviation) > tolerance ? Finding::Scrap : Finding::Good;
}

inline void expectStatus(const Ran& ran, Finding finding) {
  EXPECT_EQ(ran.q(180), finding == Finding::Good ? 1 : 0);
  EXPECT_EQ(ran.q(181), finding == Finding::Rework ? 1 : 0);
  EXPECT_EQ(ran.q(182), finding == Finding::Scrap ? 1 : 0);
}

/// Limits around a value that it keeps or misses by 0.01 to 0.2 mm; now and then none.
struct Limits {
  double maximum = 0, minimum = 0;
};
inline Limits limitsAround(Dice& dice, double actual) {
  switch (dice.whole(0, 3)) {
    case 0:
      return {};
    case 1:
      return {written(actual - dice.between(0.01, 0.2), 4), written(actual - dice.between(0.3, 0.5), 4)};
    case 2:
      return {written(actual + dice.between(0.3, 0.5), 4), written(actual + dice.between(0.01, 0.2), 4)};
    default:
      return {written(actual + dice.between(0.01, 0.2), 4), written(actual - dice.between(0.01, 0.2), 4)};
  }
}
inline double toleranceAround(Dice& dice, double deviation) {
  switch (dice.whole(0, 2)) {
    case 0:
      return 0;
    case 1:
      return written(std::abs(deviation) + dice.between(0.01, 0.1), 4);
    default:
      return std::max(0.0, written(std::abs(deviation) - dice.between(0.01, 0.1), 4));
  }
}

/// The numbers of a log by "section/label".
inline std::map<std::string, double> readLog(const std::string& text) {
  std::map<std::string, double> values;
  std::string section;
  std::size_t start = 0;
  while (start < text.size()) {
    const std::size_t end = text.find('\n', start);
    std::string line = text.substr(start, end - start);
    start = end + 1;
    for (const char* title :
         {"Nominal values:", "Given limit values:", "Actual values:", "Deviations:", "Further measuring results:",
          "NOML. VALUES:", "GIVEN LIMIT VALUES:", "ACTUAL VALUES:", "DEVIATIONS:", "FURTHER MEASURING RESULTS:"}) {
      if (line.rfind(title, 0) != 0) continue;
      section = title;
      line = line.substr(section.size());
    }
    const std::size_t colon = line.rfind(':');
    if (section.empty() || colon == std::string::npos) continue;
    const std::size_t first = line.find_first_not_of(' ');
    values[section + line.substr(first, colon - first)] = std::stod(line.substr(colon + 1));
  }
  return values;
}

}  // namespace probewright::testing_support
