#include "simulation/solid_recipe.hpp"

#include <fmt/format.h>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRepFilletAPI_MakeChamfer.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <Message_ProgressIndicator.hxx>
#include <Message_ProgressScope.hxx>
#include <ShapeUpgrade_UnifySameDomain.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Shape.hxx>
#include <array>
#include <gp_Circ.hxx>

namespace probewright::simulation {
namespace {

constexpr std::array<std::pair<std::string_view, FeatureShape>, 10> kNames{{{"box", FeatureShape::Box},
                                                                            {"cylinder", FeatureShape::Cylinder},
                                                                            {"cone", FeatureShape::Cone},
                                                                            {"sphere", FeatureShape::Sphere},
                                                                            {"torus", FeatureShape::Torus},
                                                                            {"hole", FeatureShape::Hole},
                                                                            {"pocket", FeatureShape::Pocket},
                                                                            {"slot", FeatureShape::Slot},
                                                                            {"chamfer", FeatureShape::Chamfer},
                                                                            {"fillet", FeatureShape::Fillet}}};

constexpr double kLargest = 1e5;

bool isLength(double value) { return value > 0 && value <= kLargest; }
bool isLengthOrZero(double value) { return value >= 0 && value <= kLargest; }

bool treatsEdges(const SolidFeature& f) { return f.shape == FeatureShape::Chamfer || f.shape == FeatureShape::Fillet; }

bool cuts(const SolidFeature& f) {
  return f.mode == FeatureMode::Cut || f.shape == FeatureShape::Hole || f.shape == FeatureShape::Pocket ||
         f.shape == FeatureShape::Slot;
}

/// What is wrong with the numbers of a feature; empty if nothing is.
std::string mistakeIn(const SolidFeature& f) {
  const auto cornersFit = [&] { return f.cornerRadius >= 0 && 2 * f.cornerRadius <= std::min(f.size.x(), f.size.y()); };
  if (!(f.centre.cwiseAbs().maxCoeff() <= kLargest)) return "its centre must lie within 100 m";
  if (!(f.rotation.cwiseAbs().maxCoeff() <= 360)) return "its rotation must lie within 360 degrees";
  for (const FeaturePattern& pattern : f.patterns) {
    if (pattern.count < 1 || pattern.count > 10000) return "the count of its pattern must be 1 to 10000";
    if (!(pattern.spacing.cwiseAbs().maxCoeff() <= kLargest && pattern.centre.cwiseAbs().maxCoeff() <= kLargest &&
          std::abs(pattern.angle) <= 360)) {
      return "its pattern reaches too far";
    }
    if (pattern.kind == FeaturePattern::Kind::Linear && pattern.count > 1 && pattern.spacing.isZero()) {
      return "the copies of its linear pattern need a spacing";
    }
  }
  switch (f.shape) {
    case FeatureShape::Box:
      if (!isLength(f.size.x()) || !isLength(f.size.y()) || !isLength(f.size.z())) return "its size must be positive";
      if (!cornersFit()) return "its corner_radius must be at most half its length and width";
      break;
    case FeatureShape::Cylinder:
      if (!isLength(f.diameter) || !isLength(f.height)) return "its diameter and height must be positive";
      break;
    case FeatureShape::Cone:
      if (!isLength(f.diameter) || !isLength(f.height)) return "its diameter and height must be positive";
      if (!isLengthOrZero(f.topDiameter) || f.topDiameter == f.diameter) {
        return "its top_diameter must not be negative nor equal to its diameter";
      }
      break;
    case FeatureShape::Sphere:
      if (!isLength(f.diameter)) return "its diameter must be positive";
      break;
    case FeatureShape::Torus:
      if (!isLength(f.diameter) || !isLength(f.tubeDiameter) || f.tubeDiameter >= f.diameter) {
        return "its tube_diameter must be positive and smaller than its diameter";
      }
      break;
    case FeatureShape::Hole:
      if (!isLength(f.diameter)) return "its diameter must be positive";
      break;
    case FeatureShape::Pocket:
      if (!isLength(f.size.x()) || !isLength(f.size.y())) return "its size must be positive";
      if (!cornersFit()) return "its corner_radius must be at most half its length and width";
      break;
    case FeatureShape::Slot:
      if (!isLength(f.size.x()) || !isLength(f.size.y())) return "its size must be positive";
      if (f.size.y() > f.size.x()) return "its width must be at most its length";
      break;
    case FeatureShape::Chamfer:
    case FeatureShape::Fillet:
      if (!isLength(f.edgeSize))
        return f.shape == FeatureShape::Fillet ? "its radius must be positive" : "its width must be positive";
      if (f.edges.empty()) return "it needs a point on each edge it treats";
      break;
  }
  if (!isLengthOrZero(f.depth)) return "its depth must not be negative";
  return {};
}

/// A prism about z with rounded corners.
TopoDS_Shape roundedPrism(double length, double width, double radius, double low, double high) {
  const double x = length / 2 - radius;
  const double y = width / 2 - radius;
  if (radius <= 0) return BRepPrimAPI_MakeBox(gp_Pnt(-x, -y, low), gp_Pnt(x, y, high)).Shape();
  BRepBuilderAPI_MakeWire wire;
  const auto side = [&](const gp_Pnt& a, const gp_Pnt& b) {
    if (a.Distance(b) > 1e-9) wire.Add(BRepBuilderAPI_MakeEdge(a, b));
  };
  const auto corner = [&](double cx, double cy, double startDegrees) {
    const gp_Circ circle(gp_Ax2(gp_Pnt(cx, cy, low), gp::DZ(), gp::DX()), radius);
    wire.Add(BRepBuilderAPI_MakeEdge(circle, radiansFromDegrees(startDegrees), radiansFromDegrees(startDegrees + 90)));
  };
  corner(x, y, 0);
  side({x, y + radius, low}, {-x, y + radius, low});
  corner(-x, y, 90);
  side({-x - radius, y, low}, {-x - radius, -y, low});
  corner(-x, -y, 180);
  side({-x, -y - radius, low}, {x, -y - radius, low});
  corner(x, -y, 270);
  side({x + radius, -y, low}, {x + radius, y, low});
  return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(wire.Wire(), Standard_True), gp_Vec(0, 0, high - low)).Shape();
}

/// The body of a feature in its own frame. `through` is deeper than any part.
TopoDS_Shape bodyOf(const SolidFeature& f, double through) {
  const double depth = f.depth > 0 ? f.depth : through;
  const gp_Ax2 below(gp_Pnt(0, 0, -depth), gp::DZ());
  switch (f.shape) {
    case FeatureShape::Box:
      return roundedPrism(f.size.x(), f.size.y(), f.cornerRadius, 0, f.size.z());
    case FeatureShape::Cylinder:
      return BRepPrimAPI_MakeCylinder(f.diameter / 2, f.height).Shape();
    case FeatureShape::Cone:
      return BRepPrimAPI_MakeCone(f.diameter / 2, f.topDiameter / 2, f.height).Shape();
    case FeatureShape::Sphere:
      return BRepPrimAPI_MakeSphere(f.diameter / 2).Shape();
    case FeatureShape::Torus:
      return BRepPrimAPI_MakeTorus(f.diameter / 2, f.tubeDiameter / 2).Shape();
    case FeatureShape::Hole:
      return BRepPrimAPI_MakeCylinder(below, f.diameter / 2, depth).Shape();
    case FeatureShape::Pocket:
      return roundedPrism(f.size.x(), f.size.y(), f.cornerRadius, -depth, 0);
    default:
      return roundedPrism(f.size.x(), f.size.y(), f.size.y() / 2, -depth, 0);
  }
}

/// The poses of a feature and its copies.
std::vector<Pose> posesOf(const SolidFeature& f) {
  const Pose own = translation(f.centre) * rotation(Vector3::UnitZ(), f.rotation.z()) *
                   rotation(Vector3::UnitY(), f.rotation.y()) * rotation(Vector3::UnitX(), f.rotation.x());
  std::vector<Pose> poses{own};
  for (const FeaturePattern& pattern : f.patterns) {
    std::vector<Pose> repeated;
    for (int i = 0; i < pattern.count; ++i) {
      const double step = pattern.angle != 0 ? pattern.angle : 360.0 / pattern.count;
      const Pose shift =
          pattern.kind == FeaturePattern::Kind::Linear
              ? translation(i * pattern.spacing)
              : translation(pattern.centre) * rotation(Vector3::UnitZ(), i * step) * translation(-pattern.centre);
      for (const Pose& pose : poses)
        repeated.push_back(shift * pose);
    }
    poses = std::move(repeated);
  }
  return poses;
}

TopoDS_Shape placed(const TopoDS_Shape& body, const Pose& pose) {
  gp_Trsf transform;
  const auto& m = pose.matrix();
  transform.SetValues(m(0, 0), m(0, 1), m(0, 2), m(0, 3), m(1, 0), m(1, 1), m(1, 2), m(1, 3), m(2, 0), m(2, 1), m(2, 2),
                      m(2, 3));
  return BRepBuilderAPI_Transform(body, transform, Standard_True).Shape();
}

double diagonalOf(const TopoDS_Shape& shape) {
  Bnd_Box box;
  BRepBndLib::Add(shape, box);
  return box.CornerMin().Distance(box.CornerMax());
}

TopoDS_Shape unified(const TopoDS_Shape& shape) {
  ShapeUpgrade_UnifySameDomain unify(shape);
  unify.Build();
  return unify.Shape();
}

/// The edge between two faces that passes through the point, or none.
TopoDS_Edge edgeAt(const TopoDS_Shape& shape, const Vector3& point) {
  const TopoDS_Shape vertex = BRepBuilderAPI_MakeVertex(gp_Pnt(point.x(), point.y(), point.z())).Shape();
  TopTools_IndexedDataMapOfShapeListOfShape facesOfEdges;
  TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, facesOfEdges);
  TopoDS_Edge nearest;
  double least = 0.1;
  for (int i = 1; i <= facesOfEdges.Extent(); ++i) {
    const TopoDS_Edge edge = TopoDS::Edge(facesOfEdges.FindKey(i));
    const TopTools_ListOfShape& faces = facesOfEdges(i);
    const bool seam = faces.IsEmpty() || faces.First().IsSame(faces.Last());
    if (seam || BRep_Tool::Degenerated(edge)) continue;
    const BRepExtrema_DistShapeShape distance(vertex, edge);
    if (distance.IsDone() && distance.Value() < least) {
      least = distance.Value();
      nearest = edge;
    }
  }
  return nearest;
}

Result<TopoDS_Shape> withTreatedEdges(const TopoDS_Shape& shape, const SolidFeature& f) {
  const TopoDS_Shape whole = unified(shape);
  BRepFilletAPI_MakeFillet fillet(whole);
  BRepFilletAPI_MakeChamfer chamfer(whole);
  for (const Vector3& point : f.edges) {
    const TopoDS_Edge edge = edgeAt(whole, point);
    if (edge.IsNull()) {
      return fail(fmt::format("no edge passes through {} {} {}", point.x(), point.y(), point.z()),
                  "give a point on the edge as it is after the features before this one");
    }
    f.shape == FeatureShape::Fillet ? fillet.Add(f.edgeSize, edge) : chamfer.Add(f.edgeSize, edge);
  }
  BRepBuilderAPI_MakeShape& make = f.shape == FeatureShape::Fillet ? static_cast<BRepBuilderAPI_MakeShape&>(fillet)
                                                                   : static_cast<BRepBuilderAPI_MakeShape&>(chamfer);
  make.Build();
  if (!make.IsDone()) {
    const char* key = f.shape == FeatureShape::Fillet ? "radius" : "width";
    return fail(fmt::format("its edges cannot be treated with this {}", key), fmt::format("choose a smaller {}", key));
  }
  return make.Shape();
}

/// Lets a long operation of the kernel end early.
class Interruptible final : public Message_ProgressIndicator {
public:
  explicit Interruptible(std::stop_token stop) : stop_(std::move(stop)) {}
  Standard_Boolean UserBreak() override { return stop_.stop_requested(); }
  void Show(const Message_ProgressScope&, const Standard_Boolean) override {}

private:
  std::stop_token stop_;
};

Result<TopoDS_Shape> withBody(const TopoDS_Shape& shape, const SolidFeature& f, const std::stop_token& stop) {
  const TopoDS_Shape body = bodyOf(f, shape.IsNull() ? 1 : 2 * (diagonalOf(shape) + f.centre.norm()));
  TopTools_ListOfShape tools;
  for (const Pose& pose : posesOf(f))
    tools.Append(placed(body, pose));
  TopTools_ListOfShape arguments;
  if (shape.IsNull()) {
    const TopoDS_Shape first = tools.First();
    if (tools.Extent() == 1) return first;
    tools.RemoveFirst();
    arguments.Append(first);
  } else {
    arguments.Append(shape);
  }
  BRepAlgoAPI_Fuse fuse;
  BRepAlgoAPI_Cut cut;
  BRepAlgoAPI_BooleanOperation& operation = cuts(f) ? static_cast<BRepAlgoAPI_BooleanOperation&>(cut) : fuse;
  operation.SetArguments(arguments);
  operation.SetTools(tools);
  const Handle(Message_ProgressIndicator) progress = new Interruptible(stop);
  operation.Build(progress->Start());
  if (stop.stop_requested()) return fail("the part was being built when the run was interrupted");
  if (!operation.IsDone() || operation.HasErrors()) {
    return fail("it cannot be joined with the part", "move it a little so that its faces do not just touch");
  }
  if (!TopExp_Explorer(operation.Shape(), TopAbs_SOLID).More()) return fail("it leaves nothing of the part");
  return operation.Shape();
}

}  // namespace

std::optional<FeatureShape> featureShapeNamed(std::string_view word) {
  for (const auto& [name, shape] : kNames) {
    if (name == word) return shape;
  }
  return std::nullopt;
}

std::string_view nameOf(FeatureShape shape) {
  for (const auto& [name, named] : kNames) {
    if (named == shape) return name;
  }
  return {};
}

Result<TopoDS_Shape> buildShape(const SolidRecipe& recipe, const std::stop_token& stop) {
  if (recipe.features.empty()) return fail("the part has no features", "begin with a body, for instance a box");
  TopoDS_Shape shape;
  for (std::size_t i = 0; i < recipe.features.size(); ++i) {
    const SolidFeature& f = recipe.features[i];
    const auto refuse = [&](const std::string& reason, const std::string& advice) {
      return fail(f.place, fmt::format("feature {} ({}): {}", i + 1, nameOf(f.shape), reason), advice);
    };
    if (const std::string mistake = mistakeIn(f); !mistake.empty()) return refuse(mistake, "lengths are in mm");
    if (i == 0 && (cuts(f) || treatsEdges(f))) {
      return refuse("the first feature must add a body", "begin with a box, cylinder, cone, sphere or torus");
    }
    try {
      Result<TopoDS_Shape> next = treatsEdges(f) ? withTreatedEdges(shape, f) : withBody(shape, f, stop);
      if (!next) return refuse(next.error().message, next.error().advice);
      shape = *next;
    } catch (const Standard_Failure& failure) {
      const std::string_view why = failure.GetMessageString();
      return refuse(why.empty() ? "it cannot be made" : fmt::format("it cannot be made: {}", why),
                    "change its size or place");
    }
  }
  try {
    shape = unified(shape);
    if (!BRepCheck_Analyzer(shape).IsValid()) {
      return fail("the features do not make a valid body", "move features whose faces just touch a little");
    }
  } catch (const Standard_Failure& failure) {
    return fail(fmt::format("the features do not make a valid body: {}", failure.GetMessageString()));
  }
  return shape;
}

Result<std::unique_ptr<Solid>> buildSolid(const SolidRecipe& recipe, const CadOptions& options,
                                          const std::stop_token& stop) {
  const Result<TopoDS_Shape> shape = buildShape(recipe, stop);
  if (!shape) return tl::unexpected(shape.error());
  return cadSolid(*shape, options);
}

SolidRecipe ringGauge(double boreDiameter, double outerDiameter, double height) {
  SolidFeature ring;
  ring.shape = FeatureShape::Cylinder;
  ring.centre = {0, 0, -height};
  ring.diameter = outerDiameter;
  ring.height = height;
  SolidFeature bore;
  bore.shape = FeatureShape::Hole;
  bore.diameter = boreDiameter;
  return {{ring, bore}};
}

SolidRecipe referenceSphere(double diameter, double stemDiameter, double stemLength) {
  SolidFeature sphere;
  sphere.shape = FeatureShape::Sphere;
  sphere.diameter = diameter;
  SolidFeature stem;
  stem.shape = FeatureShape::Cylinder;
  stem.centre = {0, 0, -stemLength};
  stem.diameter = stemDiameter;
  stem.height = stemLength;
  return {{sphere, stem}};
}

SolidRecipe toolProbeContact(const ToolProbeContact& contact) {
  SolidFeature plate;
  plate.centre = {0, 0, -contact.thickness};
  if (contact.length > 0) {
    plate.size = {contact.length, contact.width, contact.thickness};
  } else {
    plate.shape = FeatureShape::Cylinder;
    plate.diameter = contact.diameter;
    plate.height = contact.thickness;
  }
  SolidFeature stem;
  stem.shape = FeatureShape::Cylinder;
  stem.centre = {0, 0, -contact.thickness - contact.stemLength};
  stem.diameter = contact.stemDiameter;
  stem.height = contact.stemLength;
  return {{plate, stem}};
}

SolidRecipe gaugeBlock(double length, double width, double height) {
  SolidFeature block;
  block.centre = {0, 0, -height};
  block.size = {length, width, height};
  return {{block}};
}

}  // namespace probewright::simulation
