#include "cycles_kinematics/sphere_worlds.hpp"
#include "session/check.hpp"
#include "session/source.hpp"

/// What `check` says of the number and choice of measuring positions.
namespace probewright::testing_support {
namespace {

std::vector<std::string> advice(const Words& changes, ControlKind control = ControlKind::TNC640, int mode = 1) {
  const std::string text =
      "BEGIN PGM A MM\nTOOL CALL 1 Z\n" + probe(451, words451(builds()[0], mode, changes)) + "END PGM A MM\n";
  const auto program = session::programOf("A.H", text, language::ProgramLanguage::Klartext);
  std::vector<std::string> messages;
  for (const Diagnostic& each : session::checkProgram(*program, control))
    messages.push_back((each.severity == Severity::Error ? "error: " : "") + each.message);
  return messages;
}

void expectOnly(const std::vector<std::string>& messages, const std::string& part) {
  ASSERT_EQ(messages.size(), 1u) << part;
  EXPECT_NE(messages[0].find(part), std::string::npos) << messages[0];
}

TEST(Advice, IsSilentWhereTheManualIsFollowed) {
  EXPECT_TRUE(advice({}).empty());
  EXPECT_TRUE(advice({{432, 0.5}, {414, 8}, {422, 8}, {419, 30}, {420, 330}}).empty());
  EXPECT_TRUE(advice({{422, 4}, {419, 45}, {420, 315}}, ControlKind::TNC640, 0).empty());
}

TEST(Advice, NamesWhatTheManualAdvisesAgainst) {
  expectOnly(advice({{414, 3}}), "measuring point 2 of A lies at 0, where the reference is measured; it is left out");
  expectOnly(advice({{414, 3}}, ControlKind::iTNC530), "error: measuring point 2 of A lies at 0");
  expectOnly(advice({{419, 90}, {420, -270}, {422, 3}}), "C is measured twice at -270 degrees");
  expectOnly(advice({{411, -20}, {412, 20}}), "the sum of 2 - 2 cos of their angles is");
  expectOnly(advice({{414, 8}}), "8 measuring points of A bring hardly more than 6");
  expectOnly(advice({{422, 3}, {414, 4}}, ControlKind::TNC640, 0), "the accuracy of a machine is checked with 4 to 8");
  expectOnly(advice({{414, 8}, {432, 0.5}}), "3 measuring points of C tell little of its backlash");
  expectOnly(advice({{411, 90}, {412, 90}, {414, 1}}, ControlKind::TNC640, 2),
             "one measuring point of A does not tell");
  expectOnly(advice({{414, 0}, {422, 0}}), "no axis is measured");
  expectOnly(advice({{414, 99999999}}), "error: Q414 (measuring points of A; 0: not measured) cannot be 99999999");
  expectOnly(advice({}, ControlKind::iTNC530, 3), "error: Q406 = 3 is a mode of the TNC 640");
}

}  // namespace
}  // namespace probewright::testing_support
