#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "simulation/analytic_surface.hpp"
#include "simulation/path_record.hpp"
#include "simulation/truth.hpp"

/// What a program is to touch: what it touches where the part lies as the setup is written.
namespace probewright::survival {

/// A touch of a measuring move.
struct TouchedFace {
  std::size_t solid = 0;                            ///< its place in Truth::solids
  std::optional<simulation::AnalyticSurface> face;  ///< in the solid's frame; nothing where no closed form is known
};

/// Of all measuring moves of a run that touched with the ball, in the order of the run.
std::vector<TouchedFace> touchedFaces(const simulation::PathRecord& path, const simulation::Truth& truth);

/// Why the touches of a run are not those that are meant, if they are not. `sizeVaries`: solids whose faces are not
/// compared, by their place in Truth::solids.
std::optional<std::string> otherThanMeant(const std::vector<TouchedFace>& meant, const simulation::PathRecord& path,
                                          const simulation::Truth& truth, const std::vector<bool>& sizeVaries);

/// All faces of a solid but one, as a skin.
class OtherFaces {
public:
  /// Null if the solid has no other face, or is not from CAD. May be called from several threads.
  std::shared_ptr<const simulation::Solid> of(const simulation::Solid& solid, const simulation::AnalyticSurface& face);

private:
  struct Entry {
    const simulation::Solid* solid = nullptr;
    simulation::AnalyticSurface face;
    std::shared_ptr<const simulation::Solid> others;
  };
  std::mutex mutex_;
  std::vector<Entry> entries_;
};

}  // namespace probewright::survival
