#pragma once

#include <array>

#include "cycles/catalogue.hpp"

/// Call parameters and results that many SINUMERIK cycles share. Addresses are positions in the call, from 0. What a
/// call leaves out is 0 or empty, as everywhere in this language; the cycle refuses what it cannot do with that.
namespace probewright::cycles::sinumerik::parameters {

inline constexpr double largestCode = 99999999;

constexpr Parameter code(std::uint32_t address, std::string_view name, std::string_view meaning, double standard = 0) {
  return {.name = name,
          .address = address,
          .meaning = meaning,
          .kind = ValueKind::Integer,
          .minimum = -largestCode,
          .maximum = largestCode,
          .standard = standard,
          .controls = control::onSinumerik};
}

constexpr Parameter length(std::uint32_t address, std::string_view name, std::string_view meaning) {
  return {.name = name,
          .address = address,
          .meaning = meaning,
          .kind = ValueKind::Length,
          .standard = 0,
          .controls = control::onSinumerik};
}

constexpr Parameter angle(std::uint32_t address, std::string_view name, std::string_view meaning) {
  return {.name = name,
          .address = address,
          .meaning = meaning,
          .kind = ValueKind::Angle,
          .standard = 0,
          .controls = control::onSinumerik};
}

constexpr Parameter feed(std::uint32_t address, std::string_view name, std::string_view meaning) {
  return {.name = name,
          .address = address,
          .meaning = meaning,
          .kind = ValueKind::Feed,
          .minimum = 0,
          .standard = 0,
          .controls = control::onSinumerik};
}

constexpr Parameter text(std::uint32_t address, std::string_view name, std::string_view meaning) {
  return {
      .name = name, .address = address, .meaning = meaning, .kind = ValueKind::Text, .controls = control::onSinumerik};
}

constexpr Parameter variant(std::string_view meaning, double standard = 0) {
  return code(0, "S_MVAR", meaning, standard);
}
constexpr Parameter zeroOffset(std::uint32_t address) {
  return code(address, "S_KNUM", "zero offset to correct: number, kind in the thousands, fine or coarse in the 10^4");
}
constexpr Parameter toolToCorrect(std::uint32_t address) {
  return code(address, "S_KNUM1", "tool offset to correct: D number, component, memory, sign");
}
constexpr Parameter dataSet(std::uint32_t address) {
  return code(address, "S_PRNUM", "calibration data set of the probe, 1 to 12", 1);
}
constexpr Parameter measuringPath(std::uint32_t address) {
  return length(address, "S_FA", "measuring path DFA: from the start position to the expected surface");
}
constexpr Parameter safeArea(std::uint32_t address) {
  return length(address, "S_TSA", "safe area: a larger difference from the set value stops the program");
}
constexpr Parameter repetitions(std::uint32_t address) {
  return code(address, "S_NMSP", "number of measurements at the same place, 1 to 9", 1);
}
constexpr Parameter toolName(std::uint32_t address) { return text(address, "S_TNAME", "name of the tool to correct"); }
constexpr Parameter dlNumber(std::uint32_t address) {
  return code(address, "S_DLNUM", "DL number of the additive or setup offset");
}
constexpr Parameter zeroOffsetRange(std::uint32_t address) {
  return length(address, "S_TZL", "zero offset range: smaller differences correct no tool");
}
constexpr Parameter dimensionalDifference(std::uint32_t address) {
  return length(address, "S_TDIF", "dimensional difference check: beyond it the tool counts as worn out; 0: no check");
}
constexpr Parameter upperTolerance(std::uint32_t address) {
  return length(address, "S_TUL", "upper tolerance limit, from the set value");
}
constexpr Parameter lowerTolerance(std::uint32_t address) {
  return length(address, "S_TLL", "lower tolerance limit, from the set value");
}
constexpr Parameter meanRange(std::uint32_t address) {
  return length(address, "S_TMV", "range of the mean: larger differences correct at once and whole");
}
constexpr Parameter weight(std::uint32_t address) { return code(address, "S_K", "weighting factor of the mean"); }
constexpr Parameter memories(std::uint32_t address) {
  return code(address, "S_EVNUM", "number of the empirical value plus 10000 times the number of the mean value");
}
constexpr Parameter reserved(std::uint32_t address) { return code(address, "S_MCBIT", "reserved"); }
constexpr Parameter plane(std::uint32_t address) {
  return code(address, "_DMODE", "plane: 0 as active, 1 G17, 2 G18, 3 G19");
}
constexpr Parameter tolerance(std::uint32_t address) {
  return code(address, "_AMODE", "1: S_TUL and S_TLL are a tolerance");
}
constexpr Parameter alternative(std::uint32_t address) { return code(address, "_AMODE", "reserved"); }

/// The two lists one after the other.
template <std::size_t A, std::size_t B>
constexpr std::array<ResultDefinition, A + B> joined(const std::array<ResultDefinition, A>& first,
                                                     const std::array<ResultDefinition, B>& second) {
  std::array<ResultDefinition, A + B> all = {};
  for (std::size_t i = 0; i < A; ++i)
    all[i] = first[i];
  for (std::size_t i = 0; i < B; ++i)
    all[A + i] = second[i];
  return all;
}

/// What cycles with tool or zero offset correction leave besides their own results.
inline constexpr std::array<ResultDefinition, 18> correctionResultsWithoutLimits = {{
    {"_OVR[20]", "correction value of the tool"},
    {"_OVR[27]", "zero offset range"},
    {"_OVR[28]", "safe area"},
    {"_OVR[29]", "dimensional difference"},
    {"_OVR[30]", "empirical value"},
    {"_OVR[31]", "mean value"},
    {"_OVI[0]", "number of the edge (D) or of the zero offset", ValueKind::Integer},
    {"_OVI[2]", "number of the cycle", ValueKind::Integer},
    {"_OVI[3]", "measuring variant", ValueKind::Integer},
    {"_OVI[4]", "weighting factor", ValueKind::Integer},
    {"_OVI[5]", "data set of the probe", ValueKind::Integer},
    {"_OVI[6]", "number of the mean value", ValueKind::Integer},
    {"_OVI[7]", "number of the empirical value", ValueKind::Integer},
    {"_OVI[8]", "number of the corrected tool", ValueKind::Integer},
    {"_OVI[9]", "number of the alarm or message", ValueKind::Integer},
    {"_OVI[13]", "DL number", ValueKind::Integer},
    {"_OVI[11]", "1: a zero offset was corrected", ValueKind::Integer},
    {"_OVS_TNAME", "name of the corrected tool", ValueKind::Text},
}};

/// The same with the limits of a tolerance of one dimension.
inline constexpr auto correctionResults =
    joined(std::array<ResultDefinition, 2>{{{"_OVR[8]", "upper tolerance limit, from the middle of the tolerance"},
                                            {"_OVR[12]", "lower tolerance limit, from the middle of the tolerance"}}},
           correctionResultsWithoutLimits);

}  // namespace probewright::cycles::sinumerik::parameters
