#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

/// The conversational language of a control: what its logs and screens are written in. Programs do not depend on it.
namespace probewright::control {

enum class DialogLanguage : std::uint8_t { English, Russian, Swedish, Chinese, Polish, German };

inline constexpr std::array allDialogLanguages = {DialogLanguage::English, DialogLanguage::Russian,
                                                  DialogLanguage::Swedish, DialogLanguage::Chinese,
                                                  DialogLanguage::Polish,  DialogLanguage::German};

/// "en", "ru", "sv", "zh", "pl", "de" (ISO 639-1).
constexpr std::string_view code(DialogLanguage language) {
  constexpr std::array<std::string_view, 6> codes = {"en", "ru", "sv", "zh", "pl", "de"};
  return codes[static_cast<std::size_t>(language)];
}

/// The language with this code, or nothing.
constexpr std::optional<DialogLanguage> dialogLanguageOf(std::string_view text) {
  for (const DialogLanguage language : allDialogLanguages) {
    if (code(language) == text) return language;
  }
  return std::nullopt;
}

}  // namespace probewright::control
