#pragma once

// The laws at eight points, compiled once for each instruction set by the smoothed_kernels_*.cpp,
// which name it: ARTICULAR_INSTRUCTION_SET.

#include "fem/simd/corotated_point_lanes.inl.hpp"
#include "fem/simd/eight_matrix.inl.hpp"
#include "fem/simd/fibre_lanes.inl.hpp"
#include "fem/simd/isotropic_lanes.inl.hpp"
#include "fem/simd/point_kernels.hpp"

namespace articular::fem::ARTICULAR_INSTRUCTION_SET {
namespace {

constexpr int kPoints = 8;

/// Calls use(law, state, first) for as many points at a time as a register holds.
template <class Law, class Use>
inline void for_each_state(const SplitBatchLaw& numbers, const EightPoints& points,
                           const Use& use) {
  const Law law(numbers);
  for (int first = 0; first < kPoints; first += kWidth) {
    use(law, Law::at(load_matrix(points.F, first), points, first), first);
  }
}

template <class Law>
void energy_density(const SplitBatchLaw& numbers, const EightPoints& points, Eight& W) {
  for_each_state<Law>(numbers, points, [&W](const Law& law, const auto& state, int first) {
    store(law.energy_density(state), W.lane + first);
  });
}

template <class Law>
void first_piola(const SplitBatchLaw& numbers, const EightPoints& points, Eight* P) {
  for_each_state<Law>(numbers, points, [P](const Law& law, const auto& state, int first) {
    store_matrix(law.first_piola(state), P, first);
  });
}

template <class Law, bool kProjected>
void tangent(const SplitBatchLaw& numbers, const EightPoints& points, Eight* C) {
  for_each_state<Law>(numbers, points, [C](const Law& law, const auto& state, int first) {
    Tangent81 result;
    if constexpr (kProjected) {
      law.projected_tangent(state, result);
    } else {
      law.tangent(state, result);
    }
    for (int n = 0; n < 9; ++n) {
      for (int m = 0; m < 9; ++m) {
        store(result.block[m / 3 + 3 * (n / 3)][n % 3][m % 3], C[m + 9 * n].lane + first);
      }
    }
  });
}

/// Null where a law has no closed form of it.
template <class Law>
constexpr auto projected_tangent_of() {
  if constexpr (requires(const Law& law, const typename Law::State& state, Tangent81& C) {
                  law.projected_tangent(state, C);
                }) {
    return &tangent<Law, true>;
  } else {
    return nullptr;
  }
}

template <class Law>
constexpr PointKernels point_kernels_of{energy_density<Law>, first_piola<Law>, tangent<Law, false>,
                                        projected_tangent_of<Law>()};

template <class Energy>
const PointKernels& kernels_with_theta(const SplitBatchLaw& law) {
  return law.theta == SplitBatchLaw::Theta::Volume
             ? point_kernels_of<IsotropicLanes<Energy, VolumeTheta>>
             : point_kernels_of<IsotropicLanes<Energy, LogVolumeTheta>>;
}

template <class Energy, bool kShear>
const PointKernels& kernels_with_fibres(const SplitBatchLaw& law) {
  return law.theta == SplitBatchLaw::Theta::Volume
             ? point_kernels_of<FibreLanes<Energy, VolumeTheta, kShear>>
             : point_kernels_of<FibreLanes<Energy, LogVolumeTheta, kShear>>;
}

const PointKernels& kernels_with_fibres(const SplitBatchLaw& law) {
  if (law.fibres.shear_along != 0) return kernels_with_fibres<PolynomialEnergy<false>, true>(law);
  return law.c[2] == 0 ? kernels_with_fibres<PolynomialEnergy<false>, false>(law)
                       : kernels_with_fibres<PolynomialEnergy<true>, false>(law);
}

}  // namespace

const PointKernels& point_kernels(const SplitBatchLaw& law) {
  using enum SplitBatchLaw::Distortion;
  if (law.distortion == Corotated) return point_kernels_of<CorotatedPointLanes>;
  if (law.distortion == NeoHookean) return kernels_with_theta<NeoHookeanEnergy>(law);
  if (law.distortion == CoupledNeoHookean)
    return point_kernels_of<IsotropicLanes<CoupledNeoHookeanEnergy, LogVolumeTheta>>;
  if (law.distortion == Fibred) return kernels_with_fibres(law);
  return law.c[2] == 0 ? kernels_with_theta<PolynomialEnergy<false>>(law)
                       : kernels_with_theta<PolynomialEnergy<true>>(law);
}

}  // namespace articular::fem::ARTICULAR_INSTRUCTION_SET
