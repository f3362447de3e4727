// Masseter, temporalis and both pterygoids as bodies: `articular anatomy mandible --muscles`.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <memory>
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

FibreBody shape_named(const std::string& name) {
  const std::vector<FibreBody> shapes = muscle_shapes();
  return *std::find_if(shapes.begin(), shapes.end(),
                       [&](const FibreBody& shape) { return shape.name == name; });
}

Vec3 mean_fibre(const Mesh& mesh) { return mesh.fibres.rowwise().mean().normalized(); }

TEST(MuscleBodies, ShippedFilesAreWhatTheProgramMakes) {
  Anatomy anatomy;
  add_muscle_bodies(kSize, anatomy);
  EXPECT_EQ(anatomy.meshes.size(), 16U);
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
  for (const FibreBody& shape : muscle_shapes()) {
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
  for (const FibreBody& shape : muscle_shapes()) {
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

// As muscles.toml ties them, to the surfaces that touch. These are facets: one too coarse, or cut
// too short, leaves nodes of an end loose; and one that reaches beyond its bone holds others.
TEST_P(MuscleSize, WhatScenariosTieIsTheEnds) {
  static const Anatomy anatomy = [] {
    Anatomy made = mandible_anatomy(1.2);
    add_muscle_bodies(kSize, made);
    return made;
  }();
  using Surfaces = std::vector<std::unique_ptr<SurfaceDistance>>;
  const auto surfaces = [&](std::initializer_list<const char*> names) {
    Surfaces all;
    for (const std::string name : names) {
      const Mesh& sheet = anatomy.meshes.at(name + "_left.vtp");
      all.push_back(std::make_unique<SurfaceDistance>(sheet.X_mm, sheet.triangles));
    }
    return all;
  };
  const auto within = [](const Mesh& mesh, const Surfaces& all, double distance, double above) {
    std::vector<int> nodes;
    for (int i = 0; i < mesh.X_mm.cols(); ++i)
      if (mesh.X_mm(2, i) > above && std::any_of(all.begin(), all.end(), [&](const auto& surface) {
            return std::abs((*surface)(mesh.X_mm.col(i))) <= distance;
          }))
        nodes.push_back(i);
    return nodes;
  };
  const Surfaces of_skull = surfaces({"fossa", "temporal", "pterygoid"}),
                 of_mandible = surfaces({"condyle", "ramus"});
  for (const FibreBody& shape : muscle_shapes()) {
    SCOPED_TRACE(shape.name);
    const Mesh mesh = muscle_mesh(shape, GetParam());
    const FibreEnds ends = fibre_body_ends(shape, GetParam());
    const double to_skull = shape.name == "deep_masseter" ? 1.4 : 1;
    const double above = shape.name == "temporalis" ? 105 : 0;  // not to the eminence as well
    EXPECT_EQ(within(mesh, of_skull, to_skull, above), ends.origin);
    // A box ties the lateral pterygoid: no such surface covers the neck.
    if (shape.name != "lateral_pterygoid") {
      EXPECT_EQ(within(mesh, of_mandible, 1, 0), ends.insertion);
    }
  }
}

TEST_P(MuscleSize, MusclesDoNotOverlap) {
  const std::vector<FibreBody> shapes = muscle_shapes();
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
// temporalis has to fit between coronoid, zygomatic arch and skull, and has 0.6 of that. The
// lateral pterygoid: 66.9 N / 40 N/cm² times the 23 mm of its fibres (VE-PT).
TEST(MuscleBodies, VolumeIsThatOfTheFibres) {
  const std::map<std::string, std::pair<double, double>> wanted_cm3 = {
      {"superficial_masseter", {12.8, 0.05}},
      {"deep_masseter", {4.47, 0.06}},
      {"temporalis", {18, 0.05}},
      {"medial_pterygoid", {7.0, 0.05}},
      {"lateral_pterygoid", {3.85, 0.03}}};
  for (const FibreBody& shape : muscle_shapes()) {
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
      {"superficial_masseter", {"lsm"}},
      {"deep_masseter", {"ldm"}},
      {"temporalis", {"lat", "lmt", "lpt"}},
      {"medial_pterygoid", {"lmp"}},
      {"lateral_pterygoid", {"lip"}}};
  const std::vector<MuscleRow> rows = mandible_muscles();
  for (const FibreBody& shape : muscle_shapes()) {
    Vec3 line = Vec3::Zero();
    for (const MuscleRow& row : rows)
      if (std::count(lines.at(shape.name).begin(), lines.at(shape.name).end(), row.id) > 0)
        line += row.max_force * (row.lower - row.upper).normalized();
    const double cosine = mean_fibre(muscle_mesh(shape, kSize)).dot(line.normalized());
    EXPECT_GT(cosine, std::cos(20 * kDegree)) << shape.name;
  }
}

// Not only nodes keep clear: faces between them may cut into what is round, such as a bone's edge.
TEST_P(MuscleSize, BonesHaveNoPointInMuscles) {
  static const std::vector<Mesh> kBones = {mandible_surface(1.2), skull_surface(1.2)};
  for (const char* name : {"superficial_masseter", "deep_masseter", "lateral_pterygoid"}) {
    SCOPED_TRACE(name);
    const Mesh mesh = muscle_mesh(shape_named(name), GetParam());
    SurfaceDistance to(mesh.X_mm, boundary(mesh.tets));
    const Eigen::AlignedBox3d around(mesh.X_mm.rowwise().minCoeff(),
                                     mesh.X_mm.rowwise().maxCoeff());
    int near = 0;
    for (const Mesh& bone : kBones)
      for (const auto& point : bone.X_mm.colwise())
        if (around.contains(point)) {
          EXPECT_GT(to(point), 0) << point.transpose();
          ++near;
        }
    EXPECT_GT(near, 100);
  }
}

TEST_P(MuscleSize, LateralPterygoidLeavesTheDiscAlone) {
  const Mesh mesh = muscle_mesh(shape_named("lateral_pterygoid"), GetParam()), of_joint = disc(1.2);
  SurfaceDistance to_muscle(mesh.X_mm, boundary(mesh.tets)),
      to_disc(of_joint.X_mm, boundary(of_joint.tets));
  for (Eigen::Index i = 0; i < of_joint.X_mm.cols(); ++i)
    EXPECT_GT(to_muscle(of_joint.X_mm.col(i)), 1);
  for (Eigen::Index i = 0; i < mesh.X_mm.cols(); ++i) EXPECT_GT(to_disc(mesh.X_mm.col(i)), 1);
}

// Tetrahedron by tetrahedron: none of its fibres turns back on the way from the plate to the neck.
TEST(MuscleBodies, FibresOfLateralPterygoidGoFromOriginToInsertion) {
  const Mesh mesh = muscle_mesh(shape_named("lateral_pterygoid"), kSize);
  const FibreEnds ends = fibre_body_ends(shape_named("lateral_pterygoid"), kSize);
  const auto middle = [&](const std::vector<int>& nodes) {
    Vec3 sum = Vec3::Zero();
    for (const int node : nodes) sum += mesh.X_mm.col(node);
    return Vec3(sum / static_cast<double>(nodes.size()));
  };
  const Vec3 origin = middle(ends.origin), insertion = middle(ends.insertion);
  EXPECT_LT((origin - Vec3(28, 4, 70)).norm(), 4);  // the ends of the line
  EXPECT_LT((insertion - Vec3(48, 28, 75.5)).norm(), 2);
  for (Eigen::Index e = 0; e < mesh.fibres.cols(); ++e)
    EXPECT_GT(mesh.fibres.col(e).dot(insertion - origin), 0) << e;
}

// No surface that touches covers the neck, so scenarios tie what lies in a box in front of it.
TEST(MuscleBodies, ABoxHasTheInsertionOfLateralPterygoidAndNothingElse) {
  const Mesh mesh = muscle_mesh(shape_named("lateral_pterygoid"), kSize);
  const FibreEnds ends = fibre_body_ends(shape_named("lateral_pterygoid"), kSize);
  const Eigen::AlignedBox3d box(Vec3(40, 25.6, 72), Vec3(54, 33, 82));
  std::vector<int> inside;
  for (Eigen::Index i = 0; i < mesh.X_mm.cols(); ++i)
    if (box.contains(mesh.X_mm.col(i))) inside.push_back(static_cast<int>(i));
  EXPECT_EQ(inside, ends.insertion);
}

TEST(MuscleBodies, RightIsTheMirrorImageOfLeft) {
  Anatomy anatomy;
  add_muscle_bodies(5, anatomy);
  const Eigen::Vector3d mirror(-1, 1, 1);
  for (const FibreBody& shape : muscle_shapes()) {
    SCOPED_TRACE(shape.name);
    const Mesh &left = anatomy.meshes.at(shape.name + "_left.vtu"),
               &right = anatomy.meshes.at(shape.name + "_right.vtu");
    EXPECT_EQ(left.X_mm, mirror.asDiagonal() * right.X_mm);
    EXPECT_EQ(left.fibres, mirror.asDiagonal() * right.fibres);
    EXPECT_GT(least_relative_volume(right), 0);
  }
}

TEST(MuscleBodies, RefusesSizesOutsideItsRange) {
  const FibreBody shape = muscle_shapes().front();
  for (const double size : {2.5, 7.0, std::nan("")})
    EXPECT_THROW(muscle_mesh(shape, size), std::invalid_argument);
}

}  // namespace articular::anatomy::muscle_bodies_test
