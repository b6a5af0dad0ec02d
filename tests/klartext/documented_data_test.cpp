#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "klartext/expectations.hpp"
#include "klartext/host_world.hpp"
#include "language/klartext/system_data_numbers.hpp"

/// The table of FN 18 in docs/klartext.md against the control.
namespace probewright::language::klartext::testing {
namespace {

/// "1 to 3, 7" as numbers; empty if the cell names none.
std::set<int> numbersOf(const std::string& cell) {
  std::set<int> numbers;
  static const std::regex part("([0-9]+)(?: to ([0-9]+))?");
  for (std::sregex_iterator each(cell.begin(), cell.end(), part), end; each != end; ++each) {
    const int first = std::stoi((*each)[1]);
    const int last = (*each)[2].matched ? std::stoi((*each)[2]) : first;
    for (int number = first; number <= last; ++number)
      numbers.insert(number);
  }
  return numbers;
}

/// The documented data: NR by ID; an empty set: any NR.
std::map<int, std::set<int>> documented() {
  std::ifstream file(PROBEWRIGHT_SOURCE_DIR "/docs/klartext.md");
  std::map<int, std::set<int>> data;
  bool inside = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("| ID | NR |")) {
      inside = true;
    } else if (inside && !line.starts_with("|")) {
      break;
    } else if (inside && !line.starts_with("| ---")) {
      std::istringstream row(line.substr(1));
      std::string ids, numbers;
      std::getline(row, ids, '|');
      std::getline(row, numbers, '|');
      for (const int id : numbersOf(ids)) {
        std::set<int> found = numbersOf(numbers);
        if (numbers.find("as 50") != std::string::npos) found = data[50];
        data[id].merge(found);
      }
    }
  }
  return data;
}

bool known(int id, int number) {
  return canRead(id, number, {}, control::ControlKind::TNC640) ||
         canRead(id, number, {}, control::ControlKind::iTNC530);
}

TEST(DocumentedSystemData, AreThoseThatFn18Reads) {
  const auto data = documented();
  EXPECT_GE(data.size(), 30U);
  for (int id = 0; id <= 1100; ++id) {
    const auto row = data.find(id);
    const bool anyNumber = known(id, 9999);
    EXPECT_LE(anyNumber, row != data.end()) << "ID" << id;
    if (anyNumber) continue;
    for (int number = 0; number <= 200; ++number) {
      const bool named = row != data.end() && (row->second.empty() || row->second.contains(number));
      EXPECT_EQ(known(id, number), named) << "ID" << id << " NR" << number;
    }
  }
}

TEST(DocumentedSystemData, AreReadByTheRunWhereItIsSaid) {
  // Groups that need no table, file or touch: the run reads each documented NR.
  for (const int id : {20, 25, 35, 60, 210, 211, 280, 310, 320, 505, 530}) {
    const auto data = documented();
    for (const int number : data.at(id).empty() ? std::set<int>{1} : data.at(id)) {
      World world;
      const auto result = world.run("TOOL CALL 5 Z S1200\nFN 18: SYSREAD Q1 = ID" + std::to_string(id) + " NR" +
                                    std::to_string(number) + " IDX1");
      EXPECT_EQ(result.end, RunEnd::Finished) << "ID" << id << " NR" << number;
    }
  }
}

}  // namespace
}  // namespace probewright::language::klartext::testing
