#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

/// Whether shapes meet, without round-off and without axes: corners are read as the integers that
/// doubles are in units of a small enough power of two. And their distance to 100 digits.
namespace articular::collision::testing::exact {

using Integer = boost::multiprecision::cpp_int;
using Rational = boost::multiprecision::cpp_rational;
using Real = boost::multiprecision::cpp_bin_float_100;

template <class Number>
using Point = std::array<Number, 3>;
template <class Number>
using Points = std::vector<Point<Number>>;

template <class Number>
Point<Number> operator-(const Point<Number>& a, const Point<Number>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

template <class Number>
Point<Number> cross(const Point<Number>& a, const Point<Number>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <class Number>
Number dot(const Point<Number>& a, const Point<Number>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class Number>
bool is_zero(const Point<Number>& a) {
  return a[0] == 0 && a[1] == 0 && a[2] == 0;
}

/// A pair in a common integer unit.
struct Pair {
  Points<Integer> triangle, tetrahedron;
};

inline Pair integer_pair(const Eigen::Matrix3d& triangle,
                         const Eigen::Matrix<double, 3, 4>& tetrahedron) {
  constexpr int kDigits = std::numeric_limits<double>::digits;
  int least = std::numeric_limits<int>::max();  // exponent of all coordinates' last bits
  const auto look = [&](double x) {
    int exponent = 0;
    std::frexp(x, &exponent);
    if (x != 0) least = std::min(least, exponent - kDigits);
  };
  for (const double x : triangle.reshaped()) look(x);
  for (const double x : tetrahedron.reshaped()) look(x);
  const auto integer = [&](double x) {
    int exponent = 0;
    const double mantissa = std::frexp(x, &exponent);
    if (x == 0) return Integer(0);
    return Integer(static_cast<std::int64_t>(std::ldexp(mantissa, kDigits)))
           << (exponent - kDigits - least);
  };
  Pair pair;
  for (const auto& p : triangle.colwise())
    pair.triangle.push_back({integer(p[0]), integer(p[1]), integer(p[2])});
  for (const auto& p : tetrahedron.colwise())
    pair.tetrahedron.push_back({integer(p[0]), integer(p[1]), integer(p[2])});
  return pair;
}

inline Integer volume(const Points<Integer>& w) {
  return dot(w[1] - w[0], cross(w[2] - w[0], w[3] - w[0]));
}

/// Part of a convex polygon (its corners in order; a segment or a point as well) on the side
/// (p - origin)·normal ≥ 0, as Sutherland and Hodgman clip it.
inline Points<Rational> clipped(const Points<Rational>& polygon, const Point<Rational>& origin,
                                const Point<Rational>& normal) {
  Points<Rational> kept;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Point<Rational>&a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    const Rational height_a = dot(a - origin, normal), height_b = dot(b - origin, normal);
    if (height_a >= 0) kept.push_back(a);
    if ((height_a > 0 && height_b < 0) || (height_a < 0 && height_b > 0)) {
      const Rational s = height_a / (height_a - height_b);
      kept.push_back(
          {a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1]), a[2] + s * (b[2] - a[2])});
    }
  }
  return kept;
}

/// For a tetrahedron with volume: whether clipping by its faces leaves anything of the triangle.
inline bool clipping_leaves_something(const Pair& pair) {
  const auto rational = [](const Point<Integer>& p) {
    return Point<Rational>{Rational(p[0]), Rational(p[1]), Rational(p[2])};
  };
  const Points<Integer>& w = pair.tetrahedron;
  Points<Rational> polygon;
  for (const Point<Integer>& p : pair.triangle) polygon.push_back(rational(p));
  for (std::size_t k = 0; k < 4; ++k) {
    const Point<Integer>&a = w[(k + 1) % 4], &b = w[(k + 2) % 4], &c = w[(k + 3) % 4];
    Point<Integer> inward = cross(b - a, c - a);
    if (dot(inward, w[k] - a) < 0)
      for (Integer& x : inward) x = -x;
    polygon = clipped(polygon, rational(a), rational(inward));
  }
  return !polygon.empty();
}

/// Whether the origin is in the simplex of the given 1 to 4 corners; false also for corners that
/// are affinely dependent.
inline bool holds_origin(const Points<Integer>& p) {
  const Point<Integer> zero = {0, 0, 0};
  const auto same_side = [](const Integer& part, const Integer& whole) {
    return part == 0 || (part > 0) == (whole > 0);
  };
  if (p.size() == 1) return is_zero(p[0]);
  if (p.size() == 2) return p[0] != p[1] && is_zero(cross(p[0], p[1])) && dot(p[0], p[1]) <= 0;
  if (p.size() == 3) {
    const Point<Integer> normal = cross(p[1] - p[0], p[2] - p[0]);
    if (is_zero(normal) || dot(normal, p[0]) != 0) return false;
    for (std::size_t k = 0; k < 3; ++k)
      if (dot(normal, cross(p[k], p[(k + 1) % 3])) < 0) return false;
    return true;
  }
  const Integer whole = volume(p);
  if (whole == 0) return false;
  for (std::size_t k = 0; k < 4; ++k) {
    Points<Integer> with_origin = p;
    with_origin[k] = zero;
    if (!same_side(volume(with_origin), whole)) return false;
  }
  return true;
}

/// For any shapes: they meet if the origin is in the convex hull of all differences of corners, and
/// then [Carathéodory] in the simplex of at most four of these that are affinely independent.
inline bool differences_surround_origin(const Pair& pair) {
  Points<Integer> differences;
  for (const Point<Integer>& t : pair.triangle)
    for (const Point<Integer>& w : pair.tetrahedron) {
      const Point<Integer> difference = t - w;
      if (std::find(differences.begin(), differences.end(), difference) == differences.end())
        differences.push_back(difference);
    }
  const unsigned num_subsets = 1U << differences.size();
  for (unsigned subset = 1; subset < num_subsets; ++subset) {
    Points<Integer> simplex;
    for (std::size_t k = 0; k < differences.size() && simplex.size() <= 4; ++k)
      if ((subset >> k) & 1U) simplex.push_back(differences[k]);
    if (simplex.size() <= 4 && holds_origin(simplex)) return true;
  }
  return false;
}

/// Whether the closed sets have a point in common.
inline bool overlap(const Eigen::Matrix3d& triangle,
                    const Eigen::Matrix<double, 3, 4>& tetrahedron) {
  const Pair pair = integer_pair(triangle, tetrahedron);
  return volume(pair.tetrahedron) != 0 ? clipping_leaves_something(pair)
                                       : differences_surround_origin(pair);
}

inline Real point_segment2(const Point<Real>& p, const Point<Real>& a, const Point<Real>& b) {
  const Point<Real> u = b - a, d = p - a;
  const Real length2 = dot(u, u);
  const Real s = length2 > 0 ? std::clamp(Real(dot(d, u) / length2), Real(0), Real(1)) : Real(0);
  const Point<Real> gap = {d[0] - s * u[0], d[1] - s * u[1], d[2] - s * u[2]};
  return dot(gap, gap);
}

/// Squared height of p over the triangle, if it is over its inside; otherwise its edges are nearer.
inline Real point_face2(const Point<Real>& p, const Point<Real>& a, const Point<Real>& b,
                        const Point<Real>& c, const Real& otherwise) {
  const Point<Real> normal = cross(b - a, c - a);
  const Real area2 = dot(normal, normal);
  if (!(area2 > 0)) return otherwise;
  if (dot(normal, cross(b - a, p - a)) < 0 || dot(normal, cross(c - b, p - b)) < 0 ||
      dot(normal, cross(a - c, p - c)) < 0)
    return otherwise;
  const Real height = dot(normal, p - a);
  return height * height / area2;
}

inline Real segment_segment2(const Point<Real>& a0, const Point<Real>& a1, const Point<Real>& b0,
                             const Point<Real>& b1) {
  Real ends = std::min({point_segment2(a0, b0, b1), point_segment2(a1, b0, b1),
                        point_segment2(b0, a0, a1), point_segment2(b1, a0, a1)});
  const Point<Real> u = a1 - a0, v = b1 - b0, n = cross(u, v), d = b0 - a0;
  const Real n2 = dot(n, n);
  if (!(n2 > 0)) return ends;
  const Real s = dot(cross(d, v), n), t = dot(cross(d, u), n);
  if (s < 0 || s > n2 || t < 0 || t > n2) return ends;
  const Real height = dot(d, n);
  return std::min(ends, Real(height * height / n2));
}

/// Distance [m] of shapes that do not meet: the least of corner to face and edge to edge. Its
/// error, some 1e-90 of the pair's size, is far below all that the tests look at.
inline double distance(const Eigen::Matrix3d& triangle,
                       const Eigen::Matrix<double, 3, 4>& tetrahedron) {
  Points<Real> t, w;
  for (const auto& p : triangle.colwise()) t.push_back({Real(p[0]), Real(p[1]), Real(p[2])});
  for (const auto& p : tetrahedron.colwise()) w.push_back({Real(p[0]), Real(p[1]), Real(p[2])});
  Real least = std::numeric_limits<Real>::max();
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = a + 1; b < 4; ++b)
        least = std::min(least, segment_segment2(t[i], t[(i + 1) % 3], w[a], w[b]));
  for (std::size_t k = 0; k < 4; ++k) {
    least = std::min(least, point_face2(w[k], t[0], t[1], t[2], least));
    for (std::size_t i = 0; i < 3; ++i)
      least =
          std::min(least, point_face2(t[i], w[(k + 1) % 4], w[(k + 2) % 4], w[(k + 3) % 4], least));
  }
  return static_cast<double>(sqrt(least));
}

}  // namespace articular::collision::testing::exact
