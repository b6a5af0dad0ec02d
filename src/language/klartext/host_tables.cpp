#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "base/number_text.hpp"
#include "control/alarm.hpp"
#include "language/klartext/host.hpp"
#include "language/klartext/lexer.hpp"

/// FN 26 TABOPEN, FN 27 TABWRITE, FN 28 TABREAD: freely definable tables. Several columns take as many parameters, one
/// behind the other.
namespace probewright::language::klartext {

using control::Alarm;
using control::heidenhain::TextTable;

namespace {

std::vector<std::string> columnsOf(std::string_view text) {
  std::vector<std::string> columns;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(','), text.size());
    std::string_view name = text.substr(0, end);
    while (!name.empty() && isBlank(name.front()))
      name.remove_prefix(1);
    while (!name.empty() && isBlank(name.back()))
      name.remove_suffix(1);
    columns.emplace_back(name);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return columns;
}

template <class T>
void orAlarm(const Result<T>& done) {
  if (!done) throw Alarm("Table write error", done.error().message, done.error().advice);
}

VariableRef behind(VariableRef variable, std::size_t count) {
  variable.index[0].number += static_cast<double>(count);
  return variable;
}

}  // namespace

std::string fileNameOf(std::string_view path) {
  const std::size_t separator = path.find_last_of("/\\:");
  return std::string(separator == std::string_view::npos ? path : path.substr(separator + 1));
}

Result<std::string> KlartextHost::readHostFile(std::string_view path) const {
  std::string name(path);
  std::erase(name, '"');
  if (!options_.readFile) return fail(fmt::format("the file {} does not exist", name));
  Result<std::string> bytes = options_.readFile(name);
  if (!bytes && fileNameOf(name) != name) {
    Result<std::string> byName = options_.readFile(fileNameOf(name));
    if (byName) return byName;
  }
  return bytes;
}

void KlartextHost::openTable(std::string_view path) {
  const Result<std::string> bytes = readHostFile(path);
  if (path.empty()) throw Alarm("Table missing", "FN 26 names no table", "write FN 26: TABOPEN TABLE.TAB");
  if (!bytes) {
    throw Alarm("Table missing", fmt::format("The table {} cannot be read: {}", path, bytes.error().message),
                "put the table beside the program");
  }
  Diagnostics mistakes;
  Result<TextTable> table = TextTable::parse(*bytes, fileNameOf(path), mistakes);
  if (!table) throw Alarm("Table wrong", table.error().message, table.error().advice);
  table_ = std::move(*table);
}

void KlartextHost::writeTable(const Command& command, Evaluation& evaluation) {
  if (!table_) throw Alarm("Table missing", "No table is open for FN 27", "program FN 26: TABOPEN before it");
  const std::span<const Word> words = evaluation.words(command.words);
  const std::string row = std::to_string(std::lround(evaluation.number(words[0].value)));
  if (!table_->hasRow(row)) orAlarm(table_->addRow(row));
  const std::vector<std::string> columns = columnsOf(evaluation.at(command.text));
  for (std::size_t i = 0; i < columns.size(); ++i) {
    Value value;
    if (command.variable >= 0) {
      const VariableRef& first = evaluation.block().variables[static_cast<std::size_t>(command.variable)];
      value = read(behind(first, i), evaluation);
    } else {
      value = evaluation.value(words[1].value);
    }
    if (isText(value)) {
      orAlarm(table_->setCell(row, columns[i], std::get<std::string>(value)));
    } else {
      orAlarm(table_->setNumber(row, columns[i], std::get<double>(value)));
    }
  }
  control_.panel.file(table_->file(), table_->bytes());
}

void KlartextHost::readTable(const Command& command, Evaluation& evaluation) {
  if (!table_) throw Alarm("Table missing", "No table is open for FN 28", "program FN 26: TABOPEN before it");
  const std::string row = std::to_string(std::lround(evaluation.number(evaluation.words(command.words)[0].value)));
  const VariableRef& first = evaluation.block().variables[static_cast<std::size_t>(command.variable)];
  const std::vector<std::string> columns = columnsOf(evaluation.at(command.text));
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::optional<std::string> cell = table_->cell(row, columns[i]);
    if (!cell) {
      throw Alarm("Table entry missing",
                  fmt::format("{} has no row {} with column {}", table_->file(), row, columns[i]),
                  "correct the row or the name of the column");
    }
    if (first.space == VariableSpace::QS) {
      write(behind(first, i), *cell, evaluation);
      continue;
    }
    const std::optional<double> number = parseDecimal(*cell);
    if (!number) {
      throw Alarm("Wrong data type", fmt::format("\"{}\" in column {} is no number", *cell, columns[i]),
                  "read it into a QS parameter");
    }
    write(behind(first, i), *number, evaluation);
  }
}

}  // namespace probewright::language::klartext
