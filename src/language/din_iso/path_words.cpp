#include "language/din_iso/path_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

namespace probewright::language::din_iso {

namespace {

/// The words of a path function beside its axes.
struct PathWords {
  int path;
  bool polar;              ///< its end point is R and H, or H alone; of X, Y, Z it takes the axis along the tool only
  std::string_view words;  ///< letters; "+" stands for G43 and G44
  std::string_view takes;  ///< all its words, as a message names them
  int twin;                ///< the same path with the other kind of coordinates
};

constexpr std::string_view line = "axes, I, J, K, F and M";
constexpr std::string_view arc = "axes, I, J, K or R, F and M";
constexpr std::string_view polarLine = "R, H, the axis along the tool, I, J, K, F and M";
constexpr std::string_view polarArc = "H, the axis along the tool, I, J, K, F and M";

constexpr std::array<PathWords, 13> table = {{{0, false, "+", line, 10},
                                              {1, false, "+", line, 11},
                                              {2, false, "R", arc, 12},
                                              {3, false, "R", arc, 13},
                                              {5, false, "R", arc, 15},
                                              {6, false, "", line, 16},
                                              {7, false, "+", line, 11},
                                              {10, true, "RH", polarLine, 0},
                                              {11, true, "RH", polarLine, 1},
                                              {12, true, "H", polarArc, 2},
                                              {13, true, "H", polarArc, 3},
                                              {15, true, "H", polarArc, 5},
                                              {16, true, "RH", polarLine, 6}}};

bool isPlaneAxis(const Word& word) { return word.address >= 'X' && word.address <= 'Z'; }

/// G43 and G44.
bool isParaxial(const Word& word) { return word.address == addressOf("R") && word.mode == WordMode::DirectShortest; }

bool isFeed(const Word& word) { return word.address == addressOf("FU") || word.address == addressOf("FZ"); }

std::string adviceAgainst(const PathWords& function, const Word& word) {
  const bool ofPole = word.address == addressOf("R") || word.address == addressOf("H");
  if (isParaxial(word)) return "write the paraxial compensation in a block with G00 or G01";
  if (function.polar && ofPole) return "take it away: the radius is the distance of the starting point from the pole";
  if (!function.polar && ofPole) return fmt::format("write G{:02} for polar coordinates", function.twin);
  return fmt::format("take it away: G{:02} takes {}", function.path, function.takes);
}

}  // namespace

bool isPath(int number) { return std::ranges::find(table, number, &PathWords::path) != table.end(); }

std::optional<int> pathOf(const Block& block) {
  for (const Instruction& instruction : block.instructions) {
    const auto* modal = std::get_if<Modal>(&instruction);
    if (modal == nullptr) continue;
    const std::string_view name = block.at(modal->name);
    if (!name.starts_with('G')) continue;
    int number = -1;
    std::from_chars(name.data() + 1, name.data() + name.size(), number);
    if (isPath(number)) return number;
  }
  return std::nullopt;
}

std::optional<PathMistake> pathMistake(int path, const Block& block, const Move& move) {
  const auto function = std::ranges::find(table, path, &PathWords::path);
  if (function == table.end()) return std::nullopt;
  const Word* axis = nullptr;
  for (std::uint32_t i = 0; i < move.words.count; ++i) {
    const Word& word = block.words[move.words.first + i];
    if (isFeed(word)) continue;
    const bool coordinate = word.address == addressOf("R") || word.address == addressOf("H");
    const char letter = isParaxial(word) ? '+' : static_cast<char>(word.address);
    if (coordinate && function->words.find(letter) == std::string_view::npos) {
      const std::string name = !isParaxial(word) ? addressName(word.address) : word.value.number > 0 ? "G43" : "G44";
      return PathMistake{word, fmt::format("G{:02} takes no {}", path, name), adviceAgainst(*function, word)};
    }
    if (!function->polar || !isPlaneAxis(word)) continue;
    if (axis != nullptr) {
      return PathMistake{word,
                         fmt::format("G{:02} takes polar coordinates, and this block has {} and {}", path,
                                     addressName(axis->address), addressName(word.address)),
                         fmt::format("write G{:02} for axes of the plane", function->twin)};
    }
    axis = &word;
  }
  return std::nullopt;
}

}  // namespace probewright::language::din_iso
