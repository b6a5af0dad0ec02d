#pragma once

#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

/// Values as they lie in memory, one after the other in a text.
namespace probewright::simulation {

/// What may be copied byte by byte; matrices of fixed size, too, though they do not say so.
template <class T>
inline constexpr bool isPlain = std::is_trivially_destructible_v<T>;

template <class T>
void append(std::string& bytes, const T& value) {
  static_assert(isPlain<T>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

template <class T>
void append(std::string& bytes, const std::vector<T>& values) {
  static_assert(isPlain<T>);
  append(bytes, values.size());
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

/// Each of these takes what stands at the beginning of `bytes` and removes it there; false if that is not enough.
template <class T>
bool take(std::string_view& bytes, T& value) {
  static_assert(isPlain<T>);
  if (bytes.size() < sizeof(T)) return false;
  std::memcpy(static_cast<void*>(&value), bytes.data(), sizeof(T));
  bytes.remove_prefix(sizeof(T));
  return true;
}

template <class T>
bool take(std::string_view& bytes, std::vector<T>& values) {
  static_assert(isPlain<T>);
  std::size_t count = 0;
  if (!take(bytes, count) || count > bytes.size() / sizeof(T)) return false;
  values.resize(count);
  if (count > 0) std::memcpy(static_cast<void*>(values.data()), bytes.data(), count * sizeof(T));
  bytes.remove_prefix(count * sizeof(T));
  return true;
}

}  // namespace probewright::simulation
