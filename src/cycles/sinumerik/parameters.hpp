#pragma once

#include <array>

#include "cycles/catalogue.hpp"
#include "cycles/joined.hpp"

/// Call parameters and results that many SINUMERIK cycles share. Addresses are positions in the call, from 0. What a
/// call leaves out has the parameter's standard value, most often 0 or empty; the cycle refuses what it cannot do with
/// that.
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

/// A number of which each decimal digit has a meaning of its own.
constexpr Parameter coded(std::uint32_t address, std::string_view name, std::string_view meaning,
                          std::span<const CodeDigit> digits, double standard = 0) {
  return {.name = name,
          .address = address,
          .meaning = meaning,
          .kind = ValueKind::Integer,
          .minimum = -largestCode,
          .maximum = largestCode,
          .standard = standard,
          .digits = digits,
          .controls = control::onSinumerik};
}

template <int Most>
inline constexpr CodeDigit upTo[] = {{.width = Most > 9 ? 2 : 1, .most = Most}};

/// A whole number from 0 to `Most`: a count, an axis.
template <int Most>
constexpr Parameter count(std::uint32_t address, std::string_view name, std::string_view meaning, double standard = 0) {
  return coded(address, name, meaning, upTo<Most>, standard);
}

constexpr Parameter length(std::uint32_t address, std::string_view name, std::string_view meaning,
                           double standard = 0) {
  return {.name = name,
          .address = address,
          .meaning = meaning,
          .kind = ValueKind::Length,
          .standard = standard,
          .controls = control::onSinumerik};
}

/// A length that no cycle takes below 0.
constexpr Parameter distance(std::uint32_t address, std::string_view name, std::string_view meaning) {
  Parameter parameter = length(address, name, meaning);
  parameter.minimum = 0;
  return parameter;
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

constexpr Parameter variant(std::span<const CodeDigit> digits, double standard = 0) {
  return coded(0, "S_MVAR", "measuring variant", digits, standard);
}

inline constexpr Choice measureOnly[] = {{0, "measure only"}};
inline constexpr Choice measureOrShift[] = {{0, "measure only"}, {1, "correct the zero offset"}};
inline constexpr Choice measureOrCorrect[] = {
    {0, "measure only"}, {1, "correct the zero offset"}, {2, "correct the tool"}};
inline constexpr Choice protectionZone[] = {{0, "without protection zone"}, {1, "with protection zone"}};
inline constexpr Choice method[] = {
    {0, "probe as calibrated"}, {1, "with spindle reversal"}, {2, "probe aligned with each touch"}};
inline constexpr Choice withTolerance[] = {{0, "no tolerance"}, {1, "S_TUL and S_TLL are a tolerance"}};
inline constexpr Choice fineOrCoarse[] = {{0, "fine"}, {1, "coarse"}};
inline constexpr Choice zeroOffsetKinds[] = {{0, "settable zero offset"},
                                             {1, "basic zero offset of the channel"},
                                             {2, "base reference"},
                                             {3, "global basic zero offset"},
                                             {9, "active zero offset"}};
inline constexpr CodeDigit zeroOffsetDigits[] = {
    {1, 2, "number"}, {4, 1, "kind", zeroOffsetKinds}, {5, 1, "part", fineOrCoarse}};
/// Of cycles that correct rotations: global basic zero offsets have none.
inline constexpr Choice turnedOffsetKinds[] = {{0, "settable zero offset"},
                                               {1, "basic zero offset of the channel"},
                                               {2, "base reference"},
                                               {9, "active zero offset"}};
inline constexpr CodeDigit turnedOffsetDigits[] = {
    {1, 2, "number"}, {4, 1, "kind", turnedOffsetKinds}, {5, 1, "part", fineOrCoarse}};

inline constexpr Choice toolMemories[] = {{0, "wear"},
                                          {1, "additive offset"},
                                          {2, "setup offset, the additive offset added to it"},
                                          {3, "setup offset"},
                                          {4, "geometry"}};
inline constexpr Choice signOfCorrection[] = {{0, "not inverted"}, {1, "inverted"}};
inline constexpr Choice milledComponents[] = {
    {0, "component by the feature"}, {1, "length 1"}, {2, "length 2"}, {3, "length 3"}, {4, "radius"}};
inline constexpr Choice turnedComponents[] = {{0, "radius"}, {1, "length 1"}, {2, "length 2"}, {3, "length 3"}};
inline constexpr CodeDigit milledToolDigits[] = {{1, 5, "D"},
                                                 {6, 1, "component", milledComponents},
                                                 {7, 1, "memory", toolMemories},
                                                 {8, 1, "sign", signOfCorrection}};
inline constexpr CodeDigit turnedToolDigits[] = {{1, 3, "D"},
                                                 {5, 1, "sign", signOfCorrection},
                                                 {6, 1, "component", turnedComponents},
                                                 {7, 1, "memory", toolMemories}};

constexpr Parameter zeroOffset(std::uint32_t address) {
  return coded(address, "S_KNUM", "zero offset to correct", zeroOffsetDigits);
}
/// Of cycles that correct rotations.
constexpr Parameter turnedOffset(std::uint32_t address) {
  return coded(address, "S_KNUM", "zero offset to correct", turnedOffsetDigits);
}
/// Of milling cycles, of turning cycles.
constexpr Parameter toolToCorrect(std::uint32_t address) {
  return coded(address, "S_KNUM1", "tool offset to correct", milledToolDigits);
}
constexpr Parameter turnedToolToCorrect(std::uint32_t address) {
  return coded(address, "S_KNUM1", "tool offset to correct", turnedToolDigits);
}
constexpr Parameter dataSet(std::uint32_t address) {
  return count<12>(address, "S_PRNUM", "calibration data set of the probe, 1 to 12; 0 counts as 1", 1);
}
constexpr Parameter measuringPath(std::uint32_t address) {
  return distance(address, "S_FA", "measuring path DFA: from the start position to the expected surface");
}
constexpr Parameter safeArea(std::uint32_t address) {
  return distance(address, "S_TSA", "safe area: a larger difference from the set value stops the program");
}
constexpr Parameter repetitions(std::uint32_t address) {
  return count<9>(address, "S_NMSP", "number of measurements at the same place, 1 to 9; 0 counts as 1", 1);
}
constexpr Parameter toolName(std::uint32_t address) { return text(address, "S_TNAME", "name of the tool to correct"); }
constexpr Parameter dlNumber(std::uint32_t address) {
  return code(address, "S_DLNUM", "DL number of the additive or setup offset");
}
constexpr Parameter zeroOffsetRange(std::uint32_t address) {
  return distance(address, "S_TZL", "zero offset range: smaller differences correct no tool");
}
constexpr Parameter dimensionalDifference(std::uint32_t address) {
  return distance(address, "S_TDIF",
                  "dimensional difference check: beyond it the tool counts as worn out; 0: no check");
}
constexpr Parameter upperTolerance(std::uint32_t address) {
  return length(address, "S_TUL", "upper tolerance limit, from the set value");
}
constexpr Parameter lowerTolerance(std::uint32_t address) {
  return length(address, "S_TLL", "lower tolerance limit, from the set value");
}
constexpr Parameter meanRange(std::uint32_t address) {
  return distance(address, "S_TMV", "range of the mean: larger differences correct at once and whole");
}
constexpr Parameter weight(std::uint32_t address) { return code(address, "S_K", "weighting factor of the mean"); }
constexpr Parameter memories(std::uint32_t address) {
  return code(address, "S_EVNUM", "number of the empirical value plus 10000 times the number of the mean value");
}
inline constexpr std::string_view reservedMeaning = "reserved";
constexpr Parameter reserved(std::uint32_t address) { return code(address, "S_MCBIT", reservedMeaning); }
constexpr Parameter plane(std::uint32_t address) {
  return count<3>(address, "_DMODE", "plane: 0 as active, 1 G17, 2 G18, 3 G19");
}
constexpr Parameter tolerance(std::uint32_t address) {
  return count<1>(address, "_AMODE", "1: S_TUL and S_TLL are a tolerance");
}
constexpr Parameter alternative(std::uint32_t address) { return code(address, "_AMODE", reservedMeaning); }

/// What calls that measure for a zero offset leave of themselves; between the two what else the cycle has.
inline constexpr std::array zeroOffsetCall = {
    ResultDefinition{"_OVI[0]", "number of the zero offset", result::setting()},
    ResultDefinition{"_OVI[2]", "number of the cycle", result::status},
    ResultDefinition{"_OVI[3]", "measuring variant", result::setting()},
    ResultDefinition{"_OVI[5]", "data set of the probe", result::setting()},
};
inline constexpr std::array zeroOffsetOutcome = {
    ResultDefinition{"_OVI[9]", "number of the alarm", result::status},
    ResultDefinition{"_OVI[11]", "1: a zero offset was corrected", result::status},
};

/// Results of a measurement of one coordinate.
inline constexpr std::array coordinateResults = {
    ResultDefinition{"_OVR[0]", {"set value, ", "measuring axis"}, result::set(of::coordinate)},
    ResultDefinition{"_OVR[1]", {"set value, ", "1st axis of the plane"}, result::set(of::position1)},
    ResultDefinition{"_OVR[2]", {"set value, ", "2nd axis of the plane"}, result::set(of::position2)},
    ResultDefinition{"_OVR[3]", {"set value, ", "3rd axis of the plane"}, result::set(of::position3)},
    ResultDefinition{"_OVR[4]", {"actual value, ", "measuring axis"}, result::actual(of::coordinate).main()},
    ResultDefinition{"_OVR[5]", {"actual value, ", "1st axis of the plane"}, result::actual(of::position1)},
    ResultDefinition{"_OVR[6]", {"actual value, ", "2nd axis of the plane"}, result::actual(of::position2)},
    ResultDefinition{"_OVR[7]", {"actual value, ", "3rd axis of the plane"}, result::actual(of::position3)},
    ResultDefinition{"_OVR[16]", {"difference, ", "measuring axis"}, result::difference(of::coordinate)},
    ResultDefinition{"_OVR[17]", {"difference, ", "1st axis of the plane"}, result::difference(of::position1)},
    ResultDefinition{"_OVR[18]", {"difference, ", "2nd axis of the plane"}, result::difference(of::position2)},
    ResultDefinition{"_OVR[19]", {"difference, ", "3rd axis of the plane"}, result::difference(of::position3)},
};

/// What cycles with tool or zero offset correction leave besides their own results.
inline constexpr std::array<ResultDefinition, 18> correctionResultsWithoutLimits = {{
    {"_OVR[20]", "correction value of the tool", result::correction(of::distance)},
    {"_OVR[27]", "zero offset range", result::setting(of::distance)},
    {"_OVR[28]", "safe area", result::setting(of::distance)},
    {"_OVR[29]", "dimensional difference", result::setting(of::distance)},
    {"_OVR[30]", "empirical value", result::statistic(of::distance)},
    {"_OVR[31]", "mean value", result::statistic(of::distance)},
    {"_OVI[0]", "number of the edge (D) or of the zero offset", result::setting()},
    {"_OVI[2]", "number of the cycle", result::status},
    {"_OVI[3]", "measuring variant", result::setting()},
    {"_OVI[4]", "weighting factor", result::setting()},
    {"_OVI[5]", "data set of the probe", result::setting()},
    {"_OVI[6]", "number of the mean value", result::setting()},
    {"_OVI[7]", "number of the empirical value", result::setting()},
    {"_OVI[8]", "number of the corrected tool", result::setting()},
    {"_OVI[9]", "number of the alarm or message", result::status},
    {"_OVI[13]", "DL number", result::setting()},
    {"_OVI[11]", "1: a zero offset was corrected", result::status},
    {"_OVS_TNAME", "name of the corrected tool", result::setting(of::name)},
}};

/// The same with the limits of a tolerance of one dimension.
inline constexpr auto correctionResults = joined(
    std::array<ResultDefinition, 2>{
        {{"_OVR[8]", "upper tolerance limit, from the middle of the tolerance", result::upperLimit(of::distance)},
         {"_OVR[12]", "lower tolerance limit, from the middle of the tolerance", result::lowerLimit(of::distance)}}},
    correctionResultsWithoutLimits);

}  // namespace probewright::cycles::sinumerik::parameters
