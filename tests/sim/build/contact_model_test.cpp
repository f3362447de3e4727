// How stiff contact is by default: what of a tissue's stiffness it goes by.
#include "sim/build/contact_model.hpp"

#include <gtest/gtest.h>

#include "fem/material/any_material.hpp"
#include "sim/build/build_model.hpp"
#include "sim/model/tissue.hpp"
#include "tests/sim/support/contact_scene.hpp"

namespace articular::sim::contact_model_test {

constexpr double kYoung = 20e3;  // [Pa]

/// A block under a plate of bone, which gives way a millionth as much.
Model block_under_plate(const TissueMaterial& material, bool is_static) {
  Scenario s = contact_scene(1e-3);
  if (is_static) s.analysis = Scenario::Analysis::Static;
  s.bodies = {box_body("block", Body::Kind::Tissue, Vec3::Constant(0.1), Vec3::Zero(), {4, 4, 4}),
              box_body("plate", Body::Kind::Fixed, {0.2, 0.2, 0.02}, {0, 0, 0.06}, {3, 3, 1})};
  s.bodies[0].material = material;
  return build_model(s);
}
Model block_under_plate(double nu, bool is_static) {
  return block_under_plate(neo_hookean(kYoung, nu), is_static);
}

double stiffness(double nu, bool is_static) {
  return block_under_plate(nu, is_static).contacts[0].mean_stiffness;
}

double column(double nu) { return constrained_modulus(kYoung, nu); }
double punch(double nu) { return 2 * kYoung / (1 - nu * nu); }

// Means need nodes between the creases of a surface. Without any, contact is as stiff all the same.
TEST(ContactModel, TissueWithoutNodesBetweenItsCreasesTouchesPointByPoint) {
  const auto contact = [](const Eigen::Vector3i& cells, bool is_static) {
    Scenario s = contact_scene(1e-3);
    if (is_static) s.analysis = Scenario::Analysis::Static;
    s.contact_response = Scenario::Response::Averaged;
    s.bodies = {box_body("block", Body::Kind::Tissue, Vec3::Constant(0.1), Vec3::Zero(), cells),
                box_body("plate", Body::Kind::Fixed, {0.2, 0.2, 0.02}, {0, 0, 0.06}, {8, 8, 1})};
    s.bodies[0].material = neo_hookean(kYoung, 0.3);
    return build_model(s).contacts[0];
  };
  EXPECT_FALSE(contact({1, 1, 1}, false).averaged);
  EXPECT_FALSE(contact({1, 1, 6}, false).averaged);
  EXPECT_TRUE(contact({3, 3, 3}, false).averaged);
  EXPECT_TRUE(contact({1, 1, 1}, true).averaged);  // statics has no other
  EXPECT_EQ(contact({1, 1, 1}, false).factor, contact({3, 3, 3}, false).factor);
}

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

// By its tension it presses on what it bends around, whatever its ground substance is. Bone gives
// way by some 1e-4 as much.
TEST(ContactModel, StiffnessOfMuscleGoesByItsActiveStressToo) {
  const auto model = [](double max_stress) {
    TissueMaterial material =
        material_of(fem::BlemkerMuscle<>(fem::MuscleFibre({.max_stress = max_stress}), {}));
    material.fibres = Fibres{.along = Vec3::UnitZ()};
    return block_under_plate(material, false);
  };
  const Model weak = model(1e5), strong = model(4e5);
  const double ground = punch_modulus(weak.tissues[0]);
  EXPECT_NEAR(strong.contacts[0].mean_stiffness / weak.contacts[0].mean_stiffness,
              (ground + 2.5 * 4e5) / (ground + 2.5 * 1e5), 1e-3);
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

ContactPair rough(const std::string& a, const std::string& b, double friction) {
  ContactPair pair{a, b, {}};
  pair.friction = friction;
  return pair;
}

// Two names before one, one before none, and of equal ones the later: as the format says.
TEST(ContactModel, OfEntriesThatFitAPairTheMoreExactAndThenTheLaterHolds) {
  Scenario s = contact_scene(1e-3);
  s.bodies = {box_body("floor", Body::Kind::Fixed, {1, 1, 0.1}),
              box_body("wall", Body::Kind::Fixed, {1, 1, 0.1}, {0, 0, 1})};
  for (int i = 0; i < 3; ++i) {
    s.bodies.push_back(box_body("cube " + std::to_string(i), Body::Kind::Rigid, Vec3::Constant(0.1),
                                {0, 0, 2.0 + i}));
    s.bodies.back().density = 1000;
  }
  s.contacts = {rough("cube 0", "cube 1", 0.1), rough("floor", "cube*", 0.2), rough("*", "*", 0.3),
                rough("cube *", "cube *", 0.4), rough("cube 2", "*", 0.5)};
  const Model model = build_model(s);
  const auto friction = [&](int a, int b) {
    return model.contacts[model.contacts.between(a, b).value()].law.friction;
  };
  EXPECT_EQ(friction(2, 3), 0.1);
  EXPECT_EQ(friction(0, 2), 0.2);
  EXPECT_EQ(friction(1, 2), 0.3);
  EXPECT_EQ(friction(4, 3), 0.5);
  EXPECT_EQ(friction(0, 4), 0.5);  // later than ("floor", "cube*")
  s.contacts.pop_back();
  const Model without = build_model(s);
  EXPECT_EQ(without.contacts[without.contacts.between(2, 4).value()].law.friction, 0.4);
  EXPECT_FALSE(model.contacts.between(0, 1));  // both are fixed
  EXPECT_EQ(model.contacts.size(), 9);
}

TEST(ContactModel, BodiesThatNoPatternFitsTouchNothing) {
  Scenario s = contact_scene(1e-3);
  s.bodies = {box_body("floor", Body::Kind::Fixed, {1, 1, 0.1}),
              box_body("ball", Body::Kind::Rigid, Vec3::Constant(0.1), {0, 0, 1}),
              box_body("cube", Body::Kind::Rigid, Vec3::Constant(0.1), {0, 0, 2})};
  for (std::size_t b : {1U, 2U}) s.bodies[b].density = 1000;
  s.contacts = {rough("cu*", "*", 0)};
  const Model model = build_model(s);
  EXPECT_TRUE(model.contacts.between(0, 2));
  EXPECT_TRUE(model.contacts.between(1, 2));
  EXPECT_FALSE(model.contacts.between(0, 1));
  s.contacts = {rough("cu*", "f*", 0)};
  EXPECT_FALSE(build_model(s).bodies[1].collider);
}

}  // namespace articular::sim::contact_model_test
