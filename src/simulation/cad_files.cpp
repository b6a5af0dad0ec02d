#include <fmt/format.h>
#include <Standard_Failure.hxx>
#include <Standard_Version.hxx>

#include <algorithm>
#include <functional>
#include <future>
#include <stdexcept>
#include <string>

#include "base/file.hpp"
#include "simulation/cad_import.hpp"
#include "simulation/cad_solid.hpp"
#include "simulation/freeform_surface.hpp"
#include "simulation/import_cache.hpp"
#include "simulation/import_watch.hpp"

namespace probewright::simulation {
namespace {

/// To be counted up whenever an import makes something else of the same file, also if only its layout in memory
/// changes.
constexpr int kCacheVersion = 28;

/// About faces that STEP does not tell unmistakably: of a circle that meets its axis OpenCASCADE may turn the other
/// arc, if the face goes as far as the axis.
void warnOfDoubtfulArcs(const CadModel& model, Diagnostics& remarks) {
  const auto doubtful = std::ranges::count_if(model.faces, reachesItsAxis);
  if (doubtful == 0) return;
  const Vector3 size = model.bounds.maximum - model.bounds.minimum;
  remarks.push_back({Severity::Warning,
                     {},
                     fmt::format("{} of {} faces are circles turned about an axis that they reach (lemon, apple, horn "
                                 "torus): such faces are sometimes read with the wrong part of the circle",
                                 doubtful, model.faces.size()),
                     {},
                     fmt::format("compare the size of the part, {:.3f} x {:.3f} x {:.3f} mm, with that in the CAD "
                                 "system; if it is wrong, export as IGES",
                                 size.x(), size.y(), size.z()),
                     {}});
}

/// About faces whose weights no CAD system would write: what is proven of other splines is not of these.
void warnOfExtremeWeights(const CadModel& model, Diagnostics& remarks) {
  constexpr double kMostRatio = 1e4;
  const auto extreme =
      std::ranges::count_if(model.faces, [](const CadFace& face) { return weightRatio(face.surface) > kMostRatio; });
  if (extreme == 0) return;
  remarks.push_back({Severity::Warning,
                     {},
                     fmt::format("the weights of the splines of {} of {} faces differ by more than {:.0f} times, as by "
                                 "a wrong digit in the file: contacts there may be wrong or missing",
                                 extreme, model.faces.size(), kMostRatio),
                     {},
                     "export the part again, or repair these faces in the CAD system",
                     {}});
}

Result<std::unique_ptr<Solid>> solidOf(ImportedPart part, CadFormat format, const std::string& file, ImportWatch& watch,
                                       const std::function<CadModel()>& exact) {
  const auto broken = [&](const char* reason) -> tl::unexpected<Diagnostic> {
    if (watch.isStopped()) return tl::unexpected(watch.interrupted());
    return fail({file, 0, 0}, fmt::format("the shape cannot be prepared for contact: {}", reason),
                "export the part again as solid bodies, or as STL");
  };
  try {
    watch.tell("making it ready");
    CadModel model = exact();
    watch.goOn();
    takeElements(model, part.elements);
    watch.goOn();
    if (format == CadFormat::Step) warnOfDoubtfulArcs(model, part.remarks);
    warnOfExtremeWeights(model, part.remarks);
    for (Diagnostic& remark : part.remarks)
      remark.place.file = file;
    return std::make_unique<CadSolid>(std::move(model), std::move(part.remarks));
  } catch (const ImportStopped&) {
    return tl::unexpected(watch.interrupted());
  } catch (const Standard_Failure& failure) {
    return broken(failure.GetMessageString());
  } catch (const std::runtime_error& failure) {
    return broken(failure.what());
  }
}

Result<std::unique_ptr<Solid>> import(TransferOrder order, const ImportOptions& options) {
  order.deflection = options.deflection;
  order.facePoints = options.facePoints;
  const std::string file = order.file;
  const CadFormat format = order.format;
  ImportWatch watch(file, options);
  const ImportCache cache(options.cache);
  std::string key;
  if (!options.cache.empty()) {
    key =
        ImportCache::keyOf(order.bytes, fmt::format("{} {} {} {} {}", kCacheVersion, OCC_VERSION_COMPLETE,
                                                    static_cast<int>(format), options.deflection, options.facePoints));
    if (auto kept = cache.find(key)) {
      if (const auto part = partFromBytes(std::move(*kept))) {
        auto solid = solidOf(*part, format, file, watch,
                             [&] { return exactModel(part->shape, options.deflection, options.stop); });
        // What cannot be used is imported anew, as if nothing had been kept.
        if (solid || watch.isStopped()) return solid;
      }
    }
  }
  Result<ImportedInChild> imported = importInChild(std::move(order), options);
  if (!imported) return tl::unexpected(std::move(imported.error()));
  // While the shape is made ready.
  std::future<void> keeping;
  if (!key.empty()) {
    keeping = std::async(std::launch::async, [&cache, key, part = imported->part, stop = options.stop] {
      cache.keep(key, toBytes(part), stop);
    });
  }
  auto solid = solidOf(imported->part, format, file, watch, [&] { return imported->exact.get(); });
  if (keeping.valid()) keeping.wait();
  return solid;
}

}  // namespace

Result<std::unique_ptr<Solid>> readStep(const std::filesystem::path& path, const ImportOptions& options) {
  Result<std::string> bytes = readFile(path);
  if (!bytes) return tl::unexpected(bytes.error());
  TransferOrder order;
  order.file = path.string();
  order.bytes = std::move(*bytes);
  return import(std::move(order), options);
}

Result<std::unique_ptr<Solid>> readIges(const std::filesystem::path& path, const ImportOptions& options) {
  Result<std::string> bytes = readFile(path);
  if (!bytes) return tl::unexpected(bytes.error());
  const std::string file = path.string();
  if (bytes->find_first_not_of(" \t\r\n") == std::string::npos) {
    return fail({file, 0, 0}, "the IGES file is empty", "export the part again");
  }
  // Column 73 of every line names its section; the first line belongs to the start section.
  if (bytes->size() < 80 || (bytes->at(72) != 'S' && bytes->at(72) != 'C')) {
    return fail({file, 1, 73}, "not an IGES file: the first line has no section letter S in column 73",
                "export the part as IGES 5.3, or name a STEP or STL file with its own extension");
  }
  TransferOrder order;
  order.format = CadFormat::Iges;
  order.file = file;
  order.bytes = std::move(*bytes);
  return import(std::move(order), options);
}

}  // namespace probewright::simulation
