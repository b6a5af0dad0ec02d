#pragma once

#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <array>
#include <optional>
#include <vector>

#include "geometry/primitives.hpp"
#include "simulation/freeform_surface.hpp"

namespace probewright::simulation {

/// A spline as a net of poles over two parameters; of a curve over u alone. Quicker than OpenCASCADE's splines, the
/// same for any number of threads, and with bounds of the derivatives that are proven: between two knots a spline lies
/// in the convex hull of the poles that reach there, and so do its derivatives in those of their own poles.
class SplineNet {
public:
  /// Nothing where a weight is not positive.
  static std::optional<SplineNet> of(const Handle(Geom_BSplineSurface) & surface);
  static std::optional<SplineNet> of(const Handle(Geom_BSplineCurve) & curve);

  /// Also beyond the ends, where the outermost pieces go on.
  SurfacePoint at(const Vector2& parameters) const;
  /// Bounds for a box of parameters; beyond the ends those of the outermost pieces, which do not hold there.
  SurfaceBends bends(const Vector2& low, const Vector2& high) const;
  /// Nothing if more than a few pieces lie in the box, or first derivatives jump in it.
  std::optional<SurfaceCurving> curving(const Vector2& low, const Vector2& high, const Vector3& point,
                                        const Vector3& normal) const;
  /// True if weights near each other differ so much that the bends are far too large.
  bool isUneven() const { return isUneven_; }
  /// The point times its weight, and the weight.
  Eigen::Vector4d weighted(const Vector2& parameters) const;
  /// The largest distance of a pole from an axis, which no point exceeds.
  double farthestFrom(const Vector3& origin, const Vector3& axis) const;

  /// True if no parameter of the box lies beyond an end.
  bool covers(const Vector2& low, const Vector2& high) const;
  /// A u within an interval where the first derivative may jump; a v of the same kind.
  std::optional<double> kinkAcrossU(double low, double high) const { return u_.kinkBetween(low, high); }
  std::optional<double> kinkAcrossV(double low, double high) const { return v_.kinkBetween(low, high); }

private:
  using Pole = Eigen::Vector4d;  ///< times its weight, and the weight
  static constexpr int kMostDegree = 25;

  /// What belongs to one of the parameters.
  struct Along {
    int degree = 0;
    std::vector<double> knots;    ///< each as often as it counts
    std::vector<int> pieces;      ///< of each piece between two different knots: the place of the first
    std::vector<double> ends;     ///< where the pieces begin, and where the last ends
    std::vector<int> continuity;  ///< of each piece: how many derivatives do not jump where it begins
    std::vector<double> kinks;    ///< where first derivatives may jump
    double period = 0;            ///< 0 if it does not close

    void close(double turn, int multiplicity);
    double within(double parameter) const;
    std::size_t pieceAt(double parameter) const;
    std::optional<double> kinkBetween(double low, double high) const;
  };
  /// The values of the functions of a piece, their first and their second derivatives.
  struct Functions {
    std::array<double, kMostDegree + 1> value, first, second;
  };

  static Along along(const TColStd_Array1OfReal& knots, const TColStd_Array1OfInteger& multiplicities, int degree);
  static void findFunctions(const Along& along, int piece, double parameter, Functions& functions);
  static void findValues(const Along& along, int piece, double parameter, Functions& functions);
  void add(const Vector3& point, double weight);
  const Pole& pole(int i, int j) const { return poles_[static_cast<std::size_t>(i * columns_ + j)]; }
  struct Nets;
  /// The pieces of an interval of a parameter: the first, and how many follow it.
  struct Pieces {
    std::size_t first = 0, count = 0;
    bool jumps = false;  ///< whether second derivatives do within
  };
  static std::pair<double, double> partIn(const Along& along, std::size_t piece, double low, double high);
  static Pieces piecesIn(const Along& along, double from, double to);
  SurfaceBends bendsOf(int pieceU, int pieceV, Nets& nets);
  void findBends();

  Along u_, v_;
  int columns_ = 1;
  bool rational_ = false;
  bool isUneven_ = false;
  std::vector<Pole> poles_;
  std::vector<SurfaceBends> bends_;  ///< of each piece along u, of each along v
  SurfaceBends most_;
};

}  // namespace probewright::simulation
