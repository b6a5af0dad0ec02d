#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <map>
#include <sstream>

#include "base/file.hpp"
#include "setup/simulated_run.hpp"
#include "study/observations.hpp"
#include "study/program_bench.hpp"

/// Every number that a setup writes may be a source of a study: a trial in which it is drawn, and known, is the run of
/// the setup in which it is written.
namespace probewright::study::testing {
namespace {

namespace fs = std::filesystem;

struct World {
  const char *setup, *program;
};
void PrintTo(const World& world, std::ostream* out) { *out << world.setup; }

struct Number {
  std::string path, kind;  ///< as a study names it; the keys alone
  double value = 0;
};

std::string named(const std::string& key) {
  for (const char c : key)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_') return "\"" + key + "\"";
  return key;
}

void collect(const toml::node& node, const std::string& path, const std::string& kind, std::vector<Number>& numbers) {
  if (const auto* table = node.as_table()) {
    for (const auto& [key, value] : *table) {
      const std::string name(key.str());
      collect(value, path + (path.empty() ? "" : ".") + named(name), kind + "." + name, numbers);
    }
  } else if (const auto* list = node.as_array()) {
    for (std::size_t i = 0; i < list->size(); ++i)
      collect((*list)[i], path + "[" + std::to_string(i + 1) + "]", kind, numbers);
  } else if (node.is_number()) {
    numbers.push_back({path, kind, node.value<double>().value()});
  }
}

/// Without scatter, so that two runs can be compared.
void silence(toml::node& node) {
  if (auto* table = node.as_table()) {
    if (table->contains("repeatability")) table->insert_or_assign("repeatability", 0.0);
    for (auto&& [key, value] : *table)
      silence(value);
  } else if (auto* list = node.as_array()) {
    for (auto& value : *list)
      silence(value);
  }
}

std::string written(const toml::table& table) {
  std::ostringstream text;
  text << toml::toml_formatter(table, toml::format_flags::none);
  return text.str();
}

std::map<std::string, double> valuesOf(const std::vector<Observation>& observations) {
  std::map<std::string, double> values;
  for (const Observation& observation : observations)
    values[observation.of.key] = observation.value;
  return values;
}

class EveryNumber : public ::testing::TestWithParam<World> {};

TEST_P(EveryNumber, IsDrawnAsItIsWritten) {
  const fs::path examples = PROBEWRIGHT_EXAMPLES, file = examples / GetParam().setup,
                 program = examples / GetParam().program;
  toml::table table = toml::parse_file(file.string());
  silence(table);
  table.insert("errors", toml::parse("axis.X = { scale_mm_per_m = 0.02, offset = 0.003, backlash = 0.002 }\n"
                                     "spindle_tilt = [0.01, 0.0, 0.0]\nthermal = [{ amount = [0.0, 0.0, 0.02] }]\n"));
  std::vector<Number> numbers;
  collect(table, "", "", numbers);
  std::map<std::string, int> kinds;
  int compared = 0;
  for (const Number& number : numbers) {
    // Of numbers in lists one stands for all. The name of a row or a tool is not a quantity; scatter is drawn anew.
    if (kinds[number.kind]++ > 0 || number.kind == ".seed" || number.kind.ends_with(".row") ||
        number.kind.ends_with("].number") || number.kind == ".tool.number" || number.kind.ends_with("repeatability"))
      continue;
    SCOPED_TRACE(number.path);
    const double value = number.value * 1.0007 + 0.0003;
    toml::table changed = table;
    ASSERT_TRUE(NumberPath::parse(number.path).value().set(changed, value));
    Diagnostics mistakes, ofStudy;
    const auto setup = setup::parseSetup(written(changed), file.string(), mistakes);
    auto document = setup::SetupDocument::parse(written(table), file.string(), ofStudy);
    ASSERT_TRUE(document) << format(ofStudy.front());
    std::ostringstream text;
    text << "trials = 1\n[[source]]\nquantity = '" << number.path
         << "'\ndistribution = \"discrete\"\nknown = true\nvalues = [" << toml::value<double>(value) << ", "
         << toml::value<double>(number.value) << "]\nweights = [9, 1]\n";
    const auto study = parseStudy(text.str(), "study.toml", document->table(), ofStudy);
    ASSERT_TRUE(study) << format(ofStudy.front());
    const auto model = ProgramModel::make(program, std::move(*document), *study, {}, ofStudy);
    ASSERT_TRUE(model);
    const Outcome trial = model->run(Sampler(*study).estimate());
    if (!setup) {
      EXPECT_EQ(trial.end, TrialEnd::Refused);
      EXPECT_NE(trial.why, "");
      continue;
    }
    const setup::SimulatedRun run = setup::runText(program.string(), readFile(program).value(), *setup, {});
    const auto observed = observationsOf(run.outcome.journal, {program.string(), "", 0, {}});
    for (const Observation& each : observed)
      EXPECT_FALSE(each.of.firstOrder) << each.of.key
                                       << ": where touches do not scatter there is no uncertainty of them";
    const auto expected = valuesOf(observed);
    const auto found = valuesOf(trial.observations);
    EXPECT_EQ(found.size(), expected.size());
    for (const auto& [key, measured] : expected) {
      ASSERT_TRUE(found.contains(key)) << key;
      EXPECT_NEAR(found.at(key), measured, 1e-9 * std::max(1.0, std::abs(measured))) << key;
    }
    ++compared;
  }
  EXPECT_GT(compared, 8);
}

INSTANTIATE_TEST_SUITE_P(Examples, EveryNumber,
                         ::testing::Values(World{"first/plate.toml", "first/plate.h"},
                                           World{"studies/calibrated.setup.toml", "first/plate.h"},
                                           World{"setups/kinematics-tnc640.toml", "programs/kinematics.h"},
                                           World{"setups/tool-tnc640.toml", "programs/tool.h"},
                                           World{"setups/shaft-lathe.toml", "programs/shaft.mpf"}),
                         [](const auto& each) {
                           std::string name;
                           for (const char c : std::string(each.param.setup))
                             if (std::isalnum(static_cast<unsigned char>(c)) != 0) name += c;
                           return name;
                         });

/// A count is drawn from whole values; others are refused, in words.
TEST(WholeNumbers, AreDrawnFromWholeValues) {
  const std::string setup =
      plateSetup("", "[[tool]]\nnumber = 2\nkind = \"mill\"\nlength = 80\nradius = 5\n[tool.cutter]\nteeth = 3\n");
  const auto study = [](const std::string& source) {
    return "trials = 12\nsensitivity = \"none\"\n[[source]]\nquantity = \"tool[number=2].cutter.teeth\"\n" + source;
  };
  const std::string measuring = program(bore(3, 4));
  EXPECT_EQ(studyOfProgram(setup, measuring, study("distribution = \"discrete\"\nvalues = [2, 4]\n")).finished, 12U);
  const Diagnostics refused = mistakesOfModel(setup, measuring, study("distribution = \"uniform\"\nhalf_width = 1\n"));
  ASSERT_EQ(refused.size(), 1U);
  EXPECT_THAT(refused.front().message, ::testing::HasSubstr("\"teeth\" in [tool.cutter] must be a whole number"));
}

}  // namespace
}  // namespace probewright::study::testing
