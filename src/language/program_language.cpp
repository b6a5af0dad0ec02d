#include "language/program_language.hpp"

#include <utility>

#include "language/din_iso/program.hpp"
#include "language/klartext/program.hpp"
#include "language/sinumerik/program.hpp"

namespace probewright::language {

std::shared_ptr<Program> programFromText(std::string name, std::string text, ProgramLanguage language) {
  switch (language) {
    case ProgramLanguage::Klartext:
      return std::make_shared<klartext::KlartextProgram>(std::move(name), std::move(text));
    case ProgramLanguage::DinIso:
      return std::make_shared<din_iso::DinIsoProgram>(std::move(name), std::move(text));
    case ProgramLanguage::Sinumerik:
      break;
  }
  return sinumerik::SinumerikProgram::fromText(std::move(name), std::move(text));
}

}  // namespace probewright::language
