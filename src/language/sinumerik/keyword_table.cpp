#include <algorithm>
#include <string>
#include <vector>

#include "language/sinumerik/keywords.hpp"

/// Every word of the language that has a meaning of its own.
namespace probewright::language::sinumerik {

namespace {

/// Words that are carried out, or are words of the flow.
constexpr KeywordEntry carriedOut[] = {
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
    {"REDEF", Keyword::Redefine, Effect::NotCarriedOut},
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
    {"SUPA", Keyword::Suppress},
    {"MEAS", Keyword::Measure},
    {"MEAW", Keyword::Measure},
    {"MEASA", Keyword::Measure},
    {"MEAWA", Keyword::Measure},
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
    {"FP", Keyword::MoveWord},
    {"AX", Keyword::MoveWord},
    {"SPOS", Keyword::Setting},
    {"SPOSA", Keyword::Setting},
    {"POS", Keyword::Setting},
    {"POSA", Keyword::Setting},
    {"POSP", Keyword::Setting},
    {"FA", Keyword::Setting},
    {"LIMS", Keyword::Setting},
    {"DL", Keyword::Setting},
    {"TOFFL", Keyword::Setting},
    {"TOFFR", Keyword::Setting},
    {"ANG1", Keyword::MoveWord},
    {"ANG2", Keyword::MoveWord},
    {"DIAMON", Keyword::Modal},
    {"DIAMOF", Keyword::Modal},
    {"DIAM90", Keyword::Modal},
    {"DIAMCYCOF", Keyword::Modal},
    {"DIAMCHAN", Keyword::Modal},
    {"DIAMONA", Keyword::Modal},
    {"DIAMOFA", Keyword::Modal},
    {"DIAM90A", Keyword::Modal},
    {"DIACYCOFA", Keyword::Modal},
    {"DIAMCHANA", Keyword::Modal},
    {"G", Keyword::Setting},
    {"ORIEULER", Keyword::Modal},
    {"ORIRPY", Keyword::Modal},
    {"ORIRPY2", Keyword::Modal},
    {"TOFRAME", Keyword::Modal},
    {"TOFRAMEZ", Keyword::Modal},
    {"TOROT", Keyword::Modal},
    {"TOROTZ", Keyword::Modal},
    {"TOROTOF", Keyword::Modal},
    {"TRAORI", Keyword::Modal},
    {"TRAFOOF", Keyword::Modal},
    {"IP", Keyword::MoveWord},
    {"PO", Keyword::MoveWord},
    {"ENDPROC", Keyword::Return},
    {"MSG", Keyword::Statement},
    {"SETAL", Keyword::Statement},
    {"STOPRE", Keyword::Statement},
    {"WRITE", Keyword::Statement},
    {"READ", Keyword::Statement},
    {"DELETE", Keyword::Statement},
    {"SETINT", Keyword::SynchronizedAction},
    {"EXECSTRING", Keyword::Statement},
    {"ISOCALL", Keyword::IsoCall},
    {"GETSELT", Keyword::Statement},
    {"GETEXET", Keyword::Statement},
    {"CALCDAT", Keyword::Statement},
    {"CTABEND", Keyword::Statement},
    {"EXECUTE", Keyword::Statement},
    {"WHEN", Keyword::SynchronizedAction},
    {"WHENEVER", Keyword::SynchronizedAction},
    {"EVERY", Keyword::SynchronizedAction},
    {"FROM", Keyword::SynchronizedAction},
    {"DO", Keyword::SynchronizedAction},
    {"ID", Keyword::SynchronizedAction},
    {"IDS", Keyword::SynchronizedAction},
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
};

/// Words that say nothing about where the tool goes, and words that do and are named.
struct WordList {
  Keyword keyword;
  Effect effect;
  std::string_view names;
};
constexpr WordList lists[] = {
    {Keyword::Modal, Effect::Harmless,
     "BAUTO BNAT BRISK BTAN CDOF CFC CFIN CFTCP COMPCAD COMPCURV COMPOF COMPON COMPPATH COMPSURF CP CUT2D "
     "CUT2DF CUTCONOF DRIVE DYNFINISH DYNNORM DYNPOS DYNPREC DYNROUGH DYNSEMIFIN EAUTO ENAT ETAN FCUB "
     "FENDNORM FFWOF FFWON FIFOCTRL FLIN FNORM GFRAME0 LFOF LFON LFPOS LFTXT LFWP NORM ORIANGLE ORIAXES ORIC "
     "ORID ORIPATHS ORIPLANE ORIROTA ORIROTC ORIROTR ORIROTT ORISOF ORISON ORIVECT ORIWKS OSC OSD OSOF OSS "
     "OSSE OST PAROTOF RELIEVEOF RELIEVEON RMB RMBBL RME RMEBL RMI RMIBL RMN RMNBL RTLION SOFT SPATH SPIF1 "
     "SPIF2 STARTFIFO STOPFIFO TCOABS TOWSTD UPATH WALCS0 WALIMOF WALIMON"},
    {Keyword::Modal, Effect::NotCarriedOut,
     "CDOF2 CDON CUT2DD CUT2DFD CUT3DC CUT3DCC CUT3DCCD CUT3DCD CUT3DF CUT3DFD CUT3DFF CUT3DFS CUTCONON "
     "ORIAXPOS ORIMKS ORIPATH ORIVIRT1 ORIVIRT2 PAROT TCOFR TCOFRX TCOFRY TCOFRZ TOFRAMEX TOFRAMEY TOROTX "
     "TOROTY TOWBCS TOWKCS TOWMCS TOWTCS TOWWCS TRAANG TRACON TRACYL TRAINT TRANSMIT"},
    {Keyword::Modal, Effect::Straight, "ORICONCCW ORICONCW ORICONIO ORICONTO ORICURVE PTP PTPG0 PTPWOC RTLIOF"},
    {Keyword::Modal, Effect::AsNorm, "KONT KONTC KONTT"},
    {Keyword::Motion, Effect::Straight, "ASPLINE BSPLINE CSPLINE INCCW INCW INVCCW INVCW OEMIPO1 OEMIPO2 POLY"},
    {Keyword::MoveWord, Effect::Harmless, "DISPR DISR FAD PL PW SD SF SR ST"},
    {Keyword::MoveWord, Effect::NotCarriedOut, "ISD LEAD MOVT NUT PSI STAT THETA TILT TU XH YH ZH"},
    {Keyword::Setting, Effect::Harmless,
     "ACC ACCLIM ACCLIMA ADIS ADISPOS ADISPOSA ALF ATOL CPBC CPDEL CPFMOF CPFMON CPFMSON CPFRS CPLCTID CPLDEL "
     "CPLDEN CPLINSC CPLINTR CPLNUM CPLOF CPLOUTSC CPLOUTTR CPLSETVAL CPMALARM CPMRESET CPMSTART CPMVDI CPOF "
     "CPSETTYPE CPSYNCOP CPSYNCOP2 CPSYNCOV CPSYNFIP CPSYNFIP2 CPSYNFIV CTOL CTOLG0 DC_SLIDE DILF DISCL DITE "
     "DITS FB FD FDA FGREF FL FMA FXST FXSW FZ JERKLIM JERKLIMA OSNSC OTOL OTOLG0 OVR OVRA OVRRAP POLF SCPARA "
     "SPN SPP SRA STA STOLF SVC VELOLIM VELOLIMA"},
    {Keyword::Setting, Effect::NotCarriedOut,
     "CPDEF CPFPOS CPLDEF CPLON CPLPOS CPON CUTMOD CUTMODK DISC FXS MEAC MOV OFFN OS OSB OSCILL OSCTRL OSE "
     "OSP1 OSP2 OST1 OST2 TCARR TOFF TOFFLR"},
    {Keyword::Axial, Effect::Harmless, "COARSEA FINEA FOCOF IPOBRKA IPOENDA SCC"},
    {Keyword::Axial, Effect::NotCarriedOut, "FOC FOCON"},
    {Keyword::Statement, Effect::Harmless,
     "ACTBLOCNO ASUP AUXFUDEL AUXFUDELG AUXFUMSEQ AXCSWAP AXTOCHAN BLSYNC BRISKA CANCEL CANCELSUB CLEARM "
     "CLGOF CLGON CLRINT CORROF COUPDEL COUPRES CPRECOF CPRECON CTABDEL CTABLOCK CTABUNLOCK DELAYFSTOF "
     "DELAYFSTON DELOBJ DISABLE DISPLOF DISPLON DRFOF DRIVEA EGDEL ENABLE FCTDEF FGROUP FPR FPRAOF FPRAON "
     "FTOCOF GET GETD GWPSOF GWPSON INITIAL IPTRLOCK IPTRUNLOCK JERKA LEADOF MASLDEL MASLOF MASLOFS NEWCONF "
     "PDELAYOF PDELAYON POLFA POLFMASK POLFMLIN POLYPATH PREPRO PROTA PROTD PROTS PUNCHACC RDISABLE RELEASE "
     "RESETMON SAVE SBLOF SBLON SETM SETPIECE SIRELAY SOFTA SPCOF SPCON SPLINEPATH SPOF STOPREOF TANGDEL "
     "TANGOF TMOF TMON TOFFOF TRAILOF WAITC WAITENC WAITM WAITMC WAITP WAITS WORKPIECE WRTPR"},
    {Keyword::Statement, Effect::NotCarriedOut,
     "ADDFRAME AXCTSWE AXCTSWED CALLPATH CHECKSUM CONTDCON CONTPRON CORRTRAFO COUPDEF COUPOF COUPOFS COUPON "
     "COUPONC CPROT CPROTDEF CTABDEF DELDL DELDTG DELMLOWNER DELMLRES DELT DELTC DELTOOLENV DZERO EGDEF EGOFC "
     "EGOFS EGON EGONSYN EGONSYNE EXTCLOSE EXTOPEN FILEDATE FILEINFO FILESIZE FILESTAT FILETIME FTOC FTOCON "
     "GEOAX GETACTT GETACTTD GETFREELOC GETTCOR GETTENV INIT INTERSEC LEADON MASLDEF MASLON MMC MVTOOL NEWMT "
     "NEWT NPROT NPROTDEF ORIRESET PON PONS POSM POSMT PRESETON PRESETONS PUTFTOC PUTFTOCF REPOSA REPOSH "
     "REPOSHA REPOSL REPOSQ REPOSQA SETDNO SETMS SETMTH SETTA SETTIA SETTOOLENV SON SONS START SYNFCT TANG "
     "TANGON TCA TCI TLIFT TML TOFFON TOOLENV TRAFOON TRAILON WAITE"},
};

/// Frames of grinding and areas of work, which are numbered.
struct Numbered {
  std::string_view stem;
  int most;
};
constexpr Numbered numbered[] = {{"GFRAME", 100}, {"WALCS", 10}};

const std::vector<std::string>& numberedNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const auto& [stem, most] : numbered)
      for (int i = 1; i <= most; ++i)
        all.push_back(std::string(stem) + std::to_string(i));
    return all;
  }();
  return names;
}

const std::vector<KeywordEntry>& keywordTable() {
  static const std::vector<KeywordEntry> table = [] {
    std::vector<KeywordEntry> all(std::begin(carriedOut), std::end(carriedOut));
    for (const auto& [keyword, effect, names] : lists) {
      for (std::string_view rest = names; !rest.empty();) {
        const std::size_t end = std::min(rest.find(' '), rest.size());
        all.push_back({rest.substr(0, end), keyword, effect});
        rest.remove_prefix(std::min(end + 1, rest.size()));
      }
    }
    for (const std::string& name : numberedNames())
      all.push_back({name, Keyword::Modal, Effect::NotCarriedOut});
    std::ranges::sort(all, {}, &KeywordEntry::name);
    return all;
  }();
  return table;
}

}  // namespace

const KeywordEntry* keywordEntry(std::string_view name) {
  const std::vector<KeywordEntry>& table = keywordTable();
  const auto entry = std::ranges::lower_bound(table, name, {}, &KeywordEntry::name);
  return entry != table.end() && entry->name == name ? &*entry : nullptr;
}

Keyword keywordOf(std::string_view name) {
  const KeywordEntry* entry = keywordEntry(name);
  return entry == nullptr ? Keyword::None : entry->keyword;
}

std::span<const KeywordEntry> keywords() { return keywordTable(); }

}  // namespace probewright::language::sinumerik
