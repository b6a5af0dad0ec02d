#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "conversion/parameter_texts.hpp"
#include "conversion/sinumerik_formulas.hpp"
#include "conversion/to_klartext.hpp"

/// Assignments and definitions of SINUMERIK programs in Klartext.
namespace probewright::conversion {

using namespace language;

void ToKlartext::assign(const Block& block, const Assign& assign) {
  const VariableRef& variable = block.variables[assign.variable];
  const bool frame = variable.space == VariableSpace::System && block.at(variable.name) == "$P_UIFR";
  if (frame && variable.index[2].present()) return assignFrameComponent(block, assign);
  // A HEIDENHAIN cycle with Q305 = 0 copies the active preset to row 0 and selects it by itself.
  if (frame && trimmed(block.at(block.source), lineBlanks).starts_with("$P_UIFR[99]=$P_UIFR[$P_UIFRNUM]")) {
    copiesToRow0_ = rowZeroIsDue_ = hasRowZero_ = true;
    return;
  }
  if (variable.space == VariableSpace::System) {
    const std::string value = formulas_.value(quantity(block, assign.value));
    if (const std::string datum = formulas_.toolDatum(block, variable); !datum.empty()) {
      if (mayBeInSpindle(block, variable.index[0]) && !actsBeforeItMoves(block, Acts::ToolDatum)) {
        out_.list(
            block,
            "a tool datum acts with the next D or T, on a HEIDENHAIN control at once if the tool is in the spindle",
            "call the edge after this block (D1)");
      }
      return line(fmt::format("FN 17: SYSWRITE {} = {}", datum, value));
    }
    throw NotCarriedOver(fmt::format("{} cannot be written in Klartext", block.at(variable.name)));
  }
  const std::string name = formulas_.variable(block, variable);
  const std::string formula = formulas_.assigned(block, variable, assign.value);
  line(fmt::format("{} = {}", name, formula));
  const std::string own(variable.space == VariableSpace::User ? block.at(variable.name) : std::string_view());
  if (formulas_.isGlobal(own) && changedGlobals_.insert(own).second) {
    out_.list(block, fmt::format("{} is global user data: other programs do not see what it is set to here", own),
              "use a QR parameter if they should");
  }
  for (auto& coordinate : position_)
    if (coordinate && !coordinate->isNumber()) coordinate.reset();
}

void ToKlartext::assignFrameComponent(const Block& block, const Assign& assign) {
  const VariableRef& variable = block.variables[assign.variable];
  const auto word = [&](std::size_t i) {
    const std::int32_t node = variable.index[i].node;
    return node < 0 ? std::string_view() : block.at(block.nodes[static_cast<std::size_t>(node)].text);
  };
  const bool active = word(0) == "$P_UIFRNUM" || block.at(block.source).find("[$P_UIFRNUM,") != std::string_view::npos;
  const Quantity number = active ? Quantity(-1) : quantity(block, variable.index[0]);
  const Quantity row = number == 99 ? Quantity(0) : number;
  const bool shifts = word(2) == "TR" && control_ != control::ControlKind::iTNC530;
  if (shifts && row == 0 && std::exchange(rowZeroIsDue_, false)) {
    const std::string from = formulas_.define("active preset");
    line(fmt::format("FN 18: SYSREAD {} = ID530 NR1", from));
    line(fmt::format("PRESET COPY #{} TO #0 SELECT TARGET KEEP TRANS", from));
  }
  const Quantity value = quantity(block, assign.value);
  forgetPosition();
  const bool inEffect = active || (activeRow_ && number == *activeRow_);
  if ((inEffect || !activeRow_ || !number.isNumber()) && !actsBeforeItMoves(block, Acts::ZeroOffset)) {
    out_.list(block, "what a zero offset is set to acts when it is selected the next time, a preset acts at once",
              "select the zero offset again after this block (G54)");
  }
  if (word(2) == "RT" && word(1) == axis(2)) {
    const bool ofTables = control_ != control::ControlKind::iTNC530;
    if (!ofTables && !inEffect) {
      throw NotCarriedOver("cycle 404 of the iTNC530 turns the active preset only",
                           "select the zero offset before this block");
    }
    if (!active) listLackingRow(block, number, Lacking::CopiesPresetInEffect);
    unturned_ = value == 0;
    if (row == 0) rowZeroIsDue_ = false;
    const std::string angle = formulas_.value(value), rowText = formulas_.value(row);
    cancelFrame();  // touch probe cycles permit none
    std::vector<std::string> lines = {fmt::format("TCH PROBE 404 {} ~", cycleTitle(404, control_)),
                                      fmt::format("    Q307={} ;PRESET ROTATION ANG.{}", angle, ofTables ? " ~" : "")};
    if (ofTables) lines.push_back(fmt::format("    Q305={} ;NUMBER IN TABLE", rowText));
    writeWhole(std::move(lines));
    restoreFrame();
    return;
  }
  const std::size_t place = word(1).size() == 1 ? std::string_view("XYZ").find(word(1)[0]) : std::string_view::npos;
  if (word(2) != "TR" || place == std::string_view::npos) {
    throw NotCarriedOver(fmt::format("$P_UIFR[..,{},{}] cannot be written in Klartext", word(1), word(2)));
  }
  if (control_ == control::ControlKind::iTNC530) {
    throw NotCarriedOver("the iTNC530 has no PRESET CORR", "let the measuring cycle before it correct the offset");
  }
  if (!active) listLackingRow(block, number, Lacking::Stops);
  // A preset moves by an amount, and only while it is in effect.
  const Quantity present = active ? quantity(block, variable.index[0]) : row;
  const Quantity shift = value - Quantity::of(formulas_.presetDatum(present, static_cast<int>(place) + 1));
  const std::string amount = formulas_.value(shift);
  const std::string before = formulas_.define("preset in effect");
  if (!inEffect) {
    line(fmt::format("FN 18: SYSREAD {} = ID530 NR1", before));
    line(fmt::format("PRESET SELECT #{} KEEP TRANS", formulas_.unsignedValue(row)));
  }
  line(fmt::format("PRESET CORR {}{}", word(1), amount));
  if (!inEffect) line(fmt::format("PRESET SELECT #{} KEEP TRANS", before));
}

bool ToKlartext::mayBeInSpindle(const Block& block, const Operand& tool) {
  if (measuredWithTool_) return false;  // what is corrected is another tool than the touch probe
  const Node* node = tool.node >= 0 ? &block.nodes[static_cast<std::size_t>(tool.node)] : nullptr;
  if (node == nullptr) return !isDigit(tool_.empty() ? '"' : tool_[0]) || tool_ == exactText(tool.number);
  const bool named = node->operation == Operation::Call && block.at(node->text) == "GETT";
  return !named || formulas_.formula(block, block.operands[node->a]) == tool_;
}

bool ToKlartext::actsBeforeItMoves(const Block& block, Acts what) {
  const std::optional<std::size_t> own = graph_.at(block.position);
  if (!own) return false;
  const auto readsPosition = [](const Block& each) {
    return std::ranges::any_of(each.variables, [&](const VariableRef& variable) {
      const std::string_view name = each.at(variable.name);
      return name == "$AA_IW" || name == "$P_EP";
    });
  };
  const auto isSilent = [](const Block& next, const Instruction& instruction) {
    const auto* command = std::get_if<Command>(&instruction);
    static constexpr std::string_view silent[] = {"MSG", "STOPRE", "DEF", "WORKPIECE"};
    return std::holds_alternative<Assign>(instruction) || std::holds_alternative<Modal>(instruction) ||
           std::holds_alternative<MachineFunction>(instruction) ||
           (command != nullptr && std::ranges::find(silent, next.at(command->name)) != std::end(silent));
  };
  const auto acts = [what](const Block& each, const Instruction& instruction) {
    const auto* modal = std::get_if<Modal>(&instruction);
    const auto* function = std::get_if<MachineFunction>(&instruction);
    constexpr int toolChange = 6;
    if (what == Acts::ZeroOffset) return modal != nullptr && settableOf(each.at(modal->name)).has_value();
    return std::holds_alternative<ToolCall>(instruction) || (modal != nullptr && each.at(modal->name) == "D") ||
           (function != nullptr && function->number == toolChange);
  };
  if (std::ranges::any_of(block.instructions, [&](const Instruction& each) { return acts(block, each); })) return true;
  Block next;
  Diagnostics ignored;
  for (std::size_t i = *own + 1; i < graph_.blocks().size(); ++i) {
    program_.parse(graph_.blocks()[i].position, next, ignored);
    if (what == Acts::ZeroOffset && trimmed(next.at(next.source), lineBlanks) == selectedAgain) return true;
    if (readsPosition(next)) return false;
    for (const Instruction& instruction : next.instructions) {
      if (acts(next, instruction)) return true;
      if (std::holds_alternative<EndProgram>(instruction)) return true;
      if (!isSilent(next, instruction)) return false;
    }
  }
  return !job_.called;
}

void ToKlartext::define(const Block& block, const Command& command) {
  const VariableRef& variable = block.variables[static_cast<std::size_t>(command.variable)];
  const auto words = std::span<const Word>(block.words).subspan(command.words.first, command.words.count);
  const std::string own(block.at(variable.name));
  const std::string_view type = block.at(command.text);
  if (type == "FRAME" || type == "AXIS") throw NotCarriedOver("variables for frames and axes have no twin in Klartext");
  if (type == "CHAR") {
    throw NotCarriedOver("variables of type CHAR are characters and numbers at once, which no parameter is",
                         "define it as INT or as STRING[1]");
  }
  const bool isText = type == "STRING";
  formulas_.declare(own, type);
  std::vector<std::string> elements = {own};
  for (std::size_t i = 0; i < 3 && variable.index[i].present(); ++i) {
    constexpr double most = 100;  // there are no more free parameters
    const double count = variable.index[i].number;
    if (!variable.index[i].isLiteral() || count * static_cast<double>(elements.size()) > most) {
      throw NotCarriedOver(fmt::format("array {} has more elements than there are free Q parameters", own));
    }
    std::vector<std::string> deeper;
    for (const std::string& each : elements)
      for (int k = 0; k < count; ++k)
        deeper.push_back(fmt::format("{}{}{}", each, i == 0 ? "[" : ",", k));
    elements = std::move(deeper);
  }
  std::vector<std::string> values;
  for (const Word& word : words) {
    if (word.address == addressOf("LEN")) continue;
    values.push_back(word.value.present() ? formulas_.assigned(block, variable, word.value) : std::string());
    if (word.address == addressOf("REP")) values.resize(elements.size(), values.back());
  }
  values.resize(elements.size());
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (variable.index[0].present()) elements[i] += ']';
    const bool known = !variable.index[0].present() && KlartextFormulas::namesParameter(own);
    const std::string target =
        known ? own.substr(1)
              : formulas_.define(elements[i], isText ? KlartextFormulas::Holds::Text : KlartextFormulas::Holds::Number);
    if (values[i].empty()) values[i] = target.starts_with("QS") ? "\"\"" : "0";
    line(fmt::format("{} = {}{}", target, values[i], known ? "" : fmt::format(" ; {}", elements[i])));
  }
}

}  // namespace probewright::conversion
