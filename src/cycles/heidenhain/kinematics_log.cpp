#include "cycles/heidenhain/kinematics_log.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>

#include "base/utc.hpp"
#include "base/utf8.hpp"
#include "cycles/heidenhain/html_log.hpp"
#include "cycles/heidenhain/log_texts.hpp"

namespace probewright::cycles::heidenhain {

namespace {

constexpr LogTerm terms[] = {
    {"SAVE KINEMATICS", "СОХРАНЕНИЕ КИНЕМАТИКИ", "SPARA KINEMATIK"},
    {"MEASURE KINEMATICS", "ИЗМЕРЕНИЕ КИНЕМАТИКИ", "MÄTNING KINEMATIK"},
    {"PRESET COMPENSATION", "КОМПЕНСАЦИЯ ПРЕДУСТАНОВКИ", "PRESET-KOMPENSERING"},
    {"KINEMATICS GRID", "ИЗМЕРЕНИЕ РЕШЁТКИ", "KINEMATIK GITTER"},
    {"Mode", "Режим", "Mode"},
    {"Record", "Кадр данных", "Datablock"},
    {"Kinematics", "Кинематика", "Kinematik"},
    {"Sphere radius", "Радиус шарика", "Kulradie"},
    {"Start angle", "Начальный угол", "Startvinkel"},
    {"End angle", "Конечный угол", "Slutvinkel"},
    {"Angle of incidence", "Угол установки", "Infallsvinkel"},
    {"Number of measuring points", "Количество точек измерения", "Antal mätpunkter"},
    {"Scatter (standard deviation)", "Рассеяние (среднеквадратическое отклонение)", "Spridning (standardavvikelse)"},
    {"Maximum error", "Максимальная погрешность", "Maximalt fel"},
    {"Angular error", "Погрешность угла", "Vinkelfel"},
    {"Averaged backlash", "Усредненный люфт", "Genomsnittligt glapp"},
    {"Averaged positioning error", "Усредненная ошибка позиционирования", "Genomsnittligt positioneringsfel"},
    {"Measuring circle radius", "Радиус окружности измерения", "Mätcirkelradie"},
    {"Axis", "Ось", "Axel"},
    {"Before", "До", "Före"},
    {"After", "После", "Efter"},
    {"Maximum deviation", "Максимальное отклонение", "Maximal avvikelse"},
    {"Standard deviation", "Среднеквадратическое отклонение", "Standardavvikelse"},
    {"0: save the active kinematics", "0: сохранить активную кинематику", "0: spara den aktiva kinematiken"},
    {"1: restore a record", "1: восстановить кадр данных", "1: återställ ett datablock"},
    {"2: show the records", "2: показать кадры данных", "2: visa datablocken"},
    {"3: delete records (TNC 640)", "3: удалить кадры данных (TNC 640)", "3: radera datablock (TNC 640)"},
    {"0: test: measure, and tell what could be optimised", "0: проверка: измерить и показать, что можно оптимизировать",
     "0: test: mät och visa vad som kan optimeras"},
    {"1: optimise the positions of the rotary axes", "1: оптимизировать положения осей вращения",
     "1: optimera rotationsaxlarnas positioner"},
    {"2: optimise angles and positions (option 52)", "2: оптимизировать углы и положения (опция 52)",
     "2: optimera vinklar och positioner (option 52)"},
    {"3: correct the machine datum, optimise angles and positions (option 52, TNC 640)",
     "3: исправить нулевую точку станка, оптимизировать углы и положения (опция 52, TNC 640)",
     "3: korrigera maskinnollpunkten, optimera vinklar och positioner (option 52, TNC 640)"},
    {"-1: clear: all values of the compensation table become 0",
     "-1: очистить: все значения таблицы компенсации становятся 0",
     "-1: rensa: alla värden i kompenseringstabellen blir 0"},
    {"0: test: measure, and write nothing", "0: проверка: измерить, ничего не записывать", "0: test: mät, skriv inget"},
    {"1: compensate: write the deviations, which act at once",
     "1: компенсировать: записать отклонения, они действуют сразу",
     "1: kompensera: skriv avvikelserna, de verkar genast"},
    {"Preset shift", "Смещение предустановки", "Presetförskjutning"},
    {"Position from the spindle nose", "Положение от торца шпинделя", "Position från spindelnosen"},
    {"Position of the maximum deviation", "Положение максимального отклонения", "Position för maximal avvikelse"},
    {"Number of measuring positions", "Количество положений измерения", "Antal mätpositioner"},
    {"Measured", "Измерено", "Uppmätt"},
    {"Optimised", "Оптимизировано", "Optimerat"},
    {"Valuation of the measuring points", "Оценка точек измерения", "Värdering av mätpunkterna"},
    {"Measurement uncertainty, degrees per 0.001 mm", "Неопределённость измерения, градусов на 0,001 мм",
     "Mätosäkerhet, grader per 0,001 mm"},
    {"Not determined", "Не определено", "Ej bestämt"},
    {"Entry", "Запись", "Post"},
    {"Value", "Значение", "Värde"},
    {"Code number", "Кодовое число", "Kodnummer"},
};

}  // namespace

const std::span<const LogTerm> kinematicsLogTerms = terms;

void KinematicsLog::line(const std::string& label, const std::string& value) {
  if (tables_.empty() || !tables_.back().lines) tables_.push_back({.heading = {"", ""}, .rows = {}, .lines = true});
  tables_.back().rows.push_back({label, value});
}

void KinematicsLog::table(const std::vector<std::string>& heading, const Rows& rows) {
  tables_.push_back({.heading = heading, .rows = rows, .lines = false});
}

std::string KinematicsLog::text() const {
  const auto& control = context_.control();
  const DialogLanguage language = control.panel.language;
  const LogFrame& frame = logFrame(language);
  const auto term = [&](const std::string& english) {
    return std::string(translated(english, language, context_.entry().logTerms));
  };
  const std::tm time = utcTime(control.wallClockStart, context_.channel().seconds() - control.startSeconds);
  std::string text = "****** " +
                     fmt::format(fmt::runtime(frame.title), context_.entry().definition.name,
                                 term(std::string(context_.entry().definition.title))) +
                     " ******\n\n";
  text += fmt::format("{} ", frame.date) + fmt::format(fmt::runtime(frame.dateForm), time) + "\n";
  text += fmt::format("{} {}:{:02}:{:02}\n", frame.time, time.tm_hour, time.tm_min, time.tm_sec);
  text += fmt::format("{} {}\n", frame.program, control.programPath);
  for (const Table& table : tables_) {
    text += std::string(61, '-') + "\n";
    Rows rows = table.rows;
    if (!table.lines) rows.insert(rows.begin(), table.heading);
    std::vector<std::size_t> widths;
    for (auto& row : rows) {
      widths.resize(std::max(widths.size(), row.size()), 0);
      for (std::size_t i = 0; i < row.size(); ++i) {
        row[i] = term(row[i]);
        widths[i] = std::max(widths[i], characterCount(row[i]));
      }
    }
    for (const auto& row : rows) {
      std::string line;
      for (std::size_t i = 0; i < row.size(); ++i)
        line += i + 1 == row.size() ? row[i] : padded(row[i], widths[i] + 2);
      line.erase(line.find_last_not_of(' ') + 1);
      text += line + "\n";
    }
  }
  return text + fmt::format("****** {} ******\n", frame.end);
}

void KinematicsLog::write() {
  if (file_.ends_with(".html")) {
    for (const Table& table : tables_)
      addToHtmlLog(context_, table.heading, table.rows, file_);
  } else {
    context_.log(file_, text());
  }
}

}  // namespace probewright::cycles::heidenhain
