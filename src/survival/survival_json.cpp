#include <nlohmann/json.hpp>

#include "records/json_number.hpp"
#include "survival/survival_records.hpp"

namespace probewright::survival {

using nlohmann::ordered_json;

namespace {

const char* nameOf(SurvivalEnd end) {
  switch (end) {
    case SurvivalEnd::Finished:
      return "finished";
    case SurvivalEnd::Interrupted:
      return "interrupted";
    case SurvivalEnd::FailsAsWritten:
      return "fails as written";
    case SurvivalEnd::Contradiction:
      return "contradiction";
  }
  return "";
}

const char* nameOf(Verdict verdict) {
  switch (verdict) {
    case Verdict::Proven:
      return "proven";
    case Verdict::Fails:
      return "fails";
    case Verdict::Undecided:
    case Verdict::Cancelled:
      return "undecided";
  }
  return "";
}

ordered_json json(const Reason& reason) {
  ordered_json out = {{"why", reason.why}};
  if (reason.place.line > 0) {
    out["file"] = reason.place.file;
    out["line"] = reason.place.line;
  }
  return out;
}

}  // namespace

ordered_json survivalJson(const Survival& survival, const SurvivalInfo& info) {
  ordered_json out = {{"format", "probewright-survival"}, {"formatVersion", 1},  {"version", info.version},
                      {"program", info.program},          {"setup", info.setup}, {"end", nameOf(survival.end)}};
  ordered_json& tolerances = out["tolerances"] = ordered_json::array();
  for (const Tolerance& each : survival.tolerances)
    tolerances.push_back({{"quantity", each.name()},
                          {"low", each.low},
                          {"high", each.high},
                          {"unit", each.kind == NumberKind::Turn ? "deg" : "mm"},
                          {"proven", survival.symmetric * each.half()}});
  out["proven"] = survival.proven;
  out["fails"] = survival.fails;
  out["undecided"] = survival.undecided;
  out["symmetric"] = survival.symmetric;
  if (survival.nearestFailure) out["nearestFailure"] = *survival.nearestFailure;
  if (survival.asWritten) out["asWritten"] = json(*survival.asWritten);
  if (survival.obstacle) out["obstacle"] = json(*survival.obstacle);
  out["samples"] = {{"run", survival.samples}, {"failed", survival.failed}, {"inProven", survival.samplesInProven}};
  if (survival.openProbability)
    out["open"] = {{"run", survival.openSamples},
                   {"failed", survival.openFailures},
                   {"probability", {survival.openProbability->low, survival.openProbability->high}}};
  ordered_json& blocks = out["blocks"] = ordered_json::array();
  for (const BlockRecord& block : survival.blocks)
    blocks.push_back({{"file", block.place.file},
                      {"line", block.place.line},
                      {"failures", block.failures},
                      {"share", block.share},
                      {"why", block.why}});
  ordered_json& parts = out["parts"] = ordered_json::array();
  for (const Part& part : survival.parts) {
    ordered_json entry = {{"low", part.box.low}, {"high", part.box.high}, {"verdict", nameOf(part.verdict)}};
    if (part.reason && part.verdict != Verdict::Proven) entry.update(json(*part.reason));
    parts.push_back(std::move(entry));
  }
  ordered_json& failures = out["failures"] = ordered_json::array();
  for (const Failure& failure : survival.failures) {
    ordered_json entry = {{"sample", failure.sample}, {"values", failure.values}, {"seed", failure.noise}};
    entry.update(json(failure.reason));
    failures.push_back(std::move(entry));
  }
  out["boxes"] = survival.boxes;
  records::clearNegativeZeros(out);
  return out;
}

}  // namespace probewright::survival
