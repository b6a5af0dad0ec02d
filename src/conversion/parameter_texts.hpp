#pragma once

#include <string_view>

#include "control/control_kind.hpp"
#include "control/dialog_language.hpp"

namespace probewright::conversion {

/// What a TNC writes after a parameter of its touch probe cycles: "1ST POINT 1ST AXIS" after Q263 of 417, in its
/// conversational language. As on the controls, Russian, Swedish and German texts are in plain capitals, and some
/// Russian ones are English. Where no edition of a manual shows a text, it is worded like those that are shown. For
/// parameters without a text of their own the one of cycles in general.
std::string_view parameterText(int cycle, int parameter,
                               control::DialogLanguage language = control::DialogLanguage::English);

/// The same in English as an iTNC 530 writes it, and the title of a cycle there: its datum is what newer controls call
/// a preset.
std::string_view parameterText(int cycle, int parameter, control::ControlKind control);
std::string_view cycleTitle(int cycle, control::ControlKind control);

}  // namespace probewright::conversion
