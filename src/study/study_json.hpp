#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "study/run_study.hpp"

/// What a study has found, for other programs: docs/study.schema.json describes the layout.
namespace probewright::study {

inline constexpr int studySchemaVersion = 1;

/// What was studied, for the record.
struct StudyInfo {
  std::string program, setup, version;
};

nlohmann::json studyJson(const StudyResult& result, const StudyInfo& info);

/// A line for each result: key, unit, estimate, mean, standard uncertainty, intervals, bias.
std::string studyCsv(const StudyResult& result);

}  // namespace probewright::study
