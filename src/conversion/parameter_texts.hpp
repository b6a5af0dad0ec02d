#pragma once

#include <string_view>

namespace probewright::conversion {

/// What a TNC writes after a parameter of its touch probe cycles: "1ST POINT 1ST AXIS" after Q263 of 417. For
/// parameters without a text of their own the one of cycles in general.
std::string_view parameterText(int cycle, int parameter);

}  // namespace probewright::conversion
