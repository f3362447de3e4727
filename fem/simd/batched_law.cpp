#include "fem/simd/batched_law.hpp"

#include <type_traits>
#include <variant>

#include "fem/material/any_material.hpp"
#include "fem/material/point_law.hpp"
#include "fem/material/projected_tangent.hpp"

namespace articular::fem {
namespace {

std::optional<SplitBatchLaw> split_batch_law(const AnyMaterial& material) {
  return std::visit(
      []<class M>(const M& m) -> std::optional<SplitBatchLaw> {
        if constexpr (requires { m.distortion().split_batch_law(); }) {
          SplitBatchLaw law = m.distortion().split_batch_law();
          if (std::is_same_v<typename M::Dilatation, LogVolumeChange>) {
            law.theta = SplitBatchLaw::Theta::LogVolume;
          }
          return law;
        }
        return std::nullopt;
      },
      material);
}

Mat3 gradient_of(const EightPoints& points, int lane) {
  Mat3 F;
  for (int k = 0; k < 9; ++k) F.data()[k] = points.F[k].lane[lane];
  return F;
}

double pressure_of(const EightPoints& points, int lane) {
  return points.pressure == nullptr ? 0 : points.pressure->lane[lane];
}

/// Calls evaluate(law, F, p, lane) for point after point.
template <class Evaluate>
void for_each_point(const AnyMaterial& material, const EightPoints& points, int count,
                    const BatchedLaw::Fibres& fibres, Evaluate evaluate) {
  for (int lane = 0; lane < count; ++lane) {
    const PointLaw law(material, fibres.directions, fibres.column.lane[lane], fibres.activation);
    evaluate(law, gradient_of(points, lane), pressure_of(points, lane), lane);
  }
}

template <int kSize, class Matrix>
void store(const Matrix& A, int lane, Eight* rows) {
  for (int k = 0; k < kSize; ++k) rows[k].lane[lane] = A.data()[k];
}

}  // namespace

BatchedLaw::BatchedLaw(InstructionSet set, const AnyMaterial& material)
    : material_(material), law_(split_batch_law(material)) {
  if (law_) kernels_ = &point_kernels(set, *law_);
}

void BatchedLaw::energy_density(const EightPoints& points, int count, const Fibres& fibres,
                                Eight& W) const {
  if (law_) return kernels_->energy_density(*law_, points, W);
  for_each_point(material_, points, count, fibres,
                 [&](const PointLaw& law, const Mat3& F, double pressure, int lane) {
                   double sum = 0;
                   if (points.share != 0) sum += points.share * law.distortion_energy_density(F);
                   if (points.pressure != nullptr) sum += pressure * law.dilatation(F);
                   W.lane[lane] = sum;
                 });
}

void BatchedLaw::first_piola(const EightPoints& points, int count, const Fibres& fibres,
                             Eight* P) const {
  if (law_) return kernels_->first_piola(*law_, points, P);
  for_each_point(material_, points, count, fibres,
                 [&](const PointLaw& law, const Mat3& F, double pressure, int lane) {
                   Mat3 sum = Mat3::Zero();
                   if (points.share != 0) sum += points.share * law.distortion_first_piola(F);
                   if (points.pressure != nullptr) sum += pressure * law.dilatation_gradient(F);
                   store<9>(sum, lane, P);
                 });
}

void BatchedLaw::tangent(const EightPoints& points, int count, const Fibres& fibres,
                         Tangent tangent, Eight* C) const {
  const bool is_projected = tangent == Tangent::Projected;
  if (law_) {
    return (is_projected ? kernels_->projected_tangent : kernels_->tangent)(*law_, points, C);
  }
  for_each_point(material_, points, count, fibres,
                 [&](const PointLaw& law, const Mat3& F, double pressure, int lane) {
                   if (points.pressure == nullptr) {
                     const Mat9 part = points.share * law.distortion_tangent(F, tangent);
                     return store<81>(part, lane, C);
                   }
                   Mat9 sum = pressure * law.dilatation_hessian(F);
                   if (points.share != 0) {
                     sum += points.share * law.distortion_tangent(F, Tangent::Consistent);
                   }
                   store<81>(is_projected ? projected(sum) : sum, lane, C);
                 });
}

}  // namespace articular::fem
