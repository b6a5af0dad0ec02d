#include "simulation/search_tree.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace probewright::simulation {
namespace {

// Eight lanes are one AVX register; machines without it run the same code with two SSE registers a lane. The sanitizers
// do not go together with choosing a function at start-up.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__)
#define PROBEWRIGHT_CLONES __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define PROBEWRIGHT_CLONES
#endif

constexpr std::size_t kLeafSize = 8;
constexpr std::uint32_t kLeaf = 0x80000000U;
constexpr float kNever = 1e30F;
constexpr float kFarAway = 1e12F;

struct BuildNode {
  std::uint32_t count = 0;
  bool leaf = false;
  std::array<BuildNode*, 8> child{};
  std::array<RTCBounds, 8> bounds{};
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

void setBounds(void* place, const RTCBounds** bounds, unsigned count, void*) {
  for (unsigned i = 0; i < count; ++i)
    static_cast<BuildNode*>(place)->bounds[i] = *bounds[i];
}

void* createLeaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* elements, std::size_t count, void*) {
  auto* node = new (rtcThreadLocalAlloc(allocator, sizeof(BuildNode), 16)) BuildNode;
  node->leaf = true;
  node->count = static_cast<std::uint32_t>(count);
  for (std::size_t i = 0; i < count; ++i)
    node->elements[i] = elements[i].primID;
  return node;
}

float below(double value) { return std::nextafter(static_cast<float>(value), -std::numeric_limits<float>::infinity()); }
float above(double value) { return std::nextafter(static_cast<float>(value), std::numeric_limits<float>::infinity()); }

/// Asks for cache lines that will be needed soon.
void fetch(const char* address, std::size_t lines) {
  for (std::size_t line = 0; line < lines; ++line)
    __builtin_prefetch(address + 64 * line);
}

RTCDevice embree() {
  static const RTCDevice device = rtcNewDevice(nullptr);
  if (device == nullptr) throw std::runtime_error("Embree could not be started");
  return device;
}

}  // namespace

SearchElement searchElement(const Triangle& t, double growth) {
  SearchElement element;
  for (const Vector3& corner : t) {
    element.box.minimum = element.box.minimum.cwiseMin(corner);
    element.box.maximum = element.box.maximum.cwiseMax(corner);
  }
  element.box.minimum.array() -= growth;
  element.box.maximum.array() += growth;
  // The smallest sphere about the longest edge, if it holds the third corner; else the one about the middle.
  std::size_t longest = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if ((t[(i + 1) % 3] - t[i]).squaredNorm() > (t[(longest + 1) % 3] - t[longest]).squaredNorm()) longest = i;
  }
  element.centre = (t[longest] + t[(longest + 1) % 3]) / 2;
  element.radius = (t[longest] - element.centre).norm();
  if ((t[(longest + 2) % 3] - element.centre).norm() > element.radius) {
    element.centre = (t[0] + t[1] + t[2]) / 3;
    element.radius = 0;
    for (const Vector3& corner : t)
      element.radius = std::max(element.radius, (corner - element.centre).norm());
  }
  Vector3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
  // Without an area any direction across the longest edge will do.
  if (normal.norm() < 1e-9 * element.radius * element.radius)
    normal = (t[(longest + 1) % 3] - t[longest]).unitOrthogonal();
  element.normal = normal.norm() > 0 ? Vector3(normal.normalized()) : Vector3::UnitZ();
  element.radius += growth;
  for (const Vector3& corner : t) {
    element.thickness = std::max(element.thickness, std::abs(element.normal.dot(corner - element.centre)));
  }
  element.thickness += growth;
  return element;
}

/// A mover in the tree's single precision frame, started where it reaches the bounds of everything.
struct SearchTree::Walker {
  std::array<float, 3> start;
  std::array<float, 3> direction;
  std::array<float, 3> inverse;
  std::array<float, 3> growLow;
  std::array<float, 3> growHigh;
  float radius;
  float slack;
  float length;
  double offset;
  bool isBall;
};

SearchTree::SearchTree(std::span<const SearchElement> elements) {
  if (elements.empty()) return;
  if (elements.size() >= kLeaf) throw std::runtime_error("more elements than a search tree can hold");
  for (const SearchElement& element : elements) {
    bounds_.minimum = bounds_.minimum.cwiseMin(element.box.minimum);
    bounds_.maximum = bounds_.maximum.cwiseMax(element.box.maximum);
  }
  centre_ = (bounds_.minimum + bounds_.maximum) / 2;
  std::vector<RTCBuildPrimitive> primitives(elements.size());
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const Vector3 low = elements[i].box.minimum - centre_;
    const Vector3 high = elements[i].box.maximum - centre_;
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
  const auto* root = static_cast<const BuildNode*>(rtcBuildBVH(&arguments));
  if (root == nullptr) {
    rtcReleaseBVH(arguments.bvh);
    throw std::runtime_error("Embree could not build the search tree");
  }

  order_.reserve(elements.size());
  const auto makeBlock = [&](const BuildNode& from) {
    Block block{};
    firstPlaces_.push_back(static_cast<std::uint32_t>(order_.size()));
    for (std::size_t k = 0; k < kWidth; ++k) {
      const SearchElement& element = elements[from.elements[std::min<std::size_t>(k, from.count - 1)]];
      const Vector3 centre = element.centre - centre_;
      for (std::size_t a = 0; a < 3; ++a) {
        block.centre[a][k] = static_cast<float>(centre[static_cast<Eigen::Index>(a)]);
        block.normal[a][k] = static_cast<float>(element.normal[static_cast<Eigen::Index>(a)]);
      }
      block.radius[k] = above(element.radius);
      block.thickness[k] = above(element.thickness);
      // Lanes without an element lie out of reach.
      if (k >= from.count) block.centre[0][k] = kFarAway;
    }
    order_.insert(order_.end(), from.elements.begin(), from.elements.begin() + from.count);
    blocks_.push_back(block);
    return kLeaf | static_cast<std::uint32_t>(blocks_.size() - 1);
  };
  const auto flatten = [&](const auto& self, const BuildNode& from) -> std::uint32_t {
    if (from.leaf) return makeBlock(from);
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    Node node{};
    for (Lane& lane : node.boxes.low)
      lane.fill(kNever);
    for (Lane& lane : node.boxes.high)
      lane.fill(kNever);
    for (std::uint32_t k = 0; k < from.count; ++k) {
      const RTCBounds& box = from.bounds[k];
      node.boxes.low[0][k] = box.lower_x;
      node.boxes.low[1][k] = box.lower_y;
      node.boxes.low[2][k] = box.lower_z;
      node.boxes.high[0][k] = box.upper_x;
      node.boxes.high[1][k] = box.upper_y;
      node.boxes.high[2][k] = box.upper_z;
      node.child[k] = self(self, *from.child[k]);
    }
    nodes_[index] = node;
    return index;
  };
  root_ = flatten(flatten, *root);
  rtcReleaseBVH(arguments.bvh);
}

bool SearchTree::enter(const Mover& mover, Walker& w) const {
  const Vector3 start = mover.way.start - centre_;
  const Vector3& direction = mover.way.direction;
  const Vector3 growLow = (-mover.axis).cwiseMin(0.0);
  const Vector3 growHigh = (-mover.axis).cwiseMax(0.0);
  const double margin = mover.radius + 1e-3;
  double enterAt = 0;
  double leaveAt = mover.way.length;
  for (Eigen::Index a = 0; a < 3; ++a) {
    const double low = bounds_.minimum[a] - centre_[a] + growLow[a] - margin - start[a];
    const double high = bounds_.maximum[a] - centre_[a] + growHigh[a] + margin - start[a];
    if (std::abs(direction[a]) < 1e-20) {
      if (low > 0 || high < 0) return false;
      continue;
    }
    const double t0 = low / direction[a];
    const double t1 = high / direction[a];
    enterAt = std::max(enterAt, std::min(t0, t1));
    leaveAt = std::min(leaveAt, std::max(t0, t1));
  }
  if (enterAt > leaveAt) return false;

  w.isBall = mover.axis.isZero();
  w.offset = enterAt;
  const Vector3 from = start + enterAt * direction;
  double scale = (bounds_.maximum - bounds_.minimum).maxCoeff() + from.cwiseAbs().maxCoeff();
  for (Eigen::Index a = 0; a < 3; ++a) {
    const auto i = static_cast<std::size_t>(a);
    w.start[i] = static_cast<float>(from[a]);
    w.direction[i] = static_cast<float>(direction[a]);
    const double safe = std::abs(direction[a]) < 1e-20 ? 1e-20 : direction[a];
    w.inverse[i] = static_cast<float>(1 / safe);
    w.growLow[i] = static_cast<float>(growLow[a]);
    w.growHigh[i] = static_cast<float>(growHigh[a]);
    scale += std::abs(mover.axis[a]);
  }
  // Ten roundings of the largest number in play; added to the radius it also covers the entry into thin boxes.
  w.slack = static_cast<float>(1.2e-6 * (scale + mover.radius));
  w.radius = static_cast<float>(mover.radius) + w.slack;
  w.length = static_cast<float>(leaveAt - enterAt) + w.slack;
  return true;
}

/// Lower bounds of the distance travelled before each box is met; kNever for boxes beside the way.
PROBEWRIGHT_CLONES
void SearchTree::boundBoxes(const Walker& w, const Boxes& boxes, Lane& result) {
  const std::array<float, 3> direction = w.direction;
  const std::array<float, 3> inverse = w.inverse;
  const float radius = w.radius;
  const float slack = w.slack;
  const float length = w.length + slack;
  // The boxes' sides as seen from the start.
  std::array<float, 3> toLow;
  std::array<float, 3> toHigh;
  for (std::size_t a = 0; a < 3; ++a) {
    toLow[a] = w.growLow[a] - w.start[a];
    toHigh[a] = w.growHigh[a] - w.start[a];
  }
  const auto least = [](float x, float y) { return x < y ? x : y; };
  const auto most = [](float x, float y) { return x > y ? x : y; };
  Lane bound;
  for (std::size_t k = 0; k < kWidth; ++k) {
    const float lowX = boxes.low[0][k] + toLow[0];
    const float lowY = boxes.low[1][k] + toLow[1];
    const float lowZ = boxes.low[2][k] + toLow[2];
    const float highX = boxes.high[0][k] + toHigh[0];
    const float highY = boxes.high[1][k] + toHigh[1];
    const float highZ = boxes.high[2][k] + toHigh[2];
    const float x0 = (lowX - radius) * inverse[0];
    const float x1 = (highX + radius) * inverse[0];
    const float y0 = (lowY - radius) * inverse[1];
    const float y1 = (highY + radius) * inverse[1];
    const float z0 = (lowZ - radius) * inverse[2];
    const float z1 = (highZ + radius) * inverse[2];
    const float enterAt = most(most(most(least(x0, x1), least(y0, y1)), least(z0, z1)), 0.0F);
    const float leaveAt = least(least(least(most(x0, x1), most(y0, y1)), most(z0, z1)), length);
    const float px = enterAt * direction[0];
    const float py = enterAt * direction[1];
    const float pz = enterAt * direction[2];
    const float dx = most(most(lowX - px, px - highX), 0.0F);
    const float dy = most(most(lowY - py, py - highY), 0.0F);
    const float dz = most(most(lowZ - pz, pz - highZ), 0.0F);
    // Rounding may put the ball a little into a box it has just reached; only at the very start a depth counts.
    const float ahead = std::sqrt(dx * dx + dy * dy + dz * dz) - radius;
    const float gain = most(ahead, enterAt > 0 ? 0.0F : -radius);
    const float reached = enterAt + gain - slack;
    bound[k] = enterAt > leaveAt + slack ? kNever : reached;
  }
  result = bound;
}

/// The same for a ball and the discs of a block.
PROBEWRIGHT_CLONES
void SearchTree::boundDiscs(const Walker& w, const Block& b, Lane& result) {
  // Rounding of the normals may turn a way along a disc into one that closes in on it.
  constexpr float kSteepness = 2e-6F;
  const std::array<float, 3> start = w.start;
  const std::array<float, 3> direction = w.direction;
  const float radius = w.radius;
  const float slack = w.slack;
  Lane bound;
  for (std::size_t k = 0; k < kWidth; ++k) {
    const float nx = b.normal[0][k];
    const float ny = b.normal[1][k];
    const float nz = b.normal[2][k];
    const float mx = start[0] - b.centre[0][k];
    const float my = start[1] - b.centre[1][k];
    const float mz = start[2] - b.centre[2][k];
    const float thickness = b.thickness[k];
    const float height = mx * nx + my * ny + mz * nz;
    const float rise = direction[0] * nx + direction[1] * ny + direction[2] * nz;
    const float gap = std::fabs(height) - radius - thickness;
    const float closing = height < 0 ? rise : -rise;
    const float approach = closing > 0 ? closing + kSteepness : kSteepness;
    const float travelled = gap / approach;
    const float travel = travelled > 0 ? travelled : 0;
    const float reached = height + travel * rise;
    const float qx = mx + travel * direction[0] - reached * nx;
    const float qy = my + travel * direction[1] - reached * ny;
    const float qz = mz + travel * direction[2] - reached * nz;
    const float beside = std::sqrt(qx * qx + qy * qy + qz * qz) - b.radius[k];
    const float aside = beside > 0 ? beside : 0;
    const float above = std::fabs(reached) - thickness;
    const float off = above > 0 ? above : 0;
    const float ahead = std::sqrt(off * off + aside * aside) - radius;
    const float atLeast = travel > 0 ? 0 : -radius;
    const float gain = ahead > atLeast ? ahead : atLeast;
    bound[k] = travel + gain - slack;
  }
  result = bound;
}

void SearchTree::walk(const Mover& mover, const Meeting& best, const Visitor& visitor) const {
  Walker w;
  if (order_.empty() || !enter(mover, w)) return;
  struct Entry {
    float bound;
    std::uint32_t node;
  };
  std::array<Entry, 512> stack;
  std::size_t depth = 0;
  stack[depth++] = {-kNever, root_};
  const auto limit = [&] { return std::min(w.length, static_cast<float>(best.when - w.offset) + w.slack); };
  alignas(64) Lane bound;
  while (depth > 0) {
    const Entry entry = stack[--depth];
    const float limitNow = limit();
    if (entry.bound > limitNow) continue;
    if ((entry.node & kLeaf) != 0) {
      const Block& block = blocks_[entry.node & ~kLeaf];
      if (w.isBall) {
        boundDiscs(w, block, bound);
      } else {
        Boxes boxes;
        for (std::size_t a = 0; a < 3; ++a) {
          for (std::size_t k = 0; k < kWidth; ++k) {
            const float reach = block.radius[k] + block.thickness[k];
            boxes.low[a][k] = block.centre[a][k] - reach;
            boxes.high[a][k] = block.centre[a][k] + reach;
          }
        }
        boundBoxes(w, boxes, bound);
      }
      const std::uint32_t place = firstPlaces_[entry.node & ~kLeaf];
      for (std::uint32_t k = 0; k < kWidth; ++k) {
        if (bound[k] <= limitNow) fetch(static_cast<const char*>(visitor.elements) + visitor.size * (place + k), 2);
      }
      for (;;) {
        const auto first = static_cast<std::uint32_t>(std::min_element(bound.begin(), bound.end()) - bound.begin());
        if (bound[first] > limit()) break;
        bound[first] = kNever;
        visitor.visit(visitor.to, place + first);
      }
      continue;
    }
    const Node& node = nodes_[entry.node];
    boundBoxes(w, node.boxes, bound);
    // The nearest child comes to lie on top of the stack.
    const std::size_t base = depth;
    for (std::size_t k = 0; k < kWidth; ++k) {
      if (bound[k] > limitNow) continue;
      std::size_t at = depth++;
      for (; at > base && stack[at - 1].bound < bound[k]; --at)
        stack[at] = stack[at - 1];
      stack[at] = {bound[k], node.child[k]};
      // All that is pushed will most likely be looked at; by then it should have come from memory.
      const std::uint32_t child = node.child[k];
      if ((child & kLeaf) != 0) {
        fetch(reinterpret_cast<const char*>(&blocks_[child & ~kLeaf]), sizeof(Block) / 64);
      } else {
        fetch(reinterpret_cast<const char*>(&nodes_[child]), sizeof(Node) / 64);
      }
    }
  }
}

}  // namespace probewright::simulation
