#include "language/sinumerik/program.hpp"

#include <algorithm>
#include <utility>

namespace probewright::language::sinumerik {

using namespace language;

Result<std::shared_ptr<SinumerikProgram>> SinumerikProgram::open(const std::filesystem::path& path) {
  Result<SourceText> text = SourceText::open(path);
  if (!text) return tl::unexpected(std::move(text.error()));
  const std::string_view head = text->bytes(text->begin(), std::min(text->end(), text->begin() + 4096));
  const auto isBinary = [](unsigned char c) { return c < 0x20 && c != '\t' && c != '\r' && c != '\n' && c != 0x1a; };
  if (std::ranges::any_of(head, isBinary))
    return fail({path.string(), 0, 0},
                "this is not a text file but an encrypted or compiled program, which only the control can read",
                "put the program's own text (.SPF, .MPF) in its place");
  return std::make_shared<SinumerikProgram>(std::move(*text));
}

std::shared_ptr<SinumerikProgram> SinumerikProgram::fromText(std::string file, std::string text) {
  return std::make_shared<SinumerikProgram>(SourceText::of(std::move(file), std::move(text)));
}

SinumerikProgram::SinumerikProgram(SourceText text)
    : text_(std::move(text)), name_(programName(text_.file())), place_{text_.file(), 0, 0} {}

ProgramStructure& SinumerikProgram::structure() {
  if (!structure_) structure_ = std::make_unique<ProgramStructure>(text_);
  return *structure_;
}

bool SinumerikProgram::parse(BlockPosition position, Block& block, Diagnostics& diagnostics) {
  block.clear();
  const SourceLine line = text_.line(position.offset);
  if (!line) return false;
  block.position = position;
  block.next = {line.next, position.line + 1};
  place_.line = position.line;
  parser_.parse(macros_.empty() ? line.text : withoutMacros(line.text), place_, block, diagnostics);
  for (const Instruction& instruction : block.instructions) {
    if (std::holds_alternative<Jump>(instruction)) {
      resolveTargets(block);
      break;
    }
    if (const auto* command = std::get_if<Command>(&instruction);
        command != nullptr && block.at(command->name) == "DEFINE")
      defineMacro(block, *command);
  }
  return true;
}

void SinumerikProgram::defineMacro(const Block& block, const Command& command) {
  // The text keeps its own letters: it is taken from the source, which lies one block's length before.
  const std::string_view source = block.at(block.source);
  const std::string_view upper = block.at(command.text);
  const std::size_t start = command.text.offset - block.source.length;
  Cursor cursor(upper);
  const std::string name(cursor.name());
  cursor.skipBlanks();
  if (name.empty() || cursor.name() != "AS") return;
  cursor.skipBlanks();
  macros_[name] = std::string(source.substr(start + cursor.offset(), upper.size() - cursor.offset()));
}

/// The line with the text of each macro in the place of its name. Macros may use macros, a few levels deep.
std::string_view SinumerikProgram::withoutMacros(std::string_view line) {
  constexpr int levels = 4;
  constexpr std::size_t longest = 4096;
  std::string name;
  expanded_.assign(line);
  for (int level = 0; level < levels; ++level) {
    bool changed = false, inText = false;
    for (std::size_t i = 0; i < expanded_.size() && expanded_.size() < longest;) {
      const char c = expanded_[i];
      if (c == '"') inText = !inText;
      if (c == ';' && !inText) break;
      const auto part = [](char each) { return isNamePart(each) || (each >= 'a' && each <= 'z') || each == '$'; };
      if (inText || !part(c)) {
        ++i;
        continue;
      }
      std::size_t end = i;
      while (end < expanded_.size() && part(expanded_[end]))
        ++end;
      name.assign(expanded_, i, end - i);
      for (char& each : name)
        if (each >= 'a' && each <= 'z') each = static_cast<char>(each - 32);
      if (i == 0 && name == "DEFINE") return line;
      const auto macro = macros_.find(name);
      if (macro == macros_.end()) {
        i = end;
      } else {
        expanded_.replace(i, end - i, macro->second);
        i += macro->second.size();
        changed = true;
      }
    }
    if (!changed) break;
  }
  return expanded_;
}

/// A destination that is not a label but a STRING variable is computed.
void SinumerikProgram::resolveTargets(Block& block) {
  for (Instruction& instruction : block.instructions) {
    if (auto* jump = std::get_if<Jump>(&instruction); jump != nullptr && jump->label.length != 0) {
      const std::string_view name = block.at(jump->label);
      if (!structure().isStringVariable(name)) continue;
      VariableRef variable;
      variable.space = VariableSpace::User;
      variable.name = jump->label;
      block.variables.push_back(variable);
      Node node;
      node.operation = Operation::Variable;
      node.a = static_cast<std::uint32_t>(block.variables.size() - 1);
      block.nodes.push_back(node);
      jump->labelValue = {0, static_cast<std::int32_t>(block.nodes.size() - 1)};
      jump->label = {};
    }
  }
}

std::optional<BlockPosition> SinumerikProgram::findLabel(std::string_view label, BlockPosition from,
                                                         JumpDirection direction) {
  std::string name(label);
  std::transform(name.begin(), name.end(), name.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; });
  if (!name.empty() && name.back() == ':') name.pop_back();
  return structure().find(text_, name, from, direction);
}

std::optional<BlockPosition> SinumerikProgram::counterpart(BlockPosition position) {
  return structure().counterpart(position);
}

}  // namespace probewright::language::sinumerik
