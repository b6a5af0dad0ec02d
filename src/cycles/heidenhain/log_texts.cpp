#include "cycles/heidenhain/log_texts.hpp"

#include <algorithm>
#include <array>
#include <cctype>

namespace probewright::cycles::heidenhain {
namespace {

constexpr LogFrame english{
    .title = "Measuring Log for Probing Cycle {} {}",
    .date = "Date:",
    .time = "Time:",
    .program = "Measuring program:",
    .dateForm = "{:%d-%m-%Y}",
    .nominal = "Nominal values:",
    .limits = "Given limit values:",
    .actual = "Actual values:",
    .deviations = "Deviations:",
    .further = "Further measuring results:",
    .end = "End of measuring log",
};

constexpr LogFrame capitals{
    .title = "MEASURING LOG FOR PROBING CYCLE {}: {}",
    .date = "DATE:",
    .time = "TIME:",
    .program = "MEASURING PROGRAM:",
    .dateForm = "{:%d-%m-%Y}",
    .nominal = "NOML. VALUES:",
    .limits = "GIVEN LIMIT VALUES:",
    .actual = "ACTUAL VALUES:",
    .deviations = "DEVIATIONS:",
    .further = "FURTHER MEASURING RESULTS:",
    .end = "END OF MEASURING LOG",
};

constexpr LogFrame russian{
    .title = "Протокол измерений цикла {} {}",
    .date = "Дата:",
    .time = "Время:",
    .program = "Программа измерения:",
    .dateForm = "{:%d.%m.%Y}",
    .nominal = "Заданные значения:",
    .limits = "Заданные предельные значения:",
    .actual = "Фактические значения:",
    .deviations = "Погрешности:",
    .further = "Прочие результаты измерений:",
    .end = "Окончание протокола измерения",
};

constexpr LogFrame swedish{
    .title = "Mätprotokoll avkännarcykel {} {}",
    .date = "Datum:",
    .time = "Klockan:",
    .program = "Mätprogram:",
    .dateForm = "{:%d-%m-%Y}",
    .nominal = "Börvärden:",
    .limits = "Givna gränsvärden:",
    .actual = "Ärvärden:",
    .deviations = "Avvikelser:",
    .further = "Ytterligare mätresultat:",
    .end = "Mätprotokoll slut",
};

constexpr std::array terms = {
    // Lines of the logs of cycles 420 to 431.
    LogTerm{"Center in reference axis", "Центр главной оси", "Centrum huvudaxel"},
    LogTerm{"Center in minor axis", "Центр вспомогательной оси", "Centrum komplementaxel"},
    LogTerm{"Maximum limit for center in reference axis", "Максимальный размер центра главной оси",
            "Största mått centrum huvudaxel"},
    LogTerm{"Minimum limit for center in reference axis", "Наименьший размер центра главной оси",
            "Minsta mått centrum huvudaxel"},
    LogTerm{"Maximum limit for center in minor axis", "Максимальный размер центра вспомогательной оси",
            "Största mått centrum komplementaxel"},
    LogTerm{"Minimum limit for center in minor axis", "Наименьший размер центра вспомогательной оси",
            "Minsta mått centrum komplementaxel"},
    LogTerm{"Diameter", "Диаметр", "Diameter"},
    LogTerm{"Maximum dimension for hole", "Максимальный размер отверстия", "Största mått hål"},
    LogTerm{"Minimum dimension for hole", "Наименьший размер отверстия", "Minsta mått hål"},
    LogTerm{"Maximum dimension for stud", "Максимальный размер острова", "Största mått tapp"},
    LogTerm{"Minimum dimension for stud", "Наименьший размер острова", "Minsta mått tapp"},
    LogTerm{"Side length in reference axis", "Длина стороны главной оси", "Sidlängd huvudaxel"},
    LogTerm{"Side length in minor axis", "Длина стороны вспомогательной оси", "Sidlängd komplementaxel"},
    LogTerm{"Maximum dimension for side length in reference axis", "Максимальный размер длины стороны главной оси",
            "Största mått sidlängd huvudaxel"},
    LogTerm{"Minimum dimension for side length in reference axis", "Наименьший размер длины стороны главной оси",
            "Minsta mått sidlängd huvudaxel"},
    LogTerm{"Maximum dimension for side length in minor axis", "Максимальный размер длины стороны вспомогательной оси",
            "Största mått sidlängd komplementaxel"},
    LogTerm{"Minimum dimension for side length in minor axis", "Наименьший размер длины стороны вспомогательной оси",
            "Minsta mått sidlängd komplementaxel"},
    LogTerm{"Length", "Длина", "Längd"},
    LogTerm{"Maximum dimension for length", "Максимальный размер длины", "Största mått längd"},
    LogTerm{"Minimum dimension for length", "Наименьший размер длины", "Minsta mått längd"},
    LogTerm{"Position of center line", "Положение центральной оси", "Läge centrumpunkt"},
    LogTerm{"Measured angle", "Измеренный угол", "Uppmätt vinkel"},
    LogTerm{"Measuring height", "Высота измерения", "Mäthöjd"},
    // Headings and lines of the logs in HTML.
    LogTerm{"Touch probe log", "Протокол измерительного щупа", "Avkännarprotokoll"},
    LogTerm{"tool", "инструмент", "verktyg"},
    LogTerm{"touch probe", "контактный щуп", "avkännarsystem"},
    LogTerm{"Before", "До", "Före"},
    LogTerm{"After", "После", "Efter"},
    LogTerm{"Radius of the standard", "Радиус калибра", "Normalens radie"},
    LogTerm{"Reference point for length", "Точка привязки для длины", "Utgångspunkt för längd"},
    LogTerm{"Number of touches", "Количество касаний", "Antal avkänningar"},
    LogTerm{"Ball radius", "Радиус наконечника", "Mätkulans radie"},
    LogTerm{"Coarse measurement", "Грубое измерение", "Grovmätning"},
    LogTerm{"Fine measurement", "Точное измерение", "Finmätning"},
    LogTerm{"Reversal measurement", "Измерение с поворотом на 180°", "Omslagsmätning"},
    LogTerm{"Measurement with angle tracking", "Измерение с отслеживанием угла", "Mätning med vinkelföljning"},
    LogTerm{"3-D calibration", "3D-калибровка", "3D-kalibrering"},
    LogTerm{"Largest deviation", "Наибольшее отклонение", "Största avvikelse"},
    LogTerm{"Probing direction", "Направление измерения", "Avkänningsriktning"},
    LogTerm{"Nominal", "Заданное значение", "Börvärde"},
    LogTerm{"Lower limit", "Наименьший размер", "Minsta mått"},
    LogTerm{"Upper limit", "Максимальный размер", "Största mått"},
    LogTerm{"Actual", "Фактическое значение", "Ärvärde"},
    LogTerm{"Deviation", "Отклонение", "Avvikelse"},
    LogTerm{"Status", "Состояние", "Status"},
    LogTerm{"good", "годен", "godkänd"},
    LogTerm{"rework", "доработка", "efterbearbetning"},
    LogTerm{"scrap", "брак", "skrot"},
    LogTerm{"Main axis", "Главная ось", "Huvudaxel"},
    LogTerm{"Minor axis", "Вспомогательная ось", "Komplementaxel"},
    LogTerm{"Tool axis", "Ось инструмента", "Verktygsaxel"},
    LogTerm{"Position 1, main axis", "Позиция 1, главная ось", "Position 1, huvudaxel"},
    LogTerm{"Position 1, minor axis", "Позиция 1, вспомогательная ось", "Position 1, komplementaxel"},
    LogTerm{"Position 1, tool axis", "Позиция 1, ось инструмента", "Position 1, verktygsaxel"},
    LogTerm{"Position 2, main axis", "Позиция 2, главная ось", "Position 2, huvudaxel"},
    LogTerm{"Position 2, minor axis", "Позиция 2, вспомогательная ось", "Position 2, komplementaxel"},
    LogTerm{"Position 2, tool axis", "Позиция 2, ось инструмента", "Position 2, verktygsaxel"},
    LogTerm{"Position 3, main axis", "Позиция 3, главная ось", "Position 3, huvudaxel"},
    LogTerm{"Position 3, minor axis", "Позиция 3, вспомогательная ось", "Position 3, komplementaxel"},
    LogTerm{"Position 3, tool axis", "Позиция 3, ось инструмента", "Position 3, verktygsaxel"},
    LogTerm{"Diameter 1", "Диаметр 1", "Diameter 1"},
    LogTerm{"Diameter 2", "Диаметр 2", "Diameter 2"},
    LogTerm{"Measured angle of the rotary table", "Измеренный угол поворотного стола", "Uppmätt vinkel rundbord"},
    LogTerm{"Deviation of the angle", "Отклонение угла", "Avvikelse vinkel"},
    LogTerm{"Deviation of the angle of the rotary table", "Отклонение угла поворотного стола",
            "Avvikelse vinkel rundbord"},
};

}  // namespace

const LogFrame& logFrame(DialogLanguage language) {
  switch (language) {
    case DialogLanguage::Russian:
      return russian;
    case DialogLanguage::Swedish:
      return swedish;
    case DialogLanguage::English:
    case DialogLanguage::Chinese:
    case DialogLanguage::Polish:
      break;
  }
  return english;
}

const LogFrame& capitalLogFrame() { return capitals; }

std::string capitalTerm(std::string_view term, std::span<const CapitalTerm> own) {
  const auto found = std::ranges::find(own, term, &CapitalTerm::usual);
  std::string text(found == own.end() ? term : found->capitals);
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

std::string_view translated(std::string_view term, DialogLanguage language, std::span<const LogTerm> own) {
  if (language != DialogLanguage::Russian && language != DialogLanguage::Swedish) return term;
  for (const std::span<const LogTerm> words : {own, std::span<const LogTerm>(terms)}) {
    const auto found = std::ranges::find(words, term, &LogTerm::english);
    if (found != words.end()) return language == DialogLanguage::Russian ? found->russian : found->swedish;
  }
  return term;
}

std::size_t width(std::string_view utf8) {
  return static_cast<std::size_t>(
      std::ranges::count_if(utf8, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::string padded(std::string_view text, std::size_t columns) {
  std::string result(text);
  const std::size_t used = width(text);
  if (used < columns) result.append(columns - used, ' ');
  return result;
}

}  // namespace probewright::cycles::heidenhain
