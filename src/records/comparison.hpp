#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostic.hpp"

/// What two runs measured, side by side: the same program before and after a change, on two machines, on two parts.
namespace probewright::records {

/// A value that at least one of the two runs has.
struct ComparedValue {
  std::string name;                     ///< where the control left it: "Q153"
  std::string meaning, unit;            ///< of the first run that has it
  bool main = false;                    ///< answers what the cycle was called for
  std::optional<double> first, second;  ///< nothing: that run has no such value, or it is not a number
  std::string firstVerdict, secondVerdict;
  bool differs = false;

  std::optional<double> difference() const { return first && second ? std::optional(*second - *first) : std::nullopt; }
};

/// What stands in one entry of a table in the end; empty: the run has not written there.
struct ComparedEntry {
  std::string table, entry;
  std::string first, second;
  bool differs = false;
};

/// A call of a cycle in the one run and the same call in the other.
struct ComparedCycle {
  std::string name, title;
  std::string firstPlace, secondPlace;  ///< "PLATE.H:12"; empty: that run does not have the call
  std::string firstAlarm, secondAlarm;  ///< that ended the call; empty: none
  std::vector<ComparedValue> values;

  bool inBoth() const { return !firstPlace.empty() && !secondPlace.empty(); }
  bool differs() const;
};

struct ComparedFact {
  std::string name, first, second;  ///< "seed", "1", "7"
};

struct Comparison {
  std::vector<ComparedFact> facts;  ///< about the runs as a whole, only those that differ
  std::vector<ComparedCycle> cycles;
  std::vector<ComparedEntry> entries;
  std::size_t values = 0;     ///< that both runs have
  std::size_t differing = 0;  ///< of these
  double largest = 0;         ///< difference of a length or angle
  bool alike() const;
};

/// Compares two documents of the layout docs/results.schema.json. Calls are paired in their order by the name of the
/// cycle; where one run has calls that the other lacks, so that as many as possible have a partner. Numbers count as
/// equal if they differ by at most `tolerance` (mm, degrees). Fails on a document of another layout, naming `first` or
/// `second`.
Result<Comparison> compare(const nlohmann::json& first, const nlohmann::json& second, double tolerance);

/// The comparison as a document for other programs.
nlohmann::ordered_json comparisonJson(const Comparison& comparison);

}  // namespace probewright::records
