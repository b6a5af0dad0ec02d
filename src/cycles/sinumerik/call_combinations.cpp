#include "cycles/sinumerik/call_combinations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/number_text.hpp"
#include "geometry/primitives.hpp"

namespace probewright::cycles::sinumerik {

namespace {

int digitAt(double value, int place) {
  auto whole = static_cast<long>(std::abs(value));
  for (int i = 1; i < place; ++i)
    whole /= 10;
  return static_cast<int>(whole % 10);
}

class Combinations {
public:
  Combinations(const CycleDefinition& cycle, int variant,
               const std::function<KnownArgument(std::string_view)>& argument)
      : cycle_(cycle), variant_(variant), argument_(argument) {}

  std::vector<CombinationComplaint> all() {
    const bool corrects = digitAt(variant_, 3) == 2 && has("S_KNUM1");
    if (corrects) toolCorrection();
    if (cycle_.number == 995) spindle();
    if (cycle_.number == 997 && digitAt(variant_, 5) == 1) balls();
    if (cycle_.number == 961 && digitAt(variant_, 2) == 1) corner();
    if (cycle_.number == 977 && digitAt(variant_, 4) == 1) zones();
    if (cycle_.number == 977) setPosition();
    return std::move(found_);
  }

private:
  bool has(std::string_view name) const {
    return std::ranges::find(cycle_.parameters, name, &Parameter::name) != cycle_.parameters.end();
  }
  std::optional<double> number(std::string_view name) const { return argument_(name).number; }
  void refuse(std::string_view parameter, std::string text) { found_.push_back({parameter, {std::move(text), true}}); }
  void warn(std::string_view parameter, std::string text) { found_.push_back({parameter, {std::move(text), false}}); }

  void toolCorrection() {
    const auto target = number("S_KNUM1");
    if (!target || *target == 0) return;
    const auto mode = number("_AMODE"), upper = number("S_TUL"), lower = number("S_TLL");
    if (mode && digitAt(*mode, 1) == 1 && upper && lower && *upper < *lower) {
      refuse("S_TUL",
             fmt::format("S_TUL = {} is smaller than S_TLL = {}", formatShortest(*upper), formatShortest(*lower)));
    }
    const auto memories = number("S_EVNUM"), weight = number("S_K");
    if (memories && *memories >= 10000 && weight && *weight <= 0) {
      refuse("S_K", fmt::format("S_K = {}: the weighting factor of mean value {} must be greater than 0",
                                formatShortest(*weight), static_cast<long>(*memories) / 10000));
    }
    const KnownArgument name = argument_("S_TNAME");
    const bool empty = !name.given || (name.text && name.text->empty());
    // Long D numbers belong to one tool alone.
    if (empty && *target < 1000) {
      warn("S_TNAME", "S_TNAME names no tool to correct, which only machines with unique D numbers can do with");
    }
  }

  void spindle() {
    const auto mode = number("_AMODE"), upper = number("S_TUL");
    if (mode && digitAt(*mode, 1) == 1 && upper && *upper < 0)
      refuse("S_TUL", fmt::format("S_TUL = {} is smaller than 0", formatShortest(*upper)));
  }

  std::optional<Vector3> ball(int first) const {
    Vector3 centre;
    for (int i = 0; i < 3; ++i) {
      const auto coordinate = number(fmt::format("S_SETV{}", first + i));
      if (!coordinate) return std::nullopt;
      centre[i] = *coordinate;
    }
    return centre;
  }

  void balls() {
    if (digitAt(variant_, 3) != 1) return;
    const auto one = ball(0), two = ball(3), three = ball(6);
    if (!one || !two || !three) return;
    if ((*two - *one).cross(*three - *one).norm() < 1e-6)
      refuse("S_SETV8", "the set centres of the three balls (S_SETV0 to S_SETV8) lie on one line");
  }

  void corner() {
    double value[8] = {};
    const int count = digitAt(variant_, 1) <= 6 ? 6 : 8;
    for (int i = 0; i < count; ++i) {
      const auto coordinate = number(fmt::format("S_SETV{}", i));
      if (!coordinate) return;
      value[i] = *coordinate;
    }
    const Vector2 first(value[2] - value[0], value[3] - value[1]);
    if (first.norm() < 1e-6) return refuse("S_SETV3", "points 1 and 2 (S_SETV0 to S_SETV3) coincide");
    if (count == 6) return;
    const Vector2 second(value[6] - value[4], value[7] - value[5]);
    const double cross = first.x() * second.y() - first.y() * second.x();
    if (second.norm() < 1e-6 || std::abs(cross) < 0.01 * first.norm() * second.norm())
      refuse("S_SETV7", "the points of the two edges (S_SETV0 to S_SETV7) do not enclose an angle");
  }

  /// The ball must fit between zone and wall; its size is known to the run only.
  void zones() {
    const int feature = digitAt(variant_, 1);
    const bool inside = feature == 1 || feature == 3 || feature == 5;
    const auto check = [&](std::string_view size, std::string_view zone) {
      const auto set = number(size), width = number(zone);
      if (!set || !width || *width <= 0) return;
      if (inside ? *width < *set : *width > *set) return;
      refuse(zone, fmt::format("{} = {}: the protection zone leaves no room {} the set size {}", zone,
                               formatShortest(*width), inside ? "within" : "around", formatShortest(*set)));
    };
    if (feature <= 4) return check("S_SETV", "S_SZA");
    check("S_SETV0", "S_SZA");
    check("S_SETV1", "S_SZO");
  }

  void setPosition() {
    const auto mode = number("_AMODE");
    if (!mode || digitAt(*mode, 2) == 1) return;
    for (const std::string_view name : {"S_POS1", "S_POS2"})
      if (const auto value = number(name); value && *value != 0)
        return warn(name,
                    fmt::format("{} = {} is not observed: the tens of _AMODE are not 1", name, formatShortest(*value)));
  }

  const CycleDefinition& cycle_;
  int variant_;
  const std::function<KnownArgument(std::string_view)>& argument_;
  std::vector<CombinationComplaint> found_;
};

}  // namespace

std::vector<CombinationComplaint> combinationComplaints(
    const CycleDefinition& cycle, int variant, const std::function<KnownArgument(std::string_view)>& argument) {
  return Combinations(cycle, variant, argument).all();
}

}  // namespace probewright::cycles::sinumerik
