#include "fem/simd/batched_law.hpp"

#include <type_traits>
#include <variant>

#include "fem/material/any_material.hpp"
#include "fem/material/point_law.hpp"
#include "fem/material/projected_tangent.hpp"
#include "fem/simd/stencil_kernels.hpp"

namespace articular::fem {
namespace {

SplitBatchLaw::Theta theta_of(const auto& material) {
  using Dilatation = typename std::decay_t<decltype(material)>::Dilatation;
  return std::is_same_v<Dilatation, LogVolumeChange> ? SplitBatchLaw::Theta::LogVolume
                                                     : SplitBatchLaw::Theta::Volume;
}

/// None where the kernels don't know the law.
std::optional<SplitBatchLaw> split_batch_law(const AnyMaterial& material, double activation) {
  return std::visit(
      [&]<class M>(const M& m) -> std::optional<SplitBatchLaw> {
        std::optional<SplitBatchLaw> law;
        if constexpr (requires { m.distortion().split_batch_law(); }) {
          law = m.distortion().split_batch_law();
        } else if constexpr (Fibred<M>) {
          law = m.fibred_batch_law(activation);
        }
        if (law) law->theta = theta_of(m);
        return law;
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

template <int kSize, class Matrix>
void store(const Matrix& A, int lane, Eight* rows) {
  for (int k = 0; k < kSize; ++k) rows[k].lane[lane] = A.data()[k];
}

/// The nearest positive semidefinite matrices, in place of those that are not.
/// @param indefinite  bit k: that of point k
void project(unsigned indefinite, int count, Eight* C) {
  for (int lane = 0; lane < count; ++lane) {
    if ((indefinite >> lane & 1) == 0) continue;
    Mat9 A;
    for (int k = 0; k < 81; ++k) A.data()[k] = C[k].lane[lane];
    store<81>(projected(A), lane, C);
  }
}

}  // namespace

BatchedLaw::BatchedLaw(InstructionSet set, const AnyMaterial& material, double activation)
    : set_(set),
      material_(material),
      activation_(activation),
      law_(split_batch_law(material, activation)) {
  if (law_) kernels_ = &point_kernels(set, *law_);
}

/// Calls evaluate(law, F, p, lane) for point after point.
template <class Evaluate>
void BatchedLaw::for_each_point(const EightPoints& points, int count, const Fibres& fibres,
                                Evaluate evaluate) const {
  for (int lane = 0; lane < count; ++lane) {
    const PointLaw law(material_, fibres.directions, fibres.column.lane[lane], activation_);
    evaluate(law, gradient_of(points, lane), pressure_of(points, lane), lane);
  }
}

/// Calls evaluate(points) with the fibres if the law has any.
template <class Evaluate>
void BatchedLaw::with_fibres(const EightPoints& points, const Fibres& fibres,
                             Evaluate evaluate) const {
  if (law_->distortion != SplitBatchLaw::Distortion::Fibred) return evaluate(points);
  Eight direction[3];
  for (int lane = 0; lane < kBatchSize; ++lane) {
    const auto a0 = fibres.directions.col(fibres.column.lane[lane]);
    for (int i = 0; i < 3; ++i) direction[i].lane[lane] = a0[i];
  }
  EightPoints with = points;
  with.fibre = direction;
  evaluate(with);
}

void BatchedLaw::energy_density(const EightPoints& points, int count, const Fibres& fibres,
                                Eight& W) const {
  if (law_) {
    return with_fibres(points, fibres,
                       [&](const EightPoints& all) { kernels_->energy_density(*law_, all, W); });
  }
  for_each_point(points, count, fibres,
                 [&](const PointLaw& law, const Mat3& F, double pressure, int lane) {
                   double sum = 0;
                   if (points.share != 0) sum += points.share * law.distortion_energy_density(F);
                   if (points.pressure != nullptr) sum += pressure * law.dilatation(F);
                   W.lane[lane] = sum;
                 });
}

void BatchedLaw::first_piola(const EightPoints& points, int count, const Fibres& fibres,
                             Eight* P) const {
  if (law_) {
    return with_fibres(points, fibres,
                       [&](const EightPoints& all) { kernels_->first_piola(*law_, all, P); });
  }
  for_each_point(points, count, fibres,
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
  if (law_ && is_projected && kernels_->projected_tangent != nullptr)
    return with_fibres(points, fibres,
                       [&](const EightPoints& all) { kernels_->projected_tangent(*law_, all, C); });
  consistent_tangent(points, count, fibres, C);
  if (is_projected) project(stencil_kernels(set_).indefinite(C), count, C);
}

void BatchedLaw::consistent_tangent(const EightPoints& points, int count, const Fibres& fibres,
                                    Eight* C) const {
  if (law_) {
    return with_fibres(points, fibres,
                       [&](const EightPoints& all) { kernels_->tangent(*law_, all, C); });
  }
  for_each_point(points, count, fibres,
                 [&](const PointLaw& law, const Mat3& F, double pressure, int lane) {
                   Mat9 sum = Mat9::Zero();
                   if (points.share != 0)
                     sum += points.share * law.distortion_tangent(F, Tangent::Consistent);
                   if (points.pressure != nullptr) sum += pressure * law.dilatation_hessian(F);
                   store<81>(sum, lane, C);
                 });
}

}  // namespace articular::fem
