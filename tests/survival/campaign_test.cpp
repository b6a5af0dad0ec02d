#include <gtest/gtest.h>

#include <random>

#include "setup/simulated_run.hpp"
#include "survival/survival_bench.hpp"

namespace probewright::survival::testing {
namespace {

/// A program of one to three cycles and a box, made by chance.
struct Case {
  std::string setup, program;
  std::vector<std::string> tolerances;
};

Case caseOf(unsigned number) {
  std::mt19937 dice(number * 7919U + 3);
  const auto draw = [&](double low, double high) { return std::uniform_real_distribution<>(low, high)(dice); };
  const auto pick = [&](std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count - 1)(dice); };
  Case made;
  made.setup =
      plateSetup("TNC640", "repeatability = 0.001\npretravel = 0.004\nlobing = 0.001\ntip_offset = [0.02, -0.01]\n" +
                               std::string(number % 2 == 0 ? "orient = true\n" : ""));
  static const std::string rotate =
      "TCH PROBE 400 BASIC ROTATION ~\nQ263=-25 ~\nQ264=-30 ~\nQ265=+25 ~\nQ266=-30 ~\nQ272=+2 ~\nQ267=+1 ~\nQ261=-8 "
      "~\n"
      "Q320=+3 ~\nQ260=+20 ~\nQ301=+1 ~\nQ307=+0 ~\nQ305=+1\n";
  const std::vector<std::string> blocks = {inspectBore, presetInBore, presetOnTop, rotate};
  std::string text;
  for (std::size_t i = 0; i < 1 + pick(3); ++i)
    text += blocks[pick(blocks.size())] + "L Z+50 R0 FMAX\n";
  made.program = klartext(text);
  const std::vector<std::string> axes = {"x", "y", "z", "a", "b", "c"};
  const std::size_t first = pick(6), second = (first + 1 + pick(5)) % 6;
  for (const std::size_t axis : {first, second})
    made.tolerances.push_back("part.pose." + axes[axis] + "=" +
                              std::to_string(axis < 3 ? draw(0.3, 6) : draw(0.05, 1)));
  if (pick(3) == 0) made.tolerances.push_back("part.feature[2].diameter=" + std::to_string(draw(0.1, 1)));
  return made;
}

/// A run through the front door: the setup with these numbers, read as a file is.
bool survivesWhenRun(const Case& made, const ClampedProgram& program, const Failure& failure) {
  toml::table table = toml::parse(made.setup);
  for (std::size_t i = 0; i < failure.values.size(); ++i)
    EXPECT_TRUE(program.worlds().tolerances()[i].quantity.set(table, failure.values[i]));
  std::ostringstream text;
  text << table;
  Diagnostics mistakes;
  auto setup = setup::parseSetup(text.str(), "setup.toml", mistakes);
  if (!setup) return false;
  setup->world.truth.seed = failure.noise;
  // The control believes what the setup as it is written says.
  setup->beliefs = program.worlds().asWritten().beliefs;
  const setup::SimulatedRun run = setup::runText("p.h", made.program, *setup, {});
  if (run.outcome.result.end != execution::RunEnd::Finished) return false;
  return !otherThanMeant(program.meant(), run.machine->path(), run.machine->truth(), program.worlds().sizeVaries());
}

class Campaign : public ::testing::TestWithParam<unsigned> {};

TEST_P(Campaign, NothingFailsWhereItIsProvenAndEveryFailureFails) {
  const Case made = caseOf(GetParam());
  const auto program = clamped(made.setup, made.program, made.tolerances);
  ASSERT_TRUE(program);
  ASSERT_FALSE(program->failureAsWritten()) << program->failureAsWritten()->why;
  const Survival survival = survive(*program, {.samples = 80, .boxes = 20, .seed = GetParam()});
  EXPECT_EQ(survival.end, SurvivalEnd::Finished);
  EXPECT_FALSE(survival.obstacle);
  for (std::size_t i = 0; i < survival.failures.size() && i < 10; ++i)
    EXPECT_FALSE(survivesWhenRun(made, *program, survival.failures[i])) << survival.failures[i].reason.why;
}

INSTANTIATE_TEST_SUITE_P(Survive, Campaign, ::testing::Range(0U, 6U));

}  // namespace
}  // namespace probewright::survival::testing
