#include <fmt/format.h>

#include <algorithm>

#include "conversion/heidenhain_tasks.hpp"
#include "conversion/sinumerik_tasks.hpp"
#include "conversion/to_klartext.hpp"
#include "conversion/to_sinumerik.hpp"
#include "cycles/catalogue.hpp"
#include "cycles/heidenhain/probe_words.hpp"

/// Measuring mills and drills at a tool touch probe: cycles 481 to 483, or 31 to 33, and CYCLE971. Where that probe is,
/// from which side it is touched and how fast the tool turns is in the data of each machine, not in programs.
namespace probewright::conversion {

using namespace language;

namespace {

/// From where a touch begins and how far it looks beyond, mm: what touch probe cycles look along.
constexpr double reach = 15;

constexpr int firstOld = 31, lastOld = 33, firstNew = 481, lastNew = 483;

/// A cycle of a HEIDENHAIN control in either form.
struct ToolCycle {
  explicit ToolCycle(const Call& call) : number(std::stoi(call.cycle)) {
    namespace word = cycles::heidenhain::probe_word;
    const bool old = number <= lastOld;
    const auto name = [&](std::uint32_t oldAddress, int newNumber) {
      return old ? fmt::format("Q{}", oldAddress) : fmt::format("Q{}", newNumber);
    };
    mode = call.integer(name(word::check, 340));
    teeth = call.integer(name(word::teeth, 341)) == 1;
    clearance = call.number(name(word::height, 260));
    if (!old) status = 199;
    if (const std::string result = name(word::result, 0); old && call.has(result)) status = call.integer(result);
    kind = (old ? number - firstOld : number - firstNew);
  }
  bool length() const { return kind != 1; }
  bool radius() const { return kind != 0; }

  int number;
  int kind = 0;  ///< 0 length, 1 radius, 2 both
  int mode = 0;
  bool teeth = false;
  Quantity clearance;
  std::optional<int> status;
};

}  // namespace

bool measuresTools(int heidenhainCycle) {
  return (heidenhainCycle >= firstNew && heidenhainCycle <= lastNew) ||
         (heidenhainCycle >= firstOld && heidenhainCycle <= lastOld);
}

void ToSinumerik::toolMeasurement(const Block& block, const Call& call) {
  const ToolCycle cycle(call);
  if (cycle.mode == 2)
    throw NotCarriedOver("CYCLE971 corrects what it measures; it does not only compare", "write 0 or 1 for 2");
  if (!(cycle.clearance.isNumber() && position_[2] && position_[2]->isNumber() &&
        position_[2]->number() >= cycle.clearance.number()))
    out_.line(fmt::format("G0 {0}=MAXVAL($AA_IW[{0}],{1})", axis(2), sinumerikText(cycle.clearance)));
  enum class Finds { Length, Radius };
  const auto measure = [&](Finds what) {
    const bool length = what == Finds::Length;
    Call written;
    written.cycle = "CYCLE971";
    written.numbers = {{"S_MVAR", cycle.teeth ? 102 : 2},
                       {"S_KNUM", cycle.mode},
                       {"S_PRNUM", 1},
                       {"S_MA", length ? 3 : 1},
                       {"S_MD", length ? 0 : 1},
                       {"S_FA", reach * millimetre_},
                       {"S_TSA", reach * millimetre_},
                       {"S_NMSP", 1}};
    out_.line(callText(written));
    const int deviation = length ? 115 : 116;
    if (cycle.mode == 1 && usedQ_.contains(deviation)) {
      // From what the tool data say without wear; they count in millimetres.
      out_.line(fmt::format("{}=_OVR[{}]-$TC_DP{}[$P_TOOLNO,$P_TOOL]{}", parameter(deviation), length ? 8 : 10,
                            length ? 3 : 6, millimetre_ == 1 ? "" : fmt::format("/{}", numberText(1 / millimetre_))));
    }
  };
  // Single edges: the radius first, as the touch probe cycle.
  if (cycle.radius() && cycle.teeth) measure(Finds::Radius);
  if (cycle.length()) measure(Finds::Length);
  if (cycle.radius() && !cycle.teeth) measure(Finds::Radius);
  out_.line(fmt::format("G0 {}", addressWord(axis(2), cycle.clearance)));
  forgetPosition();
  position_[2] = cycle.clearance;
  besidePath_ = true;
  if (cycle.status && usedQ_.contains(*cycle.status) && cycle.mode == 1)
    out_.lose(block, fmt::format("Q{}: CYCLE971 tells no status, its tolerance is S_TDIF", *cycle.status));
  if (cycle.status && usedQ_.contains(*cycle.status) && cycle.mode == 0)
    out_.line(fmt::format("{}=0", parameter(*cycle.status)));
  if (cycle.mode == 1) {
    out_.list(block, "LTOL, RTOL, LBREAK and RBREAK of TOOL.T lock the tool; CYCLE971 does not know them",
              "write the tolerance as S_TDIF");
  }
}

void ToKlartext::toolMeasurement(const Block& block, const Call& call) {
  const int task = call.digit("S_MVAR", 1);
  if (task == 0)
    throw NotCarriedOver("CYCLE971 calibrates here; touch probe cycles do so with cycle 480", "write it by hand");
  const int axisNumber = call.digit("S_MA", 1);
  if (axisNumber < 1 || axisNumber > 3) throw NotCarriedOver(fmt::format("S_MA = {} names no axis", axisNumber));
  const bool length = axisNumber == 3, teeth = call.digit("S_MVAR", 3) == 1;
  listTiltedPlane(block, length ? firstNew : firstNew + 1);
  const std::set<int> wanted = wantedAfter(block);
  const int actual = length ? 8 : 10, difference = actual + 1;
  const Quantity height = here()[2];
  // Length or radius with its delta value, as TOOL.T has them: millimetres.
  const auto believed = [&](const char* when) {
    const std::string tool = formulas_.define("tool that is measured");
    std::string whole = formulas_.define(fmt::format("tool {}", when));
    const std::string delta = formulas_.define(fmt::format("delta value {}", when));
    line(fmt::format("FN 18: SYSREAD {} = ID20 NR1", tool));
    line(fmt::format("FN 18: SYSREAD {} = ID50 NR{} IDX{}", whole, length ? 1 : 2, tool));
    line(fmt::format("FN 18: SYSREAD {} = ID50 NR{} IDX{}", delta, length ? 4 : 5, tool));
    line(fmt::format("{0} = {0} + {1}", whole, delta));
    if (millimetre_ != 1) line(fmt::format("{0} = {0} / 25.4", whole));
    return whole;
  };
  const std::string before = wanted.contains(difference) ? believed("before") : std::string();
  const Quantity memory = call.number("S_KNUM");
  if (!memory.isNumber()) throw NotCarriedOver("S_KNUM is known only when the program runs");
  writeWhole({fmt::format("TCH PROBE {} {} ~", length ? 481 : 482, length ? "TOOL LENGTH" : "TOOL RADIUS"),
              fmt::format("    Q340={:+} ;CHECK ~", call.digit("S_KNUM", 1)),
              fmt::format("    Q260={} ;CLEARANCE HEIGHT ~", formulas_.value(height)),
              fmt::format("    Q341={:+} ;PROBING THE TEETH", teeth ? 1 : 0)});
  if (wanted.contains(actual) || wanted.contains(difference)) {
    const std::string after = believed("after");
    if (wanted.contains(actual)) line(fmt::format("Q{} = {}", 1700 + actual, after));
    if (wanted.contains(difference)) line(fmt::format("Q{} = {} - {}", 1700 + difference, after, before));
  }
  forgetPosition();
  for (const int index : wanted)
    if (index != actual && index != difference)
      out_.lose(block, fmt::format("_OVR[{}]: the touch probe cycle has no such result", index));
  if (call.digit("S_MVAR", 2) == 1) {
    out_.list(block,
              "S_MVAR: the tool touch probe counts in workpiece coordinates here, a HEIDENHAIN control knows it in "
              "machine coordinates: under another zero offset than it was calibrated with the SINUMERIK corrects "
              "otherwise, or stops (61341)",
              "measure in machine coordinates, with 0 in the tens of S_MVAR");
  }
  if (task == 1 && !length)
    out_.lose(block, "S_MVAR: a radius is measured with a rotating tool, unless CUT is 0 in TOOL.T");
  if (task == 1 && length)
    out_.list(block, "S_MVAR: the tool stands only where R-OFFS of TOOL.T is 0", "enter 0 for drills and ball cutters");
  const auto isWithin = [&](const char* name, double least, double most) {
    const Quantity value = call.number(name);
    return value.isNumber() && value.number() >= least * millimetre_ && value.number() <= most * millimetre_;
  };
  if (!isWithin("S_TSA", reach, unlimited))
    out_.lose(block, fmt::format("S_TSA: a tool is looked for along {} mm, and corrected by any deviation", reach));
  if (!isWithin("S_FA", 0, reach))
    out_.lose(block, fmt::format("S_FA: touch probe cycles look for the tool along {} mm", reach));
  if (call.digit("S_MA", 3) != 0)
    out_.lose(block, "S_MA: how far beside its middle a tool is touched is R-OFFS and L-OFFS of TOOL.T");
  for (const char* name : {"S_ID", "S_TZL", "S_TDIF", "S_EVNUM"}) {
    if (!(call.number(name) == 0)) out_.lose(block, fmt::format("{} has no counterpart in touch probe cycles", name));
  }
  if (call.has("S_NMSP") && !(call.number("S_NMSP") == 1) && !(call.number("S_NMSP") == 0))
    out_.lose(block, "S_NMSP: one touch is measured");
  if (call.has("S_PRNUM") && !(call.number("S_PRNUM") == 1) && !(call.number("S_PRNUM") == 0))
    out_.lose(block, "S_PRNUM: a HEIDENHAIN control has one tool touch probe");
}

}  // namespace probewright::conversion
