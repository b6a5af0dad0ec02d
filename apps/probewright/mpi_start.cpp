#include "mpi_start.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "mpi/mpi_ranks.h"

namespace probewright::app {

namespace {

/// What the starters of OpenMPI, MPICH and Slurm tell the processes that they start.
bool startedByMpi() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK"})
    if (std::getenv(name) != nullptr) return true;
  return false;
}

template <class Function>
Function* functionOf(void* module, const char* name) {
  return reinterpret_cast<Function*>(dlsym(module, name));
}

}  // namespace

Result<std::optional<JoinedRanks>> joinRanks() {
  if (!startedByMpi()) return std::nullopt;
  std::error_code error;
  const std::filesystem::path file =
      std::filesystem::read_symlink("/proc/self/exe", error).parent_path() / "probewright-mpi.so";
  // OpenMPI loads parts of itself that look for its symbols.
  void* module = dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL);
  if (module == nullptr) {
    const char* why = dlerror();
    return fail(fmt::format("this program cannot work with MPI: {}", why == nullptr ? "unknown" : why),
                "build it where libopenmpi-dev is installed, or run it without mpirun");
  }
  const auto begin = functionOf<decltype(probewright_mpi_begin)>(module, "probewright_mpi_begin");
  const auto exchange = functionOf<decltype(probewright_mpi_exchange)>(module, "probewright_mpi_exchange");
  const auto end = functionOf<decltype(probewright_mpi_end)>(module, "probewright_mpi_end");
  if (begin == nullptr || exchange == nullptr || end == nullptr)
    return fail({file.string(), 0, 0}, "this is not the module for MPI of this program", "build both together");
  JoinedRanks joined;
  begin(&joined.ranks.rank, &joined.ranks.size);
  joined.membership = std::shared_ptr<void>(module, [end](void*) { end(); });
  joined.ranks.exchange = [exchange, size = joined.ranks.size](const std::string& mine) {
    const char* received = nullptr;
    const int* sizes = nullptr;
    if (exchange(mine.data(), mine.size(), &received, &sizes) != 0)
      throw std::runtime_error("the answers of a stretch of trials are too large for MPI");
    std::vector<std::string> messages;
    for (int rank = 0; rank < size; ++rank) {
      messages.emplace_back(received, static_cast<std::size_t>(sizes[rank]));
      received += sizes[rank];
    }
    return messages;
  };
  return joined;
}

}  // namespace probewright::app
