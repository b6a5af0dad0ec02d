#pragma once

#include <set>
#include <string>

#include "simulation/child_process.hpp"

/// The part of an import that runs in a process of its own.
namespace probewright::simulation {

enum class CadFormat { Step, Iges };

struct TransferOrder {
  CadFormat format = CadFormat::Step;
  std::string file;   ///< its path
  std::string bytes;  ///< what is in it
  double deflection = 0.01;
  int facePoints = 0;       ///< as FaceMeshOptions::mostPoints
  std::set<int> gridFaces;  ///< as FaceMeshOptions::left
  bool gridAll = false;     ///< as FaceMeshOptions::leaveAll
};

/// Reads the file, builds the shape, gives it triangles and prepares it for contact. Hands over what
/// appendShape() makes of it, as soon as it is sure to survive being prepared, and then what appendElements() makes.
/// Meanwhile says, a line each:
///   stage TEXT           what it does now
///   failed TEXT          why there is no shape
///   nothing              there is neither a body nor a face
///   suspect LABEL TEXT   an entity that OpenCASCADE does not read as it stands; LABEL is #123 in STEP, D123 in IGES
///   unable LABEL TEXT    an entity that OpenCASCADE would build wrongly; there is no shape
///   at LABEL             the entity that it builds now
///   lost LABEL           a face that the shape does not have
///   faces N              how many faces the shape has
///   begin N, end N       the mesher's way with a face
///   grid N CELL KIND     a face that has a grid instead of a mesh, with its largest cell; 0: not even that
///   open N X Y Z         N edges of bodies and skins belong to one face only, one of them at X Y Z
///   gap LABEL MM         a face whose edges leave its surface, or whose vertices its edges, by so much; "endless": a
///                        face whose edges run round its surface, and nothing ends it on one side of them
///   scaled FACTOR        lengths of the model are so many times the true ones; the shape has the true ones
///   skin                 there are faces, but no body
void transferCad(const TransferOrder& order, const ChildVoice& voice);

/// Builds the faces of a file one by one, and says "at LABEL" before each: the last one is what a crash is about.
void searchFaces(const TransferOrder& order, const ChildVoice& voice);

}  // namespace probewright::simulation
