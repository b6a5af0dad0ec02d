#pragma once

#include <random>

#include "geometry/primitives.hpp"

namespace probewright::kinematics {

/// Random values of a seeded stream.
class Dice {
public:
  explicit Dice(unsigned seed) : engine_(seed) {}
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }
  Vector3 within(double reach) {
    const double x = between(-reach, reach), y = between(-reach, reach);
    return {x, y, between(-reach, reach)};
  }

private:
  std::mt19937_64 engine_;
};

}  // namespace probewright::kinematics
