#include "simulation/imported_part.hpp"

namespace probewright::simulation {
namespace {

constexpr std::string_view kTitle = "Probewright part 4\n";

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
  std::optional<std::string_view> text() {
    const auto size = number();
    if (!size || *size > rest_.size()) return std::nullopt;
    const std::string_view value = rest_.substr(0, *size);
    rest_.remove_prefix(*size);
    return value;
  }
  bool atEnd() const { return rest_.empty(); }
  std::size_t left() const { return rest_.size(); }

private:
  std::string_view rest_;
};

}  // namespace

std::string toBytes(const ImportedPart& part) {
  std::string bytes;
  bytes.reserve(part.shape.size() + part.elements.size() + 1000);
  bytes += kTitle;
  put(bytes, std::uint64_t{part.remarks.size()});
  for (const Diagnostic& remark : part.remarks) {
    put(bytes, remark.place.line);
    put(bytes, remark.message);
    put(bytes, remark.advice);
  }
  put(bytes, part.shape);
  put(bytes, part.elements);
  return bytes;
}

std::optional<ImportedPart> partFromBytes(std::string bytes) {
  const auto kept = std::make_shared<const std::string>(std::move(bytes));
  Reader reader(*kept);
  if (!reader.title()) return std::nullopt;
  const auto count = reader.number();
  if (!count || *count > reader.left() / 24) return std::nullopt;
  ImportedPart part;
  part.storage = kept;
  for (std::uint64_t i = 0; i < *count; ++i) {
    const auto line = reader.number();
    const auto message = reader.text(), advice = reader.text();
    if (!line || !message || !advice) return std::nullopt;
    part.remarks.push_back({Severity::Warning, {{}, *line, 0}, std::string(*message), {}, std::string(*advice), {}});
  }
  const auto shape = reader.text(), elements = reader.text();
  if (!shape || !elements || !reader.atEnd()) return std::nullopt;
  part.shape = *shape;
  part.elements = *elements;
  return part;
}

}  // namespace probewright::simulation
