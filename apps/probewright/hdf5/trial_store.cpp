#include "trial_store.h"

#include <hdf5.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

// The layout is described in docs/uncertainty.md.

namespace {

constexpr const char* signature = "probewright_trials";
constexpr hsize_t rowsOfChunk = 1024;
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
  Held() = default;
  Held(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {
    if (id < 0) throw failed("the library cannot go on");
  }
  Held(Held&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Held& operator=(Held&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
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
  hid_t id_ = -1;
  herr_t (*close_)(hid_t) = nullptr;
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

Held space(const std::vector<hsize_t>& sizes, const hsize_t* most = nullptr) {
  return Held(H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), most), H5Sclose);
}

/// The same trials give the same bytes.
Held layout() {
  Held list(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  check(H5Pset_obj_track_times(list, false));
  return list;
}

void writeTexts(hid_t file, const char* name, const std::vector<const char*>& texts) {
  const Held type = textType(), room = space({texts.size()}), how = layout();
  const Held set(H5Dcreate2(file, name, type, room, H5P_DEFAULT, how, H5P_DEFAULT), H5Dclose);
  if (!texts.empty()) check(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, texts.data()));
}

/// Rows that grow, in chunks that are compressed without loss. A column has no width.
class Growing {
public:
  Growing(hid_t file, const char* name, hid_t stored, std::optional<hsize_t> width) : width_(width) {
    std::vector<hsize_t> sizes = {0}, most = {H5S_UNLIMITED}, chunk = {rowsOfChunk};
    if (width) {
      sizes.push_back(*width);
      most.push_back(*width);
      chunk.push_back(std::clamp<hsize_t>(*width, 1, columnsOfChunk));
    }
    const Held how = layout();
    if (width != hsize_t{0}) {
      check(H5Pset_chunk(how, static_cast<int>(chunk.size()), chunk.data()));
      check(H5Pset_shuffle(how));
      check(H5Pset_deflate(how, 4));
    } else {
      most[0] = 0;  // a table without columns has no rows that could be kept
    }
    const Held room = space(sizes, most.data());
    set_ = Held(H5Dcreate2(file, name, stored, room, H5P_DEFAULT, how, H5P_DEFAULT), H5Dclose);
  }

  void add(hid_t type, const void* values, hsize_t count) {
    if (count == 0 || width_ == hsize_t{0}) return;
    std::vector<hsize_t> first = {rows_}, part = {count}, whole = {rows_ + count};
    if (width_) {
      first.push_back(0);
      part.push_back(*width_);
      whole.push_back(*width_);
    }
    check(H5Dset_extent(set_, whole.data()));
    const Held room(H5Dget_space(set_), H5Sclose), here = space(part);
    check(H5Sselect_hyperslab(room, H5S_SELECT_SET, first.data(), nullptr, part.data(), nullptr));
    check(H5Dwrite(set_, type, here, room, H5P_DEFAULT, values));
    rows_ += count;
  }

private:
  std::optional<hsize_t> width_;
  hsize_t rows_ = 0;
  Held set_;
};

Held endType() {
  Held type(H5Tenum_create(H5T_STD_U8LE), H5Tclose);
  uint8_t value = 0;
  for (const char* name : {"finished", "alarm", "refused"}) {
    check(H5Tenum_insert(type, name, &value));
    ++value;
  }
  return type;
}

/// A file and its tables.
class Store {
public:
  Store(const char* path, const probewright_trial_columns& columns)
      : file_(H5Fcreate(path, H5F_ACC_EXCL, H5P_DEFAULT, H5P_DEFAULT), H5Fclose), endType_(::endType()) {
    {
      const Held type = textType(), one(H5Screate(H5S_SCALAR), H5Sclose);
      const Held mark(H5Acreate2(file_, signature, type, one, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
      check(H5Awrite(mark, type, &columns.mark));
    }
    writeTexts(file_, "source_names", {columns.sources, columns.sources + columns.sourceCount});
    writeTexts(file_, "result_names", {columns.results, columns.results + columns.resultCount});
    trial_.emplace(file_, "trial", H5T_STD_U64LE, std::nullopt);
    end_.emplace(file_, "end", endType_, std::nullopt);
    why_.emplace(file_, "why", H5T_STD_I32LE, std::nullopt);
    sources_.emplace(file_, "sources", H5T_IEEE_F64LE, columns.sourceCount);
    results_.emplace(file_, "results", H5T_IEEE_F64LE, columns.resultCount);
    truths_.emplace(file_, "truths", H5T_IEEE_F64LE, columns.resultCount);
  }

  void add(const probewright_trial_rows& rows) {
    trial_->add(H5T_NATIVE_UINT64, rows.numbers, rows.trials);
    end_->add(endType_, rows.ends, rows.trials);
    why_->add(H5T_NATIVE_INT32, rows.why, rows.trials);
    sources_->add(H5T_NATIVE_DOUBLE, rows.sources, rows.trials);
    results_->add(H5T_NATIVE_DOUBLE, rows.results, rows.trials);
    truths_->add(H5T_NATIVE_DOUBLE, rows.truths, rows.trials);
  }

  void end(const std::vector<const char*>& reasons) {
    writeTexts(file_, "reasons", reasons);
    for (auto* table : {&trial_, &end_, &why_, &sources_, &results_, &truths_})
      table->reset();
    check(H5Fflush(file_, H5F_SCOPE_GLOBAL));
    file_.closeNow();
  }

private:
  Held file_, endType_;
  std::optional<Growing> trial_, end_, why_, sources_, results_, truths_;
};

/// Says nothing itself. At the end of the process the library would once more write what found no room, and crash.
void quieten() {
  H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

/// 0, or -1 with the reason.
template <class Work>
int saying(char* reason, size_t reasonSize, const Work& work) {
  try {
    work();
    return 0;
  } catch (const std::exception& failure) {
    std::snprintf(reason, reasonSize, "%s", failure.what());
    return -1;
  }
}

}  // namespace

void* probewright_hdf5_begin(const char* path, const probewright_trial_columns* columns, char* reason,
                             size_t reasonSize) {
  quieten();
  Store* store = nullptr;
  saying(reason, reasonSize, [&] { store = std::make_unique<Store>(path, *columns).release(); });
  return store;
}

int probewright_hdf5_add(void* store, const probewright_trial_rows* rows, char* reason, size_t reasonSize) {
  return saying(reason, reasonSize, [&] { static_cast<Store*>(store)->add(*rows); });
}

int probewright_hdf5_end(void* store, const char* const* reasons, size_t count, char* reason, size_t reasonSize) {
  const std::unique_ptr<Store> held(static_cast<Store*>(store));
  return saying(reason, reasonSize, [&] { held->end({reasons, reasons + count}); });
}

void probewright_hdf5_drop(void* store) { const std::unique_ptr<Store> held(static_cast<Store*>(store)); }

int probewright_hdf5_is_trials(const char* path) {
  quieten();
  const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file < 0) return 0;
  const bool signedSo = H5Aexists(file, signature) > 0;
  H5Fclose(file);
  return signedSo ? 1 : 0;
}
