#include <fmt/format.h>
#include <gmock/gmock.h>

#include "records/results.hpp"
#include "reports/summary.hpp"
#include "truth/told.hpp"

/// What is said of an alarm to those who are not to know more than a real control does.
namespace probewright::truth::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// A control knows that something was touched, and where its axes stood; what it was and where only the virtual
/// machine.
TEST(Diagnosis, DoesNotTellTheBlindWhatTheyRanInto) {
  struct Accident {
    const char* name;
    std::string program;
    std::string more;
    std::vector<std::string> hidden;  ///< what is told to those who see, and not to the blind
    const char* known;                ///< what is told to the blind
  };
  const std::string vice =
      "[[fixture]]\nname = \"vice\"\npose = { x = 70, z = -500 }\n[[fixture.feature]]\nshape = \"box\"\n"
      "size = [20, 60, 90]\n";
  const std::string mill = "[[tool]]\nnumber = 2\nname = \"MILL\"\nkind = \"mill\"\nlength = 110\nradius = 6\n";
  const std::string body =
      "[machine]\n[[machine.body]]\nname = \"column\"\nlink = \"head\"\n[[machine.body.feature]]\nshape = \"box\"\n"
      "centre = [0, -150, -140]\nsize = [20, 20, 140]\n[[fixture]]\nname = \"post\"\npose = { y = -150, z = -557.5 }\n"
      "[[fixture.feature]]\nshape = \"box\"\nsize = [30, 30, 100]\n";
  const std::vector<Accident> accidents = {
      {"the ball on its way",
       "TOOL CALL 1 Z\nL X+30 Y+0 Z-5 R0 FMAX\n",
       "",
       {"stylus tip of tool", "\"plate\""},
       "Touch probe deflected: the stylus has touched something; the tool tip stopped at X+"},
      {"the body of the probe",
       "TOOL CALL 1 Z\nL X+0 Y+0 Z+10 R0 FMAX\nL X+75 FMAX\n",
       vice,
       {"body of tool", "\"vice\""},
       "Collision: the machine has run into something; the tool tip stopped at X+"},
      {"the ball on the way of a cycle",
       "TOOL CALL 1 Z\nL X-20 Y+0 Z+40 R0 FMAX\nTCH PROBE 427 COORDINATE ~\nQ263=+85 ~\nQ264=+0 ~\n"
       "Q261=+20 ~\nQ320=+2 ~\nQ272=+1 ~\nQ267=+1 ~\nQ260=+40 ~\nQ281=+0 ~\nQ288=+99 ~\nQ289=-99 ~\nQ309=+0 ~\n"
       "Q330=+0\n",
       vice,
       {"stylus tip of tool", "\"vice\""},
       "Touch probe deflected: the stylus has touched something"},
      {"a cutter",
       "TOOL CALL 2 Z S0\nL X+0 Y+0 Z+40 R0 FMAX\nL X+70 FMAX\n",
       vice + mill,
       {"\"vice\""},
       "Collision: the machine has run into something"},
      {"a body of the machine",
       "TOOL CALL 1 Z\nL X+0 Y+0 R0 FMAX\nL Z+5 FMAX\n",
       body,
       {"\"column\"", "\"post\""},
       "Collision: the machine has run into something"}};
  const std::vector<std::pair<control::DialogLanguage, const char*>> languages = {
      {control::DialogLanguage::German, "kollidiert"},
      {control::DialogLanguage::Russian, "столкнулся"},
      {control::DialogLanguage::Swedish, "kolliderat"},
      {control::DialogLanguage::Chinese, "机床碰到了某物"},
      {control::DialogLanguage::Polish, "zderzyła"}};
  for (const Accident& accident : accidents) {
    SCOPED_TRACE(accident.name);
    World world;
    world.origin = {0, 0, -480};
    world.part = plate("{ z = -480 }");
    world.more = accident.more;
    setup::MachineOptions blind;
    blind.blind = true;
    const auto all = [](const Told& told) {
      return records::resultsText(told.outcome.journal, told.outcome.info) + told.why() +
             reports::summaryText(told.outcome.journal, told.outcome.info);
    };
    const Told seen = run(world, accident.program), hidden = run(world, accident.program, blind);
    EXPECT_FALSE(hidden.finished());
    for (const std::string& secret : accident.hidden) {
      EXPECT_THAT(seen.why(), HasSubstr(secret));
      EXPECT_THAT(hidden.why(), Not(HasSubstr(secret)));
    }
    EXPECT_THAT(seen.why(), HasSubstr("on the table"));
    EXPECT_THAT(all(hidden), Not(HasSubstr("on the table")));
    // In texts; the name of the part as such is in the head of the record, and JSON has columns of its own.
    for (const char* name : {"plate", "vice", "column", "post"}) {
      EXPECT_THAT(all(hidden), Not(HasSubstr(fmt::format("\\\"{}\\\"", name)))) << name;
      EXPECT_THAT(hidden.why(), Not(HasSubstr(name)));
    }
    EXPECT_THAT(hidden.why(), HasSubstr(accident.known));
    if (std::string(accident.known).find("stylus") != std::string::npos) continue;
    for (const auto& [language, word] : languages) {
      const std::string summary = reports::summaryText(hidden.outcome.journal, hidden.outcome.info,
                                                       reports::Colour::Off, reports::Cause::Shown, language);
      EXPECT_THAT(summary, HasSubstr(word));
      EXPECT_THAT(summary, Not(HasSubstr("run into something")));
    }
  }
}

}  // namespace
}  // namespace probewright::truth::testing
