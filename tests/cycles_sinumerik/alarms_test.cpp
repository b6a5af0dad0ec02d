#include <algorithm>
#include <cctype>

#include "support/lathe_bench.hpp"
#include "support/sinumerik_bench.hpp"

/// Each alarm of the workpiece cycles, provoked once: its number, its text, what to do, and _OVI[9].
namespace probewright {
namespace {

using namespace testing_support;

constexpr double table = -350;

std::string lowerCase(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

template <class Bench>
void expectAlarm(const Bench& bench, const language::RunResult& result, int number, const std::string& text) {
  ASSERT_FALSE(result.diagnostics.empty()) << number << " " << text;
  const Diagnostic& first = result.diagnostics.front();
  EXPECT_EQ(first.code, std::to_string(number)) << format(first);
  EXPECT_NE(lowerCase(first.message).find(text), std::string::npos) << format(first);
  EXPECT_FALSE(first.advice.empty()) << format(first);
  EXPECT_EQ(bench.ovi(9), number) << format(first);
  EXPECT_NE(bench.control.journal.cycles.back().alarm.find(std::to_string(number)), std::string::npos);
}

/// A block with faces towards minus X, minus Y and plus Z, and a hole of diameter 40 in another.
simulation::Truth world() {
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::Box({0, 0, -60}, {120, 100, 0}), translation({0, 0, table}));
  place(truth, simulation::Ring(20, 45, -60), translation({-150, 0, table}));
  return truth;
}

class Provoker : public SinumerikBench {
public:
  explicit Provoker(const simulation::Truth& truth = world()) : SinumerikBench(truth) {
    plantFrame(*this, "$P_UIFR", 1, {0, 0, table});
    control.data.set("$TC_TP2", {7}, std::string("MILL"));
    set("$TC_DP1", {7, 1}, 120);
    set("$TC_DP6", {7, 1}, 10);
  }
  /// A call of CYCLE978 at the face towards minus X, with what is changed.
  void edge(int number, const std::string& text, const NamedNumbers& changed, const std::string& before = {},
            const NamedTexts& texts = {{"S_TNAME", "MILL"}}) {
    control.radiusCompensation = false;
    control.frames.programmed = {};
    control.applyFrames();
    start({-30, 30, -10});
    expectAlarm(*this,
                tryRun("CYCLE978", with({{"S_FA", 6}, {"S_TSA", 2}, {"S_MA", 1}, {"S_MD", 1}}, changed), texts, before),
                number, text);
  }
  void hole(int number, const std::string& text, const char* cycle, const NamedNumbers& call) {
    start({-150, 0, -10});
    expectAlarm(*this, tryRun(cycle, call), number, text);
  }
};

TEST(Alarms, OfCallsOnMills) {
  Provoker bench;
  bench.edge(61300, "tool radius compensation", {}, "G41\n");
  bench.edge(61301, "probe does not switch", {{"S_SETV", -20}});
  Provoker().edge(61302, "probe collision", {{"S_SETV", 60}});
  bench.edge(61303, "safe area exceeded", {{"S_SETV", 3}});
  bench.edge(61307, "wrong measuring variant", {{"S_MVAR", 5}});
  bench.edge(61308, "measuring path", {{"S_FA", 0}});
  bench.edge(61310, "scale factor", {}, "SCALE X2\n");
  bench.edge(61311, "no d number", {}, "D0\n");
  bench.edge(61313, "probe number", {{"S_PRNUM", 13}});
  bench.edge(61314, "tool type", {{"S_MVAR", 200}, {"S_KNUM1", 500001}});
  bench.edge(61318, "weighting factor", {{"S_MVAR", 200}, {"S_KNUM1", 1}, {"S_EVNUM", 10000}});
  bench.edge(61319, "call parameter", {{"S_MVAR", 200}, {"S_KNUM1", 1}, {"S_EVNUM", 21}});
  bench.edge(61321, "zero offset number", {{"S_MVAR", 100}, {"S_KNUM", 1017}});
  bench.edge(61322, "4th digit", {{"S_MVAR", 100}, {"S_KNUM", 4001}});
  bench.edge(61323, "5th digit", {{"S_MVAR", 100}, {"S_KNUM", 20001}});
  bench.edge(61324, "6th digit", {{"S_MVAR", 100}, {"S_KNUM", 100001}});
  bench.edge(61325, "measuring axis", {{"S_MA", 4}});
  bench.edge(61326, "measuring direction", {{"S_MD", 3}});
  bench.edge(61328, "d number", {{"S_MVAR", 200}, {"S_KNUM1", 2}});
  bench.edge(61341, "not calibrated", {{"S_PRNUM", 2}});
  bench.edge(61343, "tool does not exist", {{"S_MVAR", 200}, {"S_KNUM1", 1}}, {}, {{"S_TNAME", "NONE"}});
  bench.set("$SCS_MEA_FEED_PLANE_VALUE", {}, 0);
  bench.edge(61338, "positioning speed", {});
  bench.set("$SCS_MEA_FEED_PLANE_VALUE", {}, 1000);
  bench.set("$TC_DP1", {1, 1}, 120);
  bench.edge(61309, "probe type", {});
}

TEST(Alarms, OfGeometryOnMills) {
  Provoker bench;
  const NamedNumbers segment = {{"S_MVAR", 1}, {"S_SETV", 40}, {"S_FA", 5}, {"S_TSA", 2}, {"S_CPA", -150}};
  // Three points in one place lie on no circle.
  bench.hole(61316, "centre and radius", "CYCLE979", with(segment, {{"S_INCA", 1e-9}}));
  bench.hole(61334, "protection zone", "CYCLE977",
             {{"S_MVAR", 1001}, {"S_SETV", 40}, {"S_FA", 5}, {"S_TSA", 2}, {"S_SZA", 38}, {"S_ID", 20}});
  // The edge lies at 50 degrees to the axis.
  simulation::Truth slanted = perfectWorld();
  place(slanted, simulation::Box({0, -60, -60}, {80, 60, 0}),
        translation({0, 0, table}) * rotation(Vector3::UnitZ(), 50));
  Provoker turned(slanted);
  turned.start({-14, 0, -10});
  expectAlarm(turned,
              turned.tryRun("CYCLE998",
                            {{"S_MVAR", 100005}, {"S_FA", 12}, {"S_TSA", 80}, {"S_MA", 201}, {"S_MD", 1}, {"S_ID", 5}}),
              61331, "angle too large");
  bench.set("$TC_DP6", {1, 1}, 0);
  bench.set("$SNS_MEA_WP_BALL_DIAM", {0}, 0);
  bench.hole(61351, "length or radius", "CYCLE976", {{"S_MVAR", 3}, {"S_SETV", 30}, {"S_FA", 5}, {"S_TSA", 3}});
}

TEST(Alarms, OfASpindleThatCannotBePositioned) {
  simulation::Truth truth = world();
  truth.machine.spindleOrients = false;
  Provoker bench(truth);
  bench.edge(61372, "spindle that can be positioned", {{"S_MVAR", 10000}});
}

TEST(Alarms, OfACallTooDeep) {
  /// L1 calls L2 and so on; the last measures.
  class Nest : public language::ProgramLibrary {
  public:
    explicit Nest(int depth) : depth_(depth) {}
    Result<std::shared_ptr<language::Program>> open(std::string_view name, const language::Program*) override {
      const int level = std::stoi(std::string(name.substr(1)));
      const std::string text =
          level < depth_ ? fmt::format("L{}\nM17\n", level + 1) : "CYCLE978(0,,,1,0,6,2,1,1,1)\nM17\n";
      return std::shared_ptr<language::Program>(
          sinumerik::SinumerikProgram::fromText(fmt::format("{}.SPF", name), text));
    }
    bool exists(std::string_view name, const language::Program*) override {
      return name.size() == 2 && (name[0] == 'L' || name[0] == 'l') && name[1] >= '1' && name[1] <= '9';
    }

  private:
    int depth_;
  };
  // The main program is level 1, so L4 is level 5.
  for (const int depth : {4, 5}) {
    Provoker bench;
    Nest nest(depth);
    language::InterpreterOptions options;
    options.programDepth = sinumerik::SinumerikHost::programDepth;
    sinumerik::SinumerikHost host(bench.control);
    const language::RunResult result = language::Interpreter(nest, host, options)
                                           .run(sinumerik::SinumerikProgram::fromText(
                                               "DEEP.MPF", "G17 G90 G71 G54\nT1 D1 M6\nG0 X-30 Y30\nZ-10\nL1\nM30\n"));
    if (depth == 4) {
      EXPECT_TRUE(result.diagnostics.empty()) << format(result.diagnostics.front());
    } else {
      expectAlarm(bench, result, 61300, "cannot be called here");
    }
  }
}

TEST(Alarms, MessagesLetTheProgramGoOn) {
  Provoker bench;
  const auto correct = [&](double set, const NamedNumbers& changed) {
    bench.control.journal.events.clear();
    bench.start({-150, 0, -10});
    bench.run("CYCLE977", with({{"S_MVAR", 201}, {"S_KNUM1", 1}, {"S_SETV", set}, {"S_FA", 5}, {"S_TSA", 2}}, changed),
              {{"S_TNAME", "MILL"}});
    std::string text;
    for (const auto& event : bench.control.journal.events)
      if (!event.code.empty()) text += event.code + " " + lowerCase(event.text);
    return text;
  };
  const NamedNumbers tolerance = {{"_AMODE", 1}, {"S_TUL", 0.1}, {"S_TLL", -0.1}};
  EXPECT_EQ(correct(39.8, tolerance).rfind("61304 oversize", 0), 0U);
  EXPECT_EQ(bench.ovi(9), 61304);
  EXPECT_EQ(correct(40.2, tolerance).rfind("61305 undersize", 0), 0U);
  EXPECT_EQ(bench.ovi(9), 61305);
  EXPECT_EQ(correct(39.5, {{"S_TDIF", 0.3}}).rfind("61306 permissible dimensional difference exceeded", 0), 0U);
  EXPECT_EQ(bench.ovi(9), 61306);
  EXPECT_EQ(correct(40, tolerance), "");
  EXPECT_EQ(bench.ovi(9), 0);
}

TEST(Alarms, OfLathes) {
  simulation::Setup setup = latheSetup({});
  place(setup.truth, simulation::RoundBar(20, -150, 0), translation({0, 0, 150}));
  LatheBench bench(setup);
  plantFrame(bench, "$P_UIFR", 1, 0, 150);
  const auto turned = [&](int number, const std::string& text, const std::string& arguments,
                          const std::string& before = {}) {
    expectAlarm(bench, bench.tryRun("DIAMON\nG0 X120\nG0 Z-10\n" + before + "\nCYCLE974(" + arguments + ")"), number,
                text);
  };
  turned(61332, "position of the tool tip", "2,,,1,130,2,4,1,,1");
  turned(61336, "geometry axes", "2,,,1,40,3,4,1,,1");
  turned(61330, "rotation", "2,,,1,40,2,4,1,,1", "ROT Y10\n");
  expectAlarm(bench, bench.tryRun("ROT\nDIAMON\nG0 X120\nG0 Z-10\nCYCLE973(2103,1,4,,1,,3,4,300,1,,2,0)"), 61333,
              "calibration body");
  bench.set("$TC_DP2", {1, 1}, 3);
  turned(61315, "cutting edge position", "2,,,1,40,2,4,1,,1");
}

TEST(Alarms, EachHasATextAndAWayOut) {
  for (const int number : {61300, 61301, 61302, 61303, 61304, 61305, 61306, 61307, 61308, 61309, 61310, 61311, 61313,
                           61314, 61315, 61316, 61317, 61318, 61319, 61321, 61322, 61323, 61324, 61325, 61326, 61328,
                           61330, 61331, 61332, 61333, 61334, 61336, 61338, 61341, 61343, 61351, 61372}) {
    EXPECT_FALSE(cycles::sinumerik::alarmText(number).empty()) << number;
    EXPECT_FALSE(cycles::sinumerik::alarmAdvice(number).empty()) << number;
  }
}

}  // namespace
}  // namespace probewright
