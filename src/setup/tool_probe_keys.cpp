#include "setup/tool_probe_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>

#include "setup/shape_keys.hpp"

namespace probewright::setup {

using simulation::ContactElement;
using simulation::ToolProbeContact;
using simulation::TrueToolProbe;

namespace {

/// "+X -X -Z": the directions in which the contact can be pushed.
void readDirections(TomlReader& reader, TrueToolProbe& probe) {
  const auto text = reader.text("directions");
  if (!text) return;
  static constexpr std::array<std::string_view, 6> names = {"+X", "-X", "+Y", "-Y", "+Z", "-Z"};
  probe.gives.fill(false);
  std::istringstream words(*text);
  for (std::string word; words >> word;) {
    const auto found = std::ranges::find(names, word);
    if (found == names.end()) {
      reader.report("directions", fmt::format("\"{}\" is not a direction of the contact", word),
                    "Write those in which it can be pushed: directions = \"+X -X +Y -Y -Z\"");
      return;
    }
    probe.gives[static_cast<std::size_t>(found - names.begin())] = true;
  }
  if (std::ranges::none_of(probe.gives, [](bool gives) { return gives; }))
    reader.report("directions", "a contact that gives way in no direction never signals");
}

}  // namespace

SetupToolProbe readToolProbe(TomlReader& reader) {
  SetupToolProbe read;
  TrueToolProbe& probe = read.probe;
  probe.name = reader.text("name").value_or(probe.name);
  ToolProbeContact contact;
  if (reader.has("diameter") == reader.has("size")) {
    reader.report("diameter", "the contact of a tool touch probe needs either a diameter or a size",
                  "Write diameter = 40 for a disc, size = [25, 25] for a cuboid");
  }
  contact.diameter = reader.number("diameter", anyLength).value_or(contact.diameter);
  if (const auto size = readVector2(reader, "size", anyLength)) {
    contact.length = size->x();
    contact.width = size->y();
  }
  contact.thickness = reader.number("thickness", anyLength).value_or(contact.thickness);
  contact.stemDiameter = reader.number("stem_diameter", anyLength).value_or(contact.stemDiameter);
  contact.stemLength = reader.number("stem_length", anyLength).value_or(contact.stemLength);
  const double across = contact.length > 0 ? std::min(contact.length, contact.width) : contact.diameter;
  if (contact.stemDiameter >= across) reader.report("stem_diameter", "the stem must be thinner than the contact");
  readDirections(reader, probe);
  probe.pretravel = reader.number("pretravel", {-1, 1}).value_or(0);
  probe.repeatability = reader.number("repeatability", {0, 1}).value_or(0);
  probe.signalDelay = reader.number("signal_delay", {0, 1}).value_or(0);
  probe.switchedOn = reader.boolean("switched_on").value_or(true);
  probe.tableFromContact = readPose(reader);
  probe.contact = std::make_shared<ContactElement>(
      (contact.length > 0 ? ContactElement::cuboid(contact.length, contact.width, contact.thickness)
                          : ContactElement::disc(contact.diameter, contact.thickness))
          .on(contact.stemDiameter, contact.stemLength));
  probe.cuboid = contact.length > 0;
  read.recipe = simulation::toolProbeContact(contact);
  return read;
}

}  // namespace probewright::setup
