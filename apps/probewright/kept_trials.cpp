#include "kept_trials.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <map>
#include <utility>

#include "base/file.hpp"
#include "hdf5/trial_store.h"

namespace probewright::app {

namespace fs = std::filesystem;

namespace {

template <class Function>
Function* functionOf(void* module, const char* name) {
  return reinterpret_cast<Function*>(dlsym(module, name));
}

/// Goes with what was not finished.
class Unfinished {
public:
  explicit Unfinished(fs::path path) : path_(std::move(path)) {}
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;
  ~Unfinished() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  const fs::path& path() const { return path_; }

private:
  fs::path path_;
};

bool reachesTheDisk(const fs::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool done = fsync(file) == 0;
  close(file);
  return done;
}

}  // namespace

Result<KeptTrials> KeptTrials::at(const fs::path& path) {
  std::error_code error;
  const fs::path file = fs::read_symlink("/proc/self/exe", error).parent_path() / "probewright-hdf5.so";
  void* module = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (module == nullptr) {
    const char* why = dlerror();
    return fail(fmt::format("this program cannot write HDF5: {}", why == nullptr ? "unknown" : why),
                "build it where libhdf5-dev is installed, or leave out --keep");
  }
  KeptTrials kept(path, std::shared_ptr<void>(module, [](void*) {}));
  const auto isTrials = functionOf<decltype(probewright_hdf5_is_trials)>(module, "probewright_hdf5_is_trials");
  if (isTrials == nullptr)
    return fail({file.string(), 0, 0}, "this is not the module for HDF5 of this program", "build both together");
  if (fs::exists(fs::symlink_status(path, error)) && isTrials(path.c_str()) != 1)
    return fail({path.string(), 0, 0}, "this file does not hold trials of a study, and stays as it is",
                "move it, or choose another name with --keep");
  return kept;
}

Result<void> KeptTrials::write(const study::TrialTable& table, const std::vector<std::string>& sources,
                               const std::string& mark) const {
  const auto writeTo = functionOf<decltype(probewright_hdf5_write)>(module_.get(), "probewright_hdf5_write");
  std::vector<std::uint8_t> ends;
  for (const study::TrialEnd end : table.ends())
    ends.push_back(static_cast<std::uint8_t>(end));
  std::vector<std::int32_t> why(table.size(), -1);
  std::vector<const char*> reasons;
  for (const auto& [text, places] : table.stops()) {
    for (const std::size_t place : places)
      why[place] = static_cast<std::int32_t>(reasons.size());
    reasons.push_back(text.c_str());
  }
  std::vector<probewright_column> inputs, results, truths;
  for (std::size_t i = 0; i < sources.size(); ++i)
    inputs.push_back({sources[i].c_str(), table.inputs(i).data()});
  for (std::size_t i = 0; i < table.characteristics().size(); ++i) {
    const char* name = table.characteristics()[i].key.c_str();
    results.push_back({name, table.values(i).data()});
    truths.push_back({name, table.truths(i).empty() ? nullptr : table.truths(i).data()});
  }
  const probewright_trials trials{mark.c_str(),  table.size(),   table.trials().data(), ends.data(),
                                  why.data(),    reasons.size(), reasons.data(),        inputs.size(),
                                  inputs.data(), results.size(), results.data(),        truths.data()};
  std::error_code error;
  if (path_.has_parent_path()) fs::create_directories(path_.parent_path(), error);
  const Unfinished neighbour(fs::path(path_).concat(fmt::format(".new-{}", getpid())));
  fs::remove(neighbour.path(), error);
  std::array<char, 300> reason{};
  const char* const advice = "free some room, or choose another place with --keep, and go on with --resume";
  if (writeTo == nullptr || writeTo(neighbour.path().c_str(), &trials, reason.data(), reason.size()) != 0)
    return fail({path_.string(), 0, 0}, fmt::format("cannot keep the trials: {}", reason.data()), advice);
  if (!reachesTheDisk(neighbour.path())) return failErrno(path_, "keep the trials");
  fs::rename(neighbour.path(), path_, error);
  if (error) return fail({path_.string(), 0, 0}, "cannot keep the trials: " + error.message(), advice);
  return {};
}

}  // namespace probewright::app
