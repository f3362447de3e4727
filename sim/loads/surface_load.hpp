#pragma once

#include "fem/sparse/block_matrix.hpp"
#include "sim/model/configuration.hpp"

/// Loads on a tissue's surface. On a face with the corners x0 x1 x2, counterclockwise from outside,
///
///   traction t    f_a = A t/3                A: the area at the start
///   pressure p    f_a = −p N/6,   N = x0 × x1 + x1 × x2 + x2 × x0   (twice the face's area vector)
///
/// at each corner. So a pressure pushes inwards, and on a closed surface it has neither a force nor
/// a moment. It follows the surface, and its stiffness is
///
///   K_ab = −∂f_a/∂x_b = −p/6 [e_b]×,   e_0 = x1 − x2, e_1 = x2 − x0, e_2 = x0 − x1.
///
/// Summed over a closed surface K is symmetric: there is a potential −p V. Over an open one what is
/// not symmetric comes from the forces along the rim alone, and there is none of it where the rim
/// is held. The linear solvers take symmetric matrices, so that the matrix has
///
///   (K + Kᵀ)/2:   −p/12 [e_b − e_a]×
///
/// everywhere, which is K but for a rim that moves. The forces are exact: where the rim is free,
/// Newton's iteration converges linearly, at a rate of the size of p by Young's modulus.
///
/// [Belytschko, Liu, Moran. Nonlinear Finite Elements for Continua and Structures, ch. 6.4.5]
namespace articular::sim {

/// Adds its forces at now.t to block forces. @return the largest on one face [N]
double add_surface_force(const SurfaceLoadModel& load, const Configuration& now,
                         Eigen::VectorXd& f);

/// Adds scale (K + Kᵀ)/2. The pattern has all elements.
void add_surface_stiffness(const Model& model, const SurfaceLoadModel& load,
                           const Configuration& now, double scale, fem::BlockMatrix& A);

/// Work [J] on a straight way on which the factor changes linearly: Simpson's rule, as the power is
/// cubic.
/// @param first, last  factors [-] at both ends
double surface_work(const SurfaceLoadModel& load, const Configuration& from,
                    const Configuration& to, double first, double last);

}  // namespace articular::sim
