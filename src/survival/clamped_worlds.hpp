#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "session/run.hpp"
#include "setup/setup_document.hpp"
#include "simulation/import_options.hpp"
#include "simulation/tool_shape.hpp"
#include "simulation/virtual_machine.hpp"
#include "survival/clamping.hpp"

/// The worlds of all clampings of a setup. What does not vary is built once and shared.
namespace probewright::survival {

/// How far what a clamping moves is from where it is in the middle of a box.
struct Displacements {
  /// Of a solid: any point of it, mm.
  struct OfSolid {
    Vector3 shift = Vector3::Zero();  ///< along X, Y, Z of the table, to either side
    double turn = 0;                  ///< in any direction, besides
  };
  std::vector<OfSolid> ofSolids;  ///< by their place in Truth::solids

  /// Of a tool: each ball, each shaft, mm along the tool.
  struct OfTool {
    std::vector<double> balls, shafts;
  };
  std::vector<OfTool> ofTools;  ///< by their place in Truth::tools
};

class ClampedWorlds {
public:
  /// Loads the parts and sees what each tolerance changes. Refused: one that changes nothing, or something that is not
  /// known to be covered.
  static Result<std::unique_ptr<ClampedWorlds>> make(setup::SetupDocument document, std::vector<Tolerance> tolerances,
                                                     const simulation::ImportOptions& import);

  const std::vector<Tolerance>& tolerances() const { return tolerances_; }
  const setup::Setup& asWritten() const { return document_.asWritten(); }
  std::vector<double> written() const;  ///< the numbers as the setup has them

  /// The truth of a clamping, or why the setup cannot be like this.
  Result<simulation::Truth> truth(std::span<const double> values) const;
  /// The same with the features of solids as they have the most, or the least, material in the box. Features that are
  /// larger hold those that are smaller, so every solid of the box lies between the two.
  Result<simulation::Truth> truthWithMost(const Box& box) const;
  Result<simulation::Truth> truthWithLeast(const Box& box) const;

  /// The machine in a world, or what it touches where it starts.
  Result<std::unique_ptr<simulation::VirtualMachine>> machine(simulation::Truth truth) const;

  /// Of the box against its middle, without what changes the sizes of solids. `middle`: its truth.
  Displacements displacements(const Box& box, const simulation::Truth& middle) const;
  /// How far any point of any solid can be from where it is in the middle of all tolerances.
  double farthestFromMiddle(const Box& box) const;
  /// The greatest of them that this side of the box makes alone, with half the sizes; which side to split.
  double reachOf(std::size_t tolerance, const Box& box) const;

  /// By their place in Truth::solids: those whose sizes vary.
  const std::vector<bool>& sizeVaries() const { return sizeVaries_; }
  bool anySizeVaries() const { return anySizeVaries_; }

private:
  ClampedWorlds(setup::SetupDocument document, std::vector<Tolerance> tolerances,
                const simulation::ImportOptions& import);
  Result<void> explore();
  Result<setup::Setup> setupOf(std::span<const double> values) const;
  enum class Material : std::uint8_t { Most, Least };
  /// The corner of the box with the most or the least material.
  std::vector<double> cornerWith(Material material, const Box& box) const;
  /// A solid whose pose varies: where each of its six numbers comes from.
  struct Posed {
    std::size_t solid = 0;
    std::array<double, 6> written{};                      ///< x, y, z, a, b, c
    std::array<std::optional<std::size_t>, 6> tolerance;  ///< that takes the place of what is written
  };
  /// The poses that vary, if nothing else does: then a truth is the one that is written with other poses.
  void findPoses();
  /// The solid of this recipe, which is `solid` of the world with sizes of these values.
  Result<std::shared_ptr<const simulation::Solid>> resized(std::size_t solid, const simulation::SolidRecipe& recipe,
                                                           std::span<const double> values) const;
  Pose poseOf(const Posed& posed, std::span<const double> values) const;

  setup::SetupDocument document_;
  std::vector<Tolerance> tolerances_;
  std::stop_token stop_;
  std::vector<simulation::PlacedSolid> solids_;  ///< as built: those of the world, then the table
  std::vector<simulation::MachineBody> bodies_;
  std::vector<std::vector<bool>> moves_;  ///< by tolerance and solid
  std::vector<double> radius_;            ///< of solids about the origin of their pose, mm
  std::vector<double> material_;          ///< by tolerance: +1 if larger is more material, -1 if less, 0: no size
  std::vector<bool> sizeVaries_;
  bool anySizeVaries_ = false;
  std::vector<Posed> posed_;
  std::optional<simulation::Truth> truthAsWritten_;  ///< where nothing but the poses of `posed_` varies
  mutable tbb::enumerable_thread_specific<toml::table> tables_;

  /// Solids of sizes that were asked for lately.
  struct Resized {
    std::size_t solid = 0;
    std::vector<double> sizes;
    std::shared_ptr<const simulation::Solid> shape;
  };
  static constexpr std::size_t mostResized = 128;
  mutable std::mutex mutex_;
  mutable std::deque<Resized> resized_;
};

}  // namespace probewright::survival
