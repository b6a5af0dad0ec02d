#include "meant.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "simulation/cad_solid.hpp"

namespace probewright::simulation::testing {

Distance nearestOf(std::vector<Distance> all) {
  return [all = std::move(all)](const Vector3& p) {
    double nearest = 1e300;
    for (const Distance& distance : all)
      nearest = std::min(nearest, distance(p));
    return nearest;
  };
}

Distance distanceOfBlock(const Vector3& size, const Pose& pose) {
  const Pose back = pose.inverse();
  return [size, back](const Vector3& p) {
    const Vector3 out = (back * p).cwiseAbs() - size / 2;
    if (out.maxCoeff() <= 0) return -out.maxCoeff();
    return out.cwiseMax(0).norm();
  };
}

Distance distanceOfShell(double radius, double z0, double z1, double u0, double u1, const Pose& pose) {
  const Pose back = pose.inverse();
  return [=](const Vector3& p) {
    const Vector3 q = back * p;
    const double z = std::clamp(q.z(), z0, z1);
    double u = std::atan2(q.y(), q.x());
    u += 2 * std::numbers::pi * std::ceil((u0 - u) / (2 * std::numbers::pi));
    double nearest = 1e300;
    const auto to = [&](double angle) {
      return (q - Vector3(radius * std::cos(angle), radius * std::sin(angle), z)).norm();
    };
    if (u <= u1) nearest = to(u);
    return std::min({nearest, to(u0), to(u1)});
  };
}

void expectAsMeant(const std::string& name, const Solid& solid, const Distance& distance, double size,
                   const Vector3& middle, std::mt19937_64& random, int ways) {
  int contacts = 0, wrong = 0;
  for (int i = 0; i < ways && wrong < 3; ++i) {
    // Most of a box about a part is empty: of some places the one nearest to what is meant.
    Vector3 aim = middle + randomPoint(random, 0.6 * size);
    for (int k = 0; k < 12; ++k) {
      const Vector3 other = middle + randomPoint(random, 0.6 * size);
      if (distance(other) < distance(aim)) aim = other;
    }
    Vector3 from = middle + 1.5 * size * randomDirection(random);
    if (i % 3 == 0) {
      from = aim;
      from[i % 9 / 3] += (i % 2 == 0 ? 2 : -2) * size;
    }
    const Vector3 to = from + uniform(random, 0.6, 1.8) * (aim - from);
    const double radius = uniform(random, 0.01, 0.08) * size;
    if (distance(from) < radius + 1e-6) continue;
    const auto expected = walkToContact(distance, from, to, radius);
    if (expected && std::isnan(*expected)) continue;
    const auto contact = solid.firstContact(from, to, radius);
    const double way = contact ? contact->fraction * (to - from).norm() : -1;
    if (expected) ++contacts;
    if (expected && contact && std::abs(way - *expected) < 2e-6) continue;
    if (!expected && !contact) continue;
    // Who merely grazes may be told apart by less than the accuracy.
    if (contact && std::abs(distance(contact->ballCentre) - radius) < 1e-6 && (!expected || way > *expected - 1e-3)) {
      Vector3 deepest = from;
      double least = 1e9;
      for (int k = 0; k <= 4000; ++k) {
        const Vector3 p = from + k / 4000.0 * (contact->ballCentre - from);
        if (distance(p) < least) least = distance(p), deepest = p;
      }
      if (least > radius - 1e-6) continue;
    }
    ++wrong;
    ADD_FAILURE() << name << ", way " << i << " from " << from.transpose() << " to " << to.transpose() << " radius "
                  << radius << ": ends after " << way << ", should after " << expected.value_or(-1)
                  << (contact ? fmt::format(", {:.3g} mm too far from what is meant",
                                            distance(contact->ballCentre) - radius)
                              : "");
  }
  EXPECT_GT(contacts, ways / 10) << name;
}

void expectStepAsMeant(const std::string& name, const std::string& text, const Distance& distance, double size,
                       const Vector3& middle, std::mt19937_64& random, int ways) {
  const ScratchFolder folder;
  const auto solid = readStep(folder.write("part.step", text));
  ASSERT_TRUE(solid) << name << ": " << format(solid.error());
  expectAsMeant(name, **solid, distance, size, middle, random, ways);
}

std::string saidOf(const std::string& text) {
  const ScratchFolder folder;
  const auto solid = readStep(folder.write("part.step", text));
  if (!solid) return format(solid.error());
  std::string all;
  for (const Diagnostic& remark : dynamic_cast<const CadSolid&>(**solid).remarks())
    all += format(remark) + "\n";
  return all;
}

}  // namespace probewright::simulation::testing
