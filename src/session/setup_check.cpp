#include "session/setup_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/number_text.hpp"
#include "language/block.hpp"
#include "language/klartext/commands.hpp"

namespace probewright::session {

namespace {

using namespace language;

constexpr std::uint32_t presetRow = 339;

std::string shown(const NamedItem& item) { return item.name.empty() ? formatShortest(item.number) : item.name; }

class SetupChecker {
public:
  SetupChecker(Program& program, const Inventory& inventory, std::bitset<10> skipLevels, std::vector<std::string> axes)
      : program_(program), inventory_(inventory), skipLevels_(skipLevels), axes_(std::move(axes)) {}

  Diagnostics run() {
    Diagnostics unread;  // mistakes of blocks are told by others
    BlockPosition position = program_.begin();
    while (program_.parse(position, block_, unread)) {
      if (!(block_.skippable && skipLevels_[block_.skipLevel])) {
        for (const Instruction& instruction : block_.instructions)
          std::visit([this](const auto& i) { look(i); }, instruction);
      }
      position = block_.next;
    }
    // A program that makes tools has those that it makes.
    if (makesTools_) std::erase_if(found_, [](const Diagnostic& each) { return each.code == "tool"; });
    if (spaceAngles_) std::erase_if(found_, [](const Diagnostic& each) { return each.code == "axis"; });
    for (Diagnostic& each : found_)
      each.code.clear();
    return std::move(found_);
  }

private:
  std::optional<NamedItem> named(const Operand& operand) const {
    if (!operand.present()) return std::nullopt;
    if (operand.isLiteral()) return NamedItem{{}, operand.number};
    const Node& node = block_.nodes[static_cast<std::size_t>(operand.node)];
    if (node.operation != Operation::Text) return std::nullopt;
    return NamedItem{std::string(block_.at(node.text)), 0};
  }

  /// At the name in the text of the block, or at its beginning.
  void report(const NamedItem& named, std::string message, std::string advice, std::string code) {
    const std::string_view source = block_.at(block_.source);
    const std::size_t at = named.name.empty() ? std::string_view::npos : source.find(named.name);
    const std::string_view before = source.substr(0, at == std::string_view::npos ? 0 : at);
    const auto below = static_cast<std::uint64_t>(std::count(before.begin(), before.end(), '\n'));
    const std::size_t lineBegin = below == 0 ? 0 : before.rfind('\n') + 1;
    std::string_view line = source.substr(lineBegin);
    line = line.substr(0, line.find_first_of("\r\n"));
    found_.push_back(
        {Severity::Error,
         {program_.file(), block_.position.line + below, static_cast<std::uint32_t>(before.size() - lineBegin) + 1},
         std::move(message),
         std::string(line),
         std::move(advice),
         std::move(code)});
  }

  void needTool(const NamedItem& tool) {
    if (inventory_.hasTool(tool)) return;
    report(tool, fmt::format("the setup has no tool {}", shown(tool)),
           "add the tool or correct its name; " + inventory_.tools, "tool");
  }
  void needPreset(const NamedItem& row) {
    if (inventory_.hasPreset(row)) return;
    report(row, fmt::format("the setup has no preset {}", shown(row)),
           "add the row or correct it; " + inventory_.presets, "preset");
  }

  void look(const ToolCall& call) {
    auto tool = named(call.name.present() ? call.name : call.number);
    if (!tool) return;
    if (const auto step = named(call.index); inventory_.toolSteps && step && tool->name.empty())
      tool->number += step->number / (step->number < 10 ? 10 : 100);
    needTool(*tool);
  }
  void look(const Transform& transform) {
    if (block_.at(transform.name) != klartext::nameOf(klartext::TransformKind::PresetByCycle)) return;
    for (const Word& word : wordsOf(transform.words)) {
      if (word.address != presetRow) continue;
      if (const auto row = named(word.value)) needPreset(*row);
    }
  }
  void look(const Command& command) {
    if (block_.at(command.name) != klartext::nameOf(klartext::CommandKind::PresetSelect)) return;
    for (const Word& word : wordsOf(command.words)) {
      if (word.address != '#') continue;
      if (const auto row = named(word.value)) needPreset(*row);
    }
  }
  void look(const CycleCall& call) {
    if (inventory_.monitoredTool == 0 || block_.at(call.name) != inventory_.cycleWord) return;
    for (const Word& word : wordsOf(call.parameters)) {
      if (word.address != inventory_.monitoredTool) continue;
      const auto tool = named(word.value);
      if (tool && (!tool->name.empty() || tool->number != 0)) needTool(*tool);
    }
  }
  /// A measuring cycle of a SINUMERIK that corrects a tool; it may be named by its number: "3".
  void look(const CallProgram& call) {
    if (!inventory_.correctedTool || call.nameValue.present()) return;
    const auto words = wordsOf(call.arguments);
    const auto argument = [&](std::uint32_t place) {
      const auto found = std::ranges::find(words, place, &Word::address);
      return found == words.end() ? Operand{} : found->value;
    };
    const auto number = [&](std::uint32_t place) -> std::optional<double> {
      const Operand value = argument(place);
      return value.present() && value.isLiteral() ? std::optional(value.number) : std::nullopt;
    };
    const auto place = inventory_.correctedTool(block_.at(call.name), number);
    if (!place) return;
    const auto tool = named(argument(*place));
    if (!tool || tool->name.empty() || inventory_.hasTool(*tool)) return;
    if (const auto row = parseInteger(tool->name); row && inventory_.hasTool({{}, static_cast<double>(*row)})) return;
    needTool(*tool);
  }
  /// Axes that the machine lacks. Under AXIS SPAT the letters A, B and C are angles of the plane.
  void look(const Modal& modal) {
    spaceAngles_ = spaceAngles_ || (block_.at(modal.name) == "FUNCTION TCPM" &&
                                    std::ranges::any_of(wordsOf(modal.words), [](const Word& word) {
                                      return word.address == addressOf("AXIS") && word.value.number == 0;
                                    }));
  }
  void look(const Move& move) {
    if (axes_.empty() || move.kind == MoveKind::SetCentre) return;
    for (const Word& word : wordsOf(move.words)) {
      const bool letter = word.address < 256 &&
                          std::string_view("XYZABCUVW").find(static_cast<char>(word.address)) != std::string_view::npos;
      const std::string name = addressName(word.address);
      if (!letter || std::ranges::find(axes_, name) != axes_.end()) continue;
      report({}, fmt::format("the machine of the setup has no axis {}", name),
             fmt::format("take {} away, or choose a machine that has it", name), "axis");
      found_.back().place.column = word.column > 0 ? word.column : found_.back().place.column;
    }
  }
  void look(const Assign& assign) {
    const VariableRef& target = block_.variables[static_cast<std::size_t>(assign.variable)];
    makesTools_ = makesTools_ || (target.space == VariableSpace::System && block_.at(target.name).starts_with("$TC_"));
  }
  template <class Other>
  void look(const Other&) {}

  std::span<const Word> wordsOf(WordRange range) const {
    return std::span<const Word>(block_.words).subspan(range.first, range.count);
  }

  Program& program_;
  const Inventory& inventory_;
  std::bitset<10> skipLevels_;
  Block block_;
  Diagnostics found_;
  std::vector<std::string> axes_;  ///< of the machine, in capitals; empty: not known
  bool makesTools_ = false;
  bool spaceAngles_ = false;
};

}  // namespace

Diagnostics checkAgainstSetup(Program& program, const Inventory& inventory, std::bitset<10> skipLevels,
                              std::vector<std::string> axes) {
  return SetupChecker(program, inventory, skipLevels, std::move(axes)).run();
}

}  // namespace probewright::session
