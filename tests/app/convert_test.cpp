#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/program.hpp"

namespace probewright::app::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

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

TEST(Convert, PlacesWhatIsLostInTheProgramThatWasRead) {
  const Folder folder;
  const Answer answer = probewright({"convert", "examples/programs/corner.i", (folder / "corner.mpf").string()});
  EXPECT_EQ(answer.exit, 1);
  EXPECT_THAT(answer.errors, HasSubstr("examples/programs/corner.i:10:1: warning: Q381: "));
  EXPECT_THAT(answer.errors, HasSubstr("\n    N90 G414\n"));
}

TEST(Convert, WritesForTheOtherVendor) {
  const Folder folder;
  const std::string klartext = folder.file(
      "part.h", "0 BEGIN PGM PART MM\n1 TOOL CALL 1 Z\n2 L Z+100 R0 FMAX\n3 L X+10 Y-5 R0 F500\n4 END PGM PART MM\n");
  const std::string sinumerik = (folder / "part.mpf").string();
  const Answer there = probewright({"convert", klartext, sinumerik});
  EXPECT_EQ(there.exit, 0) << there.errors;
  EXPECT_EQ(textOf(sinumerik), "; part\nG17 G90 G40 G710 G94\nG17\nT1\nM6 D1\nG0 Z100\nG1 X10 Y-5 F500\nM30\n");
  const Answer back = probewright({"convert", sinumerik, (folder / "again.h").string()});
  EXPECT_EQ(back.exit, 0) << back.errors;
  EXPECT_THAT(textOf(folder / "again.h"), HasSubstr("L X+10 Y-5 R0 F500\n"));
  EXPECT_EQ(probewright({"convert", sinumerik, (folder / "same.mpf").string()}).exit, 2);
}

TEST(Convert, KnowsTheGlobalDataOfTheSetup) {
  const Folder folder;
  const std::string program = folder.file(
      "part.mpf", "G17 G90 G710\nT1 M6 D1\nG54\nG0 Z=_SAFE[1]\nG0 X=_SAFE[0] Y=_SIDE\n_SIDE=_SIDE+1\nMSG(_WHO)\nM30\n");
  const std::string twin = (folder / "part.h").string();
  const Answer alone = probewright({"convert", program, twin});
  EXPECT_EQ(alone.exit, 1);
  EXPECT_THAT(alone.errors, HasSubstr("_SAFE[1] is not defined in this program"));
  EXPECT_THAT(alone.errors, HasSubstr("--setup"));

  std::filesystem::create_directory(folder / "tables");
  folder.file("tables/UGUD.DEF",
              "DEF NCK REAL _SAFE[2]=SET(10,20)\nDEF CHAN REAL _SIDE=4\nDEF NCK STRING[20] _WHO\nM17\n");
  folder.file("tables/VALUES.INI", "_SAFE[1]=150\n_WHO=\"TONI\"\nM17\n");
  const std::string setup = folder.file("setup.toml", "control = { type = \"840Dsl\", tables = \"tables\" }\n");
  const Answer answer = probewright({"convert", program, twin, "--setup", setup});
  EXPECT_EQ(answer.exit, 1);
  EXPECT_THAT(answer.errors, HasSubstr("part.mpf:6:1: warning: _SIDE is global user data"));
  EXPECT_THAT(answer.errors, Not(HasSubstr("_SAFE")));
  const std::string text = textOf(twin);
  EXPECT_THAT(text, HasSubstr("1 Q1600 = 150 ; _SAFE[1]\n2 Q1601 = 10 ; _SAFE[0]\n3 Q1602 = 4 ; _SIDE\n"));
  EXPECT_THAT(text, HasSubstr("QS1600 = \"TONI\" ; _WHO\n"));
  EXPECT_THAT(text, HasSubstr("L Z+Q1600 R0 FMAX\n"));

  // Definition files beside the program need no setup.
  folder.file("GUD4.DEF", "DEF NCK REAL _SAFE[2]\nDEF NCK REAL _SIDE\nDEF NCK STRING[9] _WHO\nM17\n");
  EXPECT_THAT(probewright({"convert", program, twin}).errors, Not(HasSubstr("_SAFE")));
  EXPECT_EQ(probewright({"convert", program, twin, "--setup", (folder / "none.toml").string()}).exit, 2);
}

TEST(Convert, SaysWhyAFileIsNoProgramOfItsLanguage) {
  const Folder folder;
  const std::string out = (folder / "out.mpf").string();
  EXPECT_THAT(probewright({"convert", folder.file("empty.h", "\n"), out}).errors, HasSubstr("the program is empty"));
  EXPECT_THAT(probewright({"convert", folder.file("noise.h", std::string("\x01\x02\x03\nL X+1\n")), out}).errors,
              HasSubstr("this is no text"));
  const Answer mixed = probewright({"convert", folder.file("sinumerik.h", "G17 G90\nT1 M6\nR1=5\nM30\n"), out});
  EXPECT_EQ(mixed.exit, 2);
  EXPECT_THAT(mixed.errors, HasSubstr("it was read as Klartext because of its ending, but looks like SINUMERIK"));
  EXPECT_FALSE(std::filesystem::exists(out));
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
