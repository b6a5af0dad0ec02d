#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>

#include "app/program.hpp"
#include "base/folder_swap.hpp"

/// Runs that share a folder of tables.
namespace probewright::app::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// The program, started with its output in a file, and still running.
class Started {
public:
  Started(std::vector<std::string> words, const std::string& output) {
    words.insert(words.begin(), PROBEWRIGHT_PROGRAM);
    std::vector<char*> arguments;
    for (std::string& word : words)
      arguments.push_back(word.data());
    arguments.push_back(nullptr);
    child_ = fork();
    if (child_ == 0) {
      const int file = open(output.c_str(), O_WRONLY | O_CREAT, 0600);
      dup2(file, STDOUT_FILENO);
      dup2(file, STDERR_FILENO);
      execv(arguments[0], arguments.data());
      _exit(127);
    }
  }
  ~Started() {
    if (child_ > 0) kill(child_, SIGKILL);
  }
  Started(const Started&) = delete;
  Started& operator=(const Started&) = delete;

  /// Ctrl-C; the exit code, -1 if it did not end of its own.
  int interrupt() {
    kill(child_, SIGINT);
    return exit();
  }
  /// Waits for its end; the exit code, -1 if it did not end of its own.
  int exit() {
    int status = 0;
    waitpid(child_, &status, 0);
    child_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

private:
  pid_t child_ = 0;
};

/// The lock is held until the run has said that it waits: however slow the computer, the run neither says it without
/// cause nor goes on while the tables are held.
TEST(Waiting, ForTheTablesOfAnotherRunIsSaid) {
  const Folder folder;
  const std::filesystem::path tables = folder / "tables";
  std::filesystem::create_directories(tables);
  const std::string world = folder.file("s.toml", "[control]\ntype = \"TNC640\"\ntables = \"tables\"\n");
  const std::string program = folder.file("a.h", "0 BEGIN PGM A MM\n1 Q1 = 1\n2 END PGM A MM\n");
  const std::string waits = "another run is replacing the tables in " + tables.string() + ": waiting for it";
  const std::vector<std::string> words = {"run", program, "--setup", world, "--out", (folder / "out").string()};
  const Answer alone = probewright(words);
  EXPECT_EQ(alone.exit, 0) << alone.errors;
  EXPECT_THAT(alone.errors, Not(HasSubstr("waiting")));
  std::filesystem::remove_all(folder / "out");

  auto lock = FolderLock::take(tables, {}, [](const std::filesystem::path&) { return false; });
  ASSERT_TRUE(lock);
  const std::string output = (folder / "o.txt").string();
  Started run(words, output);
  for (int i = 0; i < 6000 && textOf(output).find(waits) == std::string::npos; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_THAT(textOf(output), HasSubstr(waits));
  EXPECT_FALSE(std::filesystem::exists(folder / "out" / "results.json"));
  { const FolderLock released = std::move(*lock); }
  EXPECT_EQ(run.exit(), 0) << textOf(output);
  EXPECT_TRUE(std::filesystem::exists(folder / "out" / "results.json"));
}

TEST(Watching, ChecksOnceMoreAfterEachChange) {
  const Folder folder;
  const std::string broken = "0 BEGIN PGM A MM\n1 L X+Y\n2 END PGM A MM\n";
  const std::string good = "0 BEGIN PGM A MM\n1 L X+1 FMAX\n2 END PGM A MM\n";
  const std::string program = folder.file("a.h", broken), output = (folder / "o.txt").string();
  const std::string rests = "waiting for a change";
  // Waits until the program has come to rest so often.
  const auto rested = [&](int times) {
    for (int i = 0; i < 2000; ++i) {
      const std::string text = textOf(output);
      int count = 0;
      for (std::size_t at = 0; (at = text.find(rests, at)) != std::string::npos; at += rests.size())
        ++count;
      if (count >= times) return text;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ADD_FAILURE() << textOf(output);
    return std::string();
  };
  std::filesystem::create_directory(folder / "elsewhere");
  Started watching({"check", "--watch", program}, output);
  EXPECT_THAT(rested(1), HasSubstr("a.h:2:"));
  folder.file("a.h", good);
  EXPECT_THAT(rested(2), HasSubstr("a.h: no mistakes found"));
  // As editors save: another file takes the place.
  folder.file("elsewhere/new.h", broken);
  std::filesystem::rename(folder / "elsewhere/new.h", folder / "a.h");
  rested(3);
  EXPECT_EQ(watching.interrupt(), 2);
  EXPECT_EQ(probewright({"check", "--watch", "-"}).exit, 2);
}

}  // namespace
}  // namespace probewright::app::testing
