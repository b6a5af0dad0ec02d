#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "simulation/probe_signal.hpp"
#include "simulation/virtual_machine.hpp"

/// What tool touch probes feel of the tools.
namespace probewright::simulation {

using machine::MeasureEnd;
using machine::MeasureOrder;
using machine::MeasureResult;
using machine::Rotation;

namespace {

constexpr double obstaclePrecision = 1e-4;  // mm

constexpr std::array<const char*, 6> pushNames = {"+X", "-X", "+Y", "-Y", "+Z", "-Z"};

}  // namespace

std::optional<Touch> VirtualMachine::obstacle(const Motion& motion) const {
  const SearchOptions options = searchOptions(obstaclePrecision);
  auto first = firstTouch(motion, 0, 1, shape_, withoutToolProbes_, options);
  ToolShape carrier = shape_;
  std::erase_if(carrier.shafts, [](const Shaft& shaft) { return std::string_view(shaft.part) == cutterName; });
  const auto second = firstTouch(probesOnBed() ? onBed(motion) : motion, 0, 1, carrier, toolProbesOnly_, options);
  if (second && (!first || second->fraction < first->fraction)) {
    first = second;
    first->shaft = *second->shaft + (shape_.shafts.size() - carrier.shafts.size());  // that of the edges is the first
  }
  return first;
}

std::optional<VirtualMachine::ProbeTouch> VirtualMachine::toolProbeTouch(const Motion& motion) const {
  std::optional<ProbeTouch> first;
  const Motion seen = probesOnBed() ? onBed(motion) : motion;
  for (std::size_t i = 0; i < truth_.toolProbes.size(); ++i) {
    const TrueToolProbe& probe = truth_.toolProbes[i];
    const auto contact =
        firstEdgeContact(seen, *edges_, spin_, *probe.contact, probe.tableFromContact.inverse(), stop_);
    if (!contact || (first && first->contact.fraction <= contact->fraction)) continue;
    Touch touch;
    touch.fraction = contact->fraction;
    touch.solid = solidOfToolProbe_[i];
    touch.shaft = 0;
    touch.point = probe.tableFromContact * contact->place;
    touch.normal = probe.tableFromContact.linear() * contact->normal;
    touch.ballCentre = seen.tableFromSpindleAt(contact->fraction) * shape_.tip;
    first = ProbeTouch{i, *contact, touch};
  }
  return first;
}

/// From the touch to the signal, as of a touch probe.
MeasureResult VirtualMachine::signalOfTool(const Motion& motion, const ProbeTouch& touched) {
  const TrueToolProbe& probe = truth_.toolProbes[touched.probe];
  std::string detail = tellsTouches_ ? describe(touched.touch) : std::string();
  if (tellsTouches_ && !tool_->cutter.teeth.empty()) detail += fmt::format(" with tooth {}", touched.contact.edge + 1);
  const double length = motion.profile.length();
  const double contact = touched.contact.fraction * length;
  const auto broken = [&](std::string why) {
    advance(motion, Stop{touched.touch, std::nullopt, touched.contact.fraction}, PathKind::Measure);
    return MeasureResult{MeasureEnd::Collision, reading_, tellsTouches_ ? detail + why : ranIntoSomething};
  };
  const bool turns = spin_.degreesPerSecond != 0 && !tool_->cutter.teeth.empty();
  if (turns && carrying().rotation == tool_->cutter.cutting)
    return broken(", which turned in its cutting direction and cut into the contact");
  const Push push = pushOf(-touched.contact.normal);
  if (!probe.gives[static_cast<std::size_t>(push)])
    return broken(fmt::format("; the contact does not give way in {}", pushNames[static_cast<std::size_t>(push)]));
  double signal = contact + probe.pretravel + motion.profile.speedAt(contact) * probe.signalDelay;
  if (probe.repeatability > 0) signal += probe.repeatability * gaussian_(noise_);
  signal = std::max(signal, 0.0);
  const double stop = std::min(std::max(signal, contact) + motion.profile.brakingDistanceAt(contact), length);
  if (signal > length) {
    advance(motion, Stop{}, PathKind::Measure);
    toolContact_ = touched.touch;
    return {
        MeasureEnd::NoContact, reading_,
        tellsTouches_ ? "the target was reached before the contact was deflected enough for a signal" : reachedText};
  }
  advance(motion, Stop{touched.touch, length > 0 ? signal / length : 0, length > 0 ? stop / length : 0},
          PathKind::Measure);
  toolContact_ = touched.touch;
  // A turning edge pushes the contact once a turn: deep enough for a signal where it has touched it first. Only the
  // delay of the signal lets it turn on.
  const double degrees = std::remainder(touched.contact.degrees + spin_.degreesPerSecond * probe.signalDelay, 360);
  return {MeasureEnd::Touched, motion.readingAt(length > 0 ? signal / length : 0), std::move(detail), degrees};
}

MeasureResult VirtualMachine::measureTool(const MeasureOrder& order) {
  const auto end = [&](MeasureEnd how, std::string detail) { return MeasureResult{how, reading_, std::move(detail)}; };
  if (stop_.stop_requested()) return end(MeasureEnd::Cancelled, stoppedText);
  if (truth_.toolProbes.empty()) return end(MeasureEnd::NotReady, "this machine has no tool touch probe");
  if (!tool_) return end(MeasureEnd::NotReady, "there is no tool in the spindle");
  if (!edges_)
    return end(MeasureEnd::NotReady,
               "there is a touch probe in the spindle, which the tool touch probe cannot measure");
  if (std::ranges::none_of(truth_.toolProbes, &TrueToolProbe::switchedOn))
    return end(MeasureEnd::NotReady, "the tool touch probe is switched off");
  if (auto refused = refusal(order.feed, order.target)) return refusedMeasurement(*std::move(refused));
  if (toolContact_) return end(MeasureEnd::DeflectedAtStart, toolSignal());
  if (auto limit = beyondTravel(order.target)) return end(MeasureEnd::AxisLimit, *limit);
  const Motion motion = motionTo(order.target, order.feed);
  std::optional<Touch> obstacleMet;
  std::optional<ProbeTouch> touched;
  std::optional<BodyHit> hit;
  try {
    obstacleMet = obstacle(motion);
    touched = toolProbeTouch(motion);
    const bool obstacleFirst = obstacleMet && (!touched || obstacleMet->fraction < touched->contact.fraction);
    hit = bodyHit(motion, obstacleFirst ? obstacleMet : touched ? std::optional(touched->touch) : std::nullopt);
  } catch (const SearchStopped& stopped) {
    standAt(motion, stopped.fraction, PathKind::Measure);
    return end(MeasureEnd::Cancelled, stoppedText);
  }
  if (hit) {
    std::string detail = stopAt(motion, *hit, PathKind::Measure);
    return end(MeasureEnd::Collision, std::move(detail));
  }
  if (obstacleMet && (!touched || obstacleMet->fraction < touched->contact.fraction)) {
    advance(motion, Stop{obstacleMet, std::nullopt, obstacleMet->fraction}, PathKind::Measure);
    return end(MeasureEnd::Collision, describe(*obstacleMet));
  }
  if (!touched) {
    advance(motion, Stop{}, PathKind::Measure);
    return end(MeasureEnd::NoContact, reachedText);
  }
  if (!truth_.toolProbes[touched->probe].switchedOn) {
    advance(motion, Stop{touched->touch, std::nullopt, touched->touch.fraction}, PathKind::Measure);
    return end(MeasureEnd::Collision, describe(touched->touch) + (tellsTouches_ ? ", which is switched off" : ""));
  }
  return signalOfTool(motion, *touched);
}

}  // namespace probewright::simulation
