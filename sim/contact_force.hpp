#pragma once

#include "sim/contact_patch.hpp"
#include "sim/contact_search.hpp"
#include "sim/system_matrix.hpp"

/// The penalty response on contact candidates: each direction of a pair (triangles of a against
/// faces of b, and the reverse) carries half of the pair's stiffness.
namespace articular::sim {

/// What one contact pair carries; force on body a [N].
struct ContactSummary {
  Vec3 force = Vec3::Zero();
  double area = 0;          // [m²] mean of both directions
  double max_depth = 0;     // [m]
  double max_pressure = 0;  // [Pa] stiffness times the largest depth
  double energy = 0;        // [J]
};

/// f += contact forces (block forces); returns one summary per contact of the model.
void add_contact_force(const Model& model, const Configuration& configuration,
                       const std::vector<CandidateList>& candidates, Eigen::VectorXd& f,
                       std::vector<ContactSummary>& summaries);

/// A += scale times the contact stiffness: all of it, or (projected) its Gauss–Newton part.
void add_contact_stiffness(const Model& model, const Configuration& configuration,
                           const std::vector<CandidateList>& candidates, fem::Tangent tangent,
                           double scale, fem::BlockMatrix& A);

/// Contact force at each node of each collider [N] (by body), for output.
std::vector<Positions> nodal_contact_forces(const Model& model, const Configuration& configuration,
                                            const std::vector<CandidateList>& candidates);

/// Couplings between the nodes of candidates that `A` does not have yet.
void append_missing_stencils(const Model& model, const std::vector<CandidateList>& candidates,
                             const fem::BlockMatrix& A, Stencils& stencils);

}  // namespace articular::sim
