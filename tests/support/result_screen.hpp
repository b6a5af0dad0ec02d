#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "base/number_text.hpp"
#include "control/sinumerik/control.hpp"
#include "support/coverage.hpp"

/// The result screen of a measuring cycle, and the logs of the same measurement, as a reader sees them.
namespace probewright::testing_support {

inline std::vector<std::string> linesOfText(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    lines.push_back(line);
  return lines;
}

inline std::vector<std::string> wordsOf(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;)
    words.push_back(word);
  return words;
}

/// "-0.0000" is 0.
inline std::string fourDecimals(double value) {
  const std::string text = formatFixed(value, 4);
  return text == "-0.0000" ? "0.0000" : text;
}

class ResultScreen {
public:
  explicit ResultScreen(const std::string& text) : lines_(linesOfText(text)) {
    EXPECT_GT(lines_.size(), 3U) << text;
    if (lines_.size() > 1) setpointEnd_ = lines_[1].find("Setpoint") + std::string("Setpoint").size();
  }

  const std::string& title() const { return lines_.front(); }

  /// Setpoint, measured value and difference of a row, as they are printed; fewer where columns are empty.
  std::vector<std::string> row(const std::string& label) const {
    for (const std::string& line : lines_) {
      if (line.starts_with(label + "  ")) return wordsOf(line.substr(label.size()));
    }
    return {};
  }

  /// What stands in the columns: label, setpoint, measured value, difference, limits.
  std::vector<std::vector<std::string>> cells() const {
    std::vector<std::vector<std::string>> rows;
    for (std::size_t i = 2; i < lines_.size(); ++i) {
      const std::string& line = lines_[i];
      const std::size_t label = setpointEnd_ - width;
      if (line.size() <= label || line[label] != ' ') continue;  // the lines below the columns
      std::vector<std::string> row{line.substr(0, label)};
      for (std::size_t at = label; at < label + 5 * width; at += width) {
        const auto words = wordsOf(at < line.size() ? line.substr(at, width) : std::string());
        row.push_back(words.empty() ? std::string() : words.front());
      }
      if (std::any_of(row.begin() + 1, row.end(), [](const std::string& cell) {
            return cell.find('.') != std::string::npos && parseDecimal(cell).has_value();
          }))
        rows.push_back(row);
    }
    return rows;
  }

private:
  static constexpr std::size_t width = 12;
  std::vector<std::string> lines_;
  std::size_t setpointEnd_ = 0;
};

/// Shows the screen of every cycle from now on, and keeps both forms of the log.
inline void showAndLog(control::sinumerik::Control& control) {
  using control::sinumerik::MeasuringLog;
  control.panel.showAllResults = true;
  control.output.logs = {{"ALL.TXT", MeasuringLog::Form::Text}, {"ALL.CSV", MeasuringLog::Form::Table}};
}

/// What a screen of the control has: cycle and variant; every result that the program finds in _OVR, each difference
/// that of its row; probe number, safe area, tool. The logs have the same rows.
inline void expectScreenAndLogs(const control::sinumerik::Control& control, const std::string& cycle, int variant) {
  ASSERT_FALSE(control.journal.cycles.empty());
  const control::CycleRecord& record = control.journal.cycles.back();
  ASSERT_EQ(record.screens.size(), 1U) << cycle;
  for (const char* log : {"", "ALL.TXT", "ALL.CSV"})
    coverage::logRead(control::ControlKind::Sinumerik840Dsl, control.journal, log);
  const std::string& text = record.screens.back();
  SCOPED_TRACE(text);
  const ResultScreen screen(text);
  EXPECT_TRUE(screen.title().starts_with(cycle + "  "));
  EXPECT_THAT(screen.title(), ::testing::HasSubstr("S_MVAR = " + std::to_string(variant)));

  std::multiset<std::string> shown;
  const auto cells = screen.cells();
  for (const auto& row : cells) {
    EXPECT_NE(row[0].find_first_not_of(' '), std::string::npos) << "a row without a name";
    for (std::size_t i = 1; i < row.size(); ++i)
      if (const auto value = parseDecimal(row[i])) shown.insert(fourDecimals(*value));
    const auto set = parseDecimal(row[1]), actual = parseDecimal(row[2]), difference = parseDecimal(row[3]);
    if (set && actual && difference) {
      EXPECT_NEAR(*actual - *set, *difference, 1.01e-4) << row[0];
    }
  }
  for (const control::ResultRecord& result : record.results) {
    if (!result.name.starts_with("_OVR[")) continue;
    EXPECT_FALSE(result.meaning.empty()) << result.name << " has no meaning";
    const double value = control.ovr[static_cast<std::size_t>(std::stoi(result.name.substr(5)))];
    EXPECT_TRUE(shown.contains(fourDecimals(value))) << result.name << " = " << value;
  }
  EXPECT_FALSE(screen.row("probe number").empty());
  EXPECT_FALSE(screen.row("tool").empty());
  EXPECT_TRUE(!screen.row("safe area").empty() || !screen.row("safe area [mm]").empty() ||
              !screen.row("safe area [deg]").empty());

  const auto log = [&control](const char* name) {
    const auto found = control.panel.files().find(name);
    return found == control.panel.files().end() ? std::string() : found->second;
  };
  const auto table = linesOfText(log("ALL.CSV"));
  ASSERT_EQ(table.size(), 1 + cells.size());
  const std::string plain = log("ALL.TXT");
  EXPECT_THAT(plain, ::testing::HasSubstr(cycle));
  for (std::size_t i = 0; i < cells.size(); ++i) {
    std::vector<std::string> fields;
    std::istringstream stream(table[i + 1] + ";");
    for (std::string field; std::getline(stream, field, ';');)
      fields.push_back(field);
    ASSERT_EQ(fields.size(), 19U) << table[i + 1];
    EXPECT_EQ(fields[5], cycle);
    EXPECT_EQ(fields[6], std::to_string(variant));
    EXPECT_EQ(fields[9], cells[i][1]);
    EXPECT_EQ(fields[10], cells[i][2]);
    EXPECT_EQ(fields[11], cells[i][3]);
    EXPECT_TRUE(cells[i][0].starts_with(fields[7])) << cells[i][0];
    for (std::size_t column = 9; column < 12; ++column) {
      if (!fields[column].empty()) {
        EXPECT_THAT(plain, ::testing::HasSubstr(fields[column]));
      }
    }
  }
}

}  // namespace probewright::testing_support
