#pragma once

#include "simulation/cad_model.hpp"

/// How far faces leave their triangles at most: never only what samples show.
namespace probewright::simulation {

/// How far the corners of an element lie from where its parameters are on the surface of its free-form face: at edges
/// of coarse files, and where a mesher mixed them up.
double cornersApart(const CadElement& element, const CadFace& face);

/// True if it is certain, and quickly found, that the free-form face of an element leaves its triangle by no more than
/// a distance. `apart` is what cornersApart() gives, or more, as below.
bool isCertain(const CadElement& element, const CadFace& face, double distance, double apart);

/// A distance from the triangle that the face does not exceed: `sampled`, where that is certain, otherwise more. Takes
/// long where little is known of the face: it is looked at in at most `most` steps along each side.
double certainDeviation(const CadElement& element, const CadFace& face, double sampled, double apart, double most);

}  // namespace probewright::simulation
