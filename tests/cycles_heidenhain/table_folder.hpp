#pragma once

#include <stdlib.h>

#include <filesystem>
#include <fstream>

#include "support/heidenhain_bench.hpp"

namespace probewright::testing_support {

/// A folder with the control's own tables, which is removed again.
class TableFolder {
public:
  explicit TableFolder(Bench& bench) {
    std::string name = (std::filesystem::temp_directory_path() / "probewright-tables-XXXXXX").string();
    EXPECT_NE(::mkdtemp(name.data()), nullptr);
    path_ = name;
    bench.setup.beliefs.tables = path_;
  }
  ~TableFolder() { std::filesystem::remove_all(path_); }
  TableFolder(const TableFolder&) = delete;
  TableFolder& operator=(const TableFolder&) = delete;
  void put(const std::string& name, const control::heidenhain::TypedTable& table) const {
    put(name, table.table().bytes());
  }
  void put(const std::string& name, const std::string& bytes) const {
    std::ofstream(path_ / name, std::ios::binary) << bytes;
  }
  void remove(const std::string& name) const { std::filesystem::remove(path_ / name); }

private:
  std::filesystem::path path_;
};

}  // namespace probewright::testing_support
