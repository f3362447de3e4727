#pragma once

#include <Eigen/Core>

/// What measurements say of the parameters that were fitted to them.
namespace articular::tools {

/// The linear estimate at the solution [Bard 1974, Nonlinear Parameter Estimation, ch. 7].
struct Determination {
  Eigen::VectorXd widths;     // standard deviation of each parameter, in the unknowns' unit;
                              // infinite where nothing says what it is
  Eigen::VectorXd from_data;  // of each: how much of the variance known before the data take away,
                              // 0 to 1; 1 where nothing was known before
  Eigen::MatrixXd correlation;      // of each pair, -1 to 1; 0 where a width is infinite
  Eigen::VectorXd singular_values;  // of the data's Jacobian, each unknown by its spread, falling
  int determined = 0;  // directions of which the data say more than what was known before
  double scale = 1;    // by which misfits larger than the spreads widen all widths
};

/// @param jacobian  d(misfit of each measurement in standard deviations)/d(unknown)
/// @param spreads   of the unknowns without the measurements; infinite: nothing is known
/// @param misfits   at the solution, one a measurement
Determination determine(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& spreads,
                        const Eigen::VectorXd& misfits);

}  // namespace articular::tools
