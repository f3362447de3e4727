#pragma once

#include <span>
#include <vector>

#include "sim/contact/contact_pair_state.hpp"
#include "sim/contact/friction_coupling.hpp"
#include "sim/contact/group_gradient.hpp"
#include "sim/model/system_matrix.hpp"

namespace articular::sim {

/// The stiffness and the damping of contact.
class ContactStiffness {
 public:
  explicit ContactStiffness(const Model& model);

  /// A += contact stiffness of one contact pair: all of it, or (projected) the positive
  /// semidefinite part Σ k_a A_a ∇g_a ∇g_aᵀ; and the damping. How friction grows with the pressure
  /// goes into `coupling`.
  void add(const ContactPairState& pair_state, const Configuration& configuration,
           fem::Tangent tangent, const SystemScale& scale, fem::BlockMatrix& A,
           FrictionCoupling& coupling);

 private:
  template <class Gradient>
  void add_rank_one(const ContactPairState& pair_state, std::span<const int> patches,
                    const Configuration& configuration, double factor, Gradient&& gradient,
                    fem::BlockMatrix& A);
  void add_measure_stiffness(const ContactPairState& pair_state, std::span<const int> patches,
                             int group, const Configuration& configuration, double scale,
                             fem::BlockMatrix& A);
  void add_node_stiffness(const ContactPairState& pair_state, const Configuration& configuration,
                          fem::Tangent tangent, const SystemScale& scale, fem::BlockMatrix& A,
                          FrictionCoupling& coupling);
  template <class Drag, class Depth>
  void add_coupling(const ContactPairState& pair_state, std::span<const int> patches,
                    const Configuration& configuration, double factor, Drag&& drag, Depth&& depth,
                    FrictionCoupling& coupling);

  const Model& model_;
  PatchesOfGroups patches_;
  GroupGradient gradient_;
  std::vector<FrictionCoupling::Entry> coupled_;  // scratch: of one group
};

}  // namespace articular::sim
