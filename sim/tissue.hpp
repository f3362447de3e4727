#pragma once

#include <vector>

#include "collision/surface.hpp"
#include "sim/body_geometry.hpp"
#include "sim/model.hpp"

namespace articular::sim {

/// The elements, masses and fibres of a tissue; what moves its nodes is not known yet.
/// @param body      index into the scenario's bodies
/// @param geometry  of each of them
/// @throws InputError with the place in the scenario
Tissue make_tissue(const Model& model, const std::vector<BodyGeometry>& geometry,
                   const collision::Surface& surface, int body);

/// Edge of the cube that six of its mean tetrahedra fill [m].
double element_size(const Tissue& tissue);

/// λ + 2μ at small strain [Pa].
double constrained_modulus(const Material& material);
double constrained_modulus(double young_modulus, double poisson_ratio);

}  // namespace articular::sim
