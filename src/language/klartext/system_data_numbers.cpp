#include "language/klartext/system_data_numbers.hpp"

#include <algorithm>
#include <array>

namespace probewright::language::klartext {

using control::ControlKind;

namespace {

enum class On { Both, Older };

struct Group {
  int id;
  int first, last;  ///< numbers
  On on = On::Both;
};

constexpr int any = 1 << 30;

constexpr std::array readable = {Group{10, 3, 3},
                                 Group{10, 6, 8},
                                 Group{10, 110, 111},
                                 Group{15, 11, 13},
                                 Group{20, 1, 5},
                                 Group{20, 8, 11},
                                 Group{25, -any, any},
                                 Group{35, 1, 1},
                                 Group{50, 1, 11},
                                 Group{50, 13, 22},
                                 Group{50, 24, 26},
                                 Group{50, 28, 28},
                                 Group{50, 32, 32},
                                 Group{50, 34, 34},
                                 Group{50, 36, 37},
                                 Group{50, 40, 40},
                                 Group{60, 1, 9},
                                 Group{200, 1, 3},
                                 Group{200, 6, 6},
                                 Group{210, 1, 7},
                                 Group{210, 10, 10},
                                 Group{211, -any, any},
                                 Group{220, 2, 2},
                                 Group{230, 2, 3},
                                 Group{230, 5, 5},
                                 Group{240, -any, any},
                                 Group{270, -any, any},
                                 Group{280, 1, 1},
                                 Group{310, 116, 116},
                                 Group{310, 126, 126},
                                 Group{310, 128, 128},
                                 Group{310, 144, 144},
                                 Group{320, 1, 1},
                                 Group{320, 3, 3},
                                 Group{350, 10, 12},
                                 Group{350, 13, 13, On::Older},
                                 Group{350, 14, 15},
                                 Group{350, 20, 21, On::Older},
                                 Group{350, 50, 57},
                                 Group{360, 1, 4},
                                 Group{360, 10, 11},
                                 Group{500, -any, any},
                                 Group{501, -any, any, On::Older},
                                 Group{502, -any, any, On::Older},
                                 Group{503, -any, any, On::Older},
                                 Group{504, -any, any, On::Older},
                                 Group{505, -any, any},
                                 Group{507, -any, any},
                                 Group{508, -any, any},
                                 Group{530, 1, 2},
                                 Group{990, 1, 2},
                                 Group{990, 4, 4},
                                 Group{990, 6, 6},
                                 Group{990, 8, 8},
                                 Group{990, 10, 10},
                                 Group{992, 10, 11},
                                 Group{992, 14, 14},
                                 Group{992, 16, 16}};

constexpr std::array writable = {Group{50, 1, 6},
                                 Group{50, 9, 11},
                                 Group{50, 13, 17},
                                 Group{50, 19, 22},
                                 Group{50, 24, 26},
                                 Group{50, 28, 28},
                                 Group{50, 32, 32},
                                 Group{50, 36, 37},
                                 Group{50, 40, 40},
                                 Group{500, -any, any},
                                 Group{503, -any, any, On::Older},
                                 Group{507, -any, any},
                                 Group{508, -any, any},
                                 Group{990, -any, any}};

bool holds(const auto& groups, int id, int number, ControlKind kind) {
  if (id == 950) id = 50;
  return std::ranges::any_of(groups, [&](const Group& group) {
    const bool here = group.on == On::Both || kind != ControlKind::TNC640;
    return here && group.id == id && number >= group.first && number <= group.last;
  });
}

}  // namespace

bool canRead(int id, int number, ControlKind kind) { return holds(readable, id, number, kind); }

bool canWrite(int id, int number, ControlKind kind) { return holds(writable, id, number, kind); }

}  // namespace probewright::language::klartext
