// Where active stress is too large beside the shear modulus for smoothed elements.
#include "sim/build/active_stress_doubt.hpp"

#include <gtest/gtest.h>

#include "fem/material/any_material.hpp"
#include "sim/build/build_model.hpp"
#include "tests/sim/support/scene.hpp"

namespace articular::sim::active_stress_doubt_test {

const fem::AnyMaterial kCollagen = fem::TransverselyIsotropic<>(
    2e3, 0,
    fem::ToeLinearFibre({.c3 = 1e3, .c4 = 20, .c5 = 1e6, .toe_end = 1.1, .active_stress = 3e5}),
    1e6);

/// A block with fibres along a slanting axis.
Scenario block(const fem::AnyMaterial& law, TissueMaterial::Element element, double excitation) {
  Scenario s = scene(1e-3);
  s.bodies = {box_body("block", Body::Kind::Tissue, {0.01, 0.01, 0.02}, Vec3::Zero(), {2, 2, 4})};
  s.bodies[0].material = material_of(law);
  s.bodies[0].material->element = element;
  s.bodies[0].material->fibres = Fibres{Vec3(1, 2, 2) / 3};
  Muscle muscle;
  muscle.name = "fibres";
  muscle.tissue = "block";
  muscle.excitation = {{0, 1e-3, 2e-3}, {0, excitation, 0}};
  s.muscles = {muscle};
  return s;
}

std::size_t num_doubts(const fem::AnyMaterial& law, TissueMaterial::Element element,
                       double excitation) {
  std::size_t count = 0;
  for (const std::string& warning : build_model(block(law, element, excitation)).warnings)
    count += warning.find("too little force") != std::string::npos ? 1 : 0;
  return count;
}

TEST(ActiveStressDoubt, BeginsAtFourTimesTheShearModulus) {
  using enum TissueMaterial::Element;
  const Model model = build_model(block(kCollagen, Smoothed, 0));
  const double limit = 4 * model.tissues[0].shear_modulus / 3e5;
  ASSERT_LT(limit, 0.9);
  EXPECT_EQ(num_doubts(kCollagen, Smoothed, 0.98 * limit), 0U);
  EXPECT_EQ(num_doubts(kCollagen, Smoothed, 1.02 * limit), 1U);
  EXPECT_EQ(num_doubts(kCollagen, Plain, 1), 0U);
}

// Nothing has to balance them.
TEST(ActiveStressDoubt, IsNoneOfFibresThatFeelTheVolume) {
  const fem::AnyMaterial muscle = fem::BlemkerMuscle<>(fem::MuscleFibre({}), {});
  EXPECT_EQ(num_doubts(muscle, TissueMaterial::Element::Smoothed, 1), 0U);
}

}  // namespace articular::sim::active_stress_doubt_test
