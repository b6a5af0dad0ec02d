#include "simulation/spline_net.hpp"

#include <Eigen/Dense>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <algorithm>
#include <cmath>

#include "simulation/cad_vectors.hpp"
#include "simulation/local_net.hpp"

namespace probewright::simulation {
namespace {

using Pole = LocalNet::Pole;
constexpr double kNoBound = 1e300;

/// From the functions of a degree less to those of `degree`, and to the slopes of the new ones.
void raise(const double* knots, double t, int degree, const double* values, double* raised, double* slopes) {
  raised[0] = slopes[0] = 0;
  for (int r = 0; r < degree; ++r) {
    const double right = knots[r + 1], left = knots[r + 1 - degree];
    const double share = values[r] / (right - left);
    raised[r] += (right - t) * share;
    raised[r + 1] = (t - left) * share;
    slopes[r] -= degree * share;
    slopes[r + 1] = degree * share;
  }
}

}  // namespace

/// Those of a piece and of its derivatives, by u, v, uu, uv, vv, uuu, uuv, uvv and vvv; kept from piece to piece.
struct SplineNet::Nets {
  LocalNet net, u, v, uu, uv, vv, uuu, uuv, uvv, vvv;
};

double SplineNet::Along::within(double parameter) const {
  if (period <= 0 || (parameter >= ends.front() && parameter <= ends.back())) return parameter;
  return parameter - period * std::floor((parameter - ends.front()) / period);
}

std::size_t SplineNet::Along::pieceAt(double parameter) const {
  const auto next = std::upper_bound(ends.begin() + 1, ends.end() - 1, parameter);
  return static_cast<std::size_t>(next - ends.begin()) - 1;
}

std::optional<double> SplineNet::Along::kinkBetween(double low, double high) const {
  if (kinks.empty()) return std::nullopt;
  const double slack = 1e-12 * (ends.back() - ends.front());
  for (double at : kinks) {
    if (period > 0) at += period * std::ceil((low + slack - at) / period);
    if (at > low + slack && at < high - slack) return at;
  }
  return std::nullopt;
}

SplineNet::Along SplineNet::along(const TColStd_Array1OfReal& knots, const TColStd_Array1OfInteger& multiplicities,
                                  int degree) {
  Along made;
  made.degree = degree;
  const int last = knots.Upper();
  for (int i = knots.Lower(); i <= last; ++i)
    made.knots.insert(made.knots.end(), static_cast<std::size_t>(multiplicities(i)), knots(i));
  const int count = static_cast<int>(made.knots.size());
  for (int k = degree; k + degree + 1 < count; ++k) {
    const double from = made.knots[static_cast<std::size_t>(k)];
    if (!(from < made.knots[static_cast<std::size_t>(k + 1)])) continue;
    int times = 1;
    while (k >= times && made.knots[static_cast<std::size_t>(k - times)] == from)
      ++times;
    made.pieces.push_back(k);
    made.ends.push_back(from);
    made.continuity.push_back(degree - times);
  }
  made.ends.push_back(made.knots[static_cast<std::size_t>(count - 1 - degree)]);
  for (std::size_t i = 1; i < made.pieces.size(); ++i) {
    if (made.continuity[i] < 1) made.kinks.push_back(made.ends[i]);
  }
  return made;
}

std::optional<SplineNet> SplineNet::of(const Handle(Geom_BSplineSurface) & surface) {
  Handle(Geom_BSplineSurface) open = surface;
  if (surface->IsUPeriodic() || surface->IsVPeriodic()) {
    open = Handle(Geom_BSplineSurface)::DownCast(surface->Copy());
    open->SetUNotPeriodic();
    open->SetVNotPeriodic();
  }
  SplineNet net;
  net.u_ = along(open->UKnots(), open->UMultiplicities(), open->UDegree());
  net.v_ = along(open->VKnots(), open->VMultiplicities(), open->VDegree());
  if (surface->IsUPeriodic()) net.u_.close(surface->UPeriod(), surface->UMultiplicity(surface->FirstUKnotIndex()));
  if (surface->IsVPeriodic()) net.v_.close(surface->VPeriod(), surface->VMultiplicity(surface->FirstVKnotIndex()));
  net.rational_ = open->IsURational() || open->IsVRational();
  net.columns_ = open->NbVPoles();
  for (int i = 1; i <= open->NbUPoles(); ++i) {
    for (int j = 1; j <= open->NbVPoles(); ++j) {
      // OpenCASCADE has weights of 0 for splines without weights that it has opened.
      const double weight = net.rational_ ? open->Weight(i, j) : 1;
      if (!(weight > 0)) return std::nullopt;
      net.add(vector(open->Pole(i, j)), weight);
    }
  }
  net.findBends();
  return net;
}

std::optional<SplineNet> SplineNet::of(const Handle(Geom_BSplineCurve) & curve) {
  Handle(Geom_BSplineCurve) open = curve;
  if (curve->IsPeriodic()) {
    open = Handle(Geom_BSplineCurve)::DownCast(curve->Copy());
    open->SetNotPeriodic();
  }
  SplineNet net;
  net.u_ = along(open->Knots(), open->Multiplicities(), open->Degree());
  if (curve->IsPeriodic()) net.u_.close(curve->Period(), curve->Multiplicity(curve->FirstUKnotIndex()));
  net.v_ = {0, {0, 1}, {0}, {-1e100, 1e100}, {0}, {}, 0};
  net.rational_ = open->IsRational();
  for (int i = 1; i <= open->NbPoles(); ++i) {
    const double weight = net.rational_ ? open->Weight(i) : 1;
    if (!(weight > 0)) return std::nullopt;
    net.add(vector(open->Pole(i)), weight);
  }
  net.findBends();
  return net;
}

void SplineNet::Along::close(double turn, int multiplicity) {
  period = turn;
  continuity.front() = degree - multiplicity;
  if (continuity.front() < 1) kinks.push_back(ends.front());
}

void SplineNet::add(const Vector3& point, double weight) {
  Pole pole;
  pole << weight * point, weight;
  poles_.push_back(pole);
}

void SplineNet::findFunctions(const Along& along, int k, double t, Functions& f) {
  const int degree = along.degree;
  const double* const knots = along.knots.data() + k;
  if (degree == 0) {
    f.value[0] = 1, f.first[0] = f.second[0] = 0;
    return;
  }
  // Of the degrees below: the functions, and of the last but one their slopes.
  std::array<double, kMostDegree + 1> a, b, slopes, unused;
  a[0] = 1;
  slopes[0] = 0;
  for (int d = 1; d < degree; ++d) {
    raise(knots, t, d, a.data(), b.data(), slopes.data());
    std::copy_n(b.begin(), d + 1, a.begin());
  }
  raise(knots, t, degree, a.data(), f.value.data(), f.first.data());
  raise(knots, t, degree, slopes.data(), unused.data(), f.second.data());
}

void SplineNet::findValues(const Along& along, int k, double t, Functions& f) {
  const double* const knots = along.knots.data() + k;
  f.value[0] = 1;
  for (int degree = 1; degree <= along.degree; ++degree) {
    double carried = 0;
    for (int r = 0; r < degree; ++r) {
      const double right = knots[r + 1], left = knots[r + 1 - degree];
      const auto place = static_cast<std::size_t>(r);
      const double share = f.value[place] / (right - left);
      f.value[place] = carried + (right - t) * share;
      carried = (t - left) * share;
    }
    f.value[static_cast<std::size_t>(degree)] = carried;
  }
}

SurfacePoint SplineNet::at(const Vector2& parameters) const {
  const double tu = u_.within(parameters.x()), tv = v_.within(parameters.y());
  const int ku = u_.pieces[u_.pieceAt(tu)], kv = v_.pieces[v_.pieceAt(tv)];
  Functions fu, fv;
  findFunctions(u_, ku, tu, fu);
  findFunctions(v_, kv, tv, fv);
  Pole s = Pole::Zero(), su = s, sv = s, suu = s, suv = s, svv = s;
  for (int i = 0; i <= u_.degree; ++i) {
    Pole row = Pole::Zero(), rowV = row, rowVV = row;
    const Pole* const poles = &pole(ku - u_.degree + i, kv - v_.degree);
    for (int j = 0; j <= v_.degree; ++j) {
      const auto k = static_cast<std::size_t>(j);
      row += fv.value[k] * poles[j];
      rowV += fv.first[k] * poles[j];
      rowVV += fv.second[k] * poles[j];
    }
    const auto k = static_cast<std::size_t>(i);
    s += fu.value[k] * row;
    su += fu.first[k] * row;
    suu += fu.second[k] * row;
    sv += fu.value[k] * rowV;
    suv += fu.first[k] * rowV;
    svv += fu.value[k] * rowVV;
  }
  SurfacePoint p{s.head<3>(), su.head<3>(), sv.head<3>(), suu.head<3>(), suv.head<3>(), svv.head<3>()};
  if (!rational_) return p;
  const double w = s.w();
  p.point /= w;
  p.u = (p.u - su.w() * p.point) / w;
  p.v = (p.v - sv.w() * p.point) / w;
  p.uu = (p.uu - 2 * su.w() * p.u - suu.w() * p.point) / w;
  p.uv = (p.uv - su.w() * p.v - sv.w() * p.u - suv.w() * p.point) / w;
  p.vv = (p.vv - 2 * sv.w() * p.v - svv.w() * p.point) / w;
  return p;
}

SurfaceBends SplineNet::bendsOf(int ku, int kv, Nets& nets) {
  auto& [net, u, v, uu, uv, vv, uuu, uuv, uvv, vvv] = nets;
  net.resize(u_.degree + 1, v_.degree + 1);
  Vector3 middle = Vector3::Zero();
  double least = kNoBound, most = 0;
  for (int i = 0; i <= u_.degree; ++i) {
    for (int j = 0; j <= v_.degree; ++j) {
      net.at(i, j) = pole(ku - u_.degree + i, kv - v_.degree + j);
      least = std::min(least, net.at(i, j).w());
      most = std::max(most, net.at(i, j).w());
      middle += net.at(i, j).head<3>() / net.at(i, j).w() / ((u_.degree + 1) * (v_.degree + 1));
    }
  }
  constexpr double kUneven = 6;
  isUneven_ = isUneven_ || most > kUneven * least;
  // Derivatives do not depend on the zero point; quotients have smaller bounds about one within.
  double reach = 0;
  for (int i = 0; i <= u_.degree; ++i) {
    for (int j = 0; j <= v_.degree; ++j) {
      net.at(i, j).head<3>() -= net.at(i, j).w() * middle;
      reach = std::max(reach, net.at(i, j).head<3>().norm() / net.at(i, j).w());
    }
  }
  u.differentiateU(net, u_.knots, ku);
  v.differentiateV(net, v_.knots, kv);
  uu.differentiateU(u, u_.knots, ku);
  uv.differentiateV(u, v_.knots, kv);
  vv.differentiateV(v, v_.knots, kv);
  uuu.differentiateU(uu, u_.knots, ku);
  uuv.differentiateV(uu, v_.knots, kv);
  uvv.differentiateU(vv, u_.knots, ku);
  vvv.differentiateV(vv, v_.knots, kv);
  SurfaceBends b{u.size(), v.size(), uu.size(), uv.size(), vv.size(), uuu.size(), uuv.size(), uvv.size(), vvv.size()};
  if (!rational_) return b;
  // The rule for quotients, each term by its bound.
  const double wu = u.weight(), wv = v.weight(), wuu = uu.weight(), wuv = uv.weight(), wvv = vv.weight();
  b.u = (b.u + wu * reach) / least;
  b.v = (b.v + wv * reach) / least;
  b.uu = (b.uu + 2 * wu * b.u + wuu * reach) / least;
  b.uv = (b.uv + wu * b.v + wv * b.u + wuv * reach) / least;
  b.vv = (b.vv + 2 * wv * b.v + wvv * reach) / least;
  b.uuu = (b.uuu + 3 * wu * b.uu + 3 * wuu * b.u + uuu.weight() * reach) / least;
  b.uuv = (b.uuv + wv * b.uu + 2 * wu * b.uv + 2 * wuv * b.u + wuu * b.v + uuv.weight() * reach) / least;
  b.uvv = (b.uvv + wu * b.vv + 2 * wv * b.uv + 2 * wuv * b.v + wvv * b.u + uvv.weight() * reach) / least;
  b.vvv = (b.vvv + 3 * wv * b.vv + 3 * wvv * b.v + vvv.weight() * reach) / least;
  return b;
}

void SplineNet::findBends() {
  bends_.reserve(u_.pieces.size() * v_.pieces.size());
  Nets nets;
  for (const int ku : u_.pieces) {
    for (const int kv : v_.pieces) {
      bends_.push_back(bendsOf(ku, kv, nets));
      most_.widen(bends_.back());
    }
  }
  const auto jumps = [](const Along& along) {
    return std::any_of(along.continuity.begin() + (along.period > 0 ? 0 : 1), along.continuity.end(),
                       [](int derivatives) { return derivatives < 2; });
  };
  if (jumps(u_)) most_.uuu = most_.uuv = most_.uvv = kNoBound;
  if (jumps(v_)) most_.uuv = most_.uvv = most_.vvv = kNoBound;
}

SplineNet::Pieces SplineNet::piecesIn(const Along& along, double from, double to) {
  const std::size_t all = along.pieces.size();
  if (along.period > 0 && to - from >= along.period) return {0, all, true};
  const double begin = along.within(from), end = begin + (to - from);
  const bool wraps = along.period > 0 && end > along.ends.back();
  Pieces found{along.pieceAt(begin), 0, false};
  const std::size_t last = along.pieceAt(wraps ? end - along.period : end);
  found.count = (wraps ? last + all : last) - found.first + 1;
  if (found.count > all) found.count = all;
  for (std::size_t i = 1; i < found.count; ++i)
    found.jumps = found.jumps || along.continuity[(found.first + i) % all] < 2;
  return found;
}

SurfaceBends SplineNet::bends(const Vector2& low, const Vector2& high) const {
  const Pieces u = piecesIn(u_, low.x(), high.x()), v = piecesIn(v_, low.y(), high.y());
  constexpr std::size_t kMostPieces = 100;
  if (u.count * v.count > kMostPieces) return most_;
  SurfaceBends found;
  for (std::size_t i = 0; i < u.count; ++i) {
    for (std::size_t j = 0; j < v.count; ++j)
      found.widen(bends_[(u.first + i) % u_.pieces.size() * v_.pieces.size() + (v.first + j) % v_.pieces.size()]);
  }
  if (u.jumps) found.uuu = found.uuv = found.uvv = kNoBound;
  if (v.jumps) found.uuv = found.uvv = found.vvv = kNoBound;
  return found;
}

/// What of an interval of a parameter lies within a piece, moved to where the piece is.
std::pair<double, double> SplineNet::partIn(const Along& along, std::size_t piece, double low, double high) {
  const std::size_t all = along.pieces.size();
  const double from = along.ends[piece % all], to = along.ends[piece % all + 1];
  const double shift = along.within(low) - low + (piece >= all ? -along.period : 0);
  return {std::max(from, low + shift), std::min(to, high + shift)};
}

std::optional<SurfaceCurving> SplineNet::curving(const Vector2& low, const Vector2& high, const Vector3& point,
                                                 const Vector3& normal) const {
  const Pieces u = piecesIn(u_, low.x(), high.x()), v = piecesIn(v_, low.y(), high.y());
  constexpr std::size_t kMostPieces = 6;
  if (u.count * v.count > kMostPieces || kinkAcrossU(low.x(), high.x()) || kinkAcrossV(low.y(), high.y()))
    return std::nullopt;
  static thread_local Nets nets;
  auto& [net, alongU, alongV, uu, uv, vv, uuu, uuv, uvv, vvv] = nets;
  SurfaceCurving found;
  found.leastWeight = kNoBound, found.mostWeight = 0;
  for (std::size_t m = 0; m < u.count; ++m) {
    const int ku = u_.pieces[(u.first + m) % u_.pieces.size()];
    for (std::size_t n = 0; n < v.count; ++n) {
      const int kv = v_.pieces[(v.first + n) % v_.pieces.size()];
      net.resize(u_.degree + 1, v_.degree + 1);
      for (int i = 0; i <= u_.degree; ++i) {
        for (int j = 0; j <= v_.degree; ++j) {
          Pole& local = net.at(i, j);
          local = pole(ku - u_.degree + i, kv - v_.degree + j);
          local.head<3>() -= local.w() * point;
          found.leastWeight = std::min(found.leastWeight, local.w());
          found.mostWeight = std::max(found.mostWeight, local.w());
        }
      }
      const auto [fromU, toU] = partIn(u_, u.first + m, low.x(), high.x());
      const auto [fromV, toV] = partIn(v_, v.first + n, low.y(), high.y());
      if (!(fromU < toU && fromV < toV)) continue;
      net.restrictU(u_.knots, ku, fromU, toU);
      net.restrictV(v_.knots, kv, fromV, toV);
      alongU.differencesU(net, toU - fromU);
      alongV.differencesV(net, toV - fromV);
      uu.differencesU(alongU, toU - fromU);
      uv.differencesV(alongU, toV - fromV);
      vv.differencesV(alongV, toV - fromV);
      found.riseUu = std::max(found.riseUu, uu.rise(normal).second);
      found.riseVv = std::max(found.riseVv, vv.rise(normal).second);
      const auto [leastUv, mostUv] = uv.rise(normal);
      found.riseUv = std::max({found.riseUv, -leastUv, mostUv});
      found.uu = std::max(found.uu, uu.size());
      found.uv = std::max(found.uv, uv.size());
      found.vv = std::max(found.vv, vv.size());
    }
  }
  return found;
}

Pole SplineNet::weighted(const Vector2& parameters) const {
  const double tu = u_.within(parameters.x()), tv = v_.within(parameters.y());
  const int ku = u_.pieces[u_.pieceAt(tu)], kv = v_.pieces[v_.pieceAt(tv)];
  Functions fu, fv;
  findValues(u_, ku, tu, fu);
  findValues(v_, kv, tv, fv);
  Pole sum = Pole::Zero();
  for (int i = 0; i <= u_.degree; ++i) {
    Pole row = Pole::Zero();
    const Pole* const poles = &pole(ku - u_.degree + i, kv - v_.degree);
    for (int j = 0; j <= v_.degree; ++j)
      row += fv.value[static_cast<std::size_t>(j)] * poles[j];
    sum += fu.value[static_cast<std::size_t>(i)] * row;
  }
  return sum;
}

double SplineNet::farthestFrom(const Vector3& origin, const Vector3& axis) const {
  double farthest = 0;
  for (const Pole& pole : poles_)
    farthest = std::max(farthest, axis.cross(pole.head<3>() / pole.w() - origin).norm());
  return farthest;
}

bool SplineNet::covers(const Vector2& low, const Vector2& high) const {
  const auto holds = [](const Along& along, double from, double to) {
    constexpr double kRounding = 1e-12;
    const double slack = kRounding * (along.ends.back() - along.ends.front());
    return along.period > 0 || (from >= along.ends.front() - slack && to <= along.ends.back() + slack);
  };
  return holds(u_, low.x(), high.x()) && holds(v_, low.y(), high.y());
}

}  // namespace probewright::simulation
