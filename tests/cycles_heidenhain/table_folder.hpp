#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "support/heidenhain_bench.hpp"

namespace probewright::testing_support {

/// A folder with the control's own tables, which is removed again.
class TableFolder {
public:
  explicit TableFolder(Bench& bench) {
    path_ = std::filesystem::temp_directory_path() /
            fmt::format("probewright-tables-{}", ::testing::UnitTest::GetInstance()->random_seed() + ::getpid());
    std::filesystem::create_directories(path_);
    bench.setup.tables = path_;
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
