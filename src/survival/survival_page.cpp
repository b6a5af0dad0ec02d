#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string_view>

#include "survival/survival_records.hpp"

namespace probewright::survival {

namespace {

std::string escaped(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        if (static_cast<unsigned char>(c) >= 0x20 || c == '\t') safe += c;
    }
  }
  return safe;
}

const char* classOf(Verdict verdict) {
  switch (verdict) {
    case Verdict::Proven:
      return "proven";
    case Verdict::Fails:
      return "fails";
    default:
      return "undecided";
  }
}

constexpr const char* style =
    R"(body{font:15px/1.45 system-ui,sans-serif;margin:2rem auto;max-width:70rem;padding:0 1rem;color:#1b1f24}
h1{font-size:1.5rem}h2{font-size:1.15rem;margin-top:2rem}table{border-collapse:collapse}
td,th{padding:.2rem .7rem;border-bottom:1px solid #d0d7de;text-align:right}td.t,th.t{text-align:left}
.proven{fill:#3f9c6c;background:#3f9c6c}.fails{fill:#c8453b;background:#c8453b}.undecided{fill:#c9ced6;background:#c9ced6}
svg rect{stroke:#fff;stroke-width:.4}svg text{font-size:11px;fill:#1b1f24}svg .axis{fill:none;stroke:#57606a;stroke-width:1}
.key span{display:inline-block;width:.9rem;height:.9rem;margin:0 .4rem 0 1.2rem;vertical-align:-.1rem}
.maps{display:flex;flex-wrap:wrap;gap:1.5rem}pre{line-height:1.5;overflow-x:auto}pre .worst{background:#f4cfcb}pre .bad{background:#fbeceb}
pre i{color:#8c2f27;font-style:normal})";

/// A picture of one side of the box, or of two: the slice through the middle of all others.
class Map {
public:
  Map(const Survival& survival, std::size_t across, std::optional<std::size_t> up)
      : survival_(survival), across_(across), up_(up) {}

  std::string svg() const {
    std::string out =
        fmt::format(R"(<svg width="{}" height="{}" role="img" aria-label="map of {}{}{}">)", width + 90, height() + 45,
                    escaped(tolerance(across_).name()), up_ ? " and " : "", up_ ? escaped(tolerance(*up_).name()) : "");
    for (const Part& part : survival_.parts) {
      if (!inSlice(part.box)) continue;
      const double left = x(part.box.low[across_]), right = x(part.box.high[across_]);
      const double top = up_ ? y(part.box.high[*up_]) : 0, bottom = up_ ? y(part.box.low[*up_]) : height();
      out += fmt::format(R"(<rect class="{}" x="{:.2f}" y="{:.2f}" width="{:.2f}" height="{:.2f}">)",
                         classOf(part.verdict), left + 70, top + 5, right - left, bottom - top);
      if (part.reason && part.verdict != Verdict::Proven)
        out += fmt::format("<title>{}{}</title>",
                           part.reason->place.line > 0 ? fmt::format("line {}: ", part.reason->place.line) : "",
                           escaped(part.reason->why));
      out += "</rect>";
    }
    if (survival_.tolerances.size() <= 2) {
      for (const Failure& failure : survival_.failures)
        out += fmt::format(R"(<circle cx="{:.2f}" cy="{:.2f}" r="1.6" fill="#4d0f0a"/>)",
                           x(failure.values[across_]) + 70, (up_ ? y(failure.values[*up_]) : height() / 2) + 5);
    }
    if (survival_.symmetric > 0) {
      const double s = survival_.symmetric;
      out += fmt::format(
          R"(<rect class="axis" style="stroke:#10502f;stroke-width:2" x="{:.2f}" y="{:.2f}" width="{:.2f}" height="{:.2f}"/>)",
          70 + width * (1 - s) / 2, 5 + (up_ ? height() * (1 - s) / 2 : 0), width * s, up_ ? height() * s : height());
    }
    const Tolerance& horizontal = tolerance(across_);
    out += fmt::format(
        R"(<text x="70" y="{0:.0f}">{1:g}</text><text x="{2:.0f}" y="{0:.0f}" text-anchor="end">{3:g}</text><text x="{4:.0f}" y="{5:.0f}" text-anchor="middle">{6}</text>)",
        height() + 20, horizontal.low, 70 + width, horizontal.high, 70 + width / 2, height() + 36,
        escaped(horizontal.name()));
    if (up_) {
      const Tolerance& vertical = tolerance(*up_);
      out += fmt::format(
          R"svg(<text x="66" y="15" text-anchor="end">{:g}</text><text x="66" y="{:.0f}" text-anchor="end">{:g}</text><text transform="translate(14 {:.0f}) rotate(-90)" text-anchor="middle">{}</text>)svg",
          vertical.high, height() + 5, vertical.low, height() / 2 + 5, escaped(vertical.name()));
    }
    return out + "</svg>";
  }

private:
  static constexpr double width = 300;
  double height() const { return up_ ? 300 : 40; }
  const Tolerance& tolerance(std::size_t side) const { return survival_.tolerances[side]; }
  double x(double value) const {
    const Tolerance& side = tolerance(across_);
    return width * (value - side.low) / (side.high - side.low);
  }
  double y(double value) const {
    const Tolerance& side = tolerance(*up_);
    return height() * (1 - (value - side.low) / (side.high - side.low));
  }
  bool inSlice(const Box& box) const {
    for (std::size_t i = 0; i < survival_.tolerances.size(); ++i) {
      if (i == across_ || (up_ && i == *up_)) continue;
      const double middle = tolerance(i).middle();
      if (box.low[i] > middle || box.high[i] < middle) return false;
    }
    return true;
  }

  const Survival& survival_;
  std::size_t across_;
  std::optional<std::size_t> up_;
};

std::string maps(const Survival& survival) {
  std::string out = "<div class=\"maps\">";
  const std::size_t sides = survival.tolerances.size();
  if (sides == 1) out += Map(survival, 0, std::nullopt).svg();
  for (std::size_t a = 0; a < sides; ++a)
    for (std::size_t b = a + 1; b < sides; ++b)
      out += Map(survival, a, b).svg();
  return out + "</div>";
}

std::string programText(const Survival& survival, const SurvivalInfo& info) {
  std::string out = "<pre>";
  std::istringstream lines(info.text);
  std::uint64_t number = 0;
  const auto ofProgram = [&](const BlockRecord& block) { return block.place.file == info.program; };
  const auto worst = std::ranges::find_if(survival.blocks, ofProgram);
  for (std::string line; std::getline(lines, line) && number < 5000;) {
    ++number;
    const auto block = std::ranges::find_if(
        survival.blocks, [&](const BlockRecord& each) { return ofProgram(each) && each.place.line == number; });
    const bool there = block != survival.blocks.end();
    const std::string text = fmt::format("{:>5}  {}", number, escaped(line));
    out += !there ? text
                  : fmt::format("<span class=\"{}\"{}>{}</span>  <i>{} failures, {:.2f} % of the box: {}</i>",
                                block == worst ? "worst" : "bad", block == worst ? " id=\"worst\"" : "", text,
                                block->failures, 100 * block->share, escaped(block->why));
    out += "\n";
  }
  return out + "</pre>";
}

}  // namespace

std::string survivalPage(const Survival& survival, const SurvivalInfo& info) {
  std::string out = fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Which clampings {} survives"
      "</title><style>{}</style></head><body>\n<h1>Which clampings {} survives</h1>\n",
      escaped(info.program), style, escaped(info.program));
  std::string summary;
  std::istringstream lines(survivalText(survival));
  for (std::string line; std::getline(lines, line);)
    summary += escaped(line) + "\n";
  out += fmt::format("<p>Setup {}. Probewright {}.</p>\n<pre>{}</pre>\n", escaped(info.setup), escaped(info.version),
                     summary);
  if (!survival.asWritten) {
    out +=
        "<h2>Map</h2>\n<p class=\"key\"><span class=\"proven\"></span>proven<span class=\"fails\"></span>fails"
        "<span class=\"undecided\"></span>undecided. The frame is the largest box about the middle that is proven";
    out += survival.tolerances.size() > 2 ? ". Each picture is the slice through the middle of all other ranges.</p>\n"
                                          : "; dots are clampings that fail.</p>\n";
    out += maps(survival);
  }
  out += "<h2>Program</h2>\n" + programText(survival, info);
  if (!survival.failures.empty()) {
    out += "<h2>Clampings that fail</h2>\n<table><tr>";
    for (const Tolerance& tolerance : survival.tolerances)
      out += "<th>" + escaped(tolerance.name()) + "</th>";
    out += "<th>seed</th><th>line</th><th class=\"t\">why</th></tr>\n";
    for (std::size_t i = 0; i < survival.failures.size() && i < 100; ++i) {
      const Failure& failure = survival.failures[i];
      out += "<tr>";
      for (const double value : failure.values)
        out += fmt::format("<td>{:.4f}</td>", value);
      out += fmt::format("<td>{}</td><td>{}</td><td class=\"t\">{}</td></tr>\n", failure.noise,
                         failure.reason.place.line, escaped(failure.reason.why));
    }
    out += "</table>\n";
  }
  return out + "</body></html>\n";
}

}  // namespace probewright::survival
