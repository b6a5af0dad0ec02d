#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <stop_token>
#include <thread>

#include "simulation/child_process.hpp"
#include "simulation/import_cache.hpp"
#include "simulation/imported_part.hpp"
#include "simulation/step_text.hpp"
#include "worlds.hpp"

namespace probewright::simulation {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::ScratchFolder;
using How = ChildEnd::How;

ChildEnd child(const std::function<std::string(const ChildVoice&)>& work, const ChildLimits& limits = {}) {
  return inChild(
      work, limits, [](std::string_view) {}, [](double) { return false; });
}

TEST(ChildProcess, HandsItsResultAndItsLinesBack) {
  std::vector<std::string> lines;
  const std::string large(3'000'000, 'x');
  const ChildEnd end = inChild(
      [&](const ChildVoice& voice) {
        voice.say("one");
        voice.say("two\nlines");
        return large;
      },
      {}, [&](std::string_view line) { lines.emplace_back(line); }, [](double) { return false; });
  EXPECT_EQ(end.how, How::Finished);
  EXPECT_EQ(end.result, large);
  EXPECT_THAT(lines, ElementsAre("one", "two lines"));
}

TEST(ChildProcess, HandsOverWhatIsDoneWhileItWorksOn) {
  const std::string large(3'000'001, 'y');
  std::vector<HandedBytes> pieces;
  const ChildEnd end = inChild(
      [&](const ChildVoice& voice) -> std::string {
        voice.hand("first");
        voice.hand(large);
        for (;;)
          std::this_thread::sleep_for(std::chrono::seconds(1));
      },
      {}, [](std::string_view line) { ADD_FAILURE() << line; }, [](double) { return false; },
      [&](HandedBytes bytes) {
        pieces.push_back(std::move(bytes));
        return pieces.size() == 2;
      });
  EXPECT_EQ(end.how, How::Finished);
  EXPECT_EQ(end.result, "");
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_EQ(pieces[0].view(), "first");
  EXPECT_TRUE(pieces[1].view() == large);
}

TEST(ChildProcess, ThatHandsOverHalfOfItsWorkIsNotDone) {
  const ChildEnd end = inChild(
      [](const ChildVoice& voice) -> std::string {
        voice.hand("half");
        std::raise(SIGSEGV);
        return "whole";
      },
      {}, [](std::string_view) {}, [](double) { return false; }, [](const HandedBytes&) { return false; });
  EXPECT_EQ(end.how, How::Crashed);
  EXPECT_EQ(end.result, "");
}

TEST(ChildProcess, TellsHowItDied) {
  const ChildEnd crash = child([](const ChildVoice&) -> std::string {
    std::raise(SIGSEGV);
    return {};
  });
  EXPECT_EQ(crash.how, How::Crashed);
  const ChildEnd thrown = child([](const ChildVoice&) -> std::string { throw std::runtime_error("no"); });
  EXPECT_EQ(thrown.how, How::Crashed);
  EXPECT_EQ(thrown.signal, 0);
  const ChildEnd full = child([](const ChildVoice&) -> std::string { throw std::bad_alloc(); });
  EXPECT_EQ(full.how, How::OutOfMemory);
}

TEST(ChildProcess, EndsAfterItsTimeOrWhenTheParentHasEnough) {
  const auto sleeps = [](const ChildVoice&) -> std::string {
    for (;;)
      std::this_thread::sleep_for(std::chrono::seconds(1));
  };
  EXPECT_EQ(child(sleeps, {0.2}).how, How::OutOfTime);
  EXPECT_EQ(inChild(
                sleeps, {}, [](std::string_view) {}, [](double) { return true; })
                .how,
            How::Ended);
}

TEST(ChildProcess, CountsTheProcessorsTimeAndNotThatOfTheClock) {
  double used = 0;
  const auto note = [&](double seconds) {
    used = std::max(used, seconds);
    return seconds > 0.2;
  };
  const auto sleeps = [](const ChildVoice&) -> std::string {
    std::this_thread::sleep_for(std::chrono::milliseconds(600));
    return {};
  };
  EXPECT_EQ(inChild(
                sleeps, {}, [](std::string_view) {}, note)
                .how,
            How::Finished);
  EXPECT_LT(used, 0.2);
  const auto works = [](const ChildVoice&) -> std::string {
    for (std::atomic<unsigned> i = 0;;)
      ++i;
  };
  EXPECT_EQ(inChild(
                works, {}, [](std::string_view) {}, note)
                .how,
            How::Ended);
  EXPECT_GT(used, 0.2);
}

std::string step(const std::string& data) {
  return "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n" + data + "ENDSEC;\nEND-ISO-10303-21;\n";
}

TEST(StepText, KnowsWhereEachEntityStands) {
  const std::string bytes =
      step("#1=CARTESIAN_POINT('a;''(#9',(0.,0.,0.));\n/* #3=X();\n */ #20 = DIRECTION\n('',#1,#7);\n");
  const auto text = scanStep(bytes, "p.step");
  ASSERT_TRUE(text) << format(text.error());
  ASSERT_EQ(text->entities.size(), 2U);
  EXPECT_EQ(text->entities.at(1).line, 5U);
  EXPECT_EQ(text->entities.at(1).type, "CARTESIAN_POINT");
  EXPECT_EQ(text->entities.at(20).line, 7U);
  EXPECT_EQ(text->dangling, 20U);
  EXPECT_EQ(text->missing, 7U);
}

/// As OpenCASCADE does: names with an inch or a foot sign are common.
TEST(StepText, TakesAQuoteThatIsNotDoubledAsALetterOfItsText) {
  for (const char* name :
       {"it's", "5' x 6'", "5'", "5''", "''", "bob's (a; b) #77 part", "a\n'b", "'", "x' /* c */ y", "/*'"}) {
    const std::string bytes =
        step("#1=PRODUCT('" + std::string(name) + "' , 'b',(#20));\n#20=DIRECTION('c',(0.,1.));\n");
    const auto text = scanStep(bytes, "p.step");
    ASSERT_TRUE(text) << name << ": " << format(text.error());
    ASSERT_EQ(text->entities.size(), 2U) << name;
    EXPECT_EQ(text->entities.at(20).type, "DIRECTION");
    ASSERT_EQ(text->references.size(), 1U) << name;
    EXPECT_EQ(text->missing, 0U) << name;
  }
}

/// OpenCASCADE reads as much of a damaged number as it understands, and something else after it.
TEST(StepText, NamesWhatBeginsLikeANumberAndIsNone) {
  for (const char* number : {"0", "-12", "+3", "1.", ".5", "-.5", "0.25", "6.02E-7", "1.E+00", "2.E5", "3E2"}) {
    const auto text = scanStep(step(fmt::format("#1=DIRECTION('',(0.,{}),.T.,.U2.,\"0A1\",$);\n", number)), "p.step");
    EXPECT_TRUE(text) << number << ": " << format(text.error());
  }
  for (const char* number :
       {"0.707106B81186548", "1..5", "0.7-1", "1.E", "2.5E1.5", "--3", "+", "-", "12A", "1.5E+-3"}) {
    const auto text = scanStep(step(fmt::format("#1=A(1.);\n#7=DIRECTION('',\n(0.,{} ));\n", number)), "p.step");
    ASSERT_FALSE(text) << number;
    EXPECT_THAT(format(text.error()), HasSubstr(fmt::format("p.step:7: error: #7: \"{}\" is not a number", number)));
  }
}

TEST(StepText, ItsKeywordsMayBeWrittenSmall) {
  const std::string bytes =
      "iso-10303-21;\nheader;\nendsec;\ndata;\n#1=DIRECTION('',(0.,1.));\nendsec;\nend-iso-10303-21;\n";
  const auto text = scanStep(bytes, "p.step");
  ASSERT_TRUE(text) << format(text.error());
  EXPECT_EQ(text->entities.size(), 1U);
}

TEST(StepText, NamesTheSectionThatIsMissing) {
  const auto message = [](const std::string& bytes) {
    const auto text = scanStep(bytes, "p.step");
    return text ? std::string("fine") : format(text.error());
  };
  const std::string entity = "#1=A();\n", end = "ENDSEC;\nEND-ISO-10303-21;\n";
  EXPECT_THAT(message("ISO-10303-21;\nDATA;\n" + entity + end),
              HasSubstr("p.step:2: error: the STEP file has no section HEADER"));
  EXPECT_THAT(message("ISO-10303-21;\nHEADER;\nENDSEC;\n" + entity + end),
              HasSubstr("p.step:4: error: #1 stands outside of the section DATA"));
  EXPECT_THAT(message("ISO-10303-21;\nHEADER;\nENDSEC;\nDATA('A',('B'));\n" + entity + end),
              HasSubstr("p.step:4: error: the section DATA has parameters"));
  EXPECT_THAT(message("ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n" + entity + "ENDSEC;\n"),
              HasSubstr("p.step:7: error: the STEP file ends before END-ISO-10303-21"));
}

TEST(StepText, FindsAnEntityThatRefersToItself) {
  const auto circular = [](const std::string& data) {
    const std::string bytes = step(data);
    const auto text = scanStep(bytes, "p.step");
    EXPECT_TRUE(text) << format(text.error());
    return text ? circularEntity(*text) : 0;
  };
  EXPECT_EQ(circular("#1=A(#2,#3);\n#2=B(#3,#3);\n#3=C();\n"), 0U);
  EXPECT_EQ(circular("#1=A(#2);\n#2=B(#2);\n"), 2U);
  EXPECT_EQ(circular("#1=A(#2);\n#2=B(#3,#9);\n#3=C(#4,#5);\n#4=D();\n#5=E(#3);\n") % 2, 1U);
}

TEST(StepText, SaysWhatIsWrongAndWhere) {
  const auto message = [](const std::string& data) {
    const std::string bytes = step(data);
    const auto text = scanStep(bytes, "p.step");
    return text ? std::string("fine") : format(text.error());
  };
  EXPECT_THAT(message("#1=A();\n#1=B();\n"),
              HasSubstr("p.step:6: error: the STEP file has two entities #1, the first in line 5"));
  EXPECT_THAT(message("#1=A((1,2);\n"), HasSubstr("p.step:5: error: #1 lacks a closing bracket"));
  EXPECT_THAT(message("#1=A(1,2));\n"), HasSubstr("p.step:5: error: #1 has a bracket ) too many"));
  EXPECT_THAT(message("\n#1=A('x);\n"), HasSubstr("p.step:6: error: a text of the STEP file has no end"));
  EXPECT_THAT(message("#1=A(" + std::string(200'000, '(') + ";\n"), HasSubstr("#1 are nested too deeply"));
}

TEST(StepText, IsNotReadToItsEndOnceSomebodyAsksForAStop) {
  std::stop_source stop;
  stop.request_stop();
  const std::string bytes = step("#1=A();\n");
  const auto text = scanStep(bytes, "p.step", stop.get_token());
  ASSERT_FALSE(text);
  EXPECT_THAT(format(text.error()), HasSubstr("was interrupted"));
}

TEST(ImportedPart, ComesBackAsItWas) {
  ImportedPart part;
  part.remarks.push_back({Severity::Warning, {{}, 17, 0}, "a face is missing", {}, "export it again", {}});
  part.shape = std::string_view("any\0bytes", 9);
  part.elements = std::string_view("more\0of them", 12);
  const std::string bytes = toBytes(part);
  const auto read = partFromBytes(bytes);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->shape, part.shape);
  EXPECT_EQ(read->elements, part.elements);
  ASSERT_EQ(read->remarks.size(), 1U);
  EXPECT_EQ(read->remarks[0].message, "a face is missing");
  EXPECT_EQ(read->remarks[0].place.line, 17U);
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(partFromBytes(bytes.substr(0, size))) << size;
  EXPECT_FALSE(partFromBytes(bytes + "x"));
}

TEST(ImportCache, StaysWithinItsSizeAndDropsTheOldest) {
  const ScratchFolder folder;
  const ImportCache cache(folder / "cache", 10'000);
  const std::string entry(4'000, 'e');
  for (const char* key : {"a", "b"})
    cache.keep(key, entry);
  std::filesystem::last_write_time(folder / "cache" / "a.part",
                                   std::filesystem::file_time_type::clock::now() - std::chrono::hours(2));
  std::filesystem::last_write_time(folder / "cache" / "b.part",
                                   std::filesystem::file_time_type::clock::now() - std::chrono::hours(1));
  EXPECT_TRUE(cache.find("a"));  // used now
  cache.keep("c", entry);
  EXPECT_TRUE(cache.find("a"));
  EXPECT_FALSE(cache.find("b"));
  EXPECT_TRUE(cache.find("c"));
  cache.keep("huge", std::string(6'000, 'h'));
  EXPECT_FALSE(cache.find("huge"));
  EXPECT_FALSE(ImportCache("").find("a"));
}

}  // namespace
}  // namespace probewright::simulation
