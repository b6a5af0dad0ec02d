#include "simulation/import_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace probewright::simulation {

ImportWatch::ImportWatch(const std::string& file, const ImportOptions& options)
    : stop_(options.stop), progress_(options.progress), patience_(options.patience), file_(file) {}

void ImportWatch::tell(const std::string& stage) {
  // Who has no patience is told everything.
  const auto pause = std::min(patience_, std::chrono::duration<double>(0.25));
  const auto now = Clock::now();
  if (!progress_ || now - start_ < patience_ || now - lastTold_ < pause) return;
  lastTold_ = now;
  progress_(fmt::format("{}: {}", std::filesystem::path(file_).filename().string(), stage));
}

void ImportWatch::tell(const std::string& stage, std::size_t done, std::size_t of) {
  goOn();
  tell(done > 0 ? fmt::format("{}, {} of {}", stage, std::min(done, of), of) : stage);
}

void ImportWatch::goOn() const {
  if (isStopped()) throw ImportStopped{};
}

Diagnostic ImportWatch::interrupted() const {
  return fail(SourcePlace{file_, 0, 0}, "the import was interrupted").value();
}

}  // namespace probewright::simulation
