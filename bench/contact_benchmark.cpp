#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>
#include <fcl/fcl.h>

#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <TopoDS_Shape.hxx>
#include <algorithm>
#include <ctime>
#include <map>
#include <random>
#include <vector>

#include "simulation/cad_solid.hpp"
#include "simulation/mesh_solid.hpp"
#include "support/bumpy_body.hpp"

/// Contacts of a ball of 2 mm on its way to a part, against the queries of other engines that come nearest to it.
namespace probewright::simulation {
namespace {

constexpr double kRadius = 2;
constexpr double kSize = 100;

/// A closed bumpy body of about 200 mm diameter with about `triangles` triangles.
const TriangleMesh& body(std::size_t triangles) {
  static std::map<std::size_t, TriangleMesh> bodies;
  auto [place, isNew] = bodies.try_emplace(triangles);
  if (isNew) {
    const auto rings = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(triangles) / 4.0));
    place->second = bumpyBody(rings, kSize, {.height = 0.03, .alongPolar = 9, .aroundAxis = 8});
  }
  return place->second;
}

struct Leg {
  Vector3 from;
  Vector3 to;
};

/// Ways of 3 to 60 mm that end in the part, within 45 degrees of its normal: what probing moves look like.
std::vector<Leg> legs(std::size_t count) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> unit(0, 1);
  const auto direction = [&] { return Vector3(normal(random), normal(random), normal(random)).normalized(); };
  std::vector<Leg> list;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3 out = direction();
    const Vector3 approach = (out + 0.7 * unit(random) * direction()).normalized();
    const Vector3 inside = 0.95 * kSize * out;
    list.push_back({inside + (20 + 55 * unit(random)) * approach, inside});
  }
  return list;
}

/// Ways enough that the processor has forgotten one before it comes again: every contact is a new one, as on a real
/// part.
constexpr std::int64_t kNewWays = 262'144;
/// So few that what they need stays in the processor's caches.
constexpr std::int64_t kKnownWays = 4096;

const std::vector<Leg>& legs(const benchmark::State& state) {
  static const std::vector<Leg> all = legs(static_cast<std::size_t>(kNewWays));
  static const std::vector<Leg> few(all.begin(), all.begin() + kKnownWays);
  return state.range(1) == kNewWays ? all : few;
}

void onBothWays(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"triangles", "ways"});
  for (const std::int64_t ways : {kNewWays, kKnownWays}) {
    for (const std::int64_t triangles : {100'000, 1'000'000})
      benchmark->Args({triangles, ways});
  }
}

void ballContact(benchmark::State& state) {
  const MeshSolid solid(body(static_cast<std::size_t>(state.range(0))));
  const std::vector<Leg>& ways = legs(state);
  std::size_t i = 0;
  std::size_t contacts = 0;
  for (auto _ : state) {
    const Leg& leg = ways[i++ % ways.size()];
    contacts += solid.firstContact(leg.from, leg.to, kRadius).has_value();
  }
  if (contacts != i) state.SkipWithError("a way met nothing");
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(ballContact)->Apply(onBothWays);

/// Ball, stylus and probe body, as a virtual machine asks for every move.
void probeContact(benchmark::State& state) {
  const MeshSolid solid(body(static_cast<std::size_t>(state.range(0))));
  const std::vector<Leg>& ways = legs(state);
  std::size_t i = 0;
  for (auto _ : state) {
    const Leg& leg = ways[i++ % ways.size()];
    const Vector3 axis = (leg.from - leg.to).normalized();
    const Vector3 lift = 50 * axis;
    benchmark::DoNotOptimize(solid.firstContact(leg.from, leg.to, kRadius));
    benchmark::DoNotOptimize(solid.firstCapsuleContact(leg.from + 3 * axis, leg.to + 3 * axis, 47 * axis, 1));
    benchmark::DoNotOptimize(solid.firstCylinderContact(leg.from + lift, leg.to + lift, 80 * axis, 20));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(probeContact)->Args({100'000, kNewWays})->Args({1'000'000, kNewWays});

/// The same probe standing along Z over the top of the part, moving down: the usual case of a three-axis machine.
void uprightProbeContact(benchmark::State& state) {
  const MeshSolid solid(body(static_cast<std::size_t>(state.range(0))));
  std::size_t i = 0;
  for (auto _ : state) {
    const double angle = 0.1 * static_cast<double>(++i);
    const Vector3 from(40 * std::cos(angle), 40 * std::sin(1.3 * angle), 110);
    const Vector3 to = from - Vector3(0, 0, 30);
    benchmark::DoNotOptimize(solid.firstContact(from, to, kRadius));
    benchmark::DoNotOptimize(
        solid.firstCapsuleContact(from + Vector3(0, 0, 3), to + Vector3(0, 0, 3), Vector3(0, 0, 47), 1));
    benchmark::DoNotOptimize(
        solid.firstCylinderContact(from + Vector3(0, 0, 50), to + Vector3(0, 0, 50), Vector3(0, 0, 80), 20));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(uprightProbeContact)->Arg(100'000)->Arg(1'000'000);

/// The same triangles as a scene of Embree's.
class RayScene {
public:
  explicit RayScene(const TriangleMesh& mesh) : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* corners = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                3 * sizeof(float), mesh.corners.size()));
    for (std::size_t i = 0; i < mesh.corners.size(); ++i) {
      Eigen::Map<Eigen::Vector3f>(corners + 3 * i) = mesh.corners[i].cast<float>();
    }
    auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                   3 * sizeof(unsigned), mesh.triangles.size()));
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k)
        indices[3 * i + k] = mesh.triangles[i][k];
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;
  ~RayScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  /// True if the ray along the leg hits anything.
  bool hits(const Leg& leg) const {
    const Vector3 way = leg.to - leg.from;
    const double length = way.norm();
    RTCRayHit ray{};
    ray.ray.org_x = static_cast<float>(leg.from.x());
    ray.ray.org_y = static_cast<float>(leg.from.y());
    ray.ray.org_z = static_cast<float>(leg.from.z());
    ray.ray.dir_x = static_cast<float>(way.x() / length);
    ray.ray.dir_y = static_cast<float>(way.y() / length);
    ray.ray.dir_z = static_cast<float>(way.z() / length);
    ray.ray.tfar = static_cast<float>(length);
    ray.ray.mask = ~0U;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene_, &context, &ray);
    return ray.hit.geomID != RTC_INVALID_GEOMETRY_ID;
  }

private:
  RTCDevice device_;
  RTCScene scene_;
};

/// Embree's own query for a ray, on the same triangles and ways.
void embreeRay(benchmark::State& state) {
  const RayScene scene(body(static_cast<std::size_t>(state.range(0))));
  const std::vector<Leg>& ways = legs(state);
  std::size_t i = 0;
  std::size_t hits = 0;
  for (auto _ : state)
    hits += scene.hits(ways[i++ % ways.size()]);
  state.counters["hits"] = static_cast<double>(hits) / static_cast<double>(i);
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(embreeRay)->Apply(onBothWays);

double processorSeconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
  return values[values.size() / 2];
}

/// Both in turn on the same ways: what the machine does besides slows one as it slows the other. Medians of their times
/// and of the ratio of neighbours. Known ways are asked once more before each measurement, as the other query has
/// taken their place in the caches.
void ballToRay(benchmark::State& state) {
  const TriangleMesh& mesh = body(static_cast<std::size_t>(state.range(0)));
  const MeshSolid solid(mesh);
  const RayScene scene(mesh);
  const std::vector<Leg>& ways = legs(state);
  const auto secondsOf = [&](const auto& query) {
    std::size_t met = 0;
    const auto askAll = [&] {
      for (const Leg& leg : ways)
        met += query(leg);
    };
    if (state.range(1) == kKnownWays) askAll();
    const double begin = processorSeconds();
    askAll();
    const double end = processorSeconds();
    benchmark::DoNotOptimize(met);
    return (end - begin) / static_cast<double>(ways.size());
  };
  std::vector<double> balls, rays, ratios;
  for (auto _ : state) {
    balls.push_back(
        secondsOf([&](const Leg& leg) { return solid.firstContact(leg.from, leg.to, kRadius).has_value(); }));
    rays.push_back(secondsOf([&](const Leg& leg) { return scene.hits(leg); }));
    ratios.push_back(balls.back() / rays.back());
  }
  state.counters["ball_ns"] = 1e9 * median(balls);
  state.counters["ray_ns"] = 1e9 * median(rays);
  state.counters["ratio"] = median(ratios);
}
BENCHMARK(ballToRay)->Apply(onBothWays)->Unit(benchmark::kMillisecond);

/// FCL's continuous collision of a sphere with the same triangles.
void fclContinuousCollision(benchmark::State& state) {
  const TriangleMesh& mesh = body(static_cast<std::size_t>(state.range(0)));
  auto model = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
  model->beginModel();
  for (const auto& t : mesh.triangles) {
    model->addTriangle(mesh.corners[t[0]], mesh.corners[t[1]], mesh.corners[t[2]]);
  }
  model->endModel();
  const fcl::Sphered ball(kRadius);
  fcl::ContinuousCollisionRequestd request;
  request.ccd_motion_type = fcl::CCDM_TRANS;
  request.ccd_solver_type = fcl::CCDC_CONSERVATIVE_ADVANCEMENT;
  request.toc_err = 1e-6;
  const std::vector<Leg>& ways = legs(state);
  std::size_t i = 0;
  for (auto _ : state) {
    const Leg& leg = ways[i++ % ways.size()];
    fcl::Transform3d from = fcl::Transform3d::Identity();
    fcl::Transform3d to = fcl::Transform3d::Identity();
    from.translation() = leg.from;
    to.translation() = leg.to;
    fcl::ContinuousCollisionResultd result;
    benchmark::DoNotOptimize(fcl::continuousCollide(model.get(), fcl::Transform3d::Identity(),
                                                    fcl::Transform3d::Identity(), &ball, from, to, request, result));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(fclContinuousCollision)->Args({100'000, kKnownWays})->Args({1'000'000, kKnownWays});

const CadSolid& housing() {
  static const auto solid = readStep(std::string(PROBEWRIGHT_SOURCE_DIR) + "/examples/parts/housing.step");
  return dynamic_cast<const CadSolid&>(*solid.value());
}

/// Ways into the bore's wall, the top face and the spigot of the housing in turn.
std::vector<Leg> housingLegs() {
  std::vector<Leg> list;
  for (int i = 0; i < 360; ++i) {
    const Vector3 out = rotation(Vector3::UnitZ(), i) * Vector3::UnitX();
    list.push_back({{60, 40, -12}, Vector3(60, 40, -12) + 30 * out});
    list.push_back({{55.0 + i / 50.0, 5, 20}, {55.0 + i / 50.0, 5, -5}});
    list.push_back({Vector3(104, 62, 7) + 25 * out, {104, 62, 7}});
  }
  return list;
}

void ballContactOnCad(benchmark::State& state) {
  const auto list = housingLegs();
  std::size_t i = 0;
  for (auto _ : state) {
    const Leg& leg = list[i++ % list.size()];
    benchmark::DoNotOptimize(housing().firstContact(leg.from, leg.to, kRadius));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(ballContactOnCad);

/// OpenCASCADE's distance of a point from the same part: one of the many that a search for the contact would need.
void openCascadeDistance(benchmark::State& state) {
  const auto list = housingLegs();
  std::size_t i = 0;
  for (auto _ : state) {
    const Leg& leg = list[i++ % list.size()];
    const TopoDS_Shape point = BRepBuilderAPI_MakeVertex(gp_Pnt(leg.from.x(), leg.from.y(), leg.from.z())).Shape();
    benchmark::DoNotOptimize(BRepExtrema_DistShapeShape(point, housing().shape()).Value());
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(openCascadeDistance);

}  // namespace
}  // namespace probewright::simulation
