#include <algorithm>

#include "cycles_sinumerik/milling_variants.hpp"
#include "language/sinumerik/check.hpp"

/// Arguments left out, as programs of post-processors do: what `check` lets pass a run does not refuse for its call.
namespace probewright {
namespace {

using namespace testing_support;

/// "CYCLE977(101,1,,...)" with the first `count` places only.
std::string callText(const char* name, const NamedNumbers& numbers, std::size_t count = 99) {
  const cycles::CycleDefinition* definition = cycles::sinumerikCycle(name);
  std::vector<std::string> places(definition->parameters.size());
  for (const auto& [parameter, value] : numbers)
    for (const cycles::Parameter& each : definition->parameters)
      if (each.name == parameter) places[each.address] = fmt::format("{}", value);
  while (places.size() > count || (!places.empty() && places.back().empty()))
    places.pop_back();
  return fmt::format("{}({})", name, fmt::join(places, ","));
}

bool passesCheck(const std::string& call) {
  return std::ranges::none_of(
      language::sinumerik::check(*language::sinumerik::SinumerikProgram::fromText("TEST.MPF", call + "\nM30\n")),
      [](const Diagnostic& each) { return each.severity == Severity::Error; });
}

/// True if the alarm is about the call, not about what the probe met.
bool isOfTheCall(const std::string& code) {
  static constexpr const char* met[] = {"", "61301", "61302", "61303", "61316", "61331", "61334", "61414", "10720"};
  return std::ranges::find(met, code) == std::end(met);
}

void expectAgreement(const Variant& variant, const NamedNumbers& call, std::size_t count = 99) {
  const std::string text = callText(variant.cycle, call, count);
  SCOPED_TRACE(variant.name + (": " + text));
  simulation::Truth truth = perfectWorld();
  variant.part(truth, translation(origin));
  SinumerikBench bench(truth);
  plantFrame(bench, "$P_UIFR", 1, origin);
  bench.start(variant.start);
  NamedNumbers given;
  const cycles::CycleDefinition* definition = cycles::sinumerikCycle(variant.cycle);
  for (const auto& [name, value] : call)
    for (const cycles::Parameter& each : definition->parameters)
      if (each.name == name && each.address < count) given.emplace_back(name, value);
  const execution::RunResult result = bench.tryRun(variant.cycle, given);
  const std::string code = result.diagnostics.empty() ? std::string() : result.diagnostics.front().code;
  EXPECT_EQ(passesCheck(text), !isOfTheCall(code)) << code;
}

TEST(LeftOut, EachArgumentOfEachCall) {
  for (const Variant& variant : everyCall()) {
    const NamedNumbers whole = with(variant.call, {{"S_KNUM", variant.corrects() ? 1 : 0}});
    for (const auto& [name, value] : whole) {
      if (name == "S_MVAR") continue;
      NamedNumbers call = whole;
      std::erase_if(call, [&name = name](const auto& each) { return each.first == name; });
      expectAgreement(variant, call);
    }
  }
}

TEST(LeftOut, TheEndOfEachCall) {
  for (const Variant& variant : everyCall()) {
    const NamedNumbers whole = with(variant.call, {{"S_KNUM", variant.corrects() ? 1 : 0}});
    const std::size_t places = cycles::sinumerikCycle(variant.cycle)->parameters.size();
    // The centres of all three balls belong together.
    const bool three = std::string_view(variant.name) == "997 three balls";
    for (std::size_t count = three ? 17 : 1; count < places; ++count)
      expectAgreement(variant, whole, count);
  }
}

}  // namespace
}  // namespace probewright
