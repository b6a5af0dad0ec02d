#pragma once

#include <cmath>
#include <vector>

#include "simulation/tool_shape.hpp"
#include "survival/clamped_worlds.hpp"

namespace probewright::survival {

/// How far something may be from where it is in the middle: along the tool and across it, mm.
struct Shift {
  double along = 0, across = 0;

  double any() const { return std::hypot(along, across); }
  bool moves() const { return any() > 1e-9; }
  Shift& operator+=(const Shift& other) {
    along += other.along;
    across += other.across;
    return *this;
  }
};

inline Shift operator+(Shift a, const Shift& b) { return a += b; }
inline Shift operator*(double factor, const Shift& shift) { return {factor * shift.along, factor * shift.across}; }
/// In any direction.
inline Shift everyWay(double by) { return {by, by}; }
Shift larger(const Shift& a, const Shift& b);
/// The parts of a way along the tool (unit) and across it.
Shift shiftAgainst(const Vector3& way, const Vector3& tool);

/// Larger than it is by what it may be shifted by and by the displacements of its own parts: wherever the tool is, it
/// lies within. Shafts along the tool grow in length by what is along it. What contact is not exact to is added.
simulation::ToolShape grown(const simulation::ToolShape& shape, const Shift& by, const Displacements::OfTool& own);

/// The balls of the tool wherever they may be, as shafts: wherever the tool is, they lie within.
simulation::ToolShape everywhere(const simulation::ToolShape& shape, const Shift& by, const Displacements::OfTool& own);

/// Smaller balls at places along the tool: wherever the tool is, its balls hold those of one of them.
std::vector<simulation::ToolShape> anywhere(const simulation::ToolShape& shape, const Shift& by,
                                            const Displacements::OfTool& own);

}  // namespace probewright::survival
