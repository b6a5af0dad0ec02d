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

/// A real server of ssh, on the loopback of the session: a run as one from beside, and one whose connection breaks.
TEST_F(OnLinuxCnc, TheProgramRunsOnAnotherComputer) {
  if (!session_.needAccount()) GTEST_SKIP() << "only root can give LinuxCNC's user an account to log in";
  constexpr double feed = 1200;
  session_.write("setup.toml", setup("TNC640", world, feed));
  session_.write("bore.h", klartext());
  std::string slow = klartext();
  const std::string fast = "X+25 Y+0 Z+8 R0 FMAX";
  slow.replace(slow.find(fast), fast.size(), "X+200 Y+100 Z+8 R0 F500");
  session_.write("slow.h", slow);
  const std::string here = session_.folder().string();
  session_.write("sshd_config", "Port 2222\nListenAddress 127.0.0.1\nHostKey " + here + "/host_key\nPidFile none\n" +
                                    "UsePAM no\nPasswordAuthentication no\nKbdInteractiveAuthentication no\n" +
                                    "StrictModes no\nAuthorizedKeysFile " + here + "/user_key.pub\nSetEnv PATH=" +
                                    (session_.build() / "apps/probewright").string() + ":/usr/bin:/bin\n");
  std::filesystem::create_directory(session_.outside() / ".ssh");
  session_.write(".ssh/config", "Host mill\n HostName 127.0.0.1\n Port 2222\n IdentityFile " + here +
                                    "/user_key\n UserKnownHostsFile " + here +
                                    "/known\n StrictHostKeyChecking accept-new\n");
  atTheDesk(call(world) + R"(
for key in ('host_key', 'user_key'):
    subprocess.run(['ssh-keygen', '-q', '-t', 'ed25519', '-N', '', '-f', key], check=True)
server = subprocess.Popen(['/usr/sbin/sshd', '-D', '-e', '-f', os.getcwd() + '/sshd_config'])
end = time.monotonic() + 60
while subprocess.run(['ssh', 'mill', 'true']).returncode != 0 and time.monotonic() < end: time.sleep(0.2)
ended(desk, 'run', start('bore.h', more=['--host', 'mill']))
# The adapter there may leave LinuxCNC a moment after the program here has ended.
desk.until('the end of the adapter', lambda s: s.task_mode == linuxcnc.MODE_MANUAL)
still(desk)
desk.mdi('G10 L2 P1 X0 Y0 Z-250 R0')
run = start('slow.h', 'broken', more=['--host', 'mill'])
moving(desk)
subprocess.run(['pkill', '-KILL', '-x', 'ssh'])
ended(desk, 'broken', run)
still(desk)
desk.tell('stands', desk.status.position[0] < 199)
desk.until('the end of the adapter', lambda s: s.task_mode == linuxcnc.MODE_MANUAL)
ended(desk, 'again', start('bore.h', 'again', more=['--host', 'mill']))
server.terminate()
ended(desk, 'nobody', start('bore.h', 'nobody', more=['--host', 'mill']))
)");
  const double bound = feed / 60 * period + 1e-4;
  for (const auto& [name, folder] : {std::pair{"run", "out"}, std::pair{"again", "again"}}) {
    EXPECT_THAT(told(name), StartsWith("0 ")) << output;
    const std::vector<double> found = preset(folder);
    ASSERT_EQ(found.size(), 3U) << output;
    EXPECT_NEAR(found[0], world.x, bound);
    EXPECT_NEAR(found[1], world.y, bound);
  }
  EXPECT_TRUE(std::regex_search(told("broken"), std::regex("^3 .*the connection to the machine adapter is lost")))
      << told("broken");
  EXPECT_EQ(preset("broken"), (std::vector<double>{0, 0, -250}));
  EXPECT_EQ(told("stands"), "True") << "the axes stop when the connection is gone";
  EXPECT_TRUE(std::regex_search(told("nobody"), std::regex("^2 .*machine adapter"))) << told("nobody");
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
