#include <map>
#include <set>

#include "cycles/catalogue.hpp"
#include "language/sinumerik/check.hpp"
#include "support/lathe_bench.hpp"

/// Every digit of S_MVAR in the cycles for lathes: each value that the catalogue lists runs and does something else
/// than the others; and the lists of results of the manual.
namespace probewright {
namespace {

using namespace testing_support;

constexpr double face = 200;

/// A lathe with a part and the probe in front of it.
struct Scene {
  setup::Setup setup;
  std::string way;
  std::function<void(LatheBench&)> data = [](LatheBench&) {};
};

LatheProbe probeAt(int position) {
  LatheProbe probe;
  probe.position = position;
  if (position != 8) probe.mount = {-75, 0, 0};
  probe.pretravel = 0.01;
  probe.axialPretravel = 0.02;
  return probe;
}

Scene sceneOf(std::string_view name) {
  if (name == "thirdAxis") {
    LatheProbe probe;
    probe.position = 7;
    probe.mount = {-50, 0, 0};
    Scene scene{latheSetup(probe, "mill3"), "G0 Z60\n"};
    place(scene.setup.world.truth, simulation::RoundBar(18, -80, 0), translation({50, 0, -350}));
    scene.data = [](LatheBench& bench) {
      bench.set("$TC_DP1", {1, 1}, 580);
      bench.set("$TC_DP2", {1, 1}, 7);
      bench.set("$TC_DP3", {1, 1}, 50);
      bench.set("$TC_DP4", {1, 1}, 98);
      bench.set("$SNS_MEA_WP_TRIG_MINUS_DIR_AX3", {0}, -2);
      bench.set("$SNS_MEA_WP_TRIG_PLUS_DIR_AX3", {0}, 2);
      bench.set("$MCS_MEA_FUNCTION_MASK", {}, 2);
      plantFrame(bench, "$P_UIFR", 1, 50, -350);
    };
    return scene;
  }
  const bool under = name == "face" || name == "bore" || name == "round";
  Scene scene{latheSetup(probeAt(under ? 7 : 8)), ""};
  simulation::Truth& truth = scene.setup.world.truth;
  if (name == "face") {
    place(truth, simulation::RoundBar(40, -100, 0), translation({0, 0, face + 0.25}));
    scene.way = "G0 Z40\nG0 X40\nG0 Z12\n";
  } else if (name == "bore") {
    place(truth, simulation::Ring(40.1, 70, -100), translation({0, 0, face}));
    scene.way = "G0 Z30\nG0 X60\nG0 Z-10\n";
  } else if (name == "round") {
    place(truth, simulation::RoundBar(20.1, -100, 0), translation({0, 0, face}));
    scene.way = "G0 X80\nG0 Z-10\n";
  } else if (name == "groove") {
    place(truth, simulation::Box({90, -20, 270}, {100, 20, 310}));
    place(truth, simulation::Box({100, -20, 270}, {112, 20, 280}));
    place(truth, simulation::Box({100, -20, 300}, {112, 20, 310}));
    scene.way = "G0 X264 Z92\n";
  } else {
    place(truth, simulation::RoundBar(40.1, -100, 0), translation({0.2, 0, face}));
    scene.way = "G0 X110\nG0 Z-10\n";
  }
  scene.data = [](LatheBench& bench) {
    plantFrame(bench, "$P_UIFR", 1, 0, face);
    // Entered a little beside where the walls are.
    bench.set("$SNS_MEA_CAL_EDGE_BASE_AX2", {0}, 100);
    bench.set("$SNS_MEA_CAL_EDGE_UPPER_AX2", {0}, 112);
    bench.set("$SNS_MEA_CAL_EDGE_PLUS_DIR_AX1", {0}, 300.1);
    bench.set("$SNS_MEA_CAL_EDGE_MINUS_DIR_AX1", {0}, 280.1);
  };
  return scene;
}

/// One value of a digit of S_MVAR, and a call that has it.
struct Value {
  const char* cycle;
  int place, value;
  const char* scene;
  const char* call;
};

constexpr Value values[] = {
    {"CYCLE973", 1, 0, "bar", "CYCLE973(1100,1,,80,2,1,6,4)"},
    {"CYCLE973", 1, 1, "bar", "CYCLE973(1101,1,,80,2,1,6,4)"},
    {"CYCLE973", 1, 2, "groove", "CYCLE973(102,1,1,,,,3,4)"},
    {"CYCLE973", 1, 3, "groove", "CYCLE973(2103,1,1,,1,,3,4)"},
    {"CYCLE973", 3, 1, "bar", "CYCLE973(1100,1,,80,2,1,6,4)"},
    {"CYCLE973", 4, 0, "groove", "CYCLE973(102,1,1,,1,,3,4)"},
    {"CYCLE973", 4, 1, "groove", "CYCLE973(1103,1,1,,1,,3,4)"},
    {"CYCLE973", 4, 2, "groove", "CYCLE973(2103,1,1,,1,,3,4)"},
    {"CYCLE973", 5, 0, "groove", "CYCLE973(2103,1,1,,1,,3,4)"},
    {"CYCLE973", 5, 1, "groove", "CYCLE973(12103,1,1,,1,,3,4)"},
    {"CYCLE973", 7, 0, "bar", "CYCLE973(1100,1,,80,2,1,6,4)"},
    {"CYCLE973", 7, 1, "bar", "CYCLE973(1001100,1,,80,2,1,6,4)"},
    {"CYCLE974", 1, 0, "face", "CYCLE974(0,,,1,0,1,6,4)"},
    {"CYCLE974", 1, 1, "bore", "CYCLE974(1,,,1,80,2,6,4)"},
    {"CYCLE974", 1, 2, "bar", "CYCLE974(2,,,1,80,2,6,4)"},
    {"CYCLE974", 3, 0, "bar", "CYCLE974(2,1,1,1,80,2,6,4,,1,\"FINISH\")"},
    {"CYCLE974", 3, 1, "bar", "CYCLE974(102,1,1,1,80,2,6,4,,1,\"FINISH\")"},
    {"CYCLE974", 3, 2, "bar", "CYCLE974(202,1,1,1,80,2,6,4,,1,\"FINISH\")"},
    {"CYCLE974", 5, 0, "bar", "CYCLE974(2,,,1,80,2,6,4,30)"},
    {"CYCLE974", 5, 1, "bar", "CYCLE974(10002,,,1,80,2,6,4,30)"},
    {"CYCLE994", 1, 1, "bore", "CYCLE994(1,,,1,80,2,,30,6,4)"},
    {"CYCLE994", 1, 2, "round", "CYCLE994(2,,,1,40,2,,30,6,4)"},
    {"CYCLE994", 3, 0, "round", "CYCLE994(2,1,1,1,40,2,,30,6,4,1,\"FINISH\")"},
    {"CYCLE994", 3, 1, "round", "CYCLE994(102,1,1,1,40,2,,30,6,4,1,\"FINISH\")"},
    {"CYCLE994", 3, 2, "round", "CYCLE994(202,1,1,1,40,2,,30,6,4,1,\"FINISH\")"},
    {"CYCLE994", 4, 0, "round", "CYCLE994(2,,,1,40,2,66,30,6,4)"},
    {"CYCLE994", 4, 1, "round", "CYCLE994(1002,,,1,40,2,66,30,6,4)"},
    {"CYCLE994", 4, 2, "thirdAxis", "G0 X0 Y60\nG0 Z-10\nCYCLE994(2002,,,1,36.4,3,0,40,4,3)"},
    {"CYCLE994", 4, 3, "thirdAxis", "G0 X60 Y0\nG0 Z-10\nCYCLE994(3002,,,1,36.4,2,0,40,4,3)"},
};

/// The call with its lengths and feeds in inches, and the word that says so in front of it.
std::string inInches(const std::string& text) {
  const std::size_t name = text.find("CYCLE"), open = text.find('(', name);
  const cycles::CycleDefinition& definition = *cycles::sinumerikCycle(text.substr(name, open - name));
  std::string call = text.substr(0, name) + "G700\n" + text.substr(name, open + 1 - name);
  std::size_t at = open + 1;
  for (const cycles::Parameter& parameter : definition.parameters) {
    const std::size_t end = text.find_first_of(",)", at);
    const std::string argument = text.substr(at, end - at);
    const bool length = parameter.kind == cycles::ValueKind::Length || parameter.kind == cycles::ValueKind::Feed;
    call += length && !argument.empty() ? fmt::format("{:.12f}", std::stod(argument) / 25.4) : argument;
    call += text[end];
    if (text[end] == ')') break;
    at = end + 1;
  }
  return call;
}

control::CycleRecord carriedOut(const Value& value, bool inches = false) {
  const Scene scene = sceneOf(value.scene);
  LatheBench bench(scene.setup);
  scene.data(bench);
  bench.run("DIAMON\n" + (std::string_view(value.scene) == "thirdAxis" ? "" : std::string("G0 X300\n")) + scene.way +
            (inches ? inInches(value.call) : value.call));
  EXPECT_EQ(bench.ovi(2), std::stoi(value.cycle + 5));
  for (const auto& result : bench.control.journal.cycles.back().results) {
    if (!inches || result.unit != "mm") continue;
    EXPECT_NEAR(bench.ovr(std::stoi(result.name.substr(5))) * 25.4, result.value, 1e-9) << result.name;
  }
  return bench.control.journal.cycles.back();
}

std::string deedsOf(const control::CycleRecord& record) {
  std::string deeds;
  for (const auto& result : record.results)
    if (result.name != "_OVI[3]") deeds += fmt::format("{} = {:.5f}\n", result.name, result.value);
  for (const auto& write : record.writes)
    deeds += fmt::format("{}{} = {}\n", write.table, write.entry, write.after);
  for (const auto& touch : record.touches)
    deeds += fmt::format("{:.4f} {:.4f} {:.4f}\n", touch.surface.x(), touch.surface.y(), touch.surface.z());
  return deeds + fmt::format("{:.3f} s\n", record.endSeconds - record.startSeconds);
}

TEST(TurningDigits, EachValueOfSMvarDoesSomethingOfItsOwn) {
  for (const char* cycle : {"CYCLE973", "CYCLE974", "CYCLE994"}) {
    for (const cycles::CodeDigit& digit : cycles::sinumerikCycle(cycle)->parameters.front().digits) {
      std::map<std::string, int> seen;
      for (const cycles::Choice& choice : digit.choices) {
        SCOPED_TRACE(fmt::format("{} digit {} = {} ({})", cycle, digit.place, choice.value, choice.meaning));
        const auto found = std::ranges::find_if(values, [&](const Value& value) {
          return std::string_view(value.cycle) == cycle && value.place == digit.place && value.value == choice.value;
        });
        ASSERT_NE(found, std::end(values)) << "no call has it";
        const auto [known, first] = seen.try_emplace(deedsOf(carriedOut(*found)), choice.value);
        EXPECT_TRUE(first) << "as " << known->second;
      }
    }
  }
}

TEST(TurningDigits, MeanTheSameInInches) {
  for (const Value& value : values) {
    if (std::string_view(value.cycle) == "CYCLE994" && value.place == 3 && value.value == 1) continue;
    SCOPED_TRACE(value.call);
    const control::CycleRecord metric = carriedOut(value), inches = carriedOut(value, true);
    ASSERT_EQ(metric.results.size(), inches.results.size());
    for (std::size_t i = 0; i < metric.results.size(); ++i) {
      EXPECT_EQ(metric.results[i].name, inches.results[i].name);
      EXPECT_NEAR(metric.results[i].value, inches.results[i].value, 1e-7) << metric.results[i].name;
    }
    ASSERT_EQ(metric.writes.size(), inches.writes.size());
    for (std::size_t i = 0; i < metric.writes.size(); ++i) {
      EXPECT_EQ(metric.writes[i].table + metric.writes[i].entry, inches.writes[i].table + inches.writes[i].entry);
      EXPECT_NEAR(std::stod(metric.writes[i].after), std::stod(inches.writes[i].after), 1e-7);
    }
  }
}

// ---- arguments left out ----

std::vector<std::string> argumentsOf(const std::string& call) {
  std::vector<std::string> arguments(1);
  for (const char c : call.substr(call.find('(') + 1)) {
    if (c == ')') break;
    if (c == ',') {
      arguments.emplace_back();
    } else {
      arguments.back() += c;
    }
  }
  return arguments;
}

/// True if the alarm is about the call, not about what the probe met or what the machine has.
bool isOfTheCall(const Diagnostics& diagnostics) {
  if (diagnostics.empty()) return false;
  const std::string& code = diagnostics.front().code;
  if (code == "61334") return diagnostics.front().message.find("S_SZO must be") != std::string::npos;
  static constexpr const char* met[] = {"61301", "61302", "61303", "61331", "61332", "61343", "10720"};
  return std::ranges::find(met, code) == std::end(met);
}

/// What `check` lets pass a run does not refuse for its call, and the other way round.
void expectAgreement(const Value& value, const std::vector<std::string>& arguments) {
  const std::string before = std::string(value.call).substr(0, std::string_view(value.call).find("CYCLE"));
  const std::string call = fmt::format("{}({})", value.cycle, fmt::join(arguments, ","));
  SCOPED_TRACE(call);
  const auto program = language::sinumerik::SinumerikProgram::fromText("TEST.MPF", call + "\nM30\n");
  const bool passes = std::ranges::none_of(language::sinumerik::check(*program),
                                           [](const Diagnostic& each) { return each.severity == Severity::Error; });
  const Scene scene = sceneOf(value.scene);
  LatheBench bench(scene.setup);
  scene.data(bench);
  const execution::RunResult result =
      bench.tryRun("DIAMON\n" + (std::string_view(value.scene) == "thirdAxis" ? "" : std::string("G0 X300\n")) +
                   scene.way + before + call);
  EXPECT_EQ(passes, !isOfTheCall(result.diagnostics))
      << (result.diagnostics.empty() ? "" : result.diagnostics.front().message);
}

TEST(TurningLeftOut, EachArgumentOfEachCall) {
  for (const Value& value : values) {
    const std::vector<std::string> whole = argumentsOf(value.call);
    for (std::size_t i = 1; i < whole.size(); ++i) {
      if (whole[i].empty()) continue;
      std::vector<std::string> call = whole;
      call[i].clear();
      expectAgreement(value, call);
    }
  }
}

TEST(TurningLeftOut, TheEndOfEachCall) {
  for (const Value& value : values) {
    const std::vector<std::string> whole = argumentsOf(value.call);
    for (std::size_t count = 1; count < whole.size(); ++count)
      expectAgreement(value, {whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(count)});
  }
}

TEST(TurningDigits, LeaveTheResultsThatTheManualLists) {
  std::set<int> calibration = {4, 5, 20, 21, 27, 28};
  for (int i = 8; i <= 15; ++i)
    calibration.insert(i);
  for (const Value& value : values) {
    const int task = value.place == 3 ? value.value : 0;
    if (std::string_view(value.cycle) == "CYCLE994" && task == 1) continue;
    SCOPED_TRACE(value.call);
    const control::CycleRecord record = carriedOut(value);
    std::set<int> reals;
    for (const auto& result : record.results) {
      EXPECT_FALSE(result.meaning.empty()) << result.name;
      if (result.name.starts_with("_OVR[")) reals.insert(std::stoi(result.name.substr(5)));
    }
    if (std::string_view(value.cycle) == "CYCLE973") {
      reals.erase(22);  // the length, where it is corrected
      EXPECT_EQ(reals, calibration);
      continue;
    }
    const std::string_view scene = value.scene;
    const int axis = scene == "face" ? 0 : scene == "thirdAxis" && value.value == 2 ? 2 : 1;
    std::set<int> expected = {0, 1 + axis, 4, 5 + axis, 16, 17 + axis};
    if (task == 1) expected.insert(28);
    if (task == 2) expected.insert({20, 27, 28, 29, 30, 31});
    EXPECT_EQ(reals, expected);
  }
}

}  // namespace
}  // namespace probewright
