#include <fmt/format.h>

#include "base/number_text.hpp"
#include "base/utf8.hpp"
#include "exchange/formats.hpp"

namespace probewright::exchange {

namespace {

using control::Along;
using control::Quantity;
using control::Verdict;

/// Texts of DMIS are plain ASCII between apostrophes.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (continuesCharacter(c)) continue;  // of a character that has become one question mark
    result += static_cast<unsigned char>(c) >= 0x80 ? '?' : c == '\'' ? '"' : c;
  }
  return result + "'";
}

std::string comment(const std::string& text) {
  const std::string plain = quoted(text);
  return "$$ " + plain.substr(1, plain.size() - 2) + "\n";
}

std::string number(double value) { return formatFixed(value, 6); }

/// What a tolerance of DMIS says before and after its numbers, and what the actual one holds.
struct Form {
  std::string kind;
  std::string tail = {};
  bool absolute = false;  ///< limits and value as they are; else from the nominal value
};

Form formOf(const Row& row) {
  if (row.unit == "deg") return {"ANGL"};
  switch (row.of.quantity) {
    case Quantity::Diameter:
      return {"DIAM"};
    case Quantity::Radius:
      return {"RAD"};
    case Quantity::Width:
    case Quantity::Length:
    case Quantity::Distance:
      return {"DISTB", ",PT2PT", true};
    default:
      break;
  }
  switch (row.of.along) {
    case Along::First:
    case Along::X:
      return {"CORTOL,XAXIS"};
    case Along::Second:
    case Along::Y:
      return {"CORTOL,YAXIS"};
    case Along::Third:
    case Along::Z:
      return {"CORTOL,ZAXIS"};
    default:
      return {"PROFP"};
  }
}

/// The actual tolerance holds the measured size of a diameter, radius or distance, of all else the deviation.
bool holdsSize(const Form& form) { return form.absolute || form.kind == "DIAM" || form.kind == "RAD"; }

/// A nominal and an actual tolerance; a comment for a value that has no limits.
std::string toleranceText(const Row& row, const std::string& label) {
  std::string text = comment(nameOf(row));
  const std::string unit = row.unit.empty() ? "" : " " + row.unit;
  if (!row.lowerLimit || !row.upperLimit || row.unit.empty() || row.verdict == Verdict::None)
    return text + comment(fmt::format("  actual {}{}", number(row.actual), unit));
  const Form form = formOf(row);
  const double nominal = row.nominal.value_or((*row.lowerLimit + *row.upperLimit) / 2);
  text += comment(fmt::format("  nominal {}{}, actual {}{}", number(nominal), unit, number(row.actual), unit));
  const double from = form.absolute ? 0 : nominal;
  text += fmt::format("T({})=TOL/{}{},{},{}{}\n", label, form.kind, form.absolute ? ",LIMIT" : "",
                      number(*row.lowerLimit - from), number(*row.upperLimit - from), form.tail);
  const char* verdict = row.verdict == Verdict::Good ? "INTOL" : "OUTOL";
  return text + fmt::format("TA({})=TOL/{},{},{}{}\n", label, form.kind,
                            number(holdsSize(form) ? row.actual : row.actual - nominal), verdict, form.tail);
}

/// "2026-07-07T16:42:28" at the place of an ISO time; empty if the run does not say when it began.
std::string startText(const records::RunInfo& run) {
  const std::string& time = run.startedAt;
  if (time.size() < 19) return {};
  return fmt::format("DATE={}/{}/{}\nTIME={}\n", time.substr(0, 4), time.substr(5, 2), time.substr(8, 2),
                     time.substr(11, 8));
}

}  // namespace

std::string dmisText(const Inspection& inspection) {
  const records::RunInfo& run = inspection.run;
  const std::string program = run.programs.empty() ? "" : run.programs.front().path;
  std::string text = fmt::format("FILNAM/{},05.2\n", quoted(program.substr(program.find_last_of("/\\") + 1)));
  text += startText(run) + "UNITS/MM,ANGDEC\n";
  text += comment("Probewright " + run.version);
  const auto identify = [&](const char* label, const char* word, const std::string& value) {
    if (!value.empty()) text += fmt::format("{}={}/{}\n", label, word, quoted(value));
  };
  identify("PN(PART)", "PARTID", run.job.part.empty() ? run.partName : run.job.part);
  identify("PS(SERIAL)", "PARTSN", run.job.serial);
  identify("OP(OPERATOR)", "OPERID", run.job.operator_);
  identify("DI(MACHINE)", "DMEID", run.machine);
  std::size_t cycle = 0, place = 0;
  for (const Row& row : inspection.rows) {
    place = row.cycle == cycle ? place + 1 : 1;
    cycle = row.cycle;
    text += toleranceText(row, fmt::format("C{}_{}", cycle, place));
  }
  for (const Failure& failure : inspection.failures)
    text += comment(fmt::format("{} {} ended with an alarm: {}", failure.cycle, failure.cycleName, failure.alarm));
  return text + "ENDFIL\n";
}

}  // namespace probewright::exchange
