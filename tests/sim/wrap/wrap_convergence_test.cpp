#include <gtest/gtest.h>

#include "tests/sim/wrap/wrap_shapes.hpp"

// Lengths over smooth surfaces. A mesh with nodes on the surface lies h²/8R below it, so that the
// length converges with the order 2.
namespace articular::sim::wrap_test {
namespace {

void expect_second_order(const std::vector<double>& errors, double least_order) {
  for (std::size_t i = 1; i < errors.size(); ++i) EXPECT_LT(errors[i], errors[i - 1]);
  const double order =
      std::log2(errors.front() / errors.back()) / static_cast<double>(errors.size() - 1);
  EXPECT_GT(order, least_order);
}

/// A smooth surface x(u, v), and φ < 0 inside.
struct Smooth {
  std::function<Vec3(double, double)> x;
  std::function<Vec3(const Vec3&)> gradient;
  std::function<Mat3(const Vec3&)> hessian;
};

struct Ray {
  Vec3 x, d;
};

/// A geodesic: x″ = −(x′ᵀ ∂²φ x′)/|∇φ|² ∇φ, one step of Runge and Kutta's method.
Ray geodesic_step(const Smooth& s, const Ray& r, double h) {
  const auto bend = [&](const Vec3& x, const Vec3& d) -> Vec3 {
    const Vec3 g = s.gradient(x);
    return -d.dot(s.hessian(x) * d) / g.squaredNorm() * g;
  };
  const Vec3 k1 = bend(r.x, r.d), d2 = r.d + 0.5 * h * k1;
  const Vec3 k2 = bend(r.x + 0.5 * h * r.d, d2), d3 = r.d + 0.5 * h * k2;
  const Vec3 k3 = bend(r.x + 0.5 * h * d2, d3), d4 = r.d + h * k3;
  const Vec3 k4 = bend(r.x + h * d3, d4);
  return {r.x + h / 6 * (r.d + 2 * d2 + 2 * d3 + d4), r.d + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)};
}

/// From p along the tangent that touches at (u, v(u)), on along the geodesic to where its tangent
/// plane holds q. @return how far it passes q to the side, and the length with the way to q
std::pair<double, double> shoot(const Smooth& s, const Vec3& p, const Vec3& q, double u, double v0,
                                double v1) {
  const auto faces = [&](double v) { return s.gradient(s.x(u, v)).dot(s.x(u, v) - p); };
  for (int k = 0; k < 60; ++k) (faces(0.5 * (v0 + v1)) * faces(v0) > 0 ? v0 : v1) = 0.5 * (v0 + v1);
  Ray r{s.x(u, v0), (s.x(u, v0) - p).normalized()};
  double length = (r.x - p).norm();
  const auto below = [&](const Ray& at) { return s.gradient(at.x).dot(q - at.x); };
  double h = 2e-5;
  for (int k = 0; k < 100000 && h > 1e-14; ++k) {
    const Ray next = geodesic_step(s, r, h);
    if (below(next) > 0) {
      h *= 0.5;
      continue;
    }
    r = next;
    length += h;
  }
  const Vec3 side = s.gradient(r.x).normalized().cross(r.d);
  return {side.dot(q - r.x), length + (q - r.x).norm()};
}

double reference(const Smooth& s, const Vec3& p, const Vec3& q, double u0, double u1, double v0,
                 double v1) {
  double low = shoot(s, p, q, u0, v0, v1).first;
  EXPECT_LT(low * shoot(s, p, q, u1, v0, v1).first, 0);
  for (int k = 0; k < 40; ++k) {
    const double u = 0.5 * (u0 + u1), side = shoot(s, p, q, u, v0, v1).first;
    if (side * low > 0) {
      u0 = u;
      low = side;
    } else {
      u1 = u;
    }
  }
  return shoot(s, p, q, u0, v0, v1).second;
}

TEST(WrapConvergence, ACylinderStraightAndObliqueHasTheClosedForm) {
  const Vec3 p(-0.05, 0.011, -0.03);
  for (const double z : {-0.03, 0.041}) {
    const Vec3 q(0.043, -0.005, z);
    std::vector<double> errors;
    for (const int n : {16, 32, 64, 128}) {
      const Wrapped w = wrapped({cylinder(n, n / 2, 0.02, 0.2).placed()}, p, q);
      EXPECT_TRUE(w.found);
      errors.push_back(std::abs(w.length() - around_cylinder(p, q, 0.02)));
    }
    EXPECT_LT(errors.back(), 2e-6);
    expect_second_order(errors, 1.8);
  }
}

TEST(WrapConvergence, ASphereHasTangentsAndAGreatCircle) {
  const Vec3 p(-0.05, 0.012, 0.017), q(0.045, 0.021, -0.004);
  const double R = 0.03;
  const double arc = std::acos(p.normalized().dot(q.normalized())) - std::acos(R / p.norm()) -
                     std::acos(R / q.norm());
  const double exact =
      std::sqrt(p.squaredNorm() - R * R) + std::sqrt(q.squaredNorm() - R * R) + R * arc;
  std::vector<double> errors;
  for (const int n : {8, 16, 32}) {
    const Wrapped w = wrapped({ellipsoid(n, Vec3::Constant(R)).placed()}, p, q);
    EXPECT_TRUE(w.found);
    errors.push_back(std::abs(w.length() - exact));
  }
  EXPECT_LT(errors.back(), 1e-5);
  expect_second_order(errors, 1.8);
}

TEST(WrapConvergence, AnEllipsoidHasAnIntegratedGeodesic) {
  const Vec3 axes(0.03, 0.02, 0.014), p(-0.05, 0.004, 0.006), q(0.045, 0.009, 0.002);
  const Vec3 inverse = axes.array().square().inverse();
  Smooth s;
  s.x = [&](double u, double v) {
    const double a = 2 * kPi * u, b = kPi * v;
    return Vec3(axes.x() * std::cos(b), axes.y() * std::sin(b) * std::cos(a),
                axes.z() * std::sin(b) * std::sin(a));
  };
  s.gradient = [&](const Vec3& x) -> Vec3 { return 2 * inverse.cwiseProduct(x); };
  s.hessian = [&](const Vec3&) -> Mat3 { return 2 * Mat3(inverse.asDiagonal()); };
  const double exact = reference(s, p, q, 0.05, 0.3, 0, 1);
  std::vector<double> errors;
  for (const int n : {8, 16, 32}) {
    const Wrapped w = wrapped({ellipsoid(n, axes).placed()}, p, q);
    EXPECT_TRUE(w.found);
    errors.push_back(std::abs(w.length() - exact));
  }
  EXPECT_LT(errors.back(), 1e-5);
  expect_second_order(errors, 1.7);
}

TEST(WrapConvergence, ATorusHasAnIntegratedGeodesic) {
  const double R = 0.03, r = 0.01;
  const auto x = [&](double u, double v) {
    const double a = 2 * kPi * u, c = R + r * std::cos(2 * kPi * v);
    return Vec3(c * std::cos(a), c * std::sin(a), r * std::sin(2 * kPi * v));
  };
  Smooth s;
  s.x = x;
  // φ = (ρ − R)² + z² − r², ρ² = x² + y².
  s.gradient = [&](const Vec3& y) -> Vec3 {
    const double rho = y.head<2>().norm();
    return 2 * Vec3((1 - R / rho) * y.x(), (1 - R / rho) * y.y(), y.z());
  };
  s.hessian = [&](const Vec3& y) -> Mat3 {
    const double rho = y.head<2>().norm();
    Mat3 H = Mat3::Zero();
    H.topLeftCorner<2, 2>() = 2 * (1 - R / rho) * Eigen::Matrix2d::Identity() +
                              2 * R / (rho * rho * rho) * y.head<2>() * y.head<2>().transpose();
    H(2, 2) = 2;
    return H;
  };
  // Around the outside of the tube, from below to above.
  const Vec3 p(0.034, 0.004, -0.03), q(0.033, -0.005, 0.035);
  const double exact = reference(s, p, q, -0.06, 0.08, -0.25, 0.1);
  std::vector<double> errors;
  for (const int n : {16, 32, 64, 128}) {
    const Wrapped w = wrapped({grid(2 * n, n, true, x).placed()}, p, q);
    EXPECT_TRUE(w.found);
    errors.push_back(std::abs(w.length() - exact));
  }
  EXPECT_LT(errors.back(), 1e-5);
  expect_second_order(errors, 1.7);
}

}  // namespace
}  // namespace articular::sim::wrap_test
