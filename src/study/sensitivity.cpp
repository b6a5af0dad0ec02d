#include "study/sensitivity.hpp"

#include <algorithm>
#include <cmath>

namespace probewright::study {

namespace {

/// Trials between two looks at stop and progress.
constexpr std::size_t chunk = 256;

/// The value of each characteristic in an outcome; NaN where it has none.
class Columns {
public:
  explicit Columns(const std::vector<Characteristic>& characteristics) {
    for (std::size_t i = 0; i < characteristics.size(); ++i)
      places_[characteristics[i].key] = i;
  }
  std::size_t size() const { return places_.size(); }
  std::vector<double> of(const Outcome& outcome) const {
    std::vector<double> row(places_.size(), missing);
    for (const Observation& observation : outcome.observations)
      if (const auto found = places_.find(observation.of.key); found != places_.end())
        row[found->second] = observation.value;
    return row;
  }

private:
  std::map<std::string, std::size_t> places_;
};

using Rows = std::vector<std::vector<double>>;

/// The rows of all draws, in their order; false if stopped.
bool runRows(const Model& model, const std::vector<Draw>& draws, const Columns& columns, const RunSettings& settings,
             std::uint64_t& done, std::uint64_t of, Rows& rows) {
  rows.clear();
  for (std::size_t begin = 0; begin < draws.size(); begin += chunk) {
    const std::span<const Draw> part(draws.data() + begin, std::min(chunk, draws.size() - begin));
    const std::vector<Outcome> outcomes = settings.crew(model, part);
    if (outcomes.size() < part.size()) return false;
    for (const Outcome& outcome : outcomes)
      rows.push_back(columns.of(outcome));
    done += part.size();
    if (settings.progress) settings.progress(done, of);
  }
  return true;
}

/// `into` with what `unit` draws in `from`.
Draw replaced(Draw into, const Draw& from, const Sampler::Unit& unit) {
  for (const std::size_t source : unit.sources)
    into.inputs[source] = from.inputs[source];
  if (unit.sources.empty()) into.noise = from.noise;
  return into;
}

Contribution contributionOf(const std::vector<double>& inputs, const std::vector<double>& values) {
  double count = 0, meanX = 0, meanY = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) continue;
    ++count;
    if (!inputs.empty()) meanX += (inputs[i] - meanX) / count;
    meanY += (values[i] - meanY) / count;
  }
  Contribution contribution;
  if (count < 2) return contribution;
  double xx = 0, xy = 0, yy = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) continue;
    const double x = inputs.empty() ? 0 : inputs[i] - meanX, y = values[i] - meanY;
    xx += x * x;
    xy += x * y;
    yy += y * y;
  }
  contribution.uncertainty = std::sqrt(yy / (count - 1));
  if (xx > 0) contribution.sensitivity = xy / xx;
  return contribution;
}

/// Mean and half of the 95 % interval of a mean.
std::pair<double, double> meanOf(const std::vector<double>& terms) {
  const double count = static_cast<double>(terms.size());
  double mean = 0;
  for (const double term : terms)
    mean += term / count;
  double squares = 0;
  for (const double term : terms)
    squares += (term - mean) * (term - mean);
  return {mean, 1.96 * std::sqrt(squares / (count * (count - 1)))};
}

std::optional<SobolIndices> indicesOf(std::size_t column, const Rows& a, const Rows& b, const Rows& mixed) {
  std::vector<double> fa, fb, fab;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double x = a[i][column], y = b[i][column], z = mixed[i][column];
    if (std::isnan(x) || std::isnan(y) || std::isnan(z)) continue;
    fa.push_back(x);
    fb.push_back(y);
    fab.push_back(z);
  }
  constexpr std::size_t fewest = 10;
  if (fa.size() < fewest) return std::nullopt;
  const double count = static_cast<double>(fa.size());
  double mean = 0, variance = 0;
  for (const std::vector<double>* values : {&fa, &fb})
    for (const double value : *values)
      mean += value / (2 * count);
  for (const std::vector<double>* values : {&fa, &fb})
    for (const double value : *values)
      variance += (value - mean) * (value - mean) / (2 * count);
  if (!(variance > 0)) return std::nullopt;
  std::vector<double> first, total;
  for (std::size_t i = 0; i < fa.size(); ++i) {
    first.push_back((fb[i] - mean) * (fab[i] - fa[i]) / variance);
    total.push_back(std::pow(fa[i] - fab[i], 2) / (2 * variance));
  }
  SobolIndices indices;
  std::tie(indices.first, indices.firstHalfWidth) = meanOf(first);
  std::tie(indices.total, indices.totalHalfWidth) = meanOf(total);
  return indices;
}

}  // namespace

std::optional<std::vector<std::vector<Contribution>>> oneAtATime(const Model& model, const Sampler& sampler,
                                                                 const std::vector<Characteristic>& characteristics,
                                                                 std::uint64_t trials, const RunSettings& settings) {
  const Columns columns(characteristics);
  const auto& units = sampler.units();
  std::vector<std::vector<Contribution>> result(characteristics.size(), std::vector<Contribution>(units.size()));
  const std::uint64_t of = trials * units.size();
  std::uint64_t done = 0;
  for (std::size_t u = 0; u < units.size(); ++u) {
    std::vector<Draw> draws;
    for (std::uint64_t i = 0; i < trials; ++i) {
      draws.push_back(replaced(sampler.estimate(), sampler.draw(i, Purpose::OneAtATime), units[u]));
      draws.back().trial = i;
    }
    Rows rows;
    if (!runRows(model, draws, columns, settings, done, of, rows)) return std::nullopt;
    std::vector<double> inputs;
    if (units[u].sources.size() == 1)
      for (const Draw& draw : draws)
        inputs.push_back(draw.inputs[units[u].sources.front()]);
    for (std::size_t c = 0; c < characteristics.size(); ++c) {
      std::vector<double> values;
      for (const auto& row : rows)
        values.push_back(row[c]);
      result[c][u] = contributionOf(inputs, values);
    }
  }
  return result;
}

std::optional<std::vector<std::vector<std::optional<SobolIndices>>>> sobolIndices(
    const Model& model, const Sampler& sampler, const std::vector<Characteristic>& characteristics,
    std::uint64_t trials, const RunSettings& settings) {
  const Columns columns(characteristics);
  const auto& units = sampler.units();
  std::vector<Draw> a, b;
  for (std::uint64_t i = 0; i < trials; ++i) {
    a.push_back(sampler.draw(i, Purpose::Trial));
    b.push_back(sampler.draw(i, Purpose::Resample));
  }
  const std::uint64_t of = trials * (units.size() + 2);
  std::uint64_t done = 0;
  Rows rowsA, rowsB;
  if (!runRows(model, a, columns, settings, done, of, rowsA)) return std::nullopt;
  if (!runRows(model, b, columns, settings, done, of, rowsB)) return std::nullopt;
  std::vector<std::vector<std::optional<SobolIndices>>> result(characteristics.size(),
                                                               std::vector<std::optional<SobolIndices>>(units.size()));
  for (std::size_t u = 0; u < units.size(); ++u) {
    std::vector<Draw> mixed;
    for (std::size_t i = 0; i < a.size(); ++i)
      mixed.push_back(replaced(a[i], b[i], units[u]));
    Rows rows;
    if (!runRows(model, mixed, columns, settings, done, of, rows)) return std::nullopt;
    for (std::size_t c = 0; c < characteristics.size(); ++c)
      result[c][u] = indicesOf(c, rowsA, rowsB, rows);
  }
  return result;
}

}  // namespace probewright::study
