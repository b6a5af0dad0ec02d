#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/diagnostic.hpp"

/// The instruction set that every language is lowered to, one program block at a time.
///
/// A Block owns everything its instructions refer to: expression nodes, words and text lie in pools and are named by
/// position, so instructions are plain values and a Block that is filled again and again allocates nothing. Flow
/// instructions are carried out by the Interpreter; all others by the Host of the control (host.hpp).
namespace probewright::language {

/// A stretch of Block::text.
struct TextRef {
  std::uint32_t offset = 0;
  std::uint32_t length = 0;
};

/// A value to be computed when the block is carried out: absent, a number, or a node of Block::nodes.
struct Operand {
  static constexpr std::int32_t absent = -2;
  static constexpr std::int32_t literal = -1;
  double number = 0;           ///< if node == literal
  std::int32_t node = absent;  ///< index into Block::nodes otherwise
  bool present() const { return node != absent; }
  bool isLiteral() const { return node == literal; }
  static Operand of(double value) { return {value, literal}; }
};

/// Where a variable lives. Spaces of HEIDENHAIN and SINUMERIK side by side.
enum class VariableSpace : std::uint8_t {
  Q,       ///< HEIDENHAIN Q parameter, global
  QL,      ///< HEIDENHAIN local parameter of the program level
  QR,      ///< HEIDENHAIN remanent parameter
  QS,      ///< HEIDENHAIN string parameter
  R,       ///< SINUMERIK R parameter
  User,    ///< SINUMERIK variable declared by DEF, a PROC parameter or a GUD; `name`
  System,  ///< SINUMERIK $ variable; `name` without the indices, upper case, with its $
};

/// A variable as a program writes it. Numbered spaces use `index`, named ones `name` and up to three indices.
struct VariableRef {
  VariableSpace space = VariableSpace::Q;
  TextRef name{};
  Operand index[3]{};
};

enum class Operation : std::uint8_t {
  Number,    ///< `number`
  Text,      ///< `text`
  Variable,  ///< Block::variables[a]
  Negate,
  Not,
  BitNot,
  Add,
  Subtract,
  Multiply,
  Divide,
  IntegerDivide,
  Modulo,
  Power,
  Concatenate,
  Equal,
  NotEqual,
  Less,
  LessEqual,
  Greater,
  GreaterEqual,
  And,
  Or,
  ExclusiveOr,
  BitAnd,
  BitOr,
  BitExclusiveOr,
  Call,       ///< function `function` on the `b` operands Block::operands[a...]
  Undefined,  ///< true if variable a is undefined (FN 9 ... IS UNDEFINED)
  AxisName,   ///< an axis as a value: `text`
};

/// Functions that every control computes alike. Angles in degrees.
enum class Function : std::uint8_t {
  Sin,
  Cos,
  Tan,
  Asin,
  Acos,
  Atan,
  Atan2,
  Sqrt,
  Square,
  Ln,
  Log,
  Exp,
  Abs,
  Integer,
  Fraction,
  Sign,
  RootSumOfSquares,
  Round,
  RoundUp,
  Truncate,
  Minimum,
  Maximum,
  Bound,
  Host,  ///< one of the control's own: `text` names it
};

struct Node {
  Operation operation = Operation::Number;
  Function function = Function::Host;
  Operand left{}, right{};  ///< operands of unary and binary operations
  std::uint32_t a = 0;      ///< see Operation
  std::uint32_t b = 0;
  double number = 0;
  TextRef text{};
};

/// How the value of a word is meant.
enum class WordMode : std::uint8_t {
  Plain,           ///< as the modal state says; HEIDENHAIN: absolute
  Absolute,        ///< SINUMERIK AC()
  Incremental,     ///< HEIDENHAIN IX, SINUMERIK IC()
  DirectPositive,  ///< SINUMERIK ACP()
  DirectNegative,  ///< SINUMERIK ACN()
  DirectShortest,  ///< SINUMERIK DC()
};

/// An address with a value: an axis coordinate, an arc parameter, a cycle parameter. What `address` means is the
/// instruction's business: an axis letter code (axisAddress), a Q number, the position of an argument from 0.
struct Word {
  std::uint32_t address = 0;
  WordMode mode = WordMode::Plain;
  Operand value{};
  std::uint32_t column = 0;  ///< where it is in its line, from 1
  std::uint32_t line = 0;    ///< lines below the block's first line
};

/// "X" -> 'X', "CC" -> 'C' | 'C' << 8, "C1" -> 'C' | '1' << 8. Up to four characters.
constexpr std::uint32_t addressOf(std::string_view name) {
  std::uint32_t code = 0;
  for (std::size_t i = 0; i < name.size() && i < 4; ++i) {
    code |= static_cast<std::uint32_t>(static_cast<unsigned char>(name[i])) << (8 * i);
  }
  return code;
}
std::string addressName(std::uint32_t address);

/// Words first..first+count of Block::words.
struct WordRange {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

// ---- flow: carried out by the interpreter ----

struct Assign {
  std::uint32_t variable = 0;  ///< index into Block::variables
  Operand value{};
};

enum class JumpDirection : std::uint8_t { Any, Forward, Backward, ForwardThenBackward, ProgramStart };

struct Jump {
  TextRef label{};
  Operand labelValue{};  ///< a computed label (QS, string expression) instead of `label`
  Operand condition{};   ///< absent: always
  JumpDirection direction = JumpDirection::Any;
  bool ignoreMissing = false;  ///< SINUMERIK GOTOC: no alarm when there is no such label
};

/// HEIDENHAIN LBL n. LBL 0 ends a subprogram or a repeated part.
struct LabelMark {
  TextRef label{};
  bool end = false;
};

/// HEIDENHAIN CALL LBL n [REP m]: a subprogram, or a jump back that is taken m times.
struct CallLabel {
  TextRef label{};
  Operand labelValue{};
  Operand repeats{};  ///< present: part program repeat
};

/// SINUMERIK REPEAT a b P=n: the section from label `from` to label `to` (or to this block) once more, n times.
struct RepeatSection {
  TextRef from{};
  TextRef to{};
  Operand times{};
  bool onlyBlock = false;  ///< REPEATB
};

/// A call of another program: HEIDENHAIN CALL PGM, SINUMERIK NAME(args), L123 P2, CALL, PCALL, EXTCALL.
struct CallProgram {
  TextRef name{};
  Operand nameValue{};      ///< computed name instead of `name`
  WordRange arguments{};    ///< address: position from 0; absent values are omitted arguments
  Operand times{};          ///< P; absent: once
  TextRef from{}, to{};     ///< SINUMERIK CALL NAME BLOCK from TO to: only this section of the program
  bool maybeCycle = false;  ///< if no program of that name exists, a measuring cycle of that name is meant
  bool modal = false;       ///< SINUMERIK MCALL: from now on after each block with a motion; without a name: no more
};

/// M17, RET. SINUMERIK RET("TARGET",1,2): goes on at another place, through several levels.
struct Return {
  Operand target{};  ///< text: a label or block number in the program that is gone on with
  Operand behind{};  ///< not 0: goes on after the target's block
  Operand levels{};  ///< programs that are left; absent: one
  Operand start{};   ///< has a meaning for programs of the ISO dialect only
};
struct EndProgram {};  ///< END PGM, M2, M30

/// SINUMERIK structured statements; the interpreter pairs them within their program.
enum class Structure : std::uint8_t { If, Else, EndIf, While, EndWhile, For, EndFor, Loop, EndLoop, Repeat, Until };
struct Structured {
  Structure kind = Structure::If;
  Operand condition{};         ///< If, While, Until
  std::uint32_t variable = 0;  ///< For: index into Block::variables
  Operand from{}, to{};        ///< For
};

// ---- carried out by the control ----

enum class MoveKind : std::uint8_t {
  Modal,  ///< SINUMERIK: as the active G function of group 1 says
  Rapid,
  Linear,
  ArcClockwise,
  ArcCounterclockwise,
  ArcTangential,    ///< HEIDENHAIN CT
  ArcThroughPoint,  ///< SINUMERIK CIP
  SetCentre,        ///< HEIDENHAIN CC: moves nothing
  Chamfer,
  Rounding,
  Approach,
  Depart,  ///< HEIDENHAIN APPR/DEP, `variant` names which
};

enum class RadiusCompensation : std::uint8_t { Unchanged, Off, Left, Right };

struct Move {
  MoveKind kind = MoveKind::Linear;
  bool polar = false;
  RadiusCompensation compensation = RadiusCompensation::Unchanged;
  bool machineCoordinates = false;  ///< HEIDENHAIN M91, SINUMERIK SUPA/G53
  bool machineReference2 = false;   ///< HEIDENHAIN M92
  TextRef variant{};                ///< APPR/DEP kind: "LT", "LN", "CT", "LCT"
  WordRange words{};                ///< axes and arc words: X Y Z A.. I J K CR R PR PA LEN CCA ...
  Operand feed{};                   ///< mm/min as programmed; absent: unchanged
  bool rapid = false;               ///< HEIDENHAIN FMAX, this block only
  bool autoFeed = false;            ///< HEIDENHAIN FAUTO
};

/// A tool is called by number or name. Absent operands leave what was.
struct ToolCall {
  Operand number{};
  Operand name{};   ///< text
  Operand index{};  ///< HEIDENHAIN step index (5.1); SINUMERIK unused
  char axis = 0;    ///< HEIDENHAIN tool axis letter or 0
  Operand spindleSpeed{};
  Operand cuttingSpeed{};  ///< HEIDENHAIN S(VC=...)
  Operand feed{};
  Operand deltaLength{}, deltaRadius{}, deltaRadius2{};
};

/// A modal G function or switch: SINUMERIK G codes, HEIDENHAIN FUNCTION TCPM and the like. `name` in upper case.
struct Modal {
  TextRef name{};
  WordRange words{};
};

/// An auxiliary function Mn, or Mn=... with its argument.
struct MachineFunction {
  int number = 0;
  Operand argument{};
  WordRange words{};  ///< words of functions such as M140 MB
};

/// A change of the coordinate system. `name`: HEIDENHAIN "CYCL DEF 7", "TRANS DATUM AXIS", "PLANE SPATIAL"...;
/// SINUMERIK "TRANS", "ATRANS", "ROT", "AROT", "SCALE", "MIRROR"...
struct Transform {
  TextRef name{};
  WordRange words{};
  TextRef option{};  ///< file name, row, PLANE positioning words: see the front end's lowering
};

/// A measuring or other cycle. HEIDENHAIN: `number` and words addressed by Q number. SINUMERIK: `name` and words
/// addressed by argument position.
struct CycleCall {
  int number = 0;
  TextRef name{};
  WordRange parameters{};
};

/// Everything else the control itself does: `name` says what ("FN16", "FN17", "FN18", "MSG", "SETAL", "STOPRE",
/// "DEF"...). The lowering and the host of the same language agree on the words.
struct Command {
  TextRef name{};
  TextRef text{};
  std::int32_t variable = -1;  ///< result, index into Block::variables
  WordRange words{};
};

/// HEIDENHAIN STOP, SINUMERIK M0/M1.
struct Stop {
  bool optional = false;
  TextRef text{};
};

using Instruction =
    std::variant<Assign, Jump, LabelMark, CallLabel, RepeatSection, CallProgram, Return, EndProgram, Structured, Move,
                 ToolCall, Modal, MachineFunction, Transform, CycleCall, Command, Stop>;

/// A position in a program: the byte offset of a block's first line.
struct BlockPosition {
  std::uint64_t offset = 0;
  std::uint64_t line = 1;  ///< of the file, from 1
};

struct Block {
  BlockPosition position{};
  BlockPosition next{};        ///< where the following block begins
  TextRef source{};            ///< the block's own text without line end
  TextRef label{};             ///< SINUMERIK label "NAME:" or block number "N100" that jumps can name
  bool skippable = false;      ///< begins with "/"
  std::uint8_t skipLevel = 0;  ///< SINUMERIK "/1" to "/9"
  std::vector<Instruction> instructions;
  std::vector<Node> nodes;
  std::vector<Operand> operands;
  std::vector<VariableRef> variables;
  std::vector<Word> words;
  std::string text;

  std::string_view at(TextRef ref) const { return std::string_view(text).substr(ref.offset, ref.length); }
  TextRef add(std::string_view added);
  /// Empties the block and keeps its memory.
  void clear();
};

}  // namespace probewright::language
