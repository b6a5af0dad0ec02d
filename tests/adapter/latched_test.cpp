#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "adapter/answering_adapter.hpp"
#include "support/axis_positions.hpp"

/// What the engine makes of adapters that tell a touch where it cannot have been.
namespace probewright::adapter {
namespace {

using machine::Feed;
using machine::MeasureEnd;
using machine::MoveEnd;
using testing::HasSubstr;
using testing_support::positions;

/// A measuring move from X0 Y0 Z0 to X10 Y0 Z-20, whose adapter answers with `latched`.
machine::MeasureResult touchedAt(const std::string& latched, std::string& failure) {
  Adapter adapter(after({R"({"id":$,"position":[0,0,0],"end":"touched","latched":)" + latched + "}"}));
  auto machine = adapter.greet();
  if (!machine) return {};
  machine::MeasureResult result = (*machine)->measure({positions({10, 0, -20}), Feed::at(300)});
  failure = (*machine)->failure().value_or("");
  return result;
}

TEST(LatchedPosition, TakesNoTouchThatDoesNotLieOnTheMeasuringMove) {
  // On the line, beside it by what machines deviate, and as far beyond its ends.
  for (const char* latched :
       {"[5,0,-10]", "[5.4,0.8,-9.8]", "[0,0,0]", "[-0.4,0,0.8]", "[10,0,-20]", "[10.4,0,-20.8]"}) {
    std::string failure;
    const auto result = touchedAt(latched, failure);
    EXPECT_EQ(result.end, MeasureEnd::Touched) << latched << failure;
  }
  for (const char* latched : {"[5,1.01,-10]", "[10.5,0,-21]", "[-0.5,0,1]", "[5000,0,-10000]", "[1000000,0,-10]",
                              "[0.19685,0,-393.7]", "[-5,0,10]", "[5,0,-1e300]", "[1e308,-1e308,1e308]"}) {
    std::string failure;
    const auto result = touchedAt(latched, failure);
    EXPECT_EQ(result.end, MeasureEnd::Refused) << latched;
    EXPECT_EQ(result.detail, failure);
    EXPECT_THAT(failure, HasSubstr("off the measuring move from X0.000 Y0.000 Z0.000 to X10.000 Y0.000 Z-20.000"))
        << latched;
    EXPECT_THAT(failure, HasSubstr("docs/machine-adapters.md"));
  }
  for (const char* latched : {"[NaN,0,0]", "[nan,0,0]", "[Infinity,0,0]", "[1e999,0,0]", "[null,0,0]", "[5,0]"}) {
    std::string failure;
    EXPECT_EQ(touchedAt(latched, failure).end, MeasureEnd::Refused) << latched;
    EXPECT_THAT(failure, HasSubstr("does not keep to the protocol")) << latched;
  }
  std::string failure;
  touchedAt("[5,3,-10]", failure);
  EXPECT_THAT(failure, HasSubstr("a touch at X5.000 Y3.000 Z-10.000, which lies 3.000 mm"));
}

TEST(LatchedPosition, MeasuresFromWhereTheAxesHaveComeToStand) {
  // The answer to the move tells no position: the engine asks for it.
  Adapter adapter(after({R"({"id":$,"end":"reached"})", R"({"id":$,"position":[0,0,-100]})",
                         R"({"id":$,"end":"touched","latched":[0,0,-107]})"}));
  auto machine = adapter.greet();
  ASSERT_TRUE(machine);
  EXPECT_EQ((*machine)->move(positions({0, 0, -100}), Feed::at(300)).end, MoveEnd::Reached);
  const auto result = (*machine)->measure({positions({0, 0, -110}), Feed::at(300)});
  EXPECT_EQ(result.end, MeasureEnd::Touched) << result.detail;
  EXPECT_EQ(result.latched, positions({0, 0, -107}));
}

TEST(LatchedPosition, CountsTurnsOfAnAxisWithoutEndStopsAsTheSamePlace) {
  const std::string turning =
      R"({"id":$,"protocol":1,"adapter":"test","machine":{"name":"m","axes":[{"name":"C","kind":"rotary","modulo":true}]},"position":[350]})";
  for (const auto& [latched, end] : {std::pair{"[5]", MeasureEnd::Touched},
                                     {"[365]", MeasureEnd::Touched},
                                     {"[352]", MeasureEnd::Touched},
                                     {"[20]", MeasureEnd::Refused},
                                     {"[180]", MeasureEnd::Refused}}) {
    Adapter adapter({turning, R"({"id":$,"end":"touched","latched":)" + std::string(latched) + "}"});
    auto machine = adapter.greet();
    ASSERT_TRUE(machine);
    EXPECT_EQ((*machine)->measure({positions({370}), Feed::at(300)}).end, end) << latched;
  }
}

}  // namespace
}  // namespace probewright::adapter
