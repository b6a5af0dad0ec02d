#include <algorithm>
#include <nlohmann/json.hpp>

#include "reports/base64.hpp"
#include "reports/embedded.hpp"
#include "reports/machine_scene.hpp"

namespace probewright::reports {

using nlohmann::json;

namespace {

constexpr std::string_view mark = "<meta name=\"generator\" content=\"Probewright machine\">";

std::string packed(const std::vector<Vector3f>& points) {
  std::vector<float> values;
  values.reserve(3 * points.size());
  for (const Vector3f& point : points)
    values.insert(values.end(), point.data(), point.data() + 3);
  return base64(values);
}

/// UTF-8, whatever a file holds.
std::string readable(const std::string& text) {
  return json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace)).get<std::string>();
}

json numbers(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

json chainData(const std::vector<machine::ChainElement>& chain) {
  json data = json::array();
  for (const machine::ChainElement& element : chain) {
    data.push_back({{"axis", element.axis ? json(*element.axis) : json(nullptr)},
                    {"direction", numbers(element.direction)},
                    {"point", numbers(element.point)}});
  }
  return data;
}

json shapeData(const Mesh& mesh) {
  json pose = json::array();
  const Eigen::Matrix4d matrix = mesh.sceneFromMesh.matrix();
  for (Eigen::Index i = 0; i < 16; ++i)
    pose.push_back(matrix.data()[i]);
  return {{"name", readable(mesh.name)},         {"pose", std::move(pose)},
          {"positions", packed(mesh.positions)}, {"normals", packed(mesh.normals)},
          {"triangles", base64(mesh.triangles)}, {"edges", packed(mesh.featureEdges)}};
}

/// JSON that may stand in a script element, whatever its texts say.
std::string scriptSafe(const json& data) {
  std::string text = data.dump(-1, ' ', false, json::error_handler_t::replace);
  for (std::size_t sign = text.find('<'); sign != std::string::npos; sign = text.find('<', sign))
    text.replace(sign, 1, "\\u003c");
  return text;
}

}  // namespace

json machineData(const MachineScene& scene) {
  json axes = json::array(), bodies = json::array();
  for (std::size_t i = 0; i < scene.machine.axes.size(); ++i) {
    const machine::Axis& axis = scene.machine.axes[i];
    axes.push_back({{"name", readable(axis.name)},
                    {"rotary", axis.kind == machine::AxisKind::Rotary},
                    {"minimum", axis.minimum},
                    {"maximum", axis.maximum},
                    {"modulo", axis.modulo},
                    {"home", scene.machine.toolChange[i]}});
  }
  for (const MachineScene::Body& body : scene.bodies) {
    json data = shapeData(body.mesh);
    data["chain"] = body.link.chain == machine::Link::Chain::Table ? "table" : "spindle";
    data["elements"] = body.link.elements;
    bodies.push_back(std::move(data));
  }
  return {{"name", readable(scene.machine.name)},
          {"up", numbers(scene.up)},
          {"axes", std::move(axes)},
          {"table", chainData(scene.machine.tableChain)},
          {"spindle", chainData(scene.machine.spindleChain)},
          {"bodies", std::move(bodies)}};
}

json machineData(const MachineReplay& replay) {
  json data = machineData(replay.scene);
  json probes = json::array(), changes = json::array();
  for (const Mesh& probe : replay.probes)
    probes.push_back(shapeData(probe));
  for (const Path::ToolFrom& change : replay.changes)
    changes.push_back({change.point, change.tool});
  data["probes"] = std::move(probes);
  data["changes"] = std::move(changes);
  return data;
}

std::string machinePage(const MachineScene& scene, const std::string& file, const std::vector<std::string>& remarks) {
  json data = machineData(scene);
  data["file"] = file;
  data["remarks"] = remarks;
  std::string html = "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  html += mark;
  html +=
      "\n<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src 'unsafe-inline'; "
      "style-src 'unsafe-inline'; img-src data: blob:\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>Machine - Probewright</title>\n<style>\n";
  html += embeddedMachineCss();
  html +=
      "</style>\n</head>\n<body>\n<noscript>This page needs JavaScript switched on.</noscript>\n"
      "<div id=\"machine\"></div>\n<script type=\"application/json\" id=\"machine-data\">";
  html += scriptSafe(data);
  html += "</script>\n<script>\n";
  html += embeddedMachineJs();
  html += "</script>\n</body>\n</html>\n";
  return html;
}

bool isMachinePage(std::string_view html) { return html.substr(0, 1000).find(mark) != std::string_view::npos; }

}  // namespace probewright::reports
