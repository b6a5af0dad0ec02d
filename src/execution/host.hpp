#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "execution/names.hpp"
#include "language/block.hpp"
#include "language/program.hpp"
#include "language/value.hpp"

namespace probewright::execution {

class Evaluation;

/// What every control refuses, under a number of its own.
enum class Refusal {
  DivisionByZero,
  Domain,        ///< root of a negative number, arc sine of 2...
  Overflow,      ///< the result is larger than any number
  TypeMismatch,  ///< a text where a number is needed
  MissingValue,  ///< an operand without a value
  TooComplex,    ///< an expression nested deeper than can be computed
  MissingLabel,
  MissingProgram,
  NestingDepth,  ///< subprograms or programs call each other too deep
  Structure,     ///< a structured statement without its counterpart
};

/// What the interpreter carries out by itself. Hosts visit all other instructions, each of them; SINUMERIK hosts also
/// assignments of EXECSTRING, and calls of cycles.
template <class T>
constexpr bool isFlow =
    std::is_same_v<T, Assign> || std::is_same_v<T, Jump> || std::is_same_v<T, LabelMark> ||
    std::is_same_v<T, CallLabel> || std::is_same_v<T, RepeatSection> || std::is_same_v<T, CallProgram> ||
    std::is_same_v<T, Return> || std::is_same_v<T, EndProgram> || std::is_same_v<T, Structured>;

/// What the interpreter needs of a control: its variables, its own functions, and everything that is not flow. One
/// implementation per language; it throws control::Alarm where the control would raise one.
class Host {
public:
  virtual ~Host() = default;

  virtual Value read(const VariableRef& variable, Evaluation& evaluation) = 0;
  virtual void write(const VariableRef& variable, const Value& value, Evaluation& evaluation) = 0;
  virtual bool isDefined(const VariableRef& variable, Evaluation& evaluation) = 0;

  /// A function that is the control's own (string functions, ISVAR, AXNAME, ...).
  virtual Value call(std::string_view name, std::span<const Value> arguments) = 0;

  /// Carries out an instruction that is not flow.
  virtual void execute(const Instruction& instruction, Evaluation& evaluation) = 0;

  /// The program that the control calls by itself after the instruction it has just carried out (HEIDENHAIN cycle 12
  /// after CYCL CALL, M99 or M89); empty: none. Asked once after every instruction, and once more when the program it
  /// has called so is left (patterns of points); the answer is forgotten then.
  virtual std::string requestedProgram() { return {}; }

  /// A block begins: for records, single block, dry run. False skips the block.
  virtual bool beginBlock(const Program& program, const Block& block) = 0;

  /// The control's own number or name of an alarm that evaluation or interpreter raise; empty: none is known.
  virtual std::string code(Refusal) const { return {}; }

  /// Whether a program that was called modally (MCALL) is carried out after this block.
  virtual bool drivesModalCall(const Block&) const { return false; }

  /// A modal call (MCALL) begins or ends.
  virtual void modalCall([[maybe_unused]] bool inEffect) {}

  /// A number as texts show it: twelve significant digits at most, unless the control has its own way.
  virtual std::string numberText(double value) const;

  /// The text of a variable that holds a number and shows as a text (SINUMERIK CHAR, BOOL, a character of a STRING);
  /// nothing for others.
  virtual std::optional<std::string> shownText(const VariableRef&, Evaluation&) { return std::nullopt; }

  /// The value of `operand` for an assignment to `variable`, where its type changes it.
  virtual Value valueFor(const VariableRef& variable, const Operand& operand, Evaluation& evaluation);

  /// What the last instructions did beyond their blocks, in steps that count against the step limit: elements of
  /// arrays, pieces of arcs, files. Asked once after every block; the answer is forgotten then.
  virtual std::uint64_t takeWork() { return 0; }

  /// The steps that the use of a file of so many bytes counts, about as long as they take.
  static constexpr std::uint64_t stepsOfFile(std::size_t bytes) { return 64 + bytes / 16; }

  /// Comparisons take two numbers for equal that differ by no more than this fraction of the larger one. SINUMERIK:
  /// 1e-12.
  virtual double relativeEquality() const { return 0; }

  /// A program level is entered with the arguments of `call` (evaluated in the caller) and left again.
  virtual void enter(const Program& program, const CallProgram* call, Evaluation* caller) = 0;
  virtual void leave(const Program& program) = 0;
};

}  // namespace probewright::execution
