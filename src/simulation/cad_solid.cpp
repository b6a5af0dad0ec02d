#include "simulation/cad_solid.hpp"

#include <fmt/format.h>

#include <Standard_Failure.hxx>
#include <algorithm>
#include <stdexcept>

#include "simulation/cad_contact.hpp"
#include "simulation/cad_model.hpp"
#include "simulation/cad_refinement.hpp"
#include "simulation/contact.hpp"

namespace probewright::simulation {
namespace {

constexpr double kSameContact = 1e-7;  ///< mm along the way

/// The faces and edges a query has dealt with. One that falls out of the memory is dealt with again, to no harm.
class Memory {
public:
  bool knows(const CadElement& element) {
    const std::uint64_t key = static_cast<std::uint64_t>(element.owner) << 1 |
                              static_cast<std::uint64_t>(element.kind == CadElement::Kind::Edge);
    const std::size_t known = std::min(count_, keys_.size());
    if (std::find(keys_.begin(), keys_.begin() + static_cast<std::ptrdiff_t>(known), key) !=
        keys_.begin() + static_cast<std::ptrdiff_t>(known)) {
      return true;
    }
    keys_[count_++ % keys_.size()] = key;
    return false;
  }

private:
  std::array<std::uint64_t, 32> keys_;
  std::size_t count_ = 0;
};

/// Those of a query, and how much it may still look at. Public parts need up to 5,000 parts of triangles, 10,000 boxes
/// and 12,000 pieces of edges, faces that are rough all over 150,000 boxes; with splines as only damaged files have
/// them there is no end of it, and what samples show has to do.
struct Questions {
  std::vector<FaceQuestion> answered;  ///< by a touch, or by none: there may be earlier ones
  std::vector<FaceQuestion> open;
  int partsLeft = 20'000;    ///< of triangles
  int boxesLeft = 300'000;   ///< of faces
  int piecesLeft = 200'000;  ///< of edges
};

void meet(const CadModel& model, const CadElement& element, const Way& way, double radius, Memory& memory,
          Questions& questions, Meeting& best) {
  Meeting coarse;
  coarse.when = best.when;
  const bool isFace = element.kind == CadElement::Kind::Face;
  const double grown = radius + element.growth;
  const bool near = isFace ? sweepTriangle(way, grown, element.corners, coarse)
                           : sweepSegment(way, grown, element.corners[0], element.corners[1], coarse);
  if (!near) return;
  if (isFace) {
    const CadFace& face = model.faces[element.owner];
    if (face.forms.count > 0) {
      if (!memory.knows(element)) meetAnalyticFace(face, way, radius, best);
    } else {
      const double soonest = coarse.when;
      visitForBall(
          model, element, radius, questions.partsLeft > 0,
          [&](const CadElement& part) {
            coarse = {};
            coarse.when = best.when;
            return sweepTriangle(way, radius + part.growth, part.corners, coarse);
          },
          [&](const CadElement& part, bool isCovered) {
            --questions.partsLeft;
            FaceQuestion question;
            question.triangle = part;
            question.soonest = coarse.when;
            const bool isAnswered = meetFaceNear(face, question, coarse, way, radius, best);
            if (!isCovered) (isAnswered ? questions.answered : questions.open).push_back(question);
          },
          [&](const CadElement& part) {
            FaceQuestion question;
            question.triangle = part;
            question.soonest = soonest;
            questions.open.push_back(question);
          });
    }
  } else {
    const CadEdge& edge = model.edges[element.owner];
    const TrimmedDomain* within = edge.within ? &model.faces[*edge.within].domain : nullptr;
    if (edge.kind == CadEdge::Kind::Curve)
      return meetEdgeNear(edge, within, element, way, radius, questions.piecesLeft, best);
    if (!memory.knows(element)) meetSimpleEdge(edge, way, radius, best);
  }
}

/// How near a segment from the start of the way to `axis` beyond it, moving along the way, comes to a point at least;
/// without what leads along `line`, if that is not zero: to the line through the point.
double nearestSweep(const Way& way, const Vector3& axis, const Vector3& point, const Vector3& line) {
  const auto across = [&](const Vector3& v) { return Vector3(v - line * line.dot(v)); };
  const Vector3 start = across(way.start - point), along = across(axis), moved = across(way.direction * way.length);
  const std::array<Vector3, 4> corners{start, start + along, start + along + moved, start + moved};
  double least = 1e300;
  for (std::size_t i = 0; i < corners.size(); ++i)
    least = std::min(least, closestOnSegment(Vector3::Zero(), corners[i], corners[(i + 1) % 4]).norm());
  const Vector3 normal = along.cross(moved);
  const double area = normal.squaredNorm();
  if (area < 1e-12) return least;
  const double first = moved.cross(start).dot(normal) / area, second = start.cross(along).dot(normal) / area;
  const bool within = first > 0 && first < 1 && second > 0 && second < 1;
  return within ? std::min(least, std::abs(normal.dot(start)) / std::sqrt(area)) : least;
}

/// True if a capsule passes a round face so far away that none of its triangles needs a look: the stylus and the body
/// of a probe beside a calibration sphere.
bool passes(const CadFace& face, const Mover& mover, double radius) {
  if (face.forms.count != 1) return false;
  const AnalyticSurface& form = face.forms.sheets[0];
  const bool turned = form.kind == AnalyticSurface::Kind::Cylinder;
  if (!turned && form.kind != AnalyticSurface::Kind::Sphere) return false;
  constexpr double safety = 1e-3;  // mm
  const Vector3 line = turned ? Vector3(form.axes.col(2)) : Vector3(Vector3::Zero());
  return nearestSweep(mover.way, mover.axis, form.origin, line) > form.radius + radius + safety;
}

}  // namespace

CadSolid::CadSolid(CadModel model, Diagnostics remarks)
    : model_(std::make_unique<const CadModel>(std::move(model))), remarks_(std::move(remarks)) {}
CadSolid::~CadSolid() = default;

Bounds CadSolid::bounds() const { return model_->bounds; }
Bounds CadSolid::reach() const { return model_->tree.bounds(); }
const TopoDS_Shape& CadSolid::shape() const { return model_->shape; }

std::size_t CadSolid::triangleCount() const {
  return static_cast<std::size_t>(std::count_if(model_->elements.begin(), model_->elements.end(),
                                                [](const CadElement& e) { return e.kind == CadElement::Kind::Face; }));
}

bool CadSolid::isInside(const Vector3& point) const {
  return model_->closedBodies > 0 &&
         isWithin(model_->tree, point, Rays::Majority, [&](std::uint32_t place, const Triangle&, const auto& cross) {
           const CadElement& element = model_->elements[place];
           if (!element.isTriangle() || !model_->faces[element.owner].boundsSolid) return;
           // Far away it does not matter which side of a triangle the surface lies on.
           const auto isNear = [&](const Triangle& t, double growth) {
             const bool near = (closestOnTriangle(point, t) - point).norm() <= growth;
             if (!near) cross(t);
             return near;
           };
           visitFinely(*model_, element, isNear, cross);
         });
}

std::optional<BallContact> CadSolid::firstContact(const Vector3& from, const Vector3& to, double radius) const {
  const Mover mover{wayBetween(from, to), radius};
  Meeting best;
  Memory memory;
  Questions questions;
  model_->tree.search(mover, best, [&](std::uint32_t place, const Triangle&) {
    meet(*model_, model_->elements[place], mover.way, radius, memory, questions, best);
  });
  // Only now, because borders and neighbours answer most of them.
  for (std::vector<FaceQuestion>* const some : {&questions.open, &questions.answered}) {
    std::sort(some->begin(), some->end(), [](const auto& a, const auto& b) { return a.soonest < b.soonest; });
    for (const FaceQuestion& question : *some) {
      if (question.soonest > best.when - kSameContact || questions.boxesLeft <= 0) break;
      const CadFace& face = model_->faces[question.triangle.owner];
      const bool isClear = question.isSolved && question.when > best.when - kSameContact &&
                           isClearBefore(face, question, mover.way, radius);
      if (!isClear) meetFaceClosely(face, question, mover.way, radius, questions.boxesLeft, best);
    }
  }
  // From within one body the ball may meet another body's front: where both touch, or where they overlap.
  const bool startsOutside = model_->closedBodies == 1 && meetsFront(mover.way, best);
  if (!(best.when < 0) && !startsOutside && isInside(from)) return contactWithin(mover.way, radius);
  return ballContact(mover.way, best);
}

std::optional<BallContact> CadSolid::firstCapsuleContact(const Vector3& from, const Vector3& to, const Vector3& axis,
                                                         double radius) const {
  const Way way = wayBetween(from, to);
  Meeting best;
  const std::size_t parts = capsuleParts(axis, radius);
  const Vector3 part = axis / static_cast<double>(parts);
  for (std::size_t i = 0; i < parts; ++i) {
    const Mover mover{{way.start + static_cast<double>(i) * part, way.direction, way.length}, radius, part};
    model_->tree.search(mover, best, [&](std::uint32_t place, const Triangle&) {
      const CadElement& element = model_->elements[place];
      if (!element.isTriangle() || passes(model_->faces[element.owner], mover, radius)) return;
      visitFinely(
          *model_, element,
          [&](const Triangle& t, double growth) {
            Meeting coarse;
            coarse.when = best.when;
            return sweepCapsule(mover.way, radius + growth, part, t, coarse);
          },
          [&](const Triangle& t) { sweepCapsule(mover.way, radius, part, t, best); });
    });
  }
  if (!(best.when < 0) && isInside(from)) return contactWithin(way, radius);
  return capsuleContact(way, axis, best);
}

std::optional<BallContact> CadSolid::firstCylinderContact(const Vector3& from, const Vector3& to, const Vector3& axis,
                                                          double radius) const {
  const Mover mover{wayBetween(from, to), 0, axis, radius};
  const double height = axis.norm();
  Meeting best;
  model_->tree.search(mover, best, [&](std::uint32_t place, const Triangle&) {
    const CadElement& element = model_->elements[place];
    if (!element.isTriangle() || passes(model_->faces[element.owner], mover, radius)) return;
    visitFinely(
        *model_, element,
        [&](const Triangle& t, double growth) {
          const Vector3 more = axis * (growth / height);
          const Way way{mover.way.start - more, mover.way.direction, mover.way.length};
          Meeting coarse;
          coarse.when = best.when;
          return sweepCylinder(way, radius + growth, axis + 2 * more, t, coarse);
        },
        [&](const Triangle& t) { sweepCylinder(mover.way, radius, axis, t, best); });
  });
  // Not from an end, which may lie as near to a surface as it likes.
  const Vector3 within = from + axis * std::min(0.5, radius / height);
  if (!(best.when < 0) && isInside(within)) return contactWithin(mover.way, radius);
  return cylinderContact(mover.way, axis, radius, best);
}

Result<std::unique_ptr<Solid>> cadSolid(const TopoDS_Shape& shape, const CadOptions& options) {
  if (shape.IsNull()) return fail("the shape is empty", "a part needs at least one body or face");
  try {
    return std::make_unique<CadSolid>(cadModel(shape, options.deflection));
  } catch (const Standard_Failure& failure) {
    return fail(fmt::format("the shape cannot be prepared for contact: {}", failure.GetMessageString()),
                "export the part again as solid bodies, or as STL");
  } catch (const std::runtime_error& failure) {
    return fail(fmt::format("the shape cannot be prepared for contact: {}", failure.what()),
                "export the part again as solid bodies, or as STL");
  }
}

}  // namespace probewright::simulation
