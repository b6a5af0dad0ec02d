#include "language/klartext/path_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

namespace probewright::language::klartext {

namespace {

using enum EndPoint;

constexpr std::array table = {
    PathWords{.name = "L", .words = "R+", .twin = "LP"},
    PathWords{.name = "LP", .end = Polar, .twin = "L"},
    PathWords{.name = "LN", .words = "NX NY NZ TX TY TZ"},
    PathWords{.name = "CC", .end = Centre, .compensations = Compensations::None, .feed = false},
    PathWords{.name = "C", .words = "DR", .twin = "CP"},
    PathWords{.name = "CR", .words = "R DR", .twin = "CP"},
    PathWords{.name = "CT", .twin = "CTP"},
    PathWords{.name = "CP", .end = PolarArc, .words = "DR", .twin = "C"},
    PathWords{.name = "CTP", .end = Polar, .twin = "CT"},
    PathWords{.name = "RND", .end = None, .words = "R", .compensations = Compensations::None},
    PathWords{.name = "CHF", .end = None, .words = "R", .compensations = Compensations::None},
    PathWords{.name = "APPR LT", .words = "LEN", .twin = "APPR PLT"},
    PathWords{.name = "APPR LN", .words = "LEN", .twin = "APPR PLN"},
    PathWords{.name = "APPR CT", .words = "CCA R", .twin = "APPR PCT"},
    PathWords{.name = "APPR LCT", .words = "R", .twin = "APPR PLCT"},
    PathWords{.name = "APPR PLT", .end = Polar, .words = "LEN", .twin = "APPR LT"},
    PathWords{.name = "APPR PLN", .end = Polar, .words = "LEN", .twin = "APPR LN"},
    PathWords{.name = "APPR PCT", .end = Polar, .words = "CCA R", .twin = "APPR CT"},
    PathWords{.name = "APPR PLCT", .end = Polar, .words = "R", .twin = "APPR LCT"},
    PathWords{.name = "DEP LT", .end = None, .words = "LEN", .compensations = Compensations::OffOnly},
    PathWords{.name = "DEP LN", .end = None, .words = "LEN", .compensations = Compensations::OffOnly},
    PathWords{.name = "DEP CT", .end = None, .words = "CCA R", .compensations = Compensations::OffOnly},
    PathWords{.name = "DEP LCT", .words = "R", .compensations = Compensations::OffOnly, .twin = "DEP PLCT"},
    PathWords{
        .name = "DEP PLCT", .end = Polar, .words = "R", .compensations = Compensations::OffOnly, .twin = "DEP LCT"},
    // Calls of cycles have the words of a position.
    PathWords{.name = "CYCL CALL", .end = None, .compensations = Compensations::OffOnly},
    PathWords{.name = "CYCL CALL POS", .compensations = Compensations::OffOnly},
    PathWords{.name = "CYCL CALL PAT", .end = None, .compensations = Compensations::OffOnly},
};

bool isAxis(std::uint32_t address) {
  return address < 256 && std::string_view("XYZABCUVW").find(static_cast<char>(address)) != std::string_view::npos;
}

bool isPolar(std::uint32_t address) { return address == addressOf("PR") || address == addressOf("PA"); }

/// R+ and R- of single axes, which have no number.
bool isParaxial(const Word& word) { return word.address == addressOf("R") && word.mode == WordMode::DirectShortest; }

std::vector<std::string> listed(std::string_view words) {
  std::vector<std::string> all;
  while (!words.empty()) {
    const std::size_t end = std::min(words.find(' '), words.size());
    all.emplace_back(words.substr(0, end));
    words.remove_prefix(std::min(end + 1, words.size()));
  }
  return all;
}

}  // namespace

const PathWords& pathWords(std::string_view name) {
  const auto found = std::ranges::find(table, name, &PathWords::name);
  if (found == table.end()) throw std::logic_error(fmt::format("{} is not a path function", name));
  return *found;
}

bool takes(const PathWords& function, const Word& word) {
  const std::uint32_t address = word.address;
  if (isAxis(address)) {
    return function.end == Centre ? address >= 'X' && address <= 'Z' : function.end != None;
  }
  if (address == addressOf("PA")) return function.end == Polar || function.end == PolarArc;
  if (address == addressOf("PR")) return function.end == Polar;
  const std::string name = isParaxial(word) ? "R+" : addressName(address);
  const std::vector<std::string> own = listed(function.words);
  return std::ranges::find(own, name) != own.end();
}

std::string adviceAgainst(const PathWords& function, std::uint32_t address) {
  const bool polar = function.end == Polar || function.end == PolarArc;
  if (function.end == PolarArc && address == addressOf("PR"))
    return "take it away: the radius is the distance of the starting point from the pole";
  if (isPolar(address) && !polar && !function.twin.empty())
    return fmt::format("write {} for polar coordinates", function.twin);
  if (address == addressOf("DR")) return "take it away, or write an arc: C, CR or CP";
  if (address == addressOf("R")) return "write R0, RL or RR for the radius compensation, CR for an arc with a radius";
  if (address == addressOf("LEN") || address == addressOf("CCA")) return "take it away, or write APPR or DEP";
  const char first = static_cast<char>(address & 0xff);
  if (const bool normal = first == 'N' || first == 'T'; normal && function.name == "L")
    return "write LN for a line with a surface normal or a tool direction";
  return fmt::format("take it away: {} takes {}", function.name, summaryOf(function));
}

std::string summaryOf(const PathWords& function) {
  std::vector<std::string> all;
  switch (function.end) {
    case None:
      break;
    case Cartesian:
      all = {"axes"};
      break;
    case Centre:
      all = {"X", "Y", "Z"};
      break;
    case Polar:
      all = {"PR", "PA", "the axis along the tool"};
      break;
    case PolarArc:
      all = {"PA", "the axis along the tool"};
      break;
  }
  for (const std::string& word : listed(function.words))
    all.push_back(word == "DR" ? "DR+ or DR-" : word == "R+" ? "R+ or R-" : word);
  if (function.compensations == Compensations::All) all.insert(all.end(), {"R0", "RL", "RR"});
  if (function.feed) all.emplace_back("F");
  all.emplace_back("M");
  std::string text;
  for (std::size_t i = 0; i < all.size(); ++i)
    text += (i == 0 ? "" : i + 1 == all.size() ? " and " : ", ") + all[i];
  return text;
}

std::string writtenName(const Word& word) {
  if (isParaxial(word)) return word.value.number > 0 ? "R+" : "R-";
  return (word.mode == WordMode::Incremental ? "I" : "") + addressName(word.address);
}

}  // namespace probewright::language::klartext
