#pragma once

#include <Eigen/Core>

#include "tools/track/track_file.hpp"

/// Activations that meet linear targets, the least of them.
namespace articular::tools {

struct ActivationProblem {
  Eigen::MatrixXd A;                // misfits A a - b, in spreads, of activations a
  Eigen::VectorXd b;                // as many
  Eigen::VectorXd lowest, highest;  // of each activation
  Eigen::VectorXd count;            // of the muscles that have it
  double effort = 0;                // > 0
};

/// Sum of squares, sum of cubes, or square of the largest, each muscle counted.
double cost_of(TrackCost cost, const Eigen::VectorXd& a, const Eigen::VectorXd& count);

/// The a within its bounds with the least |A a - b|^2 + effort cost(a).
Eigen::VectorXd least_activation(const ActivationProblem& problem, TrackCost cost);

}  // namespace articular::tools
