#include "setup/machine_body_keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/text.hpp"
#include "machine/machine_text.hpp"
#include "setup/shape_keys.hpp"

namespace probewright::setup {

namespace fs = std::filesystem;

namespace {

std::optional<machine::Link> readLink(TomlReader& reader, const machine::MachineDescription& machine) {
  const auto name = reader.requiredText("link");
  if (!name) return std::nullopt;
  const auto link = machine::linkNamed(machine, *name);
  if (link) return link;
  std::vector<std::string> known = {"bed", "table", "head"};
  for (const machine::Axis& axis : machine.axes)
    known.push_back(axis.name);
  const auto near = nearestName(*name, known);
  reader.report("link", fmt::format("there is no axis called {}", *name),
                near ? fmt::format("Did you mean \"{}\"?", *near)
                     : fmt::format("Name what carries the body: {}", fmt::join(known, ", ")));
  return std::nullopt;
}

}  // namespace

std::optional<fs::path> readShapeFile(TomlReader& reader, const fs::path& folder) {
  const auto file = reader.text("file");
  if (!file) return std::nullopt;
  fs::path path = *file;
  if (!path.is_absolute()) path = folder / path;
  const std::string ending = lowerCase(path.extension().string());
  static const std::vector<std::string> known = {".step", ".stp", ".iges", ".igs", ".stl"};
  if (std::ranges::find(known, ending) == known.end()) {
    reader.report("file", fmt::format("\"{}\" is not a part file that can be read", *file),
                  "Files end in .step, .stp, .iges, .igs or .stl");
  }
  return path;
}

void readBodies(TomlReader& owner, const machine::MachineDescription& machine, const fs::path& folder,
                std::vector<simulation::WorldBody>& bodies, std::vector<fs::path>& inputs) {
  for (TomlReader& reader : owner.tables("body")) {
    simulation::WorldBody body;
    const auto link = readLink(reader, machine);
    body.link = link.value_or(machine::Link{});
    body.name = reader.text("name").value_or(
        body.link.isBed() ? "bed" : fmt::format("body of {}", machine::nameOf(machine, body.link)));
    body.source.place = reader.placeOf("file");
    if (reader.has("file") == reader.has("feature")) {
      reader.report("file", fmt::format("{} needs either a file or features", reader.name()),
                    "Write file = \"trunnion.step\" or describe the shape under [[body.feature]]");
    }
    body.source.recipe = readRecipe(reader);
    if (auto file = readShapeFile(reader, folder)) {
      body.source.file = *std::move(file);
      inputs.push_back(body.source.file);
    }
    body.linkFromSolid = readPose(reader);
    reader.finish();
    bodies.push_back(std::move(body));
  }
}

void readBodiesOf(const std::string& nameOrPath, const machine::MachineDescription& machine, Diagnostics& diagnostics,
                  std::vector<simulation::WorldBody>& bodies, std::vector<fs::path>& inputs) {
  const auto text = machine::machineText(nameOrPath);
  if (!text) return;
  const auto root = parseToml(text->text, text->file, diagnostics);
  if (!root) return;
  TomlReader reader(*root, "", text->file, diagnostics);
  readBodies(reader, machine, fs::path(text->file).parent_path(), bodies, inputs);
}

}  // namespace probewright::setup
