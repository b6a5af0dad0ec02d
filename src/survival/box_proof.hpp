#pragma once

#include <optional>

#include "survival/clamped_program.hpp"

namespace probewright::survival {

enum class Verdict {
  Proven,     ///< every clamping of the box survives
  Fails,      ///< a clamping of it was run, and fails: its middle, or a sample
  Undecided,  ///< its middle survives; of the rest nothing is known
  Cancelled,
};

struct BoxVerdict {
  Verdict verdict = Verdict::Undecided;
  std::optional<Reason> reason;  ///< what failed, or what could not be shown, and at which block
};

/// Tries to prove that the program survives every clamping of the box, from one run in its middle.
///
/// 1. How far anything can be from where it is in the middle is bounded: points of solids by the ranges of their poses,
///    parts of the tool by the ranges of its lengths.
/// 2. Where a measuring move touches in any clamping lies between the first touch of a ball that is larger by this
///    bound and that of one that is smaller by it. It must come before the end of the way, on the solid and face that
///    are meant, and nothing else may touch before.
/// 3. How far later moves can shift because of that is found by carrying out the program again, on a machine without a
///    part that answers each touch as far off as it can be. Cycles and coordinate systems are smooth functions of what
///    was touched; a quarter is added for their curvature, and the square of what was touched over the size of the
///    feature. Touches that are too far off for this make the box undecided.
/// 4. On every other move tool and shank, larger by all of it, touch nothing.
///
/// docs/survive.md says what this rests on.
BoxVerdict proveBox(const ClampedProgram& program, const Box& box);

}  // namespace probewright::survival
