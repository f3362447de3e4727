#include "tests/fem/support/laws.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>

namespace articular::fem {
namespace {

template <Hyperelastic Law>
Jet evaluated(const Law& law, const Mat3& F) {
  return {law.energy_density(F), law.first_piola(F), law.tangent(F)};
}

template <class M>
LawExample example(const char* name, const M& m, double scale, const Promise& promise = {}) {
  const auto local = [m]([[maybe_unused]] double activation) {
    if constexpr (Fibred<M>) {
      return m.along(kFibre, activation);
    } else {
      return m;
    }
  };
  using Theta = typename M::Dilatation;
  return {.name = name,
          .material = m,
          .fibred = Fibred<M>,
          .promise = promise,
          .scale = scale,
          .law = [local](const Mat3& F, double a) { return evaluated(local(a), F); },
          .distortion = [local](const Mat3& F,
                                double a) { return evaluated(local(a).distortion(), F); },
          .dilatation =
              [](const Mat3& F) {
                return Jet{Theta::value(F), Theta::gradient(F), Theta::hessian(F)};
              },
          .bulk_modulus = m.bulk_modulus(),
          .shear_modulus = m.shear_modulus()};
}

Mat9 outer(const Mat3& a, const Mat3& b) {
  return Vec9(a.reshaped()) * Vec9(b.reshaped()).transpose();
}

/// The fibres of TransverselyIsotropic, as fibre_lanes.inl.hpp has them: W(q) of q = λ J^(−1/3), or
/// of the stretch λ. What the pull W' q adds by ln J is the ground's.
template <class Law>
void add_fibre_part(const Law& fibre, bool isochoric, const Mat3& F, double activation,
                    FibrePart& part) {
  const double J = F.determinant(), stretch = (F * kFibre).norm();
  const double q = isochoric ? stretch / std::cbrt(J) : stretch;
  const double pull = fibre.tension(q, activation) * q;
  const double stiffness = fibre.stiffness(q, activation) * q * q;
  const Vec3 n = F * kFibre / stretch;
  const Mat3 by_stretch = n * kFibre.transpose() / stretch;  // ∂ln λ/∂F
  const Mat3 by_q = isochoric ? Mat3(by_stretch - F.inverse().transpose() / 3) : by_stretch;
  const Mat3 aside = Mat3::Identity() - n * n.transpose();
  Mat9 turning;  // (1 − n nᵀ) ⊗ a aᵀ/λ²
  for (int j = 0; j < 3; ++j)
    for (int l = 0; l < 3; ++l)
      turning.block<3, 3>(3 * j, 3 * l) = kFibre[j] * kFibre[l] / (stretch * stretch) * aside;
  part.hessian +=
      (stiffness + pull) * outer(by_q, by_q) + pull * (turning - outer(by_stretch, by_stretch));
  part.positive += std::max(0.0, stiffness) * outer(by_q, by_q) + pull * turning;
}

/// Laws that come with either volumetric energy.
template <class Theta>
void add_isochoric(const std::string& suffix, std::vector<LawExample>& laws) {
  const auto add = [&](const char* name, const auto& m, double scale, const Promise& promise) {
    laws.push_back(example((name + suffix).c_str(), m, scale, promise));
  };
  add("MooneyRivlin", MooneyRivlin<Theta>(3e3, 1e3, 2e4), 2e4, {});
  add("Yeoh", Yeoh<Theta>(1037, 486, 10370), 1e4, {});  // tongue
  add("Ogden", Ogden<Theta>({{4e3, 2.5}, {1e3, -3}, {200, 7}}, 2e4), 2e4, {});
  add("VerondaWestmann", VerondaWestmann<Theta>(1e4, 2, 1e5), 1e5, {});
  const auto add_with_fibres = [&](const char* name, const ToeLinearFibre& passive,
                                   const ActiveFibre& active, const auto& m, double scale) {
    add(name, m, scale, {.shape_only = false});
    laws.back().fibre_part = [=](const Mat3& F, double activation) {
      FibrePart part{Mat9::Zero(), Mat9::Zero()};
      add_fibre_part(passive, true, F, activation, part);
      add_fibre_part(active, false, F, activation, part);
      return part;
    };
  };
  add_with_fibres("TransverselyIsotropic", cruciate_fibre(), ActiveFibre({.stress = 5e6}),
                  TransverselyIsotropic<Theta>(1.95e6, 0.5e6, cruciate_fibre(), 146.41e6,
                                               ActiveFibre({.stress = 5e6})),
                  1.5e8);
  add("Prestretched",
      TransverselyIsotropic<Theta>(1.95e6, 0.5e6, cruciate_fibre(), 146.41e6,
                                   ActiveFibre({.stress = 5e6}), 1.05),
      1.5e8,
      {.shape_only = false,
       .one_shear_modulus = false,
       .rest = prestretch_gradient(1 / 1.05, kFibre)});
  add_with_fibres("LengthDependent", cardiac_fibre(), cardiac_activity(),
                  TransverselyIsotropic<Theta>(2e3, 1e3, cardiac_fibre(), 1e5, cardiac_activity()),
                  1e6);
  add("BlemkerMuscle",
      BlemkerMuscle<Theta>(MuscleFibre({.optimal_stretch = 1.05}),
                           {.G1 = 500, .G2 = 800, .c10 = 200}),
      1e7, {.shape_only = false, .one_shear_modulus = false});
  add("BlemkerMuscleWithTendon",
      BlemkerMuscle<Theta>(MuscleFibre({.optimal_stretch = 1.05, .tendon_ratio = 0.4}),
                           {.G1 = 500, .G2 = 800, .c10 = 200, .active_c10 = 600}),
      1e7, {.shape_only = false, .one_shear_modulus = false});
}

}  // namespace

ToeLinearFibre cruciate_fibre() {
  return ToeLinearFibre({.c3 = 0.0139e6, .c4 = 116.22, .c5 = 535.039e6, .toe_end = 1.046});
}

ToeLinearFibre cardiac_fibre() {
  return ToeLinearFibre({.c3 = 1e3, .c4 = 12, .c5 = 2e5, .toe_end = 1.25});
}

ActiveFibre cardiac_activity() {
  return ActiveFibre({.stress = 135.7e3, .force_length = ForceLength({.calcium = 3.1})});
}

void PrintTo(const LawExample& example, std::ostream* out) { *out << example.name; }

std::vector<LawExample> all_laws() {
  constexpr double E = 2e4, nu = 0.4;  // [Pa], [-] soft tissue
  std::vector<LawExample> laws{
      example("Linear", Linear(E, nu), E,
              {.objective = false, .shape_only = false, .inverted = true}),
      example("Corotated", Corotated(E, nu), E, {.shape_only = false, .inverted = true}),
      example("StVenantKirchhoff", StVenantKirchhoff(E, nu), E,
              {.shape_only = false, .least_stretch = 1 / std::sqrt(3.0)}),
      example("NeoHookean", NeoHookean(E, nu), E, {.shape_only = false, .inverted = true}),
      example("CoupledNeoHookean", CoupledNeoHookean(E, nu), E, {.shape_only = false}),
      example("HolmesMow", HolmesMow(E, 0.2, 0.7), E, {.shape_only = false})};
  add_isochoric<VolumeChange>("", laws);
  add_isochoric<LogVolumeChange>("Log", laws);
  return laws;
}

}  // namespace articular::fem
