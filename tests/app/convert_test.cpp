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

TEST(Convert, WritesToolCyclesInTheFormThatIsAskedFor) {
  const Folder folder;
  const std::string program =
      folder.file("tool.h",
                  "0 BEGIN PGM TOOL MM\n1 TOOL CALL 12 Z\n2 TCH PROBE 31.0 TOOL LENGTH\n3 TCH PROBE 31.1 CHECK: +1 Q5\n"
                  "4 TCH PROBE 31.2 HEIGHT: +120\n5 TCH PROBE 31.3 PROBING THE TEETH: +0\n6 END PGM TOOL MM\n");
  const std::string now = (folder / "new.h").string(), old = (folder / "old.h").string();
  EXPECT_EQ(probewright({"convert", program, now, "--tool-cycles", "new"}).exit, 0);
  EXPECT_THAT(textOf(now), HasSubstr("2 TCH PROBE 481 TOOL LENGTH ~\n    Q340=+1 ~\n    Q260=+120 ~\n    Q341=+0\n"
                                     "3 Q5 = Q199\n"));
  EXPECT_EQ(probewright({"convert", now, old, "--tool-cycles", "old"}).exit, 0);
  EXPECT_THAT(textOf(old), HasSubstr("3 TCH PROBE 31.1 CHECK: +1 Q199\n"));
  const Answer refused = probewright({"convert", program, (folder / "a.mpf").string(), "--tool-cycles", "old"});
  EXPECT_EQ(refused.exit, 2);
  EXPECT_THAT(refused.errors, HasSubstr("leave --tool-cycles out"));
  EXPECT_EQ(probewright({"convert", program, old, "--tool-cycles", "other"}).exit, 2);
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
  EXPECT_EQ(alone.exit, 2);
  EXPECT_THAT(alone.errors, HasSubstr("_SAFE is not declared"));
  EXPECT_FALSE(std::filesystem::exists(twin));

  std::filesystem::create_directory(folder / "tables");
  folder.file("tables/UGUD.DEF",
              "DEF NCK REAL _SAFE[2]=SET(10,20)\nDEF CHAN REAL _SIDE=4\nDEF NCK STRING[20] _WHO\nM17\n");
  folder.file("tables/VALUES.INI", "_SAFE[1]=150\n_WHO=\"TONI\"\nM17\n");
  const std::string setup = folder.file("setup.toml", "control = { type = \"840Dsl\", tables = \"tables\" }\n");
  const Answer answer = probewright({"convert", program, twin, "--force", "--setup", setup});
  EXPECT_EQ(answer.exit, 1);
  EXPECT_THAT(answer.errors, HasSubstr("part.mpf:6:1: warning: _SIDE is global user data"));
  EXPECT_THAT(answer.errors, Not(HasSubstr("_SAFE")));
  const std::string text = textOf(twin);
  EXPECT_THAT(text, HasSubstr("1 Q1600 = 150 ; _SAFE[1]\n2 Q1601 = 10 ; _SAFE[0]\n3 Q1602 = 4 ; _SIDE\n"));
  EXPECT_THAT(text, HasSubstr("QS1600 = \"TONI\" ; _WHO\n"));
  EXPECT_THAT(text, HasSubstr("L Z+Q1600 R0 FMAX\n"));

  // Definition files beside the program need no setup.
  folder.file("GUD4.DEF", "DEF NCK REAL _SAFE[2]\nDEF NCK REAL _SIDE\nDEF NCK STRING[9] _WHO\nM17\n");
  EXPECT_THAT(probewright({"convert", program, twin, "--force"}).errors, Not(HasSubstr("_SAFE")));
  EXPECT_EQ(probewright({"convert", program, twin, "--setup", (folder / "none.toml").string()}).exit, 2);
}

TEST(Convert, SaysWhyAFileIsNoProgramOfItsLanguage) {
  const Folder folder;
  const std::string out = (folder / "out.mpf").string();
  EXPECT_THAT(probewright({"convert", folder.file("empty.h", "\n"), out}).errors, HasSubstr("the program is empty"));
  EXPECT_THAT(probewright({"convert", folder.file("noise.h", std::string("\x01\x02\x03\nL X+1\n")), out}).errors,
              HasSubstr("this is not a text file"));
  const Answer mixed = probewright({"convert", folder.file("sinumerik.h", "G17 G90\nT1 M6\nR1=5\nM30\n"), out});
  EXPECT_EQ(mixed.exit, 2);
  EXPECT_THAT(mixed.errors,
              HasSubstr("it was read as Klartext because of its file extension, but looks like SINUMERIK"));
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

TEST(Convert, FindsTheMistakesThatCheckFinds) {
  const Folder folder;
  const std::string out = (folder / "out.mpf").string();
  for (const int cycle : {400, 403, 408, 412, 414, 416, 420, 421, 427, 431, 461, 1410}) {
    const std::string program = folder.file("bare.h", "0 BEGIN PGM BARE MM\n1 TOOL CALL 1 Z\n2 TCH PROBE " +
                                                          std::to_string(cycle) + " X\n3 END PGM BARE MM\n");
    const Answer answer = probewright({"convert", program, out});
    EXPECT_EQ(answer.exit, 2) << cycle << answer.errors;
    EXPECT_THAT(answer.errors, HasSubstr("bare.h:3:"));
    EXPECT_FALSE(std::filesystem::exists(out)) << cycle;
    EXPECT_EQ(probewright({"convert", program, (folder / "out.i").string()}).exit, 2) << cycle;
  }
  const std::string text =
      folder.file("text.mpf", "T1 M6 D1\nCYCLE979(1,,,1,40,4,2,0,0,10,100,1,1,\"\",,0,,0,0,,,,,1,,1,1,1,1,1)\nM30\n");
  EXPECT_EQ(probewright({"convert", text, (folder / "out.h").string()}).exit, 2);
}

TEST(Convert, LeavesFilesAlone) {
  const Folder folder;
  const std::string text = "0 BEGIN PGM PART MM\n1 L Z+100 R0 FMAX\n2 END PGM PART MM\n";
  const std::string program = folder.file("part.h", text);
  std::filesystem::create_symlink("part.h", folder / "link.i");
  std::filesystem::create_hard_link(folder / "part.h", folder / "twin.mpf");
  for (const char* out : {"part.h", "link.i", "twin.mpf"}) {
    for (const bool force : {false, true}) {
      std::vector<std::string> words = {"convert", program, (folder / out).string()};
      if (force) words.emplace_back("--force");
      EXPECT_EQ(probewright(words).exit, 2) << out;
    }
  }
  // The same file by another way to it.
  std::filesystem::create_directory(folder / "sub");
  std::filesystem::create_directory_symlink(".", folder / "again");
  for (const char* way : {"./part.h", "sub/../part.h", "again/part.h", "sub/../again/./part.h", "made/../part.h"})
    EXPECT_EQ(probewright({"convert", program, (folder / way).string(), "--force"}).exit, 2) << way;
  EXPECT_EQ(probewright({"convert", (folder / "link.i").string(), program, "--force"}).exit, 2);
  EXPECT_EQ(probewright({"convert", program, (folder / "sub").string(), "--force"}).exit, 2);
  EXPECT_EQ(textOf(program), text);
  const std::string out = folder.file("old.mpf", "KEEP\n");
  const Answer refused = probewright({"convert", program, out});
  EXPECT_EQ(refused.exit, 2);
  EXPECT_THAT(refused.errors, HasSubstr("--force"));
  // A folder that is made only when OUT is written hides nothing.
  EXPECT_EQ(probewright({"convert", program, (folder / "made/../old.mpf").string()}).exit, 2);
  EXPECT_EQ(textOf(out), "KEEP\n");
  EXPECT_EQ(probewright({"convert", program, out, "--force"}).exit, 0);
  EXPECT_THAT(textOf(out), HasSubstr("G0 Z100"));
}

/// DIST of the touch probe table decides whether the touches reach as far as those of the original program.
TEST(Convert, TakesTheTouchProbeTableAsItIsTold) {
  const Folder folder;
  const std::string program =
      folder.file("part.mpf", "G17 G90 G54\nT1 M6 D1\nG0 Z20\nCYCLE978(0,,,1,0,8,9,3,2,1)\nM30\n");
  const auto convert = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"convert", program, (folder / "out.h").string(), "--force"};
    words.insert(words.end(), more.begin(), more.end());
    return probewright(words);
  };
  const Answer doubtful = convert({});
  EXPECT_EQ(doubtful.exit, 1);
  EXPECT_THAT(doubtful.errors, HasSubstr("part.mpf:4:1: warning: this cycle looks for the surface along 16 mm"));
  EXPECT_EQ(convert({"--dist", "15.9"}).exit, 1);
  EXPECT_EQ(convert({"--dist", "16"}).exit, 0);
  EXPECT_THAT(textOf(folder / "out.h"), HasSubstr("Q320=+6 "));
  EXPECT_EQ(convert({"--dist", "16", "--set-up", "3"}).exit, 0);
  EXPECT_THAT(textOf(folder / "out.h"), HasSubstr("Q320=+5 "));
  EXPECT_EQ(convert({"--dist", "0"}).exit, 2);
  EXPECT_EQ(convert({"--set-up", "wide"}).exit, 2);
}

/// Parameters that programs share are shared by the programs that are written.
TEST(Convert, KeepsParametersOfAJobShared) {
  const Folder folder;
  const std::string setup = "[machine]\nname = \"mill3\"\n";
  const std::string heidenhain = folder.file("h.toml", "control = { type = \"TNC640\" }\n" + setup);
  const std::string sinumerik = folder.file("s.toml", "control = { type = \"840Dsl\" }\n" + setup);
  const std::string main = folder.file(
      "first.h",
      "0 BEGIN PGM FIRST MM\n1 Q150 = 3\n2 Q1650 = 4\n3 QR7 = 1\n4 CALL PGM SECOND\n5 FN 10: IF +Q150 NE +8 GOTO LBL "
      "1\n"
      "6 FN 9: IF +QR7 EQU +2 GOTO LBL 2\n7 LBL 1\n8 FN 14: ERROR = 12\n9 LBL 2\n10 M30\n11 END PGM FIRST MM\n");
  const std::string sub = folder.file(
      "second.h", "0 BEGIN PGM SECOND MM\n1 Q150 = Q150 + 1 + Q1650\n2 QR7 = QR7 + 1\n3 END PGM SECOND MM\n");
  ASSERT_EQ(probewright({"run", main, "--setup", heidenhain, "--out", (folder / "o1").string()}).exit, 0);
  EXPECT_EQ(probewright({"convert", main, (folder / "FIRST.MPF").string()}).exit, 0);
  EXPECT_EQ(probewright({"convert", sub, (folder / "SECOND.SPF").string()}).exit, 0);
  const Answer there =
      probewright({"run", (folder / "FIRST.MPF").string(), "--setup", sinumerik, "--out", (folder / "o2").string()});
  EXPECT_EQ(there.exit, 0) << there.output << there.errors;
  // And back, in a folder of their own.
  std::filesystem::create_directory(folder / "back");
  EXPECT_EQ(probewright({"convert", (folder / "FIRST.MPF").string(), (folder / "back/FIRST.H").string()}).exit, 0);
  EXPECT_EQ(probewright({"convert", (folder / "SECOND.SPF").string(), (folder / "back/SECOND.H").string()}).exit, 0);
  const Answer back = probewright(
      {"run", (folder / "back/FIRST.H").string(), "--setup", heidenhain, "--out", (folder / "o3").string()});
  EXPECT_EQ(back.exit, 0) << back.output << back.errors;
}

}  // namespace
}  // namespace probewright::app::testing
