#pragma once

#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace probewright::reports {

/// RFC 4648.
inline std::string base64(std::string_view text) {
  using namespace boost::archive::iterators;
  using Encode = base64_from_binary<transform_width<const char*, 6, 8>>;
  std::string bytes(text);
  // The encoder reads whole groups of three bytes.
  const std::size_t missing = (3 - bytes.size() % 3) % 3;
  bytes.append(missing, '\0');
  std::string encoded(Encode(bytes.data()), Encode(bytes.data() + bytes.size()));
  encoded.replace(encoded.size() - missing, missing, missing, '=');
  return encoded;
}

/// A typed array as the page reads it: little-endian.
template <class T>
std::string base64(const std::vector<T>& values) {
  static_assert(std::is_trivially_copyable_v<T>);
  return base64(std::string_view(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)));
}

}  // namespace probewright::reports
