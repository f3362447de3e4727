#pragma once

#include <vector>

#include "sim/model/model.hpp"
#include "sim/scenario/driven_motion.hpp"

/// Supports that are driven: what they hold follows a path s(t). As of rigid bodies with driven
/// freedoms the state has the free part of a node's position and velocity alone, x_f and v_f. With
/// the share S_i of each support that holds the node
///
///   d = Σ S_iᵀ s_i(t),   x = x_f + d,   v = v_f + ḋ,   v̇ = v̇_f + d̈
///
/// holds in every stage, and what can vary is what could without. d goes along the axes of each
/// support as far as its path says, and ḋ is orthogonal to v_f. The node puts (I − P) f − m d̈ on
/// what holds it, of which each support takes S_i. What drives them does the work
///
///   −Σ ∫ S_i ((I − P) f − m d̈) · ds_i = −∫ (I − P) f · dd + Δ(½ m ḋ²)
namespace articular::sim {

bool has_driven_supports(const Model& model);

/// Where each support is [m], from the start; 0 of one that stands.
std::vector<Vec3> support_shifts(const Model& model, double t);

/// How fast each support moves [m/s]; in statics none does.
std::vector<Vec3> support_velocities(const Model& model, double t);

/// The accelerations of all supports [m/s²]. Of one that moves linearly it is the mean over a step,
/// as in carried_tissue.hpp.
/// @param step_start  of the step that ends at `at` [s]; not before it: no mean
std::vector<Vec3> support_accelerations(const Model& model, double step_start, Instant at);

/// Σ S_iᵀ a_i of each held block, of a vector a_i of each support.
Positions on_held_blocks(const Model& model, const std::vector<Vec3>& of_supports);

/// Adds that to a vector of each free node.
void add_to_nodes(const Model& model, const std::vector<Vec3>& of_supports, Positions& of_nodes);

/// ½ Σ m ḋ² [J].
double driven_kinetic_energy(const Model& model, double t);

}  // namespace articular::sim
