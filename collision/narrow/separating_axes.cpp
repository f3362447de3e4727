// Two stages. A filter evaluates the usual axes in barycentric coordinates of the tetrahedron, with
// bounds of its own round-off: where these leave no doubt, and that is nearly always, its verdict
// is that of exact arithmetic. What is left, touching shapes and slivers, goes to all axes on which
// two nearest points can lie, in coordinates rounded to integers.
#include "collision/narrow/separating_axes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>

namespace articular::collision {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Tetrahedron = Eigen::Matrix<double, 3, 4>;

enum class Verdict { Apart, Overlapping, Unknown };

/// One value for each edge of the tetrahedron: 01, 02, 03, 12, 13, 23.
using PerEdge = Eigen::Array<double, 6, 1>;
constexpr std::array<std::array<int, 2>, 6> kOppositeEdges = {
    {{2, 3}, {1, 3}, {1, 2}, {0, 3}, {0, 2}, {0, 1}}};

// Bounds of round-off in the filter, from u = 2⁻⁵³ an operation. With s, s_w the largest coordinate
// of the pair and of the tetrahedron relative to node 0: a component of a normal (≤ 2 s_w²) is off
// by ≤ 8u s_w², a height (≤ 6 s_w² s) by ≤ 48u s_w² s, the one over face 0, the volume less three
// heights, by ≤ 264u s_w² s; we take 2⁻⁴⁴ = 512u. Two products of a height (≤ 24 s_w² s) and a
// difference of heights (≤ 48 s_w² s, off by ≤ 550u s_w² s) are then off by ≤ 56 400u (s_w² s)²; we
// take 2⁻³⁷ = 2¹⁶ u. What is left covers the margin times the length of an axis (off by ≤ 42u s_w²)
// up to margins of 6 s; no gap is larger than 3.5 s.
constexpr double kHeightRoundOff = 0x1p-44;
constexpr double kProductRoundOff = 0x1p-37;

// The bounds above are relative: they hold while no product leaves the range of numbers. Sizes in
// this range have sixth powers of 1e-180 to 1e180; others are scaled. The last bound, a part of the
// size's third power, is for one shape much smaller: its square times 1e-180 is in range as well.
constexpr double kSmallest = 1e-30, kLargest = 1e30, kSmallestProduct = 1e-35;

/// The tetrahedron relative to its node 0, and the triangle as its barycentric coordinates tell.
struct Heights {
  double volume;  // six times that of the tetrahedron, ≥ 0 [m³]
  // Row k, column i: corner i of the triangle over face k, which is its barycentric coordinate k
  // times the volume.
  Eigen::Array<double, 4, 3> over;
  Eigen::Matrix<double, 4, 3> normals;  // rows: inward, of twice the face's area [m²]
};

Heights heights(const Matrix3d& triangle, const Matrix3d& edges) {
  const Vector3d n1 = edges.col(1).cross(edges.col(2)), n2 = edges.col(2).cross(edges.col(0)),
                 n3 = edges.col(0).cross(edges.col(1));
  const double volume = n1.dot(edges.col(0)), sign = volume < 0 ? -1 : 1;
  Heights h;
  h.volume = sign * volume;
  for (int k = 0; k < 3; ++k)
    h.normals.col(k) = sign * Eigen::Vector4d(-(n1[k] + n2[k] + n3[k]), n1[k], n2[k], n3[k]);
  const Eigen::Array4d at_origin(h.volume, 0, 0, 0);
  for (int i = 0; i < 3; ++i)
    h.over.col(i) =
        at_origin + (h.normals.col(0) * triangle(0, i) + h.normals.col(1) * triangle(1, i) +
                     h.normals.col(2) * triangle(2, i))
                        .array();
  return h;
}

/// The plane of the triangle: Overlapping means that it cuts the tetrahedron.
Verdict triangle_plane(const Vector3d& normal, const Vector3d& corner, const Matrix3d& edges,
                       double margin, double round_off) {
  const double of_triangle = normal.dot(corner);
  double low = 0, high = 0;  // of the tetrahedron, over node 0
  for (int k = 0; k < 3; ++k) {
    const double height = normal.dot(edges.col(k));
    low = std::min(low, height);
    high = std::max(high, height);
  }
  const double gap = std::max(low - of_triangle, of_triangle - high);
  if (gap > round_off && (margin == 0 || gap - round_off > margin * normal.norm()))
    return Verdict::Apart;
  return gap < -round_off ? Verdict::Overlapping : Verdict::Unknown;
}

/// The planes of the tetrahedron's faces: Overlapping means that none has the triangle outside.
Verdict face_planes(const Heights& h, double margin, double round_off) {
  const Eigen::Array4d highest = h.over.col(0).max(h.over.col(1)).max(h.over.col(2));
  const double least = highest.minCoeff();
  if (least < -round_off) {
    if (margin == 0) return Verdict::Apart;
    for (int k = 0; k < 4; ++k)
      if (-highest[k] - round_off > margin * h.normals.row(k).norm()) return Verdict::Apart;
  }
  return least > round_off ? Verdict::Overlapping : Verdict::Unknown;
}

bool corner_is_inside(const Heights& h, double round_off) {
  return std::max({h.over.col(0).minCoeff(), h.over.col(1).minCoeff(), h.over.col(2).minCoeff()}) >
         round_off;
}

/// Gaps along edge i of the triangle × the edges opposite to all edges cd, times the volume. With
/// barycentric coordinates λ, their differences Δ along edge i, and the origin on the opposite
/// edge, the product's component along x is volume (λ_c Δλ_d - λ_d Δλ_c)(x): the same for both ends
/// of edge i, and for the nodes of the tetrahedron just Δλ_d, -Δλ_c and twice 0.
PerEdge edge_gaps(const std::array<PerEdge, 3>& c, const std::array<PerEdge, 3>& d, double volume,
                  std::size_t i) {
  const std::size_t j = (i + 1) % 3, corner = (i + 2) % 3;
  const PerEdge along_c = c[j] - c[i], along_d = d[j] - d[i];
  const PerEdge of_edge = c[i] * along_d - d[i] * along_c;
  const PerEdge of_corner = c[corner] * along_d - d[corner] * along_c;
  const PerEdge of_c = volume * along_d, of_d = -volume * along_c;
  const PerEdge low = of_c.min(of_d).min(0.0), high = of_c.max(of_d).max(0.0);
  return (of_edge.min(of_corner) - high).max(low - of_edge.max(of_corner));
}

Verdict edge_products(const Heights& h, const Matrix3d& triangle, const Tetrahedron& tetrahedron,
                      double margin, double round_off) {
  std::array<PerEdge, 3> c, d;  // of each corner of the triangle
  for (std::size_t i = 0; i < 3; ++i) {
    const auto over = h.over.col(static_cast<Eigen::Index>(i));
    c[i] << over[0], over[0], over[0], over[1], over[1], over[2];
    d[i] << over[1], over[2], over[3], over[2], over[3], over[3];
  }
  bool certain = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const PerEdge gaps = edge_gaps(c, d, h.volume, i);
    const double largest = gaps.maxCoeff();
    certain = certain && largest < -round_off;
    if (!(largest > round_off)) continue;
    if (margin == 0) return Verdict::Apart;
    const Eigen::Index from = static_cast<Eigen::Index>(i), to = (from + 1) % 3;
    const Vector3d side = triangle.col(to) - triangle.col(from);
    for (std::size_t e = 0; e < kOppositeEdges.size(); ++e) {
      const auto [a, b] = kOppositeEdges[e];
      const Vector3d axis = side.cross(tetrahedron.col(b) - tetrahedron.col(a));
      if (gaps[static_cast<Eigen::Index>(e)] - round_off > margin * h.volume * axis.norm())
        return Verdict::Apart;
    }
  }
  return certain ? Verdict::Overlapping : Verdict::Unknown;
}

/// The usual 23 axes. For a tetrahedron with volume these are the normals of all faces that the
/// difference of the two shapes can have, so that no gap along any of them means overlap.
/// @param corners, edges  of the triangle and of the tetrahedron, relative to its node 0
Verdict filter(const Matrix3d& triangle, const Tetrahedron& tetrahedron, const Matrix3d& corners,
               const Matrix3d& edges, double margin) {
  const Vector3d side = triangle.col(1) - triangle.col(0),
                 other = triangle.col(2) - triangle.col(0);
  const double tetrahedron_size = edges.cwiseAbs().maxCoeff();
  const double triangle_size = std::max(side.cwiseAbs().maxCoeff(), other.cwiseAbs().maxCoeff());
  const double size = std::max(tetrahedron_size, corners.cwiseAbs().maxCoeff());
  const double unit = tetrahedron_size * tetrahedron_size * size,
               unit_t = triangle_size * triangle_size * size;
  const double smallest = kSmallestProduct * size * size * size;
  if (!(unit_t > smallest && unit > smallest)) return Verdict::Unknown;

  // What is compared with the margin times an axis's length: that product is rounded too.
  margin *= 1 + kHeightRoundOff;
  const Verdict by_triangle =
      triangle_plane(side.cross(other), corners.col(0), edges, margin, kHeightRoundOff * unit_t);
  if (by_triangle == Verdict::Apart) return Verdict::Apart;
  const double height_round_off = kHeightRoundOff * unit;
  const Heights h = heights(corners, edges);
  // Without a sign of the volume, the inside of the faces is not known.
  if (!(h.volume > height_round_off)) return Verdict::Unknown;
  const Verdict by_faces = face_planes(h, margin, height_round_off);
  if (by_faces == Verdict::Apart) return Verdict::Apart;
  if (corner_is_inside(h, height_round_off)) return Verdict::Overlapping;
  const Verdict by_edges =
      edge_products(h, triangle, tetrahedron, margin, kProductRoundOff * unit * unit);
  if (by_edges == Verdict::Apart) return Verdict::Apart;
  const bool certain = by_triangle == Verdict::Overlapping && by_faces == Verdict::Overlapping;
  return certain ? by_edges : Verdict::Unknown;
}

// Corners of a pair are rounded to integers of up to 2⁵¹, so that differences are exact: the
// rounded shapes, off by 2⁻⁵⁰ of the pair's size, are decided as they are, however thin.
constexpr int kBits = 51;

// A gap may be round-off up to this number of units. Rounding the corners moves them by √3 each;
// a component along a unit axis, three products with up to 2⁵¹, is off by about 1.5, a difference
// of two by 3; the axis itself, off by a few 2⁻⁵³, turns that away by another 3.
constexpr double kTouching = 16;

/// Six vectors, one a row: what is done to each vectorises.
using Six = Eigen::Array<double, 6, 3>;

Six repeated(const Vector3d& v) { return v.transpose().replicate<6, 1>().array(); }

Six cross(const Six& a, const Six& b) {
  Six product;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    product.col(i) = a.col(j) * b.col(k) - a.col(k) * b.col(j);
  }
  return product;
}

/// a × b, each component with a relative error of 2⁻⁵² at most however much of it cancels: parallel
/// integer vectors give 0. [Jeannerod, Louvet, Muller: Further analysis of Kahan's algorithm for
/// the accurate computation of 2×2 determinants. Mathematics of Computation 82 (2013)]
Vector3d kahan_cross(const Vector3d& a, const Vector3d& b) {
  const auto component = [&](int i, int j) {
    const double product = a[j] * b[i];
    return std::fma(a[i], b[j], -product) + std::fma(-a[j], b[i], product);
  };
  return {component(1, 2), component(2, 0), component(0, 1)};
}

PerEdge squared_norms(const Six& a) {
  return a.col(0).square() + a.col(1).square() + a.col(2).square();
}

/// a × b with a relative error of some 2⁻⁴⁹. Kahan's algorithm is a function call for each product
/// where the instruction set has no fused multiply-add; vectors more than 7° apart don't need it.
Six accurate_cross(const Six& a, const Six& b) {
  Six product = cross(a, b);
  const PerEdge most = squared_norms(a) * squared_norms(b), least = squared_norms(product);
  for (int k = 0; k < 6; ++k)
    if (least[k] < 0x1p-6 * most[k])
      product.row(k) = kahan_cross(a.row(k).transpose(), b.row(k).transpose()).transpose();
  return product;
}

/// A pair in integer coordinates, and whether an axis separates it.
class IntegerPair {
 public:
  /// @param triangle, tetrahedron  relative to a common origin
  /// @param size  the largest of these coordinates, > 0
  IntegerPair(const Matrix3d& triangle, const Tetrahedron& tetrahedron, double size,
              double margin) {
    // In two factors, as the whole one may be out of range.
    const int exponent = kBits - 1 - std::ilogb(size);
    const double first = std::ldexp(1.0, exponent / 2);
    const double second = std::ldexp(1.0, exponent - exponent / 2);
    const auto rounded = [&](double x) {
      return static_cast<double>(static_cast<std::int64_t>(x * first * second));
    };
    triangle_ = triangle.unaryExpr(rounded);
    tetrahedron_ = tetrahedron.unaryExpr(rounded);
    least_gap_ = margin * first * second * (1 + 4 * 0x1p-52) + kTouching;
  }

  bool overlap() const {
    return !(normals_separate() || tetrahedron_edges_separate() || triangle_edges_separate() ||
             lines_between_corners_separate());
  }

 private:
  bool any_separates(const Six& axes) const {
    PerEdge low_t, high_t, low_w, high_w;
    range(axes, triangle_, low_t, high_t);
    range(axes, tetrahedron_, low_w, high_w);
    const PerEdge gaps = (low_t - high_w).max(low_w - high_t);
    return (gaps > least_gap_ * squared_norms(axes).sqrt()).any();
  }

  template <class Corners>
  static void range(const Six& axes, const Corners& corners, PerEdge& low, PerEdge& high) {
    for (int k = 0; k < corners.cols(); ++k) {
      const PerEdge along =
          axes.col(0) * corners(0, k) + axes.col(1) * corners(1, k) + axes.col(2) * corners(2, k);
      low = k == 0 ? along : PerEdge(low.min(along));
      high = k == 0 ? along : PerEdge(high.max(along));
    }
  }

  bool normals_separate() const {
    const Matrix3d& t = triangle_;
    const Tetrahedron& w = tetrahedron_;
    Six side, other;
    for (int k = 0; k < 4; ++k) {
      const Vector3d corner = w.col((k + 1) % 4);
      side.row(k) = (w.col((k + 2) % 4) - corner).transpose();
      other.row(k) = (w.col((k + 3) % 4) - corner).transpose();
    }
    for (int k = 4; k < 6; ++k) {
      side.row(k) = (t.col(1) - t.col(0)).transpose();
      other.row(k) = (t.col(2) - t.col(0)).transpose();
    }
    return any_separates(accurate_cross(side, other));
  }

  /// With the edges of the triangle, and from its corners.
  bool tetrahedron_edges_separate() const {
    Six from, edge;
    for (int k = 0; k < 6; ++k) {
      const auto [a, b] = kOppositeEdges[static_cast<std::size_t>(k)];
      from.row(k) = tetrahedron_.col(a).transpose();
      edge.row(k) = (tetrahedron_.col(b) - tetrahedron_.col(a)).transpose();
    }
    for (int i = 0; i < 3; ++i) {
      const Vector3d side = triangle_.col((i + 1) % 3) - triangle_.col(i);
      if (any_separates(accurate_cross(repeated(side), edge))) return true;
      if (perpendiculars_separate(repeated(triangle_.col(i)) - from, edge)) return true;
    }
    return false;
  }

  /// From the corners of the tetrahedron, two at a time.
  bool triangle_edges_separate() const {
    for (int k = 0; k < 4; k += 2) {
      Six to_corner, edge;
      for (int i = 0; i < 6; ++i) {
        const Vector3d from = triangle_.col(i % 3);
        to_corner.row(i) = (tetrahedron_.col(k + i / 3) - from).transpose();
        edge.row(i) = (triangle_.col((i + 1) % 3) - from).transpose();
      }
      if (perpendiculars_separate(to_corner, edge)) return true;
    }
    return false;
  }

  /// Perpendiculars from edges to corners. The second product is of vectors at right angles:
  /// nothing cancels.
  bool perpendiculars_separate(const Six& to_corner, const Six& edge) const {
    return any_separates(cross(accurate_cross(to_corner, edge), edge));
  }

  bool lines_between_corners_separate() const {
    for (int k = 0; k < 4; k += 2) {
      Six lines;
      for (int i = 0; i < 6; ++i)
        lines.row(i) = (tetrahedron_.col(k + i / 3) - triangle_.col(i % 3)).transpose();
      if (any_separates(lines)) return true;
    }
    return false;
  }

  Matrix3d triangle_;
  Tetrahedron tetrahedron_;
  double least_gap_;  // along a unit axis that separates
};

}  // namespace

bool separating_axes_overlap(const Matrix3d& triangle, const Tetrahedron& tetrahedron,
                             double margin) {
  assert(margin >= 0);
  const Vector3d origin = tetrahedron.col(0);
  const Matrix3d corners = triangle.colwise() - origin;
  const Matrix3d edges = tetrahedron.rightCols<3>().colwise() - origin;
  const double size = std::max(edges.cwiseAbs().maxCoeff(), corners.cwiseAbs().maxCoeff());
  if (size == 0) return true;  // one point
  const Tetrahedron local = tetrahedron.colwise() - origin;
  if (!(size > kSmallest && size < kLargest)) {
    const double unit = std::ldexp(1.0, -std::ilogb(size));  // nothing is lost by a power of two
    return separating_axes_overlap(unit * corners, unit * local, unit * margin);
  }
  const Verdict verdict = filter(triangle, tetrahedron, corners, edges, margin);
  if (verdict != Verdict::Unknown) return verdict == Verdict::Overlapping;
  return IntegerPair(corners, local, size, margin).overlap();
}

}  // namespace articular::collision
