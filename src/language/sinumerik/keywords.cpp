#include "language/sinumerik/keywords.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <numeric>
#include <vector>

namespace probewright::sinumerik {

namespace {

using language::Function;

constexpr auto keywordTable = [] {
  std::array table = std::to_array<KeywordEntry>({
      {"IF", Keyword::If},
      {"ELSE", Keyword::Else},
      {"ENDIF", Keyword::EndIf},
      {"CASE", Keyword::Case},
      {"FOR", Keyword::For},
      {"ENDFOR", Keyword::EndFor},
      {"WHILE", Keyword::While},
      {"ENDWHILE", Keyword::EndWhile},
      {"LOOP", Keyword::Loop},
      {"ENDLOOP", Keyword::EndLoop},
      {"REPEAT", Keyword::Repeat},
      {"REPEATB", Keyword::RepeatBlock},
      {"UNTIL", Keyword::Until},
      {"GOTO", Keyword::Goto},
      {"GOTOF", Keyword::Goto},
      {"GOTOB", Keyword::Goto},
      {"GOTOC", Keyword::Goto},
      {"GOTOS", Keyword::Goto},
      {"DEFINE", Keyword::Define},
      {"DEF", Keyword::Declare},
      {"REDEF", Keyword::Declare},
      {"PROC", Keyword::Procedure},
      {"EXTERN", Keyword::External},
      {"CALL", Keyword::Call},
      {"PCALL", Keyword::PathCall},
      {"MCALL", Keyword::ModalCall},
      {"EXTCALL", Keyword::ExternalCall},
      {"RET", Keyword::Return},
      {"TRANS", Keyword::Transform},
      {"ATRANS", Keyword::Transform},
      {"ROT", Keyword::Transform},
      {"AROT", Keyword::Transform},
      {"ROTS", Keyword::Transform},
      {"AROTS", Keyword::Transform},
      {"CROTS", Keyword::Transform},
      {"SCALE", Keyword::Transform},
      {"ASCALE", Keyword::Transform},
      {"MIRROR", Keyword::Transform},
      {"AMIRROR", Keyword::Transform},
      {"CIP", Keyword::Motion},
      {"CT", Keyword::Motion},
      {"INVCW", Keyword::Motion},
      {"INVCCW", Keyword::Motion},
      {"POLY", Keyword::Motion},
      {"ASPLINE", Keyword::Motion},
      {"BSPLINE", Keyword::Motion},
      {"CSPLINE", Keyword::Motion},
      {"SUPA", Keyword::Suppress},
      {"MEAS", Keyword::Measure},
      {"MEAW", Keyword::Measure},
      {"MEASA", Keyword::Measure},
      {"MEAWA", Keyword::Measure},
      // Addresses of a motion.
      {"CR", Keyword::MoveWord},
      {"AR", Keyword::MoveWord},
      {"AP", Keyword::MoveWord},
      {"RP", Keyword::MoveWord},
      {"RPL", Keyword::MoveWord},
      {"TURN", Keyword::MoveWord},
      {"RND", Keyword::MoveWord},
      {"RNDM", Keyword::MoveWord},
      {"CHF", Keyword::MoveWord},
      {"CHR", Keyword::MoveWord},
      {"ANG", Keyword::MoveWord},
      {"FRC", Keyword::MoveWord},
      {"FRCM", Keyword::MoveWord},
      {"DISR", Keyword::MoveWord},
      {"LEAD", Keyword::MoveWord},
      {"TILT", Keyword::MoveWord},
      {"FAD", Keyword::MoveWord},
      {"FP", Keyword::MoveWord},
      {"AX", Keyword::MoveWord},
      {"SF", Keyword::MoveWord},
      // Settings.
      {"SPOS", Keyword::Setting},
      {"SPOSA", Keyword::Setting},
      {"POS", Keyword::Setting},
      {"POSA", Keyword::Setting},
      {"POSP", Keyword::Setting},
      {"FA", Keyword::Setting},
      {"FB", Keyword::Setting},
      {"FZ", Keyword::Setting},
      {"FL", Keyword::Setting},
      {"LIMS", Keyword::Setting},
      {"OVR", Keyword::Setting},
      {"OVRA", Keyword::Setting},
      {"OVRRAP", Keyword::Setting},
      {"ACC", Keyword::Setting},
      {"ADIS", Keyword::Setting},
      {"ADISPOS", Keyword::Setting},
      {"CTOL", Keyword::Setting},
      {"OTOL", Keyword::Setting},
      {"ATOL", Keyword::Setting},
      {"DISC", Keyword::Setting},
      {"DISCL", Keyword::Setting},
      {"DL", Keyword::Setting},
      {"DC_SLIDE", Keyword::Setting},
      {"FGREF", Keyword::Setting},
      {"FXS", Keyword::Setting},
      {"FXST", Keyword::Setting},
      {"FXSW", Keyword::Setting},
      {"OFFN", Keyword::Setting},
      {"SCC", Keyword::Setting},
      {"SVC", Keyword::Setting},
      {"TCARR", Keyword::Setting},
      {"TOFF", Keyword::Setting},
      {"TOFFL", Keyword::Setting},
      {"TOFFR", Keyword::Setting},
      {"VELOLIM", Keyword::Setting},
      {"ACCLIM", Keyword::Setting},
      {"JERKLIM", Keyword::Setting},
      {"ANG1", Keyword::MoveWord},
      {"ANG2", Keyword::MoveWord},
      // Named G functions and switches.
      {"DIAMON", Keyword::Modal},
      {"DIAMOF", Keyword::Modal},
      {"DIAM90", Keyword::Modal},
      {"DIAMCYCOF", Keyword::Modal},
      {"SOFT", Keyword::Modal},
      {"BRISK", Keyword::Modal},
      {"DRIVE", Keyword::Modal},
      {"FFWON", Keyword::Modal},
      {"FFWOF", Keyword::Modal},
      {"COMPON", Keyword::Modal},
      {"COMPOF", Keyword::Modal},
      {"COMPCURV", Keyword::Modal},
      {"COMPCAD", Keyword::Modal},
      {"COMPSURF", Keyword::Modal},
      {"COMPPATH", Keyword::Modal},
      {"CUT2D", Keyword::Modal},
      {"CUT2DF", Keyword::Modal},
      {"CUT3DC", Keyword::Modal},
      {"CUT3DF", Keyword::Modal},
      {"CUT3DFS", Keyword::Modal},
      {"CUT3DFF", Keyword::Modal},
      {"CUTCONON", Keyword::Modal},
      {"CUTCONOF", Keyword::Modal},
      {"CUTMOD", Keyword::Modal},
      {"CDON", Keyword::Modal},
      {"CDOF", Keyword::Modal},
      {"CDOF2", Keyword::Modal},
      {"CFC", Keyword::Modal},
      {"CFTCP", Keyword::Modal},
      {"CFIN", Keyword::Modal},
      {"NORM", Keyword::Modal},
      {"KONT", Keyword::Modal},
      {"KONTC", Keyword::Modal},
      {"KONTT", Keyword::Modal},
      {"ORIWKS", Keyword::Modal},
      {"ORIMKS", Keyword::Modal},
      {"ORIAXES", Keyword::Modal},
      {"ORIVECT", Keyword::Modal},
      {"ORIPLANE", Keyword::Modal},
      {"ORIEULER", Keyword::Modal},
      {"ORIRPY", Keyword::Modal},
      {"ORIRPY2", Keyword::Modal},
      {"ORIVIRT1", Keyword::Modal},
      {"ORIVIRT2", Keyword::Modal},
      {"ORISON", Keyword::Modal},
      {"ORISOF", Keyword::Modal},
      {"ORIC", Keyword::Modal},
      {"ORID", Keyword::Modal},
      {"OSC", Keyword::Modal},
      {"OSS", Keyword::Modal},
      {"OSSE", Keyword::Modal},
      {"OSD", Keyword::Modal},
      {"OST", Keyword::Modal},
      {"OSOF", Keyword::Modal},
      {"TOFRAME", Keyword::Modal},
      {"TOFRAMEX", Keyword::Modal},
      {"TOFRAMEY", Keyword::Modal},
      {"TOFRAMEZ", Keyword::Modal},
      {"TOROT", Keyword::Modal},
      {"TOROTX", Keyword::Modal},
      {"TOROTY", Keyword::Modal},
      {"TOROTZ", Keyword::Modal},
      {"TOROTOF", Keyword::Modal},
      {"PAROT", Keyword::Modal},
      {"PAROTOF", Keyword::Modal},
      {"TCOABS", Keyword::Modal},
      {"TCOFR", Keyword::Modal},
      {"TCOFRX", Keyword::Modal},
      {"TCOFRY", Keyword::Modal},
      {"TCOFRZ", Keyword::Modal},
      {"UPATH", Keyword::Modal},
      {"SPATH", Keyword::Modal},
      {"WALIMON", Keyword::Modal},
      {"WALIMOF", Keyword::Modal},
      {"STARTFIFO", Keyword::Modal},
      {"STOPFIFO", Keyword::Modal},
      {"FIFOCTRL", Keyword::Modal},
      {"RTLION", Keyword::Modal},
      {"RTLIOF", Keyword::Modal},
      {"DYNNORM", Keyword::Modal},
      {"DYNPOS", Keyword::Modal},
      {"DYNROUGH", Keyword::Modal},
      {"DYNSEMIFIN", Keyword::Modal},
      {"DYNFINISH", Keyword::Modal},
      {"DYNPREC", Keyword::Modal},
      {"FNORM", Keyword::Modal},
      {"FLIN", Keyword::Modal},
      {"FCUB", Keyword::Modal},
      {"GFRAME0", Keyword::Modal},
      {"TRAORI", Keyword::Modal},
      {"TRAFOOF", Keyword::Modal},
      {"TRANSMIT", Keyword::Modal},
      {"TRACYL", Keyword::Modal},
      {"TRAANG", Keyword::Modal},
      // Statements.
      {"MSG", Keyword::Statement},
      {"SETAL", Keyword::Statement},
      {"STOPRE", Keyword::Statement},
      {"DISPLOF", Keyword::Statement},
      {"DISPLON", Keyword::Statement},
      {"SBLOF", Keyword::Statement},
      {"SBLON", Keyword::Statement},
      {"ACTBLOCNO", Keyword::Statement},
      {"SAVE", Keyword::Statement},
      {"FGROUP", Keyword::Statement},
      {"SETMS", Keyword::Statement},
      {"WRITE", Keyword::Statement},
      {"READ", Keyword::Statement},
      {"DELETE", Keyword::Statement},
      {"CANCEL", Keyword::Statement},
      {"WAITM", Keyword::Statement},
      {"WAITP", Keyword::Statement},
      {"WAITS", Keyword::Statement},
      {"WAITMC", Keyword::Statement},
      {"SETM", Keyword::Statement},
      {"CLEARM", Keyword::Statement},
      {"INIT", Keyword::Statement},
      {"START", Keyword::Statement},
      {"WAITE", Keyword::Statement},
      {"GETD", Keyword::Statement},
      {"GET", Keyword::Statement},
      {"RELEASE", Keyword::Statement},
      {"AXTOCHAN", Keyword::Statement},
      {"DELDTG", Keyword::Statement},
      {"DELDL", Keyword::Statement},
      {"DELT", Keyword::Statement},
      {"NEWT", Keyword::Statement},
      {"NEWCONF", Keyword::Statement},
      {"PRESETON", Keyword::Statement},
      {"PRESETONS", Keyword::Statement},
      {"MASLON", Keyword::Statement},
      {"MASLOF", Keyword::Statement},
      {"TRAILON", Keyword::Statement},
      {"TRAILOF", Keyword::Statement},
      {"FTOCON", Keyword::Statement},
      {"FTOCOF", Keyword::Statement},
      {"SOFTA", Keyword::Statement},
      {"BRISKA", Keyword::Statement},
      {"DRIVEA", Keyword::Statement},
      {"PROTA", Keyword::Statement},
      {"WORKPIECE", Keyword::Statement},
      {"CLRINT", Keyword::Statement},
      {"SETINT", Keyword::SynchronizedAction},
      {"ENABLE", Keyword::Statement},
      {"DISABLE", Keyword::Statement},
      {"EXECSTRING", Keyword::Statement},
      {"GWPSON", Keyword::Statement},
      {"GWPSOF", Keyword::Statement},
      {"REPOSA", Keyword::Statement},
      {"REPOSL", Keyword::Statement},
      {"ORIRESET", Keyword::Statement},
      {"MMC", Keyword::Statement},
      {"IPTRLOCK", Keyword::Statement},
      {"IPTRUNLOCK", Keyword::Statement},
      {"ASUP", Keyword::Statement},
      {"CONTPRON", Keyword::Statement},
      {"GEOAX", Keyword::Statement},
      {"SPCON", Keyword::Statement},
      {"SPCOF", Keyword::Statement},
      {"COUPDEF", Keyword::Statement},
      {"COUPDEL", Keyword::Statement},
      {"COUPON", Keyword::Statement},
      {"COUPONC", Keyword::Statement},
      {"COUPOF", Keyword::Statement},
      {"COUPOFS", Keyword::Statement},
      {"COUPRES", Keyword::Statement},
      {"EGDEF", Keyword::Statement},
      {"EGDEL", Keyword::Statement},
      {"EGON", Keyword::Statement},
      {"EGONSYN", Keyword::Statement},
      {"EGONSYNE", Keyword::Statement},
      {"EGOFS", Keyword::Statement},
      {"EGOFC", Keyword::Statement},
      {"LEADON", Keyword::Statement},
      {"LEADOF", Keyword::Statement},
      {"TANG", Keyword::Statement},
      {"TANGON", Keyword::Statement},
      {"TANGOF", Keyword::Statement},
      {"TANGDEL", Keyword::Statement},
      {"PUNCHACC", Keyword::Statement},
      {"PON", Keyword::Statement},
      {"PONS", Keyword::Statement},
      {"SON", Keyword::Statement},
      {"SONS", Keyword::Statement},
      {"SPOF", Keyword::Statement},
      {"PDELAYON", Keyword::Statement},
      {"PDELAYOF", Keyword::Statement},
      {"CPROT", Keyword::Statement},
      {"CPROTDEF", Keyword::Statement},
      {"NPROT", Keyword::Statement},
      {"NPROTDEF", Keyword::Statement},
      {"DRFOF", Keyword::Statement},
      {"FPR", Keyword::Statement},
      {"FPRAON", Keyword::Statement},
      {"FPRAOF", Keyword::Statement},
      {"POLFMASK", Keyword::Statement},
      {"POLFMLIN", Keyword::Statement},
      {"RESETMON", Keyword::Statement},
      {"SETDNO", Keyword::Statement},
      {"SETPIECE", Keyword::Statement},
      {"SETMTH", Keyword::Statement},
      {"SYNFCT", Keyword::Statement},
      {"STOPREOF", Keyword::Statement},
      {"RDISABLE", Keyword::Statement},
      {"TMON", Keyword::Statement},
      {"TMOF", Keyword::Statement},
      {"TRAFOON", Keyword::Statement},
      {"GETFREELOC", Keyword::Statement},
      {"GETTENV", Keyword::Statement},
      {"GETACTT", Keyword::Statement},
      {"GETACTTD", Keyword::Statement},
      {"GETSELT", Keyword::Statement},
      {"GETEXET", Keyword::Statement},
      {"MVTOOL", Keyword::Statement},
      {"SETTIA", Keyword::Statement},
      {"TCA", Keyword::Statement},
      {"TCI", Keyword::Statement},
      {"TLIFT", Keyword::Statement},
      {"DZERO", Keyword::Statement},
      {"DELTOOLENV", Keyword::Statement},
      {"CPRECON", Keyword::Statement},
      {"CPRECOF", Keyword::Statement},
      {"EXTOPEN", Keyword::Statement},
      {"EXTCLOSE", Keyword::Statement},
      {"FILEDATE", Keyword::Statement},
      {"FILEINFO", Keyword::Statement},
      {"FILESIZE", Keyword::Statement},
      {"FILESTAT", Keyword::Statement},
      {"FILETIME", Keyword::Statement},
      {"INITIAL", Keyword::Statement},
      {"CPON", Keyword::Statement},
      {"CPOF", Keyword::Statement},
      {"CPDEF", Keyword::Statement},
      {"CPDEL", Keyword::Statement},
      {"CHECKSUM", Keyword::Statement},
      {"CALCDAT", Keyword::Statement},
      {"INTERSEC", Keyword::Statement},
      {"CTABDEF", Keyword::Statement},
      {"CTABEND", Keyword::Statement},
      {"CTABDEL", Keyword::Statement},
      {"BLSYNC", Keyword::Statement},
      {"ADDFRAME", Keyword::Statement},
      {"AXCTSWE", Keyword::Statement},
      {"AXCTSWED", Keyword::Statement},
      {"CORROF", Keyword::Statement},
      {"CORRTRAFO", Keyword::Statement},
      {"TOOLENV", Keyword::Statement},
      {"SETTOOLENV", Keyword::Statement},
      {"STOLF", Keyword::Statement},
      {"EXECUTE", Keyword::Statement},
      {"WHEN", Keyword::SynchronizedAction},
      {"WHENEVER", Keyword::SynchronizedAction},
      {"EVERY", Keyword::SynchronizedAction},
      {"FROM", Keyword::SynchronizedAction},
      {"DO", Keyword::SynchronizedAction},
      {"ID", Keyword::SynchronizedAction},
      {"IDS", Keyword::SynchronizedAction},
      // Words inside statements.
      {"TO", Keyword::Reserved},
      {"BLOCK", Keyword::Reserved},
      {"OF", Keyword::Reserved},
      {"DEFAULT", Keyword::Reserved},
      {"AND", Keyword::Reserved},
      {"OR", Keyword::Reserved},
      {"XOR", Keyword::Reserved},
      {"NOT", Keyword::Reserved},
      {"DIV", Keyword::Reserved},
      {"MOD", Keyword::Reserved},
      {"B_AND", Keyword::Reserved},
      {"B_OR", Keyword::Reserved},
      {"B_XOR", Keyword::Reserved},
      {"B_NOT", Keyword::Reserved},
      {"VAR", Keyword::Reserved},
      {"AC", Keyword::Reserved},
      {"IC", Keyword::Reserved},
      {"DC", Keyword::Reserved},
      {"ACP", Keyword::Reserved},
      {"ACN", Keyword::Reserved},
      {"TRUE", Keyword::Reserved},
      {"FALSE", Keyword::Reserved},
  });
  std::sort(table.begin(), table.end(), [](const auto& l, const auto& r) { return l.name < r.name; });
  return table;
}();

constexpr int many = 64;

constexpr auto functionTable = [] {
  std::array table = std::to_array<FunctionEntry>({
      {"SIN", Function::Sin, 1, 1},         {"COS", Function::Cos, 1, 1},         {"TAN", Function::Tan, 1, 1},
      {"ASIN", Function::Asin, 1, 1},       {"ACOS", Function::Acos, 1, 1},       {"ATAN2", Function::Atan2, 2, 2},
      {"SQRT", Function::Sqrt, 1, 1},       {"POT", Function::Square, 1, 1},      {"ABS", Function::Abs, 1, 1},
      {"LN", Function::Ln, 1, 1},           {"EXP", Function::Exp, 1, 1},         {"TRUNC", Function::Truncate, 1, 1},
      {"ROUND", Function::Round, 1, 1},     {"ROUNDUP", Function::RoundUp, 1, 1}, {"MINVAL", Function::Minimum, 2, 2},
      {"MAXVAL", Function::Maximum, 2, 2},  {"BOUND", Function::Bound, 3, 3},     {"SPRINT", Function::Host, 1, many},
      {"STRLEN", Function::Host, 1, 1},     {"INDEX", Function::Host, 2, 2},      {"RINDEX", Function::Host, 2, 2},
      {"MINDEX", Function::Host, 2, 2},     {"SUBSTR", Function::Host, 2, 3},     {"TOUPPER", Function::Host, 1, 1},
      {"TOLOWER", Function::Host, 1, 1},    {"ISNUMBER", Function::Host, 1, 1},   {"NUMBER", Function::Host, 1, 1},
      {"STRING", Function::Host, 1, 1},     {"MATCH", Function::Host, 2, 2},      {"AXNAME", Function::Host, 1, 1},
      {"AXSTRING", Function::Host, 1, 1},   {"AXTOSPI", Function::Host, 1, 1},    {"SPI", Function::Host, 1, 1},
      {"ISAXIS", Function::Host, 1, 1},     {"ISVAR", Function::Host, 1, 1},      {"ISFILE", Function::Host, 1, 1},
      {"CTRANS", Function::Host, 0, many},  {"CFINE", Function::Host, 0, many},   {"CROT", Function::Host, 0, many},
      {"CROTS", Function::Host, 0, many},   {"CRPL", Function::Host, 2, 2},       {"CSCALE", Function::Host, 0, many},
      {"CMIRROR", Function::Host, 0, many}, {"INVFRAME", Function::Host, 1, 1},   {"MEAFRAME", Function::Host, 3, 3},
      {"GETT", Function::Host, 1, 2},       {"GETMDACT", Function::Host, 0, 1},   {"QU", Function::Host, 1, 1},
  });
  std::sort(table.begin(), table.end(), [](const auto& l, const auto& r) { return l.name < r.name; });
  return table;
}();

template <class Table>
const auto* findByName(const Table& table, std::string_view name) {
  const auto* found = std::lower_bound(std::begin(table), std::end(table), name,
                                       [](const auto& entry, std::string_view n) { return entry.name < n; });
  return found != std::end(table) && found->name == name ? found : nullptr;
}

constexpr std::string_view typeNames[] = {"INT", "REAL", "BOOL", "CHAR", "STRING", "AXIS", "FRAME"};

/// Levenshtein distance, counting an exchange of neighbours as one mistake.
std::size_t typingDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> older, previous(b.size() + 1), current(b.size() + 1);
  std::iota(previous.begin(), previous.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    current[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t exchange = previous[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      current[j] = std::min({previous[j] + 1, current[j - 1] + 1, exchange});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        current[j] = std::min(current[j], older[j - 2] + 1);
    }
    older = previous;
    std::swap(previous, current);
  }
  return previous[b.size()];
}

}  // namespace

Keyword keywordOf(std::string_view name) {
  const KeywordEntry* entry = findByName(keywordTable, name);
  return entry != nullptr ? entry->keyword : Keyword::None;
}

std::span<const KeywordEntry> keywords() { return keywordTable; }

const FunctionEntry* functionOf(std::string_view name) { return findByName(functionTable, name); }

std::span<const FunctionEntry> functions() { return functionTable; }

bool typeOf(std::string_view name, Type& type) {
  const auto* found = std::find(std::begin(typeNames), std::end(typeNames), name);
  if (found == std::end(typeNames)) return false;
  type = static_cast<Type>(found - std::begin(typeNames));
  return true;
}

std::string_view typeName(Type type) { return typeNames[static_cast<std::size_t>(type)]; }

bool isGFunction(int number) {
  struct Range {
    int first, last;
  };
  static constexpr Range known[] = {
      {0, 5},     {7, 7},     {9, 9},     {17, 19},   {25, 26},   {33, 35},   {40, 42},   {53, 60},
      {62, 64},   {70, 71},   {74, 75},   {90, 91},   {93, 97},   {110, 112}, {140, 143}, {147, 148},
      {153, 153}, {247, 248}, {290, 291}, {331, 332}, {335, 336}, {340, 341}, {347, 348}, {450, 451},
      {460, 462}, {500, 500}, {505, 599}, {601, 603}, {621, 621}, {641, 645}, {700, 700}, {710, 710},
      {751, 751}, {810, 829}, {931, 931}, {942, 942}, {952, 952}, {961, 962}, {971, 973},
  };
  return std::any_of(std::begin(known), std::end(known),
                     [number](const Range& range) { return number >= range.first && number <= range.last; });
}

std::string_view closestName(std::string_view name, std::span<const std::string_view> candidates) {
  std::string_view best;
  std::size_t bestDistance = name.size() > 4 ? 3 : 2;
  for (const std::string_view candidate : candidates) {
    if (candidate.size() + 2 < name.size() || name.size() + 2 < candidate.size()) continue;
    const std::size_t distance = typingDistance(name, candidate);
    if (distance < bestDistance) {
      best = candidate;
      bestDistance = distance;
    }
  }
  return best;
}

}  // namespace probewright::sinumerik
