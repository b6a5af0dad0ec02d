#include "conversion/parameter_texts.hpp"

#include <algorithm>

namespace probewright::conversion {

namespace {

struct Text {
  int parameter;
  std::string_view text;
};

constexpr Text texts[] = {
    {247, "STEPPING ANGLE"},
    {260, "CLEARANCE HEIGHT"},
    {261, "MEASURING HEIGHT"},
    {262, "NOMINAL DIAMETER"},
    {263, "1ST POINT 1ST AXIS"},
    {264, "1ST POINT 2ND AXIS"},
    {265, "2ND POINT 1ST AXIS"},
    {266, "2ND POINT 2ND AXIS"},
    {267, "TRAVERSE DIRECTION"},
    {272, "MEASURING AXIS"},
    {273, "CENTER IN 1ST AXIS"},
    {274, "CENTER IN 2ND AXIS"},
    {275, "MAXIMUM LIMIT"},
    {276, "MINIMUM LIMIT"},
    {277, "MAXIMUM LIMIT"},
    {278, "MINIMUM LIMIT"},
    {279, "TOLERANCE 1ST CENTER"},
    {280, "TOLERANCE 2ND CENTER"},
    {281, "MEASURING LOG"},
    {282, "1ST SIDE LENGTH"},
    {283, "2ND SIDE LENGTH"},
    {284, "MAX. LIMIT 1ST SIDE"},
    {285, "MIN. LIMIT 1ST SIDE"},
    {286, "MAX. LIMIT 2ND SIDE"},
    {287, "MIN. LIMIT 2ND SIDE"},
    {288, "MAXIMUM LIMIT"},
    {289, "MINIMUM LIMIT"},
    {294, "1ST POINT 3RD AXIS"},
    {295, "2ND PNT 3RD AXIS"},
    {296, "3RD PNT 1ST AXIS"},
    {297, "3RD PNT 2ND AXIS"},
    {298, "3RD PNT 3RD AXIS"},
    {301, "MOVE TO CLEARANCE"},
    {303, "MEAS. VALUE TRANSFER"},
    {304, "BASIC ROTATION"},
    {305, "NUMBER IN TABLE"},
    {307, "PRESET ROTATION ANG."},
    {309, "PGM STOP TOLERANCE"},
    {310, "OFFS. 2ND MEASUREMNT"},
    {311, "NOMINAL LENGTH"},
    {320, "SET-UP CLEARANCE"},
    {321, "CENTER IN 1ST AXIS"},
    {322, "CENTER IN 2ND AXIS"},
    {323, "FIRST SIDE LENGTH"},
    {324, "2ND SIDE LENGTH"},
    {325, "STARTING ANGLE"},
    {326, "SPACING IN 1ST AXIS"},
    {327, "SPACING IN 2ND AXIS"},
    {328, "STARTNG PNT 1ST AXIS"},
    {329, "STARTNG PNT 2ND AXIS"},
    {330, "TOOL"},
    {331, "PRESET"},
    {332, "PRESET"},
    {333, "PRESET"},
    {365, "TYPE OF TRAVERSE"},
    {372, "PROBING DIRECTION"},
    {380, "REFERENCE ANGLE"},
    {381, "PROBE IN TS AXIS"},
    {382, "1ST CO. FOR TS AXIS"},
    {383, "2ND CO. FOR TS AXIS"},
    {384, "3RD CO. FOR TS AXIS"},
    {405, "PRESET"},
    {407, "SPHERE RADIUS"},
    {423, "NO. OF PROBE POINTS"},
    {433, "CALIBRATE LENGTH"},
    {434, "PRESET FOR LENGTH"},
    {455, "NO. POINTS 3-D CAL."},
    {498, "REVERSE TOOL"},
    {531, "ANGLE OF INCIDENCE"},
    {1100, "1ST POINT REF AXIS"},
    {1101, "1ST POINT MINOR AXIS"},
    {1102, "1ST POINT TOOL AXIS"},
    {1103, "2ND POINT REF AXIS"},
    {1104, "2ND POINT MINOR AXIS"},
    {1105, "2ND POINT TOOL AXIS"},
    {1106, "3RD POINT REF AXIS"},
    {1107, "3RD POINT MINOR AXIS"},
    {1108, "3RD POINT TOOL AXIS"},
    {1120, "TRANSFER POSITION"},
    {1121, "CONFIRM ROTATION"},
    {1125, "CLEAR. HEIGHT MODE"},
    {1126, "ALIGN ROTARY AXIS"},
};

struct OfCycle {
  int cycle, parameter;
  std::string_view text;
};

/// Where a parameter means something else than in most cycles.
constexpr OfCycle exceptions[] = {
    {408, 311, "SLOT WIDTH"},        {409, 311, "RIDGE WIDTH"},      {425, 311, "NOMINAL LENGTH"},
    {426, 311, "NOMINAL LENGTH"},    {414, 296, "3RD PNT 1ST AXIS"}, {461, 434, "PRESET"},
    {462, 407, "RING RADIUS"},       {415, 308, "CORNER"},           {427, 330, "TOOL"},
    {462, 301, "MOVE TO CLEARANCE"},
};

}  // namespace

std::string_view parameterText(int cycle, int parameter) {
  for (const OfCycle& each : exceptions)
    if (each.cycle == cycle && each.parameter == parameter) return each.text;
  const auto found = std::ranges::find(texts, parameter, &Text::parameter);
  return found == std::end(texts) ? std::string_view("PARAMETER") : found->text;
}

}  // namespace probewright::conversion
