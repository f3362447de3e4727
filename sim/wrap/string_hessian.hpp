#pragma once

#include "sim/wrap/taut_string.hpp"

namespace articular::sim {

/// How a string's points move with coordinates x of ends and nodes, its parameters t being held:
/// P = A + t (B − A) moves with both nodes of its edge, and the edge turns with them.
struct StringMotion {
  Eigen::MatrixXd points;  // ∂P/∂x, three rows a point, ends included
  Eigen::MatrixXd edges;   // ∂(B − A)/∂x, three rows a crossing
};

/// ∂²L/∂x² of a string with t held: K = Σ over segments of ∂dᵀ (I − u uᵀ)/l ∂d.
Eigen::MatrixXd held_hessian(const StringShape& shape, const StringMotion& motion);

/// ∂²L/∂x² of a taut string. t follows x, so that ∂L/∂t stays 0 where no bound holds it:
///
///   K = L_xx − L_xt L_tt⁻¹ L_tx,   (L_tx)_i = e_iᵀ ∂(u_i−1 − u_i)/∂x + (u_i−1 − u_i)ᵀ ∂e_i/∂x
Eigen::MatrixXd taut_hessian(const StringShape& shape, const StringMotion& motion);

}  // namespace articular::sim
