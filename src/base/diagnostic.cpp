#include "base/diagnostic.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace probewright {

tl::unexpected<Diagnostic> fail(SourcePlace place, std::string message, std::string advice) {
  return tl::unexpected(Diagnostic{Severity::Error, std::move(place), std::move(message), {}, std::move(advice), {}});
}

tl::unexpected<Diagnostic> fail(std::string message, std::string advice) {
  return fail(SourcePlace{}, std::move(message), std::move(advice));
}

bool hasErrors(const Diagnostics& diagnostics) {
  return std::any_of(diagnostics.begin(), diagnostics.end(),
                     [](const Diagnostic& d) { return d.severity == Severity::Error; });
}

std::string format(const Diagnostic& diagnostic) {
  std::string text;
  const SourcePlace& place = diagnostic.place;
  if (!place.file.empty()) {
    text += place.file;
    if (place.line > 0) text += fmt::format(":{}", place.line);
    if (place.line > 0 && place.column > 0) text += fmt::format(":{}", place.column);
    text += ": ";
  }
  constexpr const char* names[] = {"note", "warning", "error"};
  text += names[static_cast<int>(diagnostic.severity)];
  text += ": ";
  if (!diagnostic.code.empty()) text += diagnostic.code + ": ";
  text += diagnostic.message;
  if (!diagnostic.excerpt.empty()) text += "\n    " + diagnostic.excerpt;
  if (!diagnostic.advice.empty()) text += "\n    " + diagnostic.advice;
  return text;
}

}  // namespace probewright
