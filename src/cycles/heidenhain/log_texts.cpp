#include "cycles/heidenhain/log_texts.hpp"

#include <algorithm>
#include <array>

#include "base/text.hpp"
#include "base/utf8.hpp"

namespace probewright::cycles::heidenhain {
namespace {

constexpr LogFrame englishLog{
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

constexpr LogFrame capitalLog{
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

constexpr LogFrame russianLog{
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

constexpr LogFrame swedishLog{
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

constexpr LogFrame germanLog{
    .title = "Messprotokoll Antastzyklus {} {}",
    .date = "Datum:",
    .time = "Uhrzeit:",
    .program = "Messprogramm:",
    .dateForm = "{:%d-%m-%Y}",
    .nominal = "Sollwerte:",
    .limits = "Vorgegebene Grenzwerte:",
    .actual = "Istwerte:",
    .deviations = "Abweichungen:",
    .further = "Weitere Messergebnisse:",
    .end = "Ende Messprotokoll",
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

struct GermanTerm {
  std::string_view english, german;
};

/// All words of the logs, those of single cycles too.
constexpr std::array germanTerms = {
    GermanTerm{"Center in reference axis", "Mitte Hauptachse"},
    GermanTerm{"Center in minor axis", "Mitte Nebenachse"},
    GermanTerm{"Maximum limit for center in reference axis", "Größtmaß Mitte Hauptachse"},
    GermanTerm{"Minimum limit for center in reference axis", "Kleinstmaß Mitte Hauptachse"},
    GermanTerm{"Maximum limit for center in minor axis", "Größtmaß Mitte Nebenachse"},
    GermanTerm{"Minimum limit for center in minor axis", "Kleinstmaß Mitte Nebenachse"},
    GermanTerm{"Diameter", "Durchmesser"},
    GermanTerm{"Maximum dimension for hole", "Größtmaß Bohrung"},
    GermanTerm{"Minimum dimension for hole", "Kleinstmaß Bohrung"},
    GermanTerm{"Maximum dimension for stud", "Größtmaß Zapfen"},
    GermanTerm{"Minimum dimension for stud", "Kleinstmaß Zapfen"},
    GermanTerm{"Side length in reference axis", "Seitenlänge Hauptachse"},
    GermanTerm{"Side length in minor axis", "Seitenlänge Nebenachse"},
    GermanTerm{"Maximum dimension for side length in reference axis", "Größtmaß Seitenlänge Hauptachse"},
    GermanTerm{"Minimum dimension for side length in reference axis", "Kleinstmaß Seitenlänge Hauptachse"},
    GermanTerm{"Maximum dimension for side length in minor axis", "Größtmaß Seitenlänge Nebenachse"},
    GermanTerm{"Minimum dimension for side length in minor axis", "Kleinstmaß Seitenlänge Nebenachse"},
    GermanTerm{"Length", "Länge"},
    GermanTerm{"Maximum dimension for length", "Größtmaß Länge"},
    GermanTerm{"Minimum dimension for length", "Kleinstmaß Länge"},
    GermanTerm{"Position of center line", "Lage Mittelachse"},
    GermanTerm{"Measured angle", "Gemessener Winkel"},
    GermanTerm{"Measuring height", "Messhöhe"},
    GermanTerm{"Touch probe log", "Tastsystem-Protokoll"},
    GermanTerm{"tool", "Werkzeug"},
    GermanTerm{"touch probe", "Tastsystem"},
    GermanTerm{"Before", "Vorher"},
    GermanTerm{"After", "Nachher"},
    GermanTerm{"Radius of the standard", "Radius des Kalibriernormals"},
    GermanTerm{"Reference point for length", "Bezugspunkt für Länge"},
    GermanTerm{"Number of touches", "Anzahl Antastungen"},
    GermanTerm{"Ball radius", "Kugelradius"},
    GermanTerm{"Coarse measurement", "Grobmessung"},
    GermanTerm{"Fine measurement", "Feinmessung"},
    GermanTerm{"Reversal measurement", "Umschlagmessung"},
    GermanTerm{"Measurement with angle tracking", "Messung mit Winkelnachführung"},
    GermanTerm{"3-D calibration", "3D-Kalibrierung"},
    GermanTerm{"Largest deviation", "Größte Abweichung"},
    GermanTerm{"Probing direction", "Antastrichtung"},
    GermanTerm{"Nominal", "Sollwert"},
    GermanTerm{"Lower limit", "Kleinstmaß"},
    GermanTerm{"Upper limit", "Größtmaß"},
    GermanTerm{"Actual", "Istwert"},
    GermanTerm{"Deviation", "Abweichung"},
    GermanTerm{"Status", "Status"},
    GermanTerm{"good", "gut"},
    GermanTerm{"rework", "Nacharbeit"},
    GermanTerm{"scrap", "Ausschuss"},
    GermanTerm{"Main axis", "Hauptachse"},
    GermanTerm{"Minor axis", "Nebenachse"},
    GermanTerm{"Tool axis", "Werkzeugachse"},
    GermanTerm{"Position 1, main axis", "Position 1, Hauptachse"},
    GermanTerm{"Position 1, minor axis", "Position 1, Nebenachse"},
    GermanTerm{"Position 1, tool axis", "Position 1, Werkzeugachse"},
    GermanTerm{"Position 2, main axis", "Position 2, Hauptachse"},
    GermanTerm{"Position 2, minor axis", "Position 2, Nebenachse"},
    GermanTerm{"Position 2, tool axis", "Position 2, Werkzeugachse"},
    GermanTerm{"Position 3, main axis", "Position 3, Hauptachse"},
    GermanTerm{"Position 3, minor axis", "Position 3, Nebenachse"},
    GermanTerm{"Position 3, tool axis", "Position 3, Werkzeugachse"},
    GermanTerm{"Diameter 1", "Durchmesser 1"},
    GermanTerm{"Diameter 2", "Durchmesser 2"},
    GermanTerm{"Measured angle of the rotary table", "Gemessener Winkel des Rundtischs"},
    GermanTerm{"Deviation of the angle", "Abweichung des Winkels"},
    GermanTerm{"Deviation of the angle of the rotary table", "Abweichung des Winkels des Rundtischs"},
    GermanTerm{"1st measured value", "1. Messwert"},
    GermanTerm{"2nd measured value", "2. Messwert"},
    GermanTerm{"3rd measured value", "3. Messwert"},
    GermanTerm{"Along the normal", "Längs der Normalen"},
    GermanTerm{"Angle Measuring", "Messen Winkel"},
    GermanTerm{"Bolt Hole Circle Measuring", "Messen Lochkreis"},
    GermanTerm{"CALIBRATION OF A TS IN A RING", "TS KALIBRIEREN IN RING"},
    GermanTerm{"CALIBRATION OF TS ON A SPHERE", "TS KALIBRIEREN AN KUGEL"},
    GermanTerm{"TS CALIBRATION OF TOOL LENGTH", "TS WERKZEUGLAENGE KALIBRIEREN"},
    GermanTerm{"TS CALIBRATION ON STUD", "TS KALIBRIEREN AN ZAPFEN"},
    GermanTerm{"Circular Stud Measuring", "Messen Kreis außen"},
    GermanTerm{"Coordinate Measuring", "Messen Koordinate"},
    GermanTerm{"Hole Measuring", "Messen Bohrung"},
    GermanTerm{"Maximum dimension for bolt hole circle", "Größtmaß Lochkreis"},
    GermanTerm{"Minimum dimension for bolt hole circle", "Kleinstmaß Lochkreis"},
    GermanTerm{"Maximum dimension for coordinate", "Größtmaß Koordinate"},
    GermanTerm{"Minimum dimension for coordinate", "Kleinstmaß Koordinate"},
    GermanTerm{"Measured coordinate", "Gemessene Koordinate"},
    GermanTerm{"Measured space angle SPA", "Gemessener Raumwinkel SPA"},
    GermanTerm{"Measured space angle SPB", "Gemessener Raumwinkel SPB"},
    GermanTerm{"Measured space angle SPC", "Gemessener Raumwinkel SPC"},
    GermanTerm{"PROBING IN 3-D", "ANTASTEN 3D"},
    GermanTerm{"PROBING IN PLANE", "ANTASTEN EBENE"},
    GermanTerm{"PROBING ON EDGE", "ANTASTEN KANTE"},
    GermanTerm{"PROBING TWO CIRCLES", "ANTASTEN ZWEI KREISE"},
    GermanTerm{"Plane Measuring", "Messen Ebene"},
    GermanTerm{"Projection angle A axis", "Projektionswinkel A-Achse"},
    GermanTerm{"Projection angle B axis", "Projektionswinkel B-Achse"},
    GermanTerm{"Rectangular Pocket Measuring", "Messen Rechteck innen"},
    GermanTerm{"Rectangular Stud Measuring", "Messen Rechteck außen"},
    GermanTerm{"Ridge Width Measuring", "Messen Steg außen"},
    GermanTerm{"Slot Width Measuring", "Messen Breite innen"},
    GermanTerm{"Space angle A", "Raumwinkel A"},
    GermanTerm{"Space angle B", "Raumwinkel B"},
    GermanTerm{"Space angle C", "Raumwinkel C"},
};

}  // namespace

const LogFrame& logFrame(DialogLanguage language) {
  switch (language) {
    case DialogLanguage::Russian:
      return russianLog;
    case DialogLanguage::Swedish:
      return swedishLog;
    case DialogLanguage::German:
      return germanLog;
    case DialogLanguage::English:
    case DialogLanguage::Chinese:
    case DialogLanguage::Polish:
      break;
  }
  return englishLog;
}

bool hasEnglishLogs(DialogLanguage language) {
  return language == DialogLanguage::English || language == DialogLanguage::Chinese ||
         language == DialogLanguage::Polish;
}

const LogFrame& capitalLogFrame() { return capitalLog; }

std::string capitalTerm(std::string_view term, std::span<const CapitalTerm> own) {
  const auto found = std::ranges::find(own, term, &CapitalTerm::usual);
  return upperCase(found == own.end() ? term : found->capitals);
}

std::string_view translated(std::string_view term, DialogLanguage language, std::span<const LogTerm> own) {
  if (hasEnglishLogs(language)) return term;
  if (language == DialogLanguage::German) {
    const auto found = std::ranges::find(germanTerms, term, &GermanTerm::english);
    return found == germanTerms.end() ? term : found->german;
  }
  for (const std::span<const LogTerm> words : {own, std::span<const LogTerm>(terms)}) {
    const auto found = std::ranges::find(words, term, &LogTerm::english);
    if (found != words.end()) return language == DialogLanguage::Russian ? found->russian : found->swedish;
  }
  return term;
}

std::string padded(std::string_view text, std::size_t columns) {
  std::string result(text);
  const std::size_t used = characterCount(text);
  if (used < columns) result.append(columns - used, ' ');
  return result;
}

}  // namespace probewright::cycles::heidenhain
