#include "run_record.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <utility>

#include "base/file.hpp"
#include "base/writable_folder.hpp"
#include "exchange/formats.hpp"

namespace probewright::app {

namespace {

/// The file at a path, locked for as long as this lives.
class Locked {
public:
  /// Opens, makes and locks it; false, with errno, if that cannot be done.
  bool lock(const std::filesystem::path& path) {
    while (true) {
      descriptor_ = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
      if (descriptor_ < 0 || flock(descriptor_, LOCK_EX) != 0) return false;
      // Who had the lock before has put a new file in its place: that one is to be locked.
      const auto here = identityOf(path);
      const auto held = identityOf("/proc/self/fd/" + std::to_string(descriptor_));
      if (here && held && *here == *held) return true;
      close(descriptor_);
    }
  }
  Locked() = default;
  ~Locked() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  Locked(const Locked&) = delete;
  Locked& operator=(const Locked&) = delete;

private:
  int descriptor_ = -1;
};

constexpr const char* another = "give --append the name of a file in another folder";

/// Whether there is a file at the path. Fails if it is something else.
Result<bool> isThere(const std::filesystem::path& file) {
  std::error_code unknown;
  const auto kind = std::filesystem::status(file, unknown);
  if (!std::filesystem::exists(kind)) return false;
  if (std::filesystem::is_regular_file(kind)) return true;
  return fail({file.string()}, "this is not a file that values can be added to", "give --append the name of a file");
}

}  // namespace

Result<void> checkRecord(const std::filesystem::path& file) {
  const Result<bool> there = isThere(file);
  if (!there) return tl::unexpected(there.error());
  const auto at = [&](Diagnostic mistake) {
    mistake.place.file = file.string();
    return mistake;
  };
  if (*there) {
    if (faccessat(AT_FDCWD, file.c_str(), R_OK | W_OK, AT_EACCESS) != 0) return failErrno(file, "add to the record");
    const auto added = readFile(file).and_then(
        [](std::string record) { return exchange::recordWith(std::move(record), exchange::Inspection{}); });
    if (!added) return tl::unexpected(at(added.error()));
  }
  return checkWritable(file.has_parent_path() ? file.parent_path() : ".").map_error([](Diagnostic mistake) {
    mistake.advice = another;
    return mistake;
  });
}

Result<void> appendToRecord(const std::filesystem::path& file, const exchange::Inspection& inspection) {
  std::error_code unknown;
  if (const Result<bool> there = isThere(file); !there) return tl::unexpected(there.error());
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), unknown);
  Locked locked;
  if (!locked.lock(file)) return failErrno(file, "add to the record");
  return readFile(file)
      .and_then([&](std::string record) { return exchange::recordWith(std::move(record), inspection); })
      .and_then([&](const std::string& record) { return writeFileAtomically(file, record); })
      .map_error([&](Diagnostic mistake) {
        mistake.place.file = file.string();
        return mistake;
      });
}

}  // namespace probewright::app
