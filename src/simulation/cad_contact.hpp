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

/// Where a free-form face is met near a triangle of its tessellation.
struct FaceQuestion {
  CadElement triangle;
  double soonest = 0;            ///< no meeting there is earlier
  bool isSolved = false;         ///< the whole surface is touched at a place near the triangle
  Vector2 at = Vector2::Zero();  ///< the parameters of that place
  double when = 0;               ///< and the distance along the way
};

/// A face of any shape, near one triangle of its tessellation; `coarse` is the meeting with the grown triangle. False
/// if the search does not tell where the ball meets it. True does not mean that there is no earlier meeting: see
/// isClearBefore.
bool meetFaceNear(const CadFace& face, FaceQuestion& question, const Meeting& coarse, const Way& way, double radius,
                  Meeting& best);

/// True if it is certain that the ball touches nothing of a face near a triangle before the touch that meetFaceNear
/// found there. Quick, and often enough: where the face does not bend around the ball.
bool isClearBefore(const CadFace& face, const FaceQuestion& question, const Way& way, double radius);

/// The closer look: finds what the ball meets near a triangle before it makes the best contact so far, and proves that
/// there is nothing else. The faster the more is known already of other faces and edges.
/// `boxesLeft` counts down what is looked at; when it is used up, planes stand for what is left of the surface.
void meetFaceClosely(const CadFace& face, const FaceQuestion& question, const Way& way, double radius, int& boxesLeft,
                     Meeting& best);

/// A straight or round edge with its ends, whole.
void meetSimpleEdge(const CadEdge& edge, const Way& way, double radius, Meeting& best);

/// Any edge near one of its chords, with the chord's ends. The kink of a face counts within the face's domain only.
/// `piecesLeft` counts down what is looked at; when it is used up, chords stand for what is left of the edge.
void meetEdgeNear(const CadEdge& edge, const TrimmedDomain* within, const CadElement& chord, const Way& way,
                  double radius, int& piecesLeft, Meeting& best);

}  // namespace probewright::simulation
