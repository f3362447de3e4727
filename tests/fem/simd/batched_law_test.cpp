#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/fem/support/batched_tangent.hpp"
#include "tests/fem/support/instruction_sets.hpp"
#include "tests/fem/support/laws.hpp"
#include "tests/fem/support/random_matrices.hpp"
#include "tests/fem/support/spectrum.hpp"

// What a solver relies on in the projected tangents of all laws: that of a law with fibres is a sum
// of its parts', and not the nearest.
namespace articular::fem::batched_law_test {

constexpr double kActivation = 0.7;
constexpr double kRounding = 1e-11;  // [-] by the size of the tangent

/// Takes away what changes the volume.
Mat9 constant_volume(const Mat3& F) {
  const Vec9 by_volume = Vec9(F.inverse().transpose().reshaped()).normalized();
  return Mat9::Identity() - by_volume * by_volume.transpose();
}

class BatchedLaws : public testing::TestWithParam<LawExample> {
 protected:
  Mat9 tangent(InstructionSet set, double pressure, const Mat3& F, Tangent tangent) const {
    return batched_tangent(set, GetParam().material, 1, pressure, F, kActivation, tangent);
  }
  /// Calls use(F, consistent, projected) from small to large strains, fibres slack and taut.
  template <class Use>
  void for_each_tangent(const Use& use) const {
    for (const InstructionSet set : instruction_sets())
      for (const double pressure : {0.0, 0.1 * GetParam().scale}) {
        Random random;
        for (const double size : {0.01, 0.1, 0.3, 0.6})
          for (int k = 0; k < 8; ++k) {
            const Mat3 F = random.rotation() * (Mat3::Identity() + size * random.matrix3());
            if (!bears(F)) continue;
            use(F, tangent(set, pressure, F, Tangent::Consistent),
                tangent(set, pressure, F, Tangent::Projected));
          }
      }
  }

 private:
  bool bears(const Mat3& F) const {
    return F.determinant() > 0.3 &&
           std::sqrt(eigenvalues(F.transpose() * F)[0]) > GetParam().promise.least_stretch;
  }
};
INSTANTIATE_TEST_SUITE_P(All, BatchedLaws, testing::ValuesIn(all_laws()),
                         [](const auto& info) { return info.param.name; });

TEST_P(BatchedLaws, ProjectedTangentIsPositiveSemidefinite) {
  for_each_tangent([](const Mat3&, const Mat9& consistent, const Mat9& projected) {
    EXPECT_GT(eigenvalues(projected)[0], -kRounding * consistent.norm());
  });
}

TEST_P(BatchedLaws, ProjectedTangentIsTheNearestWithoutFibres) {
  if (GetParam().fibred) GTEST_SKIP() << "a sum of projected parts";
  for_each_tangent([](const Mat3&, const Mat9& consistent, const Mat9& projected) {
    EXPECT_LT((projected - positive_part(consistent)).norm(), kRounding * consistent.norm());
  });
}

// The nearest to the ground and what its fibres' pull adds by the volume, and the fibres' own part.
TEST_P(BatchedLaws, ProjectedTangentOfALigamentIsTheSumOfItsParts) {
  if (!GetParam().fibre_part) GTEST_SKIP() << "of ligaments";
  for_each_tangent([](const Mat3& F, const Mat9& consistent, const Mat9& projected) {
    const FibrePart part = GetParam().fibre_part(F, kActivation);
    EXPECT_LT((projected - positive_part(consistent - part.hessian) - part.positive).norm(),
              kRounding * consistent.norm());
  });
}

// Nor softer, as long as the volume is kept: there, the parts of a fibre that are left out cancel.
// Nor much stiffer than the nearest one.
TEST_P(BatchedLaws, ProjectedTangentIsNowhereSofterAtConstantVolume) {
  for_each_tangent([](const Mat3& F, const Mat9& consistent, const Mat9& projected) {
    const Mat9 difference = constant_volume(F) * (projected - consistent) * constant_volume(F);
    EXPECT_GT(eigenvalues(difference)[0], -kRounding * consistent.norm()) << F;
    const double beyond = (projected - positive_part(consistent)).norm() / consistent.norm();
    EXPECT_LT(beyond, 0.5) << F;
  });
}

TEST_P(BatchedLaws, ProjectedTangentTendsToTheConsistentOneWithoutStrain) {
  Random random;
  const Mat3 direction = random.matrix3();
  std::vector<double> distances;
  for (const double size : {1e-3, 1e-4}) {
    const Mat3 F = (Mat3::Identity() + size * direction) * GetParam().promise.rest;
    const auto by_kernels = [&](Tangent tangent) {
      return batched_tangent(best_instruction_set(), GetParam().material, 1, 0, F, 0, tangent);
    };
    const Mat9 consistent = by_kernels(Tangent::Consistent);
    distances.push_back((by_kernels(Tangent::Projected) - consistent).norm() / consistent.norm());
  }
  EXPECT_LT(distances[1], 0.11 * distances[0] + kRounding);
}

}  // namespace articular::fem::batched_law_test
