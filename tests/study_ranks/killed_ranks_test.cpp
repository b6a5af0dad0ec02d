#include <gmock/gmock.h>

#include <algorithm>
#include <cerrno>
#include <nlohmann/json.hpp>

#include "study_ranks/study_bench.hpp"

/// A study whose ranks are lost, or whose disk is full: no wrong number, and it goes on.
namespace probewright::app::testing {
namespace {

constexpr const char* few = "520";  // a stretch of 500, and a beginning

/// As one process writes it without any trouble.
std::string undisturbed(const StudyBench& bench) {
  const Answer done = probewright(bench.words(few, "undisturbed"));
  EXPECT_EQ(done.exit, 0) << done.errors;
  return bench.text("undisturbed/study.json");
}

bool hasTrials(const StudyBench& bench) { return fs::exists(bench.path("out/study.state")); }

/// What was handed in stays, and the rest gives what an undisturbed study gives.
void expectToGoOn(const StudyBench& bench) {
  const Answer asked = probewright(bench.words("1", "out", {"--resume"}));
  EXPECT_EQ(asked.exit, 0) << asked.errors;
  const auto there = nlohmann::json::parse(bench.text("out/study.json"))["trials"].get<std::uint64_t>();
  EXPECT_GE(there, 500U);
  const std::string more = std::to_string(there + 700);
  const Answer resumed = probewright(bench.words(more, "out", {"--resume"}));
  EXPECT_EQ(resumed.exit, 0) << resumed.errors;
  const Answer whole = probewright(bench.words(more, "undisturbed"));
  EXPECT_EQ(whole.exit, 0) << whole.errors;
  EXPECT_EQ(bench.text("out/study.json"), bench.text("undisturbed/study.json"));
}

TEST(KilledRanks, OneOfFourEndsAllAndTheStudyGoesOn) {
  if (!hasMpi()) GTEST_SKIP() << "built without MPI";
  const StudyBench bench;
  Launched study(mpirun(4, bench.words("90000000", "out")));
  ASSERT_TRUE(waitFor([&] { return hasTrials(bench) || study.ended(); }));
  const std::vector<pid_t> ranks = ranksOf(study.pid());
  ASSERT_EQ(ranks.size(), 4U);
  kill(ranks[2], SIGKILL);
  EXPECT_NE(study.wait(), 0);
  for (const pid_t rank : ranks)
    EXPECT_TRUE(waitFor([&] { return isGone(rank); }));
  EXPECT_FALSE(fs::exists(bench.path("out/study.json")));
  expectToGoOn(bench);
}

TEST(KilledRanks, TheLauncherTakesItsRanksAlong) {
  if (!hasMpi()) GTEST_SKIP() << "built without MPI";
  const StudyBench bench;
  Launched study(mpirun(2, bench.words("90000000", "out")));
  ASSERT_TRUE(waitFor([&] { return hasTrials(bench) || study.ended(); }));
  const std::vector<pid_t> ranks = ranksOf(study.pid());
  ASSERT_EQ(ranks.size(), 2U);
  kill(study.pid(), SIGKILL);
  study.wait();
  for (const pid_t rank : ranks)
    EXPECT_TRUE(waitFor([&] { return isGone(rank); }));
  EXPECT_FALSE(fs::exists(bench.path("out/study.json")));
  // One bit of what was kept is another one.
  std::string state = bench.text("out/study.state");
  ASSERT_GT(state.size(), 1000U);
  state[state.size() / 2] = static_cast<char>(state[state.size() / 2] ^ 1);
  fs::create_directory(bench.path("damaged"));
  bench.folder().file("damaged/study.state", state);
  EXPECT_EQ(probewright(bench.words("90000000", "damaged", {"--resume"})).exit, 2);
  expectToGoOn(bench);
}

TEST(KilledRanks, CtrlCAtTheLauncherEndsAllAndTheStudyGoesOn) {
  if (!hasMpi()) GTEST_SKIP() << "built without MPI";
  const StudyBench bench;
  Launched study(mpirun(2, bench.words("90000000", "out")));
  ASSERT_TRUE(waitFor([&] { return hasTrials(bench) || study.ended(); }));
  const std::vector<pid_t> ranks = ranksOf(study.pid());
  ASSERT_EQ(ranks.size(), 2U);
  kill(study.pid(), SIGINT);
  EXPECT_NE(study.wait(), 0);
  for (const pid_t rank : ranks)
    EXPECT_TRUE(waitFor([&] { return isGone(rank); }));
  expectToGoOn(bench);
}

/// One of the ranks ends before it has joined the others.
TEST(KilledRanks, ARankThatNeverBeginsEndsAll) {
  if (!hasMpi()) GTEST_SKIP() << "built without MPI";
  const StudyBench bench;
  std::vector<std::string> words = mpirun(1, bench.words("90000000", "out"));
  words.insert(words.end(), {":", "-n", "1", "false"});
  EXPECT_NE(Launched(words).wait(), 0);
  EXPECT_FALSE(hasTrials(bench));
  EXPECT_FALSE(fs::exists(bench.path("out/study.json")));
}

/// What is there is written, and the rest follows later.
TEST(KilledStudy, CtrlCKeepsWhatIsThere) {
  const StudyBench bench;
  std::vector<std::string> words = bench.words("90000000", "out");
  words.insert(words.begin(), PROBEWRIGHT_PROGRAM);
  Launched study(words);
  const auto kept = [&] {
    return fs::exists(bench.path("out/trials.csv")) && fs::file_size(bench.path("out/trials.csv")) > 1000;
  };
  ASSERT_TRUE(waitFor([&] { return kept() || study.ended(); }));
  kill(study.pid(), SIGINT);
  EXPECT_EQ(study.wait(), 3);
  const auto left = nlohmann::json::parse(bench.text("out/study.json"));
  EXPECT_EQ(left["end"], "interrupted");
  const auto there = left["trials"].get<std::uint64_t>();
  EXPECT_GT(there, 0U);
  const std::string more = std::to_string(there + 300);
  EXPECT_EQ(probewright(bench.words(more, "out", {"--resume"})).exit, 0);
  EXPECT_EQ(probewright(bench.words(more, "undisturbed")).exit, 0);
  EXPECT_EQ(bench.text("out/study.json"), bench.text("undisturbed/study.json"));
}

/// The disk is full, or the process is killed, at calls from the first to the last that write.
TEST(KilledStudy, GoesOnAfterAnyCallThatWrites) {
  const StudyBench bench;
  const std::string whole = undisturbed(bench);
  const auto study = [&](const std::string& out, long at, const std::string& how) {
    std::vector<std::string> words = bench.words(few, out);
    words.insert(words.begin(), PROBEWRIGHT_PROGRAM);
    return Launched(words, {{"LD_PRELOAD", PROBEWRIGHT_FAILING_CALLS},
                            {"FAIL_AT", std::to_string(at)},
                            {"FAIL_HOW", how},
                            {"FAIL_COUNT", bench.path("count")}})
        .wait();
  };
  ASSERT_EQ(study("counted", 0, "kill"), 0);
  const long calls = std::stol(bench.text("count"));
  ASSERT_GT(calls, 6);
  int failed = 0;
  for (long at = 1; at <= calls; at += std::max(1L, calls / 4)) {
    for (const std::string& how : {std::to_string(ENOSPC), std::string("kill")}) {
      SCOPED_TRACE("call " + std::to_string(at) + ", " + how);
      const std::string out = "out-" + std::to_string(at) + how;
      failed += study(out, at, how) == 0 ? 0 : 1;
      const std::string left = bench.text(out + "/study.json");
      EXPECT_THAT(left, ::testing::AnyOf("", whole));
      const bool begun = fs::exists(bench.path(out + "/trials.csv"));
      const Answer resumed =
          probewright(bench.words(few, out, begun ? std::vector<std::string>{"--resume"} : std::vector<std::string>{}));
      EXPECT_EQ(resumed.exit, 0) << resumed.errors;
      EXPECT_EQ(bench.text(out + "/study.json"), whole);
    }
  }
  EXPECT_GT(failed, 4);
}

TEST(SeveralRanks, EndWhereOneOfThemReadsOtherFiles) {
  if (!hasMpi()) GTEST_SKIP() << "built without MPI";
  const StudyBench bench;
  std::vector<std::string> words = mpirun(1, bench.words(few, "out"));
  std::vector<std::string> other = bench.words(few, "out");
  other[1] = bench.folder().file("other.h", blockProgram("+20.1", "+19.8"));
  words.insert(words.end(), {":", "-n", "1", PROBEWRIGHT_PROGRAM});
  words.insert(words.end(), other.begin(), other.end());
  EXPECT_EQ(Launched(words).wait(), 2);
  EXPECT_FALSE(fs::exists(bench.path("out/trials.csv")));
}

}  // namespace
}  // namespace probewright::app::testing
