// Any bytes as a definition file of global user data, and behind a line "%%" as the initialization text with their
// values: messages have texts and places, what is declared has values that its type takes, and what a program changes
// reads back.

#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "control/sinumerik/init_text.hpp"
#include "execution/sinumerik/global_data.hpp"

using namespace probewright;

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const std::size_t cut = bytes.find("\n%%\n");
  Diagnostics mistakes;
  execution::sinumerik::GlobalUserData definitions;
  definitions.read("UGUD.DEF", std::string(bytes.substr(0, cut)), mistakes);
  for (const Diagnostic& each : mistakes)
    require(!format(each).empty() && each.place.line > 0);
  control::sinumerik::DataStore store;
  if (cut != std::string_view::npos)
    control::sinumerik::InitText::parse(bytes.substr(cut + 4), "U.GUD", store, mistakes);
  const auto variables = definitions.variables(store, mistakes);
  require(variables.size() == definitions.data().size());
  for (const execution::sinumerik::GlobalDatum& datum : definitions.data()) {
    require(definitions.find(datum.name) != nullptr && datum.place.line > 0);
    require(variables.at(datum.name).count() == datum.variable.count() && datum.variable.count() <= 65536);
    for (std::size_t place = 0; place < datum.variable.count(); ++place) {
      execution::sinumerik::UserVariable copy = variables.at(datum.name);
      copy.set(place, copy.at(place));
      if (place > 8) break;
    }
  }
  return 0;
}
