#pragma once

#include <Eigen/Core>
#include <sstream>
#include <stdexcept>

namespace articular::collision {

// Beyond this the square of a length, or a difference of two, may overflow [m].
inline constexpr double kMaxCoordinate = 1e150;

/// @throws std::invalid_argument with the parts written one after the other
template <class... Parts>
[[noreturn]] void bad_input(const Parts&... parts) {
  std::ostringstream message;
  (message << ... << parts);
  throw std::invalid_argument(message.str());
}

/// @throws std::invalid_argument for a wrong number of nodes or, naming the node, a position that
///         is not finite or too large
inline void check_positions(const Eigen::Matrix3Xd& x, Eigen::Index num_nodes, const char* what) {
  if (x.cols() != num_nodes) bad_input(what, ": ", x.cols(), " nodes, expected ", num_nodes);
  // 0 x is NaN for all that is not finite. Two vectorised passes; a comparison for each is not.
  const bool finite = (0 * x.array()).sum() == 0;
  if (finite && !(x.size() > 0 && x.array().abs().maxCoeff() > kMaxCoordinate)) return;
  for (Eigen::Index a = 0; a < x.cols(); ++a)
    if (!(x.col(a).array().abs() <= kMaxCoordinate).all())
      bad_input(what, " of node ", a, " is (", x(0, a), ", ", x(1, a), ", ", x(2, a),
                ") m; each coordinate must be finite and within ±", kMaxCoordinate, " m");
}

}  // namespace articular::collision
