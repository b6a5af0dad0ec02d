#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

#include "base/diagnostic.hpp"
#include "language/klartext/heidenhain_program.hpp"
#include "language/source_text.hpp"

namespace probewright::language::din_iso {

/// A HEIDENHAIN program in DIN/ISO (.I).
///
/// Block numbers N are not needed, and neither are the signs '*' at the ends of blocks as long as each block has a line
/// of its own. Names and comments may be in any encoding in which ASCII stays ASCII. Blocks are lowered as far as their
/// own text tells (see BlockParser); ModalState does the rest while the program runs or is translated.
class DinIsoProgram : public klartext::HeidenhainProgram {
public:
  /// A program in memory. `file` names it in messages.
  DinIsoProgram(std::string file, std::string text);
  /// A program on disk, read where it is needed: its size does not matter.
  static Result<std::shared_ptr<DinIsoProgram>> open(const std::filesystem::path& path);

  const std::string& file() const override { return source_.file(); }
  const std::string& name() const override { return name_; }
  BlockPosition begin() const override { return begin_; }
  bool parse(BlockPosition position, Block& block, Diagnostics& diagnostics) override;
  std::optional<BlockPosition> findLabel(std::string_view label, BlockPosition from, JumpDirection direction) override;
  /// DIN/ISO has no structured statements.
  std::optional<BlockPosition> counterpart(BlockPosition) override { return std::nullopt; }

  bool cornerFollows(BlockPosition position) const override;
  klartext::Unit unit() const override { return unit_; }
  klartext::FramePart framePart(const Block& block) const override;
  const klartext::FrameWords& frameWords() const override;
  std::optional<klartext::ModalMistake> modalMistake(const Block& block) override;

private:
  explicit DinIsoProgram(SourceText source);
  void readHead();
  void indexLabels();

  struct BlockText {
    std::string_view whole;
    std::string_view statement;  ///< up to the end sign
    BlockPosition next;
  };
  /// The block at `position`; empty and with next == position at the end of the program.
  BlockText read(BlockPosition position) const;

  SourceText source_;
  std::string name_;
  BlockPosition begin_;
  std::uint64_t first_ = 0;  ///< offset of the first statement
  klartext::Unit unit_ = klartext::Unit::Millimetre;
  std::optional<int> path_;  ///< for modalMistake: the path function in force, if it is known
  bool labelsIndexed_ = false;
  std::unordered_map<std::string, BlockPosition> labels_;
};

}  // namespace probewright::language::din_iso
