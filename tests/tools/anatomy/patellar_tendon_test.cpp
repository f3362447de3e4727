// The patellar tendon as a body: `articular anatomy knee --patella --ligaments`.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "tests/tools/anatomy/anatomy_checks.hpp"
#include "tools/anatomy/anatomy_knee_bones.hpp"
#include "tools/anatomy/anatomy_patella.hpp"
#include "tools/anatomy/anatomy_patellar_tendon.hpp"

namespace articular::anatomy::patellar_tendon_test {

constexpr double kCartilage = 2.76;  // [mm]

Mesh tendon(double h) {
  return patellar_tendon_mesh(medial_compartment(), lateral_compartment(), kCartilage, h);
}

class PatellarTendonSize : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Millimetres, PatellarTendonSize, testing::Values(1.5, 2.5, 4.0));

TEST_P(PatellarTendonSize, TetrahedraArePositiveAndTheSurfaceIsClosed) {
  const Mesh mesh = tendon(GetParam());
  EXPECT_GT(least_relative_volume(mesh), 0.005);
  EXPECT_EQ(unmatched_edges(boundary(mesh.tets)), 0);
}

TEST_P(PatellarTendonSize, EndsSitOnTheirBoneAndNothingLiesInOne) {
  const Mesh mesh = tendon(GetParam());
  const FibreEnds ends = fibre_body_ends(patellar_tendon(), GetParam());
  const std::pair<std::vector<int>, Distance> sides[] = {
      {ends.origin, patella_distance(kCartilage)},
      {ends.insertion, tibia_distance(medial_compartment(), lateral_compartment())}};
  for (const auto& [nodes, bone] : sides) {
    EXPECT_GE(nodes.size(), 15U);
    for (int i = 0; i < static_cast<int>(mesh.X_mm.cols()); ++i) {
      const double distance = bone(mesh.X_mm.col(i));
      if (std::binary_search(nodes.begin(), nodes.end(), i)) {
        EXPECT_NEAR(distance, 0.3, 0.02);
      } else {
        EXPECT_GT(distance, 0.3) << mesh.X_mm.col(i).transpose();
      }
    }
  }
}

// Volume by length; published bands are 24 to 30 mm wide and 4 to 5 mm thick, with rounded edges.
// Sources: scenarios/SOURCES.md.
TEST(PatellarTendon, IsAsWideAndThickAsPublishedAndRunsAlongItsLines) {
  const Mesh mesh = tendon(2.5);
  double length = 0;
  const FibreBody body = patellar_tendon();
  for (std::size_t k = 1; k < body.rows.size(); ++k)
    length += (body.rows[k].middle - body.rows[k - 1].middle).norm();
  EXPECT_NEAR(volume_of(mesh) / length, 93, 10);  // [mm²]
  const Vec3 mean = mesh.fibres.rowwise().mean(), line = Vec3(1, -25, -32) - Vec3(0, -48, 18);
  EXPECT_GT(mean.normalized().dot(line.normalized()), std::cos(8 * kDegree));
}

TEST(PatellarTendon, RefusesSizesOutsideItsRange) {
  for (const double size : {0.8, 4.5, std::nan("")})
    EXPECT_THROW(tendon(size), std::invalid_argument);
}

}  // namespace articular::anatomy::patellar_tendon_test
