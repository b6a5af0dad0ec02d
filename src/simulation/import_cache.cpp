#include "simulation/import_cache.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <fstream>
#include <memory>
#include <vector>

#include "base/file.hpp"

namespace probewright::simulation {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kDigestSize = 32;
constexpr const char* kEnding = ".part";
constexpr std::chrono::minutes kLongestWriting(10);

std::string digest(std::initializer_list<std::string_view> pieces) {
  const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context(EVP_MD_CTX_new(), EVP_MD_CTX_free);
  std::array<unsigned char, kDigestSize> bytes{};
  EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr);
  for (const std::string_view piece : pieces)
    EVP_DigestUpdate(context.get(), piece.data(), piece.size());
  EVP_DigestFinal_ex(context.get(), bytes.data(), nullptr);
  return {bytes.begin(), bytes.end()};
}

}  // namespace

ImportCache::ImportCache(fs::path folder, std::uint64_t mostBytes)
    : folder_(std::move(folder)), mostBytes_(mostBytes) {}

std::string ImportCache::keyOf(std::string_view bytes, std::string_view settings) {
  std::string key;
  for (const char byte : digest({settings, "\n", bytes}).substr(0, 20))
    key += fmt::format("{:02x}", static_cast<unsigned char>(byte));
  return key;
}

fs::path ImportCache::pathOf(const std::string& key) const { return folder_ / (key + kEnding); }

std::optional<std::string> ImportCache::find(const std::string& key) const {
  std::error_code error;
  if (folder_.empty() || !fs::is_regular_file(pathOf(key), error)) return std::nullopt;
  Result<std::string> bytes = readFile(pathOf(key));
  if (!bytes || bytes->size() < kDigestSize) return std::nullopt;
  const std::string_view entry = std::string_view(*bytes).substr(kDigestSize);
  if (digest({key, entry}) != bytes->substr(0, kDigestSize)) return std::nullopt;
  fs::last_write_time(pathOf(key), fs::file_time_type::clock::now(), error);
  bytes->erase(0, kDigestSize);
  return std::move(*bytes);
}

void ImportCache::keep(const std::string& key, std::string_view entry, const std::stop_token& stop) const {
  if (folder_.empty() || entry.size() > mostBytes_ / 2) return;
  // Not forced onto the disk, which takes long: after a crash its digest tells what is not whole.
  static std::atomic<int> made = 0;
  const fs::path making = folder_ / fmt::format("{}{}.{}.{}", key, kEnding, getpid(), made++);
  std::error_code error;
  fs::create_directories(folder_, error);
  std::ofstream file(making, std::ios::binary);
  const std::string sum = digest({key, entry});
  file.write(sum.data(), static_cast<std::streamsize>(sum.size()));
  constexpr std::size_t kPiece = std::size_t{1} << 20U;
  for (std::size_t done = 0; done < entry.size() && !stop.stop_requested(); done += kPiece) {
    const std::string_view piece = entry.substr(done, kPiece);
    file.write(piece.data(), static_cast<std::streamsize>(piece.size()));
  }
  file.close();
  const bool whole = file && !stop.stop_requested();
  if (whole) fs::rename(making, pathOf(key), error);
  if (!whole || error)
    fs::remove(making, error);
  else
    tidy();
}

void ImportCache::tidy() const {
  struct Entry {
    fs::path path;
    fs::file_time_type used;
    std::uint64_t bytes;
  };
  std::vector<Entry> entries;
  std::uint64_t total = 0;
  std::error_code error;
  for (fs::directory_iterator it(folder_, error), end; !error && it != end; it.increment(error)) {
    // Also what a run that was killed while it wrote has left.
    if (it->path().filename().string().find(kEnding) == std::string::npos) continue;
    std::error_code gone;
    Entry found{it->path(), it->last_write_time(gone), it->file_size(gone)};
    if (gone) continue;
    if (it->path().extension() != kEnding && fs::file_time_type::clock::now() - found.used > kLongestWriting) {
      fs::remove(it->path(), gone);
      continue;
    }
    total += found.bytes;
    entries.push_back(std::move(found));
  }
  std::ranges::sort(entries, {}, &Entry::used);
  for (const Entry& entry : entries) {
    if (total <= mostBytes_) break;
    if (fs::remove(entry.path, error)) total -= entry.bytes;
  }
}

}  // namespace probewright::simulation
