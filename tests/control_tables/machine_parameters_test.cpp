#include "control/heidenhain/machine_parameters.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "base/file.hpp"

namespace probewright::control::heidenhain {
namespace {

TEST(MachineParameters, AreSetByNameInAnyCaseAndByNumber) {
  MachineParameters parameters;
  EXPECT_TRUE(setMachineParameter(parameters, ControlKind::TNC640, "MAXTOUCHFEED", 800));
  EXPECT_EQ(parameters.maxTouchFeed, 800);
  EXPECT_TRUE(setMachineParameter(parameters, ControlKind::TNC640, "204601", 1));
  EXPECT_TRUE(parameters.checkTiltingAxes);
  EXPECT_TRUE(setMachineParameter(parameters, ControlKind::iTNC530, "mp6170", 3));
  EXPECT_EQ(parameters.mp6170, 3);
}

TEST(MachineParameters, RefuseWhatTheControlDoesNotKnowOrTake) {
  MachineParameters parameters;
  EXPECT_EQ(setMachineParameter(parameters, ControlKind::TNC640, "MP6120", 100).error().message,
            "the TNC640 has no machine parameter MP6120 here");
  EXPECT_EQ(setMachineParameter(parameters, ControlKind::iTNC530, "MP6170", 4).error().message,
            "MP6170 cannot be 4; its range is 1 to 3");
  EXPECT_EQ(setMachineParameter(parameters, ControlKind::iTNC530, "MP6151", 0.5).error().message,
            "MP6151 takes a whole number, not 0.5");
}

// To renew the page after a change of the table, run this test with PROBEWRIGHT_UPDATE_DOCS set.
TEST(MachineParameters, ThePageIsTheTable) {
  const std::string page = std::string(PROBEWRIGHT_SOURCE_DIR) + "/docs/machine-parameters.md";
  if (std::getenv("PROBEWRIGHT_UPDATE_DOCS") != nullptr) {
    ASSERT_TRUE(writeFileAtomically(page, machineParametersPage()));
  }
  EXPECT_EQ(readFile(page).value_or(""), machineParametersPage());
}

}  // namespace
}  // namespace probewright::control::heidenhain
