#pragma once

#include "sim/assembly/newton_matrix.hpp"

namespace articular::sim {

/// Newton's iteration with the pressures of smoothed tissues as unknowns of their own: they go
/// along with a correction of the positions, to first order.
class PressurePrediction {
 public:
  /// From a moment on, where the matrix was taken, with a correction dx of the block positions.
  void predict(const Moment& now, const NewtonMatrix& matrix, const Eigen::VectorXd& dx);

  /// From now on those of a moment, as they are, until a correction changes them.
  void keep(const Moment& now);

  /// Those of a tissue this part of the way [Pa].
  Eigen::VectorXd at(std::size_t tissue, double part) const;

 private:
  struct Way {
    Eigen::VectorXd before, after;
    Positions u;  // of the nodes
  };
  std::vector<Way> of_tissue_;  // empty for one that is not smoothed
};

}  // namespace articular::sim
