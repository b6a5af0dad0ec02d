#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "study/random.hpp"
#include "study/study.hpp"

/// Trials of a model: what they are given, what they answer, and many of them on all cores.
namespace probewright::study {

/// What one trial is given.
struct Draw {
  std::uint64_t trial = 0;
  std::vector<double> inputs;          ///< a value for each source
  std::optional<std::uint64_t> noise;  ///< seed of the machine's random effects; nothing: it has none
};

/// What is asked: a result of a cycle, an entry of a table.
struct Characteristic {
  std::string key;  ///< unique in a study: "421@23 Q153", "PRESET.PR row 1, column X"
  std::string label;
  std::string unit;
  bool main = false;   ///< an answer that the program was written for
  bool table = false;  ///< an entry of a table
  std::optional<double> nominal, lower, upper;
  /// Standard uncertainty from the scatter of the probe alone, to first order; nothing where that is not known.
  std::optional<double> firstOrder;
};

struct Observation {
  Characteristic of;
  double value = 0;
  std::optional<double> truth = std::nullopt;  ///< the true value in this trial, where the virtual machine knows it
};

enum class TrialEnd {
  Finished,
  Alarm,      ///< the control or the machine stopped the program
  Refused,    ///< the program could not begin: a value out of its range
  Cancelled,  ///< somebody stopped the study; the trial does not count
};

struct Outcome {
  TrialEnd end = TrialEnd::Finished;
  std::string why;                        ///< what stopped it
  std::vector<Observation> observations;  ///< up to there; keys are different from each other
};

/// Must answer the same draw in the same way, from any thread.
using Model = std::function<Outcome(const Draw&)>;

/// Draws for the sources of a study.
class Sampler {
public:
  explicit Sampler(const Study& study);
  /// For models that are not programs: `sources` and `groups` alone.
  Sampler(std::vector<Source> sources, std::vector<Group> groups, std::uint64_t seed);

  std::size_t size() const { return sources_.size(); }
  const std::vector<Source>& sources() const { return sources_; }
  std::uint64_t seed() const { return seed_; }

  Draw draw(std::uint64_t trial, Purpose purpose = Purpose::Trial) const;
  /// All sources at their estimates, no random effects.
  Draw estimate() const;

  /// What varies together: groups, then single sources, in the order of the study.
  struct Unit {
    std::string name;
    std::vector<std::size_t> sources;  ///< empty: the machine's random effects
  };
  const std::vector<Unit>& units() const { return units_; }

private:
  void findUnits();

  std::vector<Source> sources_;
  std::vector<Group> groups_;
  std::uint64_t seed_;
  std::vector<Unit> units_;
};

inline constexpr double missing = std::numeric_limits<double>::quiet_NaN();

/// The answers of trials, column by column, in the order of the trials. A value that a trial did not come to is NaN.
class TrialTable {
public:
  explicit TrialTable(std::size_t sources) : inputs_(sources) {}

  void add(const Draw& draw, const Outcome& outcome);
  /// A column for a result, whether or not a trial comes to it.
  void expect(const Characteristic& characteristic) { placeOf(characteristic, size()); }

  std::size_t size() const { return trials_.size(); }
  const std::vector<Characteristic>& characteristics() const { return characteristics_; }
  const std::vector<double>& values(std::size_t characteristic) const { return values_[characteristic]; }
  /// The true values beside values(); empty if no trial knows one.
  const std::vector<double>& truths(std::size_t characteristic) const { return truths_[characteristic]; }
  const std::vector<double>& inputs(std::size_t source) const { return inputs_[source]; }
  const std::vector<std::uint64_t>& trials() const { return trials_; }
  const std::vector<TrialEnd>& ends() const { return ends_; }
  /// Trials by what stopped them, as places in this table.
  const std::map<std::string, std::vector<std::size_t>>& stops() const { return stops_; }
  std::optional<std::size_t> find(const std::string& key) const;

private:
  /// The column of a characteristic; a new one begins with as many values that are missing as there are trials.
  std::size_t placeOf(const Characteristic& characteristic, std::size_t trials);

  std::vector<Characteristic> characteristics_;
  std::map<std::string, std::size_t> places_;
  std::vector<std::vector<double>> values_, truths_, inputs_;
  std::vector<std::uint64_t> trials_;
  std::vector<TrialEnd> ends_;
  std::map<std::string, std::vector<std::size_t>> stops_;
};

/// Runs the model for `draws` on `threads` threads (0: all cores). The answers come in the order of the draws, whatever
/// the threads; those from the first one on that a stop has caught are left out.
std::vector<Outcome> runTrials(const Model& model, std::span<const Draw> draws, int threads,
                               const std::stop_token& stop = {});

}  // namespace probewright::study
