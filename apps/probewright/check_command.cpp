#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <map>
#include <thread>
#include <tuple>

#include "base/file.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "interruption.hpp"
#include "session/check.hpp"
#include "setup/setup.hpp"

namespace probewright::app {

namespace {

constexpr const char* kStandardInput = "/dev/stdin";
constexpr const char* kNameOfStandardInput = "standard input";

/// Messages about what was piped in name it so that nobody looks for a file.
void nameStandardInput(Diagnostics& found) {
  for (Diagnostic& each : found) {
    if (each.place.file == kStandardInput) each.place.file = kNameOfStandardInput;
  }
}

int checkOnce(const CheckArguments& arguments) {
  bool errors = false;
  CheckDocument document(arguments.format);
  const bool asText = arguments.format == CheckFormat::Text;
  const auto tell = [&](const Diagnostics& found, language::Encoding encoding) {
    asText ? print(found, encoding) : document.add(found, encoding);
    errors = errors || hasErrors(found);
  };
  std::optional<setup::Setup> setup;
  if (!arguments.setup.empty()) {
    Diagnostics mistakes;
    setup = setup::readSetup(arguments.setup, mistakes);
    tell(mistakes, language::Encoding::Windows1252);
  }
  const bool readable = arguments.setup.empty() || setup;
  for (const std::filesystem::path& path : readable ? arguments.programs : std::vector<std::filesystem::path>()) {
    const bool piped = path == "-";
    std::string text;
    Diagnostics found = session::checkProgram(piped ? std::filesystem::path(kStandardInput) : path, arguments.control,
                                              arguments.skipLevels, &text, setup ? &setup->beliefs : nullptr,
                                              session::knownFamilies(), setup ? &setup->world.truth.machine : nullptr);
    const language::Encoding encoding = language::detectEncoding(text);
    if (piped) {
      nameStandardInput(found);
      document.know(kNameOfStandardInput, text);
    }
    tell(found, encoding);
    if (found.empty() && asText) {
      const std::string name = piped ? kNameOfStandardInput : path.string();
      std::fputs(printable(fmt::format("{}: no mistakes found\n", name)).c_str(), stdout);
    }
  }
  if (!asText) std::fputs(document.text().c_str(), stdout);
  return errors ? 2 : 0;
}

/// What tells that a file has changed: replaced, rewritten, made or removed.
using Stamps = std::map<std::filesystem::path, std::tuple<std::filesystem::file_time_type, std::uintmax_t, ino_t>>;

/// The programs, the setup, and what lies beside the programs: others that they call, definition files.
Stamps stampsOf(const CheckArguments& arguments) {
  namespace fs = std::filesystem;
  constexpr std::size_t most = 10'000;  // files of a folder
  // What this program writes itself is not a change.
  const auto output = identityOf("/proc/self/fd/1"), errors = identityOf("/proc/self/fd/2");
  Stamps stamps;
  std::error_code unknown;
  const auto note = [&](const fs::path& path) {
    const auto identity = identityOf(path);
    if (!identity || !fs::is_regular_file(path, unknown)) return;
    if (identity == output || identity == errors) return;
    stamps[path] = {fs::last_write_time(path, unknown), fs::file_size(path, unknown), identity->number};
  };
  note(arguments.setup);
  for (const fs::path& program : arguments.programs) {
    note(program);
    const fs::path folder = program.has_parent_path() ? program.parent_path() : fs::path(".");
    std::size_t count = 0;
    for (fs::directory_iterator entry(folder, unknown), end; entry != end && ++count < most; entry.increment(unknown))
      note(entry->path());
  }
  return stamps;
}

}  // namespace

int check(const CheckArguments& arguments) {
  if (!arguments.watch) return checkOnce(arguments);
  if (std::ranges::find(arguments.programs, "-") != arguments.programs.end()) {
    print({fail("standard input is read once, it cannot be watched", "give --watch the name of a file").value()});
    return 2;
  }
  const Interruption interruption;
  const std::stop_token stop = interruption.token();
  while (true) {
    const Stamps before = stampsOf(arguments);
    const int exit = checkOnce(arguments);
    std::fputs("--- waiting for a change; Ctrl-C ends\n", stdout);
    std::fflush(stdout);
    do {
      if (stop.stop_requested()) return exit;
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
    } while (stampsOf(arguments) == before);
    // Editors write in several steps: what is there when they have ended counts.
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
}

}  // namespace probewright::app
