#include "fem/simd/element_kernels.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

#include "fem/base/rotation_svd.hpp"
#include "fem/element/elasticity.hpp"
#include "fem/material/point_law.hpp"
#include "fem/mesh/tetrahedron.hpp"
#include "tests/fem/support/basic_laws.hpp"
#include "tests/fem/support/dense.hpp"
#include "tests/fem/support/instruction_sets.hpp"
#include "tests/fem/support/random_matrices.hpp"
#include "tests/fem/support/spectrum.hpp"

// The batched kernels against the formulas of the materials, one element at a time.
namespace articular::fem::element_kernels_test {

constexpr double kE = 2e4;  // [Pa]
constexpr double kNu = 0.4;
// Relative. The condition of a rotation, 1/(σ1 + σ2), is below 100 where F is random (the loop
// takes others out), and the stiffness has its square.
constexpr double kRoundOff = 1e-11;

/// One tetrahedron for each F, without common nodes.
struct Soup {
  Positions X, x;
  Tetrahedra tets;
};

/// @param X_e  shape at rest
Soup soup(const std::vector<Mat3>& Fs, const Mat34& X_e) {
  const auto count = static_cast<Eigen::Index>(Fs.size());
  Soup result{Positions(3, 4 * count), Positions(3, 4 * count), Tetrahedra(4, count)};
  for (Eigen::Index e = 0; e < count; ++e) {
    result.X.middleCols<4>(4 * e) = X_e;
    result.x.middleCols<4>(4 * e) = Fs[static_cast<std::size_t>(e)] * X_e;
    for (int a = 0; a < 4; ++a) result.tets(a, e) = static_cast<int>(4 * e) + a;
  }
  return result;
}

/// Its inverse of edges is exact, so that F comes back without an error.
Mat34 unit_tetrahedron() {
  Mat34 X = Mat34::Zero();
  X.rightCols<3>().setIdentity();
  return X;
}

/// Without F whose rotation is badly determined.
std::vector<Mat3> random_gradients(int count, double scale, double spread) {
  Random random;
  std::vector<Mat3> result;
  while (static_cast<int>(result.size()) < count) {
    const Mat3 F = scale * random.rotation() * (Mat3::Identity() + spread * random.matrix3());
    const Vec3 sigma = rotation_svd(F).sigma;
    if (sigma[1] + sigma[2] > 0.02 * sigma[0]) result.push_back(F);
  }
  return result;
}

std::vector<Mat3> hard_gradients() {
  Random random;
  std::vector<Mat3> result;
  for (const Vec3& sigma :
       {Vec3(1, 1, 1), Vec3(1, 1, -1), Vec3(1, 1, 0), Vec3(1, 0, 0), Vec3(0, 0, 0), Vec3(1, -1, -1),
        Vec3(-1, -1, -1), Vec3(3, 2, -2), Vec3(2, 1e-9, 0), Vec3(1, 1e-5, -1e-5),
        Vec3(1e-7, 1e-7, 1e-7), Vec3(1e-4, 1e-4, -1e-5), Vec3(1e3, 1, 1e-3), Vec3(1e4, 1e4, 1e4),
        Vec3(1e20, 1e19, 1e18), Vec3(1e3, 1e-3, 1e-3), Vec3(0.5, 0.02, -0.019)}) {
    result.push_back(sigma.asDiagonal());
    result.push_back(random.rotation() * sigma.asDiagonal() * random.rotation());
  }
  for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 1, 1)}) {
    const Vec3 n = axis.normalized();  // half a turn
    result.push_back(2 * n * n.transpose() - Mat3::Identity());
    result.push_back(1.3 * result.back());
  }
  return result;
}

constexpr const char* kCoupled = "CoupledNeoHookean";

/// Those that have kernels.
std::vector<BasicLaw> batched_laws() {
  std::vector<BasicLaw> laws = objective_laws();
  laws.push_back(
      {kCoupled, [](double E, double nu) -> AnyMaterial { return CoupledNeoHookean(E, nu); }});
  return laws;
}

class ElementKernelsTest : public testing::TestWithParam<BasicLaw> {
 protected:
  static AnyMaterial material() { return GetParam().make(kE, kNu); }
  static bool has_log() { return std::string(GetParam().name) == kCoupled; }
  /// Of the random ones those that the law has numbers for: with ln J a mirror image in place of
  /// what is inverted, and none whose J has lost digits.
  static std::vector<Mat3> gradients(int count, double scale, double spread) {
    if (!has_log()) return random_gradients(count, scale, spread);
    std::vector<Mat3> result;
    for (const Mat3& F : random_gradients(10 * count, scale, spread)) {
      const double J = F.determinant();
      if (std::abs(J) > 0.1 * F.colwise().norm().prod()) result.push_back(J > 0 ? F : Mat3(-F));
      if (static_cast<int>(result.size()) == count) break;
    }
    EXPECT_EQ(static_cast<int>(result.size()), count);
    return result;
  }
};
INSTANTIATE_TEST_SUITE_P(All, ElementKernelsTest, testing::ValuesIn(batched_laws()), name_of_law);

void expect_scalar_results(const Soup& soup, const AnyMaterial& material, InstructionSet set,
                           double tolerance) {
  const PointLaw law(material, {}, 0, 0);
  const Elasticity elasticity(soup.X, soup.tets, material, {}, {.instruction_set = set});
  Positions f = Positions::Zero(3, soup.x.cols()), f_both = f;
  elasticity.add_internal_force(soup.x, f);
  BlockMatrix K = elasticity.make_matrix(), K_projected = K, K_both = K;
  std::vector<int> blocks(static_cast<std::size_t>(soup.x.cols()));
  std::iota(blocks.begin(), blocks.end(), 0);
  const double scale = 0.25;
  elasticity.add_stiffness(soup.x, Tangent::Consistent, scale, K);
  elasticity.add_stiffness(soup.x, Tangent::Projected, scale, K_projected);
  elasticity.add_force_and_stiffness(soup.x, Tangent::Consistent, scale,
                                     elasticity.slots_in(K, blocks), f_both, K_both);
  double W = 0, W_size = 0;
  for (int e = 0; e < soup.tets.cols(); ++e) {
    const Mat34 X_e = soup.X.middleCols<4>(4 * e), x_e = soup.x.middleCols<4>(4 * e);
    const Mat3 inverse = edge_matrix(X_e).inverse();
    const double volume = elasticity.rest_volume()[static_cast<std::size_t>(e)];
    const Mat3 F = deformation_gradient(x_e, inverse);
    const Mat34 dN_dX = shape_gradients(inverse);
    const double gradient = dN_dX.norm();
    const double psi = law.energy_density(F);
    W += volume * psi;
    W_size += volume * (std::abs(psi) + kE * (1 + F.squaredNorm()));

    const Mat9 C = law.tangent(F, Tangent::Consistent);
    // Differences cancel where the stress is small, and where J is small beside the edges: the
    // scale is that of the terms.
    const double edges = F.colwise().norm().prod();
    const double stress = kE * (1 + F.norm() + (1 + edges) * F.squaredNorm());
    const Mat34 f_e = nodal_force(law.first_piola(F), dN_dX, volume);
    const double f_error = (f.middleCols<4>(4 * e) - f_e).norm();
    EXPECT_LE(f_error, tolerance * volume * stress * gradient) << "element " << e << ", F\n" << F;
    EXPECT_LE((f_both.middleCols<4>(4 * e) - f_e).norm(), tolerance * volume * stress * gradient);

    const double size = C.norm() + kE * edges * F.norm();
    const double K_scale = scale * volume * size * gradient * gradient;
    const Mat12 K_e = stiffness(C, dN_dX, scale * volume);
    const Mat12 K_projected_e = stiffness(positive_part(C), dN_dX, scale * volume);
    const auto difference = [&](const BlockMatrix& A, const Mat12& expected) {
      Mat12 actual;
      for (int a = 0; a < 4; ++a) {
        for (int b = 0; b < 4; ++b) {
          actual.block<3, 3>(3 * a, 3 * b) = A.block(A.slot(4 * e + a, 4 * e + b));
        }
      }
      return (actual - expected).norm();
    };
    EXPECT_LE(difference(K, K_e), tolerance * K_scale) << "element " << e << ", F\n" << F;
    EXPECT_LE(difference(K_both, K_e), tolerance * K_scale) << "element " << e << ", F\n" << F;
    EXPECT_LE(difference(K_projected, K_projected_e), tolerance * K_scale)
        << "projected, element " << e << ", F\n"
        << F;
  }
  EXPECT_NEAR(elasticity.energy(soup.x), W, tolerance * W_size);
}

TEST_P(ElementKernelsTest, RandomGradientsOfAnySizeAndNumber) {
  Mat34 X_e;  // volume 1e-14 m³
  X_e << 0, 4e-5, 1e-5, 0, 0, 0, 5e-5, 1e-5, 0, 1e-6, 0, 3e-5;
  for (const InstructionSet set : instruction_sets()) {
    for (const int count : {1, 2, 7, 8, 9, 63, 500}) {
      expect_scalar_results(soup(gradients(count, 1, 0.1), X_e), material(), set, kRoundOff);
      expect_scalar_results(soup(gradients(count, 1, 2), X_e), material(), set, kRoundOff);
      expect_scalar_results(soup(gradients(count, 30, 1), 1e5 * X_e), material(), set, kRoundOff);
    }
  }
}

TEST_P(ElementKernelsTest, InvertedDegenerateAndTurnedElements) {
  if (has_log()) GTEST_SKIP() << "no numbers where J <= 0";
  for (const InstructionSet set : instruction_sets()) {
    for (const Mat3& F : hard_gradients()) {
      // Each alone, so that every lane sees each of them, among ordinary elements.
      std::vector<Mat3> Fs = gradients(8, 1, 0.3);
      for (std::size_t lane = 0; lane < 8; ++lane) {
        std::vector<Mat3> mixed = Fs;
        mixed[lane] = F;
        SCOPED_TRACE(testing::Message() << "lane " << lane);
        expect_scalar_results(soup(mixed, unit_tetrahedron()), material(), set, kRoundOff);
      }
    }
  }
}

// ln J of an inverted element, or of a flat one: no force and no stiffness is a number, and the
// elements beside it keep theirs.
TEST_P(ElementKernelsTest, WithALogarithmAnElementWithoutVolumeHasNoNumbers) {
  if (!has_log()) GTEST_SKIP() << "defined for any F";
  for (const InstructionSet set : instruction_sets()) {
    for (const Mat3& F :
         {Mat3(Vec3(1, 1, -1).asDiagonal()), Mat3(Vec3(1.2, 0.7, 0).asDiagonal())}) {
      std::vector<Mat3> Fs = gradients(9, 1, 0.3);
      Fs[4] = F;
      const Soup s = soup(Fs, unit_tetrahedron());
      const Elasticity elasticity(s.X, s.tets, material(), {}, {.instruction_set = set});
      EXPECT_FALSE(std::isfinite(elasticity.energy(s.x)));
      Positions f = Positions::Zero(3, s.x.cols());
      elasticity.add_internal_force(s.x, f);
      EXPECT_FALSE((f.middleCols<4>(16).allFinite()));
      EXPECT_TRUE((f.leftCols<16>().allFinite() && f.rightCols<16>().allFinite()));
      for (const Tangent tangent : {Tangent::Consistent, Tangent::Projected}) {
        BlockMatrix K = elasticity.make_matrix();
        elasticity.add_stiffness(s.x, tangent, 1, K);
        const Eigen::MatrixXd A = dense(K);
        EXPECT_FALSE((A.block<12, 12>(48, 48).allFinite()));
        EXPECT_TRUE((A.block<48, 48>(0, 0).allFinite()));
      }
    }
  }
}

// Different sets round differently; each repeats its own bits.
TEST_P(ElementKernelsTest, SameBitsEveryTime) {
  const Soup s = soup(gradients(100, 1, 1), unit_tetrahedron());
  for (const InstructionSet set : instruction_sets()) {
    Positions f[2];
    for (Positions& force : f) {
      force = Positions::Zero(3, s.x.cols());
      Elasticity(s.X, s.tets, material(), {}, {.instruction_set = set})
          .add_internal_force(s.x, force);
    }
    EXPECT_EQ(f[0], f[1]);
  }
}

TEST_P(ElementKernelsTest, PositionsThatAreNotNumbersComeThrough) {
  Soup s = soup(gradients(9, 1, 0.1), unit_tetrahedron());
  s.x(1, 5) = std::numeric_limits<double>::quiet_NaN();
  for (const InstructionSet set : instruction_sets()) {
    const Elasticity elasticity(s.X, s.tets, material(), {}, {.instruction_set = set});
    for (const Tangent tangent : {Tangent::Consistent, Tangent::Projected}) {
      BlockMatrix K = elasticity.make_matrix();
      elasticity.add_stiffness(s.x, tangent, 1, K);
      const Eigen::MatrixXd A = dense(K);
      EXPECT_FALSE((A.block<12, 12>(12, 12).allFinite()));
      EXPECT_TRUE((A.block<12, 12>(0, 0).allFinite()));
      EXPECT_TRUE((A.block<12, 12>(24, 24).allFinite()));
    }
  }
}

}  // namespace articular::fem::element_kernels_test
