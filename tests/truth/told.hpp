#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "records/truth.hpp"
#include "setup/simulated_run.hpp"

/// Programs in worlds that setup files plant, and what is told of the truth afterwards.
namespace probewright::truth::testing {

/// A setup with a probe of ball radius 3 that is believed as `believedRadius`, preset 1 and G54 at `origin`.
struct World {
  std::string control = "TNC640";
  std::string part;  ///< [part] with its features
  double believedRadius = 3;
  Vector3 origin = Vector3::Zero();
  double rotation = 0;      ///< degrees about Z
  std::string probe;        ///< more keys of the probe
  std::string more;         ///< more sections
  std::string unit = "MM";  ///< of a Klartext program

  std::string text() const {
    const std::string frame = fmt::format("origin = [{}, {}, {}]\nrotation = [0, 0, {}]\nactive = true\n", origin.x(),
                                          origin.y(), origin.z(), rotation);
    return fmt::format(
        "seed = 7\n[control]\ntype = \"{}\"\n{}\n[[tool]]\nnumber = 1\nname = \"PROBE\"\nkind = \"probe\"\n"
        "length = 150\nball_radius = 3\nbelieved_radius = {}\n{}\n{}{}\n{}",
        control, part, believedRadius, probe,
        control == "840Dsl" ? "[[zero_offset]]\nname = \"G54\"\n" : "[[preset]]\nrow = 1\n", frame, more);
  }
};

/// Preset and G54 where most parts have their top.
inline World worldWith(const std::string& part, const std::string& control = "TNC640") {
  World world;
  world.control = control;
  world.origin = {0, 0, -480};
  world.part = part;
  return world;
}

/// The first blocks of a Klartext program: the probe in the spindle, above the part.
inline const std::string probeAbove = "TOOL CALL 1 Z\nL Z+50 R0 FMAX\n";

struct Told {
  session::RunOutcome outcome;

  bool finished() const { return outcome.result.end == execution::RunEnd::Finished && outcome.diagnostics.empty(); }
  std::string why() const {
    for (const Diagnostics* list : {&outcome.diagnostics, &outcome.result.diagnostics})
      if (!list->empty()) return format(list->front());
    return {};
  }
  const records::Truth& truth() const { return *outcome.info.truth; }
  /// The true value of a result of the last cycle.
  std::optional<records::TrueValue> of(const std::string& name) const {
    const auto& results = outcome.journal.cycles.back().results;
    const auto found = std::ranges::find(results, name, &control::ResultRecord::name);
    if (found == results.end()) {
      ADD_FAILURE() << "no result " << name;
      return std::nullopt;
    }
    return truth().cycles.back().results[static_cast<std::size_t>(found - results.begin())];
  }
  double value(const std::string& name) const {
    const auto known = of(name);
    EXPECT_TRUE(known) << name << " has no true value";
    return known ? known->value : 1e9;
  }
  double measured(const std::string& name) const {
    const auto& results = outcome.journal.cycles.back().results;
    return std::ranges::find(results, name, &control::ResultRecord::name)->value;
  }
};

inline Told run(const World& world, const std::string& program, setup::MachineOptions options = {},
                const session::RunOptions& running = {}) {
  Diagnostics diagnostics;
  const auto setup = setup::parseSetup(world.text(), "world.toml", diagnostics);
  if (!setup) {
    ADD_FAILURE() << format(diagnostics.front());
    return {};
  }
  const bool heidenhain = world.control != "840Dsl";
  const std::string text =
      heidenhain ? fmt::format("BEGIN PGM T {0}\n{1}END PGM T {0}\n", world.unit, program) : program + "M30\n";
  return {setup::runText(heidenhain ? "T.H" : "T.MPF", text, *setup, running, options).outcome};
}

/// A plate of 80 x 60 x 20 whose top face carries the part's origin, with a hole of 30.01 in the middle.
inline std::string plate(const std::string& pose) {
  return "[part]\nname = \"plate\"\npose = " + pose +
         "\n[[part.feature]]\nshape = \"box\"\ncentre = [0, 0, -20]\nsize = [80, 60, 20]\n"
         "[[part.feature]]\nshape = \"hole\"\ndiameter = 30.01\n";
}

/// What is told of an entry of a table, by its name.
inline const records::EntryTruth& entry(const Told& told, const std::string& name) {
  static const records::EntryTruth none;
  const auto& entries = told.truth().entries;
  const auto found = std::ranges::find(entries, name, &records::EntryTruth::name);
  EXPECT_NE(found, entries.end()) << "no entry " << name;
  return found == entries.end() ? none : *found;
}

/// One of its values.
inline const records::EntryValue& value(const records::EntryTruth& entry, const std::string& name) {
  static const records::EntryValue none;
  const auto found = std::ranges::find(entry.values, name, &records::EntryValue::name);
  EXPECT_NE(found, entry.values.end()) << "no value " << name;
  return found == entry.values.end() ? none : *found;
}

/// A folder with a setup and the tables of its control, which goes with the test.
class TableFolder {
public:
  TableFolder() : path_(std::filesystem::temp_directory_path() / ("truth-test-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~TableFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TableFolder(const TableFolder&) = delete;
  TableFolder& operator=(const TableFolder&) = delete;
  void put(const std::string& name, const std::string& text) const { std::ofstream(path_ / name) << text; }
  const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
};

}  // namespace probewright::truth::testing
