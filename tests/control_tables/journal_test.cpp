#include "control/journal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "control/alarm.hpp"

namespace probewright::control {
namespace {

TEST(EventList, GivesBackWhatWasEntered) {
  std::mt19937 random(7);
  EventList list;
  std::vector<EventRecord> entered;
  for (int i = 0; i < 5000; ++i) {
    // Also texts longer than the blocks they are kept in, and with any byte.
    const std::size_t size = i % 1000 == 999 ? 100'000 : random() % 60;
    entered.push_back({static_cast<EventKind>(random() % 6),
                       {"file" + std::to_string(random() % 3), random() % 1'000'000'000'000ULL,
                        static_cast<std::uint32_t>(random() % 80)},
                       i % 2 == 0 ? "" : std::to_string(random() % 5),
                       std::string(size, static_cast<char>(random())),
                       static_cast<double>(i) / 7});
    list.push_back(entered.back());
  }
  // A copy goes on by itself.
  EventList copy = list;
  copy.push_back({EventKind::Stop, {}, "", "only in the copy", 0});
  list.push_back({EventKind::Alarm, {}, "", "only in the list", 0});
  ASSERT_EQ(list.size(), 5001U);
  EXPECT_EQ(copy.back().text, "only in the copy");
  EXPECT_EQ(list.back().text, "only in the list");
  for (std::size_t i = 0; i < entered.size(); ++i) {
    const EventRecord event = list[i];
    ASSERT_EQ(event.kind, entered[i].kind);
    ASSERT_EQ(event.place.file, entered[i].place.file);
    ASSERT_EQ(event.place.line, entered[i].place.line);
    ASSERT_EQ(event.place.column, entered[i].place.column);
    ASSERT_EQ(event.code, entered[i].code);
    ASSERT_EQ(event.text, entered[i].text);
    ASSERT_EQ(event.seconds, entered[i].seconds);
  }
  EXPECT_EQ(std::ranges::count(list, EventKind::Alarm, &EventRecord::kind),
            1 + std::ranges::count(entered, EventKind::Alarm, &EventRecord::kind));
}

TEST(Journal, IsFullOnce) {
  Journal journal;
  journal.limit = 10'000;
  std::size_t entered = 0;
  const auto fill = [&] {
    for (;; ++entered)
      journal.event({EventKind::Message, {"a.mpf", 1, 1}, "", std::string(50, 'x'), 0});
  };
  EXPECT_THROW(fill(), RecordFull);
  EXPECT_EQ(journal.events.size(), entered) << "the last one is not in it";
  EXPECT_GT(entered, 50U);
  EXPECT_LT(entered, 200U);
  // What ends the run may still be said.
  journal.event({EventKind::Alarm, {}, "", "the end", 0});
  EXPECT_EQ(journal.events.back().text, "the end");
}

TEST(Journal, CountsWritesTouchesAndCycles) {
  const auto filled = [](auto enter) {
    Journal journal;
    journal.limit = 100'000;
    try {
      for (std::size_t count = 0;; ++count) {
        if (count > 10'000) return false;
        enter(journal);
      }
    } catch (const RecordFull&) {
      return true;
    }
  };
  EXPECT_TRUE(filled([](Journal& journal) { journal.write({"$TC_DP3", "[9,1]", "1", "2"}); }));
  EXPECT_TRUE(filled([](Journal& journal) {
    CycleRecord cycle;
    cycle.results.resize(3);
    journal.begin(cycle);
    journal.touch({});
  }));
  EXPECT_TRUE(filled([](Journal& journal) { journal.charge(100); }));
}

}  // namespace
}  // namespace probewright::control
