#pragma once

#include <vector>

#include "control/journal.hpp"

namespace probewright::cycles {

/// Which of the results of a cycle answer the question it was called for: the angles of a plane, centre and diameter of
/// a hole, what a calibration found: those that the catalogue ranks as main. The rest are deviations, set values,
/// limits and what describes the call. One entry a result, in their order.
///
/// Results with a verdict are always among them. Of a cycle that leaves none of its main results, because this variant
/// measures something else, the next best ones count: of a calibration of one direction its trigger point. A name that
/// the catalogue does not list, such as the parameter that the program chose for the result of cycle 0, is a main
/// result. Of a cycle that the catalogue does not have, the first six are.
std::vector<bool> mainResults(const control::CycleRecord& cycle);

}  // namespace probewright::cycles
