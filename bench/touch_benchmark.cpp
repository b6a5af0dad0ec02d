#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "machine/machine_file.hpp"
#include "simulation/cad_solid.hpp"
#include "simulation/mesh_solid.hpp"
#include "simulation/virtual_machine.hpp"

/// Whole touches per second: position, measure, retract, position, on one core.
namespace probewright::simulation {
namespace {

/// A plate with a waved top of about `triangles` triangles, 200 x 200 mm around the origin, closed below.
TriangleMesh wavedPlate(int triangles) {
  const int cells = static_cast<int>(std::sqrt(triangles / 2.0));
  TriangleMesh mesh;
  const auto corner = [&](int i, int j) { return static_cast<std::uint32_t>(i * (cells + 1) + j); };
  for (int i = 0; i <= cells; ++i) {
    for (int j = 0; j <= cells; ++j) {
      const double x = -100 + 200.0 * i / cells, y = -100 + 200.0 * j / cells;
      mesh.corners.emplace_back(x, y, 2 * std::sin(x / 7) * std::cos(y / 9));
    }
  }
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      mesh.triangles.push_back({corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)});
      mesh.triangles.push_back({corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)});
    }
  }
  return mesh;
}

/// Touches the top of `solid`, from above within `reach` of `middle`.
void touchFromAbove(benchmark::State& state, std::shared_ptr<const Solid> solid, const Vector3& middle, double reach) {
  Truth truth;
  truth.machine = machine::readMachine("mill3").value();
  truth.solids.push_back({std::move(solid), translation(Vector3(0, 0, -400) - middle), "part", SolidRole::Part});
  TrueTool probe;
  probe.number = 1;
  probe.probe.ballRadius = 2;
  probe.probe.stylusRadius = 1;
  truth.tools.push_back(probe);
  VirtualMachine machine(truth);
  machine.record(simulation::Recording::Nothing);
  machine.changeTool({1, ""});
  const auto at = [](double x, double y, double z) {
    machine::AxisPositions q;
    q[0] = x;
    q[1] = y;
    q[2] = z;
    return q;
  };
  const auto rapid = machine::Feed::rapidTraverse();
  int count = 0;
  for (auto _ : state) {
    const double angle = 0.1 * ++count, x = reach * std::cos(angle), y = reach * std::sin(1.3 * angle);
    machine.move(at(x, y, -284), rapid);
    const auto result = machine.measure({at(x, y, -340), machine::Feed::at(300)});
    if (result.end != machine::MeasureEnd::Touched) state.SkipWithError("no contact");
    machine.retract(at(x, y, -284), rapid);
  }
  state.SetItemsProcessed(state.iterations());
}

void triangles(benchmark::State& state) {
  touchFromAbove(state, std::make_shared<MeshSolid>(wavedPlate(static_cast<int>(state.range(0)))), Vector3::Zero(), 80);
}
BENCHMARK(triangles)->Arg(1000)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMicrosecond);

/// The exact surfaces of the housing of the examples, touched on a plain place of its top.
void housing(benchmark::State& state) {
  std::shared_ptr<const Solid> solid = readStep(PROBEWRIGHT_EXAMPLES "/parts/housing.step").value();
  touchFromAbove(state, std::move(solid), {60, 6, 0}, 2.5);
}
BENCHMARK(housing)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace probewright::simulation
