#pragma once

#include <GeomAdaptor_Surface.hxx>
#include <memory>
#include <utility>
#include <vector>

#include "simulation/cad_model.hpp"

namespace probewright::simulation {

/// The surfaces of a model's faces for one query that looks at many places near each other: a spline remembers its last
/// stretch between knots, which is why no other thread may share them.
class QuickSurfaces {
public:
  explicit QuickSurfaces(const CadModel& model) : model_(model) {}

  const Adaptor3d_Surface& of(std::uint32_t face) {
    for (const auto& [known, surface] : known_) {
      if (known == face) return *surface;
    }
    return *known_.emplace_back(face, std::make_unique<GeomAdaptor_Surface>(model_.faces[face].surface)).second;
  }

private:
  const CadModel& model_;
  std::vector<std::pair<std::uint32_t, std::unique_ptr<const GeomAdaptor_Surface>>> known_;
};

}  // namespace probewright::simulation
