#pragma once

#include <concepts>

namespace articular::fem {

/// A law that the batched kernels know, as plain numbers: those kernels are compiled once for each
/// instruction set and share no inline code with anything else.
struct BatchLaw {
  enum class Kind { Corotated, NeoHookean };
  Kind kind;
  double mu, lambda;  // as in the formulas of the material [Pa]
};

/// A material opts in to the batched kernels by saying which of their laws it is. All others are
/// evaluated one element at a time.
template <class M>
concept Batched = requires(const M& m) {
  { m.batch_law() } -> std::same_as<BatchLaw>;
};

}  // namespace articular::fem
