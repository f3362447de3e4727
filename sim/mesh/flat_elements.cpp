#include "sim/mesh/flat_elements.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace articular::sim {
namespace {

/// Least height over longest edge.
double flatness(const Eigen::Matrix<double, 3, 4>& x) {
  double longest = 0, largest_face = 0;  // twice its area
  for (int a = 0; a < 4; ++a) {
    for (int b = a + 1; b < 4; ++b) longest = std::max(longest, (x.col(b) - x.col(a)).norm());
    const Vec3 p = x.col((a + 1) % 4), q = x.col((a + 2) % 4), r = x.col((a + 3) % 4);
    largest_face = std::max(largest_face, (q - p).cross(r - p).norm());
  }
  const double sextuple_volume =
      (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0)).dot(x.col(3) - x.col(0));
  return std::abs(sextuple_volume) / (largest_face * longest);
}

}  // namespace

FlatElements flat_elements(const Positions& X, const Tetrahedra& tets) {
  constexpr double kFlat = 0.02;
  FlatElements found;
  double least = kFlat;
  for (const auto& tet : tets.colwise()) {
    const Eigen::Matrix<double, 3, 4> x = X(Eigen::all, tet);
    const double flat = flatness(x);
    if (flat >= kFlat) continue;
    ++found.count;
    if (flat >= least) continue;
    least = flat;
    found.flattest = x.rowwise().mean();
  }
  return found;
}

}  // namespace articular::sim
