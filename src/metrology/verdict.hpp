#pragma once

namespace probewright::metrology {

/// What becomes of a workpiece with this dimension; None where nothing is monitored. In ascending severity.
enum class Verdict { None, Good, Rework, Scrap };

}  // namespace probewright::metrology
