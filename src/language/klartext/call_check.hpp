#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "base/diagnostic.hpp"
#include "control/control_kind.hpp"
#include "cycles/catalogue.hpp"
#include "language/block.hpp"

namespace probewright::language::klartext {

/// What is wrong with the calls of touch probe cycles in a program: their parameters by the catalogue, and what the
/// blocks before them have left, as far as the way to them is plain.
class CallCheck {
public:
  /// `foresees`: also what a run would refuse when it gets there.
  CallCheck(control::ControlKind kind, bool foresees) : kind_(kind), foresees_(foresees) {}

  struct Remark {
    const Word* word = nullptr;  ///< of the block; null: the block as such
    std::string message, advice;
    Severity severity = Severity::Error;
    std::optional<std::uint32_t> lacking;  ///< the address of the parameter that the call lacks
  };
  std::vector<Remark> of(const Block& block, const CycleCall& call);

  /// What else passes, in the order of the program.
  void follow(const ToolCall& call);
  void follow(const Block& block, const Transform& transform);
  void follow(const Block& block, const Command& command);
  /// A label, a jump or a call: from here on nobody knows what has run before.
  void wayBranches() { plainWay_ = false; }

private:
  void remark(std::string message, std::string advice, Severity severity = Severity::Error);
  void remarkAt(const Word& word, std::string message, std::string advice, Severity severity = Severity::Error);
  const Node* nodeOf(const Word& word) const;
  std::optional<cycles::Argument> literal(const Word& word) const;
  void checkWord(const cycles::CycleDefinition& cycle, const Word& word);
  void checkTogether(const cycles::CycleDefinition& cycle, std::span<const Word> words);
  void checkState(const cycles::CycleDefinition& cycle);
  void followTilt(const Transform& transform);

  control::ControlKind kind_;
  bool foresees_;
  const Block* block_ = nullptr;  ///< the one that is looked at
  std::vector<Remark> remarks_;
  /// By cycle: what is active ("cycle 7", "TRANS DATUM"), empty if it has ended; absent: unknown or never defined.
  std::map<int, std::string> transforms_;
  std::string tilt_;                         ///< "PLANE SPATIAL", "cycle 19"; empty: not tilted, or unknown
  std::string mode_;                         ///< of FUNCTION MODE: "TURN", "GRIND"; empty: MILL
  std::set<std::uint32_t> globallyDefined_;  ///< Q parameters that GLOBAL DEF has given a value
  bool plainWay_ = true;                     ///< every block so far has run once
  bool toolCalled_ = false;
};

}  // namespace probewright::language::klartext
