#include "study/run_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <unordered_map>
#include <utility>

#include "study/measurands.hpp"

namespace probewright::study {

namespace {

class Runner {
public:
  Runner(const Study& study, const toml::table& setup, const Model& model, const StudyRun& run)
      : study_(study),
        model_(model),
        run_(run),
        sampler_(study),
        measurands_(study, setup),
        crew_(run.crew ? run.crew : threadCrew(0, run.stop)) {}

  StudyResult run() {
    result_.study = study_;
    result_.units = sampler_.units();
    const Draw estimate = sampler_.estimate();
    const std::vector<Outcome> estimated = crew_(model_, {&estimate, 1});
    if (!estimated.empty()) estimate_ = estimated.front();
    if (estimate_) {
      for (std::size_t i = 0; i < estimate_->observations.size(); ++i)
        placeOfEstimate_.emplace(estimate_->observations[i].of.key, i);
    }
    noteEstimate();
    TrialCourse course(study_, sampler_, model_, crew_,
                       {[this](const Outcome& outcome, const Draw& draw) { return seen(outcome, draw); },
                        [this](const Characteristic& of) { return toleranceOf(describedBy(of)); }},
                       run_);
    result_.end = course.carryOut();
    const Findings findings(course.trials(), sampler_);
    result_.trials = findings.size();
    result_.finished = findings.finished();
    for (std::size_t i = 0; i < findings.characteristics().size(); ++i) {
      result_.answers.push_back(answerOf(findings, i));
      result_.answers.back().stable = course.isStable(findings.characteristics()[i].key);
    }
    noteMeasurands();
    correlate(findings);
    noteStops(findings);
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
    const auto found = placeOfEstimate_.find(key);
    return found == placeOfEstimate_.end() ? nullptr : &estimate_->observations[found->second];
  }

  void tell(const std::string& phase, std::uint64_t done, std::uint64_t of) const {
    if (run_.report) run_.report(phase, done, of);
  }

  /// What is said of a result may differ a little from trial to trial: that of the estimates counts.
  Characteristic describedBy(const Characteristic& of) const {
    const Observation* estimate = estimateOf(of.key);
    return measurands_.limited(estimate != nullptr ? estimate->of : of);
  }

  /// An outcome that was kept knows the names of its results only.
  Outcome described(Outcome outcome) const {
    for (Observation& observation : outcome.observations) {
      if (!observation.of.label.empty()) continue;
      if (const Observation* same = estimateOf(observation.of.key)) observation.of = same->of;
    }
    return outcome;
  }

  /// The outcome as it counts: with what the study says of its results, angles within half a turn of the estimate and
  /// of their true values.
  Outcome seen(const Outcome& outcome, const Draw& draw) const {
    Outcome counted = measurands_.withTruths(described(outcome), draw.inputs);
    for (Observation& observation : counted.observations) {
      const Observation* estimate = estimateOf(observation.of.key);
      if (estimate == nullptr || estimate->of.unit != "deg") continue;
      observation.value = withinHalfATurn(observation.value, estimate->value);
      if (observation.truth) observation.truth = withinHalfATurn(*observation.truth, observation.value);
    }
    return counted;
  }

  static double withinHalfATurn(double angle, double of) {
    return std::abs(angle - of) > 180 ? angle - 360 * std::round((angle - of) / 360) : angle;
  }

  Answer answerOf(const Findings& findings, std::size_t i) const {
    Answer answer;
    answer.of = describedBy(findings.characteristics()[i]);
    if (const Observation* estimate = estimateOf(answer.of.key)) answer.estimate = estimate->value;
    answer.corrected = answer.estimate;
    answer.values = findings.values(i, study_.coverage);
    answer.histogram = findings.histogram(i);
    answer.standardUncertainty = answer.values.deviation;
    answer.symmetric = answer.values.symmetric;
    answer.shortest = answer.values.shortest;
    answer.error = findings.errors(i, study_.coverage);
    if (answer.error) {
      answer.errorHistogram = findings.errorHistogram(i);
      answer.truths = findings.truths(i);
      answer.standardUncertainty = answer.error->deviation;
      if (answer.estimate) answer.corrected = *answer.estimate - answer.error->mean;
      // What is too large by an error has a true value that is smaller by it.
      const auto behind = [&](const std::optional<Interval>& errors) -> std::optional<Interval> {
        if (!errors || !answer.estimate) return std::nullopt;
        return Interval{*answer.estimate - errors->high, *answer.estimate - errors->low};
      };
      answer.symmetric = behind(answer.error->symmetric);
      answer.shortest = behind(answer.error->shortest);
    }
    if (answer.values.count < 2) answer.standardUncertainty = missing;
    if (const auto tolerance = toleranceOf(answer.of)) judge(answer, findings, i, *tolerance);
    return answer;
  }

  void judge(Answer& answer, const Findings& findings, std::size_t i, const Tolerance& tolerance) const {
    answer.tolerance = tolerance;
    if (std::isnan(answer.standardUncertainty)) return;
    answer.guardBand = study_.guardFactor * answer.standardUncertainty;
    const auto zone = acceptanceZone(tolerance, answer.guardBand);
    if (answer.corrected) {
      answer.conformance = conformanceProbability(*answer.corrected, answer.standardUncertainty, tolerance);
      answer.decision = decide(*answer.corrected, answer.guardBand, tolerance);
    }
    if (!answer.error) return;
    answer.risks = findings.risks(i, tolerance);
    if (zone) answer.guardedRisks = findings.guardedRisks(i, tolerance, *zone);
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

  void correlate(const Findings& findings) {
    for (std::size_t i = 0; i < std::min(result_.answers.size(), Grid::mostCorrelated); ++i)
      if (result_.answers[i].values.deviation > 0) result_.correlated.push_back(i);
    const std::size_t count = result_.correlated.size();
    result_.correlation.assign(count, std::vector(count, std::optional(1.0)));
    for (std::size_t a = 0; a < count; ++a) {
      for (std::size_t b = a + 1; b < count; ++b)
        result_.correlation[a][b] = result_.correlation[b][a] =
            findings.correlation(result_.correlated[a], result_.correlated[b]);
    }
  }

  void noteStops(const Findings& findings) {
    constexpr std::size_t mostNamed = 10;
    const TrialTable& table = findings.kept();
    const std::vector<Tenths> drawn = table.stops().empty() ? std::vector<Tenths>() : tenthsOf(findings.size());
    for (const auto& [why, places] : table.stops()) {
      Stop stop;
      stop.why = why;
      stop.count = places.size();
      stop.probability = probability(places.size(), findings.size());
      for (std::size_t source = 0; source < study_.sources.size(); ++source) {
        std::vector<double> inputs;
        for (const std::size_t place : places)
          inputs.push_back(table.inputs(source)[place]);
        stop.sources.push_back(summarize(inputs, study_.coverage));
        stop.tenths.push_back(drawn[source]);
        for (const double input : inputs)
          ++stop.tenths.back().stopped[drawn[source].placeOf(input)];
      }
      for (std::size_t i = 0; i < std::min(mostNamed, places.size()); ++i)
        stop.first.push_back(table.trials()[places[i]]);
      result_.stops.push_back(std::move(stop));
    }
    std::ranges::stable_sort(result_.stops, std::ranges::greater{}, &Stop::count);
  }

  /// What the sources were in so many trials, the first ones. They are drawn again: sums do not hold them.
  std::vector<Tenths> tenthsOf(std::uint64_t trials) const {
    std::vector<Tenths> tenths(study_.sources.size());
    for (Tenths& each : tenths)
      each = {INFINITY, -INFINITY, {}, {}};
    const auto eachInput = [&](const auto& done) {
      for (std::uint64_t trial = 0; trial < trials; ++trial) {
        const Draw draw = sampler_.draw(trial);
        for (std::size_t i = 0; i < tenths.size(); ++i)
          done(tenths[i], draw.inputs[i]);
      }
    };
    eachInput([](Tenths& of, double value) {
      of.low = std::min(of.low, value);
      of.high = std::max(of.high, value);
    });
    eachInput([](Tenths& of, double value) { ++of.trials[of.placeOf(value)]; });
    return tenths;
  }

  RunSettings settings(const std::string& phase) const {
    return {crew_, [this, phase](std::uint64_t done, std::uint64_t of) { tell(phase, done, of); }};
  }

  /// The model with errors in place of the values of results whose truth is known: shares are those of u.
  Model erring() const {
    std::set<std::string> known;
    for (const Answer& answer : result_.answers)
      if (answer.error) known.insert(answer.of.key);
    return [this, known](const Draw& draw) {
      Outcome outcome = seen(model_(draw), draw);
      for (Observation& observation : outcome.observations)
        if (known.contains(observation.of.key))
          observation.value = observation.truth ? observation.value - *observation.truth : missing;
      return outcome;
    };
  }

  void findShares() {
    std::vector<Characteristic> characteristics;
    for (const Answer& answer : result_.answers)
      characteristics.push_back(answer.of);
    if (study_.sensitivity == Sensitivity::None) return;
    const Model model = erring();
    if (auto found =
            oneAtATime(model, sampler_, characteristics, study_.sensitivityTrials, settings("one source at a time"))) {
      for (std::size_t i = 0; i < result_.answers.size(); ++i)
        result_.answers[i].contributions = std::move((*found)[i]);
      const auto verdicts = compareWithFirstOrder(model, sampler_, characteristics, study_.sensitivityTrials,
                                                  settings("the scatter of the probe alone"));
      for (std::size_t i = 0; verdicts && i < result_.answers.size(); ++i)
        result_.answers[i].firstOrder = (*verdicts)[i];
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
        table.add(part[i], seen(outcomes[i], part[i]));
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
      auto truth = measurands_.truthAt(answer.of.key, sampler_.estimate().inputs);
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
  const Model& model_;
  const StudyRun& run_;
  Sampler sampler_;
  Measurands measurands_;
  Crew crew_;
  std::optional<Outcome> estimate_;
  std::unordered_map<std::string, std::size_t> placeOfEstimate_;  ///< by key
  StudyResult result_;
};

}  // namespace

std::size_t Tenths::placeOf(double value) const {
  if (!(high > low)) return 0;
  return static_cast<std::size_t>(std::clamp(std::floor((value - low) / (high - low) * 10), 0.0, 9.0));
}

StudyResult runStudy(const Study& study, const toml::table& setup, const Model& model, const StudyRun& run) {
  return Runner(study, setup, model, run).run();
}

}  // namespace probewright::study
