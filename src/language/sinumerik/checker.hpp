#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "language/sinumerik/argument_check.hpp"
#include "language/sinumerik/check.hpp"

/// What check() does with one program; what calls are held against is in check_calls.cpp.
namespace probewright::language::sinumerik {

class Checker {
public:
  Checker(SinumerikProgram& program, const CheckOptions& options) : program_(program), options_(options) {}
  Diagnostics run();
  /// The programs that this one calls.
  std::vector<std::shared_ptr<Program>> called;

private:
  struct Use {
    std::string name;
    Diagnostic complaint;
  };

  /// What blocks before have switched on, as far as it is known without a run.
  struct State {
    std::string correction;  ///< G41, G42; empty: G40, or not known
    bool scaled = false;     ///< by SCALE or ASCALE with a factor other than 1
    bool mirrored = false;   ///< by MIRROR or AMIRROR of an axis
  };

  std::size_t columnOf(std::string_view name) const;
  Diagnostic complaint(std::size_t column, std::string message, std::string advice) const;
  void report(std::size_t column, std::string message, std::string advice, Severity severity = Severity::Error);
  void declare(const Instruction& instruction);
  void declareFromBrokenBlock();
  void checkSection(const CallProgram& call, Program& other);
  void checkHeader();
  void checkNames();
  void checkPriorities();
  void checkFunctions();
  void checkEffect(const Command& command, const std::string& name);
  void tell(const std::string& name, std::string_view how, std::size_t column = 0);
  void checkInstruction(const Instruction& instruction);
  void checkTarget(TextRef label, JumpDirection direction);
  void checkCall(const CallProgram& call);
  void checkArguments(const std::vector<ArgumentMistake>& mistakes);
  void checkParameters(const CallProgram& call, const BlockParser::Header& header);
  void checkLabels();
  void followState(const Instruction& instruction);
  void checkState(std::string_view cycle);
  bool callsCycle(const CallProgram& call) const;
  void noteForModalWords(const Instruction& instruction);
  void checkModalWords();
  void checkType(const CallProgram& call, const BlockParser::Header& header, std::size_t place);

  SinumerikProgram& program_;
  const CheckOptions& options_;
  Block block_;
  Diagnostics found_;
  std::set<std::string> declared_;
  bool callsHook_ = false;             ///< a measuring cycle calls CUST_MEACYC
  bool callsPrograms_ = false;         ///< other programs, which may write variables for this one
  bool oldParameters_ = false;         ///< _MVAR was met: cycles may be called without arguments
  std::map<std::string, Type> types_;  ///< of those whose DEF or PROC line tells it
  std::set<std::string> macros_;
  std::set<std::string, std::less<>> targets_;  ///< of jumps and repetitions
  bool jumpsAnywhere_ = false;                  ///< to a label that only the run knows
  bool modalWords_ = false;                     ///< a motion has other words than X, Y, Z
  State state_;
  bool begun_ = false;                         ///< a block was met that is carried out
  bool toldOrder_ = false;                     ///< of a DEF after it
  std::set<std::string> told_;                 ///< system variables and words that were reported
  std::map<std::string, Diagnostic> unknown_;  ///< first use of each name that no DEF came before
};

}  // namespace probewright::language::sinumerik
