#include <fmt/format.h>

#include <cstdio>

#include "commands.hpp"
#include "console.hpp"
#include "session/check.hpp"
#include "setup/setup.hpp"

namespace probewright::app {

int check(const CheckArguments& arguments) {
  bool errors = false;
  std::optional<setup::Setup> setup;
  if (!arguments.setup.empty()) {
    Diagnostics mistakes;
    setup = setup::readSetup(arguments.setup, mistakes);
    print(mistakes);
    if (!setup) return 2;
  }
  for (const std::filesystem::path& path : arguments.programs) {
    std::string text;
    const Diagnostics found =
        session::checkProgram(path, arguments.control, arguments.skipLevels, &text, setup ? &setup->beliefs : nullptr);
    print(found, language::detectEncoding(text));
    errors = errors || hasErrors(found);
    if (found.empty()) std::fputs(printable(fmt::format("{}: no mistakes found\n", path.string())).c_str(), stdout);
  }
  return errors ? 2 : 0;
}

}  // namespace probewright::app
