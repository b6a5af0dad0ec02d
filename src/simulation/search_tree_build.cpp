#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "simulation/import_watch.hpp"
#include "simulation/memory_text.hpp"
#include "simulation/parallel.hpp"
#include "simulation/search_tree.hpp"

namespace probewright::simulation {
namespace {

constexpr std::size_t kLeafSize = 8;

struct BuildNode {
  std::uint32_t count = 0;
  bool leaf = false;
  std::array<BuildNode*, 8> child{};
  std::array<std::uint32_t, kLeafSize> elements{};
};

void* createNode(RTCThreadLocalAllocator allocator, unsigned count, void*) {
  auto* node = new (rtcThreadLocalAlloc(allocator, sizeof(BuildNode), 16)) BuildNode;
  node->count = count;
  return node;
}

void setChildren(void* place, void** children, unsigned count, void*) {
  for (unsigned i = 0; i < count; ++i)
    static_cast<BuildNode*>(place)->child[i] = static_cast<BuildNode*>(children[i]);
}

void setBounds(void*, const RTCBounds**, unsigned, void*) {}

void* createLeaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* elements, std::size_t count, void*) {
  auto* node = new (rtcThreadLocalAlloc(allocator, sizeof(BuildNode), 16)) BuildNode;
  node->leaf = true;
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
    const std::size_t first = tree.lines_.size();
    // Corners are read four numbers at a time.
    const std::size_t size = sizeof(Block) + corners.size() * sizeof(Vector3) + sizeof(double);
    tree.lines_.resize(first + (size + sizeof(Line) - 1) / sizeof(Line));
    std::byte* to = tree.lines_[first].bytes.data();
    std::memcpy(to, &block, sizeof(Block));
    std::memcpy(to + sizeof(Block), corners.data(), corners.size() * sizeof(Vector3));
    return kLeaf | static_cast<std::uint32_t>(first);
  }

  void setBoxes(Node& node, const std::vector<SlantedBox>& boxes) const {
    Bounds around;
    for (const SlantedBox& box : boxes) {
      around.minimum = around.minimum.cwiseMin(box.middle());
      around.maximum = around.maximum.cwiseMax(box.middle());
    }
    const Eigen::Vector3f origin = ((around.minimum + around.maximum) / 2 - tree.centre_).cast<float>();
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

  /// Where the elements of a node's children begin, and where those of the last one end.
  struct Places {
    std::array<std::size_t, 9> begin{};
  };
  std::vector<Places> places;

  /// The node and what lies below it, still without boxes.
  std::uint32_t makeNode(const BuildNode& from) {
    if (from.leaf) return makeBlock(from);
    const auto index = static_cast<std::uint32_t>(tree.nodes_.size());
    tree.nodes_.emplace_back();
    places.emplace_back();
    for (std::uint32_t k = 0; k < from.count; ++k) {
      places[index].begin[k] = ordered.size();
      const std::uint32_t child = makeNode(*from.child[k]);
      tree.nodes_[index].child[k] = child;
    }
    tree.nodes_[index].count = from.count;
    places[index].begin[from.count] = ordered.size();
    return index;
  }

  void makeBoxes(std::size_t index) {
    Node& node = tree.nodes_[index];
    const auto count = static_cast<std::size_t>(node.count);
    std::vector<SlantedBox> boxes;
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t first = places[index].begin[k];
      boxes.push_back(smallBox(Range(ordered).subspan(first, places[index].begin[k + 1] - first)));
    }
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
  arguments.maxBranchingFactor = kWidth;
  arguments.maxDepth = 48;
  arguments.sahBlockSize = kLeafSize;
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
  const auto* root = static_cast<const BuildNode*>(rtcBuildBVH(&arguments));
  if (root == nullptr) {
    rtcReleaseBVH(arguments.bvh);
    if (watch != nullptr) watch->goOn();
    throw std::runtime_error("Embree could not build the search tree");
  }
  Builder builder{*this, elements, watch, {}, {}};
  builder.ordered.reserve(elements.size());
  order_.reserve(elements.size());
  root_ = builder.makeNode(*root);
  rtcReleaseBVH(arguments.bvh);
  builder.makeBoxes();
  nodes_.shrink_to_fit();
  lines_.shrink_to_fit();
}

void SearchTree::appendTo(std::string& bytes) const {
  append(bytes, nodes_);
  append(bytes, lines_);
  append(bytes, root_);
  append(bytes, exactTriangles_);
  append(bytes, bounds_);
  append(bytes, centre_);
}

std::optional<SearchTree> SearchTree::takeFrom(std::string_view& bytes, std::size_t elements) {
  SearchTree tree;
  tree.instructions_ = bestInstructions();
  char exact = 0;
  if (!take(bytes, tree.nodes_) || !take(bytes, tree.lines_) || !take(bytes, tree.root_) || !take(bytes, exact) ||
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
    const std::size_t size = sizeof(Block) + found.cornerCount * sizeof(Vector3) + sizeof(double);
    if (size > (lines_.size() - first) * sizeof(Line)) return false;
    for (const auto& corners : found.at) {
      for (std::size_t k = 0; k < found.count; ++k) {
        if (corners[k] >= found.cornerCount) return false;
      }
    }
    return true;
  };
  if (elements == 0) return nodes_.empty() && lines_.empty();
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    if (node.count > kWidth) return false;
    for (std::size_t k = 0; k < node.count; ++k) {
      // A node lies before those below it, so no way leads round in a circle.
      if (!leads(node.child[k]) || ((node.child[k] & kLeaf) == 0 && node.child[k] <= i)) return false;
    }
  }
  return leads(root_);
}

}  // namespace probewright::simulation
