#include <random>

#include "linuxcnc/run_bench.hpp"

/// Programs of both languages on a real LinuxCNC from outside: `probewright run --machine linuxcnc`.
namespace probewright::testing {
namespace {

using ::testing::StartsWith;

class OnLinuxCnc : public LinuxCncRun {
protected:
  /// The same program on LinuxCNC and on the virtual machine: touches, and what became of the zero point.
  void agrees(const std::string& program, const std::string& text, const std::string& control,
              const std::string& table) {
    constexpr double feed = 300;
    const double bound = feed / 60 * period + 1e-4;
    session_.write("setup.toml", setup(control, world, feed));
    session_.write(program, text);
    runVirtually(program, "virtual");
    atTheDesk(call(world) + "ended(desk, 'run', start('" + program + "'))\n");
    ASSERT_THAT(told("run"), StartsWith("0 ")) << output;
    const std::vector<double> real = touches(results("out")), simulated = touches(results("virtual"));
    ASSERT_EQ(real.size(), simulated.size());
    ASSERT_EQ(real.size(), 15U);
    for (std::size_t i = 0; i < real.size(); ++i)
      EXPECT_NEAR(real[i], simulated[i], bound) << "touch " << i / 3 << ", axis " << i % 3;
    // Whatever the control writes but numbers is the same.
    const std::regex number("[-+]?[0-9]+\\.[0-9]+");
    const std::string before = this->text("virtual/" + table), after = this->text("out/" + table);
    EXPECT_NE(before, "");
    EXPECT_EQ(std::regex_replace(before, number, "#"), std::regex_replace(after, number, "#"));
    auto a = std::sregex_iterator(before.begin(), before.end(), number);
    for (auto b = std::sregex_iterator(after.begin(), after.end(), number); b != std::sregex_iterator(); ++a, ++b)
      EXPECT_NEAR(std::stod(b->str()), std::stod(a->str()), bound) << after;
  }
  World world;
};

TEST_F(OnLinuxCnc, KlartextFindsWhatItFindsOnTheVirtualMachine) { agrees("bore.h", klartext(), "TNC640", "PRESET.PR"); }

TEST_F(OnLinuxCnc, SinumerikFindsWhatItFindsOnTheVirtualMachine) {
  agrees("bore.mpf", sinumerik(), "840Dsl", "FRAMES.UFR");
}

/// A stand-in for ssh, which runs here what is to run there: what it is told, and that the run is as one from beside.
TEST_F(OnLinuxCnc, AnotherComputersLinuxCncIsReachedThroughSsh) {
  constexpr double feed = 1200;
  session_.write("setup.toml", setup("TNC640", world, feed));
  session_.write("bore.h", klartext());
  session_.write("ssh", "#!/bin/sh\necho \"$@\" >told\nshift 2\nexec \"$(dirname \"$PROGRAM\")/$1\"\n");
  std::filesystem::permissions(session_.outside() / "ssh", std::filesystem::perms(0755));
  atTheDesk(call(world) + R"(
os.environ['PROGRAM'] = bench.PROGRAM
ended(desk, 'run', start('bore.h', more=['--host', 'anna@mill'], path=os.getcwd() + ':'))
ended(desk, 'other', start('bore.h', machine='python3 x', more=['--host', 'mill']))
ended(desk, 'option', start('bore.h', more=['--host=-oProxyCommand=x']))
)");
  EXPECT_THAT(told("run"), StartsWith("0 ")) << output;
  EXPECT_EQ(text("told"), "-T anna@mill probewright-linuxcnc\n");
  const std::vector<double> found = preset("out");
  ASSERT_EQ(found.size(), 3U) << output;
  EXPECT_NEAR(found[0], world.x, feed / 60 * period + 1e-4);
  EXPECT_THAT(told("other"), StartsWith("2 "));
  EXPECT_THAT(told("other"), ::testing::HasSubstr("it goes with --machine linuxcnc"));
  EXPECT_THAT(told("option"), StartsWith("2 "));
  EXPECT_THAT(told("option"), ::testing::HasSubstr("it is the name of a computer"));
}

/// Random places of the part: the preset is where it was planted, to the way of one servo period at probing feed.
TEST_F(OnLinuxCnc, PresetsOfRandomWorldsAreFoundWhereTheyArePlanted) {
  constexpr double feed = 600;
  const double bound = feed / 60 * period + 1e-4;
  constexpr int count = 8;
  std::mt19937 random(20261);
  std::uniform_real_distribution<double> aside(-1.2, 1.2);
  std::vector<World> worlds;
  // Each run begins with what the setup says.
  session_.write("mill.ini", text("mill.ini") + "[PROBEWRIGHT]\nSHARE_TABLES = 0\n");
  session_.write("setup.toml", setup("TNC640", {}, feed));
  session_.write("bore.h", klartext());
  std::string script;
  for (int i = 0; i < count; ++i) {
    worlds.push_back({aside(random), aside(random), -250 + aside(random), 30 + aside(random) / 10});
    const std::string name = "w" + std::to_string(i);
    script += call(worlds.back()) + "ended(desk, '" + name + "', start('bore.h', '" + name + "'))\n";
  }
  atTheDesk(script, 500);
  for (int i = 0; i < count; ++i) {
    const std::string name = "w" + std::to_string(i);
    const World& planted = worlds[static_cast<std::size_t>(i)];
    ASSERT_THAT(told(name), StartsWith("0 ")) << output;
    const std::vector<double> found = preset(name);
    ASSERT_EQ(found.size(), 3U) << name;
    EXPECT_NEAR(found[0], planted.x, bound) << name;
    EXPECT_NEAR(found[1], planted.y, bound) << name;
    EXPECT_NEAR(found[2], planted.top, bound) << name;
  }
}

}  // namespace
}  // namespace probewright::testing
