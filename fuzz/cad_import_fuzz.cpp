#include <dlfcn.h>
#include <execinfo.h>
#include <sanitizer/common_interface_defs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "simulation/cad_solid.hpp"
#include "simulation/cad_transfer.hpp"

using namespace probewright;

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

const std::filesystem::path& folder() {
  static const std::filesystem::path made =
      std::filesystem::temp_directory_path() / ("probewright-fuzz-" + std::to_string(getpid()));
  std::filesystem::create_directories(made);
  return made;
}

/// True if the innermost function of what is under way is Probewright's, not OpenCASCADE's; libraries of the language
/// and the sanitizer do not count.
bool isOurs() {
  std::array<void*, 64> frames{};
  const int count = backtrace(frames.data(), static_cast<int>(frames.size()));
  bool inHandler = true;
  for (int i = 0; i < count; ++i) {
    Dl_info module{};
    const std::string_view file = dladdr(frames[static_cast<std::size_t>(i)], &module) != 0 ? module.dli_fname : "";
    if (file.find("libTK") != std::string_view::npos) return false;
    if (file.find(".so") != std::string_view::npos) continue;
    std::array<char, 400> name{};
    __sanitizer_symbolize_pc(frames[static_cast<std::size_t>(i)], "%f", name.data(), name.size());
    const std::string_view function(name.data());
    // What stands here is called by the sanitizer or by the signal.
    constexpr std::array<std::string_view, 8> kTools{"isOurs",      "onFault",       "__asan", "__ubsan",
                                                     "__sanitizer", "__interceptor", "std::",  "operator"};
    const bool isTool =
        std::ranges::any_of(kTools, [&](auto part) { return function.find(part) != std::string_view::npos; });
    if (inHandler && isTool) continue;
    inHandler = false;
    if (function.find("probewright::") != std::string_view::npos) return true;
    if (function.find("opencascade::") != std::string_view::npos) continue;  // inline in whoever calls it
  }
  return false;
}

void onFault() {
  static bool asked = false;
  if (!asked && (asked = true) && isOurs()) std::ofstream(folder() / "ours") << "x";
}

extern "C" void onSignal(int) {
  onFault();
  _exit(1);
}

/// Imports again what has crashed, and says whose fault it was.
bool crashesInOurs(const simulation::TransferOrder& order) {
  folder();
  simulation::inChild(
      [&](const simulation::ChildVoice& voice) {
        __sanitizer_set_death_callback(onFault);
        static std::array<char, 1 << 16> stack;
        const stack_t other{stack.data(), 0, stack.size()};
        sigaltstack(&other, nullptr);
        struct sigaction action {};
        action.sa_handler = onSignal;
        action.sa_flags = SA_ONSTACK;
        for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT})
          sigaction(signal, &action, nullptr);
        simulation::transferCad(order, voice);
        return std::string();
      },
      {30}, [](std::string_view) {}, [](double seconds) { return seconds > 10; },
      [](const simulation::HandedBytes&) { return false; });
  return std::filesystem::remove(folder() / "ours");
}

}  // namespace

// Any bytes as a STEP or an IGES file, imported as the program does: what OpenCASCADE makes of them in its own process
// is its affair, but no crash there may be Probewright's; here there is a part that can be touched, or a mistake that
// names the file.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const bool isStep = bytes.starts_with("ISO-10303-21");
  const std::filesystem::path file = folder() / (isStep ? "part.step" : "part.igs");
  std::ofstream(file, std::ios::binary) << bytes;
  simulation::ImportOptions options;
  options.deflection = 0.5;
  options.seconds = 10;
  options.faceSeconds = 2;
  const auto solid = isStep ? simulation::readStep(file, options) : simulation::readIges(file, options);
  if (!solid) {
    const Diagnostic& mistake = solid.error();
    require(mistake.place.file == file.string() && !mistake.message.empty());
    if (mistake.message.find("crash") == std::string::npos) return 0;
    simulation::TransferOrder order;
    order.format = isStep ? simulation::CadFormat::Step : simulation::CadFormat::Iges;
    order.file = file.string();
    order.bytes = bytes;
    order.deflection = options.deflection;
    order.facePoints = options.facePoints;
    require(!crashesInOurs(order));
    return 0;
  }
  const simulation::Bounds bounds = (*solid)->bounds();
  const Vector3 middle = (bounds.minimum + bounds.maximum) / 2;
  const auto contact = (*solid)->firstContact(bounds.maximum + Vector3(10, 10, 10), middle, 1);
  require(!contact || (contact->fraction >= 0 && contact->fraction <= 1));
  return 0;
}
