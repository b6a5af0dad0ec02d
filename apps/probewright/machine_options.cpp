#include <memory>

#include "commands.hpp"
#include "options.hpp"
#include "subcommands.hpp"

namespace probewright::app {

Subcommand addMachine(CLI::App& app) {
  const auto arguments = std::make_shared<MachineArguments>();
  CLI::App* machinePage =
      app.add_subcommand("machine", "Check a machine file, and write a page that moves each of its axes");
  machinePage
      ->add_option("MACHINE", arguments->machine,
                   "A machine file, the .ini of a LinuxCNC configuration, a setup, or the name of a ready-made machine")
      ->required();
  machinePage->add_option("--out", arguments->out, "The page to write")->capture_default_str()->type_name("FILE");
  machinePage->add_flag("--force", arguments->force, "Overwrite the file also if it is not the page of a machine");
  return {machinePage, [arguments] { return app::machine(*arguments); }};
}

Subcommand addFeel(CLI::App& app) {
  const auto arguments = std::make_shared<FeelArguments>();
  CLI::App* feel = app.add_subcommand(
      "feel", "Give a simulated LinuxCNC machine a probe that feels the part of a setup (see docs/linuxcnc.md)");
  feel->add_option("SETUP", arguments->setup, "The world to feel; only its truth counts")->required();
  addMachineFile(*feel, arguments->machineFile);
  feel->add_option("--segment", arguments->segment, "Shared memory that the HAL component has made")
      ->type_name("NAME")
      ->capture_default_str();
  feel->add_option("--cache", arguments->cache, "As for run")->type_name("DIR");
  feel->add_flag("--quiet", arguments->quiet, "Print nothing but mistakes");

  return {feel, [arguments] { return app::feel(*arguments); }};
}

}  // namespace probewright::app
