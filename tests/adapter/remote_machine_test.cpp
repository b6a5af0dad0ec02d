#include "adapter/remote_machine.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <deque>
#include <functional>
#include <thread>

#include "adapter/answering_adapter.hpp"
#include "support/axis_positions.hpp"

/// What the engine makes of adapters that break, lie or fall silent. The promises of a machine that works are tested in
/// tests/setup/machine_contract_test.cpp.
namespace probewright::adapter {
namespace {

using machine::Feed;
using machine::FunctionEnd;
using machine::MeasureEnd;
using machine::MoveEnd;
using machine::Sensor;
using machine::ToolChangeEnd;
using testing::HasSubstr;
using testing_support::positions;
using testing_support::streamPair;

TEST(RemoteMachine, LearnsTheMachineFromItsAdapter) {
  Adapter adapter(after({}));
  const auto machine = adapter.greet();
  ASSERT_TRUE(machine) << format(machine.error());
  EXPECT_EQ((*machine)->adapterName(), "test");
  EXPECT_EQ((*machine)->description().name, "m");
  EXPECT_EQ((*machine)->description().axes.size(), 3u);
  EXPECT_TRUE((*machine)->hasFunction(8));
  EXPECT_FALSE((*machine)->hasFunction(9));
  // Without chains the linear axes carry the tool.
  const Pose spindle = machine::baseFromSpindle((*machine)->description(), positions({1, 2, 3}));
  EXPECT_EQ(spindle.translation(), Vector3(1, 2, 3));
}

TEST(RemoteMachine, RefusesAdaptersThatGreetWrongly) {
  const std::string axes = R"([{"name":"X","kind":"linear"}])";
  const std::vector<std::pair<std::string, std::string>> greetings = {
      {"{}", "\"id\" is missing"},
      {R"({"id":$})", "\"protocol\" is missing"},
      {R"({"id":$,"protocol":2,"adapter":"a"})", "speaks version 2 of the protocol, this program version 1"},
      {R"({"id":$,"end":"failed","detail":"emergency stop"})", "the machine is not ready: emergency stop"},
      {R"({"id":$,"protocol":1,"adapter":"a","position":[0]})", "\"machine\" is missing"},
      {R"({"id":$,"protocol":1,"adapter":"a","machine":{"name":"m","axes":[]},"position":[]})", "1 to 9 axes"},
      {R"({"id":$,"protocol":1,"adapter":"a","machine":{"name":"m","axes":)" + axes + R"(},"position":[0,0]})",
       "1 numbers"},
      {R"({"id":$,"protocol":1,"adapter":"a","machine":{"name":"m","axes":[{"name":"X","kind":"round"}]},"position":[0]})",
       "\"round\" is not a word"},
      {R"({"id":$,"protocol":1,"adapter":"a","machine":{"name":"m","axes":)" + axes +
           R"(,"tableChain":[{"axis":"Q"}]},"position":[0]})",
       "there is no axis Q"},
      {R"({"id":$,"protocol":1,"adapter":"a","machine":{"name":"m","axes":)" + axes +
           R"(,"spindleChain":[{"axis":"X","direction":[2,0,0]}]},"position":[0]})",
       "has not the length 1"},
      {R"({"id":$,"protocol":1,"adapter":"a","machine":{"name":"m","axes":)" + axes +
           R"(},"functions":["8"],"position":[0]})",
       "list of whole numbers"},
      {"hang up", "the connection to the machine adapter is lost"},
      {"not JSON", "not a JSON object"},
  };
  for (const auto& [line, message] : greetings) {
    Adapter adapter({line});
    const auto machine = adapter.greet();
    ASSERT_FALSE(machine) << line;
    EXPECT_THAT(machine.error().message, HasSubstr(message)) << line;
    EXPECT_FALSE(machine.error().advice.empty()) << line;
  }
}

/// Every kind of order, and whether it was refused.
struct Order {
  const char* name;
  std::function<bool(machine::Machine& machine, std::string& detail)> refused;
};
template <class Outcome, class End>
bool refusedWith(const Outcome& result, End end, std::string& detail) {
  detail = result.detail;
  return result.end == end;
}
std::vector<Order> orders() {
  const auto target = positions({1, 0, 0});
  const Feed feed = Feed::at(100);
  return {
      {"move", [=](auto& m, auto& d) { return refusedWith(m.move(target, feed), MoveEnd::Refused, d); }},
      {"retract", [=](auto& m, auto& d) { return refusedWith(m.retract(target, feed), MoveEnd::Refused, d); }},
      {"path",
       [=](auto& m, auto& d) {
         const std::vector<machine::PathPiece> path = {{target, feed}};
         return refusedWith(m.moveAlong(path), MoveEnd::Refused, d);
       }},
      {"measure",
       [=](auto& m, auto& d) {
         return refusedWith(m.measure({target, feed}), MeasureEnd::Refused, d);
       }},
      {"turnSpindle",
       [=](auto& m, auto& d) {
         return refusedWith(m.turnSpindle(machine::Rotation::Clockwise, 100), MoveEnd::Refused, d);
       }},
      {"orientSpindle", [=](auto& m, auto& d) { return refusedWith(m.orientSpindle(90), MoveEnd::Refused, d); }},
      {"function", [=](auto& m, auto& d) { return refusedWith(m.function(8), FunctionEnd::Refused, d); }},
      {"changeTool",
       [=](auto& m, auto& d) {
         return refusedWith(m.changeTool({1, ""}), ToolChangeEnd::Refused, d);
       }},
  };
}

TEST(RemoteMachine, SaysWhyEachOrderIsRefusedWhenTheMachineFails) {
  for (const Order& order : orders()) {
    Adapter adapter(after({R"({"id":$,"end":"failed","detail":"emergency stop","position":[0,0,-7]})"}));
    auto machine = adapter.greet();
    ASSERT_TRUE(machine);
    std::string detail;
    EXPECT_TRUE(order.refused(**machine, detail)) << order.name;
    EXPECT_EQ(detail, "emergency stop") << order.name;
    EXPECT_EQ((*machine)->failure(), "emergency stop") << order.name;
    EXPECT_EQ((*machine)->position(), positions({0, 0, -7})) << order.name;
  }
}

TEST(RemoteMachine, EveryOrderIsRefusedOnceTheConnectionIsLost) {
  for (const Order& first : orders()) {
    Adapter adapter(after({R"({"alive":$})", "hang up"}));
    auto machine = adapter.greet(Patience{std::chrono::milliseconds(200)});
    ASSERT_TRUE(machine);
    (*machine)->deflected(Sensor::TouchProbe);  // gets no answer
    std::string detail;
    EXPECT_TRUE(first.refused(**machine, detail)) << first.name;
    EXPECT_THAT(detail, HasSubstr("adapter")) << first.name;
    for (const Order& then : orders()) {
      EXPECT_TRUE(then.refused(**machine, detail)) << first.name << ", then " << then.name;
      EXPECT_EQ(detail, *(*machine)->failure());
    }
    EXPECT_EQ((*machine)->position(), positions({0, 0, 0}));
    EXPECT_FALSE((*machine)->deflected(Sensor::TouchProbe));
  }
}

TEST(RemoteMachine, AnswersThatAreNotOfTheProtocolEndTheConnection) {
  const std::vector<std::string> answers = {"",
                                            "[]",
                                            "{",
                                            R"({"id":0,"end":"reached"})",
                                            R"({"id":"$","end":"reached"})",
                                            R"({"id":$})",
                                            R"({"id":$,"end":"somehow"})",
                                            R"({"id":$,"end":7})",
                                            R"({"id":$,"end":"reached","position":[1,2]})",
                                            R"({"id":$,"end":"reached","position":[1,2,"3"]})",
                                            R"({"id":$,"end":"reached","position":[1,2,null]})",
                                            R"({"id":$,"end":"failed","detail":[]})",
                                            R"({"id":$,"end":"reached","detail":5})",
                                            "\xff\xfe"};
  for (const std::string& answer : answers) {
    Adapter adapter(after({answer}));
    auto machine = adapter.greet();
    ASSERT_TRUE(machine);
    const auto moved = (*machine)->move(positions({1, 0, 0}), Feed::rapidTraverse());
    EXPECT_EQ(moved.end, MoveEnd::Refused) << answer;
    EXPECT_THAT(moved.detail, HasSubstr("does not keep to the protocol")) << answer;
  }
  Adapter adapter(after({R"({"id":$,"end":"touched"})"}));
  auto machine = adapter.greet();
  ASSERT_TRUE(machine);
  EXPECT_EQ((*machine)->measure({positions({1, 0, 0}), Feed::at(1)}).end, MeasureEnd::Refused)
      << "a touch without a position";
  Adapter further(after({R"({"id":$,"end":"reached","reached":2})"}));
  machine = further.greet();
  ASSERT_TRUE(machine);
  const std::vector<machine::PathPiece> path = {{positions({1, 0, 0}), Feed::at(1)}};
  EXPECT_EQ((*machine)->moveAlong(path).end, MoveEnd::Refused) << "further than the path goes";
}

TEST(RemoteMachine, WaitsAsLongAsTheAdapterIsAlive) {
  auto [engine, own] = streamPair();
  std::jthread adapter([stream = std::move(own)]() mutable {
    std::string line;
    stream.receive(line, std::chrono::seconds(5));
    stream.send(R"({"id":1,)" + std::string(greeting) + "}");
    stream.receive(line, std::chrono::seconds(5));
    for (int i = 0; i < 6; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      stream.send(R"({"alive":2})");
    }
    stream.send(R"({"id":2,"end":"reached","position":[1,0,0]})");
    stream.receive(line, std::chrono::seconds(5));  // the next order gets no sign of life
    stream.receive(line, std::chrono::seconds(5));
  });
  auto machine = RemoteMachine::greet({nullptr, std::move(engine)}, Patience{std::chrono::milliseconds(400)});
  ASSERT_TRUE(machine);
  EXPECT_EQ((*machine)->move(positions({1, 0, 0}), Feed::at(100)).end, MoveEnd::Reached);
  const auto moved = (*machine)->move(positions({2, 0, 0}), Feed::at(100));
  EXPECT_EQ(moved.end, MoveEnd::Refused);
  EXPECT_EQ(moved.detail, "the machine adapter has said nothing for 0.4 s");
}

TEST(RemoteMachine, HasTheAdapterAskTheOperatorWhereItCan) {
  Adapter quiet(after({}));
  auto machine = quiet.greet();
  ASSERT_TRUE(machine);
  EXPECT_FALSE((*machine)->asks());
  Adapter adapter({R"({"id":$,"asks":true,)" + std::string(greeting) + "}", R"({"id":$,"end":"continued"})",
                   R"({"id":$,"end":"cancelled"})"});
  machine = adapter.greet();
  ASSERT_TRUE(machine);
  EXPECT_TRUE((*machine)->asks());
  EXPECT_TRUE((*machine)->ask("Clean the ball"));
  EXPECT_FALSE((*machine)->ask("Clean the ball"));
}

TEST(RemoteMachine, HasTheAdapterAnswerQuestionsWhereItCan) {
  Adapter quiet(after({}));
  auto machine = quiet.greet();
  ASSERT_TRUE(machine);
  EXPECT_FALSE((*machine)->answers());
  Adapter adapter({R"({"id":$,"answers":true,)" + std::string(greeting) + "}",
                   R"({"id":$,"end":"answered","text":"1 2 3"})", R"({"id":$,"end":"unanswered"})",
                   R"({"id":$,"end":"cancelled"})", R"({"id":$,"end":"perhaps"})"});
  machine = adapter.greet();
  ASSERT_TRUE(machine);
  EXPECT_TRUE((*machine)->answers());
  const auto given = (*machine)->answer("1410 point 1", "a position");
  ASSERT_TRUE(given);
  EXPECT_EQ(given->text, "1 2 3");
  EXPECT_FALSE(given->cancelled);
  EXPECT_FALSE((*machine)->answer("1410 point 1", "a position"));
  EXPECT_TRUE((*machine)->answer("1410 point 1", "a position")->cancelled);
  // What is no answer of the protocol ends the connection, and with it the program.
  EXPECT_TRUE((*machine)->answer("1410 point 1", "a position")->cancelled);
  EXPECT_THAT((*machine)->failure().value_or(""), HasSubstr("does not keep to the protocol"));
}

TEST(RemoteMachine, SharesTheTablesOfAnAdapterThatTellsThem) {
  const std::string tables =
      R"("tables":{"offsets":[{"number":1,"origin":[1,2,-3],"rotation":4}],"tools":[{"number":2,"length":80,"diameter":10}]},)";
  Adapter adapter({R"({"id":$,)" + tables + std::string(greeting) + "}", R"({"id":$,"end":"kept"})",
                   R"({"id":$,"end":"refused","detail":"not now"})"});
  auto machine = adapter.greet();
  ASSERT_TRUE(machine);
  ASSERT_NE((*machine)->tables(), nullptr);
  const machine::OwnTables& own = *(*machine)->tables();
  ASSERT_EQ(own.offsets.size(), 1U);
  EXPECT_EQ(own.offsets[0].origin[2], -3);
  EXPECT_EQ(own.offsets[0].rotation, 4);
  ASSERT_EQ(own.tools.size(), 1U);
  EXPECT_EQ(own.tools[0].length, 80);
  EXPECT_EQ((*machine)->keep(own), std::nullopt);
  EXPECT_EQ((*machine)->keep(own), "not now");
}

TEST(RemoteMachine, SendsLinesManyAtATimeToAnAdapterThatLooksAhead) {
  auto [engine, own] = streamPair();
  std::vector<Json> heard;
  std::jthread thread([&heard, stream = std::move(own)]() mutable {
    std::string line;
    while (stream.receive(line, std::chrono::milliseconds(5000)) == LineStream::Got::Line) {
      const Json json = parseLine(line);
      heard.push_back(json);
      Json answer = {{"id", json.at("id")}, {"end", "reached"}};
      if (json.at("do") == "hello") {
        answer = Json::parse("{" + std::string(greeting) + "}");
        answer["id"] = json.at("id");
        answer["looksAhead"] = true;
        answer["machine"]["axes"][0]["maximum"] = 100;
      }
      if (json.at("do") == "path") answer["reached"] = json.at("pieces").size();
      if (json.at("do") == "move" && json.at("target")[0] > 100) answer["end"] = "axisLimit";
      if (json.at("do") == "deflected") answer["deflected"] = false;
      if (!stream.send(answer.dump())) return;
    }
  });
  {
    auto machine = RemoteMachine::greet({nullptr, std::move(engine)});
    ASSERT_TRUE(machine);
    std::uint64_t line = 0;
    (*machine)->accompany([&] { return machine::OrderPlace{++line, {}, {0, 0, 0}, 0}; });
    for (int i = 1; i <= 50; ++i)
      EXPECT_EQ((*machine)->move(positions({1.0 * i, 0, 0}), Feed::at(100)).end, MoveEnd::Reached);
    EXPECT_EQ((*machine)->position()[0], 50);
    EXPECT_FALSE((*machine)->deflected(Sensor::TouchProbe));
    // The first after another order is by itself, as it may not begin; so is one that will be refused.
    EXPECT_EQ((*machine)->move(positions({2, 0, 0}), Feed::at(100)).end, MoveEnd::Reached);
    EXPECT_EQ((*machine)->move(positions({3, 0, 0}), Feed::at(100)).end, MoveEnd::Reached);
    EXPECT_EQ((*machine)->move(positions({200, 0, 0}), Feed::at(100)).end, MoveEnd::AxisLimit);
  }
  thread.join();
  std::vector<std::string> orders;
  for (const Json& each : heard)
    orders.push_back(each.at("do"));
  EXPECT_THAT(orders, testing::ElementsAre("hello", "move", "path", "deflected", "move", "path", "move"));
  EXPECT_EQ(heard.at(2).at("pieces").size(), 49U);
  EXPECT_EQ(heard.at(2).at("pieces").at(0).at("line"), 2);
}

/// Many lines are sent at a time, up to a limit; every line is sent once, in its order.
class ManyLines : public testing::TestWithParam<bool> {};

TEST_P(ManyLines, AreSentInLongMessages) {
  const bool compact = GetParam();
  auto [engine, own] = streamPair();
  std::vector<double> travelled;
  std::vector<std::size_t> messages;
  std::jthread thread([&, stream = std::move(own)]() mutable {
    std::string line;
    while (stream.receive(line, std::chrono::milliseconds(5000)) == LineStream::Got::Line) {
      const Json json = parseLine(line);
      Json answer = {{"id", json.at("id")}, {"end", "reached"}};
      if (json.at("do") == "hello") {
        answer = Json::parse("{" + std::string(greeting) + "}");
        answer["id"] = json.at("id");
        answer["looksAhead"] = true;
        answer["compact"] = compact;
      }
      if (json.at("do") == "move") travelled.push_back(json.at("target")[0]);
      if (json.at("do") == "path") {
        EXPECT_EQ(json.contains("lines"), compact);
        const std::size_t before = travelled.size();
        for (const Json& piece : json.value("pieces", Json::array())) {
          EXPECT_EQ(piece.at("feed"), 100);
          travelled.push_back(piece.at("target")[0]);
        }
        const std::vector<double> numbers = json.value("lines", std::vector<double>());
        for (std::size_t i = 0; i < numbers.size(); i += 5) {
          EXPECT_EQ(numbers[i + 1], 100);
          travelled.push_back(numbers[i + 2]);
        }
        messages.push_back(travelled.size() - before);
        answer["reached"] = messages.back();
      }
      if (json.at("do") == "deflected") answer["deflected"] = false;
      if (!stream.send(answer.dump())) return;
    }
  });
  constexpr int lines = 20'000;
  {
    auto machine = RemoteMachine::greet({nullptr, std::move(engine)});
    ASSERT_TRUE(machine);
    for (int i = 1; i <= lines; ++i)
      ASSERT_EQ((*machine)->move(positions({0.001 * i, 0, 0}), Feed::at(100)).end, MoveEnd::Reached);
    EXPECT_FALSE((*machine)->deflected(Sensor::TouchProbe));
  }
  thread.join();
  ASSERT_EQ(travelled.size(), static_cast<std::size_t>(lines));
  EXPECT_TRUE(std::ranges::is_sorted(travelled));
  EXPECT_LT(messages.size(), lines / 10U);
  EXPECT_LE(*std::ranges::max_element(messages), 1024U);
}

INSTANTIATE_TEST_SUITE_P(Adapters, ManyLines, testing::Bool(),
                         [](const auto& test) { return test.param ? "Compact" : "AsPieces"; });

TEST(RemoteMachine, TellsTheLineOfTheProgramWithEachOrder) {
  auto [engine, own] = streamPair();
  std::jthread thread([stream = std::move(own)]() mutable {
    std::string line;
    for (int order = 0; order < 2; ++order) {
      if (stream.receive(line, std::chrono::milliseconds(5000)) != LineStream::Got::Line) return;
      const Json json = parseLine(line);
      Json answer = Json::parse("{" + std::string(greeting) + "}");
      answer["id"] = json.at("id");
      if (order == 1) answer = {{"id", json.at("id")}, {"end", "reached"}, {"detail", json.dump()}};
      stream.send(answer.dump());
    }
  });
  auto machine = RemoteMachine::greet({nullptr, std::move(engine)});
  ASSERT_TRUE(machine);
  (*machine)->accompany([] { return machine::OrderPlace{17, {"look"}, {0, 0, 100}, 3}; });
  const auto moved = (*machine)->move(positions({1, 0, 0}), Feed::at(100));
  EXPECT_THAT(moved.detail, testing::AllOf(HasSubstr(R"("line":17)"), HasSubstr(R"("messages":["look"])")));
}

TEST(RemoteMachine, HandsAStopToTheAdapterAndWaitsForTheAxesToStand) {
  auto [engine, own] = streamPair();
  std::stop_source source;
  std::string stop;
  std::jthread adapter([&, stream = std::move(own)]() mutable {
    std::string line;
    stream.receive(line, std::chrono::seconds(5));
    stream.send(R"({"id":1,)" + std::string(greeting) + "}");
    stream.receive(line, std::chrono::seconds(5));
    source.request_stop();
    stream.receive(stop, std::chrono::seconds(5));
    stream.send(R"({"id":2,"end":"cancelled","position":[0.5,0,0]})");
    stream.receive(line, std::chrono::seconds(5));
    stream.send(R"({"id":3,"end":"reached"})");
  });
  auto machine = RemoteMachine::greet({nullptr, std::move(engine)});
  ASSERT_TRUE(machine);
  (*machine)->stopOn(source.get_token());
  EXPECT_EQ((*machine)->move(positions({1, 0, 0}), Feed::at(100)).end, MoveEnd::Cancelled);
  EXPECT_EQ((*machine)->position(), positions({0.5, 0, 0}));
  EXPECT_EQ((*machine)->move(positions({2, 0, 0}), Feed::at(100)).end, MoveEnd::Cancelled);
  EXPECT_EQ((*machine)->turnSpindle(machine::Rotation::None, 0).end, MoveEnd::Reached);
  adapter.join();
  EXPECT_EQ(Json::parse(stop), (Json{{"do", "stop"}, {"order", 2}}));
}

/// Sockets that the program was started with begin after standard input, output and errors.
TEST(Connection, TakesAnOpenSocketFromTheThirdDescriptorOn) {
  for (const int number : {2, 3, 4}) {
    std::array<int, 2> ends{};
    ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()), 0);
    const int before = fcntl(number, F_DUPFD_CLOEXEC, 100), far = fcntl(ends[1], F_DUPFD_CLOEXEC, 100);
    const int near = fcntl(ends[0], F_DUPFD_CLOEXEC, 100);
    for (const int end : ends)
      if (end != number) close(end);
    dup2(near, number);
    close(near);
    {
      auto connection = connect("fd:" + std::to_string(number));
      EXPECT_EQ(connection.has_value(), number >= 3) << number;
      if (connection) {
        connection->stream.send("hello");
        std::array<char, 16> heard{};
        EXPECT_EQ(read(far, heard.data(), heard.size()), 6);
        EXPECT_STREQ(heard.data(), "hello\n");
      }
    }
    if (before >= 0) {
      dup2(before, number);
      close(before);
    } else if (number < 3) {
      close(number);
    }
    close(far);
  }
}

TEST(Connection, NamesWhatCannotBeReached) {
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {"fd:1000", "fd:1000 is not an open socket"},
      {"fd:x", "fd:x is not an open socket"},
      {"no-such-program-anywhere", "cannot be started: No such file"},
      {"  ", "has no name"},
  };
  for (const auto& [where, message] : wrong) {
    const auto connection = connect(where);
    ASSERT_FALSE(connection) << where;
    EXPECT_THAT(connection.error().message, HasSubstr(message));
  }
  auto connection = connect("true");
  ASSERT_TRUE(connection);
  const auto machine = RemoteMachine::greet(std::move(*connection));
  ASSERT_FALSE(machine);
  EXPECT_THAT(machine.error().message, HasSubstr("the connection to the machine adapter is lost"));
}

}  // namespace
}  // namespace probewright::adapter
