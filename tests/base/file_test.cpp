#include "base/file.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <thread>

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
