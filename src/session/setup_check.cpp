#include "session/setup_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>

#include "base/number_text.hpp"
#include "control/heidenhain/tool_table.hpp"
#include "control/sinumerik/tool_data.hpp"
#include "language/block.hpp"
#include "session/beliefs.hpp"

namespace probewright::session {

namespace {

using namespace language;
using control::ControlKind;

/// Q330 of the inspection cycles: the tool to monitor and correct.
constexpr std::uint32_t monitoredTool = 330;
constexpr std::uint32_t presetRow = 339;

/// A tool or row as the text names it.
struct Named {
  std::string name;  ///< empty: by its number
  double number = 0;
  std::string shown() const { return name.empty() ? formatShortest(number) : name; }
};

/// What the control has.
struct Known {
  std::function<bool(const Named&)> tool, preset;
  std::string tools, presets;  ///< for the way out: "the setup has 1 PROBE, 2"
};

class SetupChecker {
public:
  SetupChecker(Program& program, ControlKind kind, const Known& known, std::bitset<10> skipLevels)
      : program_(program), kind_(kind), known_(known), skipLevels_(skipLevels) {}

  Diagnostics run() {
    Diagnostics unread;  // mistakes of blocks are told by others
    BlockPosition position = program_.begin();
    while (program_.parse(position, block_, unread)) {
      if (!(block_.skippable && skipLevels_[isHeidenhain(kind_) ? 0 : block_.skipLevel])) {
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
  std::optional<Named> named(const Operand& operand) const {
    if (!operand.present()) return std::nullopt;
    if (operand.isLiteral()) return Named{{}, operand.number};
    const Node& node = block_.nodes[static_cast<std::size_t>(operand.node)];
    if (node.operation != Operation::Text) return std::nullopt;
    return Named{std::string(block_.at(node.text)), 0};
  }

  /// At the name in the text of the block, or at its beginning.
  void report(const Named& named, std::string message, std::string advice, std::string code) {
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

  void needTool(const Named& tool) {
    if (known_.tool(tool)) return;
    report(tool, fmt::format("the setup has no tool {}", tool.shown()),
           "add the tool or correct its name; " + known_.tools, "tool");
  }
  void needPreset(const Named& row) {
    if (known_.preset(row)) return;
    report(row, fmt::format("the setup has no preset {}", row.shown()), "add the row or correct it; " + known_.presets,
           "preset");
  }

  void look(const ToolCall& call) {
    auto tool = named(call.name.present() ? call.name : call.number);
    if (!tool) return;
    if (const auto step = named(call.index); isHeidenhain(kind_) && step && tool->name.empty())
      tool->number += step->number / (step->number < 10 ? 10 : 100);
    needTool(*tool);
  }
  void look(const Transform& transform) {
    if (block_.at(transform.name) != "CYCL DEF 247") return;
    for (const Word& word : wordsOf(transform.words)) {
      if (word.address != presetRow) continue;
      if (const auto row = named(word.value)) needPreset(*row);
    }
  }
  void look(const Command& command) {
    if (block_.at(command.name) != "PRESET SELECT") return;
    for (const Word& word : wordsOf(command.words)) {
      if (word.address != '#') continue;
      if (const auto row = named(word.value)) needPreset(*row);
    }
  }
  void look(const CycleCall& call) {
    if (!isHeidenhain(kind_) || block_.at(call.name) != "TCH PROBE") return;
    for (const Word& word : wordsOf(call.parameters)) {
      if (word.address != monitoredTool) continue;
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
  ControlKind kind_;
  const Known& known_;
  std::bitset<10> skipLevels_;
  Block block_;
  Diagnostics found_;
  bool makesTools_ = false;
};

/// "the setup has 1 PROBE, 2": the first of them.
class Listing {
public:
  void add(const std::string& number, const std::string& name) {
    constexpr std::size_t most = 8;
    if (++count_ > most + 1) return;
    list_ += count_ > most ? " ..." : (list_.empty() ? "" : ", ") + number + (name.empty() ? "" : " " + name);
  }
  std::string text() const { return list_.empty() ? "the setup has none" : "the setup has " + list_; }

private:
  std::string list_;
  std::size_t count_ = 0;
};

Diagnostics checkHeidenhain(Program& program, ControlKind kind, const simulation::Setup& setup,
                            std::bitset<10> skipLevels) {
  Diagnostics found;
  const control::heidenhain::Tables tables = heidenhainTables(setup, kind, found);
  Listing tools, presets;
  for (const std::string& row : tables.tools.table().keys()) {
    if (row != "0") tools.add(row, tables.tools.text(row, "NAME"));
  }
  const auto documented = [&](const std::string& row) {
    return tables.presets.hasColumn("DOC") ? tables.presets.text(row, "DOC") : std::string();
  };
  for (const std::string& row : tables.presets.table().keys())
    presets.add(row, documented(row));
  Known known;
  known.tools = tools.text();
  known.presets = presets.text();
  known.tool = [&](const Named& tool) {
    if (!tool.name.empty()) return control::heidenhain::findToolNamed(tables.tools, tool.name).has_value();
    return tool.number == 0 || tables.tools.hasRow(formatShortest(tool.number));
  };
  known.preset = [&](const Named& row) {
    if (row.name.empty()) return tables.presets.hasRow(formatShortest(row.number));
    for (const std::string& key : tables.presets.table().keys()) {
      if (documented(key) == row.name) return true;
    }
    return false;
  };
  const Diagnostics more = SetupChecker(program, kind, known, skipLevels).run();
  found.insert(found.end(), more.begin(), more.end());
  return found;
}

Diagnostics checkSinumerik(Program& program, ControlKind kind, const simulation::Setup& setup,
                           std::bitset<10> skipLevels) {
  Diagnostics found;
  const SinumerikData data = sinumerikData(setup, found);
  Known known;
  Listing tools;
  for (const simulation::BelievedTool& tool : setup.tools)
    tools.add(std::to_string(tool.number), tool.name);
  known.tools = tools.text();
  known.tool = [&](const Named& tool) {
    using namespace control::sinumerik;
    if (!tool.name.empty()) return tool.name == "0" || toolNamed(data.store, tool.name).has_value();
    return tool.number == 0 || toolEdge(data.store, static_cast<int>(std::lround(tool.number)), 1).has_value();
  };
  known.preset = [](const Named&) { return true; };
  const Diagnostics more = SetupChecker(program, kind, known, skipLevels).run();
  found.insert(found.end(), more.begin(), more.end());
  return found;
}

}  // namespace

Diagnostics checkAgainstSetup(Program& program, ControlKind kind, const simulation::Setup& setup,
                              std::bitset<10> skipLevels) {
  return isHeidenhain(kind) ? checkHeidenhain(program, kind, setup, skipLevels)
                            : checkSinumerik(program, kind, setup, skipLevels);
}

}  // namespace probewright::session
