#pragma once

#include <TopoDS_Shape.hxx>
#include <memory>

#include "simulation/mesh_solid.hpp"
#include "worlds.hpp"

/// Judges the contacts of ideal probes by means that share nothing with the search that found them: OpenCASCADE's
/// distances between shapes, and a fine tessellation that brackets every contact.
namespace probewright::simulation::testing {

class Oracle {
public:
  /// The shape must be the one that the solid was made of.
  /// `doubt`: how far the solid may be from it all the same, in mm.
  explicit Oracle(const TopoDS_Shape& shape, double doubt = 0);

  /// What is wrong with the contact that a solid reports for a way; empty if nothing is. `exactly`: by OpenCASCADE's
  /// distance too, which takes milliseconds.
  std::string objectionTo(const std::optional<BallContact>& contact, const Vector3& from, const Vector3& to,
                          double radius, bool exactly) const;

  struct Way {
    Vector3 from, to;
    double radius;
  };
  /// A way towards the shape: from outside or from somewhere about it, many along the axes or through its middle.
  Way randomWay(std::mt19937_64& random) const;

  /// How far the tessellation may be from the shape.
  double tolerance() const { return tolerance_; }

private:
  /// Between two values where a vertex is nearest: OpenCASCADE takes it for the ends of its edges, but their curves may
  /// end elsewhere within its tolerance, and these ends belong to the shape.
  struct Distance {
    double least = 1e300, most = 1e300;
  };
  Distance exactDistance(const Vector3& point, double about) const;

  TopoDS_Shape shape_;
  std::unique_ptr<MeshSolid> mesh_;
  std::vector<Vector3> places_;  ///< on the surface
  Bounds bounds_;                ///< of these
  struct Face;
  std::shared_ptr<const std::vector<Face>> faces_;
  double tolerance_ = 0;
  double precision_ = 1e-6;  ///< of exact distances
  bool closed_ = false;
  bool skin_ = false;  ///< faces without a body have no inside, even where they close
};

/// Sends `count` ways at a solid and names the first few on which it errs. Returns how many ended in a contact.
int expectTrueContacts(const std::string& name, const TopoDS_Shape& shape, const Solid& solid, std::mt19937_64& random,
                       int count, double doubt = 0);

/// The campaign's size: PROBEWRIGHT_CAMPAIGN, 1 if that is not set.
int campaignFactor();

/// Where the campaign's random worlds begin: PROBEWRIGHT_CAMPAIGN_FROM, 0 if that is not set.
int campaignStart();

/// Ways sent at one part: `usual`, more in a campaign, as making a part takes longer than many ways.
int waysInCampaign(int usual);

}  // namespace probewright::simulation::testing
