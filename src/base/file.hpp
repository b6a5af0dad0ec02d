#pragma once

#include <sys/types.h>

#include <compare>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "base/diagnostic.hpp"

namespace probewright {

/// No file that Probewright reads is larger, bytes.
inline constexpr std::uint64_t largestFile = std::uint64_t{1} << 30U;
/// Nor is a text that a person writes: a setup, a machine, answers, a mask.
inline constexpr std::uint64_t largestText = std::uint64_t{16} << 20U;

/// The whole file as bytes. A pipe is read to its end. Fails, with the way out, if it cannot be opened or read, is
/// larger than `most`, is a folder, a device or a socket, or a pipe that nothing writes into.
Result<std::string> readFile(const std::filesystem::path& path, std::uint64_t most = largestFile);

/// What makes a file the same under whatever name: its device and its number there.
struct FileIdentity {
  dev_t device = 0;
  ino_t number = 0;
  auto operator<=>(const FileIdentity&) const = default;
};
/// Of what lies at `path`, symbolic links followed; nothing if nothing does.
std::optional<FileIdentity> identityOf(const std::filesystem::path& path);

/// Writes the file whole or not at all: writes a neighbour, flushes it to disk, renames it over `path`. A crash at any
/// instant leaves the old file or the new one. Creates missing folders.
Result<void> writeFileAtomically(const std::filesystem::path& path, std::string_view bytes);

/// Writes all of `bytes` to an open file; false, with errno, if that cannot be done.
bool writeAll(int descriptor, std::string_view bytes);

/// "cannot <doing>: <reason of errno>", at `path`, with a way out where one is known.
tl::unexpected<Diagnostic> failErrno(const std::filesystem::path& path, std::string_view doing);

}  // namespace probewright
