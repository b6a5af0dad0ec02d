#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "control/alarm.hpp"
#include "execution/evaluation.hpp"
#include "execution/host.hpp"
#include "language/program.hpp"

/// Programs made of blocks by hand, and a host that writes down what it is told.
namespace probewright::execution {

/// Builds one block: expressions first, then the instructions that use them.
class Make {
public:
  Operand node(Node node) {
    block.nodes.push_back(node);
    return {0, static_cast<std::int32_t>(block.nodes.size()) - 1};
  }
  std::uint32_t q(double index) { return q(Operand::of(index)); }
  std::uint32_t q(Operand index) {
    VariableRef variable;
    variable.index[0] = index;
    block.variables.push_back(variable);
    return static_cast<std::uint32_t>(block.variables.size()) - 1;
  }
  Operand value(double index) { return node({.operation = Operation::Variable, .a = q(index)}); }
  Operand text(std::string_view text) { return node({.operation = Operation::Text, .text = block.add(text)}); }
  Operand binary(Operation operation, Operand left, Operand right) {
    return node({.operation = operation, .left = left, .right = right});
  }
  Operand binary(Operation operation, Operand left, double right) {
    return binary(operation, left, Operand::of(right));
  }
  Operand unary(Operation operation, Operand of) { return node({.operation = operation, .left = of}); }
  Operand call(Function function, std::vector<Operand> arguments, std::string_view name = {}) {
    const auto first = static_cast<std::uint32_t>(block.operands.size());
    block.operands.insert(block.operands.end(), arguments.begin(), arguments.end());
    return node({.operation = Operation::Call,
                 .function = function,
                 .a = first,
                 .b = static_cast<std::uint32_t>(arguments.size()),
                 .text = block.add(name)});
  }

  Make& add(Instruction instruction) {
    block.instructions.push_back(instruction);
    return *this;
  }
  Make& assign(double index, Operand value) { return add(Assign{q(index), value}); }
  Make& assign(double index, double value) { return assign(index, Operand::of(value)); }
  /// Qindex = Qindex + by
  Make& count(double index, double by = 1) { return assign(index, binary(Operation::Add, value(index), by)); }
  Make& say(std::string_view name) { return add(Command{.name = block.add(name)}); }
  Make& label(std::string_view name) {
    block.label = block.add(name);
    return add(LabelMark{block.label, name == "0"});
  }
  /// A label that only jumps know.
  Make& plainLabel(std::string_view name) {
    block.label = block.add(name);
    return *this;
  }
  Make& callLabel(std::string_view name) { return add(CallLabel{block.add(name), {}, {}}); }
  Make& callLabel(std::string_view name, double repeats) {
    return add(CallLabel{block.add(name), {}, Operand::of(repeats)});
  }
  Make& jump(std::string_view name, Operand condition = {}, JumpDirection direction = JumpDirection::Any) {
    return add(Jump{block.add(name), {}, condition, direction});
  }
  Make& callProgram(std::string_view name, double times = 1, bool maybeCycle = false) {
    return add(CallProgram{.name = block.add(name), .times = Operand::of(times), .maybeCycle = maybeCycle});
  }
  Make& repeat(std::string_view from, std::string_view to, double times, bool onlyBlock = false) {
    return add(RepeatSection{block.add(from), block.add(to), Operand::of(times), onlyBlock});
  }
  Make& structure(Structure kind, Operand condition = {}) { return add(Structured{kind, condition, 0, {}, {}}); }
  Make& loopFor(double variable, Operand from, Operand to) {
    return add(Structured{Structure::For, {}, q(variable), from, to});
  }

  Block block;
};

/// A program of made blocks; block i is at offset 10 i and line i + 1.
class MadeProgram : public Program {
public:
  MadeProgram(std::string name, std::vector<Make> blocks) : file_(name + ".prg"), name_(std::move(name)) {
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      Block& block = blocks[i].block;
      block.position = positionOf(i);
      block.next = positionOf(i + 1);
      block.source = block.add("block " + std::to_string(i + 1));
      blocks_.push_back(std::move(block));
    }
  }

  const std::string& file() const override { return file_; }
  const std::string& name() const override { return name_; }
  BlockPosition begin() const override { return positionOf(0); }

  bool parse(BlockPosition position, Block& block, Diagnostics& diagnostics) override {
    const std::size_t index = position.offset / 10;
    if (index >= blocks_.size()) return false;
    block = blocks_[index];
    ++parsed;
    if (index + 1 == brokenLine) {
      diagnostics.push_back({Severity::Error, {file_, brokenLine, 3}, "a number was expected", "L XY", {}, {}});
    }
    return true;
  }

  std::optional<BlockPosition> findLabel(std::string_view label, BlockPosition from, JumpDirection direction) override {
    ++searches;
    for (const Block& block : blocks_) {
      if (block.label.length == 0 || block.at(block.label) != label) continue;
      if (direction == JumpDirection::Forward && block.position.offset <= from.offset) continue;
      if (direction == JumpDirection::Backward && block.position.offset > from.offset) continue;
      return block.position;
    }
    return std::nullopt;
  }

  std::optional<BlockPosition> counterpart(BlockPosition position) override {
    ++searches;
    // Two passes that keep the open statements on a stack.
    std::map<std::uint64_t, BlockPosition> found;
    std::vector<std::pair<Structure, BlockPosition>> open;
    for (const Block& block : blocks_) {
      for (const Instruction& instruction : block.instructions) {
        const auto* statement = std::get_if<Structured>(&instruction);
        if (statement == nullptr) continue;
        switch (statement->kind) {
          case Structure::If:
          case Structure::While:
          case Structure::For:
          case Structure::Loop:
          case Structure::Repeat:
            open.emplace_back(statement->kind, block.position);
            break;
          case Structure::Else:
            if (open.empty()) return std::nullopt;
            found[open.back().second.offset] = block.position;
            open.back().second = block.position;
            break;
          default:
            if (open.empty()) return std::nullopt;
            found[open.back().second.offset] = block.position;
            found[block.position.offset] = open.back().second;
            open.pop_back();
        }
      }
    }
    const auto entry = found.find(position.offset);
    if (entry == found.end()) return std::nullopt;
    return entry->second;
  }

  int parsed = 0;    ///< calls of parse that found a block
  int searches = 0;  ///< calls of findLabel and counterpart
  std::size_t brokenLine = 0;

private:
  static BlockPosition positionOf(std::size_t index) { return {10 * index, index + 1}; }

  std::string file_, name_;
  std::vector<Block> blocks_;
};

class MadeLibrary : public ProgramLibrary {
public:
  std::shared_ptr<MadeProgram> add(std::string name, std::vector<Make> blocks) {
    programs_[name] = std::make_shared<MadeProgram>(name, std::move(blocks));
    return programs_[name];
  }
  Result<std::shared_ptr<Program>> open(std::string_view name, const Program*) override {
    const auto found = programs_.find(name);
    if (found == programs_.end()) {
      return fail("there is no program " + std::string(name), "look at the name");
    }
    return found->second;
  }
  bool exists(std::string_view name, const Program*) override { return programs_.find(name) != programs_.end(); }

private:
  std::map<std::string, std::shared_ptr<MadeProgram>, std::less<>> programs_;
};

/// Keeps Q parameters and a protocol of everything it is asked to do.
class RecordingHost : public Host {
public:
  Value read(const VariableRef& variable, Evaluation& evaluation) override {
    return variables[static_cast<int>(evaluation.number(variable.index[0]))];
  }
  void write(const VariableRef& variable, const Value& value, Evaluation& evaluation) override {
    variables[static_cast<int>(evaluation.number(variable.index[0]))] = value;
  }
  bool isDefined(const VariableRef& variable, Evaluation& evaluation) override {
    return variables.count(static_cast<int>(evaluation.number(variable.index[0]))) > 0;
  }
  Value call(std::string_view name, std::span<const Value> arguments) override {
    if (name == "COUNT") return static_cast<double>(arguments.size());
    return std::string(name);
  }
  void execute(const Instruction& instruction, Evaluation& evaluation) override {
    if (const auto* command = std::get_if<Command>(&instruction)) {
      const std::string_view name = evaluation.at(command->name);
      if (name == "alarm") throw control::Alarm("4711", "the axis is stuck", "free it");
      if (name == "cancel") throw control::Cancelled();
      protocol += std::string(name) + " ";
    }
    if (const auto* call = std::get_if<CallProgram>(&instruction)) {
      protocol += "cycle:" + std::string(evaluation.at(call->name)) + " ";
    }
  }
  bool beginBlock(const Program&, const Block& block) override {
    return std::find(leftOut.begin(), leftOut.end(), block.position.line) == leftOut.end();
  }
  void enter(const Program& program, const CallProgram* call, Evaluation* caller) override {
    protocol += "<" + program.name() + " ";
    for (std::uint32_t i = 0; call != nullptr && i < call->arguments.count; ++i) {
      variables[static_cast<int>(100 + i)] = caller->number(caller->words(call->arguments)[i].value);
    }
  }
  void leave(const Program& program) override { protocol += program.name() + "> "; }
  std::string code(Refusal refusal) const override { return refusal == Refusal::MissingLabel ? "14080" : ""; }

  double q(int index) { return std::get<double>(variables[index]); }

  std::map<int, Value> variables;
  std::string protocol;
  std::vector<std::uint64_t> leftOut;
};

}  // namespace probewright::execution
