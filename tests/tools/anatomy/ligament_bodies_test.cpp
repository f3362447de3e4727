// ACL and superficial MCL as bodies: `articular anatomy knee --ligaments`.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "tests/tools/anatomy/anatomy_checks.hpp"
#include "tools/anatomy/anatomy_knee.hpp"
#include "tools/anatomy/anatomy_knee_bones.hpp"
#include "tools/anatomy/anatomy_ligaments.hpp"

namespace articular::anatomy::ligament_bodies_test {

const Compartment &kMedial = medial_compartment(), &kLateral = lateral_compartment();

Mesh made(const FibreBody& ligament, double h) {
  return ligament_mesh(ligament, kMedial, kLateral, h);
}

class LigamentSize : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Millimetres, LigamentSize, testing::Values(1.5, 2.5, 4.0));

TEST_P(LigamentSize, TetrahedraArePositiveAndTheSurfaceIsClosed) {
  for (const FibreBody& ligament : {anterior_cruciate(), medial_collateral()}) {
    SCOPED_TRACE(ligament.name);
    const Mesh mesh = made(ligament, GetParam());
    EXPECT_GT(least_relative_volume(mesh), 0.005);
    EXPECT_EQ(unmatched_edges(boundary(mesh.tets)), 0);
  }
}

// So a distance tells in a scenario which nodes are tied to a bone.
TEST_P(LigamentSize, EndsSitOnTheirBoneAndNothingElseIsNear) {
  for (const FibreBody& ligament : {anterior_cruciate(), medial_collateral()}) {
    SCOPED_TRACE(ligament.name);
    const Mesh mesh = made(ligament, GetParam());
    const FibreEnds ends = fibre_body_ends(ligament, GetParam());
    const std::pair<std::vector<int>, Distance> sides[] = {
        {ends.origin, femur_distance(kMedial, kLateral)},
        {ends.insertion, tibia_distance(kMedial, kLateral)}};
    for (const auto& [nodes, bone] : sides) {
      EXPECT_GE(nodes.size(), 15U);
      for (int i = 0; i < static_cast<int>(mesh.X_mm.cols()); ++i) {
        const double distance = bone(mesh.X_mm.col(i));
        if (std::binary_search(nodes.begin(), nodes.end(), i)) {
          EXPECT_NEAR(distance, 0.3, 0.01);
        } else {
          EXPECT_GT(distance, kTiedWithin + 0.05) << mesh.X_mm.col(i).transpose();
        }
      }
    }
  }
}

// Volume by length: of the ACL 38.7 mm² (9.9 x 3.9 mm), of the MCL a band of 10 mm that is 4.3 mm
// thick at its origin and 2.3 mm at its insertion. Sources: scenarios/SOURCES.md.
TEST(LigamentBodies, CrossSectionsAreThePublishedOnes) {
  const auto section = [](const FibreBody& ligament) {
    double length = 0;
    for (std::size_t k = 1; k < ligament.rows.size(); ++k)
      length += (ligament.rows[k].middle - ligament.rows[k - 1].middle).norm();
    return volume_of(made(ligament, 2.5)) / length;
  };
  EXPECT_NEAR(section(anterior_cruciate()), 38.7, 0.1 * 38.7);
  EXPECT_NEAR(section(medial_collateral()), 10 * 2.6, 0.2 * 26);
}

// Fibres run from end to end: along the mean of the lines that the body replaces.
TEST(LigamentBodies, FibresRunAlongTheLinesOfTheScenario) {
  const auto cosine = [](const FibreBody& ligament, const Vec3& line) {
    const Vec3 mean = made(ligament, 2.5).fibres.rowwise().mean();
    return mean.normalized().dot(line.normalized());
  };
  const Vec3 acl = Vec3(-0.5, -10, 1) - Vec3(-8, 7.6, 25.25);
  const Vec3 mcl = Vec3(20, -6, -60) - Vec3(37, 6.88, 30.45);
  EXPECT_GT(cosine(anterior_cruciate(), acl), std::cos(10 * kDegree));
  EXPECT_GT(cosine(medial_collateral(), mcl), std::cos(10 * kDegree));
}

TEST(LigamentBodies, RefusesSizesOutsideItsRange) {
  for (const double size : {0.8, 4.5, std::nan("")})
    EXPECT_THROW(made(anterior_cruciate(), size), std::invalid_argument);
}

TEST(LigamentBodies, TheyTouchNoCartilageAndNotEachOther) {
  std::vector<Mesh> others;
  for (const Compartment* c : {&kMedial, &kLateral}) {
    others.push_back(femoral_cartilage(*c, {}));
    others.push_back(tibial_cartilage(*c, {}));
  }
  others.push_back(made(medial_collateral(), 2.5));
  const Mesh acl = made(anterior_cruciate(), 2.5), mcl = others.back();
  for (const Mesh* ligament : {&acl, &mcl})
    for (std::size_t k = 0; k < others.size() - (ligament == &mcl ? 1 : 0); ++k) {
      SurfaceDistance to(others[k].X_mm, boundary(others[k].tets));
      double nearest = 1e3;
      for (Eigen::Index i = 0; i < ligament->X_mm.cols(); ++i)
        nearest = std::min(nearest, to(ligament->X_mm.col(i)));
      EXPECT_GT(nearest, 0.2) << k;
    }
}

}  // namespace articular::anatomy::ligament_bodies_test
