#include "records/truth_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "records/json_number.hpp"

namespace probewright::records {

using nlohmann::json;

std::string_view nameOf(TruthBasis basis) { return basis == TruthBasis::Face ? "face" : "points"; }

std::string_view nameOf(EntryKind kind) {
  switch (kind) {
    case EntryKind::Preset:
      return "preset";
    case EntryKind::ZeroOffset:
      return "zero offset";
    case EntryKind::Tool:
      return "tool";
    case EntryKind::Probe:
      return "probe";
    case EntryKind::Kinematics:
      return "kinematics";
  }
  return "preset";
}

namespace {

json number(double value) { return jsonNumber(value); }

json point(const Vector3& p) { return {number(p.x()), number(p.y()), number(p.z())}; }

json ghost(const Ghost& drawn) {
  json object = {{"shape", drawn.shape}, {"at", point(drawn.at)}};
  if (!drawn.normal.isZero(0)) object["normal"] = point(drawn.normal);
  if (drawn.diameter > 0) object["diameter"] = number(drawn.diameter);
  for (const Vector3& corner : drawn.outline)
    object["outline"].push_back(point(corner));
  return object;
}

json entry(const EntryTruth& compared, const ReadableText& text) {
  json values = json::array();
  for (const EntryValue& value : compared.values) {
    values.push_back({{"name", text(value.name)},
                      {"unit", value.unit},
                      {"value", number(value.value)},
                      {"truth", number(value.truth)},
                      {"error", number(value.value - value.truth)}});
  }
  json object = {{"kind", nameOf(compared.kind)}, {"name", text(compared.name)}, {"values", std::move(values)}};
  if (compared.cycle) object["cycle"] = *compared.cycle;
  if (compared.distance) object["distance"] = number(*compared.distance);
  if (compared.angle) object["angle"] = number(*compared.angle);
  return object;
}

json diagnosis(const Diagnosis& known, const ReadableText& text) {
  json texts = json::array();
  for (const std::string& sentence : known.texts)
    texts.push_back(text(sentence));
  json object = {{"time", number(known.seconds)}, {"texts", std::move(texts)}};
  if (known.cycle) object["cycle"] = *known.cycle;
  if (known.expected) object["expected"] = ghost(*known.expected);
  if (known.found) object["found"] = ghost(*known.found);
  return object;
}

json clearance(const Clearance& known, const ReadableText& text) {
  json spans = json::array();
  for (const ClearanceSpan& span : known.spans) {
    json object = {{"from", number(span.from)}, {"to", number(span.to)}, {"distance", number(span.distance)}};
    if (span.orMore) object["orMore"] = true;
    if (!span.part.empty()) object["part"] = text(span.part);
    if (!span.solid.empty()) object["solid"] = text(span.solid);
    if (span.cycle) object["cycle"] = *span.cycle;
    if (span.place)
      object["place"] = {{"file", text(span.place->file)}, {"line", span.place->line}, {"column", span.place->column}};
    spans.push_back(std::move(object));
  }
  json object = {{"spans", std::move(spans)}};
  if (known.limit > 0) object["limit"] = number(known.limit);
  return object;
}

json travel(const TravelMargin& margin, const ReadableText& text) {
  json object = {{"axis", text(margin.axis)},
                 {"unit", margin.unit},
                 {"margin", number(margin.margin)},
                 {"position", number(margin.position)},
                 {"time", number(margin.seconds)}};
  if (margin.place)
    object["place"] = {
        {"file", text(margin.place->file)}, {"line", margin.place->line}, {"column", margin.place->column}};
  return object;
}

template <class Records, class Convert>
void addList(json& object, const char* key, const Records& records, Convert convert, const ReadableText& text) {
  if (records.empty()) return;
  json array = json::array();
  for (const auto& record : records)
    array.push_back(convert(record, text));
  object[key] = std::move(array);
}

}  // namespace

json truthOfResult(const TrueValue& truth, double measured) {
  json object = {
      {"value", number(truth.value)}, {"error", number(measured - truth.value)}, {"from", nameOf(truth.basis)}};
  if (!truth.shape.empty()) object["shape"] = truth.shape;
  return object;
}

json truthOfTouch(const TrueTouch& truth, const ReadableText& text) {
  json object = {{"surface", point(truth.surface)}, {"error", number(truth.error)}, {"solid", text(truth.solid)}};
  if (!truth.shape.empty()) object["shape"] = truth.shape;
  return object;
}

json truthOfRun(const Truth& truth, const ReadableText& text) {
  json object = json::object();
  addList(object, "entries", truth.entries, entry, text);
  addList(object, "diagnoses", truth.diagnoses, diagnosis, text);
  if (truth.clearance) object["clearance"] = clearance(*truth.clearance, text);
  addList(object, "travel", truth.travel, travel, text);
  addList(object, "nearEnds", truth.nearEnds, travel, text);
  return object;
}

}  // namespace probewright::records
