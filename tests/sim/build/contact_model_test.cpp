// How stiff contact is by default: what of a tissue's stiffness it goes by.
#include "sim/build/contact_model.hpp"

#include <gtest/gtest.h>

#include "sim/build/build_model.hpp"
#include "sim/model/tissue.hpp"
#include "tests/sim/support/contact_scene.hpp"

namespace articular::sim::contact_model_test {

constexpr double kYoung = 20e3;  // [Pa]

/// A block under a plate of bone, which gives way a millionth as much.
Model block_under_plate(double nu, bool is_static) {
  Scenario s = contact_scene(1e-3);
  if (is_static) s.analysis = Scenario::Analysis::Static;
  s.bodies = {box_body("block", Body::Kind::Tissue, Vec3::Constant(0.1), Vec3::Zero(), {4, 4, 4}),
              box_body("plate", Body::Kind::Fixed, {0.2, 0.2, 0.02}, {0, 0, 0.06}, {3, 3, 1})};
  s.bodies[0].material = neo_hookean(kYoung, nu);
  return build_model(s);
}

double stiffness(double nu, bool is_static) {
  return block_under_plate(nu, is_static).contacts[0].mean_stiffness;
}

double column(double nu) { return constrained_modulus(kYoung, nu); }
double punch(double nu) { return 2 * kYoung / (1 - nu * nu); }

TEST(ContactModel, ThePunchModulusIsThatOfAHalfSpace) {
  for (const double nu : {0.0, 0.3, 0.49, 0.4999}) {
    const Model model = block_under_plate(nu, false);
    EXPECT_NEAR(punch_modulus(model.tissues[0]) / punch(nu), 1, 1e-10) << nu;
  }
}

// Bone is softer than 1/0 by less than 1e-4 of the block.
TEST(ContactModel, StiffnessGoesByTheColumnOfACompressibleTissueAndByThePunchOtherwise) {
  const double base = stiffness(0.3, false) / column(0.3);
  for (const double nu : {0.0, 0.2, 0.4})
    EXPECT_NEAR(stiffness(nu, false) / (base * column(nu)), 1, 1e-4) << nu;
  for (const double nu : {0.42, 0.45, 0.49, 0.4999})
    EXPECT_NEAR(stiffness(nu, false) / (base * punch(nu)), 1, 1e-4) << nu;
}

TEST(ContactModel, StaticsAllowsTenTimesThePunch) {
  const double base = stiffness(0.3, true) / column(0.3);
  for (const double nu : {0.0, 0.45, 0.49})
    EXPECT_NEAR(stiffness(nu, true) / (base * column(nu)), 1, 1e-4) << nu;
  EXPECT_NEAR(stiffness(0.4999, true) / (10 * base * punch(0.4999)), 1, 1e-4);
}

// Whoever is a bit softer by Young's modulus is not the harder one for its bulk modulus.
TEST(ContactModel, ABulkModulusMakesNobodyTheHarderSide) {
  Scenario s = contact_scene(1e-3);
  s.bodies = {box_body("fine", Body::Kind::Tissue, Vec3::Constant(0.1), Vec3::Zero(), {8, 8, 8}),
              box_body("coarse", Body::Kind::Tissue, Vec3::Constant(0.1), {0, 0, 0.1}, {2, 2, 2})};
  s.bodies[0].material = neo_hookean(kYoung, 0.4999);
  s.bodies[1].material = neo_hookean(1.1 * kYoung, 0.3);
  EXPECT_FALSE(build_model(s).contacts[0].reversed);
}

}  // namespace articular::sim::contact_model_test
