#include "support/sinumerik_bench.hpp"

/// Measuring in G18 and G19 with a probe in an angle head: the plane is the program's or the call's (_DMODE).
namespace probewright {
namespace {

using namespace testing_support;

const Vector3 origin(10, -20, -330);

struct Plane {
  const char* name;
  const char* other;
  int dmode;
  int first, second, third;  ///< axes of the machine
  const char* out;           ///< the word of the 3rd axis
  const char* across;        ///< those of the others, for the origin of the plane
};
constexpr Plane planes[] = {{"G18", "G17", 2, 2, 0, 1, "Y", "X0 Z0"}, {"G19", "G18", 3, 1, 2, 0, "X", "Y0 Z0"}};

/// Machine from coordinates of the plane.
Pose poseOf(const Plane& plane) {
  Matrix3 axes = Matrix3::Zero();
  axes(plane.first, 0) = axes(plane.second, 1) = axes(plane.third, 2) = 1;
  Pose pose = Pose::Identity();
  pose.linear() = axes;
  return pose;
}

class HorizontalBench : public SinumerikBench {
public:
  HorizontalBench(simulation::Truth truth, const Plane& working)
      : SinumerikBench(headed(std::move(truth), working)), plane_(working) {
    plantFrame(*this, "$P_UIFR", 1, origin);
    plane = working.name;
  }

  /// From outside along the 3rd axis to `depth` over the point (first, second) of the plane, then the call.
  void measure(const char* cycle, const NamedNumbers& call, double first, double second, double depth, bool byCall) {
    const char names[] = {'X', 'Y', 'Z'};
    const std::string before = fmt::format("G0 {}120\nG0 {}\nG0 {}{:.9f} {}{:.9f}\nG0 {}{:.9f}\n{}", plane_.out,
                                           plane_.across, names[plane_.first], first, names[plane_.second], second,
                                           plane_.out, depth, byCall ? std::string(plane_.other) + "\n" : "");
    run(cycle, with(call, {{"_DMODE", byCall ? static_cast<double>(plane_.dmode) : 0.0}}), {}, before);
    EXPECT_EQ(control.plane, std::stoi(std::string(byCall ? plane_.other : plane_.name).substr(1)));
  }

private:
  static simulation::Truth headed(simulation::Truth truth, const Plane& working) {
    truth.tools[0].shankDirection = Vector3::Unit(working.third);
    return truth;
  }
  const Plane& plane_;
};

TEST(OtherPlanes, HolesSpigotsSegmentsEdgesAndCorners) {
  Planter plant(18);
  for (const Plane& plane : planes) {
    for (const bool byCall : {false, true}) {
      SCOPED_TRACE(fmt::format("{} by call {}", plane.name, byCall));
      const Vector3 error(plant.number(-0.8, 0.8), plant.number(-0.8, 0.8), 0);
      const double angle = plant.number(-2, 2);
      const Pose part = translation(origin) * poseOf(plane) * translation(error);
      const auto seen = [&](SinumerikBench& bench, const Pose& pose) {
        return Vector3(poseOf(plane).linear().transpose() * inWorkpiece(bench, pose.translation()));
      };
      {
        simulation::Truth truth = perfectWorld();
        place(truth, simulation::Ring(20, 60, -50), part);
        HorizontalBench bench(truth, plane);
        bench.measure("CYCLE977", {{"S_MVAR", 101}, {"S_KNUM", 1}, {"S_SETV", 40}, {"S_FA", 5}, {"S_TSA", 2}}, 0, 0,
                      -10, byCall);
        EXPECT_NEAR(bench.ovr(4), 40, 1e-7);
        EXPECT_NEAR(bench.ovr(5), error.x(), 1e-7);
        EXPECT_NEAR(bench.ovr(6), error.y(), 1e-7);
        EXPECT_NEAR(seen(bench, part).head<2>().norm(), 0, 1e-7);
      }
      {
        simulation::Truth truth = perfectWorld();
        place(truth, simulation::RoundBar(20, -50, 0), part);
        HorizontalBench bench(truth, plane);
        bench.measure("CYCLE979",
                      {{"S_MVAR", 102}, {"S_KNUM", 10001}, {"S_SETV", 40}, {"S_FA", 5}, {"S_TSA", 2}, {"S_INCA", 60}},
                      32, 0, -10, byCall);
        EXPECT_NEAR(bench.ovr(4), 40, 1e-7);
        EXPECT_NEAR(seen(bench, part).head<2>().norm(), 0, 1e-7);
      }
      {
        simulation::Truth truth = perfectWorld();
        place(truth, simulation::Box({0, -50, -50}, {60, 60, 0}), part * rotation(Vector3::UnitZ(), angle));
        HorizontalBench bench(truth, plane);
        bench.measure(
            "CYCLE998",
            {{"S_MVAR", 100105}, {"S_KNUM", 1}, {"S_FA", 8}, {"S_TSA", 5}, {"S_MA", 201}, {"S_MD", 1}, {"S_ID", 40}},
            -12, -15, -10, byCall);
        EXPECT_NEAR(bench.ovr(4), angle, 1e-7);
      }
      {
        const Pose corner = part * rotation(Vector3::UnitZ(), angle);
        simulation::Truth truth = perfectWorld();
        place(truth, simulation::Box({0, 0, -50}, {80, 80, 0}), corner);
        HorizontalBench bench(truth, plane);
        bench.measure("CYCLE961",
                      {{"S_MVAR", 106},
                       {"S_KNUM", 1},
                       {"S_SETV0", 20},
                       {"S_SETV1", 60},
                       {"S_SETV2", 40},
                       {"S_SETV4", -12},
                       {"S_SETV5", -12},
                       {"S_FA", 12},
                       {"S_TSA", 5}},
                      -12, -12, -10, byCall);
        EXPECT_NEAR(bench.ovr(4), angle, 1e-7);
        EXPECT_NEAR(seen(bench, corner).head<2>().norm(), 0, 1e-7);
      }
      {
        simulation::Truth truth = perfectWorld();
        const Pose ball = part * translation({0, 0, 0.4});
        place(truth, simulation::SolidSphere(Vector3::Zero(), 15), ball);
        HorizontalBench bench(truth, plane);
        bench.measure("CYCLE997",
                      {{"S_MVAR", 101119}, {"S_KNUM", 1}, {"S_SETV", 30}, {"S_FA", 5}, {"S_TSA", 2}, {"S_INCA", 90}}, 0,
                      0, 25, byCall);
        EXPECT_NEAR(seen(bench, ball).norm(), 0, 1e-6);
      }
    }
  }
}

}  // namespace
}  // namespace probewright
