#include <algorithm>
#include <array>

#include "cycles/sinumerik/alarms.hpp"
#include "cycles/sinumerik/context.hpp"

namespace probewright::cycles::sinumerik {
namespace {

constexpr std::array alarms = {
    AlarmText{61300, "The measuring cycle cannot be called here", "call it at program level 5 or above and with G40"},
    AlarmText{61301, "Probe does not switch", "check setpoint, measuring path DFA and zero offset"},
    AlarmText{61302, "Probe collision", "correct the starting position; the path of the probe must be clear"},
    AlarmText{61303, "Safe area exceeded", "check the setpoint, or enlarge TSA (parameter S_TSA)"},
    AlarmText{61304, "Oversize", "check the workpiece and the tool"},
    AlarmText{61305, "Undersize", "check the workpiece and the tool"},
    AlarmText{61306, "Permissible dimensional difference exceeded", "check the tool, or enlarge DIF (S_TDIF)"},
    AlarmText{61307, "Wrong measuring variant", "correct the digits of S_MVAR"},
    AlarmText{61308, "Measuring path DFA must be greater than 0", "correct S_FA"},
    AlarmText{61309, "Check the probe type", "load a workpiece probe: type 710, 712, 713, 714 or 580 in $TC_DP1"},
    AlarmText{61310, "A scale factor is active", "cancel SCALE before the measuring cycle"},
    AlarmText{61311, "No D number is active", "select the tool offset of the probe before the measuring cycle"},
    AlarmText{61313, "Check the probe number", "S_PRNUM is 1 to 12, of tool touch probes 1 to 6"},
    AlarmText{61314, "Check the tool type", "the tool to be corrected has a type that the variant cannot correct"},
    AlarmText{61315, "Check the cutting edge position", "correct $TC_DP2"},
    AlarmText{61316, "Centre and radius cannot be determined", "the points do not lie on a circle"},
    AlarmText{61317, "Check the number of points", "a circle needs three or four points"},
    AlarmText{61318, "Check the weighting factor", "S_K must be greater than 0"},
    AlarmText{61319, "Check the call parameter", "compare the call with the parameter's range"},
    AlarmText{61321, "Check the zero offset number", "correct S_KNUM"},
    AlarmText{61322, "Check the 4th digit of S_KNUM", "correct S_KNUM"},
    AlarmText{61323, "Check the 5th digit of S_KNUM", "correct S_KNUM"},
    AlarmText{61324, "Check the 6th digit of S_KNUM", "correct S_KNUM"},
    AlarmText{61325, "Check the measuring axis or offset axis", "correct S_MA"},
    AlarmText{61326, "Check the measuring direction", "correct S_MD"},
    AlarmText{61328, "Check the D number", "the tool to be corrected has no such cutting edge"},
    AlarmText{61329, "Check the rotary axis", "correct S_RA"},
    AlarmText{61330, "A coordinate rotation is active", "cancel the rotation before the measuring cycle"},
    AlarmText{61331, "Angle too large", "align the workpiece better, or enlarge TSA"},
    AlarmText{61332, "Change the position of the tool tip", "start the cycle from another position"},
    AlarmText{61334, "Check the protection zone", "the protection zone must lie within the feature"},
    AlarmText{61336, "The geometry axes are not available", "the machine lacks an axis that the variant needs"},
    AlarmText{61338, "The positioning speed is 0", "enter SD 55634 and SD 55636"},
    AlarmText{61341, "The probe is not calibrated in the active plane",
              "calibrate with CYCLE976 or CYCLE973, a tool touch probe with CYCLE971 or CYCLE982"},
    AlarmText{61343, "The tool does not exist", "correct S_TNAME"},
    AlarmText{61351, "Tool length or radius is 0", "enter the tool data"},
    AlarmText{61372, "The variant needs a spindle that can be positioned", "use another variant"},
};

const AlarmText* find(int number) {
  const auto among = [number](std::span<const AlarmText> list) {
    const auto found = std::ranges::find(list, number, &AlarmText::number);
    return found == list.end() ? nullptr : &*found;
  };
  const AlarmText* found = among(alarms);
  for (const Entry* entry : entries()) {
    if (found != nullptr) break;
    found = among(entry->alarms);
  }
  return found;
}

}  // namespace

std::vector<int> alarmNumbers() {
  std::vector<int> numbers;
  const auto add = [&numbers](std::span<const AlarmText> list) {
    for (const AlarmText& entry : list)
      numbers.push_back(entry.number);
  };
  add(alarms);
  for (const Entry* entry : entries())
    add(entry->alarms);
  std::ranges::sort(numbers);
  return numbers;
}

std::string_view alarmText(int number) {
  const AlarmText* entry = find(number);
  return entry == nullptr ? std::string_view() : entry->text;
}

std::string_view alarmAdvice(int number) {
  const AlarmText* entry = find(number);
  return entry == nullptr ? std::string_view() : entry->advice;
}

}  // namespace probewright::cycles::sinumerik
