#include "fem/mesh/rest_shape.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

namespace articular::fem {
namespace {

// An element counts as flat below this volume relative to its longest edge cubed (a regular one has
// 0.12). Rounding of the coordinates alone puts about 1e-16 there; 1e-12 leaves four digits of the
// volume, and a stiffness that is no more than about 1e12 times that of its neighbours.
constexpr double kFlat = 1e-12;  // [-]

}  // namespace

std::string name_of(const Tetrahedra& tets, Eigen::Index e) {
  std::ostringstream name;
  name << "tetrahedron " << e << " (nodes " << tets(0, e) << ' ' << tets(1, e) << ' ' << tets(2, e)
       << ' ' << tets(3, e) << ')';
  return name.str();
}

double checked_volume(const Positions& X, const Tetrahedra& tets, Eigen::Index e) {
  for (int a = 0; a < 4; ++a) {
    if (tets(a, e) < 0 || tets(a, e) >= X.cols()) {
      std::ostringstream message;
      message << name_of(tets, e) << " has a node out of range: there are " << X.cols() << " nodes";
      throw std::invalid_argument(message.str());
    }
  }
  const Mat34 X_e = gather(X, tets, e);
  const double volume = edge_matrix(X_e).determinant() / 6;
  double longest2 = 0;
  for (int a = 0; a < 4; ++a) {
    for (int b = a + 1; b < 4; ++b) {
      longest2 = std::max(longest2, (X_e.col(a) - X_e.col(b)).squaredNorm());
    }
  }
  const double smallest = kFlat * longest2 * std::sqrt(longest2);
  if (volume > smallest && std::isfinite(volume)) return volume;  // false for NaN
  std::ostringstream message;
  message << name_of(tets, e) << " is " << (volume < -smallest ? "inverted" : "flat")
          << ": its volume is " << volume << " m^3, must be above " << smallest
          << " m^3 (1e-12 of its longest edge cubed)";
  throw std::invalid_argument(message.str());
}

}  // namespace articular::fem
