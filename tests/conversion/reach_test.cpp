#include <gmock/gmock.h>

#include "conversion/twins.hpp"

/// How far a touch looks for the surface: what the original program finds the converted one finds, or that is listed.
namespace probewright::testing_support {
namespace {

using ::testing::HasSubstr;

/// A feature whose surfaces lie `off` mm farther from the probe than the program expects them.
struct Feature {
  const char* name;
  std::function<void(PlantedPart& part, double off)> lay;
  std::function<std::string(double clearance)> heidenhain;         ///< Q320
  std::function<std::string(double path, double safe)> sinumerik;  ///< S_FA, S_TSA of lengths
  bool listed = false;  ///< to a SINUMERIK: where DIST reaches farther behind the place than the touch begins before it
};

void layBox(PlantedPart& part, const Vector3& low, const Vector3& high) {
  part.bench.part(simulation::Box(low, high), part.machineFromPart);
}

Words heights(double clearance, double height) { return {{261, height}, {320, clearance}, {260, 40}, {281, 0}}; }

Words common(double clearance, double height) { return with(heights(clearance, height), {{309, 0}, {330, 0}}); }

std::string circle(int cycle, double clearance) {
  return probe(cycle, with(common(clearance, -8), {{273, 0},
                                                   {274, 0},
                                                   {262, 40},
                                                   {325, 0},
                                                   {247, 90},
                                                   {301, 0},
                                                   {cycle == 421 ? 275 : 277, 0},
                                                   {cycle == 421 ? 276 : 278, 0},
                                                   {279, 0},
                                                   {280, 0},
                                                   {423, 4},
                                                   {365, 1}}));
}

std::string surface(int axis, double clearance) {
  return probe(427, with(common(clearance, axis == 3 ? 0 : -8),
                         {{263, axis == 3 ? 0 : 50}, {264, 0}, {272, axis}, {267, -1}, {288, 0}, {289, 0}}));
}

std::string call977(int units, double path, double safe) {
  const std::string start = units == 1 ? "G0 X0 Y0\nG0 Z-10\n" : "G0 X0 Y0\nG0 Z20\n";
  Named words = {{"S_MVAR", units}, {"S_PRNUM", 1}, {"S_SETV", 40}, {"S_FA", path}, {"S_TSA", safe}, {"S_NMSP", 1}};
  if (units == 2) words.emplace_back("S_ID", -30);
  return start + sinumerikCall("CYCLE977", words) + "G0 Z40\n";
}

std::string call978(int axis, double path, double safe) {
  const std::string start = axis == 3 ? "G0 X0 Y0\nG0 Z30\n" : "G0 X75 Y0\nG0 Z-10\n";
  return start +
         sinumerikCall("CYCLE978", {{"S_MVAR", 0},
                                    {"S_PRNUM", 1},
                                    {"S_SETV", axis == 3 ? 0 : 50},
                                    {"S_FA", path},
                                    {"S_TSA", safe},
                                    {"S_MA", axis},
                                    {"S_MD", 2},
                                    {"S_NMSP", 1}}) +
         (axis == 3 ? "G0 Z40\n" : "G0 X75 Y0\nG0 Z40\n");
}

/// The edge at Y-50, from below, the points 30 mm apart.
std::string call998(double path, double angle) {
  return fmt::format("G0 X-15 Y={:.4f}-$P_TOOLR\nG0 Z-10\n", -50 - path) +
         sinumerikCall("CYCLE998", {{"S_MVAR", 5},
                                    {"S_PRNUM", 1},
                                    {"S_RA", 0},
                                    {"S_STA1", 0},
                                    {"S_FA", path},
                                    {"S_TSA", angle},
                                    {"S_MA", 102},
                                    {"S_MD", 1},
                                    {"S_ID", 30},
                                    {"S_NMSP", 1}}) +
         fmt::format("G0 X0 Y{}\nG0 Z40\n", -50 - path - 20);
}

const Feature features[] = {
    {"hole",
     [](PlantedPart& part, double off) { part.bench.part(simulation::Ring(20 + off, 60, -30), part.machineFromPart); },
     [](double clearance) { return circle(421, clearance); },
     [](double path, double safe) { return call977(1, path, safe); }},
    {"spigot",
     [](PlantedPart& part, double off) {
       part.bench.part(simulation::RoundBar(20 - off, -30, 0), part.machineFromPart);
     },
     [](double clearance) { return circle(422, clearance); },
     [](double path, double safe) { return call977(2, path, safe); }, true},
    {"from above",
     [](PlantedPart& part, double off) {
       layBox(part, {-50, -50, -40}, {50, 50, -off});
     },
     [](double clearance) { return surface(3, clearance); },
     [](double path, double safe) { return call978(3, path, safe); }},
    {"side",
     [](PlantedPart& part, double off) {
       layBox(part, {-50, -50, -40}, {50 - off, 50, 0});
     },
     [](double clearance) { return surface(1, clearance); },
     [](double path, double safe) { return call978(1, path, safe); }, true},
    {"edge",
     [](PlantedPart& part, double off) {
       layBox(part, {-50, -50 + off, -40}, {50, 50, 0});
     },
     [](double clearance) {
       return probe(420, with(heights(clearance, -8),
                              {{263, -15}, {264, -50}, {265, 15}, {266, -50}, {272, 2}, {267, 1}, {301, 0}}));
     },
     [](double path, double) { return call998(path, 5); }},
    {"turned edge",  // the second point lies farther, the first where it is expected
     [](PlantedPart& part, double off) {
       const double angle = degrees(std::atan2(off, 30));
       part.bench.part(simulation::Box({-10, 0, -40}, {90, 60, 0}),
                       part.machineFromPart * pose({-15, -50, 0}, {0, 0, angle}));
     },
     [](double clearance) {
       return probe(420, with(heights(clearance, -8),
                              {{263, -15}, {264, -50}, {265, 15}, {266, -50}, {272, 2}, {267, 1}, {301, 0}}));
     },
     [](double path, double) { return call998(path, 12); }},
    {"plane",
     [](PlantedPart& part, double off) {
       layBox(part, {-50, -50, -40}, {50, 50, -off});
     },
     [](double clearance) {
       return probe(431, {{263, -30},
                          {264, -30},
                          {294, 0},
                          {265, 30},
                          {266, -30},
                          {295, 0},
                          {296, 0},
                          {297, 30},
                          {298, 0},
                          {320, clearance},
                          {260, 40},
                          {281, 0}});
     },
     {}},
};

PlantedPart worldOf(const Feature& feature, double off, double travel) {
  PlantedPart part{Bench(ControlKind::TNC640, "mill3")};
  part.machineFromPart = part.machineFromPreset = pose({20, -10, -400}, {0, 0, 0});
  part.bench.preset(1, {20, -10, -400}, 0);
  part.bench.believedProbe().maximumTravel = travel;
  part.bench.probeOf(100, 2);
  feature.lay(part, off);
  return part;
}

/// Runs both, and tells whether something of the reach was listed.
bool compare(const Twin& original, ProgramLanguage to, const PlantedPart& part, double travel) {
  conversion::Conversion there =
      converted(original.text, original.language, ControlKind::TNC640, {.setUp = 2, .travel = travel});
  EXPECT_FALSE(hasErrors(there.mistakes));
  bool listed = false, findsMore = false;
  for (const Diagnostic& each : there.notCarriedOver) {
    if (each.message.find("touches lie at other places") != std::string::npos) continue;
    const bool note = each.severity == Severity::Note;
    EXPECT_THAT(each.message, HasSubstr(note ? "the one that is written measures" : "looks for the surface"));
    (note ? findsMore : listed) = true;
  }
  if (listed) return true;
  const Twin other = run(there.text, to, part);
  if (!original.finished) {  // then the other may find more
    EXPECT_TRUE(findsMore || !other.finished || to == ProgramLanguage::Sinumerik) << original.why;
    return false;
  }
  EXPECT_TRUE(other.finished) << other.why << original.text << there.text;
  const auto one = touchesOf(original), two = touchesOf(other);
  EXPECT_EQ(one.size(), two.size());
  for (const Vector3& touch : one) {
    EXPECT_TRUE(std::ranges::any_of(two, [&](const Vector3& each) { return (each - touch).norm() < exactly; }))
        << original.text << there.text;
  }
  return false;
}

TEST(ConvertReach, SinumerikCyclesFindWhatTheTouchProbeFinds) {
  for (const Feature& feature : features) {
    SCOPED_TRACE(feature.name);
    int found = 0, missed = 0;
    for (const double travel : {6.0, 10.0, 17.0}) {
      for (const double clearance : {0.0, 1.0, 3.0, 6.5}) {
        for (const double off : {0.0, 2.9, 5.9, 7.9, 10.3, 14.9}) {
          SCOPED_TRACE(fmt::format("DIST {} Q320 {} off {}", travel, clearance, off));
          const PlantedPart part = worldOf(feature, off, travel);
          const Twin original = runKlartext(klartextProgram(feature.heidenhain(clearance)), part);
          EXPECT_EQ(original.finished, off < travel - clearance - 2) << original.why;
          ++(original.finished ? found : missed);
          const bool listed = compare(original, ProgramLanguage::Sinumerik, part, travel);
          EXPECT_EQ(listed, feature.listed && travel - clearance - 2 > clearance + 2);
          if (::testing::Test::HasFailure()) return;
        }
      }
    }
    EXPECT_GT(found, 10);
    EXPECT_GT(missed, 10);
  }
}

/// A ring leaves no more room than to its middle; on a sphere the probe looks down along DIST from where it stands.
TEST(ConvertReach, CalibrationsFindRingAndSphere) {
  for (const double clearance : {1.0, 8.0, 30.0}) {
    const PlantedPart part = worldOf(features[0], -5, 16);
    const Twin original = runKlartext(
        klartextProgram("L X+0.3 Y-0.2 R0 FMAX\nL Z-10 R0 FMAX\n" +
                        probe(462, {{407, 15}, {320, clearance}, {423, 4}, {380, 0}}) + "L X+0 Y+0 Z+40 R0 FMAX\n"),
        part);
    ASSERT_TRUE(original.finished) << original.why;
    const Twin there = runConverted(original, part);
    EXPECT_TRUE(ranWhole(there)) << clearance;
    EXPECT_TRUE(sameEnd(original, there));
  }
  for (const double travel : {6.0, 8.0}) {
    const std::string sphere = klartextProgram(
        probe(460, {{407, 12.5}, {320, 1}, {301, 0}, {423, 4}, {380, 0}, {433, 0}, {434, 0}, {455, 0}}));
    const conversion::Conversion there =
        converted(sphere, ProgramLanguage::Klartext, ControlKind::TNC640, {.setUp = 2, .travel = travel});
    EXPECT_EQ(lists(there, "looks for the surface farther"), travel > 6) << there.text;
  }
}

/// A touch probe cycle begins in the middle where the walls leave no room in front of them, and at the surface where
/// SET_UP and Q320 are 0; a measuring path of a SINUMERIK is longer than 0.
TEST(ConvertReach, ListsMeasuringPathsThatMayBeNothing) {
  const auto ofHole = [](double diameter) {
    return with(common(1, -8), {{273, 0},
                                {274, 0},
                                {262, diameter},
                                {325, 0},
                                {247, 90},
                                {301, 0},
                                {275, 0},
                                {276, 0},
                                {279, 0},
                                {280, 0},
                                {423, 4},
                                {365, 1}});
  };
  for (const double diameter : {3.0, 4.0, 6.0, 6.5}) {
    // A hole of 7.5 mm that the program takes for a smaller one, and a ball of 4 mm.
    const PlantedPart part = worldOf(features[0], -16.25, 10);
    const Twin original = runKlartext(klartextProgram(probe(421, ofHole(diameter))), part);
    ASSERT_TRUE(original.finished) << original.why;
    const conversion::Conversion there = toSinumerik(original.text);
    EXPECT_EQ(lists(there, "a ball may be as large"), diameter <= 6) << diameter;
    EXPECT_EQ(run(there.text, ProgramLanguage::Sinumerik, part).finished, diameter > 4) << diameter;
  }
  const std::string side = klartextProgram(surface(1, 0));
  const conversion::Conversion there =
      converted(side, ProgramLanguage::Klartext, ControlKind::TNC640, {.setUp = 0, .travel = 10});
  EXPECT_TRUE(lists(there, "measuring path (S_FA) of 0")) << there.text;
}

TEST(ConvertReach, TouchProbeFindsWhatSinumerikCyclesFind) {
  for (const Feature& feature : features) {
    if (!feature.sinumerik) continue;
    SCOPED_TRACE(feature.name);
    int found = 0, listed = 0;
    for (const double travel : {8.0, 10.0, 16.0, 40.0}) {
      for (const double path : {2.0, 4.0, 5.0, 9.0}) {
        for (const double off : {0.0, 1.9, 3.9, 4.9, 8.9}) {
          SCOPED_TRACE(fmt::format("DIST {} S_FA {} off {}", travel, path, off));
          const PlantedPart part = worldOf(feature, off, travel);
          const Twin original =
              runSinumerik("G17 G90 G710\nT1 M6 D1\nG54\nG0 Z100\n" + feature.sinumerik(path, 20) + "M30\n", part);
          found += original.finished ? 1 : 0;
          const bool named = compare(original, ProgramLanguage::Klartext, part, travel);
          listed += named ? 1 : 0;
          if (travel < 2 * path) {
            EXPECT_TRUE(named);
          }
          if (::testing::Test::HasFailure()) return;
        }
      }
    }
    EXPECT_GT(found, 10);
    EXPECT_GT(listed, 10);
    EXPECT_LT(listed, 75);
  }
}

/// CYCLE976 looks as far behind the wall of the ring as it begins in front of it.
TEST(ConvertReach, CalibrationInARingLooksBehindItsWall) {
  for (const double off : {1.5, 5.0}) {
    const PlantedPart part = worldOf(features[0], off, 10);
    const Twin original = runSinumerik("G17 G90 G710\nT1 M6 D1\nG54\nG0 Z100\nG0 X0 Y0\nG0 Z-10\n" +
                                           sinumerikCall("CYCLE976", {{"S_MVAR", 2},
                                                                      {"S_PRNUM", 1},
                                                                      {"S_SETV", 40},
                                                                      {"S_MA", 1},
                                                                      {"S_FA", 8},
                                                                      {"S_TSA", 20},
                                                                      {"S_NMSP", 1}}) +
                                           "G0 Z40\nM30\n",
                                       part);
    EXPECT_TRUE(original.finished) << original.why;
    const conversion::Conversion there =
        converted(original.text, ProgramLanguage::Sinumerik, ControlKind::TNC640, {.setUp = 2, .travel = 10});
    EXPECT_EQ(run(there.text, ProgramLanguage::Klartext, part).finished, off < 2) << there.text;
    EXPECT_TRUE(lists(there, "looks for the surface along 16 mm")) << there.text;
  }
}

/// In a hole of 40 mm a touch that begins 38 mm in front of the wall begins at the other one.
TEST(ConvertReach, TellsWhereASinumerikCycleMayTouchTheOppositeWall) {
  for (const double path : {19.0, 38.0}) {
    const PlantedPart part = worldOf(features[0], 0, 40);
    const Twin original = runSinumerik("G17 G90 G710\nT1 M6 D1\nG54\nG0 Z100\n" + call977(1, path, 20) + "M30\n", part);
    EXPECT_EQ(original.finished, path < 20) << original.why;
    const conversion::Conversion there =
        converted(original.text, ProgramLanguage::Sinumerik, ControlKind::TNC640, {.setUp = 2, .travel = 40});
    EXPECT_TRUE(run(there.text, ProgramLanguage::Klartext, part).finished);
    EXPECT_EQ(std::ranges::any_of(there.notCarriedOver,
                                  [](const Diagnostic& each) {
                                    return each.severity == Severity::Note &&
                                           each.message.find("opposite wall") != std::string::npos;
                                  }),
              path > 20);
  }
}

}  // namespace
}  // namespace probewright::testing_support
