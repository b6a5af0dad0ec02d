#pragma once

#include "execution/klartext/motion.hpp"
#include "language/klartext/commands.hpp"

namespace probewright::execution::klartext {

/// PLANE and cycle 19: tilting the working plane.
class Tilting {
public:
  Tilting(RunContext& run, Motion& motion) : run_(run), control_(run.control), motion_(motion) {}

  /// PLANE SPATIAL, PLANE RESET and so on.
  void plane(TransformKind kind, WordRange words, Evaluation& evaluation);
  void tiltByCycle19(WordRange words, Evaluation& evaluation);

private:
  Matrix3 machineFromWorkpiece() const;
  void turnAxes(WordRange words, Evaluation& evaluation);
  void tilt(const std::optional<Matrix3>& tilt, WordRange words, Evaluation& evaluation);
  void keepWantedSide(std::vector<machine::AxisPositions>& solutions, const Vector3& toolAxis, WordRange words,
                      Evaluation& evaluation) const;
  void placeFreeAxis(const Matrix3& machineFromPlane, const Vector3& toolAxis, bool onlyTurned,
                     machine::AxisPositions& target, WordRange words, Evaluation& evaluation) const;
  void positionRotaryAxes(const machine::AxisPositions& target, WordRange words, Evaluation& evaluation);
  void publishRotaryAxes(const machine::AxisPositions& target);

  RunContext& run_;
  control::heidenhain::Control& control_;
  Motion& motion_;
};

}  // namespace probewright::execution::klartext
