#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace articular::tools {

/// A number with the interval in which it is with a probability of 95 %.
struct Estimate {
  double value = 0, low = 0, high = 0;
};

/// What share of an output's variance comes from one parameter: by itself, and with all that it
/// does together with others.
struct SobolIndex {
  Estimate first, total;
};

/// Indices from the values at saltelli_points(), with V the variance over A and B:
///
///   first  = mean of f(B) (f(AB_i) - f(A)) / V        [Saltelli 2010, table 2 b]
///   total  = mean of (f(A) - f(AB_i))² / 2V           [Jansen 1999]
///
/// with the mean of all f taken off before. Intervals are those of 1000 bootstrap samples of rows.
/// A row in which a value is missing (NaN) does not count.
///
/// [Saltelli 2010] Saltelli et al. Comput Phys Commun 181:259. [Jansen 1999] Comput Phys Commun
/// 117:35.
/// @param values  a row of the design a row, in the order A, B, AB_0, AB_1, ...
/// @return  one a parameter; none where fewer than two rows are whole or nothing varies
std::vector<SobolIndex> sobol_indices(const Eigen::MatrixXd& values, std::uint64_t seed);

}  // namespace articular::tools
