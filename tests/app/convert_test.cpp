#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/program.hpp"

namespace probewright::app::testing {
namespace {

using ::testing::HasSubstr;

TEST(Convert, WritesTheOtherLanguageOfTheControl) {
  const Folder folder;
  const std::string klartext =
      folder.file("part.h", "0 BEGIN PGM PART MM\n1 TOOL CALL 1 Z\n2 L Z+100 R0 FMAX\n3 END PGM PART MM\n");
  const std::string dinIso = (folder / "part.i").string();
  const Answer there = probewright({"convert", klartext, dinIso});
  EXPECT_EQ(there.exit, 0) << there.errors;
  EXPECT_EQ(textOf(dinIso), "%PART G71 *\nN10 T1 G17 *\nN20 G00 G40 G90 Z+100 *\nN99999999 %PART G71 *\n");
  const Answer back = probewright({"convert", dinIso, (folder / "again.h").string()});
  EXPECT_EQ(back.exit, 0) << back.errors;
  EXPECT_EQ(textOf(folder / "again.h"), textOf(klartext));
}

TEST(Convert, WritesForTheOtherVendor) {
  const Folder folder;
  const std::string klartext = folder.file(
      "part.h", "0 BEGIN PGM PART MM\n1 TOOL CALL 1 Z\n2 L Z+100 R0 FMAX\n3 L X+10 Y-5 R0 F500\n4 END PGM PART MM\n");
  const std::string sinumerik = (folder / "part.mpf").string();
  const Answer there = probewright({"convert", klartext, sinumerik});
  EXPECT_EQ(there.exit, 0) << there.errors;
  EXPECT_EQ(textOf(sinumerik), "; part\nG17 G90 G40 G710 G94\nT1\nM6 D1\nG17\nG0 Z100\nG1 X10 Y-5 F500\nM30\n");
  const Answer back = probewright({"convert", sinumerik, (folder / "again.h").string()});
  EXPECT_EQ(back.exit, 0) << back.errors;
  EXPECT_THAT(textOf(folder / "again.h"), HasSubstr("L X+10 Y-5 R0 F500\n"));
  EXPECT_EQ(probewright({"convert", sinumerik, (folder / "same.mpf").string()}).exit, 2);
}

TEST(Convert, SaysWhatItCouldNotCarryOver) {
  const Folder folder;
  const std::string klartext = folder.file("part.h", "0 BEGIN PGM PART MM\n1 DEP LT LEN20 FMAX\n2 END PGM PART MM\n");
  const Answer answer = probewright({"convert", klartext, (folder / "part.i").string()});
  EXPECT_EQ(answer.exit, 1);
  EXPECT_THAT(answer.errors, HasSubstr("part.h:2:1: warning: DEP has no twin in DIN/ISO"));
  EXPECT_THAT(textOf(folder / "part.i"), HasSubstr("NOT CARRIED OVER: 1 DEP LT LEN20 FMAX"));
}

TEST(Convert, WritesNothingIfTheProgramIsWrong) {
  const Folder folder;
  const std::string klartext = folder.file("part.h", "0 BEGIN PGM PART MM\n1 L X+\n2 END PGM PART MM\n");
  const Answer answer = probewright({"convert", klartext, (folder / "part.i").string()});
  EXPECT_EQ(answer.exit, 2);
  EXPECT_THAT(answer.errors, HasSubstr("part.h:2:"));
  EXPECT_FALSE(std::filesystem::exists(folder / "part.i"));
  EXPECT_EQ(probewright({"convert", klartext, (folder / "part.xyz").string()}).exit, 2);
  EXPECT_EQ(probewright({"convert", klartext, (folder / "part.mpf").string()}).exit, 2);
}

}  // namespace
}  // namespace probewright::app::testing
