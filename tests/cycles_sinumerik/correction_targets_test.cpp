#include <algorithm>

#include "cycles_sinumerik/milling_variants.hpp"

/// Every measuring variant into every target of correction: zero offsets of each kind, fine and coarse, by number and
/// active, their translations, rotations and rotary axes; tools by name, number and D, in each component and memory.
namespace probewright {
namespace {

using namespace testing_support;

struct Target {
  double knum;
  int settable;       ///< in effect: 1 G54, 0 G500
  const char* frame;  ///< what must change
  int number;         ///< its index; -1 none
  bool coarse;
  bool global = false;
};

constexpr Target targets[] = {
    {1, 1, "$P_UIFR", 1, false},           {10001, 1, "$P_UIFR", 1, true},        {9000, 1, "$P_UIFR", 1, false},
    {19000, 1, "$P_UIFR", 1, true},        {1001, 1, "$P_CHBFR", 0, false},       {11001, 1, "$P_CHBFR", 0, true},
    {11002, 1, "$P_CHBFR", 1, true},       {2000, 1, "$P_SETFR", -1, false},      {12000, 1, "$P_SETFR", -1, true},
    {3001, 1, "$P_NCBFR", 0, false, true}, {13002, 1, "$P_NCBFR", 1, true, true}, {9000, 0, "$P_CHBFR", 1, false},
    {19000, 0, "$P_CHBFR", 1, true},
};

TEST(CorrectionTargets, EachVariantIntoEachZeroOffset) {
  Planter plant(101);
  for (const Variant& variant : variants()) {
    for (const Target& target : targets) {
      SCOPED_TRACE(fmt::format("{} into {}{}", variant.name, target.knum, target.settable == 0 ? " with G500" : ""));
      // The chain: a base frame that is turned, and the rest in G54; with G500 all of it in the base.
      const double turn = plant.number(-30, 30);
      const Pose believed = translation(origin) * rotation(Vector3::UnitZ(), turn);
      const Pose part = displaced(variant, believed, plant);
      simulation::Truth truth = perfectWorld();
      variant.part(truth, part);
      SinumerikBench bench(truth);
      plantFrame(bench, "$P_CHBFR", 0, {origin.x(), origin.y(), 0}, {0, 0, turn / 3});
      if (target.settable == 1) {
        plantFrame(bench, "$P_UIFR", 1, {0, 0, origin.z()}, {0, 0, turn * 2 / 3});
      } else {
        plantFrame(bench, "$P_CHBFR", 1, {0, 0, origin.z()}, {0, 0, turn * 2 / 3});
      }
      bench.start(variant.start, target.settable);
      const bool refused = target.global && (variant.turns || variant.tilts);
      if (refused) {
        EXPECT_EQ(bench.alarmOf(variant.cycle, with(variant.call, {{"S_KNUM", target.knum}})), "61322");
        continue;
      }
      bench.run(variant.cycle, with(variant.call, {{"S_KNUM", target.knum}}));
      expectInPlace(bench, variant, part);
      // Nothing else has changed: only that frame, and of its translations only the part asked for.
      ASSERT_FALSE(bench.control.journal.cycles.empty());
      const auto& writes = bench.control.journal.cycles.back().writes;
      EXPECT_FALSE(writes.empty());
      for (const auto& write : writes) {
        EXPECT_EQ(write.table, target.frame);
        if (target.number >= 0) {
          EXPECT_EQ(write.entry.rfind(fmt::format("[{},", target.number), 0), 0U) << write.entry;
        }
        const bool rotation = write.entry.find(",RT]") != std::string::npos;
        EXPECT_TRUE(rotation || write.entry.find(target.coarse ? ",TR]" : ",FI]") != std::string::npos) << write.entry;
        if (rotation) {
          EXPECT_TRUE(variant.turns || variant.tilts) << write.entry;
        }
      }
      EXPECT_EQ(bench.ovi(11), 1);
      // The zero offset that was active is told by its own number.
      const int active = target.settable == 1 ? target.number : 1001 + target.number;
      const int asked = static_cast<int>(target.knum) % 10000;
      EXPECT_EQ(bench.ovi(0), asked == 9000 ? active : asked);
    }
  }
}

TEST(CorrectionTargets, TheTableAxisIntoEachZeroOffset) {
  Planter plant(102);
  for (const char* build : {"mill5-head-table", "mill5-table-table"}) {
    for (const Target& target : targets) {
      SCOPED_TRACE(fmt::format("{} on {}", target.knum, build));
      const Vector3 place0(10, -5, -450);
      const double set = plant.number(-3, 3), angle = set + plant.number(-6, 6);
      simulation::Truth truth = perfectWorld(build);
      place(truth, simulation::Box({0, -100, -80}, {200, 200, 0}),
            translation(place0) * rotation(Vector3::UnitZ(), angle));
      SinumerikBench bench(truth);
      plantFrame(bench, "$P_CHBFR", 0, {place0.x(), place0.y(), 0});
      plantFrame(bench, target.settable == 1 ? "$P_UIFR" : "$P_CHBFR", 1, {0, 0, place0.z()});
      const auto axis = truth.machine.axisIndex("C");
      ASSERT_TRUE(axis);
      const NamedNumbers call = {{"S_MVAR", 100105},
                                 {"S_KNUM", target.knum},
                                 {"S_RA", static_cast<double>(*axis) + 1},
                                 {"S_STA1", set},
                                 {"S_FA", 13},
                                 {"S_TSA", 10},
                                 {"S_MA", 201},
                                 {"S_MD", 1},
                                 {"S_ID", 40}};
      bench.start({-14, -20, -10}, target.settable);
      if (target.global) {
        EXPECT_EQ(bench.alarmOf("CYCLE998", call), "61322");
        continue;
      }
      bench.run("CYCLE998", call);
      EXPECT_NEAR(bench.ovr(16), angle - set, 1e-7);
      const auto& writes = bench.control.journal.cycles.back().writes;
      ASSERT_EQ(writes.size(), 1U);
      EXPECT_EQ(writes[0].table, target.frame);
      const std::string index = target.number < 0 ? "" : fmt::format("{},", target.number);
      EXPECT_EQ(writes[0].entry, fmt::format("[{}C,{}]", index, target.coarse ? "TR" : "FI"));
      // Positioned anew, the edge has its set angle.
      bench.start({-40, -20, -10}, target.settable);
      bench.run("CYCLE998", with(call, {{"S_MVAR", 100005}, {"S_KNUM", 0}, {"S_FA", 45}}), {},
                "G0 Z80\nG0 C0\nG0 Z-10\n");
      EXPECT_NEAR(bench.ovr(4), set, 1e-7);
    }
  }
}

TEST(CorrectionTargets, AFrameThatIsNotActiveGetsTheSameCorrection) {
  for (const Variant& variant : variants()) {
    SCOPED_TRACE(variant.name);
    const Pose part = translation(origin + Vector3(0.3, -0.2, variant.axes.size() == 3 ? 0.1 : 0)) *
                      (variant.turns ? rotation(Vector3::UnitZ(), 1) : Pose::Identity());
    simulation::Truth truth = perfectWorld();
    variant.part(truth, part);
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, origin);
    plantFrame(bench, "$P_UIFR", 6, origin);
    bench.start(variant.start);
    bench.run(variant.cycle, with(variant.call, {{"S_KNUM", 10006}}));
    const Vector3 before = inWorkpiece(bench, part.translation());
    bench.start(variant.start, 6);
    bench.run(variant.cycle, with(variant.call, {{"S_KNUM", 0}}));
    EXPECT_EQ(bench.ovi(11), 0) << "0 corrects nothing";
    const Vector3 after = inWorkpiece(bench, part.translation());
    EXPECT_NEAR(before.x(), part.translation().x() - origin.x(), 1e-9) << "G54 stays";
    for (const int axis : variant.axes)
      EXPECT_NEAR(after[axis], 0, 1e-6);
  }
}

// ---- tools ----

/// A cutter T7 "MILL" with two edges, and a feature 0.04 too large or too far.
class ToolTargets : public SinumerikBench {
public:
  explicit ToolTargets(const simulation::Truth& truth) : SinumerikBench(truth) {
    plantFrame(*this, "$P_UIFR", 1, origin);
    control.data.set("$TC_TP2", {7}, std::string("MILL"));
    for (const int edge : {1, 2}) {
      set("$TC_DP1", {7, edge}, 120);
      for (int parameter = 3; parameter <= 6; ++parameter)
        set(fmt::format("$TC_DP{}", parameter).c_str(), {7, edge}, 10.0 * parameter);
    }
  }
};

struct ToolVariant {
  const char* name;
  const char* cycle;
  std::function<void(simulation::Truth&, const Pose&)> part;
  NamedNumbers call;
  Vector3 start;
  double radius;  ///< by how much the radius and
  double length;  ///< the lengths are to be corrected: the feature is 0.04 too large, or too far in the plus direction
  bool radiusByDefault = true;
};

std::vector<ToolVariant> toolVariants() {
  std::vector<ToolVariant> all;
  const std::vector<Variant> known = variants();
  const auto named = [&](std::string_view name) -> const Variant& {
    return *std::find_if(known.begin(), known.end(), [&](const Variant& variant) { return variant.name == name; });
  };
  const auto add = [&](const char* name, double radius, double length, bool byRadius = true) {
    const Variant& variant = named(name);
    NamedNumbers call = variant.call;
    for (auto& [parameter, value] : call) {
      if (parameter == "S_MVAR") value += 100;
      // The set sizes are 0.04 smaller than the part.
      if (parameter == "S_SETV" || parameter == "S_SETV0" || parameter == "S_SETV1") value -= 0.04;
    }
    if (std::string_view(variant.cycle) == "CYCLE978") call.emplace_back("S_SETV", -0.04);
    all.push_back({name, variant.cycle, variant.part, call, variant.start, radius, length, byRadius});
  };
  // Surfaces touched in plus direction and found 0.04 further: the cutter reached further than its data say.
  add("978 1st axis", 0.04, -0.04);
  add("978 2nd axis", 0.04, -0.04);
  // The top found too high: the cutter is shorter.
  add("978 3rd axis", -0.04, -0.04, false);
  add("977 hole", 0.02, -0.02);
  add("977 spigot", -0.02, -0.02);
  add("977 groove 1", 0.02, -0.02);
  add("977 groove 2", 0.02, -0.02);
  add("977 rib", -0.02, -0.02);
  add("977 pocket", 0.02, -0.02);
  add("977 rectangle", -0.02, -0.02);
  add("979 inside", 0.02, -0.02);
  add("979 outside", -0.02, -0.02);
  return all;
}

TEST(CorrectionTargets, EachVariantIntoEachToolDatum) {
  for (const ToolVariant& variant : toolVariants()) {
    simulation::Truth truth = perfectWorld();
    variant.part(truth, translation(origin));
    for (int component = 0; component <= 4; ++component) {
      for (int memory = 0; memory <= 4; ++memory) {
        for (const bool inverted : {false, true}) {
          const int edge = 1 + (component + memory) % 2, dl = 1 + (component + 2 * memory) % 6;
          SCOPED_TRACE(fmt::format("{} component {} memory {} {} D{} DL{}", variant.name, component, memory,
                                   inverted ? "inverted" : "", edge, dl));
          ToolTargets bench(truth);
          const bool radius = component == 4 || (component == 0 && variant.radiusByDefault);
          const int place = radius ? 3 : component == 0 ? 0 : component - 1;  // length 1, 2, 3, radius
          bench.set(fmt::format("$TC_SCP{}", 10 * dl + 3 + place).c_str(), {7, edge}, 0.5);
          bench.set(fmt::format("$TC_ECP{}", 10 * dl + 3 + place).c_str(), {7, edge}, 0.25);
          bench.start(variant.start);
          const double code = (inverted ? 1e7 : 0) + 1e6 * memory + 1e5 * component + edge;
          bench.run(variant.cycle, with(variant.call, {{"S_KNUM1", code}, {"S_DLNUM", static_cast<double>(dl)}}),
                    {{"S_TNAME", component % 2 == 0 ? "mill" : "7"}});
          const double change = (radius ? variant.radius : variant.length) * (inverted ? -1 : 1);
          std::string datum;
          double expected = change;
          switch (memory) {
            case 0:
              datum = fmt::format("$TC_DP{}", place == 3 ? 15 : 12 + place);
              break;
            case 1:
              datum = fmt::format("$TC_SCP{}", 10 * dl + 3 + place);
              expected += 0.5;
              break;
            case 2:  // the additive offset goes into the setup offset
              datum = fmt::format("$TC_ECP{}", 10 * dl + 3 + place);
              expected += 0.25 + 0.5;
              EXPECT_EQ(bench.data(fmt::format("$TC_SCP{}", 10 * dl + 3 + place).c_str(), {7, edge}), 0);
              break;
            case 3:
              datum = fmt::format("$TC_ECP{}", 10 * dl + 3 + place);
              expected += 0.25;
              break;
            default:
              datum = fmt::format("$TC_DP{}", 3 + place);
              expected += 10.0 * (3 + place);
          }
          EXPECT_NEAR(bench.data(datum.c_str(), {7, edge}), expected, 1e-7) << datum;
          EXPECT_NEAR(bench.ovr(20), change, 1e-7);
          EXPECT_EQ(bench.control.journal.cycles.back().writes.size(), memory == 2 ? 2U : 1U) << "nothing else";
          EXPECT_EQ(bench.ovi(0), edge);
          EXPECT_EQ(bench.ovi(8), 7);
          EXPECT_EQ(bench.ovi(13), memory >= 1 && memory <= 3 ? dl : 0);
          EXPECT_EQ(bench.control.data.text("_OVS_TNAME", {}), "MILL");
        }
      }
    }
  }
}

TEST(CorrectionTargets, Cycle977NamesEachResultAfterItsVariant) {
  const struct {
    const char* name;
    const char *size, *second;
  } cases[] = {
      {"977 hole", "diameter of the hole", "centre, 1st axis"},
      {"977 spigot", "diameter of the spigot", "centre, 1st axis"},
      {"977 groove 1", "width of the groove", "centre, 1st axis"},
      {"977 rib", "width of the rib", "centre, 1st axis"},
      {"977 pocket", "length of the rectangle in the 1st axis", "length of the rectangle in the 2nd axis"},
      {"977 rectangle", "length of the rectangle in the 1st axis", "length of the rectangle in the 2nd axis"},
  };
  const std::vector<Variant> known = variants();
  for (const auto& [name, size, second] : cases) {
    for (const Variant& variant : known) {
      if (variant.name != std::string_view(name)) continue;
      simulation::Truth truth = perfectWorld();
      variant.part(truth, translation(origin));
      SinumerikBench bench(truth);
      plantFrame(bench, "$P_UIFR", 1, origin);
      bench.start(variant.start);
      bench.run(variant.cycle, variant.call);
      std::string meaning4, meaning5;
      for (const auto& result : bench.control.journal.cycles.back().results) {
        EXPECT_FALSE(result.meaning.empty()) << result.name;
        if (result.name == "_OVR[4]") meaning4 = result.meaning;
        if (result.name == "_OVR[5]") meaning5 = result.meaning;
      }
      EXPECT_EQ(meaning4, std::string("actual value: ") + size) << name;
      EXPECT_EQ(meaning5, std::string("actual value: ") + second) << name;
    }
  }
}

/// A turning tool in a head that is turned (bit 2 of MD 51740): where the next surface comes to lie follows from all of
/// its lengths. It must move by the difference along the measuring axis, and nowhere else.
TEST(CorrectionTargets, OfATurnedHeadAreAllLengthsThatAct) {
  for (const double angle : {30.0, 50.0, 90.0}) {
    constexpr double table = -350;
    simulation::Truth truth = perfectWorld("mill5-head-head");
    place(truth, simulation::Box({0, 0.15, -60}, {120, 100, 0}), translation({0, 0, table}));
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
    control::sinumerik::setMaskBit(bench.control.data, "$MNS_MEA_FUNCTION_MASK", 1, false);
    control::sinumerik::setMaskBit(bench.control.data, "$MNS_MEA_FUNCTION_MASK", 2, true);
    bench.set("$TC_DP3", {1, 1}, 98);
    bench.control.data.set("$TC_TP2", {2}, std::string("TURN"));
    bench.set("$TC_DP1", {2, 1}, 500);
    bench.set("$TC_DP2", {2, 1}, 3);
    bench.set("$TC_DP3", {2, 1}, 80);
    bench.run("CYCLE978",
              {{"S_MVAR", 200}, {"S_KNUM1", 1}, {"S_FA", 6}, {"S_TSA", 5}, {"S_MA", 2}, {"S_MD", 1}, {"S_SETV", 0}},
              {{"S_TNAME", "TURN"}},
              fmt::format("SUPA G0 Z0 D0\nD1\nTRAORI\nG0 A{} C0\nG0 X30 Y-60 Z-20\nG0 Y-20\n", angle));
    EXPECT_NEAR(bench.ovr(4), 0.15, 1e-7);
    // In G17 length 1 of a turning tool lies along Y, length 2 along X, length 3 along Z. The tip is at minus the
    // lengths from the reference point, turned with the head about X.
    const Vector3 change(bench.data("$TC_DP13", {2, 1}), bench.data("$TC_DP12", {2, 1}),
                         bench.data("$TC_DP14", {2, 1}));
    const Vector3 moved = rotation(Vector3::UnitX(), angle) * Vector3(-change);
    EXPECT_LT((moved - Vector3(0, 0.15, 0)).norm(), 1e-7) << angle << ": " << moved.transpose();
  }
}

}  // namespace
}  // namespace probewright
