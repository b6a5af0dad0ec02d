#include "language/sinumerik/writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <span>
#include <vector>

#include "language/sinumerik/keywords.hpp"
#include "language/sinumerik/program.hpp"

namespace probewright::language::sinumerik {

using namespace language;

namespace {

std::string_view modeName(WordMode mode) {
  switch (mode) {
    case WordMode::Absolute:
      return "AC";
    case WordMode::Incremental:
      return "IC";
    case WordMode::DirectPositive:
      return "ACP";
    case WordMode::DirectNegative:
      return "ACN";
    case WordMode::DirectShortest:
      return "DC";
    case WordMode::Plain:
      break;
  }
  return {};
}

class BlockWriter {
public:
  explicit BlockWriter(const Block& block) : block_(block) {}

  Result<std::string> write();

private:
  std::string expression(const Operand& operand) const { return writeExpression(block_, operand); }
  std::string name(TextRef ref) const { return std::string(block_.at(ref)); }
  std::span<const Word> words(WordRange range) const {
    return std::span<const Word>(block_.words).subspan(range.first, range.count);
  }
  void add(std::string statement) {
    if (!text_.empty() && text_.back() != ' ') text_ += ' ';
    text_ += statement;
  }
  void refuse(std::string_view what) {
    if (refused_.empty()) refused_ = what;
  }

  std::string value(const Word& word) const;
  std::string word(const Word& word) const;
  std::string address(std::string_view address, const Operand& value) const;
  /// S2, S[SPINU]: an address with its extension.
  std::string extended(std::string_view address, const Operand& extension) const;
  std::string axisWords(WordRange range) const;
  std::string arguments(WordRange range) const;
  std::string target(TextRef label, const Operand& value) const;
  std::string variable(std::uint32_t index) const;

  void statement(const Assign& assign) {
    add(fmt::format("{}={}", variable(assign.variable), expression(assign.value)));
  }
  void statement(const Jump& jump);
  void statement(const LabelMark&) { refuse("LBL"); }
  void statement(const CallLabel&) { refuse("CALL LBL"); }
  void statement(const RepeatSection& section);
  void statement(const CallProgram& call);
  void statement(const Return& order);
  void statement(const EndProgram&) { add("M30"); }
  void statement(const Structured& structured);
  void statement(const Move& move);
  void statement(const ToolCall& call);
  void statement(const Modal& modal);
  void statement(const MachineFunction& function);
  void statement(const Transform& transform);
  void statement(const CycleCall& call);
  void statement(const Command& command);
  void statement(const Stop& stop) { add(stop.optional ? "M1" : "M0"); }
  void declaration(const Command& command);

  const Block& block_;
  std::string text_;
  std::string refused_;
  bool declared_ = false;
};

std::string BlockWriter::variable(std::uint32_t index) const { return writeVariable(block_, block_.variables[index]); }

std::string BlockWriter::value(const Word& word) const {
  const std::string_view mode = modeName(word.mode);
  if (word.value.node >= 0) {
    const Node& node = block_.nodes[static_cast<std::size_t>(word.value.node)];
    if (node.operation == Operation::Call && node.function == Function::Host &&
        isDimensionFunction(block_.at(node.text)))
      return expression(word.value);
  }
  return mode.empty() ? expression(word.value) : fmt::format("{}({})", mode, expression(word.value));
}

std::string BlockWriter::address(std::string_view address, const Operand& value) const {
  const bool direct = address.size() == 1 && value.isLiteral();
  return fmt::format("{}{}{}", address, direct ? "" : "=", expression(value));
}

std::string BlockWriter::extended(std::string_view address, const Operand& extension) const {
  const std::string text = expression(extension);
  return extension.isLiteral() ? fmt::format("{}{}", address, text) : fmt::format("{}[{}]", address, text);
}

std::string BlockWriter::word(const Word& word) const {
  const std::string address = addressName(word.address);
  if (word.mode == WordMode::Plain) return this->address(address, word.value);
  return fmt::format("{}={}", address, value(word));
}

std::string BlockWriter::axisWords(WordRange range) const {
  std::string text;
  for (const Word& each : words(range)) {
    if (each.address == addressOf("AX[]") || each.address == addressOf("IP[]")) {
      text += fmt::format(" {}[{}]", each.address == addressOf("AX[]") ? "AX" : "IP", expression(each.value));
    } else if (each.address == addressOf("=AX") || each.address == addressOf("=IP")) {
      text += fmt::format("={}", value(each));
    } else {
      text += fmt::format(" {}", word(each));
    }
  }
  return text;
}

std::string BlockWriter::arguments(WordRange range) const {
  std::string text = "(";
  for (const Word& each : words(range)) {
    if (text.size() > 1 || each.address > 0) text += ',';
    text += expression(each.value);
  }
  text += ')';
  return text;
}

std::string BlockWriter::target(TextRef label, const Operand& value) const {
  return label.length != 0 ? name(label) : expression(value);
}

void BlockWriter::statement(const Jump& jump) {
  if (jump.condition.present()) add(fmt::format("IF {}", expression(jump.condition)));
  if (jump.direction == JumpDirection::ProgramStart) return add("GOTOS");
  const char* keyword = jump.ignoreMissing                          ? "GOTOC "
                        : jump.direction == JumpDirection::Forward  ? "GOTOF "
                        : jump.direction == JumpDirection::Backward ? "GOTOB "
                                                                    : "GOTO ";
  add(keyword + target(jump.label, jump.labelValue));
}

void BlockWriter::statement(const RepeatSection& section) {
  std::string text = section.onlyBlock ? "REPEATB " : "REPEAT ";
  text += name(section.from);
  if (section.to.length != 0) text += fmt::format(" {}", name(section.to));
  if (section.times.present()) text += fmt::format(" {}", address("P", section.times));
  add(text);
}

void BlockWriter::statement(const CallProgram& call) {
  // CALL names its program by a text; that lies in the source as it was written.
  const bool byText = call.name.offset < block_.source.offset + block_.source.length;
  if (call.modal && call.name.length == 0) return add("MCALL");
  const std::string program = name(call.name);
  if (call.nameValue.present()) {
    add(fmt::format("CALL {}", expression(call.nameValue)));
  } else if (byText) {
    add(fmt::format("CALL \"{}\"", program));
  } else {
    const bool numbered = program.size() > 1 && program[0] == 'L' && program[1] >= '0' && program[1] <= '9';
    const bool plain = call.maybeCycle || numbered;
    add(fmt::format("{}{}", call.modal ? "MCALL " : plain ? "" : "PCALL ", program));
    if (call.arguments.count > 0) text_ += arguments(call.arguments);
  }
  if (call.from.length > 0) add(fmt::format("BLOCK {} TO {}", name(call.from), name(call.to)));
  if (call.times.present()) add(address("P", call.times));
}

void BlockWriter::statement(const Return& order) {
  if (!order.target.present() && !order.levels.present() && !order.start.present()) return add("M17");
  const Operand* const given[] = {&order.target, &order.behind, &order.levels, &order.start};
  std::size_t last = std::size(given);
  while (!given[last - 1]->present())
    --last;
  std::string text = "RET(";
  for (std::size_t i = 0; i < last; ++i) {
    if (i > 0) text += ',';
    text += expression(*given[i]);
  }
  text += ")";
  add(text);
}

void BlockWriter::statement(const Structured& structured) {
  static constexpr const char* names[] = {"IF",     "ELSE", "ENDIF",   "WHILE",  "ENDWHILE", "FOR",
                                          "ENDFOR", "LOOP", "ENDLOOP", "REPEAT", "UNTIL"};
  std::string text = names[static_cast<std::size_t>(structured.kind)];
  if (structured.kind == Structure::For)
    text += fmt::format(" {}={} TO {}", variable(structured.variable), expression(structured.from),
                        expression(structured.to));
  if (structured.condition.present()) text += fmt::format(" {}", expression(structured.condition));
  add(text);
}

void BlockWriter::statement(const Move& move) {
  static constexpr const char* compensations[] = {"", "G40", "G41", "G42"};
  if (move.variant.length != 0) add(name(move.variant));
  if (move.compensation != RadiusCompensation::Unchanged)
    add(compensations[static_cast<std::size_t>(move.compensation)]);
  switch (move.kind) {
    case MoveKind::Modal:
      break;
    case MoveKind::Rapid:
      add("G0");
      break;
    case MoveKind::Linear:
      add("G1");
      break;
    case MoveKind::ArcClockwise:
      add("G2");
      break;
    case MoveKind::ArcCounterclockwise:
      add("G3");
      break;
    case MoveKind::ArcTangential:
      add("CT");
      break;
    case MoveKind::ArcThroughPoint:
      add("CIP");
      break;
    case MoveKind::SetCentre:
      return refuse("CC");
    case MoveKind::Chamfer:
      return refuse("CHF");
    case MoveKind::Rounding:
      return refuse("RND");
    case MoveKind::Approach:
      return refuse("APPR");
    case MoveKind::Depart:
      return refuse("DEP");
  }
  const std::string words = axisWords(move.words);
  if (!words.empty()) add(words.substr(1));
  if (move.feed.present()) add(address("F", move.feed));
}

void BlockWriter::statement(const ToolCall& call) {
  if (call.axis != 0) return refuse("TOOL CALL");
  const bool named = call.name.present();
  const std::string tool = call.index.present() ? extended("T", call.index) : std::string("T");
  if (named || call.number.present()) add(address(tool, named ? call.name : call.number));
}

void BlockWriter::statement(const Modal& modal) {
  const std::string function = name(modal.name);
  const auto given = words(modal.words);
  const bool isAddress = function.size() == 1 && !given.empty();
  if (isAddress && given.size() > 1)
    return add(fmt::format("{}={}", extended(function, given[1].value), value(given.front())));
  if (isAddress) return add(word(given.front()));
  if (function == "G25" || function == "G26") return add(function + axisWords(modal.words));
  add(function);
  if (!given.empty()) text_ += arguments(modal.words);
}

void BlockWriter::statement(const MachineFunction& function) {
  if (function.number < 0) {
    const std::string address =
        function.words.count > 0 ? extended("M", words(function.words).front().value) : std::string("M");
    return add(fmt::format("{}={}", address, expression(function.argument)));
  }
  if (function.argument.present()) return add(fmt::format("{}={}", extended("M", function.argument), function.number));
  add(fmt::format("M{}", function.number));
}

void BlockWriter::statement(const Transform& transform) { add(name(transform.name) + axisWords(transform.words)); }

void BlockWriter::statement(const CycleCall& call) {
  if (call.number != 0) return refuse("TCH PROBE");
  add(name(call.name) + arguments(call.parameters));
}

void BlockWriter::declaration(const Command& command) {
  const auto given = words(command.words);
  if (!declared_) {
    add(fmt::format("DEF {}", name(command.text)));
    for (const Word& each : given)
      if (each.address == addressOf("LEN")) text_ += fmt::format("[{}]", expression(each.value));
    text_ += " ";
  } else {
    text_ += ",";
  }
  declared_ = true;
  text_ += variable(static_cast<std::uint32_t>(command.variable));
  std::string list;
  std::uint32_t kind = 0;
  for (const Word& each : given) {
    if (each.address == addressOf("LEN")) continue;
    if (kind != 0) list += ",";
    kind = each.address;
    list += expression(each.value);
  }
  if (kind == addressOf("INIT")) text_ += fmt::format("={}", list);
  if (kind == addressOf("SET")) text_ += fmt::format("=SET({})", list);
  if (kind == addressOf("REP")) text_ += fmt::format("=REP({})", list);
}

void BlockWriter::statement(const Command& command) {
  const std::string what = name(command.name);
  const auto given = words(command.words);
  if (what == "DEF") return declaration(command);
  if (command.variable >= 0 && (what == "SET" || what == "REP" || what == "CALCDAT"))
    return add(
        fmt::format("{}={}{}", variable(static_cast<std::uint32_t>(command.variable)), what, arguments(command.words)));
  const Keyword keyword = keywordOf(what);
  switch (keyword) {
    case Keyword::Setting: {
      std::string text = what;
      if (given.size() > 1) text += fmt::format("[{}]", expression(given[1].value));
      if (what == "POSP") {
        std::string list = expression(given.front().value);
        for (const Word& each : given.subspan(std::min<std::size_t>(given.size(), 2)))
          list += fmt::format(",{}", expression(each.value));
        return add(fmt::format("{}=({})", text, list));
      }
      return add(fmt::format("{}={}", text, value(given.front())));
    }
    case Keyword::Measure: {
      const bool axial = what.size() == 5;
      if (axial) {
        add(fmt::format("{}[{}]=({},{})", what, expression(given[1].value), expression(given[2].value),
                        expression(given[0].value)));
      } else {
        add(fmt::format("{}={}", what, expression(given.front().value)));
      }
      // Splines write their word themselves.
      const bool written = std::ranges::any_of(block_.instructions, [&](const Instruction& each) {
        const auto* modal = std::get_if<language::Modal>(&each);
        return modal != nullptr && name(modal->name) == name(command.text);
      });
      if (command.text.length != 0 && !written) add(name(command.text));
      const std::string axes =
          axisWords({command.words.first + (axial ? 3 : 1), command.words.count - (axial ? 3 : 1)});
      if (!axes.empty()) add(axes.substr(1));
      return;
    }
    case Keyword::ModalCall:
      add(what);
      if (command.text.length != 0) add(name(command.text) + (given.empty() ? "" : arguments(command.words)));
      return;
    case Keyword::Axial:
      add(fmt::format("{}[{}]", what, expression(given.front().value)));
      if (given.size() > 1) text_ += fmt::format("={}", expression(given[1].value));
      return;
    case Keyword::Procedure:
    case Keyword::External:
    case Keyword::Define:
    case Keyword::Redefine:
    case Keyword::IsoCall:
    case Keyword::SynchronizedAction: {
      // Texts keep their own letters: the statement is taken from the source.
      const std::size_t at = command.text.offset - block_.source.length - block_.source.offset;
      const bool fromSource = at + command.text.length <= block_.source.length;
      const bool joined = keyword == Keyword::SynchronizedAction && name(command.text).front() == '=';
      add(what + (joined ? "" : " ") +
          (fromSource ? name({block_.source.offset + static_cast<std::uint32_t>(at), command.text.length})
                      : name(command.text)));
      return;
    }
    case Keyword::Statement:
      add(what);
      if (!given.empty()) text_ += arguments(command.words);
      if (given.empty() && what == "MSG") text_ += "()";
      return;
    default:
      break;
  }
  if (what == "G4" || what == "G74" || what == "G75") return add(what + axisWords(command.words));
  refuse(what);
}

/// The comment of a source line with its semicolon.
std::string_view commentOf(std::string_view source) {
  bool inText = false;
  for (std::size_t i = 0; i < source.size(); ++i) {
    if (source[i] == '"') inText = !inText;
    if (source[i] == ';' && !inText) return source.substr(i);
  }
  return {};
}

Result<std::string> BlockWriter::write() {
  const std::string_view source = block_.at(block_.source);
  const std::size_t first = source.find_first_not_of(" \t");
  if (first != std::string_view::npos && source[first] == '%') return std::string(source);
  if (block_.skippable) {
    text_ = "/";
    const std::size_t slash = source.find('/');
    if (slash != std::string_view::npos && slash + 1 < source.size() && source[slash + 1] >= '0' &&
        source[slash + 1] <= '9')
      text_ += source[slash + 1];
  }
  if (block_.label.length != 0) {
    const std::string label = name(block_.label);
    const bool number = label[0] == ':' || (label[0] == 'N' && label.size() > 1 && label[1] >= '0' && label[1] <= '9');
    add(number ? label : fmt::format("{}:", label));
  }
  for (const Instruction& instruction : block_.instructions)
    std::visit([this](const auto& each) { statement(each); }, instruction);
  if (!refused_.empty()) {
    return fail("SINUMERIK has no statement like " + refused_,
                "Rewrite this block by hand, or leave it to a subprogram of the control.");
  }
  if (const std::string_view comment = commentOf(source); !comment.empty()) add(std::string(comment));
  return std::move(text_);
}

}  // namespace

Result<std::string> writeBlock(const Block& block) { return BlockWriter(block).write(); }

Result<std::string> writeProgram(SinumerikProgram& program) {
  std::string text;
  Block block;
  Diagnostics mistakes;
  for (BlockPosition at = program.begin(); program.parse(at, block, mistakes); at = block.next) {
    if (!mistakes.empty()) return tl::unexpected(std::move(mistakes.front()));
    Result<std::string> line = writeBlock(block);
    if (!line) {
      line.error().place = {program.file(), block.position.line, 0};
      line.error().excerpt = block.at(block.source);
      return line;
    }
    text.append(*line).append("\n");
  }
  return text;
}

}  // namespace probewright::language::sinumerik
