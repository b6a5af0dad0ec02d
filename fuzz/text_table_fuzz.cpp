#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "control/heidenhain/text_table.hpp"

using namespace probewright;
using namespace probewright::control::heidenhain;

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

}  // namespace

// Any bytes: what is read comes back, what is set is read, what is refused changes nothing.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  Diagnostics diagnostics;
  auto table = TextTable::parse(bytes, "TOOL.T", diagnostics);
  for (const auto& diagnostic : diagnostics)
    require(!format(diagnostic).empty());
  if (!table) return 0;
  require(table->bytes() == bytes);
  const auto keys = table->keys();
  if (keys.size() > 40 || table->columns().size() > 40) return 0;
  for (const std::string& key : keys) {
    for (const TableColumn& column : table->columns()) {
      const std::string before = table->bytes();
      if (table->setNumber(key, column.name, -12.345678)) {
        require(table->cell(key, column.name)->starts_with("-12"));
      } else {
        require(table->bytes() == before);
      }
    }
  }
  for (const char* row : {"77", "0.5", "-3"}) {
    const bool existed = table->hasRow(row);
    require(table->addRow(row).has_value() ? !existed && table->hasRow(row) : true);
  }
  diagnostics.clear();
  const auto again = TextTable::parse(table->bytes(), "TOOL.T", diagnostics);
  require(again.has_value() && again->columns().size() == table->columns().size());
  return 0;
}
