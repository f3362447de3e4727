#pragma once

#include <vector>

#include "fem/simd/element_kernels.hpp"

namespace articular::fem {

/// Those that this machine has.
inline std::vector<InstructionSet> instruction_sets() {
  std::vector<InstructionSet> sets{InstructionSet::Baseline};
  if (best_instruction_set() != InstructionSet::Baseline) sets.push_back(InstructionSet::Avx2);
  if (best_instruction_set() == InstructionSet::Avx512) sets.push_back(InstructionSet::Avx512);
  return sets;
}

}  // namespace articular::fem
