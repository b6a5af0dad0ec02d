#include "conversion/meanings.hpp"

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

std::optional<Meaning> differenceOf(const control::Characteristic& of) {
  const std::optional<Meaning> actual = actualOf(of);
  if (!actual) return std::nullopt;
  switch (*actual) {
    case Meaning::Centre1:
      return Meaning::Centre1Deviation;
    case Meaning::Centre2:
      return Meaning::Centre2Deviation;
    case Meaning::Size1:
      return Meaning::Size1Deviation;
    case Meaning::Size2:
      return Meaning::Size2Deviation;
    case Meaning::Coordinate:
      return Meaning::CoordinateDeviation;
    case Meaning::Angle:
      // The two angles of a plane have no differences on the other side.
      return of.along == Along::Third ? std::optional(Meaning::AngleDeviation) : std::nullopt;
    default:
      return std::nullopt;
  }
}

std::optional<Meaning> setOf(const control::Characteristic& of) {
  const std::optional<Meaning> actual = actualOf(of);
  if (!actual) return std::nullopt;
  switch (*actual) {
    case Meaning::Centre1:
      return Meaning::Centre1Set;
    case Meaning::Centre2:
      return Meaning::Centre2Set;
    case Meaning::Size1:
      return Meaning::Size1Set;
    case Meaning::Size2:
      return Meaning::Size2Set;
    case Meaning::Coordinate:
      return Meaning::CoordinateSet;
    default:
      return std::nullopt;
  }
}

}  // namespace

std::optional<Meaning> meaningOf(const control::ResultKind& kind) {
  if (kind.of.system != control::System::Workpiece || kind.of.item != 0) return std::nullopt;
  if (kind.role == Role::Actual) return actualOf(kind.of);
  if (kind.role == Role::Difference) return differenceOf(kind.of);
  if (kind.role == Role::Set) return setOf(kind.of);
  return std::nullopt;
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
