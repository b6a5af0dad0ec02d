#include "base/utf8.hpp"

#include <algorithm>

namespace probewright {

std::size_t characterCount(std::string_view utf8) {
  return utf8.size() - static_cast<std::size_t>(std::ranges::count_if(utf8, continuesCharacter));
}

bool isUtf8(std::string_view bytes) {
  using Byte = unsigned char;
  std::size_t i = 0;
  while (i < bytes.size()) {
    const Byte lead = static_cast<Byte>(bytes[i]);
    const std::size_t more = lead < 0x80                   ? 0
                             : lead >= 0xC2 && lead < 0xE0 ? 1
                             : lead >= 0xE0 && lead < 0xF0 ? 2
                             : lead >= 0xF0 && lead < 0xF5 ? 3
                                                           : bytes.size();
    if (more >= bytes.size() - i) return false;
    for (std::size_t k = 1; k <= more; ++k) {
      if (!continuesCharacter(bytes[i + k])) return false;
    }
    const Byte second = more > 0 ? static_cast<Byte>(bytes[i + 1]) : Byte{0};
    // Overlong forms, surrogates and what lies above U+10FFFF.
    if ((lead == 0xE0 && second < 0xA0) || (lead == 0xED && second > 0x9F) || (lead == 0xF0 && second < 0x90) ||
        (lead == 0xF4 && second > 0x8F)) {
      return false;
    }
    i += more + 1;
  }
  return true;
}

}  // namespace probewright
