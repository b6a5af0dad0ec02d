#include "simulation/cad_bounds.hpp"

#include <GeomAdaptor_Surface.hxx>
#include <algorithm>
#include <map>

#include "simulation/cad_elements.hpp"
#include "simulation/cad_vectors.hpp"
#include "simulation/parallel.hpp"

namespace probewright::simulation {
namespace {

/// One of the directions in which a box ends.
struct Direction {
  Eigen::Index axis;
  double sign;

  double height(const Vector3& p) const { return sign * p[axis]; }
};

/// The search for the highest place of a shape: of the pieces of its faces always the one that may reach highest is
/// looked at next, in quarters.
class HighestPlace {
public:
  HighestPlace(const CadModel& model, const Direction& direction) : model_(model), direction_(direction) {}

  double find() {
    for (const CadElement& element : model_.elements)
      best_ = std::max(best_, heightOf(element.corners));
    for (const CadElement& element : model_.elements) {
      if (element.isTriangle() && !model_.faces[element.owner].forms.isPlane()) add(whole(element));
    }
    while (!open_.empty() && mayMatter(open_.front())) {
      std::ranges::pop_heap(open_, {}, &Piece::mayReach);
      const Piece next = open_.back();
      open_.pop_back();
      if (next.halvings < kMostHalvings) addQuarters(next);
    }
    return best_;
  }

private:
  static constexpr int kMostHalvings = 6;

  struct Piece {
    double mayReach = 0;  ///< the height
    std::uint32_t face = 0;
    std::array<Vector2, 6> parameters;  ///< of the corners; behind them of the middles of the sides, the first first
    std::array<Vector3, 6> points;
    int halvings = 0;
  };

  double heightOf(const Triangle& t) const {
    return std::max({direction_.height(t[0]), direction_.height(t[1]), direction_.height(t[2])});
  }

  bool mayMatter(const Piece& piece) const { return piece.mayReach > best_ + model_.deflection; }

  void add(const Piece& piece) {
    if (!mayMatter(piece)) return;
    open_.push_back(piece);
    std::ranges::push_heap(open_, {}, &Piece::mayReach);
  }

  Piece whole(const CadElement& element) {
    Piece piece;
    piece.mayReach = heightOf(element.corners) + element.growth;
    if (!mayMatter(piece)) return piece;
    piece.face = element.owner;
    std::ranges::copy(element.parameters, piece.parameters.begin());
    std::ranges::copy(element.corners, piece.points.begin());
    const double risen = measure(piece);
    // Where the element leaves the face by more than it would at any border, its samples may have seen what these do
    // not.
    if (element.growth <= growthBesideBorders(model_.deflection)) piece.mayReach = risen;
    return piece;
  }

  /// Adds the middles of the sides; returns the height that the piece may reach.
  double measure(Piece& piece) {
    auto& [a, b, c, ab, bc, ca] = piece.parameters;
    ab = (a + b) / 2, bc = (b + c) / 2, ca = (c + a) / 2;
    double rise = 0;
    const auto look = [&](const Vector2& at, double chord) {
      const Vector3 place = placeAt(piece.face, at);
      best_ = std::max(best_, direction_.height(place));
      rise = std::max(rise, direction_.height(place) - chord);
      return place;
    };
    std::array<double, 3> heights{};
    for (std::size_t k = 0; k < 3; ++k)
      heights[k] = direction_.height(piece.points[k]);
    for (std::size_t k = 0; k < 3; ++k)
      piece.points[3 + k] = look(piece.parameters[3 + k], (heights[k] + heights[(k + 1) % 3]) / 2);
    look((a + b + c) / 3, (heights[0] + heights[1] + heights[2]) / 3);
    return std::ranges::max(heights) + kDeviationSafety * rise;
  }

  void addQuarters(const Piece& piece) {
    for (const auto& corners :
         std::array<std::array<std::size_t, 3>, 4>{{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}}) {
      Piece quarter;
      quarter.face = piece.face;
      quarter.halvings = piece.halvings + 1;
      for (std::size_t k = 0; k < 3; ++k) {
        quarter.parameters[k] = piece.parameters[corners[k]];
        quarter.points[k] = piece.points[corners[k]];
      }
      quarter.mayReach = measure(quarter);
      add(quarter);
    }
  }

  Vector3 placeAt(std::uint32_t face, const Vector2& uv) {
    const auto found = surfaces_.try_emplace(face, model_.faces[face].surface).first;
    return vector(found->second.Value(uv.x(), uv.y()));
  }

  const CadModel& model_;
  Direction direction_;
  double best_ = -1e300;
  std::vector<Piece> open_;
  std::map<std::uint32_t, GeomAdaptor_Surface> surfaces_;
};

}  // namespace

Bounds boundsOf(const CadModel& model) {
  Bounds bounds;
  inParallel(6, 1, [&](std::size_t i) {
    const Direction direction{static_cast<Eigen::Index>(i / 2), i % 2 == 0 ? 1.0 : -1.0};
    const double highest = HighestPlace(model, direction).find();
    (i % 2 == 0 ? bounds.maximum : bounds.minimum)[direction.axis] = direction.sign * highest;
  });
  return bounds;
}

}  // namespace probewright::simulation
