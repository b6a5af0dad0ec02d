#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <random>
#include <string>

#include "geometry/primitives.hpp"

/// Random worlds and an independent way to find contacts, shared by the tests of solids.
namespace probewright::simulation::testing {

inline double uniform(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

inline Vector3 randomDirection(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Vector3 v;
  do {
    v = Vector3(normal(random), normal(random), normal(random));
  } while (v.norm() < 1e-3);
  return v.normalized();
}

inline Vector3 randomPoint(std::mt19937_64& random, double reach) {
  return {uniform(random, -reach, reach), uniform(random, -reach, reach), uniform(random, -reach, reach)};
}

inline Pose randomPose(std::mt19937_64& random, double reach) {
  return translation(randomPoint(random, reach)) * rotation(randomDirection(random), uniform(random, -180, 180));
}

/// A folder that lives as long as the test.
class ScratchFolder {
public:
  ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "solids-test-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~ScratchFolder() { std::filesystem::remove_all(path_); }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path_ / name, std::ios::binary) << bytes;
    return path_ / name;
  }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

private:
  std::filesystem::path path_;
};

/// The way to the first contact, found by walking: `distance` never changes faster than the position, so the ball may
/// always travel as far as its gap. Nothing if the way is free; a grazing way that the walk cannot decide gives NaN.
inline std::optional<double> walkToContact(const std::function<double(const Vector3&)>& distance, const Vector3& from,
                                           const Vector3& to, double radius) {
  const double length = (to - from).norm();
  const Vector3 direction = (to - from) / length;
  double travelled = 0;
  for (int i = 0; i < 4000; ++i) {
    const double gap = distance(from + travelled * direction) - radius;
    if (gap < 1e-11) return travelled;
    travelled += gap;
    if (travelled > length) return std::nullopt;
  }
  return std::nan("");
}

}  // namespace probewright::simulation::testing
