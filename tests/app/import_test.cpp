#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>

#include "app/program.hpp"

namespace probewright::app::testing {
namespace {

using ::testing::HasSubstr;

const std::string program = "BEGIN PGM P MM\nTOOL CALL 1 Z S100\nL Z+10 R0 FMAX M91\nEND PGM P MM\n";

std::string setupWith(const std::string& part) {
  return "[control]\ntype = \"TNC640\"\n[part]\nfile = \"" + part +
         "\"\npose = { z = -470 }\n[[tool]]\nnumber = 1\nkind = \"probe\"\nlength = 150\nball_radius = 3\n";
}

Answer runPart(const Folder& folder, const std::string& step, const std::vector<std::string>& more = {}) {
  folder.file("part.step", step);
  std::vector<std::string> words = {"run",     folder.file("p.h", program),
                                    "--setup", folder.file("s.toml", setupWith("part.step")),
                                    "--out",   (folder / "out").string()};
  words.insert(words.end(), more.begin(), more.end());
  return probewright(words);
}

std::string housing() { return textOf(PROBEWRIGHT_SOURCE_DIR "/examples/parts/housing.step"); }

TEST(Import, EndsWithAMessageWhereADamagedPartWouldCrash) {
  const Folder folder;
  const std::string good = housing();
  const std::size_t vertex = good.find("VERTEX_POINT('',#") + std::string("VERTEX_POINT('',#").size();
  std::string bad = good;
  bad.replace(vertex, bad.find(')', vertex) - vertex, "1");
  const Answer answer = runPart(folder, bad, {"--cache", "off"});
  EXPECT_EQ(answer.exit, 2) << answer.errors;
  EXPECT_THAT(answer.errors, HasSubstr("part.step:"));
  EXPECT_THAT(answer.errors, HasSubstr("#"));
}

TEST(Import, WarnsOfAnOpenBodyAndRuns) {
  const Folder folder;
  const std::string good = housing();
  const std::size_t at = good.find("CLOSED_SHELL('',(") + std::string("CLOSED_SHELL('',(").size();
  std::string bad = good;
  bad.erase(at, bad.find('#', at + 1) - at);
  const Answer answer = runPart(folder, bad, {"--cache", "off"});
  EXPECT_EQ(answer.exit, 0) << answer.errors;
  EXPECT_THAT(answer.errors, HasSubstr("warning"));
  EXPECT_THAT(answer.errors, HasSubstr("not closed"));
}

TEST(Import, KeepsAPartInTheCacheAndReportsTheSame) {
  const Folder folder;
  const std::string cache = (folder / "cache").string();
  EXPECT_EQ(runPart(folder, housing(), {"--cache", "off"}).exit, 0);
  const std::string without = textOf(folder / "out" / "report.html");
  EXPECT_EQ(runPart(folder, housing(), {"--cache", cache}).exit, 0);
  ASSERT_EQ(namesIn(cache).size(), 1U);
  EXPECT_EQ(runPart(folder, housing(), {"--cache", cache}).exit, 0);
  EXPECT_EQ(namesIn(cache).size(), 1U);
  // All but the time of day, which changes a few bytes of what is compressed.
  const std::string with = textOf(folder / "out" / "report.html");
  EXPECT_NEAR(static_cast<double>(with.size()), static_cast<double>(without.size()), 64);
}

/// A part that takes seconds to read: the housing, and points that nothing uses.
std::string longHousing() {
  std::string text = housing();
  std::string points;
  for (int i = 0; i < 400'000; ++i)
    points += "#" + std::to_string(1'000'000 + i) + "=CARTESIAN_POINT('',(0.,0.,0.));\n";
  return text.insert(text.rfind("ENDSEC;"), points);
}

TEST(Import, EndsAtOnceByCtrlCAndLeavesNothing) {
  const Folder folder;
  folder.file("part.step", longHousing());
  const std::string out = (folder / "out").string(), cache = (folder / "cache").string();
  std::vector<std::string> words = {PROBEWRIGHT_PROGRAM,
                                    "run",
                                    folder.file("p.h", program),
                                    "--setup",
                                    folder.file("s.toml", setupWith("part.step")),
                                    "--out",
                                    out,
                                    "--cache",
                                    cache};
  std::vector<char*> arguments;
  for (std::string& word : words)
    arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const std::string errors = (folder / "errors").string();
  const pid_t run = fork();
  if (run == 0) {
    setpgid(0, 0);
    dup2(open("/dev/null", O_WRONLY), STDOUT_FILENO);
    dup2(open(errors.c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
    execv(arguments[0], arguments.data());
    _exit(127);
  }
  // The import has begun as soon as the run has a child.
  const std::string children = "/proc/" + std::to_string(run) + "/task/" + std::to_string(run) + "/children";
  for (int i = 0; i < 2000 && textOf(children).empty(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  ASSERT_FALSE(textOf(children).empty());
  const auto begin = std::chrono::steady_clock::now();
  kill(run, SIGINT);
  int status = 0;
  ASSERT_EQ(waitpid(run, &status, 0), run);
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), 2);
  EXPECT_EQ(WIFEXITED(status) ? WEXITSTATUS(status) : -1, 3) << textOf(errors);
  EXPECT_THAT(textOf(errors), HasSubstr("interrupted"));
  EXPECT_EQ(kill(-run, 0), -1) << "its child is still there";
  if (std::filesystem::exists(out)) {
    EXPECT_THAT(namesIn(out), ::testing::IsEmpty());
  }
  EXPECT_FALSE(std::filesystem::exists(cache));
}

}  // namespace
}  // namespace probewright::app::testing
