#include <map>
#include <set>

#include "cycles/catalogue.hpp"
#include "cycles_sinumerik/milling_variants.hpp"

/// Every digit of S_MVAR in the milling cycles: each value that the catalogue lists runs and does something else than
/// the others. A digit or a value without a row fails.
namespace probewright {
namespace {

using namespace testing_support;

/// One digit of a cycle, on one variant that runs with each of its values, or with a variant for each value.
struct Digit {
  const char* cycle;
  int place;
  std::vector<std::pair<int, const char*>> variants;  ///< value and variant; one of value -1: for all values
  NamedNumbers more = {};
  std::vector<int> alike = {};  ///< values that do the same here as the first of them
};

/// Variants that only calibrate.
std::vector<Variant> allVariants() {
  std::vector<Variant> all = everyCall();
  const auto block = [](simulation::Truth& truth, const Pose& pose) {
    place(truth, simulation::Box({0, 0, -60}, {100, 100, 0}), pose);
  };
  const auto ring = [](simulation::Truth& truth, const Pose& pose) {
    place(truth, simulation::Ring(20, 60, -40), pose);
  };
  // A block in each quadrant in turn would do; four at once leave cross-shaped room for corners in any position.
  const auto blocks = [](simulation::Truth& truth, const Pose& pose) {
    for (const double x : {0.0, -130.0})
      for (const double y : {0.0, -130.0})
        place(truth, simulation::Box({x, y, -60}, {x + 100, y + 100, 0}), pose);
  };
  const NamedNumbers path = {{"S_FA", 6}, {"S_TSA", 4}};
  all.push_back({"976 length", "CYCLE976", block, with(path, {{"S_MVAR", 0}}), {30, 30, 10}, {}});
  all.push_back({"976 unknown", "CYCLE976", ring, with(path, {{"S_MVAR", 2}, {"S_SETV", 40}}), {0.4, 0.3, -10}, {}});
  all.push_back({"976 edge", "CYCLE976", block, with(path, {{"S_MVAR", 1004}, {"S_MA", 1}}), {-14, 30, -10}, {}});
  all.push_back(
      {"976 groove", "CYCLE976", ring, with(path, {{"S_MVAR", 2004}, {"S_MA", 1}, {"S_SETV", 40}}), {0, 0, -10}, {}});
  all.push_back({"961 four blocks",
                 "CYCLE961",
                 blocks,
                 {{"S_MVAR", 6},
                  {"S_FA", 20},
                  {"S_TSA", 5},
                  {"S_SETV0", 30},
                  {"S_SETV1", 60},
                  {"S_SETV2", 40},
                  {"S_SETV4", -15},
                  {"S_SETV5", -15}},
                 {-15, -15, -10},
                 {0, 1},
                 true});
  Variant coordinates = all.back();
  coordinates.name = "961 by coordinates";
  coordinates.call = with(coordinates.call, {{"S_SETV1", -15}, {"S_SETV2", 60}, {"S_SETV3", -15}, {"S_SETV5", 40}});
  all.push_back(coordinates);
  Variant over = *std::ranges::find(all, std::string_view("961 four blocks"), &Variant::name);
  over.name = "961 over the corner";
  over.start.z() = 12;
  over.call.emplace_back("S_ID", 22);
  all.push_back(over);
  return all;
}

const Variant& named(std::string_view name) {
  static const std::vector<Variant> all = allVariants();
  return *std::ranges::find(all, name, &Variant::name);
}

const Digit digits[] = {
    {"CYCLE961", 1, {{5, "961 right inside"}, {6, "961 right outside"}, {7, "961 any inside"}, {8, "961 any outside"}}},
    {"CYCLE961", 2, {{0, "961 four blocks"}, {1, "961 by coordinates"}}},
    {"CYCLE961", 3, {{-1, "961 right outside"}}, {{"S_KNUM", 1}}},
    {"CYCLE961", 4, {{0, "961 four blocks"}, {1, "961 over the corner"}}},
    // Without a word on it the distances run in plus direction, as from corner 1.
    {"CYCLE961", 5, {{-1, "961 four blocks"}}, {}, {0, 1}},
    {"CYCLE976", 1, {{0, "976 length"}, {1, "976 ring"}, {2, "976 unknown"}, {3, "976 ball"}, {4, "976 edge"}}},
    {"CYCLE976", 4, {{-1, "976 ring"}}, {{"S_MA", 2}}},
    {"CYCLE976", 5, {{-1, "976 groove"}}},
    {"CYCLE976", 6, {{-1, "976 ring"}}, {{"S_STA1", 30}}},
    {"CYCLE976", 7, {{-1, "976 length"}}, {{"S_SETV", 0.1}}},
    {"CYCLE977",
     1,
     {{1, "977 hole"},
      {2, "977 spigot"},
      {3, "977 groove 1"},
      {4, "977 rib"},
      {5, "977 pocket"},
      {6, "977 rectangle"}}},
    {"CYCLE977", 3, {{-1, "977 pocket"}}, {{"S_KNUM", 1}, {"S_KNUM1", 1}}},
    {"CYCLE977", 4, {{-1, "977 pocket"}}, {{"S_ID", -3}, {"S_SZA", 20}, {"S_SZO", 20}}},
    {"CYCLE977", 5, {{-1, "977 pocket"}}},
    {"CYCLE978", 1, {{0, "978 1st axis"}}},
    {"CYCLE978", 3, {{-1, "978 2nd axis"}}, {{"S_KNUM", 1}, {"S_KNUM1", 1}}},
    {"CYCLE978", 5, {{-1, "978 1st axis"}}},
    {"CYCLE979", 1, {{1, "979 inside"}, {2, "979 outside"}}},
    {"CYCLE979", 3, {{-1, "979 inside"}}, {{"S_KNUM", 1}, {"S_KNUM1", 1}}},
    {"CYCLE979", 4, {{-1, "979 inside"}}},
    {"CYCLE979", 5, {{-1, "979 inside"}}},
    {"CYCLE995", 1, {{5, "995"}}},
    {"CYCLE995", 2, {{1, "995"}}},
    {"CYCLE995", 3, {{0, "995"}}},
    {"CYCLE995", 4, {{2, "995"}}},
    {"CYCLE995", 6, {{1, "995"}}},
    {"CYCLE995", 7, {{-1, "995"}}},
    {"CYCLE997", 1, {{9, "997 ball"}}},
    {"CYCLE997", 2, {{-1, "997 ball"}}},
    {"CYCLE997", 3, {{-1, "997 ball"}}, {{"S_KNUM", 1}}},
    {"CYCLE997", 4, {{-1, "997 ball"}}, {{"S_STA1", 10}}},
    {"CYCLE997", 5, {{0, "997 ball"}, {1, "997 three balls"}}},
    {"CYCLE997", 6, {{-1, "997 ball"}}},
    {"CYCLE997", 7, {{-1, "997 ball"}}},
    {"CYCLE998", 1, {{5, "998 edge"}, {6, "998 plane"}}},
    {"CYCLE998", 3, {{-1, "998 edge"}}, {{"S_KNUM", 1}}},
    {"CYCLE998", 4, {{-1, "998 edge"}}, {{"S_SETV", 2}}},
    {"CYCLE998", 5, {{-1, "998 edge"}}},
    {"CYCLE998", 6, {{-1, "998 edge"}}, {{"S_STA1", 2}}},
};

/// All that a call does: where it goes and touches, what it finds and what it writes.
std::string deedsOf(const Variant& variant, const NamedNumbers& more) {
  Planter plant(77);
  simulation::Truth truth = perfectWorld();
  variant.part(truth, displaced(variant, translation(origin), plant, 0.4, 1));
  truth.tools[0].probe.tipOffset = {0.05, -0.03};
  SinumerikBench bench(truth);
  plantFrame(bench, "$P_UIFR", 1, origin);
  bench.control.data.set("$TC_TP2", {7}, std::string("MILL"));
  bench.set("$TC_DP1", {7, 1}, 120);
  bench.start(variant.start);
  const cycles::CycleDefinition& definition = *cycles::sinumerikCycle(variant.cycle);
  const bool tool = std::ranges::any_of(definition.parameters, [](const auto& p) { return p.name == "S_TNAME"; });
  bench.run(variant.cycle, with(variant.call, more), tool ? NamedTexts{{"S_TNAME", "MILL"}} : NamedTexts{});
  const control::CycleRecord& record = bench.control.journal.cycles.back();
  std::string deeds;
  for (const auto& result : record.results)
    if (result.name != "_OVI[3]") deeds += fmt::format("{} = {:.5f}\n", result.name, result.value);
  for (const auto& write : record.writes)
    deeds += fmt::format("{}{} = {}\n", write.table, write.entry, write.after);
  for (const auto& touch : record.touches)
    deeds += fmt::format("{:.4f} {:.4f} {:.4f}\n", touch.surface.x(), touch.surface.y(), touch.surface.z());
  deeds += fmt::format("{:.3f} s\n", record.endSeconds - record.startSeconds);
  return deeds;
}

NamedNumbers withDigit(const Variant& variant, int place, int value) {
  const int scale = static_cast<int>(std::pow(10, place - 1));
  const int number = static_cast<int>(valueOf(variant.call, "S_MVAR"));
  return {{"S_MVAR", number + (value - number / scale % 10) * scale}};
}

TEST(Digits, EachValueOfSMvarDoesSomethingOfItsOwn) {
  for (const Digit& digit : digits) {
    const cycles::CycleDefinition& definition = *cycles::sinumerikCycle(digit.cycle);
    const auto& listed = definition.parameters.front().digits;
    const auto code = std::ranges::find(listed, digit.place, &cycles::CodeDigit::place);
    ASSERT_NE(code, listed.end()) << digit.cycle << " place " << digit.place;
    std::map<std::string, int> seen;
    for (const cycles::Choice& choice : code->choices) {
      SCOPED_TRACE(fmt::format("{} digit {} = {} ({})", digit.cycle, digit.place, choice.value, choice.meaning));
      const char* name = digit.variants.front().second;
      if (digit.variants.front().first >= 0) {
        const auto own = std::ranges::find(digit.variants, choice.value, &std::pair<int, const char*>::first);
        ASSERT_NE(own, digit.variants.end()) << "no variant";
        name = own->second;
      }
      const Variant& variant = named(name);
      const std::string deeds = deedsOf(variant, with(digit.more, withDigit(variant, digit.place, choice.value)));
      const auto [known, first] = seen.try_emplace(deeds, choice.value);
      const bool alike = std::ranges::find(digit.alike, choice.value) != digit.alike.end() &&
                         std::ranges::find(digit.alike, known->second) != digit.alike.end();
      EXPECT_TRUE(first || alike) << "as " << known->second;
    }
  }
}

TEST(Digits, AllOfTheCatalogueAreHere) {
  std::set<std::pair<std::string, int>> here, listed;
  for (const Digit& digit : digits)
    here.emplace(digit.cycle, digit.place);
  for (const auto* cycle :
       {"CYCLE961", "CYCLE976", "CYCLE977", "CYCLE978", "CYCLE979", "CYCLE995", "CYCLE997", "CYCLE998"}) {
    for (const cycles::CodeDigit& digit : cycles::sinumerikCycle(cycle)->parameters.front().digits)
      listed.emplace(cycle, digit.place);
  }
  EXPECT_EQ(here, listed);
}

TEST(Digits, TheNumberedCornersTurnTheSignsOfTheirDistances) {
  // Corner 2: minus along the 1st axis, 3: along both, 4: along the 2nd; whatever sign the call has.
  for (int corner = 1; corner <= 4; ++corner) {
    const double x = corner == 2 || corner == 3 ? -1 : 1, y = corner >= 3 ? -1 : 1;
    SCOPED_TRACE(corner);
    simulation::Truth truth = perfectWorld();
    place(truth,
          simulation::Box({std::min(0.0, 100 * x), std::min(0.0, 100 * y), -60},
                          {std::max(0.0, 100 * x), std::max(0.0, 100 * y), 0}),
          translation(origin + Vector3(0.3, -0.2, 0)));
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, origin);
    const Vector3 pole(-15 * x, -15 * y, -10);
    bench.start(pole);
    bench.run("CYCLE961", {{"S_MVAR", 10000 * corner + 6},
                           {"S_SETV0", 30},
                           {"S_SETV1", 80},
                           {"S_SETV2", 40},
                           {"S_SETV4", pole.x()},
                           {"S_SETV5", pole.y()},
                           {"S_FA", 20},
                           {"S_TSA", 5}});
    EXPECT_NEAR(bench.ovr(5), 0.3, 1e-7);
    EXPECT_NEAR(bench.ovr(6), -0.2, 1e-7);
  }
}

TEST(Digits, TheWayToTheMeasuringHeightLeadsToThePart) {
  // S_ID of a corner, and S_SETV in front of an edge or a plane, are ways towards the part; the manual draws them
  // positive.
  for (const double sign : {1.0, -1.0}) {
    SCOPED_TRACE(sign);
    simulation::Truth truth = perfectWorld();
    place(truth, simulation::Box({0, 0, -60}, {100, 100, 0}), translation(origin));
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, origin);
    const Variant& corner = named("961 right outside");
    bench.start({-15, -15, 12});
    bench.run("CYCLE961", with(corner.call, {{"S_MVAR", 1006}, {"S_ID", 22 * sign}}));
    EXPECT_NEAR(bench.ovr(5), 0, 1e-7);
    const Variant& plane = named("998 plane");
    bench.start({20, 20, 32});
    bench.run("CYCLE998", with(plane.call, {{"S_MVAR", 101006}, {"S_SETV", 20 * sign}}));
    EXPECT_NEAR(bench.ovr(4), 0, 1e-7);
    const Variant& edge = named("998 edge");
    bench.start({-34, 20, -10});
    bench.run("CYCLE998", with(edge.call, {{"S_MVAR", 101005}, {"S_SETV", 20 * sign}, {"S_MD", 1}}));
    EXPECT_NEAR(bench.ovr(4), 0, 1e-7);
  }
  // Where S_MD leaves the direction open, the sign of S_SETV is it.
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::Box({-100, -100, -60}, {0, 100, 0}), translation(origin));
  SinumerikBench bench(truth);
  plantFrame(bench, "$P_UIFR", 1, origin);
  bench.start({34, -20, -10});
  bench.run("CYCLE998", with(named("998 edge").call, {{"S_MVAR", 101005}, {"S_SETV", -20}, {"S_MD", 0}}));
  EXPECT_NEAR(bench.ovr(4), 0, 1e-7);
}

TEST(Digits, ANumberOf0CorrectsNothing) {
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::Ring(20.1, 80, -60), translation(origin + Vector3(0.3, 0.2, 0)));
  SinumerikBench bench(truth);
  plantFrame(bench, "$P_UIFR", 1, origin);
  bench.control.data.set("$TC_TP2", {7}, std::string("MILL"));
  bench.set("$TC_DP1", {7, 1}, 120);
  const NamedNumbers call = {{"S_SETV", 40}, {"S_FA", 6}, {"S_TSA", 3}};
  const auto writesOf = [&](const NamedNumbers& more) {
    bench.start({0, 0, -10});
    bench.run("CYCLE977", with(call, more), {{"S_TNAME", "MILL"}});
    EXPECT_NEAR(bench.ovr(16), 0.2, 1e-7) << "measured all the same";
    return bench.control.journal.cycles.back().writes.size();
  };
  for (const int knum : {0, 10000, 1000, 11000, 3000, 13000})
    EXPECT_EQ(writesOf({{"S_MVAR", 101}, {"S_KNUM", knum}}), 0u) << knum;
  for (const int knum1 : {0, 100000, 4000000, 14400000})
    EXPECT_EQ(writesOf({{"S_MVAR", 201}, {"S_KNUM1", knum1}}), 0u) << knum1;
  // The base reference and the active frame have no number.
  EXPECT_EQ(writesOf({{"S_MVAR", 101}, {"S_KNUM", 2000}}), 2u);
  EXPECT_EQ(writesOf({{"S_MVAR", 101}, {"S_KNUM", 9000}}), 0u) << "the hole is in its place by now";
}

TEST(Digits, ARotaryAxisWithoutFineOffsetIsCorrectedCoarse) {
  // MD 52207 bit 6, of the machine's axis.
  for (const auto& [datum, part] : {std::pair(-1, "FI"), std::pair(64, "FI"), std::pair(191, "TR")}) {
    simulation::Truth truth = perfectWorld("mill5-head-table");
    const auto axis = *truth.machine.axisIndex("C");
    const Vector3 place0(10, -5, -450);
    place(truth, simulation::Box({0, -100, -80}, {200, 200, 0}), translation(place0) * rotation(Vector3::UnitZ(), 1.5));
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, place0);
    if (datum >= 0) bench.set("$MCS_AXIS_USAGE_ATTRIB", {static_cast<int>(axis)}, datum);
    bench.start({-14, -20, -10});
    bench.run("CYCLE998", {{"S_MVAR", 100105},
                           {"S_KNUM", 1},
                           {"S_RA", static_cast<double>(axis) + 1},
                           {"S_FA", 13},
                           {"S_TSA", 10},
                           {"S_MA", 201},
                           {"S_MD", 1},
                           {"S_ID", 40}});
    EXPECT_NEAR(std::abs(bench.data("$P_UIFR", {1, "C", part})), 1.5, 1e-6) << datum;
  }
}

}  // namespace
}  // namespace probewright
