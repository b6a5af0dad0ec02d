#include "survival/program_scan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <set>
#include <string_view>
#include <variant>
#include <vector>

#include "base/text.hpp"
#include "session/source.hpp"

namespace probewright::survival {

using language::Block;
using language::Node;
using language::Operand;
using language::Operation;
using language::VariableRef;
using language::VariableSpace;

namespace {

/// A variable as text: "Q5", "R1", "WIDTH". Elements of arrays count as one.
std::string nameOf(const Block& block, const VariableRef& variable) {
  static constexpr std::array<const char*, 7> spaces = {"Q", "QL", "QR", "QS", "R", "", ""};
  const auto space = static_cast<std::size_t>(variable.space);
  if (variable.space == VariableSpace::User || variable.space == VariableSpace::System)
    return std::string(block.at(variable.name));
  if (!variable.index[0].isLiteral()) return fmt::format("{}[]", spaces[space]);
  return fmt::format("{}{}", spaces[space], variable.index[0].number);
}

/// The names of all variables that an operand reads.
class Reads {
public:
  explicit Reads(const Block& block) : block_(block) {}

  std::set<std::string> names;

  void add(const Operand& operand) {
    if (operand.present() && !operand.isLiteral()) add(block_.nodes[static_cast<std::size_t>(operand.node)]);
  }
  void indices(const VariableRef& variable) {
    for (const Operand& index : variable.index)
      add(index);
  }
  void words(const language::WordRange& range) {
    for (std::uint32_t i = 0; i < range.count; ++i)
      add(block_.words[range.first + i].value);
  }

private:
  void add(const Node& node) {
    add(node.left);
    add(node.right);
    if (node.operation == Operation::Variable || node.operation == Operation::Undefined) {
      names.insert(nameOf(block_, block_.variables[node.a]));
      indices(block_.variables[node.a]);
    }
    if (node.operation != Operation::Call) return;
    // Functions of the control itself may tell anything: positions, tables, results.
    if (node.function == language::Function::Host) names.insert(std::string(block_.at(node.text)) + "()");
    for (std::uint32_t i = 0; i < node.b; ++i)
      add(block_.operands[node.a + i]);
  }

  const Block& block_;
};

/// Commands that only tell somebody something.
bool onlyTells(std::string_view name) {
  static constexpr std::array<std::string_view, 8> names = {"FN14", "FN15", "FN16", "FN20", "FN38", "MSG", "WRITE", ""};
  std::string plain;
  for (const char c : name)
    if (c != ' ') plain += c;
  return std::ranges::find(names, plain) != names.end();
}

class Scan {
public:
  explicit Scan(control::ControlKind control)
      : library_(session::programLibrary(session::knownFamilies().of(control))) {}

  std::optional<Obstacle> run(language::Program& program) {
    program_ = &program;
    // Numbers that the program gives a variable depend on others, which may stand below: until nothing changes.
    for (bool last = false;;) {
      const std::size_t before = unsure_.size();
      found_.reset();
      look(program);
      if (last) return found_;
      last = unsure_.size() == before;
    }
  }

private:
  void look(language::Program& program) {
    Block block;
    Diagnostics ignored;
    for (language::BlockPosition at = program.begin(); program.parse(at, block, ignored); at = block.next) {
      place_ = {program.file(), at.line, 0};
      for (const language::Instruction& instruction : block.instructions)
        std::visit([&](const auto& each) { look(block, each); }, instruction);
    }
  }

  /// A value of the program's own making.
  bool sure(const std::string& name) const { return set_.contains(name) && !unsure_.contains(name); }

  void use(const Reads& reads) {
    for (const std::string& name : reads.names) {
      if (sure(name) || found_) continue;
      found_ = Obstacle{fmt::format("the program computes with {}, which may be a measured value", name), place_};
    }
  }

  void set(const Block& block, std::uint32_t index, const Reads& reads) {
    const std::string name = nameOf(block, block.variables[index]);
    set_.insert(name);
    const bool computedPlace = name.ends_with("[]");
    if (isOfControl(name) || computedPlace || std::ranges::any_of(reads.names, [&](const std::string& read) {
          return unsure_.contains(read) || !set_.contains(read);
        }))
      unsure_.insert(name);
  }

  /// Q parameters that cycles write, and variables of the system.
  static bool isOfControl(const std::string& name) {
    if (name.starts_with('$') || name.starts_with('_')) return true;
    if (!name.starts_with('Q') || name.size() < 2 || name[1] < '0' || name[1] > '9') return false;
    const int number = std::atoi(name.c_str() + 1);
    return (number >= 100 && number < 200) || (number >= 600 && number < 700) || (number >= 900 && number < 1000);
  }

  void look(const Block& block, const language::Assign& assign) {
    Reads reads(block);
    reads.add(assign.value);
    reads.indices(block.variables[assign.variable]);
    set(block, assign.variable, reads);
  }
  void look(const Block& block, const language::Jump& jump) {
    Reads reads(block);
    reads.add(jump.condition);
    reads.add(jump.labelValue);
    use(reads);
  }
  void look(const Block& block, const language::CallLabel& call) {
    Reads reads(block);
    reads.add(call.labelValue);
    reads.add(call.repeats);
    use(reads);
  }
  void look(const Block& block, const language::RepeatSection& repeat) {
    Reads reads(block);
    reads.add(repeat.times);
    use(reads);
  }
  void look(const Block& block, const language::CallProgram& call) {
    const std::string name = upperCase(block.at(call.name));
    const bool cycle = call.maybeCycle && name.starts_with("CYCLE") && !library_->exists(name, program_);
    if (!cycle && !found_) found_ = Obstacle{"the program calls another one, which is not looked into", place_};
    if (call.modal && !found_) found_ = Obstacle{"a call works modally", place_};
    Reads reads(block);
    reads.words(call.arguments);
    reads.add(call.nameValue);
    reads.add(call.times);
    use(reads);
  }
  void look(const Block& block, const language::Structured& structured) {
    Reads reads(block);
    for (const Operand& operand : {structured.condition, structured.from, structured.to})
      reads.add(operand);
    if (structured.kind == language::Structure::For) set(block, structured.variable, reads);
    use(reads);
  }
  void look(const Block& block, const language::Move& move) {
    Reads reads(block);
    reads.words(move.words);
    reads.add(move.feed);
    use(reads);
  }
  void look(const Block& block, const language::ToolCall& call) {
    Reads reads(block);
    for (const Operand& operand : {call.number, call.name, call.index, call.spindleSpeed, call.cuttingSpeed, call.feed,
                                   call.deltaLength, call.deltaRadius, call.deltaRadius2})
      reads.add(operand);
    use(reads);
  }
  void look(const Block& block, const language::Modal& modal) { useWords(block, modal.words); }
  void look(const Block& block, const language::MachineFunction& function) {
    Reads reads(block);
    reads.words(function.words);
    reads.add(function.argument);
    use(reads);
  }
  void look(const Block& block, const language::Transform& transform) { useWords(block, transform.words); }
  void look(const Block& block, const language::CycleCall& call) {
    useWords(block, call.parameters);
    // TCH PROBE 0, 1 and 3 name the parameter that they write their result to.
    if (call.number > 9) return;
    for (std::uint32_t i = 0; i < call.parameters.count; ++i) {
      const Operand& value = block.words[call.parameters.first + i].value;
      if (value.present() && value.isLiteral()) unsure_.insert(fmt::format("Q{}", value.number));
    }
  }
  void look(const Block& block, const language::Command& command) {
    Reads reads(block);
    reads.words(command.words);
    const std::string_view name = block.at(command.name);
    if (name == "DEF" && command.variable >= 0) return set(block, static_cast<std::uint32_t>(command.variable), reads);
    if (command.variable >= 0) {
      const std::string target = nameOf(block, block.variables[static_cast<std::size_t>(command.variable)]);
      set_.insert(target);
      unsure_.insert(target);
    }
    if (!onlyTells(name)) use(reads);
  }
  template <class Other>
  void look(const Block&, const Other&) {}

  void useWords(const Block& block, const language::WordRange& words) {
    Reads reads(block);
    reads.words(words);
    use(reads);
  }

  std::unique_ptr<language::ProgramLibrary> library_;
  const language::Program* program_ = nullptr;
  std::set<std::string> set_, unsure_;
  SourcePlace place_;
  std::optional<Obstacle> found_;
};

}  // namespace

std::optional<Obstacle> computesWithResults(const std::string& name, const std::string& text,
                                            control::ControlKind control) {
  const auto program = session::programOf(name, text, session::languageFor(control, name, text));
  if (!program) return Obstacle{"the program cannot be read", {name}};
  return Scan(control).run(*program);
}

std::optional<Obstacle> cycleNotCovered(const control::Journal& journal) {
  // Each moves by its parameters and by the coordinate system, and leaves coordinates, angles or sizes of lines,
  // circles and planes through what it touches. Not among them: what repeats until something fits (405, 450 to 453,
  // 997), what turns axes, what calibrates, and what decides by what it has measured.
  static const std::set<std::string_view> covered = {
      "0",   "1",   "400", "401", "402", "404", "408",      "409",      "410",      "411",      "412",
      "413", "414", "415", "416", "417", "418", "419",      "420",      "421",      "422",      "423",
      "424", "425", "426", "427", "430", "431", "CYCLE961", "CYCLE977", "CYCLE978", "CYCLE979", "CYCLE998"};
  for (const control::CycleRecord& cycle : journal.cycles) {
    if (cycle.touches.empty() || covered.contains(cycle.name)) continue;
    return Obstacle{fmt::format("what cycle {} does with what it touches is not covered", cycle.name), cycle.place};
  }
  return std::nullopt;
}

}  // namespace probewright::survival
