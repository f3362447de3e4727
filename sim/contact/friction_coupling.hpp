#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "fem/base/types.hpp"

/// How friction grows with the pressure. In the matrix of Newton's iteration that is S Gᵀ, which is
/// not symmetric, with a column of each factor for a group that slides (smoothing_groups.hpp): S
/// the forces by the group's pressure [m²], G the pressure by the motion [Pa s/m].
namespace articular::sim {

class FrictionCoupling {
 public:
  /// Of one block that moves with the group.
  struct Entry {
    int block;
    Vec3 drag;      // of S
    Vec3 pressure;  // of G
  };
  void clear();
  void add_group(const std::vector<Entry>& entries);
  int num_groups() const { return static_cast<int>(begin_.size()) - 1; }
  /// Gᵀ w [Pa], one a group.
  Eigen::VectorXd pressures(const Eigen::VectorXd& w) const;
  /// f += scale S p
  void add_drag(const Eigen::VectorXd& p, double scale, Eigen::VectorXd& f) const;

 private:
  std::vector<Entry> entries_;
  std::vector<int> begin_{0};  // of each group's
};

/// w = A⁻¹ r of a symmetric A; r may be used up. @return false where that fails
using SymmetricSolve = std::function<bool(Eigen::VectorXd& r, Eigen::VectorXd& w)>;

/// Solves (A + S Gᵀ) w = b by the pressures p = Gᵀ w, w = A⁻¹ (b − S p), with GMRES for
///
///   p + Gᵀ A⁻¹ S p = Gᵀ A⁻¹ b:
///
/// the friction coefficient is what that differs from p by, so that a few of its iterations do.
/// @param w  A⁻¹ b on entry, the solution on exit
/// @return false where `solve` fails
[[nodiscard]] bool solve_with_friction(const FrictionCoupling& coupling,
                                       const SymmetricSolve& solve, const Eigen::VectorXd& b,
                                       Eigen::VectorXd& w);

}  // namespace articular::sim
