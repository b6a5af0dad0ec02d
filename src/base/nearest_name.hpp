#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace probewright {

/// The one of `names` that is most like `word`, if any is like it at all: for "did you mean".
std::optional<std::string> nearestName(std::string_view word, const std::vector<std::string>& names);

}  // namespace probewright
