#include "conversion/twins.hpp"

/// Single measuring moves and the old calibration of the length, in random worlds.
namespace probewright::testing_support {
namespace {

constexpr int worlds = 200;

/// A block, and a place from which the probe measures towards one of its faces.
struct Face {
  PlantedPart part;
  int axis, sign;
  Vector3 start;  ///< of the tip
  double high;

  explicit Face(Dice& dice, ControlKind control = ControlKind::TNC640)
      : part(plant(dice, control, 1, 0)),
        axis(dice.whole(0, 2)),
        sign(axis < 2 && dice.coin() ? 1 : -1),
        start(part.nominal),
        high(part.nominal.z() + 30) {
    part.bench.part(simulation::Box({-50, -50, -40}, {50, 50, 0}), part.machineFromPart);
    if (axis < 2) {
      start[axis] -= sign * (50 + written(dice.between(8, 12)));
      start.z() -= 15;
    } else {
      start.z() += written(dice.between(3, 10));
    }
  }
  std::string approach() const {
    return fmt::format("L Z{:+.3f} R0 FMAX\nL X{:+.3f} Y{:+.3f} FMAX\nL Z{:+.3f} FMAX\n", high, start.x(), start.y(),
                       start.z());
  }
  std::string leave() const { return fmt::format("L Z{:+.3f} R0 FMAX\n", high); }
};

TEST(ConvertSingleTouch, MeasuresWithCycle0) {
  Dice dice(1);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    const Face face(dice);
    const Twin original = runKlartext(
        klartextProgram(
            fmt::format("L Z{:+.3f} R0 FMAX\nL X{:+.3f} Y{:+.3f} FMAX\n", face.high, face.start.x(), face.start.y()) +
            fmt::format("TCH PROBE 0.0 REF. PLANE Q10 {}{}\nTCH PROBE 0.1 X{:+.3f} Y{:+.3f} Z{:+.3f}\n",
                        "XYZ"[face.axis], face.sign > 0 ? '+' : '-', face.start.x(), face.start.y(), face.start.z()) +
            face.leave() + "L X+Q10 Y+0 FMAX\n"),
        face.part);
    ASSERT_TRUE(ranWhole(original));

    const Twin there = runConverted(original, face.part, {.setUp = 2, .travel = 20});
    ASSERT_TRUE(ranWhole(there));
    EXPECT_TRUE(sameResults(original, there, {{"Q10", "_OVR[4]"}}));
    EXPECT_TRUE(sameEnd(original, there));

    const Twin back = runConverted(there, face.part);
    ASSERT_TRUE(ranWhole(back));
    EXPECT_TRUE(sameEnd(original, back));
    if (::testing::Test::HasFailure()) return;
  }
}

TEST(ConvertSingleTouch, MeasuresWithCycles3And4) {
  Dice dice(3);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    const Face face(dice);
    const double aside = written(dice.between(-20, 20)), back = written(dice.between(1, 40));
    std::string block;
    if (dice.coin()) {  // the angle counts from X to Y, from Y to Z, from Z to X
      block = fmt::format("TCH PROBE 3.0 MEASURING\nTCH PROBE 3.1 Q10\nTCH PROBE 3.2 {} ANGLE: {:+.3f}\n",
                          "XYZ"[face.axis], face.sign > 0 ? aside : 180 - std::abs(aside));
    } else {
      Vector3 way(0, 0, 0);
      way[face.axis] = face.sign;
      way[(face.axis + 1) % 3] = aside / 60;
      way[(face.axis + 2) % 3] = written(dice.between(-0.2, 0.2));
      block = fmt::format(
          "TCH PROBE 4.0 MEASURING IN 3-D\nTCH PROBE 4.1 Q10\nTCH PROBE 4.2 IX{:+.4f} IY{:+.4f} IZ{:+.4f}\n", way.x(),
          way.y(), way.z());
    }
    const int number = block[10] - '0';
    block += fmt::format("TCH PROBE {}.3 DIST +25 F300 MB{:+.3f} REFERENCE SYSTEM:0\n", number, back);
    if (number == 3) block += "TCH PROBE 3.4 ERRORMODE0\n";
    const Twin original = runKlartext(klartextProgram(face.approach() + block + face.leave() +
                                                      "L X+Q10 Y+Q11 FMAX\nQ12 = Q12 + 80 + Q13\nL Z+Q12 FMAX\n"),
                                      face.part);
    ASSERT_TRUE(ranWhole(original));

    const Twin there = runConverted(original, face.part);
    ASSERT_TRUE(ranWhole(there));
    EXPECT_TRUE(sameEnd(original, there));

    const Twin again = runConverted(there, face.part);
    ASSERT_TRUE(ranWhole(again));
    EXPECT_TRUE(sameEnd(original, again));
    if (::testing::Test::HasFailure()) return;
  }
}

TEST(ConvertSingleTouch, MeasuresWithMeasuringBlocks) {
  Dice dice(4);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    const Face face(dice);
    const char letter = "XYZ"[face.axis];
    const double end = face.start[face.axis] + 25 * face.sign;
    const std::string target =
        dice.coin() ? fmt::format("{}{:.3f}", letter, end) : fmt::format("{}=IC({})", letter, 25 * face.sign);
    const std::string text =
        fmt::format("G17 G90 G710\nT1\nM6 D1\nG54\nG0 Z{:.3f}\nG0 X{:.3f} Y{:.3f}\nG0 Z{:.3f}\nMEAS=1 G1 {} F300\n",
                    face.high, face.start.x(), face.start.y(), face.start.z(), target) +
        fmt::format("R1=$AA_MW[{}]\nR2=0\nIF $AC_MEA[1]\nR2=20\nENDIF\nG0 {}={:.3f}\n", letter, letter,
                    face.start[face.axis]) +
        fmt::format("G0 Z{:.3f}\nG0 X=R1 Y=R2\nM30\n", face.high);
    const Twin original = runSinumerik(text, face.part);
    ASSERT_TRUE(ranWhole(original));

    const Twin there = runConverted(original, face.part);
    ASSERT_TRUE(ranWhole(there));
    EXPECT_TRUE(sameEnd(original, there));
    if (::testing::Test::HasFailure()) return;
  }
}

TEST(ConvertSingleTouch, RetractsToTheStart) {
  PlantedPart part{Bench(ControlKind::TNC640, "mill3")};
  part.bench.preset(1, {20, -10, -400}, 0);
  part.bench.probeOf(100, 2);
  part.bench.part(simulation::Box({-50, -50, -40}, {50, 50, 0}), pose({20, -10, -400}));
  for (const char* back : {"MB MAX", "MB2"}) {
    for (const char* cycle : {"TCH PROBE 3.0 MEASURING\nTCH PROBE 3.1 Q10\nTCH PROBE 3.2 X ANGLE: +20\nTCH PROBE 3.3 ",
                              "TCH PROBE 4.0 MEASURING IN 3-D\nTCH PROBE 4.1 Q10\nTCH PROBE 4.2 IX+1 IY+0 IZ-0.2\n"
                              "TCH PROBE 4.3 "}) {
      const Twin original =
          runKlartext(klartextProgram(fmt::format("L X-58 Y+0 R0 FMAX\nL Z-5 R0 FMAX\n{}DIST +10 F100 {} REFERENCE "
                                                  "SYSTEM: 0\n",
                                                  cycle, back)),
                      part);
      ASSERT_TRUE(original.finished) << original.why;
      EXPECT_EQ(std::abs(original.axes[0] + 38) < exactly, back == std::string("MB MAX"));
      const Twin there = runConverted(original, part);
      EXPECT_TRUE(ranWhole(there));
      EXPECT_TRUE(sameEnd(original, there));
    }
  }
}

/// A stylus that is not retracted is still deflected when a HEIDENHAIN control moves on.
TEST(ConvertSingleTouch, NamesThatItIsNotRetracted) {
  for (const char* back : {"MB0", "MB1", "MB MAX"}) {
    const std::string along = fmt::format(
        "TCH PROBE 3.0 MEASURING\nTCH PROBE 3.1 Q10\nTCH PROBE 3.2 X ANGLE: +0\n"
        "TCH PROBE 3.3 DIST +10 F100 {} REFERENCE SYSTEM: 0\n",
        back);
    EXPECT_EQ(lists(toSinumerik(klartextProgram("L X+0 Y+0 R0 FMAX\n" + along)), "stays deflected"),
              back == std::string("MB0"))
        << back;
  }
}

TEST(ConvertSingleTouch, CalibratesTheLengthWithCycle9) {
  Dice dice(9);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    PlantedPart part = plant(dice, ControlKind::iTNC530, 0, 0);
    part.bench.part(simulation::Box({-50, -50, -40}, {50, 50, 0}), part.machineFromPart);
    part.bench.believedProbe().length += written(dice.between(-0.5, 0.5));
    const Vector3& n = part.nominal;
    const std::string text =
        fmt::format("L X{:+.3f} Y{:+.3f} R0 FMAX\nL Z{:+.3f} FMAX\n", n.x(), n.y(), n.z() + 4) +
        fmt::format("TCH PROBE 9.0 CAL. TS LENGTH\nTCH PROBE 9.1 DATUM {:+.3f} REFERENCE SYSTEM 0\n", n.z()) +
        fmt::format("L Z{:+.3f} FMAX\n", n.z() + 30) +
        probe(427, {{263, n.x() + 5},
                    {264, n.y() + 5},
                    {261, n.z()},
                    {320, 2},
                    {272, 3},
                    {267, -1},
                    {260, n.z() + 20},
                    {281, 0},
                    {288, 0},
                    {289, 0},
                    {309, 0},
                    {330, 0}});
    const Twin original = runKlartext(klartextProgram(text), part);
    ASSERT_TRUE(ranWhole(original));
    EXPECT_NEAR(original.result("Q160"), n.z(), exactly);

    const Twin there = runConverted(original, part);
    ASSERT_TRUE(ranWhole(there));
    EXPECT_TRUE(sameResults(original, there, {{"Q160", "_OVR[4]"}}));
    if (::testing::Test::HasFailure()) return;
  }
}

}  // namespace
}  // namespace probewright::testing_support
