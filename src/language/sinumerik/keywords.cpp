#include "language/sinumerik/keywords.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <vector>

namespace probewright::language::sinumerik {

namespace {

using language::Function;

constexpr int many = 64;

constexpr auto functionTable = [] {
  std::array table = std::to_array<FunctionEntry>({
      {"SIN", Function::Sin, 1, 1},           {"COS", Function::Cos, 1, 1},
      {"TAN", Function::Tan, 1, 1},           {"ASIN", Function::Asin, 1, 1},
      {"ACOS", Function::Acos, 1, 1},         {"ATAN2", Function::Atan2, 2, 2},
      {"SQRT", Function::Sqrt, 1, 1},         {"POT", Function::Square, 1, 1},
      {"ABS", Function::Abs, 1, 1},           {"LN", Function::Ln, 1, 1},
      {"EXP", Function::Exp, 1, 1},           {"TRUNC", Function::Truncate, 1, 1},
      {"ROUND", Function::Round, 1, 1},       {"ROUNDUP", Function::RoundUp, 1, 1},
      {"MINVAL", Function::Minimum, 2, 2},    {"MAXVAL", Function::Maximum, 2, 2},
      {"BOUND", Function::Bound, 3, 3},       {"SPRINT", Function::Host, 1, many},
      {"STRLEN", Function::Host, 1, 1},       {"INDEX", Function::Host, 2, 2},
      {"RINDEX", Function::Host, 2, 2},       {"MINDEX", Function::Host, 2, 2},
      {"SUBSTR", Function::Host, 2, 3},       {"TOUPPER", Function::Host, 1, 1},
      {"TOLOWER", Function::Host, 1, 1},      {"ISNUMBER", Function::Host, 1, 1},
      {"NUMBER", Function::Host, 1, 1},       {"STRING", Function::Host, 1, 1},
      {"MATCH", Function::Host, 2, 2},        {"AXNAME", Function::Host, 1, 1},
      {"AXSTRING", Function::Host, 1, 1},     {"AXTOSPI", Function::Host, 1, 1},
      {"SPI", Function::Host, 1, 1},          {"ISAXIS", Function::Host, 1, 1},
      {"ISVAR", Function::Host, 1, 1},        {"ISFILE", Function::Host, 1, 1},
      {"CTRANS", Function::Host, 0, many},    {"CFINE", Function::Host, 0, many},
      {"CROT", Function::Host, 0, many},      {"CROTS", Function::Host, 0, many},
      {"CRPL", Function::Host, 2, 2},         {"CSCALE", Function::Host, 0, many},
      {"CMIRROR", Function::Host, 0, many},   {"INVFRAME", Function::Host, 1, 1},
      {"MEAFRAME", Function::Host, 3, 3},     {"GETT", Function::Host, 1, 2},
      {"GETMDACT", Function::Host, 0, 1},     {"QU", Function::Host, 1, 1},
      {"GETDNO", Function::Host, 2, 2},       {"CHKDNO", Function::Host, 0, 3},
      {"MODAXVAL", Function::Host, 2, 2},     {"GETTCOR", Function::Host, 1, many},
      {"INTERSEC", Function::Host, 3, many},  {"GETACTTD", Function::Host, 1, 2},
      {"GETTENV", Function::Host, 1, many},   {"SETTCOR", Function::Host, 1, many},
      {"SETDNO", Function::Host, 2, 3},       {"MEASURE", Function::Host, 0, 0},
      {"CALCPOSI", Function::Host, 3, many},  {"CHKDM", Function::Host, 0, many},
      {"CTABEXISTS", Function::Host, 1, 1},   {"CTABNO", Function::Host, 0, 1},
      {"AXTOCHAN", Function::Host, 1, many},  {"SETTA", Function::Host, 2, 3},
      {"CAC", Function::Host, 1, 1},          {"CIC", Function::Host, 1, 1},
      {"CDC", Function::Host, 1, 1},          {"CACP", Function::Host, 1, 1},
      {"CACN", Function::Host, 1, 1},         {"LENTOAX", Function::Host, 1, many},
      {"STRINGIS", Function::Host, 1, 1},     {"CTAB", Function::Host, 2, many},
      {"CTABINV", Function::Host, 2, many},   {"ADDFRAME", Function::Host, 1, 2},
      {"CORRTC", Function::Host, 1, many},    {"ORISOLH", Function::Host, 1, many},
      {"GETVARTYP", Function::Host, 1, many}, {"GETVARPHU", Function::Host, 1, many},
      {"GETVARAP", Function::Host, 1, many},  {"GETVARLIM", Function::Host, 1, many},
      {"GETVARDFT", Function::Host, 1, many}, {"NAMETOINT", Function::Host, 1, many},
      {"COLLPAIR", Function::Host, 1, many},  {"AXTOINT", Function::Host, 1, 1},
      {"INTTOAX", Function::Host, 1, 1},      {"AXCTSWEC", Function::Host, 1, 1},
      {"TOOLGNT", Function::Host, 1, many},
  });
  std::sort(table.begin(), table.end(), [](const auto& l, const auto& r) { return l.name < r.name; });
  return table;
}();

constexpr std::string_view typeNames[] = {"INT", "REAL", "BOOL", "CHAR", "STRING", "AXIS", "FRAME"};

/// Levenshtein distance, counting an exchange of neighbours as one mistake.
std::size_t typingDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> older, previous(b.size() + 1), current(b.size() + 1);
  std::iota(previous.begin(), previous.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    current[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t exchange = previous[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      current[j] = std::min({previous[j] + 1, current[j - 1] + 1, exchange});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        current[j] = std::min(current[j], older[j - 2] + 1);
    }
    older = previous;
    std::swap(previous, current);
  }
  return previous[b.size()];
}

}  // namespace

const FunctionEntry* functionOf(std::string_view name) {
  const auto* entry = std::ranges::lower_bound(functionTable, name, {}, &FunctionEntry::name);
  return entry != functionTable.end() && entry->name == name ? entry : nullptr;
}

std::span<const FunctionEntry> functions() { return functionTable; }

bool typeOf(std::string_view name, Type& type) {
  const auto* found = std::find(std::begin(typeNames), std::end(typeNames), name);
  if (found == std::end(typeNames)) return false;
  type = static_cast<Type>(found - std::begin(typeNames));
  return true;
}

std::string_view typeName(Type type) { return typeNames[static_cast<std::size_t>(type)]; }

bool isGFunction(int number) {
  struct Range {
    int first, last;
  };
  static constexpr Range known[] = {
      {0, 5},     {7, 7},     {9, 9},     {17, 19},   {25, 26},   {33, 35},   {40, 42},   {53, 60},
      {62, 64},   {70, 71},   {74, 75},   {90, 91},   {93, 97},   {110, 112}, {140, 143}, {147, 148},
      {153, 153}, {247, 248}, {290, 291}, {331, 332}, {335, 336}, {340, 341}, {347, 348}, {450, 451},
      {460, 462}, {500, 500}, {505, 599}, {601, 603}, {621, 621}, {641, 645}, {700, 700}, {710, 710},
      {751, 751}, {810, 829}, {931, 931}, {942, 942}, {952, 952}, {961, 962}, {971, 973},
  };
  return std::any_of(std::begin(known), std::end(known),
                     [number](const Range& range) { return number >= range.first && number <= range.last; });
}

std::string_view closestName(std::string_view name, std::span<const std::string_view> candidates) {
  std::string_view best;
  std::size_t bestDistance = name.size() > 4 ? 3 : 2;
  for (const std::string_view candidate : candidates) {
    if (candidate.size() + 2 < name.size() || name.size() + 2 < candidate.size()) continue;
    const std::size_t distance = typingDistance(name, candidate);
    if (distance < bestDistance) {
      best = candidate;
      bestDistance = distance;
    }
  }
  return best;
}

}  // namespace probewright::language::sinumerik
