#pragma once

#include <span>
#include <vector>

#include "fem/isochoric.hpp"

namespace articular::fem {

struct PronyTerm {
  double weight;  // g [-], > 0
  double time;    // τ [s], > 0
};

/// Relaxation of a stress S0, the second Piola–Kirchhoff stress of a distortion [Holzapfel 2000,
/// ch. 6.10]:
///
///   S = (1 − Σ g_i) S0 + Σ h_i,   dh_i/dt + h_i/τ_i = g_i dS0/dt
///
/// so that after a sudden strain S/S0 = 1 − Σ g_i (1 − exp(−t/τ_i)). S0 is what the law says of an
/// instantaneous strain. All are tensors of the rest frame, which rotations leave alone. A step
/// integrates exactly for an S0 that changes linearly in it [Taylor 1970]:
///
///   h_i' = exp(−Δt/τ_i) h_i + g_i a_i (S0' − S0),   a_i = (1 − exp(−Δt/τ_i)) τ_i/Δt
///
/// which makes it of second order for others, and stable for any step. Δt = 0 is a sudden strain.
/// Each element keeps S0 and one h a term, all 0 in a tissue that has rested for long.
///
/// [Holzapfel 2000] Holzapfel. Nonlinear Solid Mechanics. Wiley.
/// [Taylor 1970] Taylor, Pister, Goudreau. Thermomechanical analysis of viscoelastic solids.
///               Int. J. Numer. Meth. Eng. 2.
class PronySeries {
 public:
  /// @throws std::invalid_argument naming the term that is out of range, or the sum of the weights
  ///         unless it is below 1
  explicit PronySeries(std::vector<PronyTerm> terms);

  int num_terms() const { return static_cast<int>(terms_.size()); }
  /// S/S0 after a long time, 1 − Σ g_i
  double equilibrium_fraction() const { return equilibrium_; }

  /// ∂S'/∂S0' = 1 − Σ g_i (1 − a_i) of a step Δt [s] >= 0
  double instantaneous_fraction(double dt) const;
  /// The part of S' that is known when the step begins [Pa]: S' = instantaneous_fraction S0' +
  /// this.
  /// @param h  one a term
  Mat3 memory(std::span<const Mat3> h, const Mat3& S0, double dt) const;
  /// Takes h to the end of the step.
  void advance(const Mat3& S0, const Mat3& S0_next, double dt, std::span<Mat3> h) const;

 private:
  std::vector<PronyTerm> terms_;
  double equilibrium_;  // [-]
};

/// P = F S of a step, from P0 and ∂P0/∂F of the distortion.
inline Mat3 relaxed_first_piola(const Mat3& P0, const Mat3& F, double fraction,
                                const Mat3& memory) {
  return fraction * P0 + F * memory;
}
/// ∂P/∂F at the end of the step, symmetric.
inline Mat9 relaxed_tangent(const Mat9& tangent0, double fraction, const Mat3& memory) {
  return fraction * tangent0 + on_columns(memory);
}

}  // namespace articular::fem
