#include "mpi_ranks.h"

// The C interface alone.
#define OMPI_SKIP_MPICXX 1
#define MPICH_SKIP_MPICXX 1
#include <mpi.h>

#include <climits>
#include <vector>

// The module that a study loads when mpirun has started it. An error of MPI ends all ranks, as MPI does by default.

namespace {

std::vector<int> messageSizes, places;
std::vector<char> messages;

}  // namespace

void probewright_mpi_begin(int* rank, int* size) {
  MPI_Init(nullptr, nullptr);
  MPI_Comm_rank(MPI_COMM_WORLD, rank);
  MPI_Comm_size(MPI_COMM_WORLD, size);
  messageSizes.resize(static_cast<std::size_t>(*size));
  places.resize(static_cast<std::size_t>(*size));
}

int probewright_mpi_exchange(const char* bytes, size_t size, const char** received, const int** sizes) {
  // Every rank must come to the same decision: a size that cannot be counted is told as -1.
  const int mine = size <= INT_MAX ? static_cast<int>(size) : -1;
  MPI_Allgather(&mine, 1, MPI_INT, messageSizes.data(), 1, MPI_INT, MPI_COMM_WORLD);
  long long sum = 0;
  for (std::size_t i = 0; i < messageSizes.size(); ++i) {
    if (messageSizes[i] < 0 || sum + messageSizes[i] > INT_MAX) return 1;
    places[i] = static_cast<int>(sum);
    sum += messageSizes[i];
  }
  messages.resize(static_cast<std::size_t>(sum) + 1);
  MPI_Allgatherv(bytes, mine, MPI_CHAR, messages.data(), messageSizes.data(), places.data(), MPI_CHAR, MPI_COMM_WORLD);
  *received = messages.data();
  *sizes = messageSizes.data();
  return 0;
}

void probewright_mpi_end(void) { MPI_Finalize(); }
