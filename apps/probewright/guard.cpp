#include "guard.hpp"

#include <cstdio>
#include <exception>

namespace probewright::app {

namespace {

int internalError(const char* what) {
  std::fprintf(stderr, "probewright: internal error: %s\nPlease report this with the program and the setup.\n", what);
  return 4;
}

}  // namespace

int guarded(const std::function<int()>& command) {
  try {
    return command();
  } catch (const std::exception& error) {
    return internalError(error.what());
  } catch (...) {  // libraries have exceptions of their own
    return internalError("an exception of a library");
  }
}

}  // namespace probewright::app
