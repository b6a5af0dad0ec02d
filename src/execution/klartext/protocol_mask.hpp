#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "control/dialog_language.hpp"
#include "execution/names.hpp"
#include "language/value.hpp"

namespace probewright::execution::klartext {

/// What a mask of FN 16 makes of a file.
struct ProtocolResult {
  enum class Going { AsOpen, Append, Truncate };
  std::string text;
  bool close = false;
  Going going = Going::AsOpen;
  std::size_t mostBytes = 0;  ///< of the file, M_APPEND_MAX; 0: any
};

/// Formats a FN 16 mask line by line; see protocol_mask.cpp. `read` gives the value of "Q5" or "QS3".
ProtocolResult formatProtocol(std::string_view mask, const std::function<Value(std::string_view)>& read,
                              std::int64_t secondsSince1970, std::string_view callPath,
                              control::DialogLanguage language);

/// The keyword of a mask for a language of the control: "L_ENGLISH".
std::string_view languageWord(control::DialogLanguage language);

}  // namespace probewright::execution::klartext
