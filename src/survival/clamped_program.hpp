#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "simulation/body_clearance.hpp"
#include "survival/clamped_worlds.hpp"
#include "survival/program_scan.hpp"
#include "survival/touched_faces.hpp"
#include "survival/watched_machine.hpp"

/// A program in the worlds of all clampings.
namespace probewright::survival {

/// Why a clamping, or a box of clampings, does not do, and where in the program.
struct Reason {
  std::string why;
  SourcePlace place;
};

/// A run of one clamping.
struct ClampedRun {
  bool cancelled = false;
  std::optional<Reason> failure;  ///< nothing: it survives
};

/// A run that is looked at move by move.
struct WatchedRun {
  ClampedRun end;
  std::vector<Step> steps;
  session::RunOutcome outcome;
  simulation::Truth truth;
  simulation::PathRecord path;
};

class ClampedProgram {
public:
  struct Script {
    std::string name, text;
  };

  /// Runs the program in the setup as it is written: that says what it is meant to touch. Fails if it cannot begin.
  static Result<std::unique_ptr<ClampedProgram>> make(Script script, std::unique_ptr<ClampedWorlds> worlds,
                                                      std::optional<control::ControlKind> control,
                                                      std::stop_token stop);

  const Script& script() const { return script_; }
  const ClampedWorlds& worlds() const { return *worlds_; }
  const std::stop_token& stop() const { return stop_; }
  /// How the setup as it is written fails, if it does; nothing can be proven then.
  const std::optional<Reason>& failureAsWritten() const { return failureAsWritten_; }
  /// Why nothing can be proven of this program on this machine, if so.
  const std::optional<Reason>& obstacle() const { return obstacle_; }
  const std::vector<TouchedFace>& meant() const { return meant_; }
  /// Bodies of the machine among what lies on the table, with the most material, in the middle of all tolerances; null
  /// if the machine has none.
  const simulation::BodyClearance* bodies() const { return bodies_.get(); }
  OtherFaces& otherFaces() const { return otherFaces_; }

  /// Runs it as it is, the random effects of the machine drawn from `noise`.
  ClampedRun run(std::span<const double> values, std::uint64_t noise) const;
  /// Without random effects, each move kept.
  WatchedRun watch(std::span<const double> values) const;
  /// On the machine of `truth` with nothing on its table, measuring moves answered as planned.
  WatchedRun replay(const simulation::Truth& truth, const std::vector<PlannedTouch>& plan) const;

private:
  ClampedProgram(Script script, std::unique_ptr<ClampedWorlds> worlds, std::optional<control::ControlKind> control,
                 std::stop_token stop)
      : script_(std::move(script)), worlds_(std::move(worlds)), stop_(std::move(stop)) {
    options_.control = control;
    options_.stop = stop_;
    traced_ = options_;
    traced_.trace = true;
    options_.files = false;
  }
  /// The program as this thread has read it: checked once, with the tables that each run begins with.
  session::PreparedProgram prepared(const session::RunOptions& options) const;
  /// How a run has ended.
  ClampedRun judged(const session::RunOutcome& outcome) const;
  std::optional<Reason> obstacleOfMachine() const;

  Script script_;
  std::unique_ptr<ClampedWorlds> worlds_;
  std::stop_token stop_;
  session::RunOptions options_, traced_;
  std::optional<Reason> failureAsWritten_, obstacle_;
  std::vector<TouchedFace> meant_;
  std::unique_ptr<simulation::BodyClearance> bodies_;
  mutable OtherFaces otherFaces_;
  struct Read {
    std::optional<session::PreparedProgram> plain, traced;
  };
  mutable tbb::enumerable_thread_specific<Read> read_;
};

/// The block that was carried out at that time.
SourcePlace placeAt(const records::RunTrace& trace, double seconds);

}  // namespace probewright::survival
