#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/diagnostic.hpp"
#include "language/klartext/heidenhain_program.hpp"
#include "language/lowered_blocks.hpp"
#include "language/source_text.hpp"

namespace probewright::language::klartext {

/// A HEIDENHAIN Klartext program (.H) of a TNC 640 or iTNC 530.
///
/// A block is one statement with its continuation lines. The parts of a cycle in the old form (TCH PROBE 0.0 and 0.1;
/// CYCL DEF 7.0, 7.1, 7.2...) are one block, and so are the parameter lines Q321=... that follow a cycle's first line
/// without continuation signs, as printed programs show them. Names and comments may be in any encoding in which ASCII
/// stays ASCII (UTF-8, CP1252, CP1251, GBK); they are kept byte for byte.
class KlartextProgram : public HeidenhainProgram {
public:
  /// A program in memory, which may run again and again: its blocks are parsed once. `file` names it in messages.
  KlartextProgram(std::string file, std::string text);
  /// A program on disk, read where it is needed: its size does not matter.
  static Result<std::shared_ptr<KlartextProgram>> open(const std::filesystem::path& path);

  const std::string& file() const override { return source_.file(); }
  const std::string& name() const override { return name_; }
  BlockPosition begin() const override { return begin_; }
  bool parse(BlockPosition position, Block& block, Diagnostics& diagnostics) override;
  std::optional<BlockPosition> findLabel(std::string_view label, BlockPosition from, JumpDirection direction) override;
  /// Klartext has no structured statements.
  std::optional<BlockPosition> counterpart(BlockPosition) override { return std::nullopt; }

  bool cornerFollows(BlockPosition position) const override;
  Unit unit() const override { return unit_; }
  FramePart framePart(const Block& block) const override;
  const FrameWords& frameWords() const override;

private:
  explicit KlartextProgram(SourceText source);
  void readHead();
  void indexLabels();
  /// The text of the block at `position`, with the positions it has and is followed by.
  std::string_view readBlock(BlockPosition position, BlockPosition& next) const;

  SourceText source_;
  std::string name_;
  BlockPosition begin_;
  Unit unit_ = Unit::Millimetre;
  bool labelsIndexed_ = false;
  std::unordered_map<std::string, std::vector<BlockPosition>> labels_;
  bool keepsBlocks_ = false;
  LoweredBlocks lowered_;
};

/// The label that a LBL block's text after LBL names, as findLabel knows it: leading zeros of numbers removed.
std::string_view canonicalLabel(std::string_view label);
/// The label with this name in quotation marks, as findLabel knows it: names of digits alone keep the marks, as LBL "5"
/// is another label than LBL 5.
std::string namedLabel(std::string_view name);
/// Where that label is, for a text that a parameter holds as well: a number of that text comes first.
template <class Labels>
auto findIn(const Labels& labels, std::string_view label) {
  const auto found = labels.find(std::string(canonicalLabel(label)));
  return found == labels.end() ? labels.find(namedLabel(label)) : found;
}

}  // namespace probewright::language::klartext
