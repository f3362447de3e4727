#pragma once

#include "fem/sparse/block_matrix.hpp"
#include "fem/sparse/pressure_gradient.hpp"
#include "sim/model/model.hpp"

/// What is held takes no part: with P the projection onto the free directions of all blocks
/// (HeldBlock), forces are P f, velocities P v and Newton's matrix P A P + s (I − P). Its pattern
/// is that of A, and what is held stays where it is to round-off. No penalty is involved, and what
/// holds does no work.
namespace articular::sim {

/// P b of a vector over blocks: those of all unknowns, at least.
void keep_free_part(const Model& model, Eigen::VectorXd& blocks);

/// P A P + s (I − P) of a matrix over the unknown blocks, s > 0 of the size of each block.
void keep_free_part(const Model& model, fem::BlockMatrix& A);

/// P G of the forces by pressures, one row a block.
void keep_free_part(const Model& model, fem::PressureGradient& G);

/// How many freedoms of a tissue's free nodes supports hold.
int num_held_freedoms(const Model& model, const Tissue& tissue);

}  // namespace articular::sim
