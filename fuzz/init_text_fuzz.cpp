#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "control/sinumerik/init_text.hpp"
#include "control/sinumerik/tool_data.hpp"

using namespace probewright;
using namespace probewright::control::sinumerik;

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

bool isSame(const DataStore& a, const DataStore& b) {
  for (const DataKey& key : a.keys()) {
    if (a.get(key) != b.get(key)) return false;
  }
  return true;
}

}  // namespace

// Any bytes: the text comes back as it was, and a text with every number changed reads back as the store that made it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  DataStore store;
  Diagnostics diagnostics;
  const InitText text = InitText::parse(bytes, "DATA.INI", store, diagnostics);
  for (const auto& diagnostic : diagnostics)
    require(!format(diagnostic).empty());
  require(text.bytes() == bytes);
  const auto unchanged = text.updated(store);
  if (!unchanged) return 0;
  require(*unchanged == bytes);
  for (const int tool : toolNumbers(store))
    toolEdge(store, tool, 1, 1);

  for (const DataKey& key : store.keys()) {
    const auto value = store.get(key);
    const double* number = std::get_if<double>(&*value);
    if (number != nullptr && key.indices.size() < 2) store.set(key, *number / 2 + 1);
  }
  store.set("$TC_DP3", {1, 1}, 12.5);
  const auto changed = text.updated(store);
  require(changed.has_value());
  DataStore again;
  diagnostics.clear();
  InitText::parse(*changed, "DATA.INI", again, diagnostics);
  require(isSame(store, again));
  return 0;
}
