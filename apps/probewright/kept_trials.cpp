#include "kept_trials.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <map>
#include <utility>

#include "base/file.hpp"
#include "base/unfinished.hpp"
#include "hdf5/trial_store.h"

namespace probewright::app {

namespace fs = std::filesystem;

namespace {

template <class Function>
Function* functionOf(void* module, const char* name) {
  return reinterpret_cast<Function*>(dlsym(module, name));
}

bool reachesTheDisk(const fs::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool done = fsync(file) == 0;
  close(file);
  return done;
}

std::vector<const char*> pointersTo(const std::vector<std::string>& texts) {
  std::vector<const char*> pointers;
  for (const std::string& text : texts)
    pointers.push_back(text.c_str());
  return pointers;
}

/// Some trials, as tables.
struct Rows {
  std::vector<std::uint64_t> numbers;
  std::vector<std::uint8_t> ends;
  std::vector<std::int32_t> why;
  std::vector<double> sources, results, truths;

  void add(std::uint64_t number, const study::TrialReader::Trial& trial, std::int32_t reason,
           const std::map<std::string, std::size_t>& places) {
    numbers.push_back(number);
    ends.push_back(static_cast<std::uint8_t>(trial.outcome.end));
    why.push_back(reason);
    sources.insert(sources.end(), trial.inputs.begin(), trial.inputs.end());
    const std::size_t row = results.size();
    results.resize(row + places.size(), study::missing);
    truths.resize(row + places.size(), study::missing);
    for (const study::Observation& observation : trial.outcome.observations) {
      const std::size_t place = row + places.at(observation.of.key);
      results[place] = observation.value;
      truths[place] = observation.truth.value_or(study::missing);
    }
  }
  probewright_trial_rows asTold() const {
    return {numbers.size(), numbers.data(), ends.data(), why.data(), sources.data(), results.data(), truths.data()};
  }
};

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

Result<void> KeptTrials::write(study::TrialReader trials, const std::string& mark) const {
  const auto begin = functionOf<decltype(probewright_hdf5_begin)>(module_.get(), "probewright_hdf5_begin");
  const auto add = functionOf<decltype(probewright_hdf5_add)>(module_.get(), "probewright_hdf5_add");
  const auto end = functionOf<decltype(probewright_hdf5_end)>(module_.get(), "probewright_hdf5_end");
  const auto drop = functionOf<decltype(probewright_hdf5_drop)>(module_.get(), "probewright_hdf5_drop");
  if (begin == nullptr || add == nullptr || end == nullptr || drop == nullptr)
    return fail({path_.string(), 0, 0}, "the module for HDF5 is not that of this program", "build both together");
  const ScratchFolder beside(path_);
  if (beside.path().empty()) return failErrno(path_, "write beside this file");
  const fs::path neighbour = beside.path() / path_.filename();

  const study::TrialColumns& columns = trials.columns();
  const std::vector<const char*> sources = pointersTo(columns.sources), results = pointersTo(columns.results);
  const probewright_trial_columns heading{mark.c_str(), sources.size(), sources.data(), results.size(), results.data()};
  std::array<char, 300> reason{};
  const auto failed = [&] {
    return fail({path_.string(), 0, 0}, fmt::format("cannot keep the trials: {}", reason.data()),
                "free some room, or choose another place with --keep, and go on with --resume");
  };
  void* store = begin(neighbour.c_str(), &heading, reason.data(), reason.size());
  if (store == nullptr) return failed();
  std::map<std::string, std::size_t> places;
  for (const std::string& key : columns.results)
    places.emplace(key, places.size());
  std::vector<std::string> reasons;
  std::map<std::string, std::int32_t> reasonPlaces;
  constexpr std::size_t atOnce = 1024;
  for (bool more = true; more;) {
    Rows rows;
    while (rows.numbers.size() < atOnce) {
      const std::uint64_t number = trials.trials();
      const auto trial = trials.next();
      if (!trial) break;
      std::int32_t why = -1;
      if (trial->outcome.end != study::TrialEnd::Finished) {
        const auto [found, isNew] =
            reasonPlaces.try_emplace(trial->outcome.why, static_cast<std::int32_t>(reasons.size()));
        if (isNew) reasons.push_back(trial->outcome.why);
        why = found->second;
      }
      rows.add(number, *trial, why, places);
    }
    more = rows.numbers.size() == atOnce;
    const probewright_trial_rows part = rows.asTold();
    if (add(store, &part, reason.data(), reason.size()) != 0) {
      drop(store);
      return failed();
    }
  }
  const std::vector<const char*> told = pointersTo(reasons);
  if (end(store, told.data(), told.size(), reason.data(), reason.size()) != 0) return failed();
  if (!reachesTheDisk(neighbour)) return failErrno(path_, "keep the trials");
  std::error_code error;
  fs::rename(neighbour, path_, error);
  if (error) {
    std::snprintf(reason.data(), reason.size(), "%s", error.message().c_str());
    return failed();
  }
  return {};
}

}  // namespace probewright::app
