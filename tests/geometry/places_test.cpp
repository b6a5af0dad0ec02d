#include "geometry/places.hpp"

#include <gtest/gtest.h>

#include <tuple>
#include <type_traits>

namespace probewright {
namespace {

using All = std::tuple<Vector3, MachineWay, ProgramWay, PlaneWay, MachinePlace, ProgramPlace, PlanePlace, BallCentre,
                       PartPoint, PartInProgram, PartInMachine>;

template <class From, class To>
constexpr bool becomes = std::is_convertible_v<From, To> || std::is_assignable_v<To&, From>;

/// How many of all types an argument of type `To` takes.
template <class To, class... Types>
constexpr int takenBy(std::type_identity<std::tuple<Types...>>) {
  return (static_cast<int>(becomes<Types, To>) + ...);
}

template <class A, class B>
concept Subtracts = requires(A a, B b) {
  a - b;
};
template <class A, class B>
concept Adds = requires(A a, B b) {
  a + b;
};

TEST(Places, NoneStandsForAnother) {
  constexpr std::type_identity<All> all;
  EXPECT_EQ(takenBy<MachineWay>(all), 1);
  EXPECT_EQ(takenBy<ProgramWay>(all), 1);
  EXPECT_EQ(takenBy<PlaneWay>(all), 1);
  EXPECT_EQ(takenBy<MachinePlace>(all), 1);
  EXPECT_EQ(takenBy<ProgramPlace>(all), 1);
  EXPECT_EQ(takenBy<PlanePlace>(all), 1);
  EXPECT_EQ(takenBy<BallCentre>(all), 1);
  EXPECT_EQ(takenBy<PartPoint>(all), 1);
  EXPECT_EQ(takenBy<PartInProgram>(all), 1);
  EXPECT_EQ(takenBy<PartInMachine>(all), 1);
  EXPECT_EQ(takenBy<Vector3>(all), 1);
}

TEST(Places, MeetOnlyWhatCountsAlongTheSameAxes) {
  EXPECT_TRUE((Subtracts<BallCentre, BallCentre>));
  EXPECT_FALSE((Subtracts<BallCentre, PartPoint>)) << "the centre of the ball is not what it touches";
  EXPECT_FALSE((Subtracts<ProgramPlace, MachinePlace>));
  EXPECT_FALSE((Subtracts<PartPoint, PartInProgram>));
  EXPECT_TRUE((Adds<ProgramPlace, ProgramWay>));
  EXPECT_FALSE((Adds<ProgramPlace, PlaneWay>));
  EXPECT_FALSE((Adds<ProgramPlace, ProgramPlace>)) << "the sum of two places is no place";
  EXPECT_FALSE((Adds<ProgramPlace, Vector3>));
}

TEST(Places, WaysLeadFromOneToTheOther) {
  const BallCentre ball(1, 2, 3);
  const PartPoint surface = partAt(ball, 2.5 * PlaneWay::unit(0));
  EXPECT_EQ(surface.vector(), Vector3(3.5, 2, 3));
  EXPECT_EQ(ballAt(surface, -2.5 * PlaneWay::unit(0)).vector(), ball.vector());
  EXPECT_EQ(tipAt(ball, PlaneWay(0, 0, -2)).vector(), Vector3(1, 2, 1));
  EXPECT_EQ((BallCentre(4, 6, 3) - ball).norm(), 5);
  EXPECT_EQ((BallCentre(4, 6, 9) - ball).inPlane(), Vector2(3, 4));
}

}  // namespace
}  // namespace probewright
