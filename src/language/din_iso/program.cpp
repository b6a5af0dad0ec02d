#include "language/din_iso/program.hpp"

#include <algorithm>

#include "language/din_iso/block_extent.hpp"
#include "language/din_iso/parser.hpp"
#include "language/din_iso/path_words.hpp"
#include "language/klartext/program.hpp"

namespace probewright::language::din_iso {

using klartext::FramePart;
using klartext::FrameWords;
using klartext::Lexer;

DinIsoProgram::DinIsoProgram(std::string file, std::string text)
    : DinIsoProgram(SourceText::of(std::move(file), std::move(text))) {}

DinIsoProgram::DinIsoProgram(SourceText source) : source_(std::move(source)), name_(programName(source_.file())) {
  begin_.offset = source_.begin();
  readHead();
}

Result<std::shared_ptr<DinIsoProgram>> DinIsoProgram::open(const std::filesystem::path& path) {
  Result<SourceText> source = SourceText::open(path);
  if (!source) return tl::unexpected(source.error());
  return std::shared_ptr<DinIsoProgram>(new DinIsoProgram(std::move(*source)));
}

DinIsoProgram::BlockText DinIsoProgram::read(BlockPosition position) const {
  BlockText block;
  block.next = position;
  const SourceLine line = source_.line(position.offset);
  if (!line) return block;
  const std::string_view text = source_.bytes(position.offset, source_.end());
  const BlockExtent extent = blockExtent(text);
  block.whole = text.substr(0, extent.length);
  if (block.whole.ends_with('\r')) block.whole.remove_suffix(1);
  block.statement = text.substr(0, std::min(extent.statement, block.whole.size()));
  block.next.offset += extent.next;
  block.next.line += extent.lines;
  return block;
}

void DinIsoProgram::readHead() {
  BlockPosition position = begin_;
  for (;;) {
    const BlockText block = read(position);
    first_ = position.offset;
    if (block.next.offset == position.offset) return;
    const std::string_view statement = withoutBlockNumber(block.statement);
    if (!statement.empty() && statement.front() != ';' && statement.front() != '*') {
      const bool inch = statement.front() == '%' && (statement.find("G70") != std::string_view::npos ||
                                                     statement.find("g70") != std::string_view::npos);
      if (inch) unit_ = klartext::Unit::Inch;
      return;
    }
    position = block.next;
  }
}

bool DinIsoProgram::parse(BlockPosition position, Block& block, Diagnostics& diagnostics) {
  block.clear();
  block.position = position;
  const BlockText text = read(position);
  block.next = text.next;
  if (block.next.offset == position.offset) return false;
  block.source = block.add(text.whole);
  BlockParser(text.statement, file(), block, diagnostics, position.offset == first_, unit_ == klartext::Unit::Inch)
      .parse();
  return true;
}

bool DinIsoProgram::cornerFollows(BlockPosition position) const {
  for (;;) {
    const BlockText block = read(position);
    if (block.next.offset == position.offset) return false;
    const std::string_view statement = withoutBlockNumber(block.statement);
    if (!statement.empty() && statement.front() != ';' && statement.front() != '*') {
      Lexer lexer(statement);
      for (const std::string_view corner : {"G24", "G25", "G26", "G27"}) {
        if (lexer.acceptPrefix(corner)) return !isDigit(lexer.here());
      }
      return false;
    }
    position = block.next;
  }
}

FramePart DinIsoProgram::framePart(const Block& block) const {
  const std::string_view statement = withoutBlockNumber(block.at(block.source));
  if (statement.empty() || statement.front() == ';' || statement.front() == '*') return FramePart::Nothing;
  if (statement.front() != '%') return FramePart::Statement;
  if (block.position.offset == first_) return FramePart::Begin;
  const bool end = block.instructions.size() == 1 && std::holds_alternative<EndProgram>(block.instructions.front());
  return end ? FramePart::End : FramePart::Statement;
}

std::optional<klartext::ModalMistake> DinIsoProgram::modalMistake(const Block& block) {
  if (block.position.offset == first_) path_.reset();
  const std::optional<int> own = pathOf(block);
  if (own) path_ = own;
  std::optional<klartext::ModalMistake> found;
  for (const Instruction& instruction : block.instructions) {
    const auto* move = std::get_if<Move>(&instruction);
    if (move != nullptr && path_ && block.at(move->variant) == "G" && !found) {
      if (std::optional<PathMistake> mistake = pathMistake(*path_, block, *move))
        found = klartext::ModalMistake{mistake->word, std::move(mistake->message), std::move(mistake->advice)};
    }
    const auto* command = std::get_if<Command>(&instruction);
    const bool leaves = std::holds_alternative<LabelMark>(instruction) ||
                        std::holds_alternative<CallLabel>(instruction) ||
                        std::holds_alternative<CallProgram>(instruction) ||
                        (command != nullptr && klartext::kindOf(block, *command) == klartext::CommandKind::CycleCall);
    if (leaves) path_.reset();
  }
  if (own && block.skippable) path_.reset();
  return found;
}

const FrameWords& DinIsoProgram::frameWords() const {
  static constexpr FrameWords words{"%", "%NAME G71 *", "%", "N99999999 %NAME G71 *", "G98 L"};
  return words;
}

void DinIsoProgram::indexLabels() {
  labelsIndexed_ = true;
  BlockPosition position = begin_;
  for (;;) {
    const BlockText block = read(position);
    if (block.next.offset == position.offset) return;
    Lexer lexer(withoutBlockNumber(block.statement));
    if (lexer.acceptPrefix("G98") && lexer.accept('L')) {
      const std::optional<std::string_view> quoted = lexer.quoted();
      const std::string label =
          quoted ? klartext::namedLabel(*quoted) : std::string(klartext::canonicalLabel(lexer.chunk()));
      if (!label.empty() && label != "0") labels_.emplace(label, position);
    }
    position = block.next;
  }
}

std::optional<BlockPosition> DinIsoProgram::findLabel(std::string_view label, BlockPosition, JumpDirection) {
  if (!labelsIndexed_) indexLabels();
  const auto found = klartext::findIn(labels_, label);
  if (found == labels_.end()) return std::nullopt;
  return found->second;
}

}  // namespace probewright::language::din_iso
