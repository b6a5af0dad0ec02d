#include "check_formats.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string_view>

#include "base/file.hpp"
#include "base/text.hpp"
#include "console.hpp"

namespace probewright::app {

namespace {

using nlohmann::ordered_json;

const char* severityName(Severity severity) {
  switch (severity) {
    case Severity::Note:
      return "note";
    case Severity::Warning:
      return "warning";
    case Severity::Error:
      return "error";
  }
  return "error";
}

ordered_json plainJson(const Diagnostics& all) {
  auto list = ordered_json::array();
  for (const Diagnostic& each : all) {
    list.push_back({{"severity", severityName(each.severity)},
                    {"file", each.place.file},
                    {"line", each.place.line},
                    {"column", each.place.column},
                    {"message", each.message},
                    {"excerpt", each.excerpt},
                    {"advice", each.advice},
                    {"code", each.code}});
  }
  return list;
}

/// A path as a reference of RFC 3986.
std::string uri(const std::string& path) {
  std::string text;
  for (const char c : path) {
    const bool plain = isLetter(c) || isDigit(c) || std::string_view("-._~/").find(c) != std::string_view::npos;
    text += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return text;
}

/// SARIF 2.1.0, sections 3.14 (run), 3.27 (result), 3.28 (location), 3.30 (region).
ordered_json sarif(const Diagnostics& all) {
  auto results = ordered_json::array();
  for (const Diagnostic& each : all) {
    const std::string text = each.advice.empty() ? each.message : each.message + "\n" + each.advice;
    ordered_json result = {{"level", severityName(each.severity)}, {"message", {{"text", text}}}};
    if (!each.code.empty()) result["ruleId"] = each.code;
    if (!each.place.file.empty()) {
      ordered_json place = {{"artifactLocation", {{"uri", uri(each.place.file)}}}};
      if (each.place.line > 0) {
        place["region"] = {{"startLine", each.place.line}};
        if (each.place.column > 0) place["region"]["startColumn"] = each.place.column;
        if (!each.excerpt.empty()) place["region"]["snippet"] = {{"text", each.excerpt}};
      }
      result["locations"] = ordered_json::array({{{"physicalLocation", place}}});
    }
    results.push_back(std::move(result));
  }
  const ordered_json driver = {{"name", "Probewright"}, {"version", PROBEWRIGHT_VERSION}};
  const ordered_json run = {{"tool", {{"driver", driver}}}, {"columnKind", "utf16CodeUnits"}, {"results", results}};
  return {{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
          {"version", "2.1.0"},
          {"runs", ordered_json::array({run})}};
}

/// A line without its end, counted from 1; empty if there is none.
std::string_view lineOf(std::string_view text, std::uint64_t line) {
  constexpr std::string_view byteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(byteOrderMark)) text.remove_prefix(byteOrderMark.size());
  for (; line > 1; --line) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return {};
    text.remove_prefix(end + 1);
  }
  return text.substr(0, text.find('\n'));
}

/// How many units the text takes in UTF-16.
std::uint32_t unitsOf(std::string_view utf8) {
  std::uint32_t units = 0;
  for (const char c : utf8) {
    const auto byte = static_cast<unsigned char>(c);
    const bool follows = (byte & 0xC0U) == 0x80U;
    if (!follows) units += byte >= 0xF0U ? 2 : 1;
  }
  return units;
}

}  // namespace

/// The column of a place, as the bytes in front of it are read.
std::uint32_t CheckDocument::inUtf16(const Diagnostic& found, language::Encoding encoding) {
  const std::uint32_t column = found.place.column;
  if (column < 2) return column;
  auto text = texts_.find(found.place.file);
  if (text == texts_.end()) text = texts_.emplace(found.place.file, readFile(found.place.file).value_or("")).first;
  if (!text->second.empty()) encoding = language::detectEncoding(text->second);
  std::string_view line = lineOf(text->second, found.place.line);
  if (line.size() + 1 < column) line = found.excerpt;
  const std::string_view before = line.substr(0, column - 1);
  const auto beyond = static_cast<std::uint32_t>(column - 1 - before.size());
  return unitsOf(language::toUtf8(before, encoding)) + beyond + 1;
}

void CheckDocument::add(const Diagnostics& found, language::Encoding encoding) {
  for (Diagnostic each : found) {
    if (format_ == CheckFormat::Sarif) each.place.column = inUtf16(each, encoding);
    for (std::string* text : {&each.place.file, &each.message, &each.excerpt, &each.advice, &each.code})
      *text = printable(*text, encoding);
    all_.push_back(std::move(each));
  }
}

std::string CheckDocument::text() const {
  return (format_ == CheckFormat::Sarif ? sarif(all_) : plainJson(all_)).dump(2) + "\n";
}

}  // namespace probewright::app
