#pragma once

#include <span>

#include "sim/contact/contact_pair_state.hpp"
#include "sim/contact/contact_search.hpp"
#include "sim/model/system_matrix.hpp"

/// Which blocks of unknowns contact couples. What carries force has to be in the pattern of the
/// matrix; what is near enters with it, so that the pattern grows now and then, not at every step.
namespace articular::sim {

/// Lists of blocks by smoothing group, whose memory serves again.
using BlocksOfGroups = std::vector<std::vector<int>>;

/// Whether contact that carries force couples blocks that `A` does not.
bool lacks_stencils(const Model& model, std::span<const ContactPairState* const> pair_states,
                    const fem::BlockMatrix& A, BlocksOfGroups& blocks);

/// Couplings between the nodes of candidates that `A` does not have yet.
void append_missing_stencils(const Model& model, std::span<const CandidateList> candidates,
                             const fem::BlockMatrix& A, Stencils& stencils);

}  // namespace articular::sim
