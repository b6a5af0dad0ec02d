#include "simulation/cad_import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <vector>

#include "simulation/child_process.hpp"
#include "simulation/entity_names.hpp"
#include "simulation/import_watch.hpp"

namespace probewright::simulation {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostNamed = 10;
constexpr int kMostAttempts = 3;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::pair<std::string_view, std::string_view> firstWord(std::string_view line) {
  const std::size_t blank = line.find(' ');
  if (blank == std::string_view::npos) return {line, {}};
  return {line.substr(0, blank), line.substr(blank + 1)};
}

class Import {
public:
  Import(TransferOrder order, const ImportOptions& options)
      : order_(std::move(order)), options_(options), watch_(order_.file, options_) {}

  Result<ImportedInChild> run() {
    for (attempt_ = 1;; ++attempt_) {
      begin();
      const ChildEnd end = inChild(
          [&](const ChildVoice& voice) {
            transferCad(order_, voice);
            return std::string();
          },
          {options_.seconds - secondsSince(start_), options_.bytes}, [&](std::string_view line) { hear(line); },
          [&](double processorSeconds) { return hasEnough(processorSeconds); },
          [&](HandedBytes bytes) { return receive(std::move(bytes)); });
      if (options_.stop.stop_requested()) return tl::unexpected(watch_.interrupted());
      if (auto read = readText(); !read) return tl::unexpected(std::move(read.error()));
      const bool whole = pieces_.size() == 2;
      if (end.how == ChildEnd::How::Finished && failure_.empty() && unable_.label.empty() && !nothing_ && whole)
        return ImportedInChild{partOf(), std::move(exact_)};
      if (end.how == ChildEnd::How::Finished) return tl::unexpected(refused());
      if (!tryOtherwise(end)) return tl::unexpected(complaint(end));
    }
  }

private:
  struct Suspect {
    std::string label, reason;
  };
  struct Gap {
    std::string label, size;
  };
  struct Grid {
    int face = 0;
    std::string cell, kind;
  };

  const char* kind() const { return order_.format == CadFormat::Step ? "STEP" : "IGES"; }

  void begin() {
    // Threads must not be in the middle of something when a process is started.
    letThreadsEnd();
    pieces_.clear();
    open_.clear();
    suspects_.clear();
    lost_.clear();
    grids_.clear();
    gaps_.clear();
    unable_ = {};
    scale_.clear();
    unitless_.clear();
    misplaced_.clear();
    unused_ = {};
    failure_.clear();
    edges_.clear();
    at_.clear();
    skin_ = nothing_ = meshing_ = preparing_ = false;
    faces_ = done_ = 0;
    used_ = usedAtLastSign_ = 0;
  }

  void letThreadsEnd() const {
    if (exact_.valid()) exact_.wait();
    if (text_.valid()) text_.wait();
  }

  /// Reads the text of a STEP file meanwhile, for what is wrong with it and for the names of its entities.
  void beginText() {
    if (text_.valid() || names_ || wrongText_) return;
    text_ = std::async(std::launch::async, [this]() -> Result<StepText> {
      if (const auto number = endlessNumber(order_.bytes)) {
        return tl::unexpected(mistake(number->line, fmt::format("the number {} is too large", number->text),
                                      "the file is damaged there; export or copy the part again"));
      }
      if (order_.format == CadFormat::Iges) return StepText{};
      return scanStep(order_.bytes, order_.file, options_.stop);
    });
  }

  /// Waits for the text.
  Result<void> readText() {
    beginText();
    if (text_.valid()) {
      Result<StepText> text = text_.get();
      if (text)
        names_.emplace(order_.format, std::move(*text), order_.bytes);
      else
        wrongText_ = std::move(text.error());
    }
    if (wrongText_) return tl::unexpected(*wrongText_);
    return {};
  }

  bool textIsWrong() {
    if (text_.valid() && text_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
    return !readText();
  }

  /// The shape, and then all that is made of it. True if there is nothing more to come.
  bool receive(HandedBytes bytes) {
    pieces_.push_back(std::move(bytes));
    if (pieces_.size() == 1) {
      // It may begin and end later than this import is there.
      exact_ = std::async(std::launch::async, [shape = pieces_.front().view(), deflection = order_.deflection,
                                               stop = options_.stop] { return exactModel(shape, deflection, stop); });
    }
    return pieces_.size() == 2;
  }

  void hear(std::string_view line) {
    beginText();
    usedAtLastSign_ = used_;
    const auto [word, rest] = firstWord(line);
    if (word == "on") {
      open_[numberIn(rest)] = used_;
    } else if (word == "stage") {
      stage_ = rest;
      watch_.tell(stage_);
      meshing_ = stage_.starts_with("meshing");
      preparing_ = stage_.starts_with("preparing");
    } else if (word == "begin") {
      open_[numberIn(rest)] = used_;
    } else if (word == "end") {
      open_.erase(numberIn(rest));
      ++done_;
    } else if (word == "faces") {
      faces_ = numberIn(rest);
    } else if (word == "at") {
      at_ = rest;
    } else if (word == "lost") {
      lost_.emplace_back(rest);
    } else if (word == "suspect") {
      const auto [label, reason] = firstWord(rest);
      suspects_.push_back({std::string(label), plainReason(std::string(reason))});
    } else if (word == "grid") {
      const auto [face, more] = firstWord(rest);
      const auto [cell, surface] = firstWord(more);
      grids_.push_back({numberIn(face), std::string(cell), std::string(surface)});
    } else if (word == "gap") {
      const auto [label, size] = firstWord(rest);
      gaps_.push_back({std::string(label), std::string(size)});
    } else if (word == "misplaced") {
      const auto [label, reason] = firstWord(rest);
      misplaced_.push_back({std::string(label), plainReason(std::string(reason))});
    } else if (word == "unitless") {
      unitless_ = rest;
    } else if (word == "unused") {
      const auto [label, count] = firstWord(rest);
      unused_ = {std::string(label), std::string(count)};
    } else if (word == "scaled") {
      scale_ = rest;
    } else if (word == "unable") {
      const auto [label, reason] = firstWord(rest);
      unable_ = {std::string(label), std::string(reason)};
    } else if (word == "open") {
      edges_ = rest;
    } else if (word == "failed") {
      failure_ = plainReason(std::string(rest));
    } else if (word == "skin") {
      skin_ = true;
    } else if (word == "nothing") {
      nothing_ = true;
    }
  }

  bool hasEnough(double processorSeconds) {
    used_ = std::max(used_, processorSeconds);
    tellProgress();
    if (options_.stop.stop_requested() || textIsWrong()) return true;
    if (!meshing_ || order_.gridAll) return false;
    const bool faceHangs =
        std::ranges::any_of(open_, [&](const auto& entry) { return used_ - entry.second > options_.faceSeconds; });
    // Before its faces the mesher does all edges, without a word.
    return faceHangs || (open_.empty() && used_ - usedAtLastSign_ > 30 * options_.faceSeconds);
  }

  void tellProgress() {
    const std::string count = meshing_ && done_ > 0 ? fmt::format(", {} of {}", std::min(done_, faces_), faces_) : "";
    watch_.tell(stage_ + count);
  }

  /// True if it is worth another try without the faces that the mesher does not get over.
  bool tryOtherwise(const ChildEnd& end) {
    const bool hopeless = end.how == ChildEnd::How::NoProcess || end.how == ChildEnd::How::OutOfTime;
    if (hopeless || !meshing_ || order_.gridAll) return false;
    const double longest = end.how == ChildEnd::How::Ended ? options_.faceSeconds / 2 : 0;
    bool found = false;
    for (const auto& [face, begun] : open_) {
      if (used_ - begun >= longest) found = order_.gridFaces.insert(face).second || found;
    }
    if (!found || attempt_ >= kMostAttempts) order_.gridAll = true;
    return true;
  }

  Diagnostic mistake(std::uint64_t line, const std::string& reason, std::string advice = {}) const {
    if (advice.empty())
      advice = fmt::format("export the part again as {}",
                           order_.format == CadFormat::Step ? "STEP (AP203, AP214 or AP242)" : "IGES 5.3 or as STEP");
    return fail({order_.file, line, 0}, fmt::format("the {} file cannot be read: {}", kind(), reason),
                std::move(advice))
        .value();
  }

  /// About an entity that cannot be right.
  std::optional<Diagnostic> blame() const {
    if (names_->holdsOnlyTriangles()) {
      return mistake(0, "it holds triangles only (a tessellated model of AP242), no exact surfaces",
                     "export the part with exact geometry (B-rep), or as STL");
    }
    if (names_->holdsNoFace()) return names_->holdsConstructions() ? constructed() : faceless();
    if (!suspects_.empty() && names_->overlongLine() != 0) {
      return mistake(names_->overlongLine(),
                     "its parameters go beyond column 64, where IGES has the number of the directory entry",
                     "the system that wrote the file does not keep to IGES; export the part as STEP, or with another "
                     "system");
    }
    if (!suspects_.empty()) {
      const Suspect& first = suspects_.front();
      return mistake(names_->lineOf(first.label), fmt::format("{}: {}", names_->nameOf(first.label), first.reason),
                     "the file is damaged in this entity; export or copy the part again");
    }
    if (const auto [label, reason] = names_->wrongInText(); !label.empty()) {
      return mistake(names_->lineOf(label), fmt::format("{}: {}", names_->nameOf(label), reason),
                     "the file is damaged in this entity; export or copy the part again");
    }
    return std::nullopt;
  }

  Diagnostic refused() {
    if (!unable_.label.empty()) {
      const std::size_t end = unable_.reason.find('|');
      return mistake(names_->lineOf(unable_.label),
                     fmt::format("{}: {}", names_->nameOf(unable_.label), unable_.reason.substr(0, end)),
                     unable_.reason.substr(std::min(end, unable_.reason.size() - 1) + 1));
    }
    if (auto blamed = blame()) return *blamed;
    if (!failure_.empty()) return mistake(0, failure_);
    if (!unused_.label.empty()) {
      return mistake(names_->lineOf(unused_.label),
                     fmt::format("of its {} faces, the first {}, none belongs to the shape of a product in a way "
                                 "that can be read",
                                 unused_.size, names_->nameOf(unused_.label)),
                     "export the part again as a solid body (AP203, AP214 or AP242)");
    }
    return faceless();
  }

  Diagnostic constructed() const {
    return mistake(0, "its bodies are put together of simple solids (CSG), not of faces",
                   "export the part with exact faces (B-rep)");
  }

  Diagnostic faceless() const {
    std::string files;
    constexpr std::string_view kReference = "DOCUMENT_FILE('";
    for (std::size_t at = 0, count = 0; (at = order_.bytes.find(kReference, at)) != std::string::npos;) {
      at += kReference.size();
      const std::size_t end = std::min(order_.bytes.find('\'', at), order_.bytes.size());
      if (end == at) continue;
      if (++count > 3) {
        files += " ...";
        break;
      }
      files += fmt::format("{}\"{}\"", files.empty() ? "" : ", ", order_.bytes.substr(at, end - at));
    }
    if (!files.empty()) {
      return fail({order_.file, 0, 0}, "the file holds no body and no face; its parts are in other files: " + files,
                  "export the assembly as one file, or name the file of a part")
          .value();
    }
    return fail({order_.file, 0, 0}, "the file holds no body and no face",
                "export the part as a solid body, not as a drawing, wire frame, finite elements or empty assembly")
        .value();
  }

  Diagnostic complaint(const ChildEnd& end) {
    using How = ChildEnd::How;
    if (end.how == How::NoProcess) {
      return mistake(0, "no process can be started for it: " + end.result, "close other programs and try again");
    }
    if (end.how == How::OutOfTime) {
      return mistake(0, fmt::format("{} takes longer than {:.0f} s", stage_, options_.seconds),
                     "simplify the part, or export it as STL");
    }
    if (auto blamed = blame()) return *blamed;
    const bool memory = end.how == How::OutOfMemory;
    const char* what = memory ? "takes too much memory" : "makes OpenCASCADE crash";
    const std::string label = preparing_ || meshing_ ? std::string() : culprit();
    if (label.empty()) {
      return mistake(0, fmt::format("{} {}", stage_.empty() ? "reading it" : stage_, what),
                     memory ? "simplify the part, or export it as STL" : "");
    }
    return mistake(names_->lineOf(label), fmt::format("{} {}", names_->nameOf(label), what),
                   memory ? "simplify the part, or export it as STL; one wrong letter in this entity can do that, too"
                          : "the file is damaged in this entity or in one that it refers to; export or copy the part "
                            "again");
  }

  /// The entity that a crash is about: the face if one alone does it, else the body.
  std::string culprit() {
    const std::string body = at_;
    if (body.empty()) return {};
    at_.clear();
    letThreadsEnd();
    const ChildEnd end = inChild(
        [&](const ChildVoice& voice) {
          searchFaces(order_, voice);
          return std::string();
        },
        {std::min(60.0, options_.seconds), options_.bytes}, [&](std::string_view line) { hear(line); },
        [&](double) { return options_.stop.stop_requested(); });
    return end.how == ChildEnd::How::Crashed && !at_.empty() ? at_ : body;
  }

  void remark(ImportedPart& part, std::uint64_t line, std::string message, std::string advice) const {
    part.remarks.push_back({Severity::Warning, {{}, line, 0}, std::move(message), {}, std::move(advice), {}});
  }

  ImportedPart partOf() const {
    ImportedPart part;
    for (const std::string& label : lost_) {
      if (part.remarks.size() == kMostNamed) {
        remark(part, 0, fmt::format("{} more faces are missing", lost_.size() - kMostNamed), {});
        break;
      }
      std::string reason;
      for (const Suspect& suspect : suspects_) {
        if (suspect.label == label) reason = ": " + suspect.reason;
      }
      remark(part, names_->lineOf(label),
             fmt::format("the face {} cannot be read and is missing{}", names_->nameOf(label), reason),
             "the probe passes through where it should be; export the part again");
    }
    if (!edges_.empty()) {
      std::vector<std::string> words;
      std::istringstream stream(edges_);
      for (std::string word; stream >> word;)
        words.push_back(word);
      words.resize(4);
      remark(part, 0,
             fmt::format("the surface is not closed: {} edges belong to one face only, one of them near "
                         "X{} Y{} Z{} of the part",
                         words[0], words[1], words[2], words[3]),
             "the probe meets only the faces there are; export the part again as one solid body");
    } else if (skin_) {
      remark(part, 0, "the file holds faces, but no solid body",
             "the probe meets the faces from both sides; export the part as one solid body if it is one");
    }
    for (std::size_t i = 0; i < gaps_.size(); ++i) {
      if (i == kMostNamed) {
        remark(part, 0, fmt::format("{} more faces do not fit their edges", gaps_.size() - kMostNamed), {});
        break;
      }
      const bool hasNoPlace = gaps_[i].size == "inf", isEndless = gaps_[i].size == "endless";
      remark(part, names_->lineOf(gaps_[i].label),
             fmt::format("the face {} does not fit its edges: {}", names_->nameOf(gaps_[i].label),
                         hasNoPlace  ? "they have no place on its surface"
                         : isEndless ? "they run round its surface, and nothing ends it on one side of them"
                                     : "they, their corners and its surface are up to " + gaps_[i].size + " mm apart"),
             fmt::format("contacts there may be wrong{}; compare the part with that in the CAD system, export it again",
                         hasNoPlace || isEndless ? "" : " by as much"));
    }
    for (std::size_t i = 0; i < std::min(misplaced_.size(), kMostNamed); ++i) {
      remark(part, names_->lineOf(misplaced_[i].label),
             fmt::format("{} cannot be read: {}", names_->nameOf(misplaced_[i].label), misplaced_[i].reason),
             "bodies may be missing or stand elsewhere; the file is damaged in this entity: export or copy it again");
    }
    if (!unitless_.empty()) {
      remark(part, names_->lineOf(unitless_),
             fmt::format("{}: its lengths have no unit that can be read", names_->nameOf(unitless_)),
             "the part may have a wrong size; compare the size of the part with that in the CAD system, or export it "
             "again");
    }
    if (!scale_.empty()) {
      remark(part, 0, fmt::format("the model is drawn {} times its true size; the part has its true size", scale_),
             "compare the size of the part with that in the CAD system, or export it in a scale of 1");
    }
    const bool somethingWrong = !part.remarks.empty() && (!skin_ || !lost_.empty() || !edges_.empty());
    for (std::size_t i = 0; somethingWrong && i < std::min(suspects_.size(), kMostNamed); ++i) {
      if (std::ranges::find(lost_, suspects_[i].label) != lost_.end()) continue;
      remark(part, names_->lineOf(suspects_[i].label),
             fmt::format("{} cannot be read: {}", names_->nameOf(suspects_[i].label), suspects_[i].reason),
             "the file is damaged in this entity; export or copy the part again");
    }
    for (const Grid& grid : grids_) {
      if (grid.cell == "0.000") {
        remark(part, 0, fmt::format("face {} of {} ({}) cannot be meshed and is missing", grid.face, faces_, grid.kind),
               "the probe passes through where it should be; export the part again");
        continue;
      }
      remark(part, 0,
             fmt::format("face {} of {} ({}) cannot be meshed{} and gets a grid with cells of up to {} mm", grid.face,
                         faces_, grid.kind, attempt_ > 1 ? " in time" : "", grid.cell),
             "balls meet it as exactly as other faces; stylus and body may stop up to a cell outside its border");
    }
    part.shape = pieces_[0].view();
    part.elements = pieces_[1].view();
    part.storage = std::make_shared<const std::vector<HandedBytes>>(pieces_);
    return part;
  }

  TransferOrder order_;
  const ImportOptions& options_;
  std::optional<EntityNames> names_;
  std::optional<Diagnostic> wrongText_;
  Clock::time_point start_ = Clock::now();
  ImportWatch watch_;
  int attempt_ = 1;

  // What the child has said.
  std::map<int, double> open_;  ///< the faces it is at, and what of the processor it had used at their last point
  double used_ = 0, usedAtLastSign_ = 0;  ///< seconds of the processor
  std::vector<Suspect> suspects_;
  std::vector<std::string> lost_;
  std::vector<Grid> grids_;
  std::vector<Gap> gaps_;
  Suspect unable_;
  std::string scale_;
  std::string unitless_;
  std::vector<Suspect> misplaced_;
  Gap unused_;  ///< the first of so many faces
  std::string stage_, failure_, edges_, at_;
  bool skin_ = false, nothing_ = false, meshing_ = false, preparing_ = false;
  int faces_ = 0, done_ = 0;
  std::vector<HandedBytes> pieces_;

  // What is done meanwhile; they wait for their threads, and come first to go.
  std::future<CadModel> exact_;
  std::future<Result<StepText>> text_;
};

}  // namespace

Result<ImportedInChild> importInChild(TransferOrder order, const ImportOptions& options) {
  return Import(std::move(order), options).run();
}

}  // namespace probewright::simulation
