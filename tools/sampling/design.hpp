#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "tools/sampling/distribution.hpp"

/// Points of a parameter space at which a population is looked at. The same seed gives the same
/// points, on every machine.
namespace articular::tools {

enum class Design { LatinHypercube, Sobol, Random };

/// Points in the open unit cube, one a column.
///
/// Latin hypercube: of n points one lies in each nth of each axis. Sobol: the sequence with the
/// direction numbers of Joe and Kuo (2008), moved as a whole by random numbers (modulo 1), so that
/// seeds differ.
Eigen::MatrixXd unit_points(Design design, int num_dimensions, int num_points, std::uint64_t seed);

/// Points of the unit cube as values of the distributions, one a row, joined by a Gaussian copula:
/// normal numbers that have this correlation, each then stretched to its own distribution.
/// @param correlation  of the normal numbers; symmetric, positive definite, ones on the diagonal
Eigen::MatrixXd values_at(const Eigen::MatrixXd& points,
                          const std::vector<Distribution>& distributions,
                          const Eigen::MatrixXd& correlation);

/// Whether there are numbers with such correlations.
bool is_positive_definite(const Eigen::MatrixXd& correlation);

/// Points for Sobol indices [Saltelli 2010]: for each row two independent points A and B, and for
/// each dimension i a point AB_i that is A but for number i, which is that of B.
/// @return  (num_dimensions + 2) columns a row, in the order A, B, AB_0, AB_1, ...
Eigen::MatrixXd saltelli_points(int num_dimensions, int num_rows, std::uint64_t seed);

}  // namespace articular::tools
