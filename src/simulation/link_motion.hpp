#pragma once

#include <vector>

#include "machine/description.hpp"
#include "simulation/contact_search.hpp"

namespace probewright::simulation {

/// How far any point of a ball about `centre`, carried by the chain, may travel on the motion.
double longestWay(const std::vector<machine::ChainElement>& chain, const std::vector<machine::Axis>& axes,
                  const Motion& motion, Vector3 centre, double radius);

}  // namespace probewright::simulation
