#include "records/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <utility>

#include "records/results.hpp"

namespace probewright::records {

namespace {

using Json = nlohmann::json;
using nlohmann::ordered_json;

std::string placeOf(const Json& cycle) {
  const Json& place = cycle.at("place");
  return std::filesystem::path(place.at("file").get<std::string>()).filename().string() + ":" +
         std::to_string(place.at("line").get<std::uint64_t>());
}

/// Pairs of indices, in order; one of them is missing where a call has no partner.
using Pairs = std::vector<std::pair<std::optional<std::size_t>, std::optional<std::size_t>>>;

/// The longest common subsequence of the names between the equal beginning and the equal end.
Pairs pairedByName(const std::vector<std::string>& first, const std::vector<std::string>& second) {
  std::size_t head = 0, tail = 0;
  const std::size_t least = std::min(first.size(), second.size());
  while (head < least && first[head] == second[head])
    ++head;
  while (tail < least - head && first[first.size() - 1 - tail] == second[second.size() - 1 - tail])
    ++tail;
  Pairs pairs;
  for (std::size_t i = 0; i < head; ++i)
    pairs.emplace_back(i, i);
  const std::size_t rows = first.size() - head - tail, columns = second.size() - head - tail;
  constexpr std::size_t most = 16'000'000;  // entries of the table below
  std::size_t i = 0, j = 0;
  if (rows > 0 && columns > 0 && rows <= most / columns) {
    std::vector<std::uint32_t> common((rows + 1) * (columns + 1), 0);
    const auto at = [&](std::size_t row, std::size_t column) -> std::uint32_t& {
      return common[row * (columns + 1) + column];
    };
    const auto same = [&](std::size_t row, std::size_t column) { return first[head + row] == second[head + column]; };
    for (std::size_t row = rows; row-- > 0;)
      for (std::size_t column = columns; column-- > 0;)
        at(row, column) =
            same(row, column) ? at(row + 1, column + 1) + 1 : std::max(at(row + 1, column), at(row, column + 1));
    while (i < rows && j < columns) {
      if (same(i, j)) {
        pairs.emplace_back(head + i++, head + j++);
      } else if (at(i + 1, j) >= at(i, j + 1)) {
        pairs.emplace_back(head + i++, std::nullopt);
      } else {
        pairs.emplace_back(std::nullopt, head + j++);
      }
    }
  }
  for (; i < rows; ++i)
    pairs.emplace_back(head + i, std::nullopt);
  for (; j < columns; ++j)
    pairs.emplace_back(std::nullopt, head + j);
  for (std::size_t k = tail; k > 0; --k)
    pairs.emplace_back(first.size() - k, second.size() - k);
  return pairs;
}

std::vector<std::string> namesOf(const Json& cycles) {
  std::vector<std::string> names;
  for (const Json& cycle : cycles)
    names.push_back(cycle.at("name"));
  return names;
}

std::optional<double> valueOf(const Json& result) {
  const Json& value = result.at("value");
  return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
}

ComparedCycle compared(const Json* first, const Json* second, double tolerance) {
  const Json& any = first != nullptr ? *first : *second;
  ComparedCycle cycle;
  cycle.name = any.at("name");
  cycle.title = any.at("title");
  const auto takeIn = [&](const Json* from, std::string& place, std::string& alarm,
                          std::optional<double> ComparedValue::*value, std::string ComparedValue::*verdict) {
    if (from == nullptr) return;
    place = placeOf(*from);
    alarm = from->value("alarm", std::string());
    for (const Json& result : from->at("results")) {
      const std::string name = result.at("name");
      auto found = std::ranges::find(cycle.values, name, &ComparedValue::name);
      if (found == cycle.values.end()) {
        ComparedValue added;
        added.name = name;
        added.meaning = result.at("meaning");
        added.unit = result.at("unit");
        added.main = result.at("main");
        cycle.values.push_back(std::move(added));
        found = cycle.values.end() - 1;
      }
      (*found).*value = valueOf(result);
      (*found).*verdict = result.at("verdict");
    }
  };
  takeIn(first, cycle.firstPlace, cycle.firstAlarm, &ComparedValue::first, &ComparedValue::firstVerdict);
  takeIn(second, cycle.secondPlace, cycle.secondAlarm, &ComparedValue::second, &ComparedValue::secondVerdict);
  for (ComparedValue& value : cycle.values) {
    const bool apart = value.first.has_value() != value.second.has_value() ||
                       (value.first && !(std::abs(*value.second - *value.first) <= tolerance));
    value.differs = apart || value.firstVerdict != value.secondVerdict;
  }
  return cycle;
}

using Entries = std::map<std::pair<std::string, std::string>, std::string>;

/// What each entry of the tables holds after the last write.
Entries entriesOf(const Json& run) {
  Entries entries;
  const auto take = [&](const Json& writes) {
    for (const Json& write : writes)
      entries[{write.at("table"), write.at("entry")}] = write.at("after");
  };
  take(run.at("writes"));
  for (const Json& cycle : run.at("cycles"))
    take(cycle.at("writes"));
  return entries;
}

/// Equal as texts, or as numbers within the tolerance.
bool equalTexts(const std::string& first, const std::string& second, double tolerance) {
  if (first == second) return true;
  const auto number = [](const std::string& text) -> std::optional<double> {
    std::size_t read = 0;
    try {
      const double value = std::stod(text, &read);
      return read == text.size() ? std::optional(value) : std::nullopt;
    } catch (const std::exception&) {
      return std::nullopt;
    }
  };
  const auto a = number(first), b = number(second);
  return a && b && std::abs(*b - *a) <= tolerance;
}

std::vector<ComparedFact> factsOf(const Json& first, const Json& second) {
  std::vector<ComparedFact> facts;
  const auto tell = [&](const char* name, const std::string& a, const std::string& b) {
    if (a != b) facts.push_back({name, a, b});
  };
  const auto text = [](const Json& value) {
    return value.is_string() ? value.get<std::string>() : value.is_null() ? std::string() : value.dump();
  };
  const auto ofRun = [&](const char* name, const char* key) {
    tell(name, text(first.at("run").value(key, Json())), text(second.at("run").value(key, Json())));
  };
  ofRun("control", "control");
  ofRun("machine", "machine");
  ofRun("seed", "seed");
  ofRun("version of Probewright", "version");
  const auto part = [&](const Json& run) { return text(run.at("run").at("part").at("name")); };
  tell("part", part(first), part(second));
  const auto end = [&](const Json& run) {
    const Json& exit = run.at("run").at("exit");
    const std::string why = exit.value("text", std::string());
    return exit.at("state").get<std::string>() + (why.empty() ? "" : ": " + why);
  };
  tell("end", end(first), end(second));
  for (const char* total : {"touches", "failedTouches"})
    tell(total == std::string("touches") ? "touches" : "failed touches", text(first.at("totals").at(total)),
         text(second.at("totals").at(total)));
  return facts;
}

Result<void> known(const Json& document, const char* which) {
  const bool results =
      document.is_object() && document.contains("schema") && document["schema"] == "probewright results";
  if (!results) return fail(std::string(which) + " is not a results.json of Probewright");
  if (!document.contains("schemaVersion") || document["schemaVersion"] != resultsSchemaVersion)
    return fail(std::string(which) + " has another layout than this version writes");
  return {};
}

}  // namespace

bool ComparedCycle::differs() const {
  return !inBoth() || firstAlarm != secondAlarm || std::ranges::any_of(values, &ComparedValue::differs);
}

bool Comparison::alike() const {
  return facts.empty() && std::ranges::none_of(cycles, &ComparedCycle::differs) &&
         std::ranges::none_of(entries, &ComparedEntry::differs);
}

Result<Comparison> compare(const Json& first, const Json& second, double tolerance) {
  if (auto fine = known(first, "the first"); !fine) return tl::unexpected(fine.error());
  if (auto fine = known(second, "the second"); !fine) return tl::unexpected(fine.error());
  Comparison comparison;
  try {
    comparison.facts = factsOf(first, second);
    const Json &a = first.at("cycles"), &b = second.at("cycles");
    for (const auto& [left, right] : pairedByName(namesOf(a), namesOf(b))) {
      comparison.cycles.push_back(compared(left ? &a[*left] : nullptr, right ? &b[*right] : nullptr, tolerance));
      const ComparedCycle& cycle = comparison.cycles.back();
      if (!cycle.inBoth()) continue;
      for (const ComparedValue& value : cycle.values) {
        if (!value.first || !value.second) continue;
        ++comparison.values;
        if (value.differs) ++comparison.differing;
        if (!value.unit.empty()) comparison.largest = std::max(comparison.largest, std::abs(*value.difference()));
      }
    }
    const Entries before = entriesOf(first), after = entriesOf(second);
    Entries all = before;
    all.insert(after.begin(), after.end());
    for (const auto& [where, unused] : all) {
      const auto in = [&place = where](const Entries& entries) {
        const auto found = entries.find(place);
        return found == entries.end() ? std::string() : found->second;
      };
      ComparedEntry entry{.table = where.first, .entry = where.second, .first = in(before), .second = in(after)};
      entry.differs = !equalTexts(entry.first, entry.second, tolerance);
      comparison.entries.push_back(std::move(entry));
    }
  } catch (const Json::exception&) {
    return fail("one of the two does not follow the layout of results.json",
                "compare files as `probewright run` writes them; docs/results.schema.json describes the layout");
  }
  return comparison;
}

ordered_json comparisonJson(const Comparison& comparison) {
  const auto number = [](const std::optional<double>& value) { return value ? ordered_json(*value) : ordered_json(); };
  const auto text = [](const std::string& value) { return value.empty() ? ordered_json() : ordered_json(value); };
  ordered_json document = {{"schema", "probewright comparison"}, {"schemaVersion", 1},
                           {"alike", comparison.alike()},        {"values", comparison.values},
                           {"differing", comparison.differing},  {"largestDifference", comparison.largest},
                           {"facts", ordered_json::array()},     {"cycles", ordered_json::array()},
                           {"entries", ordered_json::array()}};
  for (const ComparedFact& fact : comparison.facts)
    document["facts"].push_back({{"name", fact.name}, {"first", fact.first}, {"second", fact.second}});
  for (const ComparedCycle& cycle : comparison.cycles) {
    ordered_json values = ordered_json::array();
    for (const ComparedValue& value : cycle.values) {
      values.push_back({{"name", value.name},
                        {"meaning", value.meaning},
                        {"unit", value.unit},
                        {"main", value.main},
                        {"first", number(value.first)},
                        {"second", number(value.second)},
                        {"difference", number(value.difference())},
                        {"firstVerdict", text(value.firstVerdict)},
                        {"secondVerdict", text(value.secondVerdict)},
                        {"differs", value.differs}});
    }
    document["cycles"].push_back({{"name", cycle.name},
                                  {"title", cycle.title},
                                  {"firstPlace", text(cycle.firstPlace)},
                                  {"secondPlace", text(cycle.secondPlace)},
                                  {"firstAlarm", text(cycle.firstAlarm)},
                                  {"secondAlarm", text(cycle.secondAlarm)},
                                  {"differs", cycle.differs()},
                                  {"values", std::move(values)}});
  }
  for (const ComparedEntry& entry : comparison.entries)
    document["entries"].push_back({{"table", entry.table},
                                   {"entry", entry.entry},
                                   {"first", text(entry.first)},
                                   {"second", text(entry.second)},
                                   {"differs", entry.differs}});
  return document;
}

}  // namespace probewright::records
