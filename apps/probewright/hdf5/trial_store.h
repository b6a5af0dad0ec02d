#pragma once

#include <stddef.h>
#include <stdint.h>

/* What the module probewright-hdf5.so offers: trials of a study in a file of HDF5. No other command loads its library.
 */
#ifdef __cplusplus
extern "C" {
#endif

/* `values` has one number a trial; null: it has none, NaN is written. */
typedef struct {
  const char* name;
  const double* values;
} probewright_column;

typedef struct {
  const char* mark; /* tells studies apart whose trials are different */
  size_t trials;
  const uint64_t* numbers; /* of the trials */
  const uint8_t* ends;     /* 0 finished, 1 alarm, 2 refused */
  const int32_t* why;      /* place in `reasons`; -1: none */
  size_t reasonCount;
  const char* const* reasons;
  size_t sourceCount;
  const probewright_column* sources;
  size_t resultCount;
  const probewright_column* results;
  const probewright_column* truths; /* as many as results */
} probewright_trials;

/* Writes a new file. Returns 0, or -1 with what went wrong in `reason`. */
int probewright_hdf5_write(const char* path, const probewright_trials* trials, char* reason, size_t reasonSize);

/* 1 if the file was written by probewright_hdf5_write, else 0. */
int probewright_hdf5_is_trials(const char* path);

#ifdef __cplusplus
}
#endif
