#include "simulation/imported_part.hpp"

#include <cstring>

namespace probewright::simulation {
namespace {

constexpr std::string_view kTitle = "Probewright part 3\n";

void put(std::string& bytes, std::uint64_t number) {
  for (int i = 0; i < 8; ++i)
    bytes += static_cast<char>((number >> (8 * i)) & 0xFFU);
}

void put(std::string& bytes, std::string_view text) {
  put(bytes, std::uint64_t{text.size()});
  bytes += text;
}

class Reader {
public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}

  bool title() {
    if (!rest_.starts_with(kTitle)) return false;
    rest_.remove_prefix(kTitle.size());
    return true;
  }
  std::optional<std::uint64_t> number() {
    if (rest_.size() < 8) return std::nullopt;
    std::uint64_t value = 0;
    for (std::size_t i = 8; i-- > 0;)
      value = value << 8U | static_cast<unsigned char>(rest_[i]);
    rest_.remove_prefix(8);
    return value;
  }
  std::optional<std::string> text() {
    const auto size = number();
    if (!size || *size > rest_.size()) return std::nullopt;
    std::string value(rest_.substr(0, *size));
    rest_.remove_prefix(*size);
    return value;
  }
  bool skip(std::uint64_t size) {
    if (size > rest_.size()) return false;
    rest_.remove_prefix(size);
    return true;
  }
  bool atEnd() const { return rest_.empty(); }
  std::size_t left() const { return rest_.size(); }

private:
  std::string_view rest_;
};

}  // namespace

std::string toBytes(const ImportedPart& part) {
  std::string bytes;
  bytes.reserve(part.brep.size() + part.elements.size() + part.drawing.size() + 1000);
  bytes += kTitle;
  put(bytes, std::uint64_t{part.remarks.size()});
  for (const Diagnostic& remark : part.remarks) {
    put(bytes, remark.place.line);
    put(bytes, remark.message);
    put(bytes, remark.advice);
  }
  put(bytes, part.brep);
  put(bytes, part.elements);
  put(bytes, part.drawing);
  return bytes;
}

std::optional<ImportedPart> partFromBytes(std::string bytes) {
  Reader reader(bytes);
  if (!reader.title()) return std::nullopt;
  const auto count = reader.number();
  if (!count || *count > reader.left() / 24) return std::nullopt;
  ImportedPart part;
  for (std::uint64_t i = 0; i < *count; ++i) {
    const auto line = reader.number();
    auto message = reader.text(), advice = reader.text();
    if (!line || !message || !advice) return std::nullopt;
    part.remarks.push_back({Severity::Warning, {{}, *line, 0}, std::move(*message), {}, std::move(*advice), {}});
  }
  auto brep = reader.text();
  const auto size = reader.number();
  const std::size_t first = bytes.size() - reader.left();
  if (!brep || !size || !reader.skip(*size)) return std::nullopt;
  auto drawing = reader.text();
  if (!drawing || !reader.atEnd()) return std::nullopt;
  part.brep = std::move(*brep);
  part.drawing = std::move(*drawing);
  // Nearly all of the bytes: they stay where they are.
  part.elements = std::move(bytes);
  part.elements.resize(first + *size);
  part.elements.erase(0, first);
  return part;
}

}  // namespace probewright::simulation
