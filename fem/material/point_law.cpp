#include "fem/material/point_law.hpp"

#include <Eigen/LU>

#include "fem/material/any_material.hpp"
#include "fem/material/projected_tangent.hpp"

namespace articular::fem {
namespace {

template <Hyperelastic M>
Mat9 tangent_of(const M& law, const Mat3& F, Tangent tangent) {
  return tangent == Tangent::Projected ? projected_tangent(law, F) : law.tangent(F);
}

}  // namespace

template <class Function>
auto PointLaw::with_law(Function function) const {
  return std::visit(
      [&]<class M>(const M& material) {
        if constexpr (Fibred<M>) {
          return function(material.along(a0_, activation_));
        } else {
          return function(material);
        }
      },
      material_);
}

template <class Function>
auto PointLaw::with_dilatation(Function function) const {
  return std::visit([&]<class M>(const M&) { return function(typename M::Dilatation{}); },
                    material_);
}

double PointLaw::energy_density(const Mat3& F) const {
  return with_law([&](const auto& law) { return law.energy_density(F); });
}
Mat3 PointLaw::first_piola(const Mat3& F) const {
  return with_law([&](const auto& law) { return law.first_piola(F); });
}
Mat9 PointLaw::tangent(const Mat3& F, Tangent tangent) const {
  return with_law([&](const auto& law) { return tangent_of(law, F, tangent); });
}
Mat3 PointLaw::cauchy_stress(const Mat3& F) const {
  return with_law([&](const auto& law) { return cauchy(law, F); });
}

double PointLaw::fibre_stretch(const Mat3& F) const {
  return prestretch(material_) * articular::fem::fibre_stretch(F, a0_.normalized());
}

double PointLaw::distortion_energy_density(const Mat3& F) const {
  return with_law([&](const auto& law) { return law.distortion().energy_density(F); });
}
Mat3 PointLaw::distortion_first_piola(const Mat3& F) const {
  return with_law([&](const auto& law) { return law.distortion().first_piola(F); });
}
Mat9 PointLaw::distortion_tangent(const Mat3& F, Tangent tangent) const {
  return with_law([&](const auto& law) { return tangent_of(law.distortion(), F, tangent); });
}
Mat3 PointLaw::distortion_cauchy_stress(const Mat3& F) const {
  return with_law([&](const auto& law) { return cauchy(law.distortion(), F); });
}

double PointLaw::dilatation(const Mat3& F) const {
  return with_dilatation([&](auto theta) { return theta.value(F); });
}
Mat3 PointLaw::dilatation_gradient(const Mat3& F) const {
  return with_dilatation([&](auto theta) { return theta.gradient(F); });
}
Mat9 PointLaw::dilatation_hessian(const Mat3& F) const {
  return with_dilatation([&](auto theta) { return theta.hessian(F); });
}

double bulk_modulus(const AnyMaterial& material) {
  return std::visit([](const auto& m) { return m.bulk_modulus(); }, material);
}
double shear_modulus(const AnyMaterial& material) {
  return std::visit([](const auto& m) { return m.shear_modulus(); }, material);
}

}  // namespace articular::fem
