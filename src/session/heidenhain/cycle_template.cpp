#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/number_text.hpp"
#include "base/text.hpp"
#include "conversion/parameter_texts.hpp"
#include "session/first_value.hpp"
#include "session/heidenhain/family_parts.hpp"

namespace probewright::session::heidenhain {

namespace {

using cycles::CycleDefinition;
using cycles::Parameter;
using cycles::ValueKind;

/// Cycles whose parameters have no Q numbers stand in blocks of a form of their own.
struct OldForm {
  int cycle;
  const char* text;
};
constexpr std::array kOldForms = {
    OldForm{0, "TCH PROBE 0.0 REF. PLANE Q5 X-\nTCH PROBE 0.1 X+0 Y+0 Z+0\n"},
    OldForm{1, "TCH PROBE 1.0 POLAR PRESET\nTCH PROBE 1.1 X ANGLE: +0\nTCH PROBE 1.2 X+0 Y+0 Z+0\n"},
    OldForm{2, "TCH PROBE 2.0 CALIBRATE TS\nTCH PROBE 2.1 HEIGHT: +50 R +25 DIRECTION: 0\n"},
    OldForm{3,
            "TCH PROBE 3.0 MEASURING\nTCH PROBE 3.1 Q10\nTCH PROBE 3.2 X ANGLE: +0\n"
            "TCH PROBE 3.3 DIST +10 F100 MB1 REFERENCE SYSTEM: 0\nTCH PROBE 3.4 ERRORMODE1\n"},
    OldForm{4,
            "TCH PROBE 4.0 MEASURING IN 3-D\nTCH PROBE 4.1 Q10\nTCH PROBE 4.2 IX+0 IY+0 IZ-1\n"
            "TCH PROBE 4.3 DIST +10 F100 MB1 REFERENCE SYSTEM:0\n"},
    OldForm{30, "TCH PROBE 30.0 CALIBRATE TT\nTCH PROBE 30.1 HEIGHT: +100\n"},
    OldForm{31,
            "TCH PROBE 31.0 TOOL LENGTH\nTCH PROBE 31.1 CHECK: 0\nTCH PROBE 31.2 HEIGHT: +100\n"
            "TCH PROBE 31.3 PROBING THE TEETH: 0\n"},
    OldForm{32,
            "TCH PROBE 32.0 TOOL RADIUS\nTCH PROBE 32.1 CHECK: 0\nTCH PROBE 32.2 HEIGHT: +100\n"
            "TCH PROBE 32.3 PROBING THE TEETH: 0\n"},
    OldForm{33,
            "TCH PROBE 33.0 MEASURE TOOL\nTCH PROBE 33.1 CHECK: 0\nTCH PROBE 33.2 HEIGHT: +100\n"
            "TCH PROBE 33.3 PROBING THE TEETH: 0\n"},
    OldForm{9, "TCH PROBE 9.0 CALIBRATE TS LENGTH\nTCH PROBE 9.1 DATUM +50 REFERENCE SYSTEM 0\n"},
};

}  // namespace

std::string klartextTemplate(const CycleDefinition& cycle, control::ControlKind kind,
                             control::DialogLanguage language) {
  const auto old = std::ranges::find(kOldForms, cycle.number, &OldForm::cycle);
  if (old != kOldForms.end()) return old->text;
  std::string text = fmt::format("TCH PROBE {} {}", cycle.number, cycle.title);
  for (const Parameter& parameter : cycle.parameters) {
    if (!parameter.controls.contains(kind)) continue;
    const FirstValue first = firstValue(cycle, parameter);
    const std::string number = parameter.kind == ValueKind::Text
                                   ? '"' + first.text + '"'
                                   : (first.number < 0 ? "" : "+") + formatShortest(first.number);
    const std::string_view own = conversion::parameterText(cycle.number, static_cast<int>(parameter.address), language);
    text += fmt::format(" ~\n    {}={:<8};{}", parameter.name, number,
                        own.empty() ? upperCase(parameter.meaning.substr(0, parameter.meaning.find_first_of(",;:(")))
                                    : std::string(own));
  }
  return text + "\n";
}

}  // namespace probewright::session::heidenhain
