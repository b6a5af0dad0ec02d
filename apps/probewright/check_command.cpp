#include <fmt/format.h>

#include <cstdio>

#include "commands.hpp"
#include "console.hpp"
#include "session/check.hpp"
#include "setup/setup.hpp"

namespace probewright::app {

namespace {

constexpr const char* kStandardInput = "/dev/stdin";

/// Messages about what was piped in name it so that nobody looks for a file.
void nameStandardInput(Diagnostics& found) {
  for (Diagnostic& each : found) {
    if (each.place.file == kStandardInput) each.place.file = "standard input";
  }
}

}  // namespace

int check(const CheckArguments& arguments) {
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
                                              arguments.skipLevels, &text, setup ? &setup->beliefs : nullptr);
    if (piped) nameStandardInput(found);
    tell(found, language::detectEncoding(text));
    if (found.empty() && asText) {
      const std::string name = piped ? "standard input" : path.string();
      std::fputs(printable(fmt::format("{}: no mistakes found\n", name)).c_str(), stdout);
    }
  }
  if (!asText) std::fputs(document.text().c_str(), stdout);
  return errors ? 2 : 0;
}

}  // namespace probewright::app
