#include "study/trial_course.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "study/message.hpp"

namespace probewright::study {

namespace {

/// The grid is made of so many trials, whoever carries them out.
constexpr std::uint64_t firstTrials = 500;

std::uint64_t wantedTrials(const Study& study) { return study.trials.value_or(study.mostTrials); }

void put(std::string& message, const Summary& summary) {
  putCount(message, summary.count);
  for (const double value : {summary.mean, summary.deviation, summary.minimum, summary.maximum, summary.median})
    study::put(message, value);
  for (const auto& interval : {summary.symmetric, summary.shortest}) {
    study::put(message, static_cast<std::uint8_t>(interval ? 1 : 0));
    if (interval) study::put(message, *interval);
  }
}

Summary getSummary(MessageReading& reading) {
  Summary summary;
  summary.count = reading.count();
  for (double* value : {&summary.mean, &summary.deviation, &summary.minimum, &summary.maximum, &summary.median})
    *value = reading.get<double>();
  for (auto* interval : {&summary.symmetric, &summary.shortest})
    if (reading.get<std::uint8_t>() == 1) *interval = reading.get<Interval>();
  return summary;
}

}  // namespace

TrialCourse::TrialCourse(const Study& study, const Sampler& sampler, const Model& model, Crew crew, Sees sees,
                         const CourseRun& run)
    : study_(study),
      sampler_(sampler),
      model_(model),
      crew_(std::move(crew)),
      sees_(std::move(sees)),
      run_(run),
      nextLook_(study.block) {}

void TrialCourse::add(const Draw& draw, const Outcome& outcome) {
  Outcome seen = sees_.outcome(outcome, draw);
  if (draw.trial < firstTrials) first_.add(draw.trial, seen);
  block_.add(draw.trial, std::move(seen));
}

void TrialCourse::findGrid() {
  if (grid_ || first_.size() < firstTrials) return;
  grid_ = gridOf(Findings(first_, sampler_).kept(), sees_.limits);
  for (TrialSummary* sum : {&total_, &block_}) {
    TrialSummary onGrid(grid_);
    onGrid.merge(*sum);
    *sum = std::move(onGrid);
  }
}

bool TrialCourse::drawValues(std::uint64_t begin, std::uint64_t end) {
  std::vector<Draw> draws;
  for (std::uint64_t trial = begin; trial < end; ++trial)
    draws.push_back(sampler_.draw(trial));
  std::vector<Outcome> outcomes;
  while (run_.done && !doneIsRead_ && outcomes.size() < draws.size()) {
    auto done = run_.done();
    doneIsRead_ = !done;
    if (done) outcomes.push_back(*std::move(done));
  }
  const std::size_t old = outcomes.size();
  if (old < draws.size()) std::ranges::move(crew_(model_, std::span(draws).subspan(old)), std::back_inserter(outcomes));
  for (std::size_t i = 0; i < outcomes.size(); ++i)
    add(draws[i], outcomes[i]);
  findGrid();
  if (outcomes.size() > old && run_.keep)
    run_.keep(std::span(draws).subspan(old, outcomes.size() - old), std::span(outcomes).subspan(old));
  return outcomes.size() == draws.size();
}

bool TrialCourse::drawSums(std::uint64_t begin, std::uint64_t end) {
  const Summing& summing = *run_.summing;
  const auto size = static_cast<std::uint64_t>(summing.ranks.size),
             rank = static_cast<std::uint64_t>(summing.ranks.rank);
  std::vector<Draw> draws;
  for (std::uint64_t trial = begin + (end - begin) * rank / size; trial < begin + (end - begin) * (rank + 1) / size;
       ++trial)
    draws.push_back(sampler_.draw(trial));
  const std::vector<Outcome> outcomes = summing.mine(model_, draws);
  TrialSummary mine(grid_);
  for (std::size_t i = 0; i < outcomes.size(); ++i)
    mine.add(draws[i].trial, sees_.outcome(outcomes[i], draws[i]));
  // A stretch counts whole or not at all.
  const bool whole = outcomes.size() == draws.size();
  const std::vector<std::string> messages = summing.ranks.exchange(whole ? mine.message() : "");
  if (std::ranges::any_of(messages, &std::string::empty)) {
    std::stop_source(summing.all).request_stop();
    return false;
  }
  for (const std::string& message : messages)
    block_.merge(TrialSummary::read(message, grid_));
  return true;
}

TrialCourse::Digits& TrialCourse::digitsOf(const std::string& key) {
  const Stability none(study_.digits, study_.coverage);
  return stabilities_.try_emplace(key, Digits{none, none}).first->second;
}

/// Looks at the trials since the last look.
void TrialCourse::look() {
  const Findings since(block_, sampler_);
  for (std::size_t i = 0; i < since.characteristics().size(); ++i) {
    Digits& digits = digitsOf(since.characteristics()[i].key);
    digits.values.add(since.values(i, study_.coverage));
    if (const auto errors = since.errors(i, study_.coverage)) digits.errors.add(*errors);
  }
  total_.merge(block_);
  block_ = TrialSummary(grid_);
}

/// What the trials up to the last look say of the digits: whether the study ends with them.
std::optional<StudyEnd> TrialCourse::verdict() {
  const Findings whole(total_, sampler_);
  std::uint64_t most = 0;
  for (std::size_t i = 0; i < whole.characteristics().size(); ++i)
    most = std::max(most, whole.count(i));
  bool stable = most > 0;
  stable_.clear();
  for (std::size_t i = 0; i < whole.characteristics().size(); ++i) {
    const std::string& key = whole.characteristics()[i].key;
    const auto found = stabilities_.find(key);
    const bool isStable =
        found != stabilities_.end() && (whole.truthIsKnown(i) ? found->second.errors : found->second.values).stable();
    if (isStable) stable_.insert(key);
    // Trials that come to an alarm tell nothing: a result that is hardly ever there does not hold up the others.
    if (whole.count(i) * 2 >= most) stable = stable && isStable;
  }
  if (study_.trials) return std::nullopt;
  if (whole.finished() == 0) return StudyEnd::NoResult;
  return stable ? std::optional(StudyEnd::Stable) : std::nullopt;
}

std::string TrialCourse::state() const {
  std::string state;
  putCount(state, nextLook_);
  for (const TrialSummary* sum : {&first_, &total_, &block_})
    study::put(state, sum->message());
  putCount(state, stabilities_.size());
  for (const auto& [key, digits] : stabilities_) {
    study::put(state, key);
    for (const Stability* stability : {&digits.values, &digits.errors}) {
      putCount(state, stability->blocks().size());
      for (const Summary& block : stability->blocks())
        put(state, block);
    }
  }
  return state;
}

void TrialCourse::restore(const std::string& state) {
  MessageReading reading(state);
  nextLook_ = reading.count();
  first_ = TrialSummary::read(reading.text(), nullptr);
  findGrid();
  total_ = TrialSummary::read(reading.text(), grid_);
  block_ = TrialSummary::read(reading.text(), grid_);
  const std::uint64_t keys = reading.count();
  for (std::uint64_t i = 0; i < keys; ++i) {
    const std::string key = reading.text();
    Digits& digits = digitsOf(key);
    for (Stability* stability : {&digits.values, &digits.errors}) {
      const std::uint64_t blocks = reading.count();
      for (std::uint64_t k = 0; k < blocks; ++k)
        stability->add(getSummary(reading));
    }
  }
}

StudyEnd TrialCourse::carryOut() {
  if (!run_.state.empty()) restore(run_.state);
  const std::uint64_t wanted = wantedTrials(study_);
  StudyEnd end = study_.trials ? StudyEnd::AllTrials : StudyEnd::MostTrials;
  std::optional<StudyEnd> ended;
  // The earlier run may have come to its end, or to its last look.
  if (total_.size() > 0) ended = verdict();
  if (block_.size() > 0) ended.reset();
  while (!ended && size() < wanted) {
    const std::uint64_t begin = size();
    const bool sums = run_.summing && grid_;
    std::uint64_t until = std::min(begin + (sums ? run_.summing->stretch : run_.stretch), wanted);
    until = std::min(until, nextLook_);
    if (begin < firstTrials) until = std::min(until, firstTrials);
    if (!(sums ? drawSums(begin, until) : drawValues(begin, until))) {
      end = StudyEnd::Interrupted;
      break;
    }
    if (run_.report) run_.report("trials", size(), wanted);
    if (size() >= nextLook_) {
      nextLook_ += study_.block;
      look();
      ended = verdict();
    }
    if (run_.summing && grid_ && run_.keepState) run_.keepState(state());
  }
  total_.merge(block_);
  block_ = TrialSummary(grid_);
  if (ended) return *ended;
  if (end == StudyEnd::MostTrials && Findings(total_, sampler_).finished() == 0) return StudyEnd::NoResult;
  return end;
}

}  // namespace probewright::study
