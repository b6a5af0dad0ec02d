#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "app/program.hpp"

/// A program on the machine of a LinuxCNC configuration.
namespace probewright::app::testing {
namespace {

using ::testing::HasSubstr;

constexpr const char* shop = R"([EMC]
MACHINE = shop mill
[KINS]
KINEMATICS = trivkins coordinates=XYZ
[JOINT_0]
MIN_LIMIT = -100
MAX_LIMIT = 100
MAX_VELOCITY = 50
MAX_ACCELERATION = 500
[JOINT_1]
MIN_LIMIT = -100
MAX_LIMIT = 100
MAX_VELOCITY = 50
MAX_ACCELERATION = 500
[JOINT_2]
MIN_LIMIT = -300
MAX_LIMIT = 0
MAX_VELOCITY = 50
)";
constexpr const char* acceleration = "MAX_ACCELERATION = 500\n";

std::string moveTo(int x) { return "0 BEGIN PGM P MM\n1 L X+" + std::to_string(x) + " R0 FMAX M91\n2 END PGM P MM\n"; }

class MachineIni : public ::testing::Test {
protected:
  Answer run(const std::string& program, const std::string& setup, const std::vector<std::string>& more) const {
    std::vector<std::string> words = {"run",   folder.file("p.h", program), "--setup", folder.file("s.toml", setup),
                                      "--out", (folder / "out").string()};
    words.insert(words.end(), more.begin(), more.end());
    return probewright(words);
  }
  Folder folder;
};

TEST_F(MachineIni, HasTheTravelOfTheConfiguration) {
  const std::string ini = folder.file("shop.ini", std::string(shop) + acceleration);
  const std::string plain = "[control]\ntype = \"TNC640\"\n";
  EXPECT_EQ(run(moveTo(150), plain, {}).exit, 0) << "mill3 goes there";
  const Answer beyond = run(moveTo(150), plain, {"--machine-ini", ini});
  EXPECT_EQ(beyond.exit, 3);
  EXPECT_THAT(beyond.errors, HasSubstr("its travel ends at 100"));
  EXPECT_EQ(run(moveTo(90), plain, {"--machine-ini", ini}).exit, 0);
  // The setup can name it itself, from its own folder.
  const Answer named = run(moveTo(150), plain + "[machine]\nfile = \"shop.ini\"\n", {});
  EXPECT_EQ(named.exit, 3);
  EXPECT_THAT(named.errors, HasSubstr("its travel ends at 100"));
}

TEST_F(MachineIni, TellsWhatItHadToAssume) {
  const std::string ini = folder.file("shop.ini", shop);
  const Answer answer = run(moveTo(90), "[control]\ntype = \"TNC640\"\n", {"--machine-ini", ini});
  EXPECT_EQ(answer.exit, 0);
  EXPECT_THAT(answer.errors, HasSubstr("warning: axis Z has no MAX_ACCELERATION"));
}

TEST_F(MachineIni, IsRefusedInWords) {
  const std::string ini = folder.file("hexapod.ini", "[KINS]\nKINEMATICS = genhexkins\n");
  const Answer refused = run(moveTo(1), "[control]\ntype = \"TNC640\"\n", {"--machine-ini", ini});
  EXPECT_EQ(refused.exit, 2);
  EXPECT_THAT(refused.errors, HasSubstr("hexapod.ini:2: error: the kinematics genhexkins are those of a hexapod"));
  const Answer missing = run(moveTo(1), "[control]\ntype = \"TNC640\"\n", {"--machine-ini", "nowhere.ini"});
  EXPECT_EQ(missing.exit, 2);
  EXPECT_THAT(missing.errors, HasSubstr("nowhere.ini"));
}

}  // namespace
}  // namespace probewright::app::testing
