#include "words/own_words.hpp"

namespace probewright::words {

void addOwnWords(const cycles::CycleDefinition& cycle, nlohmann::json& table) {
  for (const cycles::OwnWords& own : cycle.words)
    table[std::string(own.english)] = {own.german, own.russian, own.swedish, own.chinese, own.polish};
}

void addOwnWords(nlohmann::json& table) {
  for (const control::ControlKind kind : control::allControlKinds) {
    for (const cycles::CycleDefinition* cycle : cycles::cyclesOf(kind))
      addOwnWords(*cycle, table);
  }
}

}  // namespace probewright::words
