#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "simulation/imported_part.hpp"
#include "simulation/step_text.hpp"

using namespace probewright;

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
  for (const std::string& part : {std::string(bytes), "Probewright part 3\n" + std::string(bytes)}) {
    if (const auto read = simulation::partFromBytes(part)) require(simulation::toBytes(*read) == part);
  }
  return 0;
}
