#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <string_view>

#include "cache_folder.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "interruption.hpp"
#include "setup/setup_on_machine.hpp"
#include "shared_feeling.hpp"
#include "simulation/feeling_probe.hpp"
#include "simulation/virtual_machine.hpp"

namespace probewright::app {
namespace {

using std::chrono::nanoseconds;

/// What this thread has taken of the processor: what other programs take of it meanwhile does not count.
nanoseconds worked() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return std::chrono::seconds(time.tv_sec) + nanoseconds(time.tv_nsec);
}

constexpr std::string_view letters = "XYZABCUVW";
static_assert(letters.size() == FEEL_AXES);

/// Which value of the question is which axis of the machine.
Result<std::vector<std::size_t>> placesOf(const machine::MachineDescription& machine, std::uint32_t connected) {
  std::vector<std::size_t> places;
  for (const machine::Axis& axis : machine.axes) {
    const std::size_t letter = axis.name.size() == 1 ? letters.find(axis.name.front()) : std::string_view::npos;
    if (letter == std::string_view::npos || ((connected >> letter) & 1U) == 0) {
      return fail(fmt::format("the machine of the setup has an axis {}, the LinuxCNC configuration has not", axis.name),
                  "Name a machine in the setup that has the axes of the configuration: [machine] file = \"...\"");
    }
    places.push_back(letter);
  }
  return places;
}

std::uint32_t bitsOf(const simulation::Felt& felt) {
  return (felt.touch ? unsigned{FEEL_TOUCH} : 0U) | (felt.toolTouch ? unsigned{FEEL_TOOL_TOUCH} : 0U) |
         (felt.collision ? unsigned{FEEL_COLLISION} : 0U) | (felt.byStylus ? unsigned{FEEL_BY_STYLUS} : 0U);
}

/// How long answers took.
struct Answers {
  std::uint64_t count = 0;
  nanoseconds sum{}, longest{};
  void add(nanoseconds took) {
    ++count;
    sum += took;
    longest = std::max(longest, took);
  }
  std::string text() const {
    if (count == 0) return "nothing was asked";
    const auto microseconds = [](nanoseconds time) { return std::chrono::duration<double, std::micro>(time).count(); };
    return fmt::format(
        "{} positions asked about, answered in {:.1f} microseconds of the processor on average, {:.0f} at most", count,
        microseconds(sum) / static_cast<double>(count), microseconds(longest));
  }
};

}  // namespace

int feel(const FeelArguments& arguments) {
  Diagnostics mistakes;
  const std::optional<setup::Setup> setup = setup::readSetupOn(arguments.machineFile, arguments.setup, mistakes,
                                                               [](const std::filesystem::path&) { return true; });
  // What the control believes plays no part here, neither do its tables.
  std::erase_if(mistakes, [](const Diagnostic& each) { return each.severity == Severity::Note; });
  print(mistakes);
  if (!setup) return 2;
  const Interruption interruption;
  simulation::ImportOptions import;
  import.cache = cacheFolder(arguments.cache);
  import.stop = interruption.token();
  auto machine = simulation::buildMachine(setup->world, import);
  if (!machine) {
    print({machine.error()});
    return import.stop.stop_requested() ? 3 : 2;
  }
  const auto say = [&](const std::string& what) {
    if (!arguments.quiet) std::fputs(("probewright: " + printable(what) + "\n").c_str(), stderr);
  };
  simulation::FeelingProbe probe((*machine)->truth(), setup->world.toolInSpindle);
  probe.onEvent(say);
  auto shared = SharedFeeling::open(arguments.segment, std::chrono::seconds(30), interruption.token());
  if (!shared) {
    print({shared.error()});
    return 2;
  }
  const auto places = placesOf((*machine)->description(), shared->memory().axes);
  if (!places) {
    print({places.error()});
    return 2;
  }
  say(fmt::format("feels what \"{}\" holds", setup->world.file));
  Answers answers;
  std::uint32_t resets = shared->memory().resets;
  shared->serve(
      [&](const feel_exchange& question) {
        const nanoseconds begin = worked();
        simulation::Moment moment;
        for (std::size_t i = 0; i < places->size(); ++i)
          moment.axes[i] = question.axis[(*places)[i]];
        moment.tool = question.tool;
        moment.spindleSpeed = question.spindle_speed;
        moment.spindleAngle = question.spindle_angle;
        moment.seconds = question.seconds;
        if (question.resets != resets) probe.pullOff();
        resets = question.resets;
        const std::uint32_t bits = bitsOf(probe.feel(moment));
        answers.add(worked() - begin);
        return bits;
      },
      interruption.token());
  say(answers.text());
  return interruption.token().stop_requested() ? 3 : 0;
}

}  // namespace probewright::app
