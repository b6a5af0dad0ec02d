#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "control/alarm.hpp"
#include "control/sinumerik/master_spindle.hpp"
#include "execution/sinumerik/functions.hpp"
#include "execution/sinumerik/host.hpp"
#include "execution/sinumerik/spindle_speed.hpp"
#include "geometry/decompositions.hpp"
#include "language/sinumerik/check.hpp"
#include "language/sinumerik/keywords.hpp"
#include "language/sinumerik/statement_kinds.hpp"

/// G functions, by number, by their place in a group, and by name.
namespace probewright::execution::sinumerik {

using control::Alarm;
using control::sinumerik::Frame;

void SinumerikHost::carryOut(const Modal& modal, Evaluation& evaluation) {
  const std::string_view name = evaluation.at(modal.name);
  const auto words = evaluation.words(modal.words);
  const std::optional<int> number = language::sinumerik::gFunction(name);
  // G26 S5000 is a limit of the spindle.
  const bool ofSpindle = (number == 25 || number == 26) &&
                         std::ranges::all_of(words, [](const Word& word) { return (word.address & 0xff) == 'S'; });
  if (const std::string_view how = skippedFunction(name); !how.empty() && !ofSpindle) skip(name, how);
  const ModalKind kind = language::sinumerik::modalKind(name);
  if (kind == ModalKind::TransformationOn) {
    std::vector<std::optional<double>> arguments;
    for (const Word& word : words)
      arguments.push_back(word.value.present() ? std::optional(evaluation.number(word.value)) : std::nullopt);
    if (const std::string_view what = skippedTransformation(arguments); !what.empty()) skip(what);
  }
  const auto value = [&] { return evaluation.number(words.front().value); };
  enum DiameterCode { DIAMOF = 1, DIAMON = 2, DIAM90 = 3 };  // places in G group 29
  const auto setDiameter = [&](DiameterCode code) {
    control_.diameter = code != DIAMOF;
    state_.gGroup[29] = code;
  };
  const auto transform = [&] {
    motion_.flush();
    control_.transformation = kind == ModalKind::TransformationOn;
    control_.useKinematics();
    control_.handOverFrames();
  };
  switch (kind) {
    case ModalKind::GFunction:
      return carryOutG(*number);
    case ModalKind::Feed:
      if (!words.empty()) state_.feed = value();
      return;
    case ModalKind::SpindleSpeed:
      if (!words.empty()) setSpeed(words, evaluation);
      return;
    case ModalKind::AuxiliaryFunction:
      return skip("the auxiliary function H");
    case ModalKind::CuttingEdge:
      if (!words.empty()) selectEdge(wholeNumber(value()));
      return;
    case ModalKind::DiameterOn:
      return setDiameter(DIAMON);
    case ModalKind::DiameterIfAbsolute:
      return setDiameter(DIAM90);
    case ModalKind::DiameterOff:
      return setDiameter(DIAMOF);
    case ModalKind::TransformationOn:
    case ModalKind::TransformationOff:
      return transform();
    case ModalKind::OrientationEuler:
    case ModalKind::OrientationRpy:
    case ModalKind::OrientationRpyFromX:
      state_.rpyAngles = kind != ModalKind::OrientationEuler;
      state_.rpyAboutX = kind == ModalKind::OrientationRpyFromX;
      return;
    case ModalKind::TurnFrameToTool:
    case ModalKind::PutFrameOnTool:
      motion_.flush();
      return alignFrameWithTool(kind == ModalKind::PutFrameOnTool);
    case ModalKind::FrameOfToolOff:
      motion_.flush();
      control_.frames.toolOriented = {};
      return control_.handOverFrames();
    case ModalKind::Other:
      if (language::sinumerik::keywordOf(name) == language::sinumerik::Keyword::Motion) chooseMotion(name);
      return;
  }
}

/// CIP, CT, and the splines, whose lines go straight.
void SinumerikHost::chooseMotion(std::string_view name) {
  state_.thread = 0;
  state_.otherPath = name != "CIP" && name != "CT";
  state_.group1 = name == "CIP" ? MoveKind::ArcThroughPoint : name == "CT" ? MoveKind::ArcTangential : MoveKind::Linear;
}

/// S; S2= and S[2]= are the speeds of other spindles.
void SinumerikHost::setSpeed(std::span<const Word> words, Evaluation& evaluation) {
  const double value = evaluation.number(words[0].value);
  const int named = words[0].address == addressOf("S")    ? masterSpindle(control_)
                    : words[0].address == addressOf("S1") ? control::sinumerik::mainSpindle
                    : words[0].address == addressOf("S2") ? control::sinumerik::drivenTools
                                                          : 0;
  const int spindle = words.size() > 1 ? wholeNumber(evaluation.number(words[1].value)) : named;
  if (spindle != control::sinumerik::mainSpindle) return setToolSpeed(spindle, value);
  state_.spindleSpeed = value;
  followSpeed();
}

/// D.
void SinumerikHost::selectEdge(int number) {
  motion_.flush();
  // T and D of the next tool are before M6, in its block or while no tool is in the spindle.
  const bool changesHere = block_ != nullptr && std::ranges::any_of(block_->instructions, [](const auto& each) {
                             const auto* function = std::get_if<MachineFunction>(&each);
                             return function != nullptr && function->number == 6;
                           });
  const bool noToolYet = control_.tool.number == 0 && preparedTool_ > 0 && number > 0;
  if (preparedTool_ >= 0 && (changesHere || noToolYet)) {
    edgeAfterChange_ = number;
    return;
  }
  control_.selectEdge(number);
  control_.handOverFrames();
}

void SinumerikHost::carryOutG(int number) {
  auto& groups = state_.gGroup;
  const auto settable = [&](int frame) {
    motion_.flush();
    control_.activateSettable(frame);
  };
  if (number >= 54 && number <= 57) {
    groups[8] = number - 52;
    return settable(number - 53);
  }
  if (number >= 505 && number <= 599) {
    groups[8] = number - 499;
    return settable(number - 500);
  }
  switch (number) {
    case 0:
    case 1:
    case 2:
    case 3: {
      static constexpr MoveKind kinds[] = {MoveKind::Rapid, MoveKind::Linear, MoveKind::ArcClockwise,
                                           MoveKind::ArcCounterclockwise};
      state_.group1 = kinds[number];
      state_.thread = 0;
      state_.otherPath = false;
      groups[1] = number + 1;
      return;
    }
    case 33:
    case 34:
    case 35:
    case 63:
    case 331:
    case 332:
    case 335:
    case 336:
      state_.group1 = MoveKind::Linear;
      state_.otherPath = false;
      state_.thread = number == 63 ? 0 : number;  // G63 has a feed of its own
      return;
    case 291:
      throw Alarm("14011", "G291: programs of the ISO dialect are not available",
                  "write the program in the language of the control");
    case 17:
    case 18:
    case 19:
      groups[6] = number - 16;
      motion_.flush();
      control_.plane = number;
      return control_.handOverFrames();
    case 40:
      return motion_.setCompensation(RadiusCompensation::Off);
    case 41:
      return motion_.setCompensation(RadiusCompensation::Left);
    case 42:
      return motion_.setCompensation(RadiusCompensation::Right);
    case 450:
    case 451:
      state_.cornerArc = number == 450;
      groups[18] = number - 449;
      return;
    case 70:
    case 700:
    case 71:
    case 710: {
      const bool inch = number == 70 || number == 700;
      control_.unit = inch ? 25.4 : 1;
      state_.feedInInch = number == 700;
      groups[13] = number == 70 ? 1 : number == 71 ? 2 : number == 700 ? 3 : 4;
      return;
    }
    case 90:
    case 91:
      state_.incremental = number == 91;
      groups[14] = number - 89;
      return;
    case 93:
    case 94:
    case 95:
    case 96:
    case 97:
    case 961:
    case 962:
    case 971:
    case 972:
    case 973:
      motion_.flush();
      setFeedType(state_, number, control_.channel.position(),
                  block_ != nullptr && std::ranges::any_of(block_->instructions, [this](const Instruction& each) {
                    const auto* modal = std::get_if<Modal>(&each);
                    return modal != nullptr && block_->at(modal->name) == "S";
                  }));
      groups[15] = number < 100    ? number - 92
                   : number == 961 ? 7
                   : number == 971 ? 8
                   : number == 962 ? 11
                   : number == 972 ? 12
                                   : 13;
      return followSpeed();
    case 500:
      groups[8] = 1;
      return settable(0);
    default:
      return;
  }
}

/// G[group]=number: the function that has this place in its group.
void SinumerikHost::carryOutGroup(int group, int number) {
  const auto refuse = [&] {
    throw Alarm("12470", fmt::format("G[{}]={}: the group has no such function", group, number),
                "numbers count from 1 in the order of the list of G functions");
  };
  const auto choose = [&](std::span<const int> functions) {
    if (number < 1 || number > static_cast<int>(functions.size())) refuse();
    carryOutG(functions[static_cast<std::size_t>(number - 1)]);
  };
  static constexpr int motions[] = {0, 1, 2, 3}, planes[] = {17, 18, 19}, compensations[] = {40, 41, 42},
                       units[] = {70, 71, 700, 710}, dimensions[] = {90, 91},
                       feeds[] = {93, 94, 95, 96, 97, 931, 961, 971, 942, 952, 962, 972, 973}, corners[] = {450, 451};
  switch (group) {
    case 1:
      return choose(motions);
    case 6:
      return choose(planes);
    case 7:
      return choose(compensations);
    case 8:
      if (number < 1 || number > 100) refuse();
      return carryOutG(number == 1 ? 500 : number <= 5 ? 52 + number : 499 + number);
    case 13:
      return choose(units);
    case 14:
      return choose(dimensions);
    case 15:
      return choose(feeds);
    case 18:
      return choose(corners);
    case 29:
      if (number < 1 || number > 4) refuse();
      control_.diameter = number == 2 || number == 3;
      state_.gGroup[29] = number;
      return;
    default:
      if (group < 1 || group >= static_cast<int>(state_.gGroup.size()) || number < 0) refuse();
      if (isSkippedGroup(group, number)) skip(fmt::format("G[{}]={}", group, number));
  }
}

/// TOROT: Z of the program lies along the tool, turned the shortest way; TOFRAME: and the tool tip is its origin.
void SinumerikHost::alignFrameWithTool(bool withOrigin) {
  Frame& frame = control_.frames.toolOriented;
  const Eigen::Affine3d program = control_.machineFromWorkpiece();
  const Vector3 along = program.linear() * control_.channel.toolAxis().vector();
  const Vector3 tip = program * control_.channel.position().vector();
  const Eigen::Affine3d outer =
      control_.machineFromBase() * control::sinumerik::transform(control_.frames.settableFrame);
  const Vector3 direction = (outer.linear().inverse() * along).normalized();
  Eigen::Affine3d turned = Eigen::Affine3d::Identity();
  turned.linear() = shortestTurn(Vector3::UnitZ(), direction).toRotationMatrix();
  if (withOrigin) turned.translation() = outer.inverse() * tip;
  const auto aligned = control::sinumerik::frameFromTransform(turned);
  if (!aligned) throw Alarm("18314", aligned.error().message, aligned.error().advice);
  frame = *aligned;
  if (withOrigin) control_.frames.programmed = {};
  control_.handOverFrames();
}

}  // namespace probewright::execution::sinumerik
