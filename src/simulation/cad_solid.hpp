#pragma once

#include <filesystem>
#include <memory>

#include "base/diagnostic.hpp"
#include "simulation/drawing_mesh.hpp"
#include "simulation/import_options.hpp"
#include "simulation/solid.hpp"

class TopoDS_Shape;

namespace probewright::simulation {

struct CadModel;

struct CadOptions {
  /// How far triangles may leave the faces, mm, where capsules and cylinders meet them. Contacts of balls do not depend
  /// on it; smaller takes longer to load.
  double deflection = 0.01;
};

/// A solid from CAD: planes, cylinders, cones, spheres and tori in closed form, free-form faces and edges by iteration.
/// Contacts of balls are exact on the surface to 1e-6 mm; those of capsules and cylinders are found on triangles that
/// leave it by at most the deflection.
/// Loose faces and open bodies are skins that can be touched from both sides; a closed body knows its inside, and
/// whatever starts there makes contact at fraction 0.
class CadSolid final : public Solid {
public:
  explicit CadSolid(CadModel model, Diagnostics remarks = {});
  ~CadSolid() override;

  Bounds bounds() const override;
  Bounds reach() const override;
  std::optional<BallContact> firstContact(const Vector3& from, const Vector3& to, double radius) const override;
  std::optional<BallContact> firstCapsuleContact(const Vector3& from, const Vector3& to, const Vector3& axis,
                                                 double radius) const override;
  std::optional<BallContact> firstCylinderContact(const Vector3& from, const Vector3& to, const Vector3& axis,
                                                  double radius) const override;

  const TopoDS_Shape& shape() const;
  /// Its faces and edges, and how to find those near a place.
  const CadModel& model() const { return *model_; }
  /// Warnings about the file that the solid comes from: what is missing or not as it should be.
  const Diagnostics& remarks() const { return remarks_; }
  std::size_t triangleCount() const;
  DrawingMesh drawing() const;

private:
  bool isInside(const Vector3& point) const;

  std::unique_ptr<const CadModel> model_;
  Diagnostics remarks_;
};

/// Prepares a shape for contact; fails where it has no face or cannot be tessellated.
Result<std::unique_ptr<Solid>> cadSolid(const TopoDS_Shape& shape, const CadOptions& options = {});

/// All bodies (or faces, where there are no bodies) of a STEP or IGES file, in mm, in the file's own frame.
/// A file that makes OpenCASCADE crash, hang or take all memory is refused; what a shape that can be used lacks is in
/// the remarks of the solid.
Result<std::unique_ptr<Solid>> readStep(const std::filesystem::path& path, const ImportOptions& options = {});
Result<std::unique_ptr<Solid>> readIges(const std::filesystem::path& path, const ImportOptions& options = {});

/// Writes a solid that came from CAD or a recipe as STEP (AP214, mm). The header's time stamp is fixed, so the same
/// solid gives the same file. Fails for solids of triangles.
Result<void> writeStep(const Solid& solid, const std::filesystem::path& path);
Result<void> writeStep(const TopoDS_Shape& shape, const std::filesystem::path& path);

}  // namespace probewright::simulation
