#include "session/setup_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>

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
  SetupChecker(Program& program, const Inventory& inventory, std::bitset<10> skipLevels)
      : program_(program), inventory_(inventory), skipLevels_(skipLevels) {}

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
  bool makesTools_ = false;
};

}  // namespace

Diagnostics checkAgainstSetup(Program& program, const Inventory& inventory, std::bitset<10> skipLevels) {
  return SetupChecker(program, inventory, skipLevels).run();
}

}  // namespace probewright::session
