#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "study/trial.hpp"

/// Who carries out trials: the threads of one process, or processes that work together.
namespace probewright::study {

/// Answers in the order of the draws, the same whoever carries them out; cut off at the first that a stop has caught.
using Crew = std::function<std::vector<Outcome>(const Model& model, std::span<const Draw> draws)>;

Crew threadCrew(int threads, std::stop_token stop);

/// How processes that run the same study exchange what they have: each gets the messages of all, by rank.
struct Ranks {
  int rank = 0, size = 1;
  std::function<std::vector<std::string>(const std::string& mine)> exchange;
};

/// Each rank carries out its share of the draws, and all ranks get all answers. A stop of any of them, by `mine`, ends
/// the study of all: then `all` is asked to stop on each rank after the same trial.
Crew rankCrew(Ranks ranks, int threads, std::stop_token mine, std::stop_source all);

/// Answers as a message between ranks. Names are sent once: both ends remember those of earlier messages.
class OutcomeWriter {
public:
  std::string write(std::span<const Outcome> outcomes);

private:
  std::map<std::string, std::uint32_t> known_;
};
class OutcomeReader {
public:
  std::vector<Outcome> read(const std::string& message);

private:
  std::vector<Characteristic> known_;
};

}  // namespace probewright::study
