#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "survival/survive.hpp"

/// What is said of a program's survival: for the terminal, for other programs, and as a page with the map.
namespace probewright::survival {

struct SurvivalInfo {
  std::string program, setup;  ///< files
  std::string version;
  std::string text;  ///< of the program
};

/// Fields are described in docs/survive.md.
nlohmann::ordered_json survivalJson(const Survival& survival, const SurvivalInfo& info);

std::string survivalText(const Survival& survival);

/// A page of its own: verdict, map, the program with the worst block marked, the first failures.
std::string survivalPage(const Survival& survival, const SurvivalInfo& info);

}  // namespace probewright::survival
