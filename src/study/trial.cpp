#include "study/trial.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <utility>

namespace probewright::study {

Sampler::Sampler(const Study& study) : Sampler(study.sources, study.groups, study.seed) {}

Sampler::Sampler(std::vector<Source> sources, std::vector<Group> groups, std::uint64_t seed)
    : sources_(std::move(sources)), groups_(std::move(groups)), seed_(seed) {
  findUnits();
}

void Sampler::findUnits() {
  std::vector<bool> grouped(sources_.size());
  for (const Group& group : groups_) {
    units_.push_back({group.name, group.sources});
    for (const std::size_t source : group.sources)
      grouped[source] = true;
  }
  for (std::size_t i = 0; i < sources_.size(); ++i)
    if (!grouped[i]) units_.push_back({sources_[i].name, {i}});
  units_.push_back({"random effects of the machine", {}});
}

Draw Sampler::draw(std::uint64_t trial, Purpose purpose) const {
  const Stream stream{seed_, trial, purpose};
  Draw draw{trial, std::vector<double>(sources_.size()), noiseSeed(stream)};
  for (std::size_t i = 0; i < sources_.size(); ++i)
    draw.inputs[i] = sources_[i].distribution.value(uniforms(stream, static_cast<std::uint32_t>(i)));
  for (const Group& group : groups_) {
    Eigen::VectorXd scores(static_cast<Eigen::Index>(group.sources.size()));
    for (std::size_t i = 0; i < group.sources.size(); ++i) {
      const double u = uniforms(stream, static_cast<std::uint32_t>(group.sources[i]))[0];
      scores[static_cast<Eigen::Index>(i)] = boost::math::quantile(boost::math::normal(), u);
    }
    scores = (group.factor * scores).eval();
    for (std::size_t i = 0; i < group.sources.size(); ++i) {
      const std::size_t source = group.sources[i];
      draw.inputs[source] = sources_[source].distribution.valueOfScore(scores[static_cast<Eigen::Index>(i)]);
    }
  }
  return draw;
}

Draw Sampler::estimate() const {
  Draw draw;
  for (const Source& source : sources_)
    draw.inputs.push_back(source.distribution.estimate());
  return draw;
}

std::size_t TrialTable::placeOf(const Characteristic& characteristic, std::size_t trials) {
  const auto [found, isNew] = places_.try_emplace(characteristic.key, characteristics_.size());
  if (isNew) {
    characteristics_.push_back(characteristic);
    values_.emplace_back(trials, missing);
    truths_.emplace_back();
  }
  return found->second;
}

void TrialTable::add(const Draw& draw, const Outcome& outcome) {
  const std::size_t place = trials_.size();
  std::size_t next = 0;  // most trials answer in the order of those before
  for (const Observation& observation : outcome.observations) {
    if (next >= characteristics_.size() || characteristics_[next].key != observation.of.key)
      next = placeOf(observation.of, place);
    std::vector<double>& column = values_[next];
    column.resize(place, missing);
    column.push_back(observation.value);
    if (observation.truth) {
      truths_[next].resize(place, missing);
      truths_[next].push_back(*observation.truth);
    }
    ++next;
  }
  for (std::vector<double>& column : values_)
    column.resize(place + 1, missing);
  for (std::vector<double>& column : truths_)
    if (!column.empty()) column.resize(place + 1, missing);
  for (std::size_t i = 0; i < inputs_.size(); ++i)
    inputs_[i].push_back(i < draw.inputs.size() ? draw.inputs[i] : missing);
  trials_.push_back(draw.trial);
  ends_.push_back(outcome.end);
  if (outcome.end != TrialEnd::Finished) stops_[outcome.why].push_back(place);
}

std::optional<std::size_t> TrialTable::find(const std::string& key) const {
  const auto found = places_.find(key);
  return found == places_.end() ? std::nullopt : std::optional(found->second);
}

std::vector<Outcome> runTrials(const Model& model, std::span<const Draw> draws, int threads,
                               const std::stop_token& stop) {
  std::vector<Outcome> outcomes(draws.size());
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, draws.size(), [&](std::size_t i) {
      outcomes[i].end = TrialEnd::Cancelled;
      if (!stop.stop_requested()) outcomes[i] = model(draws[i]);
    });
  });
  const auto cancelled = std::ranges::find(outcomes, TrialEnd::Cancelled, &Outcome::end);
  outcomes.erase(cancelled, outcomes.end());
  return outcomes;
}

}  // namespace probewright::study
