#include "study/trial_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "base/file.hpp"
#include "base/number_text.hpp"

namespace probewright::study {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view heading = "# probewright trials 1 ";
constexpr std::array<const char*, 4> endNames = {"finished", "alarm", "refused", "cancelled"};
constexpr std::size_t fixedColumns = 3;
/// Before the name of a column that holds the true values of another.
constexpr std::string_view truthOf = "truth of ";

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

/// Shortest text that reads back as the same double, with an exponent where that is shorter.
std::string numberText(double value) {
  if (std::isnan(value)) return "";
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

/// The next line with its end; nothing if the text ends before the line does.
std::optional<std::string_view> nextLine(std::string_view& text) {
  const std::size_t end = text.find('\n');
  if (end == std::string_view::npos) return std::nullopt;
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end + 1);
  return line;
}

/// Adds to the end of a file, or makes it anew, and sees that it reaches the disk.
Result<void> put(const fs::path& path, const std::string& text, bool append) {
  if (!append) return writeFileAtomically(path, text);
  const int file = open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (file < 0) return failErrno(path, "add trials to the file");
  if (!writeAll(file, text)) {
    auto failed = failErrno(path, "add trials to the file");
    close(file);
    return failed;
  }
  close(file);
  return {};
}

}  // namespace

TrialWriter::TrialWriter(fs::path path, std::string mark, std::vector<std::string> sources)
    : path_(std::move(path)), mark_(std::move(mark)), sources_(std::move(sources)) {}

std::string TrialWriter::rows(const TrialTable& table, std::size_t begin) const {
  std::vector<const std::string*> why(table.size(), nullptr);
  for (const auto& [text, places] : table.stops())
    for (const std::size_t place : places)
      why[place] = &text;
  std::string text;
  for (std::size_t i = begin; i < table.size(); ++i) {
    text += fmt::format("{},{},{}", table.trials()[i], endNames[static_cast<std::size_t>(table.ends()[i])],
                        why[i] == nullptr ? "" : inQuotes(*why[i]));
    for (std::size_t source = 0; source < sources_.size(); ++source)
      text += "," + numberText(table.inputs(source)[i]);
    for (std::size_t column = 0; column < table.characteristics().size(); ++column)
      text += "," + numberText(table.values(column)[i]);
    for (std::size_t column = 0; column < table.characteristics().size(); ++column)
      if (!table.truths(column).empty()) text += "," + numberText(table.truths(column)[i]);
    text += "\n";
  }
  return text;
}

Result<void> TrialWriter::write(const TrialTable& table) {
  std::size_t columns = table.characteristics().size();
  for (std::size_t column = 0; column < table.characteristics().size(); ++column)
    columns += table.truths(column).empty() ? 0 : 1;
  const bool append = begun_ && columns_ == columns;
  std::string text;
  if (!append) {
    text = fmt::format("{}{}\ntrial,end,why", heading, mark_);
    for (const std::string& source : sources_)
      text += "," + inQuotes("source " + source);
    for (const Characteristic& characteristic : table.characteristics())
      text += "," + inQuotes(characteristic.key);
    for (std::size_t column = 0; column < table.characteristics().size(); ++column)
      if (!table.truths(column).empty())
        text += "," + inQuotes(std::string(truthOf) + table.characteristics()[column].key);
    text += "\n";
  }
  text += rows(table, append ? written_ : 0);
  if (const Result<void> done = put(path_, text, append); !done) return done;
  begun_ = true;
  written_ = table.size();
  columns_ = columns;
  return {};
}

Result<std::vector<Outcome>> readTrials(const fs::path& path, std::string_view mark) {
  const auto bytes = readFile(path);
  if (!bytes) return tl::unexpected(bytes.error());
  std::string_view text = *bytes;
  const auto first = nextLine(text);
  if (!first || !first->starts_with(heading))
    return fail({path.string(), 1, 1}, "this is not the file of a study's trials",
                "leave out --resume, or name "
                "the folder of the study that was broken off");
  if (first->substr(heading.size()) != mark)
    return fail({path.string(), 1, 1},
                "these trials are of another study: program, setup, sources or seed are different",
                "leave out --resume to begin anew");
  const auto names = nextLine(text);
  std::vector<Outcome> outcomes;
  if (!names) return outcomes;
  const std::vector<std::string> columns = cellsOf(*names);
  // How many of the columns are sources, the mark says; here only results count.
  std::size_t sources = 0;
  while (fixedColumns + sources < columns.size() && columns[fixedColumns + sources].starts_with("source "))
    ++sources;
  while (const auto line = nextLine(text)) {
    const std::vector<std::string> cells = cellsOf(*line);
    if (cells.size() != columns.size() || parseInteger(cells[0]) != static_cast<long long>(outcomes.size())) break;
    Outcome outcome;
    const auto end = std::ranges::find(endNames, cells[1]);
    if (end == endNames.end()) break;
    outcome.end = static_cast<TrialEnd>(end - endNames.begin());
    outcome.why = cells[2];
    bool whole = true;
    for (std::size_t i = fixedColumns + sources; i < cells.size(); ++i) {
      if (cells[i].empty()) continue;
      double value = 0;
      const char* last = cells[i].data() + cells[i].size();
      const auto read = std::from_chars(cells[i].data(), last, value);
      whole = whole && read.ec == std::errc() && read.ptr == last;
      const bool isTruth = columns[i].starts_with(truthOf);
      const std::string key = isTruth ? columns[i].substr(truthOf.size()) : columns[i];
      const auto same = std::ranges::find_if(outcome.observations, [&](const auto& o) { return o.of.key == key; });
      if (isTruth && same != outcome.observations.end()) same->truth = value;
      if (isTruth) continue;
      Observation observation;
      observation.of.key = key;
      observation.value = value;
      outcome.observations.push_back(std::move(observation));
    }
    if (!whole) break;
    outcomes.push_back(std::move(outcome));
  }
  return outcomes;
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
  const auto bytes = readFile(path);
  if (!bytes) return bytes.error();
  return bytes->starts_with(heading) ? std::nullopt : std::optional(foreign());
}

}  // namespace probewright::study
