#pragma once

#include <array>

#include "cycles/heidenhain/parameters.hpp"
#include "cycles/heidenhain/probe_words.hpp"

/// The words that the blocks of cycles 3 and 4 share.
namespace probewright::cycles::heidenhain::parameters {

inline constexpr Parameter resultNumber = {.name = "Q",
                                           .address = probe_word::result,
                                           .meaning = "number of the first of four result parameters",
                                           .kind = ValueKind::Integer,
                                           .minimum = 0,
                                           .maximum = 1996};

inline constexpr Choice systemChoices[] = {{0, "active coordinate system"}, {1, "machine coordinate system"}};
/// The old blocks call it REFERENCE SYSTEM: 0 = ACT, 1 = REF.
inline constexpr Parameter referenceSystem =
    standard(option(probe_word::referenceSystem, "REFERENCE SYSTEM", "coordinate system", systemChoices), 0);

inline constexpr std::array strokeOfBlock = {
    coordinate(probe_word::distance, "DIST", "longest path of the measuring move"),
    Parameter{.name = "F",
              .address = probe_word::feed,
              .meaning = "feed rate of the measuring move",
              .kind = ValueKind::Feed,
              .minimum = 0,
              .maximum = 3000},
    length(probe_word::retraction, "MB", "retraction after the touch, at most to the start"),
    referenceSystem,
};

}  // namespace probewright::cycles::heidenhain::parameters
