#include "fem/element/relaxation.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "fem/element/elasticity.hpp"
#include "fem/element/smoothed_elasticity.hpp"
#include "fem/material/any_material.hpp"
#include "fem/material/von_mises.hpp"
#include "tests/fem/support/box_mesh.hpp"
#include "tests/fem/support/central_difference.hpp"
#include "tests/fem/support/dense.hpp"
#include "tests/fem/support/random_matrices.hpp"

namespace articular::fem::relaxation_test {

constexpr double kIdentity = 1e-12;   // [-] relative, round-off
constexpr double kDerivative = 1e-7;  // [-] relative, best of a sweep of central differences
constexpr double kForever = std::numeric_limits<double>::infinity();
const Vec3 kSize(0.02, 0.01, 0.005);  // [m]
const std::vector<PronyTerm> kTerms{{0.154, 3.77}, {0.161, 148}, {0.3, 0.2}};

AnyMaterial law() { return MooneyRivlin<VolumeChange>(3e3, 1e3, 1e5); }

/// A mesh with relaxing elements of either kind, and the matrix that they add to.
struct Relaxing {
  TetMesh mesh;
  BlockMatrix K;
  Relaxation relaxation;
};

template <class Elements>
Relaxing relaxing() {
  const TetMesh mesh = box_mesh({2, 1, 1}, kSize, 0.1);
  const Elements elements(mesh.X, mesh.tets, law());
  BlockMatrix K = elements.make_matrix();
  Relaxation relaxation(kTerms, law(), distortion_points(mesh.X, elements), K);
  return {mesh, std::move(K), std::move(relaxation)};
}

class EachElement : public testing::TestWithParam<Relaxing (*)()> {};
INSTANTIATE_TEST_SUITE_P(Relaxation, EachElement,
                         testing::Values(&relaxing<Elasticity>, &relaxing<SmoothedElasticity>),
                         [](const auto& instance) {
                           return std::string(instance.param == &relaxing<Elasticity> ? "Plain"
                                                                                      : "Smoothed");
                         });

Positions deformed(const TetMesh& mesh, Random& random) {
  const Mat3 F = Mat3::Identity() + 0.2 * random.matrix3();
  return F * mesh.X + 0.02 * kSize.z() * random.matrix<Positions>(3, mesh.X.cols());
}

Eigen::VectorXd random_internal_variables(const Relaxation& relaxation, Random& random) {
  return 1e3 * random.matrix<Eigen::VectorXd>(relaxation.num_internal_variables(), 1);
}

Positions force(const Relaxation& relaxation, const Positions& x,
                const Eigen::VectorXd& internal_variables) {
  Positions f = Positions::Zero(3, x.cols());
  relaxation.add_force(x, internal_variables, 1, f);
  return f;
}

double remaining(double t) {
  double S = 1;
  for (const auto& [g, tau] : kTerms) S -= g * (1 - std::exp(-t / tau));
  return S;
}

// S/S0 = 1 − Σ g (1 − exp(−t/τ)) after a sudden strain: the internal variables, integrated with
// small steps, take that part of the law's force away. A deformation without change of volume has
// no pressure.
TEST_P(EachElement, ASuddenStrainRelaxesAsTheSeriesSays) {
  Relaxing body = GetParam()();
  const Mat3 F = Vec3(1.3, 1 / 1.3, 1).asDiagonal();
  const Positions x = F * body.mesh.X;
  Eigen::VectorXd S0;
  body.relaxation.stress(x, 0, S0);
  const Positions full = -force(body.relaxation, x, S0.replicate(3, 1)) / (0.154 + 0.161 + 0.3);
  Eigen::VectorXd internal_variables =
                      Eigen::VectorXd::Zero(body.relaxation.num_internal_variables()),
                  k1 = internal_variables, k2 = internal_variables;
  const double dt = 1e-3;
  for (int n = 0; n < 1000; ++n) {  // Heun
    body.relaxation.rate(S0, internal_variables, k1);
    const Eigen::VectorXd trial = internal_variables + dt * k1;
    body.relaxation.rate(S0, trial, k2);
    internal_variables += dt / 2 * (k1 + k2);
  }
  const Positions lost = force(body.relaxation, x, internal_variables);
  EXPECT_LT((lost + (1 - remaining(1)) * full).norm(), 1e-5 * full.norm());
  body.relaxation.settle(S0, internal_variables);
  EXPECT_LT((force(body.relaxation, x, internal_variables) + (1 - remaining(1e9)) * full).norm(),
            kIdentity * full.norm());
}

// Of a uniform state the law's own distortion force is what relaxes, whichever the elements.
TEST_P(EachElement, WhatRelaxesIsTheLawsDistortion) {
  Relaxing body = GetParam()();
  const Positions x = Vec3(1.3, 1 / 1.3, 1).asDiagonal() * body.mesh.X;
  Eigen::VectorXd S0, internal_variables;
  body.relaxation.stress(x, 0, S0);
  body.relaxation.settle(S0, internal_variables);
  const Elasticity elements(body.mesh.X, body.mesh.tets, law());
  Positions f = Positions::Zero(3, x.cols());
  elements.add_internal_force(x, f);
  EXPECT_LT((force(body.relaxation, x, internal_variables) + (1 - remaining(1e9)) * f).norm(),
            1e-11 * f.norm());
  Eigen::MatrixXd stress = elements.cauchy_stress(x);
  const Eigen::MatrixXd before = stress;
  body.relaxation.add_cauchy_stress(x, internal_variables, stress);
  EXPECT_LT((stress - remaining(1e9) * before).norm(), 1e-11 * before.norm());
}

TEST_P(EachElement, SettledForceIsTheGradientOfItsEnergy) {
  Relaxing body = GetParam()();
  Random random;
  const Positions x = deformed(body.mesh, random);
  const auto energy = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
    return Eigen::VectorXd::Constant(1, body.relaxation.settled_energy(v.reshaped(3, x.cols()), 0));
  };
  Eigen::VectorXd S0, internal_variables;
  body.relaxation.stress(x, 0, S0);
  body.relaxation.settle(S0, internal_variables);
  EXPECT_LT(derivative_error(energy, x.reshaped(),
                             force(body.relaxation, x, internal_variables).reshaped().transpose(),
                             0.1 * kSize.z()),
            kDerivative);
}

// With the internal variables that a step of length h ends with, and with internal variables at
// rest.
TEST_P(EachElement, StiffnessIsTheDerivativeOfTheForceAtTheEndOfAStep) {
  Random random;
  for (const double h : {0.01, 1.0, 1e3, kForever}) {
    Relaxing body = GetParam()();
    const Eigen::VectorXd before = random_internal_variables(body.relaxation, random);
    const Eigen::Index n = body.relaxation.num_internal_variables() / 3;
    const auto internal_variables_at = [&](const Positions& x) {
      Eigen::VectorXd S0, internal_variables = before;
      body.relaxation.stress(x, 0, S0);
      for (int i = 0; i < 3; ++i) {
        const double ratio = h / kTerms[static_cast<std::size_t>(i)].time;
        internal_variables.segment(n * i, n) =
            std::isinf(h) ? S0
                          : Eigen::VectorXd((before.segment(n * i, n) + ratio * S0) / (1 + ratio));
      }
      return internal_variables;
    };
    const auto f = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
      const Positions x = v.reshaped(3, body.mesh.X.cols());
      return force(body.relaxation, x, internal_variables_at(x)).reshaped();
    };
    const Positions x = deformed(body.mesh, random);
    Eigen::VectorXd S0;
    body.relaxation.stress(x, 0, S0);
    body.K.set_zero();
    body.relaxation.add_stiffness(x, 0, Tangent::Consistent, S0, internal_variables_at(x), h, 1,
                                  body.K);
    const Eigen::MatrixXd K = dense(body.K);
    EXPECT_LT(derivative_error(f, x.reshaped(), K, 0.1 * kSize.z()), kDerivative) << h;
    EXPECT_LT((K - K.transpose()).norm(), kIdentity * K.norm());
  }
}

// A body that turns as a whole carries its internal variables along; its force turns with it, and
// has neither a resultant nor a moment.
TEST_P(EachElement, ForceTurnsWithARotation) {
  Relaxing body = GetParam()();
  Random random;
  const Positions x = deformed(body.mesh, random);
  const Eigen::VectorXd internal_variables = random_internal_variables(body.relaxation, random);
  const Mat3 Q = random.rotation();
  const Positions turned = (Q * x).colwise() + Vec3(1, 2, 3);
  const Positions f = force(body.relaxation, x, internal_variables);
  EXPECT_LT((force(body.relaxation, turned, internal_variables) - Q * f).norm(), 1e-11 * f.norm());
  Eigen::VectorXd S0, S0_turned;
  body.relaxation.stress(x, 0, S0);
  body.relaxation.stress(turned, 0, S0_turned);
  EXPECT_LT((S0_turned - S0).norm(), 1e-10 * S0.norm());
  EXPECT_LT(f.rowwise().sum().norm(), kIdentity * f.norm());
  Vec3 moment = Vec3::Zero();
  for (Eigen::Index i = 0; i < x.cols(); ++i) moment += x.col(i).cross(f.col(i));
  EXPECT_LT(moment.norm(), kIdentity * f.norm() * kSize.norm());
}

// The work of a cycle of strain from rest to rest, with all stress gone after it: what the internal
// variables took. Positive, and for cycles much faster or slower than all relaxation times nothing.
TEST_P(EachElement, CyclesOfStrainLoseEnergy) {
  Relaxing body = GetParam()();
  Random random;
  const Mat3 A = 0.2 * random.matrix3(), B = 0.1 * random.matrix3();
  const auto x_at = [&](double phase) -> Positions {
    return (Mat3::Identity() + std::sin(2 * std::numbers::pi * phase) * A +
            (1 - std::cos(2 * std::numbers::pi * phase)) * B) *
           body.mesh.X;
  };
  const auto work = [&](double period) {
    constexpr int kSteps = 400;
    const double dt = period / kSteps;
    Eigen::VectorXd internal_variables =
                        Eigen::VectorXd::Zero(body.relaxation.num_internal_variables()),
                    S0, S0_next, decayed;
    Positions x = x_at(0), f = Positions::Zero(3, x.cols());
    body.relaxation.stress(x, 0, S0);
    double sum = 0;
    for (int n = 1; n <= kSteps; ++n) {
      const Positions next = x_at(static_cast<double>(n) / kSteps);
      body.relaxation.stress(next, 0, S0_next);
      const Eigen::Index size = S0.size();
      for (int i = 0; i < 3; ++i) {  // exact for a stress that is linear in a step
        const double tau = kTerms[static_cast<std::size_t>(i)].time, decay = std::exp(-dt / tau);
        auto L = internal_variables.segment(size * i, size);
        const Eigen::VectorXd lead = tau / dt * (S0_next - S0);
        L = S0_next - lead + decay * (L - S0 + lead);
      }
      const Positions f_next = force(body.relaxation, next, internal_variables);
      sum += 0.5 * (f + f_next).cwiseProduct(next - x).sum();
      x = next;
      f = f_next;
      S0 = S0_next;
    }
    return sum;
  };
  const double medium = work(2);
  EXPECT_GT(medium, 0);
  EXPECT_LT(std::abs(work(1e-6)), 1e-3 * medium);
  EXPECT_LT(std::abs(work(1e8)), 2e-2 * medium);
}

std::string message_of(const std::vector<PronyTerm>& terms) {
  const TetMesh mesh = box_mesh({1, 1, 1}, kSize);
  const Elasticity elements(mesh.X, mesh.tets, law());
  try {
    const Relaxation relaxation(terms, law(), distortion_points(mesh.X, elements),
                                elements.make_matrix());
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Relaxation, RefusesWhatIsNoRelaxation) {
  EXPECT_EQ(message_of({}), "");
  EXPECT_EQ(message_of({{0.154, 3.77}, {0.161, 148}, {0.682, 10988}}), "");  // a ligament
  EXPECT_NE(message_of({{0.5, 0}}).find("relaxation time is 0 s"), std::string::npos);
  EXPECT_NE(message_of({{-0.5, 1}}).find("weight of a relaxation time is -0.5"), std::string::npos);
  EXPECT_NE(message_of({{0.5, 1}, {0.5, 2}}).find("sum up to 1, must be below 1"),
            std::string::npos);
}

TEST(VonMises, OfUniaxialStressAndOfShear) {
  Eigen::MatrixXd stress(6, 3);
  stress << 5, 2, 0, 0, 2, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0, 0, 0, 0;
  EXPECT_LT((von_mises(stress) - Eigen::Vector3d(5, 0, 3 * std::sqrt(3.0))).norm(), kIdentity * 5);
}

}  // namespace articular::fem::relaxation_test
