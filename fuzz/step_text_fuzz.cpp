#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "simulation/imported_part.hpp"
#include "simulation/step_records.hpp"
#include "simulation/step_text.hpp"

using namespace probewright;

namespace {

/// True if every record has a name, a type and arguments, and lists stand before what they stand in.
bool areWhole(const simulation::StepRecords& records) {
  using Kind = simulation::StepRecords::Kind;
  std::size_t lists = 0;
  for (const auto& record : records.records()) {
    if (record.name == nullptr || record.type == nullptr || record.first + record.count > records.arguments().size())
      return false;
    for (std::size_t i = record.first; i < record.first + record.count; ++i) {
      const auto& argument = records.arguments()[i];
      if (argument.text == nullptr || *argument.text == 0) return false;
      if (argument.kind == Kind::List && lists-- == 0) return false;
    }
    if (*record.name == '$') ++lists;
  }
  return lists == 0;
}

}  // namespace

// Any bytes as a STEP file, and as what an import hands over: entities that stand in the file or a mistake in its line;
// a part that comes back as it was, or none.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto require = [](bool holds) {
    if (!holds) std::abort();
  };
  const auto lines = 1 + static_cast<std::uint64_t>(std::count(bytes.begin(), bytes.end(), '\n'));
  const std::string step = "ISO-10303-21;\n" + std::string(bytes) + "\nEND-ISO-10303-21;";
  for (const std::string_view text : {bytes, std::string_view(step)}) {
    const auto scanned = simulation::scanStep(text, "part.step");
    if (!scanned) {
      require(!scanned.error().message.empty() && scanned.error().place.line <= lines + 2);
      continue;
    }
    for (const auto& [id, entity] : scanned->entities)
      require(id > 0 && entity.line >= 1 && entity.line <= lines + 2);
    const std::uint64_t circular = simulation::circularEntity(*scanned);
    require(circular == 0 || scanned->entities.contains(circular));
    require(scanned->dangling == 0 || !scanned->entities.contains(scanned->missing));
  }
  const std::string asData = "ISO-10303-21;HEADER;ENDSEC;DATA;" + std::string(bytes) + "ENDSEC;END-ISO-10303-21;";
  for (const std::string& text : {std::string(bytes), step, asData}) {
    auto records = simulation::StepRecords::of(text);
    if (!records) continue;
    require(areWhole(*records));
    records->dropAnnotations();
    require(areWhole(*records));
  }
  for (const std::string& part : {std::string(bytes), "Probewright part 4\n" + std::string(bytes)}) {
    if (const auto read = simulation::partFromBytes(part)) require(simulation::toBytes(*read) == part);
  }
  return 0;
}
