#include <fmt/format.h>

#include <utility>
#include <vector>

#include "base/text.hpp"
#include "conversion/heidenhain_tasks.hpp"
#include "conversion/sinumerik_tasks.hpp"
#include "conversion/to_sinumerik.hpp"
#include "cycles/catalogue.hpp"
#include "geometry/primitives.hpp"

/// What HEIDENHAIN programs read of a cycle, and its verdict, after a measuring cycle of a SINUMERIK.
namespace probewright::conversion {

using namespace language;

namespace {

constexpr int exceededMessage = 67000;  ///< of SETAL: shown, and the program goes on

}  // namespace

std::set<int> ToSinumerik::readResults(const std::string& heidenhainCycle) const {
  std::set<int> read;
  const cycles::CycleDefinition* definition = cycles::heidenhainCycle(std::stoi(heidenhainCycle));
  if (definition == nullptr) return read;
  for (const cycles::ResultDefinition& result : definition->results) {
    if (result.name.size() < 2 || result.name[0] != 'Q' || !isDigit(result.name[1]))
      continue;  // the parameter that cycle 0 names
    const int number = std::stoi(std::string(result.name.substr(1)));
    const bool status = number >= 180 && number <= 183;
    if (!status && usedQ_.contains(number)) read.insert(number);
  }
  return read;
}

std::string ToSinumerik::parameter(int number) {
  VariableRef variable;
  variable.index[0] = Operand::of(number);
  return formulas_.variable(variable);
}

Results ToSinumerik::resultsOf(const MeasuringTask& task, const SinumerikPassage& passage) {
  Results results = sinumerikResults(task);
  if (passage.middle == 0) return results;
  // The cycle counts deviations from the middle of the tolerance.
  const auto fromNominal = [&](Meaning deviation, Meaning actual, const Quantity& nominal) {
    if (results.contains(deviation)) {
      results[deviation] = fmt::format("({})", sinumerikText(Quantity::of(results.at(actual)) - nominal));
    }
  };
  fromNominal(Meaning::Size1Deviation, Meaning::Size1, task.size[0]);
  fromNominal(Meaning::Size2Deviation, Meaning::Size2, task.size[1]);
  fromNominal(Meaning::CoordinateDeviation, Meaning::Coordinate, task.place[static_cast<std::size_t>(task.axis)]);
  return results;
}

void ToSinumerik::copyResults(const Block& block, const std::string& heidenhainCycle, const MeasuringTask& task,
                              const SinumerikPassage& passage) {
  if (heidenhainCycle == "403") return;
  std::set<int> missing = readResults(heidenhainCycle);
  const Results left = resultsOf(task, passage);
  for (const auto& [meaning, name] : heidenhainResults(heidenhainCycle, task)) {
    const int number = std::stoi(name.substr(1));
    const auto found = left.find(meaning);
    if (!usedQ_.contains(number) || found == left.end()) continue;
    // Space angles count about X, Y and Z whatever the tool axis is.
    if (heidenhainCycle == "1420" && toolAxis_ != 'Z') continue;
    missing.erase(number);
    const std::string target = parameter(number);
    if (heidenhainCycle == "1410") {
      // An angle from the first point to the second, in any direction.
      const double offset = normalizedDegrees(task.angle.number() - sinumerikEdgeAngle(task, task.angle).number());
      out_.line(fmt::format("{}={}", target,
                            sinumerikText(meaning == Meaning::Angle ? Quantity::of(found->second) + offset
                                                                    : Quantity::of(found->second))));
      if (meaning == Meaning::Angle && offset == 180) {
        out_.line(fmt::format("IF {}>180", target));
        out_.line(fmt::format("  {0}={0}-360", target));
        out_.line("ENDIF");
      }
    } else if (task.feature == Feature::Edge && task.axis == 0) {
      // The angle counts from the other axis there.
      out_.line(fmt::format("{}={}+90", target, found->second));
      out_.line(fmt::format("IF {}>90", target));
      out_.line(fmt::format("  {0}={0}-180", target));
      out_.line("ENDIF");
    } else if (heidenhainCycle == "431" && meaning == Meaning::Angle) {
      out_.line(fmt::format("{}=ATAN2(SIN(_OVR[4]),COS(_OVR[4])*COS(_OVR[5]))", target));
    } else {
      out_.line(fmt::format("{}={}", target, found->second));
    }
  }
  for (const int number : missing)
    out_.lose(block, fmt::format("Q{}: the SINUMERIK cycle has no such result", number));
}

std::string ToSinumerik::onlyUnlessZero(const std::vector<Quantity>& values, const std::string& condition) {
  if (values.empty()) return condition;
  std::vector<std::string> set;
  for (const Quantity& each : values)
    set.push_back(fmt::format("({}<>0)", sinumerikText(each)));
  const std::string any = fmt::format("{}", fmt::join(set, " OR "));
  return fmt::format("({} AND {})", set.size() == 1 ? any : fmt::format("({})", any), condition);
}

std::string ToSinumerik::exceedsCentre(const std::string& deviation, const Quantity& tolerance) {
  return onlyUnlessZero(tolerance.isNumber() ? std::vector<Quantity>() : std::vector{tolerance},
                        fmt::format("(ABS({})>{})", deviation, sinumerikText(tolerance)));
}

void ToSinumerik::judge(const Block& block, const MeasuringTask& task, const SinumerikPassage& passage) {
  const bool flags = usedQ_.contains(180) || usedQ_.contains(181) || usedQ_.contains(182);
  // What the cycle itself does not judge the program does: as a message, or as the stop that is asked for.
  const bool byTool = passage.correctsTool && passage.call.number("_AMODE") == 1;
  const bool ofSize = (task.limits[0] || task.limits[1]) && !passage.judges && !byTool;
  const bool centre = !(task.centreTolerance[0] == 0) || !(task.centreTolerance[1] == 0);
  const bool tells = (ofSize || centre) && !task.stops;
  if (!flags && !task.stops && !tells) return;
  if (tells) {
    out_.list(block,
              fmt::format("{}: message {} tells when they are exceeded, but the cycle's own verdict and log do not",
                          ofSize ? "these limits" : "Q279, Q280", exceededMessage),
              "compare in the program that reads the results");
  }
  const Results results = resultsOf(task, passage);
  std::vector<std::string> rework, scrap;
  const auto compare = [&](Meaning meaning, const char* sign, const Quantity& limit,
                           const std::vector<Quantity>& unlessZero) {
    return onlyUnlessZero(unlessZero, fmt::format("({}{}{})", results.at(meaning), sign, sinumerikText(limit)));
  };
  const bool surface = task.feature == Feature::Surface;
  static constexpr Meaning sizes[] = {Meaning::Size1Deviation, Meaning::Size2Deviation};
  for (std::size_t i = 0; i < 2; ++i) {
    if (!task.limits[i]) continue;
    Limits limits = *task.limits[i];
    bool inside = isInside(task.feature);
    if (surface && !(limits.upper - limits.lower).isNumber()) {
      out_.list(block, "which limit is the larger one is known only when the program runs",
                "give Q288 and Q289 as numbers, or make sure that Q288 is the larger one");
    } else if (surface && (limits.upper - limits.lower).number() < 0) {
      std::swap(limits.upper, limits.lower);
      std::swap(limits.upperUnlessZero, limits.lowerUnlessZero);
      inside = true;
    }
    const Meaning meaning = surface ? Meaning::CoordinateDeviation : sizes[i];
    // What is too small inside, or too large outside, still has material to take away.
    if (!(limits.upper == unlimited))
      (inside ? scrap : rework).push_back(compare(meaning, ">", limits.upper, limits.upperUnlessZero));
    if (!(limits.lower == -unlimited))
      (inside ? rework : scrap).push_back(compare(meaning, "<", limits.lower, limits.lowerUnlessZero));
  }
  static constexpr Meaning centres[] = {Meaning::Centre1Deviation, Meaning::Centre2Deviation};
  for (std::size_t i = 0; i < 2; ++i) {
    if (task.centreTolerance[i] == 0) continue;
    scrap.push_back(exceedsCentre(results.at(centres[i]), task.centreTolerance[i]));
  }
  decide(rework, scrap, task.stops, tells);
}

void ToSinumerik::decide(const std::vector<std::string>& rework, const std::vector<std::string>& scrap, bool stops,
                         bool tells) {
  const auto either = [](const std::vector<std::string>& conditions) {
    return fmt::format("{}", fmt::join(conditions, " OR "));
  };
  if (usedQ_.contains(180) || usedQ_.contains(181) || usedQ_.contains(182)) {
    const auto state = [&](const char* indent, int good, int again, int lost) {
      out_.line(fmt::format("{}{}={} {}={} {}={}", indent, parameter(180), good, parameter(181), again, parameter(182),
                            lost));
    };
    state("", 1, 0, 0);
    if (!rework.empty()) {
      out_.line(fmt::format("IF {}", either(rework)));
      state("  ", 0, 1, 0);
      out_.line("ENDIF");
    }
    if (!scrap.empty()) {
      out_.line(fmt::format("IF {}", either(scrap)));
      state("  ", 0, 0, 1);
      out_.line("ENDIF");
    }
  }
  std::vector<std::string> exceeded = rework;
  exceeded.insert(exceeded.end(), scrap.begin(), scrap.end());
  if (stops && !exceeded.empty()) {
    out_.line(fmt::format("IF {}", either(exceeded)));
    out_.line("  SETAL(65000) ; tolerance exceeded");
    out_.line("ENDIF");
  }
  if (tells && !exceeded.empty()) {
    out_.line(fmt::format("IF {}", either(exceeded)));
    out_.line(fmt::format("  SETAL({},\"tolerance exceeded\")", exceededMessage));
    out_.line("ENDIF");
  }
}

}  // namespace probewright::conversion
