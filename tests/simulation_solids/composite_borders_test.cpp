#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "meant.hpp"
#include "oracle.hpp"
#include "simulation/cad_solid.hpp"
#include "written_iges.hpp"

/// Faces of IGES files whose borders are composite curves (entity 102) of many kinds of pieces, in space and in the
/// parameters of the surface, cut at different places in both.
namespace probewright::simulation {
namespace {

using namespace testing;

constexpr double kPi = std::numbers::pi;
const std::string kInSpace = "00010000", kInPlane = "00010500";

/// Reads the file, which must give no reason for doubt, and sends balls at it.
void expectRead(const std::string& name, const IgesFile& file, const Distance& distance, double size,
                const Vector3& middle, std::mt19937_64& random, int ways) {
  const ScratchFolder folder;
  const auto solid = readIges(folder.write("part.igs", file.text()));
  ASSERT_TRUE(solid) << name << ": " << format(solid.error());
  for (const Diagnostic& remark : dynamic_cast<const CadSolid&>(**solid).remarks())
    EXPECT_NE(remark.message.find("no solid body"), std::string::npos) << name << ": " << format(remark);
  expectAsMeant(name, **solid, distance, size, middle, random, ways);
}

std::string listed(const std::vector<int>& entities) {
  std::string text;
  for (const int entity : entities)
    text += fmt::format(",{}", entity);
  return text;
}

int composite(IgesFile& file, const std::vector<int>& pieces, const std::string& use) {
  return file.add(102, fmt::format("{}{}", pieces.size(), listed(pieces)), 0, 0, use);
}

/// A face of a surface within borders, the outer one first, each in parameters and in space.
enum class Entity { Trimmed, Bounded };
struct Border {
  std::vector<int> inParameters, inSpace;
};
void face(IgesFile& file, Entity entity, int surface, const std::vector<Border>& borders, int preferred) {
  std::vector<int> all;
  const int type = borders.front().inParameters.empty() ? 0 : 1;
  for (const Border& border : borders) {
    const int space = composite(file, border.inSpace, kInSpace);
    if (entity == Entity::Trimmed) {
      const int parameters = type == 0 ? 0 : composite(file, border.inParameters, kInPlane);
      all.push_back(file.add(142, fmt::format("1,{},{},{},{}", surface, parameters, space, preferred), 0, 0, kInSpace));
      continue;
    }
    // One curve in space, and those on the surface that belong to it, if it has parameters of its own.
    all.push_back(file.add(141,
                           fmt::format("{},{},{},1,{},1,{}{}", type, preferred, surface, space,
                                       border.inParameters.size(), listed(border.inParameters)),
                           0, 0, kInSpace));
  }
  if (entity == Entity::Bounded) {
    file.add(143, fmt::format("{},{},{}{}", type, surface, all.size(), listed(all)));
    return;
  }
  const std::vector<int> inner(all.begin() + 1, all.end());
  file.add(144, fmt::format("{},1,{},{}{}", surface, inner.size(), all.front(), listed(inner)));
}

/// An arc in the plane z of a pose as entity 100; its way anticlockwise.
int plainArc(IgesFile& file, const Pose& pose, const Vector2& centre, double radius, double from, double to) {
  const auto at = [&](double angle) {
    return fmt::format("{},{}", file.length(centre.x() + radius * std::cos(angle)),
                       file.length(centre.y() + radius * std::sin(angle)));
  };
  const int place = file.matrix(pose.linear(), pose.translation());
  return file.add(
      100,
      fmt::format("{},{},{},{},{}", file.length(0), file.length(centre.x()), file.length(centre.y()), at(from), at(to)),
      0, place, kInSpace);
}

/// The same as a conic, entity 104, about the origin of its own frame.
int conicArc(IgesFile& file, const Pose& pose, const Vector2& centre, double radius, double from, double to) {
  const Pose own = pose * translation(Vector3(centre.x(), centre.y(), 0));
  const int place = file.matrix(own.linear(), own.translation());
  // x^2 + y^2 = r^2 in the file's unit.
  const double r = std::stod(file.length(radius));
  const auto at = [&](double angle) {
    return fmt::format("{},{}", file.length(radius * std::cos(angle)), file.length(radius * std::sin(angle)));
  };
  return file.add(104, fmt::format("1.,0.,1.,0.,0.,{},0.,{},{}", igesNumber(-r * r), at(from), at(to)), 1, place,
                  kInSpace);
}

/// A straight line as entity 110, as a polyline (106 form 12), as a parametric spline (112) or as a B-spline (126).
int straight(IgesFile& file, const Vector3& from, const Vector3& to, std::size_t how) {
  switch (how % 4) {
    case 0:
      return file.line(from, to);
    case 1:
      return file.add(106,
                      fmt::format("2,3,{},{},{}", file.point(from), file.point((2 * from + to) / 3), file.point(to)),
                      12, 0, kInSpace);
    case 2: {
      std::string rows, end;
      for (Eigen::Index i = 0; i < 3; ++i) {
        rows += fmt::format(",{},{},0.,0.", file.length(from[i]), file.length((to - from)[i]));
        end += fmt::format(",{},{},0.,0.", file.length(to[i]), file.length((to - from)[i]));
      }
      return file.add(112, fmt::format("3,1,3,1,0.,1.{}{}", rows, end), 0, 0, kInSpace);
    }
    default:
      return file.add(
          126, fmt::format("1,1,0,0,1,0,2.,2.,5.,5.,1.,1.,{},{},2.,5.,0.,0.,0.", file.point(from), file.point(to)), 0,
          0, kInSpace);
  }
}

/// A window in a cylinder: angles from b0 to b1, heights from c0 to c1.
struct Window {
  double b0, b1, c0, c1;
};

/// A cylinder of radius 12 about Z, from -30 to 40 and over angles, as one of the surfaces that have one.
struct Patch {
  int surface = 0;
  std::function<Vector2(double angle, double z)> uv;
};
constexpr double kRadius = 12, kLow = -30, kHigh = 40;

Patch patch(IgesFile& file, const Pose& pose, int type, double a0, double a1) {
  const auto along = [](double z) { return (z - kLow) / (kHigh - kLow); };
  const Pose below = pose * translation(Vector3(0, 0, kLow)), above = pose * translation(Vector3(0, 0, kHigh));
  switch (type) {
    case 118: {
      const int low = file.arc(below, kRadius, a0, a1), high = file.arc(above, kRadius, a0, a1);
      return {file.add(118, fmt::format("{},{},0,0", low, high), 1, 0, kInSpace), [=](double angle, double z) {
                return Vector2(arcParameter(a0, a1, angle) / arcSpans(a0, a1), along(z));
              }};
    }
    case 120: {
      const int axis = file.line(below.translation(), above.translation());
      const int side = file.line(below * Vector3(kRadius, 0, 0), above * Vector3(kRadius, 0, 0));
      return {file.add(120, fmt::format("{},{},{},{}", axis, side, igesNumber(a0), igesNumber(a1)), 0, 0, kInSpace),
              [=](double angle, double z) { return Vector2(along(z), angle); }};
    }
    case 122: {
      const int low = file.arc(below, kRadius, a0, a1);
      const Vector3 end = above * Vector3(kRadius * std::cos(a0), kRadius * std::sin(a0), 0);
      return {file.add(122, fmt::format("{},{}", low, file.point(end)), 0, 0, kInSpace), [=](double angle, double z) {
                return Vector2(arcParameter(a0, a1, angle) / arcSpans(a0, a1), along(z));
              }};
    }
    default:
      return {file.cylinder(pose, kRadius, kLow, kHigh, a0, a1, kInSpace),
              [=](double angle, double z) { return Vector2(arcParameter(a0, a1, angle), along(z)); }};
  }
}

/// The way around a window, from corner to corner: each side in some pieces, beginning at any of them, either way.
struct Round {
  int pieces = 1;
  std::size_t first = 0;
  bool clockwise = false;
};
std::vector<std::pair<Vector2, Vector2>> around(const Window& w, const Round& round) {
  std::array<Vector2, 4> corners{Vector2(w.b0, w.c0), Vector2(w.b1, w.c0), Vector2(w.b1, w.c1), Vector2(w.b0, w.c1)};
  if (round.clockwise) std::swap(corners[1], corners[3]);
  std::vector<std::pair<Vector2, Vector2>> ways;
  for (std::size_t side = 0; side < 4; ++side) {
    const Vector2 from = corners[side], to = corners[(side + 1) % 4];
    for (int i = 0; i < round.pieces; ++i)
      ways.emplace_back(from + (to - from) * i / round.pieces, from + (to - from) * (i + 1) / round.pieces);
  }
  std::rotate(ways.begin(), ways.begin() + static_cast<std::ptrdiff_t>(round.first % ways.size()), ways.end());
  return ways;
}

Border border(IgesFile& file, const Pose& pose, const Patch& on, const Window& window, const Round& inParameters,
              const Round& inSpace, std::size_t how) {
  Border made;
  for (const auto& [from, to] : around(window, inParameters)) {
    const Vector2 a = on.uv(from.x(), from.y()), b = on.uv(to.x(), to.y());
    made.inParameters.push_back(file.add(
        110,
        fmt::format("{},{},0.,{},{},0.", igesNumber(a.x()), igesNumber(a.y()), igesNumber(b.x()), igesNumber(b.y())), 0,
        0, kInPlane));
  }
  const Pose turned = pose * rotation(Vector3::UnitX(), 180);
  for (const auto& [from, to] : around(window, inSpace)) {
    const auto at = [&](const Vector2& p) {
      return Vector3(pose * Vector3(kRadius * std::cos(p.x()), kRadius * std::sin(p.x()), p.y()));
    };
    if (from.y() != to.y()) {
      made.inSpace.push_back(straight(file, at(from), at(to), how));
      continue;
    }
    const bool backwards = to.x() < from.x();
    const Pose plane = (backwards ? turned : pose) * translation(Vector3(0, 0, (backwards ? -1 : 1) * from.y()));
    const double a = backwards ? -from.x() : from.x(), b = backwards ? -to.x() : to.x();
    switch (how / 4 % 3) {
      case 0:
        made.inSpace.push_back(file.arc(plane, kRadius, a, b));
        break;
      case 1:
        made.inSpace.push_back(plainArc(file, plane, {0, 0}, kRadius, a, b));
        break;
      default:
        made.inSpace.push_back(conicArc(file, plane, {0, 0}, kRadius, a, b));
    }
  }
  return made;
}

TEST(CompositeBorders, CutWindowsIntoEverySurface) {
  std::mt19937_64 random(401);
  std::size_t k = 0;
  for (int world = 0; world < campaignFactor(); ++world) {
    for (const int type : {118, 120, 122, 128}) {
      for (const Entity entity : {Entity::Trimmed, Entity::Bounded}) {
        for (const int preferred : {1, 2, 3}) {
          IgesFile file({k % 2 == 0 ? 2 : 1, 1});
          const Pose pose = randomPose(random, 40);
          const double a0 = uniform(random, 0, 2), a1 = a0 + uniform(random, 2.5, 4);
          const Patch on = patch(file, pose, type, a0, a1);
          const Window window{a0 + 0.3, a1 - uniform(random, 0.2, 1), -12, 23};
          const bool clockwise = random() % 2 == 0;
          Round inParameters{1 + static_cast<int>(random() % 2), 0, clockwise}, inSpace = inParameters;
          // In parameters and in space the same pieces, or pieces of their own.
          if (entity == Entity::Trimmed) {
            inSpace.pieces = 1 + static_cast<int>(random() % 3);
            inParameters.first = random() % 2 == 0 ? 0 : static_cast<std::size_t>(inParameters.pieces);
            inSpace.first = inParameters.first > 0 ? static_cast<std::size_t>(inSpace.pieces) : 0;
          }
          const Border outer = border(file, pose, on, window, inParameters, inSpace, k);
          face(file, entity, on.surface, {outer}, preferred);
          expectRead(fmt::format("surface {} entity {} preferred {} pieces {} {} first {} {} {} how {}", type,
                                 entity == Entity::Trimmed ? 144 : 143, preferred, inParameters.pieces, inSpace.pieces,
                                 inParameters.first, inSpace.first, clockwise ? "clockwise" : "anticlockwise", k % 12),
                     file, distanceOfShell(kRadius, window.c0, window.c1, window.b0, window.b1, pose), 40,
                     pose * Vector3(kRadius * std::cos(a0 + 1), kRadius * std::sin(a0 + 1), 5), random, 25);
          ++k;
        }
      }
    }
  }
}

/// A stadium in the plane z of a pose, 30 between the centres of its ends of radius 9, with two round holes.
struct Hole {
  Vector2 centre;
  double radius;
};
const std::array<Hole, 2> kHoles{{{{-12, 1}, 4}, {{9, -2}, 5}}};
Distance distanceOfPlate(const Pose& pose) {
  const Pose back = pose.inverse();
  return [back](const Vector3& p) {
    const Vector3 q = back * p;
    double aside = std::max(0.0, std::hypot(std::max(0.0, std::abs(q.x()) - 15), q.y()) - 9);
    for (const Hole& hole : kHoles)
      aside = std::max(aside, hole.radius - (q.head<2>() - hole.centre).norm());
    return std::hypot(aside, q.z());
  };
}

constexpr double kHalf = 40;  ///< of the surface that the plate is cut out of, a square

/// A square in that plane, its parameters from 0 to 1, or an endless plane with the parameters x and y.
int square(IgesFile& file, const Pose& pose, int type) {
  const auto at = [&](double x, double y) { return Vector3(pose * Vector3(x, y, 0)); };
  const double h = kHalf;
  switch (type) {
    case 108: {
      const Vector3 n = pose.linear().col(2);
      return file.add(108,
                      fmt::format("{},{},{},{},0,{},0.", igesNumber(n.x()), igesNumber(n.y()), igesNumber(n.z()),
                                  file.length(n.dot(pose.translation())), file.point(pose.translation())),
                      0, 0, kInSpace);
    }
    case 114: {
      // One bilinear patch: C, s, t, st of x, y and z.
      std::string rows;
      for (Eigen::Index i = 0; i < 3; ++i) {
        const double c = at(-h, -h)[i], s = at(h, -h)[i] - c, t = at(-h, h)[i] - c;
        std::array<double, 16> a{};
        a[0] = c, a[1] = s, a[4] = t;
        for (const double value : a)
          rows += "," + file.length(value);
      }
      // The patches beyond the ends stand in the file, too.
      const std::string none = [] {
        std::string zeros;
        for (int i = 0; i < 48; ++i)
          zeros += ",0.";
        return zeros;
      }();
      return file.add(114, fmt::format("3,1,1,1,0.,1.,0.,1.{}{}{}{}", rows, none, none, none), 0, 0, kInSpace);
    }
    case 118: {
      const int low = file.line(at(-h, -h), at(h, -h)), high = file.line(at(-h, h), at(h, h));
      return file.add(118, fmt::format("{},{},0,0", low, high), 1, 0, kInSpace);
    }
    case 122:
      return file.add(122, fmt::format("{},{}", file.line(at(-h, -h), at(h, -h)), file.point(at(-h, h))), 0, 0,
                      kInSpace);
    case 190: {
      const auto direction = [&](const Vector3& d) {
        return file.add(123, fmt::format("{},{},{}", igesNumber(d.x()), igesNumber(d.y()), igesNumber(d.z())), 0, 0,
                        "00010200");
      };
      const int place = file.add(116, file.point(pose.translation()) + ",0", 0, 0, kInSpace);
      const int normal = direction(pose.linear().col(2)), across = direction(pose.linear().col(0));
      return file.add(190, fmt::format("{},{},{}", place, normal, across), 1, 0, kInSpace);
    }
    default:
      return file.add(
          128,
          fmt::format("1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,{},{},{},{},0.,1.,0.,1.",
                      file.point(at(-h, -h)), file.point(at(h, -h)), file.point(at(-h, h)), file.point(at(h, h))),
          0, 0, kInSpace);
  }
}

/// A border of lines and arcs in space; in the parameters the same, smaller.
Border plateBorder(IgesFile& file, const Pose& pose, std::size_t how) {
  Border made;
  const std::array<Vector2, 4> corners{Vector2(15, -9), Vector2(15, 9), Vector2(-15, 9), Vector2(-15, -9)};
  const auto at = [&](const Vector2& p) { return Vector3(pose * Vector3(p.x(), p.y(), 0)); };
  const auto uv = [](const Vector2& p) {
    return fmt::format("{},{}", igesNumber((p.x() + kHalf) / (2 * kHalf)), igesNumber((p.y() + kHalf) / (2 * kHalf)));
  };
  for (std::size_t side = 0; side < 4; ++side) {
    const Vector2 from = corners[side], to = corners[(side + 1) % 4];
    if (side % 2 == 1) {
      made.inSpace.push_back(straight(file, at(from), at(to), how));
      made.inParameters.push_back(file.add(110, fmt::format("{},0.,{},0.", uv(from), uv(to)), 0, 0, kInPlane));
      continue;
    }
    const Vector2 centre(side == 0 ? 15 : -15, 0);
    const double begin = side == 0 ? -kPi / 2 : kPi / 2;
    // An end in one piece or in two.
    const int pieces = how % 3 == 0 ? 2 : 1;
    for (int i = 0; i < pieces; ++i) {
      const double a = begin + kPi * i / pieces, b = begin + kPi * (i + 1) / pieces;
      const Pose own = pose * translation(Vector3(centre.x(), centre.y(), 0));
      made.inSpace.push_back(how % 2 == 0   ? plainArc(file, pose, centre, 9, a, b)
                             : how % 3 == 0 ? conicArc(file, pose, centre, 9, a, b)
                                            : file.arc(own, 9, a, b));
      const auto on = [&](double angle) { return Vector2(centre + 9 * Vector2(std::cos(angle), std::sin(angle))); };
      made.inParameters.push_back(
          file.add(100, fmt::format("0.,{},{},{}", uv(centre), uv(on(a)), uv(on(b))), 0, 0, kInPlane));
    }
  }
  return made;
}

Border holeBorder(IgesFile& file, const Pose& pose, const Hole& hole, std::size_t how) {
  Border made;
  const auto uv = [](const Vector2& p) {
    return fmt::format("{},{}", igesNumber((p.x() + kHalf) / (2 * kHalf)), igesNumber((p.y() + kHalf) / (2 * kHalf)));
  };
  const auto on = [&](double angle) {
    return Vector2(hole.centre + hole.radius * Vector2(std::cos(angle), std::sin(angle)));
  };
  const int pieces = static_cast<int>(how % 3) + 1;
  for (int i = 0; i < pieces; ++i) {
    const double a = 0.4 + 2 * kPi * i / pieces, b = 0.4 + 2 * kPi * (i + 1) / pieces;
    made.inSpace.push_back(plainArc(file, pose, hole.centre, hole.radius, a, b));
    made.inParameters.push_back(
        file.add(100, fmt::format("0.,{},{},{}", uv(hole.centre), uv(on(a)), uv(on(b))), 0, 0, kInPlane));
  }
  return made;
}

TEST(CompositeBorders, CutPlatesWithHolesOutOfEveryPlane) {
  std::mt19937_64 random(402);
  std::size_t k = 0;
  for (int world = 0; world < campaignFactor(); ++world) {
    for (const int type : {128, 114, 118, 122, 108, 190}) {
      for (const Entity entity : {Entity::Trimmed, Entity::Bounded}) {
        for (const int preferred : {1, 2, 3}) {
          // Planes without end have borders in space alone.
          const bool endless = type == 108 || type == 190;
          if (endless && preferred != 2) continue;
          IgesFile file({k % 2 == 0 ? 2 : 1, 1});
          const Pose pose = randomPose(random, 40);
          const int surface = square(file, pose, type);
          std::vector<Border> borders{plateBorder(file, pose, k)};
          for (const Hole& hole : kHoles)
            borders.push_back(holeBorder(file, pose, hole, random()));
          for (Border& border : borders) {
            if (endless) border.inParameters.clear();
          }
          face(file, entity, surface, borders, preferred);
          expectRead(fmt::format("plane {} entity {} preferred {} how {}", type, entity == Entity::Trimmed ? 144 : 143,
                                 preferred, k % 12),
                     file, distanceOfPlate(pose), 40, pose.translation(), random, 25);
          ++k;
        }
      }
    }
  }
}

}  // namespace
}  // namespace probewright::simulation
