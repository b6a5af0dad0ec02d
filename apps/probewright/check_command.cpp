#include <fmt/format.h>

#include <cstdio>

#include "commands.hpp"
#include "console.hpp"
#include "session/check.hpp"

namespace probewright::app {

int check(const CheckArguments& arguments) {
  bool errors = false;
  for (const std::filesystem::path& path : arguments.programs) {
    std::string text;
    const Diagnostics found = session::checkProgram(path, arguments.control, arguments.skipLevels, &text);
    print(found, language::detectEncoding(text));
    errors = errors || hasErrors(found);
    if (found.empty()) std::fputs(printable(fmt::format("{}: no mistakes found\n", path.string())).c_str(), stdout);
  }
  return errors ? 2 : 0;
}

}  // namespace probewright::app
