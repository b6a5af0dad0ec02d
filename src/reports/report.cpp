#include "reports/report.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>

#include "records/readable_text.hpp"
#include "records/results.hpp"
#include "reports/base64.hpp"
#include "reports/embedded.hpp"
#include "reports/machine_scene.hpp"
#include "reports/packed_text.hpp"
#include "words/cycle_words.hpp"
#include "words/own_words.hpp"
#include "words/words.hpp"

namespace probewright::reports {

using nlohmann::json;

namespace {

std::vector<float> coordinates(const std::vector<Vector3f>& points) {
  std::vector<float> values;
  values.reserve(3 * points.size());
  for (const Vector3f& p : points)
    values.insert(values.end(), {p.x(), p.y(), p.z()});
  return values;
}

/// Unit vectors in four signed bytes each, as graphics hardware likes them.
std::vector<std::int8_t> packedDirections(const std::vector<Vector3f>& directions) {
  std::vector<std::int8_t> values;
  values.reserve(4 * directions.size());
  for (const Vector3f& d : directions) {
    for (const float component : {d.x(), d.y(), d.z()})
      values.push_back(static_cast<std::int8_t>(std::lround(127 * std::clamp(component, -1.0F, 1.0F))));
    values.push_back(0);
  }
  return values;
}

/// Column by column.
json matrix(const Pose& pose) {
  json array = json::array();
  const Eigen::Matrix4d m = pose.matrix();
  for (Eigen::Index i = 0; i < 16; ++i)
    array.push_back(m.data()[i]);
  return array;
}

std::string_view roleName(MeshRole role) {
  switch (role) {
    case MeshRole::Part:
      return "part";
    case MeshRole::Fixture:
      return "fixture";
    case MeshRole::Artefact:
      return "artefact";
  }
  return "part";
}

json meshData(const Mesh& mesh, const records::ReadableText& readable) {
  return {{"name", readable(mesh.name)},
          {"role", roleName(mesh.role)},
          {"pose", matrix(mesh.sceneFromMesh)},
          {"positions", base64(coordinates(mesh.positions))},
          {"normals", base64(packedDirections(mesh.normals))},
          {"triangles", base64(mesh.triangles)},
          {"edges", base64(coordinates(mesh.featureEdges))}};
}

json toolData(const Mesh& tool, const records::ReadableText& readable) {
  return {{"name", readable(tool.name)},
          {"positions", base64(coordinates(tool.positions))},
          {"normals", base64(packedDirections(tool.normals))},
          {"triangles", base64(tool.triangles)},
          {"edges", base64(coordinates(tool.featureEdges))}};
}

json cameraData(const std::vector<CameraShot>& shots, const records::ReadableText& readable) {
  json data = json::array();
  for (const CameraShot& shot : shots) {
    data.push_back({{"cycle", shot.cycle},
                    {"point", readable(shot.point)},
                    {"number", shot.number},
                    {"references", shot.references},
                    {"errors", shot.errors},
                    {"reference", base64(shot.reference)},
                    {"taken", base64(shot.taken)},
                    {"evaluated", base64(shot.evaluated)}});
  }
  return data;
}

/// Of each axis its readings on the path.
json axesOf(const Path& path, std::size_t count) {
  json axes = json::array();
  for (std::size_t axis = 0; axis < count && !path.axes.empty(); ++axis) {
    std::vector<float> values;
    for (const machine::AxisPositions& point : path.axes)
      values.push_back(static_cast<float>(point[axis]));
    // What stands all the time is one number.
    const bool stands = std::ranges::adjacent_find(values, std::not_equal_to()) == values.end();
    axes.push_back(stands ? json(values.front()) : json(base64(values)));
  }
  return axes;
}

json sceneData(const Scene& scene, std::size_t axisCount, const records::ReadableText& readable) {
  json meshes = json::array();
  for (const Mesh& mesh : scene.meshes)
    meshes.push_back(meshData(mesh, readable));
  json tools = json::array();
  for (const Mesh& tool : scene.tools)
    tools.push_back(toolData(tool, readable));
  std::vector<std::int32_t> changes, touching;
  for (const Path::ToolFrom& change : scene.path.tools)
    changes.insert(changes.end(), {static_cast<std::int32_t>(change.point), change.tool});
  std::vector<std::uint32_t> indices;
  std::vector<Vector3f> centres, surfaces, axes;
  for (const SceneTouch& touch : scene.touches) {
    indices.insert(indices.end(), {touch.cycle, touch.touch});
    centres.push_back(touch.ballCentre);
    surfaces.push_back(touch.surface);
    touching.push_back(touch.tool);
    axes.push_back(touch.toolAxis);
  }
  // Most machines hold the tool upright all the time: nothing to say then.
  if (std::ranges::all_of(axes, [](const Vector3f& axis) { return axis.isApprox(Vector3f::UnitZ()); })) axes.clear();
  json collisions = json::array();
  for (const SceneCollision& collision : scene.collisions) {
    collisions.push_back({{"at", {collision.at.x(), collision.at.y(), collision.at.z()}},
                          {"what", readable(collision.what)},
                          {"solid", readable(collision.solid)}});
  }
  std::vector<std::uint8_t> kinds;
  for (const MoveKind kind : scene.path.kinds)
    kinds.push_back(static_cast<std::uint8_t>(kind));
  return {{"meshes", std::move(meshes)},
          {"path",
           {{"points", base64(coordinates(scene.path.points))},
            {"kinds", base64(kinds)},
            {"seconds", base64(scene.path.seconds)},
            {"toolAxes", base64(coordinates(scene.path.toolAxes))},
            {"axes", axesOf(scene.path, axisCount)},
            {"tools", base64(changes)}}},
          {"tools", std::move(tools)},
          {"touches",
           {{"indices", base64(indices)},
            {"centres", base64(coordinates(centres))},
            {"surfaces", base64(coordinates(surfaces))},
            {"axes", base64(coordinates(axes))},
            {"tools", base64(touching)}}},
          {"collisions", std::move(collisions)},
          {"camera", cameraData(scene.camera, readable)},
          {"machine", scene.machine ? machineData(*scene.machine) : json(nullptr)},
          {"ballRadius", scene.ballRadius},
          {"lathe", scene.lathe},
          {"workpiece", scene.sceneFromWorkpiece ? matrix(*scene.sceneFromWorkpiece) : json(nullptr)}};
}

std::vector<std::string_view> splitLines(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    lines.push_back(line);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

/// The lines of each file that the journal speaks of, 1-based.
std::map<std::string, std::set<std::uint64_t>> linesOfInterest(const control::Journal& journal) {
  std::map<std::string, std::set<std::uint64_t>> lines;
  for (const auto& cycle : journal.cycles)
    lines[cycle.place.file].insert(cycle.place.line);
  for (const auto& event : journal.events)
    lines[event.place.file].insert(event.place.line);
  return lines;
}

/// A program in pieces of consecutive lines: one piece if it is short, the surroundings of `interest` otherwise.
json programData(const records::ProgramSource& source, const std::set<std::uint64_t>& interest, std::size_t longest) {
  constexpr std::uint64_t before = 10, after = 30;
  const std::string text = language::toUtf8(source.text, language::detectEncoding(source.text));
  const auto lines = splitLines(text);
  json pieces = json::array();
  const auto add = [&](std::uint64_t line) {
    if (pieces.empty() || pieces.back()["first"].get<std::uint64_t>() + pieces.back()["lines"].size() != line)
      pieces.push_back({{"first", line}, {"lines", json::array()}});
    pieces.back()["lines"].push_back(lines[line - 1]);
  };
  if (lines.size() <= longest) {
    for (std::uint64_t line = 1; line <= lines.size(); ++line)
      add(line);
  } else {
    std::uint64_t next = 1;
    for (const std::uint64_t centre : interest) {
      next = std::max(next, centre > before ? centre - before : 1);
      for (; next <= std::min<std::uint64_t>(centre + after, lines.size()); ++next)
        add(next);
    }
  }
  return {{"pieces", std::move(pieces)}, {"lineCount", lines.size()}};
}

/// Lengths and angles in steps of 0.0001, as a control shows them.
std::int32_t displayed(double value) {
  constexpr double steps = 1e4, most = 2e9;
  return static_cast<std::int32_t>(std::lround(std::clamp(value * steps, -most, most)));
}

/// What a replay shows; null if nothing was recorded.
json traceData(const records::RunTrace& trace, const std::vector<machine::Axis>& axes,
               const records::ReadableText& readable) {
  if (trace.blocks.empty()) return nullptr;
  json files = json::array(), states = json::array(), names = json::array();
  for (const std::string& file : trace.files)
    files.push_back(readable(file));
  for (const auto& state : trace.states) {
    states.push_back({{"tool", readable(state.tool)},
                      {"preset", readable(state.preset)},
                      {"follows", state.follows == records::RunTrace::State::Follows::Table ? "table" : "axes"},
                      {"frame", matrix(Pose(state.programFrom.matrix()))},
                      {"diameter", state.diameter}});
  }
  for (const machine::Axis& axis : axes)
    names.push_back(axis.name);
  std::vector<float> seconds;
  std::vector<std::uint32_t> places;
  std::vector<std::int32_t> positions, readings;
  for (const auto& block : trace.blocks) {
    seconds.push_back(static_cast<float>(block.seconds));
    places.insert(places.end(), {block.file, block.line, block.state});
    for (const double value : block.position)
      positions.push_back(displayed(value));
    for (std::size_t axis = 0; axis < axes.size(); ++axis)
      readings.push_back(displayed(block.axes[axis]));
  }
  return {{"files", std::move(files)},   {"states", std::move(states)}, {"axes", std::move(names)},
          {"seconds", base64(seconds)},  {"places", base64(places)},    {"positions", base64(positions)},
          {"readings", base64(readings)}};
}

/// What alarms say and the parameters of the calls mean, in the other languages of the page.
json wordsOf(const control::Journal& journal, const records::ReadableText& readable) {
  json words = json::object();
  using words::DialogLanguage;
  const auto sentence = [&](const std::string& bytes) {
    const std::string english = readable(bytes);
    if (english.empty() || words.contains(english)) return;
    json others = json::array();
    bool known = false;
    for (const DialogLanguage language : {DialogLanguage::German, DialogLanguage::Russian, DialogLanguage::Swedish,
                                          DialogLanguage::Chinese, DialogLanguage::Polish}) {
      others.push_back(words::translated(language, english));
      known = known || others.back() != english;
    }
    if (known) words[english] = std::move(others);
  };
  for (const auto& event : journal.events)
    if (event.kind == control::EventKind::Alarm) sentence(event.text);
  for (const auto& cycle : journal.cycles) {
    sentence(cycle.alarm);
    for (const auto& parameter : cycle.parameters) {
      if (words.contains(parameter.meaning)) continue;
      if (const auto others = words::inOtherLanguages(parameter.meaning); !others.empty())
        words[parameter.meaning] = others;
    }
  }
  return words;
}

/// What the cycles of the run alone say: the page has the words of all others.
json phrasesOf(const control::Journal& journal) {
  json phrases = json::object();
  for (const auto& cycle : journal.cycles) {
    if (const cycles::CycleDefinition* definition = cycles::cycleNamed(cycle.name))
      words::addOwnWords(*definition, phrases);
  }
  return phrases;
}

std::string htmlText(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

std::string fileName(const std::string& path) { return path.substr(path.find_last_of("/\\") + 1); }

}  // namespace

void writeReport(const Sink& sink, const control::Journal& journal, const records::RunInfo& run, const Scene& scene,
                 const PageOptions& options) {
  const records::ReadableText readable(run);
  const auto interest = linesOfInterest(journal);
  json programs = json::array();
  for (const auto& source : run.programs) {
    const auto lines = interest.find(source.path);
    programs.push_back(programData(source, lines == interest.end() ? std::set<std::uint64_t>{} : lines->second,
                                   options.longestProgram));
  }
  const std::string title = run.programs.empty() ? "Measuring report" : fileName(readable(run.programs[0].path));

  std::string html;
  html += "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  // Nothing outside this file may be asked for, whatever a program's text says.
  html +=
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src 'unsafe-inline'; "
      "style-src 'unsafe-inline'; img-src data: blob:\">\n";
  html += "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
  html += "<title>" + htmlText(title) + " - Probewright</title>\n<style>\n";
  html += embeddedReportCss();
  html += "</style>\n</head>\n<body>\n<noscript>This report needs JavaScript switched on.</noscript>\n";
  html += "<div id=\"report\"></div>\n<script type=\"text/plain\" id=\"report-data\">";
  sink(html);
  PackedText data(sink);
  const Sink add = [&](std::string_view part) { data.add(part); };
  add("{\"programs\":");
  add(programs.dump());
  add(",\"results\":");
  records::writeResults(add, journal, run, records::Layout::Compact);
  add(",\"scene\":");
  add(sceneData(scene, run.axes.size(), readable).dump());
  add(",\"trace\":");
  add(options.trace == nullptr ? "null" : traceData(*options.trace, run.axes, readable).dump());
  add(",\"words\":" + wordsOf(journal, readable).dump());
  if (const json phrases = phrasesOf(journal); !phrases.empty()) add(",\"phrases\":" + phrases.dump());
  add(",\"language\":" + json(options.language).dump() + "}");
  data.finish();
  html = "</script>\n<script>\n";
  html += embeddedReportJs();
  html += "</script>\n</body>\n</html>\n";
  sink(html);
}

std::string reportHtml(const control::Journal& journal, const records::RunInfo& run, const Scene& scene,
                       const PageOptions& options) {
  std::string html;
  writeReport([&](std::string_view part) { html += part; }, journal, run, scene, options);
  return html;
}

}  // namespace probewright::reports
