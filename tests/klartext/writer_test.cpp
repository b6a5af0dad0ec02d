#include <gtest/gtest.h>

#include <random>

#include "klartext/ir_text.hpp"
#include "klartext/samples.hpp"
#include "language/klartext/formula_writer.hpp"
#include "language/klartext/writer.hpp"

namespace probewright::language::klartext::testing {
namespace {

std::string written(const std::string& text) {
  KlartextProgram program("a.h", text);
  return writeProgram(program);
}

TEST(Writer, WhatIsWrittenMeansWhatWasRead) {
  for (const std::string_view sample : samples) {
    const std::string text(sample);
    const std::string first = irOf(text);
    EXPECT_EQ(first.find(": "), std::string::npos) << first;  // every sample reads without mistakes
    const std::string again = written(text);
    EXPECT_EQ(irOf(again), first) << again;
    EXPECT_EQ(written(again), again);  // and writing has settled
  }
}

TEST(Writer, KeepsNamesAndComments) {
  EXPECT_EQ(written("5 TCH PROBE 410 Центр ~\n Q321=1 ;КООРД. ~\n Q322=2\n9 L X+1 FMAX ; there\n; alone\n"),
            "0 TCH PROBE 410 Центр ~\n    Q321=+1 ;КООРД. ~\n    Q322=+2\n1 L X+1 FMAX ; there\n2 ; alone\n");
  EXPECT_EQ(written("5 L x + 1,5 Y - q3  r0 f max"), "0 L X+1.5 Y-Q3 R0 FMAX\n");
}

TEST(Writer, PutsParametersOfTheFirstLineBelowTheName) {
  const std::string below = "0 TCH PROBE 427 MEASURE ~\n    Q263=+1 ~\n    Q264=+2\n";
  for (const char* text :
       {"5 TCH PROBE 427 MEASURE Q263=+1 ~\n Q264=+2\n", "5 TCH PROBE 427 MEASURE Q 263 = 1 Q264=2\n",
        "5 TCH PROBE 427 MEASURE\tQ263=+1 ~\n Q264=+2\n"}) {
    EXPECT_EQ(written(text), below) << text;
    EXPECT_EQ(written(written(text)), below);
  }
  EXPECT_EQ(written("5 TCH PROBE 427 QUICK Q263=+1\n"), "0 TCH PROBE 427 QUICK ~\n    Q263=+1\n");
  EXPECT_EQ(written("5 tch probe 427 quick q263=+1\n"), "0 TCH PROBE 427 quick ~\n    Q263=+1\n");
}

TEST(Writer, KeepsCommentsThatGoOnInTheNextLine) {
  const std::string once = written("5 L X+1 FMAX ; first ~\n  second ~\nthird\n7 L X+2 ~\n  Y+3 FMAX ; only here\n");
  EXPECT_EQ(once, "0 L X+1 FMAX ; first ~\n  second ~\nthird\n1 L X+2 Y+3 FMAX ; only here\n");
  EXPECT_EQ(written(once), once);
}

TEST(Writer, KeepsFeedsPerToothOfBlocksWithoutPath) {
  EXPECT_EQ(written("F Z 0.1\n"), "0 L FZ+0.1\n");
  EXPECT_EQ(irOf(written("F Z 0.1\n")), irOf("0 F Z 0.1\n"));
}

TEST(Writer, WritesRowsOfTablesWithoutASign) {
  EXPECT_EQ(written("PRESET SELECT #3 KEEP TRANS\n"), "0 PRESET SELECT #3 KEEP TRANS\n");
  EXPECT_EQ(written("PRESET COPY #Q1 TO #2 SELECT TARGET\n"), "0 PRESET COPY #Q1 TO #2 SELECT TARGET\n");
  EXPECT_EQ(written("TRANS DATUM TABLE TABLINE25\n"), "0 TRANS DATUM TABLE TABLINE 25\n");
  EXPECT_EQ(written("CYCL DEF 7.0 SHIFT\nCYCL DEF 7.1 #5\n"), "0 CYCL DEF 7.0 SHIFT\n1 CYCL DEF 7.1 #5\n");
}

TEST(Writer, NumbersReadBackTheSame) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> mantissa(-1, 1);
  for (int i = 0; i < 2000; ++i) {
    const double value = std::ldexp(mantissa(random), static_cast<int>(random() % 60) - 30);
    KlartextProgram program("a.h", "L X" + writeSigned(value));
    Block block;
    Diagnostics mistakes;
    ASSERT_TRUE(program.parse(program.begin(), block, mistakes));
    ASSERT_EQ(block.words.size(), 1U);
    EXPECT_EQ(block.words[0].value.number, value);
  }
}

}  // namespace
}  // namespace probewright::language::klartext::testing
