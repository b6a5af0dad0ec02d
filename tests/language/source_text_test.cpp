#include "language/source_text.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <vector>

namespace probewright::language {
namespace {

struct Line {
  std::uint64_t offset;
  std::string text;
  bool operator==(const Line&) const = default;
};

std::vector<Line> linesOf(const SourceText& source) {
  std::vector<Line> lines;
  std::uint64_t offset = source.begin();
  while (const SourceLine line = source.line(offset)) {
    lines.push_back({offset, std::string(line.text)});
    offset = line.next;
  }
  return lines;
}

std::vector<Line> linesOf(std::string text) { return linesOf(SourceText::of("t.h", std::move(text))); }

class File {
public:
  explicit File(const std::string& content)
      : path_(std::filesystem::temp_directory_path() / ("source_text_test_" + std::to_string(::getpid()) + ".h")) {
    std::ofstream(path_, std::ios::binary) << content;
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  ~File() { std::filesystem::remove(path_); }
  const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
};

TEST(SourceText, AcceptsEveryLineEnd) {
  EXPECT_EQ(linesOf("a\nbc\n"), (std::vector<Line>{{0, "a"}, {2, "bc"}}));
  EXPECT_EQ(linesOf("a\r\nbc\r\n"), (std::vector<Line>{{0, "a"}, {3, "bc"}}));
  EXPECT_EQ(linesOf("a\nbc"), (std::vector<Line>{{0, "a"}, {2, "bc"}}));
  EXPECT_EQ(linesOf("\n\na"), (std::vector<Line>{{0, ""}, {1, ""}, {2, "a"}}));
  EXPECT_TRUE(linesOf("").empty());
}

TEST(SourceText, LeavesOutByteOrderMarkAndEndOfFileMark) {
  EXPECT_EQ(linesOf("\xef\xbb\xbf"
                    "a\nb\n\x1a"),
            (std::vector<Line>{{3, "a"}, {5, "b"}}));
  EXPECT_TRUE(linesOf("\xef\xbb\xbf").empty());
  EXPECT_EQ(linesOf("\x1a"
                    "a"),
            (std::vector<Line>{{0,
                                "\x1a"
                                "a"}}));
}

TEST(SourceText, AnswersAnyOffsetBehindTheEnd) {
  const SourceText source = SourceText::of("t.h", "abc");
  EXPECT_FALSE(source.line(3));
  EXPECT_FALSE(source.line(~std::uint64_t{0}));
  EXPECT_EQ(source.bytes(1, 99), "bc");
  EXPECT_EQ(source.bytes(7, 2), "");
}

TEST(SourceText, ViewsOutliveAMove) {
  SourceText source = SourceText::of("t.h", "ab\n");
  const std::string_view view = source.line(0).text;
  const SourceText moved = std::move(source);
  EXPECT_EQ(view, "ab");
  EXPECT_EQ(moved.line(0).text.data(), view.data());
}

TEST(SourceText, GivesLargeFilesLikeSmallOnes) {
  std::string content;
  for (int i = 0; content.size() < (20U << 20U); ++i)
    content += "L X" + std::to_string(i) + "\r\n";
  const File file(content);
  const auto source = SourceText::open(file.path());
  ASSERT_TRUE(source);
  const std::string_view first = source->line(0).text;
  std::uint64_t offset = 0;
  int count = 0;
  bool same = true;
  while (const SourceLine line = source->line(offset)) {
    same = same && line.text == "L X" + std::to_string(count++);
    offset = line.next;
  }
  EXPECT_TRUE(same);
  EXPECT_EQ(offset, content.size());
  EXPECT_EQ(count, std::count(content.begin(), content.end(), '\n'));
  EXPECT_EQ(first, "L X0") << "pages that were given back are read again";
}

TEST(SourceText, RefusesWhatIsNoProgramFile) {
  const auto missing = SourceText::open("/no/such/program.h");
  ASSERT_FALSE(missing);
  EXPECT_NE(format(missing.error()).find("/no/such/program.h: error: cannot open this file: No such file"),
            std::string::npos);
  EXPECT_FALSE(SourceText::open(std::filesystem::temp_directory_path()));
  const File utf16(
      std::string("\xff\xfe"
                  "0\0 \0",
                  6));
  const auto wide = SourceText::open(utf16.path());
  ASSERT_FALSE(wide);
  EXPECT_NE(wide.error().message.find("UTF-16"), std::string::npos);
}

TEST(ProgramName, IsTheFileWithoutFolderAndEnding) {
  EXPECT_EQ(programName("parts/Ring.H"), "Ring");
  EXPECT_EQ(programName("TNC:\\PARTS\\RING.V2.H"), "RING.V2");
  EXPECT_EQ(programName("L100"), "L100");
  EXPECT_EQ(programName("parts/.H"), ".H");
}

}  // namespace
}  // namespace probewright::language
