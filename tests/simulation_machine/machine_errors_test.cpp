#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/virtual_world.hpp"

namespace probewright::simulation {
namespace {

using machine::AxisPositions;
using machine::Feed;
using machine::MeasureEnd;
using machine::MoveEnd;
using testing_support::perfectWorld;
using testing_support::place;
using testing_support::positions;

constexpr double ballCentreBelowNose = 98;  // ideal probe: length 100, radius 2

/// Touches once from `from` to `to` with the probe of `truth` and returns what the control is told.
AxisPositions latched(VirtualMachine& machine, const AxisPositions& from, const AxisPositions& to, double feed = 300) {
  EXPECT_EQ(machine.changeTool({1, ""}).end, machine::ToolChangeEnd::Changed);
  EXPECT_EQ(machine.move(from, Feed::rapidTraverse()).end, MoveEnd::Reached);
  const auto result = machine.measure({to, Feed::at(feed)});
  EXPECT_EQ(result.end, MeasureEnd::Touched) << result.detail;
  EXPECT_EQ(machine.retract(from, Feed::rapidTraverse()).end, MoveEnd::Reached);
  return result.latched;
}

/// A bore of radius 30 about the origin of the table, and the probe in its middle at Z -400.
Truth worldWithBore() {
  Truth truth = perfectWorld();
  place(truth, EndlessBore(Vector2::Zero(), 30));
  truth.tools[0].probe.bodyRadius = 0;
  truth.errors.axes.resize(3);
  return truth;
}

double touchAlongX(VirtualMachine& machine, double sign, double y = 0) {
  return latched(machine, positions({0, y, -400}), positions({sign * 40, y, -400}))[0];
}

TEST(MachineErrors, ScaleStretchesReadings) {
  Truth truth = worldWithBore();
  truth.errors.axes[0].scale = 150e-6;
  VirtualMachine machine(truth);
  EXPECT_NEAR(touchAlongX(machine, 1), 28 / (1 + 150e-6), 1e-9);
  EXPECT_NEAR(touchAlongX(machine, -1), -28 / (1 + 150e-6), 1e-9);
}

TEST(MachineErrors, OffsetShiftsTheAxis) {
  Truth truth = worldWithBore();
  truth.errors.axes[0].offset = 0.25;
  VirtualMachine machine(truth);
  EXPECT_NEAR(touchAlongX(machine, 1), 27.75, 1e-9);
}

TEST(MachineErrors, SquarenessShowsWhereTheOtherAxisTravels) {
  Truth truth = perfectWorld();
  place(truth, HalfSpace({Vector3(50, 0, 0), -Vector3::UnitX()}));
  truth.tools[0].probe.bodyRadius = 0;  // the wall has no top
  truth.errors.squareness.push_back({1, 0, 0.05});
  VirtualMachine machine(truth);
  for (const double y : {-100.0, 0.0, 150.0}) {
    // The Y slide leans towards +X by 0.05 degrees: at y the tool stands y * sin(0.05 degrees) further.
    EXPECT_NEAR(latched(machine, positions({0, y, -300}), positions({60, y, -300}))[0],
                48 - y * std::sin(radiansFromDegrees(0.05)), 1e-9);
  }
}

TEST(MachineErrors, StraightnessBendsThePath) {
  Truth truth = perfectWorld();
  truth.errors.axes.resize(3);
  place(truth, HalfSpace({Vector3(50, 0, 0), -Vector3::UnitX()}));
  truth.tools[0].probe.bodyRadius = 0;  // the wall has no top
  Deviation bow;
  bow.direction = Vector3::UnitX();
  bow.polynomial = {0.01, 0, 0.5};  // mm; q in m
  truth.errors.axes[1].deviations.push_back(bow);
  VirtualMachine machine(truth);
  for (const double y : {-200.0, 0.0, 100.0}) {
    EXPECT_NEAR(latched(machine, positions({0, y, -300}), positions({60, y, -300}))[0],
                48 - 0.01 - 0.5 * std::pow(y / 1000, 2), 1e-9);
  }
}

TEST(MachineErrors, PeriodicPositioningErrorIsFoundOnTheMove) {
  Truth truth = perfectWorld();
  truth.errors.axes.resize(3);
  place(truth, HalfSpace({Vector3(50, 0, 0), -Vector3::UnitX()}));
  truth.tools[0].probe.bodyRadius = 0;  // the wall has no top
  Deviation screw;
  screw.direction = Vector3::UnitX();
  screw.amplitude = 0.02;
  screw.wavelength = 10;
  screw.phase = 30;
  truth.errors.axes[0].deviations.push_back(screw);
  VirtualMachine machine(truth);
  const double reading = latched(machine, positions({0, 0, -300}), positions({60, 0, -300}))[0];
  // At the signal the true place is the plane's: q + 0.02 sin(36 q + 30 degrees) = 48.
  EXPECT_NEAR(reading + 0.02 * std::sin(radiansFromDegrees(36 * reading + 30)), 48, 2e-7);
  EXPECT_GT(std::abs(reading - 48), 0.001);
}

TEST(MachineErrors, BacklashShowsOnMotionInMinus) {
  Truth truth = worldWithBore();
  truth.errors.axes[0].backlash = 0.03;
  VirtualMachine machine(truth);
  EXPECT_NEAR(touchAlongX(machine, 1), 28, 1e-9);
  // The slide follows to minus only after the play is used up: it stands 0.03 further in + than it reads.
  EXPECT_NEAR(touchAlongX(machine, -1), -28.03, 1e-9);
  EXPECT_NEAR(touchAlongX(machine, 1), 28, 1e-9);
}

TEST(MachineErrors, LinearErrorsTogetherAreALinearMap) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 200; ++i) {
    Truth truth = perfectWorld();
    truth.errors.axes.resize(3);
    Matrix3 map = Matrix3::Identity();
    const double xy = 0.1 * uniform(random), zx = 0.1 * uniform(random), zy = 0.1 * uniform(random);
    truth.errors.squareness = {{1, 0, xy}, {2, 0, zx}};
    map.col(1) = Vector3(std::tan(radiansFromDegrees(xy)), 1, 0).normalized();
    map.col(2) = Vector3(std::tan(radiansFromDegrees(zx)), 0, 1).normalized();
    truth.errors.squareness.push_back({2, 1, zy});
    map.col(2) = (map.col(2) + Vector3(0, std::tan(radiansFromDegrees(zy)), 0)).normalized();
    Vector3 shift;
    for (std::size_t k = 0; k < 3; ++k) {
      truth.errors.axes[k].scale = 2e-4 * uniform(random);
      truth.errors.axes[k].offset = 0.1 * uniform(random);
    }
    // The map of the readings: each axis travels along its own direction.
    const auto truePlace = [&](const AxisPositions& q) {
      Vector3 p(0, 0, -ballCentreBelowNose);
      for (std::size_t k = 0; k < 3; ++k) {
        p += map.col(static_cast<Eigen::Index>(k)) *
             (q[k] * (1 + truth.errors.axes[k].scale) + truth.errors.axes[k].offset);
      }
      return p;
    };
    const Vector3 normal = Vector3(uniform(random), uniform(random), 3 + uniform(random)).normalized();
    place(truth, HalfSpace({Vector3(0, 0, -400), normal}));
    VirtualMachine machine(truth);
    const AxisPositions from = positions({40 * uniform(random), 40 * uniform(random), -200});
    const AxisPositions to = positions({40 * uniform(random), 40 * uniform(random), -380});
    const AxisPositions reading = latched(machine, from, to);
    EXPECT_NEAR((truePlace(reading) - Vector3(0, 0, -400)).dot(normal), 2, 1e-9);
  }
}

TEST(MachineErrors, DisplacedTurntableMovesThePartOnACircleAboutItsTrueCentre) {
  Truth truth = perfectWorld("mill5-table-table");
  const Vector3 displaced(0.3, -0.2, 0);
  truth.errors.rotaryAxes.push_back({4, displaced, Vector3::Zero()});
  truth.tools[0].probe.bodyRadius = 0;
  place(truth, RoundBar(10, -600, -500), translation({100, 0, 0}));
  for (const double angle : {0.0, 40.0, 90.0, 180.0, 287.0}) {
    VirtualMachine machine(truth);
    machine.changeTool({1, ""});
    // With C the table turns by -C about its true centre; there stands the bar now:
    const Vector3 bar = displaced + rotation(Vector3::UnitZ(), -angle) * (Vector3(100, 0, 0) - displaced);
    machine.move(positions({bar.x() + 20, bar.y(), -300, 0, angle}), Feed::rapidTraverse());
    machine.move(positions({bar.x() + 20, bar.y(), -430, 0, angle}), Feed::rapidTraverse());
    const auto result = machine.measure({positions({bar.x(), bar.y(), -430, 0, angle}), Feed::at(300)});
    ASSERT_EQ(result.end, MeasureEnd::Touched) << result.detail;
    EXPECT_NEAR(result.latched[0], bar.x() + 12, 1e-9) << angle;
  }
}

TEST(MachineErrors, TiltedRotaryAxisTurnsAboutItsTrueLine) {
  Truth truth = perfectWorld("mill5-head-table");
  RotaryAxisError error{3, {0.1, 0.2, -0.3}, {0.05, 0, -0.08}};
  truth.errors.rotaryAxes.push_back(error);
  VirtualMachine machine(truth);
  machine.changeTool({1, ""});
  ASSERT_EQ(machine.move(positions({10, 20, -30, 25, 0}), Feed::rapidTraverse()).end, MoveEnd::Reached);
  const Vector3 tilt = error.orientation * (std::numbers::pi / 180);
  const Vector3 axis = Eigen::AngleAxisd(tilt.norm(), tilt.normalized()) * Vector3::UnitY();
  const Vector3 point = Vector3(0, 0, 150) + error.position;
  const Vector3 ball = Vector3(0, 0, -98);
  const Vector3 turned = point + Eigen::AngleAxisd(radiansFromDegrees(25), axis).toRotationMatrix() * (ball - point) +
                         Vector3(10, 20, -30);
  EXPECT_LT((machine.tipOnTable() - turned).norm(), 1e-9);
}

TEST(MachineErrors, SpindleTiltMovesTheBallAboutTheNose) {
  Truth truth = perfectWorld();
  truth.errors.spindleTilt = {0.1, 0, 0};
  VirtualMachine machine(truth);
  machine.changeTool({1, ""});
  const double tilt = radiansFromDegrees(0.1);
  EXPECT_LT((machine.tipOnTable() - 98 * Vector3(0, std::sin(tilt), -std::cos(tilt))).norm(), 1e-12);
}

TEST(MachineErrors, ThermalDriftGrowsWithTime) {
  Truth truth = perfectWorld();
  truth.errors.thermal.push_back({{0, 0, 0.05}, 1800});
  place(truth, HalfSpace({Vector3(0, 0, -400), Vector3::UnitZ()}));
  VirtualMachine machine(truth);
  for (int i = 0; i < 3; ++i) {
    machine.dwell(900);
    const double z = latched(machine, positions({0, 0, -299}), positions({0, 0, -301}), 60)[2];
    // The touch comes within three seconds of now: 0.05 * 3 / 1800 mm at most.
    EXPECT_NEAR(z, -300 - 0.05 * (1 - std::exp(-machine.seconds() / 1800)), 1e-4);
  }
}

TEST(ProbeErrors, PretravelFollowsTheThreeLobesOfTheProbe) {
  for (const double spindle : {0.0, 50.0}) {
    Truth truth = worldWithBore();
    TrueProbe& probe = truth.tools[0].probe;
    probe.pretravel = 0.012;
    probe.lobing = 0.003;
    probe.lobingPhase = 20;
    VirtualMachine machine(truth);
    ASSERT_EQ(machine.orientSpindle(spindle).end, MoveEnd::Reached);
    for (double angle = 0; angle < 360; angle += 15) {
      const double c = std::cos(radiansFromDegrees(angle)), s = std::sin(radiansFromDegrees(angle));
      const AxisPositions reading = latched(machine, positions({0, 0, -400}), positions({40 * c, 40 * s, -400}));
      // The surface's normal points back to the middle, against the motion.
      const double lobes = std::cos(3 * radiansFromDegrees(angle + 180 - spindle - 20));
      EXPECT_NEAR(std::hypot(reading[0], reading[1]), 28 + 0.012 + 0.003 * lobes, 1e-9) << angle;
    }
  }
}

TEST(ProbeErrors, AxialPretravelActsAlongTheStylus) {
  Truth truth = perfectWorld();
  truth.tools[0].probe.pretravel = 0.02;
  truth.tools[0].probe.axialPretravel = 0.005;
  place(truth, HalfSpace({Vector3(0, 0, -400), Vector3::UnitZ()}));
  VirtualMachine machine(truth);
  EXPECT_NEAR(latched(machine, positions({0, 0, -290}), positions({0, 0, -310}))[2], -300.005, 1e-9);
}

TEST(ProbeErrors, SignalDelayActsWithTheSpeed) {
  Truth truth = worldWithBore();
  truth.tools[0].probe.signalDelay = 0.0002;
  VirtualMachine machine(truth);
  const auto reading = [&](double feed) {
    return latched(machine, positions({0, 0, -400}), positions({40, 0, -400}), feed)[0];
  };
  EXPECT_NEAR(reading(300), 28 + 5 * 0.0002, 1e-9);
  EXPECT_NEAR(reading(3000), 28 + 50 * 0.0002, 1e-9);
}

TEST(ProbeErrors, TipOffsetTurnsWithTheSpindle) {
  Truth truth = worldWithBore();
  truth.tools[0].probe.tipOffset = {0.04, -0.01};
  VirtualMachine machine(truth);
  const double wall = std::sqrt(28 * 28 - 0.01 * 0.01);
  EXPECT_NEAR(touchAlongX(machine, 1), wall - 0.04, 1e-9);
  EXPECT_NEAR(touchAlongX(machine, -1), -wall - 0.04, 1e-9);
  machine.orientSpindle(180);
  EXPECT_NEAR(touchAlongX(machine, 1), wall + 0.04, 1e-9);
  machine.orientSpindle(90);
  // Turned by 90 degrees counter-clockwise the offset is (0.01, 0.04).
  EXPECT_NEAR(touchAlongX(machine, 1), std::sqrt(28 * 28 - 0.04 * 0.04) - 0.01, 1e-9);
}

TEST(ProbeErrors, RepeatabilityIsNormalAndComesFromTheSeed) {
  const auto run = [](std::uint64_t seed) {
    Truth truth = worldWithBore();
    truth.tools[0].probe.repeatability = 0.001;
    truth.seed = seed;
    VirtualMachine machine(truth);
    std::vector<double> readings;
    for (int i = 0; i < 4000; ++i)
      readings.push_back(touchAlongX(machine, 1) - 28);
    return readings;
  };
  const std::vector<double> noise = run(5);
  double mean = 0, square = 0;
  int within = 0;
  for (const double value : noise) {
    mean += value / 4000;
    square += value * value / 4000;
    within += std::abs(value) < 0.001;
  }
  // Standard error of the mean 0.001/63, of the deviation 0.001/89, of the share within one sigma 0.0074: five of each.
  EXPECT_NEAR(mean, 0, 5 * 0.001 / 63);
  EXPECT_NEAR(std::sqrt(square), 0.001, 5 * 0.001 / 89);
  EXPECT_NEAR(within / 4000.0, 0.6827, 5 * 0.0074);
  EXPECT_EQ(noise, run(5));
  EXPECT_NE(noise, run(6));
}

TEST(ProbeErrors, NoSignalBeforeThePretravelIsUsedUp) {
  Truth truth = worldWithBore();
  truth.tools[0].probe.pretravel = 0.02;
  VirtualMachine machine(truth);
  machine.changeTool({1, ""});
  machine.move(positions({0, 0, -400}), Feed::rapidTraverse());
  EXPECT_EQ(machine.measure({positions({28.01, 0, -400}), Feed::at(60)}).end, MeasureEnd::NoContact);
  EXPECT_EQ(machine.retract(positions({0, 0, -400}), Feed::at(60)).end, MoveEnd::Reached);
  EXPECT_FALSE(machine.deflected(machine::Sensor::TouchProbe));
  EXPECT_EQ(machine.measure({positions({28.03, 0, -400}), Feed::at(60)}).end, MeasureEnd::Touched);
}

TEST(ProbeErrors, SwitchedOffProbeIsNotReady) {
  Truth truth = worldWithBore();
  truth.tools[0].probe.switchedOn = false;
  VirtualMachine machine(truth);
  machine.changeTool({1, ""});
  EXPECT_EQ(machine.measure({positions({40, 0, 0}), Feed::at(60)}).end, MeasureEnd::NotReady);
}

}  // namespace
}  // namespace probewright::simulation
