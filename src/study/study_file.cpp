#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <set>

#include "base/file.hpp"
#include "base/number_text.hpp"
#include "base/text.hpp"
#include "base/toml_table.hpp"
#include "study/study.hpp"

namespace probewright::study {

namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t mostTrialsOfAll = 100'000'000;
constexpr std::size_t mostSources = 1000;
constexpr NumberRange anyNumber = NumberRange::within(1e12);

/// The numbers of a file, one a line, or the column of a CSV file that `column` names.
Result<std::vector<double>> readSamples(const fs::path& path, const std::string& column) {
  auto text = readFile(path, largestText);
  if (!text) return tl::unexpected(text.error());
  std::vector<double> values;
  std::size_t place = 0;
  std::uint64_t lineNumber = 0;
  bool headed = column.empty();
  for (std::size_t begin = 0; begin < text->size();) {
    const std::size_t end = std::min(text->find('\n', begin), text->size());
    const std::string_view line = trimmed(std::string_view(*text).substr(begin, end - begin), blanksAndReturn);
    begin = end + 1;
    ++lineNumber;
    if (line.empty() || line.front() == '#') continue;
    std::vector<std::string_view> cells;
    for (std::size_t i = 0; i <= line.size();) {
      const std::size_t stop = std::min(line.find_first_of(",;", i), line.size());
      cells.push_back(trimmed(line.substr(i, stop - i)));
      i = stop + 1;
    }
    if (!headed) {
      const auto found = std::ranges::find(cells, column);
      if (found == cells.end())
        return fail({path.string(), lineNumber, 0}, fmt::format("no column is called \"{}\"", column),
                    "the first line of the file names its columns");
      place = static_cast<std::size_t>(found - cells.begin());
      headed = true;
      continue;
    }
    const auto value = place < cells.size() ? parseDecimal(cells[place]) : std::nullopt;
    if (!value)
      return fail({path.string(), lineNumber, 0}, "a number was expected here", "write numbers such as 0.0125");
    values.push_back(*value);
  }
  if (values.empty()) return fail(SourcePlace{path.string(), 0, 0}, "the file holds no samples");
  return values;
}

class StudyReader {
public:
  StudyReader(TomlReader& root, fs::path folder, const toml::table& setup, Study& study)
      : root_(root), folder_(std::move(folder)), setup_(setup), study_(study) {}

  void read() {
    readPlan();
    bool any = false;
    for (TomlReader& reader : root_.tables("source")) {
      any = true;
      readSource(reader);
    }
    if (!any)
      root_.report("source", "a study needs at least one [[source]]",
                   "name a number of the setup and how it is distributed (docs/uncertainty.md)");
    for (TomlReader& reader : root_.tables("group"))
      readGroup(reader);
    for (const Pending& pending : pending_) {
      if (pending.taken) continue;
      root_.diagnostics().push_back({Severity::Error,
                                     pending.place,
                                     "the standard deviation of this source is missing",
                                     {},
                                     "write standard_deviation, or a [[group]] with the covariance of this source",
                                     {}});
    }
    for (TomlReader& reader : root_.tables("measurand"))
      readMeasurand(reader);
    if (auto reader = root_.table("gauge")) readGauge(*reader);
    root_.finish();
  }

private:
  /// A normal distribution whose deviation a group is to say.
  struct Pending {
    std::size_t source = 0;
    SourcePlace place;
    bool taken = false;
  };

  fs::path resolve(const std::string& path) const {
    return fs::path(path).is_absolute() ? fs::path(path) : folder_ / path;
  }

  std::uint64_t count(TomlReader& reader, std::string_view key, std::uint64_t otherwise, std::uint64_t least) {
    const auto value = reader.integer(key, static_cast<long long>(least), static_cast<long long>(mostTrialsOfAll));
    return value ? static_cast<std::uint64_t>(*value) : otherwise;
  }

  void readPlan() {
    study_.seed = static_cast<std::uint64_t>(root_.integer("seed", 0, INT64_MAX).value_or(1));
    study_.digits = static_cast<int>(root_.integer("digits", 1, 3).value_or(study_.digits));
    study_.block = count(root_, "block", study_.block, 10);
    study_.mostTrials = count(root_, "most_trials", study_.mostTrials, 1);
    if (root_.has("trials")) study_.trials = count(root_, "trials", 1000, 1);
    if (root_.has("trials") && root_.has("digits"))
      root_.report("digits", "a study has either a number of trials or digits that are to be stable");
    study_.coverage = root_.number("coverage", {0.5, 0.999}).value_or(study_.coverage);
    study_.guardFactor = root_.number("guard_factor", {0, 10}).value_or(study_.guardFactor);
    static const std::vector<std::string> kinds = {"none", "one-at-a-time", "sobol"};
    study_.sensitivity = static_cast<Sensitivity>(root_.choice("sensitivity", kinds).value_or(1));
    study_.sensitivityTrials = count(root_, "sensitivity_trials", study_.sensitivityTrials, 10);
    study_.trueValues = root_.boolean("true_values").value_or(study_.trueValues);
    if (const auto calibrate = root_.text("calibrate")) {
      study_.calibrate = resolve(*calibrate);
      study_.inputs.push_back(study_.calibrate);
    }
  }

  /// A number that has a default.
  double numberOr(TomlReader& reader, std::string_view key, std::optional<double> otherwise, const NumberPath& path) {
    if (const auto value = reader.number(key, anyNumber)) return *value;
    if (!otherwise && !reader.has(key))
      reader.report(key, fmt::format("\"{}\" is missing: the setup does not write {}", key, path.text()),
                    "write it here, or write the number in the setup");
    return otherwise.value_or(0);
  }

  /// Limits as minimum and maximum, or as half_width about the setup's number.
  std::pair<double, double> limits(TomlReader& reader, std::optional<double> written, const NumberPath& path) {
    if (reader.has("half_width")) {
      const double half = reader.requiredNumber("half_width", NumberRange::positive()).value_or(1);
      if (reader.has("minimum") || reader.has("maximum"))
        reader.report("half_width", "write either half_width or minimum and maximum");
      const double middle = numberOr(reader, "mean", written, path);
      return {middle - half, middle + half};
    }
    const auto minimum = reader.requiredNumber("minimum", anyNumber),
               maximum = reader.requiredNumber("maximum", anyNumber);
    return {minimum.value_or(0), maximum.value_or(1)};
  }

  std::optional<Distribution::Kind> readKind(TomlReader& reader, const NumberPath& path, bool& deviationMissing) {
    static const std::vector<std::string> kinds = {"normal",  "uniform",  "triangular", "u-shaped",
                                                   "student", "discrete", "samples"};
    const std::optional<double> written = path.numberIn(setup_);
    reader.require("distribution");
    const auto kind =
        reader.choice("distribution", kinds,
                      {{"gaussian", "normal"}, {"rectangular", "uniform"}, {"arcsine", "u-shaped"}, {"t", "student"}});
    if (!kind) return std::nullopt;
    switch (*kind) {
      case 0: {
        deviationMissing = !reader.has("standard_deviation");
        const double deviation = reader.number("standard_deviation", NumberRange::positive()).value_or(1);
        return Normal{numberOr(reader, "mean", written, path), deviation};
      }
      case 1: {
        const auto [minimum, maximum] = limits(reader, written, path);
        const double inexactness = reader.number("inexactness", NumberRange::notNegative()).value_or(0);
        if (inexactness > 0) return InexactLimits{minimum, maximum, inexactness};
        return Uniform{minimum, maximum};
      }
      case 2: {
        const auto [minimum, maximum] = limits(reader, written, path);
        const double mode = reader.number("mode", anyNumber).value_or((minimum + maximum) / 2);
        return Triangular{minimum, mode, maximum};
      }
      case 3: {
        const auto [minimum, maximum] = limits(reader, written, path);
        return UShaped{minimum, maximum};
      }
      case 4: {
        const double scale = reader.requiredNumber("standard_deviation", NumberRange::positive()).value_or(1);
        const double degrees = reader.requiredNumber("degrees_of_freedom", NumberRange::positive()).value_or(10);
        return Student{numberOr(reader, "mean", written, path), scale, degrees};
      }
      case 5: {
        reader.require("values");
        Discrete discrete;
        discrete.values = reader.numbers("values", 0, anyNumber).value_or(std::vector<double>{});
        discrete.weights = reader.numbers("weights", 0, NumberRange::notNegative())
                               .value_or(std::vector<double>(discrete.values.size(), 1.0));
        return discrete;
      }
      default: {
        const auto file = reader.requiredText("file");
        const std::string column = reader.text("column").value_or("");
        if (!file) return std::nullopt;
        study_.inputs.push_back(resolve(*file));
        auto values = readSamples(study_.inputs.back(), column);
        if (!values) {
          reader.diagnostics().push_back(std::move(values.error()));
          return std::nullopt;
        }
        return Samples{std::make_shared<const std::vector<double>>(std::move(*values))};
      }
    }
  }

  void readSource(TomlReader& reader) {
    const auto quantity = reader.requiredText("quantity");
    auto path = NumberPath::parse(quantity.value_or("missing"));
    const std::string name = reader.text("name").value_or(quantity.value_or(""));
    static const std::vector<std::string> times = {"trial", "appraiser", "part"};
    const auto drawn = static_cast<Drawn>(reader.choice("drawn", times).value_or(0));
    const bool known = reader.boolean("known").value_or(false);
    const auto between = reader.numbers("between", 2, anyNumber);
    if (!path) {
      reader.report("quantity", path.error().message, path.error().advice);
      return;
    }
    if (quantity && !hasPlace(reader, *path)) return;
    bool deviationMissing = false;
    const std::size_t before = reader.diagnostics().size();
    auto kind = readKind(reader, *path, deviationMissing);
    const std::size_t ofKind = reader.diagnostics().size();
    reader.finish();
    // A key that nobody knows may be why another one is missing: it is told first.
    const auto first = reader.diagnostics().begin();
    std::rotate(first + static_cast<std::ptrdiff_t>(before), first + static_cast<std::ptrdiff_t>(ofKind),
                reader.diagnostics().end());
    if (!kind || !quantity) return;
    auto distribution = between ? Distribution::truncated(std::move(*kind), {(*between)[0], (*between)[1]})
                                : Distribution::make(std::move(*kind));
    if (!distribution) {
      reader.report("distribution", distribution.error().message, distribution.error().advice);
      return;
    }
    for (const Source& other : study_.sources) {
      if (other.name == name) reader.report("name", fmt::format("there are two sources called \"{}\"", name));
      if (other.quantity.text() == path->text())
        reader.report("quantity", fmt::format("{} is distributed twice", path->text()));
    }
    if (study_.sources.size() >= mostSources) {
      reader.report("quantity", fmt::format("a study has at most {} sources", mostSources));
      return;
    }
    if (deviationMissing) pending_.push_back({study_.sources.size(), reader.placeOf("quantity"), false});
    study_.sources.push_back(
        {name, std::move(*path), std::move(*distribution), known, drawn, reader.placeOf("quantity")});
  }

  /// There must be a place for the number; whether the setup knows it, the first trial shows.
  bool hasPlace(TomlReader& reader, const NumberPath& path) {
    toml::table copy = setup_;
    const auto set = path.set(copy, path.numberIn(setup_).value_or(0));
    if (!set) reader.report("quantity", set.error().message, set.error().advice);
    return set.has_value();
  }

  std::optional<Eigen::MatrixXd> readMatrix(TomlReader& reader, std::string_view key, std::size_t size) {
    const auto values = reader.numbers(key, size * size, anyNumber);
    if (!values || size == 0) return std::nullopt;
    Eigen::MatrixXd matrix(size, size);
    for (std::size_t row = 0; row < size; ++row) {
      for (std::size_t column = 0; column < size; ++column)
        matrix(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) = (*values)[row * size + column];
    }
    if ((matrix - matrix.transpose()).cwiseAbs().maxCoeff() > 1e-9 * matrix.cwiseAbs().maxCoeff()) {
      reader.report(key, fmt::format("\"{}\" must be symmetric", key));
      return std::nullopt;
    }
    return matrix;
  }

  std::vector<std::size_t> readMembers(TomlReader& reader) {
    std::vector<std::size_t> members;
    // One text: names of sources with commas. TOML lists of texts are not read elsewhere in setups, either.
    const auto names = reader.requiredText("sources");
    if (!names) return members;
    std::string_view rest = *names;
    while (!rest.empty()) {
      const std::size_t comma = std::min(rest.find(','), rest.size());
      const std::string_view name = trimmed(rest.substr(0, comma));
      rest.remove_prefix(std::min(comma + 1, rest.size()));
      const auto found = std::ranges::find(study_.sources, name, &Source::name);
      if (found == study_.sources.end()) {
        reader.report("sources", fmt::format("no source is called \"{}\"", name), "write the sources before the group");
        continue;
      }
      const auto index = static_cast<std::size_t>(found - study_.sources.begin());
      if (!grouped_.insert(index).second)
        reader.report("sources", fmt::format("\"{}\" is in a group already", name));
      else
        members.push_back(index);
    }
    if (members.size() < 2) reader.report("sources", "a group needs at least two sources");
    return members;
  }

  void readGroup(TomlReader& reader) {
    Group group;
    group.name = reader.text("name").value_or("");
    group.sources = readMembers(reader);
    const std::size_t size = group.sources.size();
    const bool hasCovariance = reader.has("covariance");
    if (hasCovariance == reader.has("correlation"))
      reader.report("covariance", "a group needs either a covariance or a correlation",
                    "write the matrix row by row in one list: correlation = [1, 0.8, 0.8, 1]");
    // Whatever is wrong with a covariance is said there, not of the deviations that it was to tell.
    for (Pending& pending : pending_)
      pending.taken = pending.taken || (hasCovariance && std::ranges::count(group.sources, pending.source) > 0);
    auto matrix = readMatrix(reader, hasCovariance ? "covariance" : "correlation", size);
    reader.finish();
    if (!matrix || size < 2) return;
    for (const std::size_t member : group.sources) {
      const Source& source = study_.sources[member];
      if (group.name.empty() || group.name.back() == '+') group.name += source.name + "+";
      if (std::holds_alternative<InexactLimits>(source.distribution.kind()))
        reader.report("sources", fmt::format("\"{}\" cannot be correlated: its limits are inexact", source.name));
      if (source.drawn != study_.sources[group.sources.front()].drawn)
        reader.report("sources", "the sources of a group are drawn at the same time: \"drawn\" must be the same");
    }
    if (group.name.back() == '+') group.name.pop_back();
    if (hasCovariance && !takeDeviations(reader, group, *matrix)) return;
    for (Eigen::Index i = 0; i < matrix->rows(); ++i) {
      Eigen::Index other = 0;
      const double greatest = matrix->row(i).cwiseAbs().maxCoeff(&other);
      if (hasCovariance && greatest > 1 + 1e-9) {
        const auto nameOf = [&](Eigen::Index at) {
          return study_.sources[group.sources[static_cast<std::size_t>(at)]].name;
        };
        reader.report("covariance", fmt::format("this covariance is not positive semidefinite: that of \"{}\" and "
                                                "\"{}\" is beyond the product of their standard deviations",
                                                nameOf(i), nameOf(other)));
        return;
      }
      if (std::abs((*matrix)(i, i) - 1) > 1e-9 || greatest > 1 + 1e-9) {
        reader.report("correlation", "a correlation has 1 on its diagonal and numbers from -1 to 1 elsewhere");
        return;
      }
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(*matrix);
    if (solver.info() != Eigen::Success || solver.eigenvalues().minCoeff() < -1e-9) {
      const char* key = hasCovariance ? "covariance" : "correlation";
      reader.report(key, fmt::format("this {} is not positive semidefinite: such sources cannot be", key));
      return;
    }
    group.factor = solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
    study_.groups.push_back(std::move(group));
  }

  /// The members get their deviations from the covariance, and the matrix becomes their correlation.
  bool takeDeviations(TomlReader& reader, const Group& group, Eigen::MatrixXd& matrix) {
    for (std::size_t i = 0; i < group.sources.size(); ++i) {
      Source& source = study_.sources[group.sources[i]];
      const auto pending = std::ranges::find(pending_, group.sources[i], &Pending::source);
      const auto* normal = std::get_if<Normal>(&source.distribution.kind());
      const double variance = matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i));
      if (pending == pending_.end() || normal == nullptr || source.distribution.isTruncated()) {
        reader.report("covariance",
                      fmt::format("\"{}\" must be normal, without a standard deviation of its own", source.name));
        return false;
      }
      if (!(variance > 0) || !std::isfinite(variance)) {
        reader.report("covariance", "the diagonal of a covariance, the squares of the deviations, must be above 0");
        return false;
      }
      auto distribution = Distribution::make(Normal{normal->mean, std::sqrt(variance)});
      if (!distribution) {
        reader.report("covariance", distribution.error().message);
        return false;
      }
      source.distribution = std::move(*distribution);
    }
    const Eigen::VectorXd deviations = matrix.diagonal().cwiseSqrt();
    matrix = (matrix.array() / (deviations * deviations.transpose()).array()).matrix().eval();
    return true;
  }

  void readMeasurand(TomlReader& reader) {
    Measurand measurand;
    measurand.result = reader.requiredText("result").value_or("");
    measurand.place = reader.placeOf("result");
    if (std::ranges::find(study_.measurands, measurand.result, &Measurand::result) != study_.measurands.end())
      reader.report("result", fmt::format("there are two measurands called \"{}\"", measurand.result),
                    "write what is known of it in one [[measurand]]");
    if (const auto truth = reader.text("truth")) {
      auto path = NumberPath::parse(*truth);
      if (!path) {
        reader.report("truth", path.error().message, path.error().advice);
      } else {
        const bool varies = std::ranges::any_of(
            study_.sources, [&](const Source& source) { return source.quantity.text() == path->text(); });
        if (!varies && !path->numberIn(setup_))
          reader.report("truth", fmt::format("neither the setup nor a source has the number {}", path->text()));
        measurand.truth = std::move(*path);
      }
    }
    measurand.factor = reader.number("factor", anyNumber).value_or(1);
    measurand.offset = reader.number("offset", anyNumber).value_or(0);
    measurand.lower = reader.number("lower", anyNumber);
    measurand.upper = reader.number("upper", anyNumber);
    if (measurand.lower && measurand.upper && !(*measurand.lower < *measurand.upper))
      reader.report("upper", "the lower limit must be less than the upper one");
    reader.finish();
    study_.measurands.push_back(std::move(measurand));
  }

  void readGauge(TomlReader& reader) {
    GaugeStudy gauge;
    const auto few = [&](std::string_view key, std::uint64_t otherwise, std::uint64_t least) {
      const auto value = reader.integer(key, static_cast<long long>(least), 10'000);
      return value ? static_cast<std::uint64_t>(*value) : otherwise;
    };
    gauge.parts = few("parts", gauge.parts, 2);
    gauge.appraisers = few("appraisers", gauge.appraisers, 2);
    gauge.repeats = few("repeats", gauge.repeats, 2);
    reader.finish();
    study_.gauge = gauge;
  }

  TomlReader& root_;
  fs::path folder_;
  const toml::table& setup_;
  Study& study_;
  std::vector<Pending> pending_;
  std::set<std::size_t> grouped_;
};

}  // namespace

std::optional<Study> parseStudy(std::string_view text, const std::string& file, const toml::table& setup,
                                Diagnostics& diagnostics) {
  const auto table = parseToml(text, file, diagnostics);
  if (!table) return std::nullopt;
  const auto errors = [&] { return std::ranges::count(diagnostics, Severity::Error, &Diagnostic::severity); };
  const auto before = errors();
  TomlReader root(*table, "", file, diagnostics);
  Study study;
  study.file = file;
  study.inputs.emplace_back(file);
  StudyReader(root, fs::path(file).parent_path(), setup, study).read();
  return errors() > before ? std::nullopt : std::optional(std::move(study));
}

std::optional<Study> readStudy(const fs::path& path, const toml::table& setup, Diagnostics& diagnostics) {
  auto text = readFile(path, largestText);
  if (!text) {
    diagnostics.push_back(std::move(text.error()));
    return std::nullopt;
  }
  return parseStudy(*text, path.string(), setup, diagnostics);
}

}  // namespace probewright::study
