#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "sim/wrap/wrapped_path.hpp"

/// Surfaces to wrap strings around.
namespace articular::sim::wrap_test {

constexpr double kPi = std::numbers::pi;

/// A surface with all that a string needs of it.
struct Shape {
  Positions X;
  Triangles triangles;
  WrapSurface surface;
  TriangleTree tree;
  Pose pose;

  Shape(const Positions& X_, const Triangles& triangles_)
      : X(X_), triangles(triangles_), surface(make_wrap_surface(triangles)), tree(X, triangles) {}
  PlacedSurface placed() const {
    const double size = (X.rowwise().maxCoeff() - X.rowwise().minCoeff()).norm();
    return {&surface, &tree, &X, pose, size};
  }
};

/// x(u, v) over the unit square in nu x nv cells, closed along u and, if so wished, along v.
inline Shape grid(int nu, int nv, bool closed_v, const std::function<Vec3(double, double)>& x) {
  const int rows = closed_v ? nv : nv + 1;
  Positions X(3, nu * rows);
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < nu; ++i) X.col(i + nu * j) = x(double(i) / nu, double(j) / nv);
  Triangles triangles(3, 2 * nu * nv);
  int f = 0;
  for (int j = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i) {
      const int right = (i + 1) % nu, up = nu * ((j + 1) % rows);
      const int a = i + nu * j, b = right + nu * j, c = right + up, d = i + up;
      if ((i + j) % 2 == 0) {
        triangles.col(f++) << a, b, c;
        triangles.col(f++) << a, c, d;
      } else {
        triangles.col(f++) << a, b, d;
        triangles.col(f++) << b, c, d;
      }
    }
  return {X, triangles};
}

/// About z, open at both ends.
inline Shape cylinder(int nu, int nv, double radius, double length) {
  return grid(nu, nv, false, [&](double u, double v) {
    const double angle = 2 * kPi * u;
    return Vec3(radius * std::cos(angle), radius * std::sin(angle), length * (v - 0.5));
  });
}

/// With the given half axes: a cube's surface of n x n cells a side, blown up. Convex if all axes
/// are the same.
inline Shape ellipsoid(int n, const Vec3& axes) {
  std::vector<Vec3> points;
  std::vector<Eigen::Vector3i> faces;
  const auto node = [&](const Vec3& x) {
    for (std::size_t i = 0; i < points.size(); ++i)
      if ((points[i] - x).norm() < 1e-9) return static_cast<int>(i);
    points.push_back(x);
    return static_cast<int>(points.size()) - 1;
  };
  for (int side = 0; side < 6; ++side)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const auto corner = [&](int di, int dj) {
          const double a = std::tan(kPi / 4 * (2.0 * (i + di) / n - 1));
          const double b = std::tan(kPi / 4 * (2.0 * (j + dj) / n - 1));
          Vec3 x;
          const int k = side / 2;
          x[k] = side % 2 == 0 ? 1 : -1;
          x[(k + 1) % 3] = side % 2 == 0 ? a : b;
          x[(k + 2) % 3] = side % 2 == 0 ? b : a;
          return node(x.normalized());
        };
        const int a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
        faces.emplace_back(a, b, c);
        faces.emplace_back(a, c, d);
      }
  Positions X(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    X.col(static_cast<Eigen::Index>(i)) = axes.cwiseProduct(points[i]);
  Triangles triangles(3, static_cast<Eigen::Index>(faces.size()));
  for (std::size_t i = 0; i < faces.size(); ++i)
    triangles.col(static_cast<Eigen::Index>(i)) = faces[i];
  return {X, triangles};
}

struct Wrapped {
  WrappedString string;
  WrapWork work;
  bool found = false;
  double length() const { return work.shape.length; }
};

inline void rewrap(const std::vector<PlacedSurface>& surfaces, Wrapped& w) {
  w.found = wrap(surfaces, w.string, w.work);
}

inline Wrapped wrapped(const std::vector<PlacedSurface>& surfaces, const Vec3& from,
                       const Vec3& to) {
  Wrapped w;
  w.string.from.x = from;
  w.string.to.x = to;
  rewrap(surfaces, w);
  return w;
}

/// Around an endless cylinder about z.
inline double around_cylinder(const Vec3& p, const Vec3& q, double radius) {
  const double rp = p.head<2>().norm(), rq = q.head<2>().norm();
  const double turn = std::acos(p.head<2>().dot(q.head<2>()) / (rp * rq));
  const double arc = turn - std::acos(radius / rp) - std::acos(radius / rq);
  const double flat =
      std::sqrt(rp * rp - radius * radius) + std::sqrt(rq * rq - radius * radius) + radius * arc;
  return std::hypot(flat, q.z() - p.z());
}

}  // namespace articular::sim::wrap_test
