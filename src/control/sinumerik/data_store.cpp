#include "control/sinumerik/data_store.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "base/number_text.hpp"
#include "control/sinumerik/array_data.hpp"
#include "control/sinumerik/text.hpp"

namespace probewright::control::sinumerik {

namespace {

/// The value a component of a frame has when none was entered, if the key names one.
std::optional<double> neutralComponent(const DataKey& key) {
  if (key.indices.size() < 2 || !isFrameName(key.name)) return std::nullopt;
  const auto part = framePartOf(key.indices.back());
  if (!part) return std::nullopt;
  return *part == FramePart::Scale ? 1.0 : 0.0;
}

std::optional<double> numberOf(const DataValue& value) {
  if (const double* number = std::get_if<double>(&value)) return *number;
  if (const bool* truth = std::get_if<bool>(&value)) return *truth ? 1.0 : 0.0;
  return std::nullopt;
}

DataKey componentKey(const DataKey& frame, std::string_view axis, FramePart part) {
  DataKey key = frame;
  key.indices.emplace_back(axis);
  key.indices.emplace_back(name(part));
  return key;
}

/// Negative, zero or positive as a comes before, with or after b: numbers by value, before words.
int compareIndices(const std::string& a, const std::string& b) {
  const auto numberA = parseInteger(a);
  const auto numberB = parseInteger(b);
  if (numberA && numberB) return *numberA < *numberB ? -1 : *numberA > *numberB ? 1 : a.compare(b);
  if (numberA.has_value() != numberB.has_value()) return numberA ? -1 : 1;
  return a.compare(b);
}

}  // namespace

std::string valueText(const DataValue& value) {
  if (const double* number = std::get_if<double>(&value)) return numberText(*number);
  if (const bool* truth = std::get_if<bool>(&value)) return *truth ? "TRUE" : "FALSE";
  return fmt::format("\"{}\"", std::get<std::string>(value));
}

DataIndex::DataIndex(std::string_view word) : text_(upperCase(word)) {
  if (const auto number = parseInteger(word)) text_ = std::to_string(*number);
}

DataKey::DataKey(std::string_view datumName, std::span<const DataIndex> datumIndices) : name(upperCase(datumName)) {
  for (const DataIndex& index : datumIndices)
    indices.push_back(index.text());
  const bool digits = name.size() > 1 && name[0] == 'R' &&
                      std::all_of(name.begin() + 1, name.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (digits && indices.empty()) {
    indices.push_back(DataIndex(std::string_view(name).substr(1)).text());
    name.resize(1);
  }
  // The control takes an array without an index as its first element, in programs and in files.
  if (indices.empty() && isArrayDatum(name)) indices.emplace_back("0");
}

bool DataKey::operator<(const DataKey& other) const {
  if (const int order = name.compare(other.name); order != 0) return order < 0;
  for (std::size_t i = 0; i < std::min(indices.size(), other.indices.size()); ++i) {
    if (const int order = compareIndices(indices[i], other.indices[i]); order != 0) return order < 0;
  }
  return indices.size() < other.indices.size();
}

std::string DataKey::text() const {
  if (name == "R" && indices.size() == 1) return fmt::format("R{}", indices[0]);
  return indices.empty() ? name : fmt::format("{}[{}]", name, fmt::join(indices, ","));
}

std::optional<DataValue> DataStore::get(const DataKey& key) const {
  if (const auto found = values_.find(key); found != values_.end()) return found->second;
  if (const auto found = defaults_.find(key.name); found != defaults_.end()) return found->second;
  if (const auto neutral = neutralComponent(key)) return *neutral;
  return std::nullopt;
}

double DataStore::number(const DataKey& key, double fallback) const {
  const auto value = get(key);
  return value ? numberOf(*value).value_or(fallback) : fallback;
}

double DataStore::number(std::string_view name, std::initializer_list<DataIndex> indices, double fallback) const {
  return number(DataKey(name, indices), fallback);
}

std::string DataStore::text(std::string_view name, std::initializer_list<DataIndex> indices) const {
  const auto value = get(DataKey(name, indices));
  const std::string* text = value ? std::get_if<std::string>(&*value) : nullptr;
  return text ? *text : std::string();
}

void DataStore::setDefault(std::string_view name, DataValue value) {
  defaults_.insert_or_assign(upperCase(name), std::move(value));
}

Frame DataStore::frame(const DataKey& key) const {
  Frame frame;
  for (auto entry = values_.lower_bound(key); entry != values_.end() && entry->first.name == key.name; ++entry) {
    const std::vector<std::string>& indices = entry->first.indices;
    if (!std::equal(key.indices.begin(), key.indices.end(), indices.begin(),
                    indices.begin() + static_cast<std::ptrdiff_t>(std::min(indices.size(), key.indices.size())))) {
      break;
    }
    if (indices.size() != key.indices.size() + 2) continue;
    const auto part = framePartOf(indices.back());
    if (part) frame.set(indices[indices.size() - 2], *part, numberOf(entry->second).value_or(0.0));
  }
  return frame;
}

Frame DataStore::frame(std::string_view name, std::initializer_list<DataIndex> indices) const {
  return frame(DataKey(name, indices));
}

void DataStore::setFrame(std::string_view name, std::initializer_list<DataIndex> indices, const Frame& frame) {
  const DataKey key(name, indices);
  const Frame before = this->frame(key);
  std::set<std::string> axes = {"X", "Y", "Z"};
  for (const Frame* each : {&before, &frame}) {
    for (const auto& [axis, values] : each->others)
      axes.insert(axis);
  }
  for (const std::string& axis : axes) {
    for (const FramePart part : allFrameParts) {
      const double value = frame.get(axis, part);
      if (before.get(axis, part) != value) set(componentKey(key, axis, part), value);
    }
  }
}

void DataStore::loadFrame(const DataKey& key, const Frame& frame) {
  std::erase_if(values_, [&key](const auto& entry) {
    const DataKey& other = entry.first;
    return other.name == key.name && other.indices.size() == key.indices.size() + 2 &&
           std::equal(key.indices.begin(), key.indices.end(), other.indices.begin());
  });
  const auto loadAxis = [&](std::string_view axis) {
    for (const FramePart part : allFrameParts) {
      const double value = frame.get(axis, part);
      if (value != (part == FramePart::Scale ? 1.0 : 0.0)) load(componentKey(key, axis, part), value);
    }
  };
  for (const std::string_view axis : {"X", "Y", "Z"})
    loadAxis(axis);
  for (const auto& [axis, values] : frame.others)
    loadAxis(axis);
}

std::vector<DataKey> DataStore::keys() const {
  std::vector<DataKey> keys;
  keys.reserve(values_.size());
  for (const auto& [key, value] : values_)
    keys.push_back(key);
  return keys;
}

std::vector<DataKey> DataStore::keys(std::string_view name) const {
  std::vector<DataKey> found;
  DataKey first;
  first.name = upperCase(name);
  for (auto entry = values_.lower_bound(first); entry != values_.end() && entry->first.name == first.name; ++entry) {
    found.push_back(entry->first);
  }
  return found;
}

bool isFrameName(std::string_view text) {
  constexpr std::array<std::string_view, 30> names = {
      "$P_UIFR",      "$P_CHBFR",    "$P_NCBFR",    "$P_SETFR",    "$P_EXTFR",    "$P_PARTFR",
      "$P_TOOLFR",    "$P_WPFR",     "$P_CYCFR",    "$P_TRAFR",    "$P_RELFR",    "$P_PFRAME",
      "$P_IFRAME",    "$P_BFRAME",   "$P_UBFR",     "$P_SETFRAME", "$P_EXTFRAME", "$P_PARTFRAME",
      "$P_TOOLFRAME", "$P_WPFRAME",  "$P_CYCFRAME", "$P_TRAFRAME", "$P_RELFRAME", "$P_ACTBFRAME",
      "$P_ACTFRAME",  "$P_CHBFRAME", "$P_NCBFRAME", "$P_GFRAME",   "$P_GFR",      "$P_ACSFRAME"};
  return std::find(names.begin(), names.end(), upperCase(text)) != names.end();
}

}  // namespace probewright::control::sinumerik
