#include "simulation/cad_transfer.hpp"

#include <fmt/format.h>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <GeomAPI_ProjectPointOnCurve.hxx>
#include <Geom_Curve.hxx>
#include <Geom_Surface.hxx>
#include <IGESControl_Reader.hxx>
#include <IGESGeom_BoundedSurface.hxx>
#include <IGESGeom_TrimmedSurface.hxx>
#include <IGESSolid_Face.hxx>
#include <Interface_Check.hxx>
#include <Interface_CheckIterator.hxx>
#include <Interface_InterfaceModel.hxx>
#include <Interface_ReportEntity.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <OSD_Parallel.hxx>
#include <STEPControl_Reader.hxx>
#include <Standard_Failure.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_UndefinedEntity.hxx>
#include <StepShape_FaceSurface.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <sstream>
#include <system_error>
#include <thread>

#include "simulation/cad_cones.hpp"
#include "simulation/cad_corrections.hpp"
#include "simulation/cad_edges.hpp"
#include "simulation/cad_elementary.hpp"
#include "simulation/cad_face.hpp"
#include "simulation/cad_model.hpp"
#include "simulation/cad_pieces.hpp"
#include "simulation/cad_step_library.hpp"
#include "simulation/cad_tori.hpp"
#include "simulation/cad_units.hpp"
#include "simulation/face_mesh.hpp"
#include "simulation/parallel.hpp"

namespace probewright::simulation {
namespace {

constexpr int kMostSuspects = 20;

std::string labelOf(const Handle(Interface_InterfaceModel) & model, const Handle(Standard_Transient) & entity) {
  if (const auto step = Handle(StepData_StepModel)::DownCast(model))
    return fmt::format("#{}", step->IdentLabel(entity));
  return fmt::format("D{}", 2 * model->Number(entity) - 1);
}

bool isFace(const Handle(Standard_Transient) & entity) {
  return entity->IsKind(STANDARD_TYPE(StepShape_FaceSurface)) || entity->IsKind(STANDARD_TYPE(IGESSolid_Face)) ||
         entity->IsKind(STANDARD_TYPE(IGESGeom_TrimmedSurface)) ||
         entity->IsKind(STANDARD_TYPE(IGESGeom_BoundedSurface));
}

/// Not a colour, a dimension or a note: parts of CAD systems are full of those that OpenCASCADE does not know.
bool isGeometry(const Handle(Interface_InterfaceModel) & model, int place) {
  const Handle(Standard_Transient) entity =
      model->IsErrorEntity(place) ? model->ReportEntity(place)->Concerned() : model->Value(place);
  if (entity.IsNull()) return false;
  const std::string_view type = entity->DynamicType()->Name();
  return type.starts_with("StepGeom_") || type.starts_with("StepShape_") || type.starts_with("IGESGeom_") ||
         type.starts_with("IGESSolid_");
}

/// What says which bodies a product has and where they stand.
bool isStructure(const Handle(Interface_InterfaceModel) & model, int place) {
  const Handle(Standard_Transient) entity =
      model->IsErrorEntity(place) ? model->ReportEntity(place)->Concerned() : model->Value(place);
  if (entity.IsNull()) return false;
  constexpr std::array<std::string_view, 12> types{"StepRepr_AssemblyComponentUsage",
                                                   "StepRepr_ItemDefinedTransformation",
                                                   "StepRepr_MappedItem",
                                                   "StepRepr_NextAssemblyUsageOccurrence",
                                                   "StepRepr_ProductDefinitionShape",
                                                   "StepRepr_RepresentationMap",
                                                   "StepRepr_RepresentationRelationship",
                                                   "StepRepr_RepresentationRelationshipWithTransformation",
                                                   "StepRepr_ShapeRepresentationRelationship",
                                                   "StepRepr_ShapeRepresentationRelationshipWithTransformation",
                                                   "StepShape_ContextDependentShapeRepresentation",
                                                   "StepShape_ShapeDefinitionRepresentation"};
  return std::ranges::find(types, std::string_view(entity->DynamicType()->Name())) != types.end();
}

/// True for the type of an entity that nobody knows, but that is one of these but for a letter or two.
bool isNearlyStructure(std::string_view type) {
  constexpr std::array<std::string_view, 8> types{
      "CONTEXT_DEPENDENT_SHAPE_REPRESENTATION", "ITEM_DEFINED_TRANSFORMATION",      "MAPPED_ITEM",
      "NEXT_ASSEMBLY_USAGE_OCCURRENCE",         "PRODUCT_DEFINITION_SHAPE",         "REPRESENTATION_MAP",
      "SHAPE_DEFINITION_REPRESENTATION",        "SHAPE_REPRESENTATION_RELATIONSHIP"};
  return std::ranges::any_of(types, [&](std::string_view known) {
    constexpr std::ptrdiff_t fewLetters = 2;
    if (known.size() != type.size()) return false;
    const auto same = std::inner_product(known.begin(), known.end(), type.begin(), std::ptrdiff_t{0}, std::plus<>(),
                                         [](char a, char b) { return a == b ? 1 : 0; });
    return same + fewLetters >= static_cast<std::ptrdiff_t>(known.size());
  });
}

/// Names what is wrong with entities before anything is made of them.
void nameFaults(const Handle(Interface_InterfaceModel) & model, const ChildVoice& voice) {
  int told = 0;
  for (int i = 1; i <= model->NbEntities() && told < kMostSuspects; ++i) {
    const auto unknown = Handle(StepData_UndefinedEntity)::DownCast(model->Value(i));
    const bool strange = !unknown.IsNull() && isNearlyStructure(unknown->StepType());
    if (!strange && !model->IsReportEntity(i)) continue;
    const Handle(Interface_Check) check = model->Check(i, Standard_True);
    const bool structure = strange || isStructure(model, i);
    if (!strange && (check->NbFails() == 0 || (!structure && !isGeometry(model, i)))) continue;
    const char* reason = strange ? "its type is not known" : check->CFail(1);
    voice.say(fmt::format("{} {} {}", structure ? "misplaced" : "suspect", labelOf(model, model->Value(i)), reason));
    ++told;
  }
}

/// Says why there is no shape, unless there was not enough memory: libraries take that for a mistake in the file.
void sayFailed(const ChildVoice& voice, std::string_view reason) {
  if (ranShortOfMemory()) throw std::bad_alloc();
  voice.say(fmt::format("failed {}", reason));
}

/// A file read into entities; no shape is built yet.
std::unique_ptr<XSControl_Reader> load(const TransferOrder& order, const ChildVoice& voice) {
  Message::DefaultMessenger()->ChangePrinters().Clear();
  voice.say("stage reading the file");
  std::unique_ptr<XSControl_Reader> reader;
  if (order.format == CadFormat::Step)
    reader = std::make_unique<STEPControl_Reader>();
  else
    reader = std::make_unique<IGESControl_Reader>();
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
  IFSelect_ReturnStatus status = IFSelect_RetVoid;
  if (order.format == CadFormat::Step) {
    reader->WS()->SetLibrary(quickStepLibrary(order.bytes));
    std::istringstream none;
    status = static_cast<STEPControl_Reader&>(*reader).ReadStream(order.file.c_str(), none);
  } else {
    status = reader->ReadFile(order.file.c_str());
  }
  const Handle(Interface_InterfaceModel) model = reader->WS()->Model();
  if (!model.IsNull()) {
    acceptMissingTexts(model);
    nameFaults(model, voice);
  }
  if (status == IFSelect_RetDone) {
    if (const auto placement = misreadPlacement(model); !placement.IsNull()) {
      voice.say(
          fmt::format("unable {} it mirrors or scales a part, which cannot be read|export mirrored and scaled parts "
                      "as bodies of their own, not as instances",
                      labelOf(model, placement)));
      return nullptr;
    }
    if (const auto shape = withoutLengthUnit(model); !shape.IsNull()) voice.say("unitless " + labelOf(model, shape));
    takePlainCones(model);
    if (const auto offset = unreadableOffset(model); !offset.IsNull()) {
      voice.say(
          fmt::format("unable {} it is the offset of a cone, which cannot be read|export the part with the cone "
                      "itself instead of its offset",
                      labelOf(model, offset)));
      return nullptr;
    }
    if (const auto tip = unreadableApex(model); !tip.IsNull()) {
      voice.say(
          fmt::format("unable {} it is a cone as surface of revolution that ends at its apex without an edge, which "
                      "cannot be read|export the part with conical surfaces instead of surfaces of revolution",
                      labelOf(model, tip)));
      return nullptr;
    }
  }
  if (status == IFSelect_RetDone) return reader;
  std::string reason = "it is not what such a file must be";
  if (!model.IsNull()) {
    Interface_CheckIterator checks = reader->WS()->ModelCheckList();
    for (checks.Start(); checks.More(); checks.Next()) {
      if (checks.Value()->NbFails() == 0) continue;
      reason = checks.Value()->CFail(1);
      break;
    }
  }
  sayFailed(voice, reason);
  return nullptr;
}

TopoDS_Shape build(XSControl_Reader& reader, const ChildVoice& voice) {
  voice.say("stage building the part");
  const Handle(Interface_InterfaceModel) model = reader.WS()->Model();
  takePlainOffsets(model);
  turnOffsets(model);
  turnArcs(model);
  const int roots = reader.NbRootsForTransfer();
  for (int i = 1; i <= roots; ++i) {
    voice.say("at " + labelOf(model, reader.RootForTransfer(i)));
    reader.TransferOneRoot(i);
  }
  return reader.NbShapes() > 0 ? reader.OneShape() : TopoDS_Shape();
}

/// Names the faces of the file that came to nothing.
void nameLostFaces(const XSControl_Reader& reader, const ChildVoice& voice) {
  const Handle(Interface_InterfaceModel) model = reader.WS()->Model();
  const Handle(Transfer_TransientProcess) process = reader.WS()->TransferReader()->TransientProcess();
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const Handle(Standard_Transient) entity = model->Value(i);
    const bool broken = model->IsErrorEntity(i);
    if (!isFace(broken ? model->ReportEntity(i)->Concerned() : entity)) continue;
    if (broken || TransferBRep::ShapeResult(process, entity).IsNull()) voice.say("lost " + labelOf(model, entity));
  }
}

/// Where nothing came of the file: how many faces it holds all the same, and the first of them.
void nameUnusedFaces(const XSControl_Reader& reader, const ChildVoice& voice) {
  const Handle(Interface_InterfaceModel) model = reader.WS()->Model();
  int count = 0, first = 0;
  for (int i = 1; i <= model->NbEntities(); ++i) {
    if (model->IsErrorEntity(i) || !isFace(model->Value(i))) continue;
    if (++count == 1) first = i;
  }
  if (count > 0) voice.say(fmt::format("unused {} {}", labelOf(model, model->Value(first)), count));
}

constexpr double kNowhere = std::numeric_limits<double>::infinity();
constexpr double kWorthNaming = 0.01;  // mm

/// How far a point is from a piece of a curve.
double distanceOf(const gp_Pnt& point, const Handle(Geom_Curve) & curve, double first, double last) {
  double nearest = std::min(point.Distance(curve->Value(first)), point.Distance(curve->Value(last)));
  const GeomAPI_ProjectPointOnCurve feet(point, curve, first, last);
  if (feet.NbPoints() > 0) nearest = std::min(nearest, feet.LowerDistance());
  return nearest;
}

/// By how much the edges of a face leave its surface, or its vertices its edges; kNowhere if an edge has no place on
/// it.
double gapsOf(const TopoDS_Face& face) {
  double gap = 0;
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  for (TopExp_Explorer edges(face, TopAbs_EDGE); edges.More(); edges.Next()) {
    const TopoDS_Edge& edge = TopoDS::Edge(edges.Current());
    double first = 0, last = 0, from = 0, to = 0;
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, first, last);
    if (curve.IsNull() || surface.IsNull() || BRep_Tool::Degenerated(edge)) continue;
    const Handle(Geom2d_Curve) onSurface = BRep_Tool::CurveOnSurface(edge, face, from, to);
    constexpr int kPlaces = 6;
    if (onSurface.IsNull()) return kNowhere;
    for (int k = 0; k <= kPlaces; ++k) {
      const double share = static_cast<double>(k) / kPlaces;
      const gp_Pnt2d uv = onSurface->Value(from + share * (to - from));
      const gp_Pnt place = surface->Value(uv.X(), uv.Y());
      const double apart = curve->Value(first + share * (last - first)).Distance(place);
      // Some systems go along an edge at another pace on the surface than in space.
      if (apart > gap && apart > kWorthNaming) gap = std::max(gap, distanceOf(place, curve, first, last));
    }
    const TopoDS_Edge forward = TopoDS::Edge(edge.Oriented(TopAbs_FORWARD));
    for (const bool atStart : {true, false}) {
      const TopoDS_Vertex vertex = atStart ? TopExp::FirstVertex(forward) : TopExp::LastVertex(forward);
      if (!vertex.IsNull()) gap = std::max(gap, BRep_Tool::Pnt(vertex).Distance(curve->Value(atStart ? first : last)));
    }
  }
  return gap;
}

/// True if the edges of a face run round its surface more often one way than the other: nothing ends the face there.
bool isWithoutEnd(const TopoDS_Face& face) {
  const Handle(Geom_Surface) surface = surfaceWithoutLimits(BRep_Tool::Surface(face));
  if (surface.IsNull()) return false;
  const TopoDS_Face forward = TopoDS::Face(face.Oriented(TopAbs_FORWARD));
  gp_XY way(0, 0);
  for (TopExp_Explorer edges(forward, TopAbs_EDGE); edges.More(); edges.Next()) {
    const TopoDS_Edge& edge = TopoDS::Edge(edges.Current());
    double first = 0, last = 0;
    const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, forward, first, last);
    if (curve.IsNull()) return false;
    const gp_XY part = curve->Value(last).XY() - curve->Value(first).XY();
    if (edge.Orientation() == TopAbs_FORWARD) way += part;
    if (edge.Orientation() == TopAbs_REVERSED) way -= part;
  }
  return (surface->IsUPeriodic() && std::abs(way.X()) > surface->UPeriod() / 2) ||
         (surface->IsVPeriodic() && std::abs(way.Y()) > surface->VPeriod() / 2);
}

/// Names the faces that do not fit together: one wrong digit in a file does that.
void nameGaps(const XSControl_Reader& reader, const ChildVoice& voice) {
  const Handle(Interface_InterfaceModel) model = reader.WS()->Model();
  const Handle(Transfer_TransientProcess) process = reader.WS()->TransferReader()->TransientProcess();
  struct Made {
    int entity;
    TopoDS_Shape shape;
    double gap = 0;
    bool isWithoutEnd = false;
  };
  std::vector<Made> made;
  for (int i = 1; i <= model->NbEntities(); ++i) {
    if (model->IsErrorEntity(i) || !isFace(model->Value(i))) continue;
    if (const TopoDS_Shape shape = TransferBRep::ShapeResult(process, model->Value(i)); !shape.IsNull())
      made.push_back({i, shape});
  }
  constexpr std::size_t kWorthAThread = 20;
  inParallel(made.size(), kWorthAThread, [&](std::size_t i) {
    for (TopExp_Explorer faces(made[i].shape, TopAbs_FACE); faces.More(); faces.Next()) {
      const TopoDS_Face& face = TopoDS::Face(faces.Current());
      made[i].gap = std::max(made[i].gap, gapsOf(face));
      made[i].isWithoutEnd = made[i].isWithoutEnd || isWithoutEnd(face);
    }
  });
  for (const Made& face : made) {
    if (!(face.gap <= kWorthNaming))
      voice.say(fmt::format("gap {} {:.3f}", labelOf(model, model->Value(face.entity)), face.gap));
    else if (face.isWithoutEnd)
      voice.say(fmt::format("gap {} endless", labelOf(model, model->Value(face.entity))));
  }
}

void nameOpenEdges(const TopoDS_Shape& shape, const ChildVoice& voice) {
  if (!TopExp_Explorer(shape, TopAbs_SOLID).More()) voice.say("skin");
  int count = 0;
  gp_Pnt place;
  for (TopExp_Explorer shells(shape, TopAbs_SHELL); shells.More(); shells.Next()) {
    TopTools_IndexedDataMapOfShapeListOfShape facesOfEdges;
    TopExp::MapShapesAndAncestors(shells.Current(), TopAbs_EDGE, TopAbs_FACE, facesOfEdges);
    for (int i = 1; i <= facesOfEdges.Extent(); ++i) {
      const TopoDS_Edge& edge = TopoDS::Edge(facesOfEdges.FindKey(i));
      if (facesOfEdges(i).Extent() != 1 || BRep_Tool::Degenerated(edge)) continue;
      if (BRep_Tool::IsClosed(edge, TopoDS::Face(facesOfEdges(i).First()))) continue;
      double first = 0, last = 0;
      const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, first, last);
      if (++count == 1 && !curve.IsNull()) place = curve->Value((first + last) / 2);
    }
  }
  if (count > 0) voice.say(fmt::format("open {} {:.3f} {:.3f} {:.3f}", count, place.X(), place.Y(), place.Z()));
}

void mesh(const TopoDS_Shape& shape, const TransferOrder& order, const ChildVoice& voice) {
  voice.say(fmt::format("faces {}", faceCount(shape)));
  voice.say("stage meshing the faces");
  FaceMeshOptions options;
  options.left = order.gridFaces;
  options.leaveAll = order.gridAll;
  options.mostPoints = order.facePoints;
  // Threads of its own: those of a library that the parent uses do not exist here.
  OSD_Parallel::SetUseOcctThreads(true);
  options.parallel = std::thread::hardware_concurrency() > 1;
  options.begins = [&](int face) { voice.say(fmt::format("begin {}", face)); };
  options.goesOn = [&](int face) { voice.say(fmt::format("on {}", face)); };
  options.ends = [&](int face) { voice.say(fmt::format("end {}", face)); };
  const auto upwards = [](double cell) { return std::ceil(cell * 1000) / 1000; };
  for (const GridFace& grid : meshFaces(shape, order.deflection, options))
    voice.say(fmt::format("grid {} {:.3f} {}", grid.face, upwards(grid.cell), grid.kind));
}

template <class Work>
void guarded(const ChildVoice& voice, const Work& work) {
  try {
    work();
  } catch (const Standard_OutOfMemory&) {
    throw std::bad_alloc();
  } catch (const Standard_Failure& failure) {
    sayFailed(voice, failure.GetMessageString());
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::system_error& failure) {
    // No memory for the stack of a thread.
    if (failure.code() == std::errc::resource_unavailable_try_again) throw std::bad_alloc();
    sayFailed(voice, failure.what());
  } catch (const std::exception& failure) {
    sayFailed(voice, failure.what());
  }
}

}  // namespace

void transferCad(const TransferOrder& order, const ChildVoice& voice) {
  guarded(voice, [&] {
    const auto reader = load(order, voice);
    if (!reader) return;
    TopoDS_Shape shape = build(*reader, voice);
    if (shape.IsNull() || !TopExp_Explorer(shape, TopAbs_FACE).More()) {
      if (ranShortOfMemory()) throw std::bad_alloc();
      nameUnusedFaces(*reader, voice);
      voice.say("nothing");
      return;
    }
    nameLostFaces(*reader, voice);
    nameGaps(*reader, voice);
    if (const double scale = scaleOf(reader->WS()->Model()); scale != 1) {
      voice.say(fmt::format("scaled {:.9g}", scale));
      gp_Trsf enlarge;
      enlarge.SetScale(gp::Origin(), 1 / scale);
      shape = BRepBuilderAPI_Transform(shape, enlarge, Standard_True).Shape();
    }
    nameOpenEdges(shape, voice);
    sharpenEdges(shape);
    takeElementarySurfaces(shape);
    voice.say("stage cutting the faces");
    shape = inPieces(shape);
    // What cannot survive this must not happen in the parent.
    CadModel model = exactModel(shape, order.deflection);
    std::string bytes;
    appendShape(bytes, model);
    voice.hand(bytes);
    mesh(shape, order, voice);
    voice.say("stage preparing the faces");
    addElements(model);
    bytes.clear();
    appendElements(bytes, model);
    voice.hand(bytes);
  });
}

void searchFaces(const TransferOrder& order, const ChildVoice& voice) {
  guarded(voice, [&] {
    const auto reader = load(order, voice);
    if (!reader) return;
    const Handle(Interface_InterfaceModel) model = reader->WS()->Model();
    for (int i = 1; i <= model->NbEntities(); ++i) {
      if (model->IsErrorEntity(i) || !isFace(model->Value(i))) continue;
      voice.say("at " + labelOf(model, model->Value(i)));
      reader->TransferEntity(model->Value(i));
    }
  });
}

}  // namespace probewright::simulation
