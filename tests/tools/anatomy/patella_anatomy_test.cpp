// `articular anatomy knee --patella`: a groove that goes on from the condyles, a patella in it.
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "tests/tools/anatomy/anatomy_checks.hpp"
#include "tools/anatomy/anatomy_knee.hpp"
#include "tools/anatomy/anatomy_patella.hpp"
#include "tools/anatomy/anatomy_solids.hpp"
#include "tools/anatomy/anatomy_trochlea.hpp"

namespace articular::anatomy::patella_anatomy_test {

const Anatomy& knee_with_patella() {
  static const Anatomy anatomy = knee_anatomy({}, {.patella = true});
  return anatomy;
}

TEST(Trochlea, GoesOnFromBothCondyles) {
  const double phi = kTrochleaEndDeg * kDegree;
  for (const double x : {15.5, 18.0, 23.0, 26.5}) {
    const CondylePlace place = condyle_place(medial_compartment(), trochlea_point(x, phi, 0));
    EXPECT_NEAR(place.distance, 0, 1e-9) << x;
    EXPECT_NEAR(place.phi, phi, 1e-9) << x;
  }
  for (const double x : {-18.5, -23.0, -26.5})
    EXPECT_NEAR(condyle_place(lateral_compartment(), trochlea_point(x, phi, 0)).distance, 0, 1e-9)
        << x;
}

TEST(Trochlea, HasNoStepAcross) {
  for (const double phi_deg : {-42.5, -60.0, -80.0, -100.0})
    for (double x = -26; x < 26; x += 0.5) {
      const double phi = phi_deg * kDegree, h = 0.01;
      const double left = trochlea_radius(x, phi) - trochlea_radius(x - h, phi);
      const double right = trochlea_radius(x + h, phi) - trochlea_radius(x, phi);
      EXPECT_LT(std::abs(left), 0.8 * h) << x;
      EXPECT_LT(std::abs(right - left), 0.15 * h * h * 1.5) << x;  // radii above 4 mm
    }
}

// The recorded knee, 31 mm above its joint line: the lateral ridge is 4.1 mm in front of the
// groove, the medial one 2.5; its angle is 155 degrees.
TEST(Trochlea, IsAsOpenAsTheRecordedOneAndHigherOnTheLateralSide) {
  const double phi = -80 * kDegree;
  const auto highest = [&](double from, double to) {
    std::pair<double, double> best{from, 0};
    for (double x = from; x <= to; x += 0.1)
      if (trochlea_radius(x, phi) > best.second) best = {x, trochlea_radius(x, phi)};
    return best;
  };
  const auto lateral = highest(-25, 0), medial = highest(0, 25);
  double groove_x = 0, groove = 1e3;
  for (double x = -10; x <= 10; x += 0.1)
    if (trochlea_radius(x, phi) < groove) groove = trochlea_radius(groove_x = x, phi);
  EXPECT_LT(std::abs(groove_x), 5);
  const double angle = std::atan2(groove_x - lateral.first, lateral.second - groove) +
                       std::atan2(medial.first - groove_x, medial.second - groove);
  EXPECT_NEAR(angle / kDegree, 155, 12);
  // Forward of the shaft's axis, not around the knee's: the axes of both sides lie apart.
  EXPECT_GT(-trochlea_point(lateral.first, phi, 0).y(), -trochlea_point(medial.first, phi, 0).y());
}

TEST(Trochlea, APlaceBesideItIsThatOfItsPoint) {
  for (const double x : {-20.0, -8.0, 0.0, 6.0, 20.0})
    for (const double phi_deg : {-95.0, -70.0, -45.0})
      for (const double depth : {-1.0, 0.0, 2.0}) {
        const Vec3 p = trochlea_point(x, phi_deg * kDegree, depth);
        const TrochleaPlace place = trochlea_place(p);
        EXPECT_NEAR(place.distance, -depth, 1e-9);
        EXPECT_LT(std::abs(place.u), 1);
        EXPECT_LT(std::abs(place.v), 1.2);
      }
}

class PatellaSize : public testing::TestWithParam<KneeResolution> {};
INSTANTIATE_TEST_SUITE_P(MillimetresAndLayers, PatellaSize,
                         testing::Values(KneeResolution{1.5, 3}, KneeResolution{2.5, 2},
                                         KneeResolution{4, 2}));

TEST_P(PatellaSize, CartilageIsSoundAsThickAsPublishedAndDoesNotOverlap) {
  const Mesh trochlea = trochlear_cartilage(2.54, GetParam()),
             patella = patellar_cartilage(2.76, GetParam());
  for (const auto& [mesh, mean] : {std::pair(&trochlea, 2.54), std::pair(&patella, 2.76)}) {
    EXPECT_GT(least_relative_volume(*mesh), 0.0015);
    const auto [least, largest] = dihedral_range_deg(*mesh);
    EXPECT_GT(least, 5);
    EXPECT_LT(largest, 168);
    EXPECT_EQ(unmatched_edges(boundary(mesh->tets)), 0);
    // Area of the faces that look at the other one.
    double area = 0;
    const Triangles skin = boundary(mesh->tets);
    for (const auto& face : skin.colwise()) {
      const Vec3 a = mesh->X_mm.col(face(0)), b = mesh->X_mm.col(face(1)),
                 c = mesh->X_mm.col(face(2));
      const Vec3 normal = (b - a).cross(c - a) / 2, middle = (a + b + c) / 3;
      const Vec3 out = mesh == &patella ? Vec3(0, 1, 0) : Vec3(0, middle.y(), middle.z() - 37);
      if (normal.normalized().dot(out.normalized()) > 0.5) area += normal.norm();
    }
    EXPECT_NEAR(volume_of(*mesh) / area, mean, 0.015 * mean);
  }
  const Triangles skin = boundary(trochlea.tets);
  SurfaceDistance distance(trochlea.X_mm, skin);
  double least = 1e3;
  for (const auto& node : patella.X_mm.colwise()) least = std::min(least, distance(node));
  EXPECT_GT(least, 0);
  EXPECT_LT(least, 0.5);
}

// The recorded patella: 41 x 44 mm, with its cartilage 25 mm thick; 13.5 cm³ of bone.
TEST(Patella, IsAsLargeAsTheRecordedOne) {
  const Mesh& bone = knee_with_patella().meshes.at("patella.vtp");
  EXPECT_EQ(unmatched_edges(bone.triangles), 0);
  EXPECT_NEAR(volume_and_center(bone).first, 13535, 0.15 * 13535);
  const Mesh& cartilage = knee_with_patella().meshes.at("patellar_cartilage.vtu");
  const Vec3 low = bone.X_mm.rowwise().minCoeff(), high = bone.X_mm.rowwise().maxCoeff();
  EXPECT_NEAR(high.x() - low.x(), 40.7, 2);
  EXPECT_NEAR(high.z() - low.z(), 44.4, 2);
  EXPECT_NEAR(cartilage.X_mm.row(1).maxCoeff() - low.y(), 25, 2);
}

// Nothing ties it, so half a millimetre will do where the trochlea meets the condyles.
TEST(Patella, CartilageLiesOnItsBone) {
  for (const auto& [cartilage, bone] :
       {std::pair("patellar_cartilage.vtu", "patella.vtp"),
        std::pair("trochlear_cartilage.vtu", "femur_with_trochlea.vtp")}) {
    SCOPED_TRACE(bone);
    const Mesh& surface = knee_with_patella().meshes.at(bone);
    EXPECT_EQ(unmatched_edges(surface.triangles), 0);
    SurfaceDistance distance(surface.X_mm, surface.triangles);
    const Mesh& mesh = knee_with_patella().meshes.at(cartilage);
    const Eigen::Index layer = mesh.X_mm.cols() / 3;  // two layers of elements
    for (Eigen::Index i = 0; i < mesh.X_mm.cols(); ++i) {
      const double above = distance(mesh.X_mm.col(i));
      if (i < layer) {
        EXPECT_LT(std::abs(above), 0.5) << mesh.X_mm.col(i).transpose();
      } else {
        EXPECT_GT(above, 0.2) << mesh.X_mm.col(i).transpose();
      }
    }
  }
}

TEST(Patella, IsMadeOnDemandAndLeavesTheKneeAsItIs) {
  const Anatomy without = knee_anatomy({});
  const Anatomy& with = knee_with_patella();
  EXPECT_EQ(without.meshes.count("patella.vtp"), 0U);
  EXPECT_EQ(with.meshes.size(), without.meshes.size() + 4);
  for (const auto& [name, mesh] : without.meshes) EXPECT_EQ(with.meshes.at(name).X_mm, mesh.X_mm);
}

}  // namespace articular::anatomy::patella_anatomy_test
