#pragma once

#define TOML_HEADER_ONLY 0
#include <toml++/toml.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "setup/setup.hpp"

namespace probewright::setup {

/// A setup file that is read once, and setups that differ from it in numbers: no file is read for them again.
class SetupDocument {
public:
  static std::optional<SetupDocument> read(const std::filesystem::path& path, Diagnostics& diagnostics,
                                           const session::ControlFamilies& families = session::knownFamilies());
  static std::optional<SetupDocument> parse(std::string_view text, const std::string& file, Diagnostics& diagnostics,
                                            const session::ControlFamilies& families = session::knownFamilies());

  const toml::table& table() const { return table_; }
  const Setup& asWritten() const { return asWritten_; }

  /// The setup that `table` writes: table() with other numbers. The machine stays that of the file. May be called from
  /// several threads.
  std::optional<Setup> with(const toml::table& table, Diagnostics& diagnostics) const;

private:
  SetupDocument(toml::table table, Setup asWritten, const session::ControlFamilies& families);

  toml::table table_;
  Setup asWritten_;
  const session::ControlFamilies* families_;
};

}  // namespace probewright::setup
