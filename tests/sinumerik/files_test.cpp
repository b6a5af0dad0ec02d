#include "language/sinumerik/check.hpp"
#include "sinumerik/world.hpp"

/// Files that programs write, read and delete, and blocks that they put together: WRITE, READ, DELETE, EXECSTRING.
namespace probewright::language::sinumerik {
namespace {

/// A world with the file LIST.MPF of three lines beside the program, and programs that can be called from texts.
struct FileWorld : World {
  FileWorld() {
    HostOptions options;
    options.readFile = [](std::string_view name) -> std::optional<std::string> {
      if (name != "LIST.MPF") return std::nullopt;
      return "first\r\nsecond\nthird";
    };
    options.fileExists = [this](std::string_view name) { return texts.exists(name, nullptr) || name == "LIST.MPF"; };
    options.callProgram = [this](std::string_view name, const language::Program* caller) {
      if (!texts.exists(name, caller)) return false;
      return execution::Interpreter(texts, *own, {}).run(*texts.open(name, caller)).end == execution::RunEnd::Finished;
    };
    own.emplace(control, options);
  }
  execution::RunResult tryRun(const std::string& text) {
    return execution::Interpreter(texts, *own, {}).run(SinumerikProgram::fromText("MAIN.MPF", text));
  }
  void run(const std::string& text) {
    for (const Diagnostic& diagnostic : tryRun(text).diagnostics)
      ADD_FAILURE() << format(diagnostic);
  }
  std::string alarm(const std::string& text) {
    const execution::RunResult result = tryRun(text);
    if (result.diagnostics.empty()) return {};
    EXPECT_FALSE(result.diagnostics.front().advice.empty()) << format(result.diagnostics.front());
    return result.diagnostics.front().code;
  }
  /// The messages so far, separated by "|".
  std::string messages() const {
    std::string text;
    for (const auto& event : control.journal.events)
      if (event.kind == control::EventKind::Message) text += event.text + "|";
    return text;
  }
  std::optional<SinumerikHost> own;
};

TEST(SinumerikFiles, LinesOfAFileAreReadIntoStrings) {
  FileWorld world;
  world.run(
      "DEF INT ERR\nDEF STRING[20] LINE[3], ONE\n"
      "READ(ERR,\"LIST.MPF\",2,2,LINE)\nMSG(\"e\"<<ERR<<\" \"<<LINE[0]<<\" \"<<LINE[1]<<\" \"<<LINE[2])\n"
      "READ(ERR,\"LIST.MPF\",1,1,ONE)\nMSG(\"e\"<<ERR<<\" \"<<ONE)\n"
      "READ(ERR,\"LIST.MPF\",0,1,LINE[2])\nMSG(\"e\"<<ERR<<\" \"<<LINE[2])\n");
  EXPECT_EQ(world.messages(), "e0 second third |e0 first|e0 third|");
}

TEST(SinumerikFiles, WhatWasWrittenCanBeReadAgainAndDeleted) {
  FileWorld world;
  world.run(
      "DEF INT ERR\nDEF STRING[20] LINE[9]\n"
      "WRITE(ERR,\"PROT\",\"a\")\nWRITE(ERR,\"/_N_WKS_DIR/_N_PROT_MPF\",\"b\")\nWRITE(ERR,\"LIST.MPF\",\"fourth\")\n"
      "R1=ISFILE(\"PROT\")\nREAD(ERR,\"prot.mpf\",1,1,LINE)\nMSG(\"e\"<<ERR<<LINE[0])\n"
      "READ(ERR,\"LIST.MPF\",3,2,LINE)\nMSG(\"e\"<<ERR<<LINE[0]<<LINE[1])\n"
      "DELETE(ERR,\"PROT\")\nR2=ERR\nR3=ISFILE(\"PROT\")\nREAD(ERR,\"PROT\",1,1,LINE)\nR4=ERR\n"
      "DELETE(ERR,\"PROT\")\nR5=ERR\n"
      "DELETE(ERR,\"LIST.MPF\")\nR6=ISFILE(\"LIST.MPF\")\nWRITE(ERR,\"LIST.MPF\",\"new\")\n"
      "READ(ERR,\"LIST.MPF\",1,1,LINE)\nMSG(\"e\"<<ERR<<LINE[0])\n");
  EXPECT_EQ(world.messages(), "e0a|e0thirdfourth|e0new|");
  EXPECT_EQ(world.r(1), 1);
  EXPECT_EQ(world.r(2), 0);
  EXPECT_EQ(world.r(3), 0);
  EXPECT_EQ(world.r(4), 3) << "there is no such file any more";
  EXPECT_EQ(world.r(5), 3);
  EXPECT_EQ(world.r(6), 0);
  world.run("R7=ISFILE(\"..\")\nR8=ISFILE(\"/\")\nR9=ISFILE(\"\")\n");
  EXPECT_EQ(world.r(7) + world.r(8) + world.r(9), 0) << "folders are no files";
  EXPECT_EQ(world.alarm("DEF INT ERR\nWRITE(ERR,\"/_N_WKS_DIR/\",\"a\")\n"), "14020");
  for (const char* block : {"WRITE(ERR,\"A_MPF\")", "WRITE(ERR,\"A_MPF\",)", "WRITE(,\"A_MPF\",\"a\")", "WRITE(ERR)"})
    EXPECT_EQ(world.alarm(fmt::format("DEF INT ERR\n{}\n", block)), "14020") << block;
}

TEST(SinumerikFiles, ErrorsOfReadAreTold) {
  FileWorld world;
  const auto error = [&](const std::string& arguments) {
    world.run("DEF INT ERR=99\nDEF STRING[3] SHORT\nDEF STRING[20] LINE[2]\nREAD(ERR," + arguments + ")\nR1=ERR\n");
    return world.r(1);
  };
  EXPECT_EQ(error("\"NONE\",1,1,LINE"), 3);
  EXPECT_EQ(error("\"LIST.MPF\",4,1,LINE"), 21);
  EXPECT_EQ(error("\"LIST.MPF\",-1,1,LINE"), 21);
  EXPECT_EQ(error("\"LIST.MPF\",3,2,LINE"), 23);
  EXPECT_EQ(error("\"LIST.MPF\",1,3,LINE"), 22) << "two elements for three lines";
  EXPECT_EQ(error("\"LIST.MPF\",1,1,SHORT"), 22) << "three characters for five";
  EXPECT_EQ(world.alarm("DEF INT ERR\nREAD(ERR,\"LIST.MPF\",1,1)\n"), "14020");
  EXPECT_EQ(world.alarm("DEF INT ERR\nREAD(ERR,\"LIST.MPF\",1,1,R1)\n"), "12150");
  EXPECT_EQ(world.alarm("DELETE(R1)\n"), "14020");
}

TEST(SinumerikFiles, ATextIsCarriedOutAsABlock) {
  FileWorld world;
  world.texts.add("HELPER", "R7=R7+5\nM17\n");
  world.run(
      "DEF STRING[60] LINE\nDEF REAL MINE\nLINE=\"R1=5 MINE=7\"\nEXECSTRING(LINE)\nR2=MINE\n"
      "LINE=\"G0 X\"<<R1*2<<\" Y3\"\nEXECSTRING(LINE)\nR3=$AA_IW[X]\nEXECSTRING(\"HELPER\")\nR4=R7\n"
      "LINE=\"R5=SIN(90)\"\nEXECSTRING(LINE<<\"+1\")\nMSG(\"after\")\n");
  EXPECT_EQ(world.r(1), 5);
  EXPECT_EQ(world.r(2), 7);
  EXPECT_EQ(world.r(3), 10);
  EXPECT_EQ(world.r(4), 5);
  EXPECT_EQ(world.r(5), 2);
  EXPECT_EQ(world.messages(), "after|");
}

TEST(SinumerikFiles, ATextThatIsNoBlockIsRefused) {
  FileWorld world;
  for (const char* text : {"X1=", "DEF REAL A", "GOTOF GOAL", "IF R1==1", "M30", "R1=5 EXECSTRING(\"\"R2=1\"\")"}) {
    SCOPED_TRACE(text);
    const execution::RunResult result = world.tryRun("EXECSTRING(\"" + std::string(text) + "\")\nGOAL:\n");
    EXPECT_NE(result.end, execution::RunEnd::Finished);
  }
  EXPECT_EQ(world.alarm("EXECSTRING(\"GOTOF GOAL\")\nGOAL:\n"), "12080");
  EXPECT_EQ(world.alarm("DEF STRING[30] TXT=\"EXECSTRING(TXT)\"\nEXECSTRING(TXT)\n"), "12080") << "not without end";
}

TEST(SinumerikFiles, ProgramsOfTheIsoDialectAreNamedWithTheirPlace) {
  const auto program = SinumerikProgram::fromText("main.mpf", "R1=1\nISOCALL \"0001\"\nM30\n");
  const Diagnostics found = check(*program, {});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].place.line, 2U);
  EXPECT_EQ(found[0].place.column, 1U);
  EXPECT_NE(found[0].message.find("ISOCALL"), std::string::npos);
  FileWorld world;
  EXPECT_EQ(world.alarm("DEF STRING[8] NAME=\"0001\"\nISOCALL NAME\n"), "14011");
}

}  // namespace
}  // namespace probewright::language::sinumerik
