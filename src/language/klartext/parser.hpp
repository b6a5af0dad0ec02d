#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "base/diagnostic.hpp"
#include "language/block.hpp"
#include "language/klartext/commands.hpp"
#include "language/klartext/lexer.hpp"
#include "language/klartext/path_words.hpp"

namespace probewright::language::klartext {

/// Lowers one Klartext block into the instruction set. One file of member functions for each family of blocks.
///
/// `text` is the block's own text; the block holds a copy of it at the beginning of Block::text, so a stretch of the
/// one is a stretch of the other. Functions that return bool or an optional have reported a mistake when they fail.
class BlockParser {
public:
  BlockParser(std::string_view text, const std::string& file, Block& block, Diagnostics& diagnostics)
      : lexer_(text), file_(file), block_(block), diagnostics_(diagnostics) {}

  /// Fills the block's instructions; none if there is a mistake, which goes to the diagnostics.
  void parse();

protected:
  // parser.cpp: the kinds of blocks, and what all share
  bool statement();
  std::string meantKeyword();
  bool expectEnd();
  bool beginOrEnd();
  bool blankForm();
  bool stop();
  bool textCommand(CommandKind kind);
  bool expect(char wanted, std::string_view after);
  bool numbersFit();
  bool formulasFit();
  bool error(std::string message, std::string advice = {});
  bool errorAt(const Word& word, std::string message, std::string advice = {});
  void report(std::uint32_t line, std::uint32_t column, std::string_view text, std::string message, std::string advice);
  bool eachOnce(std::size_t first, std::string_view where);
  TextRef ref(std::string_view part) const;
  TextRef constant(std::string_view text) { return block_.add(text); }
  template <class T>
  void emit(T instruction) {
    block_.instructions.emplace_back(std::move(instruction));
  }

  // values.cpp: numbers, parameters, words
  std::optional<Operand> value(std::string_view what);
  bool variableFollows();
  /// None where !variableFollows(). A number that no control has is a mistake and counts as 0, so that reading goes on.
  std::optional<VariableRef> variable();
  std::optional<std::uint32_t> variableIndex();
  std::optional<Operand> textOrVariable(std::string_view what);
  Operand push(const Node& node);
  Operand variableOperand(const VariableRef& variable);
  Operand textOperand(TextRef text);
  Operand negated(Operand operand);
  Operand binary(Operation operation, Operand left, Operand right);
  Operand callHost(std::string_view function, std::initializer_list<Operand> arguments);
  Word& addWord(std::uint32_t address, Operand value, WordMode mode = WordMode::Plain);
  bool word(std::uint32_t address, std::string_view what, WordMode mode = WordMode::Plain);
  std::optional<Operand> valueBehindWords(std::string_view what);
  WordRange wordsSince(std::size_t first) const;

  // formula.cpp
  bool assignment();
  std::optional<Operand> formula();
  std::optional<Operand> sum();
  std::optional<Operand> product();
  std::optional<Operand> power();
  std::optional<Operand> signedPrimary();
  std::optional<Operand> primary();
  std::optional<Operand> functionCall();
  std::optional<Operand> stringFunction(std::string_view name);

  // moves.cpp
  bool move(MoveKind kind, const PathWords& function);
  bool arc(const PathWords& function);
  bool arcWithRadius();
  bool approachOrDepart(MoveKind kind);
  bool moveWords(Move& move, const PathWords& function);
  bool pathWord(Move& move);
  bool belongs(const PathWords& function, std::size_t first, std::size_t from);
  bool leftOpen(char following);
  bool axisWord(WordMode mode);
  bool radiusWord(Move& move);
  bool feedWord(Operand& feed, bool* rapid, bool* autoFeed);

  // machine_functions.cpp
  bool machineFunction(Move* move);
  bool contradicts(std::size_t start, int first, int second);
  bool machineFunctionBlock();
  void emitWithMachineFunctions(const Instruction* instruction);

  // tool.cpp
  bool toolCall();
  bool toolIdentity(ToolCall& call);
  bool toolWord(ToolCall& call);
  bool toolDefinition();

  // calls.cpp
  bool label();
  bool callLabel();
  bool repeats(CallLabel& call);
  bool callProgram();
  bool callSelectedProgram();
  bool checkPath(std::string_view path);
  bool selection();
  bool cycleCall();
  bool patternDefinition();
  bool labelName(TextRef& label, Operand& labelValue);

  // functions.cpp: FN 0 to 38
  bool function();
  bool functionBody(int number);
  Operand call(Function function, std::initializer_list<Operand> arguments);
  Operand functionResult(int number, Operand left, Operand right);
  std::optional<Operand> definedCondition();
  std::optional<Operand> comparison(int number, Operand left, std::string_view what);
  bool systemDatum();
  bool functionAssignment(int number);
  bool setUndefined(std::uint32_t target);
  bool tableData();
  bool functionJump(int number);
  bool functionSystemData(int number);
  bool functionCircle(int number);
  bool functionPreset();
  bool functionTable(int number);
  bool functionText(int number);
  /// FN 19: PLC=+10/+Q3 from "PLC" on; FN 19 hands over 1 or 2 values, FN 29 1 to 8. The words have the addresses 1
  /// to 8.
  bool functionPlc(int number);

  // cycles.cpp
  bool touchProbe();
  bool cycleDefinition();
  bool parameterCycle(std::string_view kind, int number);
  bool cycleParameters(std::size_t firstWord);
  bool cycleParameter();
  bool skipCycleName();

  // old_cycles.cpp
  struct Part {
    int cycle = 0;
    int part = 0;
  };
  bool nextPart(std::string_view first, std::string_view second, Part& part);
  bool oldProbeCycle(int number);
  bool oldProbePart(Part part);
  bool oldCycle(int number);
  bool oldCyclePart(Part part);
  enum class Axes : std::uint8_t { WithValues, LettersOnly };
  bool axisList(Axes axes);
  bool listedAxis(Axes axes);

  // plane.cpp
  bool plane();
  bool planeOption();
  bool planeComplete(std::string_view name, std::size_t first);
  bool emitPlane(std::string_view name, std::size_t first);
  bool transformation();
  bool functionKeyword();
  bool presetKeyword();

  Lexer lexer_;
  const std::string& file_;
  Block& block_;
  Diagnostics& diagnostics_;
  int depth_ = 0;
  struct PendingFunction {
    MachineFunction function;
    bool atEnd = false;
  };
  std::array<PendingFunction, 8> pending_;
  std::size_t pendingCount_ = 0;
};

}  // namespace probewright::language::klartext
