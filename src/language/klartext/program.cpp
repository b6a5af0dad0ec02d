#include "language/klartext/program.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.hpp"
#include "language/klartext/block_extent.hpp"
#include "language/klartext/lexer.hpp"
#include "language/klartext/parser.hpp"

namespace probewright::language::klartext {

std::string_view canonicalLabel(std::string_view label) {
  bool number = !label.empty();
  for (const char c : label)
    number = number && isDigit(c);
  while (number && label.size() > 1 && label.front() == '0')
    label.remove_prefix(1);
  return label;
}

std::string namedLabel(std::string_view name) {
  const bool digits = !name.empty() && std::ranges::all_of(name, isDigit);
  return digits ? fmt::format("\"{}\"", name) : std::string(name);
}

KlartextProgram::KlartextProgram(std::string file, std::string text)
    : KlartextProgram(SourceText::of(std::move(file), std::move(text))) {
  keepsBlocks_ = true;
}

KlartextProgram::KlartextProgram(SourceText source) : source_(std::move(source)), name_(programName(source_.file())) {
  begin_.offset = source_.begin();
  readHead();
}

Result<std::shared_ptr<KlartextProgram>> KlartextProgram::open(const std::filesystem::path& path) {
  Result<SourceText> source = SourceText::open(path);
  if (!source) return tl::unexpected(source.error());
  return std::shared_ptr<KlartextProgram>(new KlartextProgram(std::move(*source)));
}

void KlartextProgram::readHead() {
  constexpr int furthestHead = 50;
  BlockPosition position = begin_;
  for (int i = 0; i < furthestHead; ++i) {
    BlockPosition next;
    Lexer lexer(withoutBlockNumber(readBlock(position, next)));
    if (next.offset == position.offset) return;
    if (lexer.acceptKeyword("BEGIN")) {
      if (endsWithWord(lexer.restOfLine(), "INCH")) unit_ = Unit::Inch;
      return;
    }
    if (!lexer.atEnd() && lexer.peek() != '*') return;
    position = next;
  }
}

std::string_view KlartextProgram::readBlock(BlockPosition position, BlockPosition& next) const {
  next = position;
  const SourceLine line = source_.line(position.offset);
  if (!line) return {};
  const std::string_view statement = withoutBlockNumber(line.text);
  const char first = statement.empty() ? ' ' : upper(statement.front());
  if (first != 'T' && first != 'C' && !endsWithContinuation(line.text)) {
    next = {line.next, position.line + 1};
    return line.text;
  }
  const std::string_view text = source_.bytes(position.offset, source_.end());
  const BlockExtent extent = blockExtent(text);
  next.offset += extent.next;
  next.line += extent.lines;
  return text.substr(0, extent.length);
}

bool KlartextProgram::cornerFollows(BlockPosition position) const {
  for (;;) {
    const SourceLine line = source_.line(position.offset);
    if (!line) return false;
    const std::string_view statement = withoutBlockNumber(line.text);
    if (!statement.empty() && statement.front() != ';' && statement.front() != '*') {
      Lexer lexer(statement);
      return lexer.acceptPrefix("RND") || lexer.acceptPrefix("CHF");
    }
    position.offset = line.next;
  }
}

FramePart KlartextProgram::framePart(const Block& block) const {
  const std::string_view statement = withoutBlockNumber(block.at(block.source));
  if (statement.empty() || statement.front() == ';' || statement.front() == '*') return FramePart::Nothing;
  Lexer lexer(statement);
  if (lexer.acceptKeyword("BEGIN")) return FramePart::Begin;
  return lexer.acceptKeyword("END") ? FramePart::End : FramePart::Statement;
}

const FrameWords& KlartextProgram::frameWords() const {
  static constexpr FrameWords words{"BEGIN PGM", "BEGIN PGM NAME MM", "END PGM", "END PGM NAME MM", "LBL "};
  return words;
}

bool KlartextProgram::parse(BlockPosition position, Block& block, Diagnostics& diagnostics) {
  if (keepsBlocks_) {
    if (const Block* known = lowered_.find(position)) {
      block = *known;
      return true;
    }
  }
  block.clear();
  block.position = position;
  const std::string_view text = readBlock(position, block.next);
  if (block.next.offset == position.offset) return false;
  block.source = block.add(text);
  const std::size_t remarks = diagnostics.size();
  BlockParser(text, file(), block, diagnostics).parse();
  if (keepsBlocks_ && diagnostics.size() == remarks) lowered_.keep(block);
  return true;
}

void KlartextProgram::indexLabels() {
  labelsIndexed_ = true;
  BlockPosition position = begin_;
  for (;;) {
    BlockPosition next;
    const std::string_view text = readBlock(position, next);
    if (next.offset == position.offset) return;
    const std::string_view statement = withoutBlockNumber(text);
    if (statement.size() > 3 && upper(statement[0]) == 'L' && upper(statement[1]) == 'B' &&
        upper(statement[2]) == 'L') {
      Lexer lexer(statement.substr(3));
      const std::optional<std::string_view> quoted = lexer.quoted();
      const std::string label = quoted ? namedLabel(*quoted) : std::string(canonicalLabel(lexer.chunk()));
      if (!label.empty() && label != "0") labels_[label].push_back(position);
    }
    position = next;
  }
}

std::optional<BlockPosition> KlartextProgram::findLabel(std::string_view label, BlockPosition, JumpDirection) {
  if (!labelsIndexed_) indexLabels();
  const auto found = findIn(labels_, label);
  if (found == labels_.end()) return std::nullopt;
  return found->second.front();
}

}  // namespace probewright::language::klartext
