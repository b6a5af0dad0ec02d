#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.hpp"
#include "study/trial.hpp"

/// Trials in a file of comma-separated values, a line each: for other programs, and to go on after an interruption.
namespace probewright::study {

/// The columns of such a file.
struct TrialColumns {
  std::vector<std::string> sources;
  std::vector<std::string> results;
  std::vector<std::string> truths;  ///< results whose true values follow all values, in the order of the results
};

/// Reads trial after trial; a file of any size.
class TrialReader {
public:
  /// Fails if the file is not of a study, or of one with another mark.
  static Result<TrialReader> open(const std::filesystem::path& path, std::string_view mark);

  struct Trial {
    std::vector<double> inputs;  ///< of the sources
    Outcome outcome;             ///< of its results only the keys are known
  };
  /// The trials from the first one on; nothing at the end, or where a line was not written whole.
  std::optional<Trial> next();

  const TrialColumns& columns() const { return columns_; }
  /// After the last trial that was read.
  std::uint64_t trials() const { return trials_; }
  std::uint64_t bytes() const { return bytes_; }

private:
  TrialReader() = default;

  std::ifstream file_;
  TrialColumns columns_;
  std::vector<std::size_t> truthOf_;  ///< places of `truths` among the results
  std::uint64_t trials_ = 0, bytes_ = 0;
  bool headed_ = false;
};

/// Writes the trials of a study as they come; what is there stays whole if the process ends.
class TrialWriter {
public:
  /// `mark` tells studies apart: trials of one are of no use to another. Replaces a file that is there.
  /// `beforeChange` is called once, when the first trials are ready to be there: takes away what else belongs to the
  /// file as it is. If it fails, the file stays so.
  TrialWriter(
      std::filesystem::path path, std::string mark, std::vector<std::string> sources,
      std::function<Result<void>()> beforeChange = [] { return Result<void>(); });

  /// Goes on where `done` has come to: what follows there goes.
  Result<void> goOn(const TrialReader& done);

  /// Adds trials. A result that comes up for the first time gets a column, which means writing the file again.
  Result<void> write(std::span<const Draw> draws, std::span<const Outcome> outcomes);

private:
  /// True if there are results that have no column yet; they have one then.
  bool learn(std::span<const Outcome> outcomes);
  std::string heading() const;
  std::string rows(std::span<const Draw> draws, std::span<const Outcome> outcomes) const;
  Result<void> rewrite(const TrialColumns& before, const std::string& more);

  std::filesystem::path path_;
  std::string mark_;
  TrialColumns columns_;
  std::function<Result<void>()> beforeChange_;
  bool begun_ = false;
};

/// Why the trials of a study must not be written there: something else lies there. Nothing if they may.
std::optional<Diagnostic> whyNotTrials(const std::filesystem::path& path);

}  // namespace probewright::study
