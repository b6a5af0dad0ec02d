#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

/// A plate of 100,000 triangles and programs that measure it with a mixture of cycles: for tests and benchmarks of
/// whole runs.
namespace probewright::mixed {

/// A binary STL: a plate 100 x 100 x 40 mm around the origin of its bottom face, with a hole of 40 mm diameter (a
/// polygon of 400 sides) in the middle. 100,000 triangles.
inline std::string plateStl() {
  constexpr int sides = 400, topRings = 60, bottomRings = 5, holeRows = 30, wallRows = 30;
  constexpr double height = 40, half = 50, radius = 20;
  struct Point {
    double x, y, z;
  };
  // From the hole (0) to the edge (1) of the plate.
  const auto at = [&](int side, double share, double z) {
    const double angle = 2 * std::numbers::pi * (side % sides) / sides, c = std::cos(angle), s = std::sin(angle);
    const double edge = half / std::max(std::abs(c), std::abs(s));
    const double r = radius + share * (edge - radius);
    return Point{r * c, r * s, z};
  };
  std::string triangles;
  std::uint32_t count = 0;
  const auto add = [&](const Point& a, const Point& b, const Point& c) {
    float numbers[12] = {0, 0, 0};
    int i = 3;
    for (const Point& p : {a, b, c}) {
      numbers[i++] = static_cast<float>(p.x);
      numbers[i++] = static_cast<float>(p.y);
      numbers[i++] = static_cast<float>(p.z);
    }
    char bytes[50] = {};
    std::memcpy(bytes, numbers, sizeof numbers);
    triangles.append(bytes, sizeof bytes);
    ++count;
  };
  const auto quad = [&](const Point& a, const Point& b, const Point& c, const Point& d) {
    add(a, b, c);
    add(a, c, d);
  };
  for (int i = 0; i < sides; ++i) {
    for (int j = 0; j < topRings; ++j) {
      const double in = double(j) / topRings, out = double(j + 1) / topRings;
      quad(at(i, in, height), at(i, out, height), at(i + 1, out, height), at(i + 1, in, height));
    }
    for (int j = 0; j < bottomRings; ++j) {
      const double in = double(j) / bottomRings, out = double(j + 1) / bottomRings;
      quad(at(i, in, 0), at(i + 1, in, 0), at(i + 1, out, 0), at(i, out, 0));
    }
    for (int j = 0; j < holeRows; ++j) {
      const double low = height * j / holeRows, high = height * (j + 1) / holeRows;
      quad(at(i, 0, low), at(i, 0, high), at(i + 1, 0, high), at(i + 1, 0, low));
    }
    for (int j = 0; j < wallRows; ++j) {
      const double low = height * j / wallRows, high = height * (j + 1) / wallRows;
      quad(at(i, 1, low), at(i + 1, 1, low), at(i + 1, 1, high), at(i, 1, high));
    }
  }
  std::string file(80, ' ');
  char size[4];
  std::memcpy(size, &count, sizeof size);
  return file + std::string(size, sizeof size) + triangles;
}

/// The plate lies 0.3 and -0.2 mm beside its place, turned by 0.05 degrees. `control`: TNC640, 840Dsl.
inline std::string plateSetup(const std::string& control) {
  return fmt::format(
      "[control]\ntype = \"{}\"\n"
      "[part]\nfile = \"plate.stl\"\npose = {{ x = 0.3, y = -0.2, z = -500, c = 0.05 }}\n"
      "[[tool]]\nnumber = 1\nname = \"PROBE\"\nkind = \"probe\"\nlength = 150\nball_radius = 3\n"
      "[[{}]]\n{}origin = [0, 0, -460]\nactive = true\n",
      control, control == "840Dsl" ? "zero_offset" : "preset", control == "840Dsl" ? "name = \"G54\"\n" : "row = 1\n");
}

/// `cycles` measuring cycles of nine kinds in turn, in HEIDENHAIN Klartext.
inline std::string klartextProgram(int cycles) {
  using Words = std::vector<std::pair<int, double>>;
  std::string text = "BEGIN PGM MIXED MM\nTOOL CALL 1 Z\nL Z+60 R0 FMAX\n";
  const auto probe = [&](int number, const Words& words) {
    text += fmt::format("TCH PROBE {} MEASURE", number);
    for (const auto& [parameter, value] : words)
      text += fmt::format(" ~\n  Q{}={:+.4f} ;VALUE", parameter, value);
    text += "\n";
  };
  for (int i = 0; i < cycles; ++i) {
    const double depth = -5 - 0.1 * (i % 200), shift = (i % 37) - 18;
    switch (i % 9) {
      case 0:
        probe(421, {{273, 0},
                    {274, 0},
                    {262, 40},
                    {325, static_cast<double>(i % 360)},
                    {247, 90},
                    {261, depth},
                    {320, 1},
                    {260, 20},
                    {301, 0},
                    {275, 40.1},
                    {276, 39.9},
                    {279, 0},
                    {280, 0},
                    {281, 0},
                    {309, 0},
                    {330, 0}});
        break;
      case 1:
        probe(424, {{273, 0},
                    {274, 0},
                    {282, 100},
                    {283, 100},
                    {261, depth},
                    {320, 1},
                    {260, 20},
                    {301, 1},
                    {284, 0},
                    {285, 0},
                    {286, 0},
                    {287, 0},
                    {279, 0},
                    {280, 0},
                    {281, 0},
                    {309, 0},
                    {330, 0}});
        break;
      case 2:
        probe(427, {{263, 35},
                    {264, shift},
                    {261, 0},
                    {320, 1},
                    {272, 3},
                    {267, -1},
                    {260, 20},
                    {281, 0},
                    {288, 0},
                    {289, 0},
                    {309, 0},
                    {330, 0}});
        break;
      case 3:
        probe(420, {{263, -30},
                    {264, -50},
                    {265, 30},
                    {266, -50},
                    {272, 2},
                    {267, 1},
                    {261, depth},
                    {320, 1},
                    {260, 20},
                    {301, 0},
                    {281, 0}});
        break;
      case 4:
        probe(431, {{263, -40},
                    {264, -40},
                    {294, 0},
                    {265, 40},
                    {266, -40},
                    {295, 0},
                    {296, 0},
                    {297, 40},
                    {298, 0},
                    {320, 1},
                    {260, 20},
                    {281, 0}});
        break;
      case 5:
        probe(426, {{263, 50},
                    {264, shift},
                    {265, -50},
                    {266, shift},
                    {272, 1},
                    {261, depth},
                    {320, 1},
                    {260, 20},
                    {311, 100},
                    {288, 0},
                    {289, 0},
                    {281, 0},
                    {309, 0},
                    {330, 0}});
        break;
      case 6:
        probe(412, {{321, 0},
                    {322, 0},
                    {262, 40},
                    {325, 0},
                    {247, 60},
                    {261, depth},
                    {320, 1},
                    {260, 20},
                    {301, 0},
                    {305, 5},
                    {331, 0},
                    {332, 0},
                    {303, 1},
                    {381, 0},
                    {382, 0},
                    {383, 0},
                    {384, 0},
                    {333, 0}});
        break;
      case 7:
        probe(417, {{263, 35}, {264, shift}, {294, 0}, {320, 1}, {260, 20}, {305, 6}, {333, 0}, {303, 1}});
        break;
      default:
        probe(400, {{263, -30},
                    {264, -50},
                    {265, 30},
                    {266, -50},
                    {272, 2},
                    {267, 1},
                    {261, depth},
                    {320, 1},
                    {260, 20},
                    {301, 0},
                    {307, 0},
                    {305, 7}});
    }
  }
  return text + "END PGM MIXED MM\n";
}

/// The same for SINUMERIK: holes and edges in turn.
inline std::string sinumerikProgram(int cycles) {
  std::string text = "G17 G90 G71 G54\nT1 D1 M6\nG0 Z60\n";
  for (int i = 0; i < cycles; ++i) {
    const double depth = -5 - 0.1 * (i % 200), shift = (i % 37) - 18;
    switch (i % 3) {
      case 0:
        text += fmt::format("G0 X0 Y0\nG0 Z{:.3f}\nCYCLE977(1,,,1,40,,,5,4)\nG0 Z20\n", depth);
        break;
      case 1:
        text += fmt::format("G0 X60 Y{:.3f}\nG0 Z{:.3f}\nCYCLE978(0,,,1,50,8,4,1,2)\nG0 Z20\n", shift, depth);
        break;
      default:
        text += fmt::format("G0 X35 Y{:.3f}\nG0 Z10\nCYCLE978(0,,,1,0,8,4,3,2)\nG0 Z20\n", shift);
    }
  }
  return text + "M30\n";
}

}  // namespace probewright::mixed
