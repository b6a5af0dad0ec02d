#include "cache_folder.hpp"

#include <cstdlib>
#include <string_view>

namespace probewright::app {
namespace {

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string() : value;
}

}  // namespace

std::filesystem::path cacheFolder(const std::string& option) {
  const std::string named = option.empty() ? variable("PROBEWRIGHT_CACHE") : option;
  if (!named.empty()) return named == "off" ? std::filesystem::path() : std::filesystem::path(named);
  // A relative path in this variable is to be ignored, says the XDG specification.
  const std::filesystem::path caches = variable("XDG_CACHE_HOME");
  if (caches.is_absolute()) return caches / "probewright";
  const std::filesystem::path home = variable("HOME");
  return home.is_absolute() ? home / ".cache" / "probewright" : std::filesystem::path();
}

}  // namespace probewright::app
