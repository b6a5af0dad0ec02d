// Random calls of SINUMERIK cycles: any cycle with any argument texts, checked, and run with a calibrated probe in a
// small virtual world (a block, a ring, a ball). Whatever stands in a call, the answer is a message, an alarm or a
// measurement.

#include <fuzzer/FuzzedDataProvider.h>

#include <array>
#include <memory>
#include <string>

#include "control/sinumerik/control.hpp"
#include "control/sinumerik/measuring_data.hpp"
#include "cycles/catalogue.hpp"
#include "language/interpreter.hpp"
#include "language/sinumerik/check.hpp"
#include "language/sinumerik/host.hpp"
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

std::string call(FuzzedDataProvider& input) {
  const auto cycles = cycles::cyclesOf(control::ControlKind::Sinumerik840Dsl);
  const auto pick = input.ConsumeIntegralInRange<std::size_t>(0, cycles.size() + 1);
  std::string text = pick < cycles.size()    ? std::string(cycles[pick]->name)
                     : pick == cycles.size() ? "CYCLE800"
                                             : "CYCLE116";
  const std::size_t most = pick < cycles.size() ? cycles[pick]->parameters.size() + 1 : 16;
  const auto count = input.ConsumeIntegralInRange<std::size_t>(0, most);
  text += '(';
  for (std::size_t i = 0; i < count; ++i)
    text += (i > 0 ? "," : "") + argument(input);
  return text + ")\n";
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
  std::string text = "G90 G71\nT1 D1 M6\n";
  if (lathe) {
    text += "G0 X120\nZ80\n";
  } else {
    static constexpr const char* places[] = {"G54\nG0 X-30 Y0 Z10\nZ-10\n", "G54\nG0 X0 Y0 Z10\n",
                                             "G55\nG0 X0 Y0 Z10\nZ-10\n", "G56\nG0 X0 Y0 Z20\n",
                                             "G56\nG0 X-25 Y0 Z20\nZ0\n"};
    text += input.PickValueInArray(places);
  }
  text += input.PickValueInArray(before);
  const int calls = input.ConsumeIntegralInRange<int>(1, 3);
  for (int i = 0; i < calls; ++i)
    text += call(input);

  const auto program = sinumerik::SinumerikProgram::fromText("fuzz.mpf", text);
  sinumerik::check(*program, {});
  simulation::VirtualMachine machine(worlds[lathe ? 1 : 0]);
  machine.recordPath(false);
  control::sinumerik::Control control(machine, stores[lathe ? 1 : 0]);
  control.channel.pathTolerance = 0.1;
  sinumerik::SinumerikHost host(control);
  NoLibrary library;
  language::InterpreterOptions options;
  options.stepLimit = 200;
  language::Interpreter(library, host, options).run(program);
  return 0;
}
