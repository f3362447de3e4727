#pragma once

#include <concepts>

namespace articular::fem {

/// A law that the batched kernels know, as plain numbers: those kernels are compiled once for each
/// instruction set and share no inline code with anything else.
struct BatchLaw {
  enum class Kind { Corotated, NeoHookean, CoupledNeoHookean };
  Kind kind;
  double mu, lambda;  // as in the formulas of the material [Pa]
};

/// A material opts in to the batched kernels by saying which of their laws it is. All others are
/// evaluated one element at a time.
template <class M>
concept Batched = requires(const M& m) {
  { m.batch_law() } -> std::same_as<BatchLaw>;
};

/// The energy W of fibres at a stretch and an activation with its derivatives, as calls: see
/// FibreLaw.
struct FibreCurve {
  using Function = double (*)(const void* law, double stretch, double activation);
  const void* law = nullptr;     // null: no such fibres
  Function energy = nullptr;     // W [J/m³]
  Function tension = nullptr;    // dW/dλ [Pa]
  Function stiffness = nullptr;  // d²W/dλ² [Pa]
};

/// What fibres add to the polynomial of a SplitBatchLaw.
struct FibreBatchLaw {
  double activation = 0;                     // in [0, 1]
  double shear_along = 0, shear_across = 0;  // G1, G2 of fibre_shear.hpp [Pa]
  FibreCurve of_stretch = {}, of_isochoric_stretch = {};
};

/// A law that is split into distortion and dilatation (see split_material.hpp), as plain numbers,
/// for the kernels of point_kernels.hpp.
struct SplitBatchLaw {
  enum class Distortion { Corotated, NeoHookean, CoupledNeoHookean, Polynomial, Fibred };
  enum class Theta { Volume, LogVolume };  // of Corotated: neither, but that of its rotation
  Distortion distortion;
  Theta theta = Theta::Volume;
  /// Corotated and both NeoHookean: μ, λ of the distortion. Polynomial: c10, c20, c01 of
  /// c10 (Ī1 − 3) + c20 (Ī1 − 3)² + c01 (Ī2 − 3); Fibred: the same, with fibres. [Pa]
  double c[3];
  FibreBatchLaw fibres = {};
};

}  // namespace articular::fem
