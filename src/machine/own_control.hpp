#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "geometry/primitives.hpp"
#include "machine/machine.hpp"

/// What a machine offers beyond machine.hpp if it has a control of its own beside the one that runs the program, as a
/// LinuxCNC machine has: a screen that follows the program, zero offsets and a tool table. A machine without one does
/// not implement it.
namespace probewright::machine {

/// A settable zero offset: a point p of the workpiece lies at origin + Rz(rotation) p, in machine coordinates of the
/// spindle nose less the tool length.
struct OwnOffset {
  int number = 1;        ///< from 1
  AxisPositions origin;  ///< mm, degrees
  double rotation = 0;   ///< degrees, about Z
};

struct OwnTool {
  int number = 1;
  double length = 0, diameter = 0;  ///< mm; 0: not set
};

struct OwnTables {
  std::vector<OwnOffset> offsets;
  std::vector<OwnTool> tools;
};

/// What the control that runs the program knows while it gives an order.
struct OrderPlace {
  std::optional<std::uint64_t> line;     ///< of the main program; nothing while a called program runs
  std::vector<std::string> messages;     ///< to the operator, since the order before
  Vector3 toolVector = Vector3::Zero();  ///< believed, from the tip to the spindle nose, spindle frame
  double toolRadius = 0;                 ///< believed
};

class OwnControl {
public:
  virtual ~OwnControl() = default;

  /// Its tables when the program began; null if it shares none.
  virtual const OwnTables* tables() const = 0;
  /// Sets what is named here, and nothing else. Why that cannot be, if it cannot: then nothing is set.
  virtual std::optional<std::string> keep(const OwnTables& tables) = 0;
  /// Asked with every order until another function takes its place; an empty one ends that.
  virtual void accompany(std::function<OrderPlace()> place) = 0;
};

/// The control of its own that the machine has, or null.
inline OwnControl* ownControlOf(Machine& machine) { return dynamic_cast<OwnControl*>(&machine); }

}  // namespace probewright::machine
