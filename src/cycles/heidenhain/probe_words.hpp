#pragma once

#include <cstdint>

/// The words of cycle blocks that have no Q number: touch probe cycles 0 to 4, 9 and 30 to 33 in their old block form
/// (TCH PROBE n.0, n.1, ...). They are in CycleCall::parameters under these addresses, above all Q numbers. Lengths
/// in mm as programmed, angles in degrees.
namespace probewright::cycles::heidenhain::probe_word {

/// Number n of the Q parameter that receives the result (0.0, 3.1, 4.1, 31.1): a literal.
inline constexpr std::uint32_t result = 10000;
/// Probing axis (0.0, 1.1, 3.2): 0 = X, 1 = Y, 2 = Z, 3 = A, 4 = B, 5 = C, 6 = U, 7 = V, 8 = W. A literal.
inline constexpr std::uint32_t axis = 10001;
/// Probing direction (0.0): +1 or -1. A literal.
inline constexpr std::uint32_t direction = 10002;
/// Probing angle (1.1, 3.2).
inline constexpr std::uint32_t angle = 10003;
/// Clearance height (2.1, 30.1, 31.2).
inline constexpr std::uint32_t height = 10004;
/// Radius of the calibration workpiece (2.1).
inline constexpr std::uint32_t radius = 10005;
/// Calibration inside 0 or outside 1 (2.1).
inline constexpr std::uint32_t outside = 10006;
/// Maximum measuring path (3.3, 4.3).
inline constexpr std::uint32_t distance = 10007;
/// Feed rate for measuring (3.3, 4.3).
inline constexpr std::uint32_t feed = 10008;
/// Maximum retraction path MB (3.3, 4.3). An absent value means MAX.
inline constexpr std::uint32_t retraction = 10009;
/// Reference system 0 = ACT, 1 = REF (3.3, 4.3, 9.1).
inline constexpr std::uint32_t referenceSystem = 10010;
/// Error mode 0 = OFF, 1 = ON (3.4).
inline constexpr std::uint32_t errorMode = 10011;
/// Coordinate of the datum (9.1).
inline constexpr std::uint32_t datum = 10012;
/// Measuring 0, checking 1 or 2 (31.1, 32.1, 33.1).
inline constexpr std::uint32_t check = 10013;
/// Probing of the single teeth 0 or 1 (31.3, 32.3, 33.3).
inline constexpr std::uint32_t teeth = 10014;
/// Coordinates (0.1, 1.2; incremental 4.2): coordinate + axis as under `axis`. WordMode tells IX from X.
inline constexpr std::uint32_t coordinate = 10020;

}  // namespace probewright::cycles::heidenhain::probe_word
