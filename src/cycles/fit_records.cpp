#include "cycles/fit_records.hpp"

#include <array>
#include <utility>

namespace probewright::cycles {
namespace {

/// `members` are the rows of the covariance that count, in their order.
template <class Fit, std::size_t N>
control::FitRecord record(const char* shape, const Fit& fit, std::vector<std::size_t> touches,
                          const std::array<std::pair<int, std::string_view>, N>& members) {
  control::FitRecord made{.shape = shape,
                          .touches = std::move(touches),
                          .residuals = fit.residuals,
                          .formDeviation = fit.formDeviation,
                          .degreesOfFreedom = fit.degreesOfFreedom,
                          .members = {},
                          .cofactors = {}};
  for (const auto& [row, name] : members) {
    made.members.push_back(name);
    for (const auto& [column, other] : members)
      made.cofactors.push_back(fit.covariance(row, column));
  }
  return made;
}

using Member = std::pair<int, std::string_view>;

}  // namespace

control::FitRecord recordOf(const metrology::Line2Fit& fit, std::vector<std::size_t> touches) {
  return record("line", fit, std::move(touches),
                std::array{Member{0, "point.main"}, Member{1, "point.minor"}, Member{2, "direction.main"},
                           Member{3, "direction.minor"}});
}

control::FitRecord recordOf(const metrology::Circle2Fit& fit, std::vector<std::size_t> touches) {
  return record("circle", fit, std::move(touches),
                std::array{Member{0, "centre.main"}, Member{1, "centre.minor"}, Member{2, "radius"}});
}

control::FitRecord recordOf(const metrology::CircleFit& fit, std::vector<std::size_t> touches) {
  return record("circle", fit, std::move(touches),
                std::array{Member{0, "centre.main"}, Member{1, "centre.minor"}, Member{6, "radius"}});
}

control::FitRecord recordOf(const metrology::PlaneFit& fit, std::vector<std::size_t> touches) {
  return record("plane", fit, std::move(touches),
                std::array{Member{0, "point.main"}, Member{1, "point.minor"}, Member{2, "point.tool"},
                           Member{3, "normal.main"}, Member{4, "normal.minor"}, Member{5, "normal.tool"}});
}

control::FitRecord recordOf(const metrology::SphereFit& fit, std::vector<std::size_t> touches) {
  return record(
      "sphere", fit, std::move(touches),
      std::array{Member{0, "centre.main"}, Member{1, "centre.minor"}, Member{2, "centre.tool"}, Member{3, "radius"}});
}

void noteLine(control::Journal& journal, std::span<const Vector2> points, std::vector<std::size_t> touches) {
  if (const auto fit = metrology::fitLine(points, withCofactors)) journal.fit(recordOf(*fit, std::move(touches)));
}

void notePlane(control::Journal& journal, std::span<const Vector3> points, std::vector<std::size_t> touches) {
  if (const auto fit = metrology::fitPlane(points, withCofactors)) journal.fit(recordOf(*fit, std::move(touches)));
}

void noteSphere(control::Journal& journal, std::span<const Vector3> points, std::vector<std::size_t> touches) {
  if (const auto fit = metrology::fitSphere(points, withCofactors)) journal.fit(recordOf(*fit, std::move(touches)));
}

}  // namespace probewright::cycles
