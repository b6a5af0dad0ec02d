#include "language/directory_library.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <chrono>
#include <fstream>

#include "language/made_program.hpp"

namespace probewright::language {
namespace {

namespace fs = std::filesystem;

using execution::MadeProgram;

/// A program that knows its path only.
class NamedProgram : public MadeProgram {
public:
  explicit NamedProgram(std::string path) : MadeProgram("", {}), path_(std::move(path)) {}
  const std::string& file() const override { return path_; }

private:
  std::string path_;
};

class DirectoryLibraryTest : public ::testing::Test {
protected:
  DirectoryLibraryTest() {
    std::string name = (fs::temp_directory_path() / "directory_library_XXXXXX").string();
    root_ = ::mkdtemp(name.data());
  }
  ~DirectoryLibraryTest() override { fs::remove_all(root_); }

  void touch(const std::string& file) {
    fs::create_directories((root_ / file).parent_path());
    std::ofstream(root_ / file) << "\n";
  }
  /// What a caller in the folder parts/ finds, seen from the root.
  std::string find(const DirectoryLibrary& library, const std::string& name) {
    const NamedProgram caller((root_ / "parts/main.mpf").string());
    const auto path = library.find(name, &caller);
    return path ? path->lexically_relative(root_).generic_string() : "";
  }
  DirectoryLibrary library(std::vector<std::string> endings) {
    return DirectoryLibrary(std::move(endings),
                            [](const fs::path& path) {
                              return Result<std::shared_ptr<Program>>(std::make_shared<NamedProgram>(path.string()));
                            },
                            {root_ / "common"});
  }

  fs::path root_;
};

TEST_F(DirectoryLibraryTest, SearchesTheCallersFolderFirst) {
  touch("parts/l100.spf");
  touch("common/L100.SPF");
  touch("common/L200.MPF");
  const DirectoryLibrary spf = library({".SPF", ".MPF"});
  EXPECT_EQ(find(spf, "L100"), "parts/l100.spf");
  EXPECT_EQ(find(spf, "L200"), "common/L200.MPF");
  EXPECT_EQ(find(spf, "L200.mpf"), "common/L200.MPF");
  EXPECT_EQ(find(spf, "L200.SPF"), "");
  EXPECT_EQ(find(spf, "L300"), "");
  EXPECT_EQ(find(spf, ""), "");
  EXPECT_EQ(find(spf, "\\"), "");
}

TEST_F(DirectoryLibraryTest, PrefersEndingsInTheirOrderAndExactNames) {
  touch("parts/A.MPF");
  touch("parts/A.SPF");
  touch("parts/b.spf");
  touch("parts/B.spf");
  EXPECT_EQ(find(library({".SPF", ".MPF"}), "A"), "parts/A.SPF");
  EXPECT_EQ(find(library({".MPF", ".SPF"}), "A"), "parts/A.MPF");
  EXPECT_EQ(find(library({".spf"}), "b"), "parts/b.spf");
  EXPECT_EQ(find(library({".spf"}), "B"), "parts/B.spf");
}

TEST_F(DirectoryLibraryTest, UnderstandsPathsOfControls) {
  touch("parts/SUB.H");
  touch("parts/rings/Ring.h");
  touch("common/Ring.WPD/L100.SPF");
  const DirectoryLibrary h = library({".H", ".SPF"});
  EXPECT_EQ(find(h, "TNC:\\NC_PROG\\PARTS\\SUB.H"), "parts/SUB.H");
  EXPECT_EQ(find(h, "TNC:\\parts\\RINGS\\RING.H"), "parts/rings/Ring.h");
  EXPECT_EQ(find(h, "rings/ring"), "parts/rings/Ring.h");
  EXPECT_EQ(find(h, "..\\parts\\sub"), "parts/SUB.H");
  EXPECT_EQ(find(h, "/_N_WKS_DIR/_N_RING_WPD/_N_L100_SPF"), "common/Ring.WPD/L100.SPF");
}

TEST_F(DirectoryLibraryTest, FindsNothingOutsideOfItsRoot) {
  touch("parts/sub/IN.SPF");
  touch("OUT.SPF");
  fs::create_symlink(root_ / "OUT.SPF", root_ / "parts/LINK.SPF");
  fs::create_directory_symlink(root_, root_ / "parts/up");
  const auto open = [](const fs::path& path) {
    return Result<std::shared_ptr<Program>>(std::make_shared<NamedProgram>(path.string()));
  };
  const DirectoryLibrary within({".SPF"}, open);
  EXPECT_EQ(find(within, "sub/IN"), "parts/sub/IN.SPF");
  EXPECT_EQ(find(within, "sub/../sub/IN"), "parts/sub/IN.SPF");
  for (const char* name : {"../OUT", "sub/../../OUT", "LINK", "up/OUT", "..\\OUT"})
    EXPECT_EQ(find(within, name), "") << name;
}

TEST_F(DirectoryLibraryTest, GivesUpOnPathsWithoutEnd) {
  touch("parts/L1.SPF");
  const DirectoryLibrary spf = library({".SPF"});
  std::string up, down;
  for (int i = 0; i < 20'000; ++i) {
    up += "../";
    down += "x/../";
  }
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(find(spf, up + "L1"), "");
  EXPECT_EQ(find(spf, down + "L1"), "parts/L1.SPF");
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(1));
}

TEST_F(DirectoryLibraryTest, NeverTakesAFolderForAProgram) {
  fs::create_directories(root_ / "parts/SUB.H");
  EXPECT_EQ(find(library({".H"}), "SUB"), "");
}

TEST_F(DirectoryLibraryTest, OpensAndExplains) {
  touch("common/SUB.H");
  DirectoryLibrary h = library({".H"});
  EXPECT_TRUE(h.exists("sub", nullptr));
  const auto found = h.open("sub", nullptr);
  ASSERT_TRUE(found);
  EXPECT_EQ((*found)->file(), (root_ / "common/SUB.H").string());
  const auto missing = h.open("NONE", nullptr);
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().message, "there is no program NONE");
  EXPECT_THAT(missing.error().advice, ::testing::HasSubstr((root_ / "common").string()));
}

}  // namespace
}  // namespace probewright::language
