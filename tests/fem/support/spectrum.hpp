#pragma once

#include <Eigen/Core>

/// Eigenvalues for tests, compiled once: Eigen's decompositions take seconds in each source.
namespace articular::fem {

/// Of a symmetric matrix, ascending.
Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& A);
/// With its negative eigenvalues set to 0, from its eigenvectors.
Eigen::MatrixXd positive_part(const Eigen::MatrixXd& A);

}  // namespace articular::fem
