#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "conversion/to_klartext.hpp"
#include "conversion/to_sinumerik.hpp"
#include "cycles/heidenhain/probe_words.hpp"
#include "geometry/primitives.hpp"

/// Single measuring moves: touch probe cycles 0, 3 and 4; CYCLE978 and measuring blocks (MEAS).
namespace probewright::conversion {

using namespace language;
namespace probe_word = cycles::heidenhain::probe_word;

namespace {

std::string wordName(std::uint32_t address) { return fmt::format("Q{}", address); }

constexpr std::array<const char*, 3> axisNames = {"X", "Y", "Z"};

}  // namespace

void ToSinumerik::singleTouch(const Block& block, const CycleCall& cycle, const Call& call) {
  const int number = cycle.number;
  const int result = call.integer(wordName(probe_word::result));
  const auto coordinate = [](std::size_t axis) {
    return wordName(probe_word::coordinate + static_cast<std::uint32_t>(axis));
  };
  if (number == 0) {
    const auto words = std::span<const Word>(block.words).subspan(cycle.parameters.first, cycle.parameters.count);
    for (const Word& word : words)
      if (word.mode == WordMode::Incremental)
        throw NotCarriedOver("incremental positions of cycle 0 are not converted");
    for (std::size_t i = 3; i < 6; ++i)
      if (call.has(coordinate(i))) throw NotCarriedOver("rotary axes of cycle 0 are not converted");
    const int axisNumber = call.integer(wordName(probe_word::axis));
    const auto axis =
        axisNumber < 3 ? planeIndex(addressOf(axisNames[static_cast<std::size_t>(axisNumber)])) : std::nullopt;
    if (!axis) throw NotCarriedOver("cycle 0 measures along X, Y or Z");
    MeasuringTask touch;
    touch.feature = Feature::Surface;
    touch.axis = static_cast<int>(*axis);
    touch.sign = call.integer(wordName(probe_word::direction)) < 0 ? -1 : 1;
    touch.path = touch.beyond = probe_.travel / 2 * millimetre_;
    touch.millimetre = millimetre_;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto index = planeIndex(addressOf(axisNames[i]));
      const bool given = call.has(coordinate(i));
      if (!given && !position_[*index]) {
        throw NotCarriedOver("where cycle 0 begins is known only when the program runs", "give X, Y and Z");
      }
      touch.place[*index] = given ? call.number(coordinate(i)) : *position_[*index];
    }
    touch.clearance = touch.place[2];
    if (touch.axis < 2) touch.place[2] = touch.place[2] + ballRadius_;
    touch.place[*axis] = touch.place[*axis] + (touch.path + (touch.axis == 2 ? Quantity() : ballRadius_)) * touch.sign;
    Losses losses;
    const SinumerikPassage passage = sinumerikPassage(touch, ballRadius_, losses);
    out_.line("; 0 REF. PLANE");
    approach(*passage.start, touch.clearance);
    out_.line(callText(passage.call));
    out_.line(fmt::format("{}=_OVR[4]", parameter(result)));
    for (int read = 115; read < 120; ++read)
      if (usedQ_.contains(read)) out_.lose(block, fmt::format("Q{}: CYCLE978 has no such result", read));
    forgetPosition();
    besidePath_ = true;
    return;
  }

  // Cycles 3 and 4: from where the probe is, along an angle or a vector.
  if (besidePath_) {
    out_.list(block, "this touch begins where the measuring cycle has left the probe",
              "move to a place in the plane before it");
  }
  const auto known = [&](std::uint32_t address, const char* what) {
    const Quantity value = call.number(wordName(address));
    if (!value.isNumber()) throw NotCarriedOver(fmt::format("{} is known only when the program runs", what));
    return value.number();
  };
  if (!(call.number(wordName(probe_word::referenceSystem)) == 0)) {
    throw NotCarriedOver("REFERENCE SYSTEM 1: results in the machine system are not converted");
  }
  Vector3 direction = Vector3::Zero();
  if (number == 3) {
    const int first = call.integer(wordName(probe_word::axis));
    if (first > 2) throw NotCarriedOver("cycle 3 measures from X, Y or Z");
    const double angle = known(probe_word::angle, "the angle") * std::numbers::pi / 180;
    direction[first] = std::cos(angle);
    direction[(first + 1) % 3] = std::sin(angle);
  } else {
    for (std::size_t i = 0; i < 3; ++i)
      direction[static_cast<Eigen::Index>(i)] =
          known(probe_word::coordinate + static_cast<std::uint32_t>(i), "the direction");
    if (!(direction.norm() > 0)) throw NotCarriedOver("the direction has no length");
    direction.normalize();
  }
  const double distance = known(probe_word::distance, "the length of the measuring move");
  if (distance < 0) direction = -direction;
  const Vector3 way = direction * std::abs(distance);

  out_.line(fmt::format("; {} MEASURING", number));
  const std::string rest = formulas_.declare("_MEAS_REST");
  std::array<std::string, 3> starts;
  for (std::size_t i = 0; i < 3; ++i) {
    starts[i] = formulas_.declare(fmt::format("_MEAS_{}", axisNames[i]));
    out_.line(fmt::format("{}=$AA_IW[{}]", starts[i], axisNames[i]));
  }
  std::string move = "MEAS=1 G1";
  for (std::size_t i = 0; i < 3; ++i)
    move += fmt::format(" {}=IC({})", axisNames[i], sinumerikText(way[static_cast<Eigen::Index>(i)]));
  out_.line(fmt::format("{} {}", move, addressWord("F", asFeed(call.number(wordName(probe_word::feed))))));
  const auto results = [&](const char* name, int status) {
    for (int i = 0; i < 3; ++i) {
      // The ball's centre lies one radius along the tool from the tip.
      const Quantity centre = Quantity::of(fmt::format("{}[{}]", name, axisNames[static_cast<std::size_t>(i)])) +
                              (axis(2) == axisNames[static_cast<std::size_t>(i)] ? ballRadius_ : Quantity());
      out_.line(fmt::format("  {}={}", parameter(result + i), sinumerikText(centre)));
    }
    out_.line(fmt::format("  {}={}", parameter(result + 3), status));
  };
  out_.line("IF $AC_MEA[1]");
  results("$AA_MW", 1);
  out_.line("ELSE");
  results("$AA_IW", -1);
  out_.line("ENDIF");
  std::string travelled;
  for (std::size_t i = 0; i < 3; ++i)
    travelled += fmt::format("{}POT($AA_IW[{}]-{})", i == 0 ? "" : "+", axisNames[i], starts[i]);
  // Back by MB, but not farther than to the start.
  const bool limited = call.has(wordName(probe_word::retraction));
  const Quantity most = limited ? call.number(wordName(probe_word::retraction)) : Quantity(std::abs(distance));
  if (limited && most == 0) {
    out_.list(block, "with MB0 the stylus stays deflected, and a HEIDENHAIN control stops at the next motion",
              "give MB the length to retract by");
  }
  out_.line(fmt::format("{}=MAXVAL(0,SQRT({})-{})", rest, travelled, factorText(sinumerikText(most))));
  std::string home = "G0";
  for (std::size_t i = 0; i < 3; ++i) {
    const Quantity left = Quantity::of(rest, direction[static_cast<Eigen::Index>(i)]);
    home += fmt::format(" {}={}", axisNames[i], sinumerikText(Quantity::of(starts[i]) + left));
  }
  out_.line(home);
  if (call.has(wordName(probe_word::errorMode)) && call.integer(wordName(probe_word::errorMode)) == 1) {
    out_.lose(block, "ERRORMODE 1: a stylus that is deflected at the start stops the program");
  }
  forgetPosition();
  besidePath_ = true;
}

void ToKlartext::measuringBlock(const Block& block, const Command& command) {
  const auto words = std::span<const Word>(block.words).subspan(command.words.first, command.words.count);
  std::array<Quantity, 3> way;
  std::optional<Quantity> stroke;
  if (!(quantity(block, words[0].value) == 1)) {
    throw NotCarriedOver("TCH PROBE 4 waits for the touch probe in the spindle to be deflected, as MEAS=1 does",
                         "write it by hand");
  }
  for (const Word& word : words.subspan(1)) {
    const std::string name = addressName(word.address);
    if (name == "F") {
      stroke = feed(block, word.value);
      continue;
    }
    const auto index = planeIndex(word.address);
    if (!index) throw NotCarriedOver(fmt::format("{} in a measuring block has no twin in Klartext", name));
    rely(block, incrementalDoubtful_ && word.mode == WordMode::Plain, "G90 or G91");
    const bool incremental = word.mode == WordMode::Incremental || (word.mode == WordMode::Plain && incremental_);
    const Quantity value = quantity(block, word.value);
    const auto i = static_cast<std::size_t>(std::ranges::find(axisNames, name) - axisNames.begin());
    way[i] = incremental ? value : value - here()[*index];
  }
  if (!stroke)
    throw NotCarriedOver("the feed of this measuring block is that of a block above", "write F in this block");
  // The vector tells the direction, DIST how far; the stylus must not stay deflected.
  Quantity distance = way[0];
  const bool numbers = std::ranges::all_of(way, &Quantity::isNumber);
  if (numbers) {
    distance = Vector3(way[0].number(), way[1].number(), way[2].number()).norm();
  } else {
    const auto square = [](const Quantity& part) { return fmt::format("SQ ({})", spacedExpressionText(part)); };
    distance = Quantity::of(fmt::format("SQRT ({} + {} + {})", square(way[0]), square(way[1]), square(way[2])));
  }
  std::string vector = "TCH PROBE 4.2";
  for (std::size_t i = 0; i < 3; ++i)
    vector += fmt::format(" I{}{}", axisNames[i], formulas_.value(way[i]));
  const std::string touch = fmt::format("TCH PROBE 4.3 DIST {} F{} MB MAX REFERENCE SYSTEM:0",
                                        formulas_.value(distance), formulas_.unsignedValue(*stroke));
  writeWhole({"TCH PROBE 4.0 MEASURING IN 3-D",
              fmt::format("TCH PROBE 4.1 {}", formulas_.measuringBlock(axis(2)[0] - 'X')), vector, touch});
  forgetPosition();
  besideMeasured_ = true;
}

}  // namespace probewright::conversion
