#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "simulation/cad_solid.hpp"

using namespace probewright;

// Any bytes as a STEP or an IGES file, imported as the program does: what OpenCASCADE makes of them in its own process
// is its affair; here there is a part that can be touched, or a mistake that names the file.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto require = [](bool holds) {
    if (!holds) std::abort();
  };
  static const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("probewright-fuzz-" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const bool isStep = bytes.starts_with("ISO-10303-21");
  const std::filesystem::path file = folder / (isStep ? "part.step" : "part.igs");
  std::ofstream(file, std::ios::binary) << bytes;
  simulation::ImportOptions options;
  options.deflection = 0.5;
  options.seconds = 10;
  options.faceSeconds = 2;
  const auto solid = isStep ? simulation::readStep(file, options) : simulation::readIges(file, options);
  if (!solid) {
    require(solid.error().place.file == file.string() && !solid.error().message.empty());
    return 0;
  }
  const simulation::Bounds bounds = (*solid)->bounds();
  const Vector3 middle = (bounds.minimum + bounds.maximum) / 2;
  const auto contact = (*solid)->firstContact(bounds.maximum + Vector3(10, 10, 10), middle, 1);
  require(!contact || (contact->fraction >= 0 && contact->fraction <= 1));
  return 0;
}
