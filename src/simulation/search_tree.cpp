#include "simulation/search_tree.hpp"

#include <embree3/rtcore.h>

#include <cstring>
#include <limits>
#include <stdexcept>

namespace probewright::simulation {
namespace {

constexpr std::size_t kLeafSize = 8;

struct BuildNode {
  std::uint32_t count = 0;
  bool leaf = false;
  std::array<BuildNode*, 4> child{};
  std::array<RTCBounds, 4> bounds{};
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

RTCDevice embree() {
  static const RTCDevice device = rtcNewDevice(nullptr);
  if (device == nullptr) throw std::runtime_error("Embree could not be started");
  return device;
}

}  // namespace

SearchTree::SearchTree(std::span<const Bounds> elements) {
  if (elements.empty()) return;
  if (elements.size() > 0x0FFFFFFFU) throw std::runtime_error("more elements than a search tree can hold");
  for (const Bounds& box : elements) {
    bounds_.minimum = bounds_.minimum.cwiseMin(box.minimum);
    bounds_.maximum = bounds_.maximum.cwiseMax(box.maximum);
  }
  centre_ = (bounds_.minimum + bounds_.maximum) / 2;
  std::vector<RTCBuildPrimitive> primitives(elements.size());
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const Vector3 low = elements[i].minimum - centre_;
    const Vector3 high = elements[i].maximum - centre_;
    primitives[i] = {below(low.x()),  below(low.y()),  below(low.z()),  0,
                     above(high.x()), above(high.y()), above(high.z()), static_cast<unsigned>(i)};
  }

  RTCBuildArguments arguments = rtcDefaultBuildArguments();
  arguments.buildQuality = RTC_BUILD_QUALITY_MEDIUM;
  arguments.maxBranchingFactor = kWidth;
  arguments.maxDepth = 48;
  arguments.maxLeafSize = kLeafSize;
  arguments.intersectionCost = 8;
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
  const auto flatten = [this](const auto& self, const BuildNode& from) -> std::uint32_t {
    if (from.leaf) {
      const auto first = static_cast<std::uint32_t>(order_.size());
      order_.insert(order_.end(), from.elements.begin(), from.elements.begin() + from.count);
      return kLeaf | (from.count - 1) << 28 | first;
    }
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    Node node{};
    node.count = from.count;
    for (std::uint32_t k = 0; k < from.count; ++k) {
      const RTCBounds& box = from.bounds[k];
      node.low[0][k] = box.lower_x;
      node.low[1][k] = box.lower_y;
      node.low[2][k] = box.lower_z;
      node.high[0][k] = box.upper_x;
      node.high[1][k] = box.upper_y;
      node.high[2][k] = box.upper_z;
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

}  // namespace probewright::simulation
