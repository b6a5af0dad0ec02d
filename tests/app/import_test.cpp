#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
  // All but the time of day.
  const std::string with = textOf(folder / "out" / "report.html");
  EXPECT_EQ(with.size(), without.size());
}

}  // namespace
}  // namespace probewright::app::testing
