#include "execution/sinumerik/global_data.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "control/sinumerik/init_text.hpp"
#include "language/sinumerik/check.hpp"
#include "sinumerik/world.hpp"

namespace probewright::language::sinumerik {

using namespace execution;
using namespace execution::sinumerik;
namespace {

constexpr const char* definitions = R"(%_N_UGUD_DEF
;$PATH=/_N_DEF_DIR
; what the shop keeps
N10 DEF NCK REAL _CLEARANCE[3]=SET(2,2.5,-5)
DEF CHAN INT _COUNT=3
def nck string[20] _shift_name="early", _OPERATOR
DEF CHAN SYNR APR 7 APW 4 REAL PHU 1 LLI -0.5 ULI 0.5 _WEAR
DEF NCK INT LLI 1 ULI 99 _PART
DEF NCK BOOL _READY=TRUE
DEF CHAN REAL _GRID[2,3]
DEF NCK CHAR _KIND="A"
DEF NCK AXIS _WHICH=(X)
DEF NCK FRAME _PLACE
M17
what stands after is not read
)";

GlobalUserData definitionsOf(const std::string& text, Diagnostics& mistakes) {
  GlobalUserData data;
  data.read("UGUD.DEF", text, mistakes);
  return data;
}

GlobalUserData good() {
  Diagnostics mistakes;
  GlobalUserData data = definitionsOf(definitions, mistakes);
  for (const Diagnostic& each : mistakes)
    ADD_FAILURE() << format(each);
  return data;
}

/// A control with these definitions, and programs that run on it.
struct GlobalWorld {
  explicit GlobalWorld(const GlobalUserData& data, const std::string& initialization = {}) : machine("mill3") {
    control::sinumerik::DataStore store = World::data();
    Diagnostics mistakes;
    control::sinumerik::InitText::parse(initialization, "U.GUD", store, mistakes);
    HostOptions options;
    options.globalData = data.variables(store, mistakes);
    for (const Diagnostic& each : mistakes)
      ADD_FAILURE() << format(each);
    control.emplace(machine, store);
    host.emplace(*control, options);
  }
  execution::RunResult run(const std::string& text) {
    Texts library;
    return execution::Interpreter(library, *host, {}).run(SinumerikProgram::fromText("MAIN.MPF", text));
  }
  std::string codeOf(const std::string& text) {
    const execution::RunResult result = run(text);
    return result.diagnostics.empty() ? "" : result.diagnostics.front().code;
  }
  double r(int number) { return control->data.number("R", {number}); }

  NotingMachine machine;
  std::optional<control::sinumerik::Control> control;
  std::optional<SinumerikHost> host;
};

TEST(GlobalData, BeginsWithTheValuesOfItsDefinition) {
  GlobalWorld world(good());
  EXPECT_EQ(world.codeOf("R1=_CLEARANCE[1]+_CLEARANCE[2]\nR2=_COUNT\nR3=STRLEN(_SHIFT_NAME)\nR4=_PART\n"
                         "R5=_READY\nR6=_KIND\nR7=_WEAR\nR8=STRLEN(_OPERATOR)\nR9=ISVAR(\"_GRID\")\n"
                         "R10=ISVAR(\"_GIRD\")\nM30"),
            "");
  EXPECT_EQ(world.r(1), -2.5);
  EXPECT_EQ(world.r(2), 3);
  EXPECT_EQ(world.r(3), 5);
  EXPECT_EQ(world.r(4), 1) << "0 lies below the limit, so the limit it is";
  EXPECT_EQ(world.r(5), 1);
  EXPECT_EQ(world.r(6), 65);
  EXPECT_EQ(world.r(7), 0);
  EXPECT_EQ(world.r(8), 0);
  EXPECT_EQ(world.r(9), 1);
  EXPECT_EQ(world.r(10), 0);
  EXPECT_TRUE(world.control->data.keys("_COUNT").empty()) << "nothing changed it";
}

TEST(GlobalData, TakesValuesOfInitializationTextsAndLeavesChangesThere) {
  GlobalWorld world(good(),
                    "CHANDATA(1)\n_COUNT=7\n_CLEARANCE[0]=SET(1,1.5)\n_GRID[1,2]=4.25\n_SHIFT_NAME=\"late\"\n"
                    "_READY=FALSE\nM17\n");
  EXPECT_EQ(world.codeOf("PROC MAIN\nR1=_COUNT\nR2=_CLEARANCE[1]\nR3=_GRID[1,2]\nR4=_READY\n"
                         "_COUNT=_COUNT+1\n_GRID[0,1]=-2.5\n_OPERATOR=\"Li\"\n_READY=R4==0\n_CLEARANCE[2]=-5\n"
                         "_GRID[1]=SET(8,9)\n_PLACE=CTRANS(X,10):CROT(Z,30)\nM30"),
            "");
  EXPECT_EQ(world.r(1), 7);
  EXPECT_EQ(world.r(2), 1.5);
  EXPECT_EQ(world.r(3), 4.25);
  EXPECT_EQ(world.r(4), 0);
  const control::sinumerik::DataStore& data = world.control->data;
  EXPECT_EQ(data.number("_COUNT", {}), 8);
  EXPECT_EQ(data.number("_GRID", {0, 1}), -2.5);
  EXPECT_EQ(data.number("_GRID", {1, 0}), 8);
  EXPECT_EQ(data.number("_GRID", {1, 1}), 9);
  EXPECT_EQ(data.number("_GRID", {1, 2}), 4.25);
  EXPECT_EQ(data.text("_OPERATOR", {}), "Li");
  EXPECT_EQ(data.get("_READY"), control::sinumerik::DataValue(true));
  EXPECT_FALSE(data.isSet({"_CLEARANCE", {2}})) << "written, but not changed";
  EXPECT_EQ(data.number("_PLACE", {"X", "TR"}), 10);
  EXPECT_EQ(data.number("_PLACE", {"Z", "RT"}), 30);
  // As a file of the control it reads back.
  control::sinumerik::DataStore nothing, again;
  Diagnostics mistakes;
  const auto text = control::sinumerik::InitText::parse("M17\n", "U.GUD", nothing, mistakes).updated(data);
  ASSERT_TRUE(text);
  EXPECT_NE(text->find("_GRID[0,1]=-2.5\n"), std::string::npos) << *text;
  EXPECT_NE(text->find("_OPERATOR=\"Li\"\n"), std::string::npos);
  GlobalWorld next(good(), *text);
  EXPECT_EQ(next.codeOf("R1=_COUNT\n$P_PFRAME=_PLACE\nR2=$P_PFRAME[X,TR]\nM30"), "");
  EXPECT_EQ(next.r(1), 8);
  EXPECT_EQ(next.r(2), 10);
  // The journal tells it too.
  const auto& writes = world.control->journal.writes;
  EXPECT_TRUE(std::ranges::any_of(writes, [](const auto& each) { return each.table == "_COUNT"; }));
}

TEST(GlobalData, IsWatchedAsTheControlDoes) {
  const auto code = [](const std::string& text) { return GlobalWorld(good()).codeOf(text + "\nM30"); };
  EXPECT_EQ(code("_CLEARANCE[3]=1"), "17020");
  EXPECT_EQ(code("_GRID[0,3]=1"), "17030");
  EXPECT_EQ(code("_COUNT=\"x\""), "12150");
  EXPECT_EQ(code("_WEAR=0.6"), "17090");
  EXPECT_EQ(code("_WEAR=-0.6"), "17080");
  EXPECT_EQ(code("_PART=0"), "17080");
  EXPECT_EQ(code("_PART=99"), "");
  EXPECT_EQ(code("_COUNT=3000000000"), "12160");
}

TEST(GlobalData, IsSharedByPrograms) {
  GlobalWorld world(good());
  Texts library;
  library.add("COUNTUP", "PROC COUNTUP(VAR INT WHAT)\n_COUNT=_COUNT+10\nWHAT=WHAT+1\nM17");
  library.add("OWN", "PROC OWN\nDEF INT _COUNT=100\n_COUNT=_COUNT+1\nM17");
  const auto result = execution::Interpreter(library, *world.host, {})
                          .run(SinumerikProgram::fromText("MAIN.MPF", "COUNTUP(_PART)\nOWN\nR1=_COUNT\nR2=_PART\nM30"));
  EXPECT_EQ(result.end, execution::RunEnd::Finished);
  EXPECT_EQ(world.r(1), 13) << "a variable of the program's own hides the global one";
  EXPECT_EQ(world.r(2), 2);
}

TEST(GlobalData, MistakesOfDefinitionFilesHavePlaces) {
  struct Case {
    const char* text;
    std::uint64_t line;
    std::uint32_t column;
    const char* message;
  };
  const Case cases[] = {
      {"DEF REAL _A", 1, 1, "NCK or CHAN is missing"},
      {"DEF NCK REAL _A\nDEF CHAN INT _A", 2, 14, "declared already"},
      {"DEF NCK RAEL _A", 1, 9, "type"},
      {"R1=5\nDEF NCK REAL _A", 1, 1, "lines of DEF and DEFINE only"},
      {"DEF NCK REAL _A[0]", 1, 14, "elements"},
      {"DEF NCK REAL _A[2]=SET(1,2,3)", 1, 14, "longer"},
      {"DEF NCK INT _A=\"x\"", 1, 13, "type INT"},
      {"DEF NCK REAL LLI 1 ULI 2 _A=3", 1, 26, "above"},
      {"DEF NCK INT LLI 2 ULI 1 _A", 1, 25, "above the upper limit"},
      {"DEF NCK REAL _A=_B", 1, 14, "_B has no value"},
      {"G0 X10", 1, 1, "lines of DEF and DEFINE only"},
      {"DEF NCK REAL _A=1/0", 1, 14, "divis"},
      {"DEF NCK STRING _A", 1, 16, "'['"},
      {"DEF NCK REAL _A\nN REDEF _A LLI 1", 2, 1, ""},  // N without a number, which is not a block number
  };
  for (const Case& each : cases) {
    Diagnostics mistakes;
    definitionsOf(each.text, mistakes);
    ASSERT_EQ(mistakes.size(), 1U) << each.text;
    EXPECT_EQ(mistakes[0].place.file, "UGUD.DEF");
    EXPECT_EQ(mistakes[0].place.line, each.line) << each.text;
    EXPECT_EQ(mistakes[0].place.column, each.column) << each.text << "\n" << format(mistakes[0]);
    EXPECT_NE(mistakes[0].message.find(each.message), std::string::npos) << format(mistakes[0]);
  }
}

TEST(GlobalData, ValuesThatDoNotFitAreTold) {
  for (const char* text : {"_CLEARANCE[3]=1", "_COUNT=\"x\"", "_WEAR=0.7", "_COUNT[0,0]=1"}) {
    control::sinumerik::DataStore store;
    Diagnostics mistakes;
    control::sinumerik::InitText::parse(text, "U.GUD", store, mistakes);
    ASSERT_TRUE(mistakes.empty()) << text;
    good().variables(store, mistakes);
    ASSERT_EQ(mistakes.size(), 1U) << text;
    EXPECT_EQ(mistakes[0].place.file, "UGUD.DEF");
    EXPECT_GT(mistakes[0].place.line, 0U);
  }
}

TEST(GlobalData, LeavesTheDataOfMeasuringCyclesToTheControl) {
  Diagnostics mistakes;
  const GlobalUserData data =
      definitionsOf("DEF CHAN REAL _OVR[32]\nDEF NCK REAL _WP[3,11]\nDEF NCK INT _MINE", mistakes);
  EXPECT_TRUE(mistakes.empty());
  ASSERT_EQ(data.data().size(), 1U);
  EXPECT_EQ(data.data()[0].name, "_MINE");
}

TEST(GlobalData, CheckKnowsTheNames) {
  const GlobalUserData data = good();
  const auto messages = [&](const std::string& text) {
    const auto program = SinumerikProgram::fromText("T.MPF", text);
    CheckOptions options;
    options.globalData = data.declarations();
    std::string all;
    for (const Diagnostic& each : check(*program, options))
      all += each.message + "|" + each.advice + "\n";
    return all;
  };
  EXPECT_EQ(messages("R1=_CLEARANCE[1]\n_GRID[1,2]=R1\nM30"), "");
  EXPECT_NE(messages("R1=_CLEARENCE[1]\nM30").find("Did you mean _CLEARANCE?"), std::string::npos);
  EXPECT_EQ(messages("DEF REAL _COUNT\n_COUNT=1\nM30"), "");
}

TEST(GlobalData, FilesAreKnownByTheirNames) {
  EXPECT_EQ(definitionFileName("UGUD.DEF"), "UGUD.DEF");
  EXPECT_EQ(definitionFileName("_N_GUD4_DEF"), "GUD4.DEF");
  EXPECT_EQ(definitionFileName("gud9.def"), "GUD9.DEF");
  EXPECT_EQ(definitionFileName("_N_SGUD.DEF"), "SGUD.DEF");
  EXPECT_EQ(definitionFileName("_N_UMAC_DEF"), "UMAC.DEF");
  for (const char* name : {"UGUD.MPF", "GUD10.DEF", "XMAC.DEF", "DEF", ".DEF", "OLDUGUD.DEF"})
    EXPECT_EQ(definitionFileName(name), "") << name;
}

}  // namespace
}  // namespace probewright::language::sinumerik
