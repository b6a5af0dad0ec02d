#pragma once

#include <fcl/geometry/bvh/BVH_model.h>

#include <memory>

#include "simulation/solid.hpp"

namespace probewright::simulation {

struct BodyMesh : fcl::BVHModel<fcl::OBBRSSd> {};

/// solidTriangles(), ready for distances; solid's frame. A solid does not change, so its triangles are made once for
/// all machines that it is in, as long as there is one of them. From any thread.
std::shared_ptr<const BodyMesh> bodyMesh(const std::shared_ptr<const Solid>& solid);

}  // namespace probewright::simulation
