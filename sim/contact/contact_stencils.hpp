#pragma once

#include <span>

#include "sim/contact/contact_search.hpp"
#include "sim/model/system_matrix.hpp"

namespace articular::sim {

/// Couplings between the nodes of candidates that `A` does not have yet.
void append_missing_stencils(const Model& model, std::span<const CandidateList> candidates,
                             const fem::BlockMatrix& A, Stencils& stencils);

}  // namespace articular::sim
