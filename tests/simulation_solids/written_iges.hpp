#pragma once

#include <string>
#include <vector>

#include "geometry/primitives.hpp"

/// IGES files written entity by entity: surfaces in forms that OpenCASCADE's own writer never makes.
namespace probewright::simulation::testing {

class IgesFile {
public:
  struct Units {
    int flag = 2;      ///< 1 inch, 2 mm, 6 m
    double scale = 1;  ///< of the model: its size over the true one
  };
  explicit IgesFile(Units units) : units_(units) {}
  IgesFile() : IgesFile(Units{}) {}

  /// An entity with its parameters, without type and end; returns its place in the directory. `matrix`: an entity 124,
  /// or 0. `use`: the eight digits of the status.
  int add(int type, const std::string& parameters, int form = 0, int matrix = 0, const std::string& use = "00000000");
  /// In the unit of the file.
  std::string length(double mm) const;
  std::string point(const Vector3& p) const;

  int line(const Vector3& from, const Vector3& to, bool dependent = true);
  /// A circular arc as a rational spline, anticlockwise about z.
  int arc(const Pose& pose, double radius, double from, double to);
  /// A whole or partial cylinder about Z of a pose as one rational spline surface: u around, from 0 to arcSpans(), v
  /// along, from 0 to 1.
  int cylinder(const Pose& pose, double radius, double z0, double z1, double u0, double u1,
               const std::string& use = "00000000", int matrix = 0);
  int matrix(const Matrix3& turn, const Vector3& shift, int form = 0);
  std::string text() const;

private:
  Units units_;
  struct Entity {
    int type, form, matrix;
    std::string parameters, use;
  };
  std::vector<Entity> entities_;
};

std::string igesNumber(double value);

/// Into how many rational pieces arc() and cylinder() cut an angle.
int arcSpans(double from, double to);
/// The parameter of arc() and cylinder() at an angle.
double arcParameter(double from, double to, double angle);

}  // namespace probewright::simulation::testing
