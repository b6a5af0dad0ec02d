#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/number_text.hpp"
#include "truth/entries.hpp"
#include "truth/family_truth.hpp"
#include "truth/features.hpp"
#include "truth/shapes.hpp"

namespace probewright::truth {

using control::Along;
using control::Quantity;
using records::EntryTruth;

WrittenValues writtenValues(const control::Journal& journal) {
  WrittenValues values;
  const auto take = [&](const control::WriteRecord& write, std::optional<std::size_t> cycle) {
    if (const auto number = parseDecimal(write.after))
      values[{write.table, write.entry}] = {*number, parseDecimal(write.before), cycle};
  };
  for (const control::WriteRecord& write : journal.writes)
    take(write, std::nullopt);
  for (std::size_t i = 0; i < journal.cycles.size(); ++i)
    for (const control::WriteRecord& write : journal.cycles[i].writes)
      take(write, i);
  return values;
}

namespace {

/// How far a cycle measured beside the truth: along the axes of the working plane and about them.
struct CycleErrors {
  std::array<std::optional<double>, 3> position, angle;
  std::array<double, 3> believedAngle{};
};

std::optional<int> placeOf(Along along, const control::WorkingPlane& plane) {
  switch (along) {
    case Along::First:
      return 0;
    case Along::Second:
      return 1;
    case Along::Third:
    case Along::Table:
      return 2;
    case Along::X:
    case Along::A:
    case Along::Y:
    case Along::B:
    case Along::Z: {
      const int xyz = along == Along::X || along == Along::A ? 0 : along == Along::Z ? 2 : 1;
      for (int i = 0; i < 3; ++i)
        if (plane.axis(i) == xyz) return i;
      return std::nullopt;
    }
    default:
      return std::nullopt;
  }
}

bool isPosition(Quantity quantity) {
  return quantity == Quantity::Centre || quantity == Quantity::Corner || quantity == Quantity::Coordinate;
}

/// The last touch along an axis, if all touches along it were on one flat face, or there was one only.
const TouchedPoint* onlyFaceAlong(const TouchedCycle& touched, Eigen::Index axis) {
  const TouchedPoint* only = nullptr;
  for (const TouchedPoint& point : touched.points) {
    if (std::abs(point.direction[axis]) < 0.9) continue;
    const bool flat = point.face && point.face->kind == simulation::AnalyticSurface::Kind::Plane;
    if (only != nullptr && !(flat && sameFace(*only, point))) return nullptr;
    only = &point;
  }
  return only;
}

CycleErrors errorsOf(const control::CycleRecord& record, const TouchedCycle& touched,
                     const records::CycleTruth& truth) {
  CycleErrors errors;
  const bool several = std::ranges::any_of(record.results, [](const control::ResultRecord& result) {
    return isPosition(result.kind.of.quantity) && result.kind.of.item > 1;
  });
  bool planeMeasured = false;
  for (std::size_t i = 0; i < record.results.size(); ++i) {
    const control::ResultRecord& result = record.results[i];
    const control::Characteristic& of = result.kind.of;
    if (result.kind.role != control::Role::Actual || of.system != control::System::Workpiece) continue;
    if (of.item > (several ? 0 : 1)) continue;  // of several alike none alone decides
    const bool position = isPosition(of.quantity);
    planeMeasured = planeMeasured || of.quantity == Quantity::Centre || of.quantity == Quantity::Corner;
    if (!truth.results[i]) continue;
    auto place = placeOf(of.along, touched.plane);
    if (position && !place && !touched.points.empty()) {
      // The first touch measures it; one in the tool axis may follow.
      Eigen::Index along = 0;
      touched.points.front().direction.cwiseAbs().maxCoeff(&along);
      place = static_cast<int>(along);
    }
    if (!place) continue;
    const auto at = static_cast<std::size_t>(*place);
    const double error = result.value - truth.results[i]->value;
    if (position && !errors.position[at]) {
      errors.position[at] = error;
    } else if (of.quantity == Quantity::Angle && !errors.angle[at]) {
      errors.angle[at] = error;
      errors.believedAngle[at] = result.value;
    }
  }
  // Numbers that no result shows: by the one flat face that was touched in their direction.
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    if (errors.position[i] || (planeMeasured && i != 2)) continue;
    if (const TouchedPoint* point = onlyFaceAlong(touched, axis)) {
      if (const auto beyond = distanceToFace(*point, point->surface, Vector3::Unit(axis)))
        errors.position[i] = -*beyond;
    }
  }
  if (!errors.angle[2]) {
    const auto ways = explanations({Quantity::Angle, Along::Third}, touched, record.fits);
    const auto straight =
        std::ranges::min_element(ways, {}, [](const Explanation& way) { return std::abs(way.believed); });
    if (straight != ways.end()) {
      errors.angle[2] = straight->believed - straight->truth;
      errors.believedAngle[2] = straight->believed;
    }
  }
  return errors;
}

/// The error of a number that was written after that measurement.
std::optional<double> errorOf(const FrameNumber& number, const Written& written, const CycleErrors& errors,
                              const TouchedCycle& touched) {
  if (touched.points.empty()) return std::nullopt;
  const Matrix3 machineFromPlane = touched.points.front().planeFromTable.linear().inverse();
  if (!number.angle) {
    Vector3 error = Vector3::Zero();
    double known = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = static_cast<Eigen::Index>(i);
      if (!errors.position[i]) continue;
      error[axis] = *errors.position[i];
      known = std::max(known, std::abs(machineFromPlane.col(axis).normalized()[number.axis]));
    }
    if (known < 0.5) return std::nullopt;  // nothing was measured in this direction
    return (machineFromPlane * error)[number.axis];
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    if (!errors.angle[i] || std::abs(machineFromPlane.col(axis).normalized()[number.axis]) < 0.9) continue;
    // An offset of a rotary axis may count against the angle that was measured.
    const double change = written.value - written.before.value_or(0);
    const double quarter = std::remainder(errors.believedAngle[i], 90.0);
    const auto apart = [&](double sense) {
      return std::min(std::abs(change - sense * quarter), std::abs(written.value - sense * quarter));
    };
    const double sense = apart(-1) < apart(1) ? -1 : 1;
    return sense * *errors.angle[i];
  }
  return std::nullopt;
}

}  // namespace

std::vector<EntryTruth> frameEntries(const session::RunOutcome& outcome, const std::vector<TouchedCycle>& touched,
                                     const std::vector<records::CycleTruth>& cycles) {
  std::vector<EntryTruth> entries;
  const FamilyTruth* family = familyTruth(outcome.control);
  if (family == nullptr) return entries;
  const control::Journal& journal = outcome.journal;
  for (const auto& [place, written] : writtenValues(journal)) {
    if (!written.cycle || *written.cycle >= cycles.size()) continue;
    const auto number = family->frameNumber(place.first, place.second);
    if (!number) continue;
    const std::size_t cycle = *written.cycle;
    const CycleErrors errors = errorsOf(journal.cycles[cycle], touched[cycle], cycles[cycle]);
    const auto error = errorOf(*number, written, errors, touched[cycle]);
    if (!error) continue;
    auto entry = std::ranges::find_if(
        entries, [&](const EntryTruth& other) { return other.kind == number->kind && other.name == number->name; });
    if (entry == entries.end()) {
      EntryTruth made;
      made.kind = number->kind;
      made.name = number->name;
      entry = entries.insert(entries.end(), std::move(made));
    }
    entry->cycle = std::max(entry->cycle.value_or(0), cycle);
    const double unit = number->angle || family->unitOf == nullptr ? 1 : family->unitOf(outcome, place.first);
    const double value = written.value * unit;
    entry->values.push_back({number->label, number->angle ? "deg" : "mm", value, value - *error});
    auto& apart = number->angle ? entry->angle : entry->distance;
    apart = std::hypot(apart.value_or(0), *error);
  }
  return entries;
}

}  // namespace probewright::truth
