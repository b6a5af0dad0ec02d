#include "conversion/meanings.hpp"

#include <algorithm>
#include <array>

namespace probewright::conversion {

namespace {

using control::Along;
using control::Role;

std::optional<Meaning> actualOf(const control::Characteristic& of) {
  switch (of.quantity) {
    case control::Quantity::Centre:
    case control::Quantity::Corner:
      if (of.along == Along::First) return Meaning::Centre1;
      if (of.along == Along::Second) return Meaning::Centre2;
      return std::nullopt;
    case control::Quantity::Diameter:
    case control::Quantity::Width:
      return Meaning::Size1;
    case control::Quantity::Length:
      if (of.along == Along::First) return Meaning::Size1;
      if (of.along == Along::Second) return Meaning::Size2;
      return std::nullopt;
    case control::Quantity::Coordinate:
      if (of.along == Along::Measuring) return Meaning::Coordinate;
      return std::nullopt;
    case control::Quantity::Angle:
    case control::Quantity::Projection:
      if (of.along == Along::Third || of.along == Along::First || of.along == Along::X || of.along == Along::A)
        return Meaning::Angle;
      if (of.along == Along::Second || of.along == Along::Y || of.along == Along::B) return Meaning::Angle2;
      return std::nullopt;
    default:
      return std::nullopt;
  }
}

/// What a cycle also tells of a quantity: its deviation, and the value that the call expects.
struct Related {
  Meaning actual, deviation;
  std::optional<Meaning> set;
};
constexpr std::array related = {Related{Meaning::Centre1, Meaning::Centre1Deviation, Meaning::Centre1Set},
                                Related{Meaning::Centre2, Meaning::Centre2Deviation, Meaning::Centre2Set},
                                Related{Meaning::Size1, Meaning::Size1Deviation, Meaning::Size1Set},
                                Related{Meaning::Size2, Meaning::Size2Deviation, Meaning::Size2Set},
                                Related{Meaning::Coordinate, Meaning::CoordinateDeviation, Meaning::CoordinateSet},
                                Related{Meaning::Angle, Meaning::AngleDeviation, std::nullopt}};

}  // namespace

std::optional<Meaning> meaningOf(const control::ResultKind& kind) {
  if (kind.of.system != control::System::Workpiece || kind.of.item != 0) return std::nullopt;
  const std::optional<Meaning> actual = actualOf(kind.of);
  if (kind.role == Role::Actual) return actual;
  const auto found = std::ranges::find_if(related, [&](const Related& each) { return each.actual == actual; });
  if (!actual || found == related.end()) return std::nullopt;
  if (kind.role == Role::Set) return found->set;
  // The two angles of a plane have no differences on the other side.
  const bool ofPlane = actual == Meaning::Angle && kind.of.along != Along::Third;
  return kind.role == Role::Difference && !ofPlane ? std::optional(found->deviation) : std::nullopt;
}

Results resultsOf(const cycles::CycleDefinition& cycle, int units) {
  Results results;
  for (const cycles::ResultDefinition& result : cycle.results) {
    if (units >= 0 && !result.belongsTo(units)) continue;
    // The first that means it: projections come before space angles.
    if (const auto meaning = meaningOf(result.kind)) results.emplace(*meaning, result.name);
  }
  return results;
}

}  // namespace probewright::conversion
