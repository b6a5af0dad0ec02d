#pragma once

#include <Geom_Surface.hxx>
#include <TopoDS_Face.hxx>
#include <array>
#include <memory>
#include <mutex>
#include <optional>

#include "simulation/analytic_surface.hpp"
#include "simulation/freeform_surface.hpp"
#include "simulation/trimmed_domain.hpp"

/// A face of a boundary representation, as contact queries need it.
namespace probewright::simulation {

/// The closed forms of a face: none for free forms, one for most, two for a cone across its apex and for a torus that
/// meets itself.
struct ClosedForms {
  std::array<AnalyticSurface, 2> sheets;
  std::size_t count = 0;

  const AnalyticSurface* begin() const { return sheets.data(); }
  const AnalyticSurface* end() const { return sheets.data() + count; }
  bool isPlane() const { return count == 1 && sheets[0].kind == AnalyticSurface::Kind::Plane; }
};

/// The surface of a free-form face, made ready when somebody first asks for it, by any thread.
class LazyFreeformSurface {
public:
  LazyFreeformSurface(Handle(Geom_Surface) surface, const TrimmedDomain& domain);
  const FreeformSurface& operator*() const;

private:
  Handle(Geom_Surface) surface_;
  Vector2 low_, high_;
  mutable std::once_flag once_;
  mutable std::unique_ptr<const FreeformSurface> made_;
};

struct CadFace {
  ClosedForms forms;                                    ///< the exact surface where it has closed forms
  Handle(Geom_Surface) surface;                         ///< the exact surface in every case, without limits of its own
  std::shared_ptr<const LazyFreeformSurface> freeform;  ///< the same with bounds, where it has no closed forms
  TrimmedDomain domain;
  bool reversed = false;     ///< the material lies on the side the surface's own normal points to
  bool boundsSolid = false;  ///< belongs to a closed solid, so that a point is before or behind it

  /// The point of the surface.
  Vector3 pointAt(const Vector2& parameters) const;
};

/// Reads a face. Throws Standard_Failure or std::runtime_error where it has no surface. Its domain takes long to find,
/// unless it is known.
CadFace cadFace(const TopoDS_Face& face, std::optional<TrimmedDomain> domain = std::nullopt);

/// The surface without the limits that a trimmed surface, or a trimmed curve that made it, puts on its parameters. Only
/// so does it tell its periods.
Handle(Geom_Surface) surfaceWithoutLimits(const Handle(Geom_Surface) & surface);

/// True for a face of a lemon, apple, spindle or horn torus, a circle turned about an axis that it meets, if the face
/// goes as far as the axis: there one of the circle's arcs passes into the other. A face that ends before lies on the
/// arc that its edges lie on.
bool reachesItsAxis(const CadFace& face);

/// Appends the parameters of a curve's points so that chords stay within a tolerance. `deviates(a, b)` tells whether
/// the chord between two parameters does not.
template <class Deviates>
void subdivide(double a, double b, int depth, const Deviates& deviates, std::vector<double>& parameters) {
  if (depth > 0 && deviates(a, b)) {
    const double middle = (a + b) / 2;
    subdivide(a, middle, depth - 1, deviates, parameters);
    subdivide(middle, b, depth - 1, deviates, parameters);
  } else {
    parameters.push_back(b);
  }
}

}  // namespace probewright::simulation
