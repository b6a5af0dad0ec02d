#include "study/distribution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/distributions/triangular.hpp>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/number_text.hpp"

namespace probewright::study {

namespace {

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

bool finite(std::initializer_list<double> values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value) && std::abs(value) <= 1e12; });
}

/// Why the parameters make no distribution; empty if they do.
std::string whyNot(const Distribution::Kind& kind) {
  const auto limits = [](double minimum, double maximum) -> std::string {
    if (!finite({minimum, maximum})) return "its limits must be finite numbers";
    return minimum < maximum ? std::string() : "its minimum must be less than its maximum";
  };
  return std::visit(
      Overloaded{[](const Normal& d) -> std::string {
                   if (!finite({d.mean, d.deviation})) return "its parameters must be finite numbers";
                   return d.deviation > 0 ? "" : "its standard deviation must be above 0";
                 },
                 [&](const Uniform& d) { return limits(d.minimum, d.maximum); },
                 [&](const Triangular& d) -> std::string {
                   if (const std::string why = limits(d.minimum, d.maximum); !why.empty()) return why;
                   return d.mode >= d.minimum && d.mode <= d.maximum ? "" : "its mode must lie between its limits";
                 },
                 [&](const UShaped& d) { return limits(d.minimum, d.maximum); },
                 [](const Student& d) -> std::string {
                   if (!finite({d.mean, d.scale})) return "its parameters must be finite numbers";
                   if (!(d.scale > 0)) return "its standard deviation must be above 0";
                   return d.degreesOfFreedom > 2 && d.degreesOfFreedom <= 1e9
                              ? ""
                              : "it needs more than 2 degrees of freedom, or it has no standard uncertainty";
                 },
                 [&](const InexactLimits& d) -> std::string {
                   if (const std::string why = limits(d.minimum, d.maximum); !why.empty()) return why;
                   return d.inexactness >= 0 && d.inexactness <= (d.maximum - d.minimum) / 2
                              ? ""
                              : "its inexactness must be at least 0 and at most half of the way between the limits";
                 },
                 [](const Discrete& d) -> std::string {
                   if (d.values.empty() || d.values.size() != d.weights.size())
                     return "it needs values, and as many weights";
                   double sum = 0;
                   for (const double weight : d.weights) {
                     if (!finite({weight}) || weight < 0) return "its weights must not be negative";
                     sum += weight;
                   }
                   for (const double value : d.values)
                     if (!finite({value})) return "its values must be finite numbers";
                   return sum > 0 ? "" : "one of its weights must be above 0";
                 },
                 [](const Samples& d) -> std::string {
                   if (!d.values || d.values->empty()) return "it needs values";
                   for (const double value : *d.values)
                     if (!finite({value})) return "its values must be finite numbers";
                   return "";
                 }},
      kind);
}

double arcsineQuantile(const UShaped& d, double p) {
  return (d.minimum + d.maximum) / 2 - (d.maximum - d.minimum) / 2 * std::cos(std::numbers::pi * p);
}

}  // namespace

Result<Distribution> Distribution::make(Kind kind) {
  if (const std::string why = whyNot(kind); !why.empty()) return fail("this is not a distribution: " + why);
  Distribution made(std::move(kind));
  if (const auto* discrete = std::get_if<Discrete>(&made.kind_)) {
    made.cumulative_.resize(discrete->weights.size());
    std::partial_sum(discrete->weights.begin(), discrete->weights.end(), made.cumulative_.begin());
  }
  made.findMoments();
  return made;
}

Result<Distribution> Distribution::truncated(Kind kind, std::pair<double, double> between) {
  auto made = make(std::move(kind));
  if (!made) return made;
  if (std::holds_alternative<InexactLimits>(made->kind_) || std::holds_alternative<Discrete>(made->kind_) ||
      std::holds_alternative<Samples>(made->kind_))
    return fail(fmt::format("a {} distribution cannot be truncated", made->name()));
  if (!finite({between.first, between.second}) || !(between.first < between.second))
    return fail("the limits of a truncated distribution are two numbers, the lower first");
  made->low_ = made->probabilityBelow(between.first);
  made->high_ = made->probabilityBelow(between.second);
  if (!(made->high_ - made->low_ > 1e-9)) return fail("nearly nothing of the distribution lies between its limits");
  made->findMoments();
  return made;
}

double Distribution::quantile(double p) const {
  p = low_ + p * (high_ - low_);
  p = std::clamp(p, 0x1p-53, 1 - 0x1p-53);
  return std::visit(
      Overloaded{[&](const Normal& d) { return boost::math::quantile(boost::math::normal(d.mean, d.deviation), p); },
                 [&](const Uniform& d) { return d.minimum + p * (d.maximum - d.minimum); },
                 [&](const Triangular& d) {
                   return boost::math::quantile(boost::math::triangular(d.minimum, d.mode, d.maximum), p);
                 },
                 [&](const UShaped& d) { return arcsineQuantile(d, p); },
                 [&](const Student& d) {
                   return d.mean + d.scale * boost::math::quantile(boost::math::students_t(d.degreesOfFreedom), p);
                 },
                 [&](const InexactLimits& d) { return d.minimum + p * (d.maximum - d.minimum); },
                 [&](const Discrete& d) {
                   const auto place = std::ranges::upper_bound(cumulative_, p * cumulative_.back());
                   const auto index = static_cast<std::size_t>(place - cumulative_.begin());
                   return d.values[std::min(index, d.values.size() - 1)];
                 },
                 [&](const Samples& d) {
                   const auto index = static_cast<std::size_t>(p * static_cast<double>(d.values->size()));
                   return (*d.values)[std::min(index, d.values->size() - 1)];
                 }},
      kind_);
}

double Distribution::probabilityBelow(double value) const {
  return std::visit(
      Overloaded{[&](const Normal& d) { return boost::math::cdf(boost::math::normal(d.mean, d.deviation), value); },
                 [&](const Uniform& d) { return std::clamp((value - d.minimum) / (d.maximum - d.minimum), 0.0, 1.0); },
                 [&](const Triangular& d) {
                   if (value <= d.minimum) return 0.0;
                   if (value >= d.maximum) return 1.0;
                   return boost::math::cdf(boost::math::triangular(d.minimum, d.mode, d.maximum), value);
                 },
                 [&](const UShaped& d) {
                   const double middle = (d.minimum + d.maximum) / 2, half = (d.maximum - d.minimum) / 2;
                   return std::acos(std::clamp((middle - value) / half, -1.0, 1.0)) / std::numbers::pi;
                 },
                 [&](const Student& d) {
                   return boost::math::cdf(boost::math::students_t(d.degreesOfFreedom), (value - d.mean) / d.scale);
                 },
                 [](const auto&) { return 0.0; }},
      kind_);
}

double Distribution::value(const std::array<double, 2>& uniforms) const {
  if (const auto* d = std::get_if<InexactLimits>(&kind_)) {
    // JCGM 101, 6.4.3.4.
    const double low = d->minimum - d->inexactness + 2 * d->inexactness * uniforms[0];
    const double high = d->minimum + d->maximum - low;
    return low + (high - low) * uniforms[1];
  }
  return quantile(uniforms[0]);
}

double Distribution::valueOfScore(double score) const {
  if (const auto* normal = std::get_if<Normal>(&kind_); normal != nullptr && !isTruncated())
    return normal->mean + normal->deviation * score;
  return quantile(boost::math::cdf(boost::math::normal(), score));
}

void Distribution::findMoments() {
  if (isTruncated()) {
    boost::math::quadrature::tanh_sinh<double> integrator;
    mean_ = integrator.integrate([&](double p) { return quantile(p); }, 0.0, 1.0, 1e-10);
    const double middle = mean_;
    deviation_ =
        std::sqrt(integrator.integrate([&](double p) { return std::pow(quantile(p) - middle, 2); }, 0.0, 1.0, 1e-10));
    return;
  }
  const auto ofValues = [&](const std::vector<double>& values, const auto& weightOf) {
    double sum = 0, first = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      sum += weightOf(i);
      first += weightOf(i) * values[i];
    }
    mean_ = first / sum;
    double second = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
      second += weightOf(i) * std::pow(values[i] - mean_, 2);
    deviation_ = std::sqrt(second / sum);
  };
  std::visit(Overloaded{[&](const Normal& d) {
                          mean_ = d.mean;
                          deviation_ = d.deviation;
                        },
                        [&](const Uniform& d) {
                          mean_ = (d.minimum + d.maximum) / 2;
                          deviation_ = (d.maximum - d.minimum) / std::sqrt(12.0);
                        },
                        [&](const Triangular& d) {
                          const double a = d.minimum, b = d.maximum, c = d.mode;
                          mean_ = (a + b + c) / 3;
                          deviation_ = std::sqrt((a * a + b * b + c * c - a * b - a * c - b * c) / 18);
                        },
                        [&](const UShaped& d) {
                          mean_ = (d.minimum + d.maximum) / 2;
                          deviation_ = (d.maximum - d.minimum) / std::sqrt(8.0);
                        },
                        [&](const Student& d) {
                          mean_ = d.mean;
                          deviation_ = d.scale * std::sqrt(d.degreesOfFreedom / (d.degreesOfFreedom - 2));
                        },
                        [&](const InexactLimits& d) {
                          mean_ = (d.minimum + d.maximum) / 2;
                          // JCGM 101, equation (6).
                          deviation_ =
                              std::sqrt(std::pow(d.maximum - d.minimum, 2) / 12 + std::pow(d.inexactness, 2) / 9);
                        },
                        [&](const Discrete& d) { ofValues(d.values, [&](std::size_t i) { return d.weights[i]; }); },
                        [&](const Samples& d) { ofValues(*d.values, [](std::size_t) { return 1.0; }); }},
             kind_);
}

double Distribution::estimate() const {
  if (const auto* discrete = std::get_if<Discrete>(&kind_)) {
    const auto most = std::ranges::max_element(discrete->weights) - discrete->weights.begin();
    return discrete->values[static_cast<std::size_t>(most)];
  }
  return mean_;
}

std::string Distribution::name() const {
  static constexpr std::array<const char*, 8> names = {
      "normal", "uniform", "triangular", "U-shaped", "Student", "uniform with inexact limits", "discrete", "samples"};
  static_assert(std::variant_size_v<Kind> == names.size());
  return std::string(isTruncated() ? "truncated " : "") + names[kind_.index()];
}

}  // namespace probewright::study
