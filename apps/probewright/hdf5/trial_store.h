#pragma once

#include <stddef.h>
#include <stdint.h>

/* What the module probewright-hdf5.so offers: trials of a study in a file of HDF5. No other command loads its library.
 */
#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  const char* mark; /* tells studies apart whose trials are different */
  size_t sourceCount;
  const char* const* sources;
  size_t resultCount;
  const char* const* results;
} probewright_trial_columns;

/* Tables have a row for each trial, one after the other; NaN: no value. */
typedef struct {
  size_t trials;
  const uint64_t* numbers; /* of the trials */
  const uint8_t* ends;     /* 0 finished, 1 alarm, 2 refused */
  const int32_t* why;      /* place among the reasons; -1: none */
  const double* sources;
  const double* results;
  const double* truths; /* as many as results */
} probewright_trial_rows;

/* Begins a new file. Returns null with what went wrong in `reason`. */
void* probewright_hdf5_begin(const char* path, const probewright_trial_columns* columns, char* reason,
                             size_t reasonSize);

/* Adds trials. Returns 0, or -1 with what went wrong in `reason`. */
int probewright_hdf5_add(void* store, const probewright_trial_rows* rows, char* reason, size_t reasonSize);

/* Ends the file, with the reasons that trials name. `store` is gone afterwards. Returns 0, or -1 with what went wrong
   in `reason`. */
int probewright_hdf5_end(void* store, const char* const* reasons, size_t count, char* reason, size_t reasonSize);

/* Lets go of a file that is not to be ended. */
void probewright_hdf5_drop(void* store);

/* 1 if the file was written by this module, else 0. */
int probewright_hdf5_is_trials(const char* path);

#ifdef __cplusplus
}
#endif
