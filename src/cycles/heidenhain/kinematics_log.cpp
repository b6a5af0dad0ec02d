#include "cycles/heidenhain/kinematics_log.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>

#include "base/utc.hpp"
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
};

}  // namespace

const std::span<const LogTerm> kinematicsLogTerms = terms;

void KinematicsLog::line(const std::string& label, const std::string& value) {
  if (tables_.empty() || !tables_.back().lines) tables_.push_back({{"", ""}, {}, true});
  tables_.back().rows.push_back({label, value});
}

void KinematicsLog::table(const std::vector<std::string>& heading, const Rows& rows) {
  tables_.push_back({heading, rows, false});
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
        widths[i] = std::max(widths[i], width(row[i]));
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
