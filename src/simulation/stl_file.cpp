#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstring>
#include <string_view>
#include <unordered_map>

#include "base/file.hpp"
#include "base/text.hpp"
#include "simulation/triangle_mesh.hpp"

namespace probewright::simulation {
namespace {

constexpr std::size_t kHeaderSize = 84;
constexpr std::size_t kFacetSize = 50;

struct PointHash {
  std::size_t operator()(const std::array<double, 3>& p) const {
    std::uint64_t hash = 0x9E3779B97F4A7C15U;
    for (double value : p) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &value, sizeof bits);
      hash = (hash ^ bits) * 0xD6E8FEB86659FD93U;
      hash ^= hash >> 32;
    }
    return hash;
  }
};

class MeshBuilder {
public:
  void reserve(std::size_t triangles) {
    mesh_.triangles.reserve(triangles);
    mesh_.corners.reserve(triangles / 2 + 3);
    known_.reserve(triangles / 2 + 3);
  }

  void add(const std::array<Vector3, 3>& points) {
    if ((points[1] - points[0]).cross(points[2] - points[0]).squaredNorm() <= 0) return;
    mesh_.triangles.push_back({corner(points[0]), corner(points[1]), corner(points[2])});
  }

  TriangleMesh take() { return std::move(mesh_); }

private:
  std::uint32_t corner(const Vector3& p) {
    // Adding zero turns -0 into +0, which compares equal but hashes differently.
    const auto [place, isNew] =
        known_.try_emplace({p.x() + 0.0, p.y() + 0.0, p.z() + 0.0}, static_cast<std::uint32_t>(mesh_.corners.size()));
    if (isNew) mesh_.corners.push_back(p);
    return place->second;
  }

  TriangleMesh mesh_;
  std::unordered_map<std::array<double, 3>, std::uint32_t, PointHash> known_;
};

template <class Number>
Number littleEndian(const char* bytes) {
  Number value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

/// Triangles between two looks at whether to go on.
constexpr std::size_t kBetweenLooks = 4096;

Result<TriangleMesh> readBinary(std::string_view bytes, const std::string& file, ImportWatch& watch) {
  const auto count = littleEndian<std::uint32_t>(bytes.data() + 80);
  MeshBuilder builder;
  builder.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (i % kBetweenLooks == 0) watch.tell("reading the triangles", i, count);
    const char* facet = bytes.data() + kHeaderSize + kFacetSize * i + 12;
    std::array<Vector3, 3> points;
    for (std::size_t k = 0; k < 9; ++k) {
      const float value = littleEndian<float>(facet + 4 * k);
      if (!std::isfinite(value) || std::abs(value) > 1e7F) {
        return fail({file, 0, 0}, fmt::format("triangle {} of {} has a coordinate that is not a length", i + 1, count),
                    "export the part again from the CAD system, in mm");
      }
      points[k / 3][static_cast<Eigen::Index>(k % 3)] = static_cast<double>(value);
    }
    builder.add(points);
  }
  return builder.take();
}

/// The words of an ASCII STL with the line they are in.
class Words {
public:
  explicit Words(std::string_view text) : text_(text) {}

  std::uint64_t line() const { return line_; }

  std::string_view next() {
    while (at_ < text_.size() && isSpace(text_[at_]))
      skip();
    const std::size_t start = at_;
    while (at_ < text_.size() && !isSpace(text_[at_]))
      ++at_;
    return text_.substr(start, at_ - start);
  }

  void skipLine() {
    while (at_ < text_.size() && text_[at_] != '\n')
      ++at_;
  }

private:
  static bool isSpace(char c) { return isBlankOrReturn(c) || c == '\n'; }

  void skip() {
    if (text_[at_] == '\n') ++line_;
    ++at_;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::uint64_t line_ = 1;
};

bool isWord(std::string_view word, std::string_view lowerCase) {
  return word.size() == lowerCase.size() && std::equal(word.begin(), word.end(), lowerCase.begin(), [](char a, char b) {
           return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
         });
}

Result<TriangleMesh> readAscii(std::string_view text, const std::string& file, ImportWatch& watch) {
  Words words(text);
  MeshBuilder builder;
  const auto broken = [&](std::string_view expected, std::string_view found) {
    auto error = fail({file, words.line(), 0},
                      found.empty() ? fmt::format("the STL file ends where {} was expected", expected)
                                    : fmt::format("expected {} in the STL file", expected),
                      "the file is damaged or not an STL file; export the part again");
    error.value().excerpt = std::string(found.substr(0, 60));
    return error;
  };
  words.next();
  words.skipLine();
  for (std::size_t i = 0;; ++i) {
    if (i % kBetweenLooks == 0) watch.tell(fmt::format("reading triangle {}", i + 1), 0, 0);
    std::string_view word = words.next();
    if (isWord(word, "endsolid")) {
      words.skipLine();
      word = words.next();
      if (word.empty()) break;
      if (!isWord(word, "solid")) return broken("\"solid\" or the end of the file", word);
      words.skipLine();
      continue;
    }
    if (!isWord(word, "facet")) return broken("\"facet\" or \"endsolid\"", word);
    words.skipLine();
    if (word = words.next(); !isWord(word, "outer")) return broken("\"outer loop\"", word);
    if (word = words.next(); !isWord(word, "loop")) return broken("\"outer loop\"", word);
    std::array<Vector3, 3> points;
    for (Vector3& point : points) {
      if (word = words.next(); !isWord(word, "vertex")) return broken("\"vertex\"", word);
      for (Eigen::Index k = 0; k < 3; ++k) {
        word = words.next();
        const std::string_view digits = word.substr(!word.empty() && word.front() == '+' ? 1 : 0);
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), point[k]);
        if (error != std::errc{} || end != digits.data() + digits.size() || !(std::abs(point[k]) <= 1e7)) {
          return broken("a coordinate in mm", word);
        }
      }
    }
    if (word = words.next(); !isWord(word, "endloop")) return broken("\"endloop\"", word);
    if (word = words.next(); !isWord(word, "endfacet")) return broken("\"endfacet\"", word);
    builder.add(points);
  }
  return builder.take();
}

}  // namespace

Result<TriangleMesh> readStlMesh(const std::filesystem::path& path, ImportWatch& watch) {
  const Result<std::string> bytes = readFile(path);
  if (!bytes) return tl::unexpected(bytes.error());
  const std::string file = path.string();
  // Some writers begin binary files with "solid" too, so the size decides first.
  bool binary = false;
  std::size_t expected = 0;
  if (bytes->size() >= kHeaderSize) {
    expected = kHeaderSize + kFacetSize * static_cast<std::size_t>(littleEndian<std::uint32_t>(bytes->data() + 80));
    binary = bytes->size() == expected;
  }
  Result<TriangleMesh> mesh;
  if (binary) {
    mesh = readBinary(*bytes, file, watch);
  } else if (isWord(Words(*bytes).next(), "solid")) {
    mesh = readAscii(*bytes, file, watch);
  } else if (bytes->size() >= kHeaderSize && bytes->size() < expected) {
    return fail(
        {file, 0, 0},
        fmt::format("the binary STL file has {} bytes where its count of triangles needs {}", bytes->size(), expected),
        "the file was cut short or is not an STL file; export or copy it again");
  } else {
    std::string message =
        "not an STL file: it does not begin with \"solid\", and its size does not fit its count of triangles";
    if (bytes->size() >= kHeaderSize)
      message += fmt::format(" ({} bytes expected, it has {})", expected, bytes->size());
    return fail({file, 0, 0}, std::move(message),
                "export the part as STL, or name a STEP or IGES file with its own extension");
  }
  if (mesh && mesh->triangles.empty()) {
    return fail({file, 0, 0}, "the STL file holds no triangle with an area", "export the part again as a solid body");
  }
  return mesh;
}

}  // namespace probewright::simulation
