#include "study/random.hpp"

#include <Random123/philox.h>

namespace probewright::study {

namespace {

constexpr std::uint32_t noiseSource = 0xFFFFFFFFU;

std::array<std::uint64_t, 2> words(const Stream& stream, std::uint32_t source) {
  const auto low = [](std::uint64_t value) { return static_cast<std::uint32_t>(value); };
  const auto high = [](std::uint64_t value) { return static_cast<std::uint32_t>(value >> 32U); };
  const r123::Philox4x32::ctr_type counter = {
      {low(stream.trial), high(stream.trial), source, static_cast<std::uint32_t>(stream.purpose)}};
  const r123::Philox4x32::key_type key = {{low(stream.seed), high(stream.seed)}};
  const r123::Philox4x32::ctr_type drawn = r123::Philox4x32()(counter, key);
  const auto join = [](std::uint32_t first, std::uint32_t second) { return std::uint64_t{second} << 32U | first; };
  return {join(drawn[0], drawn[1]), join(drawn[2], drawn[3])};
}

/// 52 bits and a half: the middle of a cell, so that neither 0 nor 1 comes.
double uniform(std::uint64_t word) { return (static_cast<double>(word >> 12U) + 0.5) * 0x1p-52; }

}  // namespace

std::array<double, 2> uniforms(const Stream& stream, std::uint32_t source) {
  const auto drawn = words(stream, source);
  return {uniform(drawn[0]), uniform(drawn[1])};
}

std::uint64_t noiseSeed(const Stream& stream) { return words(stream, noiseSource)[0]; }

}  // namespace probewright::study
