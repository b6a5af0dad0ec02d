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

std::vector<std::string> inOtherLanguages(std::string_view english) {
  const auto found = table().find(english);
  return found == table().end() ? std::vector<std::string>() : found->get<std::vector<std::string>>();
}

}  // namespace probewright::words
