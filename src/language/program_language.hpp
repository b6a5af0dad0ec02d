#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "language/program.hpp"

namespace probewright::language {

enum class ProgramLanguage : std::uint8_t { Klartext, DinIso, Sinumerik };

/// A program in memory; `name` names it in messages.
std::shared_ptr<Program> programFromText(std::string name, std::string text, ProgramLanguage language);

}  // namespace probewright::language
