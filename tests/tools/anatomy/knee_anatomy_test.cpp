// `articular anatomy knee`: published dimensions, sound meshes, nothing overlaps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <vector>

#include "sim/mesh/mesh_io.hpp"
#include "tests/tools/anatomy/anatomy_checks.hpp"
#include "tools/anatomy/anatomy_grid.hpp"
#include "tools/anatomy/anatomy_knee.hpp"
#include "tools/anatomy/anatomy_meniscus.hpp"
#include "tools/anatomy/anatomy_solids.hpp"
#include "tools/anatomy/anatomy_spacing.hpp"

namespace articular::anatomy::knee_anatomy_test {

const Compartment* const kBoth[] = {&medial_compartment(), &lateral_compartment()};
std::string name_of(const Compartment& c) { return c.side > 0 ? "medial" : "lateral"; }

const Anatomy& default_knee() {
  static const Anatomy anatomy = knee_anatomy({}, {.patella = true, .ligaments = true});
  return anatomy;
}

const Mesh& part(const Anatomy& knee, const std::string& name, const Compartment& c) {
  return knee.meshes.at(name + "_" + name_of(c) + ".vtu");
}

/// Area of the boundary faces whose normal is within 60 degrees of a direction that may depend on
/// the place.
template <class Direction>
double area_facing(const Mesh& mesh, const Direction& direction) {
  double sum = 0;
  const Triangles skin = boundary(mesh.tets);
  for (const auto& face : skin.colwise()) {
    const Vec3 a = mesh.X_mm.col(face(0)), b = mesh.X_mm.col(face(1)), c = mesh.X_mm.col(face(2));
    const Vec3 area = (b - a).cross(c - a) / 2;
    if (area.normalized().dot(direction((a + b + c) / 3)) > 0.5) sum += area.norm();
  }
  return sum;
}

class KneeSize : public testing::TestWithParam<KneeResolution> {};
INSTANTIATE_TEST_SUITE_P(MillimetresAndLayers, KneeSize,
                         testing::Values(KneeResolution{1.5, 3}, KneeResolution{2.5, 2},
                                         KneeResolution{4, 2}, KneeResolution{2.5, 2, 1.6}));

TEST_P(KneeSize, TetrahedraArePositiveAndSurfacesClosed) {
  for (const Compartment* c : kBoth)
    for (const Mesh& mesh :
         {femoral_cartilage(*c, GetParam()), femoral_cartilage_back(*c, GetParam()),
          tibial_cartilage(*c, GetParam()), meniscus(*c, GetParam())}) {
      EXPECT_GT(least_relative_volume(mesh), 0.0015);
      const auto [least, largest] = dihedral_range_deg(mesh);
      EXPECT_GT(least, 5);
      EXPECT_LT(largest, 168);
      EXPECT_EQ(unmatched_edges(boundary(mesh.tets)), 0);
    }
}

TEST_P(KneeSize, TheStripBehindACondyleGoesOnWhereItsLayerEnds) {
  for (const Compartment* c : kBoth) {
    const Mesh layer = femoral_cartilage(*c, GetParam()),
               strip = femoral_cartilage_back(*c, GetParam());
    const Triangles skin = boundary(layer.tets);
    SurfaceDistance distance(layer.X_mm, skin);
    int beside = 0;
    double last = 0;
    for (const auto& node : strip.X_mm.colwise()) {
      const double apart = distance(node);
      EXPECT_GT(apart, -0.1);
      beside += apart < 0.1;
      last = std::max(last, condyle_place(*c, node).phi);
    }
    EXPECT_GE(beside, 3 * 3);
    EXPECT_NEAR(last / kDegree, kBackEndDeg, 1e-6);
  }
}

TEST_P(KneeSize, CartilageHasThePublishedMeanThickness) {
  for (const Compartment* c : kBoth) {
    const Mesh femoral = femoral_cartilage(*c, GetParam());
    const double femoral_area = area_facing(femoral, [&](const Vec3& p) -> Vec3 {
      const CondylePlace place = condyle_place(*c, p);
      return condyle_point(*c, place.phi, place.alpha, 0) -
             condyle_point(*c, place.phi, place.alpha, 1);
    });
    // Chords of the elements take away up to 1 % of both.
    EXPECT_NEAR(volume_of(femoral) / femoral_area, c->femoral_thickness,
                0.015 * c->femoral_thickness);
    const Mesh tibial = tibial_cartilage(*c, GetParam());
    const double tibial_area = area_facing(tibial, [](const Vec3&) { return Vec3::UnitZ(); });
    EXPECT_NEAR(volume_of(tibial) / tibial_area, c->tibial_thickness, 0.015 * c->tibial_thickness);
  }
}

// A meniscus has one shape, whatever its elements: at 4 mm their chords enter the condyle.
TEST_P(KneeSize, NothingOverlapsAndTheGapsAreSmall) {
  for (const Compartment* c : kBoth) {
    const double h = GetParam().size_mm, chord = h * h / (8 * c->coronal_radius);
    const std::vector<Mesh> meshes = {femoral_cartilage(*c, GetParam()),
                                      tibial_cartilage(*c, GetParam()), meniscus(*c, GetParam())};
    for (const auto& [i, j] : {std::pair(0, 1), std::pair(0, 2), std::pair(1, 2)}) {
      SCOPED_TRACE(name_of(*c) + ", meshes " + std::to_string(i) + " and " + std::to_string(j));
      double least = 1e3;
      for (const auto& [a, b] : {std::pair(i, j), std::pair(j, i)}) {
        const Mesh &on = meshes[static_cast<std::size_t>(a)],
                   &of = meshes[static_cast<std::size_t>(b)];
        const Triangles skin = boundary(on.tets), other = boundary(of.tets);
        SurfaceDistance distance(on.X_mm, skin);
        for (const auto& face : other.colwise()) {
          // Corners and middle of each face.
          Vec3 middle = Vec3::Zero();
          for (const int node : face) {
            least = std::min(least, distance(of.X_mm.col(node)));
            middle += of.X_mm.col(node) / 3;
          }
          least = std::min(least, distance(middle));
        }
      }
      EXPECT_GT(least, h > 2.5 && j == 2 ? -chord : 0);
      EXPECT_LT(least, 0.25);
    }
  }
}

// Cells of a line of 60 mm: of one size within 8 mm of the focus, 2.5 times larger from 16 mm on.
TEST(KneeSpacing, IsFinerAtTheFocusByItsFactor) {
  constexpr double kLength = 60, kMiddle = -6, kReach = 8, kFactor = 2.5;
  const Spacing spacing(kLength, 1, {kMiddle, kReach, kFactor});
  const int n = spacing.cells();
  EXPECT_EQ(n % 2, 0);
  EXPECT_EQ(spacing.place(-1), -1);
  EXPECT_NEAR(spacing.place(1), 1, 1e-12);
  std::vector<double> near, far;  // cells [mm]
  for (int i = 0; i < n; ++i) {
    const double begin = kLength / 2 * spacing.place(2.0 * i / n - 1),
                 end = kLength / 2 * spacing.place(2.0 * (i + 1) / n - 1);
    EXPECT_GT(end, begin);
    const auto [least, most] = std::minmax({std::abs(begin - kMiddle), std::abs(end - kMiddle)});
    if (most < kReach) near.push_back(end - begin);
    if (least > 2 * kReach) far.push_back(end - begin);
  }
  ASSERT_GE(near.size(), 38U);
  ASSERT_GE(far.size(), 25U);
  for (const double cell : near) EXPECT_NEAR(cell, 1 / kFactor, 0.03 / kFactor);
  for (const double cell : far) EXPECT_NEAR(cell, kFactor * near[0], 0.01 * cell);
}

TEST(KneeSpacing, WithoutAFocusIsEven) {
  const Spacing spacing(29, 2.5, {-2.5, 7.5, 1});
  EXPECT_EQ(spacing.cells(), 12);
  for (const double t : {-1.0, -0.3, 0.0, 0.9}) EXPECT_EQ(spacing.place(t), t);
}

// Faces of both cartilages around the lowest point of the condyle are smaller by the square of the
// focus. In front and behind they are so in one direction only, or not at all.
TEST(KneeAnatomy, AFocusMakesFacesSmallerWhereAStandingKneeTouches) {
  constexpr double kFocus = 2;
  const auto mean_face = [](const Mesh& mesh, const Compartment& c, double least, double most) {
    double sum = 0;
    int count = 0;
    const Triangles skin = boundary(mesh.tets);
    for (const auto& face : skin.colwise()) {
      const Eigen::Matrix3d x = mesh.X_mm(Eigen::all, face);
      const Vec3 area = (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0)) / 2;
      const Vec3 middle = x.rowwise().mean();
      const double away = std::hypot(middle.x() - c.side * kCompartmentX, middle.y() + 2.5);
      if (std::abs(area.z()) < 0.5 * area.norm() || away < least || away > most) continue;
      sum += area.norm();
      ++count;
    }
    return sum / count;
  };
  for (const Compartment* c : kBoth)
    for (const auto make : {femoral_cartilage, tibial_cartilage}) {
      const Mesh even = make(*c, {2.5, 2, 1}), focused = make(*c, {2.5, 2, kFocus});
      EXPECT_NEAR(mean_face(focused, *c, 0, 6) * kFocus * kFocus, mean_face(even, *c, 0, 6),
                  0.25 * mean_face(even, *c, 0, 6));
      EXPECT_GT(mean_face(focused, *c, 17, 40), 1.5 * mean_face(focused, *c, 0, 6));
    }
}

TEST(KneeAnatomy, ShippedFilesAreWhatTheProgramMakes) {
  const auto folder = std::filesystem::path(ARTICULAR_SOURCE_DIR) / "scenarios/knee/anatomy";
  for (const auto& [name, mesh] : default_knee().meshes) {
    SCOPED_TRACE(name);
    const sim::MeshData file = sim::read_mesh(folder / name, 1e-3);
    ASSERT_EQ(file.X.cols(), mesh.X_mm.cols());
    EXPECT_LT((file.X * 1e3 - mesh.X_mm).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_EQ(file.tets, mesh.tets);
    if (mesh.triangles.cols() > 0) {
      EXPECT_EQ(file.triangles, mesh.triangles);
    }
    if (mesh.fibres.cols() > 0) {
      ASSERT_EQ(file.cell_vectors.size(), 1U);
      EXPECT_EQ(file.cell_vectors[0].first, "fibres");
      EXPECT_LT((file.cell_vectors[0].second - mesh.fibres).cwiseAbs().maxCoeff(), 1e-12);
    }
  }
  std::ifstream stream(folder / "landmarks.csv", std::ios::binary);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(stream), {}),
            landmarks_csv(default_knee().landmarks));
}

TEST(KneeAnatomy, CondylesHaveTwoSagittalRadii) {
  for (const Compartment* c : kBoth)
    for (const double h : {1e-2, 5e-3}) {
      // Radius of the circle through three points of the profile.
      const auto radius = [&](double phi) {
        const Vec3 p = condyle_point(*c, phi - h, 0, 0), q = condyle_point(*c, phi, 0, 0),
                   r = condyle_point(*c, phi + h, 0, 0);
        return (q - p).norm() * (r - q).norm() * (r - p).norm() / (2 * (q - p).cross(r - p).norm());
      };
      EXPECT_NEAR(radius(0), c->distal_radius, 1e-6);
      EXPECT_NEAR(radius(c->transition + 0.1), c->posterior_radius, 1e-6);
    }
}

TEST(KneeAnatomy, ADistanceToACondyleIsThatOfItsParametrisation) {
  for (const Compartment* c : kBoth)
    for (const double phi : {-0.6, 0.0, 0.2, 0.4, 0.7, 1.5})
      for (const double alpha : {-0.5, 0.0, 0.3})
        for (const double out : {-1.5, 0.0, 0.7}) {
          const CondylePlace place = condyle_place(*c, condyle_point(*c, phi, alpha, -out));
          EXPECT_NEAR(place.distance, out, 1e-12);
          EXPECT_NEAR(place.phi, phi, 1e-12);
          EXPECT_NEAR(place.alpha, alpha, 1e-12);
          if (std::abs(phi) > 1) continue;
          const Vec3 p = condyle_point(*c, phi, alpha, -0.7);
          EXPECT_NEAR(condyle_height(*c, p.x(), p.y(), 0.7), p.z(), 1e-9);
        }
}

TEST(KneeAnatomy, MedialPlateauIsConcaveAndLateralOneConvexInTheSagittalPlane) {
  for (const Compartment* c : kBoth) {
    const double x = c->side * kCompartmentX;
    const double bend =
        plateau_height(*c, x, 10) + plateau_height(*c, x, -10) - 2 * plateau_height(*c, x, 0);
    EXPECT_GT(c->side * bend, 0.5);
    // Both rise to the eminence between them and slope down to the back.
    EXPECT_GT(plateau_height(*c, x - 10 * c->side, 0), plateau_height(*c, x, 0) + 0.5);
    EXPECT_NEAR((plateau_height(*c, x, -1) - plateau_height(*c, x, 1)) / 2,
                std::tan(kPlateauSlopeDeg * kDegree), 1e-9);
  }
}

/// Middles of the roots' published places: behind and to the middle of the apex of each side's
/// eminence (30 knees, scenarios/SOURCES.md), which stand at (4.5, 3) and (-4.5, 1).
Eigen::Vector2d published_root(const Compartment& c, int end) {
  if (c.side > 0) return {4.5 - (end < 0 ? 3.01 : 2.77), 3 + (end < 0 ? -25.40 : 11.73)};
  return {-4.5 + (end < 0 ? -1.31 : 1.85), 1 + (end < 0 ? -12.97 : 4.51)};
}

TEST(KneeAnatomy, HornsOfMenisciPointAtThePublishedRoots) {
  for (const Compartment* c : kBoth) {
    const Mesh& mesh = part(default_knee(), "meniscus", *c);
    for (const int end : {-1, 1}) {
      SCOPED_TRACE(name_of(*c) + (end < 0 ? " anterior" : " posterior"));
      const Eigen::Vector2d horn_end = horn(*c, end).head<2>();
      const Eigen::Vector2d to_root = published_root(*c, end) - horn_end;
      EXPECT_LT(to_root.norm(), 13);
      EXPECT_GT(to_root.norm(), 5);
      Eigen::Vector2d out = Eigen::Vector2d::Zero();  // mean of the fibres near the end
      for (Eigen::Index e = 0; e < mesh.tets.cols(); ++e)
        if ((mesh.X_mm.col(mesh.tets(0, e)).head<2>() - horn_end).norm() < 5)
          out += end * mesh.fibres.col(e).head<2>();
      EXPECT_GT(out.normalized().dot(to_root.normalized()), std::cos(25 * kDegree));
    }
  }
}

TEST(KneeAnatomy, MenisciHaveThePublishedRims) {
  // Outer rim 99.1 ± 11.2 medial, 90.3 ± 9.4 lateral, from root to root; greatest heights 6.9 ± 1.1
  // and 7.0 ± 0.9 mm.
  const std::map<std::string, std::array<double, 2>> published = {{"medial", {99.1, 11.2}},
                                                                  {"lateral", {90.3, 9.4}}};
  for (const Compartment* c : kBoth) {
    SCOPED_TRACE(name_of(*c));
    const auto [rim, deviation] = published.at(name_of(*c));
    double length = 0;
    for (const int end : {-1, 1})
      length += (horn(*c, end).head<2>() - published_root(*c, end)).norm();
    constexpr double kSize = 1;
    const Mesh mesh = meniscus(*c, {kSize, 2});
    const CellGrid grid{even_cells(75, kSize, 8), even_cells(c->middle_width, kSize, 4), 2};
    const Vec3 size = mesh.X_mm.rowwise().maxCoeff() - mesh.X_mm.rowwise().minCoeff();
    EXPECT_NEAR(size.y(), 2 * c->rim_depth, 0.5);
    for (int i = 0; i < grid.nu; ++i)
      length +=
          (mesh.X_mm.col(grid.node(i + 1, grid.nv, 1)) - mesh.X_mm.col(grid.node(i, grid.nv, 1)))
              .head<2>()
              .norm();
    EXPECT_NEAR(length, rim, deviation);
    const Eigen::Index layer = mesh.X_mm.cols() / 3;  // two layers of elements
    const Eigen::RowVectorXd heights = mesh.X_mm.row(2).tail(layer) - mesh.X_mm.row(2).head(layer);
    EXPECT_NEAR(heights.maxCoeff(), c->back_height, 1.7);
    EXPECT_GT(heights.minCoeff(), 0.7);
  }
}

/// A section of a meniscus of two layers: its outline, counterclockwise from the lower face's inner
/// end, as distance from the inner edge and height.
std::vector<Eigen::Vector2d> section(const Mesh& mesh, const CellGrid& grid, int i) {
  const Vec3 inner = mesh.X_mm.col(grid.node(i, 0, 1)),
             outer = mesh.X_mm.col(grid.node(i, grid.nv, 1));
  const Eigen::Vector2d out = (outer - inner).head<2>().normalized();
  std::vector<Eigen::Vector2d> outline;
  const auto add = [&](int j, int k) {
    const Vec3 p = mesh.X_mm.col(grid.node(i, j, k));
    outline.emplace_back((p - inner).head<2>().dot(out), p.z());
  };
  for (int j = 0; j <= grid.nv; ++j) add(j, 0);
  add(grid.nv, 1);
  for (int j = grid.nv; j >= 0; --j) add(j, grid.nw);
  add(0, 1);
  return outline;
}

/// The least angle at a corner of an outline.
double sharpest_deg(const std::vector<Eigen::Vector2d>& outline) {
  double least = 180;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Eigen::Vector2d before = outline[(k + outline.size() - 1) % outline.size()] - outline[k],
                          after = outline[(k + 1) % outline.size()] - outline[k];
    least = std::min(least, std::acos(before.normalized().dot(after.normalized())) / kDegree);
  }
  return least;
}

// An edge of 90 degrees or less digs into cartilage: pressures there grow with every refinement.
TEST(KneeAnatomy, SectionsOfAMeniscusHaveNoSharpEdgeAndThePublishedSize) {
  for (const Compartment* c : kBoth) {
    SCOPED_TRACE(name_of(*c));
    constexpr double kSize = 1;
    const Mesh mesh = meniscus(*c, {kSize, 2});
    const CellGrid grid{even_cells(75, kSize, 8), even_cells(c->middle_width, kSize, 4), 2};
    ASSERT_EQ(mesh.X_mm.cols(), (grid.nu + 1) * (grid.nv + 1) * 3);
    const auto width = [&](int i) {
      return (mesh.X_mm.col(grid.node(i, grid.nv, 1)) - mesh.X_mm.col(grid.node(i, 0, 1)))
          .head<2>()
          .norm();
    };
    for (int i = grid.nu / 8; i <= 7 * grid.nu / 8; ++i) {
      const std::vector<Eigen::Vector2d> outline = section(mesh, grid, i);
      EXPECT_GT(sharpest_deg(outline), 91) << i;
      double area = 0;  // a wedge of these widths and heights has 16 to 48 mm²
      for (std::size_t k = 0; k < outline.size(); ++k) {
        const Eigen::Vector2d &p = outline[k], &q = outline[(k + 1) % outline.size()];
        area += (p.x() * q.y() - q.x() * p.y()) / 2;
      }
      EXPECT_GT(area, 13) << i;
      EXPECT_LT(area, 48) << i;
    }
    // As wide as published, or as far inwards as there is room.
    EXPECT_NEAR(width(grid.nu / 2), c->middle_width, 1);
    EXPECT_NEAR(width(grid.nu / 5), c->front_width, c->side > 0 ? 1.3 : 2.2);
    EXPECT_NEAR(width(5 * grid.nu / 6), c->back_width, 1);
  }
}

// Else what menisci carry depends on the elements.
TEST(KneeAnatomy, AMeniscusHasTheSameShapeForAllSizesOfElements) {
  for (const Compartment* c : kBoth) {
    SCOPED_TRACE(name_of(*c));
    const Mesh fine = meniscus(*c, {0.5, 2});
    const double finest = volume_of(fine);
    // Chords err by the square of the size: 1/5 is left of what the finest one tells.
    const double coarse = volume_of(meniscus(*c, {2, 2})) - finest,
                 middle = volume_of(meniscus(*c, {1, 2})) - finest;
    EXPECT_NEAR(middle / coarse, 0.2, 0.06);
    EXPECT_LT(std::abs(coarse), 0.04 * finest);
    // Nodes of coarse elements lie on the surface of fine ones, but for the chords of these.
    const Triangles skin = boundary(fine.tets);
    SurfaceDistance distance(fine.X_mm, skin);
    const Mesh shipped = meniscus(*c, {2.5, 2});
    const Eigen::Index layer = shipped.X_mm.cols() / 3;
    for (Eigen::Index i = 0; i < layer; ++i)
      for (const Eigen::Index node : {i, 2 * layer + i})  // lower and upper face
        EXPECT_LT(std::abs(distance(shipped.X_mm.col(node))), 0.02);
  }
}

// Roots pull the ends of horns down. Unless the lower face leaves the plateau before the end, the
// last edge digs in as others do.
TEST(KneeAnatomy, LowerFacesOfHornsRiseRoundlyToTheirEnds) {
  for (const Compartment* c : kBoth) {
    constexpr double kSize = 1;
    const Mesh mesh = meniscus(*c, {kSize, 2});
    const CellGrid grid{even_cells(75, kSize, 8), even_cells(c->middle_width, kSize, 4), 2};
    const auto above_plateau = [&](int i, int j) {
      const Vec3 p = mesh.X_mm.col(grid.node(i, j, 0));
      return p.z() - plateau_height(*c, p.x(), p.y());
    };
    const auto along = [&](int i, int to, int j) {
      return (mesh.X_mm.col(grid.node(i, j, 0)) - mesh.X_mm.col(grid.node(to, j, 0)))
          .head<2>()
          .norm();
    };
    for (const int end : {0, grid.nu}) {
      const int inwards = end == 0 ? 1 : -1, middle = grid.nv / 2;
      SCOPED_TRACE(name_of(*c) + (end == 0 ? " anterior" : " posterior"));
      for (int j = middle; j <= grid.nv; ++j)
        EXPECT_GT(above_plateau(end, j) - above_plateau(end + 5 * inwards, j), 0.5) << j;
      double before = 0;  // no corner between elements is sharper than 165 degrees
      for (int k = 5; k > 0; --k) {
        const int i = end + k * inwards, next = i - inwards;
        const double slope = std::atan((above_plateau(next, middle) - above_plateau(i, middle)) /
                                       along(i, next, middle));
        EXPECT_LT(slope - before, 15 * kDegree) << k;
        before = slope;
      }
      EXPECT_GT(before, 9 * kDegree);  // at the end
    }
  }
}

TEST(KneeAnatomy, FibresOfAMeniscusRunAlongItsRim) {
  for (const Compartment* c : kBoth) {
    const Mesh& mesh = part(default_knee(), "meniscus", *c);
    ASSERT_EQ(mesh.fibres.cols(), mesh.tets.cols());
    for (Eigen::Index e = 0; e < mesh.tets.cols(); ++e) {
      Vec3 p = Vec3::Zero();
      for (const int node : mesh.tets.col(e)) p += mesh.X_mm.col(node) / 4;
      const Vec3 fibre = mesh.fibres.col(e);
      EXPECT_NEAR(fibre.norm(), 1, 1e-12);
      EXPECT_LT(std::abs(fibre.z()), 0.5);
      // Around the compartment's middle, in the sense from the anterior to the posterior horn.
      const Vec3 ray = p - Vec3(c->side * kCompartmentX, 0, p.z());
      EXPECT_GT(c->side * ray.cross(fibre).z(), 0.5 * ray.norm());
    }
  }
}

// The scenario ties what lies within 0.3 mm of the bones: all nodes of the deepest layer, no
// others.
TEST(KneeAnatomy, BonesAreClosedAndCartilageLiesOnThem) {
  const std::map<std::string, std::string> bones = {{"femoral_cartilage", "femur.vtp"},
                                                    {"tibial_cartilage", "tibia.vtp"}};
  for (const auto& [cartilage, bone] : bones) {
    SCOPED_TRACE(bone);
    const Mesh& surface = default_knee().meshes.at(bone);
    EXPECT_EQ(unmatched_edges(surface.triangles), 0);
    EXPECT_GT(volume_and_center(surface).first, 0);
    SurfaceDistance distance(surface.X_mm, surface.triangles);
    for (const Compartment* c : kBoth) {
      const Mesh& mesh = part(default_knee(), cartilage, *c);
      const Eigen::Index layer = mesh.X_mm.cols() / 3;  // two layers of elements
      for (Eigen::Index i = 0; i < mesh.X_mm.cols(); ++i) {
        const double above = distance(mesh.X_mm.col(i));
        if (i < layer) {
          EXPECT_LT(std::abs(above), 0.3) << mesh.X_mm.col(i).transpose();
        } else {
          EXPECT_GT(above, 0.4) << mesh.X_mm.col(i).transpose();
        }
      }
    }
  }
}

// Bones and outlines grow, cartilage is as thick as is asked, and it lies on its bone.
TEST(KneeAnatomy, AnotherKneeHasItsOwnSizeAndItsOwnCartilage) {
  const Anatomy usual = knee_anatomy({4, 2}), large = knee_anatomy({4, 2}, {1.15, 0.8});
  for (const auto& [name, mesh] : usual.meshes) {
    const Mesh& other = large.meshes.at(name);
    const auto width = [](const Mesh& m) {
      return m.X_mm.row(0).maxCoeff() - m.X_mm.row(0).minCoeff();
    };
    EXPECT_NEAR(width(other) / width(mesh), 1.15, 0.01) << name;
    if (name.find("cartilage") != std::string::npos) {
      EXPECT_EQ(other.tets, mesh.tets);
      // The strips have the thickness of the layer before them, no mean of their own: on a round
      // condyle the thinner one has more volume by its thickness.
      const bool strip = name.find("_back_") != std::string::npos;
      EXPECT_NEAR(volume_of(other) / volume_of(mesh), 1.15 * 1.15 * 0.8, strip ? 0.015 : 2e-3)
          << name;
    }
  }
  const Mesh& femur = large.meshes.at("femur.vtp");
  SurfaceDistance distance(femur.X_mm, femur.triangles);
  const Mesh& cartilage = large.meshes.at("femoral_cartilage_medial.vtu");
  for (Eigen::Index i = 0; i < cartilage.X_mm.cols() / 3; ++i)
    EXPECT_LT(std::abs(distance(cartilage.X_mm.col(i))), 0.3);
}

TEST(KneeAnatomy, RefusesSizesAndLayersOutsideTheirRange) {
  EXPECT_THROW(knee_anatomy({0.3, 2}), std::invalid_argument);
  EXPECT_THROW(knee_anatomy({5, 2}), std::invalid_argument);
  EXPECT_THROW(knee_anatomy({2, 1}), std::invalid_argument);
  EXPECT_THROW(knee_anatomy({std::nan(""), 2}), std::invalid_argument);
  EXPECT_THROW(knee_anatomy({4, 2}, {0.7, 1}), std::invalid_argument);
  EXPECT_THROW(knee_anatomy({4, 2}, {1, 1.6}), std::invalid_argument);
}

}  // namespace articular::anatomy::knee_anatomy_test
