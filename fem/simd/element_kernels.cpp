#include "fem/simd/element_kernels.hpp"

#include <Eigen/Core>
#include <atomic>

#include "fem/base/rotation_svd.hpp"

namespace articular::fem {
namespace {

std::atomic<bool> keeps_to_baseline = false;

const ElementKernels& kernels_of(InstructionSet set) {
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

}  // namespace

void keep_to_baseline() { keeps_to_baseline = true; }

InstructionSet best_instruction_set() {
  if (keeps_to_baseline) return InstructionSet::Baseline;
  if (__builtin_cpu_supports("avx512f")) return InstructionSet::Avx512;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return InstructionSet::Avx2;
  return InstructionSet::Baseline;
}

const LawKernels& element_kernels(InstructionSet set, BatchLaw::Kind law) {
  const ElementKernels& kernels = kernels_of(set);
  switch (law) {
    case BatchLaw::Kind::Corotated:
      return kernels.corotated;
    case BatchLaw::Kind::CoupledNeoHookean:
      return kernels.coupled_neo_hookean;
    case BatchLaw::Kind::NeoHookean:
      break;
  }
  return kernels.neo_hookean;
}

void svd_of_hard_case(const double F[9], double U[9], double V[9], double sigma[3]) {
  const RotationSvd svd = rotation_svd(Eigen::Map<const Mat3>(F));
  Eigen::Map<Mat3>{U} = svd.U;
  Eigen::Map<Mat3>{V} = svd.V;
  Eigen::Map<Vec3>{sigma} = svd.sigma;
}

}  // namespace articular::fem
