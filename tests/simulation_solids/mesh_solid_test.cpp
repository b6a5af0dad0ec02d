#include "simulation/mesh_solid.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <fstream>

#include "support/bumpy_body.hpp"
#include "worlds.hpp"

namespace probewright::simulation {
namespace {

using ::testing::HasSubstr;
using testing::randomDirection;
using testing::randomPoint;
using testing::ScratchFolder;
using testing::uniform;
using testing::walkToContact;

/// The distance of a point from a triangle by trying each of its seven parts: corners, edges, inside.
double distanceToTriangle(const Vector3& p, const Triangle& t) {
  double best = 1e300;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3& a = t[i];
    const Vector3 edge = t[(i + 1) % 3] - a;
    best = std::min(best, (p - a).norm());
    const double s = (p - a).dot(edge) / edge.dot(edge);
    if (s > 0 && s < 1) best = std::min(best, (p - a - s * edge).norm());
  }
  Eigen::Matrix<double, 3, 2> basis;
  basis << t[1] - t[0], t[2] - t[0];
  const Vector2 uv = (basis.transpose() * basis).inverse() * basis.transpose() * (p - t[0]);
  if (uv.x() >= 0 && uv.y() >= 0 && uv.x() + uv.y() <= 1) best = std::min(best, (p - t[0] - basis * uv).norm());
  return best;
}

double distanceToMesh(const Vector3& p, const TriangleMesh& mesh) {
  double best = 1e300;
  for (const auto& t : mesh.triangles) {
    best = std::min(best, distanceToTriangle(p, {mesh.corners[t[0]], mesh.corners[t[1]], mesh.corners[t[2]]}));
  }
  return best;
}

TriangleMesh cube(double low, double high) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.corners.emplace_back((i & 1) ? high : low, (i & 2) ? high : low, (i & 4) ? high : low);
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

TEST(MeshSolid, MeetsABallWhereBruteForceMeetsIt) {
  std::mt19937_64 random(1);
  const TriangleMesh mesh = bumpyBody(12, 20, {0.2, 5, 4});
  const MeshSolid solid(mesh);
  ASSERT_TRUE(solid.isClosed());
  int contacts = 0;
  int misses = 0;
  for (int i = 0; i < 600; ++i) {
    const Vector3 from = 45 * randomDirection(random);
    const Vector3 to = from + uniform(random, 5, 90) * (randomPoint(random, 22) - from).normalized();
    const double radius = uniform(random, 0.3, 6);
    const auto expected = walkToContact([&](const Vector3& p) { return distanceToMesh(p, mesh); }, from, to, radius);
    if (expected && std::isnan(*expected)) continue;
    const auto contact = solid.firstContact(from, to, radius);
    ASSERT_EQ(contact.has_value(), expected.has_value()) << i;
    if (!contact) {
      ++misses;
      continue;
    }
    ++contacts;
    EXPECT_NEAR((contact->ballCentre - from).norm(), *expected, 1e-7) << i;
    EXPECT_NEAR(distanceToMesh(contact->ballCentre, mesh), radius, 1e-10) << i;
    EXPECT_NEAR(distanceToMesh(contact->touchPoint, mesh), 0, 1e-10) << i;
    EXPECT_LT((contact->touchPoint + radius * contact->normal - contact->ballCentre).norm(), 1e-9) << i;
    EXPECT_LT((from + contact->fraction * (to - from) - contact->ballCentre).norm(), 1e-9) << i;
  }
  EXPECT_GT(contacts, 200);
  EXPECT_GT(misses, 50);
}

TEST(MeshSolid, IsMetByBallsFarFromTheOrigin) {
  std::mt19937_64 random(2);
  TriangleMesh mesh = bumpyBody(8, 10, {0.1, 5, 4});
  const Vector3 offset(700, -400, 900);
  for (Vector3& corner : mesh.corners)
    corner += offset;
  const MeshSolid solid(mesh);
  for (int i = 0; i < 100; ++i) {
    const Vector3 from = offset + 800 * randomDirection(random);
    const Vector3 to = offset + randomPoint(random, 3);
    const auto expected = walkToContact([&](const Vector3& p) { return distanceToMesh(p, mesh); }, from, to, 1.5);
    const auto contact = solid.firstContact(from, to, 1.5);
    ASSERT_TRUE(contact && expected);
    EXPECT_NEAR((contact->ballCentre - from).norm(), *expected, 1e-7);
  }
}

TEST(MeshSolid, MeetsEdgesAndCornersOfACubeInClosedForm) {
  const MeshSolid solid(cube(0, 10));
  const double r = 2;
  // Down beside the edge x = 0 at z = 10, one mm outside the face.
  const auto edge = solid.firstContact({-1, 5, 30}, {-1, 5, 0}, r);
  ASSERT_TRUE(edge);
  EXPECT_NEAR(edge->ballCentre.z(), 10 + std::sqrt(3.0), 1e-12);
  EXPECT_LT((edge->touchPoint - Vector3(0, 5, 10)).norm(), 1e-12);
  // The corner at the origin along its space diagonal.
  const Vector3 diagonal = Vector3(1, 1, 1).normalized();
  const auto corner = solid.firstContact(-20 * diagonal, Vector3::Zero(), r);
  ASSERT_TRUE(corner);
  EXPECT_LT((corner->ballCentre + r * diagonal).norm(), 1e-12);
  EXPECT_LT(corner->touchPoint.norm(), 1e-12);
  EXPECT_LT((corner->normal + diagonal).norm(), 1e-12);
}

TEST(MeshSolid, OverlapAtTheStartIsAContactButTouchingIsNot) {
  const MeshSolid solid(cube(0, 10));
  const auto overlapping = solid.firstContact({5, 5, 11.5}, {5, 5, 20}, 2);
  ASSERT_TRUE(overlapping);
  EXPECT_EQ(overlapping->fraction, 0);
  EXPECT_LT((overlapping->touchPoint - Vector3(5, 5, 10)).norm(), 1e-12);
  EXPECT_FALSE(solid.firstContact({5, 5, 12}, {5, 5, 20}, 2)) << "leaving";
  EXPECT_FALSE(solid.firstContact({2, 5, 12}, {8, 6, 12}, 2)) << "sliding";
  EXPECT_FALSE(solid.firstContact({-30, 5, 12}, {30, 6, 12}, 2)) << "sliding across the edges";
  EXPECT_TRUE(solid.firstContact({5, 5, 12 - 2e-9}, {5, 5, 20}, 2)) << "deeper than the tolerance";
  const auto pressing = solid.firstContact({5, 5, 12}, {5, 5, 9}, 2);
  ASSERT_TRUE(pressing);
  EXPECT_NEAR(pressing->fraction, 0, 1e-12);
  EXPECT_FALSE(solid.firstContact({5, 5, 13}, {5, 5, 13}, 2)) << "standing still";
}

TEST(MeshSolid, ABallWithinTheMaterialTouchesAtOnce) {
  const MeshSolid solid(cube(0, 10));
  for (const Vector3& to : {Vector3(5, 5, 30), Vector3(5, 5.5, 5), Vector3(5, 5, 7)}) {
    const auto contact = solid.firstContact({5, 5, 5}, to, 1);
    ASSERT_TRUE(contact);
    EXPECT_EQ(contact->fraction, 0);
  }
  TriangleMesh open = cube(0, 10);
  open.triangles.pop_back();
  const MeshSolid skin(open);
  EXPECT_FALSE(skin.isClosed());
  EXPECT_FALSE(skin.firstContact({5, 5, 5}, {5, 5.5, 5}, 1)) << "a skin has no inside";
  EXPECT_TRUE(skin.firstContact({5, 5, 5}, {5, 5, 30}, 1)) << "a skin is felt from behind";
}

TEST(MeshSolid, TurnsAMeshThatIsInsideOut) {
  TriangleMesh mesh = cube(0, 10);
  for (auto& t : mesh.triangles)
    std::swap(t[0], t[1]);
  const MeshSolid solid(mesh);
  EXPECT_TRUE(solid.firstContact({5, 5, 5}, {5, 5.5, 5}, 1));
  const auto contact = solid.firstContact({5, 5, 30}, {5, 5, 0}, 1);
  ASSERT_TRUE(contact);
  EXPECT_NEAR(contact->ballCentre.z(), 11, 1e-12);
}

double distanceOfSegment(const Vector3& p, const Vector3& axis, const TriangleMesh& mesh) {
  // The distance along the segment is convex for each triangle: golden section finds it.
  double best = 1e300;
  for (const auto& t : mesh.triangles) {
    const Triangle triangle{mesh.corners[t[0]], mesh.corners[t[1]], mesh.corners[t[2]]};
    double low = 0;
    double high = 1;
    const auto value = [&](double s) { return distanceToTriangle(p + s * axis, triangle); };
    for (int i = 0; i < 40; ++i) {
      const double a = high - (high - low) / std::numbers::phi;
      const double b = low + (high - low) / std::numbers::phi;
      (value(a) < value(b) ? high : low) = value(a) < value(b) ? b : a;
    }
    best = std::min(best, value((low + high) / 2));
  }
  return best;
}

TEST(MeshSolid, MeetsACapsuleWhereBruteForceMeetsIt) {
  std::mt19937_64 random(3);
  const TriangleMesh mesh = bumpyBody(4, 20, {0.2, 5, 4});
  const MeshSolid solid(mesh);
  int contacts = 0;
  for (int i = 0; i < 180; ++i) {
    const Vector3 from = 90 * randomDirection(random);
    const double size = uniform(random, 5, 60);
    Vector3 axis = size * randomDirection(random);
    const Vector3 to = from + uniform(random, 20, 90) * (randomPoint(random, 25) - axis / 2 - from).normalized();
    // A stylus behind its ball, and the same drawn back.
    if (i % 3 == 0) axis = (i % 2 == 0 ? size : -size) * (to - from).normalized();
    const double radius = uniform(random, 0.5, 4);
    const auto expected =
        walkToContact([&](const Vector3& p) { return distanceOfSegment(p, axis, mesh); }, from, to, radius);
    if (expected && std::isnan(*expected)) continue;
    const auto contact = solid.firstCapsuleContact(from, to, axis, radius);
    ASSERT_EQ(contact.has_value(), expected.has_value()) << i;
    if (!contact) continue;
    ++contacts;
    EXPECT_NEAR((contact->ballCentre - from).norm(), *expected, 1e-5) << i;
    EXPECT_NEAR(distanceToMesh(contact->touchPoint, mesh), 0, 1e-9) << i;
    EXPECT_NEAR(
        (contact->touchPoint - closestOnSegment(contact->touchPoint, contact->ballCentre, contact->ballCentre + axis))
            .norm(),
        radius, 1e-5)
        << i;
  }
  EXPECT_GT(contacts, 25);
}

/// A binary file as programs write it: 80 bytes, the count of triangles, 50 bytes a triangle.
void writeStl(const TriangleMesh& mesh, const std::filesystem::path& path) {
  constexpr std::size_t headerSize = 84, facetSize = 50;
  std::string bytes(headerSize + facetSize * mesh.triangles.size(), '\0');
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  std::memcpy(bytes.data() + 80, &count, sizeof count);
  char* facet = bytes.data() + headerSize;
  for (const auto& corners : mesh.triangles) {
    const Vector3& a = mesh.corners[corners[0]];
    const Vector3& b = mesh.corners[corners[1]];
    const Vector3& c = mesh.corners[corners[2]];
    const Vector3 normal = (b - a).cross(c - a).normalized();
    std::array<float, 12> values;
    std::size_t at = 0;
    for (const Vector3* v : {&normal, &a, &b, &c}) {
      for (Eigen::Index k = 0; k < 3; ++k)
        values[at++] = static_cast<float>((*v)[k]);
    }
    std::memcpy(facet, values.data(), sizeof values);
    facet += facetSize;
  }
  std::ofstream(path, std::ios::binary) << bytes;
}

TEST(Stl, BinaryAndAsciiReadTheSame) {
  const ScratchFolder folder;
  const TriangleMesh mesh = cube(0, 10);
  writeStl(mesh, folder / "binary.stl");
  std::string text = "solid a cube of ours\n";
  for (const auto& t : mesh.triangles) {
    text += " facet normal 0 0 0\n  outer loop\n";
    for (const auto c : t) {
      text += "   vertex " + std::to_string(mesh.corners[c].x()) + " +" + std::to_string(mesh.corners[c].y()) + "\t" +
              std::to_string(mesh.corners[c].z()) + "\r\n";
    }
    text += "  ENDLOOP\n endfacet\n";
  }
  text += "endsolid a cube of ours\n";
  for (const auto& path : {folder / "binary.stl", folder.write("ascii.stl", text)}) {
    ImportWatch watch(path, ImportOptions());
    const auto read = readStlMesh(path, watch);
    ASSERT_TRUE(read) << format(read.error());
    EXPECT_EQ(read->corners.size(), 8U);
    EXPECT_EQ(read->triangles.size(), 12U);
    const auto solid = readStl(path);
    ASSERT_TRUE(solid);
    EXPECT_NEAR((*solid)->firstContact({5, 5, 30}, {5, 5, 0}, 1)->ballCentre.z(), 11, 1e-12);
  }
}

/// Every long step of an import looks at whether to go on; binary and text.
TEST(Stl, EndsWhereItIsAskedToStop) {
  const ScratchFolder folder;
  writeStl(cube(0, 10), folder / "binary.stl");
  const std::string text =
      "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
      "endloop\nendfacet\nendsolid x\n";
  std::stop_source stop;
  ImportOptions options;
  options.stop = stop.get_token();
  const std::array files{folder / "binary.stl", folder.write("text.stl", text)};
  for (const auto& file : files)
    EXPECT_TRUE(readStl(file, options));
  stop.request_stop();
  for (const auto& file : files) {
    const auto solid = readStl(file, options);
    ASSERT_FALSE(solid);
    EXPECT_THAT(format(solid.error()), ::testing::AllOf(HasSubstr(file.string()), HasSubstr("interrupted")));
  }
  ImportWatch watch("part.stl", options);
  EXPECT_THROW(MeshSolid(cube(0, 10), watch), ImportStopped);
  std::vector<SearchElement> elements;
  for (int i = 0; i < 5000; ++i)
    elements.push_back({{Vector3(i, 0, 0), Vector3(i, 1, 0), Vector3(i, 0, 1)}});
  EXPECT_THROW(SearchTree(elements, Elements::Triangles, bestInstructions(), &watch), ImportStopped);
}

TEST(Stl, TellsHowFarItHasCome) {
  const ScratchFolder folder;
  writeStl(cube(0, 10), folder / "binary.stl");
  std::vector<std::string> told;
  ImportOptions options;
  options.progress = [&](const std::string& what) { told.push_back(what); };
  ASSERT_TRUE(readStl(folder / "binary.stl", options));
  EXPECT_THAT(told, ::testing::IsEmpty()) << "a quick import says nothing";
  options.patience = 0;
  ASSERT_TRUE(readStl(folder / "binary.stl", options));
  EXPECT_THAT(told, ::testing::ElementsAre("binary.stl: reading the triangles", "binary.stl: looking for open edges",
                                           "binary.stl: building the search tree"));
}

TEST(Stl, SaysWhatIsWrongWithABadFile) {
  const ScratchFolder folder;
  const auto message = [&](const std::string& bytes) {
    const auto read = readStl(folder.write("bad.stl", bytes));
    return read ? std::string("read") : format(read.error());
  };
  EXPECT_THAT(message(""), HasSubstr("not an STL file"));
  EXPECT_THAT(message("0 BEGIN PGM X MM"), HasSubstr("not an STL file"));
  // One triangle by its count, and seven bytes more than that takes.
  std::string longer(84 + 50 + 7, '\0');
  longer[80] = 1;
  EXPECT_THAT(message(longer), HasSubstr("134 bytes expected, it has 141"));
  EXPECT_THAT(message("solid x\nendsolid x\n"), HasSubstr("no triangle"));
  EXPECT_THAT(message("solid x\nfacet normal 0 0 1\nouter loop\nvertex 1 2 x3\n"),
              ::testing::AllOf(HasSubstr("bad.stl:4"), HasSubstr("a coordinate in mm"), HasSubstr("x3")));
  EXPECT_THAT(message("solid x\nfacet normal 0 0 1\nouter loop\nvertex 1 2"), HasSubstr("ends where"));
  writeStl(cube(0, 10), folder / "cut.stl");
  std::filesystem::resize_file(folder / "cut.stl", 400);
  const auto cut = readStl(folder / "cut.stl");
  ASSERT_FALSE(cut);
  EXPECT_THAT(format(cut.error()), ::testing::AllOf(HasSubstr("400 bytes"), HasSubstr("684"), HasSubstr("cut short")));
  EXPECT_FALSE(readStl(folder / "missing.stl"));
}

}  // namespace
}  // namespace probewright::simulation
