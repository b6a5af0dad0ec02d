#pragma once

#include <functional>
#include <string_view>

namespace probewright {

/// Takes a text or the bytes of a file piece by piece.
using Sink = std::function<void(std::string_view)>;
/// Gives them to `sink`.
using Content = std::function<void(const Sink& sink)>;

}  // namespace probewright
