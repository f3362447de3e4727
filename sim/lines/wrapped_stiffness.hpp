#pragma once

#include "sim/lines/line_force.hpp"
#include "sim/lines/line_path.hpp"

namespace articular::sim {

/// A += the part of stiffness and damping of a line that wraps:
///
///   K = s_K T ∂²L/∂x² + (s_K ∂T/∂L + s_D ∂T/∂L̇) ∂L/∂x ∂L/∂xᵀ
///
/// ∂²L/∂x² is that of a taut string, which slides over the bodies as they move (taut_hessian). That
/// is symmetric, but may be indefinite: a body may roll off under a string.
/// @param hold  with the places held where the line bends: positive semidefinite
void add_wrapped_stiffness(const Model& model, const Line& line, const LinePath& path,
                           const Configuration& configuration, const LineState& state,
                           const SystemScale& scale, bool hold, fem::BlockMatrix& A);

/// Couplings that add_wrapped_stiffness writes.
void append_wrapped_stencil(const Model& model, const Line& line, Stencils& stencils);

}  // namespace articular::sim
