#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.hpp"
#include "study/trial.hpp"

/// trials.csv: every trial with what it drew and what it answered, for other programs, and so that a study that was
/// broken off can go on.
namespace probewright::study {

/// Writes the trials of a study as they come.
class TrialWriter {
public:
  /// `mark` tells studies apart whose trials are different: what they draw from, the program, the setup.
  TrialWriter(std::filesystem::path path, std::string mark, std::vector<std::string> sources);

  /// Adds what is new in `table`; writes the file anew if there are results that it has no column for.
  Result<void> write(const TrialTable& table);

private:
  std::string rows(const TrialTable& table, std::size_t begin) const;

  std::filesystem::path path_;
  std::string mark_;
  std::vector<std::string> sources_;
  std::size_t written_ = 0, columns_ = 0;
  bool begun_ = false;
};

/// The trials that the file holds, up to the first that is not whole. Fails if the file is not one of a study, or of a
/// study with another mark.
Result<std::vector<Outcome>> readTrials(const std::filesystem::path& path, std::string_view mark);

/// Why `path` cannot be written: a file that is not the trials of a study lies there.
std::optional<Diagnostic> whyNotTrials(const std::filesystem::path& path);

}  // namespace probewright::study
