#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/number_text.hpp"
#include "control/sinumerik/tool_data.hpp"
#include "session/sinumerik/beliefs.hpp"
#include "simulation/tool_shape.hpp"
#include "truth/entries.hpp"
#include "truth/family_truth.hpp"
#include "truth/feeling.hpp"
#include "truth/tool_numbers.hpp"

namespace probewright::truth {

namespace {

using control::BelievedTool;
using control::sinumerik::DataIndex;
using control::sinumerik::DataKey;
using control::sinumerik::DataStore;
using control::sinumerik::isToolSize;
using control::sinumerik::ToolEdge;
using records::EntryKind;

/// Turning tools as they are now: their inserts stand beside the axis, and have lost something.
control::Beliefs withInserts(control::Beliefs calibrated, const simulation::Truth& truth) {
  for (BelievedTool& tool : calibrated.tools) {
    const simulation::TrueTool* planted = toolNumbered(truth, tool.number);
    if (tool.kind != "turn" || planted == nullptr || !planted->cutter.insert) continue;
    const Vector3 tip = trueTip(*planted);
    if (calibrated.technology == control::Technology::Turning) {
      const Vector3 aside =
          Eigen::AngleAxisd(radiansFromDegrees(planted->cutter.insert->orientation), Vector3::UnitZ()) *
          Vector3(tip.x(), tip.y(), tip.z() + planted->length);
      tool.mount += simulation::toolFrame(*planted) * aside;
    } else {
      tool.length = -tip.z();
    }
  }
  return calibrated;
}

/// What the setup tells of sizes beside its tools is belief.
control::Beliefs withoutSizes(control::Beliefs calibrated) {
  std::erase_if(calibrated.parameters, [](const auto& parameter) {
    return control::sinumerik::isToolSize(parameter.first.substr(0, parameter.first.find('[')));
  });
  return calibrated;
}

/// What the truth lines of tools are made of.
struct Compared {
  DataStore before;  ///< what the control began with
  DataStore ideal;   ///< what it would have begun with, everything measured without an error
  WrittenValues written;
  const std::vector<BelievedTool>& tools;
  bool lathe = false;
};

/// The numbers between brackets: "[12,1]".
std::vector<int> indicesOf(const std::string& entry) {
  std::vector<int> indices;
  std::string digits;
  for (const char c : entry) {
    if (c >= '0' && c <= '9') {
      digits += c;
    } else if (!digits.empty()) {
      indices.push_back(std::stoi(digits.substr(0, 9)));
      digits.clear();
    }
  }
  return indices;
}

constexpr std::string_view countsAsDiameter = "$MC_TOOL_PARAMETER_DEF_MASK", lengthType = "$SC_TOOL_LENGTH_TYPE";

/// The data as the run left them, as far as lengths and radii of tools depend on them.
DataStore asLeft(DataStore data, const WrittenValues& written) {
  for (const auto& [place, value] : written) {
    if (!isToolSize(place.first) && place.first != countsAsDiameter && place.first != lengthType) continue;
    const std::vector<int> numbers = indicesOf(place.second);
    data.set(DataKey(place.first, std::vector<DataIndex>(numbers.begin(), numbers.end())), value.value);
  }
  return data;
}

/// What a control adds up: length 1, length 2, the radius.
struct ToolDimension {
  const char* label;
  int parameter;  ///< $TC_DP3.. of its geometry
  bool of(std::string_view name) const {
    const auto number = parseInteger(name.substr(std::min(name.size(), std::string_view("$TC_DP").size())));
    if (const auto dl = control::sinumerik::offsetNumber(name))
      return name.ends_with(std::to_string(10 * *dl + parameter));
    return control::sinumerik::isToolSize(name) &&
           (number == parameter || number == parameter + 9 || number == parameter + 18);
  }
  double in(const ToolEdge& edge) const {
    return parameter == 6 ? edge.totalRadius() : edge.totalLength()[static_cast<std::size_t>(parameter - 3)];
  }
};
constexpr ToolDimension dimensions[] = {{"length 1", 3}, {"length 2", 4}, {"radius", 6}};

/// An edge of a tool, with the offsets of a DL number.
struct EdgeName {
  int tool = 0, edge = 1, dl = 0;
  auto operator<=>(const EdgeName&) const = default;
  std::string text() const {
    return fmt::format("tool {}{}{}", tool, edge == 1 ? "" : fmt::format(" D{}", edge),
                       dl == 0 ? "" : fmt::format(" DL{}", dl));
  }
};

/// The cycle that wrote a number of an edge last, if anything of it was written.
using LastWriter = std::map<std::pair<EdgeName, const ToolDimension*>, std::optional<std::size_t>>;

LastWriter lastWriters(const WrittenValues& written) {
  LastWriter writers;
  for (const auto& [place, value] : written) {
    const auto dimension =
        std::ranges::find_if(dimensions, [&edge = place.first](const ToolDimension& each) { return each.of(edge); });
    const std::vector<int> numbers = indicesOf(place.second);
    if (dimension == std::end(dimensions) || numbers.size() != 2) continue;
    const EdgeName name{numbers[0], numbers[1], control::sinumerik::offsetNumber(place.first).value_or(0)};
    auto& writer = writers[{name, dimension}];
    writer = std::max(writer, value.cycle);
  }
  return writers;
}

bool measuresTools(const control::CycleRecord& cycle) { return cycle.name == "CYCLE971" || cycle.name == "CYCLE982"; }

/// CYCLE982 measures the rear side of a disc cutter: its length then ends there.
bool measuresRearSide(const control::CycleRecord& cycle) {
  return cycle.name == "CYCLE982" && static_cast<int>(valueOf(cycle, "S_MVAR").value_or(0)) / 1000 % 10 == 3;
}

/// What is to be added to the number of a tool as drawn: the tooth that goes furthest.
double beyondDrawing(const ToolDimension& dimension, const BelievedTool& tool, const simulation::TrueTool* planted,
                     bool rear, bool lathe) {
  const ToolReach reach = reachOf(planted);
  if (dimension.parameter == 6) return reach.radius;
  const double along = rear ? -reach.rear : reach.length;
  if (!lathe) return dimension.parameter == 3 ? along : 0;
  return along * tool.shankDirection[dimension.parameter == 3 ? 0 : 2];
}

void toolSizes(CollectedEntries& entries, const session::RunOutcome& outcome, const Compared& compared,
               const simulation::Truth& truth) {
  const auto& cycles = outcome.journal.cycles;
  const DataStore left = asLeft(compared.before, compared.written);
  for (const auto& [what, writer] : lastWriters(compared.written)) {
    const auto& [name, dimension] = what;
    const auto tool = std::ranges::find(compared.tools, name.tool, &BelievedTool::number);
    if (tool == compared.tools.end()) continue;
    // On a lathe setups tell lengths as of turning tools. Where those of drills act as on mills, they are other
    // numbers.
    const bool asOnMills =
        compared.lathe && tool->kind != "turn" && left.number(DataKey(std::string(lengthType), {})) != 2;
    if (asOnMills && dimension->parameter != 6) continue;
    const control::CycleRecord* cycle = writer ? &cycles[*writer] : nullptr;
    // A second edge is what the control measured at the same end, or at the rear side, of a tool that turns.
    if (name.edge != 1 && (tool->kind == "turn" || cycle == nullptr || !measuresTools(*cycle))) continue;
    const auto believed = toolEdge(left, name.tool, name.edge, name.dl), drawn = toolEdge(compared.ideal, name.tool, 1);
    if (!believed || !drawn || !compared.ideal.isSet({fmt::format("$TC_DP{}", dimension->parameter), {name.tool, 1}}))
      continue;
    const double real =
        dimension->in(*drawn) + beyondDrawing(*dimension, *tool, toolNumbered(truth, name.tool),
                                              cycle != nullptr && measuresRearSide(*cycle), compared.lathe);
    entries.add(tool->kind == "probe" ? EntryKind::Probe : EntryKind::Tool, name.text(), writer,
                {dimension->label, "mm", dimension->in(*believed), real});
  }
}

void calibrationData(CollectedEntries& entries, const Compared& compared) {
  for (const auto& [place, value] : compared.written) {
    const bool probe = place.first.starts_with("$SNS_MEA_WP_"), toolProbe = place.first.starts_with("$SNS_MEA_TP_");
    const bool length = place.first.find("TRIG_") != std::string::npos || place.first.ends_with("BALL_DIAM") ||
                        place.first.find("POS_DEV_") != std::string::npos;
    const std::vector<int> indices = indicesOf(place.second);
    if (!(probe || toolProbe) || !length || indices.size() != 1) continue;
    const DataKey key(place.first, {indices[0]});
    if (!compared.ideal.isSet(key)) continue;
    entries.add(EntryKind::Probe, fmt::format("{} data {}", probe ? "probe" : "tool probe", indices[0] + 1),
                value.cycle, {place.first.substr(12), "mm", value.value, compared.ideal.number(key)});
  }
}

}  // namespace

std::vector<records::EntryTruth> sinumerikToolEntries(const session::RunOutcome& outcome,
                                                      const control::Beliefs& beliefs,
                                                      const control::Beliefs& calibrated,
                                                      const simulation::Truth& truth) {
  Diagnostics ignored;
  const Compared compared{
      .before = session::sinumerik::sinumerikData(beliefs, ignored).store,
      .ideal = session::sinumerik::sinumerikData(withInserts(withoutSizes(calibrated), truth), ignored).store,
      .written = writtenValues(outcome.journal),
      .tools = calibrated.tools,
      .lathe = calibrated.technology == control::Technology::Turning};
  CollectedEntries entries;
  toolSizes(entries, outcome, compared, truth);
  calibrationData(entries, compared);
  return entries.take();
}

}  // namespace probewright::truth
