#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "study/statistics.hpp"
#include "survival/box_proof.hpp"

/// Which clampings of a box a program survives: what is proven, what fails, what is undecided.
namespace probewright::survival {

struct Options {
  std::uint64_t samples = 1000;  ///< clampings that are run, beside the corners of the box
  std::uint64_t boxes = 1000;    ///< that are tried to be proven, at most
  std::uint64_t checks = 0;      ///< clampings that are run in the proven parts, half of them on their borders
  std::uint64_t seed = 1;        ///< of the samples and of the machine's random effects
  int threads = 0;               ///< 0: all cores
  /// What is being done, how much of it is done, and how much there is at most.
  std::function<void(const std::string& phase, std::uint64_t done, std::uint64_t of)> report = {};
};

/// A part of the box. The parts do not overlap, and together they are the box.
struct Part {
  Box box;
  Verdict verdict = Verdict::Undecided;
  std::optional<Reason> reason;
  double share = 0;  ///< of the box
};

/// A clamping that was run and does not survive.
struct Failure {
  std::uint64_t sample = 0;  ///< which one it was
  std::vector<double> values;
  std::uint64_t noise = 0;  ///< the seed of the machine's random effects
  Reason reason;
};

/// What a block of the program has to do with it.
struct BlockRecord {
  SourcePlace place;
  std::uint64_t failures = 0;  ///< samples that stop there
  double share = 0;            ///< of the box: parts that fail or are undecided because of it
  std::string why;             ///< the first reason
};

enum class SurvivalEnd {
  Finished,
  Interrupted,
  FailsAsWritten,  ///< the setup as it is written does not survive: nothing is proven
  Contradiction,   ///< a clamping of a proven part fails: a mistake of Probewright
};

struct Survival {
  SurvivalEnd end = SurvivalEnd::Finished;
  std::vector<Tolerance> tolerances;
  std::optional<Reason> asWritten;  ///< how the setup as it is written fails
  std::optional<Reason> obstacle;   ///< why nothing can be proven
  std::vector<Part> parts;
  double proven = 0, fails = 0, undecided = 0;  ///< shares of the box
  /// The largest box about the middle of the given one, of the same shape, that is proven: its size over that of the
  /// given one, 0 to 1.
  double symmetric = 0;
  std::optional<double> nearestFailure;  ///< the smallest such box that holds a clamping that failed
  std::uint64_t samples = 0;             ///< run
  std::uint64_t samplesInProven = 0;     ///< of them; none failed
  std::uint64_t failed = 0;              ///< of all samples
  std::vector<Failure> failures;         ///< the first ones
  /// Of what is not proven: samples there, how many of them failed, and the probability of that between the limits of
  /// Clopper and Pearson (95 %).
  std::uint64_t openSamples = 0, openFailures = 0;
  std::optional<study::Interval> openProbability;
  std::vector<BlockRecord> blocks;  ///< the worst first
  std::uint64_t boxes = 0;          ///< that were tried
};

/// The same on any number of threads. Ends early, with what is known, if the program's stop is asked for.
Survival survive(const ClampedProgram& program, const Options& options);

/// How many failures are kept with their values.
inline constexpr std::size_t mostFailures = 1000;

}  // namespace probewright::survival
