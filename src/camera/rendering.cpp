#include "camera/rendering.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "simulation/analytic_solids.hpp"
#include "simulation/drawing_mesh.hpp"

namespace probewright::camera {

using simulation::DrawingMesh;
using simulation::PlacedSolid;
using simulation::SolidRole;

namespace {

using Vector3f = Eigen::Vector3f;

constexpr float background = 0.03F;  // what nothing sends back
constexpr float lift = 0.02F;        // mm, of shadow rays off the surface
constexpr float shine = 24;          // of a glossy surface, exponent of Phong's reflection
constexpr int raysAcross = 2;        // in a pixel, in each direction

Finish finishOf(SolidRole role) {
  switch (role) {
    case SolidRole::Part:
      return {0.6, 0.1};
    case SolidRole::Fixture:
      return {0.35, 0.05};
    case SolidRole::Ring:
    case SolidRole::Sphere:
    case SolidRole::GaugeBlock:
    case SolidRole::ToolProbe:
      return {0.75, 0.2};
  }
  return {};
}

void addCorner(DrawingMesh& mesh, const Vector3& at, const Vector3& normal) {
  for (int i = 0; i < 3; ++i) {
    mesh.positions.push_back(static_cast<float>(at[i]));
    mesh.normals.push_back(static_cast<float>(normal[i]));
  }
}

/// A flat face with its corners in order, counter-clockwise seen from outside.
void addFace(DrawingMesh& mesh, std::span<const Vector3> corners, const Vector3& normal) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size() / 3);
  for (const Vector3& corner : corners)
    addCorner(mesh, corner, normal);
  for (std::uint32_t i = 1; i + 1 < corners.size(); ++i)
    mesh.indices.insert(mesh.indices.end(), {first, first + i, first + i + 1});
}

/// A prism over `base`, corners counter-clockwise seen from above, between two heights.
DrawingMesh prism(std::vector<Vector3> base, double bottom, double top) {
  DrawingMesh mesh;
  const auto at = [](Vector3 corner, double z) {
    corner.z() = z;
    return corner;
  };
  std::vector<Vector3> lower, upper;
  for (const Vector3& corner : base) {
    lower.insert(lower.begin(), at(corner, bottom));
    upper.push_back(at(corner, top));
  }
  addFace(mesh, upper, Vector3::UnitZ());
  addFace(mesh, lower, -Vector3::UnitZ());
  for (std::size_t i = 0; i < base.size(); ++i) {
    const Vector3 &a = base[i], &b = base[(i + 1) % base.size()];
    const std::array side = {at(a, bottom), at(b, bottom), at(b, top), at(a, top)};
    addFace(mesh, side, (b - a).cross(Vector3::UnitZ()).normalized());
  }
  return mesh;
}

/// What is drawn in reports, and the bodies in closed form that machines have for tables.
DrawingMesh meshOf(const simulation::Solid& solid) {
  const simulation::Bounds box = solid.bounds();
  const Vector3 &low = box.minimum, &high = box.maximum;
  if (dynamic_cast<const simulation::Box*>(&solid) != nullptr) {
    return prism({{low.x(), low.y(), 0}, {high.x(), low.y(), 0}, {high.x(), high.y(), 0}, {low.x(), high.y(), 0}},
                 low.z(), high.z());
  }
  if (dynamic_cast<const simulation::RoundBar*>(&solid) != nullptr) {
    constexpr int sides = 72;
    std::vector<Vector3> rim;
    for (int i = 0; i < sides; ++i) {
      const double angle = radiansFromDegrees(360.0 / sides * i);
      rim.emplace_back(high.x() * std::cos(angle), high.x() * std::sin(angle), 0);
    }
    return prism(std::move(rim), low.z(), high.z());
  }
  return simulation::drawingMesh(solid);
}

struct Hit {
  Vector3f point, normal;
  float distance = 0;  ///< in lengths of the direction
  const Finish* finish = nullptr;
};

}  // namespace

struct Scenery::Shapes {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::vector<Finish> finishes;  ///< by the number of the geometry

  Shapes() {
    device = rtcNewDevice("threads=1");
    if (device == nullptr) throw std::runtime_error("Embree could not be started");
    scene = rtcNewScene(device);
  }
  ~Shapes() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  Shapes(const Shapes&) = delete;
  Shapes& operator=(const Shapes&) = delete;

  void add(const DrawingMesh& mesh, const Pose& tableFromSolid, const Finish& finish) {
    const std::size_t corners = mesh.positions.size() / 3, triangles = mesh.indices.size() / 3;
    if (triangles == 0) return;
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryVertexAttributeCount(geometry, 1);
    constexpr std::size_t size = 3 * sizeof(float);
    auto* places = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, size, corners));
    auto* normals = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX_ATTRIBUTE, 0, RTC_FORMAT_FLOAT3, size, corners));
    auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), triangles));
    if (places == nullptr || normals == nullptr || indices == nullptr) {
      rtcReleaseGeometry(geometry);
      throw std::runtime_error("Embree has no memory for a solid");
    }
    const Eigen::Isometry3f pose = tableFromSolid.cast<float>();
    for (std::size_t i = 0; i < corners; ++i) {
      Eigen::Map<Vector3f>(places + 3 * i) = pose * Vector3f(Eigen::Map<const Vector3f>(&mesh.positions[3 * i]));
      Eigen::Map<Vector3f>(normals + 3 * i) =
          pose.linear() * Vector3f(Eigen::Map<const Vector3f>(&mesh.normals[3 * i]));
    }
    std::ranges::copy(mesh.indices, indices);
    rtcCommitGeometry(geometry);
    const unsigned number = rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    if (finishes.size() <= number) finishes.resize(number + 1);
    finishes[number] = finish;
  }

  std::optional<Hit> nearest(const Vector3f& from, const Vector3f& direction) const {
    RTCRayHit ray{};
    ray.ray = {from.x(),
               from.y(),
               from.z(),
               0,
               direction.x(),
               direction.y(),
               direction.z(),
               0,
               std::numeric_limits<float>::infinity(),
               ~0U,
               0,
               0};
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    Hit hit;
    hit.point = from + ray.ray.tfar * direction;
    hit.distance = ray.ray.tfar;
    hit.finish = &finishes[ray.hit.geomID];
    std::array<float, 3> normal{};
    rtcInterpolate0(rtcGetGeometry(scene, ray.hit.geomID), ray.hit.primID, ray.hit.u, ray.hit.v,
                    RTC_BUFFER_TYPE_VERTEX_ATTRIBUTE, 0, normal.data(), 3);
    hit.normal = Vector3f(normal.data()).normalized();
    if (hit.normal.dot(direction) > 0) hit.normal = -hit.normal;
    return hit;
  }

  bool free(const Vector3f& from, const Vector3f& to) const {
    const Vector3f way = to - from;
    RTCRay ray{from.x(), from.y(), from.z(), 0, way.x(), way.y(), way.z(), 0, 1, ~0U, 0, 0};
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, &ray);
    return ray.tfar >= 0;
  }
};

struct Scenery::Meshes {
  std::map<const simulation::Solid*, DrawingMesh> bySolid;
};

Scenery::Scenery(std::span<const PlacedSolid> solids, const TrueCamera& camera)
    : shapes_(std::make_unique<Shapes>()), camera_(camera) {
  for (const PlacedSolid& placed : solids) {
    const auto known = camera.finishes.find(placed.name);
    shapes_->add(meshOf(*placed.solid), placed.tableFromSolid,
                 known == camera.finishes.end() ? finishOf(placed.role) : known->second);
  }
  rtcCommitScene(shapes_->scene);
}

Scenery::~Scenery() = default;

void Scenery::put(std::span<const PlacedSolid> moving) {
  if (!meshes_) meshes_ = std::make_unique<Meshes>();
  auto shapes = std::make_unique<Shapes>();
  for (const PlacedSolid& placed : moving) {
    auto mesh = meshes_->bySolid.find(placed.solid.get());
    if (mesh == meshes_->bySolid.end())
      mesh = meshes_->bySolid.emplace(placed.solid.get(), meshOf(*placed.solid)).first;
    const auto known = camera_.finishes.find(placed.name);
    shapes->add(mesh->second, placed.tableFromSolid,
                known == camera_.finishes.end() ? finishOf(placed.role) : known->second);
  }
  rtcCommitScene(shapes->scene);
  moving_ = std::move(shapes);
}

Layers Scenery::render(const Pose& tableFromCamera, std::span<const Vector3> lamps) const {
  const auto width = static_cast<std::size_t>(camera_.width), height = static_cast<std::size_t>(camera_.height);
  Layers layers(1 + lamps.size(), std::vector<float>(width * height));
  const Vector3f eye = tableFromCamera.translation().cast<float>();
  constexpr float share = 1.0F / (raysAcross * raysAcross);
  const auto nearest = [&](const Vector3f& direction) {
    auto hit = shapes_->nearest(eye, direction);
    if (!moving_) return hit;
    auto other = moving_->nearest(eye, direction);
    return other && (!hit || other->distance < hit->distance) ? other : hit;
  };
  const auto free = [&](const Vector3f& from, const Vector3f& to) {
    return shapes_->free(from, to) && (!moving_ || moving_->free(from, to));
  };
  const auto see = [&](std::size_t pixel, const Vector3f& direction) {
    const auto hit = nearest(direction);
    if (!hit) {
      layers[0][pixel] += share * background;
      return;
    }
    const Finish& finish = *hit->finish;
    const auto reflectance = static_cast<float>(finish.reflectance), gloss = static_cast<float>(finish.gloss);
    layers[0][pixel] += share * reflectance * static_cast<float>(camera_.ambient);
    const Vector3f from = hit->point + lift * hit->normal;
    const Vector3f mirrored = direction - 2 * direction.dot(hit->normal) * hit->normal;
    for (std::size_t i = 0; i < lamps.size(); ++i) {
      const Vector3f lamp = lamps[i].cast<float>();
      const Vector3f towards = (lamp - hit->point).normalized();
      const float facing = towards.dot(hit->normal);
      if (facing <= 0 || !free(from, lamp)) continue;
      const float mirror = std::pow(std::max(mirrored.dot(towards), 0.0F), shine);
      layers[i + 1][pixel] +=
          share * static_cast<float>(camera_.lamps[i].brightness) * (reflectance * facing + gloss * mirror);
    }
  };
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      for (int part = 0; part < raysAcross * raysAcross; ++part) {
        const int column = part % raysAcross, row = part / raysAcross;
        const double across = (0.5 + column) / raysAcross, down = (0.5 + row) / raysAcross;
        const Vector3 ray = rayThrough(camera_, static_cast<double>(x) + across, static_cast<double>(y) + down);
        see(y * width + x, (tableFromCamera.linear() * ray.normalized()).cast<float>());
      }
    }
  }
  return layers;
}

}  // namespace probewright::camera
