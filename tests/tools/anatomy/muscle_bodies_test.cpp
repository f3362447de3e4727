// Masseter, temporalis and medial pterygoid as bodies: `articular anatomy mandible --muscles`.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <vector>

#include "sim/mesh/mesh_io.hpp"
#include "tests/tools/anatomy/anatomy_checks.hpp"
#include "tools/anatomy/anatomy_bones.hpp"
#include "tools/anatomy/anatomy_mandible.hpp"
#include "tools/anatomy/anatomy_muscles.hpp"

namespace articular::anatomy::muscle_bodies_test {

constexpr double kSize = 4;  // [mm], the default

std::vector<bool> among(const std::vector<int>& nodes, const Mesh& mesh) {
  std::vector<bool> is_among(static_cast<std::size_t>(mesh.X_mm.cols()), false);
  for (const int node : nodes) is_among[static_cast<std::size_t>(node)] = true;
  return is_among;
}

Vec3 mean_fibre(const Mesh& mesh) { return mesh.fibres.rowwise().mean().normalized(); }

TEST(MuscleBodies, ShippedFilesAreWhatTheProgramMakes) {
  Anatomy anatomy;
  add_muscle_bodies(kSize, anatomy);
  EXPECT_EQ(anatomy.meshes.size(), 12U);
  for (const auto& [name, mesh] : anatomy.meshes) {
    SCOPED_TRACE(name);
    const auto path =
        std::filesystem::path(ARTICULAR_SOURCE_DIR) / "scenarios/mandible/anatomy" / name;
    const sim::MeshData file = sim::read_mesh(path, 1e-3);
    ASSERT_EQ(file.X.cols(), mesh.X_mm.cols());
    EXPECT_LT((file.X * 1e3 - mesh.X_mm).cwiseAbs().maxCoeff(), 1e-6);
    if (mesh.tets.cols() == 0) {
      EXPECT_EQ(file.triangles, mesh.triangles);
      continue;
    }
    EXPECT_EQ(file.tets, mesh.tets);
    ASSERT_EQ(file.cell_vectors.size(), 1U);
    EXPECT_EQ(file.cell_vectors[0].first, "fibres");
    EXPECT_LT((file.cell_vectors[0].second - mesh.fibres).cwiseAbs().maxCoeff(), 1e-9);
  }
}

class MuscleSize : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Millimetres, MuscleSize, testing::Values(3.0, 4.0, 6.0));

TEST_P(MuscleSize, TetrahedraArePositiveAndFibresHaveDensityOneOnAverage) {
  for (const FibreBody& shape : closing_muscles()) {
    SCOPED_TRACE(shape.name);
    const Mesh mesh = muscle_mesh(shape, GetParam());
    EXPECT_GT(least_relative_volume(mesh), 0.002);
    EXPECT_EQ(unmatched_edges(boundary(mesh.tets)), 0);
    double fibres = 0;
    for (Eigen::Index e = 0; e < mesh.tets.cols(); ++e)
      fibres += volume_of(mesh, e) * mesh.fibres.col(e).norm();
    EXPECT_NEAR(fibres / volume_of(mesh), 1, 1e-12);
  }
}

// So a distance tells in a scenario which nodes are tied to a bone.
TEST_P(MuscleSize, EndsSitOnTheirBoneAndNothingElseIsNear) {
  const std::map<std::string, Distance> bones = {{"skull", skull_distance()},
                                                 {"mandible", mandible_distance()}};
  for (const FibreBody& shape : closing_muscles()) {
    SCOPED_TRACE(shape.name);
    const Mesh mesh = muscle_mesh(shape, GetParam());
    const FibreEnds ends = fibre_body_ends(shape, GetParam());
    EXPECT_GE(ends.origin.size(), 9U);
    EXPECT_GE(ends.insertion.size(), 9U);
    for (const auto& [end, nodes] :
         {std::pair(&shape.origin, &ends.origin), {&shape.insertion, &ends.insertion}}) {
      const std::vector<bool> sits = among(*nodes, mesh);
      for (Eigen::Index i = 0; i < mesh.X_mm.cols(); ++i) {
        const double distance = bones.at(end->bone)(mesh.X_mm.col(i));
        if (sits[static_cast<std::size_t>(i)]) {
          EXPECT_NEAR(distance, 0.5, 0.02);
        } else {
          EXPECT_GT(distance, kAttachedWithin) << mesh.X_mm.col(i).transpose();
        }
      }
    }
  }
}

TEST_P(MuscleSize, MusclesDoNotOverlap) {
  const std::vector<FibreBody> shapes = closing_muscles();
  std::vector<Mesh> meshes;
  meshes.reserve(shapes.size());
  for (const FibreBody& shape : shapes) meshes.push_back(muscle_mesh(shape, GetParam()));
  for (std::size_t a = 0; a < meshes.size(); ++a) {
    SurfaceDistance to(meshes[a].X_mm, boundary(meshes[a].tets));
    for (std::size_t b = 0; b < meshes.size(); ++b) {
      if (a == b) continue;
      SCOPED_TRACE(shapes[b].name + " in " + shapes[a].name);
      double nearest = 1e3;
      for (Eigen::Index i = 0; i < meshes[b].X_mm.cols(); ++i)
        nearest = std::min(nearest, to(meshes[b].X_mm.col(i)));
      EXPECT_GT(nearest, 0.3);
    }
  }
}

// Volume of fibres: peak force / 40 N/cm² times the part of the line that is no tendon (PECK). The
// temporalis has to fit between coronoid, zygomatic arch and skull, and has 0.6 of that.
TEST(MuscleBodies, VolumeIsThatOfTheFibres) {
  const std::map<std::string, std::pair<double, double>> wanted_cm3 = {
      {"masseter", {16.9, 0.10}}, {"temporalis", {18, 0.05}}, {"medial_pterygoid", {7.0, 0.05}}};
  for (const FibreBody& shape : closing_muscles()) {
    const auto [volume, tolerance] = wanted_cm3.at(shape.name);
    EXPECT_NEAR(volume_of(muscle_mesh(shape, kSize)) / 1e3, volume, tolerance * volume)
        << shape.name;
  }
}

// A muscle that is curved pulls at its end along its fibres there; over all of it they go along the
// line that it replaces. The temporalis is compared with the force-weighted mean of its three
// lines.
TEST(MuscleBodies, FibresRunAlongTheLines) {
  const std::map<std::string, std::vector<std::string>> lines = {
      {"masseter", {"lsm", "ldm"}},
      {"temporalis", {"lat", "lmt", "lpt"}},
      {"medial_pterygoid", {"lmp"}}};
  const std::vector<MuscleRow> rows = mandible_muscles();
  for (const FibreBody& shape : closing_muscles()) {
    Vec3 line = Vec3::Zero();
    for (const MuscleRow& row : rows)
      if (std::count(lines.at(shape.name).begin(), lines.at(shape.name).end(), row.id) > 0)
        line += row.max_force * (row.lower - row.upper).normalized();
    const double cosine = mean_fibre(muscle_mesh(shape, kSize)).dot(line.normalized());
    EXPECT_GT(cosine, std::cos(20 * kDegree)) << shape.name;
  }
}

TEST(MuscleBodies, RightIsTheMirrorImageOfLeft) {
  Anatomy anatomy;
  add_muscle_bodies(5, anatomy);
  const Eigen::Vector3d mirror(-1, 1, 1);
  for (const FibreBody& shape : closing_muscles()) {
    SCOPED_TRACE(shape.name);
    const Mesh &left = anatomy.meshes.at(shape.name + "_left.vtu"),
               &right = anatomy.meshes.at(shape.name + "_right.vtu");
    EXPECT_EQ(left.X_mm, mirror.asDiagonal() * right.X_mm);
    EXPECT_EQ(left.fibres, mirror.asDiagonal() * right.fibres);
    EXPECT_GT(least_relative_volume(right), 0);
  }
}

TEST(MuscleBodies, RefusesSizesOutsideItsRange) {
  const FibreBody shape = closing_muscles().front();
  for (const double size : {2.5, 7.0, std::nan("")})
    EXPECT_THROW(muscle_mesh(shape, size), std::invalid_argument);
}

}  // namespace articular::anatomy::muscle_bodies_test
