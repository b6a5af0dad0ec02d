#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "base/diagnostic.hpp"
#include "control/control_kind.hpp"
#include "language/block.hpp"

namespace probewright::language::klartext {

/// What can be said of a block without running it, beside its spelling: what the control does not have, what the run
/// would refuse, and what is hardly meant. To be asked for all blocks of a program in their order.
class StatementNotes {
public:
  struct Note {
    Severity severity = Severity::Warning;
    std::string message, advice;
  };
  explicit StatementNotes(control::ControlKind kind) : kind_(kind) {}

  std::vector<Note> of(const Block& block);

private:
  void look(const Block& block, const LabelMark& mark);
  void look(const Block& block, const CallLabel& call);
  void look(const Block& block, const Command& command);
  void look(const Block& block, const CycleCall& call);
  void look(const Block& block, const Transform& transform);
  void look(const Block& block, const Assign& assign);
  void look(const Block& block, const Move& move);
  void look(const Block& block, const ToolCall& call);
  void look(const Block& block, const CallProgram& call);
  void look(const Block& block, const MachineFunction& function);
  void followPole(const Block& block, const Move& move);
  void mixture(const Block& block, const Move& move);
  template <class Other>
  void look(const Block&, const Other&) {}
  void systemDatum(const Block& block, const Command& command);
  void globalDefinition(const Block& block, const Command& command);
  void printed(std::string_view text);
  void endContour();
  void note(Severity severity, std::string message, std::string advice) {
    notes_.push_back({severity, std::move(message), std::move(advice)});
  }

  control::ControlKind kind_;
  /// The axis along the tool, and the one square to the plane of the last CC; 0: not known without a run.
  char toolAxis_ = 0, poleAxis_ = 0;
  std::string corner_;   ///< RND or CHF that waits for the element after it
  std::set<int> named_;  ///< M functions that were
  bool namedCuttingSpeed_ = false;
  std::vector<Note> notes_;
};

}  // namespace probewright::language::klartext
