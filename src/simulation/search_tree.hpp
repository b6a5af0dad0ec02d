#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "simulation/solid.hpp"
#include "simulation/sweep.hpp"

namespace probewright::simulation {

class ImportWatch;

/// What moves: all points within `radius` of the segment from p to p + `axis`, p moving along `way`. With a `disc`, of
/// the cylinder of that radius with flat ends about the segment.
struct Mover {
  Way way;
  double radius = 0;
  Vector3 axis = Vector3::Zero();  ///< zero for a ball
  double disc = 0;
};

/// What the tree knows of an element: it lies within `growth` of a triangle. A segment is a triangle whose last two
/// corners are one.
struct SearchElement {
  Triangle corners;
  double growth = 0;
};

/// What a visitor makes of an element.
enum class Elements : std::uint8_t {
  Triangles,      ///< the triangle, exactly
  NearTriangles,  ///< something else within `growth` of the triangle
};

/// The processor's instructions that a search uses. The results are the same.
enum class Instructions : std::uint8_t {
  Plain,  ///< any processor
  Wide    ///< AVX2 and FMA
};

/// The fastest that this processor has.
Instructions bestInstructions();

/// Finds the elements a moving ball may meet, the nearest first.
///
/// The hierarchy is Embree's (its surface area heuristic builder), the boxes and the walk through it are our own. No
/// query of Embree's has a lower bound for a *ball* on a way, and boxes along the axes are thick where a surface is
/// slanted: a ball wider than the triangles would look at hundreds of them. So every box lies along the surface within
/// it, and is as thin as the surface is flat. The bound for a box: no meeting before the ball's centre enters the box
/// grown by the radius, and from there not before the ball has travelled the remaining distance between ball and box.
/// The bound for an element is the same with its triangle. Only the uppermost boxes, up to 128, lie along the
/// coordinate axes: a search begins with all of them.
class SearchTree {
public:
  SearchTree() = default;
  /// Throws std::runtime_error if Embree cannot allocate its memory, ImportStopped if the watch says so.
  SearchTree(std::span<const SearchElement> elements, Elements kind, Instructions instructions = bestInstructions(),
             const ImportWatch* watch = nullptr);

  /// The tree as it lies in memory, for a process that runs the same program on the same kind of processor.
  void appendTo(std::string& bytes) const;
  /// Takes a tree over `elements` elements, but without their order, from the beginning of `bytes` and removes it
  /// there. Nothing if these are not the bytes of one.
  static std::optional<SearchTree> takeFrom(std::string_view& bytes, std::size_t elements);

  /// The elements' indices in the order in which the tree stores them.
  const std::vector<std::uint32_t>& order() const { return order_; }
  const Bounds& bounds() const { return bounds_; }

  /// Calls `visit(place, triangle)` for every element that could be met before best.when, in rising order of the bound
  /// as far as boxes tell; `visit` lowers best.when as it finds meetings. `place` counts in order().
  template <class Visit>
  void search(const Mover& mover, const Meeting& best, const Visit& visit) const {
    search(mover, best, {&visit, exactTriangles_, [](const void* to, std::uint32_t place, const Triangle& triangle) {
                           (*static_cast<const Visit*>(to))(place, triangle);
                         }});
  }

  /// Calls `visit(place, triangle)` for every element along the whole way, in any order; a meeting hides none behind
  /// it.
  template <class Visit>
  void visitAll(const Mover& mover, const Visit& visit) const {
    const Meeting none;
    search(mover, none, {&visit, false, [](const void* to, std::uint32_t place, const Triangle& triangle) {
                           (*static_cast<const Visit*>(to))(place, triangle);
                         }});
  }

private:
  static constexpr std::size_t kWidth = 8;
  using Lane = std::array<float, kWidth>;

  using Grid = std::array<std::int16_t, kWidth>;

  /// Eight boxes with directions of their own, in whole numbers: a search waits for memory more than for its sums.
  struct alignas(64) Node {
    std::array<Grid, 3> middle;               ///< from the origin, in units
    std::array<Grid, 3> normal;               ///< 1 / kDirection
    std::array<Grid, 3> tangent;              ///< 1 / kDirection, across the normal
    std::array<Grid, 3> half;                 ///< along normal, tangent, and normal x tangent, in units
    std::array<std::uint32_t, kWidth> child;  ///< a node, or kLeaf | index of a block's first line
    std::array<float, 3> origin;              ///< from the tree's centre
    float unit;
    std::uint32_t count;
  };
  static constexpr float kDirection = 32768;

  /// Eight boxes along the coordinate axes, from the tree's centre: a search begins with all of them, one row after the
  /// other, as that takes less time than to come down to them box by box.
  struct alignas(64) GateRow {
    std::array<std::array<Lane, 3>, 2> sides;  ///< the minimum, above the maximum where there is no box; the maximum
    std::array<std::uint32_t, kWidth> child;
  };
  static constexpr std::size_t kMostGates = 128;
  static constexpr std::size_t kMostLevels = 192;  ///< of nodes above one another

  /// Up to eight triangles: their corners in whole numbers for the bounds, then, for exact meetings, each corner once;
  /// as many doubles as needed follow.
  struct Block {
    std::uint32_t firstPlace;
    float growth;                                        ///< the largest
    std::array<float, 3> origin;                         ///< from the tree's centre
    float unit;                                          ///< no coordinate is farther off than half of it
    std::array<std::array<Grid, 3>, 3> grid;             ///< of each corner the coordinates from the origin, in units
    std::array<std::array<std::uint8_t, kWidth>, 3> at;  ///< the triangles' corners
    std::uint32_t count;
    std::uint32_t cornerCount;

    const double* corner(std::size_t i) const { return reinterpret_cast<const double*>(this + 1) + 3 * i; }
    Triangle triangle(std::size_t k) const {
      const auto point = [&](std::size_t i) { return Vector3(Eigen::Map<const Vector3>(corner(at[i][k]))); };
      return {point(0), point(1), point(2)};
    }
  };
  struct alignas(64) Line {
    std::array<std::byte, 64> bytes;
  };

  struct Walker;
  struct Walks;
  struct Builder;
  /// How the walk reaches the caller.
  struct Visitor {
    const void* to;
    bool exactTriangles;
    void (*visit)(const void* to, std::uint32_t place, const Triangle& triangle);
  };

  void search(const Mover& mover, const Meeting& best, const Visitor& visitor) const;
  bool enter(const Mover& mover, Walker& walker) const;
  bool isWhole(std::size_t elements) const;

  const Block& block(std::uint32_t child) const { return *reinterpret_cast<const Block*>(&lines_[child & ~kLeaf]); }

  static constexpr std::uint32_t kLeaf = 0x80000000U;
  static constexpr float kNever = 1e30F;

  std::vector<GateRow> gates_;
  std::vector<Node> nodes_;
  std::vector<Line> lines_;  ///< of the blocks
  std::vector<std::uint32_t> order_;
  bool exactTriangles_ = false;
  Instructions instructions_ = Instructions::Plain;
  Bounds bounds_;
  Vector3 centre_ = Vector3::Zero();
};

}  // namespace probewright::simulation
