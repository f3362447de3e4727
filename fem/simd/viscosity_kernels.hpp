#pragma once

#include "fem/simd/element_batch.hpp"
#include "fem/simd/element_kernels.hpp"

namespace articular::fem {

/// A Kelvin–Voigt dashpot (viscosity.hpp) that moves on, at eight points.
struct EightMotions {
  const Eight* F;      // 9, column-major
  const Eight* rate;   // Ḟ [1/s], 9
  double eta, lambda;  // λ = ζ − 2η/3 [Pa s]
};

/// Results are written, not added.
struct ViscosityKernels {
  void (*first_piola)(const EightMotions&, Eight* P);  // 9 [Pa]
  /// damping ∂P/∂Ḟ + stiffness times the symmetric part of ∂P/∂F: entry (m, n) in C[m + 9 n].
  void (*tangent)(const EightMotions&, double damping, double stiffness, Eight* C);
};

/// @param set  one that the machine has
const ViscosityKernels& viscosity_kernels(InstructionSet set);

namespace baseline {
extern const ViscosityKernels viscosity_kernels;
}
namespace avx2 {
extern const ViscosityKernels viscosity_kernels;
}
namespace avx512 {
extern const ViscosityKernels viscosity_kernels;
}

}  // namespace articular::fem
