#pragma once

#include <cstdint>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>

/// Bytes that processes of the same program exchange, or that one of them keeps for later.
namespace probewright::study {

template <class Value>
void put(std::string& message, const Value& value) {
  static_assert(std::is_trivially_copyable_v<Value>);
  const auto* bytes = reinterpret_cast<const char*>(&value);
  message.append(bytes, sizeof value);
}

inline void put(std::string& message, const std::string& text) {
  put(message, static_cast<std::uint32_t>(text.size()));
  message += text;
}

inline void put(std::string& message, const std::optional<double>& value) {
  put(message, static_cast<std::uint8_t>(value ? 1 : 0));
  if (value) put(message, *value);
}

/// Seven bits a byte, the lowest first.
inline void putCount(std::string& message, std::uint64_t count) {
  for (; count >= 0x80; count >>= 7U)
    message += static_cast<char>(count | 0x80U);
  message += static_cast<char>(count);
}

/// Reads what was put. Throws if the message ends before.
class MessageReading {
public:
  explicit MessageReading(const std::string& message) : message_(message) {}

  template <class Value>
  Value get() {
    Value value;
    std::memcpy(&value, take(sizeof value), sizeof value);
    return value;
  }
  std::string text() {
    const auto size = get<std::uint32_t>();
    return {take(size), size};
  }
  std::optional<double> optional() { return get<std::uint8_t>() == 1 ? std::optional(get<double>()) : std::nullopt; }
  std::uint64_t count() {
    std::uint64_t count = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
      const auto byte = get<std::uint8_t>();
      count |= static_cast<std::uint64_t>(byte & 0x7FU) << shift;
      if (byte < 0x80) break;
    }
    return count;
  }

private:
  const char* take(std::size_t count) {
    if (message_.size() - at_ < count) throw std::runtime_error("a message between ranks is not whole");
    at_ += count;
    return message_.data() + (at_ - count);
  }

  const std::string& message_;
  std::size_t at_ = 0;
};

}  // namespace probewright::study
