#include "fem/mesh/fibre_field.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <cstdio>
#include <functional>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/fem/support/box_mesh.hpp"

namespace articular::fem::fibre_field_test {

constexpr double kPi = std::numbers::pi;

std::vector<int> nodes_where(const Positions& X, const std::function<bool(const Vec3&)>& is) {
  std::vector<int> nodes;
  for (int a = 0; a < X.cols(); ++a) {
    if (is(X.col(a))) nodes.push_back(a);
  }
  return nodes;
}

// A uniform field is one that linear elements hold exactly, on any mesh.
TEST(HarmonicFibres, RunStraightThroughABar) {
  const TetMesh mesh = box_mesh({6, 3, 3}, Vec3(0.06, 0.02, 0.01), 0.15);
  const auto from = nodes_where(mesh.X, [](const Vec3& X) { return X.x() < 1e-9; });
  const auto to = nodes_where(mesh.X, [](const Vec3& X) { return X.x() > 0.06 - 1e-9; });
  const FibreDirections fibres = harmonic_fibres(mesh.X, mesh.tets, from, to);
  EXPECT_LT((fibres.colwise() - Vec3(1, 0, 0)).colwise().norm().maxCoeff(), 1e-11);
  const Eigen::VectorXd potential = harmonic_potential(mesh.X, mesh.tets, from, to);
  EXPECT_LT((potential - mesh.X.row(0).transpose() / 0.06).cwiseAbs().maxCoeff(), 1e-12);
  const FibreDirections back = harmonic_fibres(mesh.X, mesh.tets, to, from);
  EXPECT_LT((fibres + back).norm(), 1e-9);
}

TEST(ConservedFibres, OfABarAreThoseOfTheHarmonicField) {
  const TetMesh mesh = box_mesh({6, 3, 3}, Vec3(0.06, 0.02, 0.01), 0.15);
  const auto from = nodes_where(mesh.X, [](const Vec3& X) { return X.x() < 1e-9; });
  const auto to = nodes_where(mesh.X, [](const Vec3& X) { return X.x() > 0.06 - 1e-9; });
  const FibreDirections fibres = conserved_fibres(mesh.X, mesh.tets, from, to);
  EXPECT_LT((fibres.colwise() - Vec3(1, 0, 0)).colwise().norm().maxCoeff(), 1e-10);
}

Vec3 gradient_of(const Eigen::VectorXd& values, const TetMesh& mesh, Eigen::Index e) {
  Mat3 edges;
  Vec3 rise;
  for (int a = 0; a < 3; ++a) {
    edges.row(a) = mesh.X.col(mesh.tets(a + 1, e)) - mesh.X.col(mesh.tets(0, e));
    rise[a] = values[mesh.tets(a + 1, e)] - values[mesh.tets(0, e)];
  }
  return edges.inverse() * rise;
}

// A wedge that narrows to a third: what passes through it is the same everywhere, which linear
// elements hold exactly against any of their fields that is 0 at one end and 1 at the other.
TEST(ConservedFibres, AreDenserWhereTissueNarrows) {
  TetMesh mesh = box_mesh({12, 4, 2}, Vec3(0.06, 0.02, 0.01));
  for (auto X : mesh.X.colwise()) X.y() = (X.y() - 0.01) * (1 - X.x() / 0.09);
  const auto from = nodes_where(mesh.X, [](const Vec3& X) { return X.x() < 1e-9; });
  const auto to = nodes_where(mesh.X, [](const Vec3& X) { return X.x() > 0.06 - 1e-9; });
  const FibreDirections fibres = conserved_fibres(mesh.X, mesh.tets, from, to);
  const Eigen::VectorXd potential = harmonic_potential(mesh.X, mesh.tets, from, to);
  double volume = 0, whole = 0, along_x = 0, along_phi = 0, wide = 0, narrow = 0, wide_volume = 0,
         narrow_volume = 0;
  for (Eigen::Index e = 0; e < mesh.tets.cols(); ++e) {
    const Eigen::Vector4i tet = mesh.tets.col(e);
    const Vec3 x0 = mesh.X.col(tet[0]);
    const double V =
        (mesh.X.col(tet[1]) - x0).cross(mesh.X.col(tet[2]) - x0).dot(mesh.X.col(tet[3]) - x0) / 6;
    const double density = fibres.col(e).norm();
    volume += V;
    whole += V * density;
    along_x += V * fibres(0, e) / 0.06;
    along_phi += V * fibres.col(e).dot(gradient_of(potential, mesh, e));
    const double x = mesh.X.row(0)(tet).mean();
    (x < 0.01 ? wide : narrow) += x < 0.01 || x > 0.05 ? V * density : 0;
    (x < 0.01 ? wide_volume : narrow_volume) += x < 0.01 || x > 0.05 ? V : 0;
  }
  EXPECT_NEAR(whole / volume, 1, 1e-12);
  EXPECT_NEAR(along_phi / along_x, 1, 1e-10);
  // Widths at 5 and 55 mm, 1 - 5/90 and 1 - 55/90.
  EXPECT_NEAR((narrow / narrow_volume) / (wide / wide_volume), 85.0 / 35, 0.03 * 85 / 35);
}

/// A box in curved coordinates.
struct Mapped {
  TetMesh mesh;
  Positions coordinates;
};
Mapped mapped(int cells, const Vec3& low, const Vec3& high, Vec3 (*map)(const Vec3&)) {
  TetMesh mesh = box_mesh({2 * cells, 2 * cells, cells}, high - low);
  mesh.X.colwise() += low;
  const Positions coordinates = mesh.X;
  for (Eigen::Index a = 0; a < mesh.X.cols(); ++a) mesh.X.col(a) = map(coordinates.col(a));
  return {mesh, coordinates};
}

/// Mean angle [rad] between fibres and their closed form at the centroids, and root of the mean
/// square error of the potential.
struct Errors {
  double angle, potential;
};
Errors errors(const Mapped& body, int axis, const Vec3& low, const Vec3& high,
              const std::function<Vec3(const Vec3&)>& direction,
              const std::function<double(const Vec3&)>& potential) {
  std::vector<int> from, to;
  for (int a = 0; a < body.coordinates.cols(); ++a) {
    if (body.coordinates(axis, a) < low[axis] + 1e-9) from.push_back(a);
    if (body.coordinates(axis, a) > high[axis] - 1e-9) to.push_back(a);
  }
  const auto& [X, tets] = body.mesh;
  const FibreDirections fibres = harmonic_fibres(X, tets, from, to);
  const Eigen::VectorXd phi = harmonic_potential(X, tets, from, to);
  Errors result{0, 0};
  for (Eigen::Index e = 0; e < tets.cols(); ++e) {
    const Vec3 centroid =
        (X.col(tets(0, e)) + X.col(tets(1, e)) + X.col(tets(2, e)) + X.col(tets(3, e))) / 4;
    const Vec3 exact = direction(centroid), fibre = fibres.col(e);
    EXPECT_NEAR(fibre.norm(), 1, 1e-12);
    const double angle = std::atan2(exact.cross(fibre).norm(), exact.dot(fibre));
    result.angle += angle / static_cast<double>(tets.cols());
  }
  for (Eigen::Index a = 0; a < X.cols(); ++a) {
    result.potential += std::pow(phi[a] - potential(X.col(a)), 2);
  }
  result.potential = std::sqrt(result.potential / static_cast<double>(X.cols()));
  return result;
}

void expect_convergence(const char* name, int axis, const Vec3& low, const Vec3& high,
                        Vec3 (*map)(const Vec3&), const std::function<Vec3(const Vec3&)>& direction,
                        const std::function<double(const Vec3&)>& potential) {
  Errors e[3];
  for (int k = 0; k < 3; ++k) {
    e[k] = errors(mapped(2 << k, low, high, map), axis, low, high, direction, potential);
    std::printf("%s: mean angle %.2e rad, potential %.2e\n", name, e[k].angle, e[k].potential);
  }
  EXPECT_LT(e[2].angle, 0.05);
  EXPECT_GT(std::log2(e[1].angle / e[2].angle), 0.9);          // gradients of linear elements: O(h)
  EXPECT_GT(std::log2(e[1].potential / e[2].potential), 1.7);  // their values: O(h²)
}

// A quarter of a ring, r from 1 to 2: coordinates (r, angle, z).
Vec3 ring(const Vec3& c) { return {c[0] * std::cos(c[1]), c[0] * std::sin(c[1]), c[2]}; }
const Vec3 kRingLow(1, 0, 0), kRingHigh(2, kPi / 2, 0.5);

TEST(HarmonicFibres, RunAroundARing) {
  expect_convergence(
      "around a ring", 1, kRingLow, kRingHigh, ring,
      [](const Vec3& X) { return Vec3(-X.y(), X.x(), 0).normalized(); },
      [](const Vec3& X) { return std::atan2(X.y(), X.x()) / (kPi / 2); });
}

TEST(HarmonicFibres, RunAcrossARing) {
  expect_convergence(
      "across a ring", 0, kRingLow, kRingHigh, ring,
      [](const Vec3& X) { return Vec3(X.x(), X.y(), 0).normalized(); },
      [](const Vec3& X) { return std::log(std::hypot(X.x(), X.y())) / std::log(2.0); });
}

// A cone of square section cut by spheres of radius 1 and 3: coordinates (r, two slopes). The field
// is that of a point, φ = (1 − 1/r)/(1 − 1/3).
Vec3 cone(const Vec3& c) { return c[0] * Vec3(1, c[1], c[2]).normalized(); }

TEST(HarmonicFibres, FanOutInACone) {
  expect_convergence(
      "in a cone", 0, Vec3(1, -0.4, -0.4), Vec3(3, 0.4, 0.4), cone,
      [](const Vec3& X) { return Vec3(X.normalized()); },
      [](const Vec3& X) { return (1 - 1 / X.norm()) * 1.5; });
}

void expect_refusal(const std::function<void()>& make, std::initializer_list<const char*> parts) {
  std::string message;
  try {
    make();
  } catch (const std::invalid_argument& error) {
    message = error.what();
  }
  EXPECT_NE(message, "");
  for (const char* part : parts) EXPECT_NE(message.find(part), std::string::npos) << message;
}

TEST(HarmonicFibres, RefuseWhatHasNoField) {
  const TetMesh bar = box_mesh({4, 1, 1}, Vec3(4, 1, 1));
  const auto end = [&bar](double x) {
    return nodes_where(bar.X, [x](const Vec3& X) { return std::abs(X.x() - x) < 1e-9; });
  };
  const std::vector<int> from = end(0), to = end(4), none;
  const auto run = [&bar](const std::vector<int>& a, const std::vector<int>& b) {
    return [&bar, a, b] { (void)harmonic_fibres(bar.X, bar.tets, a, b); };
  };
  expect_refusal(run(from, none), {"tetrahedron 0", "second"});
  expect_refusal(run(none, to), {"tetrahedron 0", "first"});
  expect_refusal(run(from, from), {"node 0", "both"});
  expect_refusal(run({-1}, to), {"node -1", "out of range"});
  expect_refusal(run({20}, to), {"node 20", "out of range"});

  // Beyond the node set the bar is a dead end: φ = 1 throughout, no direction.
  expect_refusal(run(from, end(3)), {"gradient", "vanishes", "tetrahedron 18"});

  // A second bar that is held by nothing.
  TetMesh two = bar;
  two.X.conservativeResize(3, 2 * bar.X.cols());
  two.X.rightCols(bar.X.cols()) = bar.X.colwise() + Vec3(0, 5, 0);
  two.tets.conservativeResize(4, 2 * bar.tets.cols());
  two.tets.rightCols(bar.tets.cols()) = bar.tets.array() + static_cast<int>(bar.X.cols());
  expect_refusal([&] { (void)harmonic_fibres(two.X, two.tets, from, to); },
                 {"tetrahedron 24", "first"});

  TetMesh inverted = bar;
  inverted.tets.col(7).reverseInPlace();
  inverted.tets.col(7).head<2>().reverseInPlace();
  inverted.tets.col(7).tail<2>().reverseInPlace();
  std::swap(inverted.tets(0, 7), inverted.tets(1, 7));
  expect_refusal([&] { (void)harmonic_fibres(inverted.X, inverted.tets, from, to); },
                 {"tetrahedron 7", "volume", "positive"});
}

// A node that no element uses does not disturb the others.
TEST(HarmonicFibres, LeaveUnusedNodesAlone) {
  TetMesh bar = box_mesh({2, 1, 1}, Vec3(2, 1, 1));
  const auto from = nodes_where(bar.X, [](const Vec3& X) { return X.x() < 1e-9; });
  const auto to = nodes_where(bar.X, [](const Vec3& X) { return X.x() > 2 - 1e-9; });
  bar.X.conservativeResize(3, bar.X.cols() + 1);
  bar.X.rightCols<1>() << 1, 3, 1;
  const FibreDirections fibres = harmonic_fibres(bar.X, bar.tets, from, to);
  EXPECT_LT((fibres.colwise() - Vec3(1, 0, 0)).norm(), 1e-11);
}

/// On planes at the two ends of a bar along x.
std::vector<bool> held_ends(const TetMesh& mesh, bool both) {
  const double length = mesh.X.row(0).maxCoeff();
  std::vector<bool> held;
  for (const double x : mesh.X.row(0)) held.push_back(x < 1e-9 || (both && x > length - 1e-9));
  return held;
}

TEST(LooseFlux, OfStraightFibresIsWhatLeavesAnEndThatIsNotHeld) {
  const TetMesh bar = box_mesh({6, 3, 3}, Vec3(0.06, 0.02, 0.01), 0.15);
  const FibreDirections fibres = constant_fibres(Vec3::UnitX(), bar.tets.cols());
  EXPECT_LT(loose_flux(bar.X, bar.tets, fibres, held_ends(bar, true)), 1e-12);
  EXPECT_NEAR(loose_flux(bar.X, bar.tets, fibres, held_ends(bar, false)), 1, 1e-12);
  EXPECT_NEAR(loose_flux(bar.X, bar.tets, 3 * fibres, held_ends(bar, false)), 1, 1e-12);
}

// Of a field whose potential solves the same equations nothing is loose, by round-off; of one whose
// fibres are everywhere as dense what the narrowing cuts off is.
TEST(LooseFlux, IsNoneWhereFibresAreConservedOnTheirMesh) {
  TetMesh mesh = box_mesh({12, 4, 2}, Vec3(0.06, 0.02, 0.01));
  for (Eigen::Index i = 0; i < mesh.X.cols(); ++i) mesh.X(1, i) *= 1 - 10 * mesh.X(0, i);
  const std::vector<bool> held = held_ends(mesh, true);
  std::vector<int> from, to;
  for (int i = 0; i < static_cast<int>(held.size()); ++i)
    if (held[static_cast<std::size_t>(i)]) (mesh.X(0, i) < 0.03 ? from : to).push_back(i);
  const FibreDirections conserved = conserved_fibres(mesh.X, mesh.tets, from, to);
  EXPECT_LT(loose_flux(mesh.X, mesh.tets, conserved, held), 1e-12);
  const FibreDirections even = conserved.colwise().normalized();
  EXPECT_GT(loose_flux(mesh.X, mesh.tets, even, held), 0.3);
}

TEST(Fibres, MoveWithTheTissueAndKeepLengthOne) {
  const TetMesh mesh = box_mesh({2, 2, 2}, Vec3(0.02, 0.02, 0.02));
  const FibreDirections fibres = constant_fibres(Vec3(3, 4, 0), mesh.tets.cols());
  Mat3 F;
  F << 1.2, 0.3, 0, 0, 0.9, 0.1, 0.2, 0, 1.1;
  const FibreDirections moved =
      moved_fibres(mesh.X, mesh.tets, fibres, (F * mesh.X).colwise() + Vec3(1, 2, 3));
  const Vec3 expected = (F * Vec3(0.6, 0.8, 0)).normalized();
  EXPECT_LT((moved.colwise() - expected).norm(), 1e-11);
}

TEST(Fibres, AreNormalizedAndCheckedWhereTheyAreGiven) {
  EXPECT_LT((constant_fibres(Vec3(0, 3, 4), 5).colwise() - Vec3(0, 0.6, 0.8)).norm(), 1e-15);
  EXPECT_EQ(constant_fibres(Vec3(0, 3, 4), 5).cols(), 5);
  Eigen::Matrix3Xd directions(3, 3);
  directions << 2, 0, 1, 0, -5, 1, 0, 0, 1;
  const FibreDirections fibres = normalized_fibres(directions);
  EXPECT_EQ(Vec3(fibres.col(0)), Vec3(1, 0, 0));
  EXPECT_EQ(Vec3(fibres.col(1)), Vec3(0, -1, 0));
  EXPECT_LT((fibres.col(2) - Vec3::Constant(std::sqrt(1.0 / 3))).norm(), 1e-15);

  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = 1 / 0.0;
  for (const Vec3& bad : {Vec3(0, 0, 0), Vec3(1, nan, 0), Vec3(inf, 0, 0)}) {
    expect_refusal([&] { (void)constant_fibres(bad, 2); }, {"direction", "not 0"});
    directions.col(1) = bad;
    expect_refusal([&] { (void)normalized_fibres(directions); }, {"tetrahedron 1", "not 0"});
  }
}

}  // namespace articular::fem::fibre_field_test
