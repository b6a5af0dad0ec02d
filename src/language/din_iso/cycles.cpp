#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "cycles/catalogue.hpp"
#include "cycles/heidenhain/probe_words.hpp"
#include "language/din_iso/parser.hpp"
#include "language/klartext/formula_writer.hpp"

/// G functions that are cycles, transformations or settings in Klartext.
namespace probewright::language::din_iso {

namespace {

constexpr std::string_view axisLetters = "XYZABCUVW";

bool isTouchProbeCycle(int number) {
  return (number >= 400 && number <= 601) || (number >= 1400 && number < 1500) ||
         cycles::heidenhainCycle(number) != nullptr;
}

}  // namespace

int oldMachiningCycle(int function) {
  struct Twin {
    int function, cycle;
  };
  static constexpr std::array<Twin, 14> twins = {{{83, 1},
                                                  {84, 2},
                                                  {74, 3},
                                                  {75, 4},
                                                  {76, 4},
                                                  {77, 5},
                                                  {78, 5},
                                                  {57, 6},
                                                  {37, 14},
                                                  {56, 15},
                                                  {58, 16},
                                                  {59, 16},
                                                  {85, 17},
                                                  {86, 18}}};
  const auto found = std::ranges::find(twins, function, &Twin::function);
  return found == twins.end() ? 0 : found->cycle;
}

const Word* BlockParser::find(std::string_view address) const {
  for (std::size_t i = 0; i < coordinateCount_; ++i) {
    if (coordinates_[i].address == addressOf(address)) return &coordinates_[i];
  }
  return nullptr;
}

const Word* BlockParser::parameter(std::uint32_t number) const {
  for (std::size_t i = 0; i < parameterCount_; ++i) {
    if (parameters_[i].address == number) return &parameters_[i];
  }
  return nullptr;
}

/// Refuses words that the block's G function does not have. `addresses`: coordinates, and among them F, S, T, L and P
/// for words of those addresses. `parameters`: the highest number of a parameter P. A tool axis holds from here on.
bool BlockParser::onlyTakes(std::string_view addresses, std::uint32_t parameters) {
  const auto takes = [&](char address) { return addresses.find(address) != std::string_view::npos; };
  std::string surplus = surplusOfPath();
  for (std::size_t i = 0; i < coordinateCount_; ++i) {
    const Word& word = coordinates_[i];
    const bool ofPath = word.address > 0xff;  // FU and FZ
    if (!ofPath && takes(static_cast<char>(word.address))) continue;
    surplus = addressName(word.address);
  }
  for (std::size_t i = 0; i < parameterCount_; ++i)
    if ((parameters_[i].address & 0xff) > parameters) surplus = fmt::format("P{:02}", parameters_[i].address & 0xff);
  if (centreCount_ > 0) surplus = "I, J, K";
  if ((move_.feed.present() || move_.rapid || move_.autoFeed) && !takes('F')) surplus = "F";
  if (tool_.spindleSpeed.present() && !takes('S')) surplus = "S";
  if (tool_.cuttingSpeed.present()) surplus = "S(VC=)";
  if (toolCalled_ && !takes('T')) surplus = "T";
  if (length_.present() && !takes('L')) surplus = "L";
  if (parameterCount_ > 0 && !takes('P')) surplus = "P";
  if (!surplus.empty())
    return error(fmt::format("G{} takes no {}", function_, surplus), "write it in a block of its own");
  if (function_ != 30) emitToolAxis();  // of G30 it is the one of the picture
  return true;
}

/// A word that belongs to a path: neither a function nor a cycle would do what it says. Empty if there is none.
std::string BlockParser::surplusOfPath() const {
  if (move_.machineCoordinates || move_.machineReference2) return move_.machineCoordinates ? "M91" : "M92";
  if (compensationFunction_ >= 0) return fmt::format("G{}", compensationFunction_);
  if (tool_.deltaLength.present()) return "DL";
  if (tool_.deltaRadius.present()) return "DR";
  if (tool_.deltaRadius2.present()) return "DR2";
  // Whether they are the end of the path or belong to the function nobody can tell.
  const bool path = motion_ && coordinateCount_ > 0 && function_ != 24 && function_ != 25;
  return path && function_ != 26 && function_ != 27 ? fmt::format("path function G{:02}", path_) : "";
}

void BlockParser::emitToolAxis() {
  if (axis_ != 0) emit(Modal{constant(axis_ == 'Z' ? "G17" : axis_ == 'Y' ? "G18" : "G19"), {}});
}

bool BlockParser::emitWithFunctions(const Instruction& instruction) {
  emitWithMachineFunctions(&instruction);
  return true;
}

bool BlockParser::emitFunction() {
  switch (function_) {
    case 4:
      return onlyTakes("F") && setting(CommandKind::DwellTime, "T", move_.feed, "G04 F1.5");
    case 24:
      return corner(MoveKind::Chamfer);
    case 25:
    case 26:  // the arc that joins straight approach and contour is the one that rounds their corner
    case 27:
      return corner(MoveKind::Rounding);
    case 28:
      return transform(TransformKind::Mirror, axisLetters);
    case 29: {
      if (!onlyTakes({})) return false;
      Move centre;
      centre.kind = MoveKind::SetCentre;
      return emitWithFunctions(centre);
    }
    case 30:
    case 31:
      return blankForm();
    case 36:
      return onlyTakes("S") && setting(CommandKind::SpindleOrientation, "ANG", tool_.spindleSpeed, "G36 S90");
    case 38:
      return onlyTakes({}) && emitWithFunctions(Stop{});
    case 39:
      return onlyTakes({}) &&
             emitWithFunctions(Command{constant(nameOf(CommandKind::ProgramCall)), ref(name_), -1, {}});
    case 51:
    case 99:
      return toolDefinition();
    case 53:
      return datumFromTable();
    case 54:
      return transform(TransformKind::DatumShift, axisLetters);
    case 55:
      return referencePlane();
    case 62:
      return tolerance();
    case 72:
      return onlyTakes("F") && (move_.feed.present() || error("the scaling factor F is missing", "write G72 F0.8")) &&
             [this]() {
               const std::size_t first = block_.words.size();
               addWord(addressOf("SCL"), move_.feed);
               return emitWithFunctions(Transform{constant(nameOf(TransformKind::Scaling)), wordsSince(first), {}});
             }();
    case 73:
      return rotation();
    case 79:
      return onlyTakes({}) && emitWithFunctions(Command{constant(nameOf(CommandKind::CycleCall)), {}, -1, {}});
    default: {
      const int machining = oldMachiningCycle(function_);
      return machining != 0 ? oldMachining(machining) : tilt();
    }
  }
}

/// G83 P01 -2 P02 -20 P03 -5 P04 0 P05 500.
bool BlockParser::oldMachining(int cycle) {
  if (!onlyTakes("P")) return false;
  const std::size_t first = block_.words.size();
  block_.words.insert(block_.words.end(), parameters_.begin(),
                      parameters_.begin() + static_cast<std::ptrdiff_t>(parameterCount_));
  return emitWithFunctions(CycleCall{cycle, constant(fmt::format("G{}", function_)), wordsSince(first)});
}

bool BlockParser::corner(MoveKind kind) {
  if (!onlyTakes("RF")) return false;
  const Word* size = find("R");
  if (size == nullptr)
    return error(fmt::format("the {} R is missing", kind == MoveKind::Chamfer ? "length" : "radius"));
  Move move;
  move.kind = kind;
  move.feed = move_.feed;
  const std::size_t first = block_.words.size();
  addWord(addressOf("R"), size->value);
  move.words = wordsSince(first);
  return emitWithFunctions(move);
}

/// A setting with one value, which may not be left out.
bool BlockParser::setting(CommandKind kind, std::string_view address, Operand value, std::string_view example) {
  if (!value.present()) {
    return error(fmt::format("the value of G{} is missing", function_), fmt::format("write {}", example));
  }
  const std::size_t first = block_.words.size();
  addWord(addressOf(address), value);
  return emitWithFunctions(Command{constant(nameOf(kind)), {}, -1, wordsSince(first)});
}

bool BlockParser::transform(TransformKind kind, std::string_view addresses) {
  if (!onlyTakes(addresses)) return false;
  if (function_ == 54 && coordinateCount_ == 0) return error("an axis with its shift is missing", "write G54 X+10");
  const std::size_t first = block_.words.size();
  block_.words.insert(block_.words.end(), coordinates_.begin(),
                      coordinates_.begin() + static_cast<std::ptrdiff_t>(coordinateCount_));
  return emitWithFunctions(Transform{constant(nameOf(kind)), wordsSince(first), {}});
}

bool BlockParser::datumFromTable() {
  if (!onlyTakes("P", 1)) return false;
  const Word* row = parameter(1);
  if (row == nullptr) return error("the row of the datum table is missing", "write G53 P01 12");
  const std::size_t first = block_.words.size();
  addWord(addressOf("#"), row->value);
  return emitWithFunctions(Transform{constant(nameOf(TransformKind::DatumShift)), wordsSince(first), {}});
}

bool BlockParser::rotation() {
  if (!onlyTakes("H")) return false;
  const Word* angle = find("H");
  if (angle == nullptr) return error("the angle of rotation H is missing", "write G73 G90 H+30");
  const std::size_t first = block_.words.size();
  addWord(addressOf("ROT"), angle->value, angle->mode);
  return emitWithFunctions(Transform{constant(nameOf(TransformKind::Rotation)), wordsSince(first), {}});
}

/// G80 A+0 B+30 C+0 F500 S10; without words tilting ends.
bool BlockParser::tilt() {
  if (!onlyTakes("ABCFS")) return false;
  const std::size_t first = block_.words.size();
  for (std::size_t i = 0; i < coordinateCount_; ++i)
    addWord(coordinates_[i].address, coordinates_[i].value, coordinates_[i].mode);
  if (move_.feed.present()) addWord(addressOf("F"), move_.feed);
  if (tool_.spindleSpeed.present()) addWord(addressOf("DIST"), tool_.spindleSpeed);
  return emitWithFunctions(Transform{constant(nameOf(TransformKind::Tilting)), wordsSince(first), {}});
}

/// G55 P01 5 P02 X- P03 +5 P04 +0 P05 -5: result, axis and direction, X, Y, Z; the axes may stand as they are instead
/// of P03 to P05.
bool BlockParser::referencePlane() {
  namespace probe_word = cycles::heidenhain::probe_word;
  if (!onlyTakes("XYZABCUVWP", 5)) return false;
  const Word* target = parameter(1);
  if (target == nullptr || !target->value.isLiteral() || probingAxis_ == 0) {
    return error("P01 with the parameter for the result and P02 with the probing axis are needed",
                 "write G55 P01 5 P02 X- P03 +5 P04 +0 P05 -5");
  }
  const std::size_t first = block_.words.size();
  addWord(probe_word::result, target->value);
  addWord(probe_word::axis, Operand::of(static_cast<double>(axisLetters.find(probingAxis_))));
  addWord(probe_word::direction, Operand::of(probingPositive_ ? 1 : -1));
  for (std::uint32_t i = 0; i < 3; ++i) {
    const Word* position = parameter(3 + i);
    if (position != nullptr) addWord(probe_word::coordinate + i, position->value);
  }
  for (std::size_t i = 0; i < coordinateCount_; ++i) {
    const std::size_t index = axisLetters.find(static_cast<char>(coordinates_[i].address));
    addWord(probe_word::coordinate + static_cast<std::uint32_t>(index), coordinates_[i].value, coordinates_[i].mode);
  }
  if (block_.words.size() == first + 3) return error("the position to be probed is missing", "add P03, P04 and P05");
  return emitWithFunctions(CycleCall{0, constant("TCH PROBE"), wordsSince(first)});
}

/// G62 T0.05 P01 1 P02 5: tolerance, finishing 0 or roughing 1, tolerance of rotary axes.
bool BlockParser::tolerance() {
  if (!onlyTakes("LP", 2)) return false;
  const std::size_t first = block_.words.size();
  if (length_.present()) addWord(addressOf("T"), length_);
  if (const Word* mode = parameter(1); mode != nullptr && length_.present()) addWord(addressOf("HSC"), mode->value);
  if (const Word* rotary = parameter(2); rotary != nullptr && parameter(1) != nullptr && length_.present()) {
    addWord(addressOf("TA"), rotary->value);
  }
  return emitWithFunctions(Command{constant(nameOf(CommandKind::Tolerance)), {}, -1, wordsSince(first)});
}

/// G99 T5 L+0 R+5 and G51 T5.
bool BlockParser::toolDefinition() {
  if (!onlyTakes(function_ == 99 ? "TLR" : "T")) return false;
  if (!toolCalled_) return error(fmt::format("the tool T of G{} is missing", function_));
  const std::size_t first = block_.words.size();
  addWord(addressOf("T"), tool_.name.present() ? tool_.name : tool_.number);
  if (length_.present()) addWord(addressOf("L"), length_);
  if (const Word* radius = find("R")) addWord(addressOf("R"), radius->value);
  return emitWithFunctions(Command{constant(nameOf(CommandKind::ToolDefinition)), {}, -1, wordsSince(first)});
}

/// The picture for the control's graphics, in the words of Klartext.
bool BlockParser::blankForm() {
  if (!onlyTakes("XYZ")) return false;
  std::string text = function_ == 30 ? fmt::format("0.1 {}", axis_ == 0 ? 'Z' : axis_) : std::string("0.2");
  for (std::size_t i = 0; i < coordinateCount_; ++i) {
    const Word& corner = coordinates_[i];
    text += fmt::format(" {}{}{}", corner.mode == WordMode::Incremental ? "I" : "", addressName(corner.address),
                        klartext::writeValue(block_, corner.value));
  }
  return emitWithFunctions(Command{constant(nameOf(CommandKind::BlankForm)), constant(text), -1, {}});
}

/// G98 and cycles take the rest of their block; words before them would be lost.
bool BlockParser::nothingBefore() {
  std::string before = surplusOfPath();
  if (centreCount_ > 0) before = "I, J, K";
  if (coordinateCount_ > 0) before = addressName(coordinates_[0].address);
  if (feedGiven_) before = "F";
  if (tool_.spindleSpeed.present() || tool_.cuttingSpeed.present()) before = "S";
  if (toolCalled_) before = "T";
  if (length_.present()) before = "L";
  if (parameterCount_ > 0) before = "P";
  if (pendingCount_ > 0) before = "M";
  if (!before.empty())
    return error(fmt::format("{} stands before G{}, which takes the rest of the block only", before, function_),
                 "write it in a block of its own");
  emitToolAxis();
  return true;
}

/// Gnnn NAME Q200=... up to the end of the block.
bool BlockParser::measuringOrMachining(int number) {
  if (!nothingBefore()) return false;
  return parameterCycle(isTouchProbeCycle(number) ? "TCH PROBE" : "CYCL DEF", number);
}

}  // namespace probewright::language::din_iso
