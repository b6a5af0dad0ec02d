#include "written_iges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace probewright::simulation::testing {

std::string igesNumber(double value) {
  std::string text = fmt::format("{:.15g}", value);
  const std::size_t e = text.find('e');
  if (text.find('.') == std::string::npos) text.insert(e == std::string::npos ? text.size() : e, ".");
  if (e != std::string::npos) text[text.find('e')] = 'D';
  return text;
}

int arcSpans(double from, double to) { return static_cast<int>(std::ceil((to - from) / 1.6)); }

double arcParameter(double from, double to, double angle) {
  const int spans = arcSpans(from, to);
  const double half = (to - from) / spans / 2;
  const int span = std::clamp(static_cast<int>((angle - from) / (2 * half)), 0, spans - 1);
  const double wanted = angle - from - (2 * span + 1) * half;  // from the middle of the piece
  double low = 0, high = 1;
  for (int i = 0; i < 100; ++i) {
    const double t = (low + high) / 2;
    const double y = std::sin(half) * (2 * t - 1), x = std::cos(half) * (1 - 2 * t * (1 - t)) + 2 * t * (1 - t);
    (std::atan2(y, x) < wanted ? low : high) = t;
  }
  return span + (low + high) / 2;
}

std::string IgesFile::length(double mm) const {
  const double unit = units_.flag == 1 ? 25.4 : units_.flag == 6 ? 1000 : 1;
  return igesNumber(mm / unit * units_.scale);
}

std::string IgesFile::point(const Vector3& p) const {
  return fmt::format("{},{},{}", length(p.x()), length(p.y()), length(p.z()));
}

int IgesFile::add(int type, const std::string& parameters, int form, int matrix, const std::string& use) {
  entities_.push_back({type, form, matrix, parameters, use});
  return static_cast<int>(2 * entities_.size()) - 1;
}

int IgesFile::line(const Vector3& from, const Vector3& to, bool dependent) {
  return add(110, fmt::format("{},{}", point(from), point(to)), 0, 0, dependent ? "00010000" : "00000000");
}

int IgesFile::arc(const Pose& pose, double radius, double from, double to) {
  const int spans = arcSpans(from, to);
  const double half = (to - from) / spans / 2;
  std::string knots = "0.,0.,0.", weights, points;
  for (int i = 0; i <= 2 * spans; ++i) {
    const bool between = i % 2 == 1;
    const double angle = from + i * half, r = between ? radius / std::cos(half) : radius;
    weights += fmt::format("{}{}", i == 0 ? "" : ",", igesNumber(between ? std::cos(half) : 1));
    points +=
        fmt::format("{}{}", i == 0 ? "" : ",", point(pose * Vector3(r * std::cos(angle), r * std::sin(angle), 0)));
  }
  for (int i = 1; i < spans; ++i)
    knots += fmt::format(",{0}.,{0}.", i);
  knots += fmt::format(",{0}.,{0}.,{0}.", spans);
  const Vector3 normal = pose.linear().col(2);
  return add(126,
             fmt::format("{},2,1,0,0,0,{},{},{},0.,{}.,{},{},{}", 2 * spans, knots, weights, points, spans,
                         igesNumber(normal.x()), igesNumber(normal.y()), igesNumber(normal.z())),
             0, 0, "00010000");
}

int IgesFile::cylinder(const Pose& pose, double radius, double z0, double z1, double u0, double u1,
                       const std::string& use, int matrix) {
  const int spans = arcSpans(u0, u1);
  const double half = (u1 - u0) / spans / 2;
  std::string knots = "0.,0.,0.", weights, points;
  for (int i = 1; i < spans; ++i)
    knots += fmt::format(",{0}.,{0}.", i);
  knots += fmt::format(",{0}.,{0}.,{0}.", spans);
  for (const double z : {z0, z1}) {
    for (int i = 0; i <= 2 * spans; ++i) {
      const bool between = i % 2 == 1;
      const double angle = u0 + i * half, r = between ? radius / std::cos(half) : radius;
      weights += fmt::format("{}{}", weights.empty() ? "" : ",", igesNumber(between ? std::cos(half) : 1));
      points += fmt::format("{}{}", points.empty() ? "" : ",",
                            point(pose * Vector3(r * std::cos(angle), r * std::sin(angle), z)));
    }
  }
  return add(
      128,
      fmt::format("{},1,2,1,0,0,0,0,0,{},0.,0.,1.,1.,{},{},0.,{}.,0.,1.", 2 * spans, knots, weights, points, spans), 0,
      matrix, use);
}

int IgesFile::matrix(const Matrix3& turn, const Vector3& shift, int form) {
  std::string text;
  for (Eigen::Index i = 0; i < 3; ++i)
    text += fmt::format("{}{},{},{},{}", i == 0 ? "" : ",", igesNumber(turn(i, 0)), igesNumber(turn(i, 1)),
                        igesNumber(turn(i, 2)), length(shift[i]));
  return add(124, text, form);
}

std::string IgesFile::text() const {
  std::string text;
  const auto line = [&](const std::string& content, char section, std::size_t number) {
    text += fmt::format("{:<72}{}{:>7}\n", content, section, number);
  };
  line("", 'S', 1);
  const std::string unit = units_.flag == 1 ? "4HINCH" : units_.flag == 6 ? "1HM" : "2HMM";
  const std::string global = fmt::format(
      "1H,,1H;,4Hpart,8Hpart.igs,1Ha,1Ha,32,38,6,308,15,4Hpart,{},{},{},1,0.1,15H20200101.000000,1.0D-7,1000.,1Ha,1Ha,"
      "11,"
      "0,15H20200101.000000;",
      igesNumber(units_.scale), units_.flag, unit);
  std::size_t globals = 0;
  for (std::size_t at = 0; at < global.size(); at += 72)
    line(global.substr(at, 72), 'G', ++globals);
  std::vector<std::string> lines;
  std::vector<std::size_t> owners;
  for (std::size_t i = 0; i < entities_.size(); ++i) {
    const Entity& e = entities_[i];
    const std::size_t first = lines.size() + 1;
    std::string rest = fmt::format("{},{};", e.type, e.parameters);
    while (!rest.empty()) {
      // A line ends with a comma or the end.
      std::size_t size = std::min<std::size_t>(64, rest.size());
      if (size < rest.size()) size = rest.rfind(',', size - 1) + 1;
      lines.push_back(rest.substr(0, size));
      owners.push_back(2 * i + 1);
      rest.erase(0, size);
    }
    line(fmt::format("{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{}", e.type, first, 0, 0, 0, 0, e.matrix, 0, e.use), 'D',
         2 * i + 1);
    line(fmt::format("{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}", e.type, 0, 0, lines.size() + 1 - first, e.form,
                     "", "", "", 0),
         'D', 2 * i + 2);
  }
  for (std::size_t i = 0; i < lines.size(); ++i)
    line(fmt::format("{:<64}{:>8}", lines[i], owners[i]), 'P', i + 1);
  line(fmt::format("S{:>7}G{:>7}D{:>7}P{:>7}", 1, globals, 2 * entities_.size(), lines.size()), 'T', 1);
  return text;
}

}  // namespace probewright::simulation::testing
