#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "control/sinumerik/tool_carrier.hpp"
#include "support/sinumerik_bench.hpp"

/// A machine with rotary axes, a calibration ball on its table, and CYCLE996 at the positions that its build asks for.
namespace probewright::testing_support {

using control::sinumerik::ToolCarrier;

/// A build of machines, and how its rotary axes are measured. Rotary axis 2 has no name where there is only one.
struct Build {
  const char* machine;
  std::array<const char*, 2> axes;
  std::array<std::array<double, 3>, 2> positions;  ///< of each rotary axis for its three measurements
  double secondStands;                             ///< rotary axis 2 while axis 1 is measured
  Vector3 ball;                                    ///< its centre, table frame
};

inline const Build tableTable{"mill5-table-table", {"A", "C"}, {{{0, 50, -50}, {0, 120, -120}}}, 0, {110, 70, -520}};
inline const Build headTable{"mill5-head-table", {"B", "C"}, {{{0, 45, -45}, {0, 90, 180}}}, 0, {130, 120, -620}};
// The axis C of a fork head turns the probe on the spot unless it is tilted.
inline const Build headHead{"mill5-head-head", {"C", "A"}, {{{0, 120, -120}, {0, 45, -45}}}, 30, {60, -40, -850}};
// The spindle lies, and does not reach behind the axis of the table.
inline const Build oneAxis{"mill4-table", {"B", ""}, {{{0, 80, -80}, {}}}, 0, {10, 60, -556}};
inline const std::array<const Build*, 4> builds = {&tableTable, &headTable, &headHead, &oneAxis};

/// Errors of position and orientation for each rotary axis; mm and degrees.
inline void plantAxisErrors(simulation::Truth& truth, Planter& plant, double position = 0.4,
                            double orientation = 0.03) {
  for (std::size_t i = 0; i < truth.machine.axes.size(); ++i) {
    if (truth.machine.axes[i].kind != machine::AxisKind::Rotary) continue;
    const Vector3 shift = plant.within(position), turn = plant.within(orientation);
    truth.errors.rotaryAxes.push_back({i, shift, turn});
  }
}

class KinematicsScene {
public:
  static constexpr double ballRadius = 12.5, clearance = 3;
  double safeHeight = -100;  ///< of the spindle nose while the rotary axes turn

  KinematicsScene(const Build& build, simulation::Truth truth)
      : build_(build),
        trueMachine_(simulation::trueDescription(truth.machine, truth.errors)),
        ball_(build.ball),
        bench(std::move((place(truth, simulation::SolidSphere(Vector3::Zero(), ballRadius), translation(build.ball),
                               "ball", simulation::SolidRole::Sphere),
                         truth))) {}

  int axes() const { return *build_.axes[1] == 0 ? 1 : 2; }
  const machine::MachineDescription& trueMachine() const { return trueMachine_; }

  /// Where the tip truly is on the table.
  Vector3 trueTip(const machine::AxisPositions& axes, const Vector3& tool) const {
    return machine::baseFromTable(trueMachine_, axes).inverse() *
           (machine::baseFromSpindle(trueMachine_, axes) * Vector3(-tool));
  }

  machine::AxisPositions turned(double first, double second) const {
    machine::AxisPositions axes;
    axes[*trueMachine_.axisIndex(build_.axes[0])] = first;
    if (this->axes() == 2) axes[*trueMachine_.axisIndex(build_.axes[1])] = second;
    return axes;
  }

  /// The readings of X, Y, Z that bring the tip to a place `distance` above the ball, seen along the tool.
  Vector3 above(const machine::AxisPositions& rotary, double distance) const {
    const Vector3 tool(0, 0, 100);
    const Matrix3 tableFromSpindle = machine::baseFromTable(trueMachine_, rotary).linear().transpose() *
                                     machine::baseFromSpindle(trueMachine_, rotary).linear();
    const Vector3 wanted = ball_ + tableFromSpindle * Vector3(0, 0, ballRadius + distance);
    machine::AxisPositions axes = rotary;
    const std::array<std::size_t, 3> linear = {*trueMachine_.axisIndex("X"), *trueMachine_.axisIndex("Y"),
                                               *trueMachine_.axisIndex("Z")};
    const Vector3 atZero = trueTip(axes, tool);
    Matrix3 slope;
    for (std::size_t i = 0; i < 3; ++i) {
      machine::AxisPositions one = axes;
      one[linear[i]] = 1;
      slope.col(static_cast<Eigen::Index>(i)) = trueTip(one, tool) - atZero;
    }
    return slope.inverse() * (wanted - atZero);
  }

  /// Brings the probe above the ball with the rotary axes at these angles, in machine coordinates.
  std::string approach(double first, double second, double distance = clearance) const {
    const machine::AxisPositions rotary = turned(first, second);
    std::string text = fmt::format("SUPA G0 Z{}\nSUPA G0 {}={:.9f}", safeHeight, build_.axes[0], first);
    if (axes() == 2) text += fmt::format(" {}={:.9f}", build_.axes[1], second);
    for (const double away : {distance + 40, distance}) {
      const Vector3 at = above(rotary, away);
      text += fmt::format("\nSUPA G0 X{:.9f} Y{:.9f}\nSUPA G0 Z{:.9f}", at.x(), at.y(), at.z() - 100);
    }
    return text + "\n";
  }

  /// The arguments of a measuring call.
  NamedNumbers call(int axis, int measurement, int way = 1) const {
    return {{"S_MVAR", 10000.0 * (axis + 1) + 100 * way + measurement + 1},
            {"S_TC", 1},
            {"S_SETV", 2 * ballRadius},
            {"S_FA", clearance},
            {"S_TSA", 4}};
  }
  std::string placeFor(int axis, int measurement) const {
    const double angle = build_.positions[static_cast<std::size_t>(axis)][static_cast<std::size_t>(measurement)];
    return axis == 0 ? approach(angle, build_.secondStands) : approach(0, angle);
  }

  void measure(int axis, int way = 1) {
    for (int measurement = 0; measurement < 3; ++measurement)
      bench.run("CYCLE996", call(axis, measurement, way), {}, placeFor(axis, measurement));
  }
  void measureAll(int way = 1) {
    for (int axis = 0; axis < axes(); ++axis)
      measure(axis, way);
  }
  /// Calculates; the vectors go into the data set at once.
  void calculate(NamedNumbers more = {}) {
    bench.run("CYCLE996", with({{"S_MVAR", 1000}, {"S_TC", 1}, {"_AMODE", 10}}, more));
  }

  /// A vector of the data set.
  Vector3 datum(int first) const {
    Vector3 vector;
    for (int i = 0; i < 3; ++i)
      vector[i] = bench.data(fmt::format("$TC_CARR{}", first + i).c_str(), {1});
    return vector;
  }
  Vector3 found(int first) const { return {bench.ovr(first), bench.ovr(first + 1), bench.ovr(first + 2)}; }
  /// What the operator decides and no cycle does: the measured directions of the axes count.
  void enterDirections() {
    for (int i = 7; i <= 12; ++i)
      bench.set(fmt::format("$TC_CARR{}", i).c_str(), {1}, bench.ovr(i));
  }

  /// Where the data set says that the tip is on the table: the formulas of orientable tool carriers.
  Vector3 tipOfDataSet(const machine::AxisPositions& axes, const Vector3& tool) const {
    const Vector3 i1 = datum(1), i2 = datum(4), i3 = datum(15), i4 = datum(18);
    const auto turn = [&](int first, const char* axis) {
      const Vector3 v = datum(first);
      return v.isZero()
                 ? Matrix3(Matrix3::Identity())
                 : Matrix3(Eigen::AngleAxisd(radiansFromDegrees(axes[*trueMachine_.axisIndex(axis)]), v.normalized()));
    };
    const Matrix3 r1 = turn(7, build_.axes[0]), r2 = turn(10, build_.axes[1]);
    Vector3 m;
    for (int i = 0; i < 3; ++i)
      m[i] = axes[*trueMachine_.axisIndex(std::string(1, static_cast<char>('X' + i)))];
    const std::string kind = bench.control.data.text("$TC_CARR23", {1});
    if (kind == "T") return m - i1 - r1 * (i2 + r2 * (i3 + tool));
    if (kind == "P") return r2.transpose() * (r1.transpose() * (m - tool - i2) - i3) - i4;
    return r2.transpose() * (m - i1 - r1 * (i2 + tool) - i3) - i4;
  }
  /// The greatest distance between the two over random positions, mm.
  double errorOfDataSet(Planter& plant) const {
    double worst = 0;
    for (int i = 0; i < 50; ++i) {
      machine::AxisPositions axes = turned(plant.number(-90, 90), plant.number(-90, 90));
      for (const char* name : {"X", "Y", "Z"})
        axes[*trueMachine_.axisIndex(name)] = plant.number(-300, 0);
      const Vector3 tool(0, 0, plant.number(50, 200));
      worst = std::max(worst, (tipOfDataSet(axes, tool) - trueTip(axes, tool)).norm());
    }
    return worst;
  }

  /// The true direction of rotary axis 0 or 1, in its chain.
  Vector3 trueDirection(int axis) const {
    const std::size_t wanted = *trueMachine_.axisIndex(build_.axes[static_cast<std::size_t>(axis)]);
    for (const auto* chain : {&trueMachine_.spindleChain, &trueMachine_.tableChain})
      for (const machine::ChainElement& element : *chain)
        if (element.axis == wanted) return element.direction;
    return Vector3::Zero();
  }

private:
  Build build_;
  machine::MachineDescription trueMachine_;
  Vector3 ball_;

public:
  SinumerikBench bench;
};

inline double angleBetween(const Vector3& a, const Vector3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

}  // namespace probewright::testing_support
