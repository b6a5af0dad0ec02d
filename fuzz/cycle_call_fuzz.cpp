// Random calls of SINUMERIK cycles: any cycle with any argument texts, checked, and run with a calibrated probe in a
// small virtual world (a block, a ring, a ball). Whatever stands in a call, the answer is a message, an alarm or a
// measurement.

#include <fuzzer/FuzzedDataProvider.h>

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "control/sinumerik/control.hpp"
#include "control/sinumerik/measuring_data.hpp"
#include "cycles/catalogue.hpp"
#include "execution/interpreter.hpp"
#include "execution/sinumerik/host.hpp"
#include "language/sinumerik/check.hpp"
#include "language/sinumerik/program.hpp"
#include "machine/machine_file.hpp"
#include "simulation/analytic_solids.hpp"
#include "simulation/virtual_machine.hpp"

namespace {

using namespace probewright;

class NoLibrary : public language::ProgramLibrary {
public:
  Result<std::shared_ptr<language::Program>> open(std::string_view, const language::Program*) override {
    return fail("there are no other programs");
  }
  bool exists(std::string_view, const language::Program*) override { return false; }
};

/// A world for each place to measure: block, ring and ball stand around the origin of G54 to G56.
simulation::Truth world(bool lathe) {
  simulation::Truth truth;
  truth.machine = machine::readMachine(lathe ? "lathe2c" : "mill5-table-table").value();
  truth.start = truth.machine.toolChange;
  simulation::TrueTool probe;
  probe.number = 1;
  probe.name = "PROBE";
  probe.length = 100;
  probe.probe.ballRadius = 2;
  probe.probe.stylusRadius = 1;
  probe.probe.stylusLength = 60;
  if (lathe) {
    probe.shankDirection = Vector3::UnitX();
    truth.tools.push_back(probe);
    truth.solids.push_back(
        {std::make_shared<simulation::RoundBar>(20, 0, 100), Pose::Identity(), "bar", simulation::SolidRole::Part});
    return truth;
  }
  truth.tools.push_back(probe);
  const auto place = [&](std::shared_ptr<simulation::Solid> solid, const Vector3& at, const char* name) {
    Pose pose = Pose::Identity();
    pose.translation() = at;
    truth.solids.push_back({std::move(solid), pose, name, simulation::SolidRole::Part});
  };
  place(std::make_shared<simulation::Box>(Vector3(-20, -15, -30), Vector3(20, 15, 0)), {0, 0, -400}, "block");
  place(std::make_shared<simulation::Ring>(15, 40, -20), {120, 0, -400}, "ring");
  place(std::make_shared<simulation::SolidSphere>(Vector3::Zero(), 12.5), {-120, 0, -400}, "ball");
  return truth;
}

control::sinumerik::DataStore data(bool lathe) {
  control::sinumerik::DataStore store;
  control::sinumerik::setMeasuringDefaults(store);
  store.load({"$TC_TP2", {1}}, std::string("PROBE"));
  store.load({"$TC_DP1", {1, 1}}, lathe ? 580.0 : 710.0);
  store.load({"$TC_DP2", {1, 1}}, lathe ? 8.0 : 0.0);
  store.load({"$TC_DP3", {1, 1}}, 100.0);
  store.load({"$TC_DP6", {1, 1}}, 2.0);
  store.load({"$TC_TP2", {2}}, std::string("MILL"));
  store.load({"$TC_DP1", {2, 1}}, lathe ? 500.0 : 120.0);
  store.load({"$TC_DP3", {2, 1}}, 80.0);
  store.load({"$TC_DP6", {2, 1}}, 5.0);
  store.load({"$SNS_MEA_WP_BALL_DIAM", {0}}, 4.0);
  for (const char* axis : {"1", "2", "3"}) {
    store.load({std::string("$SNS_MEA_WP_TRIG_MINUS_DIR_AX") + axis, {0}}, -2.0);
    store.load({std::string("$SNS_MEA_WP_TRIG_PLUS_DIR_AX") + axis, {0}}, 2.0);
  }
  if (lathe) return store;
  for (int frame = 1; frame <= 3; ++frame) {
    store.load({"$P_UIFR", {frame, "X", "TR"}}, frame == 1 ? 0.0 : frame == 2 ? 120.0 : -120.0);
    store.load({"$P_UIFR", {frame, "Z", "TR"}}, -400.0);
  }
  return store;
}

std::string argument(FuzzedDataProvider& input) {
  static constexpr const char* codes[] = {"0",     "1",      "2",       "3",       "5",       "10",    "100",
                                          "101",   "102",    "110",     "201",     "1001",    "1101",  "2000",
                                          "9999",  "10001",  "11001",   "12103",   "-1",      "20101", "99999",
                                          "12345", "100000", "1000101", "2000000", "99999999"};
  static constexpr const char* odd[] = {"\"PROBE\"",
                                        "\"MILL\"",
                                        "\"\"",
                                        "\"2\"",
                                        "R1",
                                        "R[7]",
                                        "TRUE",
                                        "X",
                                        "SIN(30)",
                                        "1/0",
                                        "1EX99",
                                        "-1EX-99",
                                        "$P_UIFR[1,X,TR]",
                                        "$AA_IW[X]",
                                        "_OVR[4]",
                                        "\"A\"<<R1",
                                        "2147483648",
                                        "((((1))))",
                                        "NOT 0",
                                        "'HFF'",
                                        "SQRT(-1)"};
  switch (input.ConsumeIntegralInRange<int>(0, 9)) {
    case 0:
    case 1:
    case 2:
      return {};
    case 3:
    case 4:
      return input.PickValueInArray(codes);
    case 5:
      return input.PickValueInArray(odd);
    case 6:
      return std::to_string(input.ConsumeIntegralInRange<int>(-40, 40));
    case 7:
      return std::to_string(input.ConsumeIntegralInRange<int>(-4000, 4000) / 100.0);
    case 8:
      return std::to_string(input.ConsumeIntegralInRange<int>(0, 2222222));
    default:
      return input.ConsumeRandomLengthString(12);
  }
}

using Named = std::vector<std::pair<std::string_view, const char*>>;

/// A call that measures, and where it begins.
struct Sound {
  const char* way;
  const char* cycle;
  Named arguments;
};

const std::vector<Sound>& soundCalls(bool lathe) {
  static constexpr const char* edge = "G54\nG0 X-30 Y0 Z10\nZ-10\n";
  static constexpr const char* top = "G54\nG0 X0 Y0 Z10\n";
  static constexpr const char* corner = "G54\nG0 X-30 Y-25 Z10\nZ-10\n";
  static constexpr const char* hole = "G55\nG0 X0 Y0 Z10\nZ-8\n";
  static constexpr const char* ball = "G56\nG0 X0 Y0 Z22\n";
  static constexpr const char* outside = "G0 Z80\nX120\n";
  static const std::vector<Sound> mill = {
      {edge,
       "CYCLE978",
       {{"S_MVAR", "100"},
        {"S_KNUM", "1"},
        {"S_SETV", "-20"},
        {"S_FA", "8"},
        {"S_TSA", "5"},
        {"S_MA", "1"},
        {"S_MD", "1"}}},
      {top,
       "CYCLE978",
       {{"S_MVAR", "200"},
        {"S_KNUM1", "1"},
        {"S_FA", "8"},
        {"S_TSA", "5"},
        {"S_MA", "3"},
        {"S_MD", "2"},
        {"S_TNAME", "\"MILL\""}}},
      {hole, "CYCLE976", {{"S_MVAR", "1"}, {"S_SETV", "30"}, {"S_FA", "8"}, {"S_TSA", "3"}}},
      {hole, "CYCLE977", {{"S_MVAR", "101"}, {"S_KNUM", "2"}, {"S_SETV", "30"}, {"S_FA", "8"}, {"S_TSA", "5"}}},
      {top,
       "CYCLE977",
       {{"S_MVAR", "106"},
        {"S_KNUM", "1"},
        {"S_SETV0", "40"},
        {"S_SETV1", "30"},
        {"S_ID", "-20"},
        {"S_FA", "8"},
        {"S_TSA", "5"}}},
      {top,
       "CYCLE977",
       {{"S_MVAR", "104"}, {"S_SETV", "30"}, {"S_MA", "2"}, {"S_ID", "-20"}, {"S_FA", "8"}, {"S_TSA", "5"}}},
      {hole,
       "CYCLE979",
       {{"S_MVAR", "101"}, {"S_KNUM", "10002"}, {"S_SETV", "30"}, {"S_INCA", "80"}, {"S_FA", "8"}, {"S_TSA", "5"}}},
      {corner,
       "CYCLE961",
       {{"S_MVAR", "106"},
        {"S_KNUM", "1"},
        {"S_FA", "15"},
        {"S_TSA", "8"},
        {"S_SETV0", "20"},
        {"S_SETV1", "35"},
        {"S_SETV2", "20"},
        {"S_SETV3", "30"},
        {"S_SETV4", "-30"},
        {"S_SETV5", "-25"},
        {"S_INCA", "90"}}},
      {edge,
       "CYCLE998",
       {{"S_MVAR", "100105"},
        {"S_KNUM", "1"},
        {"S_FA", "9"},
        {"S_TSA", "12"},
        {"S_MA", "201"},
        {"S_MD", "1"},
        {"S_ID", "10"}}},
      {top,
       "CYCLE998",
       {{"S_MVAR", "100106"}, {"S_KNUM", "1"}, {"S_FA", "9"}, {"S_TSA", "12"}, {"S_SETV0", "10"}, {"S_SETV3", "10"}}},
      {ball,
       "CYCLE997",
       {{"S_MVAR", "101119"}, {"S_KNUM", "3"}, {"S_SETV", "25"}, {"S_INCA", "90"}, {"S_FA", "8"}, {"S_TSA", "5"}}},
  };
  static const std::vector<Sound> turned = {
      {outside,
       "CYCLE974",
       {{"S_MVAR", "102"}, {"S_KNUM", "1"}, {"S_SETV", "40"}, {"S_MA", "2"}, {"S_FA", "50"}, {"S_TSA", "4"}}},
      {outside,
       "CYCLE994",
       {{"S_MVAR", "2"}, {"S_SETV", "40"}, {"S_MA", "2"}, {"S_SZO", "30"}, {"S_FA", "50"}, {"S_TSA", "4"}}},
      {outside,
       "CYCLE973",
       {{"S_MVAR", "0"}, {"S_SETV", "40"}, {"S_MA", "2"}, {"S_MD", "2"}, {"S_FA", "50"}, {"S_TSA", "4"}}},
  };
  return lathe ? turned : mill;
}

std::string text(const char* cycle, const std::vector<std::string>& places) {
  std::string call = std::string(cycle) + "(";
  for (std::size_t i = 0; i < places.size(); ++i)
    call += (i > 0 ? "," : "") + places[i];
  return call + ")\n";
}

/// A call that measures, with up to four of its arguments changed.
std::string nearlySoundCall(FuzzedDataProvider& input, bool lathe) {
  const auto& all = soundCalls(lathe);
  const Sound& sound = all[input.ConsumeIntegralInRange<std::size_t>(0, all.size() - 1)];
  const cycles::CycleDefinition& definition = *cycles::sinumerikCycle(sound.cycle);
  std::vector<std::string> places(definition.parameters.size());
  for (const cycles::Parameter& parameter : definition.parameters) {
    for (const auto& [name, value] : sound.arguments)
      if (parameter.name == name) places[parameter.address] = value;
  }
  for (int changes = input.ConsumeIntegralInRange<int>(0, 4); changes > 0; --changes)
    places[input.ConsumeIntegralInRange<std::size_t>(0, places.size() - 1)] = argument(input);
  return (lathe ? "G90 G0 X150\n" : "G90 SUPA G0 Z0 D0\nD1\n") + (sound.way + text(sound.cycle, places));
}

/// Any cycle with anything.
std::string anyCall(FuzzedDataProvider& input) {
  const auto cycles = cycles::cyclesOf(control::ControlKind::Sinumerik840Dsl);
  const auto pick = input.ConsumeIntegralInRange<std::size_t>(0, cycles.size() + 1);
  const bool known = pick < cycles.size();
  const std::string name = known ? std::string(cycles[pick]->name) : pick == cycles.size() ? "CYCLE800" : "CYCLE116";
  const std::size_t most = known ? cycles[pick]->parameters.size() + 1 : 16;
  std::vector<std::string> places(input.ConsumeIntegralInRange<std::size_t>(0, most));
  for (std::string& place : places)
    place = argument(input);
  return text(name.c_str(), places);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  FuzzedDataProvider input(bytes, size);
  const bool lathe = input.ConsumeBool();
  static const std::array<simulation::Truth, 2> worlds = {world(false), world(true)};
  static const std::array<control::sinumerik::DataStore, 2> stores = {data(false), data(true)};

  static constexpr const char* before[] = {"",           "G19\n",      "G70\n",       "G700\n",        "ROT Z30\n",
                                           "SCALE X2\n", "G18\n",      "MIRROR X0\n", "TRANS X5 Z1\n", "DIAMOF\n",
                                           "G500\n",     "AROT X10\n", "DIAMON\n",    "G91\n"};
  std::string source = "G90 G71\nT1 D1 M6\n";
  source += lathe ? "G0 X150\nZ80\n" : "G54\nG0 X-30 Y0 Z10\nZ-10\n";
  if (input.ConsumeBool()) source += input.PickValueInArray(before);
  for (int calls = input.ConsumeIntegralInRange<int>(1, 3); calls > 0; --calls)
    source += calls == 1 && input.ConsumeBool() ? anyCall(input) : nearlySoundCall(input, lathe);

  const auto program = language::sinumerik::SinumerikProgram::fromText("fuzz.mpf", source);
  language::sinumerik::check(*program, {});
  simulation::VirtualMachine machine(worlds[lathe ? 1 : 0]);
  machine.record(simulation::Recording::Nothing);
  control::sinumerik::Control control(machine, stores[lathe ? 1 : 0]);
  control.channel.pathTolerance = 0.1;
  execution::sinumerik::SinumerikHost host(control);
  NoLibrary library;
  execution::InterpreterOptions options;
  options.stepLimit = 200;
  execution::Interpreter(library, host, options).run(program);
  return 0;
}
