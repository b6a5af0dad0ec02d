#include "words/cycle_words.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "words/own_words.hpp"

// Defined in tables.S.
extern "C" {
extern const char probewrightWordsCycles[];
extern const char probewrightWordsCyclesEnd[];
}

namespace probewright::words {

namespace {

/// In the order of the columns.
constexpr std::array columns = {DialogLanguage::German, DialogLanguage::Russian, DialogLanguage::Swedish,
                                DialogLanguage::Chinese, DialogLanguage::Polish};

const nlohmann::json& table() {
  static const nlohmann::json all = [] {
    nlohmann::json words = nlohmann::json::parse(probewrightWordsCycles, probewrightWordsCyclesEnd);
    addOwnWords(words);
    return words;
  }();
  return all;
}

}  // namespace

std::string ofCatalogue(DialogLanguage language, std::string_view english) {
  const auto* const column = std::ranges::find(columns, language);
  if (column == columns.end()) return std::string(english);
  const auto found = table().find(english);
  if (found == table().end()) return std::string(english);
  return found->at(static_cast<std::size_t>(column - columns.begin())).get<std::string>();
}

std::string ofCatalogue(DialogLanguage language, std::string_view english, const std::vector<std::string>& values) {
  std::string text = ofCatalogue(language, english);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string place = "{" + std::to_string(i) + "}";
    if (const std::size_t at = text.find(place); at != std::string::npos) text.replace(at, place.size(), values[i]);
  }
  return text;
}

namespace {

/// What the table says of a piece of a code: "outside diameter", or "D 1", a meaning and its number. Empty: nothing.
std::vector<std::string> wordsOfPiece(std::string_view english) {
  const auto whole = table().find(english);
  if (whole != table().end()) return whole->get<std::vector<std::string>>();
  const std::size_t blank = english.rfind(' ');
  if (blank == std::string_view::npos || english.find_first_not_of("0123456789", blank + 1) != std::string_view::npos)
    return {};
  const auto found = table().find(english.substr(0, blank));
  if (found == table().end()) return {};
  auto words = found->get<std::vector<std::string>>();
  for (std::string& word : words)
    word += english.substr(blank);
  return words;
}

/// A parameter of digits with what they choose: "measuring variant: front edge, measure only". What is chosen may hold
/// a comma itself, so the longest piece that the table knows counts.
std::vector<std::string> wordsOfCode(std::string_view english) {
  constexpr std::string_view colon = ": ", comma = ", ";
  const std::size_t end = english.find(colon);
  if (end == std::string_view::npos) return {};
  std::vector<std::string> texts = wordsOfPiece(english.substr(0, end));
  if (texts.size() != columns.size()) return {};
  std::string_view rest = english.substr(end + colon.size());
  for (bool first = true; !rest.empty(); first = false) {
    std::size_t piece = rest.size();
    std::vector<std::string> words = wordsOfPiece(rest);
    while (words.empty()) {
      piece = piece == 0 ? std::string_view::npos : rest.rfind(comma, piece - 1);
      if (piece == std::string_view::npos) return {};
      words = wordsOfPiece(rest.substr(0, piece));
    }
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const bool wide = columns.at(i) == DialogLanguage::Chinese;
      texts.at(i) += (wide ? (first ? "\uff1a" : "\uff0c") : (first ? ": " : ", ")) + words.at(i);
    }
    rest.remove_prefix(std::min(rest.size(), piece + comma.size()));
  }
  return texts;
}

}  // namespace

std::vector<std::string> inOtherLanguages(std::string_view english) {
  std::vector<std::string> words = wordsOfPiece(english);
  return words.empty() ? wordsOfCode(english) : words;
}

}  // namespace probewright::words
