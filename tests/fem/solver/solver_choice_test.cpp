#include "fem/solver/solver_choice.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/fem/support/clamped_box.hpp"
#include "tests/fem/support/smoothed_box.hpp"

namespace articular::fem::solver_choice_test {

SolverProblem tissue(int num_nodes, double nu) {
  return {.num_blocks = num_nodes, .num_nodes = num_nodes, .largest_nu = nu};
}

TEST(SolverChoice, FollowsTheSizeAndTheTissue) {
  EXPECT_EQ(choose_solver(tissue(20, 0.3)).kind, SolverKind::Cholesky);
  EXPECT_EQ(choose_solver(tissue(20'000, 0.45)).kind, SolverKind::Multigrid);
  EXPECT_EQ(choose_solver(tissue(1'000, 0.499)).kind, SolverKind::Cholesky);
  EXPECT_EQ(choose_solver(tissue(200'000, 0.499)).kind, SolverKind::Multigrid);
  SolverProblem bones = tissue(1'000, 0.45);
  bones.num_nodes = 0;
  EXPECT_EQ(choose_solver(bones).kind, SolverKind::ConjugateGradients);
}

// A pattern that changes makes set-ups dear: factors, then nothing to set up where steps are short.
TEST(SolverChoice, ContactAsksForLittleSetUp) {
  SolverProblem problem = tissue(1'500, 0.45);
  problem.in_time = problem.has_contact = true;
  problem.is_held = false;
  EXPECT_EQ(choose_solver(problem).kind, SolverKind::Cholesky);
  problem.has_pressure = true;
  EXPECT_EQ(choose_solver(problem).kind, SolverKind::SaddlePoint);
  problem.num_blocks = problem.num_nodes = 20'000;
  problem.elements_a_step = 10;
  EXPECT_EQ(choose_solver(problem).kind, SolverKind::ConjugateGradients);
  EXPECT_GT(choose_solver(problem).num_kept, 0);
  problem.elements_a_step = 100;
  EXPECT_EQ(choose_solver(problem).kind, SolverKind::Multigrid);
  problem.elements_a_step = 10;
  problem.in_time = false;
  EXPECT_EQ(choose_solver(problem).kind, SolverKind::Multigrid);
  // Contact may be hard to iterate on where mass does not help.
  problem.num_blocks = problem.num_nodes = 5'000;
  EXPECT_EQ(choose_solver(problem).kind, SolverKind::SaddlePoint);
  problem.in_time = true;
  EXPECT_EQ(choose_solver(problem).kind, SolverKind::ConjugateGradients);
  problem.elements_a_step = 100;
  EXPECT_EQ(choose_solver(problem).kind, SolverKind::SaddlePoint);
}

// Layers between bones that move, as in a knee: their factors grow little faster than they do.
TEST(SolverChoice, ThinTissueInContactBetweenBonesIsFactoredAtRest) {
  SolverProblem knee = tissue(34'000, 0.45);
  knee.has_contact = knee.has_pressure = true;
  knee.num_blocks += 4;  // bones
  knee.thickness = 4;
  EXPECT_EQ(choose_solver(knee).kind, SolverKind::SaddlePoint);
  knee.has_pressure = false;
  EXPECT_EQ(choose_solver(knee).kind, SolverKind::Cholesky);
  knee.thickness = 8;  // that of cubes grows with its square
  EXPECT_EQ(choose_solver(knee).kind, SolverKind::Multigrid);
  knee.thickness = 4;
  knee.num_blocks = 190'000;  // nor is there memory for it at any size
  EXPECT_EQ(choose_solver(knee).kind, SolverKind::Multigrid);
  knee.num_blocks = 34'004;
  knee.in_time = true;
  knee.elements_a_step = 100;
  EXPECT_EQ(choose_solver(knee).kind, SolverKind::Multigrid);
}

// Iterations that pass on by an element each are nothing for a slender body, however few its
// unknowns, but for steps in which waves get no farther.
TEST(SolverChoice, SlenderBodiesAreNotIteratedOnElementByElement) {
  for (const bool pressure : {false, true}) {
    SolverProblem beam = tissue(280, 0);
    beam.has_pressure = pressure;
    EXPECT_EQ(choose_solver(beam).kind, SolverKind::ConjugateGradients);
    beam.reach = 800;
    EXPECT_NE(choose_solver(beam).kind, SolverKind::ConjugateGradients);
    beam.in_time = true;
    beam.elements_a_step = 80;
    EXPECT_NE(choose_solver(beam).kind, SolverKind::ConjugateGradients);
    beam.elements_a_step = 4;
    EXPECT_EQ(choose_solver(beam).kind, SolverKind::ConjugateGradients);
  }
}

// Up to a few hundred blocks; beyond, multigrid.
TEST(SolverChoice, SlenderBodiesOfFewUnknownsAreFactored) {
  for (const bool pressure : {false, true}) {
    SolverProblem beam = tissue(400, 0.45);
    beam.has_pressure = pressure;
    beam.reach = 800;
    EXPECT_EQ(choose_solver(beam).kind, pressure ? SolverKind::SaddlePoint : SolverKind::Cholesky);
    beam.num_blocks = beam.num_nodes = 2'000;
    EXPECT_EQ(choose_solver(beam).kind, SolverKind::Multigrid);
  }
}

// Waves that get no farther than two elements in a step leave nothing to a coarse level.
TEST(SolverChoice, ShortStepsAreIteratedOnElementByElementWhateverTheSize) {
  SolverProblem plate = tissue(5'000, 0.45);
  plate.has_pressure = plate.in_time = true;
  plate.reach = 500;
  plate.elements_a_step = 2;
  EXPECT_EQ(choose_solver(plate).kind, SolverKind::ConjugateGradients);
  plate.elements_a_step = 8;
  EXPECT_EQ(choose_solver(plate).kind, SolverKind::Multigrid);
}

// Contact holds it all over. What a factor costs grows with the square of the blocks across.
TEST(SolverChoice, HeldTissueInContactIsFactoredWhereItIsSlenderOrNearlyIncompressible) {
  SolverProblem plate = tissue(2'000, 0.45);
  plate.has_pressure = plate.has_contact = true;
  plate.reach = 500;
  plate.along = 30;  // 67 blocks across
  EXPECT_EQ(choose_solver(plate).kind, SolverKind::ConjugateGradients);
  plate.has_pressure = false;
  EXPECT_EQ(choose_solver(plate).kind, SolverKind::ConjugateGradients);
  plate.along = 40;  // 50
  EXPECT_EQ(choose_solver(plate).kind, SolverKind::Cholesky);
  plate.has_pressure = true;
  EXPECT_EQ(choose_solver(plate).kind, SolverKind::ConjugateGradients);
  plate.along = 80;  // 25
  EXPECT_EQ(choose_solver(plate).kind, SolverKind::SaddlePoint);
  plate.along = 40;
  plate.largest_nu = 0.49;
  EXPECT_EQ(choose_solver(plate).kind, SolverKind::SaddlePoint);
  plate.along = 30;
  EXPECT_EQ(choose_solver(plate).kind, SolverKind::ConjugateGradients);
  plate.reach = 20;  // a cube
  EXPECT_EQ(choose_solver(plate).kind, SolverKind::SaddlePoint);
  plate.reach = 500;
  plate.has_pressure = false;
  EXPECT_EQ(choose_solver(plate).kind, SolverKind::Cholesky);
  plate.has_pressure = true;
  plate.largest_nu = 0.45;
  plate.num_nodes -= 10;  // bones
  EXPECT_EQ(choose_solver(plate).kind, SolverKind::SaddlePoint);
}

TEST(SolverChoice, WhatIsHeldNearbyIsIteratedOnElementByElement) {
  SolverProblem layer = tissue(3'000, 0.45);
  EXPECT_EQ(choose_solver(layer).kind, SolverKind::Multigrid);
  layer.reach = 3;
  EXPECT_EQ(choose_solver(layer).kind, SolverKind::ConjugateGradients);
  layer.has_contact = true;
  layer.reach = 12;
  EXPECT_EQ(choose_solver(layer).kind, SolverKind::ConjugateGradients);
  layer.largest_nu = 0.49;  // unless it is nearer, or mass helps
  EXPECT_EQ(choose_solver(layer).kind, SolverKind::Cholesky);
  layer.reach = 7;
  EXPECT_EQ(choose_solver(layer).kind, SolverKind::ConjugateGradients);
  layer.num_blocks = layer.num_nodes = 300;
  EXPECT_EQ(choose_solver(layer).kind, SolverKind::Cholesky);
  layer.num_blocks = layer.num_nodes = 3'000;
  layer.reach = 12;
  layer.in_time = true;
  layer.elements_a_step = 50;
  EXPECT_EQ(choose_solver(layer).kind, SolverKind::ConjugateGradients);
  layer.elements_a_step = 500;
  EXPECT_EQ(choose_solver(layer).kind, SolverKind::Cholesky);
  layer.in_time = false;
  layer.largest_nu = 0.45;
  layer.has_friction = true;
  EXPECT_EQ(choose_solver(layer).kind, SolverKind::Cholesky);
  layer.has_friction = false;
  layer.reach = 200;
  layer.along = 60;
  EXPECT_EQ(choose_solver(layer).kind, SolverKind::Cholesky);
  layer.reach = 12;
  layer.num_nodes -= 10;  // bones
  EXPECT_EQ(choose_solver(layer).kind, SolverKind::Cholesky);
}

TEST(SolverChoice, KeepsSolutionsInTimeOnlyAndSaysWhy) {
  for (const int size : {10, 1'000, 100'000}) {
    for (const bool pressure : {false, true}) {
      SolverProblem problem = tissue(size, 0.49);
      problem.has_pressure = pressure;
      EXPECT_EQ(choose_solver(problem).num_kept, 0);
      EXPECT_FALSE(std::string(choose_solver(problem).reason).empty());
      problem.in_time = true;
      const SolverChoice choice = choose_solver(problem);
      EXPECT_EQ(choice.num_kept > 0, choice.kind != SolverKind::Cholesky);
    }
  }
}

TEST(SolverChoice, MakesSolversThatCanDoIt) {
  const TetMesh mesh = box_mesh({3, 3, 3}, Vec3::Constant(0.1));
  SmoothedBox box = smoothed_box(mesh, 0.49);
  for (const SolverKind kind :
       {SolverKind::SaddlePoint, SolverKind::ConjugateGradients, SolverKind::Multigrid}) {
    for (const int kept : {0, 3}) {
      const auto solver = make_linear_solver({.kind = kind, .num_kept = kept}, 1e-8, 1000);
      Eigen::VectorXd x;
      ASSERT_EQ(solver->prepare_with_pressure(box.K, box.x, box.part()), FactorStatus::Ready);
      EXPECT_TRUE(solver->solve(box.b, x).converged);
    }
  }
  const ClampedBox plain = clamped_box(mesh, 0.3);
  const auto solver = make_linear_solver(choose_solver(tissue(48, 0.3)), 1e-8, 1000);
  Eigen::VectorXd x;
  ASSERT_EQ(solver->prepare(plain.K, plain.X), FactorStatus::Ready);
  EXPECT_TRUE(solver->solve(plain.b, x).converged);
}

}  // namespace articular::fem::solver_choice_test
