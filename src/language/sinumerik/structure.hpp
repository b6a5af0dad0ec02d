#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "language/block.hpp"
#include "language/sinumerik/block_parser.hpp"
#include "language/source_text.hpp"

namespace probewright::language::sinumerik {

/// What jumps and structured statements of one program need to know, found in one pass over its text. Block numbers
/// are not kept: a program may have millions; those that jumps name are looked for when they are needed.
class ProgramStructure {
public:
  /// Scans the whole text.
  explicit ProgramStructure(const language::SourceText& text);

  struct Label {
    std::string name;  ///< upper case
    language::BlockPosition position;
  };
  const std::vector<Label>& labels() const { return labels_; }

  /// The block with `label` (a name, "N100" or ":100"; upper case) as a jump from the block at `from` finds it.
  std::optional<language::BlockPosition> find(const language::SourceText& text, std::string_view label,
                                              language::BlockPosition from, language::JumpDirection direction);

  std::optional<language::BlockPosition> counterpart(language::BlockPosition position) const;

  /// Mistakes in the nesting: IF without ENDIF and the like.
  const Diagnostics& mistakes() const { return mistakes_; }

  /// True if a STRING variable of that name is declared: a jump may take its label from it.
  bool isStringVariable(std::string_view name) const;

  /// The PROC line, if the program has one.
  const std::optional<BlockParser::Header>& header() const { return header_; }
  /// Why the PROC line cannot be read; empty if it can or there is none.
  const std::string& headerMistake() const { return headerMistake_; }

private:
  struct Mark {
    language::BlockPosition position;
    language::Structure kind = language::Structure::If;
    std::size_t partner = none;
    static constexpr std::size_t none = static_cast<std::size_t>(-1);
  };
  void scanLine(std::string_view line, language::BlockPosition position);
  void pair(language::Structure kind, language::BlockPosition position, std::string_view line);
  void complain(language::BlockPosition position, std::string_view line, std::string message, std::string advice);

  std::vector<Label> labels_;
  std::unordered_map<std::string, std::vector<language::BlockPosition>> positions_;
  std::vector<Mark> marks_;
  std::vector<std::size_t> open_;
  std::vector<std::string> stringVariables_;
  std::optional<BlockParser::Header> header_;
  std::string headerMistake_;
  Diagnostics mistakes_;
  std::string file_;
  std::string upper_;
};

}  // namespace probewright::language::sinumerik
