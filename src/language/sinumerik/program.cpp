#include "language/sinumerik/program.hpp"

#include <algorithm>
#include <utility>

namespace probewright::sinumerik {

using namespace language;

Result<std::shared_ptr<SinumerikProgram>> SinumerikProgram::open(const std::filesystem::path& path) {
  Result<SourceText> text = SourceText::open(path);
  if (!text) return tl::unexpected(std::move(text.error()));
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
  parser_.parse(line.text, place_, block, diagnostics);
  for (const Instruction& instruction : block.instructions) {
    if (std::holds_alternative<Jump>(instruction)) {
      resolveTargets(block);
      break;
    }
  }
  return true;
}

/// A destination that is no label but a STRING variable is computed.
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

}  // namespace probewright::sinumerik
