#include "adapter/line_queue.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

/// What an adapter gets of the lines of a program: many at a time, and short ones joined if it wants that.
namespace probewright::adapter {
namespace {

using machine::AxisPositions;
using Clock = LineQueue::Clock;

struct Line {
  std::size_t number = 0;
  double feed = 0;
  AxisPositions to;
};

machine::MachineDescription machineWith(std::size_t linear, std::size_t rotary) {
  machine::MachineDescription machine;
  for (std::size_t i = 0; i < linear + rotary; ++i)
    machine.axes.push_back({.name = std::string(1, "XYZABC"[i]),
                            .kind = i < linear ? machine::AxisKind::Linear : machine::AxisKind::Rotary});
  return machine;
}

/// What is sent of a program that begins at the origin, in one message.
std::vector<Line> sent(const std::vector<Line>& program, std::size_t axes, LineQueue queue) {
  AxisPositions at;
  const Clock::time_point now{};
  for (const Line& line : program) {
    queue.add(line.number, line.feed, at, line.to, now);
    at = line.to;
  }
  const std::vector<double> numbers = queue.take(LineQueue::Next::AnotherOrder);
  EXPECT_TRUE(queue.empty());
  std::vector<Line> lines;
  for (std::size_t i = 0; i + axes + 1 < numbers.size(); i += axes + 2) {
    Line line{static_cast<std::size_t>(numbers[i]), numbers[i + 1], {}};
    std::copy_n(numbers.begin() + static_cast<std::ptrdiff_t>(i) + 2, axes, line.to.values.begin());
    lines.push_back(line);
  }
  return lines;
}

double distance(const AxisPositions& point, const AxisPositions& a, const AxisPositions& b) {
  double least = 1e9;
  // By brute force: the nearest of many points between.
  for (int i = 0; i <= 2000; ++i) {
    double square = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      square += std::pow(a[axis] + (b[axis] - a[axis]) * i / 2000.0 - point[axis], 2);
    least = std::min(least, std::sqrt(square));
  }
  return least;
}

std::vector<Line> arc(double radius, double pitch, int lines, double feed) {
  std::vector<Line> program;
  for (int i = 1; i <= lines; ++i) {
    const double angle = i * pitch / radius;
    program.push_back(
        {static_cast<std::size_t>(i), feed, {{radius * std::sin(angle), radius * (1 - std::cos(angle)), 0}}});
  }
  return program;
}

TEST(LineQueue, LeavesLinesAsTheyAreUnlessTheyAreToBeJoined) {
  const std::vector<Line> program = arc(30, 0.02, 500, 1000);
  const std::vector<Line> lines = sent(program, 3, LineQueue(machineWith(3, 0), 0));
  ASSERT_EQ(lines.size(), program.size());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    EXPECT_EQ(lines[i].number, program[i].number);
    EXPECT_EQ(lines[i].to, program[i].to);
  }
}

/// A chord leaves an arc by s = c^2 / (8 r).
TEST(LineQueue, JoinsShortLinesOfAnArcToChordsOfTheHeightAllowed) {
  constexpr double radius = 30, tolerance = 0.01, pitch = 0.02;
  const std::vector<Line> lines = sent(arc(radius, pitch, 3000, 1000), 3, LineQueue(machineWith(3, 0), tolerance));
  const double chord = std::floor(std::sqrt(8 * radius * tolerance) / pitch) * pitch;
  EXPECT_NEAR(static_cast<double>(lines.size()), std::ceil(3000 * pitch / chord), 1);
  EXPECT_EQ(lines.back().number, 3000U) << "the end of the contour stays";
}

TEST(LineQueue, PassesEveryPointOfRandomWaysWithinTheDistance) {
  std::mt19937 random(14);
  std::uniform_real_distribution<double> step(-0.02, 0.06), turn(-0.15, 0.15), chance(0, 1);
  for (const double tolerance : {0.002, 0.01, 0.05}) {
    std::vector<Line> program;
    AxisPositions at;
    double heading = 0, feed = 500;
    for (std::size_t i = 1; i <= 2000; ++i) {
      heading += chance(random) < 0.02 ? std::numbers::pi : turn(random);
      const double length = step(random);
      at[0] += length * std::cos(heading);
      at[1] += length * std::sin(heading);
      at[2] += chance(random) < 0.1 ? step(random) : 0;
      if (chance(random) < 0.01) feed = chance(random) < 0.5 ? 0 : 1000 * chance(random) + 1;
      program.push_back({i, feed, at});
    }
    const std::vector<Line> lines = sent(program, 3, LineQueue(machineWith(3, 0), tolerance));
    ASSERT_FALSE(lines.empty());
    EXPECT_LT(lines.size(), program.size());
    EXPECT_EQ(lines.back().to, program.back().to);
    AxisPositions from;
    std::size_t next = 0;
    for (const Line& line : lines) {
      std::size_t points = 0;
      for (; next < program.size() && program[next].number <= line.number; ++next, ++points) {
        ASSERT_LE(distance(program[next].to, from, line.to), tolerance + 1e-3 * tolerance) << next;
        ASSERT_EQ(program[next].feed, line.feed) << "lines of different feeds are not joined";
      }
      EXPECT_TRUE(line.feed > 0 || points == 1) << "rapid moves are not joined";
      EXPECT_EQ(program[next - 1].to, line.to) << "the ends are points of the program";
      from = line.to;
    }
    EXPECT_EQ(next, program.size());
  }
}

TEST(LineQueue, LeavesLinesThatTurnRotaryAxesAsTheyAre) {
  std::vector<Line> program = arc(30, 0.02, 400, 1000);
  for (std::size_t i = 0; i < program.size(); ++i)
    program[i].to[4] = i < 200 ? 0.001 * static_cast<double>(i + 1) : 0.2;
  const std::vector<Line> lines = sent(program, 5, LineQueue(machineWith(3, 2), 0.01));
  ASSERT_GT(lines.size(), 200U);
  for (std::size_t i = 0; i < 200; ++i)
    ASSERT_EQ(lines[i].number, i + 1);
  EXPECT_LT(lines.size(), 205U) << "where they stand, lines are joined";
}

TEST(LineQueue, SendsTheFirstLinesSoonAndLaterOnesManyAtATime) {
  LineQueue queue(machineWith(3, 0), 0);
  Clock::time_point now{};
  const auto held = [&] {
    const Clock::time_point begin = now;
    while (true) {
      queue.add(1, 100, {}, {{1, 0, 0}}, now);
      if (queue.isDue(now)) break;
      now += std::chrono::microseconds(500);
    }
    return now - begin;
  };
  EXPECT_FALSE(queue.isDue(now));
  EXPECT_LE(held(), std::chrono::milliseconds(3));
  for (int i = 0; i < 10; ++i) {
    queue.take(LineQueue::Next::MoreLines);
    held();
  }
  queue.take(LineQueue::Next::MoreLines);
  EXPECT_GE(held(), std::chrono::milliseconds(50));
  queue.take(LineQueue::Next::AnotherOrder);
  EXPECT_LE(held(), std::chrono::milliseconds(3)) << "after another order the axes wait again";
}

}  // namespace
}  // namespace probewright::adapter
