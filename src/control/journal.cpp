#include "control/journal.hpp"

#include "control/alarm.hpp"

namespace probewright::control {

namespace {

/// What a text takes that does not lie in the object itself; allocators round up and keep books.
std::uint64_t bytesOf(const std::string& text) {
  constexpr std::size_t within = 15, books = 16;
  return text.size() > within ? text.size() + books : 0;
}

std::uint64_t bytesOf(const WriteRecord& record) {
  return sizeof record + bytesOf(record.table) + bytesOf(record.entry) + bytesOf(record.before) + bytesOf(record.after);
}

std::uint64_t bytesOf(const FitRecord& record) {
  return sizeof record + record.touches.size() * sizeof(std::size_t) +
         record.members.size() * sizeof(std::string_view) +
         (record.residuals.size() + record.cofactors.size()) * sizeof(double);
}

/// A touch is kept twice: as the control knows it, and in the path as it truly was.
constexpr std::uint64_t touchBytes = 3 * sizeof(TouchRecord);

/// Of a cycle that has ended, what was not charged when it was entered.
std::uint64_t bytesOfResults(const CycleRecord& record) {
  std::uint64_t bytes = 0;
  for (const ResultRecord& result : record.results)
    bytes +=
        sizeof result + bytesOf(result.name) + bytesOf(result.meaning) + bytesOf(result.unit) + bytesOf(result.label);
  for (const auto* texts : {&record.logFiles, &record.screens}) {
    for (const std::string& text : *texts)
      bytes += sizeof(std::string) + bytesOf(text);
  }
  return bytes;
}

}  // namespace

void Journal::charge(std::uint64_t bytes) {
  used += bytes;
  if (limit == 0 || used <= limit || full_) return;
  full_ = true;
  throw RecordFull();
}

void Journal::begin(CycleRecord record) {
  std::uint64_t bytes = sizeof record + bytesOf(record.name) + bytesOf(record.title) + bytesOf(record.place.file);
  for (const ParameterRecord& parameter : record.parameters)
    bytes += sizeof parameter + bytesOf(parameter.name) + bytesOf(parameter.value) + bytesOf(parameter.meaning);
  if (!cycles.empty()) bytes += bytesOfResults(cycles.back());
  charge(bytes);
  cycles.push_back(std::move(record));
  cycleOpen = true;
}

std::size_t Journal::touch(TouchRecord record) {
  if (!cycleOpen) return 0;
  charge(touchBytes);
  record.programFromTable = programFromTable;
  cycles.back().touches.push_back(std::move(record));
  return cycles.back().touches.size() - 1;
}

void Journal::fit(FitRecord record) {
  if (!cycleOpen) return;
  charge(bytesOf(record));
  cycles.back().fits.push_back(std::move(record));
}

void Journal::write(WriteRecord record) {
  charge(bytesOf(record));
  if (cycleOpen) {
    cycles.back().writes.push_back(std::move(record));
  } else {
    writes.push_back(std::move(record));
  }
}

void Journal::interrupt(InterruptedMotion motion) {
  charge(sizeof motion);
  if (cycleOpen) motion.cycle = cycles.size() - 1;
  interrupted.push_back(motion);
}

void Journal::event(const EventRecord& record) {
  charge(EventList::bytesOf(record));
  events.push_back(record);
}

}  // namespace probewright::control
