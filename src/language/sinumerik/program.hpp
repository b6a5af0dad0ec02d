#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "language/program.hpp"
#include "language/sinumerik/block_parser.hpp"
#include "language/sinumerik/structure.hpp"
#include "language/source_text.hpp"

namespace probewright::language::sinumerik {

/// Macros by their names in capitals: what DEFINE NAME AS text defines.
using Macros = std::map<std::string, std::string, std::less<>>;

/// A part program or subprogram (.MPF, .SPF) of a SINUMERIK 840D sl or 828D. One line is one block.
///
/// Macros (DEFINE NAME AS text) are known from the block on that defines them; a block that uses one is parsed with the
/// macro's text in its place, which is then also the block's source. Macros of the whole control (useMacros) are known
/// from the beginning; one that the program defines itself goes before them.
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

  const language::SourceText& text() const { return text_; }

  /// Macros of definition files. To be called before the first parse().
  void useMacros(const Macros& macros) { macros_.insert(macros.begin(), macros.end()); }
  /// All macros that are known by now.
  const Macros& macros() const { return macros_; }

private:
  void resolveTargets(language::Block& block);
  void defineMacro(const language::Block& block, const language::Command& command);
  std::string_view withoutMacros(std::string_view line);

  language::SourceText text_;
  std::string name_;
  BlockParser parser_;
  SourcePlace place_;
  Macros macros_;
  std::string expanded_;
  std::unique_ptr<ProgramStructure> structure_;
};

}  // namespace probewright::language::sinumerik
