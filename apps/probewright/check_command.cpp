#include <fmt/format.h>

#include <cstdio>

#include "commands.hpp"
#include "session/check.hpp"

namespace probewright::app {

int check(const CheckArguments& arguments) {
  bool errors = false;
  for (const std::filesystem::path& path : arguments.programs) {
    const Diagnostics found = session::checkProgram(path, arguments.control);
    for (const Diagnostic& diagnostic : found)
      std::fputs((format(diagnostic) + "\n").c_str(), stderr);
    errors = errors || hasErrors(found);
    if (found.empty()) std::fputs(fmt::format("{}: no mistakes found\n", path.string()).c_str(), stdout);
  }
  return errors ? 2 : 0;
}

}  // namespace probewright::app
