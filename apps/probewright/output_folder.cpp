#include "output_folder.hpp"

#include <openssl/evp.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/writable_folder.hpp"

namespace probewright::app {

namespace fs = std::filesystem;

namespace {

constexpr const char* listTitle = "the files of a Probewright run and their SHA-256";
constexpr std::uint64_t largestList = std::uint64_t{64} << 20U;

class Checksum {
public:
  Checksum() : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free) { EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr); }
  void add(std::string_view bytes) { EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()); }
  std::string text() {
    unsigned char digest[EVP_MAX_MD_SIZE];
    unsigned int size = 0;
    EVP_DigestFinal_ex(context_.get(), digest, &size);
    static constexpr char digits[] = "0123456789abcdef";
    std::string text;
    for (unsigned int i = 0; i < size; ++i) {
      text += digits[digest[i] >> 4U];
      text += digits[digest[i] & 15U];
    }
    return text;
  }

private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

using Checksums = std::map<std::string, std::string>;

/// A list may have come from anywhere: only plain names of files in the folder itself count.
bool isPlainName(const std::string& name) {
  return !name.empty() && name != "." && name != ".." && name.find('/') == std::string::npos &&
         name.find('\0') == std::string::npos;
}

/// The list of a folder; nothing if there is none that can be read.
std::optional<Checksums> listIn(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_regular_file(fs::symlink_status(folder / listName, error))) return std::nullopt;
  const Result<std::string> text = readFile(folder / listName, largestList);
  const auto list = nlohmann::json::parse(text.value_or(""), nullptr, false);
  if (!list.is_object() || list.value("title", nlohmann::json()) != listTitle) return std::nullopt;
  const auto files = list.find("files");
  if (files == list.end() || !files->is_object()) return std::nullopt;
  Checksums checksums;
  for (const auto& [name, checksum] : files->items()) {
    if (isPlainName(name) && checksum.is_string()) checksums.emplace(name, checksum.get<std::string>());
  }
  return checksums;
}

/// Read piece by piece: the report of a long run is larger than what is wanted of memory.
bool isUnchanged(const fs::path& file, const std::string& checksum) {
  std::error_code error;
  if (!fs::is_regular_file(fs::symlink_status(file, error))) return false;
  std::ifstream stream(file, std::ios::binary);
  Checksum now;
  std::vector<char> piece(std::size_t{1} << 20U);
  while (stream.read(piece.data(), static_cast<std::streamsize>(piece.size())), stream.gcount() > 0)
    now.add({piece.data(), static_cast<std::size_t>(stream.gcount())});
  return stream.eof() && now.text() == checksum;
}

/// The entries of the list that are true.
Checksums trueEntries(const fs::path& folder) {
  Checksums entries = listIn(folder).value_or(Checksums{});
  std::erase_if(entries, [&](const auto& entry) { return !isUnchanged(folder / entry.first, entry.second); });
  return entries;
}

std::string listText(const Checksums& checksums) {
  return nlohmann::json{{"title", listTitle}, {"files", checksums}}.dump(2) + "\n";
}

/// A file in a folder that is one of the set its list names, or the list.
bool isListed(const fs::path& file) {
  const std::optional<Checksums> list = listIn(file.parent_path());
  if (!list) return false;
  if (file.filename() == listName) return true;
  const auto entry = list->find(file.filename().string());
  return entry != list->end() && isUnchanged(file, entry->second);
}

Result<FolderLock> lock(const fs::path& folder, const std::stop_token& stop) {
  const auto onWait = [&] { std::fprintf(stderr, "another run writes into %s: waiting for it\n", folder.c_str()); };
  return FolderLock::take(folder, onWait, isListed, stop);
}

Diagnostic notOurs(const fs::path& file) {
  return {Severity::Error,
          {file.string(), 0, 0},
          "this file is not one that an earlier run left, or it was changed since: the run does not replace it",
          {},
          "move it elsewhere, or name another folder with --out",
          {}};
}

bool isThere(const fs::path& path) {
  std::error_code error;
  return fs::symlink_status(path, error).type() != fs::file_type::not_found;
}

/// Replaces the set of `before` by `files` and what is left of `before` without `dropped`.
Result<void> replaceSet(const FolderLock& lock, const Checksums& before,
                        const std::vector<std::pair<std::string, Content>>& files,
                        const std::function<bool(const std::string& name)>& goes, const std::stop_token& stop) {
  Checksums after;
  std::set<std::string> dropped;
  for (const auto& [name, checksum] : before) {
    const bool replaced = std::ranges::any_of(files, [&name = name](const auto& file) { return file.first == name; });
    if (!replaced && goes(name)) dropped.insert(name);
    if (!replaced && !goes(name)) after.emplace(name, checksum);
  }
  std::vector<std::pair<std::string, Content>> all;
  for (const auto& [name, content] : files) {
    all.emplace_back(name, [&after, &name = name, &content = content](const Sink& sink) {
      Checksum checksum;
      content([&](std::string_view bytes) {
        checksum.add(bytes);
        sink(bytes);
      });
      after[name] = checksum.text();
    });
  }
  if (files.empty() && after.empty()) {
    dropped.insert(listName);
  } else {
    all.emplace_back(listName, [&after](const Sink& sink) { sink(listText(after)); });
  }
  return swapFiles(lock, all, dropped, stop);
}

Result<void> removeWhat(const fs::path& folder, const std::set<FileIdentity>& inputs,
                        const std::function<bool(const std::string& name)>& mayGo) {
  const auto goes = [&](const std::string& name) {
    return mayGo(name) && !inputs.contains(identityOf(folder / name).value_or(FileIdentity{}));
  };
  std::error_code error;
  if (!fs::is_directory(folder, error)) return {};
  const Result<FolderLock> held = lock(folder, {});
  if (!held) return tl::unexpected(held.error());
  const Checksums before = trueEntries(folder);
  if (std::ranges::none_of(before, [&](const auto& entry) { return goes(entry.first); })) return {};
  return replaceSet(*held, before, {}, goes, {});
}

/// In a folder where everybody writes, and only the owner of a file may replace it (/tmp), the set of another user
/// stays.
Result<void> othersInSticky(const fs::path& folder) {
  struct stat above {};
  struct stat list {};
  const bool theirs = ::geteuid() != 0 && ::stat(folder.c_str(), &above) == 0 && (above.st_mode & S_ISVTX) != 0 &&
                      above.st_uid != ::geteuid() && ::lstat((folder / listName).c_str(), &list) == 0 &&
                      list.st_uid != ::geteuid();
  if (!theirs) return {};
  return fail({(folder / listName).string(), 0, 0},
              "this is of a run of another user, who alone may replace its files in this folder",
              "name another folder with --out");
}

bool isVerdict(const std::string& name) { return name == "results.json" || name == "report.html"; }

}  // namespace

std::set<std::string> leftByEarlierRun(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& [name, checksum] : trueEntries(folder))
    names.insert(name);
  return names;
}

Result<void> prepareOutput(const fs::path& folder, const std::stop_token& stop) {
  if (Result<void> writable = checkWritable(folder); !writable) return writable;
  std::error_code error;
  if (!fs::is_directory(folder, error)) return {};
  const Result<FolderLock> held = lock(folder, stop);
  if (!held) return tl::unexpected(held.error());
  return othersInSticky(held->folder());
}

std::optional<Diagnostic> whyNotWritable(const fs::path& folder, const std::string& name) {
  const fs::path file = folder / name;
  std::error_code error;
  if (!isThere(file) || isListed(file) || isOnItsWay(file)) return std::nullopt;
  if (!fs::is_directory(fs::symlink_status(file, error))) return notOurs(file);
  return Diagnostic{Severity::Error,
                    {file.string(), 0, 0},
                    "cannot write this file: a folder has its name",
                    {},
                    "rename the folder, or name another one with --out",
                    {}};
}

Result<void> writeOutput(const Output& output, const std::stop_token& stop) {
  const Result<FolderLock> held = lock(output.folder, stop);
  if (!held) return tl::unexpected(held.error());
  const Checksums before = trueEntries(output.folder);
  if (isThere(output.folder / listName) && !listIn(output.folder))
    return tl::unexpected(notOurs(output.folder / listName));
  for (const auto& [name, content] : output.files) {
    const fs::path file = output.folder / name;
    std::error_code error;
    if (!isThere(file) || fs::is_directory(fs::symlink_status(file, error))) continue;
    if (!before.contains(name)) return tl::unexpected(notOurs(file));
    if (output.inputs.contains(identityOf(file).value_or(FileIdentity{}))) {
      return fail({file.string(), 0, 0}, "the run has read this file, and does not replace it",
                  "name another folder with --out");
    }
  }
  const auto goes = [&](const std::string& name) {
    return !output.inputs.contains(identityOf(output.folder / name).value_or(FileIdentity{}));
  };
  return replaceSet(*held, before, output.files, goes, stop);
}

Result<void> removeEarlierRun(const fs::path& folder, const fs::path& tables, const std::set<FileIdentity>& inputs) {
  std::error_code error;
  const bool begins = !tables.empty() && fs::equivalent(folder, tables, error);
  return removeWhat(folder, inputs, [&](const std::string& name) { return !begins || isVerdict(name); });
}

Result<void> removeEarlierVerdict(const fs::path& folder, const std::set<FileIdentity>& inputs) {
  return removeWhat(folder, inputs, isVerdict);
}

}  // namespace probewright::app
