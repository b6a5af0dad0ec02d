#include "study/crew.hpp"

#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>

#include "study/message.hpp"

namespace probewright::study {

Crew threadCrew(int threads, std::stop_token stop) {
  return [threads, stop = std::move(stop)](const Model& model, std::span<const Draw> draws) {
    return runTrials(model, draws, threads, stop);
  };
}

std::string OutcomeWriter::write(std::span<const Outcome> outcomes) {
  std::string message;
  put(message, static_cast<std::uint32_t>(outcomes.size()));
  for (const Outcome& outcome : outcomes) {
    put(message, static_cast<std::uint8_t>(outcome.end));
    put(message, outcome.why);
    put(message, static_cast<std::uint32_t>(outcome.observations.size()));
    for (const Observation& observation : outcome.observations) {
      const auto [found, isNew] = known_.try_emplace(observation.of.key, static_cast<std::uint32_t>(known_.size()));
      put(message, found->second);
      if (isNew) {
        const Characteristic& of = observation.of;
        put(message, of.key);
        put(message, of.label);
        put(message, of.unit);
        put(message, static_cast<std::uint8_t>(of.main ? 1 : 0));
        put(message, static_cast<std::uint8_t>(of.table ? 1 : 0));
        for (const auto& limit : {of.nominal, of.lower, of.upper, of.firstOrder})
          put(message, limit);
      }
      put(message, observation.value);
      put(message, observation.truth);
    }
  }
  return message;
}

std::vector<Outcome> OutcomeReader::read(const std::string& message) {
  MessageReading reading(message);
  std::vector<Outcome> outcomes(reading.get<std::uint32_t>());
  for (Outcome& outcome : outcomes) {
    outcome.end = static_cast<TrialEnd>(reading.get<std::uint8_t>());
    outcome.why = reading.text();
    const auto count = reading.get<std::uint32_t>();
    for (std::uint32_t i = 0; i < count; ++i) {
      const auto place = reading.get<std::uint32_t>();
      if (place == known_.size()) {
        Characteristic of;
        of.key = reading.text();
        of.label = reading.text();
        of.unit = reading.text();
        of.main = reading.get<std::uint8_t>() == 1;
        of.table = reading.get<std::uint8_t>() == 1;
        for (auto* limit : {&of.nominal, &of.lower, &of.upper, &of.firstOrder})
          *limit = reading.optional();
        known_.push_back(std::move(of));
      }
      Observation observation;
      observation.of = known_.at(place);
      observation.value = reading.get<double>();
      observation.truth = reading.optional();
      outcome.observations.push_back(std::move(observation));
    }
  }
  return outcomes;
}

Crew rankCrew(Ranks ranks, int threads, std::stop_token mine, std::stop_source all) {
  struct State {
    Ranks ranks;
    OutcomeWriter writer;
    std::vector<OutcomeReader> readers;
  };
  const auto state = std::make_shared<State>();
  state->readers.resize(static_cast<std::size_t>(ranks.size));
  state->ranks = std::move(ranks);
  return [state, threads, mine = std::move(mine), all = std::move(all)](const Model& model,
                                                                        std::span<const Draw> draws) mutable {
    const auto size = static_cast<std::size_t>(state->ranks.size), rank = static_cast<std::size_t>(state->ranks.rank);
    const auto shareBegin = [&](std::size_t of) { return draws.size() * of / size; };
    const auto share = draws.subspan(shareBegin(rank), shareBegin(rank + 1) - shareBegin(rank));
    const std::vector<Outcome> done = runTrials(model, share, threads, mine);
    const std::vector<std::string> messages = state->ranks.exchange(state->writer.write(done));
    std::vector<Outcome> outcomes;
    bool whole = true;
    for (std::size_t of = 0; of < size; ++of) {
      std::vector<Outcome> part = state->readers[of].read(messages.at(of));
      const bool wholePart = part.size() == shareBegin(of + 1) - shareBegin(of);
      if (whole) std::ranges::move(part, std::back_inserter(outcomes));
      whole = whole && wholePart;
    }
    if (!whole) all.request_stop();
    return outcomes;
  };
}

}  // namespace probewright::study
