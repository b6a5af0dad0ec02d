#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "app/mixed_program.hpp"

/// Whole runs of the built program: 1,000 mixed cycles on a part of 100,000 triangles, with all output written. Elapsed
/// time of the process and its peak memory.
namespace probewright {
namespace {

namespace fs = std::filesystem;

class Workplace {
public:
  Workplace() {
    std::string pattern = (fs::temp_directory_path() / "probewright-bench-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) std::abort();
    folder_ = pattern;
  }
  ~Workplace() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  std::string put(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return (folder_ / name).string();
  }
  std::string folder() const { return (folder_ / "out").string(); }

private:
  fs::path folder_;
};

void run(benchmark::State& state, const std::string& control, const std::string& name, const std::string& program) {
  const Workplace place;
  place.put("plate.stl", mixed::plateStl());
  std::vector<std::string> words = {PROBEWRIGHT_PROGRAM,
                                    "run",
                                    place.put(name, program),
                                    "--setup",
                                    place.put("plate.toml", mixed::plateSetup(control)),
                                    "--out",
                                    place.folder(),
                                    "--quiet"};
  std::vector<char*> arguments;
  for (std::string& word : words)
    arguments.push_back(word.data());
  arguments.push_back(nullptr);
  long peak = 0;
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    const pid_t child = fork();
    if (child == 0) {
      execv(arguments[0], arguments.data());
      _exit(127);
    }
    int status = 0;
    rusage usage{};
    if (child < 0 || wait4(child, &status, 0, &usage) != child || !WIFEXITED(status) || WEXITSTATUS(status) != 0) {
      state.SkipWithError("the run failed");
      return;
    }
    state.SetIterationTime(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    peak = std::max(peak, usage.ru_maxrss);
  }
  state.counters["peak_MB"] = static_cast<double>(peak) / 1024;
}

void klartext(benchmark::State& state) {
  run(state, "TNC640", "mixed.h", mixed::klartextProgram(static_cast<int>(state.range(0))));
}
BENCHMARK(klartext)->Arg(1000)->UseManualTime()->Unit(benchmark::kMillisecond);

void sinumerik(benchmark::State& state) {
  run(state, "840Dsl", "mixed.mpf", mixed::sinumerikProgram(static_cast<int>(state.range(0))));
}
BENCHMARK(sinumerik)->Arg(1000)->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace probewright
