#include <fmt/format.h>

#include "survival/survival_records.hpp"

namespace probewright::survival {

namespace {

std::string textOf(const Reason& reason) {
  return reason.place.line > 0 ? fmt::format("line {}: {}", reason.place.line, reason.why) : reason.why;
}

const char* unitOf(const Tolerance& tolerance) { return tolerance.kind == NumberKind::Turn ? "deg" : "mm"; }

}  // namespace

std::string survivalText(const Survival& survival) {
  std::string text;
  const auto line = [&]<class... Args>(fmt::format_string<Args...> format, Args&&... args) {
    text += fmt::format(format, std::forward<Args>(args)...) + "\n";
  };
  if (survival.asWritten) {
    line("The program does not survive as the setup is written: {}", textOf(*survival.asWritten));
    return text;
  }
  line("Of the box of clampings");
  line("  {:6.2f} % is proven: free of collision, every feature is found", 100 * survival.proven);
  line("  {:6.2f} % fails: a clamping of each part was run and fails", 100 * survival.fails);
  line("  {:6.2f} % is undecided", 100 * survival.undecided);
  if (survival.obstacle) line("Nothing can be proven of this program: {}", textOf(*survival.obstacle));
  line("");
  line("  {:<32} {:>10} .. {:<10} {:>14}", "tolerance", "from", "to", "proven");
  for (const Tolerance& each : survival.tolerances) {
    const double half = survival.symmetric * each.half();
    line("  {:<32} {:>10.4f} .. {:<10.4f} {:>10} {}", each.name(), each.low, each.high,
         half > 0 ? fmt::format("+-{:.4f}", half) : "none", unitOf(each));
  }
  if (survival.symmetric < 1) {
    line("  All of them together: {:.1f} % of the given tolerances about the middle.", 100 * survival.symmetric);
    if (survival.nearestFailure)
      line("  The nearest clamping that fails lies at {:.1f} % of them.", 100 * *survival.nearestFailure);
  }
  line("");
  line("{} clampings were run, {} of them fail; of {} in the proven part, none.", survival.samples, survival.failed,
       survival.samplesInProven);
  if (survival.openProbability)
    line("Where nothing is proven, {} of {} fail: {:.2f} % to {:.2f} % of it (95 %, Clopper and Pearson).",
         survival.openFailures, survival.openSamples, 100 * survival.openProbability->low,
         100 * survival.openProbability->high);
  if (!survival.blocks.empty()) {
    line("");
    line("The worst blocks");
    for (std::size_t i = 0; i < survival.blocks.size() && i < 5; ++i) {
      const BlockRecord& block = survival.blocks[i];
      line("  line {:>5}  {:>6} failures, {:6.2f} % of the box: {}", block.place.line, block.failures,
           100 * block.share, block.why);
    }
  }
  return text;
}

}  // namespace probewright::survival
