#pragma once

#include <optional>

#include "cycles/heidenhain/context.hpp"
#include "kinematics/chain_fit.hpp"

/// How cycles 451 to 453 find the calibration sphere with the rotary axes at whatever angles.
namespace probewright::cycles::heidenhain {

/// The sphere as it was found at one posture.
struct FoundSphere {
  kinematics::SphereSighting sighting;
  PartInMachine centre;  ///< as the active kinematics sees it
  double radius = 0;     ///< mm
};

/// Whether the measured radius must be Q407: cycle 453 measures once more before it refuses.
enum class RadiusCheck { Yes, No, AtSecond };

/// Angles are those of the program: machine angles less the offset of the preset. The pattern of touches lies square to
/// the tool, its first touch Q380 from the main axis of the working plane as the spindle carries it. Reads Q407, Q320,
/// Q408, Q253, Q380 and Q423 of the call.
class SphereSearch {
public:
  /// `centre`: where the sphere is expected, at the reference posture.
  SphereSearch(Context& context, const PartInMachine& centre);
  /// Channel and coordinates are the program's again.
  ~SphereSearch();
  SphereSearch(const SphereSearch&) = delete;
  SphereSearch& operator=(const SphereSearch&) = delete;

  /// From where the program has left the probe to above the sphere, the rotary axes standing.
  void moveOver();

  /// The rotary axes to `angles`, one after the other in the order A, B, C or all at once; the others stand. With Q408
  /// the probe rises and stands over the preset meanwhile, without it points at the sphere.
  enum class Order { Together, OneByOne };
  void turnTo(const machine::AxisPositions& angles, const std::vector<std::size_t>& axes,
              Order order = Order::Together);

  /// Pole and Q423 touches around; ends above the pole. Throws Alarm if the radius is not Q407.
  FoundSphere measure(RadiusCheck check = RadiusCheck::Yes);

  /// The sphere as the present active kinematics sees a sighting, at the reference posture.
  PartInMachine seen(const kinematics::SphereSighting& sighting) const;
  /// From now on it is expected there.
  void expectAt(const PartInMachine& centre) { centre_ = centre; }
  const PartInMachine& expected() const { return centre_; }

  /// Where the probe points now, as the tilt of a working plane in the workpiece system.
  Matrix3 tilt() const;

private:
  /// Coordinates with the origin where the sphere is expected and the tool axis of the working plane along the tool.
  void lookAlongTool();
  void retract();
  void carryOut(const machine::AxisPositions& target, const std::vector<std::size_t>& axes);
  /// Spindle axes in machine coordinates at the reference posture.
  Matrix3 spindleAxes() const;
  /// From the tip towards the spindle, in the spindle frame.
  Vector3 alongTool() const;
  double aboveSphere() const;

  Context& context_;
  control::Channel& channel_;
  probing::HeidenhainProber prober_;
  PartInMachine centre_;
  double radius_ = 0, clearance_ = 0, retraction_ = 0;
  machine::Feed rotaryFeed_;
};

/// The preset into the middle of the sphere that the probe stands above, found twice because it stands there roughly
/// (Q431 = 1 and 3). Returns where that is.
PartInMachine presetIntoSphere(Context& context);

/// Moves the origin of the active preset to `centre`.
void setSpherePreset(Context& context, const PartInMachine& centre);

}  // namespace probewright::cycles::heidenhain
