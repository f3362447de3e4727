#pragma once

#include "sim/assembly/moment.hpp"

namespace articular::sim {

/// Newton's iteration for the internal variables of relaxing stress. Their rows (1 + γ/τ) δL =
/// b_L + γ/τ δS0 leave known parts b_L/(1 + γ/τ), whose force is added to that of the blocks; with
/// a correction γ w of the blocks' positions the rest follows. Holds scratch memory.
class RelaxationRows {
 public:
  /// f += the force of the known parts.
  /// @param b  the whole right hand side, in the order of Layout
  void add_known_force(const Moment& now, const double* b, double gamma, Eigen::VectorXd& f);

  /// The corrections of the internal variables, in x.
  void correct(const Moment& now, const double* b, double gamma, const Eigen::VectorXd& w,
               double* x);

 private:
  Positions x_, f_;                 // at the nodes of a tissue
  Eigen::VectorXd known_, stress_;  // of a tissue
};

}  // namespace articular::sim
