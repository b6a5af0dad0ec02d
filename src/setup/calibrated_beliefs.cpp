#include "setup/calibrated_beliefs.hpp"

#include <algorithm>

#include "machine/description.hpp"

namespace probewright::setup {

void believeAsCalibrated(control::BelievedTool& believed, const simulation::TrueTool& tool) {
  believed.mount = tool.mount;
  believed.shankDirection = tool.shankDirection;
  believed.length = tool.length;
  believed.radius = tool.radius;
  believed.teeth = static_cast<int>(tool.cutter.teeth.size());
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
  for (const simulation::TrueToolProbe& probe : world.truth.toolProbes) {
    const simulation::Bounds bounds = probe.contact->bounds();
    const Pose machineFromContact =
        machine::baseFromTable(world.truth.machine, world.truth.start) * probe.tableFromContact;
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

control::Technology believedTechnology(const machine::MachineDescription& machine) {
  return machine.axisIndex("Y") ? control::Technology::Milling : control::Technology::Turning;
}

}  // namespace probewright::setup
