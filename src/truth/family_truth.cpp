#include "truth/family_truth.hpp"

#include "session/control_family.hpp"

namespace probewright::truth {

const FamilyTruth* familyTruth(control::ControlKind control) {
  const std::string_view name = session::knownFamilies().of(control).name;
  for (const FamilyTruth* family : {&heidenhainTruth, &sinumerikTruth})
    if (family->family == name) return family;
  return nullptr;
}

}  // namespace probewright::truth
