#include "cycles/heidenhain/html_log.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/utc.hpp"
#include "cycles/heidenhain/log_texts.hpp"

namespace probewright::cycles::heidenhain {
namespace {

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '<') {
      result += "&lt;";
    } else if (c == '&') {
      result += "&amp;";
    } else {
      result += c;
    }
  }
  return result;
}

std::string row(Context& context, const char* cell, const std::vector<std::string>& cells) {
  const DialogLanguage language = context.control().panel.language;
  std::string text = "<tr>";
  for (const std::string& content : cells) {
    const char* colour = content == "good" ? "green" : content == "rework" ? "orange" : content == "scrap" ? "red" : "";
    const std::string style = *colour == 0 ? std::string() : fmt::format(" style=\"color:{}\"", colour);
    text += fmt::format("<{0}{1}>{2}</{0}>", cell, style,
                        escaped(std::string(translated(content, language, context.entry().logTerms))));
  }
  return text + "</tr>\n";
}

/// Title of the cycle, when and by which program it ran, tool and touch probe.
std::string sectionHead(Context& context) {
  const auto& control = context.control();
  const DialogLanguage language = control.panel.language;
  const std::tm time = utcTime(control.wallClockStart, context.channel().seconds() - control.startSeconds);
  std::string text = fmt::format("<h2>{} {}</h2>\n<p>", context.record().name,
                                 translated(context.record().title, language, context.entry().logTerms));
  text += fmt::format(fmt::runtime(logFrame(language).dateForm), time);
  text +=
      fmt::format(" {}:{:02}:{:02}, {}, {} {} {}", time.tm_hour, time.tm_min, time.tm_sec, escaped(control.programPath),
                  translated("tool", language), control.tool.row, escaped(control.tool.name));
  if (!control.tool.probeRow.empty()) {
    text += fmt::format(", {} {}", translated("touch probe", language), control.tool.probeRow);
  }
  return text + "</p>\n";
}

}  // namespace

void addToHtmlLog(Context& context, const std::vector<std::string>& heading,
                  const std::vector<std::vector<std::string>>& rows, const std::string& file) {
  auto& control = context.control();
  const auto& files = control.panel.files();
  const auto found = files.find(file);
  const DialogLanguage language = control.panel.language;
  std::string text = found == files.end()
                         ? fmt::format(
                               "<!DOCTYPE html>\n<html lang=\"{}\"><head>"
                               "<meta charset=\"utf-8\"><title>{}</title></head>\n<body>\n",
                               code(translated("tool", language) == "tool" ? DialogLanguage::English : language),
                               translated("Touch probe log", language))
                         : found->second.substr(0, found->second.rfind("</body>"));
  if (std::ranges::count(context.record().logFiles, file) == 0) text += sectionHead(context);
  text += "<table>\n";
  text += row(context, "th", heading);
  for (const auto& cells : rows)
    text += row(context, "td", cells);
  text += "</table>\n</body></html>\n";
  context.log(file, text);
}

}  // namespace probewright::cycles::heidenhain
