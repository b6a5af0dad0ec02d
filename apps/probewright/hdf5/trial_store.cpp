#include "trial_store.h"

#include <hdf5.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

// The layout is described in docs/uncertainty.md.

namespace {

constexpr const char* signature = "probewright_trials";
constexpr hsize_t rowsAtOnce = 1024;
constexpr hsize_t columnsOfChunk = 32;

/// What the system said of a call that failed, as the library keeps it: "... error message = 'No space left on
/// device'".
herr_t takeReason(unsigned, const H5E_error2_t* error, void* to) {
  const std::string text = error->desc == nullptr ? "" : error->desc, before = "error message = '";
  if (const std::size_t at = text.find(before); at != std::string::npos) {
    const std::size_t begin = at + before.size();
    *static_cast<std::string*>(to) = ": " + text.substr(begin, text.find('\'', begin) - begin);
  }
  return 0;
}

/// To be called before the library does anything else, which forgets the reason.
std::runtime_error failed(const char* what) {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, takeReason, &reason);
  return std::runtime_error(what + reason);
}

/// An identifier of the library, closed at the end.
class Held {
public:
  Held(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {
    if (id < 0) throw failed("the library cannot go on");
  }
  Held(Held&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Held& operator=(Held&&) = delete;
  ~Held() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }
  /// Closing a file writes what is left of it.
  void closeNow() {
    const hid_t id = id_;
    id_ = -1;
    if (close_(id) < 0) throw failed("the end of the file cannot be written");
  }

private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

void check(herr_t done) {
  if (done < 0) throw failed("values cannot be written");
}

Held textType() {
  Held type(H5Tcopy(H5T_C_S1), H5Tclose);
  check(H5Tset_size(type, H5T_VARIABLE));
  check(H5Tset_cset(type, H5T_CSET_UTF8));
  return type;
}

Held space(const std::vector<hsize_t>& sizes) {
  return Held(H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr), H5Sclose);
}

/// Chunks, compressed without loss, where there is anything; no sizes: in one piece.
Held layout(const std::vector<hsize_t>& sizes) {
  Held list(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  check(H5Pset_obj_track_times(list, false));  // the same trials give the same bytes
  if (sizes.empty() || std::find(sizes.begin(), sizes.end(), 0U) != sizes.end()) return list;
  std::vector<hsize_t> chunk = {std::min(sizes[0], rowsAtOnce)};
  if (sizes.size() > 1) chunk.push_back(std::min(sizes[1], columnsOfChunk));
  check(H5Pset_chunk(list, static_cast<int>(chunk.size()), chunk.data()));
  check(H5Pset_shuffle(list));
  check(H5Pset_deflate(list, 4));
  return list;
}

void writeTexts(hid_t file, const char* name, const std::vector<const char*>& texts) {
  const Held type = textType(), room = space({texts.size()}), how = layout({});
  const Held set(H5Dcreate2(file, name, type, room, H5P_DEFAULT, how, H5P_DEFAULT), H5Dclose);
  if (!texts.empty()) check(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, texts.data()));
}

template <class Value>
void writeColumn(hid_t file, const char* name, hid_t stored, hid_t type, const Value* values, size_t count) {
  const std::vector<hsize_t> sizes = {count};
  const Held room = space(sizes), how = layout(sizes);
  const Held set(H5Dcreate2(file, name, stored, room, H5P_DEFAULT, how, H5P_DEFAULT), H5Dclose);
  if (count > 0) check(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values));
}

/// A row for each trial.
void writeTable(hid_t file, const char* name, const probewright_column* columns, size_t count, size_t trials) {
  const std::vector<hsize_t> sizes = {trials, count};
  const Held room = space(sizes), how = layout(sizes);
  const Held set(H5Dcreate2(file, name, H5T_IEEE_F64LE, room, H5P_DEFAULT, how, H5P_DEFAULT), H5Dclose);
  if (count == 0) return;
  std::vector<double> rows;
  for (hsize_t begin = 0; begin < trials; begin += rowsAtOnce) {
    const hsize_t end = std::min<hsize_t>(trials, begin + rowsAtOnce);
    rows.clear();
    for (hsize_t row = begin; row < end; ++row)
      for (size_t i = 0; i < count; ++i)
        rows.push_back(columns[i].values == nullptr ? std::numeric_limits<double>::quiet_NaN()
                                                    : columns[i].values[row]);
    const std::vector<hsize_t> first = {begin, 0}, part = {end - begin, count};
    const Held here = space(part);
    check(H5Sselect_hyperslab(room, H5S_SELECT_SET, first.data(), nullptr, part.data(), nullptr));
    check(H5Dwrite(set, H5T_NATIVE_DOUBLE, here, room, H5P_DEFAULT, rows.data()));
  }
}

std::vector<const char*> namesOf(const probewright_column* columns, size_t count) {
  std::vector<const char*> names;
  for (size_t i = 0; i < count; ++i)
    names.push_back(columns[i].name);
  return names;
}

void writeEnds(hid_t file, const probewright_trials& trials) {
  const Held type(H5Tenum_create(H5T_STD_U8LE), H5Tclose);
  uint8_t value = 0;
  for (const char* name : {"finished", "alarm", "refused"}) {
    check(H5Tenum_insert(type, name, &value));
    ++value;
  }
  writeColumn(file, "end", type, type, trials.ends, trials.trials);
}

void write(const char* path, const probewright_trials& trials) {
  Held file(H5Fcreate(path, H5F_ACC_EXCL, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
  {
    const Held type = textType(), one(H5Screate(H5S_SCALAR), H5Sclose);
    const Held mark(H5Acreate2(file, signature, type, one, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    check(H5Awrite(mark, type, &trials.mark));
  }
  writeColumn(file, "trial", H5T_STD_U64LE, H5T_NATIVE_UINT64, trials.numbers, trials.trials);
  writeEnds(file, trials);
  writeColumn(file, "why", H5T_STD_I32LE, H5T_NATIVE_INT32, trials.why, trials.trials);
  writeTexts(file, "reasons", {trials.reasons, trials.reasons + trials.reasonCount});
  writeTexts(file, "source_names", namesOf(trials.sources, trials.sourceCount));
  writeTable(file, "sources", trials.sources, trials.sourceCount, trials.trials);
  writeTexts(file, "result_names", namesOf(trials.results, trials.resultCount));
  writeTable(file, "results", trials.results, trials.resultCount, trials.trials);
  writeTable(file, "truths", trials.truths, trials.resultCount, trials.trials);
  check(H5Fflush(file, H5F_SCOPE_GLOBAL));
  file.closeNow();
}

/// Says nothing itself. At the end of the process the library would once more write what found no room, and crash.
void quieten() {
  H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

}  // namespace

int probewright_hdf5_write(const char* path, const probewright_trials* trials, char* reason, size_t reasonSize) {
  quieten();
  try {
    write(path, *trials);
    return 0;
  } catch (const std::exception& failure) {
    std::snprintf(reason, reasonSize, "%s", failure.what());
    return -1;
  }
}

int probewright_hdf5_is_trials(const char* path) {
  quieten();
  const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file < 0) return 0;
  const bool signedSo = H5Aexists(file, signature) > 0;
  H5Fclose(file);
  return signedSo ? 1 : 0;
}
