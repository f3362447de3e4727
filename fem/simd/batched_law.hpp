#pragma once

#include <optional>

#include "fem/base/tangent.hpp"
#include "fem/base/types.hpp"
#include "fem/simd/point_kernels.hpp"

namespace articular::fem {

struct AnyMaterial;  // any_material.hpp

/// The law of a material at eight points: by kernels where they know it, point after point (see
/// point_law.hpp) where not. Refers to the material.
class BatchedLaw {
 public:
  /// Of the points that exist: where their fibres are, which only laws with fibres ask for.
  struct Fibres {
    const FibreDirections& directions;
    const EightIndices& column;
  };

  /// @param activation  in [0, 1]
  BatchedLaw(InstructionSet set, const AnyMaterial& material, double activation);

  /// As PointKernels have it, for the first `count` points; the others are of no meaning.
  void energy_density(const EightPoints& points, int count, const Fibres& fibres, Eight& W) const;
  void first_piola(const EightPoints& points, int count, const Fibres& fibres, Eight* P) const;
  void tangent(const EightPoints& points, int count, const Fibres& fibres, Tangent tangent,
               Eight* C) const;

 private:
  template <class Evaluate>
  void for_each_point(const EightPoints& points, int count, const Fibres& fibres,
                      Evaluate evaluate) const;
  template <class Evaluate>
  void with_fibres(const EightPoints& points, const Fibres& fibres, Evaluate evaluate) const;

  void consistent_tangent(const EightPoints& points, int count, const Fibres& fibres,
                          Eight* C) const;

  InstructionSet set_;
  const AnyMaterial& material_;
  double activation_;
  std::optional<SplitBatchLaw> law_;
  const PointKernels* kernels_ = nullptr;  // where there is a law_
};

}  // namespace articular::fem
