#pragma once

#include <stddef.h>

/* What the module probewright-mpi.so offers: the study knows no MPI, and no other command loads its libraries. */
#ifdef __cplusplus
extern "C" {
#endif

/* Joins the other ranks. */
void probewright_mpi_begin(int* rank, int* size);

/* Gives `size` bytes to all ranks. The messages of all, one after the other by rank, stand in *received until the next
   call; sizes[r] is that of rank r. Returns 0; 1 if together they are larger than MPI can count. */
int probewright_mpi_exchange(const char* bytes, size_t size, const char** received, const int** sizes);

/* Leaves the other ranks. */
void probewright_mpi_end(void);

#ifdef __cplusplus
}
#endif
