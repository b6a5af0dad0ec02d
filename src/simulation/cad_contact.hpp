#pragma once

#include "simulation/cad_model.hpp"

/// The exact contact of a moving ball with one face or edge. Each function that meets one puts a meeting earlier than
/// the best into `best`. Accuracy 1e-8 mm wherever the ball does not merely graze.
namespace probewright::simulation {

/// Puts a meeting into `best` if it is earlier.
inline void keep(Meeting& best, double when, const Vector3& point, const Vector3& normal) {
  if (when < best.when) best = {when, point, normal};
}

/// A face with closed forms, whole.
void meetAnalyticFace(const CadFace& face, const Way& way, double radius, Meeting& best);

/// A face of any shape, near one triangle of its tessellation; `coarse` is the meeting with the grown triangle. False
/// if that is not enough to tell where the ball meets it; then it takes a closer look.
bool meetFaceNear(const CadFace& face, const Adaptor3d_Surface& surface, const CadElement& triangle,
                  const Meeting& coarse, const Way& way, double radius, Meeting& best);

/// The closer look: slow, and the faster the more is known already of other faces and edges.
void meetFaceClosely(const CadFace& face, const Adaptor3d_Surface& surface, const CadElement& triangle, const Way& way,
                     double radius, Meeting& best);

/// A straight or round edge with its ends, whole.
void meetSimpleEdge(const CadEdge& edge, const Way& way, double radius, Meeting& best);

/// Any edge near one of its chords, with the chord's ends. The kink of a face counts within the face's domain only.
void meetEdgeNear(const CadEdge& edge, const TrimmedDomain* within, const CadElement& chord, const Meeting& coarse,
                  const Way& way, double radius, Meeting& best);

}  // namespace probewright::simulation
