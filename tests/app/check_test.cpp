#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "app/program.hpp"

namespace probewright::app::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

TEST(Check, FindsNothingWrongWithTheExamples) {
  for (const std::string& name : namesIn(PROBEWRIGHT_SOURCE_DIR "/examples/programs")) {
    const Answer answer = probewright({"check", "examples/programs/" + name});
    EXPECT_EQ(answer.exit, 0) << name << "\n" << answer.errors;
    EXPECT_EQ(answer.output, "examples/programs/" + name + ": no mistakes found\n");
    EXPECT_EQ(answer.errors, "");
  }
}

TEST(Check, NamesEveryMistakeWithItsPlace) {
  const Folder folder;
  const std::string path = folder.file(
      "wrong.h",
      "0 BEGIN PGM WRONG MM\n1 L X+ZZ\n2 FN 9: IF +1 EQU +1 GOTO LBL 7\n3 TCH PROBE 499 NONE\n4 END PGM WRONG MM\n");
  const Answer answer = probewright({"check", path});
  EXPECT_EQ(answer.exit, 2);
  EXPECT_THAT(answer.errors, HasSubstr(path + ":2:7: error:"));
  EXPECT_THAT(answer.errors, HasSubstr(path + ":3:"));
  EXPECT_THAT(answer.errors, HasSubstr(path + ":4:"));
  EXPECT_THAT(answer.errors, HasSubstr("1 L X+ZZ"));
}

TEST(Check, RefusesAnEmptyProgram) {
  const Folder folder;
  for (const char* name : {"empty.h", "empty.i", "empty.mpf", "empty"}) {
    const std::string path = folder.file(name, " \r\n\n");
    const Answer answer = probewright({"check", path});
    EXPECT_EQ(answer.exit, 2) << name;
    EXPECT_EQ(answer.errors,
              path + ": error: the program is empty\n    check that the file was saved and copied whole\n");
  }
}

TEST(Check, FindsParametersThatTheCatalogueDoesNotAllow) {
  const Folder folder;
  const std::string path = folder.file(
      "cycle.h",
      "0 BEGIN PGM CYCLE MM\n1 TOOL CALL 1 Z\n2 TCH PROBE 417 TOP ~\nQ263=+0 ~\nQ264=+0 ~\nQ294=+0 ~\nQ320=-1 ~\n"
      "Q260=+50 ~\nQ305=+1 ~\nQ333=+0 ~\nQ303=+1\n3 END PGM CYCLE MM\n");
  const Answer answer = probewright({"check", path});
  EXPECT_EQ(answer.exit, 2);
  EXPECT_THAT(answer.errors, HasSubstr(path + ":7:1: error: Q320"));
  EXPECT_THAT(answer.errors, HasSubstr("0 to 99999.9999 mm"));
}

TEST(Check, ReadsAllProgramsEvenIfOneIsWrong) {
  const Folder folder;
  const std::string good = folder.file("good.h", "0 BEGIN PGM GOOD MM\n1 END PGM GOOD MM\n");
  const Answer answer = probewright({"check", (folder / "none.h").string(), good});
  EXPECT_EQ(answer.exit, 2);
  EXPECT_THAT(answer.errors, HasSubstr("none.h: error: cannot open"));
  EXPECT_THAT(answer.output, HasSubstr("good.h: no mistakes found"));
}

TEST(Check, NamesCalledProgramsThatAreNotBesideTheProgram) {
  const Folder folder;
  folder.file("THERE.H", "0 BEGIN PGM THERE MM\n1 END PGM THERE MM\n");
  folder.file("HERE.SPF", "RET\n");
  const std::string klartext = folder.file("main.h",
                                           "0 BEGIN PGM MAIN MM\n1 CALL PGM THERE\n2 CALL PGM TNC:\\NC\\GONE.H\n"
                                           "3 SEL PGM \"THERE.H\"\n4 SEL PGM \"GONE2\"\n5 QS1 = \"GONE3\"\n"
                                           "6 SEL PGM QS1\n7 CALL SELECTED PGM\n8 CYCL DEF 12.0 PGM CALL\n"
                                           "9 CYCL DEF 12.1 PGM GONE4\n10 END PGM MAIN MM\n");
  const std::string dinIso =
      folder.file("main.i", "%MAIN G71 *\nN10 %THERE*\nN20 %GONE*\nN30 %:PGM: \"GONE2\" *\nN99999999 %MAIN G71 *\n");
  const std::string sinumerik = folder.file("main.mpf",
                                            "DEF STRING[20] NAME_1=\"GONE\"\nHERE\nGONE_1(1,2)\nCALL NAME_1\n"
                                            "N50 CALL \"GONE_2\"\nPCALL /_N_SPF_DIR/_N_HERE_SPF\nM30\n");
  const Answer warned = probewright({"check", klartext, dinIso});
  EXPECT_EQ(warned.exit, 0);
  EXPECT_THAT(warned.errors, HasSubstr(klartext + ":3:12: warning: there is no program TNC:\\NC\\GONE.H"));
  EXPECT_THAT(warned.errors, HasSubstr(klartext + ":5:12: warning: there is no program GONE2"));
  EXPECT_THAT(warned.errors, HasSubstr(klartext + ":10:21: warning: there is no program GONE4"));
  EXPECT_THAT(warned.errors, HasSubstr(dinIso + ":3:6: warning: there is no program GONE"));
  EXPECT_THAT(warned.errors, HasSubstr(dinIso + ":4:13: warning: there is no program GONE2"));
  EXPECT_THAT(warned.errors, Not(HasSubstr("THERE")));
  EXPECT_THAT(warned.errors, Not(HasSubstr("GONE3")));
  const Answer refused = probewright({"check", sinumerik});
  EXPECT_EQ(refused.exit, 2);
  EXPECT_THAT(refused.errors, HasSubstr(sinumerik + ":3:1: error: there is no program and no cycle GONE_1"));
  EXPECT_THAT(refused.errors, HasSubstr(sinumerik + ":5:11: error: there is no program GONE_2"));
  EXPECT_THAT(refused.errors, Not(HasSubstr("HERE")));
}

TEST(Check, NamesProgramsThatOnlyTheControlReads) {
  const Folder folder;
  folder.file("SECRET.CPF", std::string("\x00\x01\x93\xfe\x7f secret", 12));
  const std::string path = folder.file("main.mpf", "G54\nN20 SECRET(1)\nM30\n");
  const Answer answer = probewright({"check", path});
  EXPECT_EQ(answer.exit, 2);
  EXPECT_THAT(answer.errors, HasSubstr(path + ":2:5: error: the program SECRET cannot be read"));
  EXPECT_THAT(answer.errors, HasSubstr("encrypted"));
}

TEST(Check, HoldsCallsOfOwnProgramsAgainstTheirHead) {
  const Folder folder;
  folder.file("CYCLE977.SPF", "PROC CYCLE977(INT VAR_1, VAR REAL RES_1)\nRES_1=VAR_1\nRET\n");
  const std::string path = folder.file("main.mpf", "DEF REAL OUT_1\nCYCLE977(1,OUT_1)\nCYCLE977(1,2,3)\nM30\n");
  const Answer answer = probewright({"check", path});
  EXPECT_EQ(answer.exit, 2);
  EXPECT_THAT(answer.errors, HasSubstr(path + ":3:14: error: CYCLE977 has 2 parameters, but the call has 3 arguments"));
  EXPECT_THAT(answer.errors, Not(HasSubstr(":2:")));
}

TEST(Check, FindsDivisionsByZero) {
  const Folder folder;
  const std::string klartext = folder.file(
      "a.h",
      "0 BEGIN PGM A MM\n1 Q1 = 10 / 0\n2 FN 4: Q2 = +5 DIV +0\n3 Q3 = 7 / (2 - 2)\n4 Q4 = 7 / Q9\n5 Q5 = 0 / 4\n"
      "6 FN 9: IF +1 / 0 EQU +1 GOTO LBL 1\n7 LBL 1\n8 END PGM A MM\n");
  const std::string sinumerik =
      folder.file("a.mpf", "R1=10/0\nR2=5 MOD 0\nR3=5 DIV (3*0)\nR4=1/R9\nIF R1/0>1 GOTOF LA1\nX=1/(-0)\nLA1: M30\n");
  const std::string dinIso = folder.file("a.i", "%A G71 *\nN10 D04 Q1 P01 +5 P02 +0 *\nN99999999 %A G71 *\n");
  const auto named = [](const std::string& path) {
    std::set<int> lines;
    std::istringstream errors(probewright({"check", path}).errors);
    for (std::string line; std::getline(errors, line);) {
      if (line.find("warning: this divides by 0") == std::string::npos) continue;
      lines.insert(std::stoi(line.substr(line.find(path) + path.size() + 1)));
    }
    return lines;
  };
  EXPECT_EQ(named(sinumerik), (std::set<int>{1, 2, 3, 5, 6}));
  EXPECT_EQ(named(dinIso), (std::set<int>{2}));
  const std::set<int> found = named(klartext);
  EXPECT_TRUE(found.contains(2) && found.contains(3) && found.contains(4)) << probewright({"check", klartext}).errors;
  EXPECT_FALSE(found.contains(5) || found.contains(6));
}

TEST(Check, ComparesTheFirstBlockWithTheLast) {
  const Folder folder;
  const auto said = [&](const std::string& name, const std::string& text) {
    const Answer answer = probewright({"check", folder.file(name, text)});
    EXPECT_EQ(answer.exit, 0) << answer.errors;
    return answer.errors;
  };
  EXPECT_THAT(said("a.h", "0 BEGIN PGM A MM\n1 END PGM B MM\n"),
              HasSubstr("a.h:2:3: warning: the program begins as A MM and ends as B MM"));
  EXPECT_THAT(said("a.h", "0 BEGIN PGM A MM\n1 END PGM A INCH\n"), HasSubstr("begins as A MM and ends as A INCH"));
  EXPECT_THAT(said("a.i", "%A G71 *\nN99999999 %B G71 *\n"), HasSubstr("begins as A G71 and ends as B G71"));
  EXPECT_EQ(said("a.h", "0  BEGIN  PGM a MM ; one\n1 END PGM A  mm\n"), "");
  EXPECT_EQ(said("a.i", "%A G71*\nN99999999 %A G71 *\n"), "");
  EXPECT_EQ(said("a.h", "0 BEGIN PGM END 1 MM\n1 END PGM END 1 MM\n"), "");
}

TEST(Check, KnowsAxesAndCorrectedToolsOfASetup) {
  const Folder folder;
  const std::string tool = "[[tool]]\nnumber = 1\nname = \"PROBE\"\nkind = \"probe\"\nlength = 100\nball_radius = 3\n";
  const std::string tnc = folder.file("tnc.toml", "[control]\ntype = \"TNC640\"\n" + tool);
  const std::string siemens = folder.file("840.toml", "[control]\ntype = \"840Dsl\"\n" + tool);
  const auto check = [&](const std::string& name, const std::string& text, const std::string& setup) {
    return probewright({"check", "--setup", setup, folder.file(name, text)}).errors;
  };
  EXPECT_THAT(check("a.h", "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z\n2 L X+1 C+10 R0 FMAX\n3 END PGM A MM\n", tnc),
              HasSubstr("a.h:3:9: error: the machine of the setup has no axis C\n"));
  EXPECT_EQ(check("a.h", "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z\n2 L X+1 R0 FMAX\n3 END PGM A MM\n", tnc), "");
  EXPECT_THAT(check("a.mpf", "G0 X1 C10\nM30\n", siemens),
              HasSubstr("a.mpf:1:7: error: the machine of the setup has no axis C\n"));
  const std::string call = "CYCLE977({},0,{},1,40,,,5,3,0,,,,1,1,\"{}\",,,,,,,,,1,)\nM30\n";
  const auto corrects = [&](int variant, int edge, const std::string& name) {
    return check("a.mpf", fmt::format(fmt::runtime(call), variant, edge, name), siemens);
  };
  EXPECT_THAT(corrects(201, 1, "NOTOOL"), HasSubstr("error: the setup has no tool NOTOOL\n"));
  EXPECT_EQ(corrects(201, 1, "PROBE"), "");
  EXPECT_EQ(corrects(201, 1, "1"), "");
  EXPECT_THAT(corrects(101, 1, "NOTOOL"), Not(HasSubstr("no tool NOTOOL")));
}

/// What a run on the machine of the setup would refuse: changes of axes that it lacks, planes that it cannot take.
TEST(Check, KnowsWhatNeedsOtherAxesThanTheSetupHas) {
  const Folder folder;
  const std::string tool = "[[tool]]\nnumber = 1\nname = \"PROBE\"\nkind = \"probe\"\nlength = 100\nball_radius = 3\n";
  const std::string machine = "[machine]\nname = \"mill5-table-table\"\n";
  const std::string tnc = "[control]\ntype = \"TNC640\"\n" + tool, siemens = "[control]\ntype = \"840Dsl\"\n" + tool;
  const auto check = [&](const std::string& name, const std::string& text, const std::string& setup) {
    return probewright({"check", "--setup", folder.file("s.toml", setup), folder.file(name, text)}).errors;
  };
  const auto klartext = [](const std::string& block) {
    return fmt::format("BEGIN PGM A MM\nTOOL CALL 1 Z\n{}\nEND PGM A MM\n", block);
  };
  for (const auto& [block, place, said] : std::vector<std::array<std::string, 3>>{
           {"TRANS DATUM AXIS A+5", "3:18", "the machine of the setup has no axis A"},
           {"CYCL DEF 8.0 MIRRORING\nCYCL DEF 8.1 X A", "3:16", "the machine of the setup has no axis A"},
           {"TRANS MIRROR AXIS A", "3:19", "the machine of the setup has no axis A"},
           {"CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 C+5", "3:14", "the machine of the setup has no axis C"},
           {"PLANE AXIAL B+10 STAY", "3:13", "the machine of the setup has no axis B"},
           {"PRESET CORR A+5", "3:13", "the machine of the setup has no axis A"},
           {"M94 A", "3:5", "the machine of the setup has no axis A"},
           {"PLANE SPATIAL SPA+0 SPB+10 SPC+0 STAY", "3:1", "a tilted plane needs rotary axes"},
           {"PLANE RELATIV SPA+10 STAY", "3:1", "a tilted plane needs rotary axes"},
           {"PLANE VECTOR BX+1 BY+0 BZ+0 NX+0 NY+0.1 NZ+1 STAY", "3:1", "a tilted plane needs rotary axes"},
           {"CYCL DEF 19.0 WORKING PLANE\nCYCL DEF 19.1 A+10 B+0 C+0", "3:1", "a tilted plane needs rotary axes"},
           {"M128", "3:1", "M128 needs rotary axes"},
           {"FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS", "3:1", "FUNCTION TCPM needs rotary axes"}}) {
    EXPECT_THAT(check("a.h", klartext(block), tnc), HasSubstr(fmt::format("a.h:{}: error: {}", place, said))) << block;
    EXPECT_EQ(check("a.h", klartext(block), tnc + (block == "PLANE AXIAL B+10 STAY" ? "" : machine)) == "",
              block != "PLANE AXIAL B+10 STAY")
        << block;
  }
  EXPECT_THAT(check("a.h", klartext("SEL TABLE \"NONE.D\""), tnc),
              HasSubstr("a.h:3:12: error: the datum table NONE.D does not exist"));
  EXPECT_THAT(check("a.h", klartext("SEL PATTERN \"NONE.PNT\""), tnc),
              HasSubstr("a.h:3:14: error: the point table NONE.PNT does not exist"));
  folder.file("ZERO.D", "BEGIN ZERO.D MM\nNR X Y Z\n0 1 2 3\n[END]\n");
  EXPECT_EQ(check("a.h", klartext("SEL TABLE \"TNC:\\table\\zero.d\""), tnc), "");
  for (const char* block :
       {"TRANS DATUM AXIS X+5 A+0", "PLANE SPATIAL SPA+0 SPB+0 SPC+10 STAY", "PLANE SPATIAL SPA+Q1 SPB+0 SPC+0 STAY",
        "PLANE VECTOR BX+1 BY+0 BZ+0.1 NX+0 NY+0 NZ+1 STAY", "PLANE RESET STAY",
        "CYCL DEF 19.0 WORKING PLANE\nCYCL DEF 19.1 A+0 B+0 C+0", "M129"})
    EXPECT_EQ(check("a.h", klartext(block), tnc), "") << block;
  EXPECT_THAT(check("a.mpf", "TRANS U5\nM30\n", siemens),
              HasSubstr("a.mpf:1:7: error: the machine of the setup has no axis U"));
  for (const auto& [block, place, axis] : std::vector<std::array<std::string, 3>>{{"POS[U]=5", "1:1", "U"},
                                                                                  {"G0 X1=5", "1:4", "X1"},
                                                                                  {"G1 X5 E4 F100", "1:7", "E"},
                                                                                  {"POSA[C1]=5", "1:1", "C1"}}) {
    EXPECT_THAT(check("a.mpf", block + "\nM30\n", siemens),
                HasSubstr("a.mpf:" + place + ": error: the machine of the setup has no axis " + axis));
  }
  EXPECT_THAT(check("a.mpf", "MIRROR A0\nM30\n", siemens), HasSubstr("error: the machine of the setup has no axis A"));
  EXPECT_EQ(check("a.mpf", "TRANS X5 A0\nSCALE X2\nM30\n", siemens), "");
  const auto swivel = [](const char* name, int angle) {
    return fmt::format("CYCLE800(1,\"{}\",0,57,0,0,0,{},0,0,0,0,0,-1)\nM30\n", name, angle);
  };
  EXPECT_THAT(check("a.mpf", swivel("", 10), siemens), HasSubstr("a.mpf:1:1: error: CYCLE800 needs rotary axes"));
  EXPECT_EQ(check("a.mpf", swivel("", 0), siemens), "");
  EXPECT_EQ(check("a.mpf", swivel("", 10), siemens + machine), "");
  std::filesystem::create_directory(folder / "tables");
  folder.file("tables/SWIVEL.INI", "$TC_CARR23[1]=\"T\"\n$TC_CARR34[1]=\"TABLE\"\n$TC_CARR34[2]=\"HEAD\"\nM17\n");
  const std::string named = "[control]\ntype = \"840Dsl\"\ntables = \"tables\"\n" + tool + machine;
  EXPECT_THAT(check("a.mpf", swivel("HEAD", 10), named),
              HasSubstr("a.mpf:1:13: warning: the setup has no swivel data set \"HEAD\""));
  EXPECT_EQ(check("a.mpf", swivel("table", 10), named), "");
  EXPECT_EQ(check("a.mpf", swivel("0", 10), named), "");
}

TEST(Check, KnowsToolsAndPresetsOfASetup) {
  const Folder folder;
  const std::string tool = "[[tool]]\nnumber = 1\nname = \"PROBE\"\nkind = \"probe\"\nlength = 100\nball_radius = 3\n";
  const std::string tnc = folder.file("tnc.toml", "[control]\ntype = \"TNC640\"\n" + tool + "[[preset]]\nrow = 3\n");
  const std::string siemens = folder.file("840.toml", "[control]\ntype = \"840Dsl\"\n" + tool);
  const auto check = [&](const std::string& name, const std::string& text, const std::string& setup) {
    return probewright({"check", "--setup", setup, folder.file(name, text)});
  };
  const Answer klartext = check("a.h",
                                "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z\n2 TOOL CALL 9 Z\n3 TOOL CALL \"PROBE\" Z\n"
                                "4 TOOL CALL \"NOTHERE\" Z\n5 TOOL CALL 0 Z\n6 TOOL CALL Q5 Z\n"
                                "7 CYCL DEF 247 PRESETTING ~\nQ339=+3\n8 CYCL DEF 247 PRESETTING ~\nQ339=+1\n"
                                "9 PRESET SELECT #7\n10 TCH PROBE 441 FAST PROBING ~\nQ396=+0 ~\nQ397=+0 ~\nQ399=+1 ~\n"
                                "Q400=+0\n11 TCH PROBE 427 MEASURE COORDINATE ~\nQ263=+0 ~\nQ264=+0 ~\nQ261=+0 ~\n"
                                "Q320=+0 ~\nQ272=+1 ~\nQ267=+1 ~\nQ260=+50 ~\nQ281=+0 ~\nQ288=+1 ~\nQ289=-1 ~\n"
                                "Q309=+0 ~\nQ330= \"FARAWAY\"\n12 TOOL DEF \"NEXT\"\n13 TOOL DEF 8\n14 END PGM A MM\n",
                                tnc);
  EXPECT_EQ(klartext.exit, 2);
  EXPECT_THAT(klartext.errors, HasSubstr("a.h:3:1: error: the setup has no tool 9\n"));
  EXPECT_THAT(klartext.errors, HasSubstr("a.h:5:14: error: the setup has no tool NOTHERE\n"));
  EXPECT_THAT(klartext.errors, HasSubstr("the setup has 1 PROBE"));
  EXPECT_THAT(klartext.errors, HasSubstr("a.h:10:1: error: the setup has no preset 1\n"));
  EXPECT_THAT(klartext.errors, HasSubstr("a.h:12:1: error: the setup has no preset 7\n"));
  EXPECT_THAT(klartext.errors, HasSubstr("a.h:30:8: error: the setup has no tool FARAWAY\n    Q330= \"FARAWAY\"\n"))
      << "at its place in a call of many lines";
  EXPECT_THAT(klartext.errors, HasSubstr("a.h:31:14: error: the setup has no tool NEXT\n"));
  EXPECT_THAT(klartext.errors, Not(HasSubstr("no tool 1\n")));
  EXPECT_THAT(klartext.errors, Not(HasSubstr("no tool 0\n")));
  EXPECT_THAT(klartext.errors, Not(HasSubstr("no preset 3\n")));
  // A preset may be called by what the table says of it.
  std::filesystem::create_directory(folder / "tables");
  folder.file("tables/PRESET.PR", "BEGIN PRESET.PR MM\nNO  DOC   X   Y   Z\n3   VISE  +0  +0  +0\n[END]\n");
  const std::string named = folder.file("named.toml", "[control]\ntype = \"TNC640\"\ntables = \"tables\"\n" + tool);
  const auto select = [&](const std::string& name) {
    return check("b.h", "0 BEGIN PGM B MM\n1 PRESET SELECT \"" + name + "\"\n2 END PGM B MM\n", named).errors;
  };
  EXPECT_THAT(select("VISE"), Not(HasSubstr("preset")));
  EXPECT_THAT(select("VICE"), HasSubstr("b.h:2:18: error: the setup has no preset VICE\n"));
  const std::string calls = "T1 D1\nM6\nT=\"PROBE\"\nM6\nT8\nM6\nT=\"NOTHERE\"\nM6\nT0\nM6\nT=R1\nM6\nM30\n";
  const Answer sinumerik = check("a.mpf", calls, siemens);
  EXPECT_EQ(sinumerik.exit, 2);
  EXPECT_THAT(sinumerik.errors, HasSubstr("a.mpf:5:1: error: the setup has no tool 8\n"));
  EXPECT_THAT(sinumerik.errors, HasSubstr("a.mpf:7:4: error: the setup has no tool NOTHERE\n"));
  EXPECT_THAT(sinumerik.errors, Not(HasSubstr("no tool 1\n")));
  // A program that makes its tools.
  EXPECT_EQ(check("b.mpf", "$TC_DP1[8,1]=120\n" + calls, siemens).exit, 0);
  // The setup's own mistakes, and a setup of the other vendor.
  EXPECT_THAT(check("a.mpf", calls, folder.file("wrong.toml", "seed = -1\n")).errors,
              HasSubstr("wrong.toml:1:8: error:"));
  EXPECT_THAT(check("a.mpf", calls, tnc).errors, HasSubstr("the setup's control is TNC640"));
  EXPECT_EQ(probewright({"check", folder.file("c.h", "0 BEGIN PGM C MM\n1 TOOL CALL 9 Z\n2 END PGM C MM\n")}).exit, 0);
}

TEST(Check, StartsInLessThanEightyMilliseconds) {
  if (!PROBEWRIGHT_OPTIMIZED) GTEST_SKIP() << "only the release build is measured";
  // Processor time, and the best of some: other programs on the machine are not what is measured. Nearly all of it goes
  // into loading the libraries.
  double best = 1;
  for (int i = 0; i < 40 && best >= 0.08; ++i)
    best = std::min(best, probewright({"check", "examples/programs/housing.h"}).cpuSeconds);
  EXPECT_LT(best, 0.08);
}

TEST(Cycles, AreListedAndExplained) {
  const Answer all = probewright({"cycles"});
  EXPECT_EQ(all.exit, 0);
  EXPECT_THAT(all.output, HasSubstr("412"));
  EXPECT_THAT(all.output, HasSubstr("CYCLE977"));
  const Answer old = probewright({"cycles", "--control", "iTNC530"});
  EXPECT_THAT(old.output, HasSubstr("412"));
  EXPECT_THAT(old.output, Not(HasSubstr("CYCLE977")));
  const Answer one = probewright({"cycles", "cycle977"});
  EXPECT_EQ(one.exit, 0);
  EXPECT_THAT(one.output, HasSubstr("S_MVAR"));
  EXPECT_THAT(one.output, HasSubstr("_OVR[4]"));
  const auto everything = nlohmann::json::parse(probewright({"cycles", "--json"}).output);
  std::size_t lines = 0;
  for (const char c : all.output)
    lines += c == '\n' ? 1 : 0;
  EXPECT_EQ(everything.size(), lines);
  const auto bore = nlohmann::json::parse(probewright({"cycles", "412", "--json"}).output);
  ASSERT_EQ(bore.size(), 1U);
  EXPECT_EQ(bore[0]["controls"], (nlohmann::json{"TNC640", "iTNC530"}));
  EXPECT_EQ(bore[0]["parameters"][0]["name"], "Q321");
  const Answer none = probewright({"cycles", "4711"});
  EXPECT_EQ(none.exit, 2);
  EXPECT_EQ(none.errors,
            "probewright: there is no cycle 4711, and none has it in its title, summary or parameters; `probewright "
            "cycles` lists them all\n");
  EXPECT_THAT(probewright({"cycles", "TCH421"}).output, StartsWith("421  "));
  EXPECT_THAT(probewright({"cycles", "q"}).errors, HasSubstr("lists them all"));
}

TEST(Cycles, AreFoundByWords) {
  const auto rows = [](const std::vector<std::string>& words) {
    std::vector<std::string> command = {"cycles"};
    command.insert(command.end(), words.begin(), words.end());
    const Answer answer = probewright(command);
    EXPECT_EQ(answer.exit, 0) << answer.errors;
    return "\n" + answer.output;
  };
  EXPECT_THAT(rows({"Hole"}), HasSubstr("\n421 "));
  EXPECT_THAT(rows({"Hole"}), HasSubstr("\nCYCLE977 "));
  EXPECT_THAT(rows({"Hole"}), Not(HasSubstr("\n420 ")));
  // Words of shops and of other languages, with and without their accents and capitals.
  for (const char* bore :
       {"bore",      "BOHRUNG",   "Bohrungen", "отверстие", "Отверстия", "hål",     "HAL",      "odwiert",
        "otwór",     "孔",        "otvor",     "ÖFFNUNG",   "Öffnung",   "Offnung", "Oeffnung", "Löcher",
        "ОТВЕРСТИЕ", "отверстий", "HÅL",       "HÅLET",     "OTWÓR",     "otworu",  "OTVOR"}) {
    SCOPED_TRACE(bore);
    EXPECT_THAT(rows({bore}), HasSubstr("\n421 "));
    EXPECT_THAT(rows({bore}), HasSubstr("\n412 "));
    EXPECT_THAT(rows({bore}), HasSubstr("\nCYCLE977 "));
    EXPECT_THAT(rows({bore}), Not(HasSubstr("\n417 ")));
  }
  EXPECT_THAT(rows({"boss"}), HasSubstr("\n413 "));
  for (const char* corner : {"ECKE", "Ecken", "УГОЛ", "углы", "HÖRN", "Horn", "NAROŻE", "naroze", "角"})
    EXPECT_THAT(rows({corner}), HasSubstr("\n414 ")) << corner;
  EXPECT_THAT(rows({"pocket"}), HasSubstr("\n423 "));
  // All words count: the ring only, not the stud and not the sphere.
  EXPECT_THAT(rows({"kalibrieren", "Ring"}), HasSubstr("\n462 "));
  EXPECT_THAT(rows({"kalibrieren", "Ring"}), Not(HasSubstr("\n481 ")));
  // By what only a parameter says.
  EXPECT_THAT(rows({"Q423"}), HasSubstr("\n412 "));
  EXPECT_EQ(nlohmann::json::parse(probewright({"cycles", "Lochkreis", "--json"}).output).at(0)["name"], "416");
  EXPECT_EQ(probewright({"cycles", "Weihnachten"}).exit, 2);
}

TEST(Cycles, TellOtherProgramsWhatTheTextTells) {
  const auto cycle = nlohmann::json::parse(probewright({"cycles", "CYCLE977", "--json"}).output).at(0);
  const auto parameter = [&cycle](const char* name) {
    for (const auto& each : cycle["parameters"])
      if (each["name"] == name) return each;
    return nlohmann::json();
  };
  const auto variant = parameter("S_MVAR")["digits"];
  ASSERT_EQ(variant.size(), 4U);
  EXPECT_EQ(variant[0]["place"], 1);
  EXPECT_EQ(variant[0]["choices"].size(), 6U);
  EXPECT_EQ(variant[0]["choices"][2], (nlohmann::json{{"value", 3}, {"meaning", "groove"}}));
  EXPECT_FALSE(parameter("S_MVAR").contains("maximum"));
  EXPECT_EQ(parameter("S_KNUM")["digits"][0]["width"], 2);
  EXPECT_EQ(parameter("S_PRNUM")["minimum"], 0);
  EXPECT_EQ(parameter("S_PRNUM")["maximum"], 12);
  EXPECT_EQ(parameter("S_NMSP")["maximum"], 9);
  EXPECT_EQ(parameter("S_TNAME")["text"], true);
  EXPECT_EQ(parameter("S_FA")["text"], false);
  EXPECT_EQ(cycle["results"][0]["variants"], nlohmann::json({1}));
  const auto rotation = nlohmann::json::parse(probewright({"cycles", "1410", "--json"}).output).at(0);
  bool predefined = false, text = false;
  for (const auto& each : rotation["parameters"]) {
    predefined = predefined || each.contains("predef");
    text = text || (each["name"] == "Q1100" && each["text"] == true);
  }
  EXPECT_TRUE(predefined);
  EXPECT_TRUE(text);
}

TEST(Cycles, KnowTheCircleThroughPoints) {
  const Answer answer = probewright({"cycles", "CYCLE116"});
  EXPECT_EQ(answer.exit, 0);
  EXPECT_THAT(answer.output, HasSubstr("_CAL[11] radius"));
  EXPECT_THAT(probewright({"cycles", "--control", "840Dsl"}).output, HasSubstr("CYCLE116"));
  EXPECT_EQ(probewright({"cycles", "--control", "TNC640"}).output.find("CYCLE116"), std::string::npos);
}

TEST(Cycles, AreFoundHoweverTheyAreWritten) {
  for (const char* name : {"CYCLE977", "CYCLE 977", "cycle977", "977"})
    EXPECT_THAT(probewright({"cycles", name}).output, ::testing::StartsWith("CYCLE977  ")) << name;
  EXPECT_THAT(probewright({"cycles", "TCH PROBE 421"}).output, ::testing::StartsWith("421  "));
  EXPECT_EQ(probewright({"cycles", "CYCLE 9"}).exit, 2);
  EXPECT_THAT(probewright({"cycles", "0"}).output, HasSubstr("  0.0 direction probing direction\n"));
}

TEST(Program, TellsItsVersion) {
  const Answer answer = probewright({"--version"});
  EXPECT_EQ(answer.exit, 0);
  EXPECT_EQ(answer.output, PROBEWRIGHT_PROGRAM_VERSION "\n");
}

}  // namespace
}  // namespace probewright::app::testing
