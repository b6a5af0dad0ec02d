#pragma once

#include <algorithm>
#include <span>
#include <string_view>

/// The names of table columns, as types: a name in the source that no table has, or that holds texts where a number is
/// wanted, does not compile.
namespace probewright::control::heidenhain {

/// Every column that the control's tables have.
namespace known_columns {

inline constexpr std::string_view numbers[] = {
    "NR",      "NO",      "D",          "T",       "DIRECTION", "X",       "Y",        "Z",      "A",      "B",
    "C",       "U",       "V",          "W",       "X_OFFS",    "Y_OFFS",  "Z_OFFS",   "A_OFFS", "B_OFFS", "C_OFFS",
    "U_OFFS",  "V_OFFS",  "W_OFFS",     "ROT",     "SPA",       "SPB",     "SPC",      "ACTNO",  "L",      "R",
    "R2",      "DL",      "DR",         "DR2",     "ZL",        "XL",      "YL",       "DZL",    "DXL",    "DYL",
    "RS",      "DRS",     "TO",         "ORI",     "TIME1",     "TIME2",   "CUR.TIME", "LCUTS",  "ANGLE",  "T-ANGLE",
    "CUT",     "LTOL",    "RTOL",       "R-OFFS",  "L-OFFS",    "LBREAK",  "RBREAK",   "NMAX",   "PITCH",  "TP_NO",
    "CAL-OF1", "CAL-OF2", "CAL-ANG",    "CAL_OF1", "CAL_OF2",   "CAL_ANG", "F",        "FMAX",   "DIST",   "SET_UP",
    "ANGLE-V", "ANGLE-H", "SPB-INSERT", "VALUE",   "CODE",      "DX",      "DY",       "DZ"};
inline constexpr std::string_view texts[] = {
    "TOOL",   "NAME",     "TYPE",  "TYP",    "TL",       "RT",     "DOC", "PLC",  "DIRECT", "LIFTOFF", "DR2TABLE",
    "LOCKED", "F_PREPOS", "TRACK", "SERIAL", "REACTION", "STYLUS", "KEY", "AXIS", "RECORD", "DATE",    "KINEMATIC"};
constexpr bool isIn(std::span<const std::string_view> names, std::string_view name) {
  return std::ranges::find(names, name) != std::ranges::end(names);
}

}  // namespace known_columns

/// A column of whatever kind.
class Column {
public:
  /// One that the control's tables have; anything else does not compile.
  consteval Column(const char* name) : Column(Given{name}) {  // NOLINT(google-explicit-constructor)
    if (!known_columns::isIn(known_columns::numbers, name) && !known_columns::isIn(known_columns::texts, name))
      throw "no table has this column; its name belongs into columns.hpp";
  }
  /// One whose name is known only when the program runs: it comes from an NC program, or from the name of an axis.
  static constexpr Column named(std::string_view name) { return Column(Given{name}); }

  constexpr std::string_view name() const { return name_; }

protected:
  struct Given {
    std::string_view name;
  };
  constexpr explicit Column(Given given) : name_(given.name) {}

private:
  std::string_view name_;
};

/// A column whose entries are numbers.
class NumberColumn : public Column {
public:
  consteval NumberColumn(const char* name) : Column(Given{name}) {  // NOLINT(google-explicit-constructor)
    if (!known_columns::isIn(known_columns::numbers, name)) throw "no table has this column, or its entries are texts";
  }
  /// As Column::named.
  static constexpr NumberColumn named(std::string_view name) { return NumberColumn(Given{name}); }

private:
  constexpr explicit NumberColumn(Given given) : Column(given) {}
};

}  // namespace probewright::control::heidenhain
