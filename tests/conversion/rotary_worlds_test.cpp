#include "conversion/twins.hpp"

/// Machines with rotary axes: tilted planes, and workpieces that a rotary table aligns, in random worlds.
namespace probewright::testing_support {
namespace {

constexpr int worlds = 200;
constexpr const char* builds[] = {"mill5-table-table", "mill5-head-table", "mill5-head-head"};

/// A hole in a plane that is tilted about the preset by the space angles. Each control has its own choice of two
/// postures for such a plane: results are compared, not axes.
struct TiltedHole {
  PlantedPart part;
  Vector3 angles;   ///< SPA, SPB, SPC
  double diameter;  ///< nominal and true

  TiltedHole(Dice& dice, const char* machine)
      : part(plant(dice, ControlKind::TNC640, 0, 0, machine)),
        angles(written(dice.between(-20, 20)), written(dice.between(-20, 20)), written(dice.between(-40, 40))),
        diameter(written(dice.between(20, 60))) {
    part.nominal = {written(dice.between(-30, 30)), written(dice.between(-30, 30)), written(dice.between(-10, 10))};
    // Turned about X, then about Y, then about Z, each of the preset.
    part.machineFromPart =
        part.machineFromPreset * pose(Vector3::Zero(), angles) * pose(part.nominal + dice.within(0.5));
    part.bench.part(simulation::Ring(diameter / 2, diameter / 2 + 40, -40), part.machineFromPart);
  }
};

const std::vector<Counterpart> circleResults = {{"Q151", "_OVR[5]"}, {"Q152", "_OVR[6]"}, {"Q153", "_OVR[4]"}};

TEST(ConvertTiltedPlane, MeasuresHolesInPlaneSpatial) {
  Dice dice(8000);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    const TiltedHole hole(dice, builds[world % 3]);
    const Vector3& n = hole.part.nominal;
    const std::string text =
        fmt::format("L Z-1 R0 FMAX M91\nPLANE SPATIAL SPA{:+.3f} SPB{:+.3f} SPC{:+.3f} TURN FMAX\n", hole.angles.x(),
                    hole.angles.y(), hole.angles.z()) +
        fmt::format("L X{:+.3f} Y{:+.3f} R0 FMAX\nL Z{:+.3f} R0 FMAX\n", n.x(), n.y(), n.z() + 30) +
        probe(421, {{273, n.x()},
                    {274, n.y()},
                    {262, hole.diameter},
                    {325, 0},
                    {247, 90},
                    {261, n.z() - 8},
                    {320, 1},
                    {260, n.z() + 20},
                    {301, 0},
                    {275, 0},
                    {276, 0},
                    {279, 0},
                    {280, 0},
                    {281, 0},
                    {309, 0},
                    {330, 0},
                    {423, 4},
                    {365, 1}}) +
        fmt::format("L Z{:+.3f} R0 FMAX\nL X+Q151 Y+Q152 FMAX\n", n.z() + 20);
    const Twin original = runKlartext("BEGIN PGM BENCH MM\nTOOL CALL 1 Z\n" + text + "END PGM BENCH MM\n", hole.part);
    ASSERT_TRUE(ranWhole(original));
    EXPECT_NEAR(original.result("Q153"), hole.diameter, exactly);

    const Twin there = runConverted(original, hole.part);
    ASSERT_TRUE(ranWhole(there));
    EXPECT_TRUE(sameResults(original, there, circleResults));

    const Twin back = runConverted(there, hole.part);
    ASSERT_TRUE(ranWhole(back));
    EXPECT_TRUE(sameResults(original, back, circleResults));
    if (::testing::Test::HasFailure()) return;
  }
}

/// The origin moves along the tilted plane, by what the hole is off and by what the program asks for besides.
TEST(ConvertTiltedPlane, ShiftsTheOriginAlongIt) {
  Dice dice(8007);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    const TiltedHole hole(dice, builds[world % 3]);
    const Vector3& n = hole.part.nominal;
    const bool level = world % 5 == 4;
    const auto set = [&](bool known) {
      return std::string("L Z-1 R0 FMAX M91\nQ50 = 0\n") +
             fmt::format("PLANE SPATIAL SPA{:+.3f} SPB{:+.3f} SPC{} TURN FMAX\n", hole.angles.x(), hole.angles.y(),
                         known ? fmt::format("{:+.3f}", hole.angles.z()) : "+Q50") +
             fmt::format("L X{:+.3f} Y{:+.3f} R0 FMAX\nL Z{:+.3f} R0 FMAX\n", n.x(), n.y(), n.z() + 30) +
             probe(412, {{321, n.x()},
                         {322, n.y()},
                         {262, hole.diameter},
                         {325, 0},
                         {247, 90},
                         {261, n.z() - 8},
                         {320, 1},
                         {260, n.z() + 20},
                         {301, 0},
                         {305, 1},
                         {331, n.x() + (level ? 0 : 0.5)},
                         {332, n.y() - (level ? 0 : 0.8)},
                         {303, 1},
                         {381, 0},
                         {382, 0},
                         {383, 0},
                         {384, 0},
                         {333, 0},
                         {423, 4},
                         {365, 1}}) +
             fmt::format("L Z{:+.3f} R0 FMAX\nPLANE RESET STAY\n", n.z() + 40);
    };
    const auto program = [](const std::string& blocks) {
      return "BEGIN PGM BENCH MM\nTOOL CALL 1 Z\n" + blocks + "END PGM BENCH MM\n";
    };
    const Twin original = runKlartext(program(set(true)), hole.part);
    const Twin there = runConverted(original, hole.part);
    ASSERT_TRUE(ranWhole(original));
    ASSERT_TRUE(ranWhole(there));
    EXPECT_TRUE(sameOrigin(original, there));
    // Where only the running program knows the plane, that is listed.
    EXPECT_EQ(lists(toSinumerik(program(set(false))), "as if no plane were tilted"), !level);
    if (::testing::Test::HasFailure()) return;
  }
}

/// A TNC 640 aligns workpieces in the untilted plane only.
TEST(ConvertTiltedPlane, NamesCyclesThatNeedTheUntiltedOne) {
  const std::string align = probe(400, {{263, 20},
                                        {264, 0},
                                        {265, 60},
                                        {266, 0},
                                        {272, 2},
                                        {267, 1},
                                        {261, -8},
                                        {320, 8},
                                        {260, 30},
                                        {301, 0},
                                        {307, 0},
                                        {305, 1}});
  const auto listed = [&](const std::string& before) {
    return lists(toSinumerik(klartextProgram(before + align)), "stops at cycle 400");
  };
  for (const char* plane : {"SPA+0 SPB+5 SPC+0", "SPA+0 SPB+0 SPC+0", "SPA+Q1 SPB+0 SPC+0"}) {
    const std::string tilts = fmt::format("PLANE SPATIAL {} STAY\n", plane);
    EXPECT_TRUE(listed(tilts)) << plane;
    EXPECT_TRUE(listed("FN 9: IF +Q1 EQU +0 GOTO LBL 1\n" + tilts + "LBL 1\n")) << plane;
    EXPECT_FALSE(listed(tilts + "PLANE RESET STAY\n")) << plane;
  }
  EXPECT_FALSE(listed(""));
}

/// What aligns another zero offset than the one in effect becomes cycle 400.
TEST(ConvertTiltedPlane, NamesSinumerikCyclesThatNeedTheUntiltedOne) {
  const auto listed = [](const std::string& before, const std::string& call) {
    return lists(toKlartext("G17 G90 G710\nT1\nM6 D1\nG54\nG0 Z120\n" + before + "G0 X20 Y-10\nG0 Z-8\n" + call +
                            "\nG0 Z120\nM30\n"),
                 "stops at cycle 4");
  };
  const std::string other = "$P_UIFR[2,Z,RT]=0\nCYCLE998(105,10002,0,1,0,0,,8,20,102,1,40)";
  const std::string tilts = "CYCLE800(0,\"\",0,57,0,0,0,0,5,0,0,0,0,1)\n";
  EXPECT_TRUE(listed(tilts, other));
  EXPECT_TRUE(listed("IF R1>0\n" + tilts + "ENDIF\n", other));
  EXPECT_TRUE(listed(tilts, "CYCLE971(2,0,1,3,0,0,15,15)"));
  EXPECT_FALSE(listed(tilts + "CYCLE800()\n", other));
  EXPECT_FALSE(listed("CYCLE800(0,\"\",0,57,0,0,0,0,0,0,0,0,0,1)\n", other));
  EXPECT_FALSE(listed(tilts, "CYCLE998(5,10002,0,1,0,0,,8,20,102,1,40)"));
}

TEST(ConvertTiltedPlane, MeasuresHolesInSwivelledPlanes) {
  Dice dice(8001);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    TiltedHole hole(dice, builds[world % 3]);
    const Vector3& n = hole.part.nominal;
    const bool zyx = dice.coin();  // about Z, the new Y, the new X; or about X, the new Y, the new Z
    std::string angles = fmt::format("{:.3f},{:.3f},{:.3f}", hole.angles.z(), hole.angles.y(), hole.angles.x());
    if (!zyx) {
      const Matrix3 turn = (rotation(Vector3::UnitX(), hole.angles.x()) * rotation(Vector3::UnitY(), hole.angles.y()) *
                            rotation(Vector3::UnitZ(), hole.angles.z()))
                               .linear();
      const Matrix3 before = pose(Vector3::Zero(), hole.angles).linear();
      Pose turned = Pose::Identity();
      turned.linear() = turn * before.transpose();
      hole.part.bench.setup.world.truth.solids.back().tableFromSolid =
          hole.part.machineFromPreset * turned * hole.part.machineFromPreset.inverse() * hole.part.machineFromPart;
      angles = fmt::format("{:.3f},{:.3f},{:.3f}", hole.angles.x(), hole.angles.y(), hole.angles.z());
    }
    const std::string text =
        fmt::format("G17 G90 G710\nT1\nM6 D1\nG54\nSUPA G0 Z-1 D0\nD1\nCYCLE800(0,\"\",0,{},0,0,0,{},0,0,0,1)\n",
                    zyx ? 27 : 57, angles) +
        fmt::format("G0 X{:.3f} Y{:.3f}\nG0 Z{:.3f}\n", n.x(), n.y(), n.z() + 30) +
        fmt::format("G1 Z{:.3f} F1000\n", n.z() - 8) +
        sinumerikCall(
            "CYCLE977",
            {{"S_MVAR", 1}, {"S_PRNUM", 1}, {"S_NMSP", 1}, {"S_SETV", hole.diameter}, {"S_FA", 4}, {"S_TSA", 5}}) +
        fmt::format("R1=_OVR[5]\nR2=_OVR[6]\nG0 Z{:.3f}\nG0 X=R1 Y=R2\nM30\n", n.z() + 20);
    const Twin original = runSinumerik(text, hole.part);
    ASSERT_TRUE(ranWhole(original));
    EXPECT_NEAR(original.result("_OVR[4]"), hole.diameter, exactly);

    const Twin there = runConverted(original, hole.part);
    ASSERT_TRUE(ranWhole(there));
    EXPECT_TRUE(sameResults(original, there, circleResults));
    if (::testing::Test::HasFailure()) return;
  }
}

/// A skewed block on a table whose C axis turns it, and two points of an edge.
struct SkewedBlock {
  PlantedPart part;
  int axis, sign;
  Vector3 first, second;

  explicit SkewedBlock(Dice& dice)
      : part(plant(dice, ControlKind::TNC640, 0.5, 2, "mill5-table-table")),
        axis(dice.whole(0, 1)),
        sign(dice.coin() ? 1 : -1),
        first(part.nominal),
        second(part.nominal) {
    part.bench.part(simulation::Box({-50, -50, -40}, {50, 50, 0}), part.machineFromPart);
    first[axis] = second[axis] = part.nominal[axis] - sign * 50;
    first[1 - axis] += written(dice.between(-40, -10));
    second[1 - axis] += written(dice.between(10, 40));
  }
};

TEST(ConvertRotaryTable, AlignsWithCycle403) {
  Dice dice(4030);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    SkewedBlock block(dice);
    const bool directed = dice.coin();
    if (directed && dice.coin()) std::swap(block.first, block.second);
    const Vector3 way = block.second - block.first;
    const double nominal = degrees(std::atan2(way.y(), way.x()));
    const double target = directed ? (nominal < 0 ? nominal + 360 : nominal) : block.axis == 0 ? 90 : 0;
    const double up = block.part.nominal.z() + 30;
    const Twin original =
        runKlartext(klartextProgram("CYCL DEF 247 PRESETTING ~\n  Q339=+1 ;NUMBER\n" +
                                    probe(403, {{263, block.first.x()},
                                                {264, block.first.y()},
                                                {265, block.second.x()},
                                                {266, block.second.y()},
                                                {272, block.axis + 1},
                                                {267, block.sign},
                                                {261, block.part.nominal.z() - 8},
                                                {320, 3},
                                                {260, up},
                                                {301, 0},
                                                {312, directed ? 0 : 6},
                                                {337, dice.whole(0, 1)},
                                                {305, dice.whole(0, 1)},
                                                {303, 1},
                                                {380, target}}) +
                                    "L Z+100 R0 FMAX\nL X+0 Y+0 FMAX\nL Y+Q150 X+1 FMAX\nL IC+10 FMAX\nL C+5 FMAX\n"),
                    block.part);
    ASSERT_TRUE(ranWhole(original));

    const Twin there = runConverted(original, block.part);
    ASSERT_TRUE(ranWhole(there));
    EXPECT_TRUE(sameOrigin(original, there));
    EXPECT_TRUE(sameEnd(original, there));
    if (::testing::Test::HasFailure()) return;
  }
}

/// On an axis that turns endlessly: after -35 degrees a HEIDENHAIN control turns by +55 degrees to 20, a SINUMERIK by
/// -305.
TEST(ConvertRotaryTable, TellsThatAnEndlessAxisMayTurnTheOtherWayRound) {
  const auto told = [](const conversion::Conversion& there) {
    return std::ranges::count_if(there.notCarriedOver, [](const Diagnostic& each) {
      return each.severity == Severity::Note && each.message.find("the other way round") != std::string::npos;
    });
  };
  Dice dice(35);
  const PlantedPart part = plant(dice, ControlKind::TNC640, 0, 0, "mill5-table-table");
  for (const auto& [blocks, differs] : {std::pair("L C-35 FMAX\nL C+20 FMAX\n", true),
                                        {"L C-35 R0 FMAX\nL C-20 FMAX\n", true},
                                        {"L IC-35 FMAX\nL C+20 FMAX\nL IC-30 FMAX\nL C+10 FMAX\n", true},
                                        {"L C+350 FMAX\nL IC+20 FMAX\nL C+10 FMAX\n", true},
                                        {"Q1 = -35\nL C+Q1 FMAX\nL C+20 FMAX\n", true},
                                        {"LBL 1\nL C+20 FMAX\nL IC-35 FMAX\nCALL LBL 1 REP 1\n", true},
                                        {"L C+35 FMAX\nL C-20 FMAX\n", false},
                                        {"L C-35 FMAX\nL IC+50 FMAX\n", false},
                                        {"L C+35 FMAX\nL C+350 FMAX\nL C+10 FMAX\n", false}}) {
    SCOPED_TRACE(blocks);
    const Twin original = runKlartext(klartextProgram(blocks), part);
    const Twin there = runConverted(original, part);
    ASSERT_TRUE(ranWhole(original));
    ASSERT_TRUE(ranWhole(there));
    const std::size_t c = part.bench.setup.world.truth.machine.axes.size() - 1;
    EXPECT_EQ(std::abs(original.axes[c] - there.axes[c]) > 1, differs);
    EXPECT_EQ(told(toSinumerik(original.text)), differs ? 1 : 0);
  }
  for (const auto& [blocks, differs] : {std::pair("C-35\nC20\nC-10\nC30\n", true),
                                        {"G91 C-35\nG90 C20\n", true},
                                        {"C=DC(350)\nC=20\n", true},
                                        {"C35\nC-20\n", false},
                                        {"C-35\nC=DC(20)\n", false}}) {
    SCOPED_TRACE(blocks);
    EXPECT_EQ(told(toKlartext(fmt::format("G17 G90 G710\nT1 M6 D1\nG54\nG0 Z100\n{}M30\n", blocks))), differs ? 1 : 0);
  }
  // Where cycle 403 leaves an axis only the part knows.
  const std::string align = probe(403, {{263, 0},
                                        {264, 0},
                                        {265, 50},
                                        {266, 0},
                                        {272, 2},
                                        {267, 1},
                                        {261, -8},
                                        {320, 3},
                                        {260, 20},
                                        {301, 0},
                                        {312, 0},
                                        {337, 0},
                                        {305, 1},
                                        {303, 1},
                                        {380, 0}});
  for (const char axis : {'A', 'B', 'C'}) {
    const std::string move = fmt::format("L {}+20 FMAX\n", axis);
    EXPECT_EQ(told(toSinumerik(klartextProgram(move))), 0) << axis;
    EXPECT_EQ(told(toSinumerik(klartextProgram(align + move))), 1) << axis;
  }
}

TEST(ConvertRotaryTable, CorrectsItsZeroWithCycle1410) {
  Dice dice(1410);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    SkewedBlock block(dice);
    if (dice.coin()) std::swap(block.first, block.second);
    const double height = block.part.nominal.z() - 8;
    const Twin original = runKlartext(klartextProgram(probe(1410, {{1100, block.first.x()},
                                                                   {1101, block.first.y()},
                                                                   {1102, height},
                                                                   {1103, block.second.x()},
                                                                   {1104, block.second.y()},
                                                                   {1105, height},
                                                                   {372, block.sign * (block.axis + 1)},
                                                                   {320, 3},
                                                                   {260, block.part.nominal.z() + 20},
                                                                   {1125, 0},
                                                                   {309, 0},
                                                                   {1126, 0},
                                                                   {1120, 0},
                                                                   {1121, 2}}) +
                                                      "L Z+100 R0 FMAX\nL X+0 Y+0 FMAX\nL C+0 FMAX\n"),
                                      block.part);
    ASSERT_TRUE(ranWhole(original));

    const Twin there = runConverted(original, block.part);
    ASSERT_TRUE(ranWhole(there));
    EXPECT_TRUE(sameResults(original, there, {{"Q994", "_OVR[16]"}}));
    EXPECT_TRUE(sameOrigin(original, there));
    EXPECT_TRUE(sameEnd(original, there));
    if (::testing::Test::HasFailure()) return;
  }
}

TEST(ConvertRotaryTable, CorrectsItsZeroWithCycle998) {
  Dice dice(998);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    SkewedBlock block(dice);
    Vector3 start = block.first;
    start[block.axis] -= block.sign * 12;
    const double high = block.part.nominal.z() + 30;
    const std::string text =
        fmt::format("G17 G90 G710\nT1\nM6 D1\nG54\nG0 Z{:.3f}\nG0 X{:.3f} Y{:.3f}\nG1 Z{:.3f} F1000\n", high, start.x(),
                    start.y(), block.part.nominal.z() - 10) +
        sinumerikCall("CYCLE998", {{"S_MVAR", dice.coin() ? 100105 : 105},
                                   {"S_KNUM", dice.coin() ? 10001 : 19000},
                                   {"S_RA", 5},  // C, the fifth axis of the channel
                                   {"S_PRNUM", 1},
                                   {"S_NMSP", 1},
                                   {"S_FA", 10},
                                   {"S_TSA", 5},
                                   {"S_MA", (2 - block.axis) * 100 + block.axis + 1},
                                   {"S_MD", block.sign > 0 ? 1 : 2},
                                   {"S_ID", (block.second - block.first)[1 - block.axis]}}) +
        fmt::format("G0 Z{:.3f}\nG0 X0 Y0\nG54\nG0 C0\nM30\n", high);
    const Twin original = runSinumerik(text, block.part);
    ASSERT_TRUE(ranWhole(original));

    const Twin there = runConverted(original, block.part);
    ASSERT_TRUE(ranWhole(there));
    EXPECT_TRUE(sameResults(original, there, {{"Q994", "_OVR[16]"}}));
    EXPECT_TRUE(sameOrigin(original, there));
    EXPECT_TRUE(sameEnd(original, there));
    if (::testing::Test::HasFailure()) return;
  }
}

}  // namespace
}  // namespace probewright::testing_support
