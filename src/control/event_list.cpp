#include "control/event_list.hpp"

#include <algorithm>

namespace probewright::control {

namespace {

constexpr std::size_t blockSize = 65536;

}  // namespace

std::uint32_t EventList::nameIndex(const std::string& name) {
  const auto [entry, isNew] = nameIndices_.emplace(name, static_cast<std::uint32_t>(names_.size()));
  if (isNew) names_.push_back(name);
  return entry->second;
}

void EventList::push_back(const EventRecord& event) {
  const std::size_t size = event.text.size();
  if (blocks_.empty() || blocks_.back().use_count() > 1 || blocks_.back()->capacity() - blocks_.back()->size() < size) {
    blocks_.push_back(std::make_shared<std::string>());
    blocks_.back()->reserve(std::max(blockSize, size));
  }
  std::string& block = *blocks_.back();
  const std::size_t at = block.size();
  block += event.text;
  packed_.push_back({block.data() + at, event.seconds, event.place.line, static_cast<std::uint32_t>(size),
                     event.place.column, nameIndex(event.place.file), nameIndex(event.code), event.kind});
}

EventRecord EventList::operator[](std::size_t index) const {
  const Packed& event = packed_[index];
  return {event.kind,
          {names_[event.file], event.line, event.column},
          names_[event.code],
          std::string(event.text, event.textSize),
          event.seconds};
}

}  // namespace probewright::control
