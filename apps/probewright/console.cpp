#include "console.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "base/utf8.hpp"
#include "terminal.hpp"

namespace probewright::app {

using language::Encoding;

std::string printable(std::string_view text, Encoding encoding) {
  const bool isUtf8 = language::detectEncoding(text) == Encoding::Utf8;
  const std::string readable = language::toUtf8(text, isUtf8 ? Encoding::Utf8 : encoding);
  std::string shown;
  shown.reserve(readable.size());
  for (std::size_t i = 0; i < readable.size(); ++i) {
    const auto byte = static_cast<unsigned char>(readable[i]);
    // The second set of control characters, U+0080 to U+009F.
    const bool second = byte == 0xC2 && i + 1 < readable.size() && static_cast<unsigned char>(readable[i + 1]) < 0xA0;
    if (byte == '\t') {
      shown += ' ';
    } else if ((byte < 0x20 && byte != '\n') || byte == 0x7F) {
      shown += fmt::format("\\x{:02X}", byte);
    } else if (second) {
      shown += fmt::format("\\x{:02X}", static_cast<unsigned char>(readable[++i]));
    } else {
      shown += readable[i];
    }
  }
  return shown;
}

void print(const Diagnostics& diagnostics, Encoding encoding) {
  // Text by text: a path in UTF-8 may stand beside bytes of a program that are something else.
  constexpr std::size_t longest = 300;
  for (Diagnostic shown : diagnostics) {
    for (std::string* text : {&shown.place.file, &shown.message, &shown.excerpt, &shown.advice, &shown.code})
      *text = printable(*text, encoding);
    if (shown.excerpt.size() > longest) {
      std::size_t end = longest;
      while (end > 0 && continuesCharacter(shown.excerpt[end]))
        --end;
      shown.excerpt = shown.excerpt.substr(0, end) + " ...";
    }
    put(format(shown) + "\n", stderr);
  }
}

bool outputArrived() {
  errno = 0;
  const bool arrived = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  if (!arrived) {
    std::fprintf(stderr, "probewright: standard output could not be written%s%s\n", errno == 0 ? "" : ": ",
                 errno == 0 ? "" : std::strerror(errno));
  }
  return arrived;
}

}  // namespace probewright::app
