// Any bytes as a program of either language: parsed, run with a step limit, and shown as text. Whatever is wrong with
// them comes back as a message; nothing else may happen. The first byte chooses the language.

#include <cstdint>
#include <cstdlib>
#include <map>
#include <string>

#include "execution/evaluation.hpp"
#include "execution/interpreter.hpp"
#include "language/encoding.hpp"
#include "language/klartext/program.hpp"
#include "language/sinumerik/program.hpp"

namespace {

using namespace probewright;
using namespace probewright::execution;
using namespace probewright::language;

/// Every call finds the program itself, so that calls and arguments are reached.
class OnlyMain : public ProgramLibrary {
public:
  explicit OnlyMain(std::shared_ptr<Program> main) : main_(std::move(main)) {}
  Result<std::shared_ptr<Program>> open(std::string_view, const Program*) override { return main_; }
  bool exists(std::string_view name, const Program*) override { return name.size() % 2 == 0; }

private:
  std::shared_ptr<Program> main_;
};

/// Computes every operand it is shown and remembers a few variables.
class ReadingHost : public Host {
public:
  Value read(const VariableRef& variable, Evaluation& evaluation) override {
    return variables_[slot(variable, evaluation)];
  }
  void write(const VariableRef& variable, const Value& value, Evaluation& evaluation) override {
    variables_[slot(variable, evaluation)] = value;
  }
  bool isDefined(const VariableRef& variable, Evaluation& evaluation) override {
    return variables_.count(slot(variable, evaluation)) > 0;
  }
  Value call(std::string_view name, std::span<const Value> arguments) override {
    if (name.size() % 2 == 0 || arguments.empty()) return std::string(name);
    return arguments.front();
  }
  void execute(const Instruction&, Evaluation& evaluation) override {
    for (const Word& word : evaluation.block().words) {
      if (word.value.present()) evaluation.value(word.value);
    }
  }
  bool beginBlock(const Program&, const Block&) override { return true; }
  void enter(const Program&, const CallProgram*, Evaluation*) override {}
  void leave(const Program&) override {}

private:
  int slot(const VariableRef& variable, Evaluation& evaluation) {
    if (!variable.index[0].present()) return static_cast<int>(evaluation.at(variable.name).size());
    const Value index = evaluation.value(variable.index[0]);
    const auto* number = std::get_if<double>(&index);
    return number != nullptr && *number > 0 && *number < 1000 ? static_cast<int>(*number) : 0;
  }

  std::map<int, Value> variables_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  toUtf8(text, detectEncoding(text));
  std::shared_ptr<Program> program;
  if (data[0] % 2 == 0) {
    program = std::make_shared<language::klartext::KlartextProgram>("fuzz.h", std::move(text));
  } else {
    program = language::sinumerik::SinumerikProgram::fromText("fuzz.mpf", std::move(text));
  }

  // All blocks, also behind a mistake.
  Block block;
  Diagnostics mistakes;
  BlockPosition at = program->begin();
  while (program->parse(at, block, mistakes)) {
    if (block.next.offset <= at.offset || block.next.line <= at.line) std::abort();
    at = block.next;
  }
  for (const Diagnostic& mistake : mistakes) {
    if (mistake.message.empty() || mistake.place.line == 0) std::abort();
  }

  OnlyMain library(program);
  ReadingHost host;
  InterpreterOptions options;
  options.stepLimit = 2000;
  const RunResult result = Interpreter(library, host, options).run(program);
  if ((result.end == RunEnd::Finished) != result.diagnostics.empty()) std::abort();
  return 0;
}
