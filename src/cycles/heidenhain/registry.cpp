#include "cycles/heidenhain/registry.hpp"

#include <algorithm>

#include "cycles/heidenhain/cycles.hpp"

namespace probewright::cycles::heidenhain {

std::span<const Entry> entries() {
  static constexpr Entry all[] = {
      {&cycle0Definition, cycle0},       {&cycle1Definition, cycle1},       {&cycle2Definition, cycle2},
      {&cycle3Definition, cycle3},       {&cycle4Definition, cycle4},       {&cycle9Definition, cycle9},
      {&cycle400Definition, cycle400},   {&cycle401Definition, cycle401},   {&cycle402Definition, cycle402},
      {&cycle403Definition, cycle403},   {&cycle404Definition, cycle404},   {&cycle405Definition, cycle405},
      {&cycle408Definition, cycle408},   {&cycle409Definition, cycle409},   {&cycle410Definition, cycle410},
      {&cycle411Definition, cycle411},   {&cycle412Definition, cycle412},   {&cycle413Definition, cycle413},
      {&cycle414Definition, cycle414},   {&cycle415Definition, cycle415},   {&cycle416Definition, cycle416},
      {&cycle417Definition, cycle417},   {&cycle418Definition, cycle418},   {&cycle419Definition, cycle419},
      {&cycle420Definition, cycle420},   {&cycle421Definition, cycle421},   {&cycle422Definition, cycle422},
      {&cycle423Definition, cycle423},   {&cycle424Definition, cycle424},   {&cycle425Definition, cycle425},
      {&cycle426Definition, cycle426},   {&cycle427Definition, cycle427},   {&cycle430Definition, cycle430},
      {&cycle431Definition, cycle431},   {&cycle440Definition, cycle440},   {&cycle441Definition, cycle441},
      {&cycle444Definition, cycle444},   {&cycle460Definition, cycle460},   {&cycle461Definition, cycle461},
      {&cycle462Definition, cycle462},   {&cycle463Definition, cycle463},   {&cycle1410Definition, cycle1410},
      {&cycle1411Definition, cycle1411}, {&cycle1420Definition, cycle1420},
  };
  return all;
}

const Entry* findEntry(int number) {
  const auto found =
      std::ranges::find_if(entries(), [number](const Entry& entry) { return entry.definition->number == number; });
  return found == entries().end() ? nullptr : &*found;
}

}  // namespace probewright::cycles::heidenhain
