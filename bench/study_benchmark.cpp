#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <chrono>
#include <filesystem>
#include <fstream>

#include "study/crew.hpp"
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

/// What each rank does with the answers of all: 500 trials of a program of 150 results, put into a message, read from
/// it, and added to the table. A thousandth of the time for a trial is what 1,000 ranks could share among them.
void exchange(benchmark::State& state) {
  std::vector<Draw> draws(500);
  std::vector<Outcome> outcomes(500);
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    draws[i].trial = i;
    for (int k = 0; k < 150; ++k) {
      Observation observation;
      observation.of.key = std::to_string(400 + k) + "@" + std::to_string(19 * k) + " Q153";
      observation.of.label = "actual diameter";
      observation.of.unit = "mm";
      observation.value = 30 + 1e-6 * static_cast<double>(i * 150) + k;
      if (state.range(0) != 0) observation.truth = 30;
      outcomes[i].observations.push_back(observation);
    }
  }
  OutcomeWriter writer;
  OutcomeReader reader;
  std::size_t bytes = 0;
  double writing = 0;
  for (auto _ : state) {
    const auto begin = std::chrono::steady_clock::now();
    const std::string message = writer.write(outcomes);
    writing += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    TrialTable table(0);
    const std::vector<Outcome> read = reader.read(message);
    for (std::size_t i = 0; i < read.size(); ++i)
      table.add(draws[i], read[i]);
    bytes = message.size();
    benchmark::DoNotOptimize(table.size());
  }
  const auto trialsDone = static_cast<double>(state.iterations()) * 500;
  state.counters["bytes_a_trial"] = static_cast<double>(bytes) / 500;
  state.counters["us_written_a_trial"] = 1e6 * writing / trialsDone;
  state.counters["trials"] = benchmark::Counter(trialsDone, benchmark::Counter::kIsRate);
}
BENCHMARK(exchange)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace probewright::study
