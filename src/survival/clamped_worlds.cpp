#include "survival/clamped_worlds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "camera/virtual_camera.hpp"
#include "setup/shape_keys.hpp"

namespace probewright::survival {

using simulation::FeatureMode;
using simulation::FeatureShape;
using simulation::SolidFeature;
using simulation::Truth;

namespace {

/// +1 if `larger` is all of `smaller` and more, -1 if it cuts more away, 0 if they are alike; nothing if neither.
std::optional<double> materialBetween(const SolidFeature& smaller, const SolidFeature& larger) {
  SolidFeature resized = smaller;
  resized.size = larger.size;
  resized.diameter = larger.diameter;
  resized.topDiameter = larger.topDiameter;
  resized.tubeDiameter = larger.tubeDiameter;
  resized.height = larger.height;
  resized.depth = larger.depth;
  const bool grows = (larger.size.array() >= smaller.size.array()).all() && larger.diameter >= smaller.diameter &&
                     larger.topDiameter >= smaller.topDiameter && larger.tubeDiameter >= smaller.tubeDiameter &&
                     larger.height >= smaller.height && larger.depth >= smaller.depth;
  const bool same = smaller.size == larger.size && smaller.diameter == larger.diameter &&
                    smaller.topDiameter == larger.topDiameter && smaller.tubeDiameter == larger.tubeDiameter &&
                    smaller.height == larger.height && smaller.depth == larger.depth;
  // Anything else of the feature that follows the number: its place, its edges.
  if (smaller.centre != larger.centre || smaller.rotation != larger.rotation ||
      smaller.cornerRadius != larger.cornerRadius || smaller.edgeSize != larger.edgeSize ||
      smaller.shape != larger.shape || smaller.mode != larger.mode)
    return std::nullopt;
  if (same) return 0.0;
  if (!grows) return std::nullopt;
  // A wider ring of the same tube does not hold the narrower one; a taller cone that widens upwards is narrower below.
  if (smaller.shape == FeatureShape::Torus && smaller.diameter != larger.diameter) return std::nullopt;
  if (smaller.shape == FeatureShape::Cone && smaller.height != larger.height && smaller.topDiameter > smaller.diameter)
    return std::nullopt;
  // 0 cuts through.
  if (smaller.depth == 0 && larger.depth != 0) return std::nullopt;
  const bool cut = smaller.mode == FeatureMode::Cut || smaller.shape == FeatureShape::Hole ||
                   smaller.shape == FeatureShape::Pocket || smaller.shape == FeatureShape::Slot;
  return cut ? -1.0 : 1.0;
}

bool sameRecipe(const simulation::SolidRecipe& a, const simulation::SolidRecipe& b) {
  return std::ranges::equal(a.features, b.features, [](const SolidFeature& left, const SolidFeature& right) {
    return materialBetween(left, right) == 0.0;
  });
}

bool isTreatedEdge(const SolidFeature& feature) {
  return feature.shape == FeatureShape::Chamfer || feature.shape == FeatureShape::Fillet;
}

tl::unexpected<Diagnostic> refuse(const Tolerance& tolerance, const std::string& why, std::string advice) {
  return fail({}, fmt::format("tolerance of {}: {}", tolerance.name(), why), std::move(advice));
}

/// The greatest distance between what two shapes of a tool have in common; nothing if they are not alike.
std::optional<Displacements::OfTool> between(const simulation::ToolShape& a, const simulation::ToolShape& b) {
  if (a.balls.size() != b.balls.size() || a.shafts.size() != b.shafts.size()) return std::nullopt;
  Displacements::OfTool apart;
  for (std::size_t i = 0; i < a.balls.size(); ++i)
    apart.balls.push_back((a.balls[i].centre - b.balls[i].centre).norm() +
                          std::abs(a.balls[i].radius - b.balls[i].radius));
  for (std::size_t i = 0; i < a.shafts.size(); ++i) {
    const auto &first = a.shafts[i], &second = b.shafts[i];
    apart.shafts.push_back(
        std::max((first.start - second.start).norm(), (first.start + first.axis - second.start - second.axis).norm()) +
        std::abs(first.radius - second.radius));
  }
  return apart;
}

}  // namespace

ClampedWorlds::ClampedWorlds(setup::SetupDocument document, std::vector<Tolerance> tolerances,
                             const simulation::ImportOptions& import)
    : document_(std::move(document)),
      tolerances_(std::move(tolerances)),
      stop_(import.stop),
      tables_([this] { return document_.table(); }) {}

Result<std::unique_ptr<ClampedWorlds>> ClampedWorlds::make(setup::SetupDocument document,
                                                           std::vector<Tolerance> tolerances,
                                                           const simulation::ImportOptions& import) {
  auto built = simulation::buildMachine(document.asWritten().world, import);
  if (!built) return tl::unexpected(std::move(built.error()));
  std::unique_ptr<ClampedWorlds> worlds(new ClampedWorlds(std::move(document), std::move(tolerances), import));
  worlds->solids_ = (*built)->truth().solids;
  worlds->bodies_ = (*built)->truth().bodies;
  if (auto explored = worlds->explore(); !explored) return tl::unexpected(std::move(explored.error()));
  worlds->findPoses();
  return worlds;
}

Result<void> ClampedWorlds::explore() {
  const simulation::World& written = asWritten().world;
  const std::size_t count = written.solids.size();
  sizeVaries_.assign(solids_.size(), false);
  material_.assign(tolerances_.size(), 0);
  const std::vector<double> values = this->written();
  for (std::size_t i = 0; i < tolerances_.size(); ++i) {
    const Tolerance& tolerance = tolerances_[i];
    std::vector<double> low = values, high = values;
    low[i] = tolerance.low;
    high[i] = tolerance.high;
    const auto below = setupOf(low), above = setupOf(high);
    if (!below) return tl::unexpected(below.error());
    if (!above) return tl::unexpected(above.error());
    std::vector<bool> moves(solids_.size());
    bool resizes = false;
    for (std::size_t s = 0; s < count; ++s) {
      const auto &first = below->world.solids[s], &second = above->world.solids[s];
      moves[s] = first.tableFromSolid.matrix() != second.tableFromSolid.matrix();
      const auto &small = first.source.recipe.features, &large = second.source.recipe.features;
      if (sameRecipe(first.source.recipe, second.source.recipe)) continue;
      if (small.size() != large.size() || std::ranges::any_of(small, isTreatedEdge))
        return refuse(tolerance, "sizes of solids with chamfers or fillets cannot vary",
                      "Leave the edges sharp in the setup, or leave this tolerance out");
      for (std::size_t f = 0; f < small.size(); ++f) {
        const auto material = materialBetween(small[f], large[f]);
        const bool against = material && *material != 0 && material_[i] != 0 && material_[i] != *material;
        if (!material || against)
          return refuse(tolerance, "a larger number neither adds material everywhere nor takes it away everywhere",
                        "Leave this tolerance out");
        if (*material != 0) material_[i] = *material;
      }
      sizeVaries_[s] = resizes = anySizeVaries_ = true;
    }
    const bool anyMoves = std::ranges::find(moves, true) != moves.end();
    if (anyMoves && tolerance.kind != NumberKind::Shift && tolerance.kind != NumberKind::Turn)
      return refuse(tolerance, "with its size the solid moves, too", "Leave this tolerance out");
    if (!anyMoves && !resizes && tolerance.kind != NumberKind::Length)
      return refuse(tolerance, "nothing on the table follows it", "Name the pose or size of a part or fixture");
    moves_.push_back(std::move(moves));
  }
  for (const simulation::PlacedSolid& solid : solids_) {
    const simulation::Bounds reach = solid.solid->reach();
    const Vector3 farthest = reach.minimum.cwiseAbs().cwiseMax(reach.maximum.cwiseAbs());
    radius_.push_back(farthest.norm());
  }
  if (anySizeVaries_) {
    // As large as they come.
    const auto most = truthWithMost(boxOf(tolerances_));
    if (!most) return tl::unexpected(most.error());
    for (std::size_t s = 0; s < solids_.size(); ++s) {
      const simulation::Bounds reach = most->solids[s].solid->reach();
      radius_[s] = std::max(radius_[s], reach.minimum.cwiseAbs().cwiseMax(reach.maximum.cwiseAbs()).norm());
    }
    if (const auto least = truthWithLeast(boxOf(tolerances_)); !least) return tl::unexpected(least.error());
  }
  return {};
}

std::vector<double> ClampedWorlds::written() const {
  std::vector<double> values;
  for (const Tolerance& tolerance : tolerances_)
    values.push_back(tolerance.quantity.numberIn(document_.table()).value_or(0));
  return values;
}

Result<setup::Setup> ClampedWorlds::setupOf(std::span<const double> values) const {
  toml::table& table = tables_.local();
  for (std::size_t i = 0; i < tolerances_.size(); ++i) {
    if (auto set = tolerances_[i].quantity.set(table, values[i]); !set) return tl::unexpected(set.error());
  }
  Diagnostics mistakes;
  auto setup = document_.with(table, mistakes);
  if (setup) return *std::move(setup);
  const auto mistake = std::ranges::find(mistakes, Severity::Error, &Diagnostic::severity);
  if (mistake != mistakes.end()) return tl::unexpected(*mistake);
  return fail({}, "the setup cannot be like this", {});
}

Pose ClampedWorlds::poseOf(const Posed& posed, std::span<const double> values) const {
  std::array<double, 6> numbers = posed.written;
  for (std::size_t k = 0; k < numbers.size(); ++k)
    if (posed.tolerance[k]) numbers[k] = values[*posed.tolerance[k]];
  return setup::poseOf({numbers[0], numbers[1], numbers[2]}, numbers[3], numbers[4], numbers[5]);
}

void ClampedWorlds::findPoses() {
  static constexpr std::string_view names = "xyzabc";
  std::vector<Posed> found;
  for (std::size_t i = 0; i < tolerances_.size(); ++i) {
    const std::string& name = tolerances_[i].name();
    // Poses of tool touch probes and gauges are told in more places than one.
    const bool ofPart = name.starts_with("part.pose.") || name.starts_with("fixture");
    const std::size_t number = names.find(name.back());
    if (!ofPart || number == std::string_view::npos || std::ranges::count(moves_[i], true) != 1) return;
    const auto solid = static_cast<std::size_t>(std::ranges::find(moves_[i], true) - moves_[i].begin());
    auto posed = std::ranges::find(found, solid, &Posed::solid);
    if (posed == found.end()) {
      Posed whole{solid, {}, {}};
      for (std::size_t k = 0; k < names.size(); ++k) {
        const auto path = study::NumberPath::parse(name.substr(0, name.size() - 1) + names[k]);
        if (!path) return;
        whole.written[k] = path->numberIn(document_.table()).value_or(0);
      }
      posed = found.insert(found.end(), whole);
    }
    posed->tolerance[number] = i;
  }
  const Box whole = boxOf(tolerances_);
  for (const std::vector<double>& values : {written(), whole.low, whole.high, whole.middle()}) {
    const auto setup = setupOf(values);
    if (!setup) return;
    for (const Posed& posed : found)
      if (poseOf(posed, values).matrix() != setup->world.solids[posed.solid].tableFromSolid.matrix()) return;
  }
  auto asWritten = truth(written());
  if (!asWritten) return;
  posed_ = std::move(found);
  truthAsWritten_ = *std::move(asWritten);
}

Result<std::shared_ptr<const simulation::Solid>> ClampedWorlds::resized(std::size_t solid,
                                                                        const simulation::SolidRecipe& recipe,
                                                                        std::span<const double> values) const {
  std::vector<double> sizes;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (material_[i] != 0) sizes.push_back(values[i]);
  {
    const std::lock_guard lock(mutex_);
    for (const Resized& known : resized_)
      if (known.solid == solid && known.sizes == sizes) return known.shape;
  }
  auto built = simulation::buildSolid(recipe, {}, stop_);
  if (!built) return tl::unexpected(std::move(built.error()));
  const std::shared_ptr<const simulation::Solid> shape = *std::move(built);
  const std::lock_guard lock(mutex_);
  resized_.push_back({solid, std::move(sizes), shape});
  if (resized_.size() > mostResized) resized_.pop_front();
  return shape;
}

Result<Truth> ClampedWorlds::truth(std::span<const double> values) const {
  if (truthAsWritten_) {
    Truth truth = *truthAsWritten_;
    for (const Posed& posed : posed_)
      truth.solids[posed.solid].tableFromSolid = poseOf(posed, values);
    return truth;
  }
  auto setup = setupOf(values);
  if (!setup) return tl::unexpected(std::move(setup.error()));
  const auto& written = asWritten().world.solids;
  Truth truth = std::move(setup->world.truth);
  truth.solids.clear();
  for (std::size_t i = 0; i < written.size(); ++i) {
    const simulation::WorldSolid& solid = setup->world.solids[i];
    std::shared_ptr<const simulation::Solid> shape = solids_[i].solid;
    if (sizeVaries_[i] && !sameRecipe(solid.source.recipe, written[i].source.recipe)) {
      auto other = resized(i, solid.source.recipe, values);
      if (!other) return tl::unexpected(std::move(other.error()));
      shape = *std::move(other);
    }
    truth.solids.push_back({std::move(shape), solid.tableFromSolid, solid.name, solid.role});
  }
  truth.solids.insert(truth.solids.end(), solids_.begin() + static_cast<std::ptrdiff_t>(written.size()), solids_.end());
  truth.bodies = bodies_;
  return truth;
}

std::vector<double> ClampedWorlds::cornerWith(Material material, const Box& box) const {
  std::vector<double> values = box.middle();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (material_[i] != 0) values[i] = (material_[i] > 0) == (material == Material::Most) ? box.high[i] : box.low[i];
  }
  return values;
}

Result<Truth> ClampedWorlds::truthWithMost(const Box& box) const { return truth(cornerWith(Material::Most, box)); }
Result<Truth> ClampedWorlds::truthWithLeast(const Box& box) const { return truth(cornerWith(Material::Least, box)); }

Result<std::unique_ptr<simulation::VirtualMachine>> ClampedWorlds::machine(Truth truth) const {
  auto machine = std::make_unique<simulation::VirtualMachine>(std::move(truth));
  if (asWritten().world.toolInSpindle) {
    const auto inserted = machine->insertTool({*asWritten().world.toolInSpindle, {}});
    if (inserted.end != machine::ToolChangeEnd::Changed)
      return fail({}, "the machine cannot start like this: " + inserted.detail, {});
  }
  if (asWritten().camera) machine->fit(std::make_unique<camera::VirtualCamera>(*machine, *asWritten().camera));
  return machine;
}

Displacements ClampedWorlds::displacements(const Box& box, const Truth& middle) const {
  Displacements displacements;
  for (std::size_t s = 0; s < solids_.size(); ++s) {
    Displacements::OfSolid solid;
    for (std::size_t i = 0; i < tolerances_.size(); ++i) {
      if (!moves_[i][s]) continue;
      const double half = (box.high[i] - box.low[i]) / 2;
      if (tolerances_[i].kind == NumberKind::Shift) {
        // Two numbers may move one solid along one axis only where they name the same pose.
        solid.shift[tolerances_[i].name().back() - 'x'] += half;
      } else {
        // Whatever the other angles are, a turn moves a point by no more than the angle times its distance from the
        // origin of the pose.
        solid.turn += radiansFromDegrees(half) * radius_[s];
      }
    }
    displacements.ofSolids.push_back(solid);
  }
  for (const simulation::TrueTool& tool : middle.tools) {
    const simulation::ToolShape shape = shapeOf(&tool, 0);
    displacements.ofTools.push_back(
        {std::vector<double>(shape.balls.size()), std::vector<double>(shape.shafts.size())});
  }
  for (std::size_t i = 0; i < tolerances_.size(); ++i) {
    if (tolerances_[i].kind != NumberKind::Length) continue;
    std::vector<double> values = box.middle();
    values[i] = box.high[i];
    const auto above = setupOf(values);
    constexpr double unknown = 1e6;  // mm: nothing is proven with it
    for (std::size_t t = 0; t < middle.tools.size(); ++t) {
      // Shapes follow lengths in proportion, so one end of the range is as far as the other.
      Displacements::OfTool& sum = displacements.ofTools[t];
      const auto apart =
          above ? between(shapeOf(&middle.tools[t], 0), shapeOf(&above->world.truth.tools[t], 0)) : std::nullopt;
      if (!apart) {
        std::ranges::fill(sum.balls, unknown);
        std::ranges::fill(sum.shafts, unknown);
        continue;
      }
      for (std::size_t b = 0; b < sum.balls.size(); ++b)
        sum.balls[b] += apart->balls[b];
      for (std::size_t b = 0; b < sum.shafts.size(); ++b)
        sum.shafts[b] += apart->shafts[b];
    }
  }
  return displacements;
}

double ClampedWorlds::farthestFromMiddle(const Box& box) const {
  double farthest = 0;
  for (std::size_t s = 0; s < solids_.size(); ++s) {
    double shift = 0, turn = 0;
    for (std::size_t i = 0; i < tolerances_.size(); ++i) {
      if (!moves_[i][s]) continue;
      const double middle = tolerances_[i].middle();
      const double off = std::max(std::abs(box.low[i] - middle), std::abs(box.high[i] - middle));
      if (tolerances_[i].kind == NumberKind::Shift)
        shift += off * off;
      else
        turn += radiansFromDegrees(off) * radius_[s];
    }
    farthest = std::max(farthest, std::sqrt(shift) + turn);
  }
  return farthest;
}

double ClampedWorlds::reachOf(std::size_t tolerance, const Box& box) const {
  const double half = (box.high[tolerance] - box.low[tolerance]) / 2;
  if (tolerances_[tolerance].kind != NumberKind::Turn) return half;
  double farthest = 0;
  for (std::size_t s = 0; s < solids_.size(); ++s)
    if (moves_[tolerance][s]) farthest = std::max(farthest, radius_[s]);
  return radiansFromDegrees(half) * farthest;
}

}  // namespace probewright::survival
