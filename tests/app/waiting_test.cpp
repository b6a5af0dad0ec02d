#include <gmock/gmock.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "app/program.hpp"
#include "base/folder_swap.hpp"

/// Runs that share a folder of tables.
namespace probewright::app::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(Waiting, ForTheTablesOfAnotherRunIsSaid) {
  const Folder folder;
  const std::filesystem::path tables = folder / "tables";
  std::filesystem::create_directories(tables);
  const std::string world = folder.file("s.toml", "[control]\ntype = \"TNC640\"\ntables = \"tables\"\n");
  const std::string program = folder.file("a.h", "0 BEGIN PGM A MM\n1 Q1 = 1\n2 END PGM A MM\n");
  const auto errors = [&](std::chrono::milliseconds held) {
    auto lock = FolderLock::take(tables, {}, [](const std::filesystem::path&) { return false; });
    EXPECT_TRUE(lock);
    std::jthread releasing([&] {
      std::this_thread::sleep_for(held);
      const FolderLock released = std::move(*lock);
    });
    const Answer answer = probewright({"run", program, "--setup", world, "--out", (folder / "out").string()});
    EXPECT_EQ(answer.exit, 0) << answer.errors;
    return answer.errors;
  };
  EXPECT_THAT(errors(std::chrono::milliseconds(2600)),
              HasSubstr("another run is replacing the tables in " + tables.string() + ": waiting for it"));
  EXPECT_THAT(errors(std::chrono::milliseconds(300)), Not(HasSubstr("waiting")));
}

}  // namespace
}  // namespace probewright::app::testing
