#include <cstdint>
#include <string>
#include <string_view>

#include "base/toml_table.hpp"
#include "study/study.hpp"
#include "study/trial.hpp"

/// Any text as a study file; of one that is taken, a few draws are made, too.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace probewright;
  static const toml::table setup = [] {
    Diagnostics none;
    return parseToml("[part.pose]\nx = 1\n[[tool]]\nname = \"PROBE\"\nball_radius = 3\ntip_offset = [0, 0]\n",
                     "setup.toml", none)
        .value();
  }();
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  Diagnostics mistakes;
  auto study = study::parseStudy(text, "study.toml", setup, mistakes);
  if (!study) return 0;
  const study::Sampler sampler(*study);
  toml::table varied = setup;
  for (std::uint64_t trial = 0; trial < 3; ++trial) {
    const study::Draw draw = sampler.draw(trial);
    for (std::size_t i = 0; i < study->sources.size(); ++i)
      static_cast<void>(study->sources[i].quantity.set(varied, draw.inputs[i]));
  }
  return 0;
}
