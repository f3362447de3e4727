#pragma once

#include "sim/assembly/moment.hpp"

namespace articular::sim {

/// Dampers in tissue: viscous elements, fibres' force–velocity, damping by mass and stress that
/// relaxes. Holds scratch
/// memory.
class TissueDamping {
 public:
  /// What they lose [W].
  double power(const Moment& now);

  /// f += scale D u for block velocities u, with the D of all but relaxation.
  void add_product(const Moment& now, const Eigen::VectorXd& u, double scale, Eigen::VectorXd& f);

 private:
  Positions v_, f_, velocities_;  // at the nodes of a tissue
};

}  // namespace articular::sim
