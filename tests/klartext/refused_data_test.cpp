#include <fmt/format.h>
#include <gtest/gtest.h>

#include "control/heidenhain/datum_table.hpp"
#include "klartext/host_world.hpp"
#include "language/klartext/check.hpp"

/// FN 17 and FN 18 with numbers: what the run refuses, check names before it, and nothing else.
namespace probewright::language::klartext::testing {
namespace {

using control::ControlKind;

bool isNamed(const std::string& block, ControlKind kind) {
  KlartextProgram program("a.h", "0 BEGIN PGM A MM\n1 " + block + "\n2 END PGM A MM\n");
  const Diagnostics found = checkProgram(program, kind);
  EXPECT_LE(found.size(), 1U) << block;
  return !found.empty();
}

/// A world in which everything can be read that a program may have: a tool, a touch, a datum table, two presets.
World fullWorld(ControlKind kind) {
  World world("mill5-table-table", kind);
  world.control->tables.datums.emplace("D.D", control::heidenhain::defaultDatumTable(kind));
  world.control->activeDatumTable = "D.D";
  control::CycleRecord cycle;
  cycle.touches.emplace_back();
  cycle.touches.back().outcome = "touched";
  world.control->journal.cycles.push_back(cycle);
  return world;
}

bool isRefused(const std::string& block, ControlKind kind) {
  World world = fullWorld(kind);
  const RunResult result = world.run("TOOL CALL 1 Z\n" + block + "\n");
  return !result.diagnostics.empty();
}

/// IDX 4 to 9 are axes that a machine may lack, and rows that a table may lack are in the run's hands.
std::vector<int> indices(int id) {
  if (id == 50 || id == 950) return {0, 1};
  return {-1, 0, 1, 2, 3, 4, 6, 10, 499, 500, 1999, 2000};
}

bool dependsOnTables(int id, int number, int index) {
  if (id == 200 && number == 6) return index > 1;
  if (id == 530 && number == 2) return index > 1;
  return id >= 500 && id <= 508 && number > 0;
}

TEST(RefusedData, ReadIsNamedByTheCheck) {
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    for (const int id : {10,  15,  20,  25,  35,  50,  60,  200, 210, 211, 220, 230, 240, 270, 280, 310, 320,
                         350, 360, 500, 501, 502, 503, 504, 505, 507, 508, 530, 950, 990, 992, 1,   999}) {
      for (const int number : {-1, 0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 12, 13, 14, 15,  16,  17,
                               18, 19, 20, 21, 24, 26, 28, 32, 34, 36, 37, 40, 50, 54, 57, 58, 110, 111, 116}) {
        for (const int index : indices(id)) {
          if (dependsOnTables(id, number, index)) continue;
          const std::string block = fmt::format("FN 18: SYSREAD Q1 = ID{} NR{} IDX{}", id, number, index);
          EXPECT_EQ(isNamed(block, kind), isRefused(block, kind)) << block << " " << control::name(kind);
        }
        if (dependsOnTables(id, number, 0)) continue;
        const std::string block = fmt::format("FN 18: SYSREAD Q1 = ID{} NR{}", id, number);
        EXPECT_EQ(isNamed(block, kind), isRefused(block, kind)) << block << " " << control::name(kind);
      }
    }
  }
}

TEST(RefusedData, WrittenIsNamedByTheCheck) {
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    for (const int id : {20, 50, 270, 500, 503, 507, 508, 950, 990}) {
      for (const int number : {-1, 0, 1, 2, 4, 6, 7, 12, 13, 18, 34, 36, 41}) {
        for (const int index : indices(id)) {
          for (const int value : {0, 1, 21}) {
            // These tables of the older control have no column TYP and one angle, that about the tool axis.
            const bool older = kind == ControlKind::iTNC530;
            if (older && ((number == 36 && value == 1) || (id == 507 && index == 4))) continue;
            const std::string block = fmt::format("FN 17: SYSWRITE ID{} NR{} IDX{} = {:+}", id, number, index, value);
            EXPECT_EQ(isNamed(block, kind), isRefused(block, kind)) << block << " " << control::name(kind);
          }
        }
      }
    }
  }
}

/// All tables as their files.
std::string tablesOf(World& world) {
  auto& tables = world.control->tables;
  return tables.tools.table().bytes() + tables.presets.table().bytes() + tables.datums.at("D.D").table().bytes();
}

/// A row that is missing, a column that is missing, a value for which the column has no room.
TEST(RefusedData, WritesNothingAtAll) {
  int refused = 0;
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    World untouched = fullWorld(kind);
    ASSERT_TRUE(untouched.run("TOOL CALL 1 Z\n").diagnostics.empty());
    const std::string before = tablesOf(untouched);
    for (const int id : {50, 500, 503, 507, 508}) {
      for (const int number : {1, 7, 36, 87}) {
        for (const int index : {0, 1, 3, 4, 5, 6, 9}) {
          for (const char* value : {"+1", "-999999999", "+999999999.999999"}) {
            const std::string block = fmt::format("FN 17: SYSWRITE ID{} NR{} IDX{} = {}", id, number, index, value);
            World world = fullWorld(kind);
            if (world.run("TOOL CALL 1 Z\n" + block + "\n").diagnostics.empty()) continue;
            ++refused;
            EXPECT_EQ(tablesOf(world), before) << block << " " << control::name(kind);
          }
        }
      }
    }
  }
  EXPECT_GT(refused, 300);
}

/// What only the run knows is not named.
TEST(RefusedData, ComputedIsLeftToTheRun) {
  for (const char* block : {"FN 17: SYSWRITE ID50 NR36 IDX1 = Q1", "FN 18: SYSREAD Q1 = ID270 NR1 IDXQ2",
                            "FN 18: SYSREAD Q1 = ID220 NR2 IDX-Q2", "FN 17: SYSWRITE ID507 NR1 IDXQ5 = +1"})
    EXPECT_FALSE(isNamed(block, ControlKind::TNC640)) << block;
}

}  // namespace
}  // namespace probewright::language::klartext::testing
