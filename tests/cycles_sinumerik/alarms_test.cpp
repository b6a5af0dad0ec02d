#include <algorithm>
#include <cctype>
#include <set>

#include "cycles/sinumerik/alarms.hpp"
#include "support/lathe_bench.hpp"
#include "support/sinumerik_bench.hpp"

/// Every alarm and message of the cycles, provoked once: its number, its text, what to do, and _OVI[9].
namespace probewright {
namespace {

using namespace testing_support;

constexpr double table = -350;

std::string lowerCase(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// What an operator and a program see of an alarm.
struct Seen {
  std::string code, text, advice;
  int ovi9 = 0;
};

/// The alarm that a program ends with; otherwise the first message with a number.
template <class Bench>
Seen seenBy(const Bench& bench, const execution::RunResult& result) {
  if (!result.diagnostics.empty()) {
    const Diagnostic& first = result.diagnostics.front();
    EXPECT_NE(bench.control.journal.cycles.back().alarm.find(first.code), std::string::npos) << format(first);
    return {first.code, first.message, first.advice, bench.ovi(9)};
  }
  for (const auto& event : bench.control.journal.events) {
    if (event.code.empty()) continue;
    const auto advice = cycles::sinumerik::alarmAdvice(std::stoi(event.code));
    return {event.code, event.text, std::string(advice), bench.ovi(9)};
  }
  return {};
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
  Seen seen(const char* cycle, const NamedNumbers& call, const Vector3& from, const std::string& before = {},
            const char* tool = "MILL") {
    start(from);
    const cycles::CycleDefinition* definition = cycles::sinumerikCycle(cycle);
    const bool named = std::ranges::any_of(definition->parameters, [](const auto& p) { return p.name == "S_TNAME"; });
    return seenBy(*this, tryRun(cycle, call, named ? NamedTexts{{"S_TNAME", tool}} : NamedTexts{}, before));
  }
};

/// Provokes an alarm by a call of CYCLE978 at the face towards minus X, with what is changed.
Seen edge(const NamedNumbers& changed, const std::string& before = {}, const char* tool = "MILL") {
  return Provoker().seen("CYCLE978", with({{"S_FA", 6}, {"S_TSA", 2}, {"S_MA", 1}, {"S_MD", 1}}, changed),
                         {-30, 30, -10}, before, tool);
}

/// The same with a datum that is wrong.
Seen edgeWith(const char* datum, std::initializer_list<control::sinumerik::DataIndex> indices, double value) {
  Provoker bench;
  bench.set(datum, indices, value);
  return bench.seen("CYCLE978", {{"S_FA", 6}, {"S_TSA", 2}, {"S_MA", 1}, {"S_MD", 1}}, {-30, 30, -10});
}

/// By a call at the hole.
Seen hole(const char* cycle, const NamedNumbers& call) {
  return Provoker().seen(cycle, with({{"S_SETV", 40}, {"S_FA", 5}, {"S_TSA", 2}}, call), {-150, 0, -10});
}

/// By the correction of a tool after measuring the hole.
Seen corrected(const NamedNumbers& call) { return hole("CYCLE977", with({{"S_MVAR", 201}, {"S_KNUM1", 1}}, call)); }

/// By CYCLE974 and 973 at a bar on a lathe.
Seen turned(const std::string& call, const std::string& before = {}, int position = 8) {
  setup::Setup setup = latheSetup({});
  place(setup.world.truth, simulation::RoundBar(20, -150, 0), translation({0, 0, 150}));
  LatheBench bench(setup);
  plantFrame(bench, "$P_UIFR", 1, 0, 150);
  bench.set("$TC_DP2", {1, 1}, position);
  return seenBy(bench, bench.tryRun("DIAMON\nG0 X120\nG0 Z-10\n" + before + "\n" + call));
}

/// An edge at 50 degrees to its axis.
Seen steepEdge() {
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::Box({0, -60, -60}, {80, 60, 0}),
        translation({0, 0, table}) * rotation(Vector3::UnitZ(), 50));
  return Provoker(truth).seen(
      "CYCLE998", {{"S_MVAR", 100005}, {"S_FA", 12}, {"S_TSA", 80}, {"S_MA", 201}, {"S_MD", 1}, {"S_ID", 5}},
      {-14, 0, -10});
}

Seen wrongRotaryAxis() {
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::Box({0, -60, -60}, {80, 60, 0}), translation({0, 0, table}));
  return Provoker(truth).seen("CYCLE998",
                              {{"S_MVAR", 100105},
                               {"S_KNUM", 1},
                               {"S_RA", 2},
                               {"S_FA", 12},
                               {"S_TSA", 80},
                               {"S_MA", 201},
                               {"S_MD", 1},
                               {"S_ID", 5}},
                              {-14, 0, -10});
}

/// A mill whose rear side is to be measured on a swivelled tool carrier of a lathe.
Seen rearSideOnACarrier() {
  setup::Setup setup = latheSetup({});
  machine::MachineDescription& machine = setup.world.truth.machine;
  machine.axes.push_back({.name = "B", .kind = machine::AxisKind::Rotary, .minimum = -120, .maximum = 120});
  machine.spindleChain.push_back({.axis = machine.axes.size() - 1, .direction = Vector3::UnitY()});
  LatheBench bench(setup);
  bench.set("$TC_DP1", {1, 1}, 120);
  bench.set("$MNS_MEA_FUNCTION_MASK", {}, (1 << 16) + 11);
  return seenBy(bench, bench.tryRun("G0 B90\nCYCLE982(13002,0,1,,,,5,1)"));
}

Seen turningWithoutSpeed() {
  Provoker bench;
  bench.set("$TC_DP1", {1, 1}, 120);
  bench.set("$SNS_MEA_CM_MEASURING_ACCURACY", {0}, 0);
  bench.set("$SNS_MEA_CM_MIN_FEEDRATE", {0}, 0);
  return bench.seen("CYCLE971", {{"S_MVAR", 2}, {"S_MA", 1}, {"S_FA", 5}, {"S_TSA", 3}}, {-30, 30, -10});
}

Seen ballWithoutRadius() {
  Provoker bench;
  bench.set("$TC_DP6", {1, 1}, 0);
  bench.set("$SNS_MEA_WP_BALL_DIAM", {0}, 0);
  return bench.seen("CYCLE976", {{"S_MVAR", 3}, {"S_SETV", 30}, {"S_FA", 5}, {"S_TSA", 3}}, {-150, 0, -10});
}

Seen spindleWithoutPosition() {
  simulation::Truth truth = world();
  truth.machine.spindleOrients = false;
  return Provoker(truth).seen("CYCLE978", {{"S_MVAR", 10000}, {"S_FA", 6}, {"S_TSA", 2}, {"S_MA", 1}, {"S_MD", 1}},
                              {-30, 30, -10});
}

/// CYCLE116 raises no alarm: its number stands in _MODE.
Seen circleOfTwoPoints() {
  LatheBench bench(latheSetup({}));
  bench.run("DEF INT _MODE\nDEF REAL _CAL[13]=(2,0,10,-10,0,0,0,0,0,0,0,0,0)\nCYCLE116(_CAL[], _MODE)\nR1=_MODE");
  const int number = static_cast<int>(bench.data("R", {1}));
  return {std::to_string(number), std::string(cycles::sinumerik::alarmText(number)),
          std::string(cycles::sinumerik::alarmAdvice(number)), number};
}

struct Row {
  int number;
  const char* text;
  std::function<Seen()> provoke;
};

const NamedNumbers tolerance = {{"_AMODE", 1}, {"S_TUL", 0.1}, {"S_TLL", -0.1}};

/// Three balls whose second stands half a millimetre too far away, where a tenth is allowed.
Seen distortedTriangle() {
  simulation::Truth truth = perfectWorld();
  for (const Vector3& centre : {Vector3(0, 0, 0), Vector3(60.5, 0, 0), Vector3(0, 60, 0)})
    place(truth, simulation::SolidSphere(centre, 10), translation({0, 0, table}));
  Provoker bench(truth);
  const Seen seen = bench.seen("CYCLE997",
                               {{"S_MVAR", 10109},
                                {"S_KNUM", 1},
                                {"S_SETV", 20},
                                {"S_FA", 5},
                                {"S_TSA", 2},
                                {"S_SETV3", 60},
                                {"S_SETV7", 60},
                                {"S_TNVL", 0.1}},
                               {0, 0, 25});
  EXPECT_EQ(bench.data("$P_UIFR", {1, "X", "FI"}), 0) << "nothing is corrected";
  return seen;
}

Seen kinematicsWithoutMeasurements() {
  return Provoker(perfectWorld("mill5-head-table")).seen("CYCLE996", {{"S_MVAR", 0}, {"S_TC", 1}}, {0, 0, 0});
}

const Row rows[] = {
    {61037, "measuring variant", rearSideOnACarrier},
    {61300, "tool radius compensation", [] { return edge({}, "G41\n"); }},
    {61301, "probe does not switch",
     [] {
       return edge({{"S_SETV", -20}});
     }},
    {61302, "probe collision",
     [] {
       return edge({{"S_SETV", 60}});
     }},
    {61303, "safe area exceeded",
     [] {
       return edge({{"S_SETV", 3}});
     }},
    {61304, "oversize",
     [] {
       return corrected(with(tolerance, {{"S_SETV", 39.8}}));
     }},
    {61305, "undersize",
     [] {
       return corrected(with(tolerance, {{"S_SETV", 40.2}}));
     }},
    {61306, "permissible dimensional difference exceeded",
     [] {
       return corrected({{"S_SETV", 39.5}, {"S_TDIF", 0.3}});
     }},
    {61307, "wrong measuring variant",
     [] {
       return edge({{"S_MVAR", 5}});
     }},
    {61308, "measuring path",
     [] {
       return edge({{"S_FA", 0}});
     }},
    {61309, "probe type",
     [] {
       return edgeWith("$TC_DP1", {1, 1}, 120);
     }},
    {61310, "scale factor", [] { return edge({}, "SCALE X2\n"); }},
    {61310, "mirroring is active", [] { return edge({}, "MIRROR Y0\n"); }},
    {61311, "no d number", [] { return edge({}, "D0\n"); }},
    {61313, "probe number",
     [] {
       return edge({{"S_PRNUM", 13}});
     }},
    {61314, "tool type",
     [] {
       return edge({{"S_MVAR", 200}, {"S_KNUM1", 500001}});
     }},
    {61315, "cutting edge position", [] { return turned("CYCLE974(2,,,1,40,2,4,1,,1)", {}, 3); }},
    // Three points in one place lie on no circle.
    {61316, "centre and radius",
     [] {
       return hole("CYCLE979", {{"S_MVAR", 1}, {"S_CPA", -150}, {"S_INCA", 1e-9}});
     }},
    {61317, "number of points", circleOfTwoPoints},
    {61318, "weighting factor",
     [] {
       return corrected({{"S_EVNUM", 10000}});
     }},
    {61319, "call parameter",
     [] {
       return corrected({{"S_EVNUM", 21}});
     }},
    {61321, "zero offset number",
     [] {
       return edge({{"S_MVAR", 100}, {"S_KNUM", 1017}});
     }},
    {61322, "4th digit",
     [] {
       return edge({{"S_MVAR", 100}, {"S_KNUM", 4001}});
     }},
    {61323, "5th digit",
     [] {
       return edge({{"S_MVAR", 100}, {"S_KNUM", 20001}});
     }},
    {61324, "6th digit",
     [] {
       return edge({{"S_MVAR", 100}, {"S_KNUM", 100001}});
     }},
    {61325, "measuring axis",
     [] {
       return edge({{"S_MA", 4}});
     }},
    {61326, "measuring direction",
     [] {
       return edge({{"S_MD", 3}});
     }},
    {61328, "d number",
     [] {
       return edge({{"S_MVAR", 200}, {"S_KNUM1", 2}});
     }},
    {61329, "rotary axis", wrongRotaryAxis},
    {61330, "rotation", [] { return turned("CYCLE974(2,,,1,40,2,4,1,,1)", "ROT Y10"); }},
    {61331, "angle too large", steepEdge},
    {61332, "position of the tool tip", [] { return turned("CYCLE974(2,,,1,130,2,4,1,,1)"); }},
    {61333, "calibration body", [] { return turned("CYCLE973(2103,1,4,,1,,3,4,300,1,,2,0)"); }},
    {61334, "protection zone",
     [] {
       return hole("CYCLE977", {{"S_MVAR", 1001}, {"S_SZA", 38}, {"S_ID", 20}});
     }},
    {61336, "geometry axes", [] { return turned("CYCLE974(2,,,1,40,3,4,1,,1)"); }},
    {61338, "positioning speed", [] { return edgeWith("$SCS_MEA_FEED_PLANE_VALUE", {}, 0); }},
    {61341, "not calibrated",
     [] {
       return edge({{"S_PRNUM", 2}});
     }},
    {61343, "tool does not exist",
     [] {
       return edge({{"S_MVAR", 200}, {"S_KNUM1", 1}}, {}, "NONE");
     }},
    {61350, "speed of the turning spindle", turningWithoutSpeed},
    {61351, "length or radius", ballWithoutRadius},
    {61372, "spindle that can be positioned", spindleWithoutPosition},
    {61414, "distorted", distortedTriangle},
    {61430, "kinematics", kinematicsWithoutMeasurements},
};

TEST(Alarms, EachOfTheListComesWithNumberTextAndAdvice) {
  std::set<int> provoked;
  for (const auto& [number, text, provoke] : rows) {
    SCOPED_TRACE(fmt::format("{} {}", number, text));
    const Seen seen = provoke();
    EXPECT_EQ(seen.code, std::to_string(number)) << seen.text;
    EXPECT_NE(lowerCase(seen.text).find(text), std::string::npos) << seen.text;
    EXPECT_FALSE(seen.advice.empty());
    EXPECT_EQ(seen.ovi9, number);
    provoked.insert(number);
  }
  // A new alarm needs a new row.
  const std::vector<int> listed = cycles::sinumerik::alarmNumbers();
  EXPECT_TRUE(std::ranges::is_sorted(listed));
  EXPECT_EQ(provoked, std::set<int>(listed.begin(), listed.end()));
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
          language::sinumerik::SinumerikProgram::fromText(fmt::format("{}.SPF", name), text));
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
    execution::InterpreterOptions options;
    options.programDepth = execution::sinumerik::SinumerikHost::programDepth;
    execution::sinumerik::SinumerikHost host(bench.control);
    const execution::RunResult result = execution::Interpreter(nest, host, options)
                                            .run(language::sinumerik::SinumerikProgram::fromText(
                                                "DEEP.MPF", "G17 G90 G71 G54\nT1 D1 M6\nG0 X-30 Y30\nZ-10\nL1\nM30\n"));
    if (depth == 4) {
      EXPECT_TRUE(result.diagnostics.empty()) << format(result.diagnostics.front());
    } else {
      const Seen seen = seenBy(bench, result);
      EXPECT_EQ(seen.code, "61300");
      EXPECT_NE(lowerCase(seen.text).find("cannot be called here"), std::string::npos) << seen.text;
    }
  }
}

TEST(Alarms, MessagesLetTheProgramGoOn) {
  Provoker bench;
  const auto numberAfter = [&](double set, const NamedNumbers& changed) {
    bench.control.journal.events.clear();
    bench.start({-150, 0, -10});
    bench.run("CYCLE977", with({{"S_MVAR", 201}, {"S_KNUM1", 1}, {"S_SETV", set}, {"S_FA", 5}, {"S_TSA", 2}}, changed),
              {{"S_TNAME", "MILL"}}, "R9=0\n");
    return bench.ovi(9);
  };
  EXPECT_EQ(numberAfter(39.8, tolerance), 61304);
  EXPECT_EQ(numberAfter(40.2, tolerance), 61305);
  EXPECT_EQ(numberAfter(39.5, {{"S_TDIF", 0.3}}), 61306);
  EXPECT_EQ(numberAfter(40, tolerance), 0);
  EXPECT_EQ(bench.messages(), "");
}

}  // namespace
}  // namespace probewright
