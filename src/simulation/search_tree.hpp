#pragma once

#include <algorithm>
#include <array>
#include <cmath>
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

/// Finds the elements a moving ball may meet, the nearest first.
///
/// The hierarchy of boxes is Embree's (its surface area heuristic builder); the walk through it is our own because no
/// query of Embree's has a lower bound for a *ball* on a way, and without one a ball wider than the triangles looks at
/// hundreds of them. The bound: no meeting before the ball's centre enters the box grown by the radius, and from there
/// not before the ball has travelled the remaining distance between ball and box.
class SearchTree {
public:
  SearchTree() = default;
  /// Throws std::runtime_error if Embree cannot allocate its memory.
  explicit SearchTree(std::span<const Bounds> elements);

  /// The elements in the order in which the tree stores them; `visit` names them by their place in this order.
  const std::vector<std::uint32_t>& order() const { return order_; }
  const Bounds& bounds() const { return bounds_; }

  /// Calls `visit(place)` for every element that could be met before best.when, in rising order of the bound as far as
  /// boxes tell; `visit` lowers best.when as it finds meetings.
  template <class Visit>
  void search(const Mover& mover, const Meeting& best, const Visit& visit) const;

private:
  static constexpr std::uint32_t kLeaf = 0x80000000U;
  static constexpr std::uint32_t kWidth = 4;

  struct alignas(64) Node {
    std::array<std::array<float, kWidth>, 3> low;
    std::array<std::array<float, kWidth>, 3> high;
    std::array<std::uint32_t, kWidth> child;  ///< a node, or kLeaf | (count - 1) << 28 | first place
    std::uint32_t count;
  };

  /// A mover in the tree's single precision frame, started where it reaches the bounds of everything.
  struct Walker {
    std::array<float, 3> start;
    std::array<float, 3> direction;
    std::array<float, 3> inverse;
    std::array<float, 3> growLow;
    std::array<float, 3> growHigh;
    float radius;
    float slack;
    float length;
    double offset;
  };

  bool enter(const Mover& mover, Walker& walker) const;

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
  std::uint32_t root_ = 0;
  Bounds bounds_;
  Vector3 centre_ = Vector3::Zero();
};

template <class Visit>
void SearchTree::search(const Mover& mover, const Meeting& best, const Visit& visit) const {
  Walker w;
  if (order_.empty() || !enter(mover, w)) return;
  struct Entry {
    float bound;
    std::uint32_t node;
  };
  std::array<Entry, 256> stack;
  std::size_t depth = 0;
  stack[depth++] = {-1e30F, root_};
  const auto limitNow = [&] { return std::min(w.length, static_cast<float>(best.when - w.offset) + w.slack); };
  while (depth > 0) {
    const Entry entry = stack[--depth];
    float limit = limitNow();
    if (entry.bound > limit) continue;
    if ((entry.node & kLeaf) != 0) {
      const std::uint32_t first = entry.node & 0x0FFFFFFFU;
      const std::uint32_t count = ((entry.node >> 28) & 7U) + 1;
      for (std::uint32_t i = 0; i < count; ++i)
        visit(first + i);
      continue;
    }
    const Node& node = nodes_[entry.node];
    std::array<float, kWidth> enterAt;
    std::array<float, kWidth> leaveAt;
    std::array<float, kWidth> squared;
    enterAt.fill(0);
    leaveAt.fill(w.length);
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t k = 0; k < kWidth; ++k) {
        const float t0 = (node.low[a][k] + w.growLow[a] - w.radius - w.start[a]) * w.inverse[a];
        const float t1 = (node.high[a][k] + w.growHigh[a] + w.radius - w.start[a]) * w.inverse[a];
        const float nearSide = t0 < t1 ? t0 : t1;
        const float farSide = t0 < t1 ? t1 : t0;
        enterAt[k] = enterAt[k] > nearSide ? enterAt[k] : nearSide;
        leaveAt[k] = leaveAt[k] < farSide ? leaveAt[k] : farSide;
      }
    }
    std::array<float, kWidth> bound;
    for (std::size_t k = 0; k < kWidth; ++k)
      bound[k] = enterAt[k];
    for (int step = 0; step < 2; ++step) {
      squared.fill(0);
      for (std::size_t a = 0; a < 3; ++a) {
        for (std::size_t k = 0; k < kWidth; ++k) {
          const float p = w.start[a] + bound[k] * w.direction[a];
          const float below = node.low[a][k] + w.growLow[a] - p;
          const float above = p - node.high[a][k] - w.growHigh[a];
          float outside = below > above ? below : above;
          outside = outside > 0 ? outside : 0;
          squared[k] += outside * outside;
        }
      }
      // A ball that overlaps the box has no further way to go; at the very start the depth counts.
      for (std::size_t k = 0; k < kWidth; ++k) {
        const float ahead = std::sqrt(squared[k]) - w.radius;
        const float gain = bound[k] < 0 || (bound[k] > 0 && ahead < 0) ? 0 : ahead;
        bound[k] += gain;
      }
    }
    std::array<Entry, kWidth> hit;
    std::size_t hits = 0;
    for (std::uint32_t k = 0; k < node.count; ++k) {
      const float lowest = bound[k] - w.slack;
      if (enterAt[k] > leaveAt[k] + w.slack || lowest > limit) continue;
      std::size_t at = hits++;
      for (; at > 0 && hit[at - 1].bound < lowest; --at)
        hit[at] = hit[at - 1];
      hit[at] = {lowest, node.child[k]};
    }
    for (std::size_t i = 0; i < hits; ++i)
      stack[depth++] = hit[i];
  }
}

}  // namespace probewright::simulation
