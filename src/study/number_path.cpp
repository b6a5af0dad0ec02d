#include "study/number_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/number_text.hpp"
#include "base/text.hpp"

namespace probewright::study {

namespace {

constexpr std::size_t mostSteps = 20;

tl::unexpected<Diagnostic> notAPath(std::string_view text) {
  return fail(fmt::format("\"{}\" does not name a number of a setup", text),
              "write the keys on the way to it with points, in brackets which one of several: part.pose.x, "
              "tool[PROBE].pretravel, part.feature[2].diameter");
}

/// Is written as such: some keys take nothing else (numbers of teeth), and all that take other numbers take whole ones.
bool isWhole(double value) { return value == std::trunc(value) && std::abs(value) < 0x1p53; }

}  // namespace

Result<NumberPath> NumberPath::parse(std::string_view text) {
  NumberPath path;
  path.text_ = text;
  std::size_t i = 0;
  const auto quoted = [&]() -> std::optional<std::string> {
    const std::size_t close = text.find('"', i + 1);
    if (close == std::string_view::npos) return std::nullopt;
    std::string inner(text.substr(i + 1, close - i - 1));
    i = close + 1;
    return inner;
  };
  while (true) {
    std::string key;
    if (i < text.size() && text[i] == '"') {
      auto inner = quoted();
      if (!inner) return notAPath(text);
      key = std::move(*inner);
    } else {
      const std::size_t end = std::min(text.find_first_of(".[\"] \t", i), text.size());
      key = text.substr(i, end - i);
      i = end;
    }
    if (key.empty()) return notAPath(text);
    path.steps_.emplace_back(std::move(key));
    while (i < text.size() && text[i] == '[') {
      const std::size_t close = text.find(']', i);
      if (close == std::string_view::npos || close == i + 1) return notAPath(text);
      const std::string inner(text.substr(i + 1, close - i - 1));
      i = close + 1;
      if (std::ranges::all_of(inner, isDigit)) {
        const auto place = parseInteger(inner);
        if (!place || *place < 1 || *place > 1'000'000) return notAPath(text);
        path.steps_.emplace_back(static_cast<std::size_t>(*place));
      } else if (const std::size_t equals = inner.find('='); equals != std::string::npos) {
        path.steps_.emplace_back(Entry{inner.substr(0, equals), inner.substr(equals + 1)});
      } else {
        path.steps_.emplace_back(Entry{"name", inner});
      }
    }
    if (path.steps_.size() > mostSteps) return notAPath(text);
    if (i == text.size()) break;
    if (text[i] != '.') return notAPath(text);
    ++i;
  }
  const std::vector<std::string> keys = path.keys();
  if (keys.size() > 1 && keys[0] == "machine" && keys[1] == "body") {
    return fail(fmt::format("\"{}\" cannot vary: all trials share the bodies of the machine", text),
                "vary the part, a fixture or a tool, or run once with another body");
  }
  return path;
}

std::vector<std::string> NumberPath::keys() const {
  std::vector<std::string> keys;
  for (const Step& step : steps_)
    if (const auto* key = std::get_if<std::string>(&step)) keys.push_back(*key);
  return keys;
}

std::optional<std::size_t> NumberPath::placeIn(const toml::array& list, const Step& step) {
  if (const auto* place = std::get_if<std::size_t>(&step))
    return *place <= list.size() ? std::optional(*place - 1) : std::nullopt;
  const auto* entry = std::get_if<Entry>(&step);
  // A key that follows a list of one names the one.
  if (entry == nullptr) return list.size() == 1 ? std::optional<std::size_t>(0) : std::nullopt;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const toml::table* table = list.get(i)->as_table();
    const toml::node* node = table == nullptr ? nullptr : table->get(entry->key);
    if (node == nullptr) continue;
    if (const auto* text = node->as_string(); text != nullptr && text->get() == entry->value) return i;
    if (const auto number = node->value<double>(); number && parseDecimal(entry->value) == number) return i;
  }
  return std::nullopt;
}

std::optional<double> NumberPath::numberIn(const toml::table& root) const {
  const toml::node* node = &root;
  for (std::size_t i = 0; i < steps_.size();) {
    if (const toml::array* list = node->as_array()) {
      const auto place = placeIn(*list, steps_[i]);
      if (!place) return std::nullopt;
      node = list->get(*place);
      if (!std::holds_alternative<std::string>(steps_[i])) ++i;
      continue;
    }
    const toml::table* table = node->as_table();
    const auto* key = std::get_if<std::string>(&steps_[i]);
    node = table == nullptr || key == nullptr ? nullptr : table->get(*key);
    if (node == nullptr) return std::nullopt;
    ++i;
  }
  return node->is_number() ? node->value<double>() : std::nullopt;
}

Result<void> NumberPath::set(toml::table& root, double value) const {
  const auto noPlace = [&](std::string_view what) {
    return fail(fmt::format("the setup has no place for {}: {}", text_, what),
                "write the entry in the setup, or count the entries again");
  };
  toml::node* node = &root;
  for (std::size_t i = 0; i < steps_.size();) {
    const bool last = i + 1 == steps_.size();
    if (toml::array* list = node->as_array()) {
      const auto place = placeIn(*list, steps_[i]);
      if (!place) return noPlace("no entry of a list is meant");
      if (std::holds_alternative<std::string>(steps_[i])) {
        node = list->get(*place);
        if (!node->is_table()) return noPlace("the list has no keys");
        continue;
      }
      if (last) {
        if (!list->get(*place)->is_number()) return noPlace("the entry of the list is not a number");
        const auto there = list->cbegin() + static_cast<std::ptrdiff_t>(*place);
        if (isWhole(value)) {
          list->replace(there, static_cast<std::int64_t>(value));
        } else {
          list->replace(there, value);
        }
        return {};
      }
      node = list->get(*place);
      ++i;
      continue;
    }
    toml::table* table = node->as_table();
    const auto* key = std::get_if<std::string>(&steps_[i]);
    if (table == nullptr || key == nullptr) return noPlace("there is no list or table on the way to it");
    if (last) {
      toml::node* there = table->get(*key);
      if (there != nullptr && !there->is_number()) return noPlace(fmt::format("\"{}\" is not a number", *key));
      if (isWhole(value)) {
        table->insert_or_assign(*key, static_cast<std::int64_t>(value));
      } else {
        table->insert_or_assign(*key, value);
      }
      return {};
    }
    if (!table->contains(*key)) {
      if (!std::holds_alternative<std::string>(steps_[i + 1])) return noPlace(fmt::format("there is no \"{}\"", *key));
      table->insert(*key, toml::table{});
    }
    node = table->get(*key);
    ++i;
  }
  return noPlace("it names a table");
}

}  // namespace probewright::study
