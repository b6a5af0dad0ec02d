#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.hpp"
#include "language/block.hpp"
#include "language/sinumerik/cursor.hpp"
#include "language/sinumerik/keywords.hpp"
#include "language/sinumerik/operators.hpp"

namespace probewright::language::sinumerik {

/// Parses blocks of the SINUMERIK language into the instruction set. One object parses any number of blocks and
/// allocates only while its buffers grow.
///
/// How statements are lowered (the host and the writer rely on it):
///  - Instructions are in the order in which the control carries them out: assignments and modal functions as
///    written, then the motion, then M0, M1, M2, M17, M30.
///  - A motion function with axis words is one Move; without them it is Modal{"G1"}. Move{Modal} continues group 1.
///    Move::variant is "SUPA", "G53" or "G153" where those stand, or the name of a spline; feed F goes into the Move.
///  - Modal{"F" | "S" | "D" | "H"}: words[0] is the value, its address the whole address ("S", "S1"); S[v]=, H[v]=:
///    words[1] the computed extension.
///  - Settings (SPOS=, LIMS=, POS[X]=, ...): Command{NAME}, words: [0] address 0 the value, [1] address 1 the index.
///  - Statements with parentheses (MSG, SETAL, FGROUP, ...) and named G functions: arguments by position.
///  - DEF: one Command{"DEF", text: type} per variable; variables[variable] has the dimensions as indices; words:
///    "LEN" length of a STRING, "INIT" one value, "SET" values of a list, "REP" the value that fills the array.
///  - NAME[..]=SET(..) and REP(..): Command{"SET" | "REP", variable, words by position}.
///  - PROC, EXTERN, DEFINE, synchronized actions: Command whose text is the rest of the block in upper case.
///  - G4: Command{"G4"}, words F or S. MEAS/MEAW: Command, words[0] address "MEAS" the event, then axis words and F;
///    text: "G0" or "G1" if the block says so; MEASA/MEAWA have "MAX" the axis and "MMO" the mode after the event.
///  - An axis given by a variable, AX[v]=..: word "AX[]" with the axis followed by word "=AX" with the value; IP[v]=..
///    in the same way.
///  - POLY's PO[X]=(..): the word X with the end point; PO of angles of the orientation falls away.
///  - POSP[X]=(end,part,mode): Command, words[0] the end, [1] the axis, then part and mode.
///  - M functions with a spindle number, M2=3, M[v]=3: number 3, argument the spindle. M=expression: number -1,
///    argument the expression; M[v]=expression: and words[0] the spindle.
///  - NAME=CALCDAT(..): Command{"CALCDAT", variable, words by position}.
class BlockParser {
public:
  /// Parses `line`. `block` must be clear; position and next are the caller's.
  void parse(std::string_view line, const SourcePlace& place, language::Block& block, Diagnostics& diagnostics);

  /// One formal parameter of a PROC line.
  struct Parameter {
    std::string name;  ///< upper case
    Type type = Type::Real;
    bool byReference = false;  ///< VAR
    int length = 200;          ///< of a STRING
    std::vector<int> dimensions;
    double defaultNumber = 0;
    std::string defaultText;
  };
  struct Header {
    std::string name;
    std::vector<Parameter> parameters;
    std::vector<std::string> attributes;  ///< SAVE, DISPLOF, ...
  };
  /// Parses the text of a PROC command: "NAME(REAL A,VAR INT B) SAVE". Nothing if it is malformed.
  static bool parseHeader(std::string_view text, Header& header, std::string& mistake, std::size_t& mistakeOffset);

private:
  enum class Owner : std::uint8_t { Move, Transform, Modal, Command };  ///< what the axis words of a block belong to

  // block_parser.cpp
  void takeLine(std::string_view line);
  void parseStatements();
  void fail(std::size_t offset, std::string message, std::string advice = {});
  language::TextRef upper(std::size_t offset, std::size_t length) const;
  language::TextRef upper(std::string_view part) const;
  language::TextRef original(std::size_t offset, std::size_t length) const;
  language::Operand add(const language::Node& node);
  language::TextRef restOfBlock();
  void expectEnd(const char* after);
  void finish();
  void emitMove();
  bool wordsFit();
  bool addressesOnce();
  bool takeOnce(std::string what, std::size_t start, std::string_view alarm = "12010");

  // words.cpp
  void parseAddress();
  bool takeGroup(language::TextRef name, std::size_t start);
  void parseG(std::size_t start);
  void parseM(std::size_t start);
  void parseT(std::size_t start);
  void parseL(std::size_t start);
  void parseAxisWord(std::uint32_t address, std::size_t start);
  void parseModalAddress(char letter, std::size_t start);
  bool parseExtension(std::uint32_t& address);
  bool parseExtension(std::uint32_t& address, language::Operand& index);
  bool takeSkip();
  bool takeNumber(double& value);
  bool parseShortValue(double& value);
  language::Operand parseValue(language::WordMode* mode);
  bool parseDimensionedValue(language::Word& word);
  bool beginsFeedFunction(std::initializer_list<std::string_view> names);
  void parseAxialDiameter(std::string_view name);
  void addMoveWord(std::uint32_t address, std::size_t start);
  void parseMoveWord(std::string_view name, std::size_t start);
  void parseComputedAxis(std::string_view name, std::size_t start);
  void parsePolynomial(std::size_t start);
  bool beginsList() const;
  void parseSetting(std::string_view name, std::size_t start);
  void setMotion(language::MoveKind kind, std::size_t start);
  void setOwner(Owner owner, language::TextRef name, std::size_t start);
  void parseMeasure(std::string_view name, std::size_t start);

  // statements.cpp
  void parseNamed();
  bool isFirstStatement() const;
  void parseKeyword(Keyword keyword, std::string_view name, std::size_t start);
  void parseIf(std::size_t start);
  void parseCase();
  void parseFor();
  void parseJump(std::string_view name, language::Operand condition);
  void parseRepeat(std::string_view name, std::size_t start);
  void parseUserName(std::string_view name, std::size_t start);
  void parseAssignment(std::size_t start);
  void parseFill(std::uint32_t variable);
  void parseReturn(std::string_view name);
  void parseAxial(std::string_view name, std::size_t start);
  void parseStatement(Keyword keyword, std::string_view name);
  void pushStructure(language::Structure kind, language::Operand condition = {});
  language::TextRef parseTarget();

  // calls.cpp
  void parseCall(std::size_t start);
  bool parseCalledSection(language::TextRef& from, language::TextRef& to);
  void parsePathCall(std::size_t start);
  void parseModalCall();
  void parseRest(std::string_view name);
  language::WordRange parseArguments();
  enum class Meant { Program, ProgramOrCycle };
  void parseProgramCall(language::TextRef name, Meant meant);

  // declarations.cpp
  void parseDeclaration(std::size_t start);
  void parseDeclaredVariable(language::TextRef typeText, Type type, language::Operand length);
  void parseProcedure(std::string_view keyword);

  // expressions.cpp
  language::Operand parseExpression();
  language::Operand parseBinary(Priority lowest);
  language::Operand parseUnary();
  language::Operand parsePrimary();
  language::Operand emptyText();
  language::Operand parseString();
  language::Operand parseQuotedConstant();
  language::Operand parseNamedValue();
  language::Operand parseFunction(std::string_view name, std::size_t start);
  std::uint32_t parseVariable();
  void parseIndices(language::VariableRef& variable);
  bool expect(char c, const char* what);

  language::Block* block_ = nullptr;
  Diagnostics* diagnostics_ = nullptr;
  const SourcePlace* place_ = nullptr;
  std::string_view line_;
  std::string upper_;              ///< the block in upper case without its comment
  std::uint32_t upperOffset_ = 0;  ///< of upper_ in Block::text
  Cursor cursor_;
  bool failed_ = false;
  int depth_ = 0;  ///< of nested expressions

  std::vector<language::Word> axisWords_;
  std::vector<language::Instruction> after_;
  Owner owner_ = Owner::Move;
  language::TextRef ownerName_;
  language::TextRef motionName_;
  language::MoveKind motion_ = language::MoveKind::Modal;
  bool motionGiven_ = false;
  bool polar_ = false;
  language::RadiusCompensation compensation_ = language::RadiusCompensation::Unchanged;
  language::TextRef compensationName_;
  language::TextRef suppression_;
  language::Operand feed_;
  std::uint32_t feedColumn_ = 0;
  std::vector<std::string> taken_;  ///< what a block has once, and this one has
  std::uint64_t groups_ = 0;        ///< of G functions, a bit each: those that the block has a function of
};

}  // namespace probewright::language::sinumerik
