#include "simulation/search_tree.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define PROBEWRIGHT_HAS_WIDE
#include <immintrin.h>
#endif

namespace probewright::simulation {

Instructions bestInstructions() {
#if defined(PROBEWRIGHT_HAS_WIDE)
  static const bool wide = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (wide) return Instructions::Wide;
#endif
  return Instructions::Plain;
}

/// A mover, started where it reaches the bounds of everything, in the tree's single precision frame. The segment is
/// there by its middle and half its length: a box within reach of it is a larger box within reach of a ball.
struct SearchTree::Walker {
  std::array<float, 3> start;
  std::array<float, 3> direction;
  std::array<float, 3> halfAxis;
  float radius;
  float slack;              ///< what rounding may do to places in the tree's frame
  float axisSize;           ///< sum of the magnitudes of halfAxis, and the disc
  std::array<float, 3> up;  ///< unit, along the axis
  float disc;
  float length;
  /// When the mover reaches the near side of something in the way, by the place of this side along each coordinate
  /// axis: inverse * place - atNear; and when it is behind the far side.
  std::array<float, 3> inverse;
  std::array<float, 3> atNear;
  std::array<float, 3> atFar;
  std::array<std::uint32_t, 3> nearSide;  ///< 0: the minimum
  double offset;
  bool isBall;
};

bool SearchTree::enter(const Mover& mover, Walker& w) const {
  const Vector3 start = mover.way.start - centre_;
  const Vector3& direction = mover.way.direction;
  const Vector3 growLow = (-mover.axis).cwiseMin(0.0);
  const Vector3 growHigh = (-mover.axis).cwiseMax(0.0);
  const double margin = mover.radius + mover.disc + 1e-3;
  double enterAt = 0;
  double leaveAt = mover.way.length;
  for (Eigen::Index a = 0; a < 3; ++a) {
    const double low = bounds_.minimum[a] - centre_[a] + growLow[a] - margin - start[a];
    const double high = bounds_.maximum[a] - centre_[a] + growHigh[a] + margin - start[a];
    if (std::abs(direction[a]) < 1e-20) {
      if (low > 0 || high < 0) return false;
      continue;
    }
    const double inverse = 1 / direction[a];
    const double t0 = low * inverse;
    const double t1 = high * inverse;
    enterAt = std::max(enterAt, std::min(t0, t1));
    leaveAt = std::min(leaveAt, std::max(t0, t1));
  }
  if (enterAt > leaveAt) return false;

  w.isBall = mover.axis.isZero(0);
  w.offset = enterAt;
  const Vector3 from = start + enterAt * direction + mover.axis / 2;
  for (Eigen::Index a = 0; a < 3; ++a) {
    const auto i = static_cast<std::size_t>(a);
    w.start[i] = static_cast<float>(from[a]);
    w.direction[i] = static_cast<float>(direction[a]);
    w.halfAxis[i] = static_cast<float>(mover.axis[a] / 2);
  }
  const Vector3 up = w.isBall ? mover.axis : mover.axis.normalized();
  for (std::size_t i = 0; i < 3; ++i)
    w.up[i] = static_cast<float>(up[static_cast<Eigen::Index>(i)]);
  w.disc = static_cast<float>(mover.disc * (1 + 1e-6));
  w.axisSize = static_cast<float>(mover.axis.lpNorm<1>() / 2 + mover.disc);
  // Two roundings, of 2^-24 each, of each of the places in play: when it comes into the tree's frame and becomes
  // single.
  const double scale = (bounds_.maximum - bounds_.minimum).maxCoeff() + from.lpNorm<1>() + leaveAt - enterAt;
  w.slack = static_cast<float>(1.2e-7 * scale);
  w.radius = static_cast<float>(mover.radius * (1 + 1e-7));
  w.length = static_cast<float>(leaveAt - enterAt) + w.slack;
  for (Eigen::Index a = 0; a < 3; ++a) {
    const auto i = static_cast<std::size_t>(a);
    const double along = std::copysign(std::max(std::abs(direction[a]), 1e-12), direction[a]);
    const double extent = mover.radius + mover.disc + std::abs(mover.axis[a]) / 2;
    // Six roundings, of 2^-24 each, lie behind a time: of the start, of the inverse, of both products, of both
    // differences. What each does is no more than to move a place by 2^-24 of the numbers in play.
    const double reach = std::copysign(extent + 4e-7 * (scale + extent), along);
    w.inverse[i] = static_cast<float>(1 / along);
    w.atNear[i] = static_cast<float>((from[a] + reach) / along);
    w.atFar[i] = static_cast<float>((from[a] - reach) / along);
    w.nearSide[i] = along > 0 ? 0 : 1;
  }
  return true;
}

/// What the walk is made of, under short names, and the walk itself with either set of instructions.
struct SearchTree::Walks {
  using Walker = SearchTree::Walker;
  using GateRow = SearchTree::GateRow;
  using Node = SearchTree::Node;
  using Block = SearchTree::Block;
  using Visitor = SearchTree::Visitor;
  using Lanes = float __attribute__((vector_size(32)));
  struct Candidate {
    float bound;
    std::uint32_t lane;
    const Block* block;
  };
  struct Waiting {
    std::array<Candidate, 32> candidates;
    std::size_t count = 0;
    float nearest = kNever;
  };
  /// Boxes and blocks that are still to be looked at, in no order: to find the nearest of a few takes less time than to
  /// keep them sorted, which the processor cannot foresee.
  static constexpr std::size_t kMostPending = 240;
  struct Pending {
    alignas(32) std::array<float, kMostPending + 3 * kWidth> bound;  ///< kNever for two lanes and more after the last
    std::array<std::uint32_t, kMostPending + 3 * kWidth> child;
    std::size_t count = 0;
    float nearest = kNever;  ///< of the bounds
    Pending() { std::fill_n(bound.begin(), 2 * kWidth, kNever); }
  };
  /// What no longer fits there: depth first, so that it cannot become more than the tree is deep.
  struct Deep {
    struct Entry {
      float bound;
      std::uint32_t child;
    };
    std::array<Entry, kWidth * kMostLevels> entries;
    std::size_t count = 0;
  };

  /// By so much, at most, inverseRootAtMost is less.
  static constexpr float kShorter = 1.5e-6F;

  /// Thirteen roundings, of 2^-24 each, of the numbers in play.
  static constexpr float kRounding = 8e-7F;

#define PROBEWRIGHT_INLINE [[gnu::always_inline]] static inline

  PROBEWRIGHT_INLINE void store(float* to, const Lanes& from) { std::memcpy(to, &from, sizeof from); }
  PROBEWRIGHT_INLINE Lanes load(const float* from) {
    Lanes lanes;
    std::memcpy(&lanes, from, sizeof lanes);
    return lanes;
  }
  PROBEWRIGHT_INLINE Lanes every(float x) { return Lanes{} + x; }
  /// Asks for cache lines that will be needed soon.
  template <std::size_t Bytes>
  PROBEWRIGHT_INLINE void fetch(const void* address) {
    for (std::size_t i = 0; i < Bytes; i += 64)
      __builtin_prefetch(static_cast<const char*>(address) + i);
  }
  PROBEWRIGHT_INLINE Lanes lanesBelow(std::uint32_t count) {
    const float n = static_cast<float>(count);
    return n - Lanes{0, 1, 2, 3, 4, 5, 6, 7};
  }
  /// kNever in one lane, the others as they are.
  PROBEWRIGHT_INLINE Lanes without(const Lanes& x, std::uint32_t lane) {
    return Lanes{0, 1, 2, 3, 4, 5, 6, 7} == static_cast<float>(lane) ? every(kNever) : x;
  }
  /// For each set of lanes: which they are, the first ones first; then the others.
  static constexpr auto kOrder = [] {
    std::array<std::array<std::uint8_t, kWidth>, 256> orders{};
    for (std::size_t set = 0; set < orders.size(); ++set) {
      std::size_t at = 0;
      for (const bool within : {true, false}) {
        for (std::uint8_t k = 0; k < kWidth; ++k) {
          if ((((set >> k) & 1U) != 0) == within) orders[set][at++] = k;
        }
      }
    }
    return orders;
  }();

  struct Plain {
    PROBEWRIGHT_INLINE Lanes least(const Lanes& x, const Lanes& y) { return x < y ? x : y; }
    PROBEWRIGHT_INLINE Lanes most(const Lanes& x, const Lanes& y) { return x > y ? x : y; }
    PROBEWRIGHT_INLINE Lanes size(const Lanes& x) { return x < 0 ? -x : x; }
    PROBEWRIGHT_INLINE Lanes root(const Lanes& x) {
      Lanes result;
      for (std::size_t k = 0; k < kWidth; ++k)
        result[k] = std::sqrt(x[k]);
      return result;
    }
    /// 1 / x and 1 / sqrt(x) or a little less, of positive numbers.
    PROBEWRIGHT_INLINE Lanes inverseAtMost(const Lanes& x) { return 1 / x; }
    PROBEWRIGHT_INLINE Lanes inverseRootAtMost(const Lanes& x) { return 1 / root(x); }
    PROBEWRIGHT_INLINE Lanes grid(const Grid& numbers) {
      Lanes result;
      for (std::size_t k = 0; k < kWidth; ++k)
        result[k] = numbers[k];
      return result;
    }
    PROBEWRIGHT_INLINE unsigned notAbove(const Lanes& x, float limit) {
      unsigned mask = 0;
      for (std::size_t k = 0; k < kWidth; ++k)
        mask |= static_cast<unsigned>(x[k] <= limit) << k;
      return mask;
    }
    PROBEWRIGHT_INLINE float smallest(const Lanes& x) {
      float result = x[0];
      for (std::size_t k = 1; k < kWidth; ++k)
        result = std::min(result, x[k]);
      return result;
    }
    /// The lanes of the set first.
    PROBEWRIGHT_INLINE Lanes pack(const Lanes& x, unsigned set) {
      Lanes result;
      for (std::size_t k = 0; k < kWidth; ++k)
        result[k] = x[kOrder[set][k]];
      return result;
    }
    PROBEWRIGHT_INLINE void pack(const std::array<std::uint32_t, kWidth>& x, unsigned set, std::uint32_t* to) {
      for (const auto lane : kOrder[set])
        *to++ = x[lane];
    }
#include "simulation/search_walk.inc"
  };

#if defined(PROBEWRIGHT_HAS_WIDE)
#pragma GCC push_options
#pragma GCC target("avx2,fma,bmi")
  struct Wide {
    PROBEWRIGHT_INLINE Lanes least(const Lanes& x, const Lanes& y) { return _mm256_min_ps(x, y); }
    PROBEWRIGHT_INLINE Lanes most(const Lanes& x, const Lanes& y) { return _mm256_max_ps(x, y); }
    PROBEWRIGHT_INLINE Lanes size(const Lanes& x) { return _mm256_andnot_ps(_mm256_set1_ps(-0.0F), x); }
    PROBEWRIGHT_INLINE Lanes root(const Lanes& x) { return _mm256_sqrt_ps(x); }
    PROBEWRIGHT_INLINE Lanes inverseAtMost(const Lanes& x) {
      return _mm256_rcp_ps(x) * every(1 - 5e-4F);  // right to 1 in 2,700
    }
    PROBEWRIGHT_INLINE Lanes inverseRootAtMost(const Lanes& x) {
      const Lanes y = _mm256_rsqrt_ps(x);  // right to 1 in 2,700, and after a step of Newton's to 1 in 4 million
      return y * (every(1.5F * (1 - kShorter / 2)) - every(0.5F * (1 - kShorter / 2)) * x * y * y);
    }
    PROBEWRIGHT_INLINE Lanes grid(const Grid& numbers) {
      const __m128i shorts = _mm_loadu_si128(reinterpret_cast<const __m128i*>(numbers.data()));
      return _mm256_cvtepi32_ps(_mm256_cvtepi16_epi32(shorts));
    }
    PROBEWRIGHT_INLINE unsigned notAbove(const Lanes& x, float limit) {
      return static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(x, _mm256_set1_ps(limit), _CMP_LE_OQ)));
    }
    PROBEWRIGHT_INLINE float smallest(const Lanes& x) {
      __m128 m = _mm_min_ps(_mm256_castps256_ps128(x), _mm256_extractf128_ps(x, 1));
      m = _mm_min_ps(m, _mm_movehl_ps(m, m));
      return _mm_cvtss_f32(_mm_min_ss(m, _mm_movehdup_ps(m)));
    }
    PROBEWRIGHT_INLINE __m256i orderOf(unsigned set) {
      return _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(kOrder[set].data())));
    }
    PROBEWRIGHT_INLINE Lanes pack(const Lanes& x, unsigned set) { return _mm256_permutevar8x32_ps(x, orderOf(set)); }
    PROBEWRIGHT_INLINE void pack(const std::array<std::uint32_t, kWidth>& x, unsigned set, std::uint32_t* to) {
      const __m256i all = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(x.data()));
      _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm256_permutevar8x32_epi32(all, orderOf(set)));
    }
#include "simulation/search_walk.inc"
  };
#pragma GCC pop_options
#endif
};

void SearchTree::search(const Mover& mover, const Meeting& best, const Visitor& visitor) const {
  Walker walker;
  if (lines_.empty() || !enter(mover, walker)) return;
#if defined(PROBEWRIGHT_HAS_WIDE)
  if (instructions_ == Instructions::Wide) return Walks::Wide::walk(*this, walker, best, visitor);
#endif
  Walks::Plain::walk(*this, walker, best, visitor);
}

}  // namespace probewright::simulation
