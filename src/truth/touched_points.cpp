#include "truth/touched_points.hpp"

#include <algorithm>
#include <cmath>

#include "simulation/face_at.hpp"

namespace probewright::truth {

using simulation::AnalyticSurface;
using simulation::PathKind;
using simulation::PathTouch;

namespace {

/// The plane's coordinates as a matrix.
Matrix3 planeFromXyz(const control::WorkingPlane& plane) {
  Matrix3 matrix = Matrix3::Zero();
  for (int i = 0; i < 3; ++i)
    matrix(i, plane.axis(i)) = 1;
  return matrix;
}

/// The working plane that is most nearly square to the tool.
control::WorkingPlane planeAcross(const Vector3& shank) {
  Eigen::Index along = 2;
  shank.cwiseAbs().maxCoeff(&along);
  return control::WorkingPlane::ofToolAxis("XYZ"[along]);
}

bool isRigid(const Matrix3& linear) { return (linear * linear.transpose() - Matrix3::Identity()).norm() < 1e-9; }

/// The touches of a path by the positions that the control was told, in the order in which they happened.
class PathTouches {
public:
  explicit PathTouches(const simulation::PathRecord& path) : path_(path) {}

  const PathTouch* find(const control::TouchRecord& touch) {
    for (std::size_t i = next_; i < path_.touches.size(); ++i) {
      const PathTouch& candidate = path_.touches[i];
      if (candidate.kind != PathKind::Measure || !(candidate.latched == touch.latched)) continue;
      next_ = i + 1;
      return &candidate;
    }
    return nullptr;
  }

  const Vector3& shank(const PathTouch& touch) const { return path_.points[touch.pathPoint].shank; }

private:
  const simulation::PathRecord& path_;
  std::size_t next_ = 0;
};

/// What was touched, by its name; of several the one that has a face there.
void findFace(TouchedPoint& found, const PathTouch& touch, const simulation::Truth& truth) {
  for (std::size_t i = truth.solids.size(); i-- > 0;) {
    const simulation::PlacedSolid& placed = truth.solids[i];
    if (placed.name != touch.solid) continue;
    found.solid = i;
    const Pose solidFromTable = placed.tableFromSolid.inverse();
    auto face = simulation::faceAt(*placed.solid, solidFromTable * touch.point, solidFromTable.linear() * touch.normal);
    if (!face) continue;
    if (!isRigid(found.planeFromTable.linear())) return;
    const Eigen::Affine3d planeFromSolid = found.planeFromTable * placed.tableFromSolid;
    face->origin = planeFromSolid * face->origin;
    face->axes = planeFromSolid.linear() * face->axes;
    found.face = *face;
    return;
  }
}

bool isToolProbe(const PathTouch& touch, const simulation::Truth& truth) {
  return std::ranges::any_of(truth.solids, [&](const simulation::PlacedSolid& placed) {
    return placed.name == touch.solid && placed.role == simulation::SolidRole::ToolProbe;
  });
}

}  // namespace

std::vector<TouchedCycle> touchedCycles(const control::Journal& journal, const simulation::Truth& truth,
                                        const simulation::PathRecord& path) {
  std::vector<TouchedCycle> cycles;
  PathTouches known(path);
  for (const control::CycleRecord& record : journal.cycles) {
    TouchedCycle cycle;
    bool planeKnown = false;
    for (std::size_t i = 0; i < record.touches.size(); ++i) {
      const control::TouchRecord& touch = record.touches[i];
      if (touch.outcome != "touched") continue;
      const PathTouch* real = known.find(touch);
      if (real == nullptr || real->part != "ball" || isToolProbe(*real, truth)) continue;
      if (!planeKnown) {
        cycle.plane = truth.machine.mainSpindle ? control::WorkingPlane::ofG(18)
                                                : planeAcross(touch.programFromTable.linear() * known.shank(*real));
        planeKnown = true;
      }
      TouchedPoint point;
      point.touch = i;
      point.planeFromTable = Eigen::Affine3d(planeFromXyz(cycle.plane)) * touch.programFromTable;
      point.direction = cycle.plane.planeFromXyz(touch.direction);
      point.ball = cycle.plane.planeFromXyz(touch.ballCentre);
      point.surface = cycle.plane.planeFromXyz(touch.surface);
      point.point = point.planeFromTable * real->point;
      point.normal = (point.planeFromTable.linear() * real->normal).normalized();
      findFace(point, *real, truth);
      cycle.points.push_back(point);
    }
    cycles.push_back(std::move(cycle));
  }
  return cycles;
}

TouchedCycle inMachine(TouchedCycle cycle) {
  const Eigen::Affine3d planeFromTable(planeFromXyz(cycle.plane));
  for (TouchedPoint& point : cycle.points) {
    const Eigen::Affine3d change = planeFromTable * point.planeFromTable.inverse();
    for (Vector3* place : {&point.ball, &point.surface, &point.point})
      *place = change * *place;
    for (Vector3* direction : {&point.direction, &point.normal})
      *direction = (change.linear() * *direction).normalized();
    if (point.face) {
      point.face->origin = change * point.face->origin;
      point.face->axes = change.linear() * point.face->axes;
    }
    point.planeFromTable = planeFromTable;
  }
  return cycle;
}

bool sameFace(const TouchedPoint& a, const TouchedPoint& b) {
  if (!a.face || !b.face || a.solid != b.solid || a.face->kind != b.face->kind) return false;
  constexpr double near = 1e-6;  // mm
  // Each surface passes through the other one's point, and both are alike there.
  const auto lies = [&](const AnalyticSurface& face, const TouchedPoint& other) {
    const simulation::SurfaceHeight height = face.height(other.point);
    return std::abs(height.signedDistance) < near && std::abs(height.normal.dot(other.normal)) > 1 - 1e-9;
  };
  return lies(*a.face, b) && lies(*b.face, a) && std::abs(std::abs(a.face->radius) - std::abs(b.face->radius)) < near;
}

std::string nameOf(AnalyticSurface::Kind kind) {
  switch (kind) {
    case AnalyticSurface::Kind::Plane:
      return "plane";
    case AnalyticSurface::Kind::Cylinder:
      return "cylinder";
    case AnalyticSurface::Kind::Cone:
      return "cone";
    case AnalyticSurface::Kind::Sphere:
      return "sphere";
    case AnalyticSurface::Kind::Torus:
      return "torus";
  }
  return "plane";
}

}  // namespace probewright::truth
