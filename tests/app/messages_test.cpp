#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <vector>

#include "app/program.hpp"

/// Messages about programs and setups, as people read them.
namespace probewright::app::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(Messages, TellWhatThereIsInstead) {
  const Folder folder;
  const std::string rowThree = R"(
[control]
type = "TNC640"
[[tool]]
number = 1
name = "PROBE"
kind = "probe"
length = 100
ball_radius = 3
[[preset]]
row = 3
active = true
)";
  const auto run = [&](const std::string& name, const std::string& text, const std::string& setup = {}) {
    return probewright(
        {"run", folder.file(name, text), "--setup", folder.file("s.toml", setup), "--out", (folder / "out").string()});
  };
  const auto block = [](const std::string& line) { return "0 BEGIN PGM P MM\n1 " + line + "\n2 END PGM P MM\n"; };
  // A setup that names rows has no others.
  const Answer preset = run("p.h", block("CYCL DEF 247 PRESETTING ~\nQ339=+1"), rowThree);
  EXPECT_EQ(preset.exit, 3);
  EXPECT_THAT(preset.errors, HasSubstr("The preset table has no row 1"));
  EXPECT_EQ(run("p.h", block("CYCL DEF 247 PRESETTING ~\nQ339=+3"), rowThree).exit, 0);
  EXPECT_THAT(run("p.h", block("TOOL CALL 9 Z"), rowThree).errors, HasSubstr("it has 1 PROBE"));
  EXPECT_THAT(run("p.h", block("TOOL CALL \"NOTHERE\" Z"), rowThree).errors, HasSubstr("it has 1 PROBE"));
  // A letter is like no other letter.
  const Answer letter = run("p.h", block("L X+1 FMAX"), rowThree + "[part]\npose = { d = 1 }\n");
  EXPECT_THAT(letter.errors, HasSubstr("Known keys here: a, b, c, x, y, z"));
  EXPECT_THAT(letter.errors, Not(HasSubstr("Did you mean")));
  EXPECT_THAT(run("p.mpf", "M30\n", rowThree).errors, HasSubstr("name a setup whose [control] type is 840Dsl"));
  // Klartext under the ending of the other language.
  const Answer other = run("p.mpf", block("L X+1 FMAX"), "");
  EXPECT_EQ(other.exit, 2);
  EXPECT_THAT(other.errors,
              HasSubstr("it was read as SINUMERIK because of its file extension, but looks like Klartext"));
  EXPECT_THAT(probewright({"check", (folder / "p.mpf").string()}).errors, HasSubstr("but looks like Klartext"));
  EXPECT_THAT(probewright({"check", "-dash.h"}).errors, HasSubstr("write ./-dash.h"));
  EXPECT_THAT(probewright({"check", folder.file("u.h", std::string("\xFF\xFE\0\0B\0\0\0", 8))}).errors,
              HasSubstr("this file is UTF-32"));
}

TEST(Messages, HaveOneFormAndAreSaidOnce) {
  const Folder folder;
  const std::string world = folder.file("s.toml", "[control]\ntype = \"840Dsl\"\n");
  const std::string text = "R1=1\nR2=R1/0\nM30\n";
  const Answer answer =
      probewright({"run", folder.file("p.mpf", text), "--setup", world, "--out", (folder / "out").string()});
  EXPECT_EQ(answer.exit, 3);
  // file:line:column: error: number: text
  EXPECT_THAT(answer.errors, ::testing::ContainsRegex("p\\.mpf:2:1: error: [0-9]+: "));
  EXPECT_THAT(answer.output, HasSubstr("STOPPED  (line 2)"));
  EXPECT_THAT(answer.output, Not(HasSubstr("ivision")));
}

/// Alarms of moves tell where the tool stopped, in the coordinates that the program counts in.
TEST(Messages, TellPlacesInTheActiveWorkpieceSystem) {
  const Folder folder;
  // A block from X-40 to X+40 in machine coordinates, its top at Z-480; the preset lies at X+7 Y+5 of that.
  const std::string world = R"([[part.feature]]
shape = "box"
size = [80, 60, 20]
[part.pose]
z = -500
[[tool]]
number = 1
name = "PROBE"
kind = "probe"
length = 150
ball_radius = 3
)";
  const std::string tnc = folder.file("tnc.toml", "[control]\ntype = \"TNC640\"\n" + world +
                                                      "[[preset]]\nrow = 1\norigin = [7, 5, -480]\nactive = true\n");
  const std::string siemens =
      folder.file("840.toml", "[control]\ntype = \"840Dsl\"\n" + world +
                                  "[[zero_offset]]\nname = \"G54\"\norigin = [7, 5, -480]\nactive = true\n");
  const auto said = [&](const std::string& name, const std::string& text, const std::string& setup) {
    const Answer answer =
        probewright({"run", folder.file(name, text), "--setup", setup, "--out", (folder / "out").string()});
    EXPECT_EQ(answer.exit, 3) << answer.errors;
    return answer.errors;
  };
  const std::string head = "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z\n2 L Z+50 R0 FMAX\n", end = "9 END PGM A MM\n";
  // A collision on the way down at X 20, Y 10 of the program.
  EXPECT_THAT(said("a.h", head + "3 L X+20 Y+10 R0 FMAX\n4 L Z-10 R0 FMAX\n" + end, tnc),
              HasSubstr("stopped at X+20.000 Y+10.000 Z-"));
  EXPECT_THAT(said("a.mpf", "G54 G17 G90\nT1 D1\nM6\nG0 Z50\nX20 Y10\nZ-10\nM30\n", siemens),
              HasSubstr("stopped at X+20.000 Y+10.000 Z-"));
  // Nothing to touch: DIST beyond the pre-position of 60 + 2 (SET_UP) + 3 (ball), so X 55 of the ball's centre.
  const std::string miss =
      said("b.h",
           head +
               "3 TCH PROBE 427 MEASURE COORDINATE ~\nQ263=+60 ~\nQ264=+0 ~\nQ261=-5 ~\nQ320=+0 ~\n"
               "Q272=+1 ~\nQ267=-1 ~\nQ260=+20 ~\nQ281=+0 ~\nQ288=+0 ~\nQ289=+0 ~\nQ309=+0 ~\nQ330=+0\n" +
               end,
           tnc);
  EXPECT_THAT(miss, HasSubstr("not deflected within 10.000 mm; the tool tip stopped at X+55.000 Y+0.000 Z-"));
  // From X 70, at most 2 * DFA = 4 towards the set value.
  EXPECT_THAT(
      said("b.mpf", "G54 G17 G90\nT1 D1\nM6\nG0 Z50\nX70 Y0\nZ-5\nCYCLE978(0,,,1,60,2,1,1,2,1)\nM30\n", siemens),
      ::testing::ContainsRegex(
          "not switch within 4\\.000 mm; the tool tip stopped at X\\+6[0-9.]+ Y\\+0\\.000 Z-5\\.000 of "
          "the active workpiece system"));
}

/// What is sent beyond the travel never gets there: the place that was meant counts, as the program counts.
TEST(Messages, TellWhereTheToolWouldGoBeyondTheTravel) {
  const Folder folder;
  const std::string world =
      "[[tool]]\nnumber = 1\nname = \"PROBE\"\nkind = \"probe\"\nlength = 150\nball_radius = 3\n[part]\n"
      "pose = { z = -500 }\n[[part.feature]]\nshape = \"box\"\nsize = [80, 60, 20]\n";
  const std::string preset = "[[preset]]\nrow = 1\norigin = [7, 5, -480]\nrotation = [0, 0, 90]\nactive = true\n";
  const auto said = [&](const std::string& name, const std::string& text, const std::string& setup) {
    const Answer answer =
        probewright({"run", folder.file(name, text), "--setup", setup, "--out", (folder / "out").string()});
    EXPECT_EQ(answer.exit, 3) << answer.errors;
    return answer.errors;
  };
  const auto klartext = [](const std::string& blocks) {
    return "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z\n2 L Z+50 R0 FMAX\n" + blocks + "9 END PGM A MM\n";
  };
  const std::string tnc = folder.file("tnc.toml", "[control]\ntype = \"TNC640\"\n" + world + preset);
  const std::string itnc = folder.file("itnc.toml", "[control]\ntype = \"iTNC530\"\n" + world + preset);
  for (const std::string& setup : {tnc, itnc}) {
    // The preset is turned by 90 degrees: Y of the program is -X of the machine.
    EXPECT_THAT(said("a.h", klartext("3 L X+20 Y-900 R0 FMAX\n"), setup),
                HasSubstr("axis X would go to 907.0000 mm; its travel ends at 500.0000; the tool tip would go to "
                          "X+20.000 Y-900.000 Z+50.000 of the active workpiece system"));
    // Cut up into pieces, it is the first one beyond the travel.
    EXPECT_THAT(
        said("b.h", klartext("3 CC X+0 Y+0\n4 L X+450 Y+0 R0 F9999\n5 C X+450 Y+0 DR+ F9999\n"), setup),
        ::testing::ContainsRegex("the tool tip would go to X[-+][0-9.]+ Y[-+][0-9.]+ Z\\+50\\.000 of the active"));
  }
  const std::string siemens = folder.file("840.toml", "[control]\ntype = \"840Dsl\"\n" + world +
                                                          "[[zero_offset]]\nname = \"G54\"\norigin = [7, 5, -480]\n");
  // A program that counts in inches is told so.
  EXPECT_THAT(
      said("i.h", "0 BEGIN PGM A INCH\n1 TOOL CALL 1 Z\n2 L Z+2 R0 FMAX\n3 L X+1 Y-40 R0 FMAX\n9 END PGM A INCH\n",
           tnc),
      HasSubstr("the tool tip would go to X+1.0000 Y-40.0000 Z+2.0000 inch of the active workpiece system"));
  EXPECT_THAT(said("i.mpf", "G700 G54 G17 G90\nT1 D1\nM6\nG0 Z2\nX40 Y1\nM30\n", siemens),
              HasSubstr("the tool tip would go to X+40.0000 Y+1.0000 Z+2.0000 inch of the active workpiece system"));
  EXPECT_THAT(said("a.mpf", "G54 G17 G90\nT1 D1\nM6\nG0 Z50\nX900 Y10\nM30\n", siemens),
              HasSubstr("the tool tip would go to X+900.000 Y+10.000 Z+50.000 of the active workpiece system"));
}

/// A probe that is deflected before it measures: what it touches, and where the tip is.
TEST(Messages, TellWhatADeflectedProbeTouches) {
  const Folder folder;
  const std::string tnc = folder.file(
      "tnc.toml",
      "[control]\ntype = \"TNC640\"\n[machine]\nstart = { X = 27, Y = 5, Z = -320 }\n[[tool]]\nnumber = 1\n"
      "name = \"PROBE\"\nkind = \"probe\"\nlength = 150\nball_radius = 3\nin_spindle = true\n[part]\nname = \"block\"\n"
      "pose = { z = -500 }\n[[part.feature]]\nshape = \"box\"\nsize = [80, 60, 25]\n[[preset]]\nrow = 1\n"
      "origin = [7, 5, -480]\nactive = true\n");
  // Down onto the block at Z+5 of the program, no way back, and down again.
  const std::string touch =
      "1 TCH PROBE 3.0 MEASURING\n2 TCH PROBE 3.1 Q1\n3 TCH PROBE 3.2 Z ANGLE: +180\n"
      "4 TCH PROBE 3.3 DIST +10 F100 MB 0 REFERENCE SYSTEM: 0\n5 TCH PROBE 3.4 ERRORMODE0\n";
  const Answer answer =
      probewright({"run", folder.file("a.h", "0 BEGIN PGM A MM\n" + touch + touch + "6 END PGM A MM\n"), "--setup", tnc,
                   "--out", (folder / "out").string()});
  EXPECT_EQ(answer.exit, 3);
  EXPECT_THAT(answer.errors, HasSubstr("Stylus already in contact"));
  EXPECT_THAT(answer.errors, HasSubstr("touched the part \"block\""));
  EXPECT_THAT(answer.errors, ::testing::ContainsRegex(
                                 "the tool tip is at X\\+20\\.000 Y\\+0\\.000 Z\\+(5\\.0|4\\.9)[0-9]+ of the active"));
}

/// Whatever kind of input a mistake is in: file:line:column: error: text.
TEST(Messages, HaveOneFormForEveryKindOfInput) {
  const Folder folder;
  for (const char* name : {"hh", "sin", "gud"})
    std::filesystem::create_directory(folder / name);
  const std::string tnc = folder.file("tnc.toml", "[control]\ntype = \"TNC640\"\n");
  const std::string siemens = folder.file("840.toml", "[control]\ntype = \"840Dsl\"\n");
  const std::string goodH = folder.file("good.h", "0 BEGIN PGM G MM\n1 END PGM G MM\n");
  const std::string goodM = folder.file("good.mpf", "M30\n");
  const std::string out = (folder / "out").string();
  const auto run = [&](const std::string& program, const std::string& setup) {
    return std::vector<std::string>{"run", program, "--setup", setup, "--out", out};
  };
  struct Case {
    std::string what, place;
    std::vector<std::string> words;
  };
  folder.file("hh/TOOL.T", "BEGIN TOOL.T MM\nT  NAME  L\n1  A     +1.x\n[END]\n");
  folder.file("sin/A.INI", "CHANDATA(1)\n$TC_DP1[1,1]=7x\nM17\n");
  folder.file("gud/UGUD.DEF", "DEF NCK REAL 5\nM17\n");
  folder.file("m.toml", "name = \"m\"\n[[axis]]\nname = \"X\"\nkind = \"linea\"\nminimum = 0\nmaximum = 1\n");
  folder.file("part.step",
              "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n#1=CARTESIAN_POINT('',(0.,0.,0.);\nENDSEC;\n"
              "END-ISO-10303-21;\n");
  folder.file("part.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 x\n");
  const Case cases[] = {
      {"Klartext", "a.h:2:", {"check", folder.file("a.h", "0 BEGIN PGM A MM\n1 L X+ZZ\n2 END PGM A MM\n")}},
      {"DIN/ISO", "a.i:2:", {"check", folder.file("a.i", "%A G71 *\nN10 G01 X+ZZ *\nN99999999 %A G71 *\n")}},
      {"SINUMERIK", "a.mpf:2:", {"check", folder.file("a.mpf", "R1=1\nR2=(1\nM30\n")}},
      {"a program that runs", "b.mpf:2:", run(folder.file("b.mpf", "R1=1\nR2=R1/0\nM30\n"), siemens)},
      {"an alarm", "b.h:2:", run(folder.file("b.h", "0 BEGIN PGM B MM\n1 TOOL CALL 9 Z\n2 END PGM B MM\n"), tnc)},
      {"conversion",
       "c.h:2:",
       {"convert", folder.file("c.h", "0 BEGIN PGM A MM\n1 L X+ZZ\n2 END PGM A MM\n"), (folder / "c.mpf").string()}},
      {"setup", "s.toml:1:8:", run(goodH, folder.file("s.toml", "seed = -1\n"))},
      {"no TOML", "t.toml:1:", run(goodH, folder.file("t.toml", "a = [1, 2"))},
      {"machine file", "m.toml:4:8:", run(goodH, folder.file("u.toml", "[machine]\nfile = \"m.toml\"\n"))},
      {"table", "TOOL.T:3:", run(goodH, folder.file("v.toml", "[control]\ntype = \"TNC640\"\ntables = \"hh\"\n"))},
      {"initialization text",
       "A.INI:2:", run(goodM, folder.file("w.toml", "[control]\ntype = \"840Dsl\"\ntables = \"sin\"\n"))},
      {"definition file",
       "UGUD.DEF:1:", run(goodM, folder.file("x.toml", "[control]\ntype = \"840Dsl\"\ntables = \"gud\"\n"))},
      {"STEP", "part.step:5:", run(goodH, folder.file("y.toml", "[part]\nfile = \"part.step\"\n"))},
      {"STL", "part.stl:4:", run(goodH, folder.file("z.toml", "[part]\nfile = \"part.stl\"\n"))},
      {"answers",
       "n.txt:2:",
       {"run", goodH, "--setup", tnc, "--out", out, "--answers", folder.file("n.txt", "Q1 = 2\nno answer\n")}},
      {"parameters",
       "p.toml:4:", run(goodH, folder.file("p.toml", "[control]\ntype = \"TNC640\"\n[parameters]\nMP9999 = 1\n"))}};
  for (const Case& each : cases) {
    SCOPED_TRACE(each.what);
    const Answer answer = probewright(each.words);
    EXPECT_THAT(answer.exit, ::testing::AnyOf(2, 3));
    // Each message begins a line with its place; what explains it is indented.
    bool atPlace = false;
    std::istringstream errors(answer.errors);
    for (std::string line; std::getline(errors, line);) {
      if (line.starts_with("    ")) continue;
      EXPECT_THAT(line, ::testing::MatchesRegex("[^:]+(:[0-9]+(:[0-9]+)?)?: (error|warning|note): .+"));
      const std::size_t at = line.find(each.place);
      atPlace = atPlace || (at != std::string::npos && line.find(": error: ") != std::string::npos);
    }
    EXPECT_TRUE(atPlace) << answer.errors;
    EXPECT_THAT(answer.errors, Not(HasSubstr("internal error")));
  }
}

}  // namespace
}  // namespace probewright::app::testing
