#pragma once

#include <array>
#include <memory>
#include <string>

#include "simulation/analytic_solids.hpp"

/// Tool touch probes as they truly are.
namespace probewright::simulation {

/// What tools touch of a tool touch probe, and what is fixed to it: the contact, a disc or a cuboid with the middle of
/// its top face in the origin, and the stem below it. Exact to rounding.
class ContactElement final : public DistanceSolid {
public:
  static ContactElement disc(double diameter, double thickness);
  static ContactElement cuboid(double length, double width, double thickness);
  /// Adds a round stem below the contact.
  ContactElement on(double stemDiameter, double stemLength) &&;

  Bounds bounds() const override;
  ClosestPoint closest(const Vector3& point) const override;

private:
  explicit ContactElement(std::shared_ptr<const DistanceSolid> contact, double thickness)
      : contact_(std::move(contact)), thickness_(thickness) {}
  std::shared_ptr<const DistanceSolid> contact_;
  std::shared_ptr<const DistanceSolid> stem_;
  double thickness_ = 0;
};

/// The directions in which a contact can be pushed, in its frame.
enum class Push { PlusX, MinusX, PlusY, MinusY, PlusZ, MinusZ };

struct TrueToolProbe {
  std::string name = "tool touch probe";
  std::shared_ptr<const DistanceSolid> contact;
  Pose tableFromContact = Pose::Identity();
  bool cuboid = false;  ///< the contact is a cuboid
  /// By Push: whether the contact gives way and signals. Pushed in another direction it breaks.
  std::array<bool, 6> gives = {true, true, true, true, false, true};
  double pretravel = 0;      ///< mm, along the path from contact to signal
  double repeatability = 0;  ///< mm, standard deviation of the signal along the path
  double signalDelay = 0;    ///< seconds from signal to latched position: of an infrared probe
  bool switchedOn = true;    ///< an infrared probe can be off
};

}  // namespace probewright::simulation
