#include "base/file.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

namespace probewright {

namespace {

tl::unexpected<Diagnostic> failErrno(const std::filesystem::path& path, std::string_view doing) {
  const std::string reason = std::strerror(errno);
  return fail(SourcePlace{path.string(), 0, 0}, "cannot " + std::string(doing) + ": " + reason);
}

bool writeAll(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace

Result<std::string> readFile(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    return fail(SourcePlace{path.string(), 0, 0}, "this is a folder, a file was expected");
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream) return failErrno(path, "open this file");
  std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (stream.bad()) return failErrno(path, "read this file");
  return bytes;
}

Result<void> writeFileAtomically(const std::filesystem::path& path, std::string_view bytes) {
  if (path.has_parent_path()) {
    std::error_code error;
    std::filesystem::create_directories(path.parent_path(), error);
    if (error) return fail(SourcePlace{path.string(), 0, 0}, "cannot create the folder: " + error.message());
  }
  std::string aside = path.string() + ".XXXXXX";
  const int descriptor = ::mkstemp(aside.data());
  if (descriptor < 0) return failErrno(path, "write beside this file");
  const bool written = writeAll(descriptor, bytes) && ::fchmod(descriptor, 0644) == 0 && ::fsync(descriptor) == 0;
  const int writeError = errno;
  ::close(descriptor);
  if (!written || ::rename(aside.c_str(), path.c_str()) != 0) {
    if (!written) errno = writeError;
    auto failure = failErrno(path, "write this file");
    ::unlink(aside.c_str());
    return failure;
  }
  return {};
}

}  // namespace probewright
