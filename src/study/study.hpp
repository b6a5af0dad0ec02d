#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.hpp"
#include "study/distribution.hpp"
#include "study/number_path.hpp"

/// A study: what of a setup is not known exactly, and what is asked of a program that runs in it. docs/uncertainty.md
/// describes every key of its file.
namespace probewright::study {

/// In a gauge study, when a source is drawn anew.
enum class Drawn {
  EachTrial,      ///< with every repeat
  EachAppraiser,  ///< for each appraiser (clamping, shift, machine), the same for all parts and repeats
  EachPart,       ///< for each part, the same whoever measures it
};

/// A number of the setup that is distributed.
struct Source {
  std::string name;
  NumberPath quantity;
  Distribution distribution;
  bool known = false;  ///< what the control believes follows it, as if calibrated anew in each trial
  Drawn drawn = Drawn::EachTrial;
  SourcePlace place;
};

/// Sources that are drawn together.
struct Group {
  std::string name;
  std::vector<std::size_t> sources;
  /// Times independent standard normal numbers: normal numbers with the correlation that is wanted.
  Eigen::MatrixXd factor;
};

/// What is known of a result besides what the program says.
struct Measurand {
  std::string result;  ///< its key, or the end of it
  /// factor * the number of the setup + offset is the true value; nothing: nobody knows it.
  std::optional<NumberPath> truth;
  double factor = 1, offset = 0;
  std::optional<double> lower, upper;  ///< limits of the tolerance, before those of the program
  SourcePlace place;
};

enum class Sensitivity { None, OneAtATime, Sobol };

struct GaugeStudy {
  std::uint64_t parts = 10, appraisers = 3, repeats = 3;
};

struct Study {
  std::string file;
  std::uint64_t seed = 1;
  /// Significant digits of the standard uncertainty that are to be stable (JCGM 101, 7.9).
  int digits = 2;
  std::uint64_t block = 10'000;  ///< trials between two looks at the digits
  std::uint64_t mostTrials = 1'000'000;
  std::optional<std::uint64_t> trials;  ///< this many, whatever the digits
  double coverage = 0.95;
  double guardFactor = 1.65;  ///< guard band of ISO 14253-1 in standard uncertainties
  Sensitivity sensitivity = Sensitivity::OneAtATime;
  std::uint64_t sensitivityTrials = 1'000;
  bool trueValues = true;           ///< the virtual machine tells the true values of the trials' results
  std::filesystem::path calibrate;  ///< runs first in each trial; empty: nothing does
  std::vector<Source> sources;
  std::vector<Group> groups;
  std::vector<Measurand> measurands;
  std::optional<GaugeStudy> gauge;
  std::vector<std::filesystem::path> inputs;  ///< files that it names
};

/// The study that `text` writes, on top of the setup in `setup`, whose numbers are the default of means. Relative paths
/// count from the folder of `file`. Mistakes go to `diagnostics`, all of them; nothing is returned if there are any.
std::optional<Study> parseStudy(std::string_view text, const std::string& file, const toml::table& setup,
                                Diagnostics& diagnostics);
std::optional<Study> readStudy(const std::filesystem::path& path, const toml::table& setup, Diagnostics& diagnostics);

}  // namespace probewright::study
