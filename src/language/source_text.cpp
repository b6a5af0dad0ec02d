#include "language/source_text.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "base/file.hpp"

namespace probewright::language {

namespace {

constexpr std::uint64_t largestReadWhole = 8U << 20U;
/// A mapped file gives its pages back after this many bytes.
constexpr std::uint64_t releaseStep = 8U << 20U;

}  // namespace

struct SourceText::Storage {
  std::string text;
  void* mapping = nullptr;
  std::uint64_t size = 0;
  std::uint64_t releaseAt = releaseStep;

  Storage() = default;
  Storage(const Storage&) = delete;
  Storage& operator=(const Storage&) = delete;
  ~Storage() {
    if (mapping != nullptr) ::munmap(mapping, size);
  }

  /// Lets go of everything before `offset`; touching it again only reads it from the page cache again.
  void release(std::uint64_t offset) {
    const std::uint64_t kept = offset & ~((std::uint64_t{1} << 16U) - 1);
    ::madvise(mapping, kept, MADV_DONTNEED);
    releaseAt = offset + releaseStep;
  }
};

SourceText::SourceText(std::string file, std::unique_ptr<Storage> storage)
    : file_(std::move(file)), storage_(std::move(storage)), mapped_(storage_->mapping != nullptr) {
  data_ = mapped_ ? static_cast<const char*>(storage_->mapping) : storage_->text.data();
  end_ = mapped_ ? storage_->size : storage_->text.size();
  if (bytes(0, 3) == "\xef\xbb\xbf") begin_ = 3;
  if (end_ > begin_ && data_[end_ - 1] == '\x1a') --end_;
}

SourceText::SourceText(SourceText&&) noexcept = default;
SourceText& SourceText::operator=(SourceText&&) noexcept = default;
SourceText::~SourceText() = default;

Result<SourceText> SourceText::open(const std::filesystem::path& path) {
  auto storage = std::make_unique<Storage>();
  std::error_code error;
  const bool large = std::filesystem::is_regular_file(path, error) &&
                     std::filesystem::file_size(path, error) > largestReadWhole && !error;
  if (large) {
    const auto failErrno = [&] {
      return fail(SourcePlace{path.string(), 0, 0}, std::string("cannot read this file: ") + std::strerror(errno));
    };
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) return failErrno();
    struct stat status {};
    if (::fstat(descriptor, &status) == 0) {
      storage->size = static_cast<std::uint64_t>(status.st_size);
      void* mapping = ::mmap(nullptr, storage->size, PROT_READ, MAP_PRIVATE, descriptor, 0);
      if (mapping != MAP_FAILED) storage->mapping = mapping;
    }
    const int reason = errno;
    ::close(descriptor);
    errno = reason;
    if (storage->mapping == nullptr) return failErrno();
    ::madvise(storage->mapping, storage->size, MADV_SEQUENTIAL);
  } else {
    auto text = readFile(path);
    if (!text) return tl::unexpected(text.error());
    storage->text = std::move(*text);
  }
  SourceText source(path.string(), std::move(storage));
  const std::string_view head = source.bytes(0, 2);
  if (head == "\xff\xfe" || head == "\xfe\xff") {
    return fail(SourcePlace{source.file_, 1, 1}, "this file is UTF-16, which no control can read",
                "save it as UTF-8 or in the code page of the control");
  }
  return source;
}

SourceText SourceText::of(std::string file, std::string text) {
  auto storage = std::make_unique<Storage>();
  storage->text = std::move(text);
  return SourceText(std::move(file), std::move(storage));
}

SourceLine SourceText::line(std::uint64_t offset) const {
  SourceLine line;
  if (offset >= end_) {
    line.next = end_;
    return line;
  }
  if (mapped_ && offset >= storage_->releaseAt) storage_->release(offset);
  const char* first = data_ + offset;
  const char* limit = data_ + end_;
  const auto* newline = static_cast<const char*>(std::memchr(first, '\n', static_cast<std::size_t>(limit - first)));
  const char* last = newline != nullptr ? newline : limit;
  line.next = static_cast<std::uint64_t>((newline != nullptr ? newline + 1 : limit) - data_);
  while (last != first && last[-1] == '\r')
    --last;
  line.text = std::string_view(first, static_cast<std::size_t>(last - first));
  line.exists = true;
  return line;
}

std::string_view SourceText::bytes(std::uint64_t first, std::uint64_t last) const {
  first = std::min(first, end_);
  last = std::clamp(last, first, end_);
  return std::string_view(data_ + first, static_cast<std::size_t>(last - first));
}

std::string programName(std::string_view file) {
  // Both kinds of separator, whatever this machine uses: programs name files of the control.
  if (const auto separator = file.find_last_of("/\\"); separator != std::string_view::npos) {
    file.remove_prefix(separator + 1);
  }
  if (const auto dot = file.rfind('.'); dot != std::string_view::npos && dot > 0) file = file.substr(0, dot);
  return std::string(file);
}

}  // namespace probewright::language
