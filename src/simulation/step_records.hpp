#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// The text of a STEP file (ISO 10303-21) cut into what OpenCASCADE's reader fills its entities from. Its own scanner
/// takes most of the time in which it reads a file, many times what this takes.
namespace probewright::simulation {

class StepRecords {
public:
  enum class Kind : std::uint8_t { Integer, Real, Reference, Enumeration, Text, Binary, Nothing, Derived, List };

  struct Argument {
    const char* text = nullptr;  ///< ends with 0: "#12", "'name'", "1.5E-3", ".T.", "$", "*"; of a list its name, "$1"
    Kind kind = Kind::Nothing;
  };

  /// An entity, a part of one that has several types, or a list in it, which stands before what holds it.
  struct Record {
    const char* name = nullptr;  ///< "#12"; "#0" in the header and of further types; of a list "$1", "$2"
    const char* type = nullptr;  ///< "PLANE"; of a list kList, or what is written before its bracket
    std::size_t first = 0;       ///< of its arguments
    std::size_t count = 0;
  };
  static constexpr const char* kList = "/* (SUB) */";

  /// Reads the records of a whole file. Nothing where it is not written in the plain way of nearly all files: then only
  /// OpenCASCADE's reader may say what is wrong with it, or what it means.
  static std::optional<StepRecords> of(std::string bytes);

  StepRecords(StepRecords&&) = default;
  StepRecords& operator=(StepRecords&&) = default;

  const std::vector<Record>& records() const { return records_; }
  const std::vector<Argument>& arguments() const { return arguments_; }
  std::size_t headerRecords() const { return header_; }

  /// Some systems (AP242 of CATIA) tie the shape of a product to its body by a relationship that is meant for drawings;
  /// where nothing else does, it becomes the one for shapes, which OpenCASCADE looks at.
  void joinShapes();

  /// Drops what only annotations and colours refer to: half of a file with product and manufacturing information, and
  /// nothing that a shape is made of.
  void dropAnnotations();

private:
  struct Entity {
    std::uint64_t number = 0;
    std::size_t first = 0, last = 0;  ///< its records, without the last
    std::size_t head = 0;             ///< the record with its number
  };
  class Reader;

  StepRecords() = default;
  std::vector<std::size_t> referencesOf(const Entity& entity) const;

  std::string bytes_;
  std::deque<std::string> listNames_;
  std::vector<Record> records_;
  std::vector<Argument> arguments_;
  std::vector<Entity> entities_;
  std::size_t header_ = 0;
};

}  // namespace probewright::simulation
