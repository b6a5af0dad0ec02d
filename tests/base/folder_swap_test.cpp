#include "base/folder_swap.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <stop_token>
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

/// What a killed run has decided is done by the next one, within the folder only, whatever the list says.
TEST(FolderLock, DoesWhatWasDecidedWithinTheFolderAlone) {
  std::string pattern = (fs::path(::testing::TempDir()) / "probewright-swap-XXXXXX").string();
  ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
  const fs::path parent = pattern, folder = parent / "out", work = folder / ".probewright-swap";
  fs::create_directories(work / "new");
  ASSERT_TRUE(writeFileAtomically(parent / "outside.txt", "stays"));
  ASSERT_TRUE(writeFileAtomically(folder / "old.txt", "goes"));
  ASSERT_TRUE(writeFileAtomically(work / "new" / "new.txt", "comes"));
  ASSERT_TRUE(writeFileAtomically(work / "decided", "-../outside.txt\n+new.txt\n-old.txt\n-\n\n"));
  {
    const auto lock = FolderLock::take(folder, {}, [](const fs::path&) { return false; });
    ASSERT_TRUE(lock);
  }
  EXPECT_TRUE(fs::exists(parent / "outside.txt"));
  EXPECT_FALSE(fs::exists(folder / "old.txt"));
  EXPECT_TRUE(fs::exists(folder / "new.txt"));
  fs::remove_all(parent);
}

/// A run was killed between the step that made its set valid and the end. The next one makes plain files of that run's
/// links; links of others stay what they are, also those whose names the set has.
TEST(FolderLock, LeavesLinksOfOthersAsTheyAre) {
  std::string pattern = (fs::path(::testing::TempDir()) / "probewright-swap-XXXXXX").string();
  ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
  const fs::path parent = pattern, folder = parent / "out", work = folder / ".probewright-swap";
  fs::create_directories(work / "new");
  ASSERT_TRUE(writeFileAtomically(parent / "elsewhere.txt", "mine"));
  fs::create_symlink(parent / "elsewhere.txt", folder / "mine.txt");
  fs::create_symlink(parent / "elsewhere.txt", folder / "other.txt");
  for (const char* name : {"ours.txt", "mine.txt"})
    ASSERT_TRUE(writeFileAtomically(work / "new" / name, "ours"));
  fs::create_symlink(".probewright-swap/current/ours.txt", folder / "ours.txt");
  fs::create_symlink("new", work / "current");
  {
    const auto lock = FolderLock::take(folder, {}, [](const fs::path&) { return false; });
    ASSERT_TRUE(lock);
  }
  EXPECT_TRUE(fs::exists(folder / "ours.txt") && !fs::is_symlink(folder / "ours.txt"));
  for (const char* name : {"mine.txt", "other.txt"})
    EXPECT_EQ(fs::read_symlink(folder / name), parent / "elsewhere.txt") << name;
  fs::remove_all(parent);
}

/// A folder that others may read, or nobody else, stays so; so do files of others in it.
TEST(SwapFiles, KeepsWhoMayReadTheFolder) {
  for (const auto mode : {fs::perms(0755), fs::perms(0700), fs::perms(0770)}) {
    std::string pattern = (fs::path(::testing::TempDir()) / "probewright-swap-XXXXXX").string();
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    const fs::path parent = pattern, folder = parent / "out";
    fs::create_directories(folder);
    ASSERT_TRUE(writeFileAtomically(folder / "mine.txt", "stays"));
    fs::permissions(folder, mode);
    {
      const auto lock = FolderLock::take(folder, {}, [](const fs::path&) { return false; });
      ASSERT_TRUE(lock);
      ASSERT_TRUE(swapFiles(*lock, {{"new.txt", [](const Sink& sink) { sink("comes"); }}}, {}));
    }
    EXPECT_EQ(fs::status(folder).permissions(), mode);
    EXPECT_TRUE(fs::exists(folder / "mine.txt"));
    EXPECT_TRUE(fs::exists(folder / "new.txt"));
    fs::remove_all(parent);
  }
}

/// Whoever has to wait is told so once, and may give up.
TEST(FolderLock, WaitsForAnotherRunUntilItIsToStop) {
  std::string pattern = (fs::path(::testing::TempDir()) / "probewright-swap-XXXXXX").string();
  ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
  const fs::path folder = pattern;
  const auto isOurs = [](const fs::path&) { return false; };
  {
    const auto held = FolderLock::take(folder, {}, isOurs);
    ASSERT_TRUE(held);
    std::stop_source stop;
    int told = 0;
    const auto second = FolderLock::take(
        folder,
        [&] {
          ++told;
          stop.request_stop();
        },
        isOurs, stop.get_token());
    ASSERT_FALSE(second);
    EXPECT_NE(second.error().message.find("interrupted"), std::string::npos) << second.error().message;
    EXPECT_EQ(told, 1);
  }
  EXPECT_TRUE(FolderLock::take(folder, {}, isOurs)) << "nobody holds it any more";
  fs::remove_all(folder);
}

/// Folders that were made for files which could not be written go again, and no other folder does.
TEST(FolderLock, RemovesTheFoldersThatItHasMadeForNothing) {
  std::string pattern = (fs::path(::testing::TempDir()) / "probewright-swap-XXXXXX").string();
  ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
  const fs::path parent = pattern;
  const auto take = [](const fs::path& folder) {
    return FolderLock::take(folder, {}, [](const fs::path&) { return false; });
  };
  for (const char* name : {"a/b/c", "a/b/c/", "a"}) {
    {
      const auto lock = take(parent / name);
      ASSERT_TRUE(lock) << name;
      EXPECT_TRUE(fs::is_directory(parent / name)) << name;
    }
    EXPECT_FALSE(fs::exists(parent / "a")) << name;
    EXPECT_TRUE(fs::exists(parent)) << name;
  }
  fs::create_directories(parent / "there");
  take(parent / "there");
  EXPECT_TRUE(fs::exists(parent / "there"));
  {
    const auto lock = take(parent / "new/out");
    ASSERT_TRUE(lock);
    ASSERT_TRUE(swapFiles(*lock, {{"a.txt", [](const Sink& sink) { sink("text"); }}}, {}));
  }
  EXPECT_TRUE(fs::exists(parent / "new/out/a.txt"));
  {
    const auto lock = take(parent / "new/other");
    ASSERT_TRUE(lock);
  }
  EXPECT_FALSE(fs::exists(parent / "new/other"));
  EXPECT_TRUE(fs::exists(parent / "new"));
  fs::remove_all(parent);
}

}  // namespace
}  // namespace probewright
