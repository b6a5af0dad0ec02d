#include "check_formats.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string_view>

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
  const ordered_json run = {{"tool", {{"driver", driver}}}, {"results", results}};
  return {{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
          {"version", "2.1.0"},
          {"runs", ordered_json::array({run})}};
}

}  // namespace

void CheckDocument::add(const Diagnostics& found, language::Encoding encoding) {
  for (Diagnostic each : found) {
    for (std::string* text : {&each.place.file, &each.message, &each.excerpt, &each.advice, &each.code})
      *text = printable(*text, encoding);
    all_.push_back(std::move(each));
  }
}

std::string CheckDocument::text() const {
  return (format_ == CheckFormat::Sarif ? sarif(all_) : plainJson(all_)).dump(2) + "\n";
}

}  // namespace probewright::app
