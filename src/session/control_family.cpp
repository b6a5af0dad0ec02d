#include "session/control_family.hpp"

#include <algorithm>
#include <stdexcept>

#include "base/text.hpp"
#include "session/heidenhain/family.hpp"
#include "session/sinumerik/family.hpp"

namespace probewright::session {

using control::ControlKind;

const ControlFamily& ControlFamilies::of(ControlKind control) const {
  for (const ControlFamily& family : families_) {
    if (std::ranges::find(family.controls, control, &ControlModel::kind) != family.controls.end()) return family;
  }
  throw std::logic_error("a control of no family");
}

const ControlFamily& ControlFamilies::of(ProgramLanguage language) const {
  for (const ControlFamily& family : families_) {
    if (std::ranges::find(family.languages, language, &LanguageEntry::language) != family.languages.end())
      return family;
  }
  throw std::logic_error("a language of no family");
}

const LanguageEntry& ControlFamilies::entry(ProgramLanguage language) const {
  return *std::ranges::find(of(language).languages, language, &LanguageEntry::language);
}

const ControlModel& ControlFamilies::model(ControlKind control) const {
  return *std::ranges::find(of(control).controls, control, &ControlModel::kind);
}

bool ControlFamilies::speaks(ControlKind control, ProgramLanguage language) const {
  return &of(control) == &of(language);
}

std::vector<std::string> ControlFamilies::controlNames() const {
  std::vector<std::string> names;
  for (const ControlFamily& family : families_) {
    for (const ControlModel& model : family.controls) {
      names.emplace_back(model.name);
      names.insert(names.end(), model.alsoCalled.begin(), model.alsoCalled.end());
    }
  }
  return names;
}

std::optional<ControlKind> ControlFamilies::controlNamed(std::string_view text) const {
  const auto plain = [](std::string_view written) {
    std::string letters;
    for (const char c : written) {
      if (isLetter(c) || isDigit(c)) letters += lower(c);
    }
    return letters;
  };
  const std::string wanted = plain(text);
  const auto isIt = [&](std::string_view name) { return plain(name) == wanted; };
  for (const ControlFamily& family : families_) {
    for (const ControlModel& model : family.controls) {
      if (isIt(model.name) || std::ranges::any_of(model.alsoCalled, isIt) ||
          std::ranges::any_of(model.alsoUnderstood, isIt))
        return model.kind;
    }
  }
  return std::nullopt;
}

const ControlFamilies& knownFamilies() {
  static const ControlFamilies families({heidenhain::heidenhainFamily(), sinumerik::sinumerikFamily()});
  return families;
}

}  // namespace probewright::session
