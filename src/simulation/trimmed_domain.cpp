#include "simulation/trimmed_domain.hpp"

#include <algorithm>
#include <cmath>

#include "simulation/memory_text.hpp"

namespace probewright::simulation {
namespace {

double wrapped(double value, double low, double period) {
  return period > 0 ? value + period * std::ceil((low - value) / period) : value;
}

/// True if the segment has a point in the box.
bool meets(const TrimmedDomain::Segment& s, const Vector2& low, const Vector2& high) {
  double enters = 0, leaves = 1;
  for (Eigen::Index k = 0; k < 2; ++k) {
    const double way = s.to[k] - s.from[k];
    if (way == 0) {
      if (s.from[k] < low[k] || s.from[k] > high[k]) return false;
      continue;
    }
    const double a = (low[k] - s.from[k]) / way, b = (high[k] - s.from[k]) / way;
    enters = std::max(enters, std::min(a, b));
    leaves = std::min(leaves, std::max(a, b));
  }
  return enters <= leaves;
}

}  // namespace

TrimmedDomain::TrimmedDomain(std::vector<Segment> border, double periodU, double periodV)
    : border_(std::move(border)), periodU_(periodU), periodV_(periodV) {
  low_.setConstant(1e300);
  high_.setConstant(-1e300);
  for (const Segment& s : border_) {
    low_ = low_.cwiseMin(s.from).cwiseMin(s.to);
    high_ = high_.cwiseMax(s.from).cwiseMax(s.to);
  }
  if (border_.empty()) return;
  bands_.resize(std::clamp<std::size_t>(border_.size() / 4, 1, 1024));
  const double height = (high_.y() - low_.y()) / static_cast<double>(bands_.size());
  const auto bandOf = [&](double v) {
    const double band = height > 0 ? std::floor((v - low_.y()) / height) : 0;
    return static_cast<std::size_t>(std::clamp(band, 0.0, static_cast<double>(bands_.size() - 1)));
  };
  for (std::uint32_t i = 0; i < border_.size(); ++i) {
    const double from = border_[i].from.y();
    const double to = border_[i].to.y();
    if (from == to) continue;
    for (std::size_t band = bandOf(std::min(from, to)); band <= bandOf(std::max(from, to)); ++band) {
      bands_[band].push_back(i);
    }
  }
}

bool TrimmedDomain::containsPlain(const Vector2& p) const {
  if ((p - low_).minCoeff() < 0 || (high_ - p).minCoeff() < 0) return false;
  const double height = (high_.y() - low_.y()) / static_cast<double>(bands_.size());
  const double band = height > 0 ? std::floor((p.y() - low_.y()) / height) : 0;
  bool inside = false;
  for (const std::uint32_t i :
       bands_[static_cast<std::size_t>(std::clamp(band, 0.0, static_cast<double>(bands_.size() - 1)))]) {
    const Segment& s = border_[i];
    if ((s.from.y() <= p.y()) == (s.to.y() <= p.y())) continue;
    const double crossing = s.from.x() + (p.y() - s.from.y()) / (s.to.y() - s.from.y()) * (s.to.x() - s.from.x());
    if (crossing > p.x()) inside = !inside;
  }
  return inside;
}

bool TrimmedDomain::contains(const Vector2& parameters) const {
  if (border_.empty()) return true;
  const double firstU = wrapped(parameters.x(), low_.x(), periodU_);
  const double firstV = wrapped(parameters.y(), low_.y(), periodV_);
  // Every image of the point counts: a hole may be drawn in another period than the loop around it.
  bool inside = containsPlain({firstU, firstV});
  if (periodU_ == 0 && periodV_ == 0) return inside;
  const auto further = [](double first, double period, double high) {
    return period > 0 && first + period <= high ? static_cast<int>((high - first) / period) : 0;
  };
  const int moreU = further(firstU, periodU_, high_.x());
  const int moreV = further(firstV, periodV_, high_.y());
  for (int i = 0; i <= moreU; ++i) {
    for (int j = i == 0 ? 1 : 0; j <= moreV; ++j)
      inside ^= containsPlain({firstU + i * periodU_, firstV + j * periodV_});
  }
  return inside;
}

bool TrimmedDomain::crosses(const Vector2& low, const Vector2& high) const {
  return std::any_of(border_.begin(), border_.end(), [&](const Segment& s) { return meets(s, low, high); });
}

bool TrimmedDomain::reaches(const Vector2& low, const Vector2& high) const {
  if (border_.empty() || contains((low + high) / 2)) return true;
  const auto images = [](double from, double to, double first, double last, double period) {
    std::vector<double> shifts;
    if (period <= 0) return std::vector<double>{0};
    for (double n = std::ceil((first - to) / period); from + n * period <= last; ++n)
      shifts.push_back(n * period);
    return shifts;
  };
  for (const double u : images(low.x(), high.x(), low_.x(), high_.x(), periodU_)) {
    for (const double v : images(low.y(), high.y(), low_.y(), high_.y(), periodV_)) {
      if (crosses(low + Vector2(u, v), high + Vector2(u, v))) return true;
    }
  }
  return false;
}

double TrimmedDomain::area() const {
  double twice = 0;
  for (const Segment& s : border_) {
    const Vector2 from = s.from - low_;
    const Vector2 to = s.to - low_;
    twice += from.x() * to.y() - from.y() * to.x();
  }
  return std::abs(twice) / 2;
}

void TrimmedDomain::appendTo(std::string& bytes) const {
  append(bytes, border_);
  append(bytes, periodU_);
  append(bytes, periodV_);
}

std::optional<TrimmedDomain> TrimmedDomain::takeFrom(std::string_view& bytes) {
  std::vector<Segment> border;
  double periodU = 0, periodV = 0;
  if (!take(bytes, border) || !take(bytes, periodU) || !take(bytes, periodV)) return std::nullopt;
  return TrimmedDomain(std::move(border), periodU, periodV);
}

}  // namespace probewright::simulation
