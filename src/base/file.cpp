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

/// Writes and flushes a neighbour of `path` and returns its name. Creates missing folders.
Result<std::string> writeAside(const std::filesystem::path& path, std::string_view bytes) {
  std::error_code error;
  if (path.has_parent_path()) {
    std::filesystem::create_directories(path.parent_path(), error);
    if (error) return fail(SourcePlace{path.string(), 0, 0}, "cannot create the folder: " + error.message());
  }
  if (std::filesystem::is_directory(path, error)) {
    return fail(SourcePlace{path.string(), 0, 0}, "cannot write this file: a folder has its name");
  }
  std::string aside = path.string() + ".XXXXXX";
  const int descriptor = ::mkstemp(aside.data());
  if (descriptor < 0) return failErrno(path, "write beside this file");
  const bool written = writeAll(descriptor, bytes) && ::fchmod(descriptor, 0644) == 0 && ::fsync(descriptor) == 0;
  const int writeError = errno;
  ::close(descriptor);
  if (written) return aside;
  errno = writeError;
  auto failure = failErrno(path, "write this file");
  ::unlink(aside.c_str());
  return failure;
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
  return writeFilesTogether({{path, bytes}});
}

Result<void> writeFilesTogether(const std::vector<std::pair<std::filesystem::path, std::string_view>>& files) {
  std::vector<std::string> asides;
  std::size_t renamed = 0;
  const auto give = [&](tl::unexpected<Diagnostic> failure) {
    for (std::size_t i = renamed; i < asides.size(); ++i)
      ::unlink(asides[i].c_str());
    return failure;
  };
  for (const auto& [path, bytes] : files) {
    Result<std::string> aside = writeAside(path, bytes);
    if (!aside) return give(tl::unexpected(std::move(aside.error())));
    asides.push_back(std::move(*aside));
  }
  for (; renamed < asides.size(); ++renamed) {
    const std::filesystem::path& path = files[renamed].first;
    if (::rename(asides[renamed].c_str(), path.c_str()) != 0) return give(failErrno(path, "write this file"));
  }
  return {};
}

}  // namespace probewright
