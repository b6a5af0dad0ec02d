#include "setup/calibrated_beliefs.hpp"

#include "machine/description.hpp"

namespace probewright::setup {

void believeAsCalibrated(control::BelievedTool& believed, const simulation::TrueTool& tool) {
  believed.mount = tool.mount;
  believed.shankDirection = tool.shankDirection;
  believed.length = tool.length;
  believed.radius = tool.radius;
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

std::optional<control::BelievedToolProbe> believedToolProbe(const simulation::World& world) {
  if (world.truth.toolProbes.empty()) return std::nullopt;
  const simulation::TrueToolProbe& probe = world.truth.toolProbes.front();
  const simulation::Bounds bounds = probe.contact->bounds();
  control::BelievedToolProbe believed;
  believed.centre =
      (machine::baseFromTable(world.truth.machine, world.truth.start) * probe.tableFromContact) * Vector3::Zero();
  believed.width = bounds.maximum.x() - bounds.minimum.x();
  believed.widthY = bounds.maximum.y() - bounds.minimum.y();
  believed.pretravel = probe.pretravel;
  believed.cuboid = probe.cuboid;
  return believed;
}

control::Technology believedTechnology(const machine::MachineDescription& machine) {
  return machine.axisIndex("Y") ? control::Technology::Milling : control::Technology::Turning;
}

}  // namespace probewright::setup
