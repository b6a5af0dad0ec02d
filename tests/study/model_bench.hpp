#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "study/run_study.hpp"

/// Studies of formulas: what the engine finds is held against what is published or known in closed form.
namespace probewright::study::testing {

inline Distribution distribution(Distribution::Kind kind) {
  auto made = Distribution::make(std::move(kind));
  EXPECT_TRUE(made) << (made ? "" : format(made.error()));
  return std::move(*made);
}

inline Source source(const std::string& name, Distribution::Kind kind) {
  return {name, NumberPath::parse(name).value(), distribution(std::move(kind)), false, Drawn::EachTrial, {}};
}

using Formula = std::function<double(const std::vector<double>&)>;

/// One result, "y", of a formula of the sources.
inline Model modelOf(const Formula& formula) {
  return [formula](const Draw& draw) {
    Outcome outcome;
    Observation y;
    y.of.key = "y";
    y.of.main = true;
    y.value = formula(draw.inputs);
    outcome.observations.push_back(y);
    return outcome;
  };
}

inline Study studyOf(std::vector<Source> sources, std::uint64_t trials) {
  Study study;
  study.sources = std::move(sources);
  study.trials = trials;
  study.sensitivity = Sensitivity::None;
  return study;
}

inline Answer answerOf(const Study& study, const Formula& formula) {
  const StudyResult result = runStudy(study, {}, modelOf(formula), {});
  EXPECT_EQ(result.answers.size(), 1U);
  return result.answers.front();
}

}  // namespace probewright::study::testing
