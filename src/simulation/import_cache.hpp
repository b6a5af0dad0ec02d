#pragma once

#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>

/// Imported parts kept in a folder, so that the next run need not read and mesh them again.
namespace probewright::simulation {

class ImportCache {
public:
  /// `folder` is made when something is written; an empty one keeps nothing.
  explicit ImportCache(std::filesystem::path folder, std::uint64_t mostBytes = std::uint64_t{512} << 20U);

  /// What an import made of a file with these `bytes`; `settings` is everything else it depends on.
  static std::string keyOf(std::string_view bytes, std::string_view settings);

  /// What was kept under `key`. Nothing if there is no such entry, or one that is damaged.
  std::optional<std::string> find(const std::string& key) const;

  /// Keeps an entry and removes those that were not used for the longest time until the
  /// folder has at most the bytes it may have. What cannot be written is not kept: a cache is not a reason to fail.
  /// A stop leaves nothing of the entry.
  void keep(const std::string& key, std::string_view entry, const std::stop_token& stop = {}) const;

private:
  std::filesystem::path pathOf(const std::string& key) const;
  void tidy() const;

  std::filesystem::path folder_;
  std::uint64_t mostBytes_;
};

}  // namespace probewright::simulation
