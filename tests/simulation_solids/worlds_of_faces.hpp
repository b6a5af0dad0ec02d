#pragma once

#include <TopoDS_Shape.hxx>
#include <random>
#include <string>
#include <vector>

/// Shapes with every kind of surface, for random ways.
namespace probewright::simulation::testing {

struct NamedShape {
  std::string name;
  TopoDS_Shape shape;
};

/// One face on each kind of surface, its parameters in a random range, often periods away from the usual one.
std::vector<NamedShape> singleFaces(std::mt19937_64& random);

/// Solids of all kinds of surfaces.
std::vector<NamedShape> bodies(std::mt19937_64& random);

/// What other systems make of a body: as B-splines, as surfaces of revolution, split, joined, mirrored, scaled,
/// several. The body as it is where OpenCASCADE cannot make that of it.
constexpr std::size_t kDisguises = 10;
NamedShape disguised(const NamedShape& body, std::size_t how, std::mt19937_64& random);

/// A washer whose upper outer edge is a bead: a part of a torus with its parameter v from one full period on.
TopoDS_Shape beadWasher();

}  // namespace probewright::simulation::testing
