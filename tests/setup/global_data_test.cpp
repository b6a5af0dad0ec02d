#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "session/check.hpp"
#include "setup/simulated_run.hpp"
#include "support/virtual_world.hpp"

/// Definition files and values of global user data, as they lie beside programs and in folders of tables.
namespace probewright::setup {
namespace {

using namespace session;

namespace fs = std::filesystem;

/// A folder that is gone behind the test.
struct Folder {
  Folder() : path(fs::temp_directory_path() / ("global_data_" + std::to_string(::getpid()))) {
    fs::remove_all(path);
    fs::create_directories(path / "tables");
  }
  ~Folder() { fs::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path / name) << text;
    return path / name;
  }
  fs::path path;
};

setup::Setup emptyMachine() {
  setup::Setup setup;
  setup.beliefs.control = control::ControlKind::Sinumerik840Dsl;
  setup.world.truth = testing_support::perfectWorld();
  return setup;
}

TEST(GlobalDataFiles, AreReadBesideTheProgramAndInTheTables) {
  const Folder folder;
  folder.write("UGUD.DEF", "DEF NCK INT _COUNT=5\nM17\n");
  folder.write("_N_GUD4_DEF", "%_N_GUD4_DEF\nDEF CHAN REAL _LIST[3]\nM17\n");
  folder.write("tables/gud5.def", "DEF NCK STRING[8] _WORD=\"ab\"\nM17\n");
  folder.write("tables/UGUD.DEF", "DEF NCK INT _COUNT=7\nM17\n");
  const fs::path program =
      folder.write("P.MPF", "_LIST[_COUNT-6]=2.5\n_COUNT=_COUNT+1\n_WORD=_WORD<<\"c\"\nBESIDE\nM30\n");
  folder.write("BESIDE.SPF", "PROC BESIDE\n_LIST[2]=_LIST[1]*2\nM17\n");
  setup::Setup setup = emptyMachine();
  setup.beliefs.tables = folder.path / "tables";
  const RunOutcome first = runProgram(program, setup, {}).outcome;
  ASSERT_EQ(first.info.exit, records::ExitState::Good) << first.info.exitText;
  // Data without a file of their own get one; the definition goes along, so that the folder is whole.
  EXPECT_EQ(first.files.at("USER.GUD"), "_COUNT=8\n_LIST[1]=2.5\n_LIST[2]=5\n_WORD=\"abc\"\nM17\n");
  EXPECT_EQ(first.files.at("gud5.def"), "DEF NCK STRING[8] _WORD=\"ab\"\nM17\n");
  EXPECT_EQ(first.files.at("DATA.INI").find("_COUNT"), std::string::npos);

  // The next run goes on where this one ended; the value is changed where it stands.
  folder.write("tables/USER.GUD", first.files.at("USER.GUD"));
  const RunOutcome second = runProgram(program, setup, {}).outcome;
  ASSERT_EQ(second.info.exit, records::ExitState::Good) << second.info.exitText;
  EXPECT_EQ(second.files.at("USER.GUD"), "_COUNT=9\n_LIST[1]=2.5\n_LIST[2]=5\n_WORD=\"abcc\"\nM17\n");
}

TEST(GlobalDataFiles, EachFileKeepsItsOwnData) {
  const Folder folder;
  folder.write("UGUD.DEF", "DEF NCK INT _COUNT=5\nDEF NCK INT _OTHER\nM17\n");
  const fs::path program = folder.write("P.MPF", "_COUNT=6\n_OTHER=1\n$TC_DP3[9,1]=4\nM30\n");
  folder.write("tables/A.TOA", "$TC_DP1[9,1]=120\n$TC_DP3[9,1]=3\nM17\n");
  folder.write("tables/B.INI", "_COUNT=2 ; parts\nM17\n");
  setup::Setup setup = emptyMachine();
  setup.beliefs.tables = folder.path / "tables";
  const RunOutcome outcome = runProgram(program, setup, {}).outcome;
  ASSERT_EQ(outcome.info.exit, records::ExitState::Good) << outcome.info.exitText;
  EXPECT_EQ(outcome.files.at("B.INI"), "_COUNT=6 ; parts\nM17\n");
  EXPECT_EQ(outcome.files.at("A.TOA").substr(0, 36), "$TC_DP1[9,1]=120\n$TC_DP3[9,1]=4\nM17\n");
  EXPECT_EQ(outcome.files.at("USER.GUD"), "_OTHER=1\nM17\n");
}

TEST(GlobalDataFiles, AreKnownToCheck) {
  const Folder folder;
  const fs::path program = folder.write("P.MPF", "_COUNT=_COUNT+1\nM30\n");
  ASSERT_EQ(checkProgram(program, std::nullopt).size(), 1U);
  folder.write("MGUD.DEF", "DEF NCK INT _COUNT\nM17\n");
  EXPECT_TRUE(checkProgram(program, std::nullopt).empty());
  folder.write("MGUD.DEF", "DEF NCK INT _COUNT\nDEF NCK _SECOND\nM17\n");
  const Diagnostics found = checkProgram(program, std::nullopt);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].place.file, (folder.path / "MGUD.DEF").string());
  EXPECT_EQ(found[0].place.line, 2U);
  EXPECT_EQ(found[0].place.column, 9U);
  // Nothing runs with it either.
  const RunOutcome outcome = runProgram(program, emptyMachine(), {}).outcome;
  EXPECT_EQ(outcome.info.exit, records::ExitState::InputMistake);
}

TEST(GlobalDataFiles, MacrosAreKnownToEveryProgram) {
  const Folder folder;
  folder.write("tables/SMAC.DEF", "%_N_SMAC_DEF\nDEFINE TWICE AS *2\nDEFINE PROBE_ON AS R5=1\nM17\n");
  folder.write("_N_UMAC_DEF", "define Where as R2 ; a comment\nDEFINE PROBE_ON AS R5=3\nM17\n");
  folder.write("UGUD.DEF", "DEFINE ADD1 AS +1\nDEF NCK REAL _KEPT\nM17\n");
  const fs::path program =
      folder.write("P.MPF", "DEFINE ADD1 AS +10\nWHERE=4 TWICE\nPROBE_ON\nBESIDE\n_KEPT=R2 ADD1\nR3=R2\nM30\n");
  folder.write("BESIDE.SPF", "PROC BESIDE\nR6=5 ADD1\nM17\n");
  setup::Setup setup = emptyMachine();
  setup.beliefs.tables = folder.path / "tables";
  const RunOutcome outcome = runProgram(program, setup, {}).outcome;
  ASSERT_EQ(outcome.info.exit, records::ExitState::Good) << outcome.info.exitText;
  const std::string& data = outcome.files.at("DATA.INI");
  EXPECT_NE(data.find("R2=8\n"), std::string::npos) << data;
  EXPECT_NE(data.find("R5=3\n"), std::string::npos) << "UMAC goes before SMAC" << data;
  EXPECT_NE(data.find("R6=6\n"), std::string::npos) << "called programs know them too" << data;
  EXPECT_EQ(outcome.files.at("USER.GUD"), "_KEPT=18\nM17\n") << "the program's own macro goes first";

  // Beside the program check knows them; what is no DEFINE is a mistake of the file.
  const fs::path other = folder.write("Q.MPF", "WHERE=4\nPROBE_ON\nM30\n");
  for (const Diagnostic& each : checkProgram(other, std::nullopt))
    ADD_FAILURE() << format(each);
  folder.write("_N_UMAC_DEF", "DEFINE WHERE AS R2\nR1=1\nM17\n");
  const Diagnostics found = checkProgram(other, std::nullopt);
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].place.line, 2U);
}

TEST(GlobalDataFiles, ListsOfInitializationTextsGoOnInTheNextRow) {
  const Folder folder;
  folder.write("UGUD.DEF", "DEF NCK REAL _GRID[2,3]\nDEF NCK REAL _CUBE[2,2,2]\nM17\n");
  folder.write("tables/A.GUD", "_GRID[0,1]=SET(1,2,3,4,5) ; by rows\n_CUBE=SET(1,2,3,4,5,6,7,8)\nM17\n");
  const fs::path program = folder.write(
      "P.MPF", "R1=_GRID[0,0]\nR2=_GRID[0,2]\nR3=_GRID[1,0]\nR4=_GRID[1,2]\nR5=_CUBE[1,0,1]\n_GRID[1,1]=40\nM30\n");
  setup::Setup setup = emptyMachine();
  setup.beliefs.tables = folder.path / "tables";
  const RunOutcome outcome = runProgram(program, setup, {}).outcome;
  ASSERT_EQ(outcome.info.exit, records::ExitState::Good) << outcome.info.exitText;
  const std::string& data = outcome.files.at("DATA.INI");
  for (const char* value : {"R2=2\n", "R3=3\n", "R4=5\n", "R5=6\n"})
    EXPECT_NE(data.find(value), std::string::npos) << value << data;
  EXPECT_EQ(outcome.files.at("A.GUD"), "_GRID[0,1]=SET(1,2,3,40,5) ; by rows\n_CUBE=SET(1,2,3,4,5,6,7,8)\nM17\n");
  // More values than the array has elements.
  folder.write("tables/A.GUD", "_GRID[1,1]=SET(1,2,3)\nM17\n");
  EXPECT_EQ(runProgram(program, setup, {}).outcome.info.exit, records::ExitState::InputMistake);
}

}  // namespace
}  // namespace probewright::setup
