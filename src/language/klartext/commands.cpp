#include "language/klartext/commands.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

namespace probewright::language::klartext {

namespace {

/// In the order of the enumerations.
constexpr std::array<std::string_view, 58> commandNames = {"BEGIN PGM",
                                                           "BLK FORM",
                                                           "SECTION",
                                                           "ERROR",
                                                           "DECLARE",
                                                           "OPEN FILE",
                                                           "MONITORING",
                                                           "SET UNDEFINED",
                                                           "FN14",
                                                           "FN15",
                                                           "FN16",
                                                           "FN17",
                                                           "FN18",
                                                           "FN19",
                                                           "FN20",
                                                           "FN21",
                                                           "FN22",
                                                           "FN23",
                                                           "FN24",
                                                           "FN25",
                                                           "FN26",
                                                           "FN27",
                                                           "FN28",
                                                           "FN29",
                                                           "FN37",
                                                           "FN38",
                                                           "TABDATA READ",
                                                           "TABDATA WRITE",
                                                           "TABDATA ADD",
                                                           "SQL",
                                                           "CYCL DEF 9",
                                                           "CYCL DEF 12",
                                                           "CYCL DEF 13",
                                                           "CYCL DEF 32",
                                                           "CYCL CALL",
                                                           "GLOBAL DEF",
                                                           "PATTERN DEF",
                                                           "TOOL DEF",
                                                           "SEL PGM",
                                                           "SEL TABLE",
                                                           "SEL PATTERN",
                                                           "SEL CONTOUR",
                                                           "SEL CYCLE",
                                                           "SEL CORR-TABLE",
                                                           "SEL CORR-TABLE TCS",
                                                           "SEL CORR-TABLE WPL",
                                                           "PRESET SELECT",
                                                           "PRESET COPY",
                                                           "PRESET CORR",
                                                           "FUNCTION",
                                                           "FUNCTION RESET",
                                                           "CONTOUR",
                                                           "FL",
                                                           "FLT",
                                                           "FC",
                                                           "FCT",
                                                           "FPOL",
                                                           "FSELECT"};
static_assert(commandNames.size() == static_cast<std::size_t>(CommandKind::FreeSelection) + 1);

constexpr std::array<std::string_view, 24> transformNames = {
    "CYCL DEF 7",        "CYCL DEF 8",         "CYCL DEF 10",      "CYCL DEF 11",          "CYCL DEF 19",
    "CYCL DEF 26",       "CYCL DEF 247",       "TRANS DATUM AXIS", "TRANS DATUM TABLE",    "TRANS DATUM RESET",
    "TRANS MIRROR AXIS", "TRANS MIRROR RESET", "TRANS ROTATION",   "TRANS ROTATION RESET", "TRANS SCALE",
    "TRANS SCALE RESET", "PLANE SPATIAL",      "PLANE PROJECTED",  "PLANE EULER",          "PLANE VECTOR",
    "PLANE POINTS",      "PLANE RELATIVE",     "PLANE AXIAL",      "PLANE RESET"};
static_assert(transformNames.size() == static_cast<std::size_t>(TransformKind::PlaneReset) + 1);

template <class Kind, std::size_t Count>
Kind kindNamed(const std::array<std::string_view, Count>& names, std::string_view name) {
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) throw std::logic_error("no instruction of the HEIDENHAIN languages: " + std::string(name));
  return static_cast<Kind>(found - names.begin());
}

}  // namespace

std::string_view nameOf(CommandKind kind) { return commandNames[static_cast<std::size_t>(kind)]; }
std::string_view nameOf(TransformKind kind) { return transformNames[static_cast<std::size_t>(kind)]; }

CommandKind functionCommand(int number) { return kindNamed<CommandKind>(commandNames, "FN" + std::to_string(number)); }

CommandKind kindOf(const Block& block, const Command& command) {
  return kindNamed<CommandKind>(commandNames, block.at(command.name));
}

TransformKind kindOf(const Block& block, const Transform& transform) {
  return kindNamed<TransformKind>(transformNames, block.at(transform.name));
}

bool isFunction(CommandKind kind) { return kind >= CommandKind::Fn14 && kind <= CommandKind::Fn38; }
bool isPlane(TransformKind kind) { return kind >= TransformKind::PlaneSpatial; }
bool isTrans(TransformKind kind) {
  return kind >= TransformKind::TransDatumAxis && kind <= TransformKind::TransScaleReset;
}

}  // namespace probewright::language::klartext
