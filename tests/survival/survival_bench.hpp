#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "setup/setup_document.hpp"
#include "survival/survive.hpp"

/// Clampings of a plate with a bore on a mill.
namespace probewright::survival::testing {

/// A plate of 80 x 60 x 20 mm with a bore of 30 mm in its middle; the top face lies at Z -480, where the control
/// believes it. `tool` adds to the probe, `more` to the setup.
inline std::string plateSetup(const std::string& control = "TNC640", const std::string& tool = "",
                              const std::string& more = "") {
  const std::string frame = control == "840Dsl" ? "[[zero_offset]]\nname = \"G54\"\n" : "[[preset]]\nrow = 1\n";
  return "[control]\ntype = \"" + control + R"("
[part]
name = "plate"
pose = { x = 0, y = 0, z = -500, c = 0 }
[[part.feature]]
shape = "box"
size = [80, 60, 20]
[[part.feature]]
shape = "hole"
centre = [0, 0, 20]
diameter = 30
)" + frame +
         R"(origin = [0, 0, -480]
active = true
[[tool]]
number = 1
name = "PROBE"
kind = "probe"
length = 150
ball_radius = 3
stylus_length = 50
)" + tool +
         more;
}

inline std::string klartext(const std::string& blocks) {
  return "0 BEGIN PGM P MM\n1 TOOL CALL 1 Z\n2 L Z+50 R0 FMAX\n" + blocks + "99 END PGM P MM\n";
}

/// Cycle 421: inspects the bore.
inline const std::string inspectBore =
    "TCH PROBE 421 BORE ~\nQ273=+0 ~\nQ274=+0 ~\nQ262=+30 ~\nQ325=+0 ~\nQ247=+90 ~\nQ261=-5 ~\nQ320=+2 ~\nQ260=+20 ~\n"
    "Q301=+0 ~\nQ275=+0 ~\nQ276=+0 ~\nQ279=+0 ~\nQ280=+0 ~\nQ281=+0 ~\nQ309=+0 ~\nQ330=+0 ~\nQ423=+4 ~\nQ365=+0\n";

/// Cycle 412: the preset goes to the middle of the bore.
inline const std::string presetInBore =
    "TCH PROBE 412 INSIDE CIRCLE ~\nQ321=+0 ~\nQ322=+0 ~\nQ262=+30 ~\nQ325=+0 ~\nQ247=+90 ~\nQ261=-5 ~\nQ320=+2 ~\n"
    "Q260=+20 ~\nQ301=+0 ~\nQ305=+1 ~\nQ331=+0 ~\nQ332=+0 ~\nQ303=+1 ~\nQ381=+0 ~\nQ382=+0 ~\nQ383=+0 ~\nQ384=+0 ~\n"
    "Q333=+0 ~\nQ423=+4 ~\nQ365=+0\n";

/// Cycle 417: the preset's Z goes to the top face.
inline const std::string presetOnTop =
    "TCH PROBE 417 REF. POINT TS.-AXIS ~\nQ263=+30 ~\nQ264=+20 ~\nQ294=+0 ~\nQ320=+2 ~\nQ260=+20 ~\nQ305=+1 ~\n"
    "Q333=+0 ~\nQ303=+1\n";

inline Tolerance tolerance(const std::string& text, const std::string& setup) {
  const toml::table table = toml::parse(setup);
  auto tolerance = parseTolerance(text, table);
  if (!tolerance) throw std::runtime_error(tolerance.error().message);
  return *tolerance;
}

inline std::unique_ptr<ClampedProgram> clamped(const std::string& setup, const std::string& program,
                                               const std::vector<std::string>& tolerances,
                                               const std::string& name = "p.h") {
  Diagnostics mistakes;
  auto document = setup::SetupDocument::parse(setup, "setup.toml", mistakes);
  for (const Diagnostic& mistake : mistakes)
    ADD_FAILURE() << format(mistake);
  if (!document) return nullptr;
  std::vector<Tolerance> box;
  for (const std::string& text : tolerances)
    box.push_back(tolerance(text, setup));
  auto worlds = ClampedWorlds::make(std::move(*document), std::move(box), {});
  if (!worlds) {
    ADD_FAILURE() << format(worlds.error());
    return nullptr;
  }
  auto made = ClampedProgram::make({name, program}, *std::move(worlds), {}, {});
  if (!made) {
    ADD_FAILURE() << format(made.error());
    return nullptr;
  }
  return *std::move(made);
}

inline Survival survivalOf(const std::string& setup, const std::string& program,
                           const std::vector<std::string>& tolerances, Options options = {.samples = 20, .boxes = 24}) {
  const auto made = clamped(setup, program, tolerances);
  return made ? survive(*made, options) : Survival{};
}

}  // namespace probewright::survival::testing
