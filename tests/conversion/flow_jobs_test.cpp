#include <gtest/gtest.h>

#include <filesystem>

#include "base/file.hpp"
#include "conversion/flow.hpp"
#include "session/job.hpp"

/// Jobs of several programs that call each other and share parameters: the programs that are written run through the
/// same touches.
namespace probewright::testing_support {
namespace {

namespace fs = std::filesystem;

/// A folder that is gone at the end of the test.
class JobFolder {
public:
  explicit JobFolder(const std::string& name) : path_(fs::path(::testing::TempDir()) / name) {
    fs::remove_all(path_);
    fs::create_directories(path_);
  }
  ~JobFolder() {
    std::error_code none;
    fs::remove_all(path_, none);
  }
  JobFolder(const JobFolder&) = delete;
  JobFolder& operator=(const JobFolder&) = delete;

  fs::path operator/(const std::string& name) const { return path_ / name; }
  const fs::path& path() const { return path_; }

private:
  fs::path path_;
};

using Files = std::map<std::string, std::string>;  ///< texts by name, with ending

void put(const JobFolder& folder, const Files& files) {
  for (const auto& [name, text] : files)
    EXPECT_TRUE(writeFileAtomically(folder / name, text));
}

Twin runFile(const fs::path& path, const Files& files, ProgramLanguage language, const PlantedPart& part) {
  session::RunOptions options;
  options.control = language == ProgramLanguage::Sinumerik ? ControlKind::Sinumerik840Dsl : part.bench.control;
  Twin twin = twinOf(setup::runProgram(path, twinSetup(part.bench.setup), options, {.recordPath = false}));
  for (const auto& [name, text] : files)
    twin.text += text;
  twin.language = language;
  return twin;
}

/// All files of the folder in the other language; `ending`: of theirs. Empty if something is listed.
std::optional<Files> converted(const JobFolder& folder, const Files& files, ProgramLanguage to,
                               const std::string& ending) {
  Files there;
  for (const auto& [name, text] : files) {
    if (name.ends_with(".DEF")) continue;
    const fs::path path = folder / name;
    const ProgramLanguage from = *session::languageOf(path, text);
    const auto program = session::openProgram(path, text, from);
    EXPECT_TRUE(program);
    Diagnostics diagnostics;
    conversion::ConvertOptions options = session::convertOptions(path, from, nullptr, diagnostics);
    const Diagnostics mistakes = session::mistakesOf(**program, path, from);
    EXPECT_FALSE(hasErrors(mistakes)) << format(mistakes.front()) << text;
    const conversion::Job job = session::jobOf(path, from);
    options.job = &job;
    const conversion::Conversion conversion = conversion::convert(**program, from, to, options);
    EXPECT_FALSE(hasErrors(conversion.mistakes)) << text;
    for (const Diagnostic& each : conversion.notCarriedOver)
      if (isLoss(each)) return std::nullopt;
    there[name.substr(0, name.find('.')) + ending] = conversion.text;
  }
  return there;
}

TEST(ConvertJobs, RunHeidenhainProgramsThroughTheSameTouches) {
  const int programs = setting("PROBEWRIGHT_PROGRAMS", 8);
  Dice dice(static_cast<unsigned>(setting("PROBEWRIGHT_SEED", 5001)));
  int compared = 0, inDinIso = 0;
  for (int i = 0; compared < programs && i < 12 * programs; ++i) {
    SCOPED_TRACE(fmt::format("job {}", i));
    const World world(dice);
    Files files = {{"BENCH.H", KlartextFlow(dice, world, {"BENCH", false, {"SECOND", "THIRD"}}).program()},
                   {"SECOND.H", KlartextFlow(dice, world, {"SECOND", true, {"THIRD"}}).program()},
                   {"THIRD.H", KlartextFlow(dice, world, {"THIRD", true, {}}).program()}};
    const JobFolder folder("probewright-job-h"), other("probewright-job-m");
    put(folder, files);
    if (dice.whole(0, 2) == 0) {
      const JobFolder iso("probewright-job-i");
      const auto dinIso = converted(folder, files, ProgramLanguage::DinIso, ".I");
      if (dinIso) {
        for (const auto& [name, text] : files)
          fs::remove(folder / name);
        files = *dinIso;
        put(folder, files);
        ++inDinIso;
      }
    }
    const auto there = converted(folder, files, ProgramLanguage::Sinumerik, ".SPF");
    if (!there) continue;
    ++compared;
    put(other, *there);
    const std::string main = files.begin()->first;
    const Twin original = runFile(folder / main, files, ProgramLanguage::Klartext, world.part);
    const Twin twin = runFile(other / "BENCH.SPF", *there, ProgramLanguage::Sinumerik, world.part);
    ASSERT_TRUE(runsTheSame(original, twin));
  }
  EXPECT_EQ(compared, programs) << "too many jobs are named, too few compared";
  EXPECT_GT(inDinIso, 0);
}

TEST(ConvertJobs, RunSinumerikProgramsThroughTheSameTouches) {
  const int programs = setting("PROBEWRIGHT_PROGRAMS", 8);
  Dice dice(static_cast<unsigned>(setting("PROBEWRIGHT_SEED", 5002)));
  int compared = 0;
  for (int i = 0; compared < programs && i < 60 * programs; ++i) {
    SCOPED_TRACE(fmt::format("job {}", i));
    const World world(dice);
    const Files files = {{"BENCH.MPF", SinumerikFlow(dice, world, {"BENCH", false, {"SECOND", "THIRD"}}).program()},
                         {"SECOND.SPF", SinumerikFlow(dice, world, {"SECOND", true, {"THIRD"}}).program()},
                         {"THIRD.SPF", SinumerikFlow(dice, world, {"THIRD", true, {}}).program()},
                         {"UGUD.DEF", "DEF CHAN REAL PLACES[3]=(5,3,1)\nM17\n"}};
    const JobFolder folder("probewright-job-s"), other("probewright-job-k");
    put(folder, files);
    const auto there = converted(folder, files, ProgramLanguage::Klartext, ".H");
    if (!there) continue;
    ++compared;
    put(other, *there);
    const Twin original = runFile(folder / "BENCH.MPF", files, ProgramLanguage::Sinumerik, world.part);
    const Twin twin = runFile(other / "BENCH.H", *there, ProgramLanguage::Klartext, world.part);
    ASSERT_TRUE(runsTheSame(original, twin));
  }
  EXPECT_EQ(compared, programs) << "too many jobs are named, too few compared";
}

}  // namespace
}  // namespace probewright::testing_support
