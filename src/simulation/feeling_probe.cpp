#include "simulation/feeling_probe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "geometry/place_text.hpp"
#include "simulation/probe_signal.hpp"
#include "simulation/virtual_machine.hpp"

namespace probewright::simulation {

using machine::AxisKind;

namespace {

constexpr double touchPrecision = 1e-7;      // mm
constexpr double collisionPrecision = 1e-4;  // mm
constexpr double fastestLinear = 3000;       // mm/s: faster is a new zero, no motion
constexpr double fastestRotary = 30000;      // degrees/s
constexpr double turnPerLook = 2;            // degrees of a cutter

bool isToolProbe(const PlacedSolid& solid) { return solid.role == SolidRole::ToolProbe; }
bool isNoToolProbe(const PlacedSolid& solid) { return !isToolProbe(solid); }

bool isPart(const Shaft& shaft, const char* part) { return std::string_view(shaft.part) == part; }

}  // namespace

void FeelingProbe::Deflection::advance(double length, double seconds) {
  if (toGo > 0) {
    if (length < toGo) {
      toGo -= length;
      return;
    }
    seconds *= 1 - toGo / length;
    toGo = 0;
  }
  toWait -= seconds;
}

FeelingProbe::FeelingProbe(Truth truth, std::optional<int> inSpindle)
    : truth_(std::move(truth)),
      kinematics_(truth_.machine, truth_.errors),
      all_(truth_.solids),
      withoutToolProbes_(truth_.solids, isNoToolProbe),
      toolProbesOnly_(truth_.solids, isToolProbe),
      inSpindle_(inSpindle),
      noise_(streamSeed(truth_.seed, "probe")) {
  if (!truth_.bodies.empty()) guard_ = std::make_unique<BodyGuard>(truth_);
}

void FeelingProbe::pullOff() {
  pulledOff_ = true;
  broken_ = false;
}

std::string FeelingProbe::describe(const Touch& touch, const char* part) const {
  const PlacedSolid& solid = truth_.solids[touch.solid];
  return fmt::format("the {} of tool {} touched \"{}\" at {} on the table", part, tool_->number, solid.name,
                     placeText(touch.point));
}

void FeelingProbe::changeTool(int number) {
  const int wanted = number == 0 && inSpindle_ ? *inSpindle_ : number;
  if (number != 0) inSpindle_.reset();
  number_ = number;
  const auto found = std::ranges::find_if(truth_.tools, [&](const TrueTool& tool) { return tool.number == wanted; });
  tool_ = found == truth_.tools.end() ? nullptr : &*found;
  if (tool_ == nullptr && wanted != 0)
    tell(fmt::format("the setup has no tool {}: the spindle counts as empty", wanted));
  edges_.reset();
  clearance_ = 0;
  if (tool_ != nullptr && tool_->kind != ToolKind::Probe) edges_.emplace(*tool_);
  deflection_.reset();
  pushed_.reset();
  broken_ = false;
}

void FeelingProbe::orient(double degrees) {
  orientation_ = spindleDegrees_ = degrees;
  const ToolShape shape = shapeOf(tool_, degrees);
  feeler_ = blunt_ = carrier_ = whole_ = shape;
  const bool probe = tool_ != nullptr && tool_->kind == ToolKind::Probe;
  std::erase_if(feeler_.shafts, [&](const Shaft& shaft) { return !probe || !isPart(shaft, shaftName); });
  blunt_.balls.clear();
  std::erase_if(blunt_.shafts, [&](const Shaft& shaft) { return probe && isPart(shaft, shaftName); });
  carrier_ = blunt_;
  std::erase_if(carrier_.shafts, [](const Shaft& shaft) { return isPart(shaft, cutterName); });
  clearance_ = 0;
}

Motion FeelingProbe::stepTo(const Moment& moment) const {
  double linear = 0, rotary = 0;
  for (std::size_t i = 0; i < truth_.machine.axes.size(); ++i) {
    const double travel = moment.axes[i] - reading_[i];
    (truth_.machine.axes[i].kind == AxisKind::Linear ? linear : rotary) += travel * travel;
  }
  const double seconds = std::max(moment.seconds, 1e-6);
  const bool jump = std::sqrt(linear) > fastestLinear * seconds || std::sqrt(rotary) > fastestRotary * seconds;
  const double length = jump ? 0 : std::sqrt(linear > 0 ? linear : rotary);
  Motion step{kinematics_, reading_, moment.axes, slides_, clock_, MotionProfile(0, 1, 1)};
  if (jump) step.from = step.slidesAtStart = moment.axes;
  if (length > 0) step.profile = MotionProfile(length, length / seconds, 1e12);
  return step;
}

Felt FeelingProbe::feel(const Moment& moment) {
  const bool first = !number_;
  const bool otherTool = first || moment.tool != *number_;
  if (otherTool) changeTool(moment.tool);
  const bool changed = otherTool || moment.spindleAngle != orientation_;
  if (changed) orient(moment.spindleAngle);
  if (first) reading_ = slides_ = moment.axes;
  const Motion step = stepTo(moment);
  const bool stands = step.profile.length() == 0 && step.from == reading_;
  // Clockwise as seen from the spindle nose is against the angles about the tool.
  degreesPerSecond_ = -6 * moment.spindleSpeed;
  const Rest whole{step.profile.length(), moment.seconds};
  const bool searched = changed || !stands;
  // The step is searched from where the axes were, everything else is asked of where they are.
  std::optional<Touch> touched;
  if (searched && !pulledOff_) feelCollision(step);
  if (searched && guard_) feelBodies(step);
  if (searched && !feeler_.balls.empty() && !deflection_) {
    touched = firstTouch(step, 0, 1, feeler_, all_, {touchPrecision});
  }
  const double contact = touched ? touched->fraction : 0;
  const Vector3 tipAtContact = step.tableFromSpindleAt(contact) * feeler_.tip;
  const Vector3 normalInSpindle =
      touched ? Vector3(step.tableFromSpindleAt(contact).linear().transpose() * touched->normal) : Vector3::UnitZ();
  if (step.profile.length() == 0 && searched) clearance_ = 0;  // a new zero
  slides_ = step.slidesAt(1);
  reading_ = moment.axes;
  clock_ += moment.seconds;
  spindleDegrees_ += degreesPerSecond_ * moment.seconds;
  if (deflection_) {
    if (searched && !stillDeflected()) {
      deflection_.reset();
      broken_ = false;
    } else {
      deflection_->advance(whole.length, whole.seconds);
    }
  } else if (touched) {
    deflection_ = Deflection{*touched, tipAtContact, 0, tool_->probe.signalDelay};
    if (!touched->shaft) {
      deflection_->toGo = pretravelOf(*tool_, orientation_, normalInSpindle);
      if (tool_->probe.repeatability > 0) deflection_->toGo += tool_->probe.repeatability * gaussian_(noise_);
    }
    deflection_->advance((1 - contact) * whole.length, (1 - contact) * whole.seconds);
    tell(describe(*touched, touched->shaft ? shaftName : "ball"));
  }
  if (deflection_ && !broken_ && !pulledOff_ && pushedTooFar()) {
    broken_ = true;
    tell("the stylus is pushed too far");
  }
  if (edges_) feelWithCutter(whole, searched && !kinematics_.isStraight(step.slidesAtStart, slides_));
  if (colliding_ || pulledOff_) {
    if (!obstacle() && !bodiesTouch()) colliding_ = false;
    if (pulledOff_ && !colliding_ && !(deflection_ && pushedTooFar())) pulledOff_ = false;
  }
  Felt felt;
  const bool on = tool_ != nullptr && tool_->probe.switchedOn;
  felt.touch = on && deflection_ && deflection_->signals();
  felt.byStylus = felt.touch && deflection_->touch.shaft.has_value();
  felt.toolTouch = pushed_ && pushed_->signals();
  felt.collision = (colliding_ || broken_) && !pulledOff_;
  return felt;
}

bool FeelingProbe::stillDeflected() const {
  if (deflection_->touch.shaft) {
    ToolShape stylus = feeler_;
    stylus.balls.clear();
    return shaftOverlap(pose(), stylus, all_).has_value();
  }
  return ballOverlap(pose(), feeler_, all_).has_value();
}

bool FeelingProbe::pushedTooFar() const {
  const double depth = (deflection_->tip - pose() * feeler_.tip).dot(deflection_->touch.normal);
  return depth > deepestDeflection * tool_->probe.ballRadius;
}

void FeelingProbe::feelCollision(const Motion& step) {
  if (colliding_ || blunt_.shafts.empty()) return;
  auto touch = firstTouch(step, 0, 1, blunt_, edges_ ? withoutToolProbes_ : all_, {collisionPrecision});
  const ToolShape* shape = &blunt_;
  if (!touch && edges_ && !carrier_.shafts.empty()) {
    touch = firstTouch(step, 0, 1, carrier_, toolProbesOnly_, {collisionPrecision});
    shape = &carrier_;
  }
  if (!touch) return;
  colliding_ = true;
  tell(describe(*touch, shape->shafts[*touch->shaft].part));
}

void FeelingProbe::feelBodies(const Motion& step) {
  // After a new zero, and where a collision is known, the distances are asked anew at the next step.
  if (colliding_ || pulledOff_ || step.profile.length() == 0) {
    guard_->forget();
    return;
  }
  const auto hit = guard_->firstHit(step, 1, whole_, BodyGuard::Touching::Counts, {});
  guard_->arrived(1);
  if (!hit) return;
  colliding_ = true;
  tell(fmt::format("{} touched \"{}\" at {} on the table",
                   hit->byTool ? fmt::format("tool {}", tool_->number) : fmt::format("the machine's \"{}\"", hit->body),
                   hit->byTool ? hit->body : hit->other, placeText(hit->point)));
}

bool FeelingProbe::bodiesTouch() const {
  return guard_ && (guard_->standing(slides_, clock_) || guard_->standing(slides_, clock_, whole_));
}

std::optional<Touch> FeelingProbe::obstacle() const {
  if (auto touch = shaftOverlap(pose(), blunt_, edges_ ? withoutToolProbes_ : all_)) return touch;
  return edges_ ? shaftOverlap(pose(), carrier_, toolProbesOnly_) : std::nullopt;
}

std::optional<Touch> FeelingProbe::edgeTouch(double turned) {
  clearance_ = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < truth_.toolProbes.size(); ++i) {
    const TrueToolProbe& probe = truth_.toolProbes[i];
    const Pose contactFromSpindle = probe.tableFromContact.inverse() * pose();
    const double gap = edges_->leastGap(contactFromSpindle, *probe.contact);
    clearance_ = std::min(clearance_, gap);
    if (gap > 0) continue;
    const int looks = edges_->round() ? 1 : 1 + static_cast<int>(std::abs(turned) / turnPerLook);
    for (int look = 0; look < looks; ++look) {
      const double degrees = spindleDegrees_ - turned * look / looks;
      const Pose contactFromCutter = contactFromSpindle * edges_->spindleFromCutter(degrees);
      for (std::size_t edge = 0; edge < edges_->count(); ++edge) {
        const EdgeDistance distance = edges_->nearest(edge, contactFromCutter, *probe.contact);
        if (distance.gap > 0) continue;
        Touch touch;
        touch.solid = i;
        touch.point = probe.tableFromContact * distance.place;
        touch.normal = distance.normal;  // frame of the contact: which way it is pushed
        return touch;
      }
    }
  }
  return std::nullopt;
}

void FeelingProbe::feelWithCutter(const Rest& whole, bool turnsTable) {
  // Finding the gap takes long: what the axes travel less than the last one needs no new look.
  clearance_ = turnsTable ? 0 : clearance_ - whole.length;
  if (pushed_) {
    const TrueToolProbe& probe = truth_.toolProbes[pushed_->touch.solid];
    if (whole.length > 0 && edges_->leastGap(probe.tableFromContact.inverse() * pose(), *probe.contact) > 0) {
      pushed_.reset();
      broken_ = false;
    } else {
      pushed_->advance(whole.length, whole.seconds);
    }
    return;
  }
  if (clearance_ > 0) return;
  const auto touch = edgeTouch(degreesPerSecond_ * whole.seconds);
  if (!touch) return;
  const TrueToolProbe& probe = truth_.toolProbes[touch->solid];
  pushed_ = Deflection{*touch, pose() * blunt_.tip, probe.pretravel, probe.signalDelay};
  if (probe.repeatability > 0) pushed_->toGo += probe.repeatability * gaussian_(noise_);
  const machine::Rotation turns = degreesPerSecond_ < 0   ? machine::Rotation::Clockwise
                                  : degreesPerSecond_ > 0 ? machine::Rotation::CounterClockwise
                                                          : machine::Rotation::None;
  const bool cuts = !tool_->cutter.teeth.empty() && turns == tool_->cutter.cutting && turns != machine::Rotation::None;
  const bool gives = probe.gives[static_cast<std::size_t>(pushOf(-touch->normal))];
  broken_ = !pulledOff_ && (cuts || !gives || !probe.switchedOn);
  if (!probe.switchedOn) pushed_->toWait = 1e300;
  tell(fmt::format("tool {} touched \"{}\"{}", tool_->number, probe.name,
                   !broken_            ? ""
                   : !probe.switchedOn ? ", which is switched off"
                   : cuts              ? " while it turned in its cutting direction"
                                       : " where it does not give way"));
}

}  // namespace probewright::simulation
