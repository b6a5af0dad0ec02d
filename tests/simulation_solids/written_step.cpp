#include "written_step.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace probewright::simulation::testing {
namespace {

constexpr double kPi = std::numbers::pi;

std::string number(double value) {
  std::string text = fmt::format("{:.15G}", value);
  if (text.find_first_of(".E") == std::string::npos) text += '.';
  const std::size_t e = text.find('E');
  if (e != std::string::npos && text.find('.') == std::string::npos) text.insert(e, ".");
  return text;
}

using Piece = Meridian::Piece;

struct Arc {
  double radius, first, sweep;
};

Arc arcOf(const Piece& from, const Piece& to) {
  Arc arc{};
  arc.radius = std::hypot(from.r - from.centreR, from.z - from.centreZ);
  arc.first = std::atan2(from.z - from.centreZ, from.r - from.centreR);
  arc.sweep = std::atan2(to.z - from.centreZ, to.r - from.centreR) - arc.first;
  if (from.anticlockwise && arc.sweep <= 1e-12) arc.sweep += 2 * kPi;
  if (!from.anticlockwise && arc.sweep >= -1e-12) arc.sweep -= 2 * kPi;
  return arc;
}

}  // namespace

std::string listOf(const std::vector<int>& ids) {
  std::string text;
  for (const int id : ids)
    text += fmt::format("{}#{}", text.empty() ? "" : ",", id);
  return text;
}

StepFile::StepFile(Units units) { use(units); }

void StepFile::use(Units units) {
  units_ = units;
  const int radian = add("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))");
  const int millimetre = add("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))");
  const int solidAngle = add("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())");
  int lengthUnit = millimetre, angleUnit = radian;
  if (units_.length == 1000) lengthUnit = add("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT($,.METRE.))");
  if (units_.length == 25.4) {
    const int measure = add(fmt::format("LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#{})", millimetre));
    const int dimension = add("DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.)");
    lengthUnit =
        add(fmt::format("(CONVERSION_BASED_UNIT('INCH',#{})LENGTH_UNIT()NAMED_UNIT(#{}))", measure, dimension));
  }
  if (units_.degrees) {
    const int measure =
        add(fmt::format("PLANE_ANGLE_MEASURE_WITH_UNIT(PLANE_ANGLE_MEASURE({}),#{})", number(kPi / 180), radian));
    const int dimension = add("DIMENSIONAL_EXPONENTS(0.,0.,0.,0.,0.,0.,0.)");
    angleUnit =
        add(fmt::format("(CONVERSION_BASED_UNIT('DEGREE',#{})NAMED_UNIT(#{})PLANE_ANGLE_UNIT())", measure, dimension));
  }
  const int uncertainty = add(fmt::format("UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE({}),#{},'','')",
                                          number(1e-6 / units_.length), lengthUnit));
  context_ =
      add(fmt::format("(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#{}))"
                      "GLOBAL_UNIT_ASSIGNED_CONTEXT((#{},#{},#{}))REPRESENTATION_CONTEXT('',''))",
                      uncertainty, lengthUnit, angleUnit, solidAngle));
}

int StepFile::add(const std::string& text) {
  data_ += fmt::format("#{}={};\n", ++last_, text);
  return last_;
}

std::string StepFile::length(double mm) const { return number(mm / units_.length); }
std::string StepFile::angle(double radians) const { return number(units_.degrees ? radians * 180 / kPi : radians); }

int StepFile::point(const Vector3& p) {
  return add(fmt::format("CARTESIAN_POINT('',({},{},{}))", length(p.x()), length(p.y()), length(p.z())));
}
int StepFile::vertex(const Vector3& place) { return add(fmt::format("VERTEX_POINT('',#{})", point(place))); }
int StepFile::direction(const Vector3& d) {
  return add(fmt::format("DIRECTION('',({},{},{}))", number(d.x()), number(d.y()), number(d.z())));
}
int StepFile::axes(const Vector3& origin, const Vector3& z, const Vector3& x) {
  const int place = point(origin), along = direction(z), across = direction(x);
  return add(fmt::format("AXIS2_PLACEMENT_3D('',#{},#{},#{})", place, along, across));
}

int StepFile::product(const std::string& name) {
  const int application = add("APPLICATION_CONTEXT('')");
  const int context = add(fmt::format("PRODUCT_CONTEXT('',#{},'mechanical')", application));
  const int item = add(fmt::format("PRODUCT('{0}','{0}','',(#{1}))", name, context));
  const int formation = add(fmt::format("PRODUCT_DEFINITION_FORMATION('','',#{})", item));
  const int design = add(fmt::format("PRODUCT_DEFINITION_CONTEXT('part definition',#{},'design')", application));
  return add(fmt::format("PRODUCT_DEFINITION('','',#{},#{})", formation, design));
}

int StepFile::represent(int definition, const std::vector<int>& items, const std::string& type) {
  const int shape = add(fmt::format("PRODUCT_DEFINITION_SHAPE('','',#{})", definition));
  const int representation = add(fmt::format("{}('',({}),#{})", type, listOf(items), context_));
  add(fmt::format("SHAPE_DEFINITION_REPRESENTATION(#{},#{})", shape, representation));
  return representation;
}

int StepFile::solid(const std::vector<int>& faces) {
  const int shell = add(fmt::format("CLOSED_SHELL('',({}))", listOf(faces)));
  return add(fmt::format("MANIFOLD_SOLID_BREP('',#{})", shell));
}

void StepFile::put(const Shape& component, const Shape& assembly, int place) {
  const int occurrence = add(fmt::format("NEXT_ASSEMBLY_USAGE_OCCURRENCE('{0}','','',#{1},#{2},$)", place,
                                         assembly.product, component.product));
  const int definition = add(fmt::format("PRODUCT_DEFINITION_SHAPE('','',#{})", occurrence));
  const int transform = add(fmt::format("ITEM_DEFINED_TRANSFORMATION('','',#{},#{})", component.origin, place));
  const int relation =
      add(fmt::format("(REPRESENTATION_RELATIONSHIP('','',#{},#{})REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(#{})"
                      "SHAPE_REPRESENTATION_RELATIONSHIP())",
                      component.representation, assembly.representation, transform));
  add(fmt::format("CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(#{},#{})", relation, definition));
}

std::string StepFile::withItems(const std::vector<int>& items) {
  represent(product("part"), items);
  return text();
}

std::string StepFile::text() const {
  return "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');\n"
         "FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\nDATA;\n" +
         data_ + "ENDSEC;\nEND-ISO-10303-21;\n";
}

double Meridian::distance(const Vector3& point) const {
  const double r = std::hypot(point.x(), point.y()), z = point.z();
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Piece& a = pieces[i];
    const Piece& b = pieces[(i + 1) % pieces.size()];
    nearest = std::min(nearest, std::hypot(r - a.r, z - a.z));
    if (a.r == 0 && b.r == 0 && !a.isArc) continue;
    if (a.isArc) {
      const Arc arc = arcOf(a, b);
      const double turn = std::atan2(z - a.centreZ, r - a.centreR) - arc.first;
      const double along =
          arc.sweep > 0 ? turn - 2 * kPi * std::floor(turn / (2 * kPi)) : 2 * kPi * std::ceil(turn / (2 * kPi)) - turn;
      if (along <= std::abs(arc.sweep))
        nearest = std::min(nearest, std::abs(std::hypot(r - a.centreR, z - a.centreZ) - arc.radius));
    } else {
      const double dr = b.r - a.r, dz = b.z - a.z;
      const double share = ((r - a.r) * dr + (z - a.z) * dz) / (dr * dr + dz * dz);
      if (share > 0 && share < 1)
        nearest = std::min(nearest, std::abs((r - a.r) * dz - (z - a.z) * dr) / std::hypot(dr, dz));
    }
  }
  return nearest;
}

namespace {

/// Writes the faces of a body of revolution.
class Reviser {
public:
  Reviser(StepFile& file, const Meridian& meridian, const Pose& pose, const Dialect& dialect)
      : file_(file), pieces_(meridian.pieces), pose_(pose), how_(dialect) {
    count_ = how_.loops == Dialect::Loops::Sectors ? how_.sectors : 1;
    for (int k = 0; k < count_; ++k)
      angles_.push_back(how_.seamAt + 2 * kPi * k / count_);
    vertices_.resize(pieces_.size());
    circles_.resize(pieces_.size());
    meridians_.resize(pieces_.size());
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      for (int k = 0; k < count_; ++k)
        vertices_[i].push_back(k > 0 && pieces_[i].r == 0 ? vertices_[i][0]
                                                          : file_.vertex(at(pieces_[i], angles_[index(k)])));
    }
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      for (int k = 0; k < count_; ++k) {
        circles_[i].push_back(pieces_[i].r == 0 ? 0 : circleEdge(i, k));
        meridians_[i].push_back(0);
      }
    }
  }

  std::vector<int> faces() {
    std::vector<int> all;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const Piece& a = pieces_[i];
      const Piece& b = next(i);
      if (a.r == 0 && b.r == 0 && !a.isArc) continue;
      for (int k = 0; k < count_; ++k)
        all.push_back(face(i, k));
    }
    return all;
  }

private:
  struct Use {
    int edge;
    bool forwards;
  };

  static std::size_t index(int k) { return static_cast<std::size_t>(k); }
  const Piece& next(std::size_t i) const { return pieces_[(i + 1) % pieces_.size()]; }

  Vector3 at(double r, double z, double angle) const {
    return pose_ * Vector3(r * std::cos(angle), r * std::sin(angle), z);
  }
  Vector3 at(const Piece& p, double angle) const { return at(p.r, p.z, angle); }
  Vector3 axis() const { return pose_.linear().col(2); }
  Vector3 radial(double angle) const { return pose_.linear() * Vector3(std::cos(angle), std::sin(angle), 0); }
  Vector3 tangent(double angle) const { return pose_.linear() * Vector3(-std::sin(angle), std::cos(angle), 0); }

  int edge(int from, int to, int curve, bool sameSense) {
    return file_.add(fmt::format("EDGE_CURVE('',#{},#{},#{},{})", from, to, curve, sameSense ? ".T." : ".F."));
  }

  int circleEdge(std::size_t i, int k) {
    const Piece& p = pieces_[i];
    // The circle begins elsewhere than the edge; turned over, it runs the other way.
    const Vector3 z = how_.edgesReversed ? Vector3(-axis()) : axis();
    const int axes = file_.axes(at(0, p.z, 0), z, radial(how_.seamAt + (count_ > 1 ? 0.4 : 0)));
    const int circle = file_.add(fmt::format("CIRCLE('',#{},{})", axes, file_.length(p.r)));
    return edge(vertices_[i][index(k)], vertices_[i][index((k + 1) % count_)], circle, !how_.edgesReversed);
  }

  int meridianCurve(std::size_t i, double angle) {
    const Piece& a = pieces_[i];
    const Piece& b = next(i);
    if (a.isArc) {
      const Arc arc = arcOf(a, b);
      const Vector3 z = arc.sweep > 0 ? Vector3(-tangent(angle)) : tangent(angle);
      const int axes = file_.axes(at(a.centreR, a.centreZ, angle), z, radial(angle));
      return file_.add(fmt::format("CIRCLE('',#{},{})", axes, file_.length(arc.radius)));
    }
    const Vector3 way = at(b, angle) - at(a, angle);
    const int start = file_.point(at(a, angle) + 0.7 * way);
    // The length of the vector has no meaning for an edge.
    const int vector = file_.add(fmt::format("VECTOR('',#{},{})", file_.direction(way.normalized()), file_.length(7)));
    return file_.add(fmt::format("LINE('',#{},#{})", start, vector));
  }

  int meridianEdge(std::size_t i, int k) {
    int& made = meridians_[i][index(k)];
    if (made != 0) return made;
    made = edge(vertices_[i][index(k)], vertices_[(i + 1) % pieces_.size()][index(k)],
                meridianCurve(i, angles_[index(k)]), true);
    return made;
  }

  int loop(std::vector<Use> uses) {
    if (how_.loopsReversed) {
      std::reverse(uses.begin(), uses.end());
      for (Use& use : uses)
        use.forwards = !use.forwards;
    }
    std::rotate(uses.begin(), uses.begin() + how_.firstEdge % static_cast<int>(uses.size()), uses.end());
    std::vector<int> oriented;
    for (const Use& use : uses)
      oriented.push_back(
          file_.add(fmt::format("ORIENTED_EDGE('',*,*,#{},{})", use.edge, use.forwards ? ".T." : ".F.")));
    return file_.add(fmt::format("EDGE_LOOP('',({}))", listOf(oriented)));
  }

  int bound(int loop, bool outer) {
    return file_.add(fmt::format("{}('',#{},{})", outer ? "FACE_OUTER_BOUND" : "FACE_BOUND", loop,
                                 how_.loopsReversed ? ".F." : ".T."));
  }

  std::vector<int> bounds(std::size_t i, int k, bool flat) {
    const std::size_t j = (i + 1) % pieces_.size();
    const int low = circles_[i][index(k)], high = circles_[j][index(k)];
    const bool whole = count_ == 1;
    if (low == 0 && high == 0) {
      // A whole sphere has no edge at all.
      if (whole && how_.loops != Dialect::Loops::Seam)
        return {bound(file_.add(fmt::format("VERTEX_LOOP('',#{})", vertices_[i][0])), false)};
    }
    const bool isTorus = pieces_.size() == 1;
    if (isTorus && how_.loops == Dialect::Loops::TwoCircles)
      return {bound(file_.add(fmt::format("VERTEX_LOOP('',#{})", vertices_[i][0])), false)};
    if (whole && (flat || how_.loops == Dialect::Loops::TwoCircles)) {
      std::vector<int> all;
      if (low != 0) all.push_back(bound(loop({{low, true}}), high == 0 || pieces_[i].r > pieces_[j].r));
      if (high != 0) all.push_back(bound(loop({{high, false}}), low == 0 || pieces_[j].r >= pieces_[i].r));
      // The pole or apex, as a loop that is a point.
      if (!flat && (low == 0 || high == 0))
        all.push_back(bound(file_.add(fmt::format("VERTEX_LOOP('',#{})", vertices_[low == 0 ? i : j][0])), false));
      return all;
    }
    std::vector<Use> uses;
    if (low != 0) uses.push_back({low, true});
    uses.push_back({meridianEdge(i, (k + 1) % count_), true});
    if (high != 0) uses.push_back({high, false});
    uses.push_back({meridianEdge(i, k), false});
    return {bound(loop(uses), true)};
  }

  struct Made {
    int surface;
    bool sameSense;
  };

  Vector3 up() const { return how_.axesDown ? Vector3(-axis()) : axis(); }

  /// The surface of a piece, grown outwards by `more`.
  Made ownSurface(std::size_t i, double more) {
    const Piece& a = pieces_[i];
    const Piece& b = next(i);
    const double from = how_.seamAt;
    if (a.isArc) {
      const double radius = arcOf(a, b).radius + (a.anticlockwise ? more : -more);
      const int axes = file_.axes(at(0, a.centreZ, 0), up(), radial(from));
      if (a.centreR == 0)
        return {file_.add(fmt::format("SPHERICAL_SURFACE('',#{},{})", axes, file_.length(radius))), a.anticlockwise};
      if (std::abs(a.centreR) < radius) {
        // A torus that meets itself has two surfaces: the one about the axis is of an arc about beyond it.
        return {file_.add(fmt::format("DEGENERATE_TOROIDAL_SURFACE('',#{},{},{},{})", axes,
                                      file_.length(std::abs(a.centreR)), file_.length(radius),
                                      a.centreR > 0 ? ".T." : ".F.")),
                a.anticlockwise};
      }
      return {
          file_.add(fmt::format("TOROIDAL_SURFACE('',#{},{},{})", axes, file_.length(a.centreR), file_.length(radius))),
          a.anticlockwise};
    }
    const double dr = b.r - a.r, dz = b.z - a.z;
    if (dz == 0) {
      // Outwards is down where the meridian runs outwards.
      const bool facesUp = dr < 0;
      const int axes = file_.axes(at(0, a.z + (facesUp ? more : -more), 0), up(), radial(from));
      return {file_.add(fmt::format("PLANE('',#{})", axes)), facesUp != how_.axesDown};
    }
    const bool outer = dz > 0;
    if (dr == 0) {
      const double radius = a.r + (outer ? more : -more);
      const int axes = file_.axes(at(0, a.z + 3, 0), up(), radial(from));
      return {file_.add(fmt::format("CYLINDRICAL_SURFACE('',#{},{})", axes, file_.length(radius))), outer};
    }
    double slope = std::atan(dr / dz);
    const double shift = (outer ? more : -more) / std::cos(slope);
    const Piece& wide = a.r > b.r ? a : b;
    Vector3 z = axis();
    // The half angle is positive by the standard: the cone opens along its axis.
    if (slope < 0) {
      slope = -slope;
      z = -z;
    }
    const int axes = file_.axes(at(0, wide.z, 0), z, radial(from));
    return {
        file_.add(fmt::format("CONICAL_SURFACE('',#{},{},{})", axes, file_.length(wide.r + shift), file_.angle(slope))),
        outer};
  }

  /// The curve of the meridian turned about the axis.
  Made revolution(std::size_t i) {
    const int axis1 =
        file_.add(fmt::format("AXIS1_PLACEMENT('',#{},#{})", file_.point(at(0, 17, 0)), file_.direction(up())));
    const int curve = meridianCurve(i, how_.seamAt);
    // The surface's normal is the direction of rising angles times that of the curve: outwards, unless the axis is
    // turned over.
    return {file_.add(fmt::format("SURFACE_OF_REVOLUTION('',#{},#{})", curve, axis1)), !how_.axesDown};
  }

  Made offset(std::size_t i) {
    constexpr double kBy = 1.5;
    const auto [basis, sameSense] = ownSurface(i, -kBy);
    const double distance = sameSense ? kBy : -kBy;
    return {file_.add(fmt::format("OFFSET_SURFACE('',#{},{},.F.)", basis, file_.length(distance))), sameSense};
  }

  /// A rational B-spline surface: quarter circles across, the meridian (a line or arcs) along.
  Made spline(std::size_t i) {
    const Piece& a = pieces_[i];
    const Piece& b = next(i);
    struct Pole {
      double r, z, weight;
    };
    std::vector<Pole> poles{{a.r, a.z, 1}};
    int spans = 1, degree = 1;
    if (a.isArc) {
      degree = 2;
      const Arc arc = arcOf(a, b);
      spans = static_cast<int>(std::ceil(std::abs(arc.sweep) / 1.6));
      const double half = arc.sweep / spans / 2;
      for (int s = 0; s < spans; ++s) {
        const double middle = arc.first + (2 * s + 1) * half, end = arc.first + (2 * s + 2) * half;
        const double far = arc.radius / std::cos(half);
        poles.push_back({a.centreR + far * std::cos(middle), a.centreZ + far * std::sin(middle), std::cos(half)});
        poles.push_back({a.centreR + arc.radius * std::cos(end), a.centreZ + arc.radius * std::sin(end), 1});
      }
      poles.back() = {b.r, b.z, 1};
    } else {
      poles.push_back({b.r, b.z, 1});
    }
    constexpr int kQuarters = 4;
    const double half = kPi / kQuarters;
    std::string points, weights;
    for (int u = 0; u <= 2 * kQuarters; ++u) {
      const bool between = u % 2 == 1;
      const double angle = how_.seamAt + u * half;
      std::string row, rowWeights;
      for (const Pole& pole : poles) {
        const double r = between ? pole.r / std::cos(half) : pole.r;
        row += fmt::format("{}#{}", row.empty() ? "" : ",", file_.point(at(r, pole.z, angle)));
        rowWeights +=
            fmt::format("{}{}", rowWeights.empty() ? "" : ",", number(pole.weight * (between ? std::cos(half) : 1)));
      }
      points += fmt::format("{}({})", points.empty() ? "" : ",", row);
      weights += fmt::format("{}({})", weights.empty() ? "" : ",", rowWeights);
    }
    const auto knots = [](int n, double scale) {
      std::string text;
      for (int k = 0; k <= n; ++k)
        text += fmt::format("{}{}", k == 0 ? "" : ",", number(k * scale - 0.5));
      return text;
    };
    const auto multiplicities = [](int n, int d) {
      std::string text = fmt::format("{}", d + 1);
      for (int k = 1; k < n; ++k)
        text += fmt::format(",{}", d);
      return text + fmt::format(",{}", d + 1);
    };
    const bool closed = count_ == 1 && how_.loops != Dialect::Loops::Sectors;
    return {file_.add(fmt::format(
                "(BOUNDED_SURFACE()B_SPLINE_SURFACE(2,{},({}),.UNSPECIFIED.,{},.F.,.F.)"
                "B_SPLINE_SURFACE_WITH_KNOTS(({}),({}),({}),({}),.UNSPECIFIED.)GEOMETRIC_REPRESENTATION_ITEM()"
                "RATIONAL_B_SPLINE_SURFACE(({}))REPRESENTATION_ITEM('')SURFACE())",
                degree, points, closed ? ".T." : ".F.", multiplicities(kQuarters, 2), multiplicities(spans, degree),
                knots(kQuarters, 0.25), knots(spans, 1.0 / spans), weights)),
            true};
  }

  int face(std::size_t i, int k) {
    const Piece& a = pieces_[i];
    const bool flat = !a.isArc && next(i).z == a.z;
    Made made{};
    switch (how_.surfaces) {
      case Dialect::Surfaces::Own:
        made = ownSurface(i, 0);
        break;
      case Dialect::Surfaces::Revolution:
        made = flat ? ownSurface(i, 0) : revolution(i);
        break;
      case Dialect::Surfaces::Offset:
        made = offset(i);
        break;
      case Dialect::Surfaces::Splines:
        made = flat ? ownSurface(i, 0) : spline(i);
        break;
    }
    const std::vector<int> all = bounds(i, k, flat);
    return file_.add(
        fmt::format("ADVANCED_FACE('',({}),#{},{})", listOf(all), made.surface, made.sameSense ? ".T." : ".F."));
  }

  StepFile& file_;
  const std::vector<Piece>& pieces_;
  Pose pose_;
  Dialect how_;
  int count_ = 1;
  std::vector<double> angles_;
  std::vector<std::vector<int>> vertices_, circles_, meridians_;
};

}  // namespace

std::vector<int> revolvedFaces(StepFile& file, const Meridian& meridian, const Pose& pose, const Dialect& dialect) {
  return Reviser(file, meridian, pose, dialect).faces();
}

}  // namespace probewright::simulation::testing
