#include "cycles/sinumerik/rotation_offset.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace probewright::cycles::sinumerik {

using control::sinumerik::DataStore;

namespace {

constexpr int rows = 6, columns = 5;

/// A radius or a speed that the table knows, and its column or row.
struct Known {
  double value = 0;
  int place = 0;
};

/// A place among the known ones: `share` of the way from one to the next.
struct Between {
  int from = 0, to = 0;
  double share = 0;
};

Between locate(std::vector<Known> known, double value) {
  std::ranges::sort(known, {}, &Known::value);
  const auto above = std::ranges::lower_bound(known, value, {}, &Known::value);
  if (above == known.begin()) return {known.front().place, known.front().place, 0};
  if (above == known.end()) return {known.back().place, known.back().place, 0};
  const auto below = above - 1;
  return {below->place, above->place, (value - below->value) / (above->value - below->value)};
}

}  // namespace

RotationOffset rotationOffsetOf(const DataStore& data) {
  const double asked = data.number("$SNS_MEA_T_PROBE_OFFSET", {});
  return asked == 1 ? RotationOffset::OfTheMaker : asked == 2 ? RotationOffset::OfTheUser : RotationOffset::None;
}

std::string rotationOffsetComplaint(double value) {
  if (value == 0 || value == 2) return {};
  if (value != 1)
    return fmt::format("SD 54691 $SNS_MEA_T_PROBE_OFFSET = {} is none of 0, 1 and 2: nothing is added", value);
  return "the tables of the probe's maker (SD 54691 = 1) are not known here: nothing is added to what a turning tool "
         "measures";
}

double rotationOffset(const DataStore& data, TurningDimension dimension, double radius, double speed) {
  const char* table = dimension == TurningDimension::Length ? "LEN" : "RAD";
  const auto at = [&](int row, int column) {
    return data.number(fmt::format("$SNS_MEA_RESULT_OFFSET_TAB_{}{}", table, row + 1), {column});
  };
  std::vector<Known> radii, speeds;
  for (int column = 1; column < columns; ++column)
    if (const double known = at(0, column); known > 0) radii.push_back({known, column});
  for (int row = 1; row < rows; ++row)
    if (const double known = at(row, 0); known > 0) speeds.push_back({known, row});
  if (radii.empty() || speeds.empty()) return 0;
  constexpr double metre = 1000;  // mm
  const double peripheral = 2 * std::numbers::pi * radius * speed / metre;
  const Between column = locate(std::move(radii), radius), row = locate(std::move(speeds), peripheral);
  const auto along = [&](int which) { return std::lerp(at(which, column.from), at(which, column.to), column.share); };
  return std::lerp(along(row.from), along(row.to), row.share);
}

}  // namespace probewright::cycles::sinumerik
