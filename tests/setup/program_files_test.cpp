#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>

#include "session/check.hpp"
#include "setup/simulated_run.hpp"
#include "support/virtual_world.hpp"

/// What HEIDENHAIN programs read from this computer, and what outlives a run.
namespace probewright::setup {
namespace {

using namespace session;

namespace fs = std::filesystem;
using records::ExitState;
using ::testing::HasSubstr;
using ::testing::Not;

/// A folder "job" with a neighbour "other" and tables, gone behind the test.
struct Folders {
  Folders() : path(fs::temp_directory_path() / ("program_files_" + std::to_string(::getpid()))) {
    fs::remove_all(path);
    for (const char* name : {"job/parts", "other", "tables"})
      fs::create_directories(path / name);
    setup.beliefs.control = control::ControlKind::TNC640;
    setup.world.truth = testing_support::perfectWorld();
    setup.beliefs.file = (path / "job/setup.toml").string();
  }
  ~Folders() { fs::remove_all(path); }
  Folders(const Folders&) = delete;
  Folders& operator=(const Folders&) = delete;
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path / name) << text;
    return path / name;
  }
  RunOutcome run(const std::string& blocks) const {
    return runProgram(write("job/P.H", "0 BEGIN PGM P MM\n" + blocks + "9 END PGM P MM\n"), setup, {}).outcome;
  }
  std::string why(const std::string& blocks) const { return run(blocks).info.exitText; }

  fs::path path;
  setup::Setup setup;
};

TEST(ProgramFiles, AreThoseOfTheProgramsFolderAndOfTheTables) {
  Folders folders;
  folders.setup.beliefs.tables = folders.path / "tables";
  folders.write("job/parts/M1.A", "\"own\";\n");
  folders.write("tables/M2.A", "\"tables\";\n");
  folders.write("other/M3.A", "\"secret\";\n");
  const RunOutcome outcome = folders.run("1 FN 16: F-PRINT TNC:\\PARTS\\m1.a / L.TXT\n2 FN 16: F-PRINT M2.A / L.TXT\n");
  EXPECT_EQ(outcome.info.exitText, "");
  EXPECT_EQ(outcome.files.at("L.TXT"), "own\ntables\n");
  for (const std::string& name : {(folders.path / "other/M3.A").string(), std::string("../other/M3.A"),
                                  std::string("parts/../../other/M3.A"), std::string("/proc/self/environ")}) {
    const RunOutcome refused = folders.run("1 FN 16: F-PRINT " + name + " / SCREEN:\n");
    EXPECT_EQ(refused.info.exit, ExitState::Stopped) << name;
    EXPECT_THAT(refused.info.exitText, HasSubstr("in the folder of the program or among the tables")) << name;
    EXPECT_THAT(folders.why("1 FN 26: TABOPEN " + name + "\n"), HasSubstr("Table missing")) << name;
    EXPECT_THAT(folders.why("1 SEL TABLE \"" + name + "\"\n"), HasSubstr("does not exist")) << name;
  }
}

TEST(ProgramFiles, CalledProgramsLieInTheFolderOfTheFirstOneOrBelow) {
  const Folders folders;
  folders.write("other/O.H", "0 BEGIN PGM O MM\n1 QR1 = 66\n2 END PGM O MM\n");
  folders.write("job/TOP.H", "0 BEGIN PGM TOP MM\n1 QR1 = 5\n2 END PGM TOP MM\n");
  folders.write("job/parts/SUB.H", "0 BEGIN PGM SUB MM\n1 CALL PGM ..\\TOP.H\n2 END PGM SUB MM\n");
  EXPECT_EQ(folders.why("1 CALL PGM PARTS\\SUB.H\n"), "");
  EXPECT_THAT(folders.why("1 CALL PGM ..\\other\\O.H\n"), HasSubstr("there is no program ..\\other\\O.H"));
  std::string up;
  for (int i = 0; i < 2000; ++i)
    up += "../";
  const auto start = std::chrono::steady_clock::now();
  const std::string said = folders.why("1 CALL PGM " + up + "x\n");
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2));
  EXPECT_THAT(said, HasSubstr("there is no program ../../"));
  EXPECT_LT(said.size(), 200U);
}

TEST(ProgramFiles, Fn16DoesNotWriteOverTheProgramOrTheSetup) {
  const Folders folders;
  folders.write("job/M.A", "\"X\";\n");
  EXPECT_THAT(folders.why("1 FN 16: F-PRINT M.A / p.h\n"), HasSubstr("p.h is read by this run"));
  EXPECT_THAT(folders.why("1 FN 16: F-PRINT M.A / TNC:\\SETUP.TOML\n"), HasSubstr("SETUP.TOML is read by this run"));
}

TEST(ProgramFiles, RemanentParametersGoOnInTheNextRun) {
  Folders folders;
  const RunOutcome first = folders.run("1 QR5 = 1 / 3\n2 QR7 = -2\n");
  ASSERT_EQ(first.info.exitText, "");
  folders.write("tables/QR.TXT", first.files.at("QR.TXT"));
  folders.setup.beliefs.tables = folders.path / "tables";
  const RunOutcome second = folders.run("1 QR8 = QR5 * 3 + QR7\n2 FN 0: QR7 SET UNDEFINED\n");
  ASSERT_EQ(second.info.exitText, "");
  EXPECT_EQ(second.files.at("QR.TXT"), "QR5 = 0.3333333333333333\nQR8 = -1\n");
  // A run that has none leaves none.
  folders.setup.beliefs.tables.clear();
  EXPECT_FALSE(folders.run("1 Q1 = QR5\n").files.contains("QR.TXT"));
  folders.write("tables/QR.TXT", "QR5 = 1\nQR900 = 2\n");
  folders.setup.beliefs.tables = folders.path / "tables";
  const RunOutcome wrong = folders.run("1 Q1 = 1\n");
  EXPECT_EQ(wrong.info.exit, ExitState::InputMistake);
  EXPECT_THAT(wrong.info.exitText, HasSubstr("this is not a QR parameter with its value"));
}

TEST(ProgramFiles, AProgramInInchesSaysSo) {
  const Folders folders;
  const fs::path program = folders.write("job/I.H", "0 BEGIN PGM I INCH\n1 Q1 = 1\n2 END PGM I INCH\n");
  EXPECT_TRUE(runProgram(program, folders.setup, {}).outcome.info.inches);
  EXPECT_FALSE(folders.run("1 Q1 = 1\n").info.inches);
}

}  // namespace
}  // namespace probewright::setup
