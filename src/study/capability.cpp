#include "study/capability.hpp"

#include <algorithm>
#include <boost/math/distributions/fisher_f.hpp>
#include <cmath>

#include "metrology/uncertainty.hpp"

namespace probewright::study {

Result<Type1> type1(std::span<const double> values, double reference, double tolerance) {
  if (!(tolerance > 0)) return fail("a type-1 study needs a tolerance", "give the result a lower and an upper limit");
  const auto observed = metrology::typeA(values);
  if (!observed) return tl::unexpected(observed.error());
  Type1 study;
  study.count = values.size();
  study.mean = observed->mean;
  study.deviation = observed->standardDeviation;
  study.bias = study.mean - reference;
  study.cg = 0.2 * tolerance / (6 * study.deviation);
  study.cgk = (0.1 * tolerance - std::abs(study.bias)) / (3 * study.deviation);
  return study;
}

namespace {

/// Sums of squares of a crossed study.
GaugeRR varianceTable(std::span<const double> values, std::size_t parts, std::size_t appraisers, std::size_t repeats) {
  const auto at = [&](std::size_t p, std::size_t a, std::size_t r) {
    return values[(p * appraisers + a) * repeats + r];
  };
  const double n = static_cast<double>(values.size());
  double mean = 0;
  for (const double value : values)
    mean += value / n;
  const double ofPart = static_cast<double>(appraisers * repeats), ofAppraiser = static_cast<double>(parts * repeats);
  const double ofCell = static_cast<double>(repeats);
  std::vector<double> partMeans(parts), appraiserMeans(appraisers);
  GaugeRR study;
  for (std::size_t p = 0; p < parts; ++p) {
    for (std::size_t a = 0; a < appraisers; ++a) {
      for (std::size_t r = 0; r < repeats; ++r) {
        partMeans[p] += at(p, a, r) / ofPart;
        appraiserMeans[a] += at(p, a, r) / ofAppraiser;
        study.total.sumOfSquares += std::pow(at(p, a, r) - mean, 2);
      }
    }
  }
  for (const double partMean : partMeans)
    study.part.sumOfSquares += ofPart * std::pow(partMean - mean, 2);
  for (const double appraiserMean : appraiserMeans)
    study.appraiser.sumOfSquares += ofAppraiser * std::pow(appraiserMean - mean, 2);
  for (std::size_t p = 0; p < parts; ++p) {
    for (std::size_t a = 0; a < appraisers; ++a) {
      double cell = 0;
      for (std::size_t r = 0; r < repeats; ++r)
        cell += at(p, a, r) / ofCell;
      study.interaction.sumOfSquares += ofCell * std::pow(cell - partMeans[p] - appraiserMeans[a] + mean, 2);
      for (std::size_t r = 0; r < repeats; ++r)
        study.repeat.sumOfSquares += std::pow(at(p, a, r) - cell, 2);
    }
  }
  study.part.degreesOfFreedom = static_cast<double>(parts - 1);
  study.appraiser.degreesOfFreedom = static_cast<double>(appraisers - 1);
  study.interaction.degreesOfFreedom = static_cast<double>((parts - 1) * (appraisers - 1));
  study.repeat.degreesOfFreedom = static_cast<double>(parts * appraisers * (repeats - 1));
  study.total.degreesOfFreedom = n - 1;
  return study;
}

bool isSignificant(const GaugeRR::Row& row, const GaugeRR::Row& against) {
  constexpr double level = 0.25;  // AIAG MSA: of the interaction
  if (!(against.meanSquare() > 0)) return row.meanSquare() > 0;
  const boost::math::fisher_f distribution(row.degreesOfFreedom, against.degreesOfFreedom);
  const double ratio = row.meanSquare() / against.meanSquare();
  return boost::math::cdf(boost::math::complement(distribution, ratio)) < level;
}

}  // namespace

Result<GaugeRR> gaugeRR(std::span<const double> values, std::size_t parts, std::size_t appraisers, std::size_t repeats,
                        std::optional<double> tolerance) {
  if (parts < 2 || appraisers < 2 || repeats < 2)
    return fail("a gauge study needs at least 2 parts, 2 appraisers and 2 repeats");
  if (values.size() != parts * appraisers * repeats ||
      std::ranges::any_of(values, [](double value) { return !std::isfinite(value); }))
    return fail("a gauge study needs every value: some trials have come to none", "see which alarms have stopped them");
  GaugeRR study = varianceTable(values, parts, appraisers, repeats);
  study.parts = parts;
  study.appraisers = appraisers;
  study.repeats = repeats;
  const double p = static_cast<double>(parts), a = static_cast<double>(appraisers), r = static_cast<double>(repeats);
  GaugeRR::Row within = study.repeat;
  study.pooled = !isSignificant(study.interaction, study.repeat);
  if (study.pooled) {
    within.sumOfSquares += study.interaction.sumOfSquares;
    within.degreesOfFreedom += study.interaction.degreesOfFreedom;
  }
  // What parts and appraisers are compared with.
  const double against = study.pooled ? within.meanSquare() : study.interaction.meanSquare();
  const double repeatVariance = within.meanSquare();
  const double interactionVariance =
      study.pooled ? 0 : std::max(0.0, (study.interaction.meanSquare() - repeatVariance) / r);
  const double appraiserVariance = std::max(0.0, (study.appraiser.meanSquare() - against) / (p * r));
  const double partVariance = std::max(0.0, (study.part.meanSquare() - against) / (a * r));
  study.repeatability = std::sqrt(repeatVariance);
  study.reproducibility = std::sqrt(appraiserVariance + interactionVariance);
  study.gauge = std::hypot(study.repeatability, study.reproducibility);
  study.partVariation = std::sqrt(partVariance);
  study.totalVariation = std::hypot(study.gauge, study.partVariation);
  if (tolerance && *tolerance > 0) study.ofTolerance = 6 * study.gauge / *tolerance;
  study.distinctCategories =
      study.gauge > 0 ? static_cast<int>(std::min(std::sqrt(2.0) * study.partVariation / study.gauge, 1e6)) : 0;
  return study;
}

}  // namespace probewright::study
