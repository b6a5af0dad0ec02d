#pragma once

#include <string>
#include <vector>

#include "control/channel.hpp"
#include "control/journal.hpp"
#include "control/operator_panel.hpp"
#include "machine/own_control.hpp"

/// A program on a machine that has a control of its own: what of the two controls is kept as one.
namespace probewright::session {

/// As long as it lives, the machine's own screen follows the program: its line, its messages.
class Accompanied {
public:
  /// All of it outlives this. `main` is the main program as places name it.
  Accompanied(machine::Machine& machine, const control::Channel& channel, const control::OperatorPanel& panel,
              const control::Journal& journal, std::string main);
  ~Accompanied();
  Accompanied(const Accompanied&) = delete;
  Accompanied& operator=(const Accompanied&) = delete;

private:
  machine::OwnControl* own_;
  std::size_t told_ = 0;
};

/// Numbers that two tables keep count as equal within this: LinuxCNC writes six decimals.
inline constexpr double sameNumber = 1e-6;

/// The name of a zero offset at LinuxCNC: "G54" to "G59", "G59.1" to "G59.3".
std::string ownOffsetName(int number);
/// True if nobody has set the offset: all of it is 0.
bool isUnset(const machine::OwnOffset& offset);
/// True if both put the workpiece at the same place.
bool same(const machine::OwnOffset& a, const machine::OwnOffset& b, std::size_t axes);
/// What the operator is told of a row that comes from the machine's own control.
std::string takenOver(const std::string& row, const machine::OwnOffset& offset,
                      const machine::MachineDescription& machine);

/// Hands the changed rows to the machine's own control; tells the operator if that cannot be.
void giveBack(machine::OwnControl& own, const machine::OwnTables& changed, control::OperatorPanel& panel,
              double seconds);

}  // namespace probewright::session
