#pragma once

#include <array>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#define TOML_HEADER_ONLY 0
#include <toml++/toml.h>

#include "base/diagnostic.hpp"
#include "base/nearest_name.hpp"

/// Reading TOML files that people write: every mistake gets its place, and a key that is not asked for is a mistake.
namespace probewright {

/// What numbers a key may have. Infinite bounds are open.
struct NumberRange {
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  bool exclusiveMinimum = false;  ///< the minimum itself is not allowed
  static constexpr NumberRange positive() { return {.minimum = 0, .exclusiveMinimum = true}; }
  static constexpr NumberRange notNegative() { return {.minimum = 0}; }
  /// From -limit to limit.
  static constexpr NumberRange within(double limit) { return {-limit, limit}; }
};

/// The table that `text` writes; nothing after a syntax error, which is then in `diagnostics`.
std::optional<toml::table> parseToml(std::string_view text, const std::string& file, Diagnostics& diagnostics);

/// A table being read. Ask for each key that may be there, then finish(): what was not asked for is reported with the
/// nearest name that was. All functions report mistakes to `diagnostics` and go on.
class TomlReader {
public:
  /// `table` must outlive the reader. `name`: how messages call the table: "[probe]"; empty for the whole file.
  TomlReader(const toml::table& table, std::string name, std::string file, Diagnostics& diagnostics);

  bool has(std::string_view key) const { return table_->contains(key); }
  bool isTable(std::string_view key) const;

  std::optional<double> number(std::string_view key, NumberRange range = {});
  std::optional<long long> integer(std::string_view key, long long minimum, long long maximum);
  std::optional<bool> boolean(std::string_view key);
  std::optional<std::string> text(std::string_view key);
  /// One of `choices`; the index of the one that is written. `otherNames`: what people write instead, and the choice
  /// that they mean, for the message.
  std::optional<std::size_t> choice(std::string_view key, const std::vector<std::string>& choices,
                                    const std::map<std::string, std::string>& otherNames = {});
  /// An array of numbers, each in `range`, of exactly `size` if that is not 0.
  std::optional<std::vector<double>> numbers(std::string_view key, std::size_t size = 0, NumberRange range = {});
  /// A list of points, each a list of three numbers.
  std::optional<std::vector<std::array<double, 3>>> points(std::string_view key);
  /// A number, a text, or true and false as 1 and 0.
  std::optional<std::variant<double, std::string>> plainValue(std::string_view key);
  std::optional<TomlReader> table(std::string_view key);
  /// [[key]]: each table of an array of tables.
  std::vector<TomlReader> tables(std::string_view key);

  /// The same, and missing is a mistake.
  std::optional<double> requiredNumber(std::string_view key, NumberRange range = {});
  std::optional<std::string> requiredText(std::string_view key);
  void require(std::string_view key);

  /// All keys as they are written, for tables whose keys are names of the user's.
  std::vector<std::string> keys() const;

  void finish();

  /// A mistake in the value of `key`, or in this table if there is no such key.
  void report(std::string_view key, std::string message, std::string advice = {});
  SourcePlace placeOf(std::string_view key) const;
  const std::string& name() const { return name_; }
  Diagnostics& diagnostics() { return *diagnostics_; }

private:
  const toml::node* find(std::string_view key);
  void wrongType(std::string_view key, std::string_view expected);
  std::string nameOf(std::string_view key, std::string_view open, std::string_view close) const;

  const toml::table* table_;
  std::string name_;
  std::string file_;
  Diagnostics* diagnostics_;
  std::set<std::string, std::less<>> asked_;
};

}  // namespace probewright
