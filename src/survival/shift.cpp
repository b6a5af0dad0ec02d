#include "survival/shift.hpp"

#include <algorithm>
#include <utility>

namespace probewright::survival {

using simulation::ToolShape;

namespace {

// What the machine of a run and the search of a proof may differ by, mm. Balls meet the exact faces: the search is true
// to 1e-3, the machine stops 1e-4 before a contact, closed forms and Newton's steps are true to 1e-5.
constexpr double ballPrecision = 2e-3;
// Shafts meet triangles. Those of a run and those of a proof may be different ones; each leaves the face by 0.01
// (ImportOptions), of which samples may miss a half again (cad_refinement.hpp): 2 * 0.015. Where a shaft turns, each
// search takes its direction for fixed within 0.005: 2 * 0.005. With the search and the stop, 0.0411 together.
constexpr double shaftPrecision = 0.045;

double ownOf(const std::vector<double>& parts, std::size_t part) { return part < parts.size() ? parts[part] : 0; }

}  // namespace

Shift larger(const Shift& a, const Shift& b) { return {std::max(a.along, b.along), std::max(a.across, b.across)}; }

Shift shiftAgainst(const Vector3& way, const Vector3& tool) {
  const double along = way.dot(tool);
  return {std::abs(along), (way - along * tool).norm()};
}

ToolShape grown(const ToolShape& shape, const Shift& by, const Displacements::OfTool& own) {
  ToolShape thick = shape;
  for (std::size_t i = 0; i < thick.balls.size(); ++i)
    thick.balls[i].radius += std::hypot(by.along + ownOf(own.balls, i), by.across) + ballPrecision;
  for (std::size_t i = 0; i < thick.shafts.size(); ++i) {
    simulation::Shaft& shaft = thick.shafts[i];
    const double along = by.along + ownOf(own.shafts, i);
    const Vector3 direction = shaft.axis.normalized();
    const bool upright = direction.cross(shape.shank).norm() < 1e-9;
    shaft.radius += (upright ? by.across : std::hypot(along, by.across)) + shaftPrecision;
    const double longer = (upright                                 ? along
                           : shaft.ends == simulation::Ends::Round ? 0
                                                                   : std::hypot(along, by.across)) +
                          shaftPrecision;
    shaft.start -= longer * direction;
    shaft.axis += 2 * longer * direction;
  }
  return thick;
}

ToolShape everywhere(const ToolShape& shape, const Shift& by, const Displacements::OfTool& own) {
  ToolShape shafts;
  shafts.tip = shape.tip;
  shafts.shank = shape.shank;
  for (std::size_t i = 0; i < shape.balls.size(); ++i) {
    const double along = by.along + ownOf(own.balls, i) + ballPrecision;
    shafts.shafts.push_back({shape.balls[i].centre - along * shape.shank, 2 * along * shape.shank,
                             shape.balls[i].radius + by.across + shaftPrecision, "ball", simulation::Ends::Round});
  }
  return shafts;
}

std::vector<ToolShape> anywhere(const ToolShape& shape, const Shift& by, const Displacements::OfTool& own) {
  constexpr int places = 5;
  std::vector<ToolShape> shapes;
  for (int place = 0; place < places; ++place) {
    ToolShape balls;
    balls.tip = shape.tip;
    balls.shank = shape.shank;
    for (std::size_t i = 0; i < shape.balls.size(); ++i) {
      const double along = by.along + ownOf(own.balls, i), part = along / places;
      balls.balls.push_back({shape.balls[i].centre + (2 * place - (places - 1)) * part * shape.shank,
                             shape.balls[i].radius - std::hypot(part, by.across) - ballPrecision});
    }
    shapes.push_back(std::move(balls));
  }
  return shapes;
}

}  // namespace probewright::survival
