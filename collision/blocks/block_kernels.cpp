#include "collision/blocks/block_kernels.hpp"

namespace articular::collision {

InstructionSet best_instruction_set() {
  if (__builtin_cpu_supports("avx512f")) return InstructionSet::Avx512;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return InstructionSet::Avx2;
  return InstructionSet::Baseline;
}

const BlockKernels& block_kernels(InstructionSet set) {
  switch (set) {
    case InstructionSet::Avx512:
      return avx512::kernels;
    case InstructionSet::Avx2:
      return avx2::kernels;
    case InstructionSet::Baseline:
      break;
  }
  return baseline::kernels;
}

}  // namespace articular::collision
