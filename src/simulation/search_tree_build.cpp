#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <utility>

#include "simulation/import_watch.hpp"
#include "simulation/memory_text.hpp"
#include "simulation/parallel.hpp"
#include "simulation/search_tree.hpp"

namespace probewright::simulation {
namespace {

constexpr std::size_t kLeafSize = 8;

/// Embree builds a tree of pairs; nodes of eight are made of it.
struct BuildNode {
  std::uint32_t count = 0;  ///< of a leaf's elements; 0 for a pair
  std::array<BuildNode*, 2> pair{};
  std::array<std::uint32_t, kLeafSize> elements{};
  Bounds box;
  /// What a search costs below here if this is 1 to 8 boxes of a node, and how many of them the first of the pair is.
  std::array<double, 8> cost{};
  std::array<std::uint8_t, 8> ofFirst{};  ///< 0: all of them are one node
  std::uint8_t ofNode = 0;                ///< the same of the eight boxes of a node of its own
};

void* createNode(RTCThreadLocalAllocator allocator, unsigned, void*) {
  return new (rtcThreadLocalAlloc(allocator, sizeof(BuildNode), 16)) BuildNode;
}

void setChildren(void* place, void** children, unsigned, void*) {
  for (std::size_t i = 0; i < 2; ++i)
    static_cast<BuildNode*>(place)->pair[i] = static_cast<BuildNode*>(children[i]);
}

void setBounds(void*, const RTCBounds**, unsigned, void*) {}

void* createLeaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* elements, std::size_t count, void*) {
  auto* node = new (rtcThreadLocalAlloc(allocator, sizeof(BuildNode), 16)) BuildNode;
  node->count = static_cast<std::uint32_t>(count);
  for (std::size_t i = 0; i < count; ++i)
    node->elements[i] = elements[i].primID;
  return node;
}

/// Whether Embree is to go on.
bool goesOn(void* watch, double /*share*/) {
  return watch == nullptr || !static_cast<const ImportWatch*>(watch)->isStopped();
}

float below(double value) { return std::nextafter(static_cast<float>(value), -std::numeric_limits<float>::infinity()); }
float above(double value) { return std::nextafter(static_cast<float>(value), std::numeric_limits<float>::infinity()); }

RTCDevice embree() {
  static const RTCDevice device = rtcNewDevice(nullptr);
  if (device == nullptr) throw std::runtime_error("Embree could not be started");
  return device;
}

Bounds boundsOf(const SearchElement& element) {
  Bounds box;
  for (const Vector3& corner : element.corners) {
    box.minimum = box.minimum.cwiseMin(corner);
    box.maximum = box.maximum.cwiseMax(corner);
  }
  box.minimum.array() -= element.growth;
  box.maximum.array() += element.growth;
  return box;
}

/// The box about both.
Bounds around(const Bounds& one, const Bounds& other) {
  return {one.minimum.cwiseMin(other.minimum), one.maximum.cwiseMax(other.maximum)};
}

constexpr double kDirection = 32768;
constexpr double kLargest = 32767;

/// A box with directions of its own.
struct SlantedBox {
  Matrix3 axes = Matrix3::Identity();  ///< rows: normal, tangent, normal x tangent
  Vector3 minimum = Vector3::Constant(1e300);
  Vector3 maximum = Vector3::Constant(-1e300);

  Vector3 half() const { return (maximum - minimum) / 2; }
  Vector3 middle() const { return axes.inverse() * ((maximum + minimum) / 2); }
  double surface() const {
    const Vector3 h = half();
    return h[0] * h[1] + h[1] * h[2] + h[2] * h[0];
  }
};

using Range = std::span<const SearchElement>;

/// The directions as a node holds them. Distances along them are never larger than they are, nor are their squares
/// together: they are a little shorter than 1, by more than rounding takes from their right angle.
Matrix3 heldAxes(const Vector3& normal, const Vector3& tangent) {
  const auto held = [](const Vector3& v) {
    return Vector3((v.normalized() * (kDirection - 4)).array().round() / kDirection);
  };
  Matrix3 axes;
  const Vector3 n = held(normal);
  const Vector3 u = held(tangent - tangent.dot(n) / n.squaredNorm() * n);
  axes << n.transpose(), u.transpose(), n.cross(u).transpose();
  return axes;
}

SlantedBox boxAlong(const Matrix3& axes, Range elements) {
  SlantedBox box;
  box.axes = axes;
  for (const SearchElement& element : elements) {
    for (const Vector3& corner : element.corners) {
      const Vector3 p = axes * corner;
      box.minimum = box.minimum.cwiseMin(p - Vector3::Constant(element.growth));
      box.maximum = box.maximum.cwiseMax(p + Vector3::Constant(element.growth));
    }
  }
  return box;
}

Vector3 areaVector(const Triangle& t) { return (t[1] - t[0]).cross(t[2] - t[0]); }

/// The smallest of a few boxes about the elements: along the coordinate axes, and along the surface's mean normal with
/// its sides near the coordinate axes or along the elements' first edge.
SlantedBox smallBox(Range elements) {
  SlantedBox best = boxAlong(heldAxes(Vector3::UnitX(), Vector3::UnitY()), elements);
  Vector3 sum = Vector3::Zero();
  double areas = 0;
  for (const SearchElement& element : elements) {
    // Neighbours may be wound in opposite senses on an open skin.
    const Vector3 area = areaVector(element.corners);
    sum += area.dot(sum) < 0 ? Vector3(-area) : area;
    areas += area.norm();
  }
  const double size = sum.norm();
  if (!(size > 0)) return best;
  // What is bent as a whole has no direction that would be better; trying many elements takes long.
  constexpr std::size_t many = 256;
  if (elements.size() > many && size < 0.5 * areas) return best;
  const Vector3 normal = sum / size;
  const Triangle& first = elements[0].corners;
  for (const Vector3& side : {Vector3(Vector3::UnitX()), Vector3(Vector3::UnitY()), Vector3(Vector3::UnitZ()),
                              Vector3(first[1] - first[0])}) {
    const Vector3 across = side - side.dot(normal) * normal;
    if (across.norm() < 0.1 * side.norm() || across.norm() == 0) continue;
    SlantedBox box = boxAlong(heldAxes(normal, across), elements);
    if (box.surface() < best.surface()) best = box;
  }
  return best;
}

}  // namespace

struct SearchTree::Builder {
  SearchTree& tree;
  std::span<const SearchElement> elements;
  const ImportWatch* watch;
  std::vector<SearchElement> ordered;

  void setGrid(Block& block, const std::vector<Vector3>& corners) const {
    Bounds box;
    for (const Vector3& corner : corners)
      box = around(box, {corner, corner});
    const Eigen::Vector3f origin = ((box.minimum + box.maximum) / 2 - tree.centre_).cast<float>();
    const Vector3 held = origin.cast<double>() + tree.centre_;
    double reach = 1e-30;
    for (const Vector3& corner : corners)
      reach = std::max(reach, (corner - held).cwiseAbs().maxCoeff());
    block.unit = above(reach / kLargest);
    for (std::size_t a = 0; a < 3; ++a) {
      const auto axis = static_cast<Eigen::Index>(a);
      block.origin[a] = origin[axis];
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < block.count; ++k) {
          const double place = corners[block.at[i][k]][axis] - held[axis];
          block.grid[i][a][k] = static_cast<std::int16_t>(std::lround(place / static_cast<double>(block.unit)));
        }
      }
    }
  }

  std::uint32_t makeBlock(const BuildNode& from) {
    Block block{};
    block.firstPlace = static_cast<std::uint32_t>(ordered.size());
    block.count = from.count;
    std::vector<Vector3> corners;
    for (std::uint32_t k = 0; k < from.count; ++k) {
      const SearchElement& element = elements[from.elements[k]];
      tree.order_.push_back(from.elements[k]);
      ordered.push_back(element);
      block.growth = std::max(block.growth, above(element.growth));
      for (std::size_t i = 0; i < 3; ++i) {
        const auto place = std::find(corners.begin(), corners.end(), element.corners[i]);
        block.at[i][k] = static_cast<std::uint8_t>(place - corners.begin());
        if (place == corners.end()) corners.push_back(element.corners[i]);
      }
    }
    block.cornerCount = static_cast<std::uint32_t>(corners.size());
    setGrid(block, corners);
    const std::size_t first = tree.lines_.size();
    const std::size_t size = sizeof(Block) + corners.size() * sizeof(Vector3);
    tree.lines_.resize(first + (size + sizeof(Line) - 1) / sizeof(Line));
    std::byte* to = tree.lines_[first].bytes.data();
    std::memcpy(to, &block, sizeof(Block));
    std::memcpy(to + sizeof(Block), static_cast<const void*>(corners.data()), corners.size() * sizeof(Vector3));
    return kLeaf | static_cast<std::uint32_t>(first);
  }

  void setBoxes(Node& node, const std::vector<SlantedBox>& boxes) const {
    Bounds middles;
    for (const SlantedBox& box : boxes)
      middles = around(middles, {box.middle(), box.middle()});
    const Eigen::Vector3f origin = ((middles.minimum + middles.maximum) / 2 - tree.centre_).cast<float>();
    const Vector3 held = origin.cast<double>() + tree.centre_;
    double reach = 1e-30;
    for (const SlantedBox& box : boxes)
      reach = std::max({reach, (box.middle() - held).cwiseAbs().maxCoeff(), box.half().maxCoeff()});
    // Space for rounding.
    node.unit = above(1.001 * reach / (kLargest - 3));
    node.count = static_cast<std::uint32_t>(boxes.size());
    const double unit = static_cast<double>(node.unit);
    for (std::size_t k = 0; k < boxes.size(); ++k) {
      const SlantedBox& box = boxes[k];
      const Vector3 middle = box.middle() - held;
      for (std::size_t a = 0; a < 3; ++a) {
        const auto i = static_cast<Eigen::Index>(a);
        node.origin[a] = origin[i];
        node.middle[a][k] = static_cast<std::int16_t>(std::lround(middle[i] / unit));
        node.normal[a][k] = static_cast<std::int16_t>(std::lround(box.axes(0, i) * kDirection));
        node.tangent[a][k] = static_cast<std::int16_t>(std::lround(box.axes(1, i) * kDirection));
        // The middle has moved by up to half a unit in each coordinate, the sums are single precision.
        const double half = box.half()[i] + 3e-7 * box.half().sum();
        node.half[a][k] = static_cast<std::int16_t>(std::ceil(half / unit + 0.9));
      }
    }
  }

  /// A node or a block, and which of the ordered elements lie in it.
  struct Part {
    std::uint32_t child = 0;
    std::size_t first = 0;
    std::size_t last = 0;
  };
  using Parts = std::vector<Part>;
  std::vector<Parts> partsOfNode;

  /// Works out which pairs become nodes so that the surface of all nodes' boxes is the smallest: a search looks at a
  /// box the more often the larger it is. (H. Ylitie, T. Karras, S. Laine: Efficient Incoherent Ray Traversal on GPUs
  /// Through Compressed Wide BVHs, 2017, section 4.) Blocks cost nothing, as they are the same however it is done.
  void plan(BuildNode& node) const {
    for (std::size_t k = 0; k < node.count; ++k)
      node.box = around(node.box, boundsOf(elements[node.elements[k]]));
    if (node.count > 0) return;
    auto& [first, second] = node.pair;
    plan(*first);
    plan(*second);
    node.box = around(first->box, second->box);
    node.cost.fill(1e300);
    for (std::size_t boxes = 2; boxes <= kWidth; ++boxes) {
      for (std::size_t left = 1; left < boxes; ++left) {
        const double cost = first->cost[left - 1] + second->cost[boxes - left - 1];
        if (cost >= node.cost[boxes - 1]) continue;
        node.cost[boxes - 1] = cost;
        node.ofFirst[boxes - 1] = static_cast<std::uint8_t>(left);
      }
    }
    const Vector3 size = node.box.maximum - node.box.minimum;
    const double asNode = size[0] * size[1] + size[1] * size[2] + size[2] * size[0] + node.cost.back();
    node.ofNode = node.ofFirst.back();
    for (std::size_t i = 0; i < kWidth; ++i) {
      if (asNode >= node.cost[i]) continue;
      node.cost[i] = asNode;
      node.ofFirst[i] = 0;
    }
  }

  /// Makes what lies below as many parts or less, with all that is in them; nodes still without boxes. Nodes come after
  /// those below them.
  void make(const BuildNode& from, std::size_t count, Parts& parts) {
    const std::size_t first = ordered.size();
    if (from.count > 0) {
      const std::uint32_t block = makeBlock(from);
      parts.push_back({block, first, ordered.size()});
    } else if (const std::size_t left = from.ofFirst[count - 1]; left > 0) {
      make(*from.pair[0], left, parts);
      make(*from.pair[1], count - left, parts);
    } else {
      Parts within;
      make(*from.pair[0], from.ofNode, within);
      make(*from.pair[1], kWidth - from.ofNode, within);
      parts.push_back({static_cast<std::uint32_t>(tree.nodes_.size()), first, ordered.size()});
      tree.nodes_.emplace_back();
      partsOfNode.push_back(std::move(within));
    }
  }

  /// What the boxes of the gates lead to: all parts below the uppermost pairs.
  void makeGates(const BuildNode& from, int levels, Parts& parts) {
    if (levels == 0 || from.count > 0) return make(from, kWidth, parts);
    for (const BuildNode* half : from.pair)
      makeGates(*half, levels - 1, parts);
  }

  void setGates(const Parts& parts) const {
    tree.gates_.resize((parts.size() + kWidth - 1) / kWidth);
    for (GateRow& row : tree.gates_) {
      row.child.fill(parts.front().child);
      for (std::size_t a = 0; a < 3; ++a) {
        row.sides[0][a].fill(kNever);
        row.sides[1][a].fill(-kNever);
      }
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
      Bounds box;
      for (std::size_t k = parts[i].first; k < parts[i].last; ++k)
        box = around(box, boundsOf(ordered[k]));
      GateRow& row = tree.gates_[i / kWidth];
      const std::size_t lane = i % kWidth;
      row.child[lane] = parts[i].child;
      for (std::size_t a = 0; a < 3; ++a) {
        const auto axis = static_cast<Eigen::Index>(a);
        row.sides[0][a][lane] = below(box.minimum[axis] - tree.centre_[axis]);
        row.sides[1][a][lane] = above(box.maximum[axis] - tree.centre_[axis]);
      }
    }
  }

  void makeBoxes(std::size_t index) {
    const Parts& parts = partsOfNode[index];
    std::vector<SlantedBox> boxes;
    for (const Part& part : parts)
      boxes.push_back(smallBox(Range(ordered).subspan(part.first, part.last - part.first)));
    Node& node = tree.nodes_[index];
    for (std::size_t k = 0; k < parts.size(); ++k)
      node.child[k] = parts[k].child;
    setBoxes(node, boxes);
  }

  /// The boxes of all nodes; each is a matter of its own.
  void makeBoxes() {
    inParallel(tree.nodes_.size(), 200, [&](std::size_t i) {
      if (watch == nullptr || !watch->isStopped()) makeBoxes(i);
    });
    if (watch != nullptr) watch->goOn();
  }
};

SearchTree::SearchTree(std::span<const SearchElement> elements, Elements kind, Instructions instructions,
                       const ImportWatch* watch)
    : exactTriangles_(kind == Elements::Triangles), instructions_(instructions) {
  if (elements.empty()) return;
  if (elements.size() >= kLeaf) throw std::runtime_error("more elements than a search tree can hold");
  for (const SearchElement& element : elements) {
    const Bounds box = boundsOf(element);
    bounds_.minimum = bounds_.minimum.cwiseMin(box.minimum);
    bounds_.maximum = bounds_.maximum.cwiseMax(box.maximum);
  }
  centre_ = (bounds_.minimum + bounds_.maximum) / 2;
  std::vector<RTCBuildPrimitive> primitives(elements.size());
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const Bounds box = boundsOf(elements[i]);
    const Vector3 low = box.minimum - centre_;
    const Vector3 high = box.maximum - centre_;
    primitives[i] = {below(low.x()),  below(low.y()),  below(low.z()),  0,
                     above(high.x()), above(high.y()), above(high.z()), static_cast<unsigned>(i)};
  }

  RTCBuildArguments arguments = rtcDefaultBuildArguments();
  arguments.buildQuality = RTC_BUILD_QUALITY_MEDIUM;
  arguments.maxBranchingFactor = 2;
  arguments.maxDepth = static_cast<unsigned>(kMostLevels);
  arguments.sahBlockSize = kLeafSize;
  arguments.minLeafSize = kLeafSize;
  arguments.maxLeafSize = kLeafSize;
  arguments.bvh = rtcNewBVH(embree());
  arguments.primitives = primitives.data();
  arguments.primitiveCount = primitives.size();
  arguments.primitiveArrayCapacity = primitives.size();
  arguments.createNode = createNode;
  arguments.setNodeChildren = setChildren;
  arguments.setNodeBounds = setBounds;
  arguments.createLeaf = createLeaf;
  arguments.buildProgress = goesOn;
  arguments.userPtr = const_cast<ImportWatch*>(watch);  // NOLINT(cppcoreguidelines-pro-type-const-cast): as C has it
  auto* root = static_cast<BuildNode*>(rtcBuildBVH(&arguments));
  if (root == nullptr) {
    rtcReleaseBVH(arguments.bvh);
    if (watch != nullptr) watch->goOn();
    throw std::runtime_error("Embree could not build the search tree");
  }
  Builder builder{*this, elements, watch, {}, {}};
  builder.ordered.reserve(elements.size());
  order_.reserve(elements.size());
  constexpr int levelsOfGates = 4;
  static_assert(kWidth << levelsOfGates <= kMostGates);
  builder.plan(*root);
  Builder::Parts gates;
  builder.makeGates(*root, levelsOfGates, gates);
  rtcReleaseBVH(arguments.bvh);
  builder.setGates(gates);
  builder.makeBoxes();
  nodes_.shrink_to_fit();
  lines_.shrink_to_fit();
}

void SearchTree::appendTo(std::string& bytes) const {
  append(bytes, gates_);
  append(bytes, nodes_);
  append(bytes, lines_);
  append(bytes, exactTriangles_);
  append(bytes, bounds_);
  append(bytes, centre_);
}

std::optional<SearchTree> SearchTree::takeFrom(std::string_view& bytes, std::size_t elements) {
  SearchTree tree;
  tree.instructions_ = bestInstructions();
  char exact = 0;
  if (!take(bytes, tree.gates_) || !take(bytes, tree.nodes_) || !take(bytes, tree.lines_) || !take(bytes, exact) ||
      !take(bytes, tree.bounds_) || !take(bytes, tree.centre_) || !tree.isWhole(elements))
    return std::nullopt;
  tree.exactTriangles_ = exact != 0;
  return tree;
}

/// True if no search can leave what there is.
bool SearchTree::isWhole(std::size_t elements) const {
  const auto leads = [&](std::uint32_t child) {
    if ((child & kLeaf) == 0) return child < nodes_.size();
    const std::size_t first = child & ~kLeaf;
    if (first >= lines_.size()) return false;
    const Block& found = block(child);
    if (found.count > kWidth || found.firstPlace > elements || found.count > elements - found.firstPlace) return false;
    const std::size_t size = sizeof(Block) + found.cornerCount * sizeof(Vector3);
    if (size > (lines_.size() - first) * sizeof(Line)) return false;
    for (const auto& corners : found.at) {
      for (std::size_t k = 0; k < found.count; ++k) {
        if (corners[k] >= found.cornerCount) return false;
      }
    }
    return true;
  };
  if (elements == 0) return gates_.empty() && nodes_.empty() && lines_.empty();
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    if (node.count > kWidth) return false;
    for (std::size_t k = 0; k < node.count; ++k) {
      // A node lies after those below it, so no way leads round in a circle.
      if (!leads(node.child[k]) || ((node.child[k] & kLeaf) == 0 && node.child[k] >= i)) return false;
    }
  }
  if (gates_.empty() || gates_.size() > kMostGates / kWidth) return false;
  return std::ranges::all_of(gates_, [&](const GateRow& row) { return std::ranges::all_of(row.child, leads); });
}

}  // namespace probewright::simulation
