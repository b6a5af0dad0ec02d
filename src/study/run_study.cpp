#include "study/run_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "study/adaptive.hpp"

namespace probewright::study {

namespace {

std::uint64_t wantedTrials(const Study& study) { return study.trials.value_or(study.mostTrials); }

/// The key itself, or its end after a blank: "Q153" of "421@23 Q153".
bool means(const std::string& result, const std::string& key) {
  return key == result ||
         (key.size() > result.size() && key.ends_with(result) && key[key.size() - result.size() - 1] == ' ');
}

class Runner {
public:
  Runner(const Study& study, const toml::table& setup, const Model& model, const StudyRun& run)
      : study_(study),
        setup_(setup),
        model_(model),
        run_(run),
        sampler_(study),
        table_(study.sources.size()),
        crew_(run.crew ? run.crew : threadCrew(0, run.stop)) {}

  StudyResult run() {
    result_.study = study_;
    result_.units = sampler_.units();
    const Draw estimate = sampler_.estimate();
    const std::vector<Outcome> estimated = crew_(model_, {&estimate, 1});
    if (!estimated.empty()) estimate_ = estimated.front();
    noteEstimate();
    drawTrials();
    if (run_.whole) run_.whole(table_);
    result_.trials = table_.size();
    result_.finished = static_cast<std::size_t>(std::ranges::count(table_.ends(), TrialEnd::Finished));
    for (std::size_t i = 0; i < table_.characteristics().size(); ++i)
      result_.answers.push_back(answerOf(i));
    noteMeasurands();
    correlate();
    noteStops();
    if (!run_.stop.stop_requested() && result_.trials > 0) findShares();
    if (!run_.stop.stop_requested() && run_.repeat) repeat();
    if (!run_.stop.stop_requested() && study_.gauge) gauge();
    if (run_.stop.stop_requested()) result_.end = StudyEnd::Interrupted;
    return std::move(result_);
  }

private:
  void warn(std::string message, std::string advice, SourcePlace place) {
    result_.diagnostics.push_back({Severity::Warning, std::move(place), std::move(message), {}, std::move(advice), {}});
  }

  void noteEstimate() {
    if (!estimate_ || estimate_->end == TrialEnd::Finished) return;
    warn("with every source at its estimate the program does not come to its end: " + estimate_->why,
         "run the program on the setup alone first", {study_.file});
  }

  /// What the trial at the estimates answers; null if nothing.
  const Observation* estimateOf(const std::string& key) const {
    if (!estimate_) return nullptr;
    const auto found =
        std::ranges::find_if(estimate_->observations, [&](const Observation& each) { return each.of.key == key; });
    return found == estimate_->observations.end() ? nullptr : &*found;
  }

  void tell(const std::string& phase, std::uint64_t done, std::uint64_t of) const {
    if (run_.report) run_.report(phase, done, of);
  }

  /// An outcome that was kept knows the names of its results only.
  Outcome described(Outcome outcome) const {
    for (Observation& observation : outcome.observations)
      if (const Observation* same = estimateOf(observation.of.key)) observation.of = same->of;
    return outcome;
  }

  void drawTrials() {
    std::vector<Stability> stabilities;
    const std::uint64_t wanted = wantedTrials(study_);
    std::uint64_t nextLook = study_.block, lastLook = 0;
    result_.end = study_.trials ? StudyEnd::AllTrials : StudyEnd::MostTrials;
    while (table_.size() < wanted) {
      const std::uint64_t begin = table_.size();
      const std::uint64_t end = std::min({begin + run_.stretch, wanted, study_.trials ? wanted : nextLook});
      std::vector<Draw> draws;
      for (std::uint64_t trial = begin; trial < end; ++trial)
        draws.push_back(sampler_.draw(trial));
      std::vector<Outcome> outcomes;
      while (begin + outcomes.size() < run_.done.size() && outcomes.size() < draws.size())
        outcomes.push_back(described(run_.done[begin + outcomes.size()]));
      const std::span<const Draw> rest(draws.data() + outcomes.size(), draws.size() - outcomes.size());
      std::vector<Outcome> fresh = crew_(model_, rest);
      const bool any = !fresh.empty();
      std::ranges::move(fresh, std::back_inserter(outcomes));
      for (std::size_t i = 0; i < outcomes.size(); ++i)
        table_.add(draws[i], outcomes[i]);
      if (any && run_.keep) run_.keep(table_);
      if (outcomes.size() < draws.size()) {
        result_.end = StudyEnd::Interrupted;
        return;
      }
      tell("trials", table_.size(), wanted);
      if (study_.trials || table_.size() < nextLook) continue;
      if (isStable(stabilities, lastLook)) {
        result_.end = StudyEnd::Stable;
        return;
      }
      lastLook = nextLook;
      nextLook += study_.block;
    }
  }

  /// Looks at the block of trials from `begin` to the end.
  bool isStable(std::vector<Stability>& stabilities, std::uint64_t begin) {
    bool stable = true;
    stable_.assign(table_.characteristics().size(), false);
    for (std::size_t i = 0; i < table_.characteristics().size(); ++i) {
      if (stabilities.size() <= i) stabilities.emplace_back(study_.digits, study_.coverage);
      stabilities[i].add(std::span(table_.values(i)).subspan(begin));
      stable_[i] = stabilities[i].stable();
      // Trials that come to an alarm tell nothing: a result that is hardly ever there does not hold up the others.
      const std::size_t there = present(table_.values(i)).size();
      if (there * 2 >= table_.size()) stable = stable && stable_[i];
    }
    return stable;
  }

  const Measurand* measurandOf(const std::string& key) const {
    const auto exact = std::ranges::find(study_.measurands, key, &Measurand::result);
    if (exact != study_.measurands.end()) return &*exact;
    for (const Measurand& measurand : study_.measurands)
      if (means(measurand.result, key)) return &measurand;
    return nullptr;
  }

  /// The source whose values are the truth of the measurand.
  std::optional<std::size_t> sourceOf(const Measurand& measurand) const {
    for (std::size_t i = 0; i < study_.sources.size(); ++i)
      if (measurand.truth && study_.sources[i].quantity.text() == measurand.truth->text()) return i;
    return std::nullopt;
  }

  std::optional<double> truthAt(const Measurand& measurand, const std::vector<double>& inputs) const {
    if (!measurand.truth) return std::nullopt;
    const auto source = sourceOf(measurand);
    const auto number = source ? std::optional(inputs[*source]) : measurand.truth->numberIn(setup_);
    return number ? std::optional(measurand.factor * *number + measurand.offset) : std::nullopt;
  }

  /// The true value in each trial; empty if nobody knows it.
  std::vector<double> truthsOf(const Measurand& measurand) const {
    const auto atEstimate = truthAt(measurand, sampler_.estimate().inputs);
    if (!atEstimate) return {};
    const auto source = sourceOf(measurand);
    if (!source) return std::vector<double>(table_.size(), *atEstimate);
    std::vector<double> truths = table_.inputs(*source);
    for (double& truth : truths)
      truth = measurand.factor * truth + measurand.offset;
    return truths;
  }

  /// What the virtual machine knows; empty unless it is the true value of every trial: where it knows only those that
  /// are near, errors would look smaller than they are.
  std::vector<double> truthsOfMachine(std::size_t i) const {
    const std::vector<double>&values = table_.values(i), &truths = table_.truths(i);
    if (truths.empty()) return {};
    for (std::size_t k = 0; k < values.size(); ++k)
      if (!std::isnan(values[k]) && std::isnan(truths[k])) return {};
    return truths;
  }

  Answer answerOf(std::size_t i) {
    Answer answer;
    answer.of = table_.characteristics()[i];
    // What is said of a result may differ a little from trial to trial: that of the estimates counts.
    if (const Observation* estimate = estimateOf(answer.of.key)) {
      answer.of = estimate->of;
      answer.estimate = estimate->value;
    }
    const std::vector<double>& values = table_.values(i);
    answer.values = summarize(values, study_.coverage);
    answer.histogram = histogramOf(values);
    answer.stable = i < stable_.size() && stable_[i];
    answer.standardUncertainty = answer.values.deviation;
    const Measurand* measurand = measurandOf(answer.of.key);
    std::vector<double> truths;
    if (measurand != nullptr) {
      if (measurand->lower) answer.of.lower = measurand->lower;
      if (measurand->upper) answer.of.upper = measurand->upper;
      truths = truthsOf(*measurand);
    }
    if (truths.empty()) truths = truthsOfMachine(i);
    if (!truths.empty()) {
      std::vector<double> errors(values.size());
      std::vector<double> counted;
      for (std::size_t k = 0; k < values.size(); ++k) {
        errors[k] = values[k] - truths[k];
        if (!std::isnan(values[k])) counted.push_back(truths[k]);
      }
      answer.truth = summarize(counted, study_.coverage).mean;
      answer.error = summarize(errors, study_.coverage);
      answer.standardUncertainty = answer.error->deviation;
    }
    if (answer.of.lower || answer.of.upper) judge(answer, values, truths);
    return answer;
  }

  void judge(Answer& answer, const std::vector<double>& values, const std::vector<double>& truths) {
    const Tolerance tolerance{answer.of.lower, answer.of.upper};
    answer.tolerance = tolerance;
    answer.guardBand = study_.guardFactor * answer.standardUncertainty;
    const auto zone = acceptanceZone(tolerance, answer.guardBand);
    if (answer.estimate) {
      answer.conformance = conformanceProbability(*answer.estimate, answer.standardUncertainty, tolerance);
      answer.decision = decide(*answer.estimate, answer.guardBand, tolerance);
    }
    if (truths.empty()) return;
    answer.risks = risksOf(values, truths, tolerance, tolerance);
    if (zone) answer.guardedRisks = risksOf(values, truths, tolerance, *zone);
  }

  void noteMeasurands() {
    for (const Measurand& measurand : study_.measurands) {
      const auto count = std::ranges::count_if(
          result_.answers, [&](const Answer& answer) { return means(measurand.result, answer.of.key); });
      if (count == 0)
        warn(fmt::format("no result of the program is called \"{}\"", measurand.result), "study.json names all results",
             measurand.place);
      if (count > 1 &&
          std::ranges::none_of(result_.answers, [&](const Answer& a) { return a.of.key == measurand.result; }))
        warn(fmt::format("{} results of the program are called \"{}\", and all of them are taken to be meant", count,
                         measurand.result),
             "write cycle and line before it: \"421@23 Q153\"", measurand.place);
    }
  }

  void correlate() {
    constexpr std::size_t most = 200;
    for (std::size_t i = 0; i < result_.answers.size() && result_.correlated.size() < most; ++i)
      if (result_.answers[i].values.deviation > 0) result_.correlated.push_back(i);
    for (const std::size_t a : result_.correlated) {
      auto& row = result_.correlation.emplace_back();
      for (const std::size_t b : result_.correlated)
        row.push_back(a == b ? std::optional(1.0) : correlation(table_.values(a), table_.values(b)));
    }
  }

  void noteStops() {
    constexpr std::size_t mostNamed = 10;
    for (const auto& [why, places] : table_.stops()) {
      Stop stop;
      stop.why = why;
      stop.count = places.size();
      stop.probability = probability(places.size(), table_.size());
      for (std::size_t source = 0; source < study_.sources.size(); ++source) {
        std::vector<double> inputs;
        for (const std::size_t place : places)
          inputs.push_back(table_.inputs(source)[place]);
        stop.sources.push_back(summarize(inputs, study_.coverage));
      }
      for (std::size_t i = 0; i < std::min(mostNamed, places.size()); ++i)
        stop.first.push_back(table_.trials()[places[i]]);
      result_.stops.push_back(std::move(stop));
    }
    std::ranges::stable_sort(result_.stops, std::ranges::greater{}, &Stop::count);
  }

  RunSettings settings(const std::string& phase) const {
    return {crew_, [this, phase](std::uint64_t done, std::uint64_t of) { tell(phase, done, of); }};
  }

  /// The model with errors in place of the values of results whose truth is known: shares are those of u.
  Model erring() const {
    std::map<std::string, const Measurand*> known;
    for (const Answer& answer : result_.answers)
      if (answer.error) known[answer.of.key] = measurandOf(answer.of.key);
    return [this, known](const Draw& draw) {
      Outcome outcome = model_(draw);
      for (Observation& observation : outcome.observations) {
        const auto found = known.find(observation.of.key);
        if (found == known.end()) continue;
        std::optional<double> truth;
        if (found->second != nullptr) truth = truthAt(*found->second, draw.inputs);
        if (!truth) truth = observation.truth;
        observation.value = truth ? observation.value - *truth : missing;
      }
      return outcome;
    };
  }

  /// The random effects of the machine come last among the units.
  void compareWithFirstOrder() {
    for (Answer& answer : result_.answers) {
      const auto& scatter = answer.contributions.back().uncertainty;
      if (!answer.of.firstOrder || !scatter) continue;
      // A standard deviation of n trials is known to 1 / root(2 n); three times that.
      const double unsure = 3 / std::sqrt(2 * static_cast<double>(study_.sensitivityTrials));
      answer.firstOrderHolds = std::abs(*answer.of.firstOrder - *scatter) <= (0.05 + unsure) * *scatter;
    }
  }

  void findShares() {
    const auto& characteristics = table_.characteristics();
    if (study_.sensitivity == Sensitivity::None) return;
    const Model model = erring();
    if (auto found =
            oneAtATime(model, sampler_, characteristics, study_.sensitivityTrials, settings("one source at a time"))) {
      for (std::size_t i = 0; i < result_.answers.size(); ++i)
        result_.answers[i].contributions = std::move((*found)[i]);
      compareWithFirstOrder();
    }
    if (study_.sensitivity != Sensitivity::Sobol || run_.stop.stop_requested()) return;
    if (auto found =
            sobolIndices(model, sampler_, characteristics, study_.sensitivityTrials, settings("Sobol indices"))) {
      for (std::size_t i = 0; i < result_.answers.size(); ++i)
        result_.answers[i].indices = std::move((*found)[i]);
    }
  }

  /// The answers of draws, as a table; nothing if stopped.
  std::optional<TrialTable> extraTrials(const std::vector<Draw>& draws, const std::string& phase) {
    TrialTable table(study_.sources.size());
    for (std::size_t begin = 0; begin < draws.size(); begin += run_.stretch) {
      const std::span<const Draw> part(draws.data() + begin, std::min<std::size_t>(run_.stretch, draws.size() - begin));
      const auto outcomes = crew_(model_, part);
      if (outcomes.size() < part.size()) return std::nullopt;
      for (std::size_t i = 0; i < outcomes.size(); ++i)
        table.add(part[i], outcomes[i]);
      tell(phase, begin + part.size(), draws.size());
    }
    return table;
  }

  static std::optional<double> width(const Answer& answer) {
    if (!answer.of.lower || !answer.of.upper) return std::nullopt;
    return *answer.of.upper - *answer.of.lower;
  }

  void repeat() {
    std::vector<Draw> draws;
    for (std::uint64_t i = 0; i < *run_.repeat; ++i) {
      draws.push_back(sampler_.estimate());
      draws.back().trial = i;
      draws.back().noise = noiseSeed({study_.seed, i, Purpose::Gauge});
    }
    const auto table = extraTrials(draws, "repeats");
    if (!table) return;
    for (Answer& answer : result_.answers) {
      const auto place = table->find(answer.of.key);
      const auto tolerance = width(answer);
      if (!place || !tolerance) continue;
      const Measurand* measurand = measurandOf(answer.of.key);
      auto truth = measurand == nullptr ? std::nullopt : truthAt(*measurand, sampler_.estimate().inputs);
      if (const Observation* estimate = estimateOf(answer.of.key); !truth && estimate != nullptr)
        truth = estimate->truth;
      const double reference = truth.value_or(answer.estimate.value_or(0));
      if (auto made = type1(present(table->values(*place)), reference, *tolerance)) answer.type1 = *made;
    }
  }

  void gauge() {
    const GaugeStudy& plan = *study_.gauge;
    // Sources that belong to a part or an appraiser are drawn once for it; groups share their time of drawing.
    std::vector<Draw> draws;
    for (std::uint64_t p = 0; p < plan.parts; ++p) {
      const Draw part = sampler_.draw(p, Purpose::Gauge);
      for (std::uint64_t a = 0; a < plan.appraisers; ++a) {
        const Draw appraiser = sampler_.draw(plan.parts + a, Purpose::Gauge);
        for (std::uint64_t r = 0; r < plan.repeats; ++r) {
          const std::uint64_t trial = draws.size();
          Draw draw = sampler_.draw(plan.parts + plan.appraisers + trial, Purpose::Gauge);
          draw.trial = trial;
          for (std::size_t i = 0; i < study_.sources.size(); ++i) {
            if (study_.sources[i].drawn == Drawn::EachPart) draw.inputs[i] = part.inputs[i];
            if (study_.sources[i].drawn == Drawn::EachAppraiser) draw.inputs[i] = appraiser.inputs[i];
          }
          draws.push_back(std::move(draw));
        }
      }
    }
    const auto table = extraTrials(draws, "gauge R&R");
    if (!table) return;
    for (Answer& answer : result_.answers) {
      const auto place = table->find(answer.of.key);
      if (!place || !answer.of.main) continue;
      auto made = gaugeRR(table->values(*place), plan.parts, plan.appraisers, plan.repeats, width(answer));
      if (made) {
        answer.gauge = *made;
      } else {
        warn(fmt::format("{}: {}", answer.of.key, made.error().message), made.error().advice, {study_.file});
      }
    }
  }

  const Study& study_;
  const toml::table& setup_;
  const Model& model_;
  const StudyRun& run_;
  Sampler sampler_;
  TrialTable table_;
  Crew crew_;
  std::optional<Outcome> estimate_;
  std::vector<bool> stable_;
  StudyResult result_;
};

}  // namespace

StudyResult runStudy(const Study& study, const toml::table& setup, const Model& model, const StudyRun& run) {
  return Runner(study, setup, model, run).run();
}

}  // namespace probewright::study
