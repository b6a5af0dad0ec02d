#pragma once

namespace probewright::simulation {

/// Tells when the steps of an iteration have become small enough. Where coordinates are large, rounding keeps them from
/// shrinking on: then the last step was as good as any.
class Settling {
public:
  explicit Settling(double enough) : enough_(enough) {}
  bool after(double step) {
    constexpr double kRounding = 1e-9;
    const bool settled = step < enough_ || (step < kRounding && step >= last_);
    last_ = step;
    return settled;
  }

private:
  double enough_;  ///< mm, as the steps
  double last_ = 1e300;
};

}  // namespace probewright::simulation
