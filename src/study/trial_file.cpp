#include "study/trial_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <set>

#include "base/file.hpp"
#include "base/number_text.hpp"
#include "base/unfinished.hpp"

namespace probewright::study {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view firstWords = "# probewright trials 1 ";
constexpr std::array<const char*, 4> endNames = {"finished", "alarm", "refused", "cancelled"};
constexpr std::size_t fixedColumns = 3;
constexpr const char* noStudyToGoOnWith = "leave out --resume, or name the folder of the interrupted study";
/// Before the name of a column that holds the true values of another.
constexpr std::string_view truthOf = "truth of ";
constexpr std::string_view sourceName = "source ";

std::string inQuotes(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '\n' || c == '\r') {
      result += ' ';
      continue;
    }
    if (c == '"') result += '"';
    result += c;
  }
  return result + "\"";
}

/// Shortest text that reads back as the same number, with an exponent where that is shorter.
std::string numberText(double value) {
  if (std::isnan(value)) return "";
  if (value == 0) return "0";  // both zeros
  std::array<char, 40> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return std::string(text.data(), end);
}

std::vector<std::string> cellsOf(std::string_view line) {
  std::vector<std::string> cells(1);
  bool inside = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"') {
      if (inside && i + 1 < line.size() && line[i + 1] == '"') {
        cells.back() += '"';
        ++i;
      } else {
        inside = !inside;
      }
    } else if (c == ',' && !inside) {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  return cells;
}

double numberOf(const std::string& cell, bool& whole) {
  if (cell.empty()) return missing;
  double value = missing;
  const char* last = cell.data() + cell.size();
  const auto read = std::from_chars(cell.data(), last, value);
  whole = whole && read.ec == std::errc() && read.ptr == last;
  return value;
}

Result<void> add(int file, const fs::path& path, const std::string& text) {
  return writeAll(file, text) ? Result<void>() : failErrno(path, "add trials to the file");
}

Result<void> append(const fs::path& path, const std::string& text) {
  const int file = open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (file < 0) return failErrno(path, "add trials to the file");
  Result<void> done = add(file, path, text);
  close(file);
  return done;
}

}  // namespace

Result<TrialReader> TrialReader::open(const fs::path& path, std::string_view mark) {
  TrialReader reader;
  reader.file_.open(path, std::ios::binary);
  std::string line;
  if (!reader.file_) {
    auto failed = failErrno(path, "read the trials");
    failed.value().advice = noStudyToGoOnWith;
    return failed;
  }
  if (!std::getline(reader.file_, line) || !line.starts_with(firstWords))
    return fail({path.string(), 1, 1}, "this is not the file of a study's trials", noStudyToGoOnWith);
  if (line.substr(firstWords.size()) != mark)
    return fail({path.string(), 1, 1},
                "these trials are of another study: program, setup, sources or seed are different",
                "leave out --resume to begin anew");
  reader.bytes_ = line.size() + 1;
  if (!std::getline(reader.file_, line) || reader.file_.eof()) return reader;
  reader.headed_ = true;
  reader.bytes_ += line.size() + 1;
  const std::vector<std::string> names = cellsOf(line);
  for (std::size_t i = fixedColumns; i < names.size(); ++i) {
    if (reader.columns_.results.empty() && names[i].starts_with(sourceName)) {
      reader.columns_.sources.push_back(names[i].substr(sourceName.size()));
    } else if (!names[i].starts_with(truthOf)) {
      reader.columns_.results.push_back(names[i]);
    } else {
      const std::string key = names[i].substr(truthOf.size());
      const auto place = std::ranges::find(reader.columns_.results, key) - reader.columns_.results.begin();
      reader.columns_.truths.push_back(key);
      reader.truthOf_.push_back(static_cast<std::size_t>(place));
    }
  }
  return reader;
}

std::optional<TrialReader::Trial> TrialReader::next() {
  std::string line;
  // A line without its end was not written whole.
  if (!headed_ || !std::getline(file_, line) || file_.eof()) return std::nullopt;
  const std::vector<std::string> cells = cellsOf(line);
  const std::size_t results = fixedColumns + columns_.sources.size(), truths = results + columns_.results.size();
  if (cells.size() != truths + columns_.truths.size() || parseInteger(cells[0]) != static_cast<long long>(trials_))
    return std::nullopt;
  Trial trial;
  const auto end = std::ranges::find(endNames, cells[1]);
  if (end == endNames.end()) return std::nullopt;
  trial.outcome.end = static_cast<TrialEnd>(end - endNames.begin());
  trial.outcome.why = cells[2];
  bool whole = true;
  for (std::size_t i = fixedColumns; i < results; ++i)
    trial.inputs.push_back(numberOf(cells[i], whole));
  std::vector<std::optional<double>> known(columns_.results.size());
  for (std::size_t i = 0; i < columns_.truths.size(); ++i)
    if (const double truth = numberOf(cells[truths + i], whole); truthOf_[i] < known.size() && !std::isnan(truth))
      known[truthOf_[i]] = truth;
  for (std::size_t i = 0; i < columns_.results.size(); ++i) {
    if (cells[results + i].empty()) continue;
    Observation observation;
    observation.of.key = columns_.results[i];
    observation.value = numberOf(cells[results + i], whole);
    observation.truth = known[i];
    trial.outcome.observations.push_back(std::move(observation));
  }
  if (!whole) return std::nullopt;
  bytes_ += line.size() + 1;
  ++trials_;
  return trial;
}

TrialWriter::TrialWriter(fs::path path, std::string mark, std::vector<std::string> sources,
                         std::function<Result<void>()> beforeChange)
    : path_(std::move(path)),
      mark_(std::move(mark)),
      columns_{std::move(sources), {}, {}},
      beforeChange_(std::move(beforeChange)) {}

Result<void> TrialWriter::goOn(const TrialReader& done) {
  if (done.trials() == 0) return {};
  if (Result<void> ready = beforeChange_(); !ready) return ready;
  std::error_code error;
  fs::resize_file(path_, done.bytes(), error);
  if (error) return fail({path_.string(), 0, 0}, "cannot go on with the file: " + error.message(), "");
  columns_ = done.columns();
  begun_ = true;
  return {};
}

bool TrialWriter::learn(std::span<const Outcome> outcomes) {
  std::set<std::string> known(columns_.results.begin(), columns_.results.end()),
      withTruth(columns_.truths.begin(), columns_.truths.end());
  bool more = false;
  for (const Outcome& outcome : outcomes) {
    for (const Observation& observation : outcome.observations) {
      if (known.insert(observation.of.key).second) {
        columns_.results.push_back(observation.of.key);
        more = true;
      }
      more = (observation.truth && withTruth.insert(observation.of.key).second) || more;
    }
  }
  columns_.truths.clear();
  for (const std::string& key : columns_.results)
    if (withTruth.contains(key)) columns_.truths.push_back(key);
  return more;
}

std::string TrialWriter::heading() const {
  std::string text = fmt::format("{}{}\ntrial,end,why", firstWords, mark_);
  for (const std::string& source : columns_.sources)
    text += "," + inQuotes(std::string(sourceName) + source);
  for (const std::string& key : columns_.results)
    text += "," + inQuotes(key);
  for (const std::string& key : columns_.truths)
    text += "," + inQuotes(std::string(truthOf) + key);
  return text + "\n";
}

std::string TrialWriter::rows(std::span<const Draw> draws, std::span<const Outcome> outcomes) const {
  std::map<std::string, std::size_t> places, truthPlaces;
  for (const std::string& key : columns_.results)
    places.emplace(key, places.size());
  for (const std::string& key : columns_.truths)
    truthPlaces.emplace(key, truthPlaces.size());
  std::string text;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const Outcome& outcome = outcomes[i];
    text += fmt::format("{},{},{}", draws[i].trial, endNames[static_cast<std::size_t>(outcome.end)],
                        outcome.end == TrialEnd::Finished ? "" : inQuotes(outcome.why));
    for (const double input : draws[i].inputs)
      text += "," + numberText(input);
    std::vector<double> values(places.size(), missing), truths(truthPlaces.size(), missing);
    for (const Observation& observation : outcome.observations) {
      values[places.at(observation.of.key)] = observation.value;
      if (observation.truth) truths[truthPlaces.at(observation.of.key)] = *observation.truth;
    }
    for (const auto& numbers : {values, truths})
      for (const double number : numbers)
        text += "," + numberText(number);
    text += "\n";
  }
  return text;
}

/// The file anew, with the columns that have come.
Result<void> TrialWriter::rewrite(const TrialColumns& before, const std::string& more) {
  auto reader = TrialReader::open(path_, mark_);
  auto neighbour = UnfinishedFile::beside(path_);
  if (!reader || !neighbour) {
    columns_ = before;
    return tl::unexpected(reader ? neighbour.error() : reader.error());
  }
  const int file = neighbour->descriptor();
  Result<void> done = add(file, path_, heading());
  constexpr std::size_t atOnce = 1000;
  std::vector<Draw> draws;
  std::vector<Outcome> outcomes;
  for (bool any = true; any && done;) {
    draws.clear();
    outcomes.clear();
    while (draws.size() < atOnce) {
      const std::uint64_t trial = reader->trials();
      auto read = reader->next();
      if (!read) break;
      draws.push_back({trial, std::move(read->inputs), {}});
      outcomes.push_back(std::move(read->outcome));
    }
    any = !draws.empty();
    if (any) done = add(file, path_, rows(draws, outcomes));
  }
  if (done) done = add(file, path_, more);
  if (done && !(::fchmod(file, 0644) == 0 && neighbour->finish())) done = failErrno(path_, "write the trials");
  if (!done) columns_ = before;
  return done;
}

Result<void> TrialWriter::write(std::span<const Draw> draws, std::span<const Outcome> outcomes) {
  const TrialColumns before = columns_;
  const bool more = learn(outcomes);
  const std::string text = rows(draws, outcomes);
  if (!begun_) {
    const Result<void> done = replaceFile(path_, heading() + text, beforeChange_);
    begun_ = done.has_value();
    return done;
  }
  return more ? rewrite(before, text) : append(path_, text);
}

std::optional<Diagnostic> whyNotTrials(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(fs::symlink_status(path, error))) return std::nullopt;
  const auto foreign = [&] {
    return fail({path.string(), 0, 0}, "this file is not of a study, and stays as it is",
                "move it, or choose another folder with --out")
        .value();
  };
  if (!fs::is_regular_file(path, error)) return foreign();
  std::ifstream file(path, std::ios::binary);
  std::string first(firstWords.size(), ' ');
  file.read(first.data(), static_cast<std::streamsize>(first.size()));
  return file && first == firstWords ? std::nullopt : std::optional(foreign());
}

}  // namespace probewright::study
