#include "session/answers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace probewright::session {
namespace {

using testing::HasSubstr;
using testing::Pair;
using testing::UnorderedElementsAre;

TEST(Answers, AreReadByQuestion) {
  const auto answers = parseAnswers(
      "# set up by hand\r\n1410 point 1 = 10 20 50; 10 20 -5\r\n\n  Q5=\t7.5 # mm\n1411 object 2= =3\nstop =", "A.TXT");
  ASSERT_TRUE(answers);
  EXPECT_THAT(*answers, UnorderedElementsAre(Pair("1410 point 1", "10 20 50; 10 20 -5"), Pair("Q5", "7.5"),
                                             Pair("1411 object 2", "=3"), Pair("stop", "")));
  EXPECT_TRUE(parseAnswers("", "A.TXT")->empty());
}

TEST(Answers, NameLineAndReasonOfAMistake) {
  const auto mistake = [](std::string_view text) { return format(parseAnswers(text, "A.TXT").error()); };
  EXPECT_THAT(mistake("Q5 = 1\nno answer at all\n"),
              HasSubstr("A.TXT:2:1: error: 'no answer at all' is not an answer"));
  EXPECT_THAT(mistake("\n\n = 5"), HasSubstr("A.TXT:3:1: error: '= 5' is not an answer"));
  EXPECT_THAT(mistake("Q5 = 1\nQ6 = 2\nQ5 = 3\n"), HasSubstr("A.TXT:3:1: error: 'Q5' is answered twice"));
}

}  // namespace
}  // namespace probewright::session
