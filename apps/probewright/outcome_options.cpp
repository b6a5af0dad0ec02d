#include <memory>

#include "commands.hpp"
#include "options.hpp"
#include "subcommands.hpp"

namespace probewright::app {

Subcommand addCompare(CLI::App& app) {
  const auto arguments = std::make_shared<CompareArguments>();
  CLI::App* compare = app.add_subcommand("compare", "What two runs measured and wrote, side by side");
  compare->add_option("FIRST", arguments->first, "The folder of a run, or its results.json")->required();
  compare->add_option("SECOND", arguments->second, "Another one")->required();
  compare->add_option("--tolerance", arguments->tolerance, "Differences up to this do not count, mm and degrees")
      ->check(finite)
      ->check(CLI::Range(0.0, 1000.0))
      ->type_name("MM")
      ->capture_default_str();
  compare->add_flag("--all", arguments->all, "Also values and entries that are alike");
  compare->add_flag("--json", arguments->asJson, "Everything, as JSON for other programs");
  compare->footer("Exit codes: 0 alike, 1 they differ, 2 a mistake in the input.");
  return {compare, [arguments] { return app::compare(*arguments); }};
}

Subcommand addCamera(CLI::App& app) {
  const auto arguments = std::make_shared<CameraArguments>();
  CLI::App* camera = app.add_subcommand("camera", "List and manage the images that cycles 600 and 601 have stored");
  camera->add_option("FOLDER", arguments->folder, "The folder of tables that a run has left")->required();
  camera->add_option("POINT", arguments->point, "A monitoring point, as PLATE.OS; without it all are listed");
  camera
      ->add_option("--keys", arguments->keys,
                   "Soft keys to press, as \"SELECT IMAGE 3; REFERENCE IMAGE; EVALUATE\" (docs/heidenhain-cycles.md)")
      ->type_name("KEYS");
  return {camera, [arguments] { return app::camera(*arguments); }};
}

}  // namespace probewright::app
