#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <filesystem>
#include <fstream>

#include "study/program_model.hpp"

/// Trials per second of a program of 100 touches: 25 bores with four touches each, in a plate whose place varies.
namespace probewright::study {
namespace {

std::string setupText() {
  std::string text = R"(
[control]
type = "TNC640"
[part]
pose = { x = 0, y = 0, z = -500 }
[[part.feature]]
shape = "box"
size = [300, 300, 20]
[[part.feature]]
shape = "hole"
centre = [-100, -100, 20]
diameter = 30
[[part.feature.pattern]]
kind = "linear"
count = 5
spacing = [50, 0, 0]
[[part.feature.pattern]]
kind = "linear"
count = 5
spacing = [0, 50, 0]
[[preset]]
row = 1
origin = [0, 0, -480]
active = true
[[tool]]
number = 1
name = "PROBE"
kind = "probe"
length = 150
ball_radius = 3
repeatability = 0.0005
)";
  return text;
}

std::string programText() {
  std::string text = "0 BEGIN PGM P MM\n1 TOOL CALL 1 Z\n2 L Z+50 R0 FMAX\n";
  int block = 3;
  for (int i = 0; i < 25; ++i) {
    text += std::to_string(block++) + " TCH PROBE 421 BORE ~\nQ273=" + std::to_string(-100 + 50 * (i % 5)) +
            " ~\nQ274=" + std::to_string(-100 + 50 * (i / 5)) +
            " ~\nQ262=+30 ~\nQ325=+0 ~\nQ247=+90 ~\nQ261=-5 ~\nQ320=+2 ~\nQ260=+20 ~\nQ301=+0 ~\nQ275=+0 ~\nQ276=+0 ~\n"
            "Q279=+0 ~\nQ280=+0 ~\nQ281=+0 ~\nQ309=+0 ~\nQ330=+0 ~\nQ423=+4 ~\nQ365=+0\n";
  }
  return text + std::to_string(block) + " END PGM P MM\n";
}

void trials(benchmark::State& state, bool trueValues) {
  Diagnostics mistakes;
  auto document = setup::SetupDocument::parse(setupText(), "setup.toml", mistakes);
  auto study =
      parseStudy("trials = 1\n[[source]]\nquantity = \"part.pose.x\"\ndistribution = \"uniform\"\nhalf_width = 0.3\n",
                 "study.toml", document->table(), mistakes);
  study->trueValues = trueValues;
  const auto path = std::filesystem::temp_directory_path() / "probewright-study-benchmark.h";
  std::ofstream(path) << programText();
  const auto model = ProgramModel::make(path, std::move(*document), *study, {}, mistakes);
  if (!model) return state.SkipWithError("the program cannot run");
  const Sampler sampler(*study);
  constexpr std::uint64_t block = 250;
  std::uint64_t trial = 0;
  for (auto _ : state) {
    std::vector<Draw> draws;
    for (std::uint64_t i = 0; i < block; ++i)
      draws.push_back(sampler.draw(trial++));
    const auto outcomes =
        runTrials([&](const Draw& draw) { return model->run(draw); }, draws, static_cast<int>(state.range(0)));
    if (outcomes.back().end != TrialEnd::Finished) state.SkipWithError(outcomes.back().why.c_str());
  }
  state.counters["trials"] = benchmark::Counter(static_cast<double>(trial), benchmark::Counter::kIsRate);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  state.counters["MB"] = static_cast<double>(usage.ru_maxrss) / 1024;
}
BENCHMARK_CAPTURE(trials, with_true_values, true)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(trials, without, false)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace probewright::study
