#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRepLib.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_Line.hxx>
#include <Geom_BSplineSurface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "oracle.hpp"
#include "simulation/cad_solid.hpp"

/// Sheets with waves and roughness finer than the ball that meets them, inside and on their borders. A dense search of
/// places of the surface, each of the first ones followed to where it is met soonest, judges the contacts.
namespace probewright::simulation {
namespace {

using namespace testing;

struct Sheet {
  Handle(Geom_BSplineSurface) surface;
  TopoDS_Face face;
  std::function<double(double)> border = [](double) { return -1.0; };  ///< the least v at a u
  double width = 0;
  double wave = 0;  ///< the length of the waves
};

struct Knots {
  Knots(int count, int degree) : values(1, count + 1), multiplicities(1, count + 1) {
    for (int i = 1; i <= count + 1; ++i) {
      values(i) = static_cast<double>(i - 1) / count;
      multiplicities(i) = i == 1 || i == count + 1 ? degree + 1 : 1;
    }
  }
  /// Where each pole counts most.
  std::vector<double> places(int degree) const {
    std::vector<double> full, found;
    for (int i = 1; i <= values.Length(); ++i)
      full.insert(full.end(), static_cast<std::size_t>(multiplicities(i)), values(i));
    const auto steps = static_cast<std::size_t>(degree);
    for (std::size_t i = 0; i + steps + 1 < full.size(); ++i) {
      double sum = 0;
      for (std::size_t k = 1; k <= steps; ++k)
        sum += full[i + k];
      found.push_back(sum / degree);
    }
    return found;
  }
  TColStd_Array1OfReal values;
  TColStd_Array1OfInteger multiplicities;
};

enum class Texture { Waves, Ripples, Rough, Count };

/// The part of a sheet above a wavy line v = f(u).
void cutOff(Sheet& sheet, std::mt19937_64& random, int count) {
  constexpr int kDegree = 3;
  const Knots knots(count, kDegree);
  const std::vector<double> places = knots.places(kDegree);
  TColgp_Array1OfPnt2d poles(1, static_cast<int>(places.size()));
  const double height = uniform(random, 0.1, 1) * sheet.wave / sheet.width;
  for (int i = 1; i <= poles.Length(); ++i)
    poles(i) = gp_Pnt2d(places[static_cast<std::size_t>(i - 1)], 0.3 + height * uniform(random, -1, 1));
  const Handle(Geom2d_BSplineCurve) line = new Geom2d_BSplineCurve(poles, knots.values, knots.multiplicities, kDegree);
  sheet.border = [line](double u) { return line->Value(std::clamp(u, 0.0, 1.0)).Y(); };
  const auto straight = [&](const gp_Pnt2d& from, const gp_Pnt2d& to) {
    const Handle(Geom2d_Line) curve = new Geom2d_Line(from, gp_Dir2d(to.XY() - from.XY()));
    return BRepBuilderAPI_MakeEdge(curve, sheet.surface, 0, from.Distance(to)).Edge();
  };
  BRepBuilderAPI_MakeWire wire;
  wire.Add(BRepBuilderAPI_MakeEdge(line, sheet.surface).Edge());
  wire.Add(straight(line->EndPoint(), {1, 1}));
  wire.Add(straight({1, 1}, {0, 1}));
  wire.Add(straight({0, 1}, line->StartPoint()));
  sheet.face = BRepBuilderAPI_MakeFace(sheet.surface, wire.Wire()).Face();
  for (TopExp_Explorer edges(sheet.face, TopAbs_EDGE); edges.More(); edges.Next())
    BRepLib::BuildCurve3d(TopoDS::Edge(edges.Current()), 1e-8, GeomAbs_C1, 14, 400);
}

Sheet roughSheet(std::mt19937_64& random) {
  constexpr int kDegree = 3;
  Sheet sheet;
  sheet.width = uniform(random, 10, 30);
  sheet.wave = sheet.width * std::exp(uniform(random, std::log(1.0 / 32), std::log(1.0 / 4)));
  const double height = std::min(1.0, sheet.wave) * std::exp(uniform(random, std::log(0.003), std::log(0.4)));
  const auto texture = static_cast<Texture>(random() % static_cast<int>(Texture::Count));
  const bool isRational = random() % 2 == 0, isCut = random() % 3 == 0;
  const double bow = random() % 2 == 0 ? 0 : uniform(random, 0, 2), aside = random() % 2 == 0 ? 0 : height;
  const int count = std::max(6, static_cast<int>(4 * sheet.width / sheet.wave));
  const Knots knots(count, kDegree);
  const std::vector<double> places = knots.places(kDegree);
  const int poleCount = static_cast<int>(places.size());
  TColgp_Array2OfPnt poles(1, poleCount, 1, poleCount);
  TColStd_Array2OfReal weights(1, poleCount, 1, poleCount);
  const double turn = 2 * std::numbers::pi / sheet.wave, shift = uniform(random, 0, 6);
  for (int i = 1; i <= poleCount; ++i) {
    for (int j = 1; j <= poleCount; ++j) {
      const double x = sheet.width * places[static_cast<std::size_t>(i - 1)];
      const double y = sheet.width * places[static_cast<std::size_t>(j - 1)];
      double z = bow * std::sin(2 * x / sheet.width) * std::cos(3 * y / sheet.width);
      if (texture == Texture::Waves) z += height * std::sin(turn * x + shift) * std::cos(turn * y + 2 * shift);
      if (texture == Texture::Ripples) z += height * std::sin(turn * x + shift);
      if (texture == Texture::Rough) z += height * uniform(random, -1, 1);
      // Also the natural borders are wavy, in the plane as well.
      poles(i, j) = gp_Pnt(x + aside * std::sin(turn * y), y + aside * std::cos(turn * x), z);
      weights(i, j) = isRational ? uniform(random, 0.7, 1.4) : 1;
    }
  }
  sheet.surface = new Geom_BSplineSurface(poles, weights, knots.values, knots.values, knots.multiplicities,
                                          knots.multiplicities, kDegree, kDegree);
  if (isCut) {
    cutOff(sheet, random, count);
  } else {
    sheet.face = BRepBuilderAPI_MakeFace(sheet.surface, 1e-7).Face();
  }
  return sheet;
}

/// Where on its way a ball meets places of a sheet.
class DensePlaces {
public:
  explicit DensePlaces(const Sheet& sheet) : sheet_(sheet) {
    constexpr double kPerWave = 16;
    steps_ = std::min(1000, static_cast<int>(kPerWave * sheet.width / sheet.wave));
    for (int i = 0; i <= steps_; ++i) {
      for (int j = 0; j <= steps_; ++j) {
        const Vector2 at(static_cast<double>(i) / steps_, static_cast<double>(j) / steps_);
        if (isOn(at)) places_.push_back({at, pointAt(at)});
      }
      // Places on the border as well.
      const double u = static_cast<double>(i) / steps_;
      const Vector2 border(u, std::max(0.0, sheet_.border(u)));
      places_.push_back({border, pointAt(border)});
    }
  }

  const Vector3& randomPlace(std::mt19937_64& random) const { return places_[random() % places_.size()].point; }

  /// How far along the way the ball comes; its length if it meets nothing.
  double wayOf(const Vector3& from, const Vector3& to, double radius) const {
    const double length = (to - from).norm();
    const Vector3 direction = (to - from) / length;
    const auto whenMet = [&](const Vector3& point) {
      const Vector3 arm = point - from;
      const double along = arm.dot(direction);
      const double square = radius * radius - arm.squaredNorm() + along * along;
      if (square < 0) return length;
      const double when = along - std::sqrt(square);
      return when < 0 && arm.norm() > radius ? length : std::max(0.0, when);
    };
    std::vector<std::pair<double, const Place*>> met;
    for (const Place& place : places_) {
      const double when = whenMet(place.point);
      if (when < length) met.emplace_back(when, &place);
    }
    std::ranges::sort(met, {}, [](const auto& one) { return one.first; });
    double best = length;
    std::vector<Vector2> used;
    constexpr std::size_t kMost = 30;
    for (const auto& [when, place] : met) {
      const double cell = 1.0 / steps_;
      if (std::ranges::any_of(used, [&](const Vector2& at) { return (at - place->at).norm() < 2.5 * cell; })) continue;
      if (used.size() == kMost) break;
      used.push_back(place->at);
      best = std::min(best, follow(place->at, when, cell, whenMet));
    }
    return best;
  }

private:
  struct Place {
    Vector2 at;
    Vector3 point;
  };
  bool isOn(const Vector2& at) const {
    return at.minCoeff() >= 0 && at.maxCoeff() <= 1 && at.y() >= sheet_.border(at.x());
  }
  Vector3 pointAt(const Vector2& at) const {
    const gp_Pnt p = sheet_.surface->Value(at.x(), at.y());
    return {p.X(), p.Y(), p.Z()};
  }
  /// On the border if it would lead beyond it.
  Vector2 nearest(const Vector2& at) const {
    const Vector2 within = at.cwiseMax(0).cwiseMin(1);
    return {within.x(), std::max(within.y(), sheet_.border(within.x()))};
  }
  template <class WhenMet>
  double follow(Vector2 at, double best, double step, const WhenMet& whenMet) const {
    constexpr double kLeast = 1e-10;
    while (step > kLeast) {
      const Vector2 middle = at;
      bool isBetter = false;
      for (int k = 0; k < 9; ++k) {
        const Vector2 next = nearest(middle + step * Vector2(k % 3 - 1, k / 3 - 1));
        const double there = whenMet(pointAt(next));
        if (there < best) best = there, at = next, isBetter = true;
      }
      if (!isBetter) step /= 2;
    }
    return best;
  }

  const Sheet& sheet_;
  int steps_ = 0;
  std::vector<Place> places_;
};

/// As OpenCASCADE measures it.
double distanceFrom(const Sheet& sheet, const Vector3& point) {
  const TopoDS_Vertex vertex = BRepBuilderAPI_MakeVertex(gp_Pnt(point.x(), point.y(), point.z())).Vertex();
  return BRepExtrema_DistShapeShape(vertex, sheet.face).Value();
}

TEST(RoughFaces, AreMetWhereTheBallTouchesThemFirst) {
  std::mt19937_64 random(static_cast<std::uint64_t>(41 + campaignStart()));
  const int sheets = 16 * campaignFactor();
  int contacts = 0, wrong = 0;
  for (int k = 0; k < sheets; ++k) {
    const Sheet sheet = roughSheet(random);
    const auto solid = cadSolid(sheet.face);
    ASSERT_TRUE(solid) << format(solid.error());
    const DensePlaces dense(sheet);
    for (int i = 0; i < 25; ++i) {
      const double radius = std::exp(uniform(random, std::log(sheet.wave / 4), std::log(8 * sheet.wave)));
      const double turn = uniform(random, 0, 6.28), slope = 0.02 + 1.5 * std::pow(uniform(random, 0, 1), 2);
      const Vector3 direction(std::cos(turn) * std::cos(slope), std::sin(turn) * std::cos(slope), -std::sin(slope));
      const Vector3 aim = dense.randomPlace(random) + Vector3(0, 0, radius * uniform(random, 0.5, 1.2));
      const Vector3 from = aim - std::min(sheet.width, 5 * radius + 3) * direction, to = aim + radius / 2 * direction;
      const double length = (to - from).norm(), expected = dense.wayOf(from, to, radius);
      const auto contact = (*solid)->firstContact(from, to, radius);
      const double way = contact ? contact->fraction * length : length;
      contacts += contact ? 1 : 0;
      if (contact && contact->fraction > 0) {
        EXPECT_NEAR((contact->touchPoint - contact->ballCentre).norm(), radius, 1e-6);
      }
      // Where the dense search has missed a place, that must be one of the sheet.
      if (way < expected - 1e-6) {
        EXPECT_LT(distanceFrom(sheet, contact->touchPoint), 1e-6) << "sheet " << k << ", way " << i;
      }
      if (way > expected + 1e-6 && ++wrong < 10) {
        ADD_FAILURE() << "sheet " << k << ", wave " << sheet.wave << ", way " << i << ", ball " << radius << ": at "
                      << way << " instead of " << expected << ", late by " << way - expected;
      }
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(contacts, 15 * sheets);
}

}  // namespace
}  // namespace probewright::simulation
