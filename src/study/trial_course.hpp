#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "study/adaptive.hpp"
#include "study/crew.hpp"
#include "study/findings.hpp"

/// The trials of a study from the first to the last: who carries them out, when there are enough, what is kept of them.
namespace probewright::study {

/// Told what is done, in how many trials of how many (as far as anybody knows).
using Report = std::function<void(const std::string& phase, std::uint64_t done, std::uint64_t of)>;

enum class StudyEnd {
  Stable,       ///< the digits that were asked for are
  AllTrials,    ///< as many as were asked for
  MostTrials,   ///< the digits are not stable after the most that the study allows
  NoResult,     ///< no trial has come to the end of the program by the first look at the digits
  Interrupted,  ///< somebody stopped it
};

/// Ranks that hand in sums of their trials, not their values.
struct Summing {
  Ranks ranks;
  Crew mine;                     ///< carries out the share of this rank
  std::stop_source all;          ///< asked to stop on every rank, if any of them was stopped
  std::uint64_t stretch = 2500;  ///< trials of all ranks between two times that sums are handed in
};

struct CourseRun {
  std::stop_token stop;
  std::uint64_t stretch =
      500;  ///< trials between two looks at stop, progress and what is kept; no number depends on it
  Report report;
  /// Told the trials of each stretch, once they are done: where every value is handed in.
  std::function<void(std::span<const Draw>, std::span<const Outcome>)> keep;
  /// The trials of an earlier run, one after the other; then nothing. Draws are repeated, answers are not.
  std::function<std::optional<Outcome>()> done;

  /// After the first 500 trials the values of the others stay where they are.
  std::optional<Summing> summing;
  /// Told where a course with `summing` has come to, after each stretch.
  std::function<void(const std::string& state)> keepState;
  /// Where an earlier run had come to; empty: at the beginning.
  std::string state;
};

class TrialCourse {
public:
  struct Sees {
    /// An outcome as it is counted: with true values and descriptions that this study gives.
    std::function<Outcome(const Outcome&, const Draw&)> outcome;
    LimitsOf limits;
  };
  TrialCourse(const Study& study, const Sampler& sampler, const Model& model, Crew crew, Sees sees,
              const CourseRun& run);

  StudyEnd carryOut();

  /// All trials; once carryOut() has returned.
  const TrialSummary& trials() const { return total_; }
  /// To the digits that were asked for. Where so many trials were asked for, nobody knows.
  bool isStable(const std::string& key) const { return !study_.trials && stable_.contains(key); }

private:
  std::uint64_t size() const { return total_.size() + block_.size(); }
  void add(const Draw& draw, const Outcome& outcome);
  /// Once the first trials are there.
  void findGrid();
  /// Both return false if stopped.
  bool drawValues(std::uint64_t begin, std::uint64_t end);
  bool drawSums(std::uint64_t begin, std::uint64_t end);
  void look();
  std::optional<StudyEnd> verdict();
  std::string state() const;
  void restore(const std::string& state);

  const Study& study_;
  const Sampler& sampler_;
  const Model& model_;
  Crew crew_;
  Sees sees_;
  const CourseRun& run_;
  std::shared_ptr<const Grid> grid_;
  TrialSummary first_;          ///< trials that the grid is made of
  TrialSummary total_, block_;  ///< up to the last look at the digits, and since then
  /// Of measured values, and of their errors where the truth is known: it is the digits of the uncertainty that count.
  struct Digits {
    Stability values, errors;
  };
  Digits& digitsOf(const std::string& key);
  std::map<std::string, Digits> stabilities_;
  std::set<std::string> stable_;
  std::uint64_t nextLook_;
  bool doneIsRead_ = false;
};

}  // namespace probewright::study
