#include "setup/calibrated_beliefs.hpp"

#include <algorithm>
#include <cmath>

#include "machine/description.hpp"
#include "simulation/tool_shape.hpp"

namespace probewright::setup {

namespace {

/// The cutting edge position of an insert that lies in the plane of Z and X: where its nose points.
int cuttingEdgeOf(const simulation::TrueTool& tool) {
  const simulation::TrueInsert& insert = *tool.cutter.insert;
  const double half = std::remainder(insert.secondNormal - insert.firstNormal, 360) / 2;
  const double middle = radiansFromDegrees(insert.firstNormal + half);
  const Vector3 pointing = simulation::toolFrame(tool) * rotation(Vector3::UnitZ(), insert.orientation).linear() *
                           Vector3(std::cos(middle), 0, std::sin(middle));
  const auto sign = [](double value) { return std::abs(value) < 1e-6 ? 1 : value < 0 ? 0 : 2; };
  // By Z, then by X.
  static constexpr int positions[3][3] = {{3, 7, 2}, {8, 0, 6}, {4, 5, 1}};
  return positions[sign(pointing.z())][sign(pointing.x())];
}

}  // namespace

void believeAsCalibrated(control::BelievedTool& believed, const simulation::TrueTool& tool) {
  believed.mount = tool.mount;
  believed.shankDirection = tool.shankDirection;
  believed.length = tool.length;
  believed.radius = tool.radius;
  believed.teeth = static_cast<int>(tool.cutter.teeth.size());
  if (tool.cutter.insert) {
    believed.cuttingEdge = cuttingEdgeOf(tool);
    // Where the tip is beside the axis, as long as the plane of the insert is that of X.
    if (tool.cutter.insert->orientation == 0) believed.tipOffset = tool.cutter.eccentricity;
  }
  if (tool.kind != simulation::ToolKind::Probe) return;
  const simulation::TrueProbe& probe = tool.probe;
  const double delayed = probe.signalDelay * believed.feed / 60;
  believed.length = tool.length - probe.axialPretravel - delayed;
  believed.radius = probe.starArm + probe.ballRadius - probe.pretravel - delayed;
  believed.starArm = probe.starArm;
  believed.tipOffset = probe.tipOffset;
  believed.tipOffsetAngle = 0;
}

void believeShape(control::BelievedTool& believed, const simulation::TrueProbe& probe) {
  believed.axialRadius = believed.radius - probe.starArm + probe.pretravel - probe.axialPretravel;
  believed.lShaped = believed.tipOffset.norm() > 2 * (probe.ballRadius + probe.stylusRadius);
}

namespace {

/// Where a contact ends and where it gives way, along the axes of the machine; how it is tilted, nobody has measured.
void believeSides(control::BelievedToolProbe& believed, const simulation::TrueToolProbe& probe,
                  const Matrix3& machineFromContact) {
  const simulation::Bounds bounds = probe.contact->bounds();
  Vector3 least = bounds.minimum, most = bounds.maximum;
  least.z() = std::max(least.z(), most.z() - believed.width);  // what is below the contact carries it
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::Index own = 0;
    machineFromContact.row(axis).cwiseAbs().maxCoeff(&own);
    const bool along = machineFromContact(axis, own) > 0;
    believed.least[axis] = believed.centre[axis] + (along ? least[own] : -most[own]);
    believed.most[axis] = believed.centre[axis] + (along ? most[own] : -least[own]);
    for (const bool plus : {true, false}) {
      believed.gives[static_cast<std::size_t>(2 * axis + (plus ? 0 : 1))] =
          probe.gives[static_cast<std::size_t>(2 * own + (plus == along ? 0 : 1))];
    }
  }
}

}  // namespace

std::vector<control::BelievedToolProbe> believedToolProbes(const simulation::World& world) {
  std::vector<control::BelievedToolProbe> all;
  // On lathes they stand on the bed: the main spindle does not turn them.
  machine::AxisPositions standing = world.truth.start;
  if (world.truth.machine.mainSpindle) standing[*world.truth.machine.mainSpindle] = 0;
  for (const simulation::TrueToolProbe& probe : world.truth.toolProbes) {
    const simulation::Bounds bounds = probe.contact->bounds();
    const Pose machineFromContact = machine::baseFromTable(world.truth.machine, standing) * probe.tableFromContact;
    control::BelievedToolProbe believed;
    believed.centre = machineFromContact * Vector3::Zero();
    believed.width = bounds.maximum.x() - bounds.minimum.x();
    believed.widthY = bounds.maximum.y() - bounds.minimum.y();
    believed.pretravel = probe.pretravel;
    believed.cuboid = probe.cuboid;
    believeSides(believed, probe, machineFromContact.linear());
    all.push_back(believed);
  }
  return all;
}

void believeHirthCouplings(control::Beliefs& beliefs, const simulation::Truth& truth) {
  for (std::size_t i = 0; i < truth.machine.axes.size(); ++i) {
    if (truth.hirthGrid[i] <= 0) continue;
    double& believed = beliefs.kinematics[truth.machine.axes[i].name].hirthGrid;
    if (believed == 0) believed = truth.hirthGrid[i];
  }
}

control::Technology believedTechnology(const machine::MachineDescription& machine) {
  return machine.axisIndex("Y") ? control::Technology::Milling : control::Technology::Turning;
}

}  // namespace probewright::setup
