#include "cycle_search.hpp"

#include <unicode/normalizer2.h>
#include <unicode/uchar.h>
#include <unicode/unistr.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <string>

#include "words/cycle_words.hpp"

namespace probewright::app {

namespace {

using cycles::CycleDefinition;

/// Small letters without accents.
std::string plain(std::string_view text) {
  UErrorCode error = U_ZERO_ERROR;
  const icu::Normalizer2* apart = icu::Normalizer2::getNFDInstance(error);
  icu::UnicodeString letters =
      icu::UnicodeString::fromUTF8({text.data(), static_cast<std::int32_t>(text.size())}).foldCase();
  if (U_SUCCESS(error) != 0) letters = apart->normalize(letters, error);
  icu::UnicodeString bare;
  for (std::int32_t i = 0; i < letters.length(); i = letters.moveIndex32(i, 1)) {
    const UChar32 letter = letters.char32At(i);
    if (u_charType(letter) == U_NON_SPACING_MARK) continue;
    bare.append(letter == U'ł' ? UChar32{'l'} : letter);
  }
  std::string result;
  bare.toUTF8String(result);
  return result;
}

/// How words begin, and what the catalogue says for it. Several mean any of them.
struct Meaning {
  std::array<std::string_view, 3> catalogue;
  std::array<std::string_view, 20> stems;
};

constexpr Meaning meanings[] = {
    {{"hole", "inside circle", "ring"},
     {"bore", "bohrung", "otvor", "otverst", "отверст", "hal", "hål", "odwiert", "otwor", "otwór", "孔", "öffnung",
      "oeffnung", "löcher", "loecher", "halet", "borrhal"}},
    {{"stud", "spigot", "circle outside"},
     {"boss", "pin", "island", "shaft", "zapfen", "welle", "остров", "цапф", "вал", "tapp", "czop", "凸台", "圆柱"}},
    {{"preset", "zero offset"},
     {"datum", "origin", "bezugspunkt", "nullpunkt", "привязк", "ноль", "utgangspunkt", "nollpunkt", "baza", "bazy",
      "odniesien", "原点", "零点"}},
    {{"edge"}, {"side", "kante", "кромк", "kant", "krawed", "边"}},
    {{"corner"}, {"ecke", "угол", "угл", "horn", "naroz", "角"}},
    {{"ball", "sphere"}, {"sphere", "kugel", "шар", "сфер", "kula", "kulk", "球"}},
    {{"ridge", "rib", "web"}, {"web", "steg", "перемычк", "ребр", "kam", "mostek", "zebr", "凸脊", "筋"}},
    {{"slot", "groove"}, {"nut", "nuten", "паз", "канавк", "spar", "rowek", "槽"}},
    {{"misalignment", "rotation", "angle"},
     {"skew", "align", "schieflage", "ausricht", "наклон", "выравн", "перекос", "snedstall", "ukos", "wyrown", "不对正",
      "找正"}},
    {{"rotation"}, {"drehung", "grunddrehung", "поворот", "vridning", "obrot", "旋转"}},
    {{"rectan", "pocket"},
     {"pocket", "tasche", "rechteck", "карман", "прямоуг", "ficka", "rektang", "kiesz", "prostok", "型腔", "矩形"}},
    {{"plane"}, {"ebene", "плоск", "plan", "plaszcz", "平面"}},
    {{"calibrat"}, {"kalibrier", "калибр", "kalibrer", "kalibrow", "kalibrac", "校准"}},
    {{"tool"}, {"werkzeug", "инструмент", "verktyg", "narzedz", "刀具"}},
    {{"tool length"}, {"werkzeuglange", "laenge", "длин", "langd", "dlugosc", "长度"}},
    {{"radius"}, {"halbmesser", "радиус", "radie", "promien", "半径"}},
    {{"diameter"}, {"durchmesser", "диаметр", "diameter", "srednic", "直径"}},
    {{"width"}, {"breite", "ширин", "bredd", "szerokosc", "宽"}},
    {{"kinematics"}, {"kinematik", "кинематик", "kinematyk", "运动"}},
    {{"bolt hole circ", "circle center"}, {"lochkreis", "окружн", "halcirkel", "okrag", "螺栓"}},
    {{"working space", "camera"}, {"kamera", "камер", "摄像", "相机"}},
    {{"turn", "lathe"}, {"drehen", "drehmaschine", "токарн", "svarv", "tocz", "tokark", "车"}},
    {{"ring"}, {"einstellring", "кольц", "pierscien", "环"}},
    {{"rotary", "axis"}, {"drehachse", "rundachse", "rotationsaxel", "os", "轴"}},
    {{"measuring log"}, {"protokoll", "протокол", "matprotokoll", "日志"}},
    {{"coordinate", "in one axis"}, {"koordinate", "координат", "koordinat", "wspolrz", "坐标"}},
};

/// What to look for instead of a word: itself, and what the catalogue says for it.
std::vector<std::string> looksFor(const std::string& word) {
  std::vector<std::string> all = {word};
  const bool letters = static_cast<unsigned char>(word.front()) < 0xE3;  // ideographs are not inflected
  for (const Meaning& meaning : meanings) {
    const bool meant = std::ranges::any_of(meaning.stems, [&](std::string_view stem) {
      if (stem.empty()) return false;
      const std::string begin = plain(stem);
      // Short stems are whole words: "pin" is not the beginning of "pinion".
      return !letters           ? word.find(begin) != std::string::npos
             : begin.size() < 4 ? word == begin
                                : word.starts_with(begin);
    });
    if (!meant) continue;
    for (const std::string_view entry : meaning.catalogue)
      if (!entry.empty()) all.emplace_back(entry);
  }
  return all;
}

}  // namespace

std::vector<const CycleDefinition*> cyclesAbout(std::string_view sought,
                                                const std::vector<const CycleDefinition*>& known) {
  std::vector<std::vector<std::string>> wanted;
  std::istringstream stream(plain(sought));
  for (std::string word; stream >> word;) {
    if (word.size() < 2) return {};
    wanted.push_back(looksFor(word));
  }
  if (wanted.empty()) return {};
  const auto all = [&](const std::string& text) {
    return std::ranges::all_of(wanted, [&](const std::vector<std::string>& alternatives) {
      return std::ranges::any_of(alternatives,
                                 [&](const std::string& each) { return text.find(each) != std::string::npos; });
    });
  };
  std::vector<const CycleDefinition*> titles, others;
  for (const CycleDefinition* cycle : known) {
    std::string text(cycle->title);
    if (all(plain(text))) {
      titles.push_back(cycle);
      continue;
    }
    text.append(" ").append(cycle->summary);
    for (const cycles::Parameter& parameter : cycle->parameters)
      text.append("\n").append(parameter.name).append(" ").append(parameter.meaning);
    for (const auto& result : cycle->results)
      text.append("\n").append(result.name).append(" ").append(result.meaning.whole());
    if (all(plain(text))) others.push_back(cycle);
  }
  titles.insert(titles.end(), others.begin(), others.end());
  if (!titles.empty()) return titles;
  // A word of another language, such as "Schnelles Antasten" of a title, "Sicherheitsabstand" of a parameter.
  others.clear();
  for (const CycleDefinition* cycle : known) {
    std::string text;
    const auto add = [&text](std::string_view english) {
      for (const std::string& translation : words::inOtherLanguages(english))
        text.append(translation).append("\n");
    };
    add(cycle->title);
    if (all(plain(text))) {
      titles.push_back(cycle);
      continue;
    }
    add(cycle->summary);
    for (const cycles::Parameter& parameter : cycle->parameters)
      add(parameter.meaning);
    if (all(plain(text))) others.push_back(cycle);
  }
  titles.insert(titles.end(), others.begin(), others.end());
  return titles;
}

}  // namespace probewright::app
