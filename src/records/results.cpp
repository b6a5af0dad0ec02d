#include "records/results.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "cycles/main_results.hpp"
#include "records/feature_names.hpp"
#include "records/json_number.hpp"
#include "records/readable_text.hpp"
#include "records/truth_json.hpp"

namespace probewright::records {

using nlohmann::json;

namespace {

json number(double value) { return jsonNumber(value); }

json point(const Vector3& p) { return {number(p.x()), number(p.y()), number(p.z())}; }

json place(const SourcePlace& p, const ReadableText& text) {
  return {{"file", text(p.file)}, {"line", p.line}, {"column", p.column}};
}

json axisPositions(const machine::AxisPositions& positions, const std::vector<machine::Axis>& axes) {
  json object = json::object();
  const std::size_t count = std::min(axes.size(), machine::maximumAxes);
  for (std::size_t i = 0; i < count; ++i)
    object[axes[i].name] = number(positions[i]);
  return object;
}

json touch(const control::TouchRecord& record, const std::optional<TrueTouch>& truth,
           const std::vector<machine::Axis>& axes, const ReadableText& text) {
  json object = {{"outcome", text(record.outcome)},
                 {"target", point(record.target)},
                 {"direction", point(record.direction)},
                 {"time", number(record.seconds)}};
  if (record.outcome == "touched") {
    object["ballCentre"] = point(record.ballCentre);
    object["surface"] = point(record.surface);
    object["axes"] = axisPositions(record.latched, axes);
  }
  if (truth) object["truth"] = truthOfTouch(*truth, text);
  return object;
}

json result(const control::ResultRecord& record, bool isMain, const std::optional<TrueValue>& truth,
            const ReadableText& text) {
  json object = {{"name", text(record.name)},
                 {"meaning", text(record.meaning)},
                 {"value", number(record.value)},
                 {"unit", text(record.unit)},
                 {"role", control::nameOf(record.kind.role)},
                 {"main", isMain},
                 {"verdict", verdictName(record.verdict)}};
  if (json characteristic = characteristicJson(record.kind.of, text(record.label)); !characteristic.is_null())
    object["characteristic"] = std::move(characteristic);
  const auto optional = [&](const char* key, const std::optional<double>& value) {
    if (value) object[key] = number(*value);
  };
  optional("nominal", record.nominal);
  optional("deviation", record.deviation);
  optional("lowerLimit", record.lowerLimit);
  optional("upperLimit", record.upperLimit);
  optional("uncertainty", record.uncertainty);
  if (truth) object["truth"] = truthOfResult(*truth, record.value);
  return object;
}

/// The i-th of what is known, if so much is known.
template <class Known>
std::optional<Known> at(const std::vector<std::optional<Known>>& known, std::size_t i) {
  return i < known.size() ? known[i] : std::nullopt;
}

json results(const control::CycleRecord& record, const CycleTruth& truth, const ReadableText& text) {
  const std::vector<bool> isMain = cycles::mainResults(record);
  json array = json::array();
  for (std::size_t i = 0; i < isMain.size(); ++i)
    array.push_back(result(record.results[i], isMain[i], at(truth.results, i), text));
  return array;
}

json touches(const control::CycleRecord& record, const CycleTruth& truth, const std::vector<machine::Axis>& axes,
             const ReadableText& text) {
  json array = json::array();
  for (std::size_t i = 0; i < record.touches.size(); ++i)
    array.push_back(touch(record.touches[i], at(truth.touches, i), axes, text));
  return array;
}

template <class Records, class Convert>
json list(const Records& records, Convert convert) {
  json array = json::array();
  for (const auto& record : records)
    array.push_back(convert(record));
  return array;
}

json fit(const control::FitRecord& record) {
  json cofactors = json::array();
  const std::size_t size = record.members.size();
  for (std::size_t row = 0; row < size; ++row) {
    json line = json::array();
    for (std::size_t column = 0; column < size; ++column)
      line.push_back(number(record.cofactors[row * size + column]));
    cofactors.push_back(std::move(line));
  }
  json object = {{"shape", record.shape},
                 {"touches", record.touches},
                 {"residuals", list(record.residuals, number)},
                 {"formDeviation", number(record.formDeviation)},
                 {"degreesOfFreedom", record.degreesOfFreedom},
                 {"members", record.members},
                 {"cofactors", std::move(cofactors)}};
  return object;
}

json write(const control::WriteRecord& record, const ReadableText& text) {
  return {{"table", text(record.table)},
          {"entry", text(record.entry)},
          {"before", text(record.before)},
          {"after", text(record.after)}};
}

json parameter(const control::ParameterRecord& record, const ReadableText& text) {
  return {{"name", text(record.name)},
          {"value", text(record.value)},
          {"meaning", text(record.meaning)},
          {"default", record.isDefault}};
}

json cycle(const control::CycleRecord& record, const CycleTruth& truth, const std::vector<machine::Axis>& axes,
           const FeatureNames& features, const ReadableText& text) {
  json object = {{"name", text(record.name)},
                 {"title", text(record.title)},
                 {"place", place(record.place, text)},
                 {"verdict", verdictName(record.verdict)},
                 {"parameters", list(record.parameters, [&](const auto& p) { return parameter(p, text); })},
                 {"touches", touches(record, truth, axes, text)},
                 {"results", results(record, truth, text)},
                 {"writes", list(record.writes, [&](const auto& w) { return write(w, text); })},
                 {"logFiles", list(record.logFiles, text)},
                 {"screens", list(record.screens, text)},
                 {"start", number(record.startSeconds)},
                 {"end", number(record.endSeconds)},
                 {"pathLength", number(record.pathLength)}};
  if (std::string feature = features.at(record.place); !feature.empty()) object["feature"] = std::move(feature);
  if (!record.fits.empty()) object["fits"] = list(record.fits, fit);
  if (!record.alarm.empty()) object["alarm"] = text(record.alarm);
  return object;
}

json event(const control::EventRecord& record, const ReadableText& text) {
  return {{"kind", eventName(record.kind)},
          {"place", place(record.place, text)},
          {"code", text(record.code)},
          {"text", text(record.text)},
          {"time", number(record.seconds)}};
}

json jobJson(const Job& job, const ReadableText& text) {
  json object = json::object();
  for (const JobField& field : jobFields) {
    if (const std::string& value = job.*field.value; !value.empty()) object[field.name] = text(value);
  }
  return object;
}

json header(const RunInfo& run, const ReadableText& text) {
  json object = {{"programs", list(run.programs, [&](const ProgramSource& source) { return text(source.path); })},
                 {"language", text(run.language)},
                 {"control", text(run.control)},
                 {"machine", text(run.machine)},
                 {"setup", text(run.setupPath)},
                 {"part", {{"name", text(run.partName)}, {"path", text(run.partPath)}}},
                 {"seed", run.seed ? json(*run.seed) : json(nullptr)},
                 {"version", text(run.version)},
                 {"exit", {{"code", static_cast<int>(run.exit)}, {"state", exitName(run.exit)}}}};
  if (const json job = jobJson(run.job, text); !job.empty()) object["job"] = job;
  if (!run.skipLevels.empty()) object["skipLevels"] = run.skipLevels;
  if (!run.startedAt.empty()) object["startedAt"] = text(run.startedAt);
  if (!run.exitText.empty()) object["exit"]["text"] = text(run.exitText);
  return object;
}

}  // namespace

json characteristicJson(const control::Characteristic& characteristic, const std::string& label) {
  if (characteristic.quantity == control::Quantity::None) return nullptr;
  json object = {{"quantity", control::nameOf(characteristic.quantity)}};
  if (characteristic.along != control::Along::None) object["along"] = control::nameOf(characteristic.along);
  if (characteristic.item != 0) object["item"] = characteristic.item;
  if (characteristic.system != control::System::Workpiece) object["system"] = control::nameOf(characteristic.system);
  if (!label.empty()) object["label"] = label;
  return object;
}

std::string_view eventName(control::EventKind kind) {
  switch (kind) {
    case control::EventKind::Message:
      return "message";
    case control::EventKind::Alarm:
      return "alarm";
    case control::EventKind::Stop:
      return "stop";
    case control::EventKind::Skipped:
      return "skipped";
    case control::EventKind::Tool:
      return "tool";
    case control::EventKind::Warning:
      return "warning";
  }
  return "message";
}

std::string_view verdictName(control::Verdict verdict) {
  switch (verdict) {
    case control::Verdict::None:
      return "none";
    case control::Verdict::Good:
      return "good";
    case control::Verdict::Rework:
      return "rework";
    case control::Verdict::Scrap:
      return "scrap";
  }
  return "none";
}

std::string_view exitName(ExitState state) {
  switch (state) {
    case ExitState::Good:
      return "good";
    case ExitState::OutOfTolerance:
      return "out of tolerance";
    case ExitState::InputMistake:
      return "input mistake";
    case ExitState::Stopped:
      return "stopped";
    case ExitState::Internal:
      return "internal error";
  }
  return "internal error";
}

control::Verdict worstVerdict(const control::Journal& journal) {
  control::Verdict worst = control::Verdict::None;
  for (const auto& record : journal.cycles) {
    worst = std::max(worst, record.verdict);
    for (const auto& value : record.results)
      worst = std::max(worst, value.verdict);
  }
  return worst;
}

TouchCount countTouches(const control::Journal& journal) {
  TouchCount count;
  for (const auto& record : journal.cycles) {
    for (const auto& touch : record.touches)
      ++(touch.outcome == "touched" ? count.touched : count.failed);
  }
  return count;
}

namespace {

/// All but the lists that grow with the program.
json withoutLists(const control::Journal& journal, const RunInfo& run, const ReadableText& text) {
  const TouchCount counted = countTouches(journal);
  json object = {{"schema", "probewright results"},
                 {"schemaVersion", resultsSchemaVersion},
                 {"units", {{"length", "mm"}, {"angle", "deg"}, {"time", "s"}}},
                 {"run", header(run, text)},
                 {"verdict", verdictName(worstVerdict(journal))},
                 {"totals",
                  {{"cycles", journal.cycles.size()},
                   {"touches", counted.touched},
                   {"failedTouches", counted.failed},
                   {"pathLength", number(run.totalPathLength)},
                   {"time", number(run.totalSeconds)}}},
                 {"files", list(run.outputFiles, text)}};
  if (run.truth) object["truth"] = truthOfRun(*run.truth, text);
  return object;
}

/// Writes one object entry by entry and list element by element, as dump would write the whole.
class ObjectWriter {
public:
  ObjectWriter(const Sink& sink, Layout layout) : sink_(sink), indented_(layout == Layout::Indented) { sink_("{"); }

  void entry(const std::string& key, const json& value) {
    begin(key);
    put(value, 1);
  }

  template <class Records, class Convert>
  void list(const std::string& key, const Records& records, Convert convert) {
    begin(key);
    sink_("[");
    bool first = true;
    for (const auto& record : records) {
      sink_(std::exchange(first, false) ? "" : ",");
      newLine(2);
      put(convert(record), 2);
    }
    if (!first) newLine(1);
    sink_("]");
  }

  void finish() {
    newLine(0);
    sink_("}");
  }

private:
  void begin(const std::string& key) {
    sink_(std::exchange(first_, false) ? "" : ",");
    newLine(1);
    sink_(json(key).dump() + (indented_ ? ": " : ":"));
  }

  void newLine(int depth) {
    if (!indented_) return;
    sink_("\n");
    sink_(std::string(static_cast<std::size_t>(2 * depth), ' '));
  }

  /// Texts in JSON hold no line ends: each of them begins an indented line.
  void put(const json& value, int depth) {
    const std::string text = value.dump(indented_ ? 2 : -1);
    const std::string indent(static_cast<std::size_t>(2 * depth), ' ');
    std::string_view rest = text;
    for (std::size_t end = rest.find('\n'); end != std::string_view::npos; end = rest.find('\n')) {
      sink_(rest.substr(0, end + 1));
      sink_(indent);
      rest.remove_prefix(end + 1);
    }
    sink_(rest);
  }

  const Sink& sink_;
  bool indented_;
  bool first_ = true;
};

}  // namespace

void writeResults(const Sink& sink, const control::Journal& journal, const RunInfo& run, Layout layout) {
  const ReadableText text(run);
  const FeatureNames features(run, text);
  ObjectWriter object(sink, layout);
  const json rest = withoutLists(journal, run, text);
  const std::map<std::string, std::function<void(const std::string&)>> lists = {
      {"cycles",
       [&](const std::string& key) {
         const CycleTruth nothing;
         std::size_t next = 0;
         object.list(key, journal.cycles, [&](const auto& record) {
           const std::size_t place = next++;
           const bool known = run.truth && place < run.truth->cycles.size();
           json made = cycle(record, known ? run.truth->cycles[place] : nothing, run.axes, features, text);
           const auto& doubtful = run.doubtfulUncertainties;
           for (auto each = doubtful.lower_bound({place, 0}); each != doubtful.end() && each->first == place; ++each)
             made["results"].at(each->second)["uncertaintyHolds"] = false;
           return made;
         });
       }},
      {"events",
       [&](const std::string& key) {
         object.list(key, journal.events, [&](const auto& record) { return event(record, text); });
       }},
      {"writes",
       [&](const std::string& key) {
         object.list(key, journal.writes, [&](const auto& record) { return write(record, text); });
       }},
  };
  std::set<std::string> keys;  // in the order of their names, as JSON libraries write them
  for (const auto& [key, value] : rest.items())
    keys.insert(key);
  for (const auto& [key, writeList] : lists)
    keys.insert(key);
  for (const std::string& key : keys) {
    if (const auto found = lists.find(key); found != lists.end()) {
      found->second(key);
    } else {
      object.entry(key, rest[key]);
    }
  }
  object.finish();
}

std::string resultsText(const control::Journal& journal, const RunInfo& run) {
  std::string text;
  writeResults([&](std::string_view part) { text += part; }, journal, run, Layout::Indented);
  return text + "\n";
}

json resultsJson(const control::Journal& journal, const RunInfo& run) { return json::parse(resultsText(journal, run)); }

}  // namespace probewright::records
