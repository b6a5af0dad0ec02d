#include "cycles/sinumerik/old_form.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "control/alarm.hpp"
#include "cycles/sinumerik/corrections.hpp"
#include "cycles/sinumerik/old_call.hpp"

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

}  // namespace

void OldCall::refuse(const char* code, const std::string& what) const {
  throw Alarm(code, fmt::format("{} without arguments takes the variables of older measuring cycles: {}", name_, what),
              fmt::format("write the call with arguments: 'probewright cycles {}'", cycle_->name));
}

void OldCall::isNow(std::string_view cycle) {
  cycle_ = &findEntry(cycle)->definition;
  arguments_ = Arguments(*cycle_);
  common();
}

void OldCall::refuseVariant(std::string_view why) const {
  refuse("61307",
         fmt::format("_MVAR = {} is not carried out in this form{}{}", variant_, why.empty() ? "" : ": ", why));
}

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

int OldCall::toolOffset() const {
  const int number = whole("_KNUM");
  if (number < 0 || number > 9999999 || number / 1000 % 10 != 0)
    refuse("61328", fmt::format("_KNUM = {} is not a tool offset", number));
  if (codesTurnedTool(*cycle_)) return number;
  const int edge = number % 1000, inverted = number / 10000 % 10, component = number / 100000 % 10,
            memory = number / 1000000;
  return edge + component * 100000 + memory * 1000000 + inverted * 10000000;
}

int OldCall::task(Corrects corrects) {
  const int hundreds = digit(3);
  if (hundreds == 1) {
    put("S_KNUM", zeroOffset());
    return 100;
  }
  if (hundreds != 0) refuseVariant();
  const std::string name = text("_TNAME");
  const int number = whole("_TNUM");
  if (corrects == Corrects::ZeroOffsetOnly || whole("_KNUM") == 0 || (name.empty() && number == 0)) return 0;
  put("S_KNUM1", toolOffset());
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

Arguments OldCall::read(int (*oldForm)(OldCall&)) {
  if (variant_ < 0) refuseVariant();
  common();
  put("S_MVAR", oldForm(*this));
  return arguments_;
}

bool hasOldForm(const CycleDefinition& cycle) {
  const Entry* entry = findEntry(cycle.name);
  return entry != nullptr && entry->oldForm != nullptr;
}

bool isOldParameter(std::string_view name) { return std::ranges::find(names, name) != std::end(names); }

bool hasOldParameters(const DataStore& data) { return data.isSet(DataKey("_MVAR", {})); }

Arguments argumentsOfOldForm(const CycleDefinition& cycle, const Control& control) {
  return OldCall(cycle, control).read(findEntry(cycle.name)->oldForm);
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
