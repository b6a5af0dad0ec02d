#include "base/file.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

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

TEST_F(FileTest, WritesAllFilesThatBelongTogetherOrNone) {
  ASSERT_TRUE(writeFilesTogether({{folder / "first", "old"}, {folder / "second", "old"}}));
  std::filesystem::create_directory(folder / "last");
  EXPECT_FALSE(writeFilesTogether({{folder / "first", "new"}, {folder / "second", "new"}, {folder / "last", "new"}}));
  EXPECT_EQ(readFile(folder / "first").value(), "old");
  EXPECT_EQ(readFile(folder / "second").value(), "old");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 3) << "neighbours stayed";
  ASSERT_TRUE(writeFilesTogether({{folder / "first", "new"}, {folder / "second", "new"}}));
  EXPECT_EQ(readFile(folder / "first").value(), "new");
}

}  // namespace
}  // namespace probewright
