#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meant.hpp"
#include "simulation/cad_solid.hpp"
#include "written_iges.hpp"

/// Surfaces of IGES files, most without a body, met where the closed form of what they mean says.
namespace probewright::simulation {
namespace {

using namespace testing;

constexpr double kPi = std::numbers::pi;

void expectRead(const std::string& name, const IgesFile& file, const Distance& distance, double size,
                const Vector3& middle, std::mt19937_64& random, int ways) {
  const ScratchFolder folder;
  const auto solid = readIges(folder.write("part.igs", file.text()));
  ASSERT_TRUE(solid) << name << ": " << format(solid.error());
  expectAsMeant(name, **solid, distance, size, middle, random, ways);
}

TEST(WrittenIges, SplinesWithoutLimitsAreMetWhereTheyAre) {
  std::mt19937_64 random(301);
  for (const int flag : {1, 2, 6}) {
    for (const bool whole : {false, true}) {
      const Pose pose = randomPose(random, 40);
      const double u0 = uniform(random, -9, 9), u1 = whole ? u0 + 2 * kPi : u0 + uniform(random, 0.5, 5);
      IgesFile file({flag, 1});
      file.cylinder(pose, 12, -5, 20, u0, u1);
      expectRead(fmt::format("unit {} {}", flag, whole ? "whole" : "part"), file,
                 distanceOfShell(12, -5, 20, u0, u1, pose), 40, pose * Vector3(0, 0, 7), random, 40);
    }
  }
}

TEST(WrittenIges, ModelsOfAnotherScaleHaveTheirTrueSize) {
  std::mt19937_64 random(302);
  for (const double scale : {0.5, 4.0}) {
    const Pose pose = randomPose(random, 40);
    IgesFile file({2, scale});
    file.cylinder(pose, 12, -5, 20, 0.2, 4);
    expectRead(fmt::format("scale {}", scale), file, distanceOfShell(12, -5, 20, 0.2, 4, pose), 40,
               pose * Vector3(0, 0, 7), random, 40);
  }
}

/// A scale that none can be, zero or less, says nothing: the numbers are millimetres then.
TEST(WrittenIges, ModelsOfAScaleThatIsNoneHaveTheSizeOfTheirNumbers) {
  std::mt19937_64 random(311);
  for (const std::string scale : {"0.", "-2"}) {
    const Pose pose = randomPose(random, 40);
    IgesFile file({2, 1});
    file.cylinder(pose, 12, -5, 20, 0.2, 4);
    std::string text = file.text();
    const std::string one = "4Hpart," + igesNumber(1) + ",2,2HMM";
    const std::size_t at = text.find(one);
    ASSERT_NE(at, std::string::npos) << text.substr(0, 400);
    text.replace(at + 7, igesNumber(1).size(), scale);
    const ScratchFolder folder;
    const auto solid = readIges(folder.write("part.igs", text));
    ASSERT_TRUE(solid) << scale << ": " << format(solid.error());
    expectAsMeant("scale " + scale, **solid, distanceOfShell(12, -5, 20, 0.2, 4, pose), 40, pose * Vector3(0, 0, 7),
                  random, 40);
  }
}

TEST(WrittenIges, SurfacesOfRevolutionAndOfLinesAreMetWhereTheyAre) {
  std::mt19937_64 random(303);
  for (int round = 0; round < 4; ++round) {
    const Pose pose = randomPose(random, 40);
    const Vector3 low = pose * Vector3(0, 0, -5), high = pose * Vector3(0, 0, 20);
    // From the generatrix at angle 0 the surface runs anticlockwise about the axis, from SA to TA.
    const double from = uniform(random, 0, 3), to = from + uniform(random, 0.5, 2 * kPi - from);
    IgesFile turned({round % 2 + 1, 1});
    const int axis = turned.line(low, high), side = turned.line(pose * Vector3(12, 0, -5), pose * Vector3(12, 0, 20));
    turned.add(120, fmt::format("{},{},{},{}", axis, side, igesNumber(from), igesNumber(to)));
    expectRead(fmt::format("revolution {}", round), turned, distanceOfShell(12, -5, 20, from, to, pose), 40,
               pose * Vector3(0, 0, 7), random, 40);
    IgesFile swept({round % 2 + 1, 1});
    const int arc = swept.arc(pose * translation(Vector3(0, 0, -5)), 12, from, to);
    swept.add(122,
              fmt::format("{},{}", arc, swept.point(pose * Vector3(12 * std::cos(from), 12 * std::sin(from), 20))));
    expectRead(fmt::format("tabulated {}", round), swept, distanceOfShell(12, -5, 20, from, to, pose), 40,
               pose * Vector3(0, 0, 7), random, 40);
    IgesFile ruled({round % 2 + 1, 1});
    const int below = ruled.arc(pose * translation(Vector3(0, 0, -5)), 12, from, to);
    const int above = ruled.arc(pose * translation(Vector3(0, 0, 20)), 12, from, to);
    ruled.add(118, fmt::format("{},{},0,0", below, above), 1);
    expectRead(fmt::format("ruled {}", round), ruled, distanceOfShell(12, -5, 20, from, to, pose), 40,
               pose * Vector3(0, 0, 7), random, 40);
  }
}

TEST(WrittenIges, OffsetsLieOnTheSideThatTheirVectorNames) {
  std::mt19937_64 random(306);
  for (const bool inwards : {false, true}) {
    for (const bool downwards : {false, true}) {
      // Seen from below the spline runs the other way round, and its normal points to the axis.
      const Pose pose = randomPose(random, 40);
      const Pose seen = downwards ? Pose(pose * rotation(Vector3::UnitX(), 180)) : pose;
      const double from = downwards ? -1.5 : 0.2, to = from + 1.3;
      IgesFile file({1, 1});
      const int basis =
          file.cylinder(seen, inwards ? 14 : 10, downwards ? 5 : -5, downwards ? -20 : 20, from, to, "00010000");
      const double middle = (from + to) / 2;
      const Vector3 out = seen.linear() * Vector3(std::cos(middle), std::sin(middle), 0) * (inwards ? -1 : 1);
      file.add(140, fmt::format("{},{},{},{},{}", igesNumber(out.x()), igesNumber(out.y()), igesNumber(out.z()),
                                file.length(2), basis));
      const double z0 = downwards ? -20 : -5, z1 = downwards ? 5 : 20;
      expectRead(fmt::format("offset {} {}", inwards, downwards), file, distanceOfShell(12, z0, z1, from, to, seen), 40,
                 seen * Vector3(0, 0, (z0 + z1) / 2), random, 40);
    }
  }
}

TEST(WrittenIges, TrimmedAndBoundedSurfacesAreMetWithinTheirBorders) {
  std::mt19937_64 random(304);
  for (const bool bounded : {false, true}) {
    for (const bool bySpace : {false, true}) {
      const Pose pose = randomPose(random, 40);
      IgesFile file({1, 1});
      // Quarters of a turn: u is 0 to 2 over angles from 0.4 to 0.4 + pi; of these the middle part is left.
      const double u0 = 0.4, u1 = 0.4 + kPi;
      const int surface = file.cylinder(pose, 12, -30, 40, u0, u1, "00010000");
      const auto angleAt = [&](double u) {
        // A quarter as a rational parabola: its middle is exact, its ends are, too.
        return u0 + u * kPi / 2;
      };
      const auto plain = [](double u, double v) { return fmt::format("{},{},0.", igesNumber(u), igesNumber(v)); };
      const auto side = [&](double a, double b, double c, double d) {
        return file.add(110, plain(a, b) + "," + plain(c, d), 0, 0, "00010500");
      };
      // Borders at u 0.5 and 1.5, where the angle is that of the middle; v 0.25 and 0.75.
      const int inUv = file.add(102,
                                fmt::format("4,{},{},{},{}", side(0.5, 0.25, 1.5, 0.25), side(1.5, 0.25, 1.5, 0.75),
                                            side(1.5, 0.75, 0.5, 0.75), side(0.5, 0.75, 0.5, 0.25)),
                                0, 0, "00010500");
      const double a0 = angleAt(0.5), a1 = angleAt(1.5), z0 = -12.5, z1 = 22.5;
      const auto at = [&](double angle, double z) {
        return Vector3(pose * Vector3(12 * std::cos(angle), 12 * std::sin(angle), z));
      };
      const Pose turned = pose * rotation(Vector3::UnitX(), 180);
      const int low = file.arc(pose * translation(Vector3(0, 0, z0)), 12, a0, a1);
      const int right = file.line(at(a1, z0), at(a1, z1));
      const int top = file.arc(turned * translation(Vector3(0, 0, -z1)), 12, -a1, -a0);
      const int left = file.line(at(a0, z1), at(a0, z0));
      const int inSpace = file.add(102, fmt::format("4,{},{},{},{}", low, right, top, left), 0, 0, "00010000");
      if (bounded) {
        const int border = file.add(141,
                                    fmt::format("{0},{1},{2},1,{3},1,{4}", bySpace ? 0 : 1, bySpace ? 1 : 2, surface,
                                                inSpace, bySpace ? "0" : fmt::format("1,{}", inUv)),
                                    0, 0, "00010000");
        file.add(143, fmt::format("{},{},1,{}", bySpace ? 0 : 1, surface, border));
      } else {
        const int border =
            file.add(142, fmt::format("1,{},{},{},{}", surface, inUv, inSpace, bySpace ? 2 : 1), 0, 0, "00010000");
        file.add(144, fmt::format("{},1,0,{}", surface, border));
      }
      expectRead(fmt::format("{} {}", bounded ? "143" : "144", bySpace ? "space" : "parameters"), file,
                 distanceOfShell(12, z0, z1, a0, a1, pose), 40, at((a0 + a1) / 2, 5), random, 40);
    }
  }
  // The border of the surface itself.
  const Pose pose = randomPose(random, 40);
  IgesFile file;
  file.add(144, fmt::format("{},0,0,0", file.cylinder(pose, 12, -5, 20, 7, 12, "00010000")));
  expectRead("144 without borders", file, distanceOfShell(12, -5, 20, 7, 12, pose), 40, pose * Vector3(0, 0, 7), random,
             40);
}

TEST(WrittenIges, MovedMirroredAndInstancedSurfacesAreMetWhereTheyAre) {
  std::mt19937_64 random(305);
  const Pose own = randomPose(random, 20), move = randomPose(random, 60);
  const auto through = [&](const Eigen::Affine3d& place, double scale, const Pose& pose) {
    const Eigen::Affine3d back = place.inverse();
    const Distance plain = distanceOfShell(12, -5, 20, 0.3, 3, pose);
    return Distance([=](const Vector3& p) { return scale * plain(back * p); });
  };
  {
    IgesFile file({1, 1});
    file.cylinder(own, 12, -5, 20, 0.3, 3, "00000000", file.matrix(move.linear(), move.translation()));
    expectRead("moved", file, distanceOfShell(12, -5, 20, 0.3, 3, move * own), 40, move * own * Vector3(0, 0, 7),
               random, 40);
  }
  {
    IgesFile file({2, 1});
    Matrix3 mirrored = move.linear();
    mirrored.col(2) *= -1;
    file.cylinder(own, 12, -5, 20, 0.3, 3, "00000000", file.matrix(mirrored, move.translation(), 1));
    Eigen::Affine3d place = Eigen::Affine3d::Identity();
    place.linear() = mirrored;
    place.translation() = move.translation();
    expectRead("mirrored", file, through(place, 1, own), 40, place * (own * Vector3(0, 0, 7)), random, 40);
  }
}

TEST(WrittenIges, InstancesAtAnotherSizeAreRefused) {
  std::mt19937_64 random(306);
  const auto instanced = [](double scale) {
    IgesFile file({2, 1});
    const int patch = file.cylinder(Pose::Identity(), 12, -5, 20, 0.3, 3, "00010000");
    const int part = file.add(308, fmt::format("0,4HPART,1,{}", patch), 0, 0, "00010200");
    file.add(408, fmt::format("{},{},{}", part, file.point({30, -10, 5}), igesNumber(scale)));
    return file;
  };
  const Pose moved = translation({30, -10, 5});
  expectRead("instance", instanced(1), distanceOfShell(12, -5, 20, 0.3, 3, moved), 40, moved * Vector3(0, 0, 7), random,
             40);
  const ScratchFolder folder;
  const auto solid = readIges(folder.write("part.igs", instanced(1.5).text()));
  ASSERT_FALSE(solid);
  EXPECT_THAT(format(solid.error()), ::testing::HasSubstr("it mirrors or scales a part, which cannot be read"));
}

}  // namespace
}  // namespace probewright::simulation
