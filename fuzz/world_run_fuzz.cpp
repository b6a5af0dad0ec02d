// Any bytes as a program for a control with a tool touch probe and tools, a calibration sphere under a trunnion, or a
// camera: checked and run on the virtual machine of an example's setup, for up to 2,000 blocks. It ends well, or in a
// mistake or an alarm that says why. The first byte chooses the setup. Begin with fuzz/corpus/world_run, whose programs
// measure tools, kinematics and working space.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "setup/setup.hpp"
#include "setup/simulated_run.hpp"

using namespace probewright;

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

struct World {
  std::string program;  ///< its name: the ending tells the language
  setup::Setup setup;
};

/// A world whose parts cost little: a camera of few pixels.
World world(const char* setupName, const char* programName) {
  Diagnostics diagnostics;
  auto read = setup::readSetup(std::string(PROBEWRIGHT_SOURCE_DIR "/examples/setups/") + setupName, diagnostics);
  require(read.has_value());
  if (read->camera) {
    read->camera->width = 80;
    read->camera->height = 60;
  }
  return {programName, std::move(*read)};
}

const std::vector<World>& worlds() {
  static const std::vector<World> all = [] {
    std::vector<World> made;
    made.push_back(world("tool-tnc640.toml", "fuzz.h"));
    made.push_back(world("kinematics-tnc640.toml", "fuzz.h"));
    made.push_back(world("camera-tnc640.toml", "fuzz.h"));
    made.push_back(world("tool-840dsl.toml", "fuzz.mpf"));
    made.push_back(world("kinematics-840dsl.toml", "fuzz.mpf"));
    made.push_back(world("tools-lathe.toml", "fuzz.mpf"));
    return made;
  }();
  return all;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const World& here = worlds()[data[0] % worlds().size()];
  session::RunOptions options;
  options.stepLimit = 2000;
  options.recordLimit = std::uint64_t{16} << 20U;
  const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  const auto ran = setup::runText(here.program, text, here.setup, options, {.recordPath = false});
  for (const Diagnostic& diagnostic : ran.outcome.diagnostics)
    require(!diagnostic.message.empty());
  for (const Diagnostic& diagnostic : ran.outcome.result.diagnostics)
    require(!diagnostic.message.empty());
  // Who is not told of a mistake has a program that ran to its end.
  const bool finished = ran.outcome.result.end == execution::RunEnd::Finished;
  require(finished || !ran.outcome.diagnostics.empty() || !ran.outcome.result.diagnostics.empty());
  return 0;
}
