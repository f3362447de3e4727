#pragma once

#include "sim/assembly/dynamics.hpp"

namespace articular::sim {

/// By how much the forces on bodies that are free or touch others are out of balance with their
/// inertia: the largest of all of those bodies' residuals, by what may remain. Where contact is
/// stiff and a body light, a correction far below the tolerance of positions still changes its
/// contact force by many times its weight. And nothing brings a free body back: what is left of its
/// force while others move adds up from step to step. What may remain is a small part of what
/// contact puts on the body, or what moves it, free, in a stage of length gamma by less than the
/// tolerance.
/// @param residual  γ (F − M a) by unknown blocks [N s, N m s], of the last Dynamics::evaluate()
double body_imbalance(const Model& model, const Dynamics& dynamics, const Eigen::VectorXd& residual,
                      double gamma);

}  // namespace articular::sim
