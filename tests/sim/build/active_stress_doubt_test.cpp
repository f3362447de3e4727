// Where active stress is too large beside the shear modulus for smoothed elements.
#include "sim/build/active_stress_doubt.hpp"

#include <gtest/gtest.h>

#include "fem/material/any_material.hpp"
#include "sim/build/build_model.hpp"
#include "tests/sim/support/scene.hpp"

namespace articular::sim::active_stress_doubt_test {

/// A block with fibres along a slanting axis, at rest at 0.8 of their best length.
Scenario block(TissueMaterial::Element element, double excitation) {
  fem::MuscleFibre::Constants fibre;
  fibre.optimal_stretch = 1.25;
  fem::BlemkerMuscle<>::Constants ground;
  ground.c10 = 2e3;
  ground.kappa = 1e6;
  Scenario s = scene(1e-3);
  s.bodies = {box_body("block", Body::Kind::Tissue, {0.01, 0.01, 0.02}, Vec3::Zero(), {2, 2, 4})};
  s.bodies[0].material = material_of(fem::BlemkerMuscle<>(fem::MuscleFibre(fibre), ground));
  s.bodies[0].material->element = element;
  s.bodies[0].material->fibres = Fibres{Vec3(1, 2, 2) / 3};
  Muscle muscle;
  muscle.name = "fibres";
  muscle.tissue = "block";
  muscle.excitation = {{0, 1e-3, 2e-3}, {0, excitation, 0}};
  s.muscles = {muscle};
  return s;
}

std::size_t num_doubts(TissueMaterial::Element element, double excitation) {
  std::size_t count = 0;
  for (const std::string& warning : build_model(block(element, excitation)).warnings)
    count += warning.find("too little force") != std::string::npos ? 1 : 0;
  return count;
}

// σ = a σ_max n f(n), with f = 1 − 4 (1 − n)² at n = 0.8 [Blemker 2005, eq. 7].
TEST(ActiveStressDoubt, BeginsAtFourTimesTheShearModulus) {
  const Model model = build_model(block(TissueMaterial::Element::Smoothed, 0));
  const double tension = 0.3e6 * 0.8 * (1 - 4 * 0.2 * 0.2);
  const double limit = 4 * model.tissues[0].shear_modulus / tension;
  ASSERT_LT(limit, 0.9);
  EXPECT_EQ(num_doubts(TissueMaterial::Element::Smoothed, 0.98 * limit), 0U);
  EXPECT_EQ(num_doubts(TissueMaterial::Element::Smoothed, 1.02 * limit), 1U);
  EXPECT_EQ(num_doubts(TissueMaterial::Element::Plain, 1), 0U);
}

}  // namespace articular::sim::active_stress_doubt_test
