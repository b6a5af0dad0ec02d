#include "study/study_json.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "records/json_number.hpp"
#include "records/readable_text.hpp"

namespace probewright::study {

using nlohmann::json;

namespace {

/// Names and messages may hold what programs hold.
std::string readable(const std::string& text) {
  static const records::ReadableText reader{records::RunInfo{}};
  return reader(text);
}

json number(double value) { return records::jsonNumber(value); }

json optional(const std::optional<double>& value) { return value ? number(*value) : json(nullptr); }

json interval(const std::optional<Interval>& value) {
  return value ? json{number(value->low), number(value->high)} : json(nullptr);
}

json summary(const Summary& summary) {
  return {{"count", summary.count},
          {"mean", number(summary.mean)},
          {"standardDeviation", summary.count > 1 ? number(summary.deviation) : json(nullptr)},
          {"minimum", number(summary.minimum)},
          {"median", number(summary.median)},
          {"maximum", number(summary.maximum)},
          {"symmetricInterval", interval(summary.symmetric)},
          {"shortestInterval", interval(summary.shortest)},
          {"quantileError", number(summary.quantileError)}};
}

json histogram(const Histogram& histogram) {
  return {{"low", number(histogram.low)}, {"width", number(histogram.width)}, {"counts", histogram.counts}};
}

json risks(const Risks& risks) {
  return {{"count", risks.count},
          {"trulyWithin", risks.trulyWithin},
          {"accepted", risks.accepted},
          {"consumer", risks.consumer},
          {"consumerInterval", interval(risks.consumerInterval)},
          {"producer", risks.producer},
          {"producerInterval", interval(risks.producerInterval)}};
}

json budget(const Answer& answer, const StudyResult& result) {
  json lines = json::array();
  for (std::size_t i = 0; i < result.units.size(); ++i) {
    json line = {{"source", result.units[i].name}};
    if (i < answer.contributions.size()) {
      line["sensitivity"] = optional(answer.contributions[i].sensitivity);
      line["uncertainty"] = optional(answer.contributions[i].uncertainty);
    }
    if (i < answer.indices.size() && answer.indices[i]) {
      const SobolIndices& indices = *answer.indices[i];
      line["sobol"] = {{"first", number(indices.first)},
                       {"firstHalfWidth", number(indices.firstHalfWidth)},
                       {"total", number(indices.total)},
                       {"totalHalfWidth", number(indices.totalHalfWidth)}};
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

json gaugeJson(const GaugeRR& gauge) {
  const auto row = [](const GaugeRR::Row& r) {
    return json{{"sumOfSquares", number(r.sumOfSquares)},
                {"degreesOfFreedom", r.degreesOfFreedom},
                {"meanSquare", number(r.meanSquare())}};
  };
  return {{"parts", gauge.parts},
          {"appraisers", gauge.appraisers},
          {"repeats", gauge.repeats},
          {"anova",
           {{"part", row(gauge.part)},
            {"appraiser", row(gauge.appraiser)},
            {"interaction", row(gauge.interaction)},
            {"repeat", row(gauge.repeat)},
            {"total", row(gauge.total)}}},
          {"pooled", gauge.pooled},
          {"repeatability", number(gauge.repeatability)},
          {"reproducibility", number(gauge.reproducibility)},
          {"gauge", number(gauge.gauge)},
          {"partVariation", number(gauge.partVariation)},
          {"totalVariation", number(gauge.totalVariation)},
          {"ofTotal", number(gauge.ofTotal())},
          {"ofTolerance", optional(gauge.ofTolerance)},
          {"distinctCategories", gauge.distinctCategories}};
}

json answerJson(const Answer& answer, const StudyResult& result) {
  json object = {{"key", readable(answer.of.key)},
                 {"label", readable(answer.of.label)},
                 {"unit", answer.of.unit},
                 {"main", answer.of.main},
                 {"table", answer.of.table},
                 {"estimate", optional(answer.estimate)},
                 {"values", summary(answer.values)},
                 {"stable", answer.stable},
                 {"standardUncertainty", number(answer.standardUncertainty)},
                 {"coverage",
                  {{"of", answer.error ? "true value" : "measured values"},
                   {"corrected", optional(answer.corrected)},
                   {"symmetricInterval", interval(answer.symmetric)},
                   {"shortestInterval", interval(answer.shortest)}}},
                 {"histogram", histogram(answer.histogram)}};
  if (answer.of.firstOrder) object["firstOrder"] = {{"standardUncertainty", number(*answer.of.firstOrder)}};
  if (answer.of.firstOrder && answer.firstOrder)
    object["firstOrder"]["holds"] = *answer.firstOrder == FirstOrderVerdict::Unclear
                                        ? json(nullptr)
                                        : json(*answer.firstOrder == FirstOrderVerdict::Holds);
  if (answer.truths) {
    object["truth"] = number(answer.truths->mean);
    object["truths"] = {number(answer.truths->least), number(answer.truths->greatest)};
  }
  if (answer.error) {
    object["bias"] = number(answer.error->mean);
    object["error"] = summary(*answer.error);
  }
  if (answer.errorHistogram) object["errorHistogram"] = histogram(*answer.errorHistogram);
  if (answer.tolerance) {
    json& conformity = object["conformity"];
    conformity = {{"lowerLimit", optional(answer.tolerance->lower)},
                  {"upperLimit", optional(answer.tolerance->upper)},
                  {"guardBand", number(answer.guardBand)}};
    if (answer.conformance) conformity["probability"] = number(*answer.conformance);
    if (answer.decision) conformity["decision"] = nameOf(*answer.decision);
    if (answer.risks) conformity["risks"] = risks(*answer.risks);
    if (answer.guardedRisks) conformity["guardedRisks"] = risks(*answer.guardedRisks);
  }
  if (!answer.contributions.empty() || !answer.indices.empty()) object["budget"] = budget(answer, result);
  if (answer.type1) {
    const Type1& type1 = *answer.type1;
    object["type1"] = {
        {"count", type1.count},       {"mean", number(type1.mean)}, {"standardDeviation", number(type1.deviation)},
        {"bias", number(type1.bias)}, {"cg", number(type1.cg)},     {"cgk", number(type1.cgk)}};
  }
  if (answer.gauge) object["gauge"] = gaugeJson(*answer.gauge);
  return object;
}

const char* wordOf(StudyEnd end) {
  switch (end) {
    case StudyEnd::Stable:
      return "stable";
    case StudyEnd::AllTrials:
      return "all trials";
    case StudyEnd::MostTrials:
      return "not stable";
    case StudyEnd::NoResult:
      return "no result";
    case StudyEnd::Interrupted:
      return "interrupted";
  }
  return "interrupted";
}

json stopJson(const Stop& stop, const StudyResult& result) {
  json sources = json::array();
  for (std::size_t i = 0; i < stop.sources.size(); ++i)
    sources.push_back({{"source", result.study.sources[i].name},
                       {"values", summary(stop.sources[i])},
                       {"histogram",
                        {{"low", number(stop.tenths[i].low)},
                         {"high", number(stop.tenths[i].high)},
                         {"stopped", stop.tenths[i].stopped},
                         {"trials", stop.tenths[i].trials}}}});
  return {{"why", readable(stop.why)},
          {"count", stop.count},
          {"probabilityInterval", interval(stop.probability)},
          {"firstTrials", stop.first},
          {"sources", std::move(sources)}};
}

}  // namespace

json studyJson(const StudyResult& result, const StudyInfo& info) {
  json sources = json::array();
  for (const Source& source : result.study.sources) {
    sources.push_back({{"name", source.name},
                       {"quantity", source.quantity.text()},
                       {"distribution", source.distribution.name()},
                       {"mean", number(source.distribution.mean())},
                       {"standardUncertainty", number(source.distribution.standardDeviation())}});
  }
  json answers = json::array();
  for (const Answer& answer : result.answers)
    answers.push_back(answerJson(answer, result));
  json keys = json::array();
  for (const std::size_t i : result.correlated)
    keys.push_back(readable(result.answers[i].of.key));
  json matrix = json::array();
  for (const auto& row : result.correlation) {
    json line = json::array();
    for (const auto& value : row)
      line.push_back(optional(value));
    matrix.push_back(std::move(line));
  }
  json stops = json::array();
  for (const Stop& stop : result.stops)
    stops.push_back(stopJson(stop, result));
  return {{"schema", "probewright study"},
          {"schemaVersion", studySchemaVersion},
          {"units", {{"length", "mm"}, {"angle", "deg"}}},
          {"study",
           {{"file", readable(result.study.file)},
            {"program", readable(info.program)},
            {"setup", readable(info.setup)},
            {"version", info.version},
            {"seed", result.study.seed},
            {"coverage", result.study.coverage},
            {"guardFactor", result.study.guardFactor}}},
          {"end", wordOf(result.end)},
          {"trials", result.trials},
          {"finished", result.finished},
          {"sources", std::move(sources)},
          {"results", std::move(answers)},
          {"correlation", {{"keys", std::move(keys)}, {"matrix", std::move(matrix)}}},
          {"alarms", std::move(stops)}};
}

std::string studyCsv(const StudyResult& result) {
  const auto cell = [](const std::optional<double>& value) {
    return value && std::isfinite(*value) ? fmt::format(",{}", *value) : ",";
  };
  const auto quoted = [](const std::string& text) {
    std::string inner = "\"";
    for (const char c : text)
      inner += c == '"' ? "\"\"" : std::string(1, c);
    return inner + "\"";
  };
  std::string text =
      "result,label,unit,count,estimate,mean,standard uncertainty,symmetric low,symmetric high,shortest low,"
      "shortest high,bias,lower limit,upper limit,conformance probability,standard deviation of the values,"
      "values symmetric low,values symmetric high,values minimum,values maximum\n";
  for (const Answer& answer : result.answers) {
    const auto low = [](const std::optional<Interval>& i) { return i ? std::optional(i->low) : std::nullopt; };
    const auto high = [](const std::optional<Interval>& i) { return i ? std::optional(i->high) : std::nullopt; };
    text += fmt::format("{},{},{},{}", quoted(readable(answer.of.key)), quoted(readable(answer.of.label)),
                        answer.of.unit, answer.values.count);
    text += cell(answer.estimate) + cell(answer.values.mean) + cell(answer.standardUncertainty) +
            cell(low(answer.symmetric)) + cell(high(answer.symmetric)) + cell(low(answer.shortest)) +
            cell(high(answer.shortest)) + cell(answer.error ? std::optional(answer.error->mean) : std::nullopt) +
            cell(answer.of.lower) + cell(answer.of.upper) + cell(answer.conformance) +
            cell(answer.values.count > 1 ? std::optional(answer.values.deviation) : std::nullopt) +
            cell(low(answer.values.symmetric)) + cell(high(answer.values.symmetric)) + cell(answer.values.minimum) +
            cell(answer.values.maximum) + "\n";
  }
  return text;
}

}  // namespace probewright::study
