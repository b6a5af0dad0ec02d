#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "language/program.hpp"
#include "language/sinumerik/block_parser.hpp"
#include "language/sinumerik/structure.hpp"
#include "language/source_text.hpp"

namespace probewright::sinumerik {

/// A part program or subprogram (.MPF, .SPF) of a SINUMERIK 840D sl or 828D. One line is one block.
class SinumerikProgram : public language::Program {
public:
  static Result<std::shared_ptr<SinumerikProgram>> open(const std::filesystem::path& path);
  /// A program from memory; `file` is its name in messages.
  static std::shared_ptr<SinumerikProgram> fromText(std::string file, std::string text);

  explicit SinumerikProgram(language::SourceText text);

  const std::string& file() const override { return text_.file(); }
  const std::string& name() const override { return name_; }
  language::BlockPosition begin() const override { return {text_.begin(), 1}; }
  bool parse(language::BlockPosition position, language::Block& block, Diagnostics& diagnostics) override;
  std::optional<language::BlockPosition> findLabel(std::string_view label, language::BlockPosition from,
                                                   language::JumpDirection direction) override;
  std::optional<language::BlockPosition> counterpart(language::BlockPosition position) override;

  /// Labels, nesting and the PROC line; scanned at the first use.
  ProgramStructure& structure();

  /// All mistakes of the program that can be seen without running it, without the program being run.
  const language::SourceText& text() const { return text_; }

private:
  void resolveTargets(language::Block& block);

  language::SourceText text_;
  std::string name_;
  BlockParser parser_;
  SourcePlace place_;
  std::unique_ptr<ProgramStructure> structure_;
};

}  // namespace probewright::sinumerik
