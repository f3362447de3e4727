// Muscles that never pull.
#include "sim/build/muscle_doubts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "fem/material/any_material.hpp"
#include "sim/mesh/shapes.hpp"
#include "tests/sim/support/doubt.hpp"
#include "tests/sim/support/scene.hpp"
#include "tests/sim/support/temporary_folder.hpp"

namespace articular::sim::muscle_doubts_test {

/// A block of fibres that can pull with a stress [Pa], and one of tissue without.
Scenario fibres(double active_stress) {
  Scenario s = scene(1e-3);
  s.contact = false;
  Body block = box_body("block", Body::Kind::Tissue, {0.02, 0.02, 0.02});
  block.material = material_of(fem::TransverselyIsotropic<fem::VolumeChange>(
      1e4, 0, fem::ToeLinearFibre({.c3 = 1e3, .c4 = 10, .c5 = 1e5, .toe_end = 1.1}), 1e6,
      fem::ActiveFibre({.stress = active_stress, .force_length = {}})));
  block.material->fibres = Fibres{Vec3::UnitZ()};
  block.material->element = TissueMaterial::Element::Smoothed;  // plain ones would lock
  block.material->where = {"scene.toml", 3, 1};
  s.bodies = {block, box_body("pad", Body::Kind::Tissue, {0.02, 0.02, 0.02}, {0.1, 0, 0}),
              stand("floor")};
  return s;
}

Muscle of_fibres(const Curve& excitation) {
  Muscle muscle;
  muscle.name = "masseter";
  muscle.tissue = "block";
  muscle.excitation = excitation;
  muscle.where = {"scene.toml", 7, 1};
  return muscle;
}

Muscle line(const std::string& name, const Curve& excitation) {
  Muscle muscle;
  muscle.name = name;
  muscle.path = {anchor("block", {0, 0, 0.01}, 0.015), anchor("floor", {0, 1e-4 * name[0], 0.1})};
  muscle.max_force = 100;
  muscle.excitation = excitation;
  muscle.where = {"scene.toml", 9, 1};
  return muscle;
}

const Curve kNone, kSilent{{0}, {0}}, kPull{{0, 1}, {0, 1}};

TEST(MuscleDoubts, AreNoneOfFibresThatPull) {
  Scenario s = fibres(2e5);
  s.muscles = {of_fibres(kPull)};
  EXPECT_EQ(doubt(s), "");
  EXPECT_EQ(doubt(fibres(0)), "");
}

// At n = (1/λ − r)/(1 − r) of its optimum fibre gives 9 (n − 0.4)² below 0.6.
TEST(MuscleDoubts, AreOfFibresThatCannotPullAsTheyAreDrawn) {
  for (const auto& [optimal, tendon, words] :
       {std::tuple(1.09, 0.46, ""), std::tuple(1.8, 0.0, ""), std::tuple(92.0, 0.0, "only 0.0 %"),
        std::tuple(1.92, 0.0, "only 13.1 %"), std::tuple(1.2, 0.9, "only 0.0 %")}) {
    Scenario s = fibres(2e5);
    s.bodies[0].material = material_of(fem::BlemkerMuscle<>(
        fem::MuscleFibre({.optimal_stretch = optimal, .tendon_ratio = tendon}), {}));
    s.bodies[0].material->fibres = Fibres{Vec3::UnitZ()};
    s.bodies[0].material->element = TissueMaterial::Element::Smoothed;
    s.muscles = {of_fibres(kPull)};
    const std::string told = doubt(s);
    EXPECT_TRUE(says(told, words)) << optimal << " " << tendon;
    EXPECT_EQ(told.empty(), std::string_view(words).empty()) << optimal << " " << tendon;
  }
}

TEST(MuscleDoubts, AreOfAMuscleWhoseMaterialCannotPull) {
  Scenario s = fibres(0);
  s.muscles = {of_fibres(kPull)};
  EXPECT_TRUE(says(doubt(s), "scene.toml:7:1: muscle `masseter` never pulls"));
}

TEST(MuscleDoubts, AreOfFibresThatNoMuscleActivates) {
  Scenario s = fibres(2e5);
  EXPECT_TRUE(says(doubt(s), "scene.toml:3:1: the fibres of `block` can pull with 200 kPa"));
  s.muscles = {line("other", kPull)};
  EXPECT_TRUE(says(doubt(s), "can pull with 200 kPa and never do"));
}

TEST(MuscleDoubts, AreOfFibresWithoutExcitationUnlessItIsGivenAsNone) {
  Scenario s = fibres(2e5);
  s.muscles = {of_fibres(kNone), line("other", kPull)};
  EXPECT_TRUE(says(doubt(s), "scene.toml:7:1: muscle `masseter` has no `excitation`"));
  s.muscles = {of_fibres(kSilent)};
  EXPECT_EQ(doubt(s), "");
}

// Tied at the lower face to the floor and at the upper one to a bone.
TEST(MuscleDoubts, AreOfFibresAcrossTheLineBetweenTheEnds) {
  for (const auto& [degrees, doubted] :
       {std::pair(0, false), std::pair(40, false), std::pair(80, true), std::pair(90, true)}) {
    const double angle = degrees * std::numbers::pi / 180;
    Scenario s = fibres(2e5);
    s.bodies[0].geometry =
        box_body("block", Body::Kind::Tissue, {0.02, 0.02, 0.02}, {0, 0, 0}, {1, 1, 2}).geometry;
    s.bodies[0].material->fibres = Fibres{Vec3(std::sin(angle), 0, std::cos(angle))};
    s.bodies.push_back(stand("bone"));
    s.attachments = {attach("block", "floor", {-1, -1, -0.011}, {1, 1, -0.0099}),
                     attach("block", "bone", {-1, -1, 0.0099}, {1, 1, 0.011})};
    s.muscles = {of_fibres(kPull)};
    const std::string told = doubt(s);
    EXPECT_EQ(!told.empty(), doubted) << degrees;
    if (doubted) {
      EXPECT_TRUE(says(told, "at " + std::to_string(degrees) + " degrees"));
    }
    s.attachments.pop_back();  // no line to run along
    EXPECT_EQ(doubt(s), "") << degrees;
  }
}

/// A bar along z with an array of fibres along it: all as dense, or the upper ones half as dense.
std::filesystem::path bar_with_fibres(const TemporaryFolder& folder, bool even) {
  const MeshData bar = box_mesh({{0.02, 0.02, 0.02}, {2, 2, 4}});
  std::ostringstream text;
  text << "# vtk DataFile Version 3.0\nbar\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS "
       << bar.X.cols() << " double\n"
       << bar.X.transpose() << "\nCELLS " << bar.tets.cols() << " " << 5 * bar.tets.cols() << "\n";
  for (const auto& tet : bar.tets.colwise()) text << "4 " << tet.transpose() << "\n";
  text << "CELL_TYPES " << bar.tets.cols() << "\n";
  for (int e = 0; e < bar.tets.cols(); ++e) text << "10\n";
  text << "CELL_DATA " << bar.tets.cols() << "\nVECTORS fibres double\n";
  for (const auto& tet : bar.tets.colwise()) {
    const bool above = bar.X(2, Eigen::all)(tet).sum() > 0;
    text << "0 0 " << (above && !even ? 0.5 : 1.0) << "\n";
  }
  return folder.file("bar.vtk", text.str());
}

// Half of the fibres end in the middle, where nothing holds them: a quarter of what ends at both
// ends together is loose there, and more around it.
TEST(MuscleDoubts, AreOfAnArrayWhoseFibresBreakOff) {
  const TemporaryFolder folder;
  for (const bool even : {true, false}) {
    Scenario s = fibres(2e5);
    MeshFile file;
    file.path = bar_with_fibres(folder, even);
    file.unit = 1;
    s.bodies[0].geometry = file;
    s.bodies[0].material->fibres =
        Fibres{FibreArray{"fibres"}, Fibres::Density::Conserved, {"scene.toml", 4, 1}};
    s.bodies.push_back(stand("bone"));
    s.attachments = {attach("block", "floor", {-1, -1, -0.011}, {1, 1, -0.0099}),
                     attach("block", "bone", {-1, -1, 0.0099}, {1, 1, 0.011})};
    s.muscles = {of_fibres(kPull)};
    const std::string told = doubt(s);
    EXPECT_EQ(told.empty(), even) << told;
    if (!even) {
      EXPECT_TRUE(says(told, "scene.toml:4:1: the fibres of `block` are not conserved"));
      EXPECT_TRUE(
          says(told, "for each that ends where it is held, 0.33 end at nodes that nothing"));
    }
    s.bodies[0].material->fibres->density = Fibres::Density::Even;
    EXPECT_EQ(doubt(s), "");
  }
}

TEST(MuscleDoubts, AreOfActiveStressThatRelaxes) {
  for (const double stress : {0.0, 2e5}) {
    Scenario s = fibres(stress);
    if (stress > 0) s.muscles = {of_fibres(kPull)};
    s.bodies[0].material->relaxation = {{.weight = 0.5, .time = 1}, {.weight = 0.2, .time = 9}};
    const std::string told = doubt(s);
    EXPECT_EQ(told.empty(), stress == 0) << told;
    if (stress > 0) {
      EXPECT_TRUE(says(told, "takes 70 % of its fibres' active stress"));
    }
  }
}

// In a scene with one that pulls, others are silent on purpose: openers while closers bite.
TEST(MuscleDoubts, AreOfASubstanceThatHoldsItsFibresOrLosesItsVolume) {
  for (const auto& [shear, bulk, words] :
       {std::tuple(500.0, 1e7, ""), std::tuple(5e5, 1e7, "it will hardly shorten"),
        std::tuple(500.0, 1e4, "it will not keep its volume")}) {
    Scenario s = fibres(2e5);
    s.bodies[0].material = material_of(
        fem::BlemkerMuscle<>(fem::MuscleFibre({}), {.G1 = shear, .G2 = shear, .kappa = bulk}));
    s.bodies[0].material->fibres = Fibres{Vec3::UnitZ()};
    s.bodies[0].material->element = TissueMaterial::Element::Smoothed;
    s.muscles = {of_fibres(kPull)};
    const std::string told = doubt(s);
    EXPECT_TRUE(says(told, words)) << told;
    EXPECT_EQ(told.empty(), std::string_view(words).empty()) << told;
  }
}

TEST(MuscleDoubts, AreOfLinesOfWhichNoneIsExcited) {
  Scenario s = fibres(0);
  s.muscles = {line("closer", kNone), line("opener", kNone)};
  EXPECT_TRUE(says(doubt(s), "scene.toml:9:1: no muscle of the scene has an `excitation`"));
  s.muscles[1].excitation = kPull;
  EXPECT_EQ(doubt(s), "");
  s.muscles[1].excitation = kSilent;
  EXPECT_EQ(doubt(s), "");
}

}  // namespace articular::sim::muscle_doubts_test
