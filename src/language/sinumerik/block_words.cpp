#include "language/sinumerik/block_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <unordered_map>

#include "language/sinumerik/keywords.hpp"

namespace probewright::language::sinumerik {

namespace {

struct Group {
  int number;
  std::string_view functions;
};

/// Those that say where the tool goes, how fast and in which unit.
constexpr Group groups[] = {
    {6, "G17 G18 G19"},
    {7, "G40 G41 G42"},
    {8, "G500 G54 G55 G56 G57"},  // and G505 to G599
    {9, "SUPA G53 G153"},
    {13, "G70 G71 G700 G710"},
    {14, "G90 G91"},
    {15, "G93 G94 G95 G96 G97 G931 G961 G971 G942 G952 G962 G972 G973"},
    {18, "G450 G451"},
    {25, "ORIWKS ORIMKS"},
    {29, "DIAMOF DIAMON DIAM90 DIAMCYCOF"},
    {43, "G140 G141 G142 G143"},
    {47, "G290 G291"},
    {50, "ORIEULER ORIRPY ORIRPY2 ORIVIRT1 ORIVIRT2 ORIAXPOS"},
    {52, "PAROTOF PAROT"},
    {53, "TOROTOF TOROT TOROTX TOROTY TOROTZ TOFRAME TOFRAMEX TOFRAMEY TOFRAMEZ"},
};

template <class Each>
void eachName(std::string_view names, const Each& each) {
  while (!names.empty()) {
    const std::size_t end = std::min(names.find(' '), names.size());
    each(names.substr(0, end));
    names.remove_prefix(std::min(end + 1, names.size()));
  }
}

const std::unordered_map<std::string_view, int>& groupTable() {
  static const std::unordered_map<std::string_view, int> table = [] {
    std::unordered_map<std::string_view, int> all;
    for (const auto& [number, functions] : groups)
      eachName(functions, [&, group = number](std::string_view name) { all.emplace(name, group); });
    return all;
  }();
  return table;
}

/// Words that are no axes, as far as each row takes them; G functions, F, S, T, D, M and H stand beside them.
struct Row {
  Takes takes;
  std::string_view words;
  std::string_view advice;
};

constexpr Row rows[] = {
    {Takes::Line, "AP RP RND RNDM CHF CHR ANG ANG1 ANG2 FRC FRCM", "write G2 or G3 for an arc"},
    {Takes::Thread, "AP RP RND RNDM CHF CHR ANG ANG1 ANG2 FRC FRCM I J K", "write G2 or G3 for an arc"},
    {Takes::Arc, "AP RP RND RNDM CHF CHR FRC FRCM I J K CR AR TURN",
     "an arc has I, J, K, CR or AR, its end point, TURN, RND, CHF and CHR"},
    {Takes::Points, "AP RP RND RNDM CHF CHR FRC FRCM I1 J1 K1 TURN", "CIP has an end point and I1, J1, K1"},
    {Takes::Tangent, "AP RP RND RNDM CHF CHR FRC FRCM", "CT has an end point only"},
    {Takes::Frame, "", "it takes axes only"},
    {Takes::Turn, "RPL", "it takes X, Y and Z, or RPL"},
    {Takes::Pole, "AP RP", "it takes X, Y and Z, or AP and RP"},
    {Takes::Limit, "", "it takes axes, or S"},
    {Takes::Dwell, "", "it takes F in seconds, or S in turns of the spindle"},
    {Takes::Fixed, "FP", "it takes axes with any value, and FP"},
    {Takes::Measure, "AP RP ANG", "a measuring block is a straight line"},
};

/// Words of a motion that stand beside each of them: weights of splines, soft approach, the orientation of the tool.
bool staysBeside(Takes takes, std::string_view name) {
  const bool motion = takes <= Takes::Spline || takes == Takes::Measure;
  const KeywordEntry* entry = keywordEntry(name);
  return motion && entry != nullptr && entry->effect != Effect::CarriedOut;
}

/// True for words that say how a block goes to its end, not which axis goes there.
bool isParameter(std::string_view name) {
  if (name.size() <= 2 && name.front() >= 'I' && name.front() <= 'K' && (name.size() == 1 || name[1] == '1'))
    return true;
  return keywordOf(name) == Keyword::MoveWord && name != "AX";
}

bool contains(std::string_view names, std::string_view wanted) {
  bool found = false;
  eachName(names, [&](std::string_view name) { found = found || name == wanted; });
  return found;
}

/// Poles and rotations have geometry axes only; what AX[axis]= means the run knows.
bool isGeometryAxis(std::string_view name) {
  return name == "X" || name == "Y" || name == "Z" || name == "AX[]" || name == "=AX";
}

/// The axes of a plane.
std::string_view axesOf(int plane) { return plane == 18 ? "ZX" : plane == 19 ? "YZ" : "XY"; }

}  // namespace

std::optional<int> groupOf(std::string_view name) {
  const auto found = groupTable().find(name);
  if (found != groupTable().end()) return found->second;
  const bool settable = name.size() == 4 && name[0] == 'G' && name[1] == '5' && name > "G504";
  if (settable) return 8;
  return std::nullopt;
}

std::optional<WordMistake> wordMistake(Takes takes, std::string_view name, const Block& block, WordRange range,
                                       std::optional<int> plane) {
  if (takes == Takes::Spline) return std::nullopt;
  const std::span<const Word> words = std::span<const Word>(block.words).subspan(range.first, range.count);
  const Row& row = *std::ranges::find(rows, takes, &Row::takes);
  const Word* polar = nullptr;
  const Word* given[3] = {};
  const Word* centre = nullptr;
  const Word* radius = nullptr;
  const Word* opening = nullptr;
  for (const Word& word : words) {
    std::string written = addressName(word.address);
    if (written == "=IP" || written == "IP[]") {  // IP[axis]=: I, J or K
      written = "IP";
    }
    if (written == "IP" && (takes == Takes::Arc || takes == Takes::Thread)) {
      centre = &word;
      continue;
    }
    if (written == "F" || written == "S" || written == "MEAS" || written == "MAX" || written == "MMO") continue;
    const bool ofDwell = takes == Takes::Dwell && written.front() == 'S';
    const bool axis = !isParameter(written) && !ofDwell;
    const bool ofGeometry = takes == Takes::Turn || takes == Takes::Pole;
    if ((axis && (takes == Takes::Dwell || (ofGeometry && !isGeometryAxis(written)))) ||
        (isParameter(written) && !contains(row.words, written) && !staysBeside(takes, written))) {
      return WordMistake{word.column, fmt::format("{} takes no {}", name, written),
                         fmt::format("Take it away: {}.", row.advice), takes == Takes::Dwell ? "12120" : "12110"};
    }
    if (polar == nullptr && (written == "AP" || written == "RP")) polar = &word;
    if (centre == nullptr && (written == "I" || written == "J" || written == "K")) centre = &word;
    if (written == "CR") radius = &word;
    if (written == "AR") opening = &word;
    if (word.address >= 'X' && word.address <= 'Z') given[word.address - 'X'] = &word;
  }
  const auto inPlane = [&](int axis) {
    return plane && axesOf(*plane).find(static_cast<char>('X' + axis)) != std::string_view::npos;
  };
  const Word* ofPlane = nullptr;
  int count = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (given[axis] == nullptr) continue;
    ++count;
    if (ofPlane == nullptr && inPlane(axis)) ofPlane = given[axis];
  }
  // Two of three axes: one of them lies in whatever plane.
  if (ofPlane == nullptr && !plane && count > 1) ofPlane = given[0] != nullptr ? given[0] : given[1];
  if (polar != nullptr && ofPlane != nullptr) {
    return WordMistake{ofPlane->column,
                       fmt::format("{} stands beside {}: the end point is polar or Cartesian, not both",
                                   addressName(ofPlane->address), addressName(polar->address)),
                       "Write AP and RP, or the axes of the plane.", "14280"};
  }
  if (takes != Takes::Arc) return std::nullopt;
  const auto both = [&](const Word& one, const Word& other, std::string_view advice) {
    return WordMistake{
        other.column,
        fmt::format("{} and {} determine the arc twice", addressName(one.address), addressName(other.address)),
        std::string(advice), "12110"};
  };
  if (radius != nullptr && centre != nullptr)
    return both(*centre, *radius, "Write the centre with I, J, K, or the radius with CR.");
  if (radius != nullptr && opening != nullptr) return both(*radius, *opening, "Write CR, or AR with the end point.");
  const bool ends = ofPlane != nullptr || polar != nullptr;
  if (opening != nullptr && centre != nullptr && ends)
    return both(ofPlane != nullptr ? *ofPlane : *polar, *opening,
                "Write AR with the end point, or AR with the centre I, J, K.");
  return std::nullopt;
}

}  // namespace probewright::language::sinumerik
