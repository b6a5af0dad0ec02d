#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>

#include "setup/setup_document.hpp"
#include "study/program_model.hpp"
#include "study/run_study.hpp"

/// Studies of programs: a plate with a bore on a mill with a TNC 640.
namespace probewright::study::testing {

/// A folder that goes with the test.
class TestFolder {
public:
  TestFolder()
      : path_(std::filesystem::temp_directory_path() /
              ("study-test-" + std::to_string(getpid()) + "-" + std::to_string(++count()))) {
    std::filesystem::create_directories(path_);
  }
  ~TestFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;
  std::filesystem::path file(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return path_ / name;
  }
  const std::filesystem::path& path() const { return path_; }

private:
  static std::atomic<int>& count() {
    static std::atomic<int> made{0};
    return made;
  }
  std::filesystem::path path_;
};

/// A plate of 80 x 60 x 20 mm with a bore of 30 mm in its middle; the top face lies at Z -480. `tool` adds to the
/// probe, `more` to the setup.
inline std::string plateSetup(const std::string& tool = "repeatability = 0.002\n", const std::string& more = "") {
  return R"(
[control]
type = "TNC640"
[part]
name = "plate"
pose = { x = 0, y = 0, z = -500, b = 0 }
[[part.feature]]
shape = "box"
size = [80, 60, 20]
[[part.feature]]
shape = "hole"
centre = [0, 0, 20]
diameter = 30
[[preset]]
row = 1
origin = [0, 0, -480]
active = true
[[tool]]
number = 1
name = "PROBE"
kind = "probe"
length = 150
ball_radius = 3
)" + tool +
         more;
}

inline std::string program(const std::string& blocks) {
  return "0 BEGIN PGM P MM\n1 TOOL CALL 1 Z\n2 L Z+50 R0 FMAX\n" + blocks + "99 END PGM P MM\n";
}

/// Cycle 421: the bore by `points` touches.
inline std::string bore(int block, int points, const std::string& limits = "Q275=+0 ~\nQ276=+0 ~\n") {
  const std::string step = points == 3 ? "120" : "90";
  return std::to_string(block) + " TCH PROBE 421 BORE ~\nQ273=+0 ~\nQ274=+0 ~\nQ262=+30 ~\nQ325=+0 ~\nQ247=+" + step +
         " ~\nQ261=-5 ~\nQ320=+2 ~\nQ260=+20 ~\nQ301=+0 ~\n" + limits +
         "Q279=+0 ~\nQ280=+0 ~\nQ281=+0 ~\nQ309=+0 ~\nQ330=+0 ~\nQ423=+" + std::to_string(points) + " ~\nQ365=+0\n";
}

inline StudyResult studyOfProgram(const std::string& setupText, const std::string& programText,
                                  const std::string& studyText, StudyRun run = {},
                                  const std::string& calibration = {}) {
  const TestFolder folder;
  Diagnostics mistakes;
  auto document = setup::SetupDocument::parse(setupText, (folder.path() / "setup.toml").string(), mistakes);
  std::optional<Study> study;
  if (!calibration.empty()) folder.file("calibrate.h", calibration);
  if (document) study = parseStudy(studyText, (folder.path() / "study.toml").string(), document->table(), mistakes);
  for (const Diagnostic& mistake : mistakes)
    ADD_FAILURE() << format(mistake);
  if (!study) return {};
  const toml::table table = document->table();
  const auto model = ProgramModel::make(folder.file("p.h", programText), std::move(*document), *study, {}, mistakes);
  for (const Diagnostic& mistake : mistakes)
    ADD_FAILURE() << format(mistake);
  if (!model) return {};
  return runStudy(
      *study, table, [&](const Draw& draw) { return model->run(draw); }, run);
}

/// Why a study whose file can be read cannot begin on this setup; nothing if it can.
inline Diagnostics mistakesOfModel(const std::string& setupText, const std::string& programText,
                                   const std::string& studyText) {
  const TestFolder folder;
  Diagnostics mistakes;
  auto document = setup::SetupDocument::parse(setupText, "setup.toml", mistakes);
  const auto study = parseStudy(studyText, "study.toml", document->table(), mistakes);
  EXPECT_TRUE(study) << studyText;
  const bool made = study && ProgramModel::make(folder.file("p.h", programText), std::move(*document), *study, {},
                                                mistakes) != nullptr;
  EXPECT_EQ(made, mistakes.empty()) << studyText;
  return mistakes;
}

/// The answer with this key.
inline const Answer& answer(const StudyResult& result, const std::string& key) {
  static const Answer none;
  std::string keys;
  for (const Answer& each : result.answers) {
    if (each.of.key == key) return each;
    keys += "\n  " + each.of.key;
  }
  ADD_FAILURE() << "no result " << key << "; there are" << keys;
  return none;
}

}  // namespace probewright::study::testing
