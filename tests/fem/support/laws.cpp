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
  add("TransverselyIsotropic",
      TransverselyIsotropic<Theta>(1.95e6, 0.5e6, cruciate_fibre(), 146.41e6,
                                   ActiveFibre({.stress = 5e6})),
      1.5e8, {.shape_only = false});
  add("Prestretched",
      TransverselyIsotropic<Theta>(1.95e6, 0.5e6, cruciate_fibre(), 146.41e6,
                                   ActiveFibre({.stress = 5e6}), 1.05),
      1.5e8,
      {.shape_only = false,
       .one_shear_modulus = false,
       .rest = prestretch_gradient(1 / 1.05, kFibre)});
  add("LengthDependent",
      TransverselyIsotropic<Theta>(2e3, 1e3, cardiac_fibre(), 1e5, cardiac_activity()), 1e6,
      {.shape_only = false});
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
