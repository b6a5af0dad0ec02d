#include "session/own_control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/number_text.hpp"

namespace probewright::session {

using control::EventKind;

Accompanied::Accompanied(machine::Machine& machine, const control::Channel& channel,
                         const control::OperatorPanel& panel, const control::Journal& journal, std::string main)
    : own_(machine::ownControlOf(machine)) {
  if (own_ == nullptr) return;
  own_->accompany([this, &channel, &panel, &journal, main = std::move(main)] {
    machine::OrderPlace place;
    if (panel.place.file == main && panel.place.line > 0) place.line = panel.place.line;
    for (; told_ < journal.events.size(); ++told_) {
      const control::EventRecord event = journal.events[told_];
      const bool forOperator = event.kind == EventKind::Message || event.kind == EventKind::Warning;
      if (forOperator && !event.text.empty()) place.messages.push_back(event.text);
    }
    place.toolVector = channel.toolVector;
    place.toolRadius = channel.toolRadius;
    return place;
  });
}

Accompanied::~Accompanied() {
  if (own_ != nullptr) own_->accompany({});
}

std::string ownOffsetName(int number) {
  return number <= 6 ? fmt::format("G{}", 53 + number) : fmt::format("G59.{}", number - 6);
}

bool isUnset(const machine::OwnOffset& offset) {
  return offset.rotation == 0 && std::ranges::all_of(offset.origin.values, [](double value) { return value == 0; });
}

bool same(const machine::OwnOffset& a, const machine::OwnOffset& b, std::size_t axes) {
  for (std::size_t i = 0; i < axes; ++i)
    if (!(std::abs(a.origin[i] - b.origin[i]) <= sameNumber)) return false;
  return std::abs(a.rotation - b.rotation) <= sameNumber;
}

std::string takenOver(const std::string& row, const machine::OwnOffset& offset,
                      const machine::MachineDescription& machine) {
  std::string where;
  for (std::size_t i = 0; i < machine.axes.size(); ++i)
    where += fmt::format(" {}{}", machine.axes[i].name, formatFixed(offset.origin[i], 4));
  if (offset.rotation != 0) where += fmt::format(", turned by {} degrees", formatFixed(offset.rotation, 4));
  return fmt::format("{} is what the machine has as {}:{}", row, ownOffsetName(offset.number), where);
}

void giveBack(machine::OwnControl& own, const machine::OwnTables& changed, control::OperatorPanel& panel,
              double seconds) {
  if (changed.offsets.empty() && changed.tools.empty()) return;
  if (const auto why = own.keep(changed)) {
    panel.message(
        EventKind::Warning,
        fmt::format("the machine's own tables could not be changed: {}; they are older than those of this run", *why),
        seconds);
  }
}

}  // namespace probewright::session
