#pragma once

#include <array>
#include <optional>

#include "control/scoped.hpp"
#include "execution/klartext/run_context.hpp"

namespace probewright::execution::klartext {

/// Where rotary axes go, by axis index; empty: they stay.
using RotaryTarget = std::array<std::optional<double>, machine::maximumAxes>;

/// M128 and FUNCTION TCPM: which point of the tool follows the program while rotary axes turn, and what A, B, C mean.
///
/// The tip is the lowest point of the tool on its axis, the centre lies R2 with its oversizes above it: the middle of a
/// ball, or of the rounding of a toroid. With TIP-TIP programmed coordinates are those of the tip, which stays still on
/// the workpiece while rotary axes turn; with CENTER-CENTER both are the centre. With TIP-CENTER coordinates are those
/// of the tip, but the tool turns about its centre: that point runs straight, or stays where a block moves rotary axes
/// only.
class ToolGuidance {
public:
  explicit ToolGuidance(RunContext& run) : run_(run), control_(run.control) {}

  /// FUNCTION TCPM, FUNCTION RESET TCPM.
  void switchBy(const Modal& modal, Evaluation& evaluation);
  /// M128, M129, M114, M115.
  void setHoldTip(bool hold);
  /// Hands the point that programmed coordinates name to the channel. To be called after every change of the tool.
  void placeControlledPoint();

  /// AXIS SPAT: A, B, C are space angles of the tool.
  bool spaceAngles() const { return spaceAngles_; }
  void turnToSpaceAngles(WordRange words, RotaryTarget& rotary, Evaluation& evaluation);
  void turnToVector(WordRange words, RotaryTarget& rotary, Evaluation& evaluation);
  void moveTurning(const control::Target& target, control::Feed feed);

  /// Cycles place the tip, whatever FUNCTION TCPM says; calls `work` so. What it ends, M128 or FUNCTION TCPM, is over.
  template <class Work>
  void withTip(Work work) {
    const bool held = control_.channel.holdTip;
    {
      const control::AtEnd placed([this] { placeControlledPoint(); });
      const control::Scoped point(referencePoint_, ReferencePoint::TipTip);
      placeControlledPoint();
      work();
    }
    if (held && !control_.channel.holdTip) setHoldTip(false);
  }

private:
  /// The point of the tool that the program names, and the one about which rotary axes turn the tool.
  enum class ReferencePoint { TipTip, TipCentre, CentreCentre };

  void turnTo(const Vector3& direction, RotaryTarget& rotary) const;

  RunContext& run_;
  control::heidenhain::Control& control_;
  ReferencePoint referencePoint_ = ReferencePoint::TipTip;
  bool spaceAngles_ = false;
  Vector3 toolAngles_ = Vector3::Zero();  ///< as last programmed with AXIS SPAT
};

}  // namespace probewright::execution::klartext
