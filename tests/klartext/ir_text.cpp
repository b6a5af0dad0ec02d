#include "klartext/ir_text.hpp"

#include <fmt/format.h>

#include "base/number_text.hpp"
#include "language/klartext/program.hpp"

namespace probewright::language::klartext::testing {

namespace {

struct Writer {
  const Block& block;
  std::string out;

  std::string variable(const VariableRef& v) const {
    static constexpr std::string_view names[] = {"Q", "QL", "QR", "QS", "R", "User", "$"};
    return std::string(names[static_cast<int>(v.space)]) + formatShortest(v.index[0].number);
  }

  std::string operand(const Operand& o) const {
    if (!o.present()) return "-";
    if (o.isLiteral()) return formatShortest(o.number);
    const Node& n = block.nodes.at(static_cast<std::size_t>(o.node));
    const auto two = [&](std::string_view sign) {
      return fmt::format("({}{}{})", operand(n.left), sign, operand(n.right));
    };
    switch (n.operation) {
      case Operation::Number:
        return formatShortest(n.number);
      case Operation::Text:
        return fmt::format("'{}'", block.at(n.text));
      case Operation::Variable:
        return variable(block.variables.at(n.a));
      case Operation::Undefined:
        return fmt::format("undefined({})", variable(block.variables.at(n.a)));
      case Operation::Negate:
        return fmt::format("-{}", operand(n.left));
      case Operation::Not:
        return fmt::format("!{}", operand(n.left));
      case Operation::Add:
        return two("+");
      case Operation::Subtract:
        return two("-");
      case Operation::Multiply:
        return two("*");
      case Operation::Divide:
        return two("/");
      case Operation::Modulo:
        return two("%");
      case Operation::Power:
        return two("^");
      case Operation::Concatenate:
        return two("||");
      case Operation::Equal:
        return two("==");
      case Operation::NotEqual:
        return two("!=");
      case Operation::Less:
        return two("<");
      case Operation::Greater:
        return two(">");
      case Operation::Call: {
        std::string text = n.function == Function::Host ? std::string(block.at(n.text))
                                                        : "f" + std::to_string(static_cast<int>(n.function));
        text += "(";
        for (std::uint32_t i = 0; i < n.b; ++i)
          text.append(i ? "," : "").append(operand(block.operands.at(n.a + i)));
        return text + ")";
      }
      default:
        return "?";
    }
  }

  void words(WordRange range) {
    for (std::uint32_t i = 0; i < range.count; ++i) {
      const Word& w = block.words.at(range.first + i);
      out += w.mode == WordMode::Incremental ? " I" : " ";
      const std::string name = addressName(w.address);
      const bool letters = !name.empty() && name.front() >= '#' && name.front() <= 'Z' && w.address > 255;
      const bool one = w.address >= '#' && w.address <= 'Z' && name.size() == 1;
      out += letters && name.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789") == std::string::npos
                 ? name
                 : (one && (name[0] == '#' || (name[0] >= 'A' && name[0] <= 'Z')) ? name : std::to_string(w.address));
      if (w.value.present()) out.append("=").append(operand(w.value));
    }
  }

  void label(TextRef text, const Operand& value) {
    out += value.present() ? " " + operand(value) : " '" + std::string(block.at(text)) + "'";
  }

  void operator()(const Assign& i) { out += variable(block.variables.at(i.variable)) + " := " + operand(i.value); }
  void operator()(const Jump& i) {
    out += "Jump";
    label(i.label, i.labelValue);
    out.append(" if ").append(operand(i.condition));
  }
  void operator()(const LabelMark& i) { out += "Label '" + std::string(block.at(i.label)) + (i.end ? "' end" : "'"); }
  void operator()(const CallLabel& i) {
    out += "CallLabel";
    label(i.label, i.labelValue);
    if (i.repeats.present()) out += " rep " + operand(i.repeats);
  }
  void operator()(const RepeatSection&) { out += "RepeatSection"; }
  void operator()(const CallProgram& i) {
    out += "CallProgram";
    label(i.name, i.nameValue);
  }
  void operator()(const Return&) { out += "Return"; }
  void operator()(const EndProgram&) { out += "EndProgram"; }
  void operator()(const Structured&) { out += "Structured"; }
  void operator()(const Move& i) {
    static constexpr std::string_view kinds[] = {"Modal",   "Rapid",         "Linear",   "Arc-",
                                                 "Arc+",    "ArcTangential", "Through",  "SetCentre",
                                                 "Chamfer", "Rounding",      "Approach", "Depart"};
    static constexpr std::string_view compensations[] = {"", " R0", " RL", " RR"};
    out += kinds[static_cast<int>(i.kind)];
    if (i.polar) out += " polar";
    if (i.variant.length > 0) out += " " + std::string(block.at(i.variant));
    words(i.words);
    out += compensations[static_cast<int>(i.compensation)];
    if (i.feed.present()) out.append(" F=").append(operand(i.feed));
    if (i.rapid) out += " FMAX";
    if (i.autoFeed) out += " FAUTO";
    if (i.machineCoordinates) out += " M91";
    if (i.machineReference2) out += " M92";
  }
  void operator()(const ToolCall& i) {
    out += "Tool";
    const auto part = [&](std::string_view name, const Operand& o) {
      if (o.present()) out += " " + std::string(name) + "=" + operand(o);
    };
    part("number", i.number);
    part("name", i.name);
    part("index", i.index);
    if (i.axis != 0) out += std::string(" axis=") + i.axis;
    part("S", i.spindleSpeed);
    part("VC", i.cuttingSpeed);
    part("F", i.feed);
    part("DL", i.deltaLength);
    part("DR", i.deltaRadius);
    part("DR2", i.deltaRadius2);
  }
  void operator()(const Modal& i) {
    out += "Modal " + std::string(block.at(i.name));
    words(i.words);
  }
  void operator()(const MachineFunction& i) {
    out.append("M").append(std::to_string(i.number));
    if (i.argument.present()) out += " arg=" + operand(i.argument);
    words(i.words);
  }
  void operator()(const Transform& i) {
    out += "Transform " + std::string(block.at(i.name));
    words(i.words);
    if (i.option.length > 0) out += " '" + std::string(block.at(i.option)) + "'";
  }
  void operator()(const CycleCall& i) {
    out += "Cycle " + std::to_string(i.number) + " " + std::string(block.at(i.name));
    words(i.parameters);
  }
  void operator()(const Command& i) {
    out += std::string(block.at(i.name));
    if (i.text.length > 0) out += " '" + std::string(block.at(i.text)) + "'";
    if (i.variable >= 0) out += " -> " + variable(block.variables.at(static_cast<std::size_t>(i.variable)));
    words(i.words);
  }
  void operator()(const Stop& i) { out += i.optional ? "Stop optional" : "Stop"; }
};

}  // namespace

std::string irText(const Block& block) {
  Writer writer{block, {}};
  for (const Instruction& instruction : block.instructions) {
    if (!writer.out.empty()) writer.out += " | ";
    std::visit(writer, instruction);
  }
  return writer.out;
}

std::string irOf(const std::string& text) {
  KlartextProgram program("test.h", text);
  Block block;
  Diagnostics diagnostics;
  std::string result;
  BlockPosition position = program.begin();
  while (program.parse(position, block, diagnostics)) {
    const std::string written = irText(block);
    if (!result.empty() && !written.empty()) result += "\n";
    result += written;
    position = block.next;
  }
  for (const Diagnostic& d : diagnostics) {
    if (!result.empty()) result += "\n";
    result += std::to_string(d.place.line) + ":" + std::to_string(d.place.column) + ": " + d.message;
  }
  return result;
}

}  // namespace probewright::language::klartext::testing
