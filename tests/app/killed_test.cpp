#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>

#include "app/program.hpp"
#include "base/folder_swap.hpp"

/// A run that ends in the middle of writing: killed, or refused by the disk, at each call that changes a file.
namespace probewright::app::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::AnyOf;
using ::testing::ElementsAre;
using ::testing::Eq;
using ::testing::IsEmpty;

using Texts = std::map<std::string, std::string>;

const Texts older = {{"PRESET.PR", "old preset"}, {"LOG.TXT", "old log"}, {"results.json", "old"}};
const Texts newer = {{"PRESET.PR", "new preset"}, {"NEW.TXT", "new log"}, {"results.json", "new"}};

struct Fault {
  long at = 0;  ///< the number of the call; 0: none
  std::string how = "kill";
  bool withoutLinks = false;  ///< on a file system like that of a memory stick
  long sync = 0;              ///< the number of the fsync that fails; 0: none
};

/// The exit code of the writer; -1 if it was killed.
int writeSet(const fs::path& folder, const Texts& files, const Fault& fault = {}, const fs::path& count = {}) {
  std::vector<std::string> words = {PROBEWRIGHT_FOLDER_WRITER, folder.string()};
  for (const auto& [name, text] : files)
    words.push_back(name + "=" + text);
  std::vector<char*> arguments;
  for (std::string& word : words)
    arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    dup2(open("/dev/null", O_WRONLY), STDERR_FILENO);
    setenv("LD_PRELOAD", PROBEWRIGHT_FAILING_CALLS, 1);
    setenv("FAIL_AT", std::to_string(fault.at).c_str(), 1);
    setenv("FAIL_HOW", fault.how.c_str(), 1);
    if (fault.withoutLinks) setenv("FAIL_LINKS", "1", 1);
    if (fault.sync != 0) setenv("FAIL_SYNC", std::to_string(fault.sync).c_str(), 1);
    if (!count.empty()) setenv("FAIL_COUNT", count.c_str(), 1);
    if (chdir("/") != 0) _exit(127);
    execv(arguments[0], arguments.data());
    _exit(127);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// What somebody who opens the files of the folder by their names finds.
Texts filesIn(const fs::path& folder) {
  Texts texts;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.front() != '.' && entry.is_regular_file()) texts.emplace(name, textOf(entry.path()));
  }
  return texts;
}

Texts with(Texts texts, const std::string& name, const std::string& text) {
  texts.emplace(name, text);
  return texts;
}

/// A folder with the old set and a user's file; a subfolder, which rules out exchanging the folder, if asked for.
class World {
public:
  explicit World(bool subfolder) {
    static const Folder first;
    if (!fs::exists(first / "out")) {
      EXPECT_EQ(writeSet(first / "out", older), 0);
      first.file("out/mine.txt", "mine");
    }
    fs::copy(first / "out", out(), fs::copy_options::recursive);
    if (subfolder) {
      fs::create_directory(out() / "sub");
      folder_.file("out/sub/deep.txt", "deep");
    }
    inode_ = inodeOf(out() / "mine.txt");
  }

  fs::path out() const { return folder_ / "out"; }
  fs::path count() const { return folder_ / "count"; }
  std::vector<std::string> neighbours() const {
    std::vector<std::string> names = namesIn(folder_ / "");
    std::erase(names, "count");
    return names;
  }
  bool keptTheUsersFile() const { return inodeOf(out() / "mine.txt") == inode_; }

  static ino_t inodeOf(const fs::path& path) {
    struct stat status {};
    return ::stat(path.c_str(), &status) == 0 ? status.st_ino : 0;
  }

private:
  Folder folder_;
  ino_t inode_ = 0;
};

/// What a run finds there as soon as it has the lock.
Texts nextFinds(const fs::path& folder) {
  const auto held = FolderLock::take(folder, {}, [](const fs::path&) { return true; });
  EXPECT_TRUE(held) << format(held.error());
  return filesIn(folder);
}

class Killed : public ::testing::TestWithParam<bool> {
protected:
  void SetUp() override {
    if (!PROBEWRIGHT_OPTIMIZED) GTEST_SKIP() << "sanitizers and preloaded libraries do not go together";
  }
};

TEST_P(Killed, LeavesTheOldSetOrTheNewOneAtEachCall) {
  const Texts before = with(older, "mine.txt", "mine"), after = with(newer, "mine.txt", "mine");
  const std::vector<std::string> names =
      GetParam()
          ? std::vector<std::string>{".probewright.json", "NEW.TXT", "PRESET.PR", "mine.txt", "results.json", "sub"}
          : std::vector<std::string>{".probewright.json", "NEW.TXT", "PRESET.PR", "mine.txt", "results.json"};
  long calls = 1000;
  int old = 0, changed = 0;
  for (long at = 1; at <= calls; ++at) {
    const World world(GetParam());
    const int end = writeSet(world.out(), newer, {at, "kill"}, world.count());
    if (end != -1) {  // fewer calls than this
      calls = std::stol(textOf(world.count()));
      ASSERT_EQ(end, 0);
      ASSERT_EQ(at, calls + 1);
      break;
    }
    const Texts found = filesIn(world.out());
    ASSERT_THAT(found, AnyOf(Eq(before), Eq(after))) << "killed in front of call " << at;
    ++(found == before ? old : changed);
    ASSERT_TRUE(world.keptTheUsersFile()) << at;
    // The next run clears up.
    ASSERT_EQ(writeSet(world.out(), newer), 0) << at;
    ASSERT_EQ(filesIn(world.out()), after) << at;
    ASSERT_EQ(namesIn(world.out()), names) << at;
    ASSERT_THAT(world.neighbours(), ElementsAre("out")) << at;
    ASSERT_TRUE(world.keptTheUsersFile()) << at;
    if (GetParam()) {
      ASSERT_EQ(textOf(world.out() / "sub/deep.txt"), "deep");
    }
  }
  EXPECT_GT(old, 10);
  EXPECT_GT(changed, 3);
}

TEST_P(Killed, LeavesTheOldSetOrTheNewOneWhereADiskFails) {
  const Texts before = with(older, "mine.txt", "mine"), after = with(newer, "mine.txt", "mine");
  long calls = 1000;
  for (long at = 1; at <= calls; ++at) {
    const World world(GetParam());
    const int end = writeSet(world.out(), newer, {at, std::to_string(at % 2 == 0 ? EIO : ENOSPC)}, world.count());
    calls = std::stol(textOf(world.count()));
    ASSERT_THAT(end, AnyOf(0, 2)) << at;
    // A failure behind the step itself leaves the new set, which may still have to be tidied.
    ASSERT_THAT(filesIn(world.out()), AnyOf(Eq(before), Eq(after))) << "call " << at << " failed";
    if (end == 0) {
      ASSERT_EQ(filesIn(world.out()), after) << at;
    }
    ASSERT_EQ(writeSet(world.out(), newer), 0) << at;
    ASSERT_EQ(filesIn(world.out()), after) << at;
    ASSERT_THAT(world.neighbours(), ElementsAre("out")) << at;
    ASSERT_TRUE(world.keptTheUsersFile()) << at;
  }
}

/// A power cut after the step must find the new files on the disk, and the folder that names them.
TEST_P(Killed, HasTheNewFilesAndTheirFolderOnTheDiskBeforeTheyCount) {
  const Texts before = with(older, "mine.txt", "mine");
  std::size_t flushed = 0;
  for (long sync = 1;; ++sync) {
    const World world(GetParam());
    const int end = writeSet(world.out(), newer, {.sync = sync});
    if (filesIn(world.out()) != before) break;
    ASSERT_EQ(end, 2) << sync;
    ASSERT_LT(++flushed, 100U);
  }
  EXPECT_GE(flushed, newer.size() + 2) << "the files, the list of them, the folder";
}

TEST_P(Killed, IsWholeAgainAfterTheNextRunWhereThereAreNoLinks) {
  const Texts before = with(older, "mine.txt", "mine"), after = with(newer, "mine.txt", "mine"),
              third = {{"THIRD.TXT", "third"}, {"mine.txt", "mine"}};
  int mixed = 0;
  for (long at = 1; at < 1000; ++at) {
    for (const std::string& how : {std::string("kill"), std::to_string(EIO)}) {
      const World world(GetParam());
      const int end = writeSet(world.out(), newer, {at, how, true}, world.count());
      const long calls = end == -1 ? at : std::stol(textOf(world.count()));
      if (calls < at) {
        ASSERT_EQ(end, 0);
        EXPECT_EQ(filesIn(world.out()), after);
        EXPECT_GT(mixed, 0) << "what the next run mends";
        return;
      }
      const Texts left = filesIn(world.out());
      mixed += left != before && left != after ? 1 : 0;
      // The next one takes the lock, which clears up, and fails as soon as it writes.
      ASSERT_THAT(nextFinds(world.out()), AnyOf(Eq(before), Eq(after))) << "call " << at << ", " << how;
      ASSERT_EQ(writeSet(world.out(), {{"THIRD.TXT", "third"}}, {0, {}, true}), 0) << at;
      ASSERT_EQ(filesIn(world.out()), third) << at;
      ASSERT_TRUE(world.keptTheUsersFile()) << at;
    }
  }
  FAIL() << "no end";
}

TEST_P(Killed, RemovesASetInOneStepToo) {
  const Texts before = with(older, "mine.txt", "mine"), after = {{"mine.txt", "mine"}};
  for (long at = 1; at < 1000; ++at) {
    const World world(GetParam());
    const int end = writeSet(world.out(), {}, {at, "kill"});
    ASSERT_THAT(filesIn(world.out()), AnyOf(Eq(before), Eq(after))) << "killed in front of call " << at;
    if (end == 0) return;
    ASSERT_EQ(writeSet(world.out(), newer), 0) << at;
    ASSERT_THAT(world.neighbours(), ElementsAre("out")) << at;
  }
  FAIL() << "no end";
}

TEST_P(Killed, GoesOnToWriteWhereSomebodyWaits) {
  // Many at once: each leaves a whole set, and the last one's stays.
  const World world(GetParam());
  std::vector<pid_t> children;
  for (int i = 0; i < 8; ++i) {
    const pid_t child = fork();
    if (child == 0) {
      const std::string tag = std::to_string(i);
      _exit(writeSet(world.out(), {{"A" + tag, tag}, {"both", tag}, {"results.json", tag}}));
    }
    children.push_back(child);
  }
  for (const pid_t child : children) {
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_EQ(WIFEXITED(status) ? WEXITSTATUS(status) : -1, 0);
  }
  const Texts found = filesIn(world.out());
  ASSERT_TRUE(found.contains("results.json"));
  const std::string tag = found.at("results.json");
  EXPECT_EQ(found, (Texts{{"A" + tag, tag}, {"both", tag}, {"results.json", tag}, {"mine.txt", "mine"}}));
  EXPECT_TRUE(world.keptTheUsersFile());
  EXPECT_THAT(world.neighbours(), ElementsAre("out"));
}

/// The last calls of a run that adds its values to a record: nothing but whole runs is in the record, and the next run
/// leaves nothing beside it.
TEST(KilledRecord, HoldsWholeRunsAndNothingLiesBesideIt) {
  if (!PROBEWRIGHT_OPTIMIZED) GTEST_SKIP() << "sanitizers and preloaded libraries do not go together";
  const Folder folder;
  const fs::path work = folder / "work", record = work / "record.csv", out = folder / "out", count = folder / "count";
  const auto run = [&](const std::string& fault) {
    fs::remove_all(out);
    const std::string command = "cd '" PROBEWRIGHT_SOURCE_DIR "' && " + fault +
                                " LD_PRELOAD='" PROBEWRIGHT_FAILING_CALLS "' '" PROBEWRIGHT_PROGRAM
                                "' run examples/first/plate.h --setup examples/first/plate.toml --out '" +
                                out.string() + "' --append '" + record.string() + "' --quiet > /dev/null 2>&1; exit $?";
    return WEXITSTATUS(std::system(command.c_str()));
  };
  const auto linesOf = [&] { return std::ranges::count(textOf(record), '\n'); };
  ASSERT_EQ(run("FAIL_COUNT='" + count.string() + "'"), 1);
  const auto once = linesOf();
  ASSERT_GT(once, 1);
  const long calls = std::stol(textOf(count));
  int left = 0;
  for (long at = calls; at > calls - 6; --at) {
    fs::remove_all(work);
    ASSERT_EQ(run("FAIL_AT=" + std::to_string(at)), 128 + SIGKILL);
    left += fs::exists(work) && namesIn(work).size() > 1 ? 1 : 0;
    EXPECT_THAT(linesOf(), AnyOf(Eq(0), Eq(once))) << at;
    ASSERT_EQ(run(""), 1);
    EXPECT_THAT(namesIn(work), ElementsAre("record.csv")) << at;
  }
  EXPECT_GT(left, 2);
}

/// What a command that was killed has left, a file and a folder, goes with the next one that writes there.
TEST(KilledCommands, LeaveNothingAfterTheNextOne) {
  const Folder folder;
  const fs::path place = folder / "place", temporary = folder / "temporary", out = folder / "out";
  const auto in = [&](const char* name) { return (place / name).string(); };
  const std::string run = "run examples/first/plate.h --setup examples/first/plate.toml --out '" + out.string() + "' ";
  const std::vector<std::string> commands = {
      run + "--append '" + in("record.csv") + "'",
      run + "--export xlsx",
      "convert examples/programs/housing.h '" + in("housing.mpf") + "'",
      "machine mill3 --out '" + in("machine.html") + "'",
      "study examples/first/plate.h --setup examples/first/plate.toml --study examples/studies/plate.toml --trials 4 "
      "--out '" +
          place.string() + "'",
  };
  for (const std::string& command : commands) {
    SCOPED_TRACE(command);
    const bool inTemporary = command.ends_with("xlsx");
    for (const fs::path& each : {place, temporary, out})
      fs::remove_all(each);
    fs::create_directories(place);
    fs::create_directories(temporary);
    const fs::path where = inTemporary ? temporary : place;
    fs::create_directory(where / ".a.probewright-unfinished-Abc123");
    for (const char* name : {".a.probewright-unfinished-Abc123/b", ".b.probewright-unfinished-xyz789"})
      folder.file((inTemporary ? "temporary/" : "place/") + std::string(name), "left");
    const std::string line = "cd '" PROBEWRIGHT_SOURCE_DIR "' && TMPDIR='" + temporary.string() +
                             "' '" PROBEWRIGHT_PROGRAM "' " + command + " > '" + (folder / "printed").string() +
                             "' 2>&1";
    EXPECT_LE(WEXITSTATUS(std::system(line.c_str())), 1) << textOf(folder / "printed");
    for (const fs::path& each : {place, temporary})
      for (const std::string& name : namesIn(each))
        EXPECT_EQ(name.find("unfinished"), std::string::npos) << name;
    if (!inTemporary) {
      EXPECT_NE(namesIn(place), std::vector<std::string>());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Folders, Killed, ::testing::Bool(),
                         [](const auto& which) { return which.param ? "WithASubfolder" : "OfFilesOnly"; });

}  // namespace
}  // namespace probewright::app::testing
