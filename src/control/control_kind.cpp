#include "control/control_kind.hpp"

#include <cctype>
#include <string>

namespace probewright::control {

std::optional<ControlKind> controlKindOf(std::string_view text) {
  std::string plain;
  for (const char c : text) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
      plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
  }
  if (plain == "tnc640") return ControlKind::TNC640;
  if (plain == "itnc530") return ControlKind::iTNC530;
  if (plain == "840dsl" || plain == "840d" || plain == "828d" || plain == "sinumerik") {
    return ControlKind::Sinumerik840Dsl;
  }
  return std::nullopt;
}

}  // namespace probewright::control
