// What a patch sums to, its gradient and its tangent, each held against differences.
#include "sim/gap/contact_patch.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "tests/sim/support/patch_triangles.hpp"
#include "tests/sim/support/scene.hpp"

namespace articular::sim::contact_patch_derivatives_test {

constexpr double kStiffness = 3, kRestArea = 0.7;
constexpr DepthRange kRange{10, 10};

/// A triangle with its normal along −z, and a face that looks along +z.
struct Pair {
  Mat3 s, f;
};

/// Triangles wholly behind a face that covers them.
Pair covered_pair(Random& random) {
  Pair pair{small_triangle(0.5), large_face()};
  for (Mat3* m : {&pair.s, &pair.f})
    for (int i = 0; i < 3; ++i) m->col(i) += 0.2 * random.vec3();
  return pair;
}

/// Triangles and faces of like size that overlap in part and cross each other.
Pair partial_pair(Random& random) {
  Pair pair{small_triangle(0.1), large_face() / 20};
  for (Mat3* m : {&pair.s, &pair.f})
    for (int i = 0; i < 3; ++i) m->col(i) += 0.3 * random.vec3();
  return pair;
}

/// One triangle's nodes carry with a third of its area each: E = ½ k Σ G_a²/A_a.
constexpr double kNodeArea = kRestArea / 3;

double energy_of(const Vec3& G) { return 0.5 * kStiffness * G.squaredNorm() / kNodeArea; }

Vec3 depth_integrals_of(const Pair& pair) {
  ContactPatch patch;
  return contact_patch(flat_triangle(pair.s), flat_triangle(pair.f), kRestArea, kRange, patch)
             ? depth_integrals(patch)
             : Vec3::Zero();
}

double energy(const Pair& pair) { return energy_of(depth_integrals_of(pair)); }

Vec18 gradient(const Pair& pair) {
  ContactPatch patch;
  if (!contact_patch(flat_triangle(pair.s), flat_triangle(pair.f), kRestArea, kRange, patch))
    return Vec18::Zero();
  return patch_gradient(patch, kStiffness / kNodeArea * depth_integrals(patch));
}

/// ∇G_a, one a column.
Eigen::Matrix<double, 18, 3> node_gradients(const ContactPatch& patch) {
  Eigen::Matrix<double, 18, 3> gradients;
  for (int a = 0; a < 3; ++a) gradients.col(a) = patch_gradient(patch, Vec3::Unit(a));
  return gradients;
}

Mat18 tangent(const ContactPatch& patch) {
  const auto n = node_gradients(patch);
  return kStiffness / kNodeArea *
         (n * n.transpose() + patch_curvature(patch, {depth_integrals(patch)}));
}

double& entry(Pair& pair, int i) { return i < 9 ? pair.s.reshaped()[i] : pair.f.reshaped()[i - 9]; }

/// Central differences in one coordinate of the pair.
template <class Result>
Result difference(Result (*function)(const Pair&), const Pair& pair, int i, double h) {
  Pair plus = pair, minus = pair;
  entry(plus, i) += h;
  entry(minus, i) -= h;
  return (function(plus) - function(minus)) / (2 * h);
}

double gradient_error(const Pair& pair) {
  const Vec18 g = gradient(pair);
  double best = std::numeric_limits<double>::infinity();
  for (const double h : {1e-4, 1e-5, 1e-6}) {
    Vec18 numeric;
    for (int i = 0; i < 18; ++i) numeric[i] = difference(energy, pair, i, h);
    best = std::min(best, (numeric - g).norm() / g.norm());
  }
  return best;
}

TEST(ContactPatch, UnderALargeFaceTheGradientIsTheDerivativeOfTheEnergy) {
  Random random(1);
  for (int n = 0; n < 50; ++n) {
    const Pair pair = covered_pair(random);
    ASSERT_GT(energy(pair), 0);
    EXPECT_LT(gradient_error(pair), 1e-8);
  }
}

/// A triangle over a sheet of six faces about a node, all uneven: the depth is continuous from face
/// to face.
constexpr int kSheetNodes = 10;  // three of the triangle, the sheet's middle, its six outer nodes
using SheetMatrix = Eigen::Matrix<double, 3 * kSheetNodes, 3 * kSheetNodes>;

Positions uneven_sheet(Random& random) {
  Positions x(3, kSheetNodes);
  x.leftCols(3) = small_triangle(0.3);
  x.leftCols(3).row(0).array() -= 0.3;
  x.leftCols(3).row(1).array() -= 0.3;
  x.col(3).setZero();
  for (int k = 0; k < 6; ++k)
    x.col(4 + k) = 3 * Vec3(std::cos(k * M_PI / 3), std::sin(k * M_PI / 3), 0);
  for (int i = 0; i < kSheetNodes; ++i) x.col(i) += 0.1 * random.vec3();
  return x;
}

/// Calls visit(pair, nodes) for the triangle and each of the six faces.
template <class Visit>
void for_each_sheet_face(const Positions& x, Visit&& visit) {
  for (int k = 0; k < 6; ++k) {
    const std::array<int, 6> nodes = {0, 1, 2, 3, 4 + k, 4 + (k + 1) % 6};
    Pair pair;
    pair.s = x.leftCols(3);
    for (int m = 0; m < 3; ++m) pair.f.col(m) = x.col(nodes[3 + static_cast<std::size_t>(m)]);
    visit(pair, nodes);
  }
}

Vec3 sheet_depth_integrals(const Positions& x) {
  Vec3 sum = Vec3::Zero();
  for_each_sheet_face(x, [&](const Pair& pair, const auto&) { sum += depth_integrals_of(pair); });
  return sum;
}

double sheet_energy(const Positions& x) { return energy_of(sheet_depth_integrals(x)); }

Positions sheet_gradient(const Positions& x) {
  const Vec3 p = kStiffness / kNodeArea * sheet_depth_integrals(x);
  Positions g = Positions::Zero(3, kSheetNodes);
  for_each_sheet_face(x, [&](const Pair& pair, const std::array<int, 6>& nodes) {
    ContactPatch patch;
    if (!contact_patch(flat_triangle(pair.s), flat_triangle(pair.f), kRestArea, kRange, patch))
      return;
    const Vec18 part = patch_gradient(patch, p);
    for (int i = 0; i < 6; ++i) g.col(nodes[static_cast<std::size_t>(i)]) += part.segment<3>(3 * i);
  });
  return g;
}

/// @param rims  of the faces; of a sheet that goes on all around, 0
SheetMatrix sheet_tangent(const Positions& x, unsigned rims) {
  const Vec3 p = kStiffness / kNodeArea * sheet_depth_integrals(x);
  SheetMatrix H = SheetMatrix::Zero();
  Eigen::Matrix<double, 3 * kSheetNodes, 3> gradients = decltype(gradients)::Zero();
  for_each_sheet_face(x, [&](const Pair& pair, const std::array<int, 6>& nodes) {
    ContactPatch patch;
    FlatTriangle f = flat_triangle(pair.f);
    f.rims = rims;
    if (!contact_patch(flat_triangle(pair.s), f, kRestArea, kRange, patch)) return;
    const Mat18 part = patch_curvature(patch, {p});
    const auto n = node_gradients(patch);
    for (int i = 0; i < 6; ++i) {
      const int row = 3 * nodes[static_cast<std::size_t>(i)];
      gradients.middleRows<3>(row) += n.middleRows<3>(3 * i);
      for (int j = 0; j < 6; ++j)
        H.block<3, 3>(row, 3 * nodes[static_cast<std::size_t>(j)]) +=
            part.block<3, 3>(3 * i, 3 * j);
    }
  });
  return H + kStiffness / kNodeArea * gradients * gradients.transpose();
}

// Nothing is left over at the edges which move over the triangle.
TEST(ContactPatch, UnderAnUnevenSheetTheSummedGradientIsTheDerivativeOfTheSummedEnergy) {
  Random random(3);
  for (int n = 0; n < 20; ++n) {
    const Positions x = uneven_sheet(random), g = sheet_gradient(x);
    double best = std::numeric_limits<double>::infinity();
    for (const double h : {1e-4, 1e-5, 1e-6}) {
      Positions numeric(3, kSheetNodes);
      for (int i = 0; i < 3 * kSheetNodes; ++i) {
        Positions plus = x, minus = x;
        plus.reshaped()[i] += h;
        minus.reshaped()[i] -= h;
        numeric.reshaped()[i] = (sheet_energy(plus) - sheet_energy(minus)) / (2 * h);
      }
      best = std::min(best, (numeric - g).norm() / g.norm());
    }
    EXPECT_LT(best, 1e-8);
  }
}

// So for the tangent: what one face loses by the motion of an edge, its neighbour gains.
TEST(ContactPatch, UnderAnUnevenSheetTheSummedTangentIsTheDerivativeOfTheSummedGradient) {
  Random random(9);
  for (int n = 0; n < 20; ++n) {
    const Positions x = uneven_sheet(random);
    const SheetMatrix H = sheet_tangent(x, 0);
    // With what is added at rims too, as two faces at an edge have it with opposite signs.
    EXPECT_LT((sheet_tangent(x, 7) - H).norm(), 1e-12 * H.norm());
    double best = std::numeric_limits<double>::infinity();
    for (const double h : {1e-4, 1e-5, 1e-6}) {
      SheetMatrix numeric;
      for (int i = 0; i < 3 * kSheetNodes; ++i) {
        Positions plus = x, minus = x;
        plus.reshaped()[i] += h;
        minus.reshaped()[i] -= h;
        const Positions change = (sheet_gradient(plus) - sheet_gradient(minus)) / (2 * h);
        numeric.col(i) = change.reshaped();
      }
      best = std::min(best, (numeric - H).norm() / H.norm());
    }
    EXPECT_LT(best, 1e-7);
  }
}

/// Depths count a little in front of the face, so that polygons end there as well as at rims.
constexpr DepthRange kNear{0.1, 10};

/// Of Σ p_a G_a − m_a W_a, over all parts: what fades in, and points nearer to rims than to the
/// face.
struct PartialSum {
  Pair pair;
  Vec3 p, m;
  Vec3 rim_height = Vec3::Zero();
  std::vector<ContactPatch> parts() const {
    std::vector<ContactPatch> found;
    FlatTriangle f = flat_triangle(pair.f);
    f.rim_height = rim_height;
    for (int nearest = 0; nearest < ContactPatch::kParts; ++nearest) {
      ContactPatch patch;
      if (!contact_patch(flat_triangle(pair.s), f, kRestArea, kNear, patch, nearest)) continue;
      for (PatchEdge& edge : patch.edge) edge.is_end = edge.kind != PatchEdge::Kind::OpenDepth;
      found.push_back(patch);
    }
    return found;
  }
  double value() const {
    double sum = 0;
    for (const ContactPatch& patch : parts()) sum += sim::value(patch, {p, m});
    return sum;
  }
  Vec18 gradient() const {
    Vec18 sum = Vec18::Zero();
    for (const ContactPatch& patch : parts()) sum += sim::patch_gradient(patch, PatchSum{p, m});
    return sum;
  }
  Mat18 tangent() const {
    Mat18 H = Mat18::Zero();
    for (const ContactPatch& patch : parts()) H += patch_curvature(patch, {p, m});
    return H;
  }
  Vec18 numeric_gradient(double h) const {
    Vec18 g;
    for (int i = 0; i < 18; ++i) g[i] = (moved(i, h).value() - moved(i, -h).value()) / (2 * h);
    return g;
  }
  PartialSum moved(int i, double h) const {
    PartialSum there = *this;
    entry(there.pair, i) += h;
    return there;
  }
};

Vec3 nodal_areas_of(const std::vector<ContactPatch>& parts) {
  Vec3 sum = Vec3::Zero();
  for (const ContactPatch& patch : parts) sum += nodal_areas(patch);
  return sum;
}

TEST(ContactPatch, AtRimsAndWhereDepthsBeginToCountTheGradientIsTheDerivativeOfTheSum) {
  Random random(11);
  int at_rims = 0, fading = 0, open = 0, corners_pass = 0;
  for (int n = 0; n < 300; ++n) {
    const PartialSum sum{partial_pair(random), random.vec3(), random.vec3()};
    const std::vector<ContactPatch> parts = sum.parts();
    if (nodal_areas_of(parts).sum() < 0.05 * kRestArea) continue;
    for (const ContactPatch& patch : parts) {
      fading += patch.fade > 0 ? 1 : 0;
      for (const PatchEdge& edge : std::span(patch.edge.data(), std::size_t(patch.num_edges))) {
        at_rims += edge.kind == PatchEdge::Kind::FaceEdge ? 1 : 0;
        open += edge.kind == PatchEdge::Kind::OpenDepth ? 1 : 0;
      }
    }
    const Vec18 g = sum.gradient();
    double best = std::numeric_limits<double>::infinity();
    for (const double h : {1e-5, 1e-6})
      best = std::min(best, (sum.numeric_gradient(h) - g).norm() / g.norm());
    corners_pass += best > 1e-6 ? 1 : 0;  // within h of a corner that comes or goes
    EXPECT_LT(best, 1e-3);
  }
  EXPECT_GT(at_rims, 100);
  EXPECT_GT(fading, 50);
  EXPECT_GT(open, 30);
  EXPECT_LT(corners_pass, 3);
}

// Points that passed a rim close by are as deep as they are far from it.
TEST(ContactPatch, BesideRimsTheGradientIsTheDerivativeOfTheSumOverAllParts) {
  Random random(13);
  int several = 0, corners_pass = 0;
  for (int n = 0; n < 300; ++n) {
    PartialSum sum{partial_pair(random), random.vec3(), random.vec3()};
    sum.pair.s.row(2).array() -= 0.3;
    const double whole = nodal_areas_of(sum.parts()).sum();
    sum.rim_height = Vec3(1.3, 0, 0.8);
    const std::vector<ContactPatch> parts = sum.parts();
    if (!(whole > 0.05 * kRestArea) || parts.size() < 2) continue;
    ++several;
    EXPECT_NEAR(nodal_areas_of(parts).sum(), whole, 1e-12);
    const Vec18 g = sum.gradient();
    double best = std::numeric_limits<double>::infinity();
    for (const double h : {1e-5, 1e-6})
      best = std::min(best, (sum.numeric_gradient(h) - g).norm() / g.norm());
    corners_pass += best > 1e-6 ? 1 : 0;
    EXPECT_LT(best, 1e-3);
  }
  EXPECT_GT(several, 50);
  EXPECT_LT(corners_pass, 3);
}

// So for the tangent, with and without depths that count to rims.
TEST(ContactPatch, AtItsEndsTheTangentIsTheDerivativeOfTheGradient) {
  Random random(12);
  int several = 0, single = 0, corners_pass = 0;
  for (int n = 0; n < 200; ++n) {
    PartialSum sum{partial_pair(random), random.vec3(), random.vec3()};
    sum.pair.s.row(2).array() -= 0.2;
    if (n % 2 == 0) sum.rim_height = Vec3(1.3, 0, 0.8);
    const std::vector<ContactPatch> parts = sum.parts();
    if (!(nodal_areas_of(parts).sum() > 0.05 * kRestArea)) continue;
    ++(parts.size() > 1 ? several : single);
    const Mat18 H = sum.tangent();
    double best = std::numeric_limits<double>::infinity();
    for (const double h : {1e-4, 1e-5, 1e-6}) {
      Mat18 numeric;
      for (int i = 0; i < 18; ++i)
        numeric.col(i) = (sum.moved(i, h).gradient() - sum.moved(i, -h).gradient()) / (2 * h);
      best = std::min(best, (numeric - H).norm() / H.norm());
    }
    corners_pass += best > 1e-7 ? 1 : 0;
    EXPECT_LT(best, 1e-2);
  }
  EXPECT_GT(several, 20);
  EXPECT_GT(single, 30);
  EXPECT_LT(corners_pass, 3);
}

TEST(ContactPatch, ForcesAreEqualAndOppositeWithoutNetMoment) {
  Random random(4);
  int in_contact = 0;
  for (int n = 0; n < 400; ++n) {
    const Pair pair = partial_pair(random);
    const Vec18 g = gradient(pair);
    if (g.isZero(0)) continue;
    ++in_contact;
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    for (int i = 0; i < 3; ++i) {
      force += g.segment<3>(3 * i) + g.segment<3>(9 + 3 * i);
      moment +=
          pair.s.col(i).cross(g.segment<3>(3 * i)) + pair.f.col(i).cross(g.segment<3>(9 + 3 * i));
    }
    // Weights beyond the face's corners are up to tens: their round-off counts.
    EXPECT_LT(force.norm(), 1e-13 * g.norm());
    EXPECT_LT(moment.norm(), 1e-13 * g.norm());
  }
  // Both outcomes occur.
  EXPECT_GT(in_contact, 120);
  EXPECT_LT(in_contact, 400);
}

TEST(ContactPatch, ARigidMotionTurnsTheForcesAndKeepsTheEnergy) {
  Random random(5);
  for (int n = 0; n < 100; ++n) {
    const Pair pair = partial_pair(random);
    const Mat3 R = rotation_matrix(3 * random.vec3());
    const Vec3 shift = random.vec3();
    const Pair moved{(R * pair.s).colwise() + shift, (R * pair.f).colwise() + shift};
    const Vec18 g = gradient(pair), turned = gradient(moved);
    EXPECT_NEAR(energy(moved), energy(pair), 1e-12 * kStiffness);
    for (int i = 0; i < 6; ++i)
      EXPECT_LT((turned.segment<3>(3 * i) - R * g.segment<3>(3 * i)).norm(),
                1e-11 * std::max(1e-3, g.norm()));
  }
}

double tangent_error(const Pair& pair) {
  ContactPatch patch;
  EXPECT_TRUE(
      contact_patch(flat_triangle(pair.s), flat_triangle(pair.f), kRestArea, kRange, patch));
  const Mat18 H = tangent(patch);
  EXPECT_LT((H - H.transpose()).norm(), 1e-14 * H.norm());
  double best = std::numeric_limits<double>::infinity();
  for (const double h : {1e-4, 1e-5, 1e-6}) {
    Mat18 numeric;
    for (int i = 0; i < 18; ++i) numeric.col(i) = difference(gradient, pair, i, h);
    best = std::min(best, (numeric - H).norm() / H.norm());
  }
  return best;
}

TEST(ContactPatch, UnderALargeFaceTheTangentIsTheDerivativeOfTheGradient) {
  Random random(8);
  for (int n = 0; n < 50; ++n) {
    Pair pair = covered_pair(random);
    if (n % 2 == 1) pair.s.row(2).array() += 0.4;  // comes out of the face
    ContactPatch patch;
    if (!contact_patch(flat_triangle(pair.s), flat_triangle(pair.f), kRestArea, kRange, patch))
      continue;
    if (patch.turning != 0 || patch.area < 0.1) continue;
    EXPECT_LT(tangent_error(pair), 1e-7);
  }
}

/// ½ k ∫ d² dA over what lies behind the face: where depths are not averaged. A part of the depth
/// may be allowed.
template <int kPercent>
constexpr DepthRange kBehind{0, 10, kPercent / 100.0};

template <int kPercent>
double point_energy(const Pair& pair) {
  ContactPatch patch;
  if (!contact_patch(flat_triangle(pair.s), flat_triangle(pair.f), kRestArea, kBehind<kPercent>,
                     patch))
    return 0;
  return value(patch, sim::point_energy(patch, kStiffness));
}

template <int kPercent>
Vec18 point_gradient(const Pair& pair) {
  ContactPatch patch;
  if (!contact_patch(flat_triangle(pair.s), flat_triangle(pair.f), kRestArea, kBehind<kPercent>,
                     patch))
    return Vec18::Zero();
  return sim::patch_gradient(patch, sim::point_energy(patch, kStiffness));
}

template <int kPercent>
void expect_derivatives_to_where_the_triangle_comes_out() {
  Random random(2);
  int crossing = 0;
  for (int n = 0; n < 50; ++n) {
    Pair pair = covered_pair(random);
    pair.s.row(2).array() += 0.5 - kBehind<kPercent>.allowance;
    ContactPatch patch;
    if (!contact_patch(flat_triangle(pair.s), flat_triangle(pair.f), kRestArea, kBehind<kPercent>,
                       patch))
      continue;
    if (patch.area < 0.1 || patch.turning != 0) continue;
    crossing += patch.area < 0.99 * kRestArea ? 1 : 0;
    const Vec18 g = point_gradient<kPercent>(pair);
    const Mat18 H =
        kStiffness * (patch_hessian(patch) + patch_curvature(patch, sim::point_energy(patch, 1)));
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(patch_hessian(patch))
                  .eigenvalues()
                  .minCoeff(),
              -1e-12 * patch_hessian(patch).norm());
    double gradient_best = std::numeric_limits<double>::infinity(), tangent_best = gradient_best;
    for (const double h : {1e-4, 1e-5, 1e-6}) {
      Vec18 numeric;
      Mat18 numeric_tangent;
      for (int i = 0; i < 18; ++i) {
        numeric[i] = difference(point_energy<kPercent>, pair, i, h);
        numeric_tangent.col(i) = difference(point_gradient<kPercent>, pair, i, h);
      }
      gradient_best = std::min(gradient_best, (numeric - g).norm() / g.norm());
      tangent_best = std::min(tangent_best, (numeric_tangent - H).norm() / H.norm());
    }
    EXPECT_LT(gradient_best, 1e-6);  // the energy's third derivative jumps
    EXPECT_LT(tangent_best, 1e-4);
  }
  EXPECT_GT(crossing, 10);
}

// Where the triangle dips in and out, the energy vanishes at the polygon's moving edge.
TEST(ContactPatch, PointwiseGradientAndTangentAreDerivativesToWhereTheTriangleComesOut) {
  expect_derivatives_to_where_the_triangle_comes_out<0>();
}

TEST(ContactPatch, WithAnAllowanceTheyAreDerivativesToWhereItsDepthIsReached) {
  expect_derivatives_to_where_the_triangle_comes_out<30>();
}

// Between 60 and 37 degrees the weight of a patch changes as it turns.
TEST(ContactPatch, PointwiseGradientAndTangentHaveTheTurningOfTheWeight) {
  Random random(6);
  int turning = 0;
  for (int n = 0; n < 200; ++n) {
    Pair pair = covered_pair(random);
    pair.s = rotation_matrix({0.8, 0.1, 0}) * pair.s;
    pair.s.row(2).array() -= 1;
    ContactPatch patch;
    if (!contact_patch(flat_triangle(pair.s), flat_triangle(pair.f), kRestArea, kBehind<0>, patch))
      continue;
    if (patch.turning == 0 || patch.area < 0.1 || (patch.depth.array() < 0.01).any()) continue;
    ++turning;
    const Vec18 g = point_gradient<0>(pair);
    const Mat18 H = kStiffness * patch_hessian(patch) +
                    patch_curvature(patch, sim::point_energy(patch, kStiffness));
    double gradient_best = std::numeric_limits<double>::infinity(), tangent_best = gradient_best;
    for (const double h : {1e-4, 1e-5, 1e-6}) {
      Vec18 numeric;
      Mat18 numeric_tangent;
      for (int i = 0; i < 18; ++i) {
        numeric[i] = difference(point_energy<0>, pair, i, h);
        numeric_tangent.col(i) = difference(point_gradient<0>, pair, i, h);
      }
      gradient_best = std::min(gradient_best, (numeric - g).norm() / g.norm());
      tangent_best = std::min(tangent_best, (numeric_tangent - H).norm() / H.norm());
    }
    EXPECT_LT(gradient_best, 1e-7);
    EXPECT_LT(tangent_best, 1e-6);
  }
  EXPECT_GT(turning, 50);
}

}  // namespace articular::sim::contact_patch_derivatives_test
