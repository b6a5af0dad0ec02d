#include "base/folder_swap.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

#include "base/file.hpp"

namespace probewright {
namespace {

namespace fs = std::filesystem;

/// A set that a killed run has not finished, of which one entry cannot be removed (a disk that refuses): it stays
/// marked as unfinished, and nothing of it comes into the folder, however often runs try.
TEST(FolderLock, KeepsTheMarkOfAnUnfinishedSetThatItCannotRemove) {
  std::string pattern = (fs::path(::testing::TempDir()) / "probewright-swap-XXXXXX").string();
  ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
  const fs::path parent = pattern, folder = parent / "out", aside = parent / ".out.probewright";
  fs::create_directories(folder);
  fs::create_directories(aside / "stays");  // unlink refuses a folder
  for (const char* name : {".probewright-incomplete", ".probewright.json", "new.txt"})
    ASSERT_TRUE(writeFileAtomically(aside / name, "unfinished"));
  for (int i = 0; i < 2; ++i) {
    const auto lock = FolderLock::take(folder, {}, [](const fs::path&) { return false; });
    ASSERT_TRUE(lock);
    EXPECT_TRUE(fs::is_empty(folder)) << "what is unfinished came into the folder";
    EXPECT_TRUE(fs::exists(aside / ".probewright-incomplete"));
  }
  fs::remove(aside / "stays");
  const auto lock = FolderLock::take(folder, {}, [](const fs::path&) { return false; });
  EXPECT_TRUE(lock);
  EXPECT_FALSE(fs::exists(aside));
  EXPECT_TRUE(fs::is_empty(folder));
  fs::remove_all(parent);
}

}  // namespace
}  // namespace probewright
