#include "cycles/sinumerik/old_form.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "control/alarm.hpp"

namespace probewright::cycles::sinumerik {

using control::Alarm;
using control::sinumerik::Control;
using control::sinumerik::DataKey;
using control::sinumerik::DataStore;

namespace {

constexpr std::string_view names[] = {
    "_MVAR",  "_KNUM",  "_PRNUM", "_SETVAL", "_SETV", "_MA",  "_MD",  "_FA",   "_TSA",    "_VMS",   "_NMSP", "_TNUM",
    "_TNAME", "_DLNUM", "_TENV",  "_TZL",    "_TMV",  "_TUL", "_TLL", "_TDIF", "_K",      "_EVNUM", "_ID",   "_SZA",
    "_SZO",   "_STA1",  "_INCA",  "_CPA",    "_CPO",  "_RA",  "_RF",  "_CORA", "_CALNUM", "_TNVL"};

/// Reads the variables and fills the arguments.
class OldCall {
public:
  OldCall(const CycleDefinition& cycle, const Control& control)
      : cycle_(cycle), control_(control), arguments_(cycle), variant_(whole("_MVAR")) {}

  Arguments read();

private:
  double number(std::string_view name, double absent = 0) const { return control_.data.number(name, {}, absent); }
  double element(int index) const { return control_.data.number("_SETV", {index}, index == 0 ? number("_SETV") : 0); }
  int whole(std::string_view name, double absent = 0) const {
    const double value = number(name, absent);
    return std::abs(value) < 1e9 ? static_cast<int>(std::lround(value)) : -1;
  }
  std::string text(const char* name) const {
    const auto value = control_.data.get(DataKey(name, {}));
    const auto* found = value ? std::get_if<std::string>(&*value) : nullptr;
    return found == nullptr ? std::string() : *found;
  }
  /// A decimal digit of _MVAR, from the right from 1.
  int digit(int place) const {
    int value = variant_;
    for (int i = 1; i < place; ++i)
      value /= 10;
    return value % 10;
  }
  void put(std::string_view parameter, double value) {
    const auto found = std::ranges::find(cycle_.parameters, parameter, &Parameter::name);
    if (found != cycle_.parameters.end()) arguments_.set(found->address, value);
  }
  void put(std::string_view parameter, std::string value) {
    const auto found = std::ranges::find(cycle_.parameters, parameter, &Parameter::name);
    if (found != cycle_.parameters.end()) arguments_.set(found->address, std::move(value));
  }
  [[noreturn]] void refuse(const char* code, const std::string& what) const {
    throw Alarm(
        code, fmt::format("{} without arguments takes the variables of older measuring cycles: {}", cycle_.name, what),
        fmt::format("write the call with arguments: 'probewright cycles {}'", cycle_.name));
  }
  [[noreturn]] void refuseVariant(std::string_view why = {}) const {
    refuse("61307",
           fmt::format("_MVAR = {} is not carried out in this form{}{}", variant_, why.empty() ? "" : ": ", why));
  }
  /// Refuses digits of _MVAR from `place` on.
  void nothingFrom(int place) const {
    int value = variant_;
    for (int i = 1; i < place; ++i)
      value /= 10;
    if (value != 0) refuseVariant();
  }

  void common();
  /// The hundreds of S_MVAR for those of _MVAR, with what they correct.
  int task(bool corrects);
  int zeroOffset() const;
  int toolOffset(bool turning) const;
  void setValues(int count) {
    for (int i = 0; i < count; ++i)
      put(fmt::format("S_SETV{}", i), element(i));
  }
  int corner();
  int calibration();
  int turned();

  const CycleDefinition& cycle_;
  const Control& control_;
  Arguments arguments_;
  int variant_;
};

void OldCall::common() {
  // The measuring path is in mm whatever the program's unit is.
  put("S_FA", number("_FA") / control_.unit);
  put("S_TSA", number("_TSA"));
  put("S_PRNUM", whole("_PRNUM", 1) % 100);  // the hundreds told the kind of the probe, which the tool data tell now
  put("S_NMSP", whole("_NMSP", 1));
  put("S_STA1", number("_STA1"));
  put("S_INCA", number("_INCA"));
  put("S_ID", number("_ID"));
  put("S_SZA", number("_SZA"));
  put("S_SZO", number("_SZO"));
  put("S_SETV", number("_SETVAL"));
  put("S_MA", whole("_MA"));
  put("S_EVNUM", whole("_EVNUM"));
  put("S_VMS", number("_VMS"));
  const double angle = number("_CORA");
  if (control_.tool.type == 712 && angle != 0 && std::abs(angle - control_.tool.correctionAngle) > 1e-6)
    refuse("61319", fmt::format("_CORA = {}; the correction angle of the probe is $TC_DP10 = {} now", angle,
                                control_.tool.correctionAngle));
  if (!text("_TENV").empty()) refuse("61319", "_TENV: tool environments are not available");
}

int OldCall::zeroOffset() const {
  const int number = whole("_KNUM");
  // Fine, or coarse where the machine was set up so.
  const int part = control_.data.number("_CHBIT", {21}) != 0 ? 10000 : 0;
  if (number == 0) return 0;
  if (number >= 1 && number <= 99) return part + number;
  if (number == 1000) return part + 1001;
  if (number >= 1011 && number <= 1026) return part + number - 10;
  if (number >= 1051 && number <= 1066) return part + 3000 + number - 1050;
  if (number == 2000) return part + 2000;
  if (number == 9999) return part + 9000;
  refuse("61321", fmt::format("_KNUM = {} is not a zero offset", number));
}

int OldCall::toolOffset(bool turning) const {
  const int number = whole("_KNUM");
  if (number < 0 || number > 9999999 || number / 1000 % 10 != 0)
    refuse("61328", fmt::format("_KNUM = {} is not a tool offset", number));
  if (turning) return number;
  const int edge = number % 1000, inverted = number / 10000 % 10, component = number / 100000 % 10,
            memory = number / 1000000;
  return edge + component * 100000 + memory * 1000000 + inverted * 10000000;
}

int OldCall::task(bool corrects) {
  const int hundreds = digit(3);
  if (hundreds == 1) {
    put("S_KNUM", zeroOffset());
    return 100;
  }
  if (hundreds != 0) refuseVariant();
  const std::string name = text("_TNAME");
  const int number = whole("_TNUM");
  if (!corrects || whole("_KNUM") == 0 || (name.empty() && number == 0)) return 0;
  put("S_KNUM1", toolOffset(cycle_.number == 974));
  put("S_TNAME", name.empty() ? std::to_string(number) : name);
  put("S_DLNUM", whole("_DLNUM"));
  put("S_TZL", this->number("_TZL"));
  put("S_TMV", this->number("_TMV"));
  put("S_TUL", this->number("_TUL"));
  put("S_TLL", this->number("_TLL"));
  put("S_TDIF", this->number("_TDIF"));
  put("S_K", whole("_K", 1));
  if (this->number("_TUL") != 0 || this->number("_TLL") != 0) put("_AMODE", 1);
  return 200;
}

/// CYCLE961: 105 to 108 by distances from where the probe stands, 117 and 118 by coordinates of four points.
int OldCall::corner() {
  const int units = digit(1);
  nothingFrom(4);
  if (units < 5 || units > 8) refuseVariant();
  put("S_ID", 0.0);
  if (digit(2) == 1) {
    if (units < 7) refuseVariant();
    setValues(8);
    return 10 + units;
  }
  if (digit(2) != 0) refuseVariant();
  if (whole("_SETV", 0) > 1 || element(4) > 1)
    refuse(
        "61319",
        fmt::format("_SETV[4] = {} lays the required corner beside the measured one, by _SETV[2] and _SETV[3]; the set "
                    "place of the measured corner is S_SETV8, S_SETV9 now",
                    element(4)));
  const Vector3 pole = control_.workingPlane().planeFromXyz(control_.channel.position()) / control_.unit;
  put("S_SETV0", element(0) / 2);
  put("S_SETV1", element(0));
  put("S_SETV2", element(1) / 2);
  put("S_SETV3", element(1));
  put("S_SETV4", pole.x());
  put("S_SETV5", pole.y());
  const double height = number("_ID");
  put("S_ID", height);
  return units + (height != 0 ? 1000 : 0);
}

/// CYCLE976: a surface, or a ring whose centre is known (1) or not (8).
int OldCall::calibration() {
  const int task = variant_ % 100;
  put("S_MD", whole("_MD"));
  if (digit(3) != 0) refuseVariant();
  if (task == 0) {
    nothingFrom(6);
    if (digit(4) != 0 || digit(5) > 1) refuseVariant();
    return 1000 + (digit(5) == 1 ? 1000000 : 0);
  }
  nothingFrom(7);
  if ((task != 1 && task != 8) || digit(5) != 0 || digit(6) > 1) refuseVariant();
  if (task == 8 && digit(4) != 0) refuseVariant();
  return (task == 1 ? 1 : 2) + digit(4) * 1000 + digit(6) * 100000;
}

/// CYCLE974: a face, or a diameter inside or outside, as the probe stands.
int OldCall::turned() {
  nothingFrom(5);
  if (digit(2) != 0 || digit(1) != 0 || digit(4) > 1) refuseVariant();
  int feature = 0;
  const control::WorkingPlane plane = control_.workingPlane();
  const int axis = whole("_MA");
  if (axis >= 1 && axis <= 3 && plane.xyzFromPlane(Vector3::Unit(axis - 1)).x() != 0)
    feature = (control_.diameter ? 2 : 1) * std::abs(control_.channel.position().x()) >=
                      std::abs(number("_SETVAL")) * control_.unit
                  ? 2
                  : 1;
  return feature + task(true) + digit(4) * 10000;
}

Arguments OldCall::read() {
  if (variant_ < 0) refuseVariant();
  common();
  int variant = 0;
  switch (cycle_.number) {
    case 961:
      variant = corner() + task(false);
      break;
    case 973:
      if (variant_ != 0)
        refuseVariant("only 0, calibration on a surface, is; the groove that _CALNUM names is S_CALNUM now");
      put("S_MD", whole("_MD"));
      variant = 1100;
      break;
    case 974:
      variant = turned();
      break;
    case 976:
      variant = calibration();
      break;
    case 977:
      nothingFrom(5);
      if (digit(2) != 0 || digit(4) > 1) refuseVariant();
      setValues(2);
      variant = digit(1) + task(true) + digit(4) * 1000;
      break;
    case 978:
      nothingFrom(5);
      if (digit(2) != 0 || digit(1) != 0 || digit(4) > 1) refuseVariant();
      variant = task(true) + digit(4) * 10000;
      break;
    case 979:
      nothingFrom(5);
      if (digit(2) == 0 && (digit(1) == 3 || digit(1) == 4))
        refuseVariant("grooves and ribs at an angle are measured by CYCLE977 with S_STA1 now");
      if (digit(2) != 0 || digit(1) < 1 || digit(1) > 2) refuseVariant();
      put("S_CPA", number("_CPA"));
      put("S_CPO", number("_CPO"));
      variant = digit(1) + task(true) + digit(4) * 1000;
      break;
    case 997:
      nothingFrom(7);
      setValues(9);
      if (control_.data.isSet(DataKey("_TNVL", {}))) put("S_TNVL", number("_TNVL"));
      variant = variant_ - digit(3) * 100 + task(false);
      break;
    case 998:
      nothingFrom(7);
      if (digit(2) != 0 || digit(4) > 1 || digit(5) != 0 || digit(6) > 1) refuseVariant();
      setValues(4);
      put("S_RA", whole("_RA"));
      if (digit(1) == 6) put("S_SETV", 0.0);
      variant = digit(1) + task(false) + digit(4) * 10000 + digit(6) * 100000;
      break;
    case 994:
      refuseVariant("its _SZA and _SZO count in the axes of the plane, S_SZA and S_SZO in measuring and passing axis");
    default:
      refuseVariant();
  }
  put("S_MVAR", variant);
  return arguments_;
}

}  // namespace

bool hasOldForm(const CycleDefinition& cycle) {
  static constexpr int cycles[] = {961, 973, 974, 976, 977, 978, 979, 994, 997, 998};
  return std::ranges::find(cycles, cycle.number) != std::end(cycles);
}

bool isOldParameter(std::string_view name) { return std::ranges::find(names, name) != std::end(names); }

bool hasOldParameters(const DataStore& data) { return data.isSet(DataKey("_MVAR", {})); }

Arguments argumentsOfOldForm(const CycleDefinition& cycle, const Control& control) {
  return OldCall(cycle, control).read();
}

OldFeed::OldFeed(Control& control)
    : control_(control),
      key_("$SNS_MEA_WP_FEED",
           {std::max(1, static_cast<int>(std::lround(control.data.number("_PRNUM", {}, 1))) % 100) - 1}) {
  const double feed = control.data.number("_VMS", {}) * control.unit;
  if (!(feed > 0)) return;
  before_ = control.data.number(key_);
  changed_ = true;
  control_.data.set(key_, feed);
}

OldFeed::~OldFeed() {
  if (changed_) control_.data.set(key_, before_);
}

}  // namespace probewright::cycles::sinumerik
