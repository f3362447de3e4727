#pragma once

#include <optional>

#include "sim/statics/equilibrium.hpp"

namespace articular::sim {

/// Where the tangent of the equilibrium y at t_before has everything when driven rigid bodies and
/// supports are where they are at t:
///
///   (K + d M) u = ∂f/∂s,
///
/// ∂f/∂s what these add to the forces on their way. Newton's iteration from where things
/// are begins with the elements beside a wall crushed by the whole way of that wall. K has the soft
/// contact stiffness. d > 0 keeps in its place what is loose.
///
/// Tissue that is tied to one driven rigid body alone goes with it as a rigid body, however far
/// that turns: in y, and in what is predicted besides u.
///
/// Contact candidates must hold at the old equilibrium; they need not at the new places.
///
/// @return none where nothing is driven, or K can't be solved
std::optional<Eigen::VectorXd> predict_load_step(const Model& model, Dynamics& dynamics,
                                                 Equilibrium& equilibrium, double t_before,
                                                 double t, Eigen::VectorXd& y);

/// The largest K_ii/m_i of a free node at the last Dynamics::evaluate() [1/s²]: a damping that is a
/// small part of it holds what is loose, and nothing else feels it.
double fastest_rate(const Model& model, Dynamics& dynamics);

}  // namespace articular::sim
