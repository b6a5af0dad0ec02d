#pragma once

#include <array>
#include <cstdint>

/// Random numbers without a state: what a trial draws depends on nothing but its number, so any thread may draw it, at
/// any time, and a trial can be repeated alone.
namespace probewright::study {

/// What a number is drawn for; each purpose has streams of its own.
enum class Purpose : std::uint32_t {
  Trial,       ///< the trials of a study, and the first sample of Saltelli's scheme
  Resample,    ///< its second sample
  OneAtATime,  ///< one source varies, the others stand
  Gauge,       ///< parts, appraisers and repeats of a gauge study
};

struct Stream {
  std::uint64_t seed = 1;
  std::uint64_t trial = 0;
  Purpose purpose = Purpose::Trial;
};

/// Two numbers for the source with this index, even in (0, 1), never 0 or 1. Philox4x32-10 (Salmon and others 2011),
/// with seed as key and trial, source and purpose as counter.
std::array<double, 2> uniforms(const Stream& stream, std::uint32_t source);

/// A seed for the random effects of the machine.
std::uint64_t noiseSeed(const Stream& stream);

}  // namespace probewright::study
