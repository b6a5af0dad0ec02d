#include <gtest/gtest.h>

#include <array>
#include <optional>

#include "setup/simulated_run.hpp"
#include "study/program_bench.hpp"

/// A thread prepares a program once and runs it in all of its trials: none of them leaves anything to the next.
namespace probewright::study::testing {
namespace {

constexpr const char* place = R"(
trials = 1
[[source]]
quantity = "part.pose.x"
distribution = "uniform"
half_width = 0.3
)";

struct Bench {
  std::string name, setup, program;
};

Bench klartext() {
  return {"p.h", plateSetup(),
          program("3 Q1 = Q1 + 1\n4 QL1 = QL1 + 1\n5 LBL 7\n" + bore(6, 4) + "7 CALL LBL 7 REP 1\n")};
}

/// Blocks of DIN/ISO are completed by what went before.
Bench dinIso() {
  return {"p.i", plateSetup(),
          "%P G71 *\nN10 T1 G17 *\nN20 G00 G40 G90 Z+50 *\nN30 Q1 = Q1 + 1 *\nN40 G98 L7 *\n"
          "N50 G421 BORE Q273=+0 Q274=+0 Q262=+30 Q325=+0 Q247=+90 Q261=-5 Q320=+2 Q260=+20 Q301=+0 Q275=+0 Q276=+0 "
          "Q279=+0 Q280=+0 Q281=+0 Q309=+0 Q330=+0 Q423=+4 Q365=+0 *\nN60 L7,1 *\nN70 Z+60 *\nN99999999 %P G71 *\n"};
}

/// With a macro, variables and R parameters, which a run changes.
Bench sinumerik() {
  std::string setup = plateSetup();
  const auto replace = [&](const std::string& what, const std::string& with) {
    setup.replace(setup.find(what), what.size(), with);
  };
  replace("TNC640", "840Dsl");
  replace("[[preset]]\nrow = 1", "[[zero_offset]]\nname = \"G54\"");
  return {"p.mpf", setup,
          "DEFINE QUICK AS G0\n"
          "DEF REAL DEEP=-5\n"
          "DEF INT PASS\n"
          "N10 G17 G90 G71 G94\n"
          "N20 T=\"PROBE\"\n"
          "N30 M6 D1\n"
          "N40 G54\n"
          "N50 QUICK X0 Y0 Z50\n"
          "FOR PASS=0 TO 1\n"
          "R1=R1+1\n"
          "DEEP=DEEP-R1\n"
          "N60 G1 Z=DEEP F2000\n"
          "N70 CYCLE977(101,10001,,1,30,,,5,1,0,,,,1,1,\"\",,0,,0,0,,,,,1,)\n"
          "ENDFOR\n"
          "N80 QUICK Z50\n"
          "M30\n"};
}

struct Trials {
  std::unique_ptr<ProgramModel> model;
  std::optional<Sampler> sampler;

  explicit Trials(const Bench& bench, const TestFolder& folder) {
    Diagnostics mistakes;
    auto document = setup::SetupDocument::parse(bench.setup, (folder.path() / "setup.toml").string(), mistakes);
    std::optional<Study> study;
    if (document) study = parseStudy(place, (folder.path() / "study.toml").string(), document->table(), mistakes);
    if (study) {
      sampler.emplace(*study);
      model = ProgramModel::make(folder.file(bench.name, bench.program), std::move(*document), *study, {}, mistakes);
    }
    for (const Diagnostic& mistake : mistakes)
      ADD_FAILURE() << format(mistake);
  }
  Outcome operator()(std::uint64_t trial) const { return model->run(sampler->draw(trial)); }
};

void expectSame(const Outcome& a, const Outcome& b) {
  EXPECT_EQ(a.end, TrialEnd::Finished) << a.why;
  EXPECT_EQ(b.end, TrialEnd::Finished) << b.why;
  ASSERT_EQ(a.observations.size(), b.observations.size());
  EXPECT_GE(a.observations.size(), 6U);
  for (std::size_t i = 0; i < a.observations.size(); ++i) {
    const Observation &x = a.observations[i], &y = b.observations[i];
    EXPECT_EQ(x.of.key, y.of.key);
    EXPECT_EQ(x.value, y.value) << x.of.key;
    EXPECT_EQ(x.truth, y.truth) << x.of.key;
  }
}

class RepeatedTrials : public ::testing::TestWithParam<Bench (*)()> {};

TEST_P(RepeatedTrials, LeaveNothingToTheNext) {
  const TestFolder folder;
  const Trials together(GetParam()(), folder);
  ASSERT_TRUE(together.model);
  for (std::uint64_t trial = 0; trial < 6; ++trial) {
    SCOPED_TRACE(trial);
    const Trials alone(GetParam()(), folder);
    expectSame(together(trial), alone(trial));
  }
}

TEST_P(RepeatedTrials, ReadProgramAndTablesOnce) {
  const TestFolder folder, tables;
  Bench bench = GetParam()();
  Diagnostics mistakes;
  const auto setup = setup::SetupDocument::parse(bench.setup, "setup.toml", mistakes);
  ASSERT_TRUE(setup);
  const auto first = setup::runText(bench.name, bench.program, setup->asWritten(), {}, {.recordPath = false});
  ASSERT_FALSE(first.outcome.files.empty());
  for (const auto& [name, text] : first.outcome.files)
    tables.file(name, text);
  const std::string control = "[control]\n";
  bench.setup.insert(bench.setup.find(control) + control.size(), "tables = \"" + tables.path().string() + "\"\n");
  const Trials trials(bench, folder);
  ASSERT_TRUE(trials.model);
  const Outcome before = trials(3);
  for (const TestFolder* each : {&folder, &tables}) {
    for (const auto& file : std::filesystem::directory_iterator(each->path()))
      std::filesystem::remove(file);
  }
  expectSame(before, trials(3));
}

INSTANTIATE_TEST_SUITE_P(Languages, RepeatedTrials, ::testing::Values(klartext, dinIso, sinumerik),
                         [](const auto& language) {
                           return std::string(std::array{"Klartext", "DinIso", "Sinumerik"}[language.index]);
                         });

}  // namespace
}  // namespace probewright::study::testing
