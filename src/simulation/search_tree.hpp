#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "simulation/solid.hpp"
#include "simulation/sweep.hpp"

namespace probewright::simulation {

/// What moves: all points within `radius` of the segment from p to p + `axis`, p moving along `way`.
struct Mover {
  Way way;
  double radius = 0;
  Vector3 axis = Vector3::Zero();  ///< zero for a ball
};

/// What the tree knows of an element: it lies in the flat round disc about `centre`.
struct SearchElement {
  Bounds box;
  Vector3 centre = Vector3::Zero();
  Vector3 normal = Vector3::UnitZ();
  double radius = 0;
  double thickness = 0;  ///< to either side of the disc's middle plane
};

/// A triangle, or a segment as a triangle whose last two corners are one, together with all points within `growth`.
SearchElement searchElement(const Triangle& triangle, double growth = 0);

/// Finds the elements a moving ball may meet, the nearest first.
///
/// The hierarchy of boxes is Embree's (its surface area heuristic builder); the walk through it is our own because no
/// query of Embree's has a lower bound for a *ball* on a way, and without one a ball wider than the triangles looks at
/// hundreds of them. The bound for a box: no meeting before the ball's centre enters the box grown by the radius, and
/// from there not before the ball has travelled the remaining distance between ball and box. The bound for an element
/// is the same with its disc, which is far thinner than a box about a slanted triangle.
class SearchTree {
public:
  SearchTree() = default;
  /// Throws std::runtime_error if Embree cannot allocate its memory.
  explicit SearchTree(std::span<const SearchElement> elements);

  /// The elements' indices in the order in which the tree stores them.
  const std::vector<std::uint32_t>& order() const { return order_; }
  const Bounds& bounds() const { return bounds_; }

  /// Calls `visit(element)` for every element that could be met before best.when, in rising order of the bound as far
  /// as boxes tell; `visit` lowers best.when as it finds meetings. `elements` are the caller's, in the tree's order.
  template <class Element, class Visit>
  void search(const Mover& mover, const Meeting& best, const std::vector<Element>& elements, const Visit& visit) const {
    struct Call {
      const Element* elements;
      const Visit* visit;
    };
    const Call call{elements.data(), &visit};
    walk(mover, best, {&call, elements.data(), sizeof(Element), [](const void* to, std::uint32_t place) {
                         const Call& c = *static_cast<const Call*>(to);
                         (*c.visit)(c.elements[place]);
                       }});
  }

private:
  static constexpr std::size_t kWidth = 8;
  using Lane = std::array<float, kWidth>;

  struct Boxes {
    std::array<Lane, 3> low;
    std::array<Lane, 3> high;
  };

  struct alignas(64) Node {
    Boxes boxes;
    std::array<std::uint32_t, kWidth> child;  ///< a node, or kLeaf | index of a block
  };

  /// Up to eight elements side by side.
  struct alignas(64) Block {
    std::array<Lane, 3> centre;
    std::array<Lane, 3> normal;
    Lane radius;
    Lane thickness;
  };

  struct Walker;
  /// How the walk reaches the caller's elements: to fetch them from memory ahead of time, and to visit them.
  struct Visitor {
    const void* to;
    const void* elements;
    std::size_t size;
    void (*visit)(const void* to, std::uint32_t place);
  };

  bool enter(const Mover& mover, Walker& walker) const;
  void walk(const Mover& mover, const Meeting& best, const Visitor& visitor) const;
  static void boundBoxes(const Walker& w, const Boxes& boxes, Lane& bound);
  static void boundDiscs(const Walker& w, const Block& block, Lane& bound);

  std::vector<Node> nodes_;
  std::vector<Block> blocks_;
  std::vector<std::uint32_t> firstPlaces_;  ///< of the blocks' elements
  std::vector<std::uint32_t> order_;
  std::uint32_t root_ = 0;
  Bounds bounds_;
  Vector3 centre_ = Vector3::Zero();
};

}  // namespace probewright::simulation
