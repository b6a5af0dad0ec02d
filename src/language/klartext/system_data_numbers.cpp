#include "language/klartext/system_data_numbers.hpp"

#include <algorithm>
#include <array>

namespace probewright::language::klartext {

using control::ControlKind;

namespace {

enum class On { Both, Older };

struct Range {
  int first, last;
  bool holds(int value) const { return value >= first && value <= last; }
};

constexpr int any = 1 << 30;
constexpr Range anyIndex = {-any, any};
constexpr Range axes = {1, 9};  ///< X Y Z A B C U V W
constexpr Range linearAxes = {1, 3};
constexpr Range shiftsAndAngles = {1, 6};  ///< X Y Z and the angles about them
constexpr Range rotaryAxes = {4, 6};
constexpr Range parameters = {0, 1999};  ///< Q, QS
constexpr Range fewParameters = {0, 499};

struct Group {
  int id;
  int first, last;  ///< numbers
  On on = On::Both;
  Range indices = anyIndex;
};

constexpr std::array readable = {Group{10, 3, 3},
                                 Group{10, 6, 7},
                                 Group{10, 8, 8, On::Both, {1, 2}},
                                 Group{10, 110, 110, On::Both, parameters},
                                 Group{10, 111, 111},
                                 Group{15, 11, 11, On::Both, parameters},
                                 Group{15, 12, 13, On::Both, fewParameters},
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
                                 Group{210, 1, 4},
                                 Group{210, 5, 5, On::Both, linearAxes},
                                 Group{210, 6, 7},
                                 Group{210, 10, 10},
                                 Group{211, -any, any},
                                 Group{220, 2, 2, On::Both, axes},
                                 Group{230, 2, 3, On::Both, axes},
                                 Group{230, 5, 5},
                                 Group{240, -any, any, On::Both, axes},
                                 Group{270, -any, any, On::Both, axes},
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
                                 Group{350, 20, 20, On::Older, linearAxes},
                                 Group{350, 21, 21, On::Older},
                                 Group{350, 50, 57},
                                 Group{360, 1, 4, On::Both, axes},
                                 Group{360, 10, 11},
                                 Group{500, 0, any, On::Both, axes},
                                 Group{501, 0, any, On::Older, axes},
                                 Group{502, 0, any, On::Older, axes},
                                 Group{503, 0, any, On::Older, axes},
                                 Group{504, 0, any, On::Older},
                                 Group{505, -any, any},
                                 Group{507, 0, any, On::Both, shiftsAndAngles},
                                 Group{508, 0, any, On::Both, axes},
                                 Group{530, 1, 1},
                                 Group{530, 2, 2, On::Both, {0, any}},
                                 Group{990, 1, 2},
                                 Group{990, 4, 4},
                                 Group{990, 6, 6},
                                 Group{990, 8, 8},
                                 Group{990, 10, 10, On::Both, parameters},
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
                                 Group{500, 0, any, On::Both, axes},
                                 Group{503, 0, any, On::Older, shiftsAndAngles},
                                 Group{507, 0, any, On::Both, shiftsAndAngles},
                                 Group{508, 0, any, On::Both, rotaryAxes},
                                 Group{990, -any, any}};

bool holds(const auto& groups, int id, int number, std::optional<int> index, ControlKind kind) {
  if (id == 950) id = 50;
  return std::ranges::any_of(groups, [&](const Group& group) {
    const bool here = group.on == On::Both || kind != ControlKind::TNC640;
    return here && group.id == id && number >= group.first && number <= group.last &&
           (!index || group.indices.holds(*index));
  });
}

}  // namespace

bool canRead(int id, int number, std::optional<int> index, ControlKind kind) {
  return holds(readable, id, number, index, kind);
}

bool canWrite(int id, int number, std::optional<int> index, ControlKind kind) {
  return holds(writable, id, number, index, kind);
}

}  // namespace probewright::language::klartext
