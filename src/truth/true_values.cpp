#include "truth/true_values.hpp"

#include <algorithm>
#include <cmath>

#include "truth/features.hpp"

namespace probewright::truth {

namespace {

using control::Quantity;
using control::ResultRecord;

bool isAngle(const ResultRecord& result) {
  return result.kind.of.quantity == Quantity::Angle || result.kind.of.quantity == Quantity::Projection;
}

bool isActualValue(const ResultRecord& result) {
  return result.kind.role == control::Role::Actual && std::isfinite(result.value);
}

bool isInMachineSystem(const ResultRecord& result) { return result.kind.of.system == control::System::Machine; }

std::optional<records::TrueValue> trueValueOf(const ResultRecord& result, const CycleFeatures& features) {
  const double near = isAngle(result) ? 0.005 : 0.02;
  std::optional<Explanation> best;
  double least = near;
  for (const Explanation& way : features.explanations(result.kind.of)) {
    const double apart = std::abs(way.believed - result.value);
    if (apart >= least) continue;
    least = apart;
    best = way;
  }
  if (!best) return std::nullopt;
  return records::TrueValue{best->truth, best->basis, best->shape};
}

/// True if the table stood as it does at the reading 0 of all rotary axes: then its coordinates are the machine's.
bool tableIsSquare(const control::CycleRecord& record, const machine::MachineDescription& machine) {
  for (const control::TouchRecord& touch : record.touches) {
    if (touch.outcome != "touched") continue;
    for (std::size_t i = 0; const machine::Axis& axis : machine.axes) {
      const double reading = touch.latched[i++];
      if (axis.kind == machine::AxisKind::Rotary && std::abs(std::remainder(reading, 360.0)) > 1e-9) return false;
    }
  }
  return true;
}

std::optional<records::TrueTouch> trueTouchOf(const TouchedPoint& touched, const control::WorkingPlane& plane,
                                              const std::string& solid) {
  records::TrueTouch touch;
  touch.surface = plane.xyzFromPlane(touched.point);
  touch.error = (touched.surface - touched.point).dot(touched.normal);
  touch.solid = solid;
  if (touched.face) touch.shape = nameOf(touched.face->kind);
  return touch;
}

}  // namespace

std::vector<records::CycleTruth> trueValues(const control::Journal& journal, const std::vector<TouchedCycle>& touched,
                                            const simulation::Truth& truth) {
  std::vector<records::CycleTruth> cycles;
  for (std::size_t i = 0; i < touched.size(); ++i) {
    const control::CycleRecord& record = journal.cycles[i];
    records::CycleTruth cycle;
    cycle.touches.resize(record.touches.size());
    for (const TouchedPoint& point : touched[i].points)
      cycle.touches[point.touch] = trueTouchOf(point, touched[i].plane, truth.solids[point.solid].name);
    TouchedCycle asMachine;
    const bool anyAsMachine = std::ranges::any_of(
        record.results, [](const ResultRecord& result) { return isActualValue(result) && isInMachineSystem(result); });
    if (anyAsMachine && tableIsSquare(record, truth.machine)) asMachine = inMachine(touched[i]);
    const CycleFeatures features(touched[i], record.fits), machineFeatures(asMachine, record.fits);
    for (const ResultRecord& result : record.results) {
      cycle.results.push_back(isActualValue(result)
                                  ? trueValueOf(result, isInMachineSystem(result) ? machineFeatures : features)
                                  : std::nullopt);
    }
    cycles.push_back(std::move(cycle));
  }
  return cycles;
}

}  // namespace probewright::truth
