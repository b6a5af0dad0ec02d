#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.hpp"
#include "control/control_kind.hpp"
#include "control/journal.hpp"
#include "cycles/result_kinds.hpp"

/// The catalogue: what each cycle is called, takes and leaves, as data. One table drives the parsers, the checks, the
/// help and the documentation. Each cycle's entry is in the cycle's own file, above the code that runs it.
namespace probewright::cycles {

using control::ControlKind;
using control::ControlSet;

enum class ValueKind : std::uint8_t {
  Length,        ///< mm
  Angle,         ///< degrees
  Feed,          ///< mm/min
  Number,        ///< without unit
  Integer,       ///< a whole number: a row, a count, coded digits
  Option,        ///< one of `choices`
  Text,          ///< a text
  NumberOrText,  ///< a tool by number or name, a position or "?"
};

/// "mm", "deg", "mm/min" or "".
std::string_view unitOf(ValueKind kind);

struct Choice {
  int value = 0;
  std::string_view meaning;
  ControlSet controls = control::onBothTNC | control::onSinumerik;  ///< that know it
};

/// One decimal digit of a coded whole number, or several that belong together.
struct CodeDigit {
  int place = 1;                         ///< of its last digit: 1 units, 2 tens, ... 8 ten millions
  int width = 1;                         ///< digits
  std::string_view meaning = {};         ///< "feature"
  std::span<const Choice> choices = {};  ///< what it can be; empty: 0 to `most`
  int most = 99999999;
};

/// What some controls take where others take more.
struct Narrower {
  ControlSet controls = {};
  double maximum = 0;
  bool text = true;  ///< false: a number only, where others take a text as well
};

struct Parameter {
  std::string_view name;      ///< "Q321", "S_MVAR"
  std::uint32_t address = 0;  ///< HEIDENHAIN: the Q number; SINUMERIK: the position from 0
  std::string_view meaning;   ///< one phrase
  ValueKind kind = ValueKind::Length;
  double minimum = -99999.9999;
  double maximum = 99999.9999;
  std::optional<double> standard =
      std::nullopt;  ///< used when the parameter is left out; without it the parameter is required
  std::span<const Choice> choices = {};
  std::span<const CodeDigit> digits = {};  ///< of a coded number; digits that are not listed are 0
  ControlSet controls = control::onBothTNC | control::onSinumerik;
  bool predefinable = false;  ///< HEIDENHAIN: may be PREDEF, taken from GLOBAL DEF
  int iTNC530Software = 0;    ///< xx of the NC software 340 49x-xx that brought it to the iTNC 530; 0: always there
  static constexpr ControlSet withSoftware = control::onITNC530;  ///< controls that iTNC530Software is about
  Narrower narrower = {};
  /// Of a feed: the controls on which FMAX and FAUTO may stand for the number.
  ControlSet feedWords = {};
  /// As this control, which has it, has it: its range, whether it takes a text, what brought it. Of the choices those
  /// count that list the control.
  Parameter on(ControlKind kind) const;
  bool required() const { return !standard && kind != ValueKind::Text; }
};

/// The English text of a result: its role and the label of its characteristic, "actual value: " and "diameter of the
/// hole".
struct ResultText {
  std::string_view role;  ///< may be empty
  std::string_view label;
  constexpr ResultText(const char* text) : label(text) {}  // NOLINT(google-explicit-constructor): tables
  constexpr ResultText(std::string_view roleText, std::string_view labelText) : role(roleText), label(labelText) {}
  std::string whole() const { return std::string(role).append(label); }
};

/// A value that the cycle leaves behind.
struct ResultDefinition {
  std::string_view name;  ///< "Q151", "_OVR[4]"
  ResultText meaning = "";
  control::ResultKind kind = {};
  /// SINUMERIK: bit n stands for the measuring variants with n in the units of S_MVAR, which alone leave this; 0: all.
  /// An index that means one thing here and another there has a line for each.
  std::uint16_t variants = 0;
  bool belongsTo(int units) const { return variants == 0 || (units >= 0 && (variants >> units & 1) != 0); }
  /// What its quantity is counted in.
  ValueKind valueKind() const;
};

/// Gives a value of a cycle the text and the kind of its definition.
void describe(control::ResultRecord& record, const ResultDefinition& definition);

/// A text of a cycle in the other languages of reports. Places for values, {0}, {1}.., stand in each.
struct OwnWords {
  std::string_view english, german, russian, swedish, chinese, polish;
};

/// What a result is compared with.
struct Compared {
  std::optional<double> nominal = std::nullopt;
  std::optional<double> lower = std::nullopt;  ///< absolute limits
  std::optional<double> upper = std::nullopt;
  control::Verdict verdict = control::Verdict::None;
};

/// The record of a result of that name; `definition` may be null: the cycle does not list it.
control::ResultRecord resultRecord(std::string name, const ResultDefinition* definition, ValueKind kind, double value,
                                   const Compared& compared);

enum class CycleFamily : std::uint8_t { Misalignment, Preset, Inspection, Special, Calibration, Kinematics, Tool };
std::string_view nameOf(CycleFamily family);

/// What a template of a call has for a parameter where `check` would complain of the default, of the first choice or of
/// 0, or where that helps nobody.
struct Example {
  std::string_view parameter;
  double number = 0;
  std::string_view text = {};  ///< of a parameter that takes a text
};

struct CycleDefinition {
  int number = 0;          ///< 411, 977
  std::string_view name;   ///< "411", "CYCLE977"
  std::string_view title;  ///< as in the English manuals: "PRESET OUTSIDE RECTAN."
  CycleFamily family = CycleFamily::Preset;
  std::string_view summary;  ///< one or two sentences: what it measures and corrects
  std::span<const Parameter> parameters = {};
  std::span<const ResultDefinition> results = {};
  ControlSet controls = control::onBothTNC;
  /// What people read of this cycle alone: title, summary, meanings, names of alarms and what they say. What several
  /// cycles say stands in the tables of web/src/texts.
  std::span<const OwnWords> words = {};
  std::span<const Example> examples = {};

  const Parameter* parameter(std::uint32_t address) const;
  /// The result of that name, where several share it that of the measuring variant with `units` in S_MVAR; null if the
  /// cycle has none.
  const ResultDefinition* result(std::string_view resultName, int units = -1) const;
};

/// All cycles of the control, in the order of their numbers.
std::vector<const CycleDefinition*> cyclesOf(ControlKind kind);

/// The cycle with this number on a HEIDENHAIN control, or null.
const CycleDefinition* heidenhainCycle(int number);

/// The cycle with this name ("CYCLE977", case does not matter) on a SINUMERIK control, or null.
const CycleDefinition* sinumerikCycle(std::string_view name);

/// The cycle of either vendor that records call so: "411", "CYCLE977"; null if there is none.
const CycleDefinition* cycleNamed(std::string_view name);

/// One value handed to a cycle.
struct Argument {
  double number = 0;
  std::string text;
  bool isText = false;
  bool given = false;  ///< false: the standard value stands here
};

/// The value in mm, mm/min or degrees: lengths of a call count in units of `unit` mm, feeds in units of `feedUnit`
/// mm/min, standard values in mm and mm/min.
double inMillimetres(const Parameter& parameter, const Argument& argument, double unit, double feedUnit);

/// The arguments of one call, in the order of the definition's parameters.
class Arguments {
public:
  explicit Arguments(const CycleDefinition& definition);

  const CycleDefinition& definition() const { return *definition_; }
  std::span<const Argument> values() const { return values_; }

  /// False if the cycle has no parameter of that address.
  bool set(std::uint32_t address, double number);
  bool set(std::uint32_t address, std::string text);

  bool given(std::uint32_t address) const { return at(address).given; }
  double number(std::uint32_t address) const { return at(address).number; }
  /// The number, rounded to whole.
  int integer(std::uint32_t address) const;
  const std::string& text(std::uint32_t address) const { return at(address).text; }
  const Argument& at(std::uint32_t address) const;

private:
  const CycleDefinition* definition_;
  std::vector<Argument> values_;
};

/// What is wrong with the value for this parameter on every control that has it, as one sentence that names what this
/// control takes; empty if nothing is. Values that this control alone lacks are the business of the cycle's rules.
std::string complaint(const Parameter& parameter, const Argument& argument, ControlKind kind);

/// "units", "tens", ... of CodeDigit::place.
std::string_view placeName(int place);

/// What is wrong with the digits of a coded number, as one sentence; empty if nothing is or the parameter has none. The
/// cycles refuse such a number with an alarm of their own.
std::string codeComplaint(const Parameter& parameter, const Argument& argument);

/// What the digits of a coded number ask for: "hole, correct the zero offset".
std::string codeText(const Parameter& parameter, double value);

/// All that is wrong with a call: values out of range, required parameters left out. The messages have no place yet.
Diagnostics check(const Arguments& arguments, ControlKind kind);

}  // namespace probewright::cycles
