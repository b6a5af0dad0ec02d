#include "survival/survive.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "study/random.hpp"

namespace probewright::survival {

namespace {

constexpr std::size_t batch = 32;        // boxes that are tried at once, whatever the threads
constexpr double smallest = 1.0 / 1024;  // of a side of the whole box
constexpr std::size_t mostCorners = 64;
constexpr double sizes = 32;     // steps of a range of sizes, in which proven parts are checked
constexpr double failing = 0.1;  // priority of a part whose middle fails
constexpr std::uint64_t openSamplesFrom = std::uint64_t{1} << 40U;  // numbers of samples drawn where nothing is proven
constexpr std::uint64_t checksFrom = std::uint64_t{1} << 41U;       // of those drawn in proven parts

class Search {
public:
  Search(const ClampedProgram& program, const Options& options)
      : program_(program),
        options_(options),
        whole_(boxOf(program.worlds().tolerances())),
        arena_(options.threads > 0 ? options.threads : tbb::task_arena::automatic) {
    result_.tolerances = program.worlds().tolerances();
  }

  Survival run();

private:
  struct Sample {
    std::uint64_t number = 0;
    std::vector<double> values;
    std::uint64_t noise = 0;
    ClampedRun run;
  };

  /// Of the random effects of a sample; a setup file can name it.
  std::uint64_t seedOf(std::uint64_t sample) const {
    return study::noiseSeed({options_.seed, sample}) & ((std::uint64_t{1} << 53U) - 1);
  }
  bool stopped() const { return program_.stop().stop_requested(); }
  std::size_t sides() const { return whole_.low.size(); }
  double share(const Box& box) const;
  /// How far the box is from the middle of the whole: the scale of the largest box about it that does not meet this
  /// one.
  double distance(const Box& box) const;
  double distance(const std::vector<double>& values) const;
  Box scaled(double scale) const;
  /// The nearest of so many sizes that solids are built of, or the end of the box before it.
  double stepped(std::size_t side, double value, const Box& box) const;

  void runAll(std::vector<Sample>& samples, const char* phase);
  bool keep(const std::vector<Sample>& samples);
  void sample();
  void sampleOpen();
  bool checkProven();
  std::vector<BoxVerdict> tryAll(const std::vector<Box>& boxes);
  /// The largest box about the middle that is proven at once, as a part, and what is left of the whole.
  void beginWithCore();
  void refine();
  bool split(const Part& part, Part& low, Part& high) const;
  /// How a clamping in the box fails that was run; null if none does.
  const Reason* failureIn(const Box& box) const;
  void count();

  const ClampedProgram& program_;
  const Options& options_;
  Box whole_;
  tbb::task_arena arena_;
  Survival result_;
  std::vector<Sample> samples_;
  std::vector<std::pair<std::vector<double>, Reason>> failed_;  ///< samples
  std::vector<bool> untried_;                                   ///< parts, by their place
};

double Search::share(const Box& box) const {
  double share = 1;
  for (std::size_t i = 0; i < sides(); ++i)
    share *= (box.high[i] - box.low[i]) / (whole_.high[i] - whole_.low[i]);
  return share;
}

double Search::distance(const Box& box) const {
  double farthest = 0;
  for (std::size_t i = 0; i < sides(); ++i) {
    const double middle = (whole_.low[i] + whole_.high[i]) / 2, half = (whole_.high[i] - whole_.low[i]) / 2;
    farthest = std::max({farthest, (box.low[i] - middle) / half, (middle - box.high[i]) / half});
  }
  return farthest;
}

double Search::distance(const std::vector<double>& values) const { return distance(Box{values, values}); }

Box Search::scaled(double scale) const {
  Box box = whole_;
  for (std::size_t i = 0; i < sides(); ++i) {
    const double middle = (whole_.low[i] + whole_.high[i]) / 2, half = (whole_.high[i] - whole_.low[i]) / 2;
    box.low[i] = std::max(whole_.low[i], middle - scale * half);
    box.high[i] = std::min(whole_.high[i], middle + scale * half);
  }
  return box;
}

double Search::stepped(std::size_t side, double value, const Box& box) const {
  const double step = (whole_.high[side] - whole_.low[side]) / sizes;
  const double nearest = whole_.low[side] + step * std::round((value - whole_.low[side]) / step);
  return std::clamp(nearest, box.low[side], box.high[side]);
}

void Search::runAll(std::vector<Sample>& samples, const char* phase) {
  constexpr std::size_t stretch = 256;
  for (std::size_t begin = 0; begin < samples.size() && !stopped(); begin += stretch) {
    const std::size_t end = std::min(samples.size(), begin + stretch);
    arena_.execute([&] {
      tbb::parallel_for(begin, end,
                        [&](std::size_t i) { samples[i].run = program_.run(samples[i].values, samples[i].noise); });
    });
    if (stopped()) {
      samples.resize(begin);
      return;
    }
    if (options_.report) options_.report(phase, end, samples.size());
  }
}

/// False if one of them contradicts what is proven.
bool Search::keep(const std::vector<Sample>& samples) {
  for (const Sample& each : samples) {
    ++result_.samples;
    const bool proven = std::ranges::any_of(result_.parts, [&](const Part& part) {
      return part.verdict == Verdict::Proven && part.box.holds(each.values);
    });
    if (proven) ++result_.samplesInProven;
    if (!each.run.failure) continue;
    ++result_.failed;
    const double scale = distance(each.values);
    if (!result_.nearestFailure || scale < *result_.nearestFailure) result_.nearestFailure = scale;
    if (proven) result_.end = SurvivalEnd::Contradiction;
    if (result_.failures.size() < mostFailures || proven)
      result_.failures.push_back({each.number, each.values, each.noise, *each.run.failure});
  }
  return result_.end != SurvivalEnd::Contradiction;
}

void Search::sample() {
  std::vector<Sample> samples;
  const std::size_t corners = sides() <= 6 ? std::size_t{1} << sides() : mostCorners;
  const auto add = [&](std::vector<double> values) {
    const std::uint64_t number = samples.size();
    samples.push_back({number, std::move(values), seedOf(number), {}});
  };
  for (std::size_t corner = 0; corner < corners; ++corner) {
    std::vector<double> values;
    for (std::size_t i = 0; i < sides(); ++i)
      values.push_back((corner >> i & 1U) != 0 ? whole_.high[i] : whole_.low[i]);
    add(std::move(values));
  }
  for (std::uint64_t count = 0; count < options_.samples; ++count) {
    std::vector<double> values;
    for (std::size_t i = 0; i < sides(); ++i) {
      const double drawn = study::uniforms({options_.seed, samples.size()}, static_cast<std::uint32_t>(i))[0];
      values.push_back(whole_.low[i] + drawn * (whole_.high[i] - whole_.low[i]));
    }
    add(std::move(values));
  }
  runAll(samples, "clampings run");
  samples_ = std::move(samples);
  // Which of them lie in proven parts is told when the parts are known; the search wants the failures now.
  for (const Sample& each : samples_)
    if (each.run.failure) failed_.emplace_back(each.values, *each.run.failure);
}

std::vector<BoxVerdict> Search::tryAll(const std::vector<Box>& boxes) {
  std::vector<BoxVerdict> verdicts(boxes.size());
  arena_.execute([&] {
    tbb::parallel_for(std::size_t{0}, boxes.size(), [&](std::size_t i) { verdicts[i] = proveBox(program_, boxes[i]); });
  });
  result_.boxes += boxes.size();
  if (options_.report) options_.report("boxes tried", result_.boxes, options_.boxes);
  return verdicts;
}

const Reason* Search::failureIn(const Box& box) const {
  const auto found = std::ranges::find_if(failed_, [&](const auto& sample) { return box.holds(sample.first); });
  return found == failed_.end() ? nullptr : &found->second;
}

void Search::beginWithCore() {
  std::vector<double> scales;
  for (double scale = 1; scale > 1e-3; scale /= 2)
    if (failureIn(scaled(scale)) == nullptr) scales.push_back(scale);
  const auto largest = [&](std::vector<double>& tried) {
    tried.resize(std::min<std::size_t>(tried.size(), options_.boxes - result_.boxes));
    if (tried.empty()) return 0.0;
    std::vector<Box> boxes;
    for (const double scale : tried)
      boxes.push_back(scaled(scale));
    const auto verdicts = tryAll(boxes);
    double found = 0;
    for (std::size_t i = 0; i < verdicts.size(); ++i)
      if (verdicts[i].verdict == Verdict::Proven) found = std::max(found, tried[i]);
    return found;
  };
  double core = largest(scales);
  if (core > 0 && core < 1) {
    std::vector<double> between;
    for (int i = 1; i < 8; ++i)
      if (failureIn(scaled(core * (1 + i / 8.0))) == nullptr) between.push_back(core * (1 + i / 8.0));
    core = std::max(core, largest(between));
  }
  Box left = whole_;
  if (core > 0) {
    const Box inner = scaled(core);
    for (std::size_t i = 0; i < sides() && core < 1; ++i) {
      for (const bool above : {false, true}) {
        Box slab = left;
        (above ? slab.low[i] : slab.high[i]) = above ? inner.high[i] : inner.low[i];
        result_.parts.push_back({slab, Verdict::Undecided, {}, share(slab)});
        untried_.push_back(true);
      }
      left.low[i] = inner.low[i];
      left.high[i] = inner.high[i];
    }
    result_.parts.push_back({left, Verdict::Proven, {}, share(left)});
    untried_.push_back(false);
  } else {
    result_.parts.push_back({left, Verdict::Undecided, {}, 1});
    untried_.push_back(true);
  }
}

bool Search::split(const Part& part, Part& low, Part& high) const {
  std::size_t side = sides();
  double longest = 0;
  for (std::size_t i = 0; i < sides(); ++i) {
    const double width = part.box.high[i] - part.box.low[i];
    if (width < smallest * (whole_.high[i] - whole_.low[i])) continue;
    const double reach = program_.worlds().reachOf(i, part.box);
    if (side == sides() || reach > longest) {
      side = i;
      longest = reach;
    }
  }
  if (side == sides()) return false;
  low = high = {part.box, Verdict::Undecided, part.reason, part.share / 2};
  low.box.high[side] = high.box.low[side] = (part.box.low[side] + part.box.high[side]) / 2;
  return true;
}

void Search::refine() {
  std::vector<bool> final(result_.parts.size());  // too small to be split
  while (!stopped() && result_.boxes < options_.boxes) {
    // Parts that were not tried go first; then half of the batch goes to those next to the middle, which limit the
    // symmetric tolerance, and half to the largest.
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < result_.parts.size(); ++i)
      if (result_.parts[i].verdict != Verdict::Proven && !final[i]) open.push_back(i);
    if (open.empty()) return;
    const auto near = [&](std::size_t a, std::size_t b) {
      const double first = distance(result_.parts[a].box), second = distance(result_.parts[b].box);
      return first != second ? first < second : a < b;
    };
    const auto weight = [&](std::size_t i) {
      return result_.parts[i].share * (result_.parts[i].verdict == Verdict::Fails ? failing : 1);
    };
    const auto large = [&](std::size_t a, std::size_t b) {
      return weight(a) != weight(b) ? weight(a) > weight(b) : a < b;
    };
    std::vector<std::size_t> chosen;
    // Each of them becomes two boxes, unless it was not tried yet.
    const std::size_t most = std::clamp<std::size_t>((options_.boxes - result_.boxes) / 2, 1, batch);
    const auto take = [&](const auto& order, std::size_t count) {
      std::ranges::sort(open, order);
      for (const std::size_t i : open)
        if (chosen.size() < count && std::ranges::find(chosen, i) == chosen.end()) chosen.push_back(i);
    };
    take(near, (most + 1) / 2);
    take(large, most);
    std::vector<Box> boxes;
    std::vector<std::size_t> places;
    // What holds a failure cannot be proven.
    const auto wants = [&](std::size_t i) {
      Part& part = result_.parts[i];
      if (const Reason* failure = failureIn(part.box)) {
        part.verdict = Verdict::Fails;
        part.reason = *failure;
        untried_[i] = false;
        return;
      }
      boxes.push_back(part.box);
      places.push_back(i);
    };
    for (const std::size_t i : chosen) {
      if (untried_[i]) {
        wants(i);
        continue;
      }
      Part low, high;
      if (!split(result_.parts[i], low, high)) {
        final[i] = true;
        continue;
      }
      result_.parts[i] = std::move(low);
      result_.parts.push_back(std::move(high));
      final.push_back(false);
      untried_.push_back(true);
      untried_[i] = true;
      wants(i);
      // With one box left, the other half stays untried.
      if (result_.boxes + boxes.size() < options_.boxes) wants(result_.parts.size() - 1);
    }
    if (boxes.empty()) {
      if (std::ranges::all_of(chosen, [&](std::size_t i) { return final[i]; })) continue;
      ++result_.boxes;  // splitting alone must come to an end, too
      continue;
    }
    const auto verdicts = tryAll(boxes);
    for (std::size_t i = 0; i < verdicts.size(); ++i) {
      Part& part = result_.parts[places[i]];
      if (verdicts[i].verdict == Verdict::Cancelled) continue;
      part.verdict = verdicts[i].verdict;
      part.reason = verdicts[i].reason;
      untried_[places[i]] = false;
    }
  }
}

/// More clampings where nothing is proven.
void Search::sampleOpen() {
  std::vector<const Part*> open;
  double total = 0;
  for (const Part& part : result_.parts) {
    if (part.verdict == Verdict::Proven) continue;
    open.push_back(&part);
    total += part.share;
  }
  if (open.empty() || options_.samples == 0) return;
  std::vector<Sample> samples;
  for (std::uint64_t count = 0; count < options_.samples; ++count) {
    const std::uint64_t number = openSamplesFrom + count;
    double where = study::uniforms({options_.seed, number}, static_cast<std::uint32_t>(sides()))[0] * total;
    std::size_t place = 0;
    while (place + 1 < open.size() && where >= open[place]->share)
      where -= open[place++]->share;
    std::vector<double> values;
    for (std::size_t i = 0; i < sides(); ++i) {
      const double drawn = study::uniforms({options_.seed, number}, static_cast<std::uint32_t>(i))[0];
      values.push_back(open[place]->box.low[i] + drawn * (open[place]->box.high[i] - open[place]->box.low[i]));
    }
    samples.push_back({number, std::move(values), seedOf(number), {}});
  }
  runAll(samples, "clampings run where nothing is proven");
  for (const Sample& each : samples) {
    ++result_.openSamples;
    if (each.run.failure) ++result_.openFailures;
  }
  if (result_.openSamples > 0) result_.openProbability = study::probability(result_.openFailures, result_.openSamples);
  keep(samples);
}

/// Clampings in the proven parts: a mistake of the proof shows. Half of them lie anywhere, half on borders and corners
/// of the parts, where things are farthest from the middle. False if one fails.
bool Search::checkProven() {
  std::vector<const Part*> proven;
  std::vector<double> ends;  // of the shares, one behind the other
  double total = 0;
  for (const Part& part : result_.parts) {
    if (part.verdict != Verdict::Proven) continue;
    proven.push_back(&part);
    ends.push_back(total += part.share);
  }
  if (proven.empty()) return true;
  constexpr std::uint64_t atOnce = 4096;
  for (std::uint64_t begin = 0; begin < options_.checks && !stopped(); begin += atOnce) {
    std::vector<Sample> samples;
    for (std::uint64_t number = checksFrom + begin; number < checksFrom + std::min(options_.checks, begin + atOnce);
         ++number) {
      const auto draw = [&](std::size_t i) {
        return study::uniforms({options_.seed, number}, static_cast<std::uint32_t>(i))[0];
      };
      const bool onBorder = number % 2 == 1;
      // On borders any part as often, otherwise as often as its share says.
      const double where = draw(sides());
      const std::size_t place =
          onBorder ? static_cast<std::size_t>(where * static_cast<double>(proven.size()))
                   : static_cast<std::size_t>(std::ranges::upper_bound(ends, where * total) - ends.begin());
      const Box& box = proven[std::min(place, proven.size() - 1)]->box;
      std::vector<double> values;
      for (std::size_t i = 0; i < sides(); ++i) {
        // On borders a third of the sides is at its lower end, a third at its upper one.
        const double drawn = onBorder ? std::clamp(3 * draw(i) - 1, 0.0, 1.0) : draw(i);
        const double value = box.low[i] + drawn * (box.high[i] - box.low[i]);
        values.push_back(result_.tolerances[i].kind == NumberKind::Size ? stepped(i, value, box) : value);
      }
      samples.push_back({number, std::move(values), seedOf(number), {}});
    }
    runAll(samples, "clampings run in the proven part");
    if (!keep(samples)) return false;
  }
  return true;
}

void Search::count() {
  result_.symmetric = 1;
  std::map<std::pair<std::string, std::uint64_t>, BlockRecord> blocks;
  const auto record = [&](const Reason& reason) -> BlockRecord& {
    BlockRecord& block = blocks[{reason.place.file, reason.place.line}];
    block.place = reason.place;
    if (block.why.empty()) block.why = reason.why;
    return block;
  };
  for (const Failure& failure : result_.failures)
    ++record(failure.reason).failures;
  for (const Part& part : result_.parts) {
    if (part.verdict == Verdict::Proven) {
      result_.proven += part.share;
      continue;
    }
    (part.verdict == Verdict::Fails ? result_.fails : result_.undecided) += part.share;
    result_.symmetric = std::min(result_.symmetric, distance(part.box));
    if (part.reason) record(*part.reason).share += part.share;
  }
  for (auto& [place, block] : blocks)
    if (block.place.line > 0) result_.blocks.push_back(std::move(block));
  std::ranges::stable_sort(result_.blocks, [](const BlockRecord& a, const BlockRecord& b) {
    return a.failures != b.failures ? a.failures > b.failures : a.share > b.share;
  });
}

Survival Search::run() {
  if (program_.failureAsWritten()) {
    result_.end = SurvivalEnd::FailsAsWritten;
    result_.asWritten = program_.failureAsWritten();
    result_.parts.push_back({whole_, Verdict::Undecided, result_.asWritten, 1});
    count();
    return std::move(result_);
  }
  result_.obstacle = program_.obstacle();
  sample();
  if (result_.obstacle) {
    result_.parts.push_back({whole_, Verdict::Undecided, result_.obstacle, 1});
  } else if (!stopped()) {
    beginWithCore();
    refine();
  }
  if (result_.parts.empty()) result_.parts.push_back({whole_, Verdict::Undecided, {}, 1});
  if (keep(samples_) && checkProven() && !stopped()) sampleOpen();
  count();
  if (stopped() && result_.end == SurvivalEnd::Finished) result_.end = SurvivalEnd::Interrupted;
  return std::move(result_);
}

}  // namespace

Survival survive(const ClampedProgram& program, const Options& options) { return Search(program, options).run(); }

}  // namespace probewright::survival
