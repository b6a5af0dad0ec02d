#pragma once

#include <array>
#include <string_view>

#include "language/klartext/parser.hpp"

namespace probewright::language::din_iso {

using klartext::CommandKind;
using klartext::nameOf;
using klartext::TransformKind;

/// The number in Klartext of the machining cycle that an old G function with parameters P01, P02... defines; 0: it
/// defines none. Such a block becomes a CycleCall with the name "G83", whose words have the number of their parameter
/// as address, and its axis, if it has one, shifted left by 8.
int oldMachiningCycle(int function);

/// Lowers one DIN/ISO block into the instruction set, as far as its own text tells. What only the blocks before it
/// tell (G90 or G91, the path function, the tool axis) is left open for ModalState::resolve:
/// - Modal "G0" "G1" ... "G16", "G17" "G18" "G19", "G90", "G91" for each such function, before all else.
/// - A path is Move with the variant "G". Its radius R and angle H are polar coordinates under a polar path function.
/// - Words without G90 or G91 in their own block have WordMode::Plain, all others Absolute or Incremental.
/// Everything else is what Klartext is lowered to. Values, formulas, M functions and cycle parameters are those of
/// Klartext, so its parser lends its words.
class BlockParser : private klartext::BlockParser {
public:
  /// `text`: the block without the sign that ends it. `first`: this is the first statement of the program.
  BlockParser(std::string_view text, const std::string& file, Block& block, Diagnostics& diagnostics, bool first,
              bool inch)
      : klartext::BlockParser(text, file, block, diagnostics), first_(first), inch_(inch) {}

  void parse();

private:
  using klartext::BlockParser::error;

  // parser.cpp
  bool statement();
  bool percent();
  bool selectionByPercent();
  bool labelCall();
  bool labelDefinition();

  // words.cpp: G functions and coordinates
  bool words();
  bool wordOf(char address);
  bool preparatory();
  bool takeFunction(int number);
  bool coordinate(char address, std::string_view what);
  bool parameterWord();
  bool referencePlaneWord(int parameter);
  bool spindleOrClearance();
  bool valueOnce(Operand& operand, std::string_view what);
  bool toolWordOrTolerance();
  bool emitWords();
  bool emitPath();
  bool emitTool();

  // cycles.cpp: G functions that are cycles, transformations or settings in Klartext
  bool emitFunction();
  bool onlyTakes(std::string_view addresses, std::uint32_t parameters = 99);
  std::string surplusOfPath() const;
  bool nothingBefore();
  void emitToolAxis();
  const Word* find(std::string_view address) const;
  const Word* parameter(std::uint32_t number) const;
  bool emitWithFunctions(const Instruction& instruction);
  bool corner(MoveKind kind);
  bool setting(CommandKind kind, std::string_view address, Operand value, std::string_view example);
  bool transform(TransformKind kind, std::string_view addresses);
  bool datumFromTable();
  bool rotation();
  bool tilt();
  bool referencePlane();
  bool tolerance();
  bool toolDefinition();
  bool blankForm();
  bool measuringOrMachining(int number);
  bool oldMachining(int cycle);

  // functions.cpp: D00 to D38
  bool function();
  bool assignmentOf(int number);
  bool jumpOf(int number);
  bool systemRead();
  bool printing();
  bool secondParameterFollows();
  bool valuesForPlc(int number);
  std::optional<Operand> parameterValue(int number);
  bool parameterAddress(int number);

  static constexpr std::size_t mostWords = 16;

  bool first_;
  bool inch_;  ///< the unit of the program
  WordMode mode_ = WordMode::Plain;
  int function_ = -1;  ///< G function that decides what the block does
  bool motion_ = false;
  int path_ = -1;                  ///< the path function of this block, if it has one
  int axisFunction_ = -1;          ///< G17, G18, G19
  int compensationFunction_ = -1;  ///< G40 to G44
  bool feedGiven_ = false;
  char axis_ = 0;  ///< of G17, G18, G19
  std::array<Word, mostWords> coordinates_{};
  std::size_t coordinateCount_ = 0;
  std::array<Word, 3> centre_{};
  std::size_t centreCount_ = 0;
  std::array<Word, 12> parameters_{};  ///< P01, P02...: the number is the address
  std::size_t parameterCount_ = 0;
  char probingAxis_ = 0;
  bool probingPositive_ = false;
  std::string_view name_;  ///< the file of G39
  Move move_;
  ToolCall tool_;
  bool toolCalled_ = false;
  Operand length_{};
};

}  // namespace probewright::language::din_iso
