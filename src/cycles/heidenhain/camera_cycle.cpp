#include "cycles/heidenhain/camera_cycle.hpp"

#include <fmt/format.h>

#include <string>

#include "control/alarm.hpp"
#include "control/heidenhain/camera_screen.hpp"

namespace probewright::cycles::heidenhain {

using control::Alarm;
using control::Verdict;
using control::heidenhain::CameraMonitoring;
using control::heidenhain::CameraScreen;
using control::heidenhain::ImageKind;
using control::heidenhain::MonitoringPoint;
using machine::CameraEnd;
using machine::Picture;

namespace {

enum State { noError = 1, error = 2, notConfigured = 3, internalError = 10 };

constexpr const char* nameAdvice = "write QS600 = \"NAME\" with a name that a file can have";

std::string wrongName(const std::string& name, const std::string& why) {
  return fmt::format("QS600 = \"{}\" is not a name of a monitoring point: {}", name, why);
}

void requireDone(CameraEnd end) {
  if (end == CameraEnd::Cancelled) throw control::Cancelled();
}

/// One call of a cycle.
class Monitoring {
public:
  Monitoring(Context& context, CameraMonitoring& all)
      : context_(context),
        camera_(*all.camera),
        point_(all.point(context.control().programPath, context.arguments().text(600))),
        references_(context.option(617)),
        stops_(context.option(309) == 1) {}

  /// `isNew`: there was no monitoring file of this point.
  void run(CoverAfterwards cover, bool isNew) {
    const std::string question = fmt::format("{} {}", context_.record().name, point_.name);
    std::string text;
    if (const auto picture = take()) {
      store(*picture);
      if (isNew && fault_.empty()) {
        context_.warn(fmt::format("{}: there is no monitoring file {}: this image begins a new one", question,
                                  monitoringFileName(point_)));
      }
      CameraScreen screen(port(), point_, references_);
      const bool before = fault_.empty() && !point_.configured(references_);
      if (fault_.empty() && stops_ && (before || state() == error)) {
        text = fmt::format("{}: {}", question, screen.message());
        const int shown = point_.images.back().number;
        show(screen, before ? question : question + " error");
        for (const auto& image : point_.images)
          if (image.number > shown) noteImage(image);
      }
    }
    if (cover == CoverAfterwards::Closed) closeCover();
    if (!fault_.empty()) {
      text = fmt::format("{}: camera fault: {}", question, fault_);
      if (!stops_) context_.warn(text);
    }
    judge(fault_.empty() ? state() : internalError);
    if (stops_ && !text.empty()) context_.control().panel.stop(text, context_.channel().seconds());
  }

private:
  control::heidenhain::CameraScreenPort port() {
    return {.language = context_.control().panel.language,
            .show = [this](std::string text) { context_.record().screens.push_back(std::move(text)); },
            .warn = [this](std::string text) { context_.warn(std::move(text)); },
            .file = [this](const std::string& name, std::string bytes) { context_.log(name, bytes); },
            .takeAnother = [this]() -> std::optional<Picture> {
              auto another = take();
              if (another) check(*another);
              return fault_.empty() ? another : std::nullopt;
            }};
  }

  /// Shows the image and lets the operator press soft keys.
  void show(CameraScreen& screen, const std::string& question) {
    const std::string shown = screen.statusLine() + "\n" + screen.message();
    context_.record().screens.push_back(shown);
    const auto& panel = context_.control().panel;
    std::optional<std::string> reply;
    if (panel.answer) {
      reply = panel.answer(
          {question, shown + "\nsoft keys, as REFERENCE IMAGE; CONFIGURE; DRAW AREA 40 30 200 150; SAVE AND BACK; BACK",
           [](const std::string& text) { return control::heidenhain::keyStrokes(text).has_value(); }});
    }
    if (reply) return screen.operate(*reply, question);
    context_.warn(
        fmt::format("{}. No soft key is pressed for \"{}\": the image is stored as it is", screen.message(), question));
    screen.display();
  }

  std::optional<Picture> take() {
    if (!camera_.coverOpen()) {
      const machine::CameraResult opened = camera_.openCover();
      requireDone(opened.end);
      if (opened.end != CameraEnd::Done) return fails(opened.detail);
    }
    machine::PictureResult taken = camera_.takePicture();
    requireDone(taken.end);
    if (taken.end != CameraEnd::Done) return fails(taken.detail);
    return std::move(taken.picture);
  }

  /// Images of two sizes cannot be compared: the camera is another one than before.
  void check(const Picture& picture) {
    if (point_.images.empty()) return;
    const Picture before = point_.images.back().picture();
    if (before.width == picture.width && before.height == picture.height) return;
    fails(fmt::format("the image has {} x {} pixels, those of {} have {} x {}", picture.width, picture.height,
                      fileStem(point_), before.width, before.height));
  }

  void store(const Picture& picture) {
    check(picture);
    if (!fault_.empty()) return;
    if (point_.images.size() >= MonitoringPoint::mostImages) {
      throw Alarm("Too many images",
                  fmt::format("The monitoring file {} has {} images", fileStem(point_), point_.images.size()),
                  "delete images with SELECT IMAGE and DELETE IMAGE, or name another monitoring point");
    }
    noteImage(point_.add(picture));
  }

  void noteImage(const control::heidenhain::MonitoringImage& image) {
    const std::string name = imageFileName(point_, image);
    requireFile(name);
    if (image.number == 1) requireFile(monitoringFileName(point_));
    context_.control().journal.charge(image.png.size());
    context_.record().writes.push_back({monitoringFileName(point_), fmt::format("image {}", image.number), "", name});
  }

  /// The run must be able to leave a file of this name.
  void requireFile(const std::string& name) const {
    const auto& panel = context_.control().panel;
    const auto why = panel.whyNoFile ? panel.whyNoFile(name) : std::nullopt;
    if (!why) return;
    throw Alarm({}, fmt::format("The file \"{}\" of the camera cannot be written: {}", name, why->message),
                why->advice);
  }

  std::nullopt_t fails(std::string why) {
    fault_ = std::move(why);
    return std::nullopt;
  }

  void closeCover() {
    if (!camera_.coverOpen()) return;
    const machine::CameraResult closed = camera_.closeCover();
    requireDone(closed.end);
    if (closed.end != CameraEnd::Done) fails(closed.detail);
  }

  /// What is not monitored, or not seen, is neither good nor bad.
  void judge(State state) {
    const Verdict verdict = state == error ? Verdict::Rework : state == noError ? Verdict::Good : Verdict::None;
    context_.result(601, state, {.nominal = {}, .lower = {}, .upper = {}, .verdict = verdict});
    context_.record().verdict = verdict;
  }

  State state() const {
    if (!point_.configured(references_)) return notConfigured;
    return point_.images.back().found.empty() ? noError : error;
  }

  Context& context_;
  machine::Camera& camera_;
  MonitoringPoint& point_;
  int references_;
  bool stops_;
  std::string fault_;
};

}  // namespace

void cameraRules(CallRules& call) {
  const auto name = call.value(600);
  if (!name) return;
  if (const std::string why = control::heidenhain::complaintAboutName(name->text); !why.empty())
    call.add(600, wrongName(name->text, why), nameAdvice);
}

CameraMonitoring& cameraOf(Context& context) {
  const std::string& name = context.arguments().text(600);
  if (const std::string why = control::heidenhain::complaintAboutName(name); !why.empty())
    throw Alarm("Cycle parameter wrong", wrongName(name, why), nameAdvice);
  const auto& monitoring = context.control().cameraMonitoring;
  if (!monitoring) {
    throw Alarm("Function not enabled",
                "The machine is not prepared for monitoring with a camera (option 136, Visual Setup Control)",
                "give the machine a [camera] in the setup, or leave the cycle out");
  }
  return *monitoring;
}

void monitorByCamera(Context& context, CoverAfterwards cover) {
  CameraMonitoring& all = cameraOf(context);
  const std::size_t known = all.points.size();
  Monitoring monitoring(context, all);
  monitoring.run(cover, all.points.size() > known);
}

}  // namespace probewright::cycles::heidenhain
