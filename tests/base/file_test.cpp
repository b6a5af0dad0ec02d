#include "base/file.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "base/unfinished.hpp"
#include "base/utc.hpp"

namespace probewright {
namespace {

class FileTest : public testing::Test {
protected:
  FileTest() {
    std::string name = (std::filesystem::temp_directory_path() / "probewright-file-XXXXXX").string();
    folder = ::mkdtemp(name.data());
  }
  ~FileTest() override { std::filesystem::remove_all(folder); }
  std::filesystem::path folder;
};

TEST_F(FileTest, WritesWholeFilesAndLeavesNoNeighbours) {
  const auto path = folder / "table" / "preset.pr";
  ASSERT_TRUE(writeFileAtomically(path, "first"));
  ASSERT_TRUE(writeFileAtomically(path, std::string("sec\0ond", 7)));
  EXPECT_EQ(readFile(path).value(), std::string("sec\0ond", 7));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / "table"), {}), 1);
}

std::vector<std::string> namesIn(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}

/// A process that does something and is killed.
template <class Doing>
void beKilled(const Doing& doing) {
  const pid_t child = ::fork();
  if (child == 0) {
    doing();
    ::kill(::getpid(), SIGKILL);
    ::pause();
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
}

TEST_F(FileTest, TheNextOneRemovesWhatKilledOnesLeft) {
  const auto path = folder / "record.csv";
  const std::string longName(240, 'x');
  ASSERT_TRUE(writeFileAtomically(path, "first"));
  beKilled([&] {
    auto file = UnfinishedFile::beside(path);
    static_cast<void>(writeAll(file->descriptor(), "sec"));
    new UnfinishedFile(*UnfinishedFile::beside(folder / longName));
    const auto* scratch = new ScratchFolder(path);
    std::ofstream(scratch->path() / "a") << "a";
    ::kill(::getpid(), SIGKILL);
    ::pause();
  });
  EXPECT_EQ(namesIn(folder).size(), 4U);
  EXPECT_EQ(readFile(path).value(), "first");
  ASSERT_TRUE(writeFileAtomically(path, "second"));
  EXPECT_EQ(namesIn(folder), std::vector<std::string>{"record.csv"});
  ASSERT_TRUE(writeFileAtomically(folder / longName, "long"));
  EXPECT_EQ(namesIn(folder).size(), 2U);
}

TEST_F(FileTest, NobodyRemovesWhatOthersAreMakingOrWhatIsNotOurs) {
  const std::vector<std::string> foreign = {".record.csv.probewright-unfinished-12345",
                                            ".record.csv.probewright-unfinished-123-56", "record.csv.backup",
                                            "record.csv.probewright-unfinished"};
  for (const std::string& name : foreign)
    std::ofstream(folder / name) << "mine";
  {
    auto file = UnfinishedFile::beside(folder / "record.csv");
    ASSERT_TRUE(file);
    const ScratchFolder scratch(folder / "record.csv");
    std::ofstream(scratch.path() / "a") << "a";
    const pid_t other = ::fork();
    if (other == 0) {
      removeUnfinished(folder);
      ::_exit(0);
    }
    ::waitpid(other, nullptr, 0);
    EXPECT_EQ(readFile(scratch.path() / "a").value(), "a");
    ASSERT_TRUE(writeAll(file->descriptor(), "whole"));
    ASSERT_TRUE(file->finish());
    EXPECT_EQ(readFile(folder / "record.csv").value(), "whole");
  }
  std::vector<std::string> all = foreign;
  all.emplace_back("record.csv");
  std::ranges::sort(all);
  EXPECT_EQ(namesIn(folder), all);
}

/// What one makes, another one takes for left behind between making and locking: then it is made again.
TEST_F(FileTest, ManyWriteTheSameFileAtOnce) {
  const auto path = folder / "shared";
  std::vector<pid_t> children;
  for (int i = 0; i < 6; ++i) {
    children.push_back(::fork());
    if (children.back() != 0) continue;
    bool all = true;
    for (int j = 0; j < 100; ++j) {
      all = all && writeFileAtomically(path, std::string(1000, static_cast<char>('a' + i)));
      const ScratchFolder scratch(path);
      all = all && std::filesystem::is_directory(scratch.path());
    }
    ::_exit(all ? 0 : 1);
  }
  for (const pid_t child : children) {
    int status = 1;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
  }
  EXPECT_EQ(namesIn(folder), std::vector<std::string>{"shared"});
  EXPECT_EQ(readFile(path).value().size(), 1000U);
}

TEST_F(FileTest, SaysWhyAFileCannotBeRead) {
  const auto missing = readFile(folder / "nothing.h");
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().message.find("No such file"), std::string::npos) << missing.error().message;
  ASSERT_FALSE(readFile(folder));
}

TEST_F(FileTest, LeavesTheOldFileWhenTheNewOneCannotBeWritten) {
  const auto path = folder / "occupied";
  std::filesystem::create_directory(path);
  EXPECT_FALSE(writeFileAtomically(path, "text"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
}

TEST_F(FileTest, RefusesWhatIsNoFile) {
  const auto messageOf = [](const std::filesystem::path& path) {
    const auto text = readFile(path);
    return text ? "it was read" : text.error().message;
  };
  EXPECT_EQ(messageOf(folder), "this is a folder, a file was expected");
  for (const char* device : {"/dev/zero", "/dev/urandom", "/dev/null"})
    EXPECT_EQ(messageOf(device), "this is a device, a file was expected") << device;
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(messageOf(folder / "pipe"), "this is a pipe, and nothing writes into it");
  std::ofstream(folder / "large") << std::string(1001, 'x');
  EXPECT_TRUE(readFile(folder / "large", 1001));
  EXPECT_FALSE(readFile(folder / "large", 1000));
}

TEST_F(FileTest, ReadsAPipeToItsEnd) {
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  // More than a pipe holds at once, and slowly.
  const std::string text(300'000, 'x');
  std::thread writer([&] {
    const int pipe = ::open((folder / "pipe").c_str(), O_WRONLY);
    EXPECT_TRUE(writeAll(pipe, text.substr(0, 100'000)));
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_TRUE(writeAll(pipe, text.substr(100'000)));
    ::close(pipe);
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(20));  // the writer waits in open
  EXPECT_EQ(readFile(folder / "pipe").value(), text);
  writer.join();
}

TEST(Utc, KeepsWithinTheYearsThatClocksShow) {
  EXPECT_EQ(utcTime(0, 86400).tm_mday, 2);
  EXPECT_EQ(utcTime(0, 1e300).tm_year, 9999 - 1900);
  EXPECT_EQ(utcTime(0, -1e300).tm_year, 70);
  EXPECT_EQ(utcTime(0, std::numeric_limits<double>::quiet_NaN()).tm_year, 70);
}

}  // namespace
}  // namespace probewright
