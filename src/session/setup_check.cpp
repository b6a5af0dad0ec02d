#include "session/setup_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/number_text.hpp"
#include "base/text.hpp"
#include "language/block.hpp"
#include "language/klartext/commands.hpp"

namespace probewright::session {

namespace {

using namespace language;

constexpr std::uint32_t presetRow = 339;

std::string shown(const NamedItem& item) { return item.name.empty() ? formatShortest(item.number) : item.name; }

class SetupChecker {
public:
  SetupChecker(Program& program, const Inventory& inventory, std::bitset<10> skipLevels,
               const machine::MachineDescription* machine)
      : program_(program), inventory_(inventory), skipLevels_(skipLevels) {
    if (machine == nullptr) return;
    for (const machine::Axis& axis : machine->axes) {
      axes_.push_back(upperCase(axis.name));
      tilts_ = tilts_ || axis.kind == machine::AxisKind::Rotary;
    }
  }

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
    if (!inventory_.holdsTool || !inventory_.hasTool(*tool) || inventory_.holdsTool(*tool)) return;
    report(*tool, fmt::format("the control has tool {}, the virtual machine of the setup does not", shown(*tool)),
           "add it to the setup as [[tool]]; without it a run stops here", "tool");
    found_.back().severity = Severity::Warning;  // a real machine may have it
  }
  bool lacksAxis(std::string_view name) const {
    return !axes_.empty() && std::ranges::find(axes_, name) == axes_.end();
  }
  static bool isAxisLetter(std::uint32_t address) {
    return address < 256 && std::string_view("XYZABCUVW").find(static_cast<char>(address)) != std::string_view::npos;
  }
  /// Of a SINUMERIK: E=, X1=; A2 to C7 orient the tool.
  bool isNumberedAxis(std::uint32_t address) const {
    if (isHeidenhain()) return false;
    const std::string name = addressName(address);
    if (name == "E") return true;
    if (name.size() < 2 || std::string_view("XYZABCUVWE").find(name[0]) == std::string_view::npos) return false;
    const auto isNumber = [](std::string_view digits) {
      return digits.find_first_not_of("0123456789") == std::string_view::npos;
    };
    const bool orients = name.size() == 2 && name[0] <= 'C' && name[1] >= '2' && name[1] <= '7';
    return isNumber(std::string_view(name).substr(1)) && !orients;
  }
  static bool isNumberBut(const Word& word, double neutral) {
    return word.value.isLiteral() && word.value.number != neutral;
  }

  /// An axis that the machine lacks, moved or changed by this word.
  void needAxis(const Word& word) { needAxis(addressName(word.address), word.column); }
  void needAxis(const std::string& name, std::uint32_t column) {
    report({}, fmt::format("the machine of the setup has no axis {}", name),
           fmt::format("take {} away, or choose a machine that has it", name), "axis");
    found_.back().place.column = column > 0 ? column : found_.back().place.column;
  }
  void needRotaryAxes(std::string_view what) {
    report({}, fmt::format("{} needs rotary axes, and the machine of the setup has none", what),
           "take the block out, or choose a machine with rotary axes", "tilt");
  }

  /// Shifts, mirror images and scalings of axes; planes that no machine without rotary axes reaches.
  void changesOfAxes(const Transform& transform) {
    using Kind = klartext::TransformKind;
    const std::string_view name = block_.at(transform.name);
    const auto is = [&](std::initializer_list<Kind> kinds) {
      return std::ranges::any_of(kinds, [&](Kind kind) { return name == klartext::nameOf(kind); });
    };
    const bool mirrors = is({Kind::Mirror, Kind::TransMirror}) || name == "MIRROR" || name == "AMIRROR";
    const bool shifts = is({Kind::DatumShift, Kind::TransDatumAxis}) || name == "TRANS" || name == "ATRANS";
    const bool scales = name == "SCALE" || name == "ASCALE";
    const bool turns = is({Kind::PlaneAxial});
    for (const Word& word : wordsOf(transform.words)) {
      if (!isAxisLetter(word.address) || !lacksAxis(addressName(word.address))) continue;
      if (mirrors || turns || (shifts && isNumberBut(word, 0)) || (scales && isNumberBut(word, 1))) needAxis(word);
    }
    if (axes_.empty() || tilts_ || turns) return;
    const bool byAngles = is({Kind::Tilting, Kind::PlaneSpatial, Kind::PlaneProjected, Kind::PlaneEuler,
                              Kind::PlaneRelative, Kind::PlaneVector});
    const bool tilted = byAngles && std::ranges::any_of(wordsOf(transform.words), [&](const Word& word) {
                          static constexpr std::array<std::string_view, 9> leaning = {
                              "A", "B", "SPA", "SPB", "PROP", "PROM", "EULN", "NX", "NY"};
                          return std::ranges::find(leaning, addressName(word.address)) != leaning.end() &&
                                 isNumberBut(word, 0) && std::remainder(word.value.number, 360.0) != 0;
                        });
    if (tilted) needRotaryAxes("a tilted plane");
  }

  void look(const MachineFunction& function) {
    if (function.number == 128 && lacksRotaryAxes()) needRotaryAxes("M128");
    if (function.number != 94 || !isHeidenhain()) return;
    for (const Word& word : wordsOf(function.words))  // M94 A
      if (isAxisLetter(word.address) && lacksAxis(addressName(word.address))) needAxis(word);
  }
  bool isHeidenhain() const { return inventory_.monitoredTool != 0; }
  bool lacksRotaryAxes() const { return isHeidenhain() && !axes_.empty() && !tilts_; }

  /// Tables and patterns of points that are selected by name.
  void needFile(std::string_view what, std::string_view text) {
    const NamedItem file{std::string(text), 0};
    if (text.empty() || !inventory_.hasFile || inventory_.hasFile(file.name)) return;
    if (inventory_.hasFile(std::string(text.substr(text.find_last_of("\\/:") + 1)))) return;  // folders of the control
    report(file, fmt::format("the {} {} does not exist", what, text.substr(0, 100)),
           "put it beside the program or into the tables of the setup, or correct its name", "file");
  }

  void look(const Transform& transform) {
    changesOfAxes(transform);
    if (block_.at(transform.name) == klartext::nameOf(klartext::TransformKind::TransDatumTable))
      needFile("datum table", block_.at(transform.option));
    if (block_.at(transform.name) != klartext::nameOf(klartext::TransformKind::PresetByCycle)) return;
    for (const Word& word : wordsOf(transform.words)) {
      if (word.address != presetRow) continue;
      if (const auto row = named(word.value)) needPreset(*row);
    }
  }
  /// POS[U]=, POSA[U]=, POSP[U]=: the axis in brackets.
  void positions(const Command& command) {
    const auto words = wordsOf(command.words);
    const std::string_view name = block_.at(command.name);
    if (words.size() < 2 || (name != "POS" && name != "POSA" && name != "POSP")) return;
    if (words[1].value.node < 0) return;
    const Node& index = block_.nodes[static_cast<std::size_t>(words[1].value.node)];
    if (index.operation != Operation::AxisName) return;
    const std::string axis = upperCase(block_.at(index.text));
    if (lacksAxis(axis)) needAxis(axis, words[0].column);
  }
  void look(const Command& command) {
    if (!isHeidenhain()) positions(command);
    if (block_.at(command.name) == klartext::nameOf(klartext::CommandKind::SelectTable))
      needFile("datum table", block_.at(command.text));
    if (block_.at(command.name) == klartext::nameOf(klartext::CommandKind::SelectPattern))
      needFile("point table", block_.at(command.text));
    if (block_.at(command.name) == klartext::nameOf(klartext::CommandKind::PresetCorrection)) {
      for (const Word& word : wordsOf(command.words))
        if (isAxisLetter(word.address) && lacksAxis(addressName(word.address))) needAxis(word);
    }
    if (block_.at(command.name) == klartext::nameOf(klartext::CommandKind::ToolDefinition)) {
      const auto tool = named(wordsOf(command.words).front().value);
      if (tool && !tool->name.empty()) needTool(*tool);
    }
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
  /// CYCLE800: the name of its data set, and its angles on a machine without rotary axes.
  void swivels(const CallProgram& call) {
    for (const Word& word : wordsOf(call.arguments)) {
      const auto name = word.address == 1 ? named(word.value) : std::nullopt;
      if (name && name->name == "0") return;  // ends the swivelling
      const auto isName = [&](const std::string& other) { return upperCase(other) == upperCase(name->name); };
      if (name && !name->name.empty() && !inventory_.swivelData.empty() &&
          std::ranges::none_of(inventory_.swivelData, isName)) {
        report(*name, fmt::format("the setup has no swivel data set \"{}\"", name->name),
               fmt::format("the setup has {}", fmt::join(inventory_.swivelData, ", ")), "swivel");
        found_.back().severity = Severity::Warning;  // the run takes another one, and says so
      }
    }
    const bool turned = std::ranges::any_of(wordsOf(call.arguments), [](const Word& word) {
      return word.address >= 7 && word.address <= 9 && isNumberBut(word, 0);
    });
    if (turned && !axes_.empty() && !tilts_) needRotaryAxes("CYCLE800");
  }

  /// A measuring cycle of a SINUMERIK that corrects a tool; it may be named by its number: "3".
  void look(const CallProgram& call) {
    if (block_.at(call.name) == "CYCLE800") swivels(call);
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
    if (block_.at(modal.name) == "FUNCTION TCPM" && lacksRotaryAxes()) needRotaryAxes("FUNCTION TCPM");
  }
  void look(const Move& move) {
    if (move.kind == MoveKind::SetCentre) return;
    for (const Word& word : wordsOf(move.words))
      if ((isAxisLetter(word.address) || isNumberedAxis(word.address)) && lacksAxis(addressName(word.address)))
        needAxis(word);
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
  bool tilts_ = false;             ///< the machine has rotary axes
  bool makesTools_ = false;
  bool spaceAngles_ = false;
};

}  // namespace

bool holdsTool(const std::vector<control::BelievedTool>& tools, int number, std::string_view name) {
  return std::ranges::any_of(tools, [&](const control::BelievedTool& tool) {
    const bool named = !name.empty() && tool.name == name;
    return named || (tool.number == number && (name.empty() || tool.name.empty()));
  });
}

Diagnostics checkAgainstSetup(Program& program, const Inventory& inventory, std::bitset<10> skipLevels,
                              const machine::MachineDescription* machine) {
  return SetupChecker(program, inventory, skipLevels, machine).run();
}

}  // namespace probewright::session
