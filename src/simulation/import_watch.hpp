#pragma once

#include <chrono>
#include <string>

#include "base/diagnostic.hpp"
#include "simulation/import_options.hpp"

namespace probewright::simulation {

/// Thrown out of a long step of an import that was asked to stop.
struct ImportStopped {};

/// Tells how far the import of a file has come, and whether it is to go on.
class ImportWatch {
public:
  ImportWatch(const std::string& file, const ImportOptions& options);

  /// May be asked from any thread.
  bool isStopped() const { return stop_.stop_requested(); }
  /// Says what is being done, once the import takes longer than its patience, and then a few times a second.
  void tell(const std::string& stage);
  /// The same of something that is counted; throws ImportStopped. Cheap enough for every thousandth step.
  void tell(const std::string& stage, std::size_t done, std::size_t of);
  /// Throws ImportStopped if the import is not to go on.
  void goOn() const;

  Diagnostic interrupted() const;

private:
  using Clock = std::chrono::steady_clock;

  std::stop_token stop_;
  std::function<void(const std::string& what)> progress_;
  std::chrono::duration<double> patience_;
  std::string file_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point lastTold_;
};

}  // namespace probewright::simulation
