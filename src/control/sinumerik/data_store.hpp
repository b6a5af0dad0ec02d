#pragma once

#include <concepts>
#include <initializer_list>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <variant>
#include <vector>

#include "control/sinumerik/frame.hpp"

/// The data of a SINUMERIK control: tool data, frames, machine and setting data, R parameters, user variables.
namespace probewright::control::sinumerik {

/// INT and REAL are numbers; CHAR and AXIS are strings.
using DataValue = std::variant<double, bool, std::string>;

/// As the control writes it: 12.5, TRUE, "PROBE".
std::string valueText(const DataValue& value);

/// An index: a number, an axis, the part of a frame.
class DataIndex {
public:
  template <std::integral Number>
  DataIndex(Number number) : text_(std::to_string(number)) {}
  DataIndex(std::string_view word);
  DataIndex(const char* word) : DataIndex(std::string_view(word)) {}
  DataIndex(const std::string& word) : DataIndex(std::string_view(word)) {}
  const std::string& text() const { return text_; }

private:
  std::string text_;  ///< in capitals
};

/// A datum: name in capitals and indices. R parameters are R with one index: R12 is {"R", 12}.
struct DataKey {
  std::string name;
  std::vector<std::string> indices;

  DataKey() = default;
  DataKey(std::string_view datumName, std::span<const DataIndex> datumIndices);
  DataKey(std::string_view datumName, std::initializer_list<DataIndex> datumIndices)
      : DataKey(datumName, std::span(datumIndices.begin(), datumIndices.size())) {}
  bool operator==(const DataKey&) const = default;
  /// By name, then index by index, numbers before words and by value.
  bool operator<(const DataKey& other) const;
  /// "$TC_DP3[1,1]", "R12".
  std::string text() const;
};

/// Values by name and indices. What has no value has the default of its name; what has no default has none.
///
/// A frame is held component by component: $P_UIFR[1,X,TR]; components without a value are neutral (SC: 1, others: 0).
class DataStore {
public:
  /// The value, or the default, or nothing. Components of frames always have one.
  std::optional<DataValue> get(const DataKey& key) const;
  std::optional<DataValue> get(std::string_view name, std::initializer_list<DataIndex> indices = {}) const {
    return get(DataKey(name, indices));
  }
  /// The number: TRUE is 1; strings and missing data are `fallback`.
  double number(std::string_view name, std::initializer_list<DataIndex> indices, double fallback = 0) const;
  double number(const DataKey& key, double fallback = 0) const;
  std::string text(std::string_view name, std::initializer_list<DataIndex> indices) const;
  bool isSet(const DataKey& key) const { return values_.contains(key); }

  /// Sets a value.
  void set(const DataKey& key, DataValue value) { values_.insert_or_assign(key, std::move(value)); }
  void set(std::string_view name, std::initializer_list<DataIndex> indices, DataValue value) {
    set(DataKey(name, indices), std::move(value));
  }
  /// The same, for values that are read from files.
  void load(const DataKey& key, DataValue value) { set(key, std::move(value)); }
  void setDefault(std::string_view name, DataValue value);

  /// The frame `name`[indices]: frame("$P_UIFR", {1}).
  Frame frame(std::string_view name, std::initializer_list<DataIndex> indices) const;
  Frame frame(const DataKey& key) const;
  /// Sets the components that differ.
  void setFrame(std::string_view name, std::initializer_list<DataIndex> indices, const Frame& frame);
  /// Replaces the frame by one that was read.
  void loadFrame(const DataKey& key, const Frame& frame);

  /// The data that have a value of their own, in order; of one name if given.
  std::vector<DataKey> keys() const;
  std::vector<DataKey> keys(std::string_view name) const;

private:
  std::map<DataKey, DataValue> values_;
  std::unordered_map<std::string, DataValue> defaults_;
};

/// True for the names of frames in data management: $P_UIFR, $P_CHBFR, $P_NCBFR, the system frames and their active
/// copies.
bool isFrameName(std::string_view name);

}  // namespace probewright::control::sinumerik
