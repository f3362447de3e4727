#include "fem/element/dilatation_means.hpp"

#include <gtest/gtest.h>

#include "fem/element/smoothed_elasticity.hpp"
#include "fem/material/any_material.hpp"
#include "fem/mesh/rest_shape.hpp"
#include "tests/fem/support/box_mesh.hpp"
#include "tests/fem/support/random_matrices.hpp"

namespace articular::fem::dilatation_means_test {

class Box {
 public:
  const SmoothedElasticity& elasticity() const { return elasticity_; }
  const EdgeDomains& domains() const { return elasticity_.domains(); }
  const std::vector<double>& volume() const { return elasticity_.rest_volume(); }
  const DilatationMeans& means() const { return means_; }

  /// Σ_k Σ_e V_e/6 (Θ_e − Θ̄_k)², twice the energy over κ'.
  double variance(const Eigen::VectorXd& dilatation) const {
    const auto num_domains = static_cast<std::size_t>(domains().size());
    std::vector<std::vector<std::size_t>> members(num_domains);
    for (std::size_t i = 0; i < domains().of_element.size(); ++i)
      members[static_cast<std::size_t>(domains().of_element[i])].push_back(i / 6);
    double sum = 0;
    for (const std::vector<std::size_t>& around : members) {
      double whole = 0, mean = 0;
      for (const std::size_t e : around) {
        whole += volume()[e];
        mean += volume()[e] * dilatation[static_cast<Eigen::Index>(e)];
      }
      for (const std::size_t e : around) {
        const double difference = dilatation[static_cast<Eigen::Index>(e)] - mean / whole;
        sum += volume()[e] / 6 * difference * difference;
      }
    }
    return sum;
  }

 private:
  TetMesh mesh_ = box_mesh({3, 2, 2}, Vec3(0.04, 0.02, 0.03), 0.15);
  SmoothedElasticity elasticity_{mesh_.X, mesh_.tets, AnyMaterial{NeoHookean(1e4, 0.4)}};
  DilatationMeans means_{mesh_.tets, elasticity_.domains(), elasticity_.make_matrix()};
};

TEST(DilatationMeans, LeaveNothingWhereAllElementsGrowAlike) {
  const Box box;
  Eigen::VectorXd dilatation = Eigen::VectorXd::Constant(box.elasticity().num_elements(), 0.3);
  box.means().subtract(box.domains(), box.volume(), dilatation);
  EXPECT_LT(dilatation.cwiseAbs().maxCoeff(), 1e-15);
}

// The energy is a square: its derivative times the dilatation is twice the energy, and that of two
// is symmetric.
TEST(DilatationMeans, WhatIsLeftIsTheDerivativeOfTheEnergy) {
  const Box box;
  const auto num = static_cast<Eigen::Index>(box.volume().size());
  const auto V = Eigen::Map<const Eigen::VectorXd>(box.volume().data(), num);
  Random random;
  const Eigen::VectorXd a = random.matrix<Eigen::VectorXd>(num, 1),
                        b = random.matrix<Eigen::VectorXd>(num, 1);
  Eigen::VectorXd of_a = a;
  box.means().subtract(box.domains(), box.volume(), of_a);
  const double by_b = 0.25 * (box.variance(a + b) - box.variance(a - b));
  EXPECT_NEAR(V.cwiseProduct(of_a).dot(b), by_b, 1e-12 * box.variance(a));
  EXPECT_NEAR(V.cwiseProduct(of_a).dot(a), box.variance(a), 1e-12 * box.variance(a));
}

// Of dilatations that are linear in the displacement.
TEST(DilatationMeans, TheirStiffnessIsWhatTheVarianceLacksToTheSquare) {
  constexpr double kFactor = 7;
  const Box box;
  const Tetrahedra& tets = box.elasticity().tets();
  Random random;
  std::vector<Mat34> slope;
  for (Eigen::Index e = 0; e < tets.cols(); ++e) slope.push_back(random.matrix<Mat34>(3, 4));
  BlockMatrix K = box.elasticity().make_matrix();
  box.means().subtract_stiffness(box.domains(), slope, std::vector{kFactor}, K);
  const auto u = random.matrix<Positions>(3, box.elasticity().num_nodes());
  Eigen::VectorXd dilatation(tets.cols()), product;
  double square = 0;
  for (Eigen::Index e = 0; e < tets.cols(); ++e) {
    const double volume = box.volume()[static_cast<std::size_t>(e)];
    const double change = slope[static_cast<std::size_t>(e)].cwiseProduct(gather(u, tets, e)).sum();
    dilatation[e] = change / volume;
    square += change * change / volume;
  }
  K.multiply(u.reshaped(), product);
  EXPECT_NEAR(u.reshaped().dot(product), kFactor * (box.variance(dilatation) - square),
              1e-11 * kFactor * square);
}

}  // namespace articular::fem::dilatation_means_test
