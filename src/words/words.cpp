#include "words/words.hpp"

#include <fmt/format.h>

#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <vector>

#include "words/own_words.hpp"

// Defined in tables.S.
#define PROBEWRIGHT_TABLE(name) \
  extern const char name[];     \
  extern const char name##End[]
extern "C" {
PROBEWRIGHT_TABLE(probewrightWordsEn);
PROBEWRIGHT_TABLE(probewrightWordsDe);
PROBEWRIGHT_TABLE(probewrightWordsRu);
PROBEWRIGHT_TABLE(probewrightWordsSv);
PROBEWRIGHT_TABLE(probewrightWordsZh);
PROBEWRIGHT_TABLE(probewrightWordsPl);
PROBEWRIGHT_TABLE(probewrightWordsPhrases);
PROBEWRIGHT_TABLE(probewrightWordsAlarms);
}
#undef PROBEWRIGHT_TABLE

namespace probewright::words {

namespace {

using nlohmann::json;

json tableOf(DialogLanguage language) {
  switch (language) {
    case DialogLanguage::English:
      return json::parse(probewrightWordsEn, probewrightWordsEnEnd);
    case DialogLanguage::German:
      return json::parse(probewrightWordsDe, probewrightWordsDeEnd);
    case DialogLanguage::Russian:
      return json::parse(probewrightWordsRu, probewrightWordsRuEnd);
    case DialogLanguage::Swedish:
      return json::parse(probewrightWordsSv, probewrightWordsSvEnd);
    case DialogLanguage::Chinese:
      return json::parse(probewrightWordsZh, probewrightWordsZhEnd);
    case DialogLanguage::Polish:
      return json::parse(probewrightWordsPl, probewrightWordsPlEnd);
  }
  throw std::logic_error("a language without a table");
}

const json& table(DialogLanguage language) {
  static std::map<DialogLanguage, json> tables;
  const auto found = tables.find(language);
  return found != tables.end() ? found->second : tables.emplace(language, tableOf(language)).first->second;
}

/// The column of phrases.json; nothing for English.
std::optional<std::size_t> columnOf(DialogLanguage language) {
  switch (language) {
    case DialogLanguage::English:
      return std::nullopt;
    case DialogLanguage::German:
      return 0;
    case DialogLanguage::Russian:
      return 1;
    case DialogLanguage::Swedish:
      return 2;
    case DialogLanguage::Chinese:
      return 3;
    case DialogLanguage::Polish:
      return 4;
  }
  return std::nullopt;
}

/// The plural form of Unicode's CLDR for a whole number.
const char* pluralOf(DialogLanguage language, std::size_t n) {
  const std::size_t units = n % 10, tens = n % 100;
  const bool teens = tens >= 11 && tens <= 14;
  switch (language) {
    case DialogLanguage::Chinese:
      return "other";
    case DialogLanguage::Russian:
      if (units == 1 && !teens) return "one";
      return units >= 2 && units <= 4 && !teens ? "few" : "many";
    case DialogLanguage::Polish:
      if (n == 1) return "one";
      return units >= 2 && units <= 4 && !teens ? "few" : "many";
    case DialogLanguage::English:
    case DialogLanguage::German:
    case DialogLanguage::Swedish:
      break;
  }
  return n == 1 ? "one" : "other";
}

const json& entry(DialogLanguage language, std::string_view key) {
  const json& words = table(language);
  const auto found = words.find(key);
  if (found == words.end()) throw std::logic_error(fmt::format("no text for {}", key));
  return *found;
}

/// The text with values for its {names}; other braces stay.
std::string filled(const std::string& text, Values values) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t open = text.find('{', at);
    const std::size_t close = text.find('}', open);
    if (close == std::string::npos) return result + text.substr(at);
    const std::string_view name = std::string_view(text).substr(open + 1, close - open - 1);
    result += text.substr(at, open - at);
    const auto* found = std::ranges::find(values, name, &std::pair<std::string_view, std::string>::first);
    result += found == values.end() ? text.substr(open, close - open + 1) : found->second;
    at = close + 1;
  }
  return result;
}

/// A phrase with places: "axis {0} would go to {1}" is {"axis ", " would go to ", ""}.
struct Pattern {
  std::vector<std::string> pieces;
  const json* words;
};

std::vector<std::string> piecesOf(const std::string& phrase) {
  std::vector<std::string> pieces;
  std::size_t at = 0;
  for (std::size_t open; (open = phrase.find('{', at)) != std::string::npos; at = open + 3)
    pieces.push_back(phrase.substr(at, open - at));
  pieces.push_back(phrase.substr(at));
  return pieces;
}

/// What stands in the places, if the text is such a phrase: each as short as possible.
std::optional<std::vector<std::string>> fit(std::string_view text, const std::vector<std::string>& pieces) {
  if (!text.starts_with(pieces.front())) return std::nullopt;
  std::vector<std::string> values;
  std::size_t at = pieces.front().size();
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    const bool last = i + 1 == pieces.size();
    const std::string& piece = pieces[i];
    std::size_t next = 0;
    if (last) {
      if (text.size() < at + piece.size() || !text.ends_with(piece)) return std::nullopt;
      next = text.size() - piece.size();
    } else {
      next = text.find(piece, at);
      if (next == std::string_view::npos) return std::nullopt;
    }
    if (next == at) return std::nullopt;
    values.emplace_back(text.substr(at, next - at));
    at = next + piece.size();
  }
  return values;
}

struct Phrases {
  json exact = json::parse(probewrightWordsPhrases, probewrightWordsPhrasesEnd);
  std::vector<Pattern> patterns;  ///< the ones with the most words in them first
  Phrases() {
    // What alarms of single cycles say: the page of a run gets those that it needs.
    exact.update(json::parse(probewrightWordsAlarms, probewrightWordsAlarmsEnd));
    addOwnWords(exact);
    for (const auto& [english, words] : exact.items()) {
      if (english.find("{0}") != std::string::npos) patterns.push_back({piecesOf(english), &words});
    }
    const auto length = [](const Pattern& pattern) {
      std::size_t sum = 0;
      for (const std::string& piece : pattern.pieces)
        sum += piece.size();
      return sum;
    };
    std::ranges::stable_sort(patterns, [&](const Pattern& a, const Pattern& b) { return length(a) > length(b); });
  }
};

const Phrases& phrases() {
  static const Phrases all;
  return all;
}

/// A phrase that the table has word for word.
std::optional<std::string> exactly(DialogLanguage language, std::string_view english) {
  const std::optional<std::size_t> column = columnOf(language);
  const json& all = phrases().exact;
  const auto found = all.find(english);
  if (!column || found == all.end()) return std::nullopt;
  return found->at(*column).get<std::string>();
}

std::optional<std::string> known(DialogLanguage language, std::size_t column, std::string_view english) {
  const Phrases& all = phrases();
  if (const auto found = all.exact.find(english); found != all.exact.end()) return found->at(column).get<std::string>();
  for (const Pattern& pattern : all.patterns) {
    const auto values = fit(english, pattern.pieces);
    if (!values) continue;
    std::string text = pattern.words->at(column).get<std::string>();
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t open = text.find('{', at);
      if (open == std::string::npos) {
        result += text.substr(at);
        break;
      }
      result += text.substr(at, open - at);
      result += translated(language, values->at(static_cast<std::size_t>(text.at(open + 1) - '0')));
      at = open + 3;
    }
    return result;
  }
  return std::nullopt;
}

}  // namespace

std::string text(DialogLanguage language, std::string_view key, Values values) {
  return filled(entry(language, key).get<std::string>(), values);
}

std::string counted(DialogLanguage language, std::string_view key, std::size_t n, Values values) {
  const json& forms = entry(language, key);
  const auto form = forms.find(pluralOf(language, n));
  const std::string& chosen = (form == forms.end() ? forms.at("other") : *form).get_ref<const std::string&>();
  return filled(filled(chosen, values), {{"n", std::to_string(n)}});
}

std::string translated(DialogLanguage language, std::string_view english) {
  const std::optional<std::size_t> column = columnOf(language);
  if (!column || english.empty()) return std::string(english);
  const std::size_t colon = english.find(": ");
  // The name of an alarm first: else what it says would be taken for a value of some sentence.
  const auto& exact = phrases().exact;
  if (const auto name = exact.find(english.substr(0, colon)); colon != std::string_view::npos && name != exact.end())
    return name->at(*column).get<std::string>() + ": " + translated(language, english.substr(colon + 2));
  if (auto whole = known(language, *column, english)) return *whole;
  if (colon == std::string_view::npos) {
    // A feature with its size.
    const std::size_t size = english.find_first_of("0123456789");
    if (size != std::string_view::npos && size > 1 && english[size - 1] == ' ') {
      if (const auto name = exact.find(english.substr(0, size - 1)); name != exact.end())
        return name->at(*column).get<std::string>().append(english.substr(size - 1));
    }
    return std::string(english);
  }
  const std::string_view name = english.substr(0, colon), sentence = english.substr(colon + 2);
  return known(language, *column, name).value_or(std::string(name)) + ": " + translated(language, sentence);
}

std::string phrase(DialogLanguage language, std::string_view english) {
  const std::optional<std::size_t> column = columnOf(language);
  return column ? known(language, *column, english).value_or(std::string(english)) : std::string(english);
}

std::string characteristic(DialogLanguage language, const control::Characteristic& of, std::string_view english) {
  if (language == DialogLanguage::English || of.quantity == control::Quantity::None) return std::string(english);
  if (const auto own = exactly(language, english)) return *own;
  const json& words = table(language);
  const auto quantity = words.find(fmt::format("quantity_{}", nameOf(of.quantity)));
  if (quantity == words.end()) return std::string(english);
  std::string text = quantity->get<std::string>();
  if (of.item > 0) text += fmt::format(" {}", of.item);
  if (of.along != control::Along::None) {
    const auto along = words.find(fmt::format("along_{}", nameOf(of.along)));
    text += ", " + (along == words.end() ? std::string(nameOf(of.along)) : along->get<std::string>());
  }
  if (of.system == control::System::Machine) text += ", " + words.at("system_machine").get<std::string>();
  return text;
}

std::string meaning(DialogLanguage language, const control::ResultKind& kind, std::string_view english) {
  if (const auto own = exactly(language, english)) return *own;
  const std::string of = characteristic(language, kind.of, "");
  if (language == DialogLanguage::English || of.empty()) return phrase(language, english);
  return fmt::format("{}, {}", text(language, fmt::format("role_{}", nameOf(kind.role))), of);
}

}  // namespace probewright::words
