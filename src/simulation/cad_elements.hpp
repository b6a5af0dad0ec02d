#pragma once

#include <TopoDS_Face.hxx>
#include <vector>

#include "simulation/cad_model.hpp"

/// What the search tree of a model finds: triangles of faces and chords of edges.
namespace probewright::simulation {

/// The triangles of a face that has a mesh, true to its edges within `deflection`, mm; a grid where the mesh leaves a
/// part of it open.
std::vector<CadElement> faceElements(const CadFace& exact, const TopoDS_Face& face, std::uint32_t owner,
                                     double deflection);

/// Chords that leave an edge by at most `deflection`.
std::vector<CadElement> edgeElements(const CadEdge& edge, std::uint32_t owner, double deflection);

}  // namespace probewright::simulation
