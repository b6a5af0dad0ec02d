#pragma once

namespace probewright::simulation {

/// The points after which the mesher gives a face up: many times as many as the faces of large parts need, and seconds
/// of work. A count of work, not of time: on every machine the same faces are given up.
inline constexpr int kMostMeshPoints = 50'000;

/// Triangles only help to find a face, so its inside need not be meshed as finely as its edges: so many deflections
/// they may leave it there. Where a contact needs it they are halved.
inline constexpr double kInteriorDeflections = 60;

}  // namespace probewright::simulation
