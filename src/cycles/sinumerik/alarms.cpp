#include <algorithm>
#include <array>

#include "cycles/sinumerik/alarms.hpp"
#include "cycles/sinumerik/context.hpp"

namespace probewright::cycles::sinumerik {
namespace {

struct AlarmEntry {
  int number;
  std::string_view text, advice;
};

constexpr std::array alarms = {
    AlarmEntry{61300, "The measuring cycle cannot be called here", "call it at program level 5 or above and with G40"},
    AlarmEntry{61301, "Probe does not switch", "check setpoint, measuring path DFA and zero offset"},
    AlarmEntry{61302, "Probe collision", "correct the starting position; the path of the probe must be clear"},
    AlarmEntry{61303, "Safe area exceeded", "check the setpoint, or enlarge TSA (parameter S_TSA)"},
    AlarmEntry{61304, "Oversize", "check the workpiece and the tool"},
    AlarmEntry{61305, "Undersize", "check the workpiece and the tool"},
    AlarmEntry{61306, "Permissible dimensional difference exceeded", "check the tool, or enlarge DIF (S_TDIF)"},
    AlarmEntry{61307, "Wrong measuring variant", "correct the digits of S_MVAR"},
    AlarmEntry{61308, "Measuring path DFA must be greater than 0", "correct S_FA"},
    AlarmEntry{61309, "Check the probe type", "load a workpiece probe: type 710, 712, 713, 714 or 580 in $TC_DP1"},
    AlarmEntry{61310, "A scale factor is active", "cancel SCALE before the measuring cycle"},
    AlarmEntry{61311, "No D number is active", "select the tool offset of the probe before the measuring cycle"},
    AlarmEntry{61313, "Check the probe number", "S_PRNUM is 1 to 12"},
    AlarmEntry{61314, "Check the tool type", "the tool to be corrected has a type that the variant cannot correct"},
    AlarmEntry{61315, "Check the cutting edge position", "correct $TC_DP2"},
    AlarmEntry{61316, "Centre and radius cannot be determined", "the points do not lie on a circle"},
    AlarmEntry{61317, "Check the number of points", "a circle needs three or four points"},
    AlarmEntry{61318, "Check the weighting factor", "S_K must be greater than 0"},
    AlarmEntry{61319, "Check the call parameter", "compare the call with the parameter's range"},
    AlarmEntry{61321, "Check the zero offset number", "correct S_KNUM"},
    AlarmEntry{61322, "Check the 4th digit of S_KNUM", "correct S_KNUM"},
    AlarmEntry{61323, "Check the 5th digit of S_KNUM", "correct S_KNUM"},
    AlarmEntry{61324, "Check the 6th digit of S_KNUM", "correct S_KNUM"},
    AlarmEntry{61325, "Check the measuring axis or offset axis", "correct S_MA"},
    AlarmEntry{61326, "Check the measuring direction", "correct S_MD"},
    AlarmEntry{61328, "Check the D number", "the tool to be corrected has no such cutting edge"},
    AlarmEntry{61329, "Check the rotary axis", "correct S_RA"},
    AlarmEntry{61330, "A coordinate rotation is active", "cancel the rotation before the measuring cycle"},
    AlarmEntry{61331, "Angle too large", "align the workpiece better, or enlarge TSA"},
    AlarmEntry{61332, "Change the position of the tool tip", "start the cycle from another position"},
    AlarmEntry{61333, "Check the calibration body number", "S_CALNUM is 1 to 3"},
    AlarmEntry{61334, "Check the protection zone", "the protection zone must lie within the feature"},
    AlarmEntry{61336, "The geometry axes are not available", "the machine lacks an axis that the variant needs"},
    AlarmEntry{61338, "The positioning speed is 0", "enter SD 55634 and SD 55636"},
    AlarmEntry{61341, "The probe is not calibrated in the active plane", "calibrate with CYCLE976 or CYCLE973"},
    AlarmEntry{61343, "The tool does not exist", "correct S_TNAME"},
    AlarmEntry{61351, "Tool length or radius is 0", "enter the tool data"},
    AlarmEntry{61372, "The variant needs a spindle that can be positioned", "use another variant"},
    AlarmEntry{61414, "The triangle of the three balls is distorted more than allowed",
               "check the set centres of the balls, or enlarge S_TNVL"},
};

const AlarmEntry* find(int number) {
  const auto found = std::ranges::find(alarms, number, &AlarmEntry::number);
  return found == alarms.end() ? nullptr : &*found;
}

}  // namespace

std::vector<int> alarmNumbers() {
  std::vector<int> numbers;
  for (const AlarmEntry& entry : alarms)
    numbers.push_back(entry.number);
  return numbers;
}

std::string_view alarmText(int number) {
  const AlarmEntry* entry = find(number);
  return entry == nullptr ? std::string_view() : entry->text;
}

std::string_view alarmAdvice(int number) {
  const AlarmEntry* entry = find(number);
  return entry == nullptr ? std::string_view() : entry->advice;
}

}  // namespace probewright::cycles::sinumerik
