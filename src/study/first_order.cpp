#include "study/first_order.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cycles/main_results.hpp"
#include "study/moved_touches.hpp"

namespace probewright::study {

using control::Along;
using control::CycleRecord;
using control::FitRecord;
using control::Quantity;
using control::ResultRecord;
using control::Role;
using control::TouchRecord;

namespace {

std::optional<double> variance(const FitRecord& fit, std::string_view member) {
  const auto found = std::ranges::find(fit.members, member);
  if (found == fit.members.end()) return std::nullopt;
  const auto place = static_cast<std::size_t>(found - fit.members.begin());
  return fit.cofactors[place * fit.members.size() + place];
}

std::optional<double> rootOf(const std::optional<double>& variance, double factor = 1) {
  if (!variance || !(*variance >= 0)) return std::nullopt;
  return factor * std::sqrt(*variance);
}

/// "main", "minor", "tool": as fits call the axes of the working plane.
std::string_view axisOf(Along along) {
  switch (along) {
    case Along::First:
      return "main";
    case Along::Second:
      return "minor";
    case Along::Third:
      return "tool";
    default:
      return "";
  }
}

/// What a unit vector in a plane that varies by `main` and `minor` turns by: its variance lies across it.
std::optional<double> turn(const FitRecord& fit, std::string_view of) {
  const auto main = variance(fit, std::string(of) + ".main"), minor = variance(fit, std::string(of) + ".minor");
  if (!main || !minor) return std::nullopt;
  return *main + *minor;
}

std::optional<double> byFit(const FitRecord& fit, const ResultRecord& result) {
  const Quantity quantity = result.kind.of.quantity;
  // Spheres with more points than they need are evaluated in other ways than by the fit of the record.
  if (fit.shape == "sphere" && fit.degreesOfFreedom > 0) return std::nullopt;
  if (fit.shape == "circle" || fit.shape == "sphere") {
    if (quantity == Quantity::Centre)
      return rootOf(variance(fit, "centre." + std::string(axisOf(result.kind.of.along))));
    if (quantity == Quantity::Diameter) return rootOf(variance(fit, "radius"), 2);
    if (quantity == Quantity::Radius) return rootOf(variance(fit, "radius"));
  }
  if (fit.shape == "line" && (quantity == Quantity::Angle || quantity == Quantity::Projection))
    return rootOf(turn(fit, "direction"), degreesFromRadians(1));
  // Near level planes only: what a turn about one axis does to the angle about another is of second order there.
  constexpr double level = 5;
  if (fit.shape == "plane" && quantity == Quantity::Projection && std::abs(result.value) < level) {
    if (result.kind.of.along == Along::A) return rootOf(variance(fit, "normal.minor"), degreesFromRadians(1));
    if (result.kind.of.along == Along::B) return rootOf(variance(fit, "normal.main"), degreesFromRadians(1));
  }
  return std::nullopt;
}

/// The scatter of a touch moves its point along the way of the probe alone.
std::optional<double> bySingle(const Vector3& way, const ResultRecord& result) {
  if (result.kind.of.quantity != Quantity::Coordinate) return std::nullopt;
  const auto along = [&](Eigen::Index axis) {
    const double share = std::abs(way[axis]);
    return share > 1e-9 ? std::optional(share) : std::nullopt;  // across the way it is what the program says
  };
  switch (result.kind.of.along) {
    case Along::First:
      return along(0);
    case Along::Second:
      return along(1);
    case Along::Third:
      return along(2);
    default:
      return 1.0;
  }
}

/// Touches in pairs that face each other in the working plane: each pair makes a size and its middle.
bool inPairs(const std::vector<Vector3>& ways) {
  if (ways.size() != 2 && ways.size() != 4) return false;
  for (std::size_t i = 0; i < ways.size(); i += 2)
    if ((ways[i] + ways[i + 1]).norm() > 1e-6 || std::abs(ways[i].z()) > 1e-9) return false;
  return true;
}

std::optional<double> byPairs(const std::vector<Vector3>& ways, const ResultRecord& result) {
  switch (result.kind.of.quantity) {
    case Quantity::Diameter:
    case Quantity::Width:
    case Quantity::Length:
      return std::sqrt(2.0);
    case Quantity::Centre: {
      const Along along = result.kind.of.along;
      if (along != Along::First && along != Along::Second) return std::nullopt;
      double variance = 0;
      for (std::size_t i = 0; i < ways.size(); i += 2)
        variance += std::pow(ways[i][along == Along::First ? 0 : 1], 2) / 2;
      return variance > 1e-9 ? std::optional(std::sqrt(variance)) : std::nullopt;
    }
    case Quantity::Coordinate:  // of the middle between the two
      return ways.size() == 2 && result.kind.of.along == Along::Measuring ? std::optional(std::sqrt(0.5))
                                                                          : std::nullopt;
    default:
      return std::nullopt;
  }
}

/// Errors of the axes, squareness and their like: of account to every touch, and the same for all of a result.
bool hasErrors(const simulation::MachineErrors& errors) {
  const auto wrong = [](const simulation::AxisErrors& axis) {
    return axis.scale != 0 || axis.offset != 0 || axis.backlash != 0 || !axis.deviations.empty();
  };
  return std::ranges::any_of(errors.axes, wrong) || !errors.squareness.empty() || !errors.rotaryAxes.empty() ||
         !errors.spindleTilt.isZero(0) || !errors.thermal.empty();
}

bool isMeasured(const ResultRecord& result) {
  return (result.kind.role == Role::Actual || result.kind.role == Role::Difference) &&
         result.kind.of.quantity != Quantity::None && result.kind.of.quantity != Quantity::Name;
}

/// Of what first order may be wrong by.
constexpr double tolerated = 0.05;

}  // namespace

std::optional<double> sensitivityToTouches(const CycleRecord& cycle, const ResultRecord& result) {
  if (!isMeasured(result)) return std::nullopt;
  if (cycle.fits.size() == 1) return byFit(cycle.fits.front(), result);
  if (!cycle.fits.empty()) return std::nullopt;
  std::vector<Vector3> ways;  // along main, minor and tool axis, as results count
  for (const TouchRecord& touch : cycle.touches)
    if (touch.outcome == "touched") ways.push_back(cycle.plane.planeFromXyz(touch.direction));
  if (ways.size() == 1) return bySingle(ways.front(), result);
  return inPairs(ways) ? byPairs(ways, result) : std::nullopt;
}

double scatterOf(const simulation::Truth& truth) {
  double scatter = 0;
  for (const simulation::TrueTool& tool : truth.tools)
    if (tool.kind == simulation::ToolKind::Probe) scatter = std::max(scatter, tool.probe.repeatability);
  return scatter;
}

std::string firstOrderText(const control::Journal& journal, const FirstOrder& done) {
  std::string text = "\nUncertainties (k = 2) from the scatter of the probe, to first order (GUM)\n";
  for (std::size_t c = 0; c < journal.cycles.size(); ++c) {
    const CycleRecord& cycle = journal.cycles[c];
    const std::vector<bool> isMain = cycles::mainResults(cycle);
    for (std::size_t i = 0; i < cycle.results.size(); ++i) {
      const ResultRecord& result = cycle.results[i];
      if (!isMain[i] || !result.uncertainty) continue;
      text += fmt::format(
          "  {} {}: {:.6f} +- {:.2g} {}{}\n", cycle.name, result.name, result.value, *result.uncertainty, result.unit,
          done.doubtful.contains({c, i}) ? "  not trustworthy: first order is wrong by more than 5 %" : "");
    }
  }
  if (!done.doubtful.empty())
    text += fmt::format(
        "  {} values are not trustworthy: their fits do not follow the scatter of the touches linearly. Measure a\n"
        "  larger arc or more touches, or let `probewright study` say what they are worth\n",
        done.doubtful.size());
  if (done.withheld > 0)
    text +=
        fmt::format("  {} values have none: how they follow the touches is not known to first order\n", done.withheld);
  for (const std::string& what : done.notHeld)
    text += fmt::format("  not held: {}\n", what);
  return text + "  `probewright study` holds everything that a setup can say (docs/uncertainty.md)\n";
}

FirstOrder addUncertainties(control::Journal& journal, const simulation::Truth& truth) {
  FirstOrder done;
  const double scatter = scatterOf(truth);
  bool differ = false, lobes = false;
  for (const simulation::TrueTool& tool : truth.tools) {
    if (tool.kind != simulation::ToolKind::Probe) continue;
    differ = differ || tool.probe.repeatability != scatter;
    lobes = lobes || tool.probe.lobing != 0;
  }
  if (!(scatter > 0)) {
    done.notHeld.emplace_back("the setup gives the touch probe no repeatability: nothing can be said");
    return done;
  }
  bool corrected = false, follows = false;  // what later cycles measure from
  for (std::size_t c = 0; c < journal.cycles.size(); ++c) {
    CycleRecord& cycle = journal.cycles[c];
    follows = follows || (corrected && !cycle.results.empty());
    corrected = corrected || !cycle.writes.empty();
    std::optional<MovedTouches> moved;
    for (std::size_t i = 0; i < cycle.results.size(); ++i) {
      ResultRecord& result = cycle.results[i];
      if (!isMeasured(result)) continue;
      const auto sensitivity = sensitivityToTouches(cycle, result);
      ++(sensitivity ? done.given : done.withheld);
      if (!sensitivity) continue;
      const double uncertainty = *sensitivity * scatter;
      result.uncertainty = 2 * uncertainty;
      if (cycle.fits.empty()) continue;  // single touches and pairs: linear
      if (!moved) moved.emplace(cycle, cycle.fits.front(), scatter);
      const auto found = moved->uncertaintyOf(result);
      if (!found || std::abs(*found - uncertainty) > tolerated * uncertainty) done.doubtful.emplace(c, i);
    }
  }
  if (follows)
    done.notHeld.emplace_back("the scatter of what earlier cycles have set or calibrated, and later ones measure by");
  if (lobes) done.notHeld.emplace_back("the lobes of the probe: they act on all touches of a feature together");
  if (hasErrors(truth.errors)) done.notHeld.emplace_back("the errors of the machine");
  if (differ) done.notHeld.emplace_back("which probe has measured: the scatter is that of the one that repeats worst");
  if (!truth.toolProbes.empty()) done.notHeld.emplace_back("the scatter of the tool touch probe");
  return done;
}

}  // namespace probewright::study
