#include <benchmark/benchmark.h>
#include <sys/resource.h>
#include <unistd.h>

#include <IGESControl_Reader.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Reader.hxx>
#include <TopoDS_Shape.hxx>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <vector>

#include "simulation/cad_solid.hpp"

/// Parts made ready for contacts, beside the time in which OpenCASCADE alone reads them; of the files in the folder
/// PROBEWRIGHT_PARTS, else of the housing. "processor" is that of all threads and processes.
namespace probewright::simulation {
namespace {

namespace fs = std::filesystem;

bool isIges(const fs::path& file) { return file.extension() == ".igs" || file.extension() == ".iges"; }

double processorSeconds() {
  double sum = 0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    getrusage(who, &usage);
    for (const timeval& time : {usage.ru_utime, usage.ru_stime})
      sum += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  }
  return sum;
}

template <class Work>
void measure(benchmark::State& state, const Work& work) {
  const double before = processorSeconds();
  for (auto _ : state) {
    if (!work()) return state.SkipWithError("it cannot be read");
  }
  state.counters["processor"] = benchmark::Counter(processorSeconds() - before, benchmark::Counter::kAvgIterations);
}

void openCascade(benchmark::State& state, const fs::path& file) {
  Message::DefaultMessenger()->ChangePrinters().Clear();
  measure(state, [&] {
    std::unique_ptr<XSControl_Reader> reader;
    if (isIges(file))
      reader = std::make_unique<IGESControl_Reader>();
    else
      reader = std::make_unique<STEPControl_Reader>();
    if (reader->ReadFile(file.c_str()) != IFSelect_RetDone) return false;
    reader->TransferRoots();
    return !reader->OneShape().IsNull();
  });
}

void imported(benchmark::State& state, const fs::path& file, const fs::path& cache) {
  ImportOptions options;
  options.cache = cache;
  const auto read = [&] { return isIges(file) ? readIges(file, options) : readStep(file, options); };
  if (!cache.empty() && !read()) return state.SkipWithError("it cannot be read");
  measure(state, [&] { return read().has_value(); });
}

std::vector<fs::path> parts() {
  const char* folder = std::getenv("PROBEWRIGHT_PARTS");
  if (folder == nullptr) return {PROBEWRIGHT_SOURCE_DIR "/examples/parts/housing.step"};
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path ending = entry.path().extension();
    if (isIges(entry.path()) || ending == ".step" || ending == ".stp") files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

const bool kRegistered = [] {
  const fs::path cache = fs::temp_directory_path() / ("probewright-bench-" + std::to_string(getpid()));
  const auto add = [](const std::string& name, const auto& run) {
    benchmark::RegisterBenchmark(name.c_str(), run)->Unit(benchmark::kMillisecond)->UseRealTime();
  };
  for (const fs::path& file : parts()) {
    const std::string name = file.filename().string();
    add(name + "/OpenCASCADE", [file](benchmark::State& state) { openCascade(state, file); });
    add(name + "/import", [file](benchmark::State& state) { imported(state, file, {}); });
    add(name + "/again", [file, cache](benchmark::State& state) {
      imported(state, file, cache);
      fs::remove_all(cache);
    });
  }
  return true;
}();

}  // namespace
}  // namespace probewright::simulation
