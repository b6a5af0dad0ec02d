#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "control/heidenhain/kinematic_tables.hpp"
#include "control/heidenhain/kinematics.hpp"
#include "cycles_heidenhain/table_folder.hpp"
#include "simulation/analytic_solids.hpp"
#include "support/heidenhain_bench.hpp"

/// Machines whose rotary axes are not where their control believes, with a calibration sphere on a stem.
namespace probewright::testing_support {

using control::heidenhain::KinematicData;
using control::heidenhain::Kinematics;

inline constexpr double sphereRadius = 12.5;

/// How a machine is measured so that nothing is in the way: each axis with its angles and where it stands meanwhile.
struct Measured {
  double start = 0, end = 0, incidence = 0;
  int points = 0;
};
struct Build {
  std::string machine;
  std::map<char, Measured> axes;
  Vector3 sphere;  ///< machine coordinates, all axes at 0
  double reference = 45;
};

inline std::vector<Build> builds() {
  return {
      {"mill5-table-table", {{'A', {-90, 90, 0, 4}}, {'C', {90, 270, 0, 3}}}, {120, 40, -480}},
      {"mill5-head-table", {{'B', {-80, 80, 0, 4}}, {'C', {90, 270, 0, 3}}}, {150, 60, -420}},
      {"mill5-head-head", {{'A', {-80, 80, 45, 4}}, {'C', {90, 270, 0, 3}}}, {100, 50, -600}},
      {"mill4-table", {{'B', {90, 270, 0, 3}}}, {60, -380, -640}},
  };
}

/// The parameters of cycle 451; 452 has no Q406 and Q431.
inline Words words451(const Build& build, int mode, const Words& changes = {}) {
  Words words = {{406, mode}, {407, sphereRadius}, {320, 0}, {408, 0}, {253, 5000}, {380, build.reference}};
  int number = 411;
  for (const char name : {'A', 'B', 'C'}) {
    const auto found = build.axes.find(name);
    const Measured axis = found == build.axes.end() ? Measured{} : found->second;
    words.insert(
        words.end(),
        {{number, axis.start}, {number + 1, axis.end}, {number + 2, axis.incidence}, {number + 3, axis.points}});
    number += 4;
  }
  words.insert(words.end(), {{423, 4}, {431, 0}, {432, 0}});
  return with(words, changes);
}

/// A sphere where `build` has it, preset 1 in its middle, and rotary axes that truly lie elsewhere.
struct SphereWorld {
  explicit SphereWorld(const Build& built, ControlKind control = ControlKind::TNC640)
      : build(built), bench(control, built.machine) {
    bench.probeOf(200, 2);
    bench.believedProbe().maximumTravel = 30;
    plantSphere(build.sphere);
    bench.preset(1, build.sphere);
  }

  void plantSphere(const Vector3& centre) {
    bench.part(simulation::SolidSphere(Vector3::Zero(), sphereRadius), pose(centre));
    // The stem stands on the table: along its normal.
    const bool upright = build.machine == "mill4-table";
    const Pose stem = pose(centre, upright ? Vector3(-90, 0, 0) : Vector3(0, 0, 0));
    bench.part(simulation::RoundBar(4, -60, -sphereRadius + 1), stem);
  }

  machine::MachineDescription built() const { return bench.setup.world.truth.machine; }
  machine::MachineDescription truth() const {
    return simulation::trueDescription(bench.setup.world.truth.machine, bench.setup.world.truth.errors);
  }

  /// Places (mm) and directions (degrees) of all rotary axes, at random.
  void plant(Dice& dice, double place, double direction) {
    simulation::MachineErrors& errors = bench.setup.world.truth.errors;
    for (std::size_t i = 0; i < built().axes.size(); ++i) {
      if (built().axes[i].kind == machine::AxisKind::Rotary)
        errors.rotaryAxes.push_back({i, dice.within(place), dice.within(direction)});
    }
  }

  Build build;
  Bench bench;
};

/// Goes over the preset and touches the top of the sphere along the tool: Q160.
inline std::string touchTop() {
  return "L Z+60 R0 FMAX\nL X+0 Y+0 R0 FMAX\n" + probe(427, {{263, 0},
                                                             {264, 0},
                                                             {261, sphereRadius},
                                                             {320, 5},
                                                             {272, 3},
                                                             {267, -1},
                                                             {260, 60},
                                                             {281, 0},
                                                             {288, 0},
                                                             {289, 0},
                                                             {309, 0},
                                                             {330, 0}});
}

inline bool ended(const Ran& ran) {
  return ran.outcome.result.end == execution::RunEnd::Finished && !hasErrors(ran.outcome.diagnostics);
}

/// The kinematics that a run leaves.
inline KinematicData kinematicsOf(const Ran& ran, const machine::MachineDescription& built) {
  const Kinematics kinematics(built);
  const auto found = ran.outcome.files.find("KINEMATIC.TAB");
  if (found == ran.outcome.files.end()) return kinematics.data();
  coverage::writesRead(ran.outcome.control, ran.outcome.journal,
                       [](const control::WriteRecord& write) { return write.table == "KINEMATIC.TAB"; });
  Diagnostics diagnostics;
  const auto table = control::heidenhain::TypedTable::parse(found->second, found->first,
                                                            control::heidenhain::kinematicColumns(), diagnostics);
  EXPECT_TRUE(table);
  const auto data = kinematics.dataOf(control::heidenhain::entriesOf(*table));
  EXPECT_TRUE(data) << format(data.error());
  return *data;
}

/// How far axes of rotation lie apart, and how far their directions, over all rotary axes of `names`.
struct Apart {
  double place = 0, direction = 0;  ///< mm, rad
};
inline Apart apart(const machine::MachineDescription& a, const machine::MachineDescription& b,
                   const std::string& names = "ABC") {
  Apart most;
  for (auto chain : {&machine::MachineDescription::tableChain, &machine::MachineDescription::spindleChain}) {
    for (std::size_t i = 0; i < (a.*chain).size(); ++i) {
      const auto& first = (a.*chain)[i];
      const auto& second = (b.*chain)[i];
      const machine::Axis& axis = a.axes[*first.axis];
      if (axis.kind != machine::AxisKind::Rotary || names.find(axis.name) == names.npos) continue;
      most.direction = std::max(most.direction, first.direction.cross(second.direction).norm());
      most.place = std::max(most.place, second.direction.cross(first.point - second.point).norm());
    }
  }
  return most;
}

}  // namespace probewright::testing_support
