#include "cycles/heidenhain/log_texts.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

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

/// Where the capitals are not those of the usual term.
constexpr std::array<std::pair<std::string_view, std::string_view>, 10> capitalTerms = {{
    {"Center in reference axis", "CENTER IN REF. AXIS"},
    {"Maximum limit for center in reference axis", "MAX. FOR CENTER IN REF. AXIS"},
    {"Minimum limit for center in reference axis", "MIN. FOR CENTER IN REF. AXIS"},
    {"Maximum limit for center in minor axis", "MAX. FOR CENTER IN MINOR AXIS"},
    {"Minimum limit for center in minor axis", "MIN. FOR CENTER IN MINOR AXIS"},
    {"Side length in reference axis", "SIDE LENGTH IN REF. AXIS"},
    {"Maximum dimension for side length in reference axis", "MAX. IN REFERENCE AXIS"},
    {"Minimum dimension for side length in reference axis", "MINIMUM DIMENSION IN REFERENCE AXIS"},
    {"Maximum dimension for side length in minor axis", "MAXIMUM SIDE LENGTH IN MINOR AXIS"},
    {"Minimum dimension for side length in minor axis", "MINIMUM SIDE LENGTH IN MINOR AXIS"},
}};

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

struct Term {
  std::string_view english, russian, swedish;
};

constexpr std::array terms = {
    // Titles of cycles 420 to 431.
    Term{"Angle Measuring", "Измерение угла", "Mätning vinkel"},
    Term{"Hole Measuring", "Измерение отверстия", "Mätning av hål"},
    Term{"Circular Stud Measuring", "Измерение окружности снаружи", "Mätning utvändig cirkel"},
    Term{"Rectangular Pocket Measuring", "Измерение прямоугольника внутри", "Mätning invändig rektangel"},
    Term{"Rectangular Stud Measuring", "Измерение прямоугольника снаружи", "Mätning utvändig rektangel"},
    Term{"Slot Width Measuring", "Измерение ширины внутри", "Mätning invändig bredd"},
    Term{"Ridge Width Measuring", "Измерение ребра снаружи", "Mätning kam utvändigt"},
    Term{"Coordinate Measuring", "Измерить координату", "Mätning koordinater"},
    Term{"Bolt Hole Circle Measuring", "Измерение образующей окружности", "Mätning hålcirkel"},
    Term{"Plane Measuring", "Измерить плоскость", "Mätning plan"},
    // Lines of their logs.
    Term{"Center in reference axis", "Центр главной оси", "Centrum huvudaxel"},
    Term{"Center in minor axis", "Центр вспомогательной оси", "Centrum komplementaxel"},
    Term{"Maximum limit for center in reference axis", "Максимальный размер центра главной оси",
         "Största mått centrum huvudaxel"},
    Term{"Minimum limit for center in reference axis", "Наименьший размер центра главной оси",
         "Minsta mått centrum huvudaxel"},
    Term{"Maximum limit for center in minor axis", "Максимальный размер центра вспомогательной оси",
         "Största mått centrum komplementaxel"},
    Term{"Minimum limit for center in minor axis", "Наименьший размер центра вспомогательной оси",
         "Minsta mått centrum komplementaxel"},
    Term{"Diameter", "Диаметр", "Diameter"},
    Term{"Maximum dimension for hole", "Максимальный размер отверстия", "Största mått hål"},
    Term{"Minimum dimension for hole", "Наименьший размер отверстия", "Minsta mått hål"},
    Term{"Maximum dimension for stud", "Максимальный размер острова", "Största mått tapp"},
    Term{"Minimum dimension for stud", "Наименьший размер острова", "Minsta mått tapp"},
    Term{"Maximum dimension for bolt hole circle", "Максимальный размер образующей окружности",
         "Största mått hålcirkel"},
    Term{"Minimum dimension for bolt hole circle", "Наименьший размер образующей окружности", "Minsta mått hålcirkel"},
    Term{"Side length in reference axis", "Длина стороны главной оси", "Sidlängd huvudaxel"},
    Term{"Side length in minor axis", "Длина стороны вспомогательной оси", "Sidlängd komplementaxel"},
    Term{"Maximum dimension for side length in reference axis", "Максимальный размер длины стороны главной оси",
         "Största mått sidlängd huvudaxel"},
    Term{"Minimum dimension for side length in reference axis", "Наименьший размер длины стороны главной оси",
         "Minsta mått sidlängd huvudaxel"},
    Term{"Maximum dimension for side length in minor axis", "Максимальный размер длины стороны вспомогательной оси",
         "Största mått sidlängd komplementaxel"},
    Term{"Minimum dimension for side length in minor axis", "Наименьший размер длины стороны вспомогательной оси",
         "Minsta mått sidlängd komplementaxel"},
    Term{"Length", "Длина", "Längd"},
    Term{"Maximum dimension for length", "Максимальный размер длины", "Största mått längd"},
    Term{"Minimum dimension for length", "Наименьший размер длины", "Minsta mått längd"},
    Term{"Position of center line", "Положение центральной оси", "Läge centrumpunkt"},
    Term{"Measured coordinate", "Измеренная координата", "Uppmätt koordinat"},
    Term{"Maximum dimension for coordinate", "Максимальный размер координаты", "Största mått koordinat"},
    Term{"Minimum dimension for coordinate", "Наименьший размер координаты", "Minsta mått koordinat"},
    Term{"Measured angle", "Измеренный угол", "Uppmätt vinkel"},
    Term{"Projection angle A axis", "Угол проекции оси A", "Projektionsvinkel A-axel"},
    Term{"Projection angle B axis", "Угол проекции оси B", "Projektionsvinkel B-axel"},
    Term{"Space angle A", "Пространственный угол A", "Rymdvinkel A"},
    Term{"Space angle B", "Пространственный угол B", "Rymdvinkel B"},
    Term{"Space angle C", "Пространственный угол C", "Rymdvinkel C"},
    Term{"1st measured value", "1-е измеренное значение", "1:a mätvärde"},
    Term{"2nd measured value", "2-е измеренное значение", "2:a mätvärde"},
    Term{"3rd measured value", "3-е измеренное значение", "3:e mätvärde"},
    Term{"Measuring height", "Высота измерения", "Mäthöjd"},
    // Titles, headings and lines of the logs in HTML.
    Term{"CALIBRATION OF TS ON A SPHERE", "KALIBROVKA TS NA SHARIKE", "TS KALIBRERING MOT KULA"},
    Term{"TS CALIBRATION OF TOOL LENGTH", "KALIBROVKA DLINI TS", "TS KALIBRERING LAENGD"},
    Term{"CALIBRATION OF A TS IN A RING", "KALIBROVKA TS V KOLZE", "TS KALIBRERING MOT RING"},
    Term{"TS CALIBRATION ON STUD", "KALIBROVKA TS NA ZAPFE", "TS KALIBRERING MOT TAPP"},
    Term{"PROBING IN 3-D", "IZMERENIYE V 3D", "AVKAENNING 3D"},
    Term{"PROBING ON EDGE", "IZMERENIE GRANI", "AVKAENNING KANT"},
    Term{"PROBING TWO CIRCLES", "IZMERENIJE DVUH OKRUZHNOSTEY", "AVKAENNING TVAA CIRKLAR"},
    Term{"PROBING IN PLANE", "IZMERENIE PLOSKOSTI", "AVKAENNING PLAN"},
    Term{"Touch probe log", "Протокол измерительного щупа", "Avkännarprotokoll"},
    Term{"tool", "инструмент", "verktyg"},
    Term{"touch probe", "контактный щуп", "avkännarsystem"},
    Term{"Before", "До", "Före"},
    Term{"After", "После", "Efter"},
    Term{"Radius of the standard", "Радиус калибра", "Normalens radie"},
    Term{"Reference point for length", "Точка привязки для длины", "Utgångspunkt för längd"},
    Term{"Number of touches", "Количество касаний", "Antal avkänningar"},
    Term{"Ball radius", "Радиус наконечника", "Mätkulans radie"},
    Term{"Coarse measurement", "Грубое измерение", "Grovmätning"},
    Term{"Fine measurement", "Точное измерение", "Finmätning"},
    Term{"Reversal measurement", "Измерение с поворотом на 180°", "Omslagsmätning"},
    Term{"Measurement with angle tracking", "Измерение с отслеживанием угла", "Mätning med vinkelföljning"},
    Term{"3-D calibration", "3D-калибровка", "3D-kalibrering"},
    Term{"Largest deviation", "Наибольшее отклонение", "Största avvikelse"},
    Term{"Probing direction", "Направление измерения", "Avkänningsriktning"},
    Term{"Nominal", "Заданное значение", "Börvärde"},
    Term{"Lower limit", "Наименьший размер", "Minsta mått"},
    Term{"Upper limit", "Максимальный размер", "Största mått"},
    Term{"Actual", "Фактическое значение", "Ärvärde"},
    Term{"Deviation", "Отклонение", "Avvikelse"},
    Term{"Status", "Состояние", "Status"},
    Term{"good", "годен", "godkänd"},
    Term{"rework", "доработка", "efterbearbetning"},
    Term{"scrap", "брак", "skrot"},
    Term{"Main axis", "Главная ось", "Huvudaxel"},
    Term{"Minor axis", "Вспомогательная ось", "Komplementaxel"},
    Term{"Tool axis", "Ось инструмента", "Verktygsaxel"},
    Term{"Along the normal", "По нормали", "Längs normalen"},
    Term{"Position 1, main axis", "Позиция 1, главная ось", "Position 1, huvudaxel"},
    Term{"Position 1, minor axis", "Позиция 1, вспомогательная ось", "Position 1, komplementaxel"},
    Term{"Position 1, tool axis", "Позиция 1, ось инструмента", "Position 1, verktygsaxel"},
    Term{"Position 2, main axis", "Позиция 2, главная ось", "Position 2, huvudaxel"},
    Term{"Position 2, minor axis", "Позиция 2, вспомогательная ось", "Position 2, komplementaxel"},
    Term{"Position 2, tool axis", "Позиция 2, ось инструмента", "Position 2, verktygsaxel"},
    Term{"Position 3, main axis", "Позиция 3, главная ось", "Position 3, huvudaxel"},
    Term{"Position 3, minor axis", "Позиция 3, вспомогательная ось", "Position 3, komplementaxel"},
    Term{"Position 3, tool axis", "Позиция 3, ось инструмента", "Position 3, verktygsaxel"},
    Term{"Diameter 1", "Диаметр 1", "Diameter 1"},
    Term{"Diameter 2", "Диаметр 2", "Diameter 2"},
    Term{"Measured angle of the rotary table", "Измеренный угол поворотного стола", "Uppmätt vinkel rundbord"},
    Term{"Deviation of the angle", "Отклонение угла", "Avvikelse vinkel"},
    Term{"Deviation of the angle of the rotary table", "Отклонение угла поворотного стола",
         "Avvikelse vinkel rundbord"},
    Term{"Measured space angle SPA", "Измеренный пространственный угол SPA", "Uppmätt rymdvinkel SPA"},
    Term{"Measured space angle SPB", "Измеренный пространственный угол SPB", "Uppmätt rymdvinkel SPB"},
    Term{"Measured space angle SPC", "Измеренный пространственный угол SPC", "Uppmätt rymdvinkel SPC"},
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

std::string capitalTerm(std::string_view term) {
  const auto found = std::ranges::find(capitalTerms, term, &std::pair<std::string_view, std::string_view>::first);
  std::string text(found == capitalTerms.end() ? term : found->second);
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

std::string_view translated(std::string_view term, DialogLanguage language) {
  if (language != DialogLanguage::Russian && language != DialogLanguage::Swedish) return term;
  const auto found = std::ranges::find(terms, term, &Term::english);
  if (found == terms.end()) return term;
  return language == DialogLanguage::Russian ? found->russian : found->swedish;
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
