#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "base/diagnostic.hpp"
#include "study/trial_file.hpp"

namespace probewright::app {

/// All values of a study's trials in a file of HDF5 (`study --keep`).
class KeptTrials {
public:
  /// Fails if this program was built without HDF5, or if something else than kept trials lies at `path`.
  static Result<KeptTrials> at(const std::filesystem::path& path);

  /// Writes the file whole or not at all. `mark` tells studies apart whose trials are different.
  Result<void> write(study::TrialReader trials, const std::string& mark) const;

private:
  KeptTrials(std::filesystem::path path, std::shared_ptr<void> module)
      : path_(std::move(path)), module_(std::move(module)) {}

  std::filesystem::path path_;
  std::shared_ptr<void> module_;
};

}  // namespace probewright::app
