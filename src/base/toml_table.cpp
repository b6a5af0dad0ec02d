#include "base/toml_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/number_text.hpp"

namespace probewright {

namespace {

SourcePlace placeIn(const std::string& file, const toml::source_region& region) {
  return {file, region.begin.line, region.begin.column};
}

bool within(double value, const NumberRange& range) {
  if (!std::isfinite(value) || value > range.maximum) return false;
  return range.exclusiveMinimum ? value > range.minimum : value >= range.minimum;
}

std::string describe(const NumberRange& range) {
  const char* above = range.exclusiveMinimum ? "above" : "at least";
  const bool low = std::isfinite(range.minimum), high = std::isfinite(range.maximum);
  if (low && high)
    return fmt::format("{} {} and at most {}", above, formatShortest(range.minimum), formatShortest(range.maximum));
  if (low) return fmt::format("{} {}", above, formatShortest(range.minimum));
  if (high) return fmt::format("at most {}", formatShortest(range.maximum));
  return "a finite number";
}

}  // namespace

namespace {

/// Where a name in `text` has more parts than the parser can take (a.b.c...), as an offset; the parser nests them.
std::optional<std::size_t> deepestName(std::string_view text) {
  constexpr int mostParts = 100;
  int points = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"' || c == '\'') {  // texts may hold any number of them
      const bool threefold = text.substr(i, 3) == std::string(3, c);
      const std::string close(threefold ? 3 : 1, c);
      std::size_t end = i + close.size();
      while (end < text.size() && text.substr(end, close.size()) != close && (threefold || text[end] != '\n'))
        end += c == '"' && text[end] == '\\' ? 2 : 1;
      i = std::min(end + close.size(), text.size()) - 1;
    } else if (c == '#') {
      i = std::min(text.find('\n', i), text.size()) - 1;
    } else if (c == '.') {
      if (++points == mostParts) return i;
    } else if (std::string_view("\n=,{}[]").find(c) != std::string_view::npos) {
      points = 0;
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<toml::table> parseToml(std::string_view text, const std::string& file, Diagnostics& diagnostics) {
  if (const auto deep = deepestName(text)) {
    const auto line =
        static_cast<std::uint64_t>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(*deep), '\n'));
    diagnostics.push_back({Severity::Error, {file, line + 1, 1}, "this name has more than 100 parts", {}, {}, {}});
    return std::nullopt;
  }
  try {
    return toml::parse(text, std::string_view(file));
  } catch (const toml::parse_error& error) {
    diagnostics.push_back({Severity::Error,
                           placeIn(file, error.source()),
                           fmt::format("this is not valid TOML: {}", error.description()),
                           {},
                           "Write key = value: texts in double quotes, numbers with a decimal point",
                           {}});
    return std::nullopt;
  }
}

TomlReader::TomlReader(const toml::table& table, std::string name, std::string file, Diagnostics& diagnostics)
    : table_(&table), name_(std::move(name)), file_(std::move(file)), diagnostics_(&diagnostics) {}

SourcePlace TomlReader::placeOf(std::string_view key) const {
  if (const toml::node* node = table_->get(key)) return placeIn(file_, node->source());
  return placeIn(file_, table_->source());
}

void TomlReader::report(std::string_view key, std::string message, std::string advice) {
  diagnostics_->push_back({Severity::Error, placeOf(key), std::move(message), {}, std::move(advice), {}});
}

void TomlReader::wrongType(std::string_view key, std::string_view expected) {
  report(key, fmt::format("\"{}\"{} must be {}", key, name_.empty() ? "" : " in " + name_, expected));
}

const toml::node* TomlReader::find(std::string_view key) {
  asked_.emplace(key);
  return table_->get(key);
}

bool TomlReader::isTable(std::string_view key) const { return table_->get_as<toml::table>(key) != nullptr; }

std::optional<double> TomlReader::number(std::string_view key, NumberRange range) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  const auto value = node->is_number() ? node->value<double>() : std::nullopt;
  if (!value) {
    wrongType(key, "a number");
    return std::nullopt;
  }
  if (!within(*value, range)) {
    wrongType(key, describe(range));
    return std::nullopt;
  }
  return value;
}

std::optional<long long> TomlReader::integer(std::string_view key, long long minimum, long long maximum) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  const auto* value = node->as_integer();
  if (!value || value->get() < minimum || value->get() > maximum) {
    wrongType(key, fmt::format("a whole number from {} to {}", minimum, maximum));
    return std::nullopt;
  }
  return value->get();
}

std::optional<bool> TomlReader::boolean(std::string_view key) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  if (const auto* value = node->as_boolean()) return value->get();
  wrongType(key, "true or false");
  return std::nullopt;
}

std::optional<std::string> TomlReader::text(std::string_view key) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  if (const auto* value = node->as_string()) return value->get();
  wrongType(key, "a text in quotes");
  return std::nullopt;
}

std::optional<std::size_t> TomlReader::choice(std::string_view key, const std::vector<std::string>& choices,
                                              const std::map<std::string, std::string>& otherNames) {
  const auto value = text(key);
  if (!value) return std::nullopt;
  const auto found = std::find(choices.begin(), choices.end(), *value);
  if (found != choices.end()) return static_cast<std::size_t>(found - choices.begin());
  const auto other = otherNames.find(*value);
  const auto near = other != otherNames.end() ? std::optional(other->second) : nearestName(*value, choices);
  report(key, fmt::format("\"{}\" cannot be \"{}\"; it must be one of {}", key, *value, fmt::join(choices, ", ")),
         near ? fmt::format("Did you mean \"{}\"?", *near) : "");
  return std::nullopt;
}

std::optional<std::vector<double>> TomlReader::numbers(std::string_view key, std::size_t size, NumberRange range) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  const std::string expected =
      size == 0 ? "a list of numbers"
                : fmt::format("a list of {} numbers, such as [{}]", size, fmt::join(std::vector<int>(size, 0), ", "));
  const toml::array* array = node->as_array();
  if (!array || (size != 0 && array->size() != size)) {
    wrongType(key, expected);
    return std::nullopt;
  }
  std::vector<double> values;
  for (const toml::node& element : *array) {
    const auto value = element.is_number() ? element.value<double>() : std::nullopt;
    if (!value || !std::isfinite(*value)) {
      wrongType(key, expected);
      return std::nullopt;
    }
    if (!within(*value, range)) {
      wrongType(key, fmt::format("a list of numbers, each {}", describe(range)));
      return std::nullopt;
    }
    values.push_back(*value);
  }
  return values;
}

std::optional<std::vector<std::array<double, 3>>> TomlReader::points(std::string_view key) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  std::vector<std::array<double, 3>> result;
  const toml::array* list = node->as_array();
  bool fine = list != nullptr;
  for (std::size_t i = 0; fine && i < list->size(); ++i) {
    const toml::array* point = list->get(i)->as_array();
    fine = point && point->size() == 3;
    for (std::size_t k = 0; fine && k < 3; ++k) {
      if (k == 0) result.emplace_back();
      const toml::node& element = *point->get(k);
      fine = element.is_number() && std::isfinite(element.value<double>().value());
      if (fine) result.back()[k] = element.value<double>().value();
    }
  }
  if (fine) return result;
  wrongType(key, "a list of points, such as [[0, 0, 0], [10, 0, 0]]");
  return std::nullopt;
}

std::optional<std::variant<double, std::string>> TomlReader::plainValue(std::string_view key) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  if (const auto* text = node->as_string()) return text->get();
  if (const auto* flag = node->as_boolean()) return flag->get() ? 1.0 : 0.0;
  if (node->is_number() && std::isfinite(node->value<double>().value())) return node->value<double>().value();
  wrongType(key, "a number, a text, true or false");
  return std::nullopt;
}

std::string TomlReader::nameOf(std::string_view key, std::string_view open, std::string_view close) const {
  const std::size_t brackets = name_.find_first_not_of('[');
  const std::string outer = name_.empty() ? "" : name_.substr(brackets, name_.find(']') - brackets) + ".";
  return fmt::format("{}{}{}{}", open, outer, key, close);
}

std::optional<TomlReader> TomlReader::table(std::string_view key) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  if (const toml::table* inner = node->as_table()) {
    return TomlReader(*inner, nameOf(key, "[", "]"), file_, *diagnostics_);
  }
  wrongType(key, fmt::format("a table, written {}", nameOf(key, "[", "]")));
  return std::nullopt;
}

std::vector<TomlReader> TomlReader::tables(std::string_view key) {
  std::vector<TomlReader> readers;
  const toml::node* node = find(key);
  if (!node) return readers;
  const toml::array* array = node->as_array();
  if (!array || !std::all_of(array->begin(), array->end(), [](const toml::node& n) { return n.is_table(); })) {
    wrongType(key, fmt::format("a list of tables, each written {}", nameOf(key, "[[", "]]")));
    return readers;
  }
  for (const toml::node& element : *array) {
    readers.emplace_back(*element.as_table(), nameOf(key, "[[", "]]"), file_, *diagnostics_);
  }
  return readers;
}

void TomlReader::require(std::string_view key) {
  if (table_->contains(key)) return;
  asked_.emplace(key);
  report("", fmt::format("\"{}\" is missing{}", key, name_.empty() ? "" : " in " + name_));
}

std::optional<double> TomlReader::requiredNumber(std::string_view key, NumberRange range) {
  require(key);
  return number(key, range);
}

std::optional<std::string> TomlReader::requiredText(std::string_view key) {
  require(key);
  return text(key);
}

std::vector<std::string> TomlReader::keys() const {
  std::vector<std::string> names;
  for (const auto& [key, value] : *table_)
    names.emplace_back(key.str());
  return names;
}

namespace {

/// The known key that was meant: the only one that begins so (min, accel), or the most similar one.
std::optional<std::string> meantKey(std::string_view word, const std::vector<std::string>& known) {
  constexpr std::size_t shortestBeginning = 3;
  const auto begun = [&](const std::string& name) { return name.starts_with(word); };
  if (word.size() >= shortestBeginning && std::ranges::count_if(known, begun) == 1)
    return *std::ranges::find_if(known, begun);
  return nearestName(word, known);
}

}  // namespace

void TomlReader::finish() {
  for (const auto& [key, value] : *table_) {
    if (asked_.contains(key.str())) continue;
    const std::vector<std::string> known(asked_.begin(), asked_.end());
    const auto near = meantKey(key.str(), known);
    diagnostics_->push_back(
        {Severity::Error,
         placeIn(file_, key.source()),
         fmt::format("unknown key \"{}\"{}", key.str(), name_.empty() ? "" : " in " + name_),
         {},
         near ? fmt::format("Did you mean \"{}\"?", *near) : fmt::format("Known keys here: {}", fmt::join(known, ", ")),
         {}});
  }
}

}  // namespace probewright
