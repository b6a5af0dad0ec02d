#include <algorithm>
#include <iterator>

#include "language/sinumerik/check.hpp"
#include "language/sinumerik/cursor.hpp"
#include "language/sinumerik/keywords.hpp"

namespace probewright::language::sinumerik {

namespace {

constexpr std::string_view globals[] = {
    "_OVR",     "_OVI",     "_EV",         "_MV",          "_EVMVNUM",    "_WP",       "_TP",      "_TPW",
    "_KB",      "_CM",      "_CBIT",       "_CHBIT",       "_SPEED",      "_CVAL",     "_MFS",     "_TP_CF",
    "_MT_COMP", "_TXT",     "_PROTNAME",   "_HEADLINE",    "_PROTFORM",   "_PROTSYM",  "_PROTVAL", "_PMI",
    "_SP_B",    "_JM_I",    "_JM_B",       "_MC_MA",       "_MC_SIMDIFF", "_KNUM",     "_MVAR",    "_PRNUM",
    "_SETVAL",  "_MA",      "_MD",         "_FA",          "_TSA",        "_VMS",      "_NMSP",    "_TNAME",
    "_TZL",     "_TMV",     "_TUL",        "_TLL",         "_TDIF",       "_K",        "_EVNUM",   "_CALNUM",
    "_SETV",    "_ID",      "_INCA",       "_STA1",        "_RA",         "_CPA",      "_FINISH",  "_SEMIFIN",
    "_ROUGH",   "_OFF",     "_ORI_FINISH", "_ORI_SEMIFIN", "_ORI_ROUGH",  "_CYCLE832", "_CPO",     "_SZA",
    "_SZO",     "_RF",      "_TENV",       "_DLNUM",       "_CORA",       "_TNUM",     "_TNVL",    "_OVS_TNAME",
    "_ALM",     "_MT_EC_R", "_MT_EC_L",
};

}  // namespace

bool isGlobalUserData(std::string_view name) {
  return name.starts_with("E_MESS") || std::find(std::begin(globals), std::end(globals), name) != std::end(globals);
}

namespace {

/// Steps of ShopMill and ShopTurn programs: E_HEAD, E_PO_CIR, F_ROUGH.
bool isShopStep(std::string_view name) {
  static constexpr std::string_view kinds[] = {"HEAD", "END", "DR",  "PS",   "PO",   "PI",    "SL",     "MI",
                                               "SW",   "CP",  "CON", "TH",   "EN",   "FR",    "ZO",     "ST",
                                               "TR",   "SP",  "SR",  "GROV", "THRD", "DRILL", "CUTOFF", "ROUGH"};
  if (!name.starts_with("E_") && !name.starts_with("F_")) return false;
  const std::string_view rest = name.substr(2);
  return std::ranges::find(kinds, rest.substr(0, rest.find('_'))) != std::end(kinds);
}

}  // namespace

bool isSkippedCycle(std::string_view name) {
  if (isShopStep(name)) return true;
  static constexpr std::string_view machining[] = {
      "HOLES1", "HOLES2", "POCKET1", "POCKET2", "POCKET3", "POCKET4", "SLOT1", "SLOT2", "LONGHOLE", "TOOLCARR",
  };
  if (std::find(std::begin(machining), std::end(machining), name) != std::end(machining)) return true;
  if (!name.starts_with("CYCLE") || name.size() < 7 || name.size() > 9) return false;
  if (isMeasuringCycle(name) || !std::all_of(name.begin() + 5, name.end(), isDigit)) return false;
  // Technology cycles: drilling and milling 60 to 99 and 800 to 899, turning 930 to 959, grinding 4070 to 4079,
  // position patterns and the like.
  int number = 0;
  for (const char digit : name.substr(5))
    number = 10 * number + (digit - '0');
  const auto within = [number](int first, int last) { return number >= first && number <= last; };
  return within(60, 119) || within(200, 299) || within(400, 499) || within(700, 899) || within(930, 959) ||
         within(3000, 3999) || within(4070, 4079);
}

bool isCycleWithoutEffect(std::string_view name) {
  static constexpr std::string_view names[] = {
      "GROUP_BEGIN", "GROUP_END",   "GROUP_ADDEND", "CYCLE832",   "CYCLE_HSC",
      "CUST_800",    "CUST_MEACYC", "CUST_TECHCYC", "CUST_CLAMP", "PROG_EVENT",
  };
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

std::string_view skippedFunction(std::string_view name) {
  struct Skipped {
    std::string_view name, how;
  };
  constexpr std::string_view no = "is not carried out", straight = "is travelled as straight lines",
                             norm = "is not carried out: the contour is approached and left as with NORM",
                             limits = "is not carried out: limits of the working area are not watched";
  static constexpr Skipped functions[] = {
      {"G147", norm},    {"G148", norm},     {"G247", norm},     {"G248", norm},     {"G347", norm},
      {"G348", norm},    {"G461", no},       {"G462", no},       {"G33", straight},  {"G34", straight},
      {"G35", straight}, {"G331", straight}, {"G332", straight}, {"G335", straight}, {"G336", straight},
      {"G63", straight}, {"G5", no},         {"G7", no},         {"G25", limits},    {"G26", limits},
      {"G74", no},       {"G751", no},       {"G931", no},       {"G942", no},       {"G952", no},
  };
  if (const auto found = std::ranges::find(functions, name, &Skipped::name); found != std::end(functions))
    return found->how;
  if (name.size() == 4 && name.starts_with("G8")) return no;  // G810 to G829: the machine builder's own
  const KeywordEntry* word = keywordEntry(name);
  switch (word == nullptr ? Effect::CarriedOut : word->effect) {
    case Effect::NotCarriedOut:
      return no;
    case Effect::Straight:
      return straight;
    case Effect::AsNorm:
      return norm;
    case Effect::CarriedOut:
    case Effect::Harmless:
      break;
  }
  return {};
}

std::string_view skippedMoveWord(std::uint32_t address) {
  static constexpr std::string_view vectors[] = {"A4", "B4", "C4", "A5", "B5", "C5",
                                                 "A6", "B6", "C6", "A7", "B7", "C7"};
  const auto has = [address](std::string_view name) { return language::addressOf(name) == address; };
  if (const auto found = std::ranges::find_if(vectors, has); found != std::end(vectors)) return *found;
  for (const KeywordEntry& each : keywords())
    if (each.keyword == Keyword::MoveWord && each.effect == Effect::NotCarriedOut && has(each.name)) return each.name;
  return {};
}

std::string_view skippedTransformation(std::span<const std::optional<double>> arguments) {
  const auto at = [&](std::size_t place) {
    return place < arguments.size() && arguments[place] ? *arguments[place] : 0;
  };
  if (at(0) != 0 && at(0) != 1) return "TRAORI with another transformation than the first";
  if (at(1) != 0 || at(2) != 0 || at(3) < 0) return "TRAORI with another direction of the tool than its Z axis";
  return {};
}

bool isFrameWithoutEffect(std::string_view name) {
  static constexpr std::string_view names[] = {
      "$P_EXTFRAME",  "$P_TRAFRAME",  "$P_CYCFRAME",  "$P_GFRAME",    "$P_ISO1FRAME", "$P_ISO2FRAME",
      "$P_ISO3FRAME", "$P_ISO4FRAME", "$P_EXTSFRAME", "$P_EXTFR",     "$P_TOOLFR",    "$P_PARTFR",
      "$P_TRAFR",     "$P_WPFR",      "$P_CYCFR",     "$P_GFR",       "$P_ISO1FR",    "$P_ISO2FR",
      "$P_ISO3FR",    "$P_ISO4FR",    "$P_CHBFRMASK", "$P_NCBFRMASK", "$P_CHSFRMASK"};
  return std::ranges::find(names, name) != std::end(names);
}

bool saysWhatIs(std::string_view name, std::optional<double> value) {
  static constexpr std::string_view offAtZero[] = {"OFFN", "TCARR", "FXS", "CUTMOD", "TOFF", "DISC"};
  if (!value) return name == "SETMS" || name == "GEOAX";
  // On lathes spindle 2 drives the tools in the turret.
  if (name == "SETMS") return *value == 1 || *value == 2;
  return *value == 0 && std::ranges::find(offAtZero, name) != std::end(offAtZero);
}

bool isSkippedMachineFunction(int number) {
  // Ends and stops, spindle, tool change, coolant, gears, spindle as an axis.
  return number > 9 && number != 17 && number != 19 && number != 30 && (number < 40 || number > 45) && number != 70;
}

bool isSkippedGroup(int group, int number) {
  static constexpr int groups[] = {17, 22, 23, 25, 31, 32, 33, 40, 42, 47, 49, 52, 53, 56};
  return number > 1 && std::ranges::find(groups, group) != std::end(groups);
}

bool isUnavailableFunction(std::string_view name) {
  static constexpr std::string_view functions[] = {
      "CHKDNO",    "GETTCOR",  "INTERSEC",  "MEAFRAME",  "GETMDACT",  "GETACTTD", "GETTENV",    "SETTCOR",
      "LENTOAX",   "STRINGIS", "CTAB",      "CTABINV",   "ADDFRAME",  "CORRTC",   "ORISOLH",    "GETVARTYP",
      "GETVARPHU", "GETVARAP", "GETVARLIM", "GETVARDFT", "NAMETOINT", "COLLPAIR", "AXTOINT",    "INTTOAX",
      "AXCTSWEC",  "TOOLGNT",  "SETDNO",    "MEASURE",   "CALCPOSI",  "CHKDM",    "CTABEXISTS", "CTABNO",
      "AXTOCHAN",  "SETTA",    "CAC",       "CIC",       "CDC",       "CACP",     "CACN"};
  return std::ranges::find(functions, name) != std::end(functions);
}

bool isMeasuringCycle(std::string_view name) {
  static constexpr std::string_view measuring[] = {
      "CYCLE116", "CYCLE150", "CYCLE961", "CYCLE971", "CYCLE972", "CYCLE973", "CYCLE974", "CYCLE976", "CYCLE977",
      "CYCLE978", "CYCLE979", "CYCLE982", "CYCLE994", "CYCLE995", "CYCLE996", "CYCLE997", "CYCLE998", "CYCLE9960",
  };
  return std::find(std::begin(measuring), std::end(measuring), name) != std::end(measuring);
}

}  // namespace probewright::language::sinumerik
