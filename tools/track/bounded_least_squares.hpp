#pragma once

#include <Eigen/Core>

namespace articular::tools {

/// The x within bounds that makes |A x - b|^2 least, by active sets: unknowns that lie at a bound
/// are freed one at a time, where the sum falls most, until it falls nowhere [Stark 1995].
/// @param A  of full column rank
///
/// [Stark 1995] Stark, Parker. Bounded-variable least squares: an algorithm and applications.
/// Computational Statistics 10:129.
Eigen::VectorXd bounded_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                                      const Eigen::VectorXd& lowest,
                                      const Eigen::VectorXd& highest);

}  // namespace articular::tools
