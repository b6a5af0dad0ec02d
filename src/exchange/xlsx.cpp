#include <fmt/format.h>
#include <unistd.h>
#include <xlsxwriter.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>

#include "base/file.hpp"
#include "base/unfinished.hpp"
#include "exchange/formats.hpp"
#include "records/results.hpp"

namespace probewright::exchange {

namespace {

namespace fs = std::filesystem;

struct Column {
  const char* title;
  double width;
};
constexpr std::array kColumns = {
    Column{"Cycle", 7},   Column{"Name", 12},      Column{"Title", 26},          Column{"Program", 18},
    Column{"Line", 7},    Column{"Feature", 26},   Column{"Characteristic", 32}, Column{"Result", 10},
    Column{"Unit", 6},    Column{"Nominal", 11},   Column{"Lower limit", 11},    Column{"Upper limit", 11},
    Column{"Actual", 11}, Column{"Deviation", 11}, Column{"Verdict", 10},        Column{"Time", 20}};

/// As long as one lives, what is written to `stderr` of the C library goes nowhere: the library for workbooks prints
/// there why it fails, and cannot be told not to. In glibc it is a variable that programs may set.
class SilentErrors {
public:
  SilentErrors() : heard_(open_memstream(&text_, &size_)), before_(stderr) {
    if (heard_ != nullptr) stderr = heard_;
  }
  ~SilentErrors() {
    const int reason = errno;
    stderr = before_;
    if (heard_ != nullptr) std::fclose(heard_);
    std::free(text_);
    errno = reason;
  }
  SilentErrors(const SilentErrors&) = delete;
  SilentErrors& operator=(const SilentErrors&) = delete;

private:
  char* text_ = nullptr;
  std::size_t size_ = 0;
  std::FILE *heard_, *before_;
};

/// Fails with an error of the library, and with its reason in `errno` if it has one.
lxw_error closeSilently(lxw_workbook* book) {
  const SilentErrors silent;
  errno = 0;
  return workbook_close(book);
}

class Sheet {
public:
  explicit Sheet(lxw_workbook* book) : book_(book) {
    head_ = workbook_add_format(book);
    format_set_bold(head_);
    format_set_bottom(head_, LXW_BORDER_THIN);
    number_ = numbers(nullptr);
    bad_ = numbers("#FFC7CE");
    good_ = numbers("#C6EFCE");
    rework_ = numbers("#FFEB9C");
  }

  void rows(const Inspection& inspection) {
    lxw_worksheet* sheet = workbook_add_worksheet(book_, "Inspection");
    lxw_col_t column = 0;
    for (const Column& each : kColumns) {
      worksheet_set_column(sheet, column, column, each.width, nullptr);
      worksheet_write_string(sheet, 0, column++, each.title, head_);
    }
    lxw_row_t line = 1;
    for (const Row& row : inspection.rows)
      put(sheet, line++, row, inspection.run);
    worksheet_freeze_panes(sheet, 1, 0);
    worksheet_autofilter(sheet, 0, 0, std::max<lxw_row_t>(line - 1, 1), kColumns.size() - 1);
    worksheet_set_landscape(sheet);
    worksheet_fit_to_pages(sheet, 1, 0);
    worksheet_repeat_rows(sheet, 0, 0);
  }

  void run(const Inspection& inspection) {
    lxw_worksheet* sheet = workbook_add_worksheet(book_, "Run");
    worksheet_set_column(sheet, 0, 0, 16, nullptr);
    worksheet_set_column(sheet, 1, 1, 60, nullptr);
    const records::RunInfo& run = inspection.run;
    lxw_row_t line = 0;
    const auto put = [&](const char* what, const std::string& value) {
      worksheet_write_string(sheet, line, 0, what, head_);
      worksheet_write_string(sheet, line++, 1, value.c_str(), nullptr);
    };
    put("Program", run.programs.empty() ? "" : run.programs.front().path);
    put("Part", run.partName);
    put("Part file", run.partPath);
    for (const records::JobField& field : records::jobFields)
      if (const std::string& value = run.job.*field.value; !value.empty())
        put(fmt::format("Job: {}", field.name).c_str(), value);
    put("Control", run.control);
    put("Machine", run.machine);
    put("Setup", run.setupPath);
    put("Seed", run.seed ? std::to_string(*run.seed) : "");
    put("Started", run.startedAt);
    put("Verdict", std::string(records::verdictName(inspection.verdict)));
    put("End", run.exitText.empty() ? std::string(records::exitName(run.exit)) : run.exitText);
    put("Probewright", run.version);
    for (const Failure& failure : inspection.failures)
      put("Alarm", fmt::format("{} {} ({} line {}): {}", failure.cycle, failure.cycleName, failure.program,
                               failure.line, failure.alarm));
  }

private:
  lxw_format* numbers(const char* background) {
    lxw_format* format = workbook_add_format(book_);
    format_set_num_format(format, "0.0000");
    if (background != nullptr)
      format_set_bg_color(format, static_cast<lxw_color_t>(std::strtol(background + 1, nullptr, 16)));
    return format;
  }

  void put(lxw_worksheet* sheet, lxw_row_t line, const Row& row, const records::RunInfo& run) {
    lxw_col_t column = 0;
    const auto text = [&](const std::string& value) {
      worksheet_write_string(sheet, line, column++, value.c_str(), nullptr);
    };
    const auto whole = [&](double value) { worksheet_write_number(sheet, line, column++, value, nullptr); };
    const auto length = [&](const std::optional<double>& value, lxw_format* format) {
      if (value) worksheet_write_number(sheet, line, column, *value + 0.0, format);  // no -0
      ++column;
    };
    using control::Verdict;
    lxw_format* colour = row.verdict == Verdict::Good     ? good_
                         : row.verdict == Verdict::Rework ? rework_
                         : row.verdict == Verdict::Scrap  ? bad_
                                                          : number_;
    whole(static_cast<double>(row.cycle));
    text(row.cycleName);
    text(row.title);
    text(row.program);
    whole(static_cast<double>(row.line));
    text(row.feature);
    text(row.characteristic);
    text(row.result);
    text(row.unit);
    length(row.nominal, number_);
    length(row.lowerLimit, number_);
    length(row.upperLimit, number_);
    length(row.actual, colour);
    length(row.deviation, number_);
    text(std::string(records::verdictName(row.verdict)));
    text(timeOf(row, run));
  }

  lxw_workbook* book_;
  lxw_format *head_, *number_, *bad_, *good_, *rework_;
};

}  // namespace

Result<std::string> xlsxFile(const Inspection& inspection) {
  const ScratchFolder folder;
  const auto failed = [&](const std::string& reason) {
    return fail({"inspection.xlsx", 0, 0}, "the workbook cannot be written: " + reason,
                "see that the folder for temporary files (TMPDIR) can be written to and has room");
  };
  if (folder.path().empty()) return failed("no temporary folder can be made");
  const fs::path file = folder.path() / "inspection.xlsx";
  std::string scratch = folder.path().string();
  lxw_workbook_options options{};
  options.tmpdir = scratch.data();
  lxw_workbook* book = workbook_new_opt(file.c_str(), &options);
  if (book == nullptr) return failed("not enough memory");
  Sheet sheet(book);
  sheet.rows(inspection);
  sheet.run(inspection);
  const lxw_error error = closeSilently(book);
  // Of a file that it cannot write the library only says that permissions are the usual reason.
  if (error != LXW_NO_ERROR) return failed(errno != 0 ? std::strerror(errno) : lxw_strerror(error));
  return readFile(file);
}

}  // namespace probewright::exchange
