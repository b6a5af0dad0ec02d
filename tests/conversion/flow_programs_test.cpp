#include <gtest/gtest.h>

#include "conversion/flow.hpp"
#include "session/check.hpp"

/// Random programs with flow of every kind: whatever a conversion does not name runs through the same touches.
namespace probewright::testing_support {
namespace {

// ---- HEIDENHAIN ----

TEST(ConvertFlow, RunsHeidenhainProgramsThroughTheSameTouches) {
  const int programs = setting("PROBEWRIGHT_PROGRAMS", 60);
  Dice dice(static_cast<unsigned>(setting("PROBEWRIGHT_SEED", 4001)));
  // A conversion that names something promises nothing: others take its place.
  int compared = 0;
  for (int i = 0; compared < programs && i < 5 * programs; ++i) {
    SCOPED_TRACE(fmt::format("program {}", i));
    const World world(dice);
    const Twin original = runKlartext(KlartextFlow(dice, world).program(), world.part);
    const Twin there = runConverted(original, world.part);
    if (!there.lost.empty()) continue;
    ++compared;
    ASSERT_TRUE(runsTheSame(original, there));
    const Twin back = runConverted(there, world.part);
    if (back.lost.empty()) {
      ASSERT_TRUE(runsTheSame(original, back));
    }
  }
  EXPECT_EQ(compared, programs) << "too many programs are named, too few compared";
}

// ---- SINUMERIK ----

TEST(ConvertFlow, RunsSinumerikProgramsThroughTheSameTouches) {
  const int programs = setting("PROBEWRIGHT_PROGRAMS", 60);
  Dice dice(static_cast<unsigned>(setting("PROBEWRIGHT_SEED", 4002)));
  int compared = 0;
  for (int i = 0; compared < programs && i < 10 * programs; ++i) {
    SCOPED_TRACE(fmt::format("program {}", i));
    const World world(dice);
    const Twin original = runSinumerik(SinumerikFlow(dice, world).program(), world.part);
    const Twin there = runConverted(original, world.part);
    if (!there.lost.empty()) continue;
    ++compared;
    ASSERT_TRUE(runsTheSame(original, there));
  }
  EXPECT_EQ(compared, programs) << "too many programs are named, too few compared";
}

// ---- damaged programs ----

/// The program with a few lines or signs lost, doubled or exchanged.
std::string damaged(std::string text, Dice& dice) {
  const auto place = [&] { return static_cast<std::size_t>(dice.whole(0, static_cast<int>(text.size()) - 1)); };
  for (int i = 0; i < dice.whole(1, 4); ++i) {
    const std::size_t at = place(), begin = text.rfind('\n', at) + 1;
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
    const std::string line = begin < end ? text.substr(begin, end - begin) : "";
    const int kind = dice.whole(0, 4);
    if (kind == 0) text.erase(begin, line.size());
    if (kind == 1) text.insert(text.find('\n', place()) + 1, line);
    if (kind == 2) text.erase(at, 1);
    if (kind == 3) text[at] = "0129+-=,;~/*()[]LQRXN "[dice.whole(0, 21)];
    if (kind == 4) text.insert(at, std::string(1, "0129-Q,"[dice.whole(0, 6)]));
  }
  return text;
}

/// What `check` accepts is converted; what is written that its control would refuse is named.
TEST(ConvertFlow, SurvivesDamagedPrograms) {
  const int programs = 20 * setting("PROBEWRIGHT_PROGRAMS", 20);
  Dice dice(static_cast<unsigned>(setting("PROBEWRIGHT_SEED", 4003)));
  int accepted = 0;
  for (int i = 0; i < programs; ++i) {
    const World world(dice);
    const bool heidenhain = dice.coin();
    const std::string text =
        damaged(heidenhain ? KlartextFlow(dice, world).program() : SinumerikFlow(dice, world).program(), dice);
    const ProgramLanguage from = heidenhain ? ProgramLanguage::Klartext : ProgramLanguage::Sinumerik;
    const auto program = session::programOf(heidenhain ? "BENCH.H" : "BENCH.MPF", text, from);
    const ControlKind control = heidenhain ? ControlKind::TNC640 : ControlKind::Sinumerik840Dsl;
    if (hasErrors(session::checkProgram(*program, control))) continue;
    ++accepted;
    const session::Conversion there = converted(text, from, dice.coin() ? ControlKind::TNC640 : ControlKind::iTNC530);
    EXPECT_TRUE(there.mistakes.empty() || !hasErrors(there.mistakes)) << text;
    for (const Diagnostic& each : there.notCarriedOver)
      EXPECT_FALSE(each.message.empty()) << text;
    if (::testing::Test::HasFailure()) return;
  }
  EXPECT_GT(accepted, programs / 20);
}

}  // namespace
}  // namespace probewright::testing_support
