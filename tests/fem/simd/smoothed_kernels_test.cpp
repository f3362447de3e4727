#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "fem/element/smoothed_elasticity.hpp"
#include "fem/material/any_material.hpp"
#include "fem/mesh/rest_shape.hpp"
#include "fem/mesh/tetrahedron.hpp"
#include "tests/fem/support/batched_tangent.hpp"
#include "tests/fem/support/box_mesh.hpp"
#include "tests/fem/support/dense.hpp"
#include "tests/fem/support/instruction_sets.hpp"
#include "tests/fem/support/laws.hpp"
#include "tests/fem/support/random_matrices.hpp"

// The loops over eight domains or elements at a time against the formulas of
// smoothed_elasticity.hpp, one domain after the other, with the laws of the tests.
namespace articular::fem::smoothed_kernels_test {

constexpr double kActivation = 0.4;
constexpr double kScale = 0.3;        // of stiffnesses
const Vec3 kSize(0.02, 0.01, 0.005);  // [m]

/// A mesh, its laws and a state.
struct Problem {
  TetMesh mesh;
  std::vector<LawExample> laws;
  std::vector<int> law_of_element;
  Smoothing smoothing;
  Positions x;

  /// κ' [Pa], see SmoothedElasticity
  double own_bulk(const LawExample& law) const {
    return smoothing.active_bulk * kActivation * active_stress(law.material);
  }
};

SmoothedElasticity elasticity_of(const Problem& problem, InstructionSet set) {
  std::vector<AnyMaterial> materials;
  for (const LawExample& law : problem.laws) materials.push_back(law.material);
  return {problem.mesh.X,
          problem.mesh.tets,
          materials,
          problem.law_of_element,
          problem.smoothing,
          kFibre.replicate(1, problem.mesh.tets.cols()),
          set};
}

/// All that the assembly gives, with the sizes of the terms that were added: sums cancel.
struct Assembled {
  double W = 0, W_size = 0;
  Positions f;
  double f_size = 0;
  Eigen::MatrixXd K, K_projected, K_plain, K_plain_projected, K_compressible, G;
  double K_size = 0, G_size = 0;
  Eigen::VectorXd b;

  Assembled(Eigen::Index nodes, Eigen::Index pressures)
      : f(Positions::Zero(3, nodes)),
        K(Eigen::MatrixXd::Zero(3 * nodes, 3 * nodes)),
        K_projected(K),
        K_plain(K),
        K_plain_projected(K),
        K_compressible(K),
        G(Eigen::MatrixXd::Zero(3 * nodes, pressures)),
        b(Eigen::VectorXd::Zero(pressures)) {}

  /// V (share Ψ_d + p Θ), also of the plain matrix, where it is that of an element.
  /// @param projected  of the same
  void add_energy(double V, const Jet& part, const Mat9& projected, const std::vector<int>& nodes,
                  const std::vector<Vec3>& gradients) {
    W += V * part.value;
    W_size += V * std::abs(part.value);
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      f.col(nodes[a]) += V * part.gradient * gradients[a];
      f_size += V * (part.gradient * gradients[a]).norm();
    }
    add_stiffness(V, part.hessian, nodes, gradients, K);
    add_stiffness(V, projected, nodes, gradients, K_projected);
    for (const Vec3& g : gradients) K_size += kScale * V * part.hessian.norm() * g.squaredNorm();
  }

  static void add_stiffness(double V, const Mat9& C, const std::vector<int>& nodes,
                            const std::vector<Vec3>& gradients, Eigen::MatrixXd& sum) {
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      for (std::size_t b_node = 0; b_node < nodes.size(); ++b_node) {
        for (int j = 0; j < 3; ++j) {
          for (int l = 0; l < 3; ++l) {
            sum.block<3, 3>(3 * nodes[a], 3 * nodes[b_node]) +=
                kScale * V * gradients[a][j] * gradients[b_node][l] * C.block<3, 3>(3 * j, 3 * l);
          }
        }
      }
    }
  }
};

/// See batched_law_test.cpp for what it is.
Mat9 projected_tangent(const LawExample& law, double share, double pressure, const Mat3& F) {
  return batched_tangent(InstructionSet::Baseline, law.material, share, pressure, F, kActivation,
                         Tangent::Projected);
}

Jet scaled(double factor, const Jet& jet) {
  return {factor * jet.value, factor * jet.gradient, factor * jet.hessian};
}
Jet sum_of(const Jet& a, const Jet& b) {
  return {a.value + b.value, a.gradient + b.gradient, a.hessian + b.hessian};
}

/// Θ of all elements, and of all domains its mean.
struct Dilatations {
  Eigen::VectorXd of_element, of_domain;
};
Dilatations dilatations(const Problem& problem, const SmoothedElasticity& elasticity) {
  const EdgeDomains& domains = elasticity.domains();
  const Tetrahedra& tets = problem.mesh.tets;
  Dilatations theta{Eigen::VectorXd::Zero(tets.cols()), Eigen::VectorXd::Zero(domains.size())};
  for (int e = 0; e < static_cast<int>(tets.cols()); ++e) {
    const Mat3 inverse = edge_matrix(gather(problem.mesh.X, tets, e)).inverse();
    const LawExample& law = problem.laws[problem.law_of_element[e]];
    theta.of_element[e] =
        law.dilatation(deformation_gradient(gather(problem.x, tets, e), inverse)).value;
    for (int i = 0; i < 6; ++i) {
      const int k = domains.of_element[6 * e + i];
      theta.of_domain[k] +=
          elasticity.rest_volume()[e] / 6 / domains.volume[k] * theta.of_element[e];
    }
  }
  return theta;
}

Assembled point_by_point(const Problem& problem, const SmoothedElasticity& elasticity,
                         const Eigen::VectorXd& p) {
  const Positions& x = problem.x;
  const double share = problem.smoothing.plain_share;
  Assembled sum(x.cols(), elasticity.num_pressures());
  const EdgeDomains& domains = elasticity.domains();
  for (int k = 0; k < domains.size(); ++k) {
    std::size_t m = 0;
    while (domains.material_begin[m + 1] <= k) ++m;
    const auto begin = domains.node_begin[k], end = domains.node_begin[k + 1];
    const std::vector<int> nodes(domains.node.begin() + begin, domains.node.begin() + end);
    const std::vector<Vec3> gradients(domains.gradient.begin() + begin,
                                      domains.gradient.begin() + end);
    Mat3 F = Mat3::Zero();
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      F += (x.col(nodes[a]) - x.col(nodes[0])) * gradients[a].transpose();
    }
    const LawExample& law = problem.laws[m];
    const Jet part = scaled(1 - share, law.distortion(F, kActivation));
    sum.add_energy(domains.volume[k], part, projected_tangent(law, 1 - share, 0, F), nodes,
                   gradients);
  }
  const Tetrahedra& tets = problem.mesh.tets;
  const Dilatations thetas = dilatations(problem, elasticity);
  Eigen::MatrixXd slope_of_domain = Eigen::MatrixXd::Zero(3 * x.cols(), domains.size());
  Eigen::VectorXd own_of_domain = Eigen::VectorXd::Zero(domains.size());
  for (Eigen::Index e = 0; e < tets.cols(); ++e) {
    const LawExample& law = problem.laws[problem.law_of_element[e]];
    const double V = elasticity.rest_volume()[e];
    Mat34 X_e, x_e;
    std::vector<int> nodes;
    double pressure = 0;
    for (int a = 0; a < 4; ++a) {
      nodes.push_back(tets(a, e));
      X_e.col(a) = problem.mesh.X.col(tets(a, e));
      x_e.col(a) = x.col(tets(a, e));
      pressure += p[elasticity.nodal_pressure().of_corner()(a, e)] / 4;
    }
    const Mat34 dN_dX = shape_gradients(edge_matrix(X_e).inverse());
    std::vector<Vec3> gradients;
    for (const auto& g : dN_dX.colwise()) gradients.emplace_back(g);
    const Mat3 F = deformation_gradient(x_e, edge_matrix(X_e).inverse());
    const Jet theta = law.dilatation(F), distortion = law.distortion(F, kActivation);
    const double own = problem.own_bulk(law);
    double uneven = theta.value;
    for (int i = 0; i < 6; ++i) {
      const int k = domains.of_element[6 * static_cast<std::size_t>(e) + i];
      uneven -= thetas.of_domain[k] / 6;
      own_of_domain[k] = own;
      for (int a = 0; a < 4; ++a)
        slope_of_domain.block<3, 1>(3 * nodes[a], k) += V / 6 * theta.gradient * gradients[a];
    }
    const double p_e = pressure + own * uneven;
    const Vec9 theta_gradient = theta.gradient.reshaped();
    const Mat9 own_tangent = own * theta_gradient * theta_gradient.transpose();
    Jet part = scaled(p_e, theta);
    part.value -= own / 2 * uneven * theta.value;
    part.hessian += own_tangent;
    if (share > 0) part = sum_of(part, scaled(share, distortion));
    sum.add_energy(V, part, projected_tangent(law, share, p_e, F) + own_tangent, nodes, gradients);
    Assembled::add_stiffness(V, distortion.hessian, nodes, gradients, sum.K_plain);
    Assembled::add_stiffness(V, projected_tangent(law, 1, 0, F), nodes, gradients,
                             sum.K_plain_projected);
    const double kappa = std::min(law.bulk_modulus, 13.0 / 6 * law.shear_modulus);
    Assembled::add_stiffness(V, kappa * theta_gradient * theta_gradient.transpose(), nodes,
                             gradients, sum.K_compressible);
    for (int c = 0; c < 4; ++c) {
      const int pressure_c = elasticity.nodal_pressure().of_corner()(c, e);
      sum.b[pressure_c] += V / 4 * theta.value;
      for (int a = 0; a < 4; ++a) {
        sum.G.block<3, 1>(3 * nodes[a], pressure_c) += V / 4 * theta.gradient * gradients[a];
        sum.G_size += V / 4 * (theta.gradient * gradients[a]).norm();
      }
    }
  }
  for (int k = 0; k < domains.size(); ++k)
    sum.K -= kScale * own_of_domain[k] / domains.volume[k] * slope_of_domain.col(k) *
             slope_of_domain.col(k).transpose();
  return sum;
}

Eigen::MatrixXd dense(const PressureGradient& G) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(3 * G.num_nodes(), G.num_pressures());
  for (int i = 0; i < G.num_nodes(); ++i) {
    for (int s = G.row_begin()[i]; s < G.row_begin()[i + 1]; ++s) {
      result.block<3, 1>(3 * i, G.column()[s]) = G.block(s);
    }
  }
  return result;
}

void expect_point_by_point(const Problem& problem, InstructionSet set, double tolerance) {
  const SmoothedElasticity elasticity = elasticity_of(problem, set);
  const Positions& x = problem.x;
  // Of the size of the stresses, and different at each node.
  const Eigen::VectorXd p =
      0.3 * problem.laws[0].scale * Random().matrix<Eigen::VectorXd>(elasticity.num_pressures(), 1);
  const Assembled expected = point_by_point(problem, elasticity, p);
  EXPECT_NEAR(elasticity.energy(x, p, kActivation), expected.W, tolerance * expected.W_size);
  Positions f = Positions::Zero(3, x.cols());
  elasticity.add_internal_force(x, p, f, kActivation);
  EXPECT_LE((f - expected.f).norm(), tolerance * expected.f_size);

  const auto stiffness = [&](Tangent tangent) {
    BlockMatrix K = elasticity.make_matrix();
    elasticity.add_stiffness(x, p, tangent, kScale, K, kActivation);
    return dense(K);
  };
  const auto plain_stiffness = [&](Tangent tangent) {
    BlockMatrix K = elasticity.make_plain_matrix();
    elasticity.add_plain_stiffness(x, tangent, kScale, K, kActivation);
    return dense(K);
  };
  const Eigen::MatrixXd K = stiffness(Tangent::Consistent);
  EXPECT_LE((K - expected.K).norm(), tolerance * expected.K_size);
  EXPECT_LE((K - K.transpose()).norm(), 1e-15 * expected.K_size);
  EXPECT_LE((stiffness(Tangent::Projected) - expected.K_projected).norm(),
            tolerance * expected.K_size);
  EXPECT_LE((plain_stiffness(Tangent::Consistent) - expected.K_plain).norm(),
            tolerance * expected.K_size);
  EXPECT_LE((plain_stiffness(Tangent::Projected) - expected.K_plain_projected).norm(),
            tolerance * expected.K_size);

  BlockMatrix compressible = elasticity.make_plain_matrix();
  elasticity.add_compressible_stiffness(x, kScale, compressible);
  EXPECT_LE((dense(compressible) - expected.K_compressible).norm(), tolerance * expected.K_size);

  PressureGradient G = elasticity.make_pressure_gradient();
  elasticity.set_pressure_gradient(x, G);
  EXPECT_LE((dense(G) - expected.G).norm(), tolerance * expected.G_size);
  // A p = b; A is as badly conditioned as κ/μ is large.
  Eigen::VectorXd pressure, b;
  elasticity.pressure(x, pressure);
  elasticity.nodal_pressure().compliance().multiply(pressure, b);
  EXPECT_LE((b - expected.b).norm(), 100 * tolerance * expected.b.norm());
}

/// @param amplitude  of random motions, relative to the size of a cell
Problem random_problem(const std::array<int, 3>& cells, double amplitude,
                       const std::vector<LawExample>& laws) {
  Problem problem{.mesh = box_mesh({cells[0], cells[1], cells[2]}, kSize, 0.1),
                  .laws = laws,
                  .law_of_element = {},
                  .smoothing = {},
                  .x = {}};
  Random random;
  const Mat3 R = random.rotation();
  const double cell = kSize.z() / cells[2];
  problem.x =
      R * (problem.mesh.X + amplitude * cell * random.matrix<Positions>(3, problem.mesh.X.cols()));
  for (Eigen::Index e = 0; e < problem.mesh.tets.cols(); ++e) {
    problem.law_of_element.push_back(static_cast<int>(e / 5 % std::ssize(laws)));
  }
  return problem;
}

class SmoothedKernels : public testing::TestWithParam<LawExample> {};
INSTANTIATE_TEST_SUITE_P(Laws, SmoothedKernels, testing::ValuesIn(all_laws()),
                         [](const auto& info) { return info.param.name; });

// From one batch that is not full to chunks of many.
TEST_P(SmoothedKernels, PointByPointInMeshesOfAnySize) {
  for (const InstructionSet set : instruction_sets()) {
    for (const std::array<int, 3>& cells :
         {std::array{1, 1, 1}, std::array{2, 1, 1}, std::array{3, 2, 2}}) {
      expect_point_by_point(random_problem(cells, 0.1, {GetParam()}), set, 1e-11);
    }
  }
}

// Cross sections of fibres get half as wide again one way as the other, and ligaments go beyond
// their toe; then active stress falls with the stretch.
TEST_P(SmoothedKernels, LargeStrains) {
  const Mat3 Q = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitX(), kFibre).toRotationMatrix();
  for (const Vec3& along_axes : {Vec3(1.08, 1.25, 0.8), Vec3(1.7, 0.9, 0.8)}) {
    const Mat3 stretch = Q * along_axes.asDiagonal() * Q.transpose();
    for (const InstructionSet set : instruction_sets()) {
      Problem problem = random_problem({2, 2, 1}, 0.1, {GetParam()});
      problem.x = stretch * problem.mesh.X +
                  2e-4 * Random().matrix<Positions>(3, problem.mesh.X.cols());  // [m]
      expect_point_by_point(problem, set, 1e-11);
    }
  }
}

TEST_P(SmoothedKernels, SharesOfNoneAndOfAll) {
  for (const InstructionSet set : instruction_sets()) {
    for (const double share : {0.0, 1.0}) {
      Problem problem = random_problem({2, 1, 1}, 0.1, {GetParam()});
      problem.smoothing.plain_share = share;
      expect_point_by_point(problem, set, 1e-11);
    }
  }
}

// Each law with one behind it in the list and one before it: with vector loops and without.
TEST_P(SmoothedKernels, TwoMaterialsMixed) {
  const std::vector<LawExample> laws = all_laws();
  std::size_t k = 0;
  while (laws[k].name != GetParam().name) ++k;
  for (const InstructionSet set : instruction_sets()) {
    for (const std::size_t other : {(k + 1) % laws.size(), (k + laws.size() - 2) % laws.size()}) {
      expect_point_by_point(random_problem({2, 1, 1}, 0.1, {GetParam(), laws[other]}), set, 1e-11);
    }
  }
}

// Most laws are not defined for these; the others are, but the rotation of some is badly
// conditioned.
TEST_P(SmoothedKernels, InvertedElements) {
  for (const InstructionSet set : instruction_sets()) {
    const Problem problem = random_problem({3, 2, 2}, 2, {GetParam()});
    const SmoothedElasticity elasticity = elasticity_of(problem, set);
    EXPECT_LT(elasticity.volume_ratio(problem.x).minCoeff(), -0.5);
    if (GetParam().promise.inverted) {
      expect_point_by_point(problem, set, 1e-9);
      continue;
    }
    EXPECT_TRUE(std::isnan(elasticity.energy(problem.x)));
    const Eigen::VectorXd p = Eigen::VectorXd::Zero(elasticity.num_pressures());
    for (const Tangent tangent : {Tangent::Consistent, Tangent::Projected}) {
      BlockMatrix K = elasticity.make_matrix();
      elasticity.add_stiffness(problem.x, p, tangent, 1, K);
      EXPECT_FALSE(fem::dense(K).allFinite());
    }
  }
}

// Energy, force and stiffness are linear in how many fibres there are: what one more of them adds
// is always the same.
TEST(SmoothedKernelsOfFibres, EachFibreAddsTheSame) {
  for (const LawExample& law : all_laws()) {
    if (!law.fibred) continue;
    const Problem problem = random_problem({2, 1, 1}, 0.1, {law});
    Positions x = 1.05 * problem.x;  // taut
    for (const InstructionSet set : instruction_sets()) {
      double W[3];
      Positions f[3];
      Eigen::MatrixXd K[3];
      for (int i = 0; i < 3; ++i) {
        const Vec3 fibre = (i + 1.0) * kFibre;
        const SmoothedElasticity elasticity(problem.mesh.X, problem.mesh.tets, law.material, {},
                                            fibre.replicate(1, problem.mesh.tets.cols()), set);
        const Eigen::VectorXd p = Eigen::VectorXd::Zero(elasticity.num_pressures());
        W[i] = elasticity.energy(x, p, kActivation);
        f[i] = Positions::Zero(3, x.cols());
        elasticity.add_internal_force(x, p, f[i], kActivation);
        BlockMatrix matrix = elasticity.make_matrix();
        elasticity.add_stiffness(x, p, Tangent::Consistent, 1, matrix, kActivation);
        K[i] = dense(matrix);
      }
      EXPECT_GT(std::abs(W[2] - W[1]), 1e-6 * std::abs(W[1])) << law.name;
      EXPECT_GT((f[2] - f[1]).norm(), 1e-3 * f[1].norm()) << law.name;
      EXPECT_GT((K[2] - K[1]).norm(), 1e-3 * K[1].norm()) << law.name;
      EXPECT_NEAR(W[2] - W[1], W[1] - W[0], 1e-12 * std::abs(W[2])) << law.name;
      EXPECT_LE((f[2] - 2 * f[1] + f[0]).norm(), 1e-12 * f[2].norm()) << law.name;
      EXPECT_LE((K[2] - 2 * K[1] + K[0]).norm(), 1e-12 * K[2].norm()) << law.name;
    }
  }
}

TEST(SmoothedKernelsTwice, SameBitsEveryTime) {
  const Problem problem = random_problem({9, 8, 7}, 0.1, {all_laws()[1]});  // several chunks
  for (const InstructionSet set : instruction_sets()) {
    std::vector<double> K[2];
    for (std::vector<double>& values : K) {
      const SmoothedElasticity elasticity = elasticity_of(problem, set);
      Eigen::VectorXd p;
      elasticity.pressure(problem.x, p);
      BlockMatrix matrix = elasticity.make_matrix();
      elasticity.add_stiffness(problem.x, p, Tangent::Projected, 1, matrix);
      values.assign(matrix.values(), matrix.values() + 9 * matrix.num_nonzero_blocks());
    }
    EXPECT_EQ(K[0], K[1]);
  }
}

}  // namespace articular::fem::smoothed_kernels_test
